"""Very many words: the nearest are told apart, however the lessons came about."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tabletop import percept_of, prototypes

from kille.perception import nearest_words, objects
from kille.perception.descriptor_index import View
from kille.perception.features import NONE
from kille.perception.learners import check_learner
from kille.perception.likeness import Examples, Kernel, Likeness
from kille.perception.nearest_words import NearestWords
from kille.perception.objects import ObjectMemory
from kille.scene import Traits

KERNELS = {"colour": Kernel(1.0, 0.5), "size": Kernel(0.5, 0.2)}
LENGTHS = {"colour": 4, "size": 3}


def traits_of(chance: np.random.Generator, lacking: float = 0.0) -> Traits:
    return {
        cue: chance.random(length, np.float32)
        for cue, length in LENGTHS.items()
        if chance.random() >= lacking
    }


def views_of(words: Sequence[str], seed: int = 1, lacking: float = 0.0) -> list[View]:
    chance = np.random.default_rng(seed)
    return [
        View(key, word, NONE.descriptors, traits_of(chance, lacking))
        for key, word in enumerate(words)
    ]


def by_word(views: Sequence[View]) -> dict[str, tuple[View, ...]]:
    words = sorted({it.label for it in views})
    return {word: tuple(it for it in views if it.label == word) for word in words}


def nearest(views: Sequence[View], old: NearestWords | None = None) -> NearestWords:
    words = by_word(views)
    if old is not None:  # what has not changed is the same, as in an index
        before = old._words
        words = {
            word: before[word] if before.get(word) == some else some
            for word, some in words.items()
        }
    return NearestWords(words, list(words), KERNELS, old)


def assert_alike(one: Likeness, other: Likeness) -> None:
    assert one.scores.keys() == other.scores.keys()
    for cue, scores in other.scores.items():
        assert one.scores[cue] == pytest.approx(scores, abs=1e-5)
        assert one.unlike[cue] == pytest.approx(other.unlike[cue], abs=1e-5)
        assert one.others[cue] == pytest.approx(other.others[cue], abs=1e-5)


@given(st.integers(0, 1000), st.integers(1, 12))
def test_where_all_words_are_near_it_is_the_regression(seed: int, words: int) -> None:
    views = views_of([f"w{n % words}" for n in range(3 * words)], seed, lacking=0.2)
    asked = traits_of(np.random.default_rng(seed + 1))
    labels = sorted(by_word(views))
    found = nearest(views).likeness(asked)
    assert_alike(found, Examples(views, labels, KERNELS).likeness(asked))


@given(st.data())
def test_what_is_kept_answers_as_if_it_were_made_anew(drawn: st.DataObject) -> None:
    """Whatever was learned and forgotten, and in whatever steps."""
    words = drawn.draw(st.lists(st.sampled_from("abcdefgh"), min_size=1, max_size=25))
    views = views_of(words, len(words), lacking=0.2)
    asked = traits_of(np.random.default_rng(0))
    kept: NearestWords | None = None
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(nearest_words, "_NEAREST", 3)
        patch.setattr(nearest_words, "_COMPARED", 16)
        patch.setattr(nearest_words, "_SPARE", 4)
        for _ in range(drawn.draw(st.integers(1, 5))):
            gone = drawn.draw(st.sets(st.sampled_from(range(len(views)))))
            some = [it for n, it in enumerate(views) if n not in gone] or views[:1]
            kept = nearest(some, kept)
            assert_alike(kept.likeness(asked), nearest(some).likeness(asked))


def test_of_words_that_are_not_near_it_says_what_it_says_of_any_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(nearest_words, "_NEAREST", 5)
    views = views_of([f"w{n:03}" for n in range(200)])
    found = nearest(views).likeness(views[77].traits)
    total = sum(found.scores.values(), np.zeros(200))
    other = sum(found.others.values())
    assert total.argmax() == 77
    assert total[77] > other + 0.5
    assert np.sum(total != pytest.approx(other)) <= 5
    assert sum(it[77] for it in found.unlike.values()) == pytest.approx(0, abs=1e-5)


def test_vectors_of_another_length_than_most_are_unknown() -> None:
    views = views_of(["a", "b", "c"])
    odd = View(9, "d", NONE.descriptors, {"colour": np.float32([1, 2])})
    found = nearest([*views, odd]).likeness(views[0].traits)
    assert np.isinf(found.unlike["colour"][3])
    others = [View(n, "e", NONE.descriptors, odd.traits) for n in range(10, 20)]
    changed = nearest([*views, odd, *others], nearest([*views, odd]))
    found = changed.likeness(odd.traits)
    assert found.unlike["colour"][3] == pytest.approx(0, abs=1e-5)
    assert np.isinf(found.unlike["colour"][:3]).all()


def test_the_nearest_view_is_the_likest_of_the_word() -> None:
    views = views_of(["a", "b"] * 3)
    assert nearest(views).nearest(views[3].traits, 1) is views[3]
    assert nearest(views).nearest({}, 1) is None


@pytest.fixture
def many(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two words are very many."""
    monkeypatch.setattr(objects, "MANY", 1)


