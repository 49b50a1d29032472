"""Small data of every kind that is measured, and learners that look at colour only."""

from __future__ import annotations

import json
import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.lab.scenes.galleries import Gallery, open_gallery
from kille.scene import Percept
from kille.sensors.sensor import At
from kille.sensors.synthetic import open_synthetic

INKS = {"lime": (60, 200, 40), "plum": (120, 30, 120), "sun flower": (240, 200, 10)}


class NearestColour:
    """The word of the lesson with the nearest mean colour."""

    def __init__(self) -> None:
        self.lessons: list[tuple[tuple[float, ...], str]] = []

    def learn_one(self, x: Percept, y: str) -> None:
        self.lessons.append((self.colour(x), y))

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        degrees: dict[str, float] = {}
        for colour, word in self.lessons:
            near = math.exp(-math.dist(colour, self.colour(x)) / 20)
            degrees[word] = max(near, degrees.get(word, 0.0))
        return {word: it / (1 + sum(degrees.values())) for word, it in degrees.items()}

    @staticmethod
    def colour(x: Percept) -> tuple[float, ...]:
        assert x.frame is not None
        return tuple(x.frame.colour[x.region.mask].mean(axis=0))


class Mute(NearestColour):
    """It has never learned a word."""

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        return {}


class Failing(NearestColour):
    """It cannot say what it learned."""

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        raise ZeroDivisionError("nothing\nto divide by")


@pytest.fixture
def colour() -> type[NearestColour]:
    return NearestColour


@pytest.fixture
def mute() -> type[Mute]:
    return Mute


@pytest.fixture
def failing() -> type[Failing]:
    return Failing


@pytest.fixture
def photos(tmp_path: Path) -> Path:
    """Pictures of discs, in a folder for each colour."""
    return discs(tmp_path / "photos")


def discs(folder: Path) -> Path:
    """Three categories of six pictures: a disc of one colour, a little different."""
    chance = np.random.default_rng(7)
    for word, ink in INKS.items():
        inner = folder / word.replace(" ", "_")
        inner.mkdir(parents=True)
        for number in range(6):
            picture = np.full((60, 80, 3), 190, np.uint8)
            shade = np.clip(np.array(ink) + chance.integers(-12, 13), 0, 255)
            cv2.circle(picture, (40, 30), 18, shade[::-1].tolist(), -1)
            cv2.imwrite(str(inner / f"{word[:3]}{number}.png"), picture)
    return folder


@pytest.fixture(scope="module")
def gallery(tmp_path_factory: pytest.TempPathFactory) -> Gallery:
    return open_gallery(discs(tmp_path_factory.mktemp("gallery")), "photos")


@pytest.fixture(scope="session")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two labelled scenes with the apple in both, and a stranger in the second."""
    folder = tmp_path_factory.mktemp("scenes")
    standing = {
        "first": {"apple": At(-0.15, 0), "cup": At(0.12, 0.05)},
        "second": {"apple": At(0.1, 0), "banana": At(-0.15, 0.05, 30)},
    }
    for name, things in standing.items():
        _written(folder / name, things)
    return folder


def _written(folder: Path, things: dict[str, At]) -> None:
    folder.mkdir()
    sensor = open_synthetic("synthetic:empty?seed=7")
    for thing, spot in things.items():
        sensor.place(thing, spot)
    labels = [{"label": i, "name": it} for i, it in enumerate(things, start=1)]
    frames = {}
    for number in range(2):
        frame = sensor.frame()
        assert frame.depth is not None
        assert frame.intrinsics is not None
        label = np.zeros(frame.depth.shape, np.uint8)
        for place, mask in enumerate(frame.outlines.values(), start=1):
            label[mask] = place
        depth = np.nan_to_num(frame.depth * 1000).round().astype(np.uint16)
        cv2.imwrite(str(folder / f"{number}_color.png"), frame.colour[..., ::-1])
        cv2.imwrite(str(folder / f"{number}_depth.png"), depth)
        cv2.imwrite(str(folder / f"{number}_label.png"), label)
        frames[str(number)] = labels
    lens = frame.intrinsics
    described = {
        "intrinsics": {"fx": lens.fx, "fy": lens.fy, "cx": lens.cx, "cy": lens.cy},
        "depth_units_per_metre": 1000,
        "frames": frames,
    }
    (folder / "scene.json").write_text(json.dumps(described))
