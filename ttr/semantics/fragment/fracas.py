"""The FraCaS problems on quantifiers: read them, answer them, compare the answers.

The problem set is not part of this distribution. If you have it as an XML file in Bill
MacCartney's format, you can run its section 1, problems 1 to 80.
Source: Cooper et al. 1996, Using the Framework.
"""

from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, NoReturn, TypeAlias
from xml.parsers import expat

from ttr.errors import TTRError
from ttr.safety.files import why_unread
from ttr.safety.inputs import read_bytes
from ttr.safety.limits import PROBLEMS
from ttr.semantics.fragment.inference import follows
from ttr.semantics.fragment.lexicon import Lexicon
from ttr.semantics.fragment.sentence_parsing import OutsideFragmentError
from ttr.semantics.quantifiers import Thresholds

_LAST = 80
"""The last problem of section 1."""

_DIGITS = 9
"""The most digits that the number of a problem may have."""

_ANSWERS = ("yes", "no", "unknown")

Outcome: TypeAlias = Literal["right", "wrong", "outside", "open"]
"""How a problem came out; open if the set has no plain answer to compare with."""


class UnreadableError(TTRError):
    """A file that is not a FraCaS problem set."""


@dataclass(frozen=True)
class Problem:
    """Premises and a hypothesis, with the answer of the problem set."""

    number: int
    premises: tuple[str, ...]
    hypothesis: str
    answer: str


@dataclass(frozen=True)
class AnsweredProblem:
    """A problem, how it came out, the answer that was found, and why."""

    problem: Problem
    outcome: Outcome
    found: str
    why: str


def problems(path: str | os.PathLike[str]) -> tuple[Problem, ...]:
    """Read the problems of section 1 of a file, in order.

    Raises `UnreadableError` for what is no FraCaS problem set.
    """
    root = _parse_xml(path)
    if root.tag != "fracas-problems":
        raise UnreadableError(
            f"{path} is no FraCaS problem set: expected <fracas-problems>, "
            f"found <{root.tag}>"
        )
    found = [_read_problem(path, it) for it in root.iter("problem")]
    section = tuple(it for it in found if 1 <= it.number <= _LAST)
    if not section:
        raise UnreadableError(f"{path} has none of the problems 1 to {_LAST}")
    return section


def _parse_xml(path: str | os.PathLike[str]) -> ET.Element:
    try:
        data = read_bytes(path, PROBLEMS)
    except OSError as error:
        raise UnreadableError(why_unread(path, error)) from None
    try:
        _refuse_entities(path, data)
        return ET.fromstring(data)
    except (expat.ExpatError, ET.ParseError, LookupError, ValueError) as error:
        raise UnreadableError(f"{path} is no XML: {error}") from None


def _refuse_entities(path: str | os.PathLike[str], data: bytes) -> None:
    """Refuse declarations of entities: these can grow, or read files.

    Raises `UnreadableError`.
    """

    def refuse(name: str, *_: object) -> NoReturn:
        raise UnreadableError(
            f"{path} declares the entity {name}, which is not allowed"
        )

    parser = expat.ParserCreate()
    parser.EntityDeclHandler = refuse
    parser.Parse(data, True)


def _read_problem(path: str | os.PathLike[str], it: ET.Element) -> Problem:
    name = it.get("id", "")
    if not name.isdecimal() or len(name) > _DIGITS:
        raise UnreadableError(f"{path} has a problem whose id is no number: {name!r}")
    premises = tuple(_text(p) for p in it.findall("p"))
    return Problem(
        int(name), premises, _text(it.find("h")), it.get("fracas_answer", "undef")
    )


def _text(element: ET.Element | None) -> str:
    return "" if element is None else " ".join("".join(element.itertext()).split())


def answer_problems(
    some: tuple[Problem, ...], words: Lexicon, thresholds: Thresholds | None = None
) -> Iterator[AnsweredProblem]:
    """Answer the problems one after the other."""
    for problem in some:
        yield _answer_problem(problem, words, thresholds)


def _answer_problem(
    problem: Problem, words: Lexicon, thresholds: Thresholds | None
) -> AnsweredProblem:
    if not problem.hypothesis:
        return AnsweredProblem(problem, "outside", "", "the problem has no hypothesis")
    try:
        found = follows(problem.premises, problem.hypothesis, words, thresholds)
    except OutsideFragmentError as outside:
        why = "; ".join(filter(None, (outside.message, outside.hint)))
        return AnsweredProblem(problem, "outside", "", why)
    if problem.answer not in _ANSWERS:
        return AnsweredProblem(problem, "open", found.verdict, found.why)
    right = found.verdict == problem.answer
    return AnsweredProblem(
        problem, "right" if right else "wrong", found.verdict, found.why
    )
