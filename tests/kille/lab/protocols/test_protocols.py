"""Protocols on small data: what they count, and that the seed decides all."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from kille.lab.protocols import objects, picture_splits, shots, variations
from kille.lab.protocols import scenes as scenes_of
from kille.lab.protocols.protocols_for_data import Plan, object_plans, run_plan
from kille.lab.protocols.teaching import NOTHING, ObjectAnswer, mean_degrees
from kille.lab.results import ExperimentError, Result, silent
from kille.lab.scenes.galleries import Gallery, open_gallery
from kille.lab.scenes.labelled import Split, open_scenes, splits
from kille.lab.theories.candidates import MethodFailedError, candidates
from kille.sensors.synthetic.catalogue import TOY_NAMES

Make = Any


def methods(**makers: Make) -> dict[str, Make]:
    return candidates(list(makers), makers)


def told(result: Result) -> str:
    return repr([(table.title, table.rows) for table in result.tables])


# --- answers -------------------------------------------------------------------------


def test_the_word_of_the_highest_degree_is_said() -> None:
    answer = ObjectAnswer("cup", {"cap": 0.2, "cup": 0.2, "car": 0.1})
    assert answer.said == "cap"
    assert not answer.right


@pytest.mark.parametrize("degrees", [{}, {"cup": 0.0}])
def test_who_knows_no_word_says_none(degrees: dict[str, float]) -> None:
    assert ObjectAnswer("cup", degrees).said == NOTHING


def test_a_word_that_was_not_known_yet_counts_as_0() -> None:
    mean = mean_degrees(
        [ObjectAnswer("cup", {"cup": 1.0}), ObjectAnswer("cup", {"car": 0.5})]
    )
    assert mean.degrees == {"car": 0.25, "cup": 0.5}


# --- the table -----------------------------------------------------------------------


def test_the_papers_protocol(colour: Make, mute: Make) -> None:
    things = ("apple", "banana")
    result = objects.paper(
        methods(colour=colour, mute=mute), seed=7, things=things, rounds=2
    )
    rows = {row[0]: row for row in result.tables[0].rows}
    assert rows["colour"][1:4] == ("2 of 2", "4 of 4", "2 of 2")
    assert rows["mute"][1:4] == ("0 of 2", "0 of 4", "0 of 2")
    ranking = result.tables[2]
    assert {str(row[1]).split()[0] for row in ranking.rows} == {*things}
    assert result.facts["methods"]["colour"]["right"] == 2


def test_the_papers_own_ranking_stands_beside_ours(mute: Make) -> None:
    answers = [ObjectAnswer(thing, {}) for thing in TOY_NAMES]
    course = objects._MethodAnswers([answers], answers)
    ranking = objects._rank_table({"mute": course}, TOY_NAMES)
    assert ranking.columns == ("", "KILLE's robot", "mute")
    assert [row[1] for row in ranking.rows][:3] == ["book", "car", "shoe"]


def test_new_things_of_a_kind_are_others(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[float, ...]] = []

    class Watching:
        def learn_one(self, x: Any, y: str) -> None:
            seen.append(tuple(x.frame.colour[x.region.mask].mean(axis=0)))

        def predict_proba_one(self, x: Any) -> dict[str, float]:
            seen.append(tuple(x.frame.colour[x.region.mask].mean(axis=0)))
            return {"cup": 1.0}

    monkeypatch.setattr(variations, "TOY_NAMES", ("cup",))
    result = variations.specimens(methods(it=Watching), seed=7)
    assert len(set(seen)) == len(seen) == 6
    assert result.facts["methods"]["it"] == 1


def test_turned_things(colour: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(variations, "ANGLES", (0, 90))
    result = variations.rotation(
        methods(colour=colour), seed=7, things=("apple", "banana")
    )
    assert result.facts["methods"]["colour"] == [1.0, 1.0]


# --- pictures by category ------------------------------------------------------------


def test_pictures_are_in_the_order_people_count(photos: Path) -> None:
    picture = photos / "lime" / "lim1.png"
    (photos / "lime" / "lim10.png").write_bytes(picture.read_bytes())
    lime = open_gallery(photos, "photos").categories["lime"]
    assert [path.stem for path in lime][-2:] == ["lim5", "lim10"]


def test_every_other_picture_is_asked_for(gallery: Gallery, colour: Make) -> None:
    result = picture_splits.every_other(gallery, methods(colour=colour), seed=0)
    assert result.tables[0].rows[0][:3] == ("colour", "9 of 9", 1.0)
    assert (result.facts["taught"], result.facts["asked"]) == (9, 9)


def test_the_last_half_is_asked_for(gallery: Gallery, mute: Make) -> None:
    result = picture_splits.halves(gallery, methods(mute=mute), seed=0)
    assert result.tables[0].rows[0][:3] == ("mute", "0 of 9", 0.0)
    confusion = result.figures[0].data
    assert confusion["columns"][-1] == NOTHING
    assert np.sum(confusion["counts"]) == 9


def test_what_is_taught_is_never_asked(gallery: Gallery) -> None:
    class Honest:
        def __init__(self) -> None:
            self.seen: list[Any] = []

        def learn_one(self, x: Any, y: str) -> None:
            self.seen.append(x)

        def predict_proba_one(self, x: Any) -> dict[str, float]:
            assert x not in self.seen
            return {"lime": 0.1}

    for protocol in (picture_splits.every_other, picture_splits.halves, shots.shots):
        protocol(gallery, methods(honest=Honest), seed=3)


def test_the_same_seed_gives_the_same_numbers(gallery: Gallery, colour: Make) -> None:
    taking_part = methods(colour=colour)
    once, again, other = (
        shots.shots(gallery, taking_part, seed=seed) for seed in (3, 3, 4)
    )
    assert told(once) == told(again)
    assert told(once) != told(other)
    assert once.facts["shots"] == [1, 3]
    assert once.facts["asked_of_each"] == 2


def test_what_does_not_open_is_left_out_and_named(photos: Path, colour: Make) -> None:
    (photos / "lime" / "broken.png").write_bytes(b"\x89PNG")
    gallery = open_gallery(photos, "photos")
    assert gallery.unread == ("lime/broken.png",)
    result = picture_splits.every_other(gallery, methods(colour=colour), seed=0)
    assert "lime/broken.png" in result.tables[0].note


def test_two_folders_of_one_word_are_one_category(photos: Path) -> None:
    more = photos / "red_ball", photos / "red ball"
    for number, folder in enumerate(more):
        folder.mkdir()
        picture = np.full((20, 20, 3), 90 * number, np.uint8)
        cv2.imwrite(str(folder / f"{number}.png"), picture)
    assert len(open_gallery(photos, "photos").categories["red ball"]) == 2


def test_huge_pictures_are_made_smaller(photos: Path) -> None:
    huge = np.full((1440, 2560, 3), 90, np.uint8)
    cv2.imwrite(str(photos / "lime" / "huge.png"), huge)
    gallery = open_gallery(photos, "photos")
    seen = gallery.percept(photos / "lime" / "huge.png")
    assert seen.frame is not None
    assert seen.frame.colour.shape == (360, 640, 3)


# --- labelled scenes -----------------------------------------------------------------


def test_strangers_are_told_from_what_was_taught(scenes: Path, colour: Make) -> None:
    found = open_scenes(scenes, "scenes")
    chosen = splits(found, ["first"], [])
    assert chosen == [Split(("first",), "second")]
    result = scenes_of.across(found, chosen, methods(it=colour), seed=0)
    (split,) = result.facts["splits"]
    assert (split["taught"], split["strangers"]) == (["apple"], ["banana"])
    assert split["right_by_frame"] == split["auroc_by_thing"] == 1
    assert result.tables[0].rows[0][2] == "2 of 2"


def test_by_default_every_scene_is_asked(scenes: Path) -> None:
    found = splits(open_scenes(scenes, "scenes"), [], [])
    assert [str(it) for it in found] == ["second → first", "first → second"]


@pytest.mark.parametrize(
    ("teach", "ask", "problem"),
    [
        (["third"], [], "scenes has no scene third: it has first, second"),
        (["first"], ["first"], "the scene first is both taught and asked"),
        (["first", "second"], [], "nothing that is taught"),
    ],
)
def test_scenes_that_cannot_be_split(
    scenes: Path, teach: list[str], ask: list[str], problem: str
) -> None:
    with pytest.raises(ExperimentError, match=problem):
        splits(open_scenes(scenes, "scenes"), teach, ask)


# --- plans ---------------------------------------------------------------------------


def names(found: tuple[Plan, ...]) -> list[str]:
    return [plan.name for plan in found if plan.usual]


def test_data_is_recognised_by_its_content(photos: Path, scenes: Path) -> None:
    assert names(object_plans(None)) == ["paper", "rotation", "specimens"]
    assert names(object_plans(str(photos))) == [
        *("even-odd", "halves", "shots", "degrees")
    ]
    assert names(object_plans(str(scenes))) == ["scenes", "regions"]
    only, _ = object_plans(str(scenes / "first"))  # the other is growth
    assert (only.name, only.compares) == ("regions", ("default", "plain"))


def test_real_data_is_recognised_too(data: Path) -> None:
    found = object_plans(str(data / "ycbv_scenes"), ["0001", "0002"], ["0050"])
    assert names(found) == ["scenes", "regions"]
    assert names(object_plans(str(data / "mosd_scenes"))) == ["regions"]
    assert names(object_plans(str(data / "ycb_meshes"))) == ["paper", "rotation"]


def test_who_fails_is_left_out_and_the_others_go_on(
    gallery: Gallery, colour: Make, failing: Make
) -> None:
    failures: list[MethodFailedError] = []
    plan = Plan(
        "even-odd", lambda *a, **b: picture_splits.every_other(gallery, *a, **b)
    )
    taking_part = methods(failing=failing, colour=colour)
    result, able = run_plan(
        plan, taking_part, seed=0, progress=silent, failed=failures.append
    )
    assert result is not None
    assert [row[0] for row in result.tables[0].rows] == ["colour"] == [*able]
    assert [failure.name for failure in failures] == ["failing"]
    assert run_plan(
        plan, methods(failing=failing), seed=0, progress=silent, failed=failures.append
    ) == (None, {})


def test_progress_goes_from_0_to_1(gallery: Gallery, colour: Make) -> None:
    shares: list[float] = []
    shots.shots(
        gallery,
        methods(colour=colour),
        seed=0,
        progress=lambda share, doing: shares.append(share),
    )
    assert shares == sorted(shares)
    assert shares[-1] == 1
