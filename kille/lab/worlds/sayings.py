"""What a tutor may say about a simulated world, in the wordings of the lexicon.

For each of the tutor's moves the lexicon has wordings with slots; here they are filled
with all that can be talked about: things in view and not, words that are true of them
and words that are not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice, permutations, product
from string import Formatter

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import DialogueTypes, denial, merge_of
from kille.dialogue.reference import meant_by
from kille.dialogue.taxonomy import HEADWORD, LOWER, SYNONYM, UPPER
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
    "Biggest",
    "Nearest",
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

    It may be said that it is not. Without a word it only speaks of the target. The word
    is said as the `template` has it, by default that of its kind.
    """

    sign: Record | None = None
    target: Phrase = NOTHING
    landmark: Phrase = NOTHING
    denies: bool = False
    template: str = ""

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
            else types.meaning_at(sign, self.template or TEMPLATES[sign.kind])
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
    besides: tuple[str, ...] = ()
    """The names of other types that are merged with it."""

    def content(self, types: DialogueTypes) -> RecordType:
        """What is talked about."""
        parts = {
            label: it.meaning(types) if isinstance(it, Phrase) else it.meaning
            for label, it in self.labels
        }
        if not self.name:
            return rectype(parts) if parts else Rec
        content = types.record_type(self.name)
        for name in self.besides:
            content = merge_of(content, types.record_type(name))
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


@dataclass(frozen=True)
class WorldTalk:
    """What may be said in these words about a world.

    >>> from kille.lab.worlds.vocabulary import vocabulary
    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> WorldTalk(vocabulary("en"), world).sayings("instruct")[0].text
    'This is a cup.'
    """

    words: Vocabulary
    world: World

    @property
    def acts(self) -> tuple[str, ...]:
        """The moves of the tutor's for which the lexicon has a wording."""
        return tuple(lexicon(self.words.language).tells)

    def without_glance(self) -> WorldTalk:
        """The same, however often the world was looked at."""
        return replace(self, world=replace(self.world, glance=0))

    def say(self, act: str, about: Claim | Matter = Matter()) -> Saying:
        """Something to be said, in these words."""
        return Saying(self.words, act, about)

    def sayings(self, act: str) -> tuple[Saying, ...]:
        """All that may be said as a move: its wordings, about everything there is."""
        return _sayings(self.without_glance(), act)

    def relation(self, x: int, y: int, front: str = "away") -> Record | None:
        """The relation in which x stands to y, seen from there."""
        return self.words.relation_of(self.world, x, y, front)

    def words_of(self, x: int) -> tuple[Record, ...]:
        """The words that are true of a thing by itself."""
        return self.words.words_of(self.world, x)

    def true_claims(self, x: int, phrase: Phrase = THIS) -> Iterator[Claim]:
        """The claims that are true of a thing, with this phrase for it.

        Where things are is not known of a flat picture, but talked of all the same.
        """
        for sign in self.words_of(x):
            yield Claim(sign, phrase)
        for y in self.world.in_view:
            if y != x:
                relation = self.relation(x, y) or self.words.relations["left"]
                yield Claim(relation, phrase, self.colour_phrase(y))

    def colour_phrase(self, x: int) -> Phrase:
        """A phrase for a thing in words that are known anyhow: "the red one"."""
        return Phrase("", self.words.adjectives_of(self.world, x)[:1])

    def phrases(self, x: int) -> tuple[Phrase, ...]:
        """Phrases for a thing: "this", if it is attended to, and by its words."""
        noun, colour, *_ = self.words_of(x)
        described = [Phrase("", it) for it in ((colour,), (noun,), (colour, noun))]
        is_this = x == self.world.attended_thing
        return (THIS, *described) if is_this else tuple(described)


@lru_cache(1024)
def _sayings(talk: WorldTalk, act: str) -> tuple[Saying, ...]:
    found = (
        talk.say(act, about)
        for wording in lexicon(talk.words.language).tells[act]
        for about in _matters_of(talk, _slots(wording))
    )
    return tuple(dict.fromkeys(found))


def _slots(wording: str) -> frozenset[str]:
    return frozenset(slot for _, slot, _, _ in Formatter().parse(wording) if slot)


