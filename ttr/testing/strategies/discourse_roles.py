"""Roles: the paths of a state at which questions, commitments and so on are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from ttr.errors import TTRError, suggestion
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.types.objects import Object, Record
from ttr.types.syntax import (
    Basic,
    ListOf,
    NonEmpty,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
    Universe,
)

Test: TypeAlias = Callable[[Object, Object], bool]

Acts: TypeAlias = Sequence[object] | Callable[[Record, Model], Sequence[object]]
"""What a tutor may do: a list, or a function that gives one for a state and a model."""

_USUAL_NAMES = {
    "qud": (
        *("qud", "issues", "questions", "open_questions", "open_issues"),
        *("under_discussion", "questions_under_discussion", "raised"),
    ),
    "commitments": (
        *("commitments", "com", "facts", "shared_commitments", "agreed", "accepted"),
        *("common_ground", "commonground", "cg", "grounded", "shared_facts"),
    ),
    "agenda": ("agenda", "todo", "to_do", "next", "next_moves", "plan", "planned"),
    "pending": (
        *("pending", "ungrounded", "unconfirmed", "unacknowledged", "to_confirm"),
        *("to_ground", "awaiting", "proposed"),
    ),
    "latest": (
        *("latest", "latest_move", "lm", "last_move"),
        *("latest_utterance", "last_utterance"),
    ),
    "speaker": (
        *("turn", "floor", "has_turn", "has_floor", "next_speaker"),
        *("speaker", "spkr"),
    ),
    "addressee": ("addressee", "addr", "hearer"),
}
"""The labels of the fields for each role in gameboards of the literature."""


@dataclass(frozen=True)
class Roles:
    """Which path of the state plays which role; a role without a path is not checked.

    `qud` is the list of questions under discussion and `commitments` what the partners
    are committed to: a list, a set or a record type. `latest` is the latest move: what
    the system says is one, and so are texts, and events of the type `spoken`. `history`
    is the list of all moves so far, the latest at either end. `agenda` is the list of
    the types of moves to be made, `pending` what was said and is not yet accepted,
    `speaker` who has the turn, or spoke last, and `addressee` to whom.

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
    agenda: str | None = None
    pending: str | None = None
    speaker: str | None = None
    addressee: str | None = None
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
        """The roles played by the fields with the labels of the literature.

        The type of the field has to fit as well: questions under discussion are a list
        or a set, a speaker is of a basic type.

        >>> from ttr import Ind, rectype
        >>> roles = Roles.of(rectype(shared=rectype(qud=ListOf(Ind), com=SetOf(Ind))))
        >>> roles.qud, roles.commitments, roles.latest
        ('shared.qud', 'shared.com', None)
        """
        fields = list(_field_paths(type, ""))
        found = {role: _path_for_role(role, fields) for role in _USUAL_NAMES}
        return cls(**found)  # type: ignore[arg-type]

    def with_declared(self, type: RecordType, named: Mapping[str, str]) -> Roles:
        """The same roles, except that the ones named are played at these paths.

        No field plays a role whose path is empty; `drops` and `retracts` are names of
        rules, with commas between them. Raises `TTRError` for what is no role or path.

        >>> from ttr import Ind, rectype
        >>> Board = rectype(shared=rectype(wishes=ListOf(Ind)))
        >>> Roles().with_declared(Board, {"qud": "shared.wishes", "drops": "a,b"}).qud
        'shared.wishes'
        >>> Roles().with_declared(Board, {"qud": "shared.wish"})
        Traceback (most recent call last):
        ttr.errors.TTRError: the role qud is played by shared.wish, but a state has ...
        help: did you mean shared.wishes?
        """
        known = dict(_field_paths(type, ""))
        changes: dict[str, object] = {}
        for role, path in named.items():
            if role in RULES:
                changes[role] = frozenset(filter(None, path.split(",")))
            elif role not in PATHS:
                roles = ", ".join((*PATHS, *RULES))
                raise TTRError(f"a role is one of {roles}, found {role!r}")
            elif path and path not in known:
                raise TTRError(
                    f"the role {role} is played by {path}, but a state has no {path}",
                    hint=suggestion(path, known),
                )
            else:
                changes[role] = path or None
        return replace(self, **changes)  # type: ignore[arg-type]

    @property
    def paths(self) -> dict[str, str]:
        """The path of each role that a field of the state plays."""
        named = ((role, getattr(self, role)) for role in PATHS)
        return {role: path for role, path in named if path is not None}


PATHS = (
    *("qud", "commitments", "agenda", "pending", "latest", "history"),
    *("speaker", "addressee"),
)
"""The roles that are played by a field of the state, by its path."""

RULES = ("drops", "retracts")
"""The roles that are played by rules."""


def acts_in(state: Record, model: Model, acts: Acts) -> Sequence[object]:
    """What a tutor may do in a state."""
    return acts(state, model) if callable(acts) else acts


def _path_for_role(role: str, fields: Sequence[tuple[str, TypeNode]]) -> str | None:
    """The path of the field that plays a role; the usual labels come first."""
    for name in _USUAL_NAMES[role]:
        for path, T in fields:
            if path.rpartition(".")[2].lower() == name and _can_play(role, name, T):
                return path
    return None


def _can_play(role: str, name: str, field: TypeNode) -> bool:
    """Can a field with this label and type play a role?"""
    T = field.base if isinstance(field, Singleton) else field
    match role:
        case "qud" | "pending":
            return isinstance(T, ListOf | NonEmpty | SetOf)
        case "agenda":
            return isinstance(T, ListOf | NonEmpty) and isinstance(T.item, Universe)
        case "speaker" | "addressee":
            return isinstance(T, Basic)
        case "commitments" if name not in _USUAL_NAMES["commitments"][:3]:
            return isinstance(T, ListOf | NonEmpty | SetOf | Universe)
    return True


def _field_paths(T: RecordType, above: str) -> Iterator[tuple[str, TypeNode]]:
    for label, field in T.fields:
        path = f"{above}.{label}" if above else label
        yield path, field
        if isinstance(field, RecordType):
            yield from _field_paths(field, path)
