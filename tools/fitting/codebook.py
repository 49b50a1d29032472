"""Fits the codebooks of texture and paint.

`python -m tools.fitting.codebook DATA` is given the data folder, with
`ycbv_scenes` (frames of the YCB-Video data set, Xiang et al. 2018, MIT), `mosd_scenes`
(after the Object Segmentation Database, Richtsfeld et al. 2012) and `ycb_meshes` (scans
of the YCB Object and Model Set, Calli et al. 2015, CC BY 4.0).
Windows are cut out of the frames by chance, around the labelled things, and around
rendered meshes; a codebook describes what descriptors are like. No word is looked at.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from kille.perception.cues import fisher
from kille.perception.cues.dense import Descriptors, colours, edges
from kille.perception.cues.patch import Patch, Window
from kille.perception.segment import region_of
from kille.scene import Frame
from kille.sensors.captures import description_of, read_scenes, read_sequence
from kille.sensors.synthetic.sensor import open_synthetic
from ttr.safety.unforeseen_errors import run_guarded

_EACH = 150  # descriptors of a window
_WINDOWS = 8  # by chance of a frame
_VIEWS = 4  # of a mesh
_SCENES = ("0001", "0002")  # 0050 is kept for asking
_SIZES = {"texture": (48, 48), "paint": (32, 32)}
"""Components and Gaussians: more told things apart no better, fewer a little worse."""

_DESCRIPTORS: dict[str, Callable[[Window], Descriptors]] = {
    "texture": edges,
    "paint": colours,
}


def main(data: Path) -> None:
    """Fit the codebooks and store them in the package."""
    chance = np.random.default_rng(0)
    cut = list(windows(data, chance))
    stored = {
        f"{name}_{part}": value.astype(np.float16)
        for name, describe in _DESCRIPTORS.items()
        for part, value in vars(_book(cut, describe, *_SIZES[name], chance)).items()
    }
    path = Path(fisher.__file__).with_name("codebooks.npz")
    np.savez_compressed(path, allow_pickle=False, **stored)
    print(f"{len(cut)} windows -> {path}")


def windows(data: Path, chance: np.random.Generator) -> Iterator[Window]:
    """The windows that the codebooks are fitted to."""
    for frame in _frames(data):
        yield from _by_chance(frame, chance)
        yield from _of_things(frame)
    meshes = data / "ycb_meshes"
    for seed in range(_VIEWS):
        sensor = open_synthetic(f"synthetic:empty?seed={seed}&meshes={meshes}")
        for thing in sensor.things():
            sensor.show(thing)
            yield from _of_things(sensor.frame())


def fit_codebook(
    found: Descriptors, components: int, gaussians: int
) -> fisher.Codebook:
    """The codebook of some descriptors, of so many components and Gaussians."""
    from sklearn.mixture import GaussianMixture

    mean = found.values.mean(axis=0)
    spread, axes = np.linalg.eigh(np.cov((found.values - mean).T))
    kept = np.argsort(spread)[::-1][:components]
    whitened = (axes[:, kept] / np.sqrt(spread[kept])).astype(np.float32)
    numbers = fisher.numbers(found, mean, whitened)
    mixture = GaussianMixture(
        gaussians,
        covariance_type="diag",
        reg_covar=1e-2,
        max_iter=60,
        tol=2e-3,
        random_state=0,
    )
    mixture.fit(numbers)
    return fisher.Codebook(
        mean,
        whitened,
        mixture.weights_.astype(np.float32),
        mixture.means_.astype(np.float32),
        np.sqrt(mixture.covariances_).astype(np.float32),
    )


def _book(
    cut: Sequence[Window],
    describe: Callable[[Window], Descriptors],
    components: int,
    gaussians: int,
    chance: np.random.Generator,
) -> fisher.Codebook:
    found = [describe(window) for window in cut]
    some = [_some(each, chance) for each in found if len(each.values) > _EACH]
    values, places = zip(*some, strict=True)
    together = Descriptors(np.concatenate(values), np.concatenate(places))
    return fit_codebook(together, components, gaussians)


def _frames(data: Path) -> Iterator[Frame]:
    for scene in _SCENES:
        # The frames of a scene are nearly the same: every third one is enough.
        found = _description_in(data / "ycbv_scenes" / scene)
        yield from (shot.read() for shot in read_sequence(found)[::3])
    yield from (
        shot.read() for shot in read_scenes(_description_in(data / "mosd_scenes"))
    )


def _description_in(folder: Path) -> Path:
    description = description_of(folder)
    if description is None:
        raise SystemExit(f"{folder}: no captures are described: give the data folder")
    return description


def _by_chance(frame: Frame, chance: np.random.Generator) -> Iterator[Window]:
    height, width = frame.colour.shape[:2]
    for _ in range(_WINDOWS):
        side = int(chance.integers(96, height))
        top = int(chance.integers(height - side + 1))
        left = int(chance.integers(width - side + 1))
        piece = frame.colour[top : top + side, left : left + side]
        picture = Frame(np.ascontiguousarray(piece), None, None, 0.0, {})
        whole = Patch(picture, region_of(picture, np.ones((side, side), bool))).whole
        if whole is not None:
            yield whole


def _of_things(frame: Frame) -> Iterator[Window]:
    for mask in frame.outlines.values():
        window = Patch(frame, region_of(frame, mask)).window
        if window is not None:
            yield window


def _some(found: Descriptors, chance: np.random.Generator) -> Descriptors:
    chosen = chance.choice(len(found.values), _EACH, replace=False)
    return Descriptors(found.values[chosen], found.places[chosen])


if __name__ == "__main__":
    sys.exit(run_guarded("kille", lambda: main(Path(sys.argv[1]))))
