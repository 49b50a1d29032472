"""Are the things in view found? Regions against the outlines of labelled captures.

A region finds a thing if it overlaps its outline by half; which region stands for which
thing is chosen so that the overlaps are largest in sum (Hungarian matching).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import astuple, dataclass
from operator import add
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from kille.lab.progress import Steps
from kille.lab.results import (
    Cell,
    ExperimentError,
    Figure,
    Progress,
    Result,
    Table,
    silent,
)
from kille.perception.segment import SEGMENTATIONS, Segmentation, region_of
from kille.scene import Frame, Region
from kille.sensors.captures import (
    Shot,
    description_of,
    is_sequence,
    read_scenes,
    read_sequence,
)
from ttr.safety.inputs import parse_json, read_text
from ttr.safety.limits import TABLE

_HALF = 0.5  # the overlap at which a thing counts as found
_LABELLED = 0.3  # regions with a smaller labelled part may be things nobody labelled
_SHOWN = 6  # scenes in the figure
_WIDTH = 320  # pixels of a picture in the figure
_INKS = np.array(
    [
        *((230, 60, 50), (60, 160, 60), (60, 90, 230), (230, 170, 0), (190, 60, 200)),
        *((0, 180, 190), (140, 90, 40), (250, 120, 170), (120, 200, 40), (20, 20, 20)),
    ],
    np.uint8,
)


@dataclass(frozen=True, eq=False)
class LabelledCapture:
    """A labelled frame on disk, and the kind of scene it is of."""

    kind: str
    shot: Shot


@dataclass(frozen=True)
class SegmentationScore:
    """What was found in one frame, or in several of them together.

    found: things with a region; given: regions; there: things; likely: regions of which
    a good part is labelled; exact: frames in which things and regions are the same;
    overlaps: of the found things; errors: metres from the middle of the region to the
    middle of the thing.
    """

    found: int = 0
    given: int = 0
    there: int = 0
    likely: int = 0
    frames: int = 0
    exact: int = 0
    overlaps: tuple[float, ...] = ()
    errors: tuple[float, ...] = ()

    def __add__(self, other: SegmentationScore) -> SegmentationScore:
        return SegmentationScore(*map(add, astuple(self), astuple(other)))

    @property
    def recall(self) -> float:
        """The share of the things that were found."""
        return _ratio(self.found, self.there)

    @property
    def precision(self) -> float:
        """The share of the regions that are a thing."""
        return _ratio(self.found, self.given)

    @property
    def f(self) -> float:
        """The harmonic mean of precision and recall."""
        return _ratio(2 * self.found, self.given + self.there)

    @property
    def lenient(self) -> float:
        """The same, without regions that are hardly labelled."""
        return _ratio(2 * self.found, self.likely + self.there)


def score(regions: Sequence[Region], frame: Frame) -> SegmentationScore:
    """How well these regions match the labelled things of their frame.

    A thing's middle is the median of the points that were measured within its outline.
    """
    outlines = list(frame.outlines.values())
    overlaps, labelled = _overlaps(regions, outlines)
    pairs = [(i, j) for i, j in _match_regions(overlaps) if overlaps[i, j] >= _HALF]
    finders = {i for i, _ in pairs}
    enough = {i for i, share in enumerate(labelled) if share >= _LABELLED}
    return SegmentationScore(
        found=len(pairs),
        given=len(regions),
        there=len(outlines),
        likely=len(finders | enough),
        frames=1,
        exact=int(len(pairs) == len(regions) == len(outlines)),
        overlaps=tuple(float(overlaps[pair]) for pair in pairs),
        errors=tuple(
            error
            for i, j in pairs
            if (error := _distance_between(regions[i], region_of(frame, outlines[j])))
            is not None
        ),
    )


def captures(folder: Path) -> tuple[LabelledCapture, ...]:
    """The labelled captures in a folder and its folders, in order.

    Their kind is in the description, or else the name of their folder.
    ExperimentError if there are none; SensorError for a broken description.
    """
    folders = [folder, *sorted(it for it in folder.iterdir() if it.is_dir())]
    found = [capture for it in folders for capture in _captures(it)]
    if not found:
        raise ExperimentError(
            f"{folder}: no labelled captures (NAME_color.png, NAME_depth.png and "
            "NAME_label.png with index.json or scene.json)"
        )
    return tuple(found)


def regions(
    scenes: Sequence[LabelledCapture],
    ways: Mapping[str, Segmentation] = SEGMENTATIONS,
    *,
    progress: Progress = silent,
) -> Result:
    """How many things each way to segment finds, by kind of scene, and how exactly."""
    steps = Steps(progress, len(scenes))
    scores: dict[str, dict[str, SegmentationScore]] = {name: {} for name in ways}
    times: dict[str, list[float]] = {name: [] for name in ways}
    shown = _evenly_spread(len(scenes))
    pictures, captions, good = [], [], []
    for number, capture in enumerate(scenes):
        frame = capture.shot.read()
        for name, way in ways.items():
            start = time.process_time()
            found = way(frame).regions
            times[name].append(time.process_time() - start)
            one = score(found, frame)
            of_kind = scores[name]
            of_kind[capture.kind] = of_kind.get(capture.kind, SegmentationScore()) + one
            if number in shown:
                pictures.append(paint_regions(frame, found).tolist())
                captions.append(f"{capture.shot.name}, {name}: {one.found}/{one.there}")
                good.append(one.exact == 1)
        steps(f"looking at {capture.shot.name}")
    totals = {
        name: sum(them.values(), SegmentationScore()) for name, them in scores.items()
    }
    return Result(
        "Are the things in view found?",
        (_by_kind(scores, totals), _exactness(totals, times)),
        (
            Figure(
                "pictures",
                "Regions, each in its ink",
                {"pictures": pictures, "captions": captions, "good": good},
            ),
        ),
        {
            name: {"all": _facts(totals[name])}
            | {kind: _facts(it) for kind, it in scores[name].items()}
            | {"ms": 1e3 * float(np.median(times[name]))}
            for name in ways
        },
    )


def _captures(folder: Path) -> list[LabelledCapture]:
    description = description_of(folder)
    if description is None:
        return []
    read = read_sequence if is_sequence(description) else read_scenes
    kinds = parse_json(read_text(description, TABLE)).get("scenes", {})
    return [
        LabelledCapture(str(kinds.get(shot.name, {}).get("kind", folder.name)), shot)
        for shot in read(description)
        if shot.labels is not None and shot.things
    ]


def _overlaps(
    regions: Sequence[Region], outlines: Sequence[NDArray[np.bool_]]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Overlaps (regions, outlines), and the share of each region in any outline."""
    if not regions or not outlines:
        return np.zeros((len(regions), len(outlines))), np.zeros(len(regions))
    found = np.stack([it.mask.ravel() for it in regions]).astype(np.float32)
    true = np.stack([it.ravel() for it in outlines]).astype(np.float32)
    both = (found @ true.T).astype(np.float64)
    sizes, true_sizes = found.sum(axis=1)[:, None], true.sum(axis=1)[None]
    labelled = found @ (true.max(axis=0)) / np.maximum(sizes[:, 0], 1)
    return both / np.maximum(sizes + true_sizes - both, 1), labelled


