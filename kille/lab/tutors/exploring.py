"""A tutor who explores all moves: what they say and do next, by the state of the talk.

They know the simulated world. When they are asked something they mostly answer; else
they teach, ask, confirm, correct, point, forget, talk nonsense, and move things.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache, partial
from itertools import chain, product
from random import Random

from hypothesis import strategies as st

from kille.dialogue.language import understand
from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    is_denial,
    value_at,
    word_of,
)
from kille.dialogue.robust_reading import situations
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.dialogue.tutoring import hear_sentences
from kille.lab.tutors.leading_topics import (
    Situation,
    leading_topics,
    perspectives_by_side,
    situation,
)
from kille.lab.worlds.games import world_of
from kille.lab.worlds.perception import glance_event, look_event, number_of
from kille.lab.worlds.sayings import (
    LESSON_ACTS,
    NOTHING,
    THIS,
    Claim,
    Saying,
    WorldTalk,
)
from kille.lab.worlds.vocabulary import Vocabulary, vocabulary
from kille.lab.worlds.worlds import World
from ttr import Model, Pred, Record, RecordType
from ttr.aliases import former_names
from ttr.testing.strategies import Tutor
from ttr.types import Negation, PType

__getattr__ = former_names(__name__, {"tutoring": "exploring_tutor"})

NONSENSE = (
    "",
    "?!",
    "Colourless green ideas sleep furiously.",
    "no no no",
    "You are stupid.",
    "import os; os.remove('x')",
    "[x : Ind, c : cup(x)]",
    "☃" * 30,
    "This is a",
    "Where is the cupp?",
    "Is this a muug?",
    "Forget bokk.",
    "cup " * 90,
)
"""What means nothing in any grammar."""

IN_PARTS = (
    "ask_deed",
    "ask_beyond",
    "ask_difference",
    "ask_part",
    "define",
    "ask_self",
    "remark",
    "tell_use",
    "ask_guess",
    "ask_whose",
    "agree_partly",
    "forget_about",
    "correct_thing",
    "attend",
)
"""The moves that are understood in a part of a sentence only."""

OTHERS = 5
"""How often it is not clear what was said, and something happens, as each move is."""

CERTAINTIES = ((0.9, 0.05), (0.5, 0.4), (0.2, 0.1), (0.05, 0.02))
"""How probable it is that the one, and the other, of two things was said."""

Options = Sequence[object]
Sayings = Sequence[Saying]
Look = tuple[Callable[[World, World], Record], World]


def exploring_tutor(
    language: str = "en", types: DialogueTypes | None = None, **shares: float
) -> Tutor:
    """A tutor who speaks a language, by default as the packaged theory has it.

    `shares` are those of `ttr.testing.Tutor`.
    """
    words = vocabulary(language, types)
    for act in IN_PARTS:  # they are read now, and not while dialogues are drawn
        for one in _worldless_sayings(WorldTalk(words, World()), act):
            event_or_text(one)
    moves, replies = partial(_moves, words), partial(_replies, words)
    return Tutor(moves=moves, replies=replies, **shares)


def _moves(words: Vocabulary, s: Record, model: Model) -> Options:
    """All that may be said or done, each kind of thing as often as any other."""
    talk = WorldTalk(words, world_of(s))
    happening = _sample_happenings(talk.world)
    return [*_all_options(talk.without_glance()), *[happening] * OTHERS]


@lru_cache(256)
def _all_options(talk: WorldTalk) -> Options:
    """All that may be said, clearly or not."""
    everything = _all(talk)
    unclear = [_sample_unclear(everything)] * OTHERS
    return [*map(_sample_texts, everything), *unclear, st.sampled_from(NONSENSE)]


def _all(talk: WorldTalk) -> Sequence[Sayings]:
    """All that may be said, move by move."""
    said = (talk.sayings(act) for act in talk.acts)
    return [one for one in said if one]


def _replies(words: Vocabulary, s: Record, model: Model) -> Options:
    """Answers to what the robot has said, or else lessons and questions.

    Half of what needs no answer is what leads on from the state.
    """
    talk = WorldTalk(words, world_of(s))
    if s.shared.qud:
        return _choice_options(talk, s.shared.qud[0].ask)
    now = situation(words, s)
    leading = [*_leading_strategies(now), _sample_idle_looks(talk.world)]
    if s.shared.pending:
        judging = _verdict_options(talk, s.shared.pending)
        return [*judging, *judging, st.one_of(leading)]
    happening = _sample_happenings(talk.world)
    said = [*_free_options(now.talk, now.known), *[happening] * OTHERS]
    return [*said, *leading * (len(said) // len(leading))]


@lru_cache(256)
def _leading_strategies(now: Situation) -> Sequence[st.SearchStrategy[object]]:
    """What leads on, topic by topic."""
    return [*map(_sample_texts, leading_topics(now))]


@lru_cache(256)
def _free_options(talk: WorldTalk, known: frozenset[Pred]) -> Options:
    """What a tutor may say who was not asked anything, clearly or not."""
    free = _free(talk, known)
    unclear = [_sample_unclear(free), _sample_misspelt(free, known)]
    return [*map(_sample_texts, free), *unclear * OTHERS]


def _free(talk: WorldTalk, known: frozenset[Pred]) -> Sequence[Sayings]:
    """What a tutor may say who was not asked anything, mostly in words that are known.

    Half of it are lessons.
    """
    everything = [
        [it for it in said if known.issuperset(map(word_of, it.about.signs))] or said
        for said in _all(talk)
    ]
    if talk.world.attended_thing is None:
        return everything
    lessons = [
        talk.say(_lesson_act(claim), claim)
        for phrase in talk.phrases(talk.world.attended_thing)
        for claim in talk.true_claims(talk.world.attended_thing, phrase)
        if known.issuperset(map(word_of, (*phrase.signs, *claim.landmark.signs)))
    ]
    return [*everything, *[lessons] * len(everything)]


def _verdict_options(talk: WorldTalk, pending: Sequence[RecordType]) -> Options:
    """Judgements of what the robot claims: yes if it is true, no if it is not.

    What is not so is mostly corrected. Now and then they err.
    """
    true = [claim for claim in pending if is_true(talk, claim)]
    agreeing = _sample_texts(_worldless_sayings(talk, "affirm" if true else "deny"))
    erring = _sample_texts(_worldless_sayings(talk, "deny" if true else "affirm"))
    asking = [_sample_texts(_worldless_sayings(talk, act)) for act in _WONDERING]
    if _label(pending[0]) == "rel":
        asking.append(_sample_texts(perspectives_by_side(talk)))
    if true and len(pending) == 1:
        return [agreeing, agreeing, erring, *asking]
    right = list(_corrections(talk, pending[0]))
    return [agreeing, erring, *asking, *[_sample_texts(right)] * (3 if right else 0)]


_WONDERING = ("ask_certainty", "ask_why")
"""What one may ask about a claim."""


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
                    yield talk.say(_lesson_act(claim), claim)


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


def _lesson_act(claim: Claim) -> str:
    """The move that teaches a claim."""
    assert claim.sign is not None
    return LESSON_ACTS[claim.sign.kind]


def _choice_options(talk: WorldTalk, asked: str) -> Options:
    """Which of several moves was meant: in words, by pointing, or none of them."""
    agreeing = [it for act in _YES_OR_NO for it in _worldless_sayings(talk, act)]
    settling = _plain_answers(talk, asked)
    mentions = talk.sayings("mention")
    pointing = [(glance_event, talk.world.point_at(x)) for x in talk.world.in_view]
    return [
        _sample_texts(agreeing),
        _sample_texts(settling),
        _sample_texts(settling),
        _sample_texts([it for it in mentions if len(it.about.signs) == 1]),
        *([_sample_looks(talk.world, pointing)] if pointing else []),
    ]


_YES_OR_NO = ("affirm", "deny")


def _plain_answers(talk: WorldTalk, asked: str) -> Sayings:
    """What plainly answers a question of the robot's."""
    match asked:
        case "AskFrame":
            return perspectives_by_side(talk)
        case (
            "OfferWord"
            | "AskHeard"
            | "AskKind"
            | "AskHow"
            | "AskBoth"
            | "AskKindStill"
            | "AskForget"
            | "AskEvery"
            | "AskOnly"
            | "AskSwapped"
        ):
            return [it for act in _YES_OR_NO for it in _worldless_sayings(talk, act)]
        case "AskEarlier":
            preferring = ("prefer_now", "prefer_earlier")
            return [it for act in preferring for it in _worldless_sayings(talk, act)]
    return talk.sayings("mention")


