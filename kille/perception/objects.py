"""Object words: what things are called, learned from their features and traits.

Two kinds of evidence are combined. Features vote, each for the word of its nearest
learned descriptor: so the very thing that was shown is known again. Traits, such as
colours, size and form, are compared with those of examples: so a new cup is known as a
cup. `kille.perception.evidence` says how they are weighed, and what is left for what
has not been learned.

A word may also be denied of a thing: "this is not a cup". That weakens this word there
and for what is like that, and is evidence for no other: it is an example against it
(`kille.perception.negative_examples`), and features near those of the denied view vote
for it no more than if another word had such (`kille.perception.votes`). Other words
gain only what it leaves them.

And a tutor may say which cues count for a word: "the colour does not matter". Then its
examples are compared by other weights (`kille.perception.relevance`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from kille.perception.cues import CUES, Cue, measure_cues
from kille.perception.descriptor_index import (
    AGAIN,
    Index,
    View,
    distances,
    rooted,
)
from kille.perception.descriptor_index.builders import Builder
from kille.perception.evidence import Evidence, Weighing, weighing
from kille.perception.features import NONE, descriptors_of
from kille.perception.learners import Key, own_key
from kille.perception.likeness import SIZE, Examples, Kernel, Likeness
from kille.perception.nearest_words import MANY, NearestWords
from kille.perception.relevance import Relevance
from kille.perception.strangers import share_of_strangers
from kille.perception.votes import UNTAUGHT, beyond_chance, rivals, votes
from kille.scene import Features, Percept, Traits

__all__ = ["ObjectMemory", "kept_features"]

Comparison = Examples | NearestWords

_KEPT_SCANS = 4
_RECALLED = 24  # views of a word that are looked through by their features


class ObjectMemory:
    """A learner of words for things, from percepts.

    It keeps the views it was taught and nothing else, so that it can be stored as they
    are and built anew from them. `weighed` says how evidence is weighed, and `cues`
    which traits are measured beside those that a percept has; `builder` when the index
    of features is built, see `kille.perception.descriptor_index`.

    >>> from kille.perception.look import look
    >>> from kille.sensors.synthetic import open_synthetic
    >>> percept = look(open_synthetic("synthetic:desk?seed=7")).percepts[0]
    >>> memory = ObjectMemory()
    >>> memory.learn_one(percept, "cup")
    >>> [*memory.predict_proba_one(percept)]
    ['cup']
    """

    def __init__(
        self,
        views: Iterable[View] = (),
        *,
        denied: Iterable[View] = (),
        weighed: Weighing | None = None,
        cues: Mapping[str, Cue] = CUES,
        builder: Builder | None = None,
    ) -> None:
        """A memory that has been taught these views in this order.

        `denied` are views of what their words do not hold of.
        """
        self._index = Index(views, builder=builder)
        self._denied: dict[Key, View] = {}
        self._said: dict[Key, tuple[str, str, bool]] = {}
        self._relevance: dict[str, Relevance] = {}
        self._own_examples: dict[Relevance, Comparison] = {}
        self._own_latest: dict[Relevance, Comparison] = {}
        self._weighing = weighed or weighing()
        self._cues = cues
        self._examples: Comparison | None = None
        self._latest: Comparison | None = None
        self._calibrated: Weighing | None = None
        self._known: tuple[bool, ...] = ()
        for view in denied:
            self.deny(view)

    def copy(self) -> ObjectMemory:
        """A copy that knows the same; either learns without the other."""
        twin = object.__new__(ObjectMemory)
        twin.become(self)
        return twin

    def become(self, other: ObjectMemory) -> None:
        """Take over all that the other knows; afterwards either learns by itself."""
        self.__dict__.update(other.__dict__)
        self._index, self._denied = other._index.copy(), dict(other._denied)
        self._said = dict(other._said)

    @property
    def views(self) -> tuple[View, ...]:
        """All views learned, in order, without those denied."""
        return tuple(self._index.views.values())

    @property
    def denied(self) -> tuple[View, ...]:
        """The views of what their words do not hold of, in order."""
        return tuple(self._denied.values())

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words in alphabetical order."""
        return self._index.labels

    def learn_one(self, x: Percept, label: str, *, key: Key | None = None) -> None:
        """Learn that the word applies to the percept; ValueError if the key is
        taken."""
        self.learn(self.view_of(x, label, key=self._own_key() if key is None else key))

    def deny_one(self, x: Percept, label: str, *, key: Key | None = None) -> None:
        """Learn that the word does not apply to the percept; ValueError if the key is
        taken.

        A word that was only denied is not known.
        """
        self.deny(self.view_of(x, label, key=self._own_key() if key is None else key))

    def learn(self, view: View) -> None:
        """Learn a view made by `view_of`; ValueError if its key is taken."""
        self._require_free(view.key)
        self._index.learn(view)
        self._views_changed()

    def deny(self, view: View) -> None:
        """Learn a view that its word does not apply to; ValueError as for `learn`."""
        self._require_free(view.key)
        self._denied[view.key] = view
        self._views_changed()

    def weigh(self, label: str, group: str, matters: bool, *, key: Key) -> None:
        """Learn that a group of cues is what matters for a word, or does not matter.

        `group` is one of `kille.perception.relevance`. ValueError if the key is taken.
        """
        self._require_free(key)
        self._said[key] = label, group, matters
        self._weigh_anew()

    @property
    def familiarity(self) -> tuple[bool, ...]:
        """Whether the things it was told about after it had answered were known."""
        return self._known

    @property
    def strangers(self) -> float:
        """The share of strangers that it reckons with among what it is asked about."""
        return share_of_strangers(self._known)

    def reckon_with(self, known: Iterable[bool]) -> None:
        """Take it that of the things asked about so many are strange.

        `known` is of each thing that it was told about after it had answered whether it
        was known, the latest last, in the place of what it was told before. The more
        were strange, the lower are all degrees.
        """
        self._known = tuple(known)

    def relevance(self, label: str) -> Relevance:
        """Which cues count for a word, by what was said."""
        return self._relevance.get(label, Relevance())

    def view_of(self, x: Percept, label: str, *, key: Key) -> View:
        """What a lesson stores: the features kept of the percept, and its traits."""
        return View(key, label, kept_features(x).descriptors, self.traits_of(x))

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        if self._said.pop(key, None) is not None:
            self._weigh_anew()
            return
        if key in self._denied:
            self._denied[key].load()  # others may still hold it
            del self._denied[key]
        else:
            self._index.forget(key)
        self._views_changed()

    def forget_word(self, label: str) -> None:
        """Undo all lessons in a word; KeyError if there were none."""
        every = (*self.views, *self.denied)
        keys = [view.key for view in every if view.label == label]
        if not keys:
            raise KeyError(label)
        for key in keys:
            self.forget(key)

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        """The degree of each learned word for the percept; {} if nothing is seen."""
        return self.evidence(x).degrees()

    def evidence(self, x: Percept) -> Evidence:
        """What each cue adds for each word; no words if nothing is seen."""
        labels = self.labels
        if not labels:
            return Evidence((), self._weighing.base, {})
        found = self._index.neighbours_in(x.scans, UNTAUGHT)
        features, traits = len(found.words), self.traits_of(x)
        if not (traits or features):
            return Evidence((), self._weighing.base, {})
        cast = np.zeros(len(labels))
        if features:
            rivalling = rivals(found, x.scans, labels, self.denied)
            cast = votes(found, len(labels), len(x.scans), rivalling)
            cast = beyond_chance(cast, self._index.sizes, features / len(x.scans))
        likeness = self._likeness(traits)
        for label, relevance in self._relevance.items():
            if label in labels:
                column, own = labels.index(label), self._examples_for(relevance)
                likeness = likeness.with_column(column, own.likeness(traits))
                cast[column] *= relevance.votes**2
        heard = self._without_ignored_size(likeness, labels)
        weighing = self._calibrated_weighing() if heard.scores else self._weighing
        return weighing.reckon_with(self._known).evidence(labels, heard, cast)

    def _calibrated_weighing(self) -> Weighing:
        """How evidence is weighed, by what the lessons say of each other."""
        if self._calibrated is None:
            left_out = self._current_examples().left_out()
            self._calibrated = self._weighing.calibrate_by(left_out)
        return self._calibrated

    def _without_ignored_size(
        self, likeness: Likeness, labels: Sequence[str]
    ) -> Likeness:
        """The likeness without a size for the words of which the size was said not to
        matter."""
        words = [it for it, said in self._relevance.items() if said.ignores(SIZE)]
        columns = [labels.index(it) for it in words if it in labels]
        return likeness.without(SIZE, columns) if columns else likeness

    def traits_of(self, x: Percept) -> Traits:
        """The percept's traits, and those of this memory's own cues that it lacks."""
        lacking = {name: cue for name, cue in self._cues.items() if name not in CUES}
        if not lacking or x.frame is None:
            return x.traits
        if x not in _MORE or not lacking.keys() <= _MORE[x].keys():
            _MORE[x] = measure_cues(x.frame, x.region, lacking)
        return {**x.traits, **_MORE[x]}

    def nearest(self, x: Percept, label: str) -> View | None:
        """The stored view of a word whose traits are most like the percept's.

        Where no trait tells, by the features of the newest ones. None if nothing does;
        KeyError for a word that was not learned.
        """
        labels = self.labels
        if label not in labels:
            raise KeyError(label)
        examples = self._current_examples()
        if label in self._relevance:
            examples = self._examples_for(self._relevance[label])
        found = examples.nearest(self.traits_of(x), labels.index(label))
        return self._nearest_in_features(x, label) if found is None else found

    def _nearest_in_features(self, x: Percept, label: str) -> View | None:
        own = [it for it in self.views if it.label == label and it.size]
        query = rooted(descriptors_of(x.scans[:1]))
        if not own or not len(query):
            return None
        apart = [
            distances(query, rooted(it.descriptors)).min(axis=1).mean()
            for it in own[-_RECALLED:]
        ]
        return own[-_RECALLED:][int(np.argmin(apart))]

    def _likeness(self, traits: Traits) -> Likeness:
        return self._current_examples().likeness(traits)

    def _current_examples(self) -> Comparison:
        if self._examples is None:
            self._examples = self._compare(self._weighing.kernels, self._latest)
            self._latest = self._examples
        return self._examples

    def _examples_for(self, relevance: Relevance) -> Comparison:
        """The examples, compared by the weights that words of this relevance have."""
        if relevance not in self._own_examples:
            kernels = relevance.kernels(self._weighing.kernels)
            made = self._compare(kernels, self._own_latest.get(relevance))
            self._own_examples = {**self._own_examples, relevance: made}
            self._own_latest = {**self._own_latest, relevance: made}
        return self._own_examples[relevance]

    def _compare(
        self, kernels: Mapping[str, Kernel], old: Comparison | None
    ) -> Comparison:
        """Examples of all words, with what others of the same kernels worked out."""
        labels, denied = self.labels, self.denied
        if len(labels) <= MANY:
            before = old if isinstance(old, Examples) else None
            return Examples(self.views, labels, kernels, before, denied=denied)
        latest = next(
            (it for it in (old, self._latest) if isinstance(it, NearestWords)), None
        )
        words = self._index.words
        return NearestWords(words, labels, kernels, latest, denied=denied)

    def _views_changed(self) -> None:
        """Compare the examples anew when it is next asked."""
        self._examples, self._own_examples, self._calibrated = None, {}, None

    def _weigh_anew(self) -> None:
        """Work out which cues count for which words, by all that was said of them."""
        said: dict[str, list[tuple[str, bool]]] = {}
        for label, group, matters in self._said.values():
            said.setdefault(label, []).append((group, matters))
        self._relevance = {label: Relevance.of(them) for label, them in said.items()}
        kept = {*self._relevance.values()}
        self._own_latest = {k: it for k, it in self._own_latest.items() if k in kept}

    def _own_key(self) -> Key:
        return own_key({*self._index.views, *self._denied, *self._said})

    def _require_free(self, key: Key) -> None:
        if key in self._denied or key in self._said or key in self._index.views:
            raise ValueError(f"the key {key!r} was learned before; forget it first")


