"""The four games of tutoring, as update rules over one typed state.

What the tutor says becomes the latest move; a game answers it by putting the type of
the robot's next move on the agenda; when the robot has made that move, it is the
latest. Every rule says in its docstring when it applies. The bands of certainty are
numbers in the state, and degrees are those of judgements: nothing is decided elsewhere.

Source: Dobnik and de Graaf 2017, section 3.
"""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.beliefs import (
    Beliefs,
    best_pair,
    best_thing,
    has_rival,
    is_sure,
    knows,
    nouns_of,
    recognised,
    relations_of,
    thinks,
)
from kille.dialogue.meanings import named
from kille.dialogue.moves import answering, in_look, plan, related, uses
from kille.dialogue.state import STATE
from ttr import Model, Record, RecordType, replace
from ttr.updates import Rule, first, maybe, rule, seq

__all__ = ["HEARD", "LOOKED", "SAID", "SCENE_CHANGED"]

Update = tuple[Record, Model]

# --- seeing, hearing and saying ------------------------------------------------------


@rule(when=STATE, on=named("Seen"))
def see(s: Record, seen: Record) -> Record:
    """What is in view is what the latest look shows."""
    return replace(s, view=seen.view)


@rule(when=STATE, on=named("Heard"))
def hear(s: Record, said: Record) -> Record:
    """What the tutor says is the latest move, and has to be answered."""
    changes = {"private.agenda": (), "private.beliefs": (), "shared.latest": said}
    return replace(s, changes)


@rule(when=STATE, on=named("Said"))
def say(s: Record, said: Record) -> Record:
    """What the robot has said is the latest move, and off its agenda."""
    return replace(s, {"private.agenda": s.private.agenda[1:], "shared.latest": said})


# --- game 1: direct instruction ------------------------------------------------------


@rule(when=answering("Instruct"))
def learn_word(s: Record) -> Record | None:
    """The tutor names the thing in focus: learn the word from this very look."""
    if not s.view.focus:
        return None
    said = s.shared.latest
    content = in_look(s, said.content, s.view.focus[0])
    return plan(s, "Learned", content, signs=said.signs)


@rule(when=STATE, on=named("Learned"))
def keep_noun(s: Record, said: Record) -> Record:
    """A noun that was learned is known, and that the thing is one is agreed on."""
    return _kept(s, "nouns", said)


@rule(when=STATE, on=named("LearnedRelation"))
def keep_relation(s: Record, said: Record) -> Record:
    """A relation that was learned is known, and that things stand so is agreed on."""
    return _kept(s, "relations", said)


def _kept(s: Record, words: str, said: Record) -> Record:
    known, agreed = s.private[words], s.shared.commitments
    new = tuple(sign for sign in said.signs if not knows(known, sign))
    news = () if said.content in agreed else (said.content,)
    return replace(
        s, {f"private.{words}": known + new, "shared.commitments": agreed + news}
    )


# --- game 2: description, as certain as the robot is ---------------------------------


@rule(when=answering("AskName"))
def recognise(s: Record, *, model: Model) -> Update | None:
    """The tutor asks what the thing in focus is: judge every noun of it."""
    if not s.view.focus or not s.private.nouns:
        return None
    beliefs, model = nouns_of(s, model, s.view.focus[0])
    return replace(s, {"private.beliefs": beliefs}), model


@rule(when=answering("AskName"))
def assert_name(s: Record) -> Record | None:
    """It is sure, and no rival is near: it says what this is."""
    if not is_sure(s, s.private.beliefs):
        return None
    content, sign = _named(s, 0)
    return plan(s, "AssertName", content, signs=[sign], pending=[content])


@rule(when=answering("AskName"))
def hedge_name(s: Record) -> Record | None:
    """It has an opinion, but also a rival to it: it names both."""
    if not thinks(s, s.private.beliefs) or not has_rival(s, s.private.beliefs):
        return None
    content, sign = _named(s, 0)
    rival, other = _named(s, 1)
    claims = [content, rival]
    return plan(s, "HedgeName", content, rival, signs=[sign, other], pending=claims)


@rule(when=answering("AskName"))
def guess_name(s: Record) -> Record | None:
    """It has an opinion that it is not sure of, and no rival to it."""
    if not thinks(s, s.private.beliefs):
        return None
    content, sign = _named(s, 0)
    return plan(s, "GuessName", content, signs=[sign], pending=[content])