def _worldless_sayings(talk: WorldTalk, act: str) -> Sayings:
    return WorldTalk(talk.words, World()).sayings(act)


def _sample_texts(options: Sayings) -> st.SearchStrategy[object]:
    """Sample one of these, as a text, or as an event."""
    return st.sampled_from(options).map(event_or_text)


@lru_cache(256)
def event_or_text(one: Saying) -> object:
    """The text of what is said, or its event where only its parts are understood."""
    if one.act not in IN_PARTS:
        return one.text
    language, types = one.words.language, one.words.types
    sentences = understand(one.text, language, types=types)
    around = situations.Situation(things=1)
    heard = hear_in_parts(sentences, around, language, types=types)
    return hear_sentences(*heard.moves[:1])


def _sample_unclear(said: Sequence[Sayings]) -> st.SearchStrategy[object]:
    """Sample events in which one of two texts was heard."""
    said = [them for them in said if them[0].act not in IN_PARTS]
    random = Random(len(said))
    pairs = [
        (random.choice(random.choice(said)), random.choice(random.choice(said)), p)
        for p in CERTAINTIES
        for _ in said
    ]
    return st.sampled_from(pairs).map(_either)


def _either(mumbled: tuple[Saying, Saying, tuple[float, float]]) -> object:
    """The event that one of two texts was heard, each so probable."""
    *both, p = mumbled
    sentences = [
        understand(one.text, one.words.language, types=one.words.types)[0]
        for one in both
    ]
    return hear_sentences(*sentences, p=p)


