"""Pooled votes: a plain method that tells words by local features, for comparison.

All learned descriptors are in one pool. Each feature of what is seen votes for the word
of the nearest of them, with one whole vote, and the votes for a word are divided by how
many descriptors of it there are. With nobody's votes left over, nothing is ever new.

Source: the voting of Schmid & Mohr 1997, "Local grayvalue invariants for image
retrieval", here with RootSIFT, and for words, not for single pictures.
"""

from __future__ import annotations

import numpy as np

from kille.perception.descriptor_index import Index, View, rooted
from kille.perception.features import descriptors_of
from kille.perception.learners import Key, own_key
from kille.perception.objects import kept_features
from kille.perception.votes import count_votes
from kille.scene import Percept


class PooledVotes:
    """A learner of object words from features only, each with one vote."""

    def __init__(self) -> None:
        self._index = Index()

    def learn_one(self, x: Percept, label: str, *, key: Key | None = None) -> None:
        """Add the features to the pool; ValueError if the key is taken."""
        named = own_key(self._index.views) if key is None else key
        self._index.learn(View(named, label, kept_features(x).descriptors))

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        self._index.forget(key)

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        """Each word's share of the votes; all 0 if there are no votes."""
        labels = self._index.labels
        found = self._index.neighbours(rooted(descriptors_of(x.scans)))
        votes = count_votes(found, len(labels)) / np.maximum(self._index.sizes, 1)
        shares = votes / max(float(votes.sum()), 1e-9)
        return dict(zip(labels, shares.tolist(), strict=True))
