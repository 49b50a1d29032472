"""The bridge: what is seen and learned, as the witness functions of words.

A look is named by a handle, look7, and a thing in it by its number, o2; the theory sees
only these names. The predicate of a noun is judged of a thing and a look by the object
memory, that of a colour by the colour memory, and that of a relation of two things and
a look by the relation memory.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import partial

from kille.dialogue.meanings import word_of
from kille.perception.colours import ColourMemory, colours_of, xkcd
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.perception.relations.seeing import configuration
from kille.scene import Configuration, Look, Percept
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

    def __init__(
        self,
        objects: ObjectMemory,
        relations: RelationMemory,
        colours: ColourMemory | None = None,
    ) -> None:
        """Witnesses by these learners; colours as most people name them by default."""
        self._objects, self._relations = objects, relations
        self._colours = colours or ColourMemory(prior=xkcd())
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

    def configuration(self, x: str, y: str, handle: str) -> Configuration | None:
        """How x stands to y; None if it is not remembered, or a place is unknown."""
        look = self.look(handle)
        target, landmark = self.percept(x, handle), self.percept(y, handle)
        if look is None or target is None or landmark is None:
            return None
        others = [it.region for it in look.percepts if it not in (target, landmark)]
        return configuration(
            look.frame, target.region, landmark.region, others, look.up
        )

    def noun(self, word: str, x: str, handle: str) -> float | tuple[float, float]:
        """The degree of word(x, look)."""
        if self.percept(x, handle) is None:
            return UNKNOWN
        return self._degrees(x, handle).get(word, 0.0)

    def colour(self, word: str, x: str, handle: str) -> float | tuple[float, float]:
        """The degree of word(x, look) for a colour word, such as "light blue".

        What has no colours that could be told, or a word that nobody taught: [0, 1].
        """
        percept = self.percept(x, handle)
        if percept is None or percept.frame is None:
            return UNKNOWN
        palette = colours_of(percept.frame, percept.region)
        if palette is None:
            return UNKNOWN
        return self._colours.degrees(palette).get(word, UNKNOWN)

    def relation(
        self, word: str, x: str, y: str, handle: str
    ) -> float | tuple[float, float]:
        """The degree of word(x, y, look)."""
        stand = self.configuration(x, y, handle)
        if stand is None:
            return UNKNOWN
        return self._relations.degrees(stand).get(word, 0.0)

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
