"""The index: exact while it is small, nearly so with trees, and forgets exactly."""

from __future__ import annotations

import logging
import subprocess
import sys
import threading
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tabletop import prototypes

from kille.perception.descriptor_index import (
    SEARCHES,
    AtOnce,
    Background,
    Builder,
    Descriptors,
    Index,
    Rows,
    View,
    distances,
    index,
    partition,
    rooted,
)

WORDS = "abcd"


@cache
def view(key: int, rows: int = 60, word: str | None = None) -> View:
    """A view of one of four things, each picture of which has noise of its own."""
    label = word or WORDS[key % len(WORDS)]
    thing = prototypes(ord(label), rows)
    chance = np.random.default_rng([key, ord(label)])
    seen = chance.permutation(thing + chance.normal(0, 4, thing.shape))
    return View(key, label, np.clip(seen, 0, 255).astype(np.uint8))


@cache
def asked(rows: int = 60) -> Rows:
    return rooted(np.concatenate([view(1000 + i, rows).descriptors for i in range(4)]))


def exact(views: Sequence[View], query: Rows) -> Rows:
    """The distances by comparing with every descriptor of every word."""
    labels = sorted({it.label for it in views})
    nearest = np.full((len(query), len(labels)), np.inf, np.float32)
    for it in views:
        if len(it.descriptors):
            column = labels.index(it.label)
            apart = distances(query, rooted(it.descriptors)).min(axis=1)
            nearest[:, column] = np.minimum(nearest[:, column], apart)
    return nearest


