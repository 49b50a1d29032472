"""`ttr fracas`: answer the FraCaS problems on quantifiers."""

from __future__ import annotations

import argparse
from collections import Counter
from typing import TYPE_CHECKING, Any

from ttr.cli.consent_options import add_allow
from ttr.cli.output import FAILED, FINE, Commands, complain, say, say_json
from ttr.errors import TTRError

if TYPE_CHECKING:
    from ttr.semantics.fragment.fracas import AnsweredProblem


def add(commands: Commands) -> None:
    """Declares the command."""
    fracas = commands.add_parser(
        "fracas",
        help="answer the FraCaS problems on quantifiers",
        description="Answers section 1 of a FraCaS problem set; exits with 1 if one is "
        "wrong.",
    )
    fracas.add_argument("file", metavar="FILE", help="the problem set (.xml)")
    fracas.add_argument(
        "--lexicon", metavar="FILE", help="a theory file (.ttr) with more words"
    )
    fracas.add_argument("--json", action="store_true", help="report for machines")
    add_allow(fracas)
    fracas.set_defaults(run=_fracas)


def _fracas(options: argparse.Namespace) -> int:
    from ttr.semantics.fragment.fracas import answer_problems, problems
    from ttr.semantics.fragment.lexicon import english

    try:
        words = english()
        if options.lexicon is not None:
            words = words.extend(options.lexicon, allow=options.allow)
        some = problems(options.file)
    except TTRError as error:
        return complain(str(error))
    found = []
    for one in answer_problems(some, words):
        found.append(one)
        if not options.json:
            say(_answer_line(one))
    totals = Counter[str](one.outcome for one in found)
    if options.json:
        say_json(_json_answers(found, totals))
    else:
        say(
            f"{len(found)} problems: {totals['right']} right, {totals['wrong']} wrong, "
            f"{totals['outside']} outside the fragment, "
            f"{totals['open']} without a plain answer"
        )
    return FAILED if totals["wrong"] else FINE


def _answer_line(one: AnsweredProblem) -> str:
    """A line on one problem."""
    number = f"{one.problem.number:03}"
    match one.outcome:
        case "outside":
            return f"{number}  outside the fragment: {one.why}"
        case "wrong":
            return f"{number}  wrong: {one.found}, expected {one.problem.answer}"
        case "open":
            return f"{number}  without a plain answer: {one.found}"
    return f"{number}  right: {one.found}"


def _json_answers(found: list[AnsweredProblem], totals: Counter[str]) -> dict[str, Any]:
    outcomes = ("right", "wrong", "outside", "open")
    return {
        "problems": [
            {
                "id": one.problem.number,
                "outcome": one.outcome,
                "expected": one.problem.answer,
                "found": one.found or None,
                "why": one.why,
            }
            for one in found
        ],
        "totals": {outcome: totals[outcome] for outcome in outcomes},
    }
