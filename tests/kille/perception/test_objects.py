"""Object words: the laws of a learner, open words, forgetting, reasons."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tabletop import percept_of, prototypes

from kille.perception.descriptor_index import View, partition
from kille.perception.features import NONE
from kille.perception.learners import check_learner
from kille.perception.likeness import Examples, Kernel
from kille.perception.look import look
from kille.perception.objects import ObjectMemory
from kille.scene import Percept
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
    assert sum(degrees.values()) > 0.5
    assert degrees["cup"] == pytest.approx(degrees["mug"], rel=0.5)


def test_a_thing_without_features_is_learned_and_stays_unknown() -> None:
    memory = taught()
    memory.learn_one(featureless(), "glass", key="glass")
    assert memory.predict_proba_one(featureless()) == {}
    assert memory.predict_proba_one(seen("cup", 9))["glass"] < 0.05
    only = ObjectMemory()
    only.learn_one(featureless(), "glass", key=0)
    assert only.predict_proba_one(seen("cup", 9))["glass"] < 0.3


def test_a_memory_is_built_anew_from_its_views() -> None:
    memory = taught()
    stored = [(it.key, it.label, it.descriptors.copy()) for it in memory.views]
    again = ObjectMemory(View(*row) for row in stored)
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
    still, memory = seen("cup", 0), ObjectMemory()
    count = len(still.scans[0].descriptors)
    again = replace(still, scans=still.scans[:1] * 10)
    both = replace(still, scans=(still.scans[0], seen("book", 0).scans[0]))
    assert len(memory.view_of(again, "cup", key=0).descriptors) == count
    assert len(memory.view_of(both, "cup", key=0).descriptors) == 2 * count


# --- what traits add ---------------------------------------------------------------


def smooth(**traits: object) -> Percept:
    """A thing without features, which has these traits."""
    vectors = {cue: np.asarray(it, np.float32) for cue, it in traits.items()}
    return replace(featureless(), measure=lambda: vectors)


RED, GREEN = np.eye(8)[0], np.eye(8)[4]
SMALL, LARGE = np.log([0.09, 0.06, 0.06]), np.log([0.31, 0.21, 0.11])


def by_looks() -> ObjectMemory:
    memory = ObjectMemory()
    memory.learn_one(smooth(colour=RED, size=SMALL), "apple", key="apple")
    memory.learn_one(smooth(colour=GREEN, size=LARGE), "shoe", key="shoe")
    return memory


def test_a_thing_without_features_is_known_by_its_looks() -> None:
    degrees = by_looks().predict_proba_one(smooth(colour=RED, size=SMALL))
    assert best(degrees) == "apple"
    assert degrees["apple"] > 3 * degrees["shoe"]


def test_another_size_speaks_against_a_word() -> None:
    memory = by_looks()
    like = memory.predict_proba_one(smooth(colour=RED, size=SMALL))["apple"]
    twice = smooth(colour=RED, size=SMALL + np.log(2))
    assert memory.predict_proba_one(twice)["apple"] < 0.5 * like


def test_a_word_whose_size_nobody_read_is_not_rejected_for_its_size() -> None:
    """Depth has holes, and may have had one where the thing was when it was taught."""
    memory, colour = by_looks(), np.eye(8)[2]
    memory.learn_one(smooth(colour=colour), "bottle", key="bottle")
    evidence = memory.evidence(smooth(colour=colour, size=SMALL))
    assert best(evidence.degrees()) == "bottle"
    assert evidence.reasons("bottle")["size"] > evidence.reasons("shoe")["size"]


def test_what_cannot_be_told_says_nothing() -> None:
    memory = by_looks()
    unsized = memory.evidence(smooth(colour=RED))
    assert "size" not in unsized.added
    assert best(unsized.degrees()) == "apple"
    stale = memory.evidence(smooth(colour=np.ones(3), size=SMALL))
    assert "colour" not in stale.added


@pytest.mark.parametrize("vector", [[], [1e30] * 8, [np.inf] * 8])
def test_vectors_that_are_no_measures_are_unknown(vector: list[float]) -> None:
    """A memory may have been made by another program."""
    memory = by_looks()
    memory.learn_one(smooth(colour=vector, size=SMALL), "box", key="box")
    for asked in (smooth(colour=RED, size=SMALL), smooth(colour=vector, size=SMALL)):
        degrees = memory.predict_proba_one(asked)
        assert 0 < sum(degrees.values()) < 1


def test_lengths_that_change_leave_nothing_behind() -> None:
    """K of examples whose vectors were compared is not kept when they no longer are."""
    lengths = {"a": 3, "b": 4, "c": 4}
    views = [
        View(key, "cup", NONE.descriptors, {"colour": np.ones(n, np.float32)})
        for key, n in lengths.items()
    ]
    kernels, asked = {"colour": Kernel(1.0, 1.0)}, {"colour": np.ones(3, np.float32)}
    before = Examples(views, ["cup"], kernels)
    after = Examples(views[:1], ["cup"], kernels, before).likeness(asked)
    anew = Examples(views[:1], ["cup"], kernels).likeness(asked)
    assert after.scores["colour"] == pytest.approx(anew.scores["colour"])


def test_the_reasons_for_a_word_are_told_by_cue_and_add_up() -> None:
    evidence = by_looks().evidence(smooth(colour=RED, size=LARGE))
    degrees = evidence.degrees()
    reasons = evidence.reasons("apple", "shoe")
    assert reasons["colour"] > 0 > reasons["size"]
    ratio = np.log(degrees["apple"] / degrees["shoe"])
    assert sum(reasons.values()) == pytest.approx(ratio)
    assert list(reasons.values()) == sorted(reasons.values(), reverse=True)
    with pytest.raises(KeyError):
        evidence.reasons("unicorn")


def test_a_word_is_forgotten_with_all_its_lessons() -> None:
    memory = by_looks()
    memory.learn_one(smooth(colour=RED, size=LARGE), "apple", key=2)
    memory.forget_word("apple")
    assert memory.labels == ("shoe",)
    with pytest.raises(KeyError):
        memory.forget_word("apple")


# --- what was denied ------------------------------------------------------------------


def test_a_word_that_was_denied_is_weaker_there_and_no_other_gains_evidence() -> None:
    for memory, asked, word in (
        (taught(), seen("cup", 0), "cup"),
        (by_looks(), smooth(colour=RED, size=SMALL), "apple"),
    ):
        before, degrees = memory.evidence(asked), memory.predict_proba_one(asked)
        memory.deny_one(asked, word, key="no")
        after, now = memory.evidence(asked), memory.predict_proba_one(asked)
        assert now[word] < 0.5 * degrees[word]
        for label in set(memory.labels) - {word}:
            assert after.reasons(label) == pytest.approx(before.reasons(label))
            assert now[label] >= degrees[label]
        assert memory.labels == before.labels
        memory.forget("no")
        assert memory.predict_proba_one(asked) == degrees


def test_a_denial_counts_where_features_are_searched_by_trees(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The distance to the denied view is that to the view learned: neither is less."""
    monkeypatch.setattr(partition, "TAIL", 50)
    memory, asked = taught(), seen("cup", 0)
    before = memory.predict_proba_one(asked)["cup"]
    memory.deny_one(asked, "cup", key="no")
    assert memory.predict_proba_one(asked)["cup"] < 0.5 * before


