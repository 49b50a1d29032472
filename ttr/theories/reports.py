"""What became of a theory's checks, and what is wrong with its rules."""

from __future__ import annotations

from dataclasses import dataclass

from ttr.theories.queries import Check
from ttr.updates.checks import Fault

__all__ = ["Failure", "Report", "described"]


@dataclass(frozen=True)
class Failure:
    """A check that does not hold: what was expected, what was found, and why."""

    check: Check
    found: str
    why: str

    def __str__(self) -> str:
        """The failure as the command prints it.

        >>> from ttr.theories.checking import check
        >>> from ttr.theories.theory import Theory
        >>> theory = Theory.parse("basic A, B\\ncheck A <= B", "ab.ttr")
        >>> print(check(theory).failures[0])
        failed: check A <= B
          ┌─ ab.ttr:2:1
        2 │ check A <= B
          │ ^^^^^^^^^^^^
        expected: yes
        found:    no
        why:      A is not below B
        """
        why = self.why.strip().replace("\n", "\n          ")
        return (
            f"failed: {self.check.text}\n{self.check.span}\n"
            f"expected: {self.check.expected}\nfound:    {self.found}"
            + f"\nwhy:      {why}"
            * bool(why)
        )


@dataclass(frozen=True)
class Report:
    """What became of a theory's checks: how many were asked, and those that failed.

    `faults` are what is wrong with its rules, of which there are so many.
    """

    asked: int
    failures: tuple[Failure, ...]
    rules: int = 0
    faults: tuple[Fault, ...] = ()

    @property
    def holds(self) -> bool:
        """Whether no check failed and no rule is wrong; a warning says none is."""
        return not self.failures and all(
            fault.severity == "warning" for fault in self.faults
        )

    @property
    def summary(self) -> str:
        """How many checks hold, and how many rules are without fault, on one line."""
        told = [_count_of(self.asked, "check holds", "checks hold")]
        if self.failures:
            told = [f"{len(self.failures)} of {self.asked} checks failed"]
        if self.rules:
            rules = _count_of(self.rules, "rule", "rules")
            told.append(f"{self._found} in {rules}")
        return ", ".join(told)

    @property
    def _found(self) -> str:
        """How many faults and warnings there are."""
        warnings = sum(fault.severity == "warning" for fault in self.faults)
        wrong = len(self.faults) - warnings
        count = _count_of(wrong, "fault", "faults") if wrong else "no fault"
        more = f" and {_count_of(warnings, 'warning', 'warnings')}" if warnings else ""
        return count + more

    @property
    def told(self) -> tuple[str, ...]:
        """The checks that failed and the faults, each as the command prints it."""
        return (*map(str, self.failures), *map(described, self.faults))

    def __str__(self) -> str:
        return "\n\n".join(self.told) or self.summary


def _count_of(count: int, one: str, several: str) -> str:
    return f"{count} {one if count == 1 else several}"


def described(fault: Fault) -> str:
    """A fault as the command prints it, with its sort in front."""
    head = "warning" if fault.severity == "warning" else "fault"
    return f"{head}: {fault}"
