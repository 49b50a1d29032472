"""What a tutor may say about a simulated world, in the wordings of the lexicon.

For each of the tutor's moves the lexicon has wordings with slots; here they are filled
with all that can be talked about: things in view and not, words that are true of them
and words that are not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice, permutations
from string import Formatter

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import DialogueTypes, denial, merge_of
from kille.dialogue.reference import meant_by
from kille.dialogue.wording import tell
from kille.lab.worlds.vocabulary import Vocabulary
from kille.lab.worlds.worlds import World
from ttr import Rec, Record, RecordType, record, rectype

TEMPLATES = {"noun": "Naming", "adjective": "Having", "relation": "Relation"}
"""What a claim means, by the kind of its word."""

LESSON_ACTS = {"noun": "instruct", "adjective": "describe", "relation": "relate"}
"""The moves that teach words, by their kinds."""

QUESTION_ACTS = {
    "noun": "ask_name",
    "adjective": "ask_quality",
    "relation": "ask_place",
}
"""The moves that ask for words, by their kinds."""

SLOTS = {"a_word": "noun", "so": "adjective", "relation": "relation"}
"""The kind of word that a slot of a claim is for."""

TALK = (
    "It",
    "Other",
    "First",
    "Second",
    "Third",
    "Last",
    "Leftmost",
    "Rightmost",
)
"""Phrases by which any thing may be called, depending on the dialogue."""

PAIRS = 8
"""The largest number of pairs of things that are talked about."""


@dataclass(frozen=True)
class Phrase:
    """A noun phrase by its parts: what the talk makes of it, and the words in it.

    Without either it is none: what is talked about follows from the talk.
    """

    talk: str = ""
    signs: tuple[Record, ...] = ()

    def meaning(self, types: DialogueTypes) -> RecordType:
        """What it means."""
        meant = meant_by(self.signs, types=types) if self.signs else rectype()
        return merge_of(meant, types.record_type(self.talk)) if self.talk else meant


NOTHING, THIS = Phrase(), Phrase("This")


@dataclass(frozen=True)
class Claim:
    """What may be said: that a word is true of a target, or of a target and a landmark.

    It may be said that it is not. Without a word it only speaks of the target.
    """

    sign: Record | None = None
    target: Phrase = NOTHING
    landmark: Phrase = NOTHING
    denies: bool = False

    def content(self, types: DialogueTypes) -> RecordType:
        """What is said."""
        parts = {
            label: part.meaning(types)
            for label, part in (("target", self.target), ("landmark", self.landmark))
            if part is not NOTHING
        }
        sign = self.sign
        said = (
            types.record_type("Asked")
            if sign is None
            else types.meaning_at(sign, TEMPLATES[sign.kind])
        )
        content = merge_of(said, rectype(parts))
        return denial(content) if self.denies else content

    @property
    def signs(self) -> tuple[Record, ...]:
        """The words in it."""
        own = () if self.sign is None else (self.sign,)
        return (*self.target.signs, *own, *self.landmark.signs)


@dataclass(frozen=True)
class Matter:
    """Anything else that is talked about: a word, a number, a perspective.

    It is what a type is by its `name`, if it has one, with something set in it.
    """

    name: str = ""
    labels: tuple[tuple[str, Phrase | Record], ...] = ()

    def content(self, types: DialogueTypes) -> RecordType:
        """What is talked about."""
        parts = {
            label: it.meaning(types) if isinstance(it, Phrase) else it.meaning
            for label, it in self.labels
        }
        if not self.name:
            return rectype(parts) if parts else Rec
        content = types.record_type(self.name)
        return merge_of(content, rectype(parts)) if parts else content

    @property
    def signs(self) -> tuple[Record, ...]:
        """The words in it."""
        found = (it.signs if isinstance(it, Phrase) else (it,) for _, it in self.labels)
        return tuple(sign for signs in found for sign in signs)


@dataclass(frozen=True)
class Saying:
    """Something to be said: a move of the tutor's, and what it is about."""

    words: Vocabulary
    act: str
    about: Claim | Matter = Matter()

    @property
    def text(self) -> str:
        """The text of it, in the lexicon's wording."""
        return _text(self)


@lru_cache(65536)
def _text(saying: Saying) -> str:
    about, words = saying.about, saying.words
    move = record(content=about.content(words.types), signs=about.signs)
    return tell(lexicon(words.language), saying.act, move)


def acts(words: Vocabulary) -> tuple[str, ...]:
    """The moves of the tutor's for which the lexicon has a wording."""
    return tuple(lexicon(words.language).tells)


def sayings(words: Vocabulary, act: str, world: World) -> tuple[Saying, ...]:
    """All that may be said as a move: its wordings, about everything there is.

    >>> from kille.lab.worlds.vocabulary import vocabulary
    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> sayings(vocabulary("en"), "instruct", world)[0].text
    'This is a cup.'
    """
    return _sayings(words, act, without_glance(world))


def without_glance(world: World) -> World:
    """A world whose looks are not counted, of which the same may be said."""
    return replace(world, glance=0)


@lru_cache(1024)
def _sayings(words: Vocabulary, act: str, world: World) -> tuple[Saying, ...]:
    found = (
        Saying(words, act, about)
        for wording in lexicon(words.language).tells[act]
        for about in _matters_of(words, _slots(wording), world)
    )
    return tuple(dict.fromkeys(found))


