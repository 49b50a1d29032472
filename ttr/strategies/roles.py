"""Where in a state the things are that properties of dialogue speak of."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ttr.judgements import Judgement
from ttr.models import Model
from ttr.syntax import ListOf, Object, Record, RecordType, SetOf, TypeNode

__all__ = ["Acts", "Roles", "acts_in", "at"]

Test: TypeAlias = Callable[[Object, Object], bool]

Acts: TypeAlias = Sequence[object] | Callable[[Record, Model], Sequence[object]]
"""What a tutor may do, in any state or in one."""

_LISTS = {"qud"}
_NAMES = {
    "qud": ("qud",),
    "commitments": ("commitments", "com", "facts"),
    "latest": ("latest", "latest_move"),
}
"""What the fields are called in the gameboards of the literature."""


@dataclass(frozen=True)
class Roles:
    """Which path of the state plays which role; a role without a path is not checked.

    `qud` is the list of questions under discussion and `commitments` what the partners
    are committed to: a list, a set or a record type. `latest` is the latest move: what
    the system says is one, and so are texts, and events of the type `spoken`. `history`
    is the list of all moves so far, the latest at either end.

    `answers(event, question)` tells whether an event answers a question, and
    `resolves(commitment, question)` whether a commitment settles it. `fits(e, move)`
    tells whether a move of the system's answers an event, both as judgements; there is
    no event where nothing happened. `words(event)` is how the tutor words an event,
    None where there are no words. The rules in `drops` may take a question away that
    nothing resolves, the rules in `retracts` may take a commitment back. States of the
    type `over` need not lead on; elsewhere one of the `acts` has to, which are the
    moves of the tutor that is played with, or an event of a type that the game hears.
    `moves` is how many moves the system makes in a turn, at most.
    """

    qud: str | None = None
    commitments: str | None = None
    latest: str | None = None
    spoken: TypeNode | None = None
    history: str | None = None
    answers: Test | None = None
    resolves: Test | None = None
    fits: Callable[[Judgement | None, Judgement], bool] | None = None
    words: Callable[[Object], str | None] | None = None
    drops: frozenset[str] = frozenset()
    retracts: frozenset[str] = frozenset()
    over: RecordType | None = None
    acts: Acts = ()
    moves: int | None = None

    @classmethod
    def of(cls, type: RecordType) -> Roles:
        """The roles of the fields that are called as in the literature.

        >>> from ttr.constructors import rectype
        >>> from ttr.syntax import Ind
        >>> roles = Roles.of(rectype(shared=rectype(qud=ListOf(Ind), com=SetOf(Ind))))
        >>> roles.qud, roles.commitments, roles.latest
        ('shared.qud', 'shared.com', None)
        """
        found: dict[str, str] = {}
        for path, field in _fields(type, ""):
            label = path.rpartition(".")[2]
            for role, names in _NAMES.items():
                if label in names and _can_be(role, field):
                    found.setdefault(role, path)
        return cls(**found)  # type: ignore[arg-type]


def acts_in(state: Record, model: Model, acts: Acts) -> Sequence[object]:
    """What a tutor may do in a state."""
    return acts(state, model) if callable(acts) else acts


def _can_be(role: str, field: TypeNode) -> bool:
    return role not in _LISTS or isinstance(field, ListOf | SetOf)


def _fields(T: RecordType, above: str) -> Iterator[tuple[str, TypeNode]]:
    for label, field in T.fields:
        path = f"{above}.{label}" if above else label
        yield path, field
        if isinstance(field, RecordType):
            yield from _fields(field, path)


def at(state: Record, path: str) -> Object:
    """What is at the path; None where the state has no such path."""
    value: Object = state
    for label in path.split("."):
        if not isinstance(value, Record) or label not in value:
            return None
        value = value[label]
    return value