_MORE: WeakKeyDictionary[Percept, Traits] = WeakKeyDictionary()
"""Traits of additional cues, each measured once for a percept."""

_KEPT: WeakKeyDictionary[Percept, Features] = WeakKeyDictionary()
"""The features kept of each percept, computed once."""


def kept_features(x: Percept) -> Features:
    """The features that a lesson stores: each one once, from some scans of the look.

    The first scan is kept whole, and of three later ones what the earlier lack.

    >>> from kille.perception.look import look
    >>> from kille.sensors.synthetic import open_synthetic
    >>> percept = look(open_synthetic("synthetic:desk?seed=7")).percepts[0]
    >>> kept_features(percept).descriptors.shape[1]
    128
    """
    if x not in _KEPT:
        _KEPT[x] = _merge_scans(x)
    return _KEPT[x]


def _merge_scans(x: Percept) -> Features:
    """Merge the features of a few scans, leaving out those seen in an earlier scan."""
    count = len(x.scans)
    chosen = sorted(
        {round(i) for i in np.linspace(0, count - 1, min(count, _KEPT_SCANS))}
    )
    kept = NONE
    for i in chosen:
        scan = x.scans[i]
        new = _is_new(scan.descriptors, kept.descriptors)
        kept = Features(
            np.concatenate([kept.descriptors, scan.descriptors[new]]),
            np.concatenate([kept.pixels, scan.pixels[new]]),
            np.concatenate([kept.points, scan.points[new]]),
        )
    return kept


def _is_new(more: NDArray[np.uint8], kept: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which descriptors (n,) are far from all those kept so far?"""
    apart = distances(rooted(more), rooted(kept)).min(axis=1, initial=np.inf)
    new: NDArray[np.bool_] = apart > AGAIN
    return new
