"""`ttr check`: does what theory files claim hold, and do stories go as written?"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from time import sleep
from typing import TYPE_CHECKING, Any, NoReturn

from ttr.cli.command_line import WRONG_USE
from ttr.cli.consent_options import add_allow
from ttr.cli.output import (
    FAILED,
    FINE,
    Commands,
    complain,
    json_place,
    remark,
    say,
    say_json,
    step_count,
)
from ttr.safety.budgets import STEPS, budget
from ttr.safety.consent import Consent

if TYPE_CHECKING:
    from ttr.editing.findings import Checked

_PAUSE = 0.25
"""How many seconds pass between two looks at the files that are watched."""


def add(commands: Commands) -> None:
    """Declares the command."""
    check = commands.add_parser(
        "check",
        help="does what the files claim hold?",
        description="Asks the checks of theory files and looks at their rules, and "
        "plays stories with the games of theories; exits with 1 if one fails or is "
        "wrong.",
    )
    check.add_argument(
        "files", nargs="+", metavar="FILE", help="a theory (.ttr) or stories (.dlg)"
    )
    check.add_argument(
        "--format",
        choices=[*_PRINTERS],
        default="text",
        help="for people (text), or for programs: FILE:LINE:COLUMN: error: … (gcc), or "
        "json",
    )
    check.add_argument(
        "--json",
        action="store_const",
        const="json",
        dest="format",
        help="report for machines: --format json",
    )
    check.add_argument(
        "--watch",
        action="store_true",
        help="check again when a file, or one that it imports, changes",
    )
    add_allow(check)
    check.add_argument(
        "--steps",
        type=step_count,
        default=STEPS,
        metavar="N",
        help=f"how many steps each check may take (default: {STEPS:,})",
    )
    check.set_defaults(run=_check)


def _check(options: argparse.Namespace) -> int:
    files = [
        _Watched(file, Consent.of(options.allow), options.steps)
        for file in options.files
    ]
    show = _PRINTERS[options.format]
    if options.watch:
        _watch(files, show)
    if options.format == "text":  # each as soon as it is known
        for one in files:
            one.check()
            show([one.checked])
    else:
        for one in files:
            one.check()
        show([one.checked for one in files])
    return max(_code(one.checked) for one in files)


def _code(checked: Checked) -> int:
    if checked.is_beyond_limits:
        return WRONG_USE
    return FINE if checked.holds else FAILED


# --- watching ------------------------------------------------------------------------

_Stamp = tuple[int, int, int] | None


def _stamp(path: Path) -> _Stamp:
    """What changes when a file does; None where there is none."""
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


@dataclass
class _Watched:
    """A file, what came of checking it, and the stamps of all that was read for it."""

    file: str
    consent: Consent
    steps: int
    stamps: dict[Path, _Stamp] = field(default_factory=dict)

    def check(self) -> None:
        """Checks the file."""
        from ttr.editing.findings import check_file

        self.stamps = {}
        with budget(steps=self.steps):
            self.checked = check_file(self.file, self.consent, self._note)

    def _note(self, path: Path) -> None:
        """Notes the state of a file before it is read."""
        self.stamps.setdefault(path, _stamp(path))

    @property
    def has_changed(self) -> bool:
        """Has anything changed that was read?"""
        return any(_stamp(path) != stamp for path, stamp in self.stamps.items())


def _watch(files: list[_Watched], show: Callable[[list[Checked]], None]) -> NoReturn:
    """Checks files whenever one changes, until Ctrl-C."""
    changed = files
    while True:
        remark(f"checking {', '.join(one.file for one in changed)}")
        for one in changed:
            one.check()
        show([one.checked for one in files])
        count = len({path for one in files for path in one.stamps})
        remark(f"watching {count} file{'s' * (count != 1)} (Ctrl-C ends)")
        while not (changed := [one for one in files if one.has_changed]):
            sleep(_PAUSE)


# --- printing ------------------------------------------------------------------------


def _print_text(checked: list[Checked]) -> None:
    for one in checked:
        if one.unreadable:
            complain(one.unreadable)
        else:
            say("\n\n".join([*one.messages, one.summary]))


def _print_for_editors(checked: list[Checked]) -> None:
    for one in checked:
        if one.unreadable:
            complain(one.unreadable)
        for finding in () if one.unreadable else one.findings:
            say(str(finding))


def _print_json(checked: list[Checked]) -> None:
    say_json([_json_facts(one) for one in checked])


_PRINTERS: Mapping[str, Callable[[list[Checked]], None]] = {
    "text": _print_text,
    "gcc": _print_for_editors,
    "json": _print_json,
}


def _json_facts(checked: Checked) -> dict[str, Any]:
    report = checked.report
    told: dict[str, Any] = {
        "file": checked.file,
        "asked": report.asked if report else 0,
        "holds": checked.holds,
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
            for error in checked.mistakes
        ]
        + [{"message": checked.unreadable}] * bool(checked.unreadable),
    }
    if checked.outcomes:
        from ttr.dialogues.stories import facts

        told["stories"] = [facts(one) for one in checked.outcomes]
    return told
