"""A tutor who explores all moves: what they say and do next, by the state of the talk.

They know the simulated world. When they are asked something they mostly answer; else
they teach, ask, confirm, correct, point, forget, talk nonsense, and move things.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache, partial

from hypothesis import strategies as st

from kille.dialogue.meanings import DialogueTypes, word_of
from kille.dialogue.state import words as words_of
from kille.lab.tutors.answering import choices, lesson_act, sayings_anywhere, verdicts
from kille.lab.tutors.follow_ups import follow_ups, sudden_events
from kille.lab.tutors.happenings import sample_happenings, sample_idle_looks
from kille.lab.tutors.heard_sayings import (
    IN_PARTS,
    NONSENSE,
    event_or_text,
    sample_asides,
    sample_misspelt,
    sample_texts,
    sample_unclear,
)
from kille.lab.tutors.leading_kinds import kind_situation, kind_topics
from kille.lab.tutors.leading_topics import Situation, leading_topics, situation
from kille.lab.worlds.asides import asides
from kille.lab.worlds.games import world_of
from kille.lab.worlds.sayings import Saying, WorldTalk
from kille.lab.worlds.vocabulary import Vocabulary, vocabulary
from kille.lab.worlds.worlds import World
from ttr import Model, Pred, Record
from ttr.aliases import former_names
from ttr.testing.strategies import Tutor

__getattr__ = former_names(__name__, {"tutoring": "exploring_tutor"})

OTHERS = 5
"""How often it is not clear what was said, and something happens, as each move is."""

KINDS = 2
"""How often kinds are talked of, as is any other thing that leads on."""

FOLLOWING = 12
"""As often as one in so many times each thing that follows up is said."""

TRIED = ("several", "in_doubt", "of_kinds", "supposed", "attending")
"""What may be tried at any time, in words of its own."""

Options = Sequence[object]
Sayings = Sequence[Saying]


def exploring_tutor(
    language: str = "en", types: DialogueTypes | None = None, **shares: float
) -> Tutor:
    """A tutor who speaks a language, by default as the packaged theory has it.

    `shares` are those of `ttr.testing.Tutor`.
    """
    words = vocabulary(language, types)
    for act in IN_PARTS:  # they are read now, and not while dialogues are drawn
        for one in sayings_anywhere(WorldTalk(words, World()), act):
            event_or_text(one)
    moves, replies = partial(_moves, words), partial(_replies, words)
    return Tutor(moves=moves, replies=replies, **shares)


def _moves(words: Vocabulary, s: Record, model: Model) -> Options:
    """All that may be said or done, each kind of thing as often as any other."""
    talk = WorldTalk(words, world_of(s))
    happening = sample_happenings(talk.world)
    return [*_all_options(talk.without_glance()), *[happening] * OTHERS]


@lru_cache(256)
def _all_options(talk: WorldTalk) -> Options:
    """All that may be said, clearly or not."""
    everything = _all(talk)
    unclear = [sample_unclear(everything)] * OTHERS
    return [*map(sample_texts, everything), *unclear, st.sampled_from(NONSENSE)]


def _all(talk: WorldTalk) -> Sequence[Sayings]:
    """All that may be said, move by move."""
    said = (talk.sayings(act) for act in talk.acts)
    return [one for one in said if one]


def _replies(words: Vocabulary, s: Record, model: Model) -> Options:
    """Answers to what the robot has said, or else lessons and questions.

    Now and then they follow up what it said, or something happens.
    """
    talk = WorldTalk(words, world_of(s))
    options = _answers(talk, s) or _openings(words, talk, s)
    often = len(options) // FOLLOWING + 1
    following, sudden = [*follow_ups(talk, s)], [*sudden_events(talk, s)]
    return [*options, *following * often, *sudden * (often // 2 or 1)]


def _answers(talk: WorldTalk, s: Record) -> Options:
    """Answers to what the robot has asked or claimed, if it has."""
    if s.shared.qud:
        return [*choices(talk, s)] * 2
    if not s.shared.pending:
        return ()
    judging = verdicts(talk, s)
    leading = [*_leading_strategies(talk, s), sample_idle_looks(talk.world)]
    return [*judging, *judging, st.one_of(leading)]


def _openings(words: Vocabulary, talk: WorldTalk, s: Record) -> Options:
    """What a tutor says who was not asked anything.

    Half of it is what leads on from the state.
    """
    plain = talk.without_glance()
    known = frozenset(word_of(sign) for sign in words_of(s))
    happening = sample_happenings(talk.world)
    said = [*_free_options(plain, known), *[happening] * OTHERS]
    leading = [*_leading_strategies(talk, s), sample_idle_looks(talk.world)]
    return [*said, *leading * (len(said) // len(leading))]


def _leading_strategies(
    talk: WorldTalk, s: Record
) -> Sequence[st.SearchStrategy[object]]:
    """What leads on, topic by topic."""
    plain = talk.without_glance()
    kinds = [*map(sample_texts, kind_topics(kind_situation(plain, s)))]
    tried = (asides(talk.words, name, s.private.nouns) for name in TRIED)
    return [
        *_topic_strategies(situation(talk.words, s)),
        *kinds * KINDS,
        *(sample_asides(s, it) for it in tried if it),
    ]


@lru_cache(256)
def _topic_strategies(now: Situation) -> Sequence[st.SearchStrategy[object]]:
    """What leads on from a situation, topic by topic."""
    return [*map(sample_texts, leading_topics(now))]


@lru_cache(256)
def _free_options(talk: WorldTalk, known: frozenset[Pred]) -> Options:
    """What a tutor may say who was not asked anything, clearly or not."""
    free = _free(talk, known)
    unclear = [sample_unclear(free), sample_misspelt(free, known)]
    return [*map(sample_texts, free), *unclear * OTHERS]


def _free(talk: WorldTalk, known: frozenset[Pred]) -> Sequence[Sayings]:
    """What a tutor may say who was not asked anything, mostly in words that are known.

    A third of it are lessons.
    """
    everything = [
        [it for it in said if known.issuperset(map(word_of, it.about.signs))] or said
        for said in _all(talk)
    ]
    if talk.world.attended_thing is None:
        return everything
    lessons = [
        talk.say(lesson_act(claim), claim)
        for phrase in talk.phrases(talk.world.attended_thing)
        for claim in talk.true_claims(talk.world.attended_thing, phrase)
        if known.issuperset(map(word_of, (*phrase.signs, *claim.landmark.signs)))
    ]
    return [*everything, *[lessons] * (len(everything) // 2)]
