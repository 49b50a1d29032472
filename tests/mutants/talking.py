"""The games of the robot, as a game that can be played without seeing anything.

What it would see is made up: of a thing in a look each word is true to a degree that
depends on nothing but their names.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from zlib import crc32

from kille.dialogue.meanings import noun, predicate_at, relation, theory, word_of
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from ttr import Judgement, Model, PType, Record, RecordType, TypeNode, record
from ttr.syntax import Object
from ttr.testing import Roles, Tutor

NOUNS = [noun(form) for form in ("cup", "book", "box")]
RELATIONS = [relation("to the left of")]
LOOKS = tuple(f"look{number}" for number in range(1, 13))
THINGS = ("o1", "o2", "o3")


# --- what it sees --------------------------------------------------------------------


def degree(word: str, *seen: str) -> float:
    """How probable a word is of what is seen: of a thing, or of two, in a look.

    Some things are clearly something, some might be either of two, some are perhaps
    something; of some nothing is known.
    """
    *things, look = (int(name.lstrip("lok")) for name in seen)
    number = 3 * look + sum(x * x for x in things)
    likely = ((0.9, 0.05, 0.0), (0.5, 0.4, 0.0), (0.4, 0.0, 0.0), (0.1, 0.1, 0.0))
    rank = (crc32(word.encode()) + number // 4) % 3
    return likely[number % 4][rank]


def witnessed(model: Model, signs: list[Record]) -> Model:
    """The model in which these words are judged of what is seen."""
    for sign in signs:
        word = word_of(sign)
        model = model.witnessed(word, by=partial(degree, word.name))
    return model


def seen(look: str) -> Record:
    """What is to be seen in a look: up to three things, mostly with their places."""
    number = int(look.removeprefix("look"))
    things = THINGS[: number % 5]
    placed = things if number % 4 else ()
    return record(
        view=record(look=look, things=things, placed=placed, focus=things[:1])
    )


def model() -> Model:
    """What there is before the dialogue begins."""
    found = witnessed(blank_model(), [*NOUNS, *RELATIONS])
    for look in LOOKS:
        found = found.given(look, theory()["Look"])
    for x in THINGS:
        found = found.given(x, theory()["Ind"])
    return found


# --- what it does --------------------------------------------------------------------


def act(planned: TypeNode, so_far: Model) -> tuple[Object, Model]:
    """Makes a move; a lesson makes the robot able to judge a new word."""
    move, so_far = so_far.create(planned)
    if act_of(planned) in ("learned", "learned_relation"):
        so_far = witnessed(so_far, list(move.signs))
    return move, so_far


def act_of(T: TypeNode) -> str:
    """What kind of move it is: assert_name, learned."""
    assert isinstance(T, RecordType)
    return predicate_at(T, "e").name


plain = tutoring(NOUNS, RELATIONS, model=model(), act=act)
game = replace(plain, hear=cache(plain.hear))


# --- the tutor -----------------------------------------------------------------------

SEEN = tuple(map(seen, LOOKS))
SAYS = (
    "What is this?",
    "This is a cup.",
    "This is a ball.",
    "Where is the book?",
    "Where is the ball?",
    "The book is to the left of the cup.",
    "The cup is behind the box.",
    "The ball is near the book.",
    "Yes.",
    "No.",
    "No, it is a box.",
    "Hello.",
    "Thank you.",
    "Goodbye.",
    "Help.",
    "Colourless green ideas.",
)
CLAIMS = ("Yes.", "No.", "No, it is a box.")
REPLIES = {
    "admit_name": ("This is a cup.", "This is a ball."),
    "ask_again": ("This is a cup.", "This is a box."),
    "ask_which": ("This is a cup.", "Yes."),
    "ask_relation": ("The book is to the left of the cup.", "The cup is near the box."),
    "admit_place": ("The book is to the left of the cup.", "The cup is near the box."),
    "unknown_word": ("This is a ball.",),
}


def replies(state: Record, model: Model) -> tuple[object, ...]:
    """What answers what the robot said, or a new look and a question."""
    if state.shared.pending:
        return CLAIMS
    if not state.view.focus:
        return (*SEEN, *SAYS[:3])
    return REPLIES.get(latest_act(state, model), (*SAYS[:6], *SEEN))


def latest_act(state: Record, model: Model) -> str:
    """What kind of move the latest one is: greet, assert_name; none at the start."""
    latest = state.shared.latest
    if "e" not in latest:
        return ""
    types = (T for T in model.facts.types_of(latest.e) if isinstance(T, PType))
    return next((T.pred.name for T in types), "")


tutor = Tutor(moves=(*SAYS, *SEEN), replies=replies, answers=0.6, wanders=0.3)

FITTING = {
    "instruct": {"learned", "see_nothing"},
    "ask_name": {
        "assert_name",
        "hedge_name",
        "guess_name",
        "admit_name",
        "see_nothing",
    },
    "affirm": {"learned", "learned_relation", "ask_which", "ask_which_place", "wonder"},
    "deny": {"ask_again", "wonder"},
    "relate": {"learned_relation", "unknown_word", "see_no_such", "need_depth"},
    "ask_place": {
        *("assert_place", "hedge_place", "guess_place", "admit_place", "see_no_such"),
        *("need_landmark", "need_depth", "unknown_word"),
    },
    "ask_help": {"give_help"},
    "greet": {"greet_back"},
    "thank": {"welcome"},
    "leave": {"part"},
}
"""What the robot may answer to what the tutor does."""


def fits(event: Judgement | None, move: Judgement) -> bool:
    """Whether the robot's move is an answer to what was said or seen."""
    if event is None:
        return False
    if "view" in event.type:
        return act_of(move.type) == "ask_relation"
    return act_of(move.type) in FITTING[act_of(event.type)]


roles = Roles(
    commitments="shared.commitments",
    latest="shared.latest",
    fits=fits,
    moves=1,
)
