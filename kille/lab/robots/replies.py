"""Replies: what a robot said and did in a turn, and what it thinks after it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from kille.dialogue.beliefs import degree
from kille.dialogue.meanings import CLAIMS, claims, predicate_at, value_at, word_of
from kille.dialogue.reference.perspectives import front_of
from ttr import Model, Record, RecordType
from ttr.aliases import Alias
from ttr.judging import Judgement
from ttr.types import Negation

WAYS = {
    "assert": "assert",
    "hedge": "hedge",
    "guess": "think",
    "doubt": "doubt",
    "admit": "admit",
    "yes": "yes",
    "no": "no",
    "rather": "rather",
    "probably": "probably",
    "point": "point",
}
"""How an answer is put, by how the name of the move begins, or goes on after `say`."""

ASKING = frozenset(
    {
        "ask_again",
        "ask_example",
        "ask_frame",
        "ask_front",
        "ask_heard",
        "ask_heard_one",
        "ask_referent",
        "ask_relation",
        "ask_thing",
        "ask_which",
        "ask_which_place",
        "ask_which_quality",
        "offer_referents",
        "offer_word",
        "pardon",
    }
)
"""The moves by which it asks something of its own accord."""

WANTING = ASKING | {"admit_name", "admit_place", "admit_quality"}
"""The moves after which a tutor may tell it something."""


@dataclass(frozen=True, eq=False)
class Reply:
    """What a robot replies in a turn: its sentences, its moves, and what it thinks.

    `rules` are those that ran. `number` says which thing of the world a name of its own
    is for, if it is for any.

    >>> from kille.dialogue.tutoring import tutoring
    >>> game = tutoring()
    >>> turn = game.take(game.begin(), game.hear("Hello."))
    >>> reply = Reply(game.say(turn.said[0]), turn.said, turn.state, turn.model)
    >>> reply.text, reply.acts
    ('Hello.', ('greet_back',))
    """

    text: str
    moves: tuple[Judgement, ...]
    state: Record
    model: Model
    rules: tuple[str, ...] = ()
    number: Callable[[str], int | None] = lambda x: None

    @cached_property
    def acts(self) -> tuple[str, ...]:
        """The names of its moves."""
        return tuple(_act(it) for it in self.moves)

    @property
    def asks(self) -> bool:
        """Whether the robot asks something of its own accord."""
        return not ASKING.isdisjoint(self.acts)

    @property
    def wants(self) -> str:
        """The last move after which the robot wants to be told something, or ""."""
        return next((it for it in reversed(self.acts) if it in WANTING), "")

    @property
    def is_lost(self) -> bool:
        """Whether the robot says that it has not understood, which is not a move."""
        return bool(self.text) and not self.moves

    @property
    def is_open(self) -> bool:
        """Whether the robot asks back, so that it has not answered yet."""
        return bool(self.state.shared.qud)

    @property
    def way(self) -> str:
        """How the robot has answered: `assert`, `think`, `admit` …, or `none`."""
        ways = (_way(act) for act in self.acts)
        return next((way for way in ways if way), "none")

    @property
    def pointed_thing(self) -> int | None:
        """The thing of the world that the robot points at, if any."""
        points = (x for move in self.moves for x in move.sit.points)
        return next((self.number(x) for x in points), None)

    @property
    def things(self) -> tuple[int | None, ...]:
        """The target and the landmark of the robot's last move."""
        content = self.moves[-1].sit.content if self.moves else None
        if not isinstance(content, RecordType):
            return ()
        return tuple(self.number(x) for x in _things(content))

    @property
    def reasons(self) -> tuple[Record, ...]:
        """The cues, with their shares, by which the robot has explained a claim."""
        found = (it.sit.reasons for it in self.moves if it.sit.reasons)
        return tuple(cue for reasons in found for it in reasons for cue in it.cues)

    @property
    def word(self) -> str:
        """The first word in the robot's last move."""
        signs = self.moves[-1].sit.signs if self.moves else ()
        return next((str(it.form) for it in signs), "")

    @property
    def focus(self) -> int | None:
        """The thing that the robot attends to."""
        return next((self.number(x) for x in self.state.view.focus), None)

    @property
    def fronts(self) -> Mapping[int | None, str]:
        """Which way things face, as far as the robot knows."""
        return {self.number(it.x): str(it.front) for it in self.state.shared.turned}

    def then(self, other: Reply) -> Reply:
        """This reply and another one that follows in the same turn, as one."""
        text = "\n".join(it for it in (self.text, other.text) if it)
        moves, rules = (*self.moves, *other.moves), (*self.rules, *other.rules)
        return replace(other, text=text, moves=moves, rules=rules)

    def claimed_word(self, kind: str) -> str:
        """The first word of a kind that the robot claims to be true."""
        for move in self.moves:
            content = move.sit.content
            if isinstance(content, RecordType) and _is_affirmation(content):
                for sign in move.sit.signs:
                    if sign.kind == kind and claims(content, sign):
                        return str(sign.form)
        return ""

    pointed = Alias("pointed_thing")
    said = Alias("claimed_word")


def _way(act: str) -> str:
    first, _, rest = act.partition("_")
    return WAYS.get(rest if first == "say" else first, "")


def _act(move: Judgement) -> str:
    assert isinstance(move.type, RecordType)
    return predicate_at(move.type, "e").name


def _is_affirmation(content: RecordType) -> bool:
    """Whether a content is a claim without a negation."""
    found = [content[label] for label in CLAIMS if label in content]
    return bool(found) and not any(isinstance(it, Negation) for it in found)


def _things(content: RecordType) -> Iterator[str]:
    for label in ("target", "landmark"):
        part = content.get(label)
        if isinstance(part, RecordType) and "x" in part:
            try:
                yield str(value_at(part, "x"))
            except TypeError:
                return


def degrees(
    s: Record, model: Model, kind: str, x: str, y: str = ""
) -> Mapping[str, float]:
    """The probability of each known word of a kind for x, or for x beside y.

    Adjectives are those for colours, of which a thing has one.
    """
    look = s.view.look
    signs = s.private.colours if kind == "adjective" else s.private[f"{kind}s"]
    args = (x, y, look, front_of(s, y)) if kind == "relation" else (x, look)
    return {str(it.form): degree(model, word_of(it)(*args)) for it in signs}
