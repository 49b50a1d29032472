"""Prediction: given the beginning of a string, which events may come next?

A course is a string of a type of which only the beginning is known. Each event gives a
new course, in a time that does not grow with the number of events so far.

Sources: Fernando 2007 and Cooper 2023, chapter 2, for types of strings of events as
what agents expect, as in the game of fetch.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.computing.strings.automata import automaton
from ttr.computing.strings.pieces import is_of_strings
from ttr.errors import UnexpectedError, UnsupportedError
from ttr.judging.automaton_filter import AutomatonFilter, start_filter
from ttr.judging.models import Model, as_model
from ttr.judging.string_segmentation import events_in_words
from ttr.probability import REFUTED, Degree
from ttr.safety.budgets import within_budget
from ttr.types.derived_types import star
from ttr.types.objects import Object, freeze
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.syntax import TypeNode, as_type, join

__all__ = ["Course", "start_course", "star"]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)


@within_budget
def start_course(T: TypeNode, model: Model, /) -> Course:
    """The course of a string of T before its first event.

    Raises `UnsupportedError` for a type that is not of strings, or that says something
    of a string as a whole.

    >>> from ttr import Ind, Plus, Pred, Str
    >>> throw, fetch = Pred("throw", Ind)("stick"), Pred("fetch", Ind)("stick")
    >>> M = Model().given("e1", throw).given("e2", fetch)
    >>> game = start_course(Plus(Str(throw, fetch)), M)
    >>> print(game.expected)
    throw(stick)
    >>> game = game.seen("e1")
    >>> print(game.expected, game.may_end)
    fetch(stick) 0
    >>> game.seen("e1")
    Traceback (most recent call last):
    ttr...UnexpectedError: event 2, e1, is of throw(stick), but expected: fetch(stick)
    help: ask expects(event) how probable it is that it fits
    >>> print(game.seen("e2").may_end)
    1
    """
    T = as_type(T)
    as_model(model)
    if not is_of_strings(T) or free_paths(T):
        raise UnsupportedError(
            f"{T} is no type of strings that can be predicted",
            hint="write one with str(…), plus(…) or star(…), without paths outwards",
        )
    found = automaton(T)
    if any(found.wholes.values()):
        raise UnsupportedError(
            f"{T} says something of a string as a whole, which no single event shows",
            hint="judge the string when it is complete",
        )
    return Course(T, model, start_filter(found, bool(model.facts.links)))


@dataclass(frozen=True, eq=False)
class Course:
    """How far a string of a type has come, and what may come next. See `start_course`.

    If events are uncertain, so is the state that the string is in: its probabilities
    are exact where uncertain judgements are independent and given as numbers, else
    bounds.
    """

    type: TypeNode
    model: Model
    _filter: AutomatonFilter = field(repr=False)
    length: int = 0

    @within_budget
    def seen(self, event: object, /) -> Course:
        """The course after one more event.

        Raises `UnexpectedError` where no string of the type goes on with it.
        """
        event = freeze(event)
        after = self._after(event)
        if after.on_course == REFUTED:
            raise self._unexpected_error(event)
        return after

    @within_budget
    def expects(self, event: object, /) -> Degree:
        """The probability that a string of the type goes on with this event."""
        return self._after(freeze(event)).on_course

    def judged_in(self, model: Model, /) -> Course:
        """The same course, with later events judged in another model.

        That may be a model with new facts; earlier events are not judged again.
        """
        as_model(model)
        linked = self._filter.linked or bool(model.facts.links)
        return replace(self, model=model, _filter=replace(self._filter, linked=linked))

    @property
    def on_course(self) -> Degree:
        """The probability that the events so far begin a string of the type."""
        return self._filter.goes_on

    @property
    def may_end(self) -> Degree:
        """The probability that the events so far are a whole string of the type."""
        return self._filter.may_end

    @property
    @within_budget
    def expected(self) -> TypeNode | None:
        """The type of the events that may come next; None where none may.

        >>> from ttr import Basic, Plus, Str
        >>> A, B = Basic("A"), Basic("B")
        >>> print(start_course(Str(A, B) | Plus(B), Model()).expected)
        A \\/ B
        """
        labels = [
            label
            for state in self._filter.beliefs.states()
            for label in self._filter.automaton.labels(state)
        ]
        return join(*labels) if labels else None

    @property
    @within_budget
    def rest(self) -> TypeNode:
        """The type of the strings that may still follow.

        >>> from ttr import Basic, Plus, Str
        >>> A, B = Basic("A"), Basic("B")
        >>> course = start_course(Str(A, Plus(B)), Model().given("a", A))
        >>> print(course.seen("a").rest)
        plus(B)
        """
        automaton = self._filter.automaton
        if automaton.empty:
            return self.type
        return join(*map(automaton.rest_of, self._filter.beliefs.states()))

    def __str__(self) -> str:
        if self._filter.automaton.empty:
            return f"a string of {self.type}, of which there is none"
        what = f"a string of {self.type} after {events_in_words(self.length)}"
        if self.expected is None:
            return f"{what}, complete"
        return f"{what}; expected: {self.expected}"

    def _after(self, event: Object) -> Course:
        """The course after an event, even one that fits nothing."""
        after = self._filter.after(lambda T: self.model.judge(event, T).why)
        return replace(self, _filter=after, length=self.length + 1)

    def _unexpected_error(self, event: Object) -> UnexpectedError:
        kinds = sorted(str(kind) for kind in self.model.facts.types_of(event))
        found = " and ".join(kinds) or "nothing that is known"
        wanted = self.expected
        return UnexpectedError(
            f"event {self.length + 1}, {notation(event)}, is of {found}, but expected: "
            f"{'no more events' if wanted is None else wanted}",
            hint="ask expects(event) how probable it is that it fits",
        )