@pytest.fixture(params=["trees", "faiss"])
def search(request: pytest.FixtureRequest) -> str:
    if request.param == "faiss":
        pytest.importorskip("faiss", reason="the extra kille[faiss] is not installed")
    return str(request.param)


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Trees from so few descriptors on that tests are quick."""
    monkeypatch.setattr(partition, "TAIL", 150)
    monkeypatch.setattr(partition, "FACTOR", 4)


@pytest.fixture(params=[AtOnce, Background], ids=["at once", "background"])
def builder(request: pytest.FixtureRequest) -> Builder:
    made: Builder = request.param()
    return made


def test_an_empty_index_has_no_neighbours() -> None:
    empty = Index()
    assert empty.labels == ()
    assert empty.nearest(asked()).shape == (240, 0)
    assert Index([view(0, rows=0, word="a")]).nearest(asked()).tolist() == [
        [np.inf]
    ] * len(asked())


def test_nothing_asked_nothing_found(small: None) -> None:
    grown = Index([view(i) for i in range(8)])
    assert grown.nearest(asked()[:0]).shape == (0, 4)


def test_a_search_that_does_not_exist_is_named() -> None:
    with pytest.raises(ValueError, match=r"no search is called 'tree': .* mean trees"):
        Index(search="tree")


@settings(max_examples=50)
@given(st.lists(st.one_of(st.integers(0, 11), st.just("forget")), max_size=25))
def test_any_lessons_in_the_exact_regime_equal_naive_search(
    acts: list[int | str],
) -> None:
    grown, kept = Index(), dict[int, View]()
    for number, act in enumerate(acts):
        if isinstance(act, int):
            kept[number] = view(number, rows=20 * (act % 4), word=WORDS[act % 3])
            grown.learn(kept[number])
        elif kept:
            grown.forget(key := list(kept)[number % len(kept)])
            del kept[key]
    assert list(grown.views.values()) == list(kept.values())
    assert grown.labels == tuple(sorted({it.label for it in kept.values()}))
    sizes = dict.fromkeys(grown.labels, 0)
    for it in kept.values():
        sizes[it.label] += len(it.descriptors)
    assert grown.sizes.tolist() == list(sizes.values())
    query = asked(20)
    assert np.allclose(
        grown.nearest(query), exact(list(kept.values()), query), atol=1e-3
    )
    assert np.array_equal(grown.nearest(query), Index(kept.values()).nearest(query))


def test_trees_find_what_exact_search_finds(small: None, search: str) -> None:
    views = [view(i, 200) for i in range(16)]
    query = asked(200)
    found, true = Index(views, search=search).nearest(query), exact(views, query)
    assert (found.argmin(axis=1) == true.argmin(axis=1)).mean() > 0.97
    assert np.median(np.abs(found.min(axis=1) - true.min(axis=1))) < 0.01


def test_what_is_found_for_a_query_does_not_depend_on_the_others(small: None) -> None:
    """They are searched for in another order than they are asked in."""
    grown, query = Index([view(i) for i in range(16)]), asked(20)
    together = grown.nearest(query)
    apart = np.concatenate([grown.nearest(it[None]) for it in query])
    assert together == pytest.approx(apart, abs=2e-3)
    assert grown.nearest(query[::-1]) == pytest.approx(together[::-1], abs=2e-3)


def test_an_index_that_learned_and_forgot_is_the_one_given_what_is_left(
    small: None, search: str, builder: Builder
) -> None:
    grown = Index(builder=builder, search=search)
    for i in range(40):
        grown.learn(view(i))
        if i % 7 == 3:
            grown.nearest(asked(5))
    for key in (0, 3, 17, 18, 39):
        grown.forget(key)
    grown.learn(view(50))
    settled = grown.settled().nearest(asked())
    fresh = Index(list(grown.views.values()), search=search)
    assert np.array_equal(settled, fresh.nearest(asked()))


def test_what_was_forgotten_is_no_neighbour_while_trees_still_hold_it(
    small: None, stalled: Stalled
) -> None:
    grown = Index([view(i) for i in range(40)], builder=stalled)
    stalled.release()
    before = grown.settled().nearest(asked())
    stalled.hold()
    for key in range(1, 40, 4):
        grown.forget(key)
    assert grown.labels == ("a", "c", "d")
    after = grown.nearest(asked())
    assert after.shape == (240, 3)
    rest = list(grown.views.values())
    true = exact(rest, asked())
    near = true.min(axis=1) < 0.3
    assert (after.argmin(axis=1) == true.argmin(axis=1))[near].mean() > 0.97
    # "b" was near its own features; whatever else is, is far.
    assert np.median(before[60:120, 1]) < 0.3 < np.median(after[60:120].min(axis=1))
    grown.learn(view(1))
    assert np.median(grown.nearest(asked())[60:120, 1]) < 0.35


class Stalled(Background):
    """A background that builds nothing while it is held."""

    def __init__(self) -> None:
        super().__init__(patience=0)
        self._kept: list[index.Part] = []
        self._held = True

    def begin(self, parts: Sequence[index.Part]) -> None:
        self._kept.extend(parts)
        if not self._held:
            self.release()

    def hold(self) -> None:
        self._held = True

    def release(self) -> None:
        self._held = False
        super().begin(self._kept)
        self._kept = []


@pytest.fixture
def stalled() -> Stalled:
    return Stalled()


def test_learning_counts_at_once_while_trees_are_built(
    small: None, stalled: Stalled
) -> None:
    views = [view(i) for i in range(40)]
    grown = Index(views[:20], builder=stalled)
    for it in views[20:]:
        grown.learn(it)
        assert np.allclose(grown.nearest(it_rows(it)).min(axis=1), 0, atol=2e-3)
    assert np.allclose(grown.nearest(asked()), exact(views, asked()), atol=1e-3)
    stalled.release()
    near = grown.settled().nearest(asked()).min(axis=1)
    assert np.median(np.abs(near - exact(views, asked()).min(axis=1))) < 0.01


def it_rows(it: View) -> Rows:
    return rooted(it.descriptors)


def test_a_sketch_answers_for_very_many_views(
    small: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(index, "_SKETCH", 400)
    monkeypatch.setattr(index, "_SKETCHED", 800)
    monkeypatch.setattr(index, "_EXACT", 100)
    stalled = Stalled()
    views = [view(i) for i in range(60)]
    grown = Index(views, builder=stalled)
    first = grown.nearest(asked())
    assert (first[:60].argmin(axis=1) == 0).mean() > 0.25
    sketch = grown._sketches[0]
    sketch.build()
    second = grown.nearest(asked())
    right = np.repeat(range(4), 60)
    assert (second.argmin(axis=1) == right).mean() > (
        first.argmin(axis=1) == right
    ).mean()
    stalled.release()
    last = grown.settled().nearest(asked())
    assert (last.argmin(axis=1) == right).mean() > 0.95
    assert not grown._sketches
    assert np.array_equal(last, Index(views).nearest(asked()))


def test_a_copy_learns_and_forgets_for_itself(small: None, builder: Builder) -> None:
    grown = Index([view(i) for i in range(20)], builder=builder)
    before = grown.settled().nearest(asked())
    twin = grown.copy()
    for i in range(20, 30):
        twin.learn(view(i, word="e"))
    twin.forget(0)
    assert twin.labels == (*WORDS, "e")
    assert grown.labels == tuple(WORDS)
    assert 0 in grown.views
    assert 0 not in twin.views
    assert np.array_equal(grown.settled().nearest(asked()), before)
    fresh = Index(list(twin.views.values()))
    assert np.array_equal(twin.settled().nearest(asked()), fresh.nearest(asked()))


def test_keys_are_taken_once() -> None:
    grown = Index([view(1)])
    with pytest.raises(ValueError, match="the key 1 was learned before"):
        grown.learn(view(1))
    with pytest.raises(KeyError):
        grown.forget(2)
    assert list(grown.views) == [1]


def test_a_key_that_was_forgotten_may_stand_for_something_else(small: None) -> None:
    grown = Index([view(i) for i in range(20)])
    grown.nearest(asked())
    grown.forget(5)
    grown.learn(View(5, "new", view(0, word="z").descriptors))
    assert grown.nearest(it_rows(view(0, word="z")))[:, -1].max() < 2e-3


@pytest.fixture
def breaking(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(blocks: Sequence[Descriptors]) -> object:
        raise MemoryError("no more memory")

    monkeypatch.setitem(SEARCHES, "broken", lambda: broken)


def test_what_cannot_be_built_is_reported_and_the_rest_goes_on_answering(
    small: None, breaking: None, caplog: pytest.LogCaptureFixture
) -> None:
    views = [view(i) for i in range(20)]
    grown = Index(views, builder=Background(), search="broken")
    with caplog.at_level(logging.ERROR), pytest.raises(MemoryError):
        grown.settled()
    await_threads()
    assert "could not be built" in caplog.text
    assert np.allclose(grown.nearest(asked()), exact(views, asked()), atol=1e-3)


def await_threads() -> None:
    for thread in threading.enumerate():
        if thread.name == "kille-index":
            thread.join(5)


def test_threads_end_when_there_is_nothing_to_build(small: None) -> None:
    grown = Index([view(i) for i in range(60)], builder=Background())
    grown.settled()
    await_threads()
    assert "kille-index" not in {it.name for it in threading.enumerate()}


def test_what_goes_on_after_the_main_thread_has_ended_builds_for_itself() -> None:
    program = """