def test_a_denial_says_little_of_what_is_unlike() -> None:
    memory = by_looks()
    elsewhere = smooth(colour=GREEN, size=LARGE)
    before = memory.predict_proba_one(elsewhere)
    memory.deny_one(smooth(colour=RED, size=SMALL), "shoe")
    assert memory.predict_proba_one(elsewhere)["shoe"] > 0.7 * before["shoe"]


def test_the_right_word_takes_the_place_of_the_one_denied() -> None:
    memory = by_looks()
    fruit = smooth(colour=RED, size=SMALL)
    memory.deny_one(fruit, "apple", key=1)
    memory.learn_one(fruit, "tomato", key=2)
    degrees = memory.predict_proba_one(fruit)
    assert best(degrees) == "tomato"
    assert degrees["apple"] < 0.3


def test_a_word_that_was_only_denied_is_not_known() -> None:
    memory = by_looks()
    before = memory.predict_proba_one(smooth(colour=RED))
    memory.deny_one(smooth(colour=RED, size=SMALL), "plum", key="no")
    assert memory.labels == ("apple", "shoe")
    assert memory.predict_proba_one(smooth(colour=RED)) == before
    with pytest.raises(ValueError, match="learned before"):
        memory.learn_one(smooth(colour=RED), "plum", key="no")
    memory.forget_word("plum")
    assert memory.denied == ()


def test_denials_of_the_same_thing_add_up_and_many_are_borne() -> None:
    memory, asked = by_looks(), smooth(colour=RED, size=SMALL)
    degrees = []
    for _ in range(20):
        memory.deny_one(asked, "apple")
        degrees.append(memory.predict_proba_one(asked)["apple"])
    assert degrees[0] > degrees[3]
    assert all(0 <= p < 0.3 for p in degrees)
    again = ObjectMemory(memory.views, denied=memory.denied)
    assert again.predict_proba_one(asked) == pytest.approx(
        memory.predict_proba_one(asked), abs=1e-6
    )


