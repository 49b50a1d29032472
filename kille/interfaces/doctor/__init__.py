"""`kille doctor`: what works on this machine, what is missing, and how to get it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict

from kille.interfaces.doctor.basics import line_editing, memory, python, synthetic
from kille.interfaces.doctor.finding import Finding
from kille.interfaces.doctor.kinect import kinect
from kille.interfaces.doctor.packages import extras, packages
from kille.interfaces.doctor.ros import ros
from kille.interfaces.doctor.speech import speech
from kille.interfaces.terminal import FAILED, FINE, console, hanging, print_json

Report = Callable[[Sequence[Finding]], None]
"""How findings are printed."""

Search = Callable[[], Iterator[Finding]]
"""Finds out how a part is."""

_PARTS: tuple[tuple[str, bool, Search], ...] = (
    ("Python", True, python),
    ("packages", True, packages),
    ("synthetic Kinect", True, synthetic),
    ("memory", True, memory),
    ("Kinect", False, kinect),
    ("ROS", False, ros),
    ("speech", False, speech),
    ("line editing", False, line_editing),
    ("extras", False, extras),
)
"""What is looked at, and whether it is needed."""

_MARGIN = 7


def doctor(report: Report) -> int:
    """Prints the findings; the exit code is 1 if a needed part does not work."""
    findings = [finding for part in _PARTS for finding in _found(*part)]
    report(findings)
    return FAILED if _broken(findings) else FINE


def as_json(findings: Sequence[Finding]) -> None:
    """The findings as a list of objects, for machines."""
    print_json([asdict(finding) for finding in findings])


def as_text(findings: Sequence[Finding]) -> None:
    """A line or two for each finding, and what they come to, for people."""
    width = max(len(finding.part) for finding in findings)
    out = console()
    for finding in findings:
        mark, style = _mark(finding)
        out.print(f"{mark:>{_MARGIN}}", style=style, end="")
        head = f"{'':{_MARGIN}}  {finding.part:<{width}}  "
        line, below = _with_room(head, finding)
        out.print(line[_MARGIN:], markup=False)
        if below:
            out.print(f"{'':{_MARGIN + 4}}{below}", style="cyan", markup=False)
    out.print(f"\n{_upshot(findings)}", markup=False)


def _found(part: str, needed: bool, search: Search) -> Iterator[Finding]:
    """What is found; a part that fails in a way of its own is a finding, too."""
    try:
        yield from search()
    except Exception as error:
        told = " ".join(str(error).split()) or type(error).__name__
        yield Finding(part, False, needed, told)


def _broken(findings: Sequence[Finding]) -> bool:
    return any(finding.needed and not finding.works for finding in findings)


def _mark(finding: Finding) -> tuple[str, str]:
    """The word for how it is, and its colour."""
    if finding.works:
        return "ok", "green"
    return ("FAILS", "red") if finding.needed else ("no", "yellow")


def _with_room(head: str, finding: Finding) -> tuple[str, str]:
    """The state and its remedy in one line, or parted if there is no room for both.

    A command in a line of its own is not wrapped, so that it can be copied.
    """
    whole = hanging(head, ": ".join(filter(None, (finding.state, finding.remedy))))
    if not finding.remedy or "\n" not in whole:
        return whole, ""
    return hanging(head, finding.state), finding.remedy


def _upshot(findings: Sequence[Finding]) -> str:
    if _broken(findings):
        return "What FAILS has to be mended before the robot works here."
    return 'All that is needed works; "no" marks what only some uses need.'
