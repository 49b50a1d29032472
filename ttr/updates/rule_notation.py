"""Printing rules, strategies and games in the notation of theory files."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ttr.aliases import former_names
from ttr.errors import UnsupportedError
from ttr.escapes import json_text
from ttr.probability import CERTAIN, Degree
from ttr.signature.signature import Opening
from ttr.types.objects import Object
from ttr.types.printing import as_object, notation
from ttr.types.reserved_words import RESERVED
from ttr.updates.rules import Body, Rule

if TYPE_CHECKING:
    from ttr.theories.theory import Theory

__all__ = ["declaration", "format_rule"]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)

Fold = Callable[[Object], Object]
"""Replaces types by their names (`ttr.display.abbreviations`)."""


def format_rule(rule: Rule) -> str:
    r"""The statement that declares the rule.

    Where the names in it are declared, reading it gives the same rule. Raises
    `UnsupportedError` for a rule that has no notation, as one whose effect is in
    Python.

    >>> from ttr import Theory
    >>> board = Theory.parse('''
    ...     basic Ind
    ...     Board := [spkr : Ind, addr : Ind]
    ...     rule turn(s : Board) 'Who was spoken to speaks.' of floor
    ...         where [a = s.addr : Ind] := [spkr = a : Ind, addr = s.spkr : Ind]
    ... ''')
    >>> print(format_rule(board.rules["turn"]))
    rule turn(s : [addr : Ind, spkr : Ind]) "Who was spoken to speaks." of floor
        where [a = s.addr : Ind]
        := [addr = s.spkr : Ind, spkr = a : Ind]
    """
    return "\n    ".join(_lines(rule))


def _lines(rule: Rule) -> Iterator[str]:
    if not isinstance(rule.effect, Body):
        raise UnsupportedError(
            f"the effect of {rule} is a Python function, not notation"
        )
    if rule.gives is not None:
        raise UnsupportedError(f"{rule} declares what it gives, which has no notation")
    for name in (rule.name, rule.kind or rule.name):
        if not name.isidentifier() or name in RESERVED:
            raise UnsupportedError(f"{name!r} is no name in the notation")
    names = rule.names[: 1 + (rule.on is not None)]
    kind = f" of {rule.kind}" if rule.kind else ""
    doc = f" {json_text(rule.doc)}" if rule.doc else ""
    yield f"rule {rule.name}({', '.join(_format_parameters(rule, names))}){doc}{kind}"
    if rule.where:
        yield f"where {notation(rule.where, (frozenset(names),))}"
    scope = (frozenset((*names, *(rule.where or ()))),)
    yield f":= {notation(as_object(rule.effect.value, scope), scope)}"


def _format_parameters(rule: Rule, names: tuple[str, ...]) -> Iterator[str]:
    yield f"{names[0]} : {notation(rule.when)}"
    if rule.on is None:
        return
    certainty = "" if rule.p == CERTAIN else f" in {_format_interval(rule.p)}"
    scope = (frozenset(names[:1]),)
    yield f"{names[1]} : {notation(rule.on, scope)}{certainty}"


def _format_interval(p: Degree) -> str:
    """The interval, with whole numbers for its ends where possible.

    >>> _format_interval(Degree(0.7, 1.0))
    '[0.7, 1]'
    """
    ends = (int(end) if end == int(end) else end for end in p)
    return f"[{', '.join(map(repr, ends))}]"


# --- declarations of a theory --------------------------------------------------------


def declaration(theory: Theory, name: str, fold: Fold = lambda value: value) -> str:
    """The statement that declares a rule, a strategy or a game of a theory.

    Raises `KeyError` for any other name.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     S := [l : list(Ind)]
    ...     rule forget(s : S) := [l = [] : list(Ind)]
    ...     game oblivion({l = []} : S) := maybe(forget)
    ... ''')
    >>> print(declaration(theory, "oblivion"))
    game oblivion({l = []} : [l : list(Ind)]) := maybe(forget)
    """
    if name in theory.rules:
        return format_rule(_abbreviate(theory.rules[name], fold))
    if name in theory.strategies:
        return f"strategy {name} := {theory.strategies[name]}"
    return _declare_game(theory.openings[name], fold)


def _declare_game(game: Opening, fold: Fold) -> str:
    start, state = notation(fold(game.start)), notation(fold(game.type))
    acts = f", acts on {game.agenda}" if game.agenda else ""
    types = ", ".join(notation(fold(T)) for T in game.hears)
    hears = f", hears {types}" if types else ""
    return f"game {game.name}({start} : {state}{acts}{hears}) := {game.algorithm}"


def _abbreviate(rule: Rule, fold: Fold) -> Rule:
    """The rule with its types replaced by their names, only to be displayed."""
    effect = rule.effect
    if isinstance(effect, Body):
        effect = replace(effect, value=fold(effect.value))
    folded: dict[str, Any] = {"when": fold(rule.when), "effect": effect}
    if rule.on is not None:
        folded["on"] = fold(rule.on)
    if rule.where is not None:
        folded["where"] = fold(rule.where)
    return replace(rule, **folded)