def test_the_nearest_view_is_the_likest() -> None:
    memory = by_looks()
    memory.learn_one(smooth(colour=RED, size=LARGE), "apple", key="large")
    memory.deny_one(smooth(colour=RED, size=LARGE), "apple", key="no")
    nearest = memory.nearest(smooth(colour=RED, size=LARGE), "apple")
    assert nearest is not None
    assert nearest.key == "large"
    seen_before = taught().nearest(seen("cup", 0), "cup")
    assert seen_before is not None
    assert seen_before.key == 0
    assert memory.nearest(featureless(), "apple") is None
    with pytest.raises(KeyError):
        memory.nearest(seen("cup", 0), "unicorn")


def test_a_memory_may_become_what_another_is() -> None:
    memory, asked = by_looks(), smooth(colour=RED, size=SMALL)
    then = memory.copy()
    before = memory.predict_proba_one(asked)
    memory.deny_one(asked, "apple")
    memory.forget("shoe")
    memory.become(then)
    assert memory.predict_proba_one(asked) == before
    memory.forget("apple")
    assert then.predict_proba_one(asked) == before


@given(st.lists(st.sampled_from("abc"), min_size=1, max_size=12), st.data())
def test_to_forget_is_to_be_as_if_it_had_never_been(
    words: list[str], data: st.DataObject
) -> None:
    """With the examples that are compared chosen from many."""
    chance = np.random.default_rng(len(words))
    views = [
        View(key, word, NONE.descriptors, {"colour": chance.random(4, np.float32)})
        for key, word in enumerate(words)
    ]
    kernels = {"colour": Kernel(1.0, 0.5)}
    gone = data.draw(st.sampled_from(range(len(views))))
    left = views[:gone] + views[gone + 1 :]
    labels = sorted({it.label for it in left})
    asked = {"colour": np.full(4, 0.4, np.float32)}
    before = Examples(views, sorted(set(words)), kernels)
    taken_over = Examples(left, labels, kernels, before).likeness(asked)
    anew = Examples(left, labels, kernels).likeness(asked)
    for cue, scores in anew.scores.items():
        assert taken_over.scores[cue] == pytest.approx(scores, abs=1e-6)


@given(st.integers(0, 1000))
def test_likeness_is_a_positive_kernel_whatever_is_unknown(seed: int) -> None:
    """Else the regression has no bounds: weights of examples would grow at will."""
    chance, kernels = np.random.default_rng(seed), {}
    views = [View(key, "cup", NONE.descriptors, {}) for key in range(40)]
    for cue in "abc":
        kernels[cue] = Kernel(chance.uniform(0.5, 2), 0.3)
        views = [
            replace(it, traits={**it.traits, cue: chance.random(2, np.float32)})
            if chance.random() < 0.6
            else it
            for it in views
        ]
    found = Examples(views, ["cup"], kernels)._kernel
    assert np.linalg.eigvalsh(found).min() > -1e-5
    assert np.diag(found) == pytest.approx([1.0 if it.traits else 0.0 for it in views])


def test_a_word_with_many_lessons_is_compared_by_some_of_them() -> None:
    """So asking stays as quick, and the newest are among them."""
    blank = NONE.descriptors
    views = [
        View(key, "cup", blank, {"colour": np.float32([key])}) for key in range(500)
    ]
    examples = Examples(views, ["cup"], {"colour": Kernel(1.0, 1.0)})
    nearest = examples.likeness({"colour": np.float32([499])}).unlike["colour"]
    assert nearest == pytest.approx([0])
    far = [
        examples.likeness({"colour": np.float32([key])}).unlike["colour"][0]
        for key in range(500)
    ]
    assert 20 < sum(it == 0 for it in far) < 60


def test_objects_of_one_real_scene_are_known_in_the_next(data: Path) -> None:
    memory = ObjectMemory()
    folder = str(data / "ycbv_scenes" / "0001")
    outlines = open_recording(folder).frame().outlines
    for name, outline in outlines.items():
        lesson = look(open_recording(folder), pointed=outline)
        memory.learn_one(lesson.percepts[0], name, key=name)
    asked = look(open_recording(str(data / "ycbv_scenes" / "0002")))
    mustard = asked.frame.outlines["mustard bottle"]
    assert any(
        (it.region.mask & mustard).sum() > 0.5 * mustard.sum() for it in asked.percepts
    )
    for percept in asked.percepts:
        degrees = memory.predict_proba_one(percept)
        if (percept.region.mask & mustard).sum() > 0.5 * mustard.sum():
            assert best(degrees) == "mustard bottle"
            assert degrees["mustard bottle"] > 0.4
        else:
            assert max(degrees.values()) < 0.5


@pytest.mark.slow
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
    outlines, boxes = asked.frame.outlines, 0
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
            boxes += 1
    assert boxes == 1
