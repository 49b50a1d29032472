"""Results of stories: a line for people, JSON, or a JUnit report for CI systems."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any
from xml.etree import ElementTree

from ttr.dialogues.stories.mismatches import Mismatch
from ttr.errors import TTRError
from ttr.escapes import terminal_text


@dataclass(frozen=True)
class Outcome:
    """The result of a story: where it differs, or why it could not be played.

    With neither, it went as written.

    >>> Outcome("hello.dlg", "a greeting", 0.25).as_written
    True
    """

    file: str
    title: str
    seconds: float = 0.0
    mismatch: Mismatch | None = None
    error: TTRError | None = None

    @property
    def as_written(self) -> bool:
        """Was the story played, and did nothing differ?"""
        return self.mismatch is None and self.error is None

    def __str__(self) -> str:
        """Where it differs or what is wrong; empty where it went as written."""
        told = self.mismatch or self.error
        return "" if told is None else str(told)


def summary(file: str, outcomes: Sequence[Outcome]) -> str:
    """A line on the results of the stories of a file.

    >>> summary("hello.dlg", [Outcome("hello.dlg", "a greeting", 0.25)])
    'hello.dlg: 1 story as written'
    """
    count = len(outcomes)
    told = f"{count} {'story' if count == 1 else 'stories'}"
    wrong = sum(not one.as_written for one in outcomes)
    if not wrong:
        return f"{file}: {told} as written"
    return f"{file}: {wrong} of {told} {'differs' if wrong == 1 else 'differ'}"


def facts(one: Outcome) -> dict[str, Any]:
    """The result of a story for machines, as a JSON object.

    >>> facts(Outcome("hello.dlg", "a greeting", 0.25))
    {'file': 'hello.dlg', 'title': 'a greeting', 'difference': None}
    """
    told: dict[str, Any] = {"file": one.file, "title": one.title, "difference": None}
    if one.error is not None:
        return {**told, "error": str(one.error)}
    if one.mismatch is None:
        return told
    line = one.mismatch.line
    told["difference"] = {
        "line": {
            "file": line.file,
            "number": line.number,
            "mark": line.mark,
            "text": line.text,
        },
        "expected": one.mismatch.expected,
        "found": one.mismatch.found,
        "rules": [
            {"rule": step.rule.name, "changes": list(step.changes)}
            for step in one.mismatch.trace
        ],
    }
    return told


def junit(outcomes: Iterable[Outcome]) -> str:
    """The report: a test suite for each file, a test case for each story.

    It keeps to the schema of Jenkins' xUnit plugin (junit-10.xsd).

    >>> print(junit([Outcome("hello.dlg", "a greeting", 0.25)]))
    <?xml version='1.0' encoding='utf-8'?>
    <testsuites tests="1" failures="0" errors="0" time="0.250">
      <testsuite name="hello.dlg" file="hello.dlg" tests="1" failures="0" ...>
        <testcase name="a greeting" classname="hello" time="0.250" />
      </testsuite>
    </testsuites>
    """
    files: dict[str, list[Outcome]] = {}
    for one in outcomes:
        files.setdefault(one.file, []).append(one)
    every = [one for group in files.values() for one in group]
    root = ElementTree.Element("testsuites", _totals(every))
    for file, group in files.items():
        about = {
            "name": terminal_text(file),
            "file": terminal_text(file),
            **_totals(group),
        }
        suite = ElementTree.SubElement(root, "testsuite", about)
        for one in group:
            _add_case(suite, one)
    ElementTree.indent(root)
    written: bytes = ElementTree.tostring(root, "utf-8", xml_declaration=True)
    return written.decode("utf-8")


def _totals(outcomes: list[Outcome]) -> dict[str, str]:
    failed = sum(one.mismatch is not None for one in outcomes)
    broken = sum(one.error is not None for one in outcomes)
    return {
        "tests": str(len(outcomes)),
        "failures": str(failed),
        "errors": str(broken),
        "time": f"{sum(one.seconds for one in outcomes):.3f}",
    }


def _add_case(suite: ElementTree.Element, one: Outcome) -> None:
    about = {
        "name": terminal_text(one.title),
        "classname": terminal_text(PurePath(one.file).stem),
        "time": f"{one.seconds:.3f}",
    }
    case = ElementTree.SubElement(suite, "testcase", about)
    if one.as_written:
        return
    kind = "error" if one.error is not None else "failure"
    first = str(one.error or f"{one.file} differs in line {_line_number(one)}")
    brief = {"message": terminal_text(first.splitlines()[0]), "type": kind}
    ElementTree.SubElement(case, kind, brief).text = terminal_text(str(one))


def _line_number(one: Outcome) -> int:
    return one.mismatch.line.number if one.mismatch is not None else 0
