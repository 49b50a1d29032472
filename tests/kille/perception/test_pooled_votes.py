"""Pooled votes: a closed learner that hears features only."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tabletop import percept_of, prototypes

from kille.perception.features import NONE
from kille.perception.learners import check_learner
from kille.perception.pooled_votes import PooledVotes
from kille.scene import Percept

WORDS = {"cup": 1, "book": 2, "shoe": 3}


def seen(word: str, seed: int) -> Percept:
    chance = np.random.default_rng([seed, WORDS[word]])
    return percept_of(chance, prototypes(WORDS[word]))


def taught() -> PooledVotes:
    memory = PooledVotes()
    for word in WORDS:
        memory.learn_one(seen(word, 0), word)
    return memory


def test_the_laws_of_a_learner() -> None:
    check_learner(PooledVotes, [(seen(w, i), w) for i in range(2) for w in WORDS])


@pytest.mark.parametrize("word", WORDS)
def test_features_vote_for_the_word_of_the_nearest(word: str) -> None:
    assert taught().predict_proba_one(seen(word, 7))[word] > 0.9


def test_nothing_is_ever_new() -> None:
    new = percept_of(np.random.default_rng(5), prototypes(77))
    assert sum(taught().predict_proba_one(new).values()) == pytest.approx(1)


def test_a_word_is_not_favoured_for_having_more_features() -> None:
    memory = taught()
    for i in range(1, 9):
        other = percept_of(np.random.default_rng(i), prototypes(100 + i))
        memory.learn_one(other, "book")
    half = replace(
        seen("cup", 3), scans=(seen("cup", 3).scans[0], seen("book", 3).scans[0])
    )
    shares = memory.predict_proba_one(half)
    assert shares["cup"] > 5 * shares["book"] > 0


def test_without_features_nobody_votes() -> None:
    nothing = replace(seen("cup", 0), scans=(NONE,))
    assert taught().predict_proba_one(nothing) == dict.fromkeys(sorted(WORDS), 0.0)
    memory = PooledVotes()
    assert memory.predict_proba_one(nothing) == {}
    memory.learn_one(nothing, "glass")
    assert memory.predict_proba_one(seen("cup", 0)) == {"glass": 0.0}