def _matters_of(talk: WorldTalk, slots: frozenset[str]) -> Iterable[Claim | Matter]:
    """All contents that fill the slots of a wording, if the slots are known."""
    claiming = next((slot for slot in slots if _affirmed_slot(slot) in SLOTS), "")
    if claiming:
        kind = SLOTS[_affirmed_slot(claiming)]
        claims = _relations if kind == "relation" else _claims
        said = claims(talk, kind, "the_target" in slots)
        denies = claiming != _affirmed_slot(claiming)
        return (replace(claim, denies=denies) for claim in said)
    if slots == {"the_target"}:
        return (Claim(None, phrase) for phrase in _all_phrases(talk))
    nouns = talk.words.nouns.values()
    match sorted(slots):
        case []:
            return [Matter()]
        case ["a_landmark", "a_target"]:
            pairs = islice(permutations(nouns, 2), PAIRS)
            return (
                Claim(None, Phrase("", (one,)), Phrase("", (other,)))
                for one, other in pairs
            )
        case ["comparative", "the_landmark", "the_target"]:
            return _comparisons(talk)
        case ["amid", "the_target"]:
            return _things_between(talk)
        case ["the_landmark", "the_target"]:
            return _pairs(talk)
        case ["side", "the_target"]:
            return _things_at_sides(talk)
        case ["word"]:
            return map(word_matter, talk.words.all)
        case ["counted"] | ["a_counted"]:
            return (Matter("", (("counted", it),)) for it in nouns)
        case ["a_subkind", "superkind"]:
            pairs = islice(permutations(nouns, 2), PAIRS)
            return (subsumption_matter(lower, upper) for lower, upper in pairs)
        case ["headword", "synonym"]:
            pairs = islice(permutations(nouns, 2), PAIRS)
            return (synonymy_matter(one, other) for one, other in pairs)
        case ["cue", "matters", "plural_subject"]:
            return (
                cue_matter(noun, cue, matters)
                for noun in nouns
                for cue in ("colour", "shape")
                for matters in (False, True)
            )
        case ["cue", "plural_subject"]:
            return (cue_matter(noun, "colour", True) for noun in nouns)
        case ["plural_property", "plural_subject"]:
            pairs = islice(product(nouns, talk.words.adjectives.values()), PAIRS)
            return (generic_matter(it, "Always", quality=one) for it, one in pairs)
        case ["plural_component", "plural_subject"]:
            pairs = islice(permutations(nouns, 2), PAIRS)
            return (generic_matter(one, "Always", part=it) for one, it in pairs)
        case ["often", "plural_property", "plural_subject"]:
            adjectives = talk.words.adjectives.values()
            pairs = islice(product(nouns, adjectives), PAIRS)
            return (
                generic_matter(noun, often, quality=adjective)
                for noun, adjective in pairs
                for often in ("Generally", "Never")
            )
        case ["often", "plural_component", "plural_subject"]:
            pairs = islice(permutations(nouns, 2), PAIRS)
            return (generic_matter(one, "Always", part=it) for one, it in pairs)
        case ["a_component", "the_target"]:
            phrases = _all_phrases(talk)
            parts = islice(product(phrases, nouns), PAIRS)
            return (part_matter(phrase, noun) for phrase, noun in parts)
        case ["front", "the_target"]:
            return _all_facing(talk)
        case ["the_landmark"]:
            phrases = (Phrase("", (noun,)) for noun in nouns)
            return (perspective_matter("landmark", phrase) for phrase in phrases)
        case ["by"]:
            return [perspective_matter("viewer"), perspective_matter("landmark")]
    return ()


def _comparisons(talk: WorldTalk) -> Iterator[Claim]:
    """Which of two things is bigger, or nearer."""
    for x, y in islice(permutations(talk.world.in_view, 2), PAIRS):
        for sign in talk.words.comparatives.values():
            phrases = talk.colour_phrase(x), talk.colour_phrase(y)
            yield Claim(sign, *phrases, template="Comparison")


def _pairs(talk: WorldTalk) -> Iterator[Matter]:
    """Two things, by phrases for them."""
    for x, y in islice(permutations(talk.world.in_view, 2), PAIRS):
        phrases = talk.colour_phrase(x), talk.colour_phrase(y)
        yield Matter("", (("target", phrases[0]), ("landmark", phrases[1])))


@dataclass(frozen=True)
class BetweenPhrase(Phrase):
    """A phrase for being between two things."""

    flanks: tuple[Phrase, ...] = ()

    def meaning(self, types: DialogueTypes) -> RecordType:
        """What it means: the second thing is the landmark of the first."""
        one, other = (it.meaning(types) for it in self.flanks)
        flank = merge_of(one, rectype(landmark=other))
        return merge_of(types.record_type("Between"), rectype(landmark=flank))


def between_phrase(*flanks: Phrase) -> Phrase:
    """The phrase for being between things of these phrases."""
    signs = tuple(sign for it in flanks for sign in it.signs)
    return BetweenPhrase("", signs, flanks)


