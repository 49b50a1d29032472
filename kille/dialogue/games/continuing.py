"""And this one? The tutor asks of another thing what was asked last.

Which question that is, the robot's last answer shows. The tutor's move becomes that
question, about the thing that they name now, and the games answer it. So it is where
they only name a thing: "The other one." And where the robot has just learned something
of a thing, that may be meant of the other one, too: "This one, too." It asks.

Source: Ginzburg 2012 (fragments are resolved on the question under discussion).
"""

from __future__ import annotations

from kille.dialogue.answered_questions import (
    ANSWERING_ACTS,
    NAMING_ACTS,
    last_act,
    last_question,
)
from kille.dialogue.commitments import affirmation, kind_of
from kille.dialogue.meanings import DialogueTypes, predicate_at, value_at
from kille.dialogue.moves import content_of, hear_as, words_in
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from kille.dialogue.word_lists import PARTIAL
from ttr import Model, Record, RecordType, rectype, replace
from ttr.types import TypeNode
from ttr.updates import first

Update = tuple[Record, Model]

CLAIM = ("look", "frame", "scale", "landmark", "c", "a", "rel")
"""What a claim says of its target, by labels."""


@rule(answers="AskAlso")
def ask_same(s: Record, *, model: Model, types: DialogueTypes) -> Update:
    """The tutor asks the same of another thing: it is heard as that question."""
    return _as_question(s, model, types=types)


@rule(answers="Mention")
def ask_same_of_named(
    s: Record, *, model: Model, types: DialogueTypes
) -> Update | None:
    """After an answer the tutor names another thing: the same is asked of that one."""
    act = last_act(s)
    if act not in NAMING_ACTS and last_question(s) == "AskName":
        return None
    return _as_question(s, model, types=types)


@rule(answers="Mention")
def teach_same(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """After a lesson the tutor names another thing: it asks if it is the same."""
    if last_act(s) not in _LEARNING:
        return None
    learned = value_at(s.private.last[-1], "content")
    label = kind_of(learned) if isinstance(learned, RecordType) else None
    if label is None:
        return None
    claim = _claim_of(s, content_of(s), types=types)
    act = _LEARNING[last_act(s)]
    return _take_as(s, model, act, claim, types=types, doubt=types["Text"] @ PARTIAL)


@rule(answers="CorrectThing")
def ask_same_of_meant(
    s: Record, *, model: Model, types: DialogueTypes
) -> Update | None:
    """It took another thing for the one the tutor asked about: it is asked of that."""
    acts = {*NAMING_ACTS}.union(*ANSWERING_ACTS.values())
    if last_act(s) not in acts or kind_of(content_of(s)) is not None:
        return None
    return _as_question(s, model, types=types)


_LEARNING = {"learned": "Instruct", "learned_quality": "Describe"}
"""What the robot says of a lesson that may be given again, and that lesson."""


def _as_question(s: Record, model: Model, *, types: DialogueTypes) -> Update:
    """The tutor's move as the question that the robot answered last."""
    asked, content = last_question(s), content_of(s)
    if asked == "AskWhether":
        content = _claim_of(s, content, types=types)
        asked = asked if kind_of(content) else "AskName"
    return _take_as(s, model, asked, content, types=types)


def _take_as(
    s: Record,
    model: Model,
    act: str,
    content: RecordType,
    *,
    types: DialogueTypes,
    **more: TypeNode,
) -> Update:
    """The state in which what the tutor said is this act, with this content."""
    said = s.shared.latest
    signs = tuple(dict.fromkeys((*said.signs, *words_in(_words_at_hand(s), content))))
    move, model = hear_as(s, model, act, content, signs, types=types, **more)
    return replace(s, {"shared.latest": move}), model


def _claim_of(s: Record, content: RecordType, *, types: DialogueTypes) -> RecordType:
    """What was asked last of a thing, of the thing that a content is about."""
    answer = s.private.last[-1]
    rather = predicate_at(answer, "e").name == "say_rather"
    claim = value_at(answer, "rival" if rather else "content")
    assert isinstance(claim, RecordType)
    claim = affirmation(claim)
    fields = {label: claim[label] for label in CLAIM if label in claim}
    if "frame" in fields:
        fields["frame"] = types["Front"]
    return rectype({**fields, "look": types["Look"], "target": content["target"]})


def _words_at_hand(s: Record) -> list[Record]:
    """The words that are known, and those of the robot's last answer."""
    said = value_at(s.private.last[-1], "signs") if s.private.last else ()
    return [*words(s), *said]


CONTINUING = first(ask_same, ask_same_of_meant)
NAMED_ALSO = first(teach_same, ask_same_of_named)
"""What takes a thing that is only named as the next one of which the same is so."""
