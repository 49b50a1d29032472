"""The bridge: what is seen and learned, as the witness functions of words.

A look is named by a handle, look7, and a thing in it by its number, o2; the theory sees
only these names. The predicate of a noun is judged of a thing and a look by the object
memory, that of a relation of two things and a look by the relation memory.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import partial

from kille.dialogue.meanings import word_of
from kille.perception.geometry import offset
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.scene import Look, Percept, Point
from ttr import Model, Record

__all__ = ["Witnesses", "thing"]

UNKNOWN = (0.0, 1.0)
_REMEMBERED_LOOKS = 4


def thing(number: int) -> str:
    """The name of the thing with this number in a look."""
    return f"o{number}"


class Witnesses:
    """Judges words of the things in the latest looks, by what the learners know.

    A look that is no longer remembered says nothing: [0, 1].
    """

    def __init__(self, objects: ObjectMemory, relations: RelationMemory) -> None:
        self._objects, self._relations = objects, relations
        self._looks: dict[str, Look] = {}
        self._named: dict[tuple[str, str], Mapping[str, float]] = {}

    def remember(self, handle: str, look: Look, needed: Collection[str] = ()) -> None:
        """Have words judged of this look too.

        Of the others only those that are still needed and the latest are kept.
        """
        self._looks[handle] = look
        kept = {*needed, *list(self._looks)[-_REMEMBERED_LOOKS:]}
        self._looks = {name: it for name, it in self._looks.items() if name in kept}
        self._named = {
            key: p for key, p in self._named.items() if key[1] in self._looks
        }

    def reconsider(self) -> None:
        """Forget what was judged: the learners have changed."""
        self._named.clear()

    def look(self, handle: str) -> Look | None:
        """The look of this name, if it is remembered."""
        return self._looks.get(handle)

    def percept(self, x: str, handle: str) -> Percept | None:
        """The thing of this name in a look, if it is remembered."""
        look = self._looks.get(handle)
        number = int(x[1:])
        if look is None or not 1 <= number <= len(look.percepts):
            return None
        return look.percepts[number - 1]

    def place(self, x: str, handle: str) -> Point | None:
        """Where a thing is: the mean of its best-matched features, by its best word.

        A thing without any word is where its region is; None where that is unknown.
        """
        percept = self.percept(x, handle)
        if percept is None or percept.region.place is None:
            return None
        degrees = self._degrees(x, handle)
        if not degrees:
            return percept.region.place
        return self._objects.locate(percept, max(degrees, key=lambda w: degrees[w]))

    def offset(self, x: str, y: str, handle: str) -> Point | None:
        """Where x is from y: metres right, away and up; None if a place is unknown."""
        look, here, there = (
            self.look(handle),
            self.place(x, handle),
            self.place(y, handle),
        )
        if look is None or here is None or there is None:
            return None
        return Point(*offset(here, there, look.up))

    def noun(self, word: str, x: str, handle: str) -> float | tuple[float, float]:
        """The degree of word(x, look)."""
        if self.percept(x, handle) is None:
            return UNKNOWN
        return self._degrees(x, handle).get(word, 0.0)

    def relation(
        self, word: str, x: str, y: str, handle: str
    ) -> float | tuple[float, float]:
        """The degree of word(x, y, look)."""
        apart = self.offset(x, y, handle)
        if apart is None:
            return UNKNOWN
        return self._relations.predict_proba_one(apart).get(word, 0.0)

    def in_model(
        self, model: Model, nouns: Iterable[Record], relations: Iterable[Record]
    ) -> Model:
        """The model in which these words are judged by what is seen."""
        for sign in nouns:
            word = word_of(sign)
            model = model.witnessed(word, by=partial(self.noun, word.name))
        for sign in relations:
            word = word_of(sign)
            model = model.witnessed(word, by=partial(self.relation, word.name))
        return model

    def _degrees(self, x: str, handle: str) -> Mapping[str, float]:
        """The degree of every noun for a thing, asked of the learner once."""
        if (x, handle) not in self._named:
            percept = self.percept(x, handle)
            degrees = (
                {} if percept is None else self._objects.predict_proba_one(percept)
            )
            self._named[x, handle] = {w: min(p, 1.0) for w, p in degrees.items()}
        return self._named[x, handle]
