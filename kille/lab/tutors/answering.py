"""What a tutor answers: whether the robot's claims are true, and what it asks about.

They mostly know what is so, and say it; now and then they err, wonder, or point.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from kille.dialogue.meanings import (
    CLAIMS,
    claims,
    is_denial,
    value_at,
    word_of,
)
from kille.dialogue.taxonomy import LOWER
from kille.lab.tutors.happenings import sample_looks
from kille.lab.tutors.heard_sayings import sample_asides, sample_texts
from kille.lab.tutors.leading_perspectives import perspectives_by_side
from kille.lab.tutors.question_answers import EITHER, WHICH, YES_OR_NO
from kille.lab.worlds.asides import asides
from kille.lab.worlds.perception import glance_event, number_of
from kille.lab.worlds.sayings import (
    LESSON_ACTS,
    NOTHING,
    THIS,
    Claim,
    Matter,
    Saying,
    WorldTalk,
    subsumption_matter,
)
from kille.lab.worlds.worlds import World
from ttr import Record, RecordType
from ttr.types import Negation, PType

Options = Sequence[object]
Sayings = Sequence[Saying]


# --- claims --------------------------------------------------------------------------


def verdicts(talk: WorldTalk, s: Record) -> Options:
    """Judgements of what the robot claims: yes if it is true, no if it is not.

    What is not so is mostly corrected. Now and then they err, and what was taught on
    another day they have forgotten.
    """
    earlier = [sample_texts(taking_back(talk))] * 2 if s.private.taught else ()
    return [*_judgements(talk, s.shared.pending), *earlier]


def _judgements(talk: WorldTalk, pending: Sequence[RecordType]) -> Options:
    """What one may say who is told something: that it is so, or what is."""
    true = [claim for claim in pending if is_true(talk, claim)]
    agreeing = sample_texts(sayings_anywhere(talk, "affirm" if true else "deny"))
    erring = sample_texts(sayings_anywhere(talk, "deny" if true else "affirm"))
    asking = [sample_texts(bare_sayings(talk, act)) for act in _WONDERING]
    if _label(pending[0]) == "rel":
        asking.append(sample_texts(perspectives_by_side(talk)))
    if true and len(pending) == 1:
        return [agreeing, agreeing, erring, *asking]
    right = list(_corrections(talk, pending[0]))
    return [agreeing, erring, *asking, *[sample_texts(right)] * (3 if right else 0)]


_WONDERING = ("ask_certainty", "ask_why", "agree_partly", "forget_that")
"""What one may ask about a claim, or say that decides nothing."""


def _corrections(talk: WorldTalk, content: RecordType) -> Iterator[Saying]:
    """What is true instead of a claim, as a correction or as a lesson."""
    x = number_of(str(value_at(_part_of(content, "target"), "x")))
    if x not in talk.world:
        return
    label = _label(content)
    shortly = [] if label == "rel" else [NOTHING]
    for phrase in (THIS, *talk.phrases(x), *shortly):
        for claim in talk.true_claims(x, phrase):
            if _label(claim.content(talk.words.types)) == label:
                yield talk.say("correct", claim)
                if phrase is not NOTHING:
                    yield talk.say(lesson_act(claim), claim)


def is_true(talk: WorldTalk, content: RecordType) -> bool:
    """Whether a claim is true of the world, as the tutor sees it."""
    x = number_of(str(value_at(_part_of(content, "target"), "x")))
    if x not in talk.world:
        return False
    label = _label(content)
    signs: Iterable[Record | None] = talk.words_of(x)
    if label == "rel":
        y = number_of(str(value_at(_part_of(content, "landmark"), "x")))
        front = str(value_at(content, "frame"))
        signs = [talk.relation(x, y, front)] if y in talk.world else []
    claim = content[label]
    said = claim.body if isinstance(claim, Negation) else claim
    assert isinstance(said, PType)
    so = any(sign is not None and word_of(sign) is said.pred for sign in signs)
    return so is not is_denial(content)


def _label(content: RecordType) -> str:
    """The label of what a content claims."""
    return next(label for label in CLAIMS if label in content)


def _part_of(content: RecordType, label: str) -> RecordType:
    part = content[label]
    assert isinstance(part, RecordType)
    return part


def lesson_act(claim: Claim) -> str:
    """The move that teaches a claim."""
    assert claim.sign is not None
    return LESSON_ACTS[claim.sign.kind]


# --- questions -----------------------------------------------------------------------


PAIR = 2
"""Of so many things each may be what was said of the other."""


def choices(talk: WorldTalk, s: Record) -> Options:
    """Which of several moves was meant: in words, by pointing, or none of them."""
    asked = s.shared.qud[0]
    settling = sample_texts(_plain_answers(talk, asked))
    options = [
        sample_texts(yes_or_no(talk)),
        *[settling] * 3,
        sample_texts(taking_back(talk)),
    ]
    if len(asked.options) == PAIR:
        swapped = asides(talk.words, "reversed")
        options += [sample_asides(s, swapped)] if swapped else []
    return [*options, *_mentions(talk, s)] if asked.ask in WHICH else options


def _mentions(talk: WorldTalk, s: Record) -> Options:
    """Which thing is meant, or is not: in words, and by pointing."""
    mentions = [it for it in talk.sayings("mention") if len(it.about.signs) == 1]
    pointing = [(glance_event, talk.world.point_at(x)) for x in talk.world.in_view]
    which = (asides(talk.words, name) for name in ("all", "other"))
    return [
        sample_texts(mentions),
        *([sample_looks(talk.world, pointing)] if pointing else []),
        *(sample_asides(s, it) for it in which if it),
    ]


def yes_or_no(talk: WorldTalk) -> Sayings:
    """Yes, and no."""
    return [it for act in ("affirm", "deny") for it in sayings_anywhere(talk, act)]


def _plain_answers(talk: WorldTalk, asked: Record) -> Sayings:
    """What plainly answers a question of the robot's."""
    preferring = [
        it
        for act in ("prefer_now", "prefer_earlier")
        for it in sayings_anywhere(talk, act)
    ]
    if asked.ask == "AskFrame":
        return perspectives_by_side(talk)
    if asked.ask == "AskEarlier":
        return [*preferring, *_restatements(talk, asked)]
    if asked.ask in EITHER:
        judging = yes_or_no(talk) if asked.ask in YES_OR_NO else ()
        return [*judging, *preferring, *_names_again(talk, asked)]
    if asked.ask in YES_OR_NO or asked.ask == "AskHeard":
        return yes_or_no(talk)
    return talk.sayings("mention")


