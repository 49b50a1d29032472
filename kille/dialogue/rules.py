"""Rules of the dialogue: on types that are known by their names, until a game is made.

A rule says what it is about in the names that a theory gives its types, so that the
same rules serve every theory that has these names. `bind` makes rules for one theory.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import NoReturn, TypeAlias

from kille.dialogue.meanings import DialogueTypes, any_of
from kille.dialogue.moves import plan, unanswered_states
from ttr import Rec, Record, RecordType
from ttr.errors import Span, UpdateError
from ttr.probability import CERTAIN
from ttr.updates import Algorithm, ByClass, Maybe, Repeat, Rule
from ttr.updates.rules import (
    EXTRAS,
    Effect,
    degree_asked_for,
    name_of_effect,
    read_parameters,
    span_of_function,
)

__all__ = ["NamedRule", "bind", "reply", "rule"]

When: TypeAlias = str | Callable[[DialogueTypes], RecordType]
"""A condition: the name of a record type, or what makes one of the types."""

TYPES = "types"
"""The parameter by which an effect is given the types of its game."""


@dataclass(frozen=True, repr=False, kw_only=True)
class NamedRule(Rule):
    """A rule on types known by their names; it can be played once it is bound.

    >>> @rule(answers="Greet")
    ... def be_silent(s): ...
    >>> isinstance(be_silent, NamedRule), be_silent.name
    (True, 'be_silent')
    """

    of: Effect
    condition: When
    event: str
    takes_types: bool
    says: tuple[str, ...] = ()
    """Moves that it is known to plan: the theory must have their types."""

    @cached_property
    def span(self) -> Span | None:
        """Where the function of the rule stands."""
        return span_of_function(self.of)

    def bind(self, types: DialogueTypes) -> Rule:
        """The rule on the types that a theory gives these names.

        `KeyError` for one that the theory does not have.
        """
        for move in self.says:
            types.record_type(move)
        condition = self.condition
        return Rule(
            self.name,
            partial(self.of, types=types) if self.takes_types else self.of,
            types.record_type(condition)
            if isinstance(condition, str)
            else condition(types),
            on=types[self.event] if self.event else None,
            p=self.p,
            takes=self.takes,
            names=self.names,
            doc=self.doc,
        )


def rule(
    *,
    when: When = "State",
    on: str = "",
    answers: str | tuple[str, ...] = (),
    p: object = CERTAIN,
) -> Callable[[Effect], NamedRule]:
    """Make a rule of a function, as `ttr.updates.rule` does, on types by their names.

    `when` names the type of the states, `on` that of the event; `answers` names a move,
    or several, for the states in which one of them is the latest and no answer is
    planned yet. A function
    with a parameter `types` is given the `DialogueTypes` of the game.

    >>> from kille.dialogue.meanings import packaged_types
    >>> from kille.dialogue.moves import plan
    >>> @rule(answers="Greet")
    ... def be_curt(s, *, types):
    ...     "A greeting is only noted."
    ...     return plan(s, "Noted", types=types)
    >>> bound = bind(be_curt, packaged_types())
    >>> print(bound.when["shared"])
    [latest : [addr : Ind, spkr : Ind, e : greet(spkr, addr)]]
    """
    moves = (answers,) if isinstance(answers, str) else answers
    condition: When = partial(_states_to_answer, moves=moves) if moves else when
    certain = degree_asked_for(p)

    def make_rule(effect: Effect) -> NamedRule:
        name = name_of_effect(effect)
        names, takes = read_parameters(name, effect, bool(on), (*EXTRAS, TYPES))
        return NamedRule(
            name,
            partial(_refuse, name),
            Rec,
            on=Rec if on else None,
            p=certain,
            takes=takes - {TYPES},
            names=names,
            doc=inspect.getdoc(effect) or "",
            of=effect,
            condition=condition,
            event=on,
            takes_types=TYPES in takes,
        )

    return make_rule


def reply(move: str, act: str, doc: str) -> NamedRule:
    """The rule that answers every such move by this act, without a thought.

    >>> print(reply("Thank", "Welcome", "Thanks are acknowledged.").name)
    Welcome to Thank
    """

    def answer(s: Record, *, types: DialogueTypes) -> Record:
        return plan(s, act, types=types)

    answer.__name__ = f"{act} to {move}"
    answer.__doc__ = doc
    return replace(rule(answers=move)(answer), says=(act,))


def bind(algorithm: Algorithm, types: DialogueTypes) -> Algorithm:
    """The strategy with its rules on the types of a theory; other rules stay.

    >>> from kille.dialogue.meanings import packaged_types
    >>> bound = bind(reply("Thank", "Welcome", "Thanks."), packaged_types())
    >>> print(bound.when["shared"])
    [latest : [addr : Ind, spkr : Ind, e : thank(spkr, addr)]]
    """
    return types.derive(_bind, algorithm)


def _bind(types: DialogueTypes, algorithm: Algorithm) -> Algorithm:
    match algorithm:
        case NamedRule():
            return types.derive(_bind_rule, algorithm)
        case Rule():
            return algorithm
        case Maybe(part) | Repeat(part):
            return replace(algorithm, part=_bind(types, part))
        case ByClass(classes):
            new = [
                (kind, tuple(_bind_if_named(types, it) for it in r))
                for kind, r in classes
            ]
            return ByClass(tuple(new))
    parts = tuple(_bind(types, part) for part in algorithm.parts)
    return replace(algorithm, parts=parts)


def _bind_rule(types: DialogueTypes, rule: NamedRule) -> Rule:
    return rule.bind(types)


def _bind_if_named(types: DialogueTypes, rule: Rule) -> Rule:
    return types.derive(_bind_rule, rule) if isinstance(rule, NamedRule) else rule


def _states_to_answer(types: DialogueTypes, moves: tuple[str, ...]) -> RecordType:
    return types.derive(unanswered_states, types.derive(any_of, moves))


def _refuse(name: str, *_: object, **__: object) -> NoReturn:
    raise UpdateError(
        f"the rule {name} is on types by their names: bind it to a theory's first"
    )
