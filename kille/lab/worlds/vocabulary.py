"""The words in which tutors speak of simulated worlds, in each language."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import DialogueTypes, packaged_types
from kille.lab.worlds.perception import direction
from kille.lab.worlds.worlds import COLOURS, KINDS, World
from ttr import Record

SIZES = {0.1: "small", 0.9: "big"}
"""What the sizes of things are called."""

SIDES = {
    "left": (-1.0, 0.0),
    "right": (1.0, 0.0),
    "behind": (0.0, 1.0),
    "in front": (0.0, -1.0),
}
"""Where a thing may be: how far to the right, and how far ahead."""

PLACES = {
    "to the left of": "left",
    "to the right of": "right",
    "behind": "behind",
    "in front of": "in front",
}
"""The sides by what they are called in studies."""

_SWEDISH = {
    "cup": "kopp",
    "mug": "mugg",
    "bowl": "skål",
    "book": "bok",
    "box": "låda",
    "apple": "äpple",
    "car": "bil",
    "shoe": "sko",
    "red": "röd",
    "orange": "orange",
    "yellow": "gul",
    "green": "grön",
    "blue": "blå",
    "black": "svart",
    "white": "vit",
    "brown": "brun",
    "small": "liten",
    "big": "stor",
    "left": "till vänster om",
    "right": "till höger om",
    "behind": "bakom",
    "in front": "framför",
}
COMPARATIVES = ("bigger than", "smaller than", "nearer than", "further than")
"""The comparatives that simulated tutors use, by their English forms."""

_SWEDISH_COMPARATIVES = ("större än", "mindre än", "närmare än", "längre bort än")
_SWEDISH_DISTANCES = {
    "near": "nära",
    "close to": "intill",
    "next to": "bredvid",
    "far from": "långt från",
}
_ENGLISH = {
    "left": "to the left of",
    "right": "to the right of",
    "in front": "in front of",
}


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """The signs of a language for what there is in a world, by their names here.

    They, and all that is said with them, have their meanings by `types`. `distances`
    are words for places that are no sides: they have no signs of their own.
    """

    language: str
    types: DialogueTypes
    nouns: Mapping[str, Record]
    adjectives: Mapping[str, Record]
    relations: Mapping[str, Record]
    comparatives: Mapping[str, Record]
    distances: Mapping[str, str]

    @property
    def all(self) -> tuple[Record, ...]:
        """All the words."""
        kinds = self.nouns, self.adjectives, self.relations
        return tuple(sign for signs in kinds for sign in signs.values())

    @property
    def colours(self) -> tuple[Record, ...]:
        """The adjectives for colours, which are known without lessons."""
        return tuple(self.adjectives[name] for name in COLOURS)

    def form_of(self, name: str) -> str:
        """What a kind, a colour or a place is called; its name, if none of these.

        >>> vocabulary("sv").form_of("mug"), vocabulary("sv").form_of("near")
        ('mugg', 'nära')
        """
        if name in PLACES:
            return str(self.relations[PLACES[name]].form)
        if name in KINDS:
            return str(self.nouns[name].form)
        if name in COLOURS:
            return str(self.adjectives[name].form)
        return self.distances.get(name, name)

    def noun_of(self, world: World, number: int) -> Record:
        """The noun for a thing."""
        return self.nouns[world.thing(number).kind]

    def adjectives_of(self, world: World, number: int) -> tuple[Record, ...]:
        """The adjectives that are true of a thing."""
        thing = world.thing(number)
        size = [SIZES[thing.size]] if thing.size in SIZES else []
        return tuple(self.adjectives[it] for it in [thing.colour, *size])

    def words_of(self, world: World, number: int) -> tuple[Record, ...]:
        """The words that are true of a thing by itself."""
        return self.noun_of(world, number), *self.adjectives_of(world, number)

    def relation_of(
        self, world: World, x: int, y: int, front: str = "away"
    ) -> Record | None:
        """The relation in which one thing stands to another, seen from there."""
        way = direction(world, x, y, front)
        if way is None:
            return None
        right, ahead = way
        side = max(SIDES, key=lambda it: SIDES[it][0] * right + SIDES[it][1] * ahead)
        return self.relations[side]


def vocabulary(language: str = "en", types: DialogueTypes | None = None) -> Vocabulary:
    """The words of a language, by default as the packaged theory has their meanings.

    >>> vocabulary("sv").nouns["cup"].form
    'kopp'
    """
    return (types or packaged_types()).derive(_vocabulary, language)


def _vocabulary(types: DialogueTypes, language: str) -> Vocabulary:
    forms = {"en": _ENGLISH, "sv": _SWEDISH}[language]
    if language == "sv":
        forms = forms | dict(zip(COMPARATIVES, _SWEDISH_COMPARATIVES, strict=True))
    means = lexicon(language).means

    def signs(kind: str, *names: str) -> dict[str, Record]:
        found = {}
        for name in names:
            form = forms.get(name, name)
            meant = "" if kind == "noun" else means.get(form, "")
            found[name] = types.sign(form, kind, means=meant)
        return found

    return Vocabulary(
        language,
        types,
        signs("noun", *KINDS),
        signs("adjective", *COLOURS, *SIZES.values()),
        signs("relation", *SIDES),
        signs("relation", *COMPARATIVES),
        _SWEDISH_DISTANCES if language == "sv" else {},
    )
