"""The witness functions of words: judgements by what is seen and learned.

A look is named by a handle, look7, and a thing in it by its number, o2; the theory sees
only these names. The predicate of a noun is judged of a thing and a look by the object
memory, that of an adjective by the colour memory or by that of other attributes, and
that of a relation of two things, a look and a perspective by the relation memory.

The learners are asked once for the degrees of all their words, and the answers are kept
until the learners have changed; what depends on the look alone is measured once.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from functools import partial
from typing import Self

from kille.dialogue.meanings import DialogueTypes, packaged_types, word_of
from kille.grounding.comparisons import (
    COMPARISONS,
    SUPERLATIVES,
    Extents,
    degree_between,
    degree_of,
    superlative_degree,
)
from kille.grounding.generics import CUE, Generics
from kille.grounding.lessons_and_learners import Knowledge, colour_named
from kille.grounding.measurements import Measurements
from kille.perception.attributes import AttributeMemory
from kille.perception.colours import ColourMemory, xkcd
from kille.perception.evidence import Evidence
from kille.perception.look import Scans
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.perception.relations.perspectives import AWAY, FRONTS
from kille.scene import Configuration, Look, Percept
from ttr import Model, Record

Degree = float | tuple[float, float]
"""A degree in [0, 1], or the least and the greatest it may be."""

Named = Mapping[str, float]
"""The degrees of words."""

UNKNOWN = (0.0, 1.0)
_REMEMBERED_LOOKS = 4


def thing_name(number: int) -> str:
    """The name of the thing with this number in a look."""
    return f"o{number}"


def number_of(x: str) -> int:
    """The number of the thing of this name."""
    return int(x[1:])


class WitnessFunctions:
    """Judges words of the things in the latest looks, by what the learners know.

    A look that is no longer remembered says nothing: [0, 1].
    """

    def __init__(
        self,
        objects: ObjectMemory,
        relations: RelationMemory,
        colours: ColourMemory | None = None,
        attributes: AttributeMemory | None = None,
        generics: Generics | None = None,
    ) -> None:
        """Judge by these learners; by default colours are named as most people do."""
        self._objects, self._relations = objects, relations
        self._colours = ColourMemory(prior=xkcd()) if colours is None else colours
        self._attributes = AttributeMemory() if attributes is None else attributes
        self._generics = Generics() if generics is None else generics
        self._seen: dict[str, Measurements] = {}
        self._evident: dict[tuple[str, str], Evidence] = {}
        self._named: dict[tuple[str, str], Mapping[str, float]] = {}
        self._coloured: dict[tuple[str, str], Mapping[str, float]] = {}
        self._described: dict[tuple[str, str], Mapping[str, Degree]] = {}
        self._placed: dict[tuple[str, str], Mapping[tuple[int, int], Named]] = {}

    @classmethod
    def of(cls, knowledge: Knowledge) -> Self:
        """Judge by this knowledge, as it is now and later."""
        known = knowledge
        return cls(
            known.objects,
            known.relations,
            known.colours,
            known.attributes,
            known.generics,
        )

    def remember(self, handle: str, look: Look, needed: Collection[str] = ()) -> None:
        """Remember a look, so that words can be judged of it.

        Of earlier looks the latest and those that are still needed are kept.
        """
        self._seen[handle] = Measurements(look)
        kept = {*needed, *list(self._seen)[-_REMEMBERED_LOOKS:]}
        self._seen = {name: it for name, it in self._seen.items() if name in kept}
        for judged in (self._evident, self._named, self._coloured, self._described):
            for key in [it for it in judged if it[1] not in self._seen]:
                judged.pop(key)
        self._placed = {
            key: judged for key, judged in self._placed.items() if key[1] in self._seen
        }

    def prepare(self, handle: str) -> None:
        """Measure all things in a look, and judge all words of them, now.

        Otherwise a thing is measured and judged when it is first asked about.
        """
        seen = self._seen.get(handle)
        if seen is None:
            return
        for number in range(1, len(seen.look.percepts) + 1):
            x = thing_name(number)
            self._names(x, handle)
            self._colours_of(x, handle)
            self._descriptions(x, handle)
        self._places(AWAY, handle)

    def reconsider(self) -> None:
        """Forget what was judged: the learners have changed."""
        self._evident.clear()
        self._named.clear()
        self._coloured.clear()
        self._described.clear()
        self._placed.clear()

    def look(self, handle: str) -> Look | None:
        """The look of this name, if it is remembered."""
        seen = self._seen.get(handle)
        return None if seen is None else seen.look

    def percept(self, x: str, handle: str) -> Percept | None:
        """The thing of this name in a look, if it is remembered."""
        look = self.look(handle)
        number = int(x[1:])
        if look is None or not 1 <= number <= len(look.percepts):
            return None
        return look.percepts[number - 1]

    def configuration(
        self, x: str, y: str, handle: str, front: str = AWAY
    ) -> Configuration | None:
        """How x stands to y in a perspective of `FRONTS`: `away` is the robot's own.

        None if it is not remembered, or a place or the perspective is unknown.
        """
        if self.percept(x, handle) is None or self.percept(y, handle) is None:
            return None
        if front not in FRONTS:
            return None
        pairs = self._seen[handle].configurations(front)
        return pairs.get((int(x[1:]) - 1, int(y[1:]) - 1))

    # --- the degrees of words --------------------------------------------------------

    def evidence(self, x: str, handle: str) -> Evidence | None:
        """The evidence for each noun; None if no remembered look has the thing."""
        percept = self.percept(x, handle)
        if percept is None:
            return None
        if (x, handle) not in self._evident:
            if any(look == handle for _, look in self._evident):
                self._begin_after(x, handle)
            seen = self._objects.evidence(percept)
            self._evident[x, handle] = self._with_generics(seen, x, handle)
        return self._evident[x, handle]

    def _begin_after(self, x: str, handle: str) -> None:
        """Have the scans extracted of the thing that is likely to be asked about next.

        Whoever asks about a second thing in a look mostly goes through them all.
        """
        following = self.percept(thing_name(number_of(x) + 1), handle)
        if following is not None and isinstance(following.scans, Scans):
            following.scans.begin()

    def _with_generics(self, seen: Evidence, x: str, handle: str) -> Evidence:
        """The evidence for each noun with what was said of all things of its kind."""
        told = self._generics.evidence(
            seen.labels, lambda quality: self.attribute(quality, x, handle)
        )
        if told is None:
            return seen
        return Evidence(seen.labels, seen.base, {**seen.added, CUE: told})

    def noun(self, word: str, x: str, handle: str) -> Degree:
        """The degree of word(x, look)."""
        if self.percept(x, handle) is None:
            return UNKNOWN
        return self._names(x, handle).get(word, 0.0)

    def attribute(self, word: str, x: str, handle: str) -> Degree:
        """The degree of word(x, look) for an adjective, such as `is_red` or `is_big`.

        A colour is judged by the colour memory, any other adjective by what was taught
        of it. [0, 1] for a word that nobody taught, and for a thing of unknown colours.
        """
        if self.percept(x, handle) is None:
            return UNKNOWN
        colour = colour_named(self._colours, word)
        if colour is not None:
            return self._colours_of(x, handle).get(colour, UNKNOWN)
        return self._descriptions(x, handle).get(word, UNKNOWN)

    def colour(self, word: str, x: str, handle: str) -> Degree:
        """The degree of a colour word as it is said, such as "light blue".

        [0, 1] for a word that nobody taught, and for a thing of unknown colours.
        """
        if self.percept(x, handle) is None:
            return UNKNOWN
        return self._colours_of(x, handle).get(word, UNKNOWN)

    def relation(
        self, word: str, x: str, y: str, handle: str, front: str = AWAY
    ) -> Degree:
        """The degree of word(x, y, look, front), in a perspective of `FRONTS`.

        [0, 1] for things of unknown places, and for a thing and itself.
        """
        if self.configuration(x, y, handle, front) is None:
            return UNKNOWN
        pair = int(x[1:]) - 1, int(y[1:]) - 1
        return self._places(front, handle)[pair].get(word, 0.0)

    def across(self, x: str, handle: str) -> Degree:
        """How far to the right a thing is seen, from 0 to 1; nothing of it is vague."""
        percept, look = self.percept(x, handle), self.look(handle)
        if percept is None or look is None:
            return UNKNOWN
        box = percept.region.box
        return float((box.left + box.right) / 2 / look.frame.colour.shape[1])

    def comparative(
        self, word: str, x: str, y: str, handle: str, front: str = AWAY
    ) -> Degree:
        """The degree of `bigger_than(x, y, look, front)`, or of another comparative.

        It is the same in each perspective; [0, 1] for things of unknown sizes.
        """
        if self.percept(x, handle) is None or self.percept(y, handle) is None:
            return UNKNOWN
        i, j = number_of(x) - 1, number_of(y) - 1
        if word in SUPERLATIVES:
            seen = self._seen[handle].look.percepts
            found = superlative_degree(word, i, j, [it.region.place for it in seen])
            return UNKNOWN if found is None else found
        extents = self._seen[handle].extents
        one, other = extents[i], extents[j]
        if one is None or other is None:
            return UNKNOWN
        return degree_of(word, one, other)

    def extents(self, x: str, handle: str) -> Extents | None:
        """What is measured of a thing in a look, in metres; None for no place."""
        if self.percept(x, handle) is None:
            return None
        return self._seen[handle].extents[number_of(x) - 1]

    def between(self, x: str, y: str, z: str, handle: str) -> Degree:
        """The degree of `between(x, y, z, look)`; [0, 1] for unknown places."""
        seen = [self.percept(it, handle) for it in (x, y, z)]
        places = [None if it is None else it.region.place for it in seen]
        if any(it is None for it in places) or len({x, y, z}) < 3:
            return UNKNOWN
        return degree_between(*(it for it in places if it is not None))

    def in_model(
        self,
        model: Model,
        signs: Iterable[Record],
        *,
        types: DialogueTypes | None = None,
    ) -> Model:
        """The model in which these words are judged by what is seen.

        So are `across` and the comparatives, which need no lessons.
        """
        judges: Mapping[str, Callable[..., Degree]] = {
            "noun": self.noun,
            "adjective": self.attribute,
            "relation": self.relation,
        }
        types = types or packaged_types()
        if types["across"] not in model.facts.functions:
            model = model.witnessed(types["across"], by=self.across)
            model = model.witnessed(types["between"], by=self.between)
            for name in (*COMPARISONS, *SUPERLATIVES):
                by = partial(self.comparative, name)
                model = model.witnessed(types[name], by=by)
        for sign in signs:
            word = word_of(sign)
            model = model.witnessed(word, by=partial(judges[sign.kind], word.name))
        return model

    # --- asked of the learners once --------------------------------------------------

    def _names(self, x: str, handle: str) -> Mapping[str, float]:
        """The degree of every noun for a thing."""
        if (x, handle) not in self._named:
            found = self.evidence(x, handle)
            self._named[x, handle] = {} if found is None else found.degrees()
        return self._named[x, handle]

    def _colours_of(self, x: str, handle: str) -> Mapping[str, float]:
        """The degree of every colour for a thing."""
        if (x, handle) not in self._coloured:
            palette = self._seen[handle].palette(int(x[1:]) - 1)
            self._coloured[x, handle] = (
                {} if palette is None else self._colours.degrees(palette)
            )
        return self._coloured[x, handle]

    def _descriptions(self, x: str, handle: str) -> Mapping[str, Degree]:
        """The degree of every other adjective for a thing.

        A word that was only ever denied is unknown, except of things that are like
        those of which it was denied.
        """
        if (x, handle) not in self._described:
            percept = self.percept(x, handle)
            traits = {} if percept is None else percept.traits
            denied = self._attributes.denials(traits)
            self._described[x, handle] = {
                **self._attributes.degrees(traits),
                **{word: (0.0, 1 - alike) for word, alike in denied.items()},
            }
        return self._described[x, handle]

    def _places(self, front: str, handle: str) -> Mapping[tuple[int, int], Named]:
        """The degree of every relation for every two things in a look."""
        if (front, handle) not in self._placed:
            seen = self._seen[handle]
            pairs = seen.configurations(front)
            found = self._relations.degrees_of(
                tuple(pairs.values()), seen.template_odds(front)
            )
            self._placed[front, handle] = dict(zip(pairs, found, strict=True))
        return self._placed[front, handle]