def _restatements(talk: WorldTalk, asked: Record) -> Sayings:
    """What was said now, or earlier, of two kinds, said again."""
    _, before = asked.options
    if LOWER not in before.content:
        return ()
    matter = subsumption_matter(*before.signs)
    return [talk.say(act, matter) for act in ("classify", "unclassify")]


def _names_again(talk: WorldTalk, asked: Record) -> Sayings:
    """Each of two nouns that a thing was called by, as a lesson or a correction."""
    nouns = talk.words.nouns.values()
    found = [it for it in nouns if any(claims(o.content, it) for o in asked.options)]
    acts = ("instruct", "correct")
    return [talk.say(act, Claim(sign, NOTHING)) for sign in found for act in acts]


def taking_back(talk: WorldTalk) -> Sayings:
    """What takes back what was said last, without saying what that was."""
    return [*bare_sayings(talk, "forget_that"), *sayings_anywhere(talk, "forget_last")]


def bare_sayings(talk: WorldTalk, act: str) -> Sayings:
    """Sayings about what was said last, which do not say so."""
    return [it for it in sayings_anywhere(talk, act) if it.about == Matter()]


def sayings_anywhere(talk: WorldTalk, act: str) -> Sayings:
    """What may be said as a move whatever there is in view."""
    return WorldTalk(talk.words, World()).sayings(act)
