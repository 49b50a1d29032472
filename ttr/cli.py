"""The command `ttr`: check a theory file, show what it defines, try things out."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ttr.errors import TTRError

if TYPE_CHECKING:
    from ttr.checking import Failure
    from ttr.fragment.fracas import Answered
    from ttr.objects import Object
    from ttr.theories import Theory

__all__ = ["main"]

FINE, FAILED, WRONG_USE, INTERRUPTED, PIPE_CLOSED = 0, 1, 2, 130, 141

_FORMATS = ("text", "box", "latex", "html")


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; 0 fine, 1 something does not hold, 2 wrong use."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # not where a program has replaced it
            stream.reconfigure(errors="backslashreplace")
    try:
        code = _run(argv)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return INTERRUPTED
    except RecursionError:
        _complain("types are nested too deep, by definitions, to be printed or checked")
        return FAILED
    except BrokenPipeError:
        # Python would complain once more when it flushes at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE_CLOSED
    return code


def _run(argv: Sequence[str] | None) -> int:
    options = _parser().parse_args(argv)
    code: int = options.command(options)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ttr",
        description="Type Theory with Records: check files, show them, try things.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    check = commands.add_parser(
        "check",
        help="does what the files claim hold?",
        description="Asks the checks of theory files; exits with 1 if one fails.",
    )
    check.add_argument("files", nargs="+", metavar="FILE", help="a theory file (.ttr)")
    check.add_argument("--json", action="store_true", help="report for machines")
    check.set_defaults(command=_check)
    show = commands.add_parser(
        "show",
        help="print what a name stands for",
        description="Prints a definition or declaration of a theory file.",
    )
    show.add_argument("file", metavar="FILE", help="a theory file (.ttr)")
    show.add_argument("name", metavar="NAME", help="a name that it declares")
    show.add_argument(
        "--as", dest="form", choices=_FORMATS, default="text", help="how to print it"
    )
    show.add_argument(
        "--unfold",
        type=_levels,
        metavar="N",
        help="show names for the definitions inside, but for N levels (default: all)",
    )
    show.set_defaults(command=_show)
    repl = commands.add_parser(
        "repl",
        help="type statements and questions, and get answers",
        description="A session in which a theory grows line by line.",
    )
    repl.add_argument("file", nargs="?", metavar="FILE", help="a theory to start from")
    repl.set_defaults(command=_repl)
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
    fracas.set_defaults(command=_fracas)
    return parser


def _levels(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"expected 0, 1, 2 or so, found {text}")
    return int(text)


class _Version(argparse.Action):
    """Prints the version, which is looked up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import version

        _say(f"ttr {version('kille')}")
        parser.exit()


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")


def _complain(text: str) -> int:
    sys.stderr.write(f"ttr: {text}\n")
    return WRONG_USE


# --- ttr check -----------------------------------------------------------------------


@dataclass(frozen=True)
class _Outcome:
    """What became of one file: its mistakes, or the checks that failed."""

    file: str
    asked: int = 0
    failures: tuple[Failure, ...] = ()
    mistakes: tuple[TTRError, ...] = ()
    unreadable: str = ""

    @property
    def code(self) -> int:
        if self.unreadable:
            return WRONG_USE
        return FAILED if self.failures or self.mistakes else FINE


def _check(options: argparse.Namespace) -> int:
    outcomes = []
    for file in options.files:
        outcome = _outcome(file)
        outcomes.append(outcome)
        if not options.json:
            _tell(outcome)
    if options.json:
        _say(
            json.dumps([_facts(one) for one in outcomes], ensure_ascii=False, indent=2)
        )
    return max(one.code for one in outcomes)


def _outcome(file: str) -> _Outcome:
    from ttr.checking import check
    from ttr.notation.loading import Unreadable
    from ttr.theories import Mistakes, load

    try:
        report = check(load(file))
    except Unreadable as error:
        if error.span is None:
            return _Outcome(file, unreadable=error.message)
        return _Outcome(file, mistakes=(error,))
    except Mistakes as error:
        return _Outcome(file, mistakes=error.errors)
    except TTRError as error:
        return _Outcome(file, mistakes=(error,))
    return _Outcome(file, report.asked, report.failures)


def _tell(outcome: _Outcome) -> None:
    if outcome.unreadable:
        _complain(outcome.unreadable)
        return
    if outcome.code == FINE:
        verb = "check holds" if outcome.asked == 1 else "checks hold"
        _say(f"{outcome.file}: {outcome.asked} {verb}")
        return
    told = [f"error: {mistake}" for mistake in outcome.mistakes]
    told += map(str, outcome.failures)
    _say("\n\n".join([*told, _summary(outcome)]))