@rule(when=answering("AskName"))
def admit_name(s: Record) -> Record | None:
    """It does not know what this is, and asks."""
    return plan(s, "AdmitName") if s.view.focus else None


def _named(s: Record, rank: int) -> tuple[RecordType, Record]:
    """What it says of the thing by its belief of this rank, and the sign it uses."""
    belief = s.private.beliefs[rank]
    return in_look(s, belief.sign.meaning, belief.sit.x), belief.sign


# --- game 3: reinforcement -----------------------------------------------------------


@rule(when=answering("Affirm"))
def learn_confirmed(s: Record) -> Record | None:
    """The tutor confirms the robot's one claim: it is a lesson about that look."""
    if len(s.shared.pending) != 1:
        return None
    content = s.shared.pending[0]
    if content <= named("Relating"):
        signs = _used(s.private.relations, content)
        return plan(s, "LearnedRelation", content, signs=signs)
    return plan(s, "Learned", content, signs=_used(s.private.nouns, content))


@rule(when=answering("Affirm"))
def ask_which(s: Record) -> Record | None:
    """The tutor confirms, but the robot had named two: it asks which."""
    if len(s.shared.pending) != 2:
        return None
    content, rival = s.shared.pending
    act = "AskWhichPlace" if content <= named("Relating") else "AskWhich"
    known = s.private.nouns + s.private.relations
    signs = _used(known, content, rival)
    return plan(s, act, content, rival, signs=signs, pending=s.shared.pending)


def _used(known: Iterable[Record], *contents: RecordType) -> list[Record]:
    """The words that are known and occur in one of the contents."""
    return [sign for sign in known if any(uses(one, sign) for one in contents)]


@rule(when=answering("Deny"))
def ask_again(s: Record) -> Record | None:
    """The tutor rejects what the robot claimed: it takes that back, and asks."""
    return plan(s, "AskAgain") if s.shared.pending else None


# --- game 4: where things are --------------------------------------------------------


@rule(when=STATE)
def ask_relation(s: Record, *, model: Model) -> Update | None:
    """Two things it knows are in view, and how they stand it cannot say: it asks."""
    known, model = _known_pair(s, model)
    if known is None:
        return None
    target, landmark = known
    relations, model = relations_of(s, model, target.sit.x, landmark.sit.x)
    asked = sorted((target.sign.form, landmark.sign.form))
    if is_sure(s, relations) or asked == list(s.private.asked):
        return None
    content = related(s, target.sit.x, target.sign, landmark.sit.x, landmark.sign)
    signs = [target.sign, landmark.sign]
    planned = plan(s, "AskRelation", content, signs=signs)
    return replace(planned, {"private.asked": asked}), model


def _known_pair(s: Record, model: Model) -> tuple[tuple[Record, Record] | None, Model]:
    """The two nearest things with a place that it recognises as different things."""
    found: list[Record] = []
    for x in s.view.placed:
        belief, model = recognised(s, model, x)
        if belief is None or any(belief.sign == other.sign for other in found):
            continue
        found.append(belief)
        if len(found) == 2:
            return (found[0], found[1]), model
    return None, model


@rule(when=answering("Relate"))
def learn_relation(s: Record, *, model: Model) -> Update | None:
    """The tutor says how two things in view stand: learn the relation from them."""
    target, relation, landmark = s.shared.latest.signs
    pair, model = best_pair(s, model, target, landmark)
    if pair is None or not set(pair) <= set(s.view.placed):
        return None
    x, y = pair
    content = related(s, x, target, y, landmark, relation)
    return plan(s, "LearnedRelation", content, signs=[relation]), model


@rule(when=answering("Relate"))
def miss_related(s: Record, *, model: Model) -> Update | None:
    """The tutor relates a thing that it does not know, or does not see."""
    target, _, landmark = s.shared.latest.signs
    for sign in (target, landmark):
        missing, model = _missing(s, model, sign)
        if missing is not None:
            return missing, model
    if not s.view.placed:
        return None
    return plan(s, "SeeNoSuch", landmark.meaning, signs=[landmark]), model


def _missing(s: Record, model: Model, sign: Record) -> tuple[Record | None, Model]:
    """The state in which it says that it does not know or see such a thing, if so."""
    if not knows(s.private.nouns, sign):
        return plan(s, "UnknownWord", sign.meaning, signs=[sign]), model
    thing, model = best_thing(s, model, sign)
    if thing is None:
        return plan(s, "SeeNoSuch", sign.meaning, signs=[sign]), model
    return None, model


