"""Following a string event by event: what may come next, and how sure it is so far.

A course is what a type of strings says of a string of which only the beginning is
there. Each event gives a new course, at a cost that does not grow with what was seen.

Source: Fernando 2007 and Cooper 2023, chapter 2, for types of strings of events as
what agents expect, as in the game of fetch.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from ttr.computing.strings.automata import automaton
from ttr.computing.strings.pieces import is_of_strings
from ttr.errors import Unexpected, Unsupported
from ttr.judging.automaton_filter import Following, followed_from
from ttr.judging.models import Model, as_model
from ttr.judging.segmentation import events_in_words
from ttr.probability import REFUTED, Degree
from ttr.safety.budgets import within_budget
from ttr.types.forms import star
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import Object, TypeNode, as_type, freeze, join

__all__ = ["Course", "begun", "star"]


@within_budget
def begun(T: TypeNode, model: Model, /) -> Course:
    """The course of a string of T of which nothing has happened yet.

    Raises `Unsupported` for a type that is not of strings, or that says of a string as
    a whole what its events do not tell.

    >>> from ttr.types.syntax import Ind, Plus, Pred, Str
    >>> throw, fetch = Pred("throw", Ind)("stick"), Pred("fetch", Ind)("stick")
    >>> M = Model().given("e1", throw).given("e2", fetch)
    >>> game = begun(Plus(Str(throw, fetch)), M)
    >>> print(game.expected)
    throw(stick)
    >>> game = game.seen("e1")
    >>> print(game.expected, game.may_end)
    fetch(stick) 0
    >>> game.seen("e1")
    Traceback (most recent call last):
    ttr.errors.Unexpected: event 2, e1, is of throw(stick), but expected: fetch(stick)
    help: ask expects(event) how probable it is that it fits
    >>> print(game.seen("e2").may_end)
    1
    """
    T = as_type(T)
    as_model(model)
    if not is_of_strings(T) or escaping(T):
        raise Unsupported(
            f"{T} is no type of strings that can be followed",
            hint="write one with str(…), plus(…) or star(…), without paths outwards",
        )
    found = automaton(T)
    if any(found.wholes.values()):
        raise Unsupported(
            f"{T} says of a string as a whole what its events do not tell",
            hint="judge the string when it is complete",
        )
    return Course(T, model, followed_from(found, bool(model.facts.links)))


@dataclass(frozen=True, eq=False)
class Course:
    """How far a string of a type has come, and what may come next. Made by `begun`.

    Events may be uncertain: then the states that the string may be in have degrees,
    exact where all that is uncertain is independent and given in numbers, else bounds.
    """

    type: TypeNode
    model: Model
    _following: Following = field(repr=False)
    length: int = 0

    @within_budget
    def seen(self, event: object, /) -> Course:
        """The course after one more event.

        Raises `Unexpected` where no string of the type goes on so.
        """
        event = freeze(event)
        after = self._after(event)
        if after.on_course == REFUTED:
            raise self._unexpected(event)
        return after

    @within_budget
    def expects(self, event: object, /) -> Degree:
        """How probable it is that some string of the type goes on so."""
        return self._after(freeze(event)).on_course

    def judged_in(self, model: Model, /) -> Course:
        """The same course, where from now on events are judged in another model.

        A model that has new facts is such a one: what came before is not asked again.
        """
        as_model(model)
        linked = self._following.linked or bool(model.facts.links)
        following = replace(self._following, linked=linked)
        return replace(self, model=model, _following=following)

    @property
    def on_course(self) -> Degree:
        """How probable it is that what was seen begins a string of the type."""
        return self._following.goes_on

    @property
    def may_end(self) -> Degree:
        """How probable it is that what was seen is a string of the type."""
        return self._following.may_end

    @property
    @within_budget
    def expected(self) -> TypeNode | None:
        """The type of the events that may come next; None if none may.

        >>> from ttr.types.syntax import Basic, Plus, Str
        >>> A, B = Basic("A"), Basic("B")
        >>> print(begun(Str(A, B) | Plus(B), Model()).expected)
        A \\/ B
        """
        labels = [
            label
            for state in self._following.beliefs.states()
            for label in self._following.automaton.labels(state)
        ]
        return join(*labels) if labels else None

    @property
    @within_budget
    def rest(self) -> TypeNode:
        """The type of the strings that may follow: what is left of the type to come.

        >>> from ttr.types.syntax import Basic, Plus, Str
        >>> A, B = Basic("A"), Basic("B")
        >>> course = begun(Str(A, Plus(B)), Model().given("a", A))
        >>> print(course.seen("a").rest)
        plus(B)
        """
        following = self._following
        if following.automaton.empty:
            return self.type
        return join(*map(following.automaton.rest_of, following.beliefs.states()))

    def __str__(self) -> str:
        if self._following.automaton.empty:
            return f"a string of {self.type}, of which there is none"
        what = f"a string of {self.type} after {events_in_words(self.length)}"
        if self.expected is None:
            return f"{what}, complete"
        return f"{what}; expected: {self.expected}"

    def _after(self, event: Object) -> Course:
        """The course after an event, which may be off course."""
        after = self._following.after(lambda T: self.model.judge(event, T).why)
        return replace(self, _following=after, length=self.length + 1)

    def _unexpected(self, event: Object) -> Unexpected:
        kinds = sorted(str(kind) for kind in self.model.facts.types_of(event))
        found = " and ".join(kinds) or "nothing that is known"
        wanted = self.expected
        return Unexpected(
            f"event {self.length + 1}, {notation(event)}, is of {found}, but expected: "
            f"{'no more events' if wanted is None else wanted}",
            hint="ask expects(event) how probable it is that it fits",
        )
