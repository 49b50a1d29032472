"""What "this" and "that" may be, as witness functions of the state.

"This" is proximal and "that" distal, to the speaker and to the focus of the talk. What
is pointed at or was just talked about may be either; of two things that are pointed at,
"this" is the first and "that" the second. Where nothing is, both may be
anything in view: then a question about "this" is about the focus, and one about "that"
about what is farther away. After a lesson about "this", "that" is another thing.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

from kille.dialogue.meanings import DialogueTypes, value_at
from kille.dialogue.reference.salience import nearness
from ttr import Model, Record, RecordType

CONTRASTING = ("Instruct", "AskName")
"""The moves in which "that" is told from the "this" of a lesson."""

_LESSON = 2.0
"""How many moves before "that" the tutor asked what "this" is, and then said it."""

THIS, THAT = "this", "that"
"""The roles of what the tutor has asked about by such a word alone."""


def in_talk(s: Record, model: Model, *, types: DialogueTypes) -> Model:
    """The model in which the talk says what "this" and "that" may be."""
    may_be = _Demonstratives(s, model, types)
    return model.witnessed(
        types["shown"], by=lambda x, look: x in may_be.this
    ).witnessed(types["distal"], by=lambda x, look: x in may_be.that)


@dataclass(frozen=True)
class _Demonstratives:
    """What the demonstratives may be in a state, found out when it is asked for."""

    s: Record
    model: Model
    types: DialogueTypes

    @cached_property
    def this(self) -> Sequence[str]:
        return self._others_asked_about(THAT) or shown_things(self.s)

    @cached_property
    def that(self) -> Sequence[str]:
        """After a lesson about "this" another thing, if there is one.

        So it is when the tutor asks what "this" is, and then what "that" is. What is
        said to be so of "that" may be said of "this" as well: then it is open.
        """
        if asked := self._others_asked_about(THIS):
            return asked
        s, shown = self.s, shown_things(self.s)
        if second := [x for x in s.view.pointed[1:] if x in s.view.things]:
            return second
        this = [] if s.view.pointed else [*s.shared.shown, *self._asked_before()]
        this = [x for x in this if x in shown]
        this = [x for x in this if x in _latest_taught(s)]
        others = tuple(x for x in s.view.things if x not in this)
        if not this or not others:
            return shown
        if any(map(self._is_latest, CONTRASTING)):
            return others
        return tuple(s.view.things) if self._is_latest("Describe") else shown

    def _asked_before(self) -> Sequence[str]:
        """What the tutor asked about as "this" before they said what it is."""
        s, before = self.s, self.s.private.cost.turns - _LESSON
        return [
            it.x for it in s.shared.noticed if it.role == THIS and it.move >= before
        ]

    def _others_asked_about(self, word: str) -> Sequence[str]:
        """What the tutor asks about now, who has just asked about a thing by this word.

        These are the other things in view. None, unless that is what has happened.
        """
        s, before = self.s, self.s.private.cost.turns - 1.0
        asked = [
            it.x for it in s.shared.noticed if it.move == before and it.role == word
        ]
        if not asked or s.view.pointed or asked[0] not in shown_things(s):
            return ()
        if not self._is_latest("AskName"):
            return ()
        return tuple(x for x in s.view.things if x not in asked)

    def _is_latest(self, move: str) -> bool:
        """Whether the latest move is of this type."""
        return self.types.has(self.s.shared.latest, move, self.model)


def shown_things(s: Record) -> Sequence[str]:
    """What "this" may be: what is pointed at, or was just talked about.

    Where neither singles out one thing, it may be any of those in view.
    """
    for one in (s.view.pointed[:1], s.shared.topic):
        if len(one) == 1 and one[0] in s.view.things:
            return tuple(one)
    return tuple(s.view.things)


def _latest_taught(s: Record) -> Sequence[str]:
    """The thing of the latest lesson."""
    targets = (it.content.get("target") for it in s.private.lessons[-1:])
    return [str(value_at(it, "x")) for it in targets if isinstance(it, RecordType)]


def proximal(s: Record, things: Collection[str]) -> list[str]:
    """Those of the things that are rather "this" than "that": what is in focus."""
    return [x for x in things if x in s.view.focus]


def distal(s: Record, things: Collection[str]) -> list[str]:
    """Those of the things that are rather "that" than "this".

    They are not in focus, and none is clearly farther away.
    """
    others = [x for x in things if x not in s.view.focus]
    margin = s.private.strategy.salience.margin
    farthest = min((nearness(s, x) for x in others), default=0.0)
    return [x for x in others if nearness(s, x) <= farthest + margin]
