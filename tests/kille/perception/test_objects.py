"""Object words: the laws of a learner, open words, forgetting, places, the index."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tabletop import Camera, Card, frame_of, percept_of, prototypes

from kille.perception import index
from kille.perception.index import Index, View, distances, rooted
from kille.perception.learners import check_learner
from kille.perception.look import look
from kille.perception.objects import ObjectMemory, view_of
from kille.scene import Percept, Point
from kille.sensors.recordings import open_recording
from kille.sensors.synthetic import open_synthetic

WORDS = {"cup": 1, "book": 2, "shoe": 3}


def seen(word: str, seed: int) -> Percept:
    return percept_of(
        np.random.default_rng([seed, WORDS[word]]), prototypes(WORDS[word])
    )


def lessons(rounds: int) -> list[tuple[Percept, str]]:
    return [(seen(word, i), word) for i in range(rounds) for word in WORDS]


def taught(rounds: int = 2) -> ObjectMemory:
    memory = ObjectMemory()
    for key, (percept, word) in enumerate(lessons(rounds)):
        memory.learn_one(percept, word, key=key)
    return memory


def featureless() -> Percept:
    percept = seen("cup", 0)
    return replace(percept, scans=(replace_descriptors(percept, 0),))


def replace_descriptors(percept: Percept, count: int) -> object:
    scan = percept.scans[0]
    return replace(
        scan,
        descriptors=scan.descriptors[:count],
        pixels=scan.pixels[:count],
        points=scan.points[:count],
    )


def best(degrees: dict[str, float]) -> str:
    return max(degrees, key=lambda word: degrees[word])


def test_the_laws_of_a_learner() -> None:
    check_learner(ObjectMemory, lessons(2))


def test_the_laws_hold_with_trees_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(index, "_TAIL", 100)
    check_learner(ObjectMemory, lessons(2))


def test_what_was_learned_is_known_again_in_new_views() -> None:
    memory = taught()
    for word in WORDS:
        degrees = memory.predict_proba_one(seen(word, 99))
        assert best(degrees) == word
        assert degrees[word] > 0.6


def test_what_was_never_taught_is_not_asserted() -> None:
    degrees = taught().predict_proba_one(
        percept_of(np.random.default_rng(5), prototypes(77))
    )
    assert set(degrees) == set(WORDS)
    assert max(degrees.values()) < 0.3


def test_one_word_is_no_reason_to_use_it_for_everything() -> None:
    memory = ObjectMemory()
    memory.learn_one(seen("cup", 0), "cup", key=0)
    assert memory.predict_proba_one(seen("cup", 1))["cup"] > 0.6
    assert memory.predict_proba_one(seen("book", 1))["cup"] < 0.3


def test_two_words_for_one_thing_share_its_degree() -> None:
    memory = ObjectMemory()
    memory.learn_one(seen("cup", 0), "cup", key=0)
    memory.learn_one(seen("cup", 1), "mug", key=1)
    degrees = memory.predict_proba_one(seen("cup", 2))
    assert abs(degrees["cup"] - degrees["mug"]) < 0.5


def test_a_thing_without_features_is_learned_and_stays_unknown() -> None:
    memory = taught()
    memory.learn_one(featureless(), "glass", key="glass")
    assert memory.predict_proba_one(featureless()) == {}
    assert memory.predict_proba_one(seen("cup", 9))["glass"] == 0
    only = ObjectMemory()
    only.learn_one(featureless(), "glass", key=0)
    assert only.predict_proba_one(seen("cup", 9)) == {"glass": 0}


def test_a_memory_is_built_anew_from_its_views() -> None:
    memory = taught()
    stored = [(it.key, it.label, it.descriptors.copy()) for it in memory.views]
    again = ObjectMemory.of(View(*row) for row in stored)
    assert again.labels == memory.labels == ("book", "cup", "shoe")
    for word in WORDS:
        percept = seen(word, 50)
        assert again.predict_proba_one(percept) == memory.predict_proba_one(percept)


def test_a_copy_knows_the_same_and_learns_for_itself() -> None:
    memory = taught()
    asked, new = seen("cup", 31), percept_of(np.random.default_rng(4), prototypes(4))
    degrees = memory.predict_proba_one(asked)
    twin = memory.copy()
    assert twin.predict_proba_one(asked) == degrees
    twin.learn_one(new, "banana", key="new")
    assert best(twin.predict_proba_one(new)) == "banana"
    assert "banana" not in memory.labels
    assert memory.predict_proba_one(asked) == degrees
    memory.forget(memory.views[0].key)
    assert len(twin.views) == len(memory.views) + 2


def test_a_view_keeps_each_feature_once() -> None:
    still = seen("cup", 0)
    count = len(still.scans[0].descriptors)
    assert (
        len(
            view_of(
                replace(still, scans=still.scans[:1] * 10), "cup", key=0
            ).descriptors
        )
        == count
    )
    both = replace(still, scans=(still.scans[0], seen("book", 0).scans[0]))
    assert len(view_of(both, "cup", key=0).descriptors) == 2 * count


def test_a_thing_is_where_its_best_features_are() -> None:
    memory, percept = taught(), seen("cup", 60)
    assert memory.locate(percept, "cup") == pytest.approx((0.1, 0.2, 0.9), abs=1e-6)
    unmeasured = [
        replace(scan, points=np.full_like(scan.points, np.nan))
        for scan in percept.scans
    ]
    nowhere = replace(percept, scans=tuple(unmeasured))
    assert memory.locate(nowhere, "cup") == percept.region.place
    assert memory.locate(percept, "unicorn") == percept.region.place


def test_points_that_were_not_measured_do_not_count() -> None:
    percept = seen("cup", 61)
    points = percept.scans[0].points.copy()
    points[::2] = np.nan
    half = replace(percept, scans=(replace(percept.scans[0], points=points),))
    assert taught().locate(half, "cup") == pytest.approx((0.1, 0.2, 0.9), abs=1e-6)


def test_a_place_is_near_the_thing_in_a_scene() -> None:
    frames = [frame_of(Card(0.1, 0.8, seed=3), noise=0.001, seed=i) for i in range(10)]
    (percept,) = look(Camera(*frames)).percepts
    memory = ObjectMemory()
    memory.learn_one(percept, "book", key=0)
    found, place = memory.locate(percept, "book"), percept.region.place
    assert isinstance(found, Point)
    assert place is not None
    assert np.linalg.norm(np.subtract(found, place)) < 0.05


def view(key: int, label: str, rows: int, seed: int) -> View:
    return View(key, label, prototypes(seed, rows).clip(0, 255).astype(np.uint8))


def test_trees_find_what_exact_search_finds(monkeypatch: pytest.MonkeyPatch) -> None:
    views = [view(i, "abcd"[i % 4], 300, i) for i in range(12)]
    noise = np.random.default_rng(0).normal(0, 6, (100, 128))
    queries = np.concatenate([it.descriptors[:25] for it in views[:4]])
    query = rooted(np.clip(queries + noise, 0, 255).astype(np.uint8))
    exact = Index(views).nearest(query)
    monkeypatch.setattr(index, "_TAIL", 500)
    trees = Index(views).nearest(query)
    assert exact.argmin(axis=1).tolist() == [i // 25 for i in range(100)]
    assert (exact.argmin(axis=1) == trees.argmin(axis=1)).mean() > 0.97
    assert np.nanmedian(np.abs(exact.min(axis=1) - trees.min(axis=1))) < 1e-3


def test_an_index_takes_over_old_parts_and_equals_a_new_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(index, "_TAIL", 500)
    views = [view(i, "ab"[i % 2], 200, i) for i in range(10)]
    query = rooted(views[3].descriptors)
    grown = Index(())
    for count in range(1, 11):
        grown = Index(views[:count], grown)
    assert np.array_equal(grown.nearest(query), Index(views).nearest(query))


@given(st.lists(st.integers(0, 9000), max_size=60))
def test_parts_hold_every_view_once_in_order_of_falling_size(sizes: list[int]) -> None:
    runs = index._runs(sizes)
    held = [i for run, _ in runs for i in range(len(sizes))[run]]
    assert held == list(range(len(sizes)))
    trees = [sum(sizes[run]) for run, is_tail in runs if not is_tail]
    assert all(8 * late <= early for early, late in pairwise(trees))
    assert all(sum(sizes[run]) <= 6000 for run, is_tail in runs if is_tail)


@given(st.integers(0, 1000))
def test_root_sift_has_length_one(seed: int) -> None:
    rows = rooted(prototypes(seed, 5).clip(0, 255).astype(np.uint8))
    assert np.linalg.norm(rows, axis=1) == pytest.approx(np.ones(5), abs=1e-5)
    assert np.diag(distances(rows, rows)) == pytest.approx(np.zeros(5), abs=2e-3)


def test_objects_of_one_real_scene_are_known_in_the_next(data: Path) -> None:
    memory = ObjectMemory()
    folder = str(data / "ycbv_scenes" / "0001")
    outlines = open_recording(folder).frame().outlines
    for name, outline in outlines.items():
        lesson = look(open_recording(folder), pointed=outline)
        memory.learn_one(lesson.percepts[0], name, key=name)
    asked = look(open_recording(str(data / "ycbv_scenes" / "0002")))
    mustard = asked.frame.outlines["mustard bottle"]
    for percept in asked.percepts:
        degrees = memory.predict_proba_one(percept)
        if (percept.region.mask & mustard).sum() > 0.5 * mustard.sum():
            assert best(degrees) == "mustard bottle"
            assert degrees["mustard bottle"] > 0.6
        else:
            assert max(degrees.values()) < 0.5


def test_ten_things_in_poses_not_seen_before() -> None:
    stage, memory = open_synthetic("synthetic:empty?seed=21"), ObjectMemory()
    for key in range(2):
        for thing in stage.things():
            stage.show(thing)
            memory.learn_one(look(stage, 3).percepts[0], thing, key=f"{key}.{thing}")
    right = []
    for thing in stage.things():
        stage.show(thing)
        right.append(
            best(memory.predict_proba_one(look(stage, 3).percepts[0])) == thing
        )
    assert np.mean(right) >= 0.8


def test_nothing_is_asserted_wrongly_in_another_room(data: Path) -> None:
    memory = ObjectMemory()
    for scene in ("0001", "0002"):
        folder = str(data / "ycbv_scenes" / scene)
        for name, outline in open_recording(folder).frame().outlines.items():
            lesson = look(open_recording(folder), 4, pointed=outline)
            memory.learn_one(lesson.percepts[0], name, key=f"{scene}.{name}")
    asked = look(open_recording(str(data / "ycbv_scenes" / "0050")), 4)
    outlines = asked.frame.outlines
    for percept in asked.percepts:
        covered = {
            name: (mask & percept.region.mask).sum() / mask.sum()
            for name, mask in outlines.items()
        }
        degrees = memory.predict_proba_one(percept)
        wrong = {word: p for word, p in degrees.items() if covered.get(word, 0) < 0.3}
        assert max(wrong.values()) < 0.3
        if covered["cracker box"] > 0.5:
            assert best(degrees) == "cracker box"
