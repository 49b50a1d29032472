"""Seeing, hearing and saying: what every game begins and ends with.

What is heard may be read in several ways; the state decides between them. Then its
noun phrases are resolved to things in view, and only then do the games answer it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import count, islice

from kille.dialogue.beliefs import knows, knows_word
from kille.dialogue.commitments import claims_here, keep_claims
from kille.dialogue.criteria import signs_in
from kille.dialogue.games.attending import ATTENDING
from kille.dialogue.games.mishearing import MISHEARING
from kille.dialogue.games.tutoring_cost import ASKED, CORRECTED
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    is_denial,
    set_to,
    word_of,
)
from kille.dialogue.reference import roles_in, things_in
from kille.dialogue.reference.salience import notice, notice_in_view
from kille.dialogue.rules import rule
from kille.dialogue.speech_hypotheses import FAINTLY, weigh_readings
from kille.dialogue.taxonomy import nouns_in, under_kinds
from ttr import Model, Pred, Record, RecordType, replace
from ttr.updates import NBest, first, maybe, seq

# --- seeing --------------------------------------------------------------------------


@rule(when="State", on="Seen")
def see(s: Record, seen: Record) -> Record:
    """What is in view is what the latest look shows, and the robot has the floor."""
    return state_after_look(s, seen)


@rule(when="State", on="Glance")
def glance(s: Record, seen: Record) -> Record:
    """What is in view is what the latest look shows, while the tutor has the floor."""
    return state_after_look(s, seen)


def state_after_look(s: Record, seen: Record) -> Record:
    """The state after a look: talk is about what is shown, and not about what is gone.

    Talk turns to what the tutor points at, or else to the one thing that is new if it
    is the nearest as well; if it is not, it is open which of them "this" is. A question
    about what is gone is dropped.
    """
    view = seen.view
    before = {*s.view.things} & {*seen.kept}
    new = [x for x in view.things if x not in before]
    changed = view.focus if view.focus != s.view.focus else ()
    pointed = view.pointed if view.pointed != s.view.pointed else ()
    turned_to = () if len(new) > 1 else changed or pointed
    topic = () if new else [x for x in s.shared.topic if x in seen.kept]
    shown = _first(turned_to, pointed)
    salient = _first(turned_to, (x for x in s.shared.salient if x in seen.kept))
    turned = tuple(it for it in s.shared.turned if it.x in seen.kept)
    asked = [it for it in s.private.asked if set(it.things) <= set(seen.kept)]
    qud = [it for it in s.shared.qud if _things_of(it) <= set(seen.kept)]
    changes = {
        "view": view,
        "private.asked": asked,
        "shared.qud": qud,
        "shared.salient": salient,
        "shared.topic": turned_to or topic,
        "shared.shown": [x for x in s.shared.shown if x in seen.kept],
        "shared.turned": turned,
        "shared.here": keep_claims(s.shared.here, seen.kept),
        "shared.sights": seen.sights if "sights" in seen else (),
        "shared.noticed": notice_in_view(s, shown, new, seen.kept),
    }
    return replace(s, changes)


def _things_of(issue: Record) -> set[str]:
    """The things that the options of a question are about."""
    return {x for option in issue.options for x in things_in(option.content)}


def _first(ahead: Iterable[str], rest: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys((*ahead, *rest)))


# --- hearing -------------------------------------------------------------------------


@rule(when="State", on="Heard", p=FAINTLY)
def hear(
    s: Record, said: Record, *, nbest: object, model: Model, types: DialogueTypes
) -> Record:
    """What the tutor says is the latest move: the likeliest of what it may be."""
    if isinstance(nbest, NBest):
        said = weigh_readings(s, model, nbest, types=types)[0].said
    cost = s.private.cost
    changes = {
        "private.agenda": (),
        "private.beliefs": (),
        "private.cost.turns": cost.turns + 1.0,
        "private.cost.words": cost.words + len(said.text.split()),
        "shared.latest": said,
    }
    if s.private.news and not s.shared.floor:
        changes["private.news"] = ()  # the tutor has taken the turn
    return replace(s, changes)


# --- saying --------------------------------------------------------------------------


@rule(when="State", on="Said")
def say(s: Record, said: Record, *, types: DialogueTypes) -> Record:
    """What the robot has said is the latest move, and off its agenda."""
    agenda, last = s.private.agenda, s.private.last
    roles = roles_in(said.content)
    changes = {
        "private.agenda": agenda[1:],
        "private.last": last
        if agenda[0] in last
        else _repeatable_moves(agenda, said, types=types),
        "shared.latest": said,
        "shared.here": claims_here(s, said, types=types),
        "shared.topic": tuple(roles) or s.shared.topic,
        "shared.noticed": notice(s.shared.noticed, roles, s.private.cost.turns),
    }
    if s.shared.cut and not agenda[0] <= types["Wait"]:
        changes["shared.cut"] = ()  # it has said something else
    return replace(s, changes)


def _repeatable_moves(
    agenda: Sequence[RecordType], said: Record, *, types: DialogueTypes
) -> Sequence[RecordType]:
    """The planned moves, as they can be said again: what was undone stays the same."""
    planned, *others = agenda
    if not said.undoes:
        return agenda
    none, undone = (
        types.record_type("Said")["undoes"] @ (),
        types.record_type("Said")["undone"] @ said.undone,
    )
    return (set_to(planned, undoes=none, undone=undone), *others)


@rule(when="State", on="Said")
def keep(
    s: Record, said: Record, *, model: Model, types: DialogueTypes
) -> tuple[Record, Model] | None:
    """What was learned is known and agreed on; what was unlearned is neither."""
    undone = said.undone if said.undoes else ()
    learned = said.teaches or said.classifies or said.weighs
    if not (learned or said.forgets or said.drops or undone):
        return None
    state = s
    keys = said.keys or _free_keys(s, len(said.teaches))
    for content, key in zip(said.teaches, keys, strict=True):
        state = _add_lesson(state, key, content, said.signs)
    state = _remove_kinds(_remove_lessons(state, said), s, said)
    state = _remove_criteria(state, s, said)
    keys = said.kinds or _free_keys(state, len(said.classifies), "kind")
    for content, key in zip(said.classifies, keys, strict=True):
        state = _add_kind(state, key, content, said.signs)
    keys = said.criteria or _free_keys(state, len(said.weighs), "criterion")
    for content, key in zip(said.weighs, keys, strict=True):
        state = _add_criterion(state, key, content, said.signs)
    return state, under_kinds(model, state.private.kinds, types=types)


def _free_keys(s: Record, number: int, stem: str = "lesson") -> list[str]:
    """Keys that no lesson has, where no memory has given any."""
    private = s.private
    lessons = (*private.lessons, *private.kinds, *private.criteria)
    taken = {lesson.key for lesson in lessons}
    free = (f"{stem}{n}" for n in count(1) if f"{stem}{n}" not in taken)
    return list(islice(free, number))


def _add_lesson(
    s: Record, key: str, content: RecordType, signs: Iterable[Record]
) -> Record:
    sign = next(it for it in signs if claims(content, it))
    agreed = s.shared.commitments
    news = () if content in agreed else (content,)
    lesson = {"key": key, "sign": sign, "content": content}
    changes = {
        "private.lessons": (*s.private.lessons, lesson),
        "shared.commitments": agreed + news,
    }
    if not is_denial(content) and not knows_word(s, sign):
        kind = f"private.{sign.kind}s"
        changes[kind] = (*s.private[f"{sign.kind}s"], sign)
    return replace(s, changes)


def _add_kind(
    s: Record, key: str, content: RecordType, signs: Sequence[Record]
) -> Record:
    """The state in which one kind of thing is a kind of another."""
    nouns = nouns_in(content, signs)
    new = [it for it in nouns if not knows(s.private.nouns, it)]
    kind = {
        "key": key,
        "signs": nouns,
        "content": content,
        "new": new,
        "after": float(len(s.private.lessons)),
    }
    changes = {
        "private.kinds": (*s.private.kinds, kind),
        "private.nouns": (*s.private.nouns, *new),
    }
    return replace(s, changes)


def _add_criterion(
    s: Record, key: str, content: RecordType, signs: Sequence[Record]
) -> Record:
    """The state in which the things of a kind are known by this."""
    criterion = {
        "key": key,
        "signs": signs_in(content, signs),
        "content": content,
        "after": float(len(s.private.lessons)),
    }
    return replace(s, {"private.criteria": (*s.private.criteria, criterion)})


def _remove_criteria(s: Record, before: Record, said: Record) -> Record:
    """The state without the criteria that are taken back."""
    if not s.private.criteria:
        return s
    gone = _keys_gone(said)
    left = [it for it in s.private.criteria if it.key not in gone]
    return replace(s, {"private.criteria": _after_fewer(left, before, gone)})


def _after_fewer(
    kept: Sequence[Record], before: Record, gone: set[str]
) -> list[Record]:
    """What was taught after some lessons, of which fewer are left."""
    stay = [it.key not in gone for it in before.private.lessons]
    return [
        replace(it, after=float(sum(stay[: int(it.after)]))) if it.after > 0.0 else it
        for it in kept
    ]


def _remove_kinds(s: Record, before: Record, said: Record) -> Record:
    """The state without the axioms that are taken back, and without their own words."""
    if not s.private.kinds:
        return s
    gone = _keys_gone(said)
    left = [it for it in s.private.kinds if it.key not in gone]
    kinds = _after_fewer(left, before, gone)
    used = [
        *(sign for it in left for sign in it.signs),
        *(it.sign for it in (*s.private.lessons, *s.private.taught)),
    ]
    lost = [
        sign
        for it in s.private.kinds
        if it.key in gone
        for sign in it.new
        if not knows(used, sign)
    ]
    nouns = [it for it in s.private.nouns if not knows(lost, it)]
    return replace(s, {"private.kinds": kinds, "private.nouns": nouns})


def _keys_gone(said: Record) -> set[str]:
    """The keys of all that a move unlearns."""
    return {*said.forgets, *said.dropped, *(it.key for it in said.undone)}


def _remove_lessons(s: Record, said: Record) -> Record:
    gone = _keys_gone(said)
    if not (gone or said.lost or said.drops):
        return s
    lessons = [it for it in s.private.lessons if it.key not in gone]
    kept = {it.content for it in lessons}
    unlearned = {it.content for it in s.private.lessons if it.key in gone} - kept
    changes: dict[str, object] = {
        "private.lessons": lessons,
        "shared.commitments": [
            it for it in s.shared.commitments if it not in unlearned
        ],
        "private.taught": _earlier_lessons(s, said),
        "shared.here": [it for it in s.shared.here if it not in unlearned],
    }
    classified = [
        sign for it in s.private.kinds if it.key not in gone for sign in it.signs
    ]
    lost = [it for it in said.lost if not knows(classified, it)]
    for kind in {sign.kind for sign in lost}:
        known = s.private[f"{kind}s"]
        changes[f"private.{kind}s"] = [it for it in known if not knows(lost, it)]
    return replace(s, changes)


def _earlier_lessons(s: Record, said: Record) -> list[Record]:
    """How often words were taught before this dialogue, without forgotten lessons."""
    fewer = Counter[Pred]()
    for it in said.undone:
        fewer[word_of(it.sign)] += it.examples
    less = (
        replace(it, lessons=it.lessons - fewer[word_of(it.sign)])
        for it in s.private.taught
    )
    return [it for it in less if it.lessons > 0.0 and not knows(said.drops, it.sign)]


# --- the algorithms ------------------------------------------------------------------

SEEN = see
GLANCED = glance
LISTENING = seq(maybe(ATTENDING), hear, maybe(first(MISHEARING, CORRECTED)))
SAID = seq(say, maybe(keep), maybe(ASKED))
