"""What leads on: what a tutor may say by what the talk, as it is, makes possible.

Most of what may be said at any time leads to the same few answers. What is rarer has to
be prepared: a perspective is asked about only when a thing is known to face some way, a
rival is named only where two words were learned of like things. So it is here that a
state says what is worth trying in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import permutations, product
from typing import NamedTuple

from kille.dialogue.meanings import word_of
from kille.dialogue.reference import thing_at
from kille.dialogue.state import words as words_of
from kille.lab.worlds.games import world_of
from kille.lab.worlds.perception import number_of
from kille.lab.worlds.sayings import (
    Claim,
    Matter,
    Phrase,
    Saying,
    acts,
    colour_phrase,
    phrases_of,
    sayings,
    without_glance,
)
from kille.lab.worlds.vocabulary import Vocabulary
from kille.lab.worlds.worlds import World
from ttr import Pred, Record

Talk = Sequence[Saying]

OF_PLACES = ("relate", "correct", "reject", "ask_whether")
"""The moves that claim a relation, or ask for one."""


class Situation(NamedTuple):
    """The part of a state that decides what leads on from it.

    Things are numbers: `untold` are those in view of which nothing was said; `fronts`
    face some way that is known. `is_taught` says that it was just learned where
    something is beside one of these, `is_new` that the robot has said nothing yet.
    """

    words: Vocabulary
    world: World
    known: frozenset[Pred]
    untold: tuple[int, ...]
    fronts: tuple[tuple[int, str], ...]
    is_taught: bool
    is_new: bool


def situation(words: Vocabulary, s: Record) -> Situation:
    """The situation of a tutor who speaks this language."""
    told = {thing_at(it, "target") for it in s.shared.here}
    return Situation(
        words,
        without_glance(world_of(s)),
        frozenset(word_of(sign) for sign in words_of(s)),
        tuple(number_of(x) for x in s.view.things if x not in told),
        tuple((number_of(it.x), str(it.front)) for it in s.shared.turned),
        _is_of_turned(s),
        not s.private.last,
    )


def leading_topics(now: Situation) -> Sequence[Talk]:
    """What leads on from a situation, topic by topic."""
    words, world = now.words, now.world
    if now.is_taught:
        return [perspectives_by_side(words, world)]
    untold = [_name_questions(words, world, now.untold)] if now.untold else []
    unsaid = [sayings(words, "ask_repeat", world)] if now.is_new else []
    return [
        *_word_topics(words, world, now.known),
        *_front_topics(words, world, now.fronts),
        *untold * 2,
        *unsaid,
    ]


def _word_topics(
    words: Vocabulary, world: World, known: frozenset[Pred]
) -> Sequence[Talk]:
    """What can be talked of in the words that are known, and in one that is not."""
    found = [
        *_empty_table_topics(words, world, known),
        _knowledge_questions(words, world, known),
        _about_the_last(words, world),
        _name_questions(words, world, world.in_view),
        _questions_of_others(words, world),
        _reflexive_lessons(words, world),
        *_wrong_nouns(words, world, known),
        *_flat_place_topics(words, world),
        *_unknown_word_topics(words, world, known),
    ]
    return [talk for talk in found if talk]


SEVERAL = ("ask_places", "instruct_several")
"""The moves about all things of a kind."""


def _empty_table_topics(
    words: Vocabulary, world: World, known: frozenset[Pred]
) -> Iterator[Talk]:
    """What one may ask and say when nothing is in view."""
    if world.in_view:
        return
    yield sayings(words, "ask_view", world)
    for act in SEVERAL:
        said = sayings(words, act, world)
        yield [it for it in said if known.issuperset(map(word_of, it.about.signs))]


def _knowledge_questions(
    words: Vocabulary, world: World, known: frozenset[Pred]
) -> Talk:
    """What one may ask who knows nothing."""
    return () if known else sayings(words, "ask_knowledge", world)


BARE = ("ask_certainty", "ask_why", "forget_that")
"""The moves that may be about what was said last, without saying so."""


def _about_the_last(words: Vocabulary, world: World) -> Talk:
    """Sayings about what was said last."""
    said = (one for act in BARE for one in sayings(words, act, world))
    return [one for one in said if isinstance(one.about, Matter)]


def _name_questions(words: Vocabulary, world: World, things: Sequence[int]) -> Talk:
    """Questions what each of these things is."""
    phrases = (phrases_of(words, world, x)[0] for x in things)
    return [Saying(words, "ask_name", Claim(None, phrase)) for phrase in phrases]


def _questions_of_others(words: Vocabulary, world: World) -> Talk:
    """Questions about the other things than the one that was talked of."""
    other = Claim(None, Phrase("Other"))
    acts_ = ("ask_name", "ask_place") if len(world.in_view) > 1 else ()
    return [Saying(words, act, other) for act in acts_]


def _reflexive_lessons(words: Vocabulary, world: World) -> Talk:
    """Lessons that something stands beside itself."""
    left = words.relations["left"]
    ways = (phrases_of(words, world, x) for x in world.in_view)
    claims = (Claim(left, one, other) for one, *_, other in ways)
    return [Saying(words, "relate", claim) for claim in claims]


def _wrong_nouns(
    words: Vocabulary, world: World, known: frozenset[Pred]
) -> Iterator[Talk]:
    """Sayings that call a thing by a known noun of another kind."""
    nouns = [it for it in words.nouns.values() if word_of(it) in known]
    claims = [
        Claim(noun, colour_phrase(words, world, x))
        for x, noun in product(world.in_view, nouns)
        if noun != words.noun_of(world, x)
    ]
    for act in ("instruct", "ask_whether"):
        yield [Saying(words, act, claim) for claim in claims]


def _flat_place_topics(words: Vocabulary, world: World) -> Iterator[Talk]:
    """What may be said of places in a picture that does not show them."""
    if world.deep:
        return
    relations = words.relations.values()
    claims = [
        Claim(relation, *_colour_phrases(words, world, x, y))
        for relation in relations
        for x, y in permutations(world.in_view, 2)
    ]
    for act in OF_PLACES:
        yield [_place_saying(words, act, claim) for claim in claims]


def _colour_phrases(
    words: Vocabulary, world: World, x: int, y: int
) -> tuple[Phrase, Phrase]:
    return colour_phrase(words, world, x), colour_phrase(words, world, y)


def _place_saying(words: Vocabulary, act: str, claim: Claim) -> Saying:
    """What is said of places by way of a move; who rejects something denies it."""
    return Saying(words, act, replace(claim, denies=act == "reject"))


STRANGE = (
    "ask_whether",
    "ask_certainty",
    "ask_why",
    "ask_count",
    "ask_meaning",
    "forget_word",
)
"""The moves in which one may ask for a word that is not known."""


def _unknown_word_topics(
    words: Vocabulary, world: World, known: frozenset[Pred]
) -> Iterator[Talk]:
    """Sayings with an unknown word, of things that can be told apart."""
    for act in STRANGE:
        if act in acts(words):
            said = sayings(words, act, world)
            yield [it for it in said if _has_one_unknown(it, known)]


def _has_one_unknown(one: Saying, known: frozenset[Pred]) -> bool:
    """Whether all words are known but the last one, which is said of the others."""
    about = one.about
    claimed = (about.sign,) if isinstance(about, Claim) else about.signs
    return bool(claimed) and all(
        sign is not None and (word_of(sign) in known) is not (sign in claimed)
        for sign in (*about.signs, *claimed)
    )


# --- perspectives --------------------------------------------------------------------


def _front_topics(
    words: Vocabulary, world: World, fronts: Sequence[tuple[int, str]]
) -> Sequence[Talk]:
    """Sayings about perspectives, if things face some way, or that they do."""
    turned = [(y, front) for y, front in fronts if y in world]
    if not turned:
        return [sayings(words, "orient", world)] if len(world.in_view) > 1 else []
    beside = list(_claims_beside(words, world, turned))
    claims = [[_place_saying(words, act, it) for it in beside] for act in OF_PLACES]
    phrases = [Phrase("", (it.sign, *it.landmark.signs)) for it in beside if it.sign]
    asked = [
        Saying(words, act, Claim(None, phrase))
        for act in ("ask_name", "ask_find")
        for phrase in phrases
    ]
    places = [
        Saying(words, "ask_place", Claim(None, colour_phrase(words, world, x)))
        for x in world.in_view
    ]
    taking = (
        sayings(words, "take_frame", world),
        perspectives_by_side(words, world),
    )
    return [talk for talk in (*claims, asked, places, places, *taking) if talk]


def _claims_beside(
    words: Vocabulary, world: World, turned: Sequence[tuple[int, str]]
) -> Iterator[Claim]:
    """Where things are beside what faces some way: for a viewer, and for itself."""
    for y, front in turned:
        for x, way in product(world.in_view, ("away", front)):
            relation = None if x == y else words.relation_of(world, x, y, way)
            if relation is not None:
                pair = _colour_phrases(words, world, x, y)
                yield Claim(relation, *pair)


def perspectives_by_side(words: Vocabulary, world: World) -> Talk:
    """Whose perspective is meant, where nobody is named but the robot and the thing."""
    taking = sayings(words, "take_frame", world)
    return [one for one in taking if not one.about.signs]


def _is_of_turned(s: Record) -> bool:
    """Whether it was just learned where something is beside what faces some way."""
    said = s.shared.latest
    taught = said.teaches if "teaches" in said else ()
    turned = {it.x for it in s.shared.turned}
    return any("rel" in it and thing_at(it, "landmark") in turned for it in taught)
