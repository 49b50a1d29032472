"""Features seen again in later scans: which they are, and what is found for them."""

from __future__ import annotations

from collections.abc import Iterator
from threading import current_thread, main_thread

import numpy as np
import pytest
from numpy.typing import NDArray
from tabletop import prototypes

from kille.perception.descriptor_index import (
    AGAIN,
    NOBODY,
    Index,
    Repeats,
    Rows,
    View,
    distances,
    find_repeats,
    index_parts,
    partition,
    rooted,
)
from kille.perception.descriptor_index import index as growing
from kille.scene import Features

THINGS = {"cup": 1, "book": 2, "shoe": 3}


def scan(thing: int, seed: int, count: int = 60) -> Features:
    """A scan of a still thing: most of its features are seen in it, with noise."""
    chance = np.random.default_rng([thing, seed])
    seen = chance.permutation(count)[: count * 4 // 5]
    noisy = prototypes(thing, count) + chance.normal(0, 1, (count, 128))
    places = np.random.default_rng(thing).uniform(0, 480, (count, 2))
    shaken = places + chance.normal(0, 0.3, (count, 2))
    return Features(
        np.clip(noisy[seen], 0, 255).astype(np.uint8),
        shaken[seen].astype(np.float32),
        np.zeros((len(seen), 3), np.float32),
    )


def rows_of(scans: list[Features]) -> Rows:
    return rooted(np.concatenate([it.descriptors for it in scans]))


def taught() -> Index:
    views = [
        View(f"{word} {seed}", word, scan(thing, 100 + seed).descriptors)
        for word, thing in THINGS.items()
        for seed in range(3)
    ]
    return Index(views)


def looked() -> tuple[list[Features], Rows, Repeats]:
    scans = [scan(1, seed) for seed in range(6)]
    query = rows_of(scans)
    return scans, query, find_repeats(query, scans)


def test_each_feature_is_the_first_of_its_kind_or_like_that_of_an_earlier_scan() -> (
    None
):
    scans, query, (firsts, same, far) = looked()
    own = np.repeat(np.arange(len(scans)), [len(it.pixels) for it in scans])
    standing = firsts[same]
    again = standing != np.arange(len(query))
    assert (own[standing[again]] < own[again]).all()
    apart = np.diag(distances(query, query[standing]))
    assert (apart[again] < AGAIN).all()
    assert far == pytest.approx(np.where(again, apart, 0), abs=2e-3)
    assert (standing[firsts] == firsts).all()
    assert len(scans[0].pixels) <= len(firsts) < len(query) / 3


def test_firsts_are_in_the_order_of_how_often_they_are_seen() -> None:
    _, _, (firsts, same, _) = looked()
    assert (np.diff(np.bincount(same, minlength=len(firsts))) >= 0).all()


def test_in_order_the_same_features_stand_together_and_repeat_the_same_ones() -> None:
    _, query, repeats = looked()
    order, put = repeats.in_order()
    assert sorted(order) == list(range(len(query)))
    assert (np.diff(put.same) >= 0).all()
    assert np.array_equal(order[put.firsts], repeats.firsts)
    assert np.array_equal(put.same, repeats.same[order])
    assert np.array_equal(put.far, repeats.far[order])


def test_features_of_things_that_moved_far_are_all_different() -> None:
    one = scan(1, 0)
    other = Features(one.descriptors, one.pixels + np.float32([0, 1000]), one.points)
    firsts, same, _ = find_repeats(rows_of([one, other]), [one, other])
    assert len(firsts) == len(same) == 2 * len(one.pixels)


def test_scans_without_features_repeat_nothing() -> None:
    nothing, some = scan(1, 0, count=0), scan(1, 1)
    scans = [nothing, some, nothing]
    firsts, same, _ = find_repeats(rows_of(scans), scans)
    assert firsts[same].tolist() == list(range(len(some.pixels)))


@pytest.mark.parametrize("tail", [4000, 100])
def test_nothing_is_found_for_scans_without_features(
    tail: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(partition, "TAIL", tail)
    nothing, some = scan(1, 0, count=0), scan(1, 1)
    for scans in ([], [nothing], [nothing] * 3):
        assert len(taught().neighbours_in(scans, 0.45).distances) == 0
    found = taught().neighbours_in([nothing, some, nothing], 0.45)
    assert len(found.distances) == len(some.pixels)
    assert np.isfinite(found.distances).any()


def test_nobody_is_near_in_an_index_without_views() -> None:
    scans, query, _ = looked()
    found = Index().neighbours_in(scans, 0.45)
    assert len(found.words) == len(query)
    assert (found.words == NOBODY).all()
    assert np.isinf(found.distances).all()


def test_a_single_scan_is_searched_for_as_its_features_are() -> None:
    scans, _, _ = looked()
    found = taught().neighbours_in(scans[:1], 0.45)
    each = taught().neighbours(rows_of(scans[:1]))
    assert np.array_equal(found.words, each.words)
    assert np.array_equal(found.distances, each.distances)


def test_the_first_scan_is_searched_for_before_the_others_have_come(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """And only the features that are new in the others are searched for later."""
    monkeypatch.setattr(partition, "TAIL", 100)
    searched, search = [], index_parts.Part.find_rows

    def find_rows(
        part: index_parts.Part, query: Rows, owners: NDArray[np.intp]
    ) -> NDArray[np.int32]:
        searched.append(len(query))
        return search(part, query, owners)

    monkeypatch.setattr(index_parts.Part, "find_rows", find_rows)
    scans, _, repeats = looked()

    class Coming(list[Features]):
        def __iter__(self) -> Iterator[Features]:
            yield self[0]
            assert searched == [len(scans[0].pixels)]
            yield from self[1:]

    taught().neighbours_in(Coming(scans), 0.45)
    assert searched[1:] == [len(repeats.firsts) - len(scans[0].pixels)]
    assert searched[1] > 0


@pytest.mark.parametrize(("tail", "few"), [(4000, 0), (100, 0), (100, 20_000)])
def test_what_is_found_for_repeats_is_nearly_what_is_found_for_each(
    tail: int, few: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exactly so for the first of each, and never nearer than the nearest is."""
    monkeypatch.setattr(partition, "TAIL", tail)
    monkeypatch.setattr(index_parts, "_FEW", few)
    scans, query, repeats = looked()
    index = taught()
    each, found = index.neighbours(query), index.neighbours_in(scans, 2)
    nearest, near = (it.distances.min(axis=1) for it in (each, found))
    firsts = repeats.firsts
    assert near[firsts] == pytest.approx(nearest[firsts], abs=2e-3)
    assert (near > nearest - 2e-3).all()
    assert (near < nearest + 2 * AGAIN).all()
    assert np.median(near - nearest) < 0.01


@pytest.mark.parametrize("close", [1, 4, 24])
@pytest.mark.parametrize("within", [0.1, 0.45, 0.9])
def test_what_is_within_a_distance_is_found_for_all_repeats(
    within: float, close: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Among the newest views, which are searched exactly: neither the nearest that is
    so near is missed nor that of another word, and neither is nearer than it is."""
    monkeypatch.setattr(index_parts, "_CLOSE", close)
    scans, query, _ = looked()
    index = taught()
    each, found = index.neighbours(query), index.neighbours_in(scans, within)
    for _ in range(2):
        (word, true), (got_word, got) = each.nearest(), found.nearest()
        near = true < within
        assert near.any() or within < 0.9
        assert (got_word == word)[near].all()
        assert got[near] == pytest.approx(true[near], abs=2e-3)
        assert (got > true - 2e-3).all()
        each, found = each.without(word), found.without(word)


def test_descriptors_are_the_same_gathered_or_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(partition, "TAIL", 100)
    scans, query, _ = looked()
    found = []
    for few in (0, 20_000):
        monkeypatch.setattr(index_parts, "_FEW", few)
        found += [taught().neighbours(query), taught().neighbours_in(scans, 0.45)]
    for one, other in zip(found[:2], found[2:], strict=True):
        assert np.array_equal(one.words, other.words)
        assert np.array_equal(one.distances, other.distances)


@pytest.mark.parametrize("repeated", [False, True])
def test_two_threads_find_what_one_finds(
    repeated: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(partition, "TAIL", 100)
    scans, query, _ = looked()
    threads, compare = [], index_parts.Exact.neighbours

    def compare_in_thread(
        exact: index_parts.Exact, query: Rows
    ) -> index_parts.Neighbours:
        threads.append(current_thread())
        return compare(exact, query)

    monkeypatch.setattr(index_parts.Exact, "neighbours", compare_in_thread)
    found = []
    for pairs in (1, 10**9):
        monkeypatch.setattr(growing, "_WORTH_A_THREAD", pairs)
        index = taught()
        index.learn(View("newest", "cup", scan(1, 200).descriptors))
        found.append(
            index.neighbours_in(scans, 0.45) if repeated else index.neighbours(query)
        )
    assert [it is main_thread() for it in threads] == [False, True]
    assert np.array_equal(found[0].words, found[1].words)
    assert np.array_equal(found[0].distances, found[1].distances)
