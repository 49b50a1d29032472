"""What follows up what the robot has just said: to take it back, or to have it go on.

That can be said once only, straight after. So it is drawn more often than what leads on
to something at any time.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from hypothesis import strategies as st

from kille.dialogue.answered_questions import NAMING_ACTS, last_act
from kille.dialogue.games.confirming import JUST_LEARNED
from kille.dialogue.games.criticising import TOLD as CRITERIA_TOLD
from kille.dialogue.games.kinds_of_kinds import TOLD as KINDS_TOLD
from kille.lab.tutors.answering import (
    PAIR,
    bare_sayings,
    sayings_anywhere,
    taking_back,
    yes_or_no,
)
from kille.lab.tutors.happenings import interruptions, sample_silences
from kille.lab.tutors.heard_sayings import sample_asides, sample_texts
from kille.lab.tutors.leading_kinds import kind_situation, topics_about_known_kinds
from kille.lab.tutors.leading_perspectives import perspectives_by_side
from kille.lab.worlds.asides import Aside, asides
from kille.lab.worlds.sayings import Claim, Saying, WorldTalk
from ttr import Record

Options = Sequence[st.SearchStrategy[object]]

TOLD = frozenset((*KINDS_TOLD, *CRITERIA_TOLD, "unlearned_kind"))
"""What the robot says of kinds, which may be taken back, or asked about."""

ASKING_BACK = ("ask_why", "ask_certainty", "ask_so", "ask_guess", "deny")
"""What one may ask about anything that was said, or say against it."""

LIVELY = 4
"""How often nobody speaks to a robot that speaks then, as it is cut off."""


def follow_ups(talk: WorldTalk, s: Record) -> Options:
    """What follows up what the robot has said, as strategies."""
    said = [*_sayings(talk, s)]
    if not s.shared.pending and not s.shared.qud:
        said += [_questions(talk, s)]
        said += topics_about_known_kinds(kind_situation(talk.without_glance(), s))
    said_so = map(sample_texts, filter(None, said))
    tried = (sample_asides(s, it) for it in _asides(talk, s) if it)
    return [*said_so, *tried]


def _sayings(talk: WorldTalk, s: Record) -> Iterator[Sequence[Saying]]:
    """What may be said of what the robot has just said, as a move."""
    last = last_act(s)
    if s.shared.cut:
        yield sayings_anywhere(talk, "release_floor")
    if last in TOLD:
        yield [*sayings_anywhere(talk, "deny"), *bare_sayings(talk, "ask_why")]
        yield taking_back(talk)
    elif last in JUST_LEARNED or not last:
        yield taking_back(talk)
    elif not s.shared.qud:
        yield [it for act in ASKING_BACK for it in bare_sayings(talk, act)]
    if last == "admit_whether":
        yield from [yes_or_no(talk)] * 2
    if not s.shared.qud:
        yield talk.sayings("mention")
    if s.shared.turned:
        yield [*perspectives_by_side(talk), *sayings_anywhere(talk, "ask_whose")]


def _questions(talk: WorldTalk, s: Record) -> Sequence[Saying]:
    """What things are, where it matters that the robot says that by itself."""
    if not s.private.taught and len(talk.world.in_view) != PAIR:
        return ()
    phrases = (talk.phrases(x)[0] for x in talk.world.in_view)
    return [talk.say("ask_name", Claim(None, phrase)) for phrase in phrases]


def _asides(talk: WorldTalk, s: Record) -> Iterator[Sequence[Aside]]:
    """What may be tried after what the robot has just said."""
    last, words = last_act(s), talk.words
    if s.shared.pending:
        yield asides(words, "of_cue")
        yield asides(words, "other")
    if len(talk.world.in_view) == 1:
        yield asides(words, "alone")
    if last == "unknown_noun":
        yield asides(words, "all")
    if last == "ask_again":
        yield asides(words, "conceding")
    if last in JUST_LEARNED:
        yield asides(words, "of_other", [it.sign for it in s.private.lessons[-1:]])
    if last in NAMING_ACTS and len(talk.world.in_view) == PAIR:
        yield asides(words, "reversed")


def sudden_events(talk: WorldTalk, s: Record) -> Options:
    """What may happen that nobody says: the robot is cut off, or nobody speaks."""
    found: list[st.SearchStrategy[object]] = []
    if cut := interruptions(s):
        found.append(st.sampled_from(cut))
    if s.private.strategy.turns.ask:
        found += [sample_silences(talk.world)] * LIVELY
    return found
