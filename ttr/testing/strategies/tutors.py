"""Tutors: those with whom a game is played, and what they say next.

A tutor who answers what was asked reaches states that random moves never reach: 3,000
random dialogues never crashed a travel agency; of 3,000 with answers, one in seven did.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import gcd
from typing import TypeAlias

from hypothesis import strategies as st

from ttr.dialogues.dialogue import Dialogue, event_heard
from ttr.errors import TTRError
from ttr.judging.certainty import is_certain
from ttr.judging.models import Model
from ttr.testing.strategies.discourse_roles import Acts, acts_in
from ttr.testing.strategies.random_states import event_of, heard_by
from ttr.types.objects import Object, Record
from ttr.types.syntax import TypeNode
from ttr.updates.games import Game
from ttr.updates.nbest import NBest, nbest
from ttr.updates.rules import Rule

Speaker: TypeAlias = Callable[[st.DrawFn, Record, Model], object]
"""A tutor of one's own: draws what is said next, from the state and the model."""

Voice: TypeAlias = Callable[[st.DrawFn, Dialogue], Object]
"""Draws what is said next, from the dialogue so far."""


_WAYS = ("answers", "wanders", "contradicts", "repeats", "silent", "mumbles")

_CERTAINTIES = st.sampled_from([(0.9, 0.05), (0.6, 0.3), (0.4, 0.2), (0.1, 0.05)])
"""Probabilities that the one, and the other, of two things was heard."""


@dataclass(frozen=True)
class Tutor:
    """What a tutor can say, and how often they do what, as shares of 1.

    `moves` is all that there is to say and `replies` what answers what was asked: a
    sequence of texts, events, uncertain events and types of events, or a function of
    state and model that gives one. If there are no moves, they are the types of events
    that the game hears; if there are no replies, they are those moves that some rule
    waits for in the state.

    The tutor `answers` what was asked, or `wanders` off to any other move, or
    `contradicts` their last answer, `repeats` what they said last, is `silent`, or
    `mumbles`, so that two things may have been heard, with probabilities. A tutor who
    cannot do one of these answers. Raises `TTRError` for what is no share.

    >>> chatty = Tutor(moves=("Hello.", "This is a cup."), repeats=0.2, answers=0.64)
    >>> chatty.moves
    ('Hello.', 'This is a cup.')
    """

    moves: Acts = ()
    replies: Acts | None = None
    answers: float = 0.8
    wanders: float = 0.08
    contradicts: float = 0.04
    repeats: float = 0.04
    silent: float = 0.04
    mumbles: float = 0.0

    def __post_init__(self) -> None:
        for name in _WAYS:
            weight = getattr(self, name)
            if not isinstance(weight, int | float) or not 0 <= weight <= 1:
                raise TTRError(f"{name} is a share from 0 to 1, found {weight!r}")
        if not any(getattr(self, name) for name in _WAYS):
            raise TTRError("a tutor does something: one share at least is above 0")

    @cached_property
    def ways(self) -> st.SearchStrategy[str]:
        """What the tutor does next; Hypothesis shrinks it to the first, answering."""
        shares = [round(100 * getattr(self, name)) for name in _WAYS]
        unit = gcd(*shares) or 1
        numbers = [share // unit for share in shares]
        ways = zip(_WAYS, numbers, strict=True)
        return st.sampled_from([way for way, number in ways for _ in range(number)])


def voice_of(tutor: Tutor | Speaker | None, game: Game) -> Voice:
    """How a tutor draws what to say in this game. Raises `TTRError` for no tutor."""
    if tutor is None:
        tutor = Tutor()
    if isinstance(tutor, Tutor):
        return _Talk(tutor, game).draw
    if not callable(tutor):
        raise TTRError(
            "a tutor is a Tutor, or a function of draw, state and model, "
            f"found {tutor!r}"
        )

    def speak(draw: st.DrawFn, so_far: Dialogue) -> Object:
        state, model, _ = so_far.now
        return tutor(draw, state, model)

    return speak


@dataclass(frozen=True)
class _Talk:
    """A tutor in a game."""

    tutor: Tutor
    game: Game

    def draw(self, draw: st.DrawFn, so_far: Dialogue) -> Object:
        """What the tutor says next."""
        state, model, _ = so_far.now
        way = draw(self.tutor.ways)
        if way == "silent":
            return None
        if way == "repeats" and so_far.trials:
            return so_far.trials[-1].given
        if way == "wanders":
            return self._one(draw, self._moves(state, model), model, None)
        options: Sequence[object] = ()
        if way == "contradicts" and so_far.trials:
            last = so_far.trials[-1]
            answers = self._replies(last.before.state, last.before.model)
            options = [one for one in answers if one != last.given]
        options = options or self._replies(state, model) or self._moves(state, model)
        one = self._one(draw, options, model, state)
        if way != "mumbles":
            return one
        other = self._one(draw, self._moves(state, model), model, None)
        return self._uncertain(one, other, draw(_CERTAINTIES))

    def _uncertain(
        self, one: Object, other: Object, certainties: tuple[float, float]
    ) -> Object:
        """Two things of which either may have been heard; the first, if one is none."""
        events = [event_heard(self.game, one), event_heard(self.game, other)]
        if any(event is None or isinstance(event, NBest) for event in events):
            return one
        return nbest(*zip(events, certainties, strict=True))

    def _one(
        self,
        draw: st.DrawFn,
        options: Sequence[object],
        model: Model,
        about: Record | None,
    ) -> Object:
        if not options:
            return None
        chosen = options[0] if len(options) == 1 else draw(st.sampled_from(options))
        if isinstance(chosen, st.SearchStrategy):
            return draw(chosen)
        if isinstance(chosen, TypeNode):
            return draw(event_of(chosen, model, about))
        return chosen

    def _moves(self, state: Record, model: Model) -> Sequence[object]:
        return acts_in(state, model, self.tutor.moves) or self._heard_types

    def _replies(self, state: Record, model: Model) -> Sequence[object]:
        if self.tutor.replies is not None:
            return acts_in(state, model, self.tutor.replies)
        if self.tutor.moves:
            return self._moves(state, model)
        return [T for T in self._heard_types if self._is_awaited(T, state, model)]

    @cached_property
    def _heard_types(self) -> tuple[TypeNode, ...]:
        return heard_by(self.game)

    def _is_awaited(self, T: TypeNode, state: Record, model: Model) -> bool:
        return any(
            rule.when is self.game.type or is_certain(model.facts, state, rule.when)
            for rule in self._takers[T]
        )

    @cached_property
    def _takers(self) -> dict[TypeNode, tuple[Rule, ...]]:
        """The rules that might take an event of each type."""
        taking = [(rule, rule.on) for rule in self.game.rules if rule.on is not None]
        return {
            T: tuple(rule for rule, on in taking if on <= T or on >= T)
            for T in self._heard_types
        }
