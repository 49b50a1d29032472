"""What leads on: what a tutor may say by what the talk, as it is, makes possible.

Most of what may be said at any time leads to the same few answers. What is rarer has to
be prepared: a perspective is asked about only when a thing is known to face some way, a
rival is named only where two words were learned of like things. So it is here that a
state says what is worth trying in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations, product
from typing import NamedTuple

from kille.dialogue.meanings import word_of
from kille.dialogue.reference import thing_at
from kille.dialogue.state import words as words_of
from kille.lab.tutors.leading_perspectives import (
    OF_PLACES,
    colour_phrases,
    front_topics,
    perspectives_by_side,
    place_saying,
)
from kille.lab.worlds.games import world_of
from kille.lab.worlds.perception import number_of
from kille.lab.worlds.sayings import (
    THIS,
    Claim,
    Matter,
    Phrase,
    Saying,
    WorldTalk,
    between_phrase,
)
from kille.lab.worlds.vocabulary import Vocabulary
from ttr import Pred, Record

Sayings = Sequence[Saying]


class Situation(NamedTuple):
    """The part of a state that decides what leads on from it.

    Things are numbers: `untold` are those in view of which nothing was said; `fronts`
    face some way that is known. `is_taught` says that it was just learned where
    something is beside one of these, `is_new` that the robot has said nothing yet.
    """

    talk: WorldTalk
    known: frozenset[Pred]
    untold: tuple[int, ...]
    fronts: tuple[tuple[int, str], ...]
    is_taught: bool
    is_new: bool


def situation(words: Vocabulary, s: Record) -> Situation:
    """The situation of a tutor who speaks this language."""
    told = {thing_at(it, "target") for it in s.shared.here}
    return Situation(
        WorldTalk(words, world_of(s)).without_glance(),
        frozenset(word_of(sign) for sign in words_of(s)),
        tuple(number_of(x) for x in s.view.things if x not in told),
        tuple((number_of(it.x), str(it.front)) for it in s.shared.turned),
        _is_of_turned(s),
        not s.private.last,
    )


def leading_topics(now: Situation) -> Sequence[Sayings]:
    """What leads on from a situation, topic by topic."""
    talk = now.talk
    if now.is_taught:
        return [perspectives_by_side(talk)]
    untold = [_name_questions(talk, now.untold)] if now.untold else []
    unsaid = [talk.sayings("ask_repeat")] if now.is_new else []
    return [
        *_word_topics(talk, now.known),
        *front_topics(talk, now.fronts),
        *untold * 2,
        *unsaid,
    ]


def _word_topics(talk: WorldTalk, known: frozenset[Pred]) -> Sequence[Sayings]:
    """What can be talked of in the words that are known, and in one that is not."""
    found = [
        *_empty_table_topics(talk, known),
        _knowledge_questions(talk, known),
        _about_the_last(talk),
        _name_questions(talk, talk.world.in_view),
        _questions_of_others(talk),
        _reflexive_lessons(talk),
        *_wrong_nouns(talk, known),
        *_flat_place_topics(talk),
        *_unknown_word_topics(talk, known),
        _lessons_about_all(talk, known),
        _places_between(talk),
        _converse_questions(talk, known),
        _forgetting_all(talk),
    ]
    return [said for said in found if said]


SEVERAL = ("ask_places", "instruct_several")
"""The moves about all things of a kind."""


def _empty_table_topics(talk: WorldTalk, known: frozenset[Pred]) -> Iterator[Sayings]:
    """What one may ask and say when nothing is in view."""
    if talk.world.in_view:
        return
    yield talk.sayings("ask_view")
    for act in SEVERAL:
        said = talk.sayings(act)
        yield [it for it in said if known.issuperset(map(word_of, it.about.signs))]


def _knowledge_questions(talk: WorldTalk, known: frozenset[Pred]) -> Sayings:
    """What one may ask who knows nothing."""
    return () if known else talk.sayings("ask_knowledge")


BARE = ("ask_certainty", "ask_why", "forget_that")
"""The moves that may be about what was said last, without saying so."""


def _about_the_last(talk: WorldTalk) -> Sayings:
    """Sayings about what was said last."""
    said = (one for act in BARE for one in talk.sayings(act))
    return [one for one in said if isinstance(one.about, Matter)]


def _name_questions(talk: WorldTalk, things: Sequence[int]) -> Sayings:
    """Questions what each of these things is."""
    phrases = (talk.phrases(x)[0] for x in things)
    return [talk.say("ask_name", Claim(None, phrase)) for phrase in phrases]


def _questions_of_others(talk: WorldTalk) -> Sayings:
    """Questions about the other things than the one that was talked of."""
    other = Claim(None, Phrase("Other"))
    acts_ = ("ask_name", "ask_place") if len(talk.world.in_view) > 1 else ()
    return [talk.say(act, other) for act in acts_]


OF_ALL = ("instruct_several", "instruct_every", "instruct_only", "reject_several")
"""The moves that teach what all things in view are."""


def _lessons_about_all(talk: WorldTalk, known: frozenset[Pred]) -> Sayings:
    """Lessons in words that are known about all things, as far as there are such."""
    said = [it for act in OF_ALL for it in talk.sayings(act)]
    return [it for it in said if known.issuperset(map(word_of, it.about.signs))] or said


def _places_between(talk: WorldTalk) -> Sayings:
    """Questions if this is between two things, by their nouns."""
    things = talk.world.in_view[:TWO]
    if len(things) < TWO:
        return ()
    flanks = [Phrase("", (talk.words.noun_of(talk.world, x),)) for x in things]
    amid = between_phrase(*flanks)
    return [talk.say("ask_between", Matter("", (("target", THIS), ("amid", amid))))]


TWO = 2
"""So many things another one is between."""


def _converse_questions(talk: WorldTalk, known: frozenset[Pred]) -> Sayings:
    """Questions if things stand the other way round, in words that are known."""
    pairs = permutations(talk.world.in_view, TWO)
    stands = ((x, y, talk.relation(x, y)) for x, y in pairs)
    return [
        talk.say("ask_whether", Claim(relation, *colour_phrases(talk, y, x)))
        for x, y, relation in stands
        if relation is not None and word_of(relation) in known
    ]


def _forgetting_all(talk: WorldTalk) -> Sayings:
    """What takes back everything, or the latest."""
    return [*talk.sayings("forget_all"), *talk.sayings("forget_last")]


def _reflexive_lessons(talk: WorldTalk) -> Sayings:
    """Lessons that something stands beside itself."""
    left = talk.words.relations["left"]
    ways = (talk.phrases(x) for x in talk.world.in_view)
    claims = (Claim(left, one, other) for one, *_, other in ways)
    return [talk.say("relate", claim) for claim in claims]


def _wrong_nouns(talk: WorldTalk, known: frozenset[Pred]) -> Iterator[Sayings]:
    """Sayings that call a thing by a known noun of another kind."""
    nouns = [it for it in talk.words.nouns.values() if word_of(it) in known]
    claims = [
        Claim(noun, talk.colour_phrase(x))
        for x, noun in product(talk.world.in_view, nouns)
        if noun != talk.words.noun_of(talk.world, x)
    ]
    for act in ("instruct", "ask_whether"):
        yield [talk.say(act, claim) for claim in claims]


def _flat_place_topics(talk: WorldTalk) -> Iterator[Sayings]:
    """What may be said of places in a picture that does not show them."""
    if talk.world.deep:
        return
    relations = talk.words.relations.values()
    claims = [
        Claim(relation, *colour_phrases(talk, x, y))
        for relation in relations
        for x, y in permutations(talk.world.in_view, 2)
    ]
    for act in OF_PLACES:
        yield [place_saying(talk, act, claim) for claim in claims]


STRANGE = (
    "ask_whether",
    "ask_certainty",
    "ask_why",
    "ask_count",
    "ask_meaning",
    "forget_word",
)
"""The moves in which one may ask for a word that is not known."""


def _unknown_word_topics(talk: WorldTalk, known: frozenset[Pred]) -> Iterator[Sayings]:
    """Sayings with an unknown word, of things that can be told apart."""
    for act in STRANGE:
        if act in talk.acts:
            said = talk.sayings(act)
            yield [it for it in said if _has_one_unknown(it, known)]


def _has_one_unknown(one: Saying, known: frozenset[Pred]) -> bool:
    """Whether all words are known but the last one, which is said of the others."""
    about = one.about
    claimed = (about.sign,) if isinstance(about, Claim) else about.signs
    return bool(claimed) and all(
        sign is not None and (word_of(sign) in known) is not (sign in claimed)
        for sign in (*about.signs, *claimed)
    )


def _is_of_turned(s: Record) -> bool:
    """Whether it was just learned where something is beside what faces some way."""
    said = s.shared.latest
    taught = said.teaches if "teaches" in said else ()
    turned = {it.x for it in s.shared.turned}
    return any("rel" in it and thing_at(it, "landmark") in turned for it in taught)
