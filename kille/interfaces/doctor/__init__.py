"""`kille doctor`: what works on this machine, what is missing, and how to get it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict

from kille.interfaces.doctor.basics import line_editing, memory, python, synthetic
from kille.interfaces.doctor.finding import Finding
from kille.interfaces.doctor.kinect import kinect
from kille.interfaces.doctor.packages import extras, packages
from kille.interfaces.doctor.ros import ros
from kille.interfaces.doctor.speech import speech
from kille.interfaces.terminal import FAILED, FINE, console, hanging

__all__ = ["Finding", "as_json", "as_text", "doctor"]

Report = Callable[[Sequence[Finding]], None]
"""How findings are printed."""


def doctor(report: Report) -> int:
    """Prints the findings; the exit code is 1 if a needed part does not work."""
    findings = list(_findings())
    report(findings)
    broken = any(finding.needed and not finding.works for finding in findings)
    return FAILED if broken else FINE


def as_json(findings: Sequence[Finding]) -> None:
    """The findings as a list of objects, for machines."""
    console().print_json(json.dumps([asdict(finding) for finding in findings]))


def as_text(findings: Sequence[Finding]) -> None:
    """A line for each finding, for people."""
    width = max(len(finding.part) for finding in findings)
    out = console()
    for finding in findings:
        mark, style = _mark(finding)
        state = ": ".join(filter(None, (finding.state, finding.remedy)))
        out.print(f"{mark:>7}", style=style, end="")
        line = hanging(f"{'':7}  {finding.part:<{width}}  ", state)
        out.print(line[7:], markup=False)


def _mark(finding: Finding) -> tuple[str, str]:
    """The word for how it is, and its colour."""
    if finding.works:
        return "ok", "green"
    return ("MISSING", "red") if finding.needed else ("absent", "yellow")


def _findings() -> Iterator[Finding]:
    yield python()
    yield from packages()
    yield synthetic()
    yield memory()
    yield from kinect()
    yield from ros()
    yield from speech()
    yield line_editing()
    yield from extras()
