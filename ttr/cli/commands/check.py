"""`ttr check`: does what theory files claim hold?"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ttr.cli.command_line import WRONG_USE
from ttr.cli.consent_options import add_allow
from ttr.cli.output import (
    FAILED,
    FINE,
    Commands,
    complain,
    json_place,
    say,
    say_json,
    step_count,
)
from ttr.errors import TooLargeError, TTRError
from ttr.safety.budgets import STEPS, budget

if TYPE_CHECKING:
    from ttr.theories.check_reports import Report


def add(commands: Commands) -> None:
    """Declares the command."""
    check = commands.add_parser(
        "check",
        help="does what the files claim hold?",
        description="Asks the checks of theory files and looks at their rules; exits "
        "with 1 if one fails or is wrong.",
    )
    check.add_argument("files", nargs="+", metavar="FILE", help="a theory file (.ttr)")
    check.add_argument("--json", action="store_true", help="report for machines")
    add_allow(check)
    check.add_argument(
        "--steps",
        type=step_count,
        default=STEPS,
        metavar="N",
        help=f"how many steps each check may take (default: {STEPS:,})",
    )
    check.set_defaults(run=_check)


@dataclass(frozen=True)
class _Outcome:
    """The result of one file: its mistakes, or the report on it."""

    file: str
    report: Report | None = None
    mistakes: tuple[TTRError, ...] = ()
    unreadable: str = ""

    @property
    def code(self) -> int:
        if self.unreadable or any(isinstance(e, TooLargeError) for e in self.mistakes):
            return WRONG_USE
        return FINE if self.report is not None and self.report.holds else FAILED


def _check(options: argparse.Namespace) -> int:
    outcomes = []
    for file in options.files:
        with budget(steps=options.steps):
            outcome = _outcome(file, options.allow)
        outcomes.append(outcome)
        if not options.json:
            _print_outcome(outcome)
    if options.json:
        say_json([_json_facts(one) for one in outcomes])
    return max(one.code for one in outcomes)


def _outcome(file: str, allow: Sequence[Path]) -> _Outcome:
    from ttr.errors import MistakesError
    from ttr.theories.checking import check
    from ttr.theories.loading import UnreadableError
    from ttr.theories.theory import load

    try:
        report = check(load(file, allow=allow))
    except UnreadableError as error:
        if error.span is None:
            return _Outcome(file, unreadable=error.message)
        return _Outcome(file, mistakes=(error,))
    except MistakesError as error:
        return _Outcome(file, mistakes=error.errors)
    except TTRError as error:
        return _Outcome(file, mistakes=(error,))
    return _Outcome(file, report)


def _print_outcome(outcome: _Outcome) -> None:
    if outcome.unreadable:
        complain(outcome.unreadable)
        return
    if outcome.report is None:
        count = len(outcome.mistakes)
        told = [f"error: {mistake}" for mistake in outcome.mistakes]
        summary = f"{count} mistake{'s' * (count != 1)}, nothing checked"
    else:
        told, summary = list(outcome.report.messages), outcome.report.summary
    say("\n\n".join([*told, f"{outcome.file}: {summary}"]))


def _json_facts(outcome: _Outcome) -> dict[str, Any]:
    report = outcome.report
    return {
        "file": outcome.file,
        "asked": report.asked if report else 0,
        "holds": outcome.code == FINE,
        "failures": [
            {
                **json_place(failure.check.span),
                "check": failure.check.text,
                "expected": failure.check.expected,
                "found": failure.found,
                "why": failure.why,
            }
            for failure in (report.failures if report else ())
        ],
        "rules": report.rules if report else 0,
        "faults": [
            {
                **json_place(fault.span),
                "rule": fault.rule.name if fault.rule else None,
                "sort": fault.sort,
                "severity": fault.severity,
                "message": fault.message,
                "help": fault.hint,
            }
            for fault in (report.faults if report else ())
        ],
        "mistakes": [
            {**json_place(error.span), "message": error.message, "help": error.hint}
            for error in outcome.mistakes
        ]
        + [{"message": outcome.unreadable}] * bool(outcome.unreadable),
    }