@rule(when=answering("AskPlace"))
def say_place(s: Record, *, model: Model) -> Update | None:
    """The tutor asks where a thing is: say how it stands to the best-known other."""
    (target,) = s.shared.latest.signs
    thing, model = best_thing(s, model, target)
    if thing is None or thing.sit.x not in s.view.placed:
        return None
    landmark, model = _landmark(s, model, thing)
    if landmark is None:
        return plan(s, "NeedLandmark", target.meaning, signs=[target]), model
    relations, model = relations_of(s, model, thing.sit.x, landmark.sit.x)
    believing = replace(s, {"private.beliefs": relations})
    return _place_said(believing, thing, landmark, relations), model


def _landmark(s: Record, model: Model, thing: Record) -> tuple[Record | None, Model]:
    """The other thing with a place that it knows best, as a belief worth saying."""
    best: Record | None = None
    for y in s.view.placed:
        beliefs, model = nouns_of(s, model, y)
        if y == thing.sit.x or not thinks(s, beliefs) or beliefs[0].sign == thing.sign:
            continue
        if best is None or beliefs[0].p > best.p:
            best = beliefs[0]
    return best, model


def _place_said(
    s: Record, thing: Record, landmark: Record, relations: Beliefs
) -> Record:
    """The plan to say how the thing stands, as certain as the robot is of it."""

    def standing(*relation: Record) -> RecordType:
        return related(
            s, thing.sit.x, thing.sign, landmark.sit.x, landmark.sign, *relation
        )

    nouns = [thing.sign, landmark.sign]
    if not thinks(s, relations):
        return plan(s, "AdmitPlace", standing(), signs=nouns)
    best = relations[0].sign
    content = standing(best)
    if is_sure(s, relations):
        signs = [*nouns, best]
        return plan(s, "AssertPlace", content, signs=signs, pending=[content])
    if not has_rival(s, relations):
        signs = [*nouns, best]
        return plan(s, "GuessPlace", content, signs=signs, pending=[content])
    other = relations[1].sign
    rival, signs = standing(other), [*nouns, best, other]
    return plan(s, "HedgePlace", content, rival, signs=signs, pending=[content, rival])


@rule(when=answering("AskPlace"))
def miss_placed(s: Record, *, model: Model) -> Update | None:
    """The tutor asks for a thing that it does not know, or does not see."""
    missing, model = _missing(s, model, s.shared.latest.signs[0])
    return None if missing is None else (missing, model)


# --- answers that need no thought ----------------------------------------------------


def reply(move: str, act: str, doc: str) -> Rule:
    """The rule that answers every such move by this act."""

    def answer(s: Record) -> Record:
        return plan(s, act)

    answer.__name__ = f"{act} to {move}"
    answer.__doc__ = doc
    return rule(when=answering(move))(answer)


REPLIES = (
    reply("Instruct", "SeeNothing", "There is nothing in view to learn from."),
    reply("AskName", "SeeNothing", "There is nothing in view to name."),
    reply("Relate", "NeedDepth", "The things are in view, but not where they are."),
    reply("AskPlace", "NeedDepth", "The thing is in view, but not where it is."),
    reply("Affirm", "Wonder", "The robot has claimed nothing to confirm."),
    reply("Deny", "Wonder", "The robot has claimed nothing to reject."),
    reply("AskHelp", "GiveHelp", "It says what it understands."),
    reply("Greet", "GreetBack", "A greeting is returned."),
    reply("Thank", "Welcome", "Thanks are acknowledged."),
    reply("Leave", "Part", "The tutor takes leave, and so does the robot."),
)

# --- the algorithms ------------------------------------------------------------------

LOOKED = see
"""What a look does while the tutor has the floor."""

SCENE_CHANGED = seq(see, maybe(ask_relation))
"""What a look does when the scene has changed and the robot has the floor."""

HEARD = seq(
    hear,
    first(
        learn_word,
        seq(recognise, first(assert_name, hedge_name, guess_name, admit_name)),
        admit_name,
        learn_confirmed,
        ask_which,
        ask_again,
        learn_relation,
        miss_related,
        say_place,
        miss_placed,
        *REPLIES,
    ),
)
"""What an utterance of the tutor's does."""

SAID = seq(say, maybe(first(keep_noun, keep_relation)))
"""What an utterance of the robot's does."""
