"""Which cues count for a word: shares that sum to one, and lessons that are undone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tabletop import percept_of, prototypes

from kille.dialogue.lexicon import lexicon
from kille.perception.descriptor_index import View
from kille.perception.evidence import weighing
from kille.perception.features import NONE
from kille.perception.likeness import Kernel
from kille.perception.objects import ObjectMemory
from kille.perception.relevance import DETAILS, GROUPS, Relevance
from kille.scene import Percept, Traits, Vector

KERNELS = weighing().kernels
SEEN = tuple(it for it in GROUPS if it != DETAILS)
"""The groups of cues that are compared by kernels."""

said = st.lists(st.tuples(st.sampled_from([*GROUPS]), st.booleans()), max_size=6)
kernels = st.dictionaries(
    st.sampled_from([*KERNELS]),
    st.builds(Kernel, st.floats(0.01, 10), st.just(1.0)),
    min_size=1,
)


@given(said, kernels)
def test_shares_are_in_0_1_and_sum_to_one(
    said: list[tuple[str, bool]], kernels: dict[str, Kernel]
) -> None:
    shares = Relevance.of(said).shares(kernels)
    assert all(0.0 <= it <= 1.0 for it in shares.values())
    left = [it for it in shares if it not in Relevance.of(said).ignored]
    assert sum(shares.values()) == pytest.approx(1.0 if left else 0.0)


@given(said, kernels, st.sampled_from(SEEN))
def test_what_does_not_matter_has_no_share(
    said: list[tuple[str, bool]], kernels: dict[str, Kernel], group: str
) -> None:
    relevance = Relevance.of([*said, (group, False)])
    assert relevance.shares(kernels).get(group, 0.0) == 0.0
    assert all(relevance.ignores(cue) for cue in GROUPS[group])


@given(said, kernels, st.sampled_from(SEEN))
def test_what_matters_has_no_less_share_and_half_of_it_alone(
    said: list[tuple[str, bool]], kernels: dict[str, Kernel], group: str
) -> None:
    others = [it for it in said if it[1] is False and it[0] != group]
    before = Relevance.of(others).shares(kernels)
    after = Relevance.of([*others, (group, True)]).shares(kernels)
    assert after.get(group, 0.0) >= before.get(group, 0.0) - 1e-9
    if group in after:
        assert after[group] >= 0.5 - 1e-9


@given(said, said)
def test_only_the_latest_word_on_a_group_counts(
    first: list[tuple[str, bool]], last: list[tuple[str, bool]]
) -> None:
    spoken = {group for group, _ in last}
    rest = [it for it in first if it[0] not in spoken]
    assert Relevance.of([*first, *last]) == Relevance.of([*rest, *last])


@pytest.mark.parametrize("language", ["en", "sv"])
def test_cues_that_are_spoken_of_together_have_one_name(language: str) -> None:
    names = lexicon(language).sections["cues"]
    for cues in GROUPS.values():
        assert len({names[cue] for cue in cues}) == 1
    assert len({names[cues[0]] for cues in GROUPS.values()}) == len(GROUPS)


# --- words whose cues were spoken of --------------------------------------------------

WORDS = ("apple", "ball", "cup")


def view(key: int, label: str, seed: int) -> View:
    return View(key, label, np.empty((0, 128), np.uint8), traits(label, seed))


def traits(label: str, seed: int) -> Traits:
    """What is seen of a thing: each kind has a form, and any colour."""
    of_kind = np.random.default_rng(WORDS.index(label))
    own = np.random.default_rng([seed, WORDS.index(label)])
    found = {}
    for cue in ("colour", "hue", "form", "outline", "size"):
        typical = own if cue in ("colour", "hue") else of_kind
        found[cue] = (typical.normal(size=3) + 0.1 * own.normal(size=3)).astype("f4")
    return found


def percept(label: str, seed: int, **others: Vector) -> Percept:
    seen = percept_of(np.random.default_rng(1), prototypes(1), 1)
    return replace(
        seen,
        scans=(NONE,),
        measure=lambda: {**traits(label, seed), **others},
        frame=None,
    )


def taught() -> ObjectMemory:
    return ObjectMemory(view(i, WORDS[i % 3], i) for i in range(9))


QUERIES = [percept(word, 77) for word in WORDS]


def degrees_of_queries(memory: ObjectMemory) -> list[dict[str, float]]:
    return [memory.predict_proba_one(it) for it in QUERIES]


lessons = st.lists(
    st.tuples(st.sampled_from(WORDS), st.sampled_from([*GROUPS]), st.booleans()),
    max_size=5,
)


@settings(max_examples=40)
@given(lessons)
def test_taking_it_back_restores_the_answers_exactly(
    lessons: Sequence[tuple[str, str, bool]],
) -> None:
    memory = taught()
    before = degrees_of_queries(memory)
    for key, lesson in enumerate(lessons, start=100):
        memory.weigh(*lesson, key=key)
        degrees_of_queries(memory)
    for key in range(100, 100 + len(lessons)):
        memory.forget(key)
    assert degrees_of_queries(memory) == before


@settings(max_examples=40)
@given(lessons)
def test_degrees_stay_degrees_and_are_the_same_for_the_same_lessons(
    lessons: Sequence[tuple[str, str, bool]],
) -> None:
    one, other = taught(), ObjectMemory()
    for key, lesson in enumerate(lessons, start=100):
        other.weigh(*lesson, key=key)
    for it in one.views:
        other.learn(it)
    for key, lesson in enumerate(lessons, start=100):
        one.weigh(*lesson, key=key)
    assert degrees_of_queries(one) == degrees_of_queries(other)
    for degrees in degrees_of_queries(one):
        assert all(0.0 <= it <= 1.0 for it in degrees.values())
        assert sum(degrees.values()) <= 1.0 + 1e-9


def test_it_changes_the_evidence_for_that_word_only() -> None:
    memory = taught()
    before = memory.evidence(QUERIES[0])
    memory.weigh("apple", "colour", False, key=100)
    after = memory.evidence(QUERIES[0])
    for cue, added in after.added.items():
        assert added[1:].tolist() == before.added[cue][1:].tolist()
    assert after.added["colour"][0] == after.added["hue"][0] == 0.0
    assert before.added["colour"][0] != 0.0


def test_a_thing_of_another_colour_is_known_where_the_colour_does_not_matter() -> None:
    memory = ObjectMemory(view(i, word, 0) for i, word in enumerate(WORDS))
    before = memory.predict_proba_one(percept("cup", 5))["cup"]
    memory.weigh("cup", "colour", False, key=100)
    assert memory.predict_proba_one(percept("cup", 5))["cup"] > before + 0.1


def test_nothing_is_rejected_for_a_size_that_does_not_matter() -> None:
    memory = taught()
    small = percept("cup", 1, size=np.full(3, -9.0, "f4"))
    before = memory.evidence(small).added["size"][2]
    memory.weigh("cup", "size", False, key=100)
    after = memory.evidence(small).added["size"]
    assert before < -3.0
    assert after[2] == 0.0
    assert after[0] < -3.0


def test_a_copy_is_told_for_itself() -> None:
    memory = taught()
    before = degrees_of_queries(memory)
    twin = memory.copy()
    twin.weigh("cup", "colour", False, key=100)
    assert degrees_of_queries(memory) == before != degrees_of_queries(twin)
    memory.become(twin)
    assert degrees_of_queries(memory) == degrees_of_queries(twin) != before
    memory.forget(100)
    assert degrees_of_queries(memory) == before != degrees_of_queries(twin)


def test_a_key_is_taken_once() -> None:
    memory = taught()
    memory.weigh("cup", "colour", False, key=100)
    with pytest.raises(ValueError, match="learned before"):
        memory.weigh("cup", "shape", True, key=100)
    with pytest.raises(ValueError, match="learned before"):
        memory.learn(view(100, "cup", 1))
    memory.forget(100)
    with pytest.raises(KeyError):
        memory.forget(100)


def test_a_word_may_be_spoken_of_before_it_is_known() -> None:
    memory = taught()
    before = degrees_of_queries(memory)
    memory.weigh("mug", "colour", False, key=100)
    assert degrees_of_queries(memory) == before
