"""Games of the robot, as a game that can be played without seeing anything.

They are those of the paper, without what only other strategies, other games or what is
misheard bring about. What it would see is made up: of a thing in a look each word is
true to a degree that depends on nothing but their names.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from zlib import crc32

from kille.dialogue.games.clarifying import (
    ask_once_more,
    ask_yes_to_which,
    drop_question,
    take_described,
    take_none,
    wonder_at_mention,
)
from kille.dialogue.games.confirming import (
    ask_again,
    ask_which,
    learn_confirmed,
    wonder_what,
    wonder_why,
)
from kille.dialogue.games.courtesy import COURTESY as ALL_COURTESY
from kille.dialogue.games.instructing import learn_relation, learn_word, need_places
from kille.dialogue.games.interrupting import repeat
from kille.dialogue.games.listening import GLANCED, SAID, SEEN, hear
from kille.dialogue.games.naming import (
    admit_name,
    assert_name,
    guess_name,
    hedge_name,
    recognise,
)
from kille.dialogue.games.placing import PLACING
from kille.dialogue.games.referring import REFERRING as REFERRING_TO_WHAT_IS_SEEN
from kille.dialogue.games.referring import trust_pointing
from kille.dialogue.games.taking_initiative import ask_relation
from kille.dialogue.games.tutoring_cost import CORRECTED
from kille.dialogue.language import understand
from kille.dialogue.meanings import noun, predicate_at, relation, theory, word_of
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import hear_sentences, tutoring
from kille.lab.worlds.dialogue_properties import RETRACTED
from ttr import Model, Record, RecordType, record
from ttr.judging import Judgement
from ttr.testing import ALL, Roles, Tutor
from ttr.types import PType, TypeNode
from ttr.updates import first, maybe, seq

SIGNS = [*map(noun, ("cup", "book", "box")), relation("to the left of")]
LOOKS = tuple(f"look{number}" for number in range(1, 13))
THINGS = ("o1", "o2", "o3")


# --- the games -----------------------------------------------------------------------

CLARIFYING = first(
    take_described,
    take_none,
    ask_once_more,
    ask_yes_to_which,
    seq(drop_question, maybe(wonder_at_mention)),
    wonder_at_mention,
)
CONFIRMING = first(learn_confirmed, ask_which, wonder_what, ask_again, wonder_why)
INSTRUCTING = first(learn_word, learn_relation, need_places)
REFERRING = first(
    *(it for it in REFERRING_TO_WHAT_IS_SEEN.parts if it is not trust_pointing)
)
COURTESY = first(
    *(it for it in ALL_COURTESY.parts if it.name != "TellNames to NameOne")
)
NAMING = seq(maybe(recognise), first(assert_name, hedge_name, guess_name, admit_name))
RULES = first(
    seq(
        hear,
        maybe(CORRECTED),
        first(repeat, maybe(CLARIFYING)),
        maybe(REFERRING),
        maybe(first(CONFIRMING, INSTRUCTING, NAMING, PLACING, COURTESY)),
    ),
    SAID,
    GLANCED,
    seq(SEEN, maybe(ask_relation)),
)


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


def degree_beside(word: str, x: str, y: str, look: str, front: str) -> float:
    """How probable a relation is of two things: the same in every perspective."""
    return degree(word, x, y, look)


def witnessed(model: Model, signs: list[Record]) -> Model:
    """The model in which these words are judged of what is seen."""
    for sign in signs:
        word = word_of(sign)
        by = degree_beside if sign.kind == "relation" else degree
        model = model.witnessed(word, by=partial(by, word.name))
    return model


def seen(look: str, floor: str = "robot") -> Record:
    """What is to be seen in a look: up to three things, mostly with their places.

    A thing that is still there has kept its name.
    """
    number = int(look.removeprefix("look"))
    things = THINGS[: number % 5]
    placed = things if number % 4 else ()
    view = record(
        look=look, things=things, placed=placed, focus=things[:1], pointed=things[:1]
    )
    return record(view=view, kept=things, floor=floor)


def model() -> Model:
    """What there is before the dialogue begins."""
    found = witnessed(blank_model(), SIGNS)
    for look in LOOKS:
        found = found.given(look, theory()["Look"])
    for x in THINGS:
        found = found.given(x, theory()["Ind"])
    return found


# --- what it does --------------------------------------------------------------------


def act(planned: TypeNode, so_far: Model) -> tuple[Record, Model]:
    """Makes a move; a lesson makes the robot able to judge a new word."""
    move, so_far = so_far.create(planned)
    if move.teaches:
        so_far = witnessed(so_far, list(move.signs))
    return move, so_far


def act_of(T: TypeNode) -> str:
    """What kind of move it is: assert_name, learned."""
    assert isinstance(T, RecordType)
    return predicate_at(T, "e").name


game = tutoring(SIGNS, rules=RULES, model=model(), act=act)
assert game.hear is not None
game = replace(game, hear=cache(game.hear))


# --- the tutor -----------------------------------------------------------------------

LOOKED = tuple(map(seen, LOOKS))
GLIMPSED = tuple(seen(look, "tutor") for look in LOOKS[::4])
SAYS = (
    "What is this?",
    "This is a cup.",
    "This is a ball.",
    "Where is the book?",
    "Where is the box?",
    "Where is the ball?",
    "The book is to the left of the cup.",
    "The cup is behind the box.",
    "The ball is near the book.",
    "Yes.",
    "No.",
    "The first one.",
    "Say that again.",
    "Hello.",
    "Thank you.",
    "OK.",
    "Goodbye.",
    "Help.",
    "Colourless green ideas.",
)


def heard_in_part(text: str) -> object:
    """The event of saying what the robot understands in part only."""
    heard = hear_in_parts(understand(text), Situation(things=1))
    return hear_sentences(*heard.moves[:1])


IN_PARTS = tuple(map(heard_in_part, ("Pick it up.", "Who are you?", "I am tired.")))
"""What is not its job, who it is, and a remark."""

CLAIMS = ("Yes.", "Yes.", "No.", "No.", "This is a box.")
UNCLEAR = {"look4", "look8"}
"""Where two things might be a box."""

CHOICES = ("The first one.", "The book.", "The ball.", "Yes.", "No.", SAYS[0])
REPLIES = {
    "admit_name": ("This is a cup.", "This is a ball."),
    "ask_again": ("This is a cup.", "This is a box."),
    "ask_which": ("This is a cup.", "Yes."),
    "ask_relation": ("The book is to the left of the cup.", "The cup is near the box."),
    "admit_place": ("The book is to the left of the cup.", "The cup is near the box."),
    "unknown_noun": ("This is a ball.",),
}


def replies(state: Record, model: Model) -> tuple[object, ...]:
    """What answers what the robot said, or else a lesson, a question or a new look."""
    if state.shared.qud:
        return CHOICES
    if state.shared.pending:
        return CLAIMS
    if not state.view.focus:
        return (*LOOKED, *SAYS[:3])
    if state.view.look in UNCLEAR:
        return ("Where is the box?", SAYS[0], SAYS[0], SAYS[1])
    return REPLIES.get(latest_act(state, model), (*SAYS[:7], *LOOKED))


def latest_act(state: Record, model: Model) -> str:
    """What kind of move the latest one is: greet, assert_name; none at the start."""
    latest = state.shared.latest
    if "e" not in latest:
        return ""
    types = (T for T in model.facts.types_of(latest.e) if isinstance(T, PType))
    return next((T.pred.name for T in types), "")


tutor = Tutor(
    moves=(*SAYS, *IN_PARTS, *LOOKED[::2], *GLIMPSED),
    replies=replies,
    answers=0.6,
    wanders=0.3,
)

MISSING = {"see_nothing", "see_no_such"}
ASKING = {"ask_referent", "offer_referents"}
FITTING = {
    "instruct": {"learned", *MISSING},
    "ask_name": {"assert_name", "hedge_name", "guess_name", "admit_name", *MISSING},
    "affirm": {"learned", "learned_relation", "ask_which", "ask_which_place", "wonder"}
    | ASKING,
    "deny": {"ask_again", "wonder", "resign"},
    "relate": {"learned_relation", "unknown_noun", "same_thing", "need_depth"}
    | MISSING
    | ASKING,
    "ask_place": {
        *("assert_place", "hedge_place", "guess_place", "admit_place"),
        *("admit_name", "need_landmark", "need_depth", "unknown_noun"),
    }
    | MISSING
    | ASKING,
    "ask_help": {"give_help"},
    "greet": {"greet_back"},
    "thank": {"welcome"},
    "okay": {"noted"},
    "leave": {"part"},
    "ask_deed": {"tell_abilities"},
    "ask_beyond": {"admit_beyond"},
    "define": {"need_example"},
    "ask_self": {"introduce"},
    "tell_use": {"tell_scope"},
    "remark": {"take_as_remark"},
}
"""What the robot may answer to what the tutor does."""

FITTING["mention"] = {"what_about"} | FITTING["relate"] | FITTING["ask_place"]
"""Which thing was meant: what answers the move that this was asked about."""


def fits(event: Judgement | None, move: Judgement) -> bool:
    """Whether the robot's move is an answer to what was said or seen."""
    if event is None:
        return False
    assert isinstance(event.type, RecordType)
    if "view" in event.type:
        return act_of(move.type) == "ask_relation"
    asked = act_of(event.type)
    return asked == "ask_repeat" or act_of(move.type) in FITTING[asked]


roles = Roles(
    qud="shared.qud",
    commitments="shared.commitments",
    latest="shared.latest",
    fits=fits,
    retracts=frozenset({"keep"}),
    moves=1,
)
properties = (RETRACTED, *(one for one in ALL if one.name != RETRACTED.name))
"""What is taken back is told exactly by the moves of these games."""