def _sample_misspelt(
    said: Sequence[Sayings], known: frozenset[Pred]
) -> st.SearchStrategy[str]:
    """Sample questions with a word that is nearly one that the robot knows."""
    asked = [
        one for them in said for one in them if one.act in ("ask_place", "ask_find")
    ]
    pairs = [
        (one, sign.form)
        for one in asked
        for sign in one.about.signs
        if sign.kind == "noun" and word_of(sign) in known
    ]
    if not pairs:
        return st.sampled_from(NONSENSE)
    return st.sampled_from(pairs).map(lambda it: it[0].text.replace(it[1], f"{it[1]}q"))


# --- what happens in the world -------------------------------------------------------


def _sample_happenings(world: World) -> st.SearchStrategy[Record]:
    """Sample something that may happen, as the event in which it is seen.

    Each kind of thing happens as often as any other.
    """
    looks = (glance_event, look_event)
    kinds = [_sample_looks(world, list(product(looks, it))) for it in _kinds(world)]
    return st.one_of(kinds)


def _sample_idle_looks(world: World) -> st.SearchStrategy[Record]:
    """Sample looks on the robot's own turn: all is as it was, or has changed.

    What is pointed at is the tutor's to speak of.
    """
    changed = [it for it in happenings(world) if it.focus == world.focus]
    return _sample_looks(
        world, [(look_event, it) for it in (world.look_again(), *changed)]
    )


def _sample_looks(world: World, after: Sequence[Look]) -> st.SearchStrategy[Record]:
    """Sample one of these looks, as an event."""
    return st.sampled_from(after).map(lambda one: one[0](one[1], world))


def happenings(world: World) -> tuple[World, ...]:
    """What may become of a world: things are put, taken, moved, pointed at."""
    return tuple(chain.from_iterable(_kinds(world)))


@lru_cache(256)
def _kinds(world: World) -> Sequence[Sequence[World]]:
    """What may become of a world, kind by kind."""
    random = Random(world.name)
    free = list(world.free_places())
    hidden = [n for n in range(1, len(world.things) + 1) if n not in world.in_view]
    kinds = [
        [world.look_again()],
        [world.flip_depth()],
        [world.clear()],
        [world.point_at(number) for number in world.in_view],
        [world.move(number, random.choice(free)) for number in hidden],
    ]
    if world.in_view:
        one, other = random.choices(world.in_view, k=2)
        kinds += [[world.move(one, None)], [world.move(other, random.choice(free))]]
    return tuple(kind for kind in kinds if kind)
