"""`kille doctor`: what works on this machine, what is missing, and how to get it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict

from kille.interfaces.doctor.basics import line_editing, memory, python, synthetic
from kille.interfaces.doctor.findings import DoctorFinding
from kille.interfaces.doctor.kinect import kinect
from kille.interfaces.doctor.packages import extras, packages
from kille.interfaces.doctor.ros import ros
from kille.interfaces.doctor.speech import speech
from kille.interfaces.terminal import FAILED, FINE, console, hang_text, print_json

Report = Callable[[Sequence[DoctorFinding]], None]
"""How findings are printed."""

Search = Callable[[], Iterator[DoctorFinding]]
"""Finds out the state of a part."""

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
"""The parts to look at, and whether each is needed."""

_MARGIN = 7


def doctor(report: Report) -> int:
    """Print the findings; the exit code is 1 if a needed part does not work."""
    findings = [finding for part in _PARTS for finding in _search_part(*part)]
    report(findings)
    return FAILED if _has_broken_part(findings) else FINE


def as_json(findings: Sequence[DoctorFinding]) -> None:
    """Print the findings as a list of objects, for machines."""
    print_json([asdict(finding) for finding in findings])


def as_text(findings: Sequence[DoctorFinding]) -> None:
    """Print each finding in a line or two, and a conclusion, for people."""
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


def _search_part(part: str, needed: bool, search: Search) -> Iterator[DoctorFinding]:
    """Search for a part; an unexpected failure becomes a finding, too."""
    try:
        yield from search()
    except Exception as error:
        told = " ".join(str(error).split()) or type(error).__name__
        yield DoctorFinding(part, False, needed, told)


def _has_broken_part(findings: Sequence[DoctorFinding]) -> bool:
    return any(finding.needed and not finding.works for finding in findings)


def _mark(finding: DoctorFinding) -> tuple[str, str]:
    """The word for the state, and its colour."""
    if finding.works:
        return "ok", "green"
    return ("FAILS", "red") if finding.needed else ("no", "yellow")


def _with_room(head: str, finding: DoctorFinding) -> tuple[str, str]:
    """The state and its remedy in one line, or in two if there is no room for both.

    A command in a line of its own is not wrapped, so that it can be copied.
    """
    whole = hang_text(head, ": ".join(filter(None, (finding.state, finding.remedy))))
    if not finding.remedy or "\n" not in whole:
        return whole, ""
    return hang_text(head, finding.state), finding.remedy


def _upshot(findings: Sequence[DoctorFinding]) -> str:
    if _has_broken_part(findings):
        return "What FAILS has to be mended before the robot works here."
    return 'All that is needed works; "no" marks what only some uses need.'
