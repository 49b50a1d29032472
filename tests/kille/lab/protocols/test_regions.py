"""Scores of regions against outlines, and the protocol over labelled captures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kille.lab.protocols.regions import SegmentationScore, captures, regions, score
from kille.lab.results import ExperimentError
from kille.perception.segment import region_of
from kille.scene import Frame, Intrinsics

SQUARES = {"left": np.s_[10:30, 10:30], "right": np.s_[10:30, 40:60]}


def frame() -> Frame:
    outlines = {name: np.zeros((50, 80), bool) for name in SQUARES}
    for name, square in SQUARES.items():
        outlines[name][square] = True
    depth = np.ones((50, 80), np.float32)
    colour = np.zeros((50, 80, 3), np.uint8)
    return Frame(colour, depth, Intrinsics(100, 100, 40, 25), 0.0, outlines)


def test_the_outlines_themselves_are_a_perfect_score() -> None:
    seen = frame()
    found = score([region_of(seen, it) for it in seen.outlines.values()], seen)
    assert (found.precision, found.recall, found.f, found.lenient) == (1, 1, 1, 1)
    assert found.exact == found.frames == 1
    assert found.overlaps == (1.0, 1.0)
    assert found.errors == (0.0, 0.0)


def test_one_region_for_two_things_finds_none() -> None:
    seen = frame()
    both = np.logical_or(*seen.outlines.values())
    found = score([region_of(seen, both)], seen)
    assert found.found == 1  # it overlaps one of them by just a half
    both[35:45, 10:60] = True
    assert score([region_of(seen, both)], seen).found == 0


def test_a_region_finds_one_thing_and_a_thing_has_one_region() -> None:
    seen = frame()
    left = region_of(seen, seen.outlines["left"])
    found = score([left, left], seen)
    assert (found.found, found.given, found.there) == (1, 2, 2)
    assert found.f == 0.5


def test_what_nobody_labelled_counts_in_the_strict_score_only() -> None:
    seen = frame()
    clutter = np.zeros((50, 80), bool)
    clutter[35:45, 60:75] = True
    things = [region_of(seen, it) for it in seen.outlines.values()]
    found = score([*things, region_of(seen, clutter)], seen)
    assert found.precision == pytest.approx(2 / 3)
    assert found.lenient == 1
    assert found.exact == 0


def test_a_middle_that_is_off_is_measured_in_metres() -> None:
    seen = frame()
    moved = np.zeros((50, 80), bool)
    moved[10:30, 13:33] = True
    (error,) = score([region_of(seen, moved)], seen).errors
    assert error == pytest.approx(0.03, abs=1e-6)


def test_nothing_in_view_is_found_by_no_regions() -> None:
    empty = replace(frame(), outlines={})
    assert score([], empty).f == 1
    assert (score([], frame()) + score([], empty)).recall == 0
    assert SegmentationScore().f == 1


def test_a_folder_without_labels_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ExperimentError, match="no labelled captures"):
        captures(tmp_path)


def test_real_scenes_are_scored_by_kind(data: Path) -> None:
    scenes = captures(data / "mosd_scenes")
    told: list[float] = []
    result = regions(scenes[::6], progress=lambda share, doing: told.append(share))
    assert told[-1] == 1
    facts = result.facts
    assert facts["default"]["all"]["F"] >= facts["plain"]["all"]["F"]
    table, exactness = result.tables
    assert len(table.columns) == len(table.rows[0])
    assert len(exactness.rows) == 2
    (figure,) = result.figures
    assert len(figure.data["pictures"]) == len(figure.data["captions"])


def test_the_frames_of_a_recording_are_of_one_kind(data: Path) -> None:
    kinds = {capture.kind for capture in captures(data / "ycbv_scenes")}
    assert kinds == {"0001", "0002", "0050"}