def _match_regions(overlaps: NDArray[np.float64]) -> list[tuple[int, int]]:
    """Match regions and things, each at most once, by the largest sum of overlaps."""
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(overlaps, maximize=True)
    return list(zip(rows.tolist(), columns.tolist(), strict=True))


def _distance_between(one: Region, other: Region) -> float | None:
    if one.place is None or other.place is None:
        return None
    return float(np.linalg.norm(np.subtract(one.place, other.place)))


def _by_kind(
    scores: Mapping[str, Mapping[str, SegmentationScore]],
    totals: Mapping[str, SegmentationScore],
) -> Table:
    rows = [
        (kind, name, them.frames, them.there, *_rates(them))
        for name, kinds in scores.items()
        for kind, them in {**kinds, "all": totals[name]}.items()
    ]
    order = list(dict.fromkeys(row[0] for row in rows if row[0] != "all"))
    rows.sort(key=lambda row: [*order, "all"].index(row[0]))
    columns = ("scenes", "method", "frames", "things", "precision", "recall", "F")
    return Table(
        "Is every thing a region of its own?",
        (*columns, "F, lenient", "frames all right"),
        tuple(rows),
        "A thing is found if a region overlaps its outline by half. Lenient: regions "
        "of which less than three tenths are labelled may be things nobody labelled, "
        "and do not count.",
    )


def _rates(them: SegmentationScore) -> tuple[Cell, ...]:
    return (
        them.precision,
        them.recall,
        them.f,
        them.lenient,
        _ratio(them.exact, them.frames),
    )


def _exactness(
    totals: Mapping[str, SegmentationScore], times: Mapping[str, Sequence[float]]
) -> Table:
    return Table(
        "How exactly, and how quickly?",
        ("method", "overlap", "middle off, cm", "nine in ten within, cm", "ms a frame"),
        tuple(
            (
                name,
                _quantile(them.overlaps, np.mean),
                _quantile(100 * np.array(them.errors), np.median),
                _quantile(100 * np.array(them.errors), lambda it: np.quantile(it, 0.9)),
                1e3 * float(np.median(times[name])),
            )
            for name, them in totals.items()
        ),
        "Of the things that were found: the mean overlap, and how far the middle of "
        "the region is from that of the thing. Times are medians of the processor's.",
    )


def _facts(them: SegmentationScore) -> Mapping[str, float | int | None]:
    off = 100 * np.array(them.errors)
    return {
        "frames": them.frames,
        "things": them.there,
        "precision": them.precision,
        "recall": them.recall,
        "F": them.f,
        "F lenient": them.lenient,
        "frames all right": _ratio(them.exact, them.frames),
        "overlap": _quantile(them.overlaps, np.mean),
        "centre median cm": _quantile(off, np.median),
        "centre p90 cm": _quantile(off, lambda it: np.quantile(it, 0.9)),
    }


def _quantile(
    values: Sequence[float] | NDArray[np.float64],
    of: Callable[[NDArray[np.float64]], np.floating],
) -> float | None:
    return float(of(np.asarray(values))) if len(values) else None


def _ratio(part: int, of: int) -> float:
    return part / of if of else 1.0


def _evenly_spread(count: int) -> set[int]:
    """A few numbers below the count, evenly spread."""
    return {int(it) for it in np.linspace(0, max(count - 1, 0), _SHOWN)}


def paint_regions(frame: Frame, found: Sequence[Region]) -> NDArray[np.uint8]:
    """The frame, grey, with each region in its own ink."""
    step = max(1, round(frame.colour.shape[1] / _WIDTH))
    grey = frame.colour[::step, ::step].mean(axis=2, keepdims=True)
    picture = grey.repeat(3, axis=2)
    for number, region in enumerate(found):
        inside = region.mask[::step, ::step]
        picture[inside] = 0.45 * picture[inside] + 0.55 * _INKS[number % len(_INKS)]
    drawn: NDArray[np.uint8] = picture.astype(np.uint8)
    return drawn