def _things_between(talk: WorldTalk) -> Iterator[Matter]:
    """That a thing is between two others."""
    for x, y, z in islice(permutations(talk.world.in_view, 3), 2 * PAIRS):
        amid = between_phrase(talk.colour_phrase(y), talk.colour_phrase(z))
        yield Matter("", (("target", talk.colour_phrase(x)), ("amid", amid)))


def _things_at_sides(talk: WorldTalk) -> Iterator[Matter]:
    """That a thing is on the left, on the right or in the middle."""
    for x in talk.world.in_view:
        for side in ("AtLeft", "AtRight", "AtMiddle"):
            yield Matter(side, (("target", talk.colour_phrase(x)),))


def _all_facing(talk: WorldTalk) -> Iterator[Matter]:
    """Which way things face: as they do, and, where they have no front, some way."""
    for x in talk.world.in_view:
        front = talk.world.thing(x).front or "left"
        for phrase in talk.phrases(x):
            yield facing_matter(front, phrase)


def facing_matter(front: str, phrase: Phrase) -> Matter:
    """That a thing faces this way: `left`, `towards` …"""
    return Matter(f"Faces{front.capitalize()}", (("target", phrase),))


def perspective_matter(side: str, phrase: Phrase | None = None) -> Matter:
    """That places are as the `viewer` has them, or the `landmark` of a phrase."""
    landmark = () if phrase is None else (("landmark", phrase),)
    return Matter(f"By{side.capitalize()}", landmark)


def subsumption_matter(lower: Record, upper: Record) -> Matter:
    """That one kind of thing is a kind of another."""
    return Matter("", ((LOWER, lower), (UPPER, upper)))


def synonymy_matter(synonym: Record, headword: Record) -> Matter:
    """That one noun means the same as another."""
    return Matter("", ((SYNONYM, synonym), (HEADWORD, headword)))


def cue_matter(noun: Record, cue: str, matters: bool) -> Matter:
    """That a cue matters for the things of a noun, or does not."""
    said = "Matters" if matters else "MattersNot"
    return Matter(said, (("subject", noun),), (f"By{cue.capitalize()}",))


def generic_matter(
    noun: Record,
    often: str,
    *,
    quality: Record | None = None,
    part: Record | None = None,
) -> Matter:
    """That things of a noun have a quality or a part, so often."""
    rest = {"property": quality, "component": part}
    labels = tuple((label, it) for label, it in rest.items() if it is not None)
    return Matter(often, (("subject", noun), *labels))


def part_matter(phrase: Phrase, part: Record) -> Matter:
    """That a thing has a part."""
    return Matter("Asked", (("target", phrase), ("component", part)))


def word_matter(sign: Record) -> Matter:
    """That it is a word that is talked of, as in "Forget cup"."""
    return Matter("", (("word", sign),))


def _affirmed_slot(slot: str) -> str:
    return slot.removeprefix("not_")


def _claims(talk: WorldTalk, kind: str, phrased: bool) -> Iterator[Claim]:
    """Claims with a noun or an adjective, as many of them true as not."""
    rest = talk.words.nouns if kind == "noun" else talk.words.adjectives
    for x in talk.world.in_view:
        true = [it for it in talk.words_of(x) if it.kind == kind]
        for target in talk.phrases(x) if phrased else [NOTHING]:
            for sign in (*true, *islice(rest.values(), 2)):
                yield Claim(sign, target)


def _relations(talk: WorldTalk, kind: str, phrased: bool) -> Iterator[Claim]:
    """Claims with a relation, as many of them true as not."""
    some = tuple(talk.words.relations.values())[:1]
    for x, y in islice(permutations(talk.world.in_view, 2), PAIRS):
        true = talk.relation(x, y)
        for sign in some if true is None else (true, *some):
            for target in talk.phrases(x) if phrased else [NOTHING]:
                for landmark in talk.phrases(y):
                    yield Claim(sign, target, landmark)


def _all_phrases(talk: WorldTalk) -> Iterator[Phrase]:
    """The phrases for things in view, and such as may fit anything, or nothing."""
    words, world = talk.words, talk.world
    for x in world.in_view:
        yield from talk.phrases(x)
    yield THIS
    yield from map(Phrase, TALK)
    for noun in words.nouns.values():
        yield Phrase("", (noun,))
        yield Phrase("Other", (noun,))
    for x, y in islice(permutations(world.in_view, 2), PAIRS):
        where = talk.relation(x, y)
        if where is not None:
            nouns = words.noun_of(world, x), words.noun_of(world, y)
            yield Phrase("", (nouns[0], where, nouns[1]))
