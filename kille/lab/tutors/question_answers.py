"""Which moves of a tutor's answer which question of the robot's, for the properties.

What a phrase is true of, and which thing a perspective is of, depends on the state: the
rules that settle such a question are among those that may drop it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

from kille.dialogue.commitments import kind_of
from kille.dialogue.language import understand
from kille.dialogue.meanings import DialogueTypes, predicate_at, value_at
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from ttr import Record, RecordType
from ttr.types import PType
from ttr.types.objects import Object

DROPPING = frozenset(
    {
        "drop_question",
        "drop_unsaid",
        "see",
        "glance",
        "watch",
        "take_described",
        "take_rest",
        "learn_all",
        "take_either",
        "take_restated",
        "correct_either",
        "ask_fewer",
        "ask_once_more",
        "ask_yes_to_which",
        "settle_frame",
    }
)
"""The rules by which a question goes that nothing plainly answers.

It is dropped for something else, or as what it is about is gone; or the answer depends
on what is seen, or leaves some of it open.
"""

WHICH = ("AskReferent", "AskReferentAgain")
"""The questions which thing was meant."""

EITHER = ("AskBoth", "AskEither")
"""The questions which of two nouns is right, or if both are."""

YES_OR_NO = frozenset(
    {
        "OfferWord",
        "AskKind",
        "AskHow",
        "AskBoth",
        "AskKindStill",
        "AskForget",
        "AskForgetAll",
        "AskMeant",
        "AskPresumed",
        "AskEvery",
        "AskOnly",
        "AskSwapped",
    }
)
"""The questions that yes and no answer."""

TAKEN_BACK = (YES_OR_NO - {"AskForget", "AskForgetAll"}) | {"AskEarlier"}
"""The questions that are settled when the tutor takes back what they said."""

PLACES = {
    "first": 1,
    "leftmost": 1,
    "last": 1,
    "rightmost": 1,
    "second": 2,
    "third": 3,
}
"""Of how many things at least one is chosen by its place among them."""


def answer_test(
    language: str, types: DialogueTypes | None = None
) -> Callable[[Object, Object], bool]:
    """Whether an event is a move in this language that answers a question.

    >>> from ttr import Rec, record
    >>> said = record(text="Yes.", content=Rec)
    >>> asked = record(ask="OfferWord", options=[record(), record()])
    >>> answer_test("en")(said, asked)
    True
    """

    def answers(event: Object, question: Object) -> bool:
        if not isinstance(event, Record) or not isinstance(question, Record):
            return False
        if "text" not in event:
            return False
        meant = _readings(str(event.text), language, types)
        return any(
            content == event.content and _is_answer(move, event, question)
            for move, content in meant
        )

    return answers


def _is_answer(move: str, event: Record, question: Record) -> bool:
    """Whether an event that is such a move answers a question, whatever is seen."""
    options = len(question.options)
    match question.ask, move:
        case asked, "affirm" | "deny" if asked in YES_OR_NO:
            return True
        case asked, "forget_that" | "forget_last" if asked in TAKEN_BACK:
            return kind_of(event.content) is None
        case "AskMeant" | "AskPresumed", "swap":
            return options == _PAIR
        case "AskEarlier", "prefer_now" | "prefer_earlier" | "affirm" | "deny":
            return True
        case asked, "prefer_now" | "prefer_earlier" if asked in EITHER:
            return True
        case "AskHeard", "affirm":
            return options == 1
        case "AskFrame", "take_frame":
            return "landmark" not in event.content
        case asked, "mention":
            return asked in WHICH and _is_place(event.content, options)
        case asked, "deny":
            return asked in ("AskHeard", *WHICH)
    return False


_PAIR = 2
"""So many claims may be meant the other way round."""


def _is_place(content: RecordType, options: int) -> bool:
    """Whether one of several things is mentioned by its place among them."""
    target = content["target"]
    assert isinstance(target, RecordType)
    said = [T for _, T in target.fields if isinstance(T, PType)]
    return len(said) == 1 and options >= PLACES.get(said[0].pred.name, options + 1)


@lru_cache(4096)
def _readings(
    text: str, language: str, types: DialogueTypes | None
) -> tuple[tuple[str, object], ...]:
    """What a text may be: moves, by their predicates, and what they are about.

    Some are heard by their parts: "Not that one."
    """
    first = understand(text, language, types=types)[:1]
    around = Situation(things=1, asks_whether=True)
    in_parts = hear_in_parts(first, around, language, types=types).moves[:1]
    heard = dict.fromkeys((*first, *in_parts))
    moves = (it.type for sentence in heard for it in sentence.readings)
    return tuple((predicate_at(it, "e").name, value_at(it, "content")) for it in moves)
