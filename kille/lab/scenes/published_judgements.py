"""People's judgements of spatial words, read from the files of published studies.

Each study is recognised by its files and read into the same form: for each word, the
configurations it was judged of, to what degree it was held to fit, and in which scene.
"""

from __future__ import annotations

import csv
import io
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from kille.lab.results import ExperimentError
from kille.perception.relations.bounding_boxes import Bounds, containment
from kille.scene import Configuration, Direction
from ttr.safety.inputs import parse_json, read_text
from ttr.safety.limits import TABLE

_CELL = 0.1  # metres: a cell of the grid of Logan and Sadler is taken as that wide


@dataclass(frozen=True)
class Judged:
    """A word judged of x: the mean degree in [0, 1] to which people held it to fit."""

    x: Configuration
    degree: float
    scene: str = ""


@dataclass(frozen=True)
class Choice:
    """Of some targets the one that a person found to fit a word best."""

    word: str
    targets: tuple[Configuration, ...]
    chosen: int
    scene: str


@dataclass(frozen=True, eq=False)
class JudgementStudy:
    """What people said; `about` names what the words are about, as a rule would."""

    name: str
    words: Mapping[str, Sequence[Judged]]
    about: Mapping[str, str]
    choices: Sequence[Choice] = field(default=())

    def every(self) -> Iterator[Judged]:
        """All that was judged, word by word."""
        for them in self.words.values():
            yield from them


_ABOUT = {
    "left": "left",
    "right": "right",
    "to the left of": "left",
    "to the right of": "right",
    "in front of": "towards",
    "behind": "away",
    "above": "up",
    "over": "up",
    "on": "up",
    "on top of": "up",
    "below": "down",
    "under": "down",
    "near": "near",
    "near to": "near",
    "next to": "near",
    "beside": "near",
    "touching": "near",
    "between": "near",
    "in": "near",
    "inside": "near",
    "against": "near",
    "far from": "far",
    "away from": "far",
}


def read(folder: Path) -> JudgementStudy:
    """The study in a folder; ExperimentError if there is none that is known."""
    for files, reader in _READERS.items():
        if all((folder / it).is_file() for it in files):
            return _read_study(folder, files, reader)
    known = "; ".join(" with ".join(files) for files in _READERS)
    raise ExperimentError(
        f"{folder} has no judgements of spatial words that are known: it needs {known}"
    )


def _read_study(folder: Path, files: Sequence[str], reader: Any) -> JudgementStudy:
    try:
        study: JudgementStudy = reader(folder)
    except (LookupError, ValueError, TypeError, ArithmeticError, csv.Error) as error:
        raise ExperimentError(
            f"{folder}: {' or '.join(files)} is not as expected "
            f"({type(error).__name__}: {error}); see where it was published"
        ) from error
    if not any(study.words.values()):
        raise ExperimentError(f"{folder} holds no judgement")
    return study


# --- Logan and Sadler 1996 -----------------------------------------------------------


def _grid(folder: Path) -> JudgementStudy:
    """Ratings from 1 to 9 of ten words on an upright grid around a landmark."""
    words: dict[str, list[Judged]] = defaultdict(list)
    for row in _rows(folder / "logan_sadler.csv"):
        right, up = int(row["dx_right"]) * _CELL, int(row["dy_up"]) * _CELL
        x = Configuration((right, 0.0, up), target_size=_CELL, landmark_size=_CELL)
        degree = (float(row["rating_1_9"]) - 1) / 8
        words[row["preposition"]].append(Judged(x, degree))
    return JudgementStudy("Logan and Sadler 1996", dict(words), _ABOUT)


# --- rooms ---------------------------------------------------------------------------


def _rooms(folder: Path) -> JudgementStudy:
    """Statements said to be true or false of things in rooms.

    Those of sides are left out where the viewer is not known and where they are by the
    landmark's own front, and so are words with fewer than 40 statements.
    """
    scenes = parse_json(read_text(folder / "scenes.json", TABLE))
    words: dict[str, list[Judged]] = defaultdict(list)
    for row in _rows(folder / "relations.csv"):
        x = _in_room(row, scenes[row["scene"]])
        if x is not None:
            judged = Judged(x, float(row["holds"]), row["scene"])
            words[row["preposition"]].append(judged)
    enough = {word: them for word, them in words.items() if len(them) >= 40}
    return JudgementStudy("statements about rooms", enough, _ABOUT)