WORDS = {"cup": 1, "book": 2, "shoe": 3}


def view_of_thing(word: str, seed: int) -> objects.Percept:
    """A view of the thing, which looks as things of its word do, but for a little."""
    chance = np.random.default_rng([seed, WORDS[word]])
    traits = traits_of(np.random.default_rng(WORDS[word]))
    own = {
        cue: vector + 0.1 * chance.random(len(vector), np.float32)
        for cue, vector in traits.items()
    }
    percept = percept_of(chance, prototypes(WORDS[word]))
    return replace(percept, measure=lambda: own)


@pytest.mark.usefixtures("many")
def test_the_laws_of_a_learner_hold() -> None:
    check_learner(
        ObjectMemory,
        [(view_of_thing(word, n), word) for n in range(2) for word in WORDS],
    )


@pytest.mark.usefixtures("many")
def test_what_is_denied_weakens_a_word_and_lessons_are_taken_back() -> None:
    memory = ObjectMemory()
    for key, word in enumerate([*WORDS, *WORDS]):
        memory.learn_one(view_of_thing(word, key), word, key=key)
    asked = view_of_thing("cup", 9)
    before = memory.predict_proba_one(asked)
    memory.deny_one(asked, "cup", key="no")
    denied = memory.predict_proba_one(asked)
    assert denied["cup"] < before["cup"]
    memory.weigh("cup", "colour", False, key="said")
    assert memory.predict_proba_one(asked) != denied
    memory.forget("said")
    memory.forget("no")
    assert memory.predict_proba_one(asked) == pytest.approx(before, abs=1e-5)
    assert memory.nearest(asked, "cup") in memory.views


def without_cue(percept: objects.Percept, cue: str) -> objects.Percept:
    """The same, but nothing is known by one of its cues."""
    traits = {name: it for name, it in percept.traits.items() if name != cue}
    return replace(percept, measure=lambda: traits)


def test_every_cue_of_a_thing_has_a_score_whatever_its_nearest_words_lack(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kille.perception.nearest_words._NEAREST", 1)
    whole, asked = views_of(["a", "b"]), views_of(["a"])[0].traits
    bare = {cue: it for cue, it in whole[0].traits.items() if cue != "size"}
    found = nearest([replace(whole[0], traits=bare), whole[1]]).likeness(asked)
    assert found.scores.keys() == found.others.keys() == found.unlike.keys()


@pytest.mark.usefixtures("many")
@pytest.mark.parametrize("counts", [True, False])
def test_a_word_may_be_known_by_other_cues_than_a_thing_is_seen_by(
    counts: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kille.perception.nearest_words._NEAREST", 1)
    memory = ObjectMemory()
    for key, word in enumerate([*WORDS, *WORDS]):
        shown = view_of_thing(word, key)
        shown = shown if word == "book" else without_cue(shown, "size")
        memory.learn_one(shown, word, key=key)
    memory.weigh("cup", "colour", counts, key="said")
    for word in WORDS:
        found = memory.predict_proba_one(view_of_thing(word, 9))
        assert max(found, key=lambda it: found[it]) == word


def test_one_word_more_leaves_the_robot_as_sure_as_it_was(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(objects, "MANY", 2)
    memory = ObjectMemory()
    for key, word in enumerate(["cup", "book"] * 4):
        memory.learn_one(view_of_thing(word, key), word, key=key)
    asked = view_of_thing("cup", 99)
    before = memory.predict_proba_one(asked)["cup"]
    for key in range(4):
        memory.learn_one(view_of_thing("shoe", key), "shoe", key=f"shoe {key}")
    assert memory.predict_proba_one(asked)["cup"] > before - 0.05


def test_where_all_words_are_near_lessons_say_of_each_other_what_they_do_there() -> (
    None
):
    views = views_of(["a", "b", "c"] * 3)
    ours, theirs = (
        nearest(views).left_out(),
        Examples(views, ["a", "b", "c"], KERNELS).left_out(),
    )
    assert ours is not None
    assert theirs is not None
    np.testing.assert_allclose(ours.scores, theirs.scores, atol=1e-5)
    assert ours.columns.tolist() == theirs.columns.tolist()
    assert nearest(views_of(["a", "b", "c"])).left_out() is None


def test_the_step_to_very_many_words_and_back_leaves_nothing_behind(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(objects, "MANY", 2)
    memory = ObjectMemory()
    for key, word in enumerate(("cup", "book")):
        memory.learn_one(view_of_thing(word, key), word, key=key)
    asked = view_of_thing("cup", 9)
    before = memory.predict_proba_one(asked)
    memory.learn_one(view_of_thing("shoe", 2), "shoe", key=2)
    assert memory.predict_proba_one(asked).keys() == WORDS.keys()
    memory.forget(2)
    assert memory.predict_proba_one(asked) == pytest.approx(before, abs=1e-6)