def _slots(wording: str) -> frozenset[str]:
    return frozenset(slot for _, slot, _, _ in Formatter().parse(wording) if slot)


def _matters_of(
    words: Vocabulary, slots: frozenset[str], world: World
) -> Iterable[Claim | Matter]:
    """All contents that fill the slots of a wording, if the slots are known."""
    claiming = next((slot for slot in slots if _affirmed_slot(slot) in SLOTS), "")
    if claiming:
        kind = SLOTS[_affirmed_slot(claiming)]
        claims = _relations if kind == "relation" else _claims
        said = claims(words, world, kind, "the_target" in slots)
        denies = claiming != _affirmed_slot(claiming)
        return (replace(claim, denies=denies) for claim in said)
    if slots == {"the_target"}:
        return (Claim(None, phrase) for phrase in _phrases(words, world))
    nouns = words.nouns.values()
    match sorted(slots):
        case []:
            return [Matter()]
        case ["word"]:
            return map(word_matter, words.all)
        case ["counted"]:
            return (Matter("", (("counted", it),)) for it in nouns)
        case ["front", "the_target"]:
            return _all_facing(words, world)
        case ["the_landmark"]:
            phrases = (Phrase("", (noun,)) for noun in nouns)
            return (perspective_matter("landmark", phrase) for phrase in phrases)
        case ["by"]:
            return [perspective_matter("viewer"), perspective_matter("landmark")]
    return ()


def _all_facing(words: Vocabulary, world: World) -> Iterator[Matter]:
    """Which way things face: as they do, and, where they have no front, some way."""
    for x in world.in_view:
        front = world.thing(x).front or "left"
        for phrase in phrases_of(words, world, x):
            yield facing_matter(front, phrase)


def facing_matter(front: str, phrase: Phrase) -> Matter:
    """That a thing faces this way: `left`, `towards` …"""
    return Matter(f"Faces{front.capitalize()}", (("target", phrase),))


def perspective_matter(side: str, phrase: Phrase | None = None) -> Matter:
    """That places are as the `viewer` has them, or the `landmark` of a phrase."""
    landmark = () if phrase is None else (("landmark", phrase),)
    return Matter(f"By{side.capitalize()}", landmark)


def word_matter(sign: Record) -> Matter:
    """That it is a word that is talked of, as in "Forget cup"."""
    return Matter("", (("word", sign),))


def _affirmed_slot(slot: str) -> str:
    return slot.removeprefix("not_")


def _claims(
    words: Vocabulary, world: World, kind: str, phrased: bool
) -> Iterator[Claim]:
    """Claims with a noun or an adjective, as many of them true as not."""
    rest = words.nouns if kind == "noun" else words.adjectives
    for x in world.in_view:
        true = [it for it in words.words_of(world, x) if it.kind == kind]
        for target in phrases_of(words, world, x) if phrased else [NOTHING]:
            for sign in (*true, *islice(rest.values(), 2)):
                yield Claim(sign, target)


def _relations(
    words: Vocabulary, world: World, kind: str, phrased: bool
) -> Iterator[Claim]:
    """Claims with a relation, as many of them true as not."""
    some = tuple(words.relations.values())[:1]
    for x, y in islice(permutations(world.in_view, 2), PAIRS):
        true = words.relation_of(world, x, y)
        for sign in some if true is None else (true, *some):
            for target in phrases_of(words, world, x) if phrased else [NOTHING]:
                for landmark in phrases_of(words, world, y):
                    yield Claim(sign, target, landmark)


def true_claims(
    words: Vocabulary, world: World, x: int, phrase: Phrase = THIS
) -> Iterator[Claim]:
    """The claims that are true of a thing, with this phrase for it.

    Where things are is not known of a flat picture, but talked of all the same.
    """
    for sign in words.words_of(world, x):
        yield Claim(sign, phrase)
    for y in world.in_view:
        if y != x:
            relation = words.relation_of(world, x, y) or words.relations["left"]
            yield Claim(relation, phrase, colour_phrase(words, world, y))


def colour_phrase(words: Vocabulary, world: World, x: int) -> Phrase:
    """A phrase for a thing in words that are known from the start: "the red one"."""
    return Phrase("", words.adjectives_of(world, x)[:1])


def phrases_of(words: Vocabulary, world: World, x: int) -> tuple[Phrase, ...]:
    """How one may speak of a thing: "this", if it is attended to, and by its words."""
    noun, (colour, *_) = words.noun_of(world, x), words.adjectives_of(world, x)
    described = [Phrase("", it) for it in ((colour,), (noun,), (colour, noun))]
    return (THIS, *described) if x == world.attended_thing else tuple(described)


def _phrases(words: Vocabulary, world: World) -> Iterator[Phrase]:
    """The phrases for things in view, and such as may fit anything, or nothing."""
    for x in world.in_view:
        yield from phrases_of(words, world, x)
    yield THIS
    for talk in TALK:
        yield Phrase(talk)
    for noun in words.nouns.values():
        yield Phrase("", (noun,))
        yield Phrase("Other", (noun,))
    for x, y in islice(permutations(world.in_view, 2), PAIRS):
        where = words.relation_of(world, x, y)
        if where is not None:
            nouns = words.noun_of(world, x), words.noun_of(world, y)
            yield Phrase("", (nouns[0], where, nouns[1]))