def _summary(outcome: _Outcome) -> str:
    if outcome.mistakes:
        count = len(outcome.mistakes)
        return f"{outcome.file}: {count} mistake{'s' * (count != 1)}, nothing checked"
    return f"{outcome.file}: {len(outcome.failures)} of {outcome.asked} checks failed"


def _facts(outcome: _Outcome) -> dict[str, Any]:
    return {
        "file": outcome.file,
        "asked": outcome.asked,
        "holds": outcome.code == FINE,
        "failures": [
            {
                **_place(failure.check.span),
                "check": failure.check.text,
                "expected": failure.check.expected,
                "found": failure.found,
                "why": failure.why,
            }
            for failure in outcome.failures
        ],
        "mistakes": [
            {**_place(error.span), "message": error.message, "help": error.hint}
            for error in outcome.mistakes
        ]
        + [{"message": outcome.unreadable}] * bool(outcome.unreadable),
    }


def _place(span: Any) -> dict[str, Any]:
    if span is None:
        return {}
    return {"file": span.source, "line": span.line, "column": span.column}


# --- ttr show ------------------------------------------------------------------------


def _show(options: argparse.Namespace) -> int:
    from ttr.notation.loading import Unreadable
    from ttr.theories import load

    try:
        theory = load(options.file)
    except Unreadable as error:
        return _complain(error.message)
    except TTRError as error:
        _say(f"error: {error}")
        return FAILED
    if options.name in theory.objects:
        return _complain(f"{options.file}: {options.name} is an object, only a name")
    try:
        _say(_shown(theory, options))
    except KeyError as missing:
        return _complain(f"{options.file}: {missing.args[0]}")
    except TTRError as error:
        _say(f"error: {error}")
        return FAILED
    return FINE


def _shown(theory: Theory, options: argparse.Namespace) -> str:
    """What the name stands for, as asked; raises `KeyError` for a name nobody knows."""
    from ttr.display.folding import folding
    from ttr.display.markup import page
    from ttr.render import box, html, latex

    # What was asked for is opened itself, whatever else is not.
    unfold = None if options.unfold is None else options.unfold + 1
    value = folding(theory, unfold)(theory[options.name])
    match options.form:
        case "box":
            return box(value)
        case "latex":
            return latex(value)
        case "html":
            return page(options.name, html(value))
    return _declaration(theory, options.name, value)


def _declaration(theory: Theory, name: str, value: Object) -> str:
    """The name as a statement that declares it."""
    from ttr.printing import notation
    from ttr.syntax import Pred

    if name in theory.definitions:
        return f"{name} := {notation(value)}"
    if isinstance(value, Pred):
        arities = [", ".join(map(str, arity)) for arity in value.arities]
        return f"pred {', '.join(f'{name}({arity})' for arity in arities)}"
    return f"basic {name}"


# --- ttr repl ------------------------------------------------------------------------


def _repl(options: argparse.Namespace) -> int:
    from ttr.interactive.sessions import Session, loaded
    from ttr.interactive.terminal import talk
    from ttr.notation.loading import Unreadable

    session = Session()
    try:
        if options.file is not None:
            session, _ = loaded(session, Path(options.file))
    except Unreadable as error:
        return _complain(error.message)
    except TTRError as error:
        _say(f"error: {error}")
        return FAILED
    talk(session)
    return FINE


# --- ttr fracas ----------------------------------------------------------------------


def _fracas(options: argparse.Namespace) -> int:
    from ttr.fragment.fracas import answered, problems
    from ttr.fragment.lexicon import english

    try:
        words = english()
        if options.lexicon is not None:
            words = words.extended(options.lexicon)
        some = problems(options.file)
    except TTRError as error:
        return _complain(str(error))
    found = []
    for one in answered(some, words):
        found.append(one)
        if not options.json:
            _say(_answer(one))
    totals = Counter[str](one.outcome for one in found)
    if options.json:
        _say(json.dumps(_answers(found, totals), ensure_ascii=False, indent=2))
    else:
        _say(
            f"{len(found)} problems: {totals['right']} right, {totals['wrong']} wrong, "
            f"{totals['outside']} outside the fragment, "
            f"{totals['open']} without a plain answer"
        )
    return FAILED if totals["wrong"] else FINE


def _answer(one: Answered) -> str:
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


def _answers(found: list[Answered], totals: Counter[str]) -> dict[str, Any]:
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


if __name__ == "__main__":
    sys.exit(main())
