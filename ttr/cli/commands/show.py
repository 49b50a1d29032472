"""`ttr show`: print what a name of a theory stands for."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from ttr.cli.consent_options import add_allow
from ttr.cli.output import FAILED, FINE, Commands, complain, say
from ttr.errors import TTRError, UnsupportedError

if TYPE_CHECKING:
    from ttr.theories.theory import Theory
    from ttr.types.objects import Object
    from ttr.types.printing import Scope

_FORMATS = ("text", "box", "latex", "html")


def add(commands: Commands) -> None:
    """Declares the command."""
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
        type=_level_count,
        metavar="N",
        help="show names for the definitions inside, but for N levels (default: all)",
    )
    show.add_argument("--normal", action="store_true", help="show what it computes to")
    add_allow(show)
    show.set_defaults(run=_show)


def _level_count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"expected 0, 1, 2 or so, found {text}")
    return int(text)


def _show(options: argparse.Namespace) -> int:
    from ttr.theories.loading import UnreadableError
    from ttr.theories.theory import load

    try:
        theory = load(options.file, allow=options.allow)
    except UnreadableError as error:
        return complain(error.message)
    except TTRError as error:
        say(f"error: {error}")
        return FAILED
    if options.name in theory.objects:
        return complain(f"{options.file}: {options.name} is an object, only a name")
    try:
        say(_text_of(theory, options))
    except KeyError as missing:
        return complain(f"{options.file}: {missing.args[0]}")
    except TTRError as error:
        say(f"error: {error}")
        return FAILED
    return FINE


def _text_of(theory: Theory, options: argparse.Namespace) -> str:
    """What the name stands for, in the form asked for; `KeyError` if unknown."""
    from ttr.computing.normalisation import normal_form
    from ttr.display.abbreviations import abbreviator
    from ttr.display.html import page
    from ttr.display.render import box, html, latex
    from ttr.signature.signature import Signature

    if options.name in {*theory.rules, *theory.strategies, *theory.openings}:
        return _rule_text(theory, options)
    # The definition asked for is always unfolded itself.
    unfold = None if options.unfold is None else options.unfold + 1
    value = theory[options.name]
    if options.normal:
        value = normal_form(value, theory)
    fold = abbreviator(theory, unfold)
    value = fold(value)
    text = fold.spelling(theory.spelling_of(options.name))
    as_written = Signature(spelling=text)
    match options.form:
        case "box":
            return box(value, theory=as_written)
        case "latex":
            return latex(value, theory=as_written)
        case "html":
            return page(options.name, html(value, theory=as_written))
    return _declaration(theory, options.name, value, text)


def _rule_text(theory: Theory, options: argparse.Namespace) -> str:
    """The statement that declares a rule, a strategy or a game."""
    from ttr.display.abbreviations import abbreviator
    from ttr.updates.rule_notation import declaration

    if options.form != "text":
        raise UnsupportedError(f"{options.name} is shown as text only: it is no type")
    return declaration(theory, options.name, abbreviator(theory, options.unfold))


def _declaration(theory: Theory, name: str, value: Object, text: Scope) -> str:
    """The name as a statement that declares it."""
    from ttr.notation.names import format_predicate
    from ttr.types.printing import notation
    from ttr.types.syntax import Pred

    if name in theory.definitions:
        return f"{name} := {notation(value, text)}"
    if isinstance(value, Pred):
        return format_predicate(value)
    return f"basic {name}"
