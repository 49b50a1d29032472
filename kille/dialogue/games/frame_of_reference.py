"""Whose left is it? The viewer's, or that of the thing beside which something stands.

Where a landmark is known to face some way, its left need not be the viewer's. If the
talk has not settled on a perspective, and what is said comes to something else in the
other one, the robot asks. What is settled holds as long as the talk is about places; a
correction changes it, and what was asked before is answered anew.

Source: Dobnik, Howes and Kelleher 2015 (perspectives are aligned game by game).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kille.dialogue.beliefs import relations_of
from kille.dialogue.commitments import act_of, affirmation, signs_for
from kille.dialogue.games.placing import asked_thing, landmark_for
from kille.dialogue.games.referring import about
from kille.dialogue.meanings import (
    DialogueTypes,
    any_of,
    predicate_at,
    set_at,
    set_to,
    value_at,
)
from kille.dialogue.moves import content_of, hear_as, issue, plan, words_in
from kille.dialogue.reference import (
    LANDMARK,
    OPEN,
    PARTS,
    VIEWER,
    PhraseJudge,
    fits_well,
    front_of,
    in_view,
    intended_readings,
    known_front,
    phrase_at,
    possible_readings,
    thing_at,
    things_in,
)
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from ttr import Model, Rec, Record, RecordType, rectype, replace
from ttr.updates import first

Update = tuple[Record, Model]

ASKED = "AskFrame"
"""The question whose perspective is meant: the viewer's, or else the landmark's."""

FRAMES = (VIEWER, LANDMARK)
"""The perspectives that the robot asks to choose from."""

LESSONS = ("Relate", "Correct", "Reject")
"""Moves by which a relation may be learned."""

OTHER_GAMES = ("Instruct", "Describe", "AskName", "Leave")
"""Moves that begin another game, in which no place is talked about."""

CHECKED = ("SayYes", "SayNo", "SayRather", "SayProbably", "AdmitWhether")
"""Answers to whether things stand so."""

# --- settling on a perspective -------------------------------------------------------


@rule(answers="TakeFrame")
def ask_front(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor takes the perspective of a thing, and how it faces was never said."""
    content = content_of(s)
    if _frame_in(content) != LANDMARK or _has_front(s, model, content, types=types):
        return None
    return plan(s, "AskFront", content, signs=s.shared.latest.signs, types=types)


@rule(answers="TakeFrame")
def settle_frame(s: Record, *, types: DialogueTypes) -> Record | None:
    """Asked whose perspective is meant, the tutor says whose."""
    if not s.shared.qud or s.shared.qud[0].ask != ASKED:
        return None
    frame = _frame_in(content_of(s))
    option = s.shared.qud[0].options[FRAMES.index(frame)]
    changes = {"shared.qud": s.shared.qud[1:], "shared.latest": option}
    return about(replace(_in(s, frame), changes), option.content, types=types)