def _in_room(row: Mapping[str, str], scene: Mapping[str, Any]) -> Configuration | None:
    names = [row["target"], row["landmark"]]
    second = row.get("landmark2", "")
    things = scene["objects"]
    if not all(it in things for it in [*names, *([second] if second else [])]):
        return None
    viewed = scene.get("viewer_side_estimated") is not None
    sided = any(it in row["preposition"] for it in ("left", "right", "front", "behind"))
    if row["reading"] == "intrinsic" or (sided and not viewed):
        return None
    # The viewer is on the +y side: right is -x, away is -y.
    turned = np.array([-1, -1, 1]) if viewed else np.ones(3)
    target, landmark = (_bounds(things[it], turned) for it in names)
    others = [second] if second else [it for it in things if it not in names]
    held = containment(target, landmark)
    return Configuration(
        offset=_direction(target.middle - landmark.middle),
        viewed=_ray(scene, landmark, turned) if viewed else None,
        target_size=target.size,
        landmark_size=landmark.size,
        others=tuple(
            _direction(_bounds(things[it], turned).middle - landmark.middle)
            for it in others
            if "plane" not in things[it]["type"]
        ),
        contact=held.contact,
        support=held.support,
        containment=held.containment,
    )


def _bounds(thing: Mapping[str, Any], turned: Any) -> Bounds:
    corners = np.array([thing["bbox_min"], thing["bbox_max"]], np.float64) * turned
    return Bounds(corners.min(axis=0), corners.max(axis=0))


def _ray(scene: Mapping[str, Any], landmark: Bounds, turned: Any) -> Direction | None:
    """From the camera to the landmark, if the camera is on the viewer's side."""
    if not scene.get("camera"):
        return None
    eye = np.array(scene["camera"]["location"], np.float64) * turned
    ray = landmark.middle - eye
    return _direction(ray) if ray[1] > abs(ray[0]) else None


# --- things in use -------------------------------------------------------------------


def _functional(folder: Path) -> JudgementStudy:
    """Words ticked for pairs of things, and the best of some things for a word.

    The degree of a word is the share of people who ticked it. There are no places, so
    the offset is told from the distances and from how much is above and below.
    """
    pairs = {
        (row["Scene"], row["Figure"], row["Ground"]): _pair_configuration(row)
        for row in _rows(folder / "relations.csv")
    }
    ticked: dict[tuple[str, str, str], list[set[str]]] = defaultdict(list)
    for row in _rows(folder / "category_judgments.csv"):
        key = (row["Scene"], row["Figure"], row["Ground"])
        ticked[key].append({it for it in row["Prepositions"].split(";") if it})
    names = sorted({it for sets in ticked.values() for ticks in sets for it in ticks})
    words = {
        word: [
            Judged(pairs[key], float(np.mean([word in it for it in sets])), key[0])
            for key, sets in ticked.items()
            if key in pairs
        ]
        for word in names
        if word != "none"
    }
    choices = _choices(folder / "comparative_judgments.csv", pairs)
    return JudgementStudy("things in use 2019", words, _ABOUT, choices)


def _pair_configuration(row: Mapping[str, str]) -> Configuration:
    target, ground = (
        max(float(row[it]), 1e-9) ** (1 / 3)
        for it in ("figure_volume", "ground_volume")
    )
    side = float(row["above_proportion"]) - float(row["below_proportion"])
    rise = side * (float(row["shortest_distance"]) + (target + ground) / 2)
    return Configuration(
        offset=(float(row["horizontal_distance"]), 0.0, rise),
        target_size=target,
        landmark_size=ground,
        contact=_share(row["contact_proportion"]),
        support=_share(row["support"]),
        containment=_share(row["bbox_overlap_proportion"]),
    )


def _choices(
    file: Path, pairs: Mapping[tuple[str, str, str], Configuration]
) -> list[Choice]:
    if not file.is_file():
        return []
    _, *rows = csv.reader(io.StringIO(read_text(file, TABLE)))
    found = []
    for _, _, _, scene, word, figure, ground, _, *others in rows:
        possible = [it for it in others if (scene, it, ground) in pairs]
        if figure in possible and len(possible) > 1:
            them = tuple(pairs[scene, it, ground] for it in possible)
            found.append(Choice(word, them, possible.index(figure), scene))
    return found


def _share(text: str) -> float:
    return min(1.0, max(0.0, float(text)))


def _rows(file: Path) -> Iterable[dict[str, str]]:
    yield from csv.DictReader(io.StringIO(read_text(file, TABLE)))


def _direction(vector: Any) -> Direction:
    right, away, up = (float(it) for it in vector)
    if not math.isfinite(right + away + up):
        raise ValueError("a place that is no number")
    return right, away, up


_READERS = {
    ("logan_sadler.csv",): _grid,
    ("scenes.json", "relations.csv"): _rooms,
    ("category_judgments.csv", "relations.csv"): _functional,
}
