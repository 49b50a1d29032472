"""What the talk is about, as witness functions of the state.

Some words are true of a thing by itself: `shown` of what is in focus. Others choose
among the things that the rest of the phrase is true of: "the other cup" is a cup, but
not the one that was talked about last, and "the second cup" is counted among the cups.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from kille.dialogue.meanings import DialogueTypes, packaged_types, value_at
from kille.dialogue.reference.comparing import COMPARATIVES, unexceeded_things
from ttr import Model, Pred, Record, RecordType
from ttr.types import Meet, PType

Choice = Callable[[Record, Model, Sequence[str], DialogueTypes], Sequence[str]]
"""Chooses, in a state, among the things that the rest of a phrase fits."""


def in_talk(s: Record, model: Model, *, types: DialogueTypes) -> Model:
    """The model in which the talk says what is shown and what was mentioned."""
    latest = s.shared.salient[:1] or s.view.focus
    shown = shown_things(s)

    def is_distal(x: str, look: str) -> bool:
        return x in distal_things(s, model, shown, types)

    return (
        model.witnessed(types["shown"], by=lambda x, look: x in shown)
        .witnessed(types["distal"], by=is_distal)
        .witnessed(types["mentioned"], by=lambda x, look: x in latest)
    )


def shown_things(s: Record) -> Sequence[str]:
    """What "this" may be: what is pointed at, or was just talked about.

    Where neither singles out one thing, it may be any of those in view.
    """
    for one in (s.view.pointed, s.shared.topic):
        if len(one) == 1 and one[0] in s.view.things:
            return tuple(one)
    return tuple(s.view.things)


def distal_things(
    s: Record, model: Model, shown: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    """What "that" may be: after a lesson about "this" another thing, if there is one.

    What is said to be so of "that" may be said of "this" as well: then it is open.
    """
    this = [x for x in s.shared.shown if x in shown and not s.view.pointed]
    this = [x for x in this if x in _latest_taught(s)]
    others = tuple(x for x in s.view.things if x not in this)
    if not this or not others:
        return shown
    if any(model.judge(s.shared.latest, types[act]).holds for act in CONTRASTING):
        return others
    describes = model.judge(s.shared.latest, types["Describe"]).holds
    return tuple(s.view.things) if describes else shown


def _latest_taught(s: Record) -> Sequence[str]:
    """The thing of the latest lesson."""
    targets = (it.content.get("target") for it in s.private.lessons[-1:])
    return [str(value_at(it, "x")) for it in targets if isinstance(it, RecordType)]


CONTRASTING = ("Instruct", "AskName")
"""The moves in which "that" is told from the "this" of a lesson."""


def most_salient(s: Record, things: Iterable[str]) -> str | None:
    """The one of the things that was talked about last, if any was."""
    among = set(things)
    return next((str(x) for x in s.shared.salient if x in among), None)


def just_mentioned(s: Record, things: Collection[str]) -> str | None:
    """The one of the things that was just talked about, if one and no other was."""
    mentioned = [str(x) for x in s.shared.topic if x in things]
    return mentioned[0] if len(mentioned) == 1 else None


def across(
    s: Record,
    model: Model,
    things: Iterable[str],
    *,
    types: DialogueTypes | None = None,
) -> list[str]:
    """The things from left to right as they are seen.

    The witness function of `across` says how far to the right a thing is; without one
    the order is that of the view.
    """
    place = (types or packaged_types())["across"]
    order = {str(x): i for i, x in enumerate(s.view.things)}

    def rightness(x: str) -> tuple[float, int]:
        degree = model.facts.perceive(x, place(x, s.view.look))
        return (degree.lo if degree else 0.0), order.get(x, len(order))

    return sorted(things, key=rightness)


def _other(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    latest = most_salient(s, things) or next(iter(s.view.focus), None)
    return [x for x in things if x != latest]


def _nth(n: int) -> Choice:
    def choose_nth(
        s: Record, model: Model, things: Sequence[str], types: DialogueTypes
    ) -> Sequence[str]:
        return across(s, model, things, types=types)[n:][:1]

    return choose_nth


def _any(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    return things


def _most(comparative: str) -> Choice:
    def choose_most(
        s: Record, model: Model, things: Sequence[str], types: DialogueTypes
    ) -> Sequence[str]:
        return unexceeded_things(s, model, types[comparative], things)

    return choose_most


CHOICES: Mapping[str, Choice] = {
    "other": _other,
    "any_other": _any,
    "leftmost": _nth(0),
    "first": _nth(0),
    "second": _nth(1),
    "third": _nth(2),
    "last": _nth(-1),
    "rightmost": _nth(-1),
    **{name: _most(comparative) for name, comparative in COMPARATIVES.items()},
}
"""The words that choose, by the names of their predicates."""


def choosing_predicates(types: DialogueTypes) -> frozenset[Pred]:
    """The predicates that choose among the things that fit the rest of a phrase."""
    return frozenset(types[name] for name in CHOICES)


def compares(phrase: RecordType) -> bool:
    """Whether a phrase chooses its thing by a measure: "the biggest one"."""
    field = phrase.get("d")
    parts = field.parts if isinstance(field, Meet) else (field,)
    return any(isinstance(it, PType) and it.pred.name in COMPARATIVES for it in parts)


def choose(
    s: Record, model: Model, pred: Pred, things: Sequence[str], *, types: DialogueTypes
) -> Sequence[str]:
    """Those of the things that the predicate chooses."""
    return CHOICES[pred.name](s, model, things, types)
