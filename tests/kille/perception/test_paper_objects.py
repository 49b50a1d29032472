"""KILLE's own way with object words: a learner, closed, biased, and slow as it was."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tabletop import Camera, Card, frame_of, percept_of, prototypes

from kille.perception.learners import check_learner
from kille.perception.look import look
from kille.perception.paper_objects import PaperObjects, _scans
from kille.scene import Percept, Point

WORDS = {"cup": 1, "book": 2, "shoe": 3}


def seen(word: str, seed: int) -> Percept:
    return percept_of(
        np.random.default_rng([seed, WORDS[word]]), prototypes(WORDS[word])
    )


def taught() -> PaperObjects:
    memory = PaperObjects()
    for word in WORDS:
        memory.learn_one(seen(word, 0), word)
    return memory


def featureless() -> Percept:
    percept = seen("cup", 0)
    scan = percept.scans[0]
    none = replace(
        scan,
        descriptors=scan.descriptors[:0],
        pixels=scan.pixels[:0],
        points=scan.points[:0],
    )
    return replace(percept, scans=(none,))


def test_the_laws_of_a_learner() -> None:
    check_learner(PaperObjects, [(seen(w, i), w) for i in range(2) for w in WORDS])


def test_a_feature_matches_by_lowes_ratio() -> None:
    memory = taught()
    for word in WORDS:
        scores = memory.scores(seen(word, 7))
        assert max(scores, key=lambda it: scores[it]) == word
        assert scores[word] > 0.9


def test_a_glimpse_of_a_word_is_enough_when_nothing_else_matches() -> None:
    new = percept_of(np.random.default_rng(5), prototypes(77))
    glimpse = replace(new, scans=(*new.scans * 9, *seen("cup", 1).scans))
    assert taught().scores(glimpse)["cup"] < 0.2
    assert taught().predict_proba_one(glimpse)["cup"] > 0.9


def test_a_thing_without_features_has_no_word() -> None:
    memory = taught()
    assert memory.predict_proba_one(featureless()) == dict.fromkeys(sorted(WORDS), 0.0)
    memory.learn_one(featureless(), "glass")
    assert memory.scores(seen("cup", 3))["glass"] == 0
    assert memory.predict_proba_one(replace(featureless(), scans=())) == dict.fromkeys(
        sorted([*WORDS, "glass"]), 0.0
    )


def test_scores_are_means_over_the_scans() -> None:
    cup, book = seen("cup", 8), seen("book", 8)
    both = replace(cup, scans=(cup.scans[0], book.scans[0]))
    scores = taught().scores(both)
    assert scores["cup"] == pytest.approx(taught().scores(cup)["cup"] / 2, abs=0.05)
    assert scores["book"] == pytest.approx(taught().scores(book)["book"] / 2, abs=0.05)


def test_a_thing_is_where_its_nearest_features_are() -> None:
    assert taught().locate(seen("cup", 60), "cup") == pytest.approx((0.1, 0.2, 0.9))
    assert taught().locate(seen("cup", 60), "unicorn") is None
    assert taught().locate(featureless(), "cup") is None


def test_opencvs_own_sift_looks_at_the_frames() -> None:
    frames = [frame_of(Card(0.1, 0.8, seed=3), noise=0.001, seed=i) for i in range(3)]
    (percept,) = look(Camera(*frames), 3).percepts
    memory = PaperObjects()
    memory.learn_one(percept, "book")
    stored = _scans(percept)[0].descriptors
    assert 10 < len(stored) < len(percept.scans[0].descriptors)
    place = memory.locate(percept, "book")
    assert isinstance(place, Point)
    assert percept.region.place is not None
    assert np.linalg.norm(np.subtract(place, percept.region.place)) < 0.1
    assert memory.scores(percept)["book"] > 0.8
