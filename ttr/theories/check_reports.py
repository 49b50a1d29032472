"""Which checks of a theory failed, and what is wrong with its rules."""

from __future__ import annotations

from dataclasses import dataclass, field

from ttr.judging.judgements import Why
from ttr.showing import Fold, NotebookValue, Part, Text, Value, below, beside
from ttr.theories.queries import Check
from ttr.updates.checks import Fault


@dataclass(frozen=True)
class Failure(NotebookValue):
    """A check that does not hold: what was expected, what was found, and why.

    `derivation` has the reasons as a tree, where a judgement gave the answer.
    """

    check: Check
    found: str
    why: str
    derivation: Why | None = field(default=None, compare=False, repr=False)

    def _shown_as_(self) -> Part:
        found = f"expected {self.check.expected}, found {self.found}"
        return below(
            beside(Text("failed:", "no"), Text(self.check.text, "code"), Text(found)),
            Fold(
                "why",
                Text(self.why) if self.derivation is None else Value(self.derivation),
            ),
        )

    def __str__(self) -> str:
        """The failure as `ttr check` prints it.

        >>> from ttr import Theory, check
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
        lines = [
            f"failed: {self.check.text}",
            str(self.check.span),
            f"expected: {self.check.expected}",
            f"found:    {self.found}",
        ]
        why = self.why.strip().replace("\n", "\n          ")
        if why:
            lines.append(f"why:      {why}")
        return "\n".join(lines)


@dataclass(frozen=True)
class Report(NotebookValue):
    """The outcome of checking a theory.

    `asked` is the number of checks, `failures` has those that failed; `rules` is the
    number of rules, `faults` is what is wrong with them and with definitions.
    """

    asked: int
    failures: tuple[Failure, ...]
    rules: int = 0
    faults: tuple[Fault, ...] = ()

    @property
    def holds(self) -> bool:
        """Did no check fail, and is no rule wrong? Warnings do not count."""
        return not self.failures and all(
            fault.severity == "warning" for fault in self.faults
        )

    def _shown_as_(self) -> Part:
        return below(
            Text(self.summary, "yes" if self.holds else "no"),
            *[one._shown_as_() for one in self.failures],
            *[_draw_fault(fault) for fault in self.faults],
        )

    @property
    def summary(self) -> str:
        """The number of checks that hold or fail, and of faults, on one line."""
        parts = ["no mistakes and no checks"]
        if self.asked:
            parts = [_count_of(self.asked, "check holds", "checks hold")]
        if self.failures:
            parts = [f"{len(self.failures)} of {self.asked} checks failed"]
        if self.rules:
            rules = _count_of(self.rules, "rule", "rules")
            parts.append(f"{self._count_faults} in {rules}")
        elif self.faults:
            parts.append(self._count_faults)
        return ", ".join(parts)

    @property
    def _count_faults(self) -> str:
        """The number of faults and warnings."""
        warnings = sum(fault.severity == "warning" for fault in self.faults)
        wrong = len(self.faults) - warnings
        count = _count_of(wrong, "fault", "faults") if wrong else "no fault"
        more = f" and {_count_of(warnings, 'warning', 'warnings')}" if warnings else ""
        return count + more

    @property
    def messages(self) -> tuple[str, ...]:
        """The checks that failed and the faults, each as `ttr check` prints it."""
        return (*map(str, self.failures), *map(_format_fault, self.faults))

    def __str__(self) -> str:
        return "\n\n".join(self.messages) or self.summary


def _count_of(count: int, one: str, several: str) -> str:
    return f"{count} {one if count == 1 else several}"


def _format_fault(fault: Fault) -> str:
    """A fault as `ttr check` prints it, with the word fault or warning before it."""
    head = "warning" if fault.severity == "warning" else "fault"
    return f"{head}: {fault}"


def _draw_fault(fault: Fault) -> Part:
    is_warning = fault.severity == "warning"
    word = Text("warning:", "strong") if is_warning else Text("fault:", "no")
    place = f"line {fault.span.line}: {fault.span.text.strip()}" if fault.span else ""
    return below(
        beside(word, Text(fault.message)),
        Text(place, "code") if place else None,
        Text(f"help: {fault.hint}", "quiet") if fault.hint else None,
    )