@rule(answers="TakeFrame")
def answer_anew(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """The tutor corrects the perspective of an answer: the question is asked again."""
    settled = _in(s, _frame_in(content_of(s)))
    asked = _last_question(settled, types=types)
    if asked is None:
        return None
    act, content = asked
    signs = words_in(words(s), content)
    content = in_view(settled, content, types=types)
    move, model = hear_as(s, model, act, content, signs, types=types)
    return replace(settled, {"shared.latest": move, "shared.pending": ()}), model


@rule(answers="TakeFrame")
def learn_anew(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor corrects the perspective of a lesson: it is learned in the other."""
    lesson = next(iter(s.private.lessons[-1:]), None)
    if lesson is None or "rel" not in lesson.content or not _just_learned(s, lesson):
        return None
    settled = _in(s, _frame_in(content_of(s)))
    landmark = str(thing_at(lesson.content, "landmark"))
    content = set_at(lesson.content, "frame", front_of(settled, landmark))
    if content == lesson.content:
        return None
    signs = signs_for(s, content)
    forgets, teaches = [lesson.key], [content]
    return plan(
        settled,
        act_of(content),
        content,
        signs=signs,
        teaches=teaches,
        forgets=forgets,
        types=types,
    )


@rule(answers="TakeFrame")
def note_frame(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor says in whose perspective places will be talked about."""
    return plan(_in(s, _frame_in(content_of(s))), "Noted", types=types)


@rule(answers="AskWhose")
def tell_owner(s: Record, *, types: DialogueTypes) -> Record | None:
    """Asked whose left it means, it says that it is that of what it spoke of."""
    if s.shared.frame != LANDMARK:
        return None
    claims = (*s.shared.pending, *(it.content for it in s.private.lessons[::-1]))
    placed = next((it for it in claims if "landmark" in it), Rec)
    return plan(s, "TellOwner", placed, signs=words_in(words(s), placed), types=types)


@rule(answers="AskWhose")
def tell_viewer(s: Record, *, types: DialogueTypes) -> Record:
    """Asked whose left it means, it says that it is its own."""
    return plan(s, "TellViewer", pending=s.shared.pending, types=types)


@rule(answers=OTHER_GAMES)
def leave_places(s: Record) -> Record | None:
    """Another game begins: nothing is settled any more about perspectives."""
    if (
        s.shared.frame == OPEN
        or next(_phrases_with_landmark(content_of(s)), None) is not None
    ):
        return None
    return _in(s, OPEN)


@rule(answers="Heard")
def ask_frame_of_phrase(
    s: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """A phrase means one thing to the viewer, and another as the landmark has it."""
    label = next(_phrases_with_landmark(content_of(s)), None)
    if s.shared.frame != OPEN or not s.shared.turned or label is None:
        return None
    meant = [_resolved_content(_in(s, frame), model, types=types) for frame in FRAMES]
    if meant[0] == meant[1]:
        return None
    landmark = phrase_at(phrase_at(content_of(s), label), "landmark")
    options = [replace(s.shared.latest, content=content) for content in meant]
    return _plan_question(s, landmark, options, types=types)


# --- asking for it -------------------------------------------------------------------


@rule(answers="Orient")
def learn_front(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says which way a thing faces."""
    content = content_of(s)
    x = thing_at(content, "target")
    if x is None:
        return None
    others = (it for it in s.shared.turned if it.x != x)
    turned = (*others, {"x": x, "front": value_at(content, "front")})
    return plan(replace(s, {"shared.turned": turned}), "Noted", types=types)


@rule(answers=LESSONS)
def ask_frame_of_lesson(s: Record, *, types: DialogueTypes) -> Record | None:
    """What is said of a place can be learned in one perspective or in the other."""
    landmark = _open_landmark(s)
    return _plan_question_of_claim(s, landmark, types=types) if landmark else None


@rule(answers="AskWhether")
def ask_frame_of_question(
    s: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """Things stand so in one perspective, and not in the other."""
    landmark = _open_landmark(s)
    if landmark is None:
        return None
    seen = [_verdict(_in(s, frame), model, landmark, types=types) for frame in FRAMES]
    return (
        _plan_question_of_claim(s, landmark, types=types)
        if seen[0] != seen[1]
        else None
    )


@rule(answers="AskPlace")
def ask_frame_of_place(
    s: Record, *, model: Model, types: DialogueTypes
) -> Update | None:
    """Where a thing is would be said in other words as the landmark has it."""
    x = thing_at(content_of(s), "target")
    if s.shared.frame != OPEN or not s.shared.turned or x not in s.view.placed:
        return None
    thing = asked_thing(s, model, str(x))
    landmark = landmark_for(s, model, thing) if thing else None
    if landmark is None or known_front(s, landmark.sit.x) is None:
        return None
    said = []
    for frame in FRAMES:
        stands, model = relations_of(_in(s, frame), model, str(x), landmark.sit.x)
        said.append(stands[0].sign if stands else None)
    if said[0] == said[1]:
        return None
    return _plan_question(
        s,
        landmark.sign.meaning,
        [_with_front(s, it, types=types) for it in _fronts(s, landmark.sit.x)],
        types=types,
    ), model


def _last_question(s: Record, *, types: DialogueTypes) -> tuple[str, RecordType] | None:
    """The question of places that the robot has answered last, and what it is about.

    It was whether things stand so, or else where the thing is of which it has claimed
    that. There is none of what is no longer in view.
    """
    answers = types.derive(any_of, CHECKED)
    checked = next((it for it in s.private.last[-1:] if it <= answers), None)
    if checked is not None:
        rather = checked <= types.record_type("SayRather")
        about = value_at(checked, "rival" if rather else "content")
        assert isinstance(about, RecordType)
        act, content = "AskWhether", affirmation(about)
    elif s.shared.pending:
        act, content = "AskPlace", s.shared.pending[0]
    else:
        return None
    if "rel" not in content or not set(things_in(content)) <= set(s.view.things):
        return None
    if act == "AskWhether":
        return act, set_to(content, frame=types["Front"])
    return act, set_at(
        types.record_type("Asked"), "target.x", str(thing_at(content, "target"))
    )


def _just_learned(s: Record, lesson: Record) -> bool:
    """Whether it is of this lesson that the robot has spoken last."""
    return any(lesson.content in value_at(it, "teaches") for it in s.private.last)


def _in(s: Record, frame: str) -> Record:
    """The state in which this perspective is settled on."""
    return replace(s, {"shared.frame": frame})


def _frame_in(content: RecordType) -> str:
    """The perspective that the tutor takes."""
    return str(value_at(content, "by"))


def _has_front(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> bool:
    """Whether a thing that the tutor may mean is known to face some way."""
    turned = [str(it.x) for it in s.shared.turned]
    if "landmark" not in content:
        return bool(turned)
    fits = PhraseJudge(s, model, types=types).fits(phrase_at(content, "landmark"))
    return any(x in turned for x in fits_well(s, fits))


def _phrases_with_landmark(content: RecordType) -> Iterator[str]:
    """The phrases that say of their thing what it stands beside."""
    for label in PARTS:
        if label in content and "landmark" in phrase_at(content, label):
            yield label


def _resolved_content(s: Record, model: Model, *, types: DialogueTypes) -> RecordType:
    """What the latest move is about if its phrases are resolved, or else as it is."""
    content = content_of(s)
    readings = intended_readings(
        s, possible_readings(s, model, content, types=types), types=types
    )
    return readings[0].content if len(readings) == 1 else content


def _open_landmark(s: Record) -> str | None:
    """The landmark of the latest move, if its perspective could be meant or not."""
    content = content_of(s)
    landmark = thing_at(content, "landmark")
    if s.shared.frame != OPEN or "rel" not in content or landmark is None:
        return None
    return landmark if known_front(s, landmark) is not None else None


def _verdict(
    s: Record, model: Model, landmark: str, *, types: DialogueTypes
) -> tuple[bool, bool]:
    """Whether things surely stand as is asked, and whether they are likely to."""
    content, bands = content_of(s), s.private.strategy.bands
    target, look = thing_at(content, "target"), s.view.look
    word, front = predicate_at(content, "rel"), front_of(s, landmark)
    p = PhraseJudge(s, model, types=types).degree(word, target, landmark, look, front)
    return bool(p >= bands.sure), bool(p >= bands.likely)


def _plan_question_of_claim(
    s: Record, landmark: str, *, types: DialogueTypes
) -> Record:
    """The plan to ask in whose perspective a claim of the tutor's is meant."""
    content = content_of(s)
    options = [_with_front(s, front, types=types) for front in _fronts(s, landmark)]
    return _plan_question(s, phrase_at(content, "landmark"), options, types=types)


def _fronts(s: Record, landmark: str) -> list[str]:
    """What is forward in either perspective."""
    return [front_of(_in(s, frame), landmark) for frame in FRAMES]


def _with_front(s: Record, front: str, *, types: DialogueTypes) -> Record:
    """The latest move, made specific: this is forward."""
    content = set_to(content_of(s), frame=types["Front"] @ front)
    return replace(s.shared.latest, content=content)


def _plan_question(
    s: Record, landmark: RecordType, options: Sequence[Record], *, types: DialogueTypes
) -> Record:
    """The plan to ask whose perspective is meant; what was claimed stays pending."""
    asked = rectype(look=types["Look"], landmark=landmark)
    signs = words_in([*words(s), *s.shared.latest.signs], asked)
    asks, pending = [issue(ASKED, options)], s.shared.pending
    return plan(s, ASKED, asked, signs=signs, asks=asks, pending=pending, types=types)


FRAME_ANSWERED = first(ask_front, settle_frame)
"""What answers the question whose perspective is meant."""

FRAME_OF_REFERENCE = first(
    ask_front,
    answer_anew,
    learn_anew,
    note_frame,
    tell_owner,
    tell_viewer,
    leave_places,
    ask_frame_of_phrase,
)
"""What the tutor says of perspectives, and phrases that depend on them."""

ASKING_FRAME = first(
    learn_front, ask_frame_of_lesson, ask_frame_of_question, ask_frame_of_place
)
"""What comes to something else in another perspective, with its phrases resolved."""
