"""Planning what the robot says next, what it is about, and what it does thereby."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    mentions,
    packaged_types,
    set_at,
    set_to,
)
from kille.dialogue.reference.perspectives import front_of
from ttr import Model, Rec, Record, RecordType, RecType, record, rectype, replace
from ttr.aliases import former_names
from ttr.types import TypeNode
from ttr.types.objects import Object

__getattr__ = former_names(
    __name__,
    {
        "changed_act": "change_act",
        "numbered": "number_field",
        "standing": "placement",
        "used": "words_in",
    },
)

__all__ = [
    "answering",
    "change_act",
    "content_of",
    "hear_as",
    "instead",
    "issue",
    "nouns_said",
    "number_field",
    "plan",
    "said_of",
    "placement",
    "words_in",
]

DOES = (
    "drops",
    "degrees",
    "explains",
    "recalls",
    "points",
    "undoes",
    "classifies",
    "weighs",
    "cites",
    "measures",
)
"""What else a move of the robot may do, by the labels of the type Said."""

CLAIMED = {
    "noun": ("c", "Naming"),
    "adjective": ("a", "Having"),
    "relation": ("rel", "Relation"),
}
"""Where each kind of word stands in what is said: the label, and the type with it."""


def answering(move: str, *, types: DialogueTypes | None = None) -> RecordType:
    """The states in which this is the latest move and no answer is planned yet.

    >>> print(answering("Greet")["shared"])
    [latest : [addr : Ind, spkr : Ind, e : greet(spkr, addr)]]
    """
    types = types or packaged_types()
    return types.derive(unanswered_states, types.record_type(move))


def unanswered_states(types: DialogueTypes, latest: TypeNode) -> RecordType:
    """The states in which the latest move is of a type and not answered yet."""
    return rectype(
        private=rectype(agenda=types["Agenda"] @ ()), shared=rectype(latest=latest)
    )


def plan(
    s: Record,
    act: str,
    content: TypeNode = Rec,
    rival: TypeNode = Rec,
    *,
    signs: Iterable[Record] = (),
    pending: Iterable[TypeNode] = (),
    teaches: Iterable[TypeNode] = (),
    forgets: Iterable[str] = (),
    asks: Iterable[Record] = (),
    types: DialogueTypes | None = None,
    **does: Iterable[Object],
) -> Record:
    """The state in which the robot is about to say this, and what it does thereby.

    `signs` are the words that it will use or learn; `pending` is what it claims, which
    the tutor may confirm afterwards; `asks` are the issues that it puts under
    discussion. `teaches` and `forgets` are what it learns and unlearns before it says
    so, and `does` what else it does, under the labels that the type Said has for it.

    >>> from kille.dialogue.state import initial
    >>> s = plan(initial(), "Greet")
    >>> print(s.private.agenda[0]["e"])
    greet(.spkr, .addr)
    """
    types = types or packaged_types()
    said = types.record_type("Said")
    done = {"signs": signs, "teaches": teaches, "forgets": forgets, **does}
    some = {label: found for label, it in done.items() if (found := tuple(it))}
    move = set_to(
        types.derive(_speech_type, act),
        content=RecType @ content,
        rival=RecType @ rival,
        **{label: said[label] @ them for label, them in some.items()},
    )
    return replace(
        s,
        {
            "private.agenda": (*s.private.agenda, move),
            "shared.pending": tuple(pending),
            "shared.qud": (*asks, *s.shared.qud),
        },
    )


def _speech_type(types: DialogueTypes, act: str) -> RecordType:
    """The type of saying something, and doing nothing else."""
    said = types.record_type("Said")
    does = ("signs", "teaches", "forgets", *DOES)
    return set_to(
        types.move_type("Said", act), **{label: said[label] @ () for label in does}
    )


def issue(ask: str, options: Iterable[Record]) -> Record:
    """The question which of these moves the tutor meant.

    >>> print(issue("name", [record(x="o1"), record(x="o2")]))
    {ask = name, options = [{x = o1}, {x = o2}]}
    """
    return record(ask=ask, options=tuple(options))


def content_of(s: Record) -> RecordType:
    """What the latest move is about.

    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> turn = game.take(game.begin(), game.hear("This is a cup."))
    >>> print(content_of(turn.state)["c"])
    cup(.target.x, .look)
    """
    content: RecordType = s.shared.latest.content
    return content


def hear_as(
    s: Record,
    model: Model,
    act: str,
    content: TypeNode = Rec,
    signs: Iterable[Record] = (),
    *,
    types: DialogueTypes,
    **more: TypeNode,
) -> tuple[Record, Model]:
    """What the tutor said last, taken for a move of this act, and the model with it.

    >>> s = record(shared=record(latest=record(text="no")))
    >>> types = packaged_types()
    >>> swap, model = hear_as(s, Model(), "Swap", types=types)
    >>> swap.text, model.judge(swap, types["Swap"]).holds
    ('no', True)
    """
    move = set_to(
        types.move_type("Heard", act),
        text=types["Text"] @ s.shared.latest.text,
        signs=types.record_type("Heard")["signs"] @ tuple(signs),
        content=RecType @ content,
        **more,
    )
    return model.create(move)


def nouns_said(said: Record, phrase: RecordType) -> list[Record]:
    """The nouns that a phrase of a move calls its thing, not what that stands beside.

    >>> from kille.dialogue.meanings import noun, relation
    >>> from kille.dialogue.reference import meant_by
    >>> words = [noun("cup"), relation("behind"), noun("book")]
    >>> [it.form for it in nouns_said(record(signs=words), meant_by(words))]
    ['cup']
    """
    return [it for it in said.signs if it.kind == "noun" and claims(phrase, it)]


def said_of(
    s: Record,
    sign: Record,
    x: str,
    template: str = "Naming",
    *,
    types: DialogueTypes | None = None,
) -> RecordType:
    """That a word is true of an individual in the latest look.

    >>> from kille.dialogue.meanings import noun
    >>> from kille.dialogue.state import initial
    >>> print(said_of(initial(), noun("cup"), "o1"))  # doctest: +NORMALIZE_WHITESPACE
    [look = look0 : Look, target : [look = ^.look : Look, x = o1 : Ind],
     c : cup(target.x, look)]
    """
    types = types or packaged_types()
    content = set_at(types.meaning_at(sign, template), "look", s.view.look)
    return set_at(content, "target.x", x)


def instead(
    content: RecordType, sign: Record, *, types: DialogueTypes | None = None
) -> RecordType:
    """A content that claims another word of the same things.

    >>> from kille.dialogue.meanings import meaning_in, noun
    >>> print(instead(meaning_in("cup", "Naming"), noun("mug")))
    [look : Look, target : [look = ^.look : Look, x : Ind], c : mug(target.x, look)]
    """
    types = types or packaged_types()
    label, template = CLAIMED[sign.kind]
    return set_to(content, **{label: types.meaning_at(sign, template)[label]})


def number_field(
    s: Record, x: str, *, types: DialogueTypes | None = None
) -> dict[str, TypeNode]:
    """The field of a content that says which number a thing in view has.

    >>> from kille.dialogue.state import initial
    >>> s = replace(initial(), {"view.things": ["o1", "o2"]})
    >>> print(number_field(s, "o2")["number"])
    Text@"2"
    """
    types = types or packaged_types()
    return {"number": types["Text"] @ str(1 + s.view.things.index(x))}


def change_act(
    planned: RecordType, act: str, *, types: DialogueTypes | None = None
) -> RecordType:
    """A planned move that is made in other words: the same, by another act.

    >>> from kille.dialogue.meanings import meaning_in
    >>> from kille.dialogue.state import initial
    >>> s = plan(initial(), "AssertName", meaning_in("cup", "Naming"))
    >>> print(change_act(s.private.agenda[0], "HedgeName")["e"])
    hedge_name(.spkr, .addr)
    """
    types = types or packaged_types()
    return set_to(planned, e=types.record_type(act)["e"])


def placement(
    s: Record,
    x: str,
    target: Record,
    y: str,
    landmark: Record,
    *relation: Record,
    types: DialogueTypes | None = None,
) -> RecordType:
    """That x, a target, and y, a landmark, stand so, by these signs in the latest look.

    Without a relation it says only that both are there.

    >>> from kille.dialogue.meanings import noun, relation
    >>> from kille.dialogue.state import initial
    >>> cup, book = noun("cup"), noun("book")
    >>> print(placement(initial(), "o1", cup, "o2", book, relation("behind"))["rel"])
    behind(.target.x, .landmark.x, .look, .frame)
    """
    types = types or packaged_types()
    content = types.record_type("Relating")
    for sign in relation:
        content = set_at(sign.meaning, "frame", front_of(s, y))
    content = set_at(content, "look", s.view.look)
    return set_to(
        content,
        target=_individual(content, "target", target, x),
        landmark=_individual(content, "landmark", landmark, y),
    )


def _individual(content: RecordType, part: str, sign: Record, x: str) -> RecordType:
    """The type of x as what a sign means, in the look of the record around it."""
    own = content[part]
    assert isinstance(own, RecordType)
    return set_at(set_to(sign.meaning, **dict(own.fields)), "x", x)


def words_in(known: Iterable[Record], *contents: RecordType) -> Sequence[Record]:
    """The words that are known and occur in one of the contents.

    >>> from kille.dialogue.meanings import meaning_in, noun
    >>> found = words_in([noun("cup"), noun("mug")], meaning_in("cup", "Naming"))
    >>> [it.form for it in found]
    ['cup']
    """
    return [sign for sign in known if any(mentions(one, sign) for one in contents)]