import threading
import numpy as np
from kille.perception.descriptor_index import Background, Index, View

def work():
    threading.main_thread().join()
    rows = np.random.default_rng(0).integers(0, 255, (9_000, 128)).astype(np.uint8)
    index = Index([View(0, "a", rows)], builder=Background(patience=0))
    print(index.settled().nearest(np.eye(128, dtype=np.float32)).shape)

threading.Thread(target=work).start()
"""
    ended = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert ended.stdout.strip() == "(128, 1)"
    assert ended.stderr == ""


def test_a_program_may_end_while_trees_are_built() -> None:
    program = """
import numpy as np
from kille.perception.descriptor_index import Background, Index, View
rows = np.random.default_rng(0).integers(0, 255, (50_000, 128)).astype(np.uint8)
index = Index([View(i, "a", rows) for i in range(8)], builder=Background())
raise KeyboardInterrupt
"""
    ended = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert ended.stderr.strip().splitlines()[-1] == "KeyboardInterrupt"
    assert "kille-index" not in ended.stderr
    assert ended.stdout == ""


@pytest.mark.parametrize("seed", [0, 1])
def test_any_order_of_acts_while_parts_are_merged(small: None, seed: int) -> None:
    chance = np.random.default_rng(seed)
    grown, kept = Index(builder=Background(patience=0)), dict[int, View]()
    for number in range(40):
        kept[number] = view(number)
        grown.learn(kept[number])
        if number % 5 == 4:
            grown.forget(key := int(chance.choice(list(kept))))
            del kept[key]
        if chance.random() < 0.3:
            some = list(kept.values())[int(chance.integers(len(kept)))]
            near = grown.nearest(it_rows(some))[:, grown.labels.index(some.label)]
            assert np.median(near) < 0.2
    fresh = Index(kept.values()).nearest(asked())
    assert np.array_equal(grown.settled().nearest(asked()), fresh)


@given(st.integers(0, 1000))
def test_root_sift_has_length_one(seed: int) -> None:
    rows = rooted(prototypes(seed, 5).clip(0, 255).astype(np.uint8))
    assert np.linalg.norm(rows, axis=1) == pytest.approx(np.ones(5), abs=1e-5)
    assert np.diag(distances(rows, rows)) == pytest.approx(np.zeros(5), abs=2e-3)
