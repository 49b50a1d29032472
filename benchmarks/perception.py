"""What seeing costs and how well it does: `python benchmarks/perception.py [WHICH …]`.

WHICH is any of speed, synthetic, spatial, real, pictures, regions; all without any.
`--json` prints one JSON object instead of tables. The last three need the real
captures, in ../shared/data or KILLE_DATA, and are left out without them.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.appearance import traits_of
from kille.perception.features import features_of
from kille.perception.geometry import offset
from kille.perception.index import View
from kille.perception.look import look
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.perception.segment import segment
from kille.scene import Features, Frame, Look, Percept, Region
from kille.sensors.sensor import At, Sensor, Stage
from kille.sensors.sources import open_sensor

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("KILLE_DATA") or ROOT.parent / "shared" / "data")
TEN = (
    "apple", "banana", "teddy bear", "book", "cap",
    "car", "cup", "can of paint", "shoe", "shoe-box",
)  # fmt: skip
ROUNDS = 4
CAR = At(0.0, 0.05)
WAYS = {
    "to the right of": (1, 0),
    "behind": (0, 1),
    "to the left of": (-1, 0),
    "in front of": (0, -1),
}

Row = Mapping[str, Any]


def speed(sizes: Sequence[int] = (100, 1_000, 10_000)) -> list[Row]:
    """A scan's query against SIFT on its crop, as the number of learned views grows.

    The views are of ten synthetic objects. To have thousands, each real one is varied:
    noise on the descriptors, another half of them each time.
    """
    chance = np.random.default_rng(0)
    scans = _scans_of_ten()
    region, frame, scan = scans[3][1], scans[3][0], scans[3][2]
    sift = _milliseconds(lambda: features_of(frame, region))
    rows = []
    for size in sizes:
        memory = ObjectMemory.of(_varied(scans, size, chance))
        percept = Percept(region, (scan,), lambda: traits_of(frame, region))
        start = time.perf_counter()
        memory.predict_proba_one(percept)
        built = time.perf_counter() - start
        query = _milliseconds(lambda: _asked(memory, percept))  # noqa: B023
        rows.append(
            {
                "views": size,
                "descriptors": sum(len(it.descriptors) for it in memory.views),
                "build s": round(built, 2),
                "features of the scan": len(scan.descriptors),
                "SIFT ms": round(sift, 1),
                "query ms": round(query, 1),
                "query / SIFT": round(query / sift, 2),
            }
        )
    return rows


def synthetic(sensor: str = "synthetic:empty?seed=7") -> list[Row]:
    """The paper's protocol: four rounds, each learns all ten and then asks all ten.

    Each `show` is a new pose. The answer is the word of the highest mean degree.
    """
    stage, memory = _stage(sensor), ObjectMemory()
    asked: dict[str, list[dict[str, float]]] = {name: [] for name in TEN}
    for round_ in range(ROUNDS):
        for name in TEN:
            memory.learn_one(_shown(stage, name), name, key=f"{round_}.{name}")
        for name in TEN:
            asked[name].append(memory.predict_proba_one(_shown(stage, name)))
    return [_protocol_row(name, answers) for name, answers in asked.items()]


def spatial(sensor: str = "synthetic:empty?seed=7") -> list[Row]:
    """A book around a car: 16 places three times to learn from, then 32 to be asked.

    The tutor says any word whose direction is within 60 degrees; so may the answer be.
    """
    stage, memory = _stage(sensor), RelationMemory()
    chance = np.random.default_rng(0)
    for round_ in range(3):
        for i, (spot, words) in enumerate(_around(chance)):
            seen = _book_from_car(stage, spot)
            memory.learn_one(seen, str(chance.choice(words)), key=f"{round_}.{i}")
    degrees = [
        (words, memory.predict_proba_one(_book_from_car(stage, spot)))
        for _ in range(2)
        for spot, words in _around(chance)
    ]
    right = [best(answer) in words for words, answer in degrees]
    top = [max(answer.values()) for _, answer in degrees]
    return [
        {
            "asked": len(right),
            "accepted": np.mean(right).round(3),
            "degree of the answer": np.mean(top).round(3),
        }
    ]


def real() -> list[Row]:
    """Taught in two real scenes by outlines, asked in a third by its own regions."""
    memory = ObjectMemory()
    for scene in ("0001", "0002"):
        for name, percept in outlined(scene):
            memory.learn_one(percept, name, key=f"{scene}/{name}")
    seen = look(open_sensor(str(DATA / "ycbv_scenes" / "0050")))
    return [_real_row(memory, seen, percept) for percept in seen.percepts]


def pictures() -> list[Row]:
    """SOTA's 12 categories: half of the pictures teach, the other half asks."""
    looks = _sota()
    rows = []
    for name, teaches in (
        ("even teach, odd asked", lambda i: i % 2 == 0),
        ("odd teach, even asked", lambda i: i % 2 == 1),
        ("first ten teach, last ten asked", lambda i: i < 10),
    ):
        memory = ObjectMemory()
        for word, i, percept in looks:
            if teaches(i):
                memory.learn_one(percept, word, key=f"{word}{i}")
        right = [
            best(memory.predict_proba_one(percept)) == word
            for word, i, percept in looks
            if not teaches(i)
        ]
        rows.append(
            {"split": name, "asked": len(right), "right": np.mean(right).round(3)}
        )
    return rows


def regions() -> list[Row]:
    """How many labelled objects have a region of their own (overlap .5); the time."""
    scenes = sorted((DATA / "mosd_scenes").glob("*_color.png"))
    names = [f"mosd_scenes/{path.name.removesuffix('_color.png')}" for path in scenes]
    return [
        _regions_row("mosd (24 scenes)", [_first(name) for name in names]),
        *(
            _regions_row(
                f"ycbv {scene} (10 frames)", _all_frames(f"ycbv_scenes/{scene}")
            )
            for scene in ("0001", "0002", "0050")
        ),
    ]


def outlined(scene: str) -> Iterator[tuple[str, Percept]]:
    """Each labelled thing of a real scene as the tutor's finger shows it."""
    folder = str(DATA / "ycbv_scenes" / scene)
    for name, outline in open_sensor(folder).frame().outlines.items():
        yield name, look(open_sensor(folder), pointed=outline).percepts[0]


def best(degrees: Mapping[str, float]) -> str:
    return max(degrees, key=lambda word: degrees[word], default="")


def _around(chance: np.random.Generator) -> Iterator[tuple[At, list[str]]]:
    """Sixteen spots around the car, each with the words that fit there."""
    for distance in (0.25, 0.3):
        for angle in np.radians(np.arange(0, 360, 45)):
            right, away = distance * np.cos(angle), distance * np.sin(angle)
            words = [
                w for w, (x, y) in WAYS.items() if right * x + away * y > distance / 2
            ]
            dx, dy = chance.normal(0, 0.01, 2)
            yield At(right + dx, CAR.away + away + dy, chance.uniform(-20, 20)), words


def _book_from_car(stage: Any, spot: At) -> tuple[float, float, float]:
    stage.show("car")
    stage.place("car", CAR)
    stage.place("book", spot)
    seen = look(stage, 3)
    book, car = (
        max(
            seen.percepts, key=lambda it: _overlap(seen.frame.outlines[name], it.region)
        )
        for name in ("book", "car")
    )
    return offset(book.region.place, car.region.place, seen.up)


def _scans_of_ten() -> list[tuple[Frame, Region, Features]]:
    stage = _stage("synthetic:empty?seed=3")
    scans = []
    for name in TEN:
        stage.show(name)
        frame = stage.frame()
        region = segment(frame).regions[0]
        scans.append((frame, region, features_of(frame, region)))
    return scans


def _varied(
    scans: Sequence[tuple[Frame, Region, Features]],
    count: int,
    chance: np.random.Generator,
) -> Iterator[View]:
    for key in range(count):
        frame, region, scan = scans[key % len(scans)]
        rows = _varied_rows(scan.descriptors, chance)
        yield View(key, TEN[key % len(TEN)], rows, traits_of(frame, region))


def _asked(memory: ObjectMemory, percept: Percept) -> Mapping[str, float]:
    """The answer for a thing whose traits have not been measured yet."""
    return memory.predict_proba_one(replace(percept))


def _varied_rows(
    descriptors: NDArray[np.uint8], chance: np.random.Generator
) -> NDArray[np.uint8]:
    half = chance.permutation(len(descriptors))[: len(descriptors) // 2 + 1]
    noisy = descriptors[half] + chance.normal(0, 12, (len(half), 128))
    return np.clip(noisy, 0, 255).astype(np.uint8)


def _milliseconds(act: Callable[[], object], times: int = 15) -> float:
    act()
    taken = []
    for _ in range(times):
        start = time.perf_counter()
        act()
        taken.append(time.perf_counter() - start)
    return float(np.median(taken)) * 1e3


def _stage(name: str) -> Any:
    sensor: Sensor = open_sensor(name)
    assert isinstance(sensor, Stage)
    return sensor


def _shown(stage: Any, name: str) -> Percept:
    stage.show(name)
    return look(stage).percepts[0]


def _protocol_row(name: str, answers: Sequence[Mapping[str, float]]) -> Row:
    words = {word for answer in answers for word in answer}
    mean = {
        word: float(np.mean([answer.get(word, 0.0) for answer in answers]))
        for word in sorted(words)
    }
    other = best({word: p for word, p in mean.items() if word != name})
    return {
        "object": name,
        "answer": best(mean),
        "right of 4": sum(best(answer) == name for answer in answers),
        "degree": round(mean.get(name, 0.0), 3),
        "runner-up": other,
        "its degree": round(mean.get(other, 0.0), 3),
    }


def _real_row(memory: ObjectMemory, seen: Look, percept: Percept) -> Row:
    truth = {
        name: _overlap(mask, percept.region)
        for name, mask in seen.frame.outlines.items()
    }
    name = best(truth)
    degrees = memory.predict_proba_one(percept)
    ranked = sorted(degrees, key=lambda word: -degrees[word])[:3]
    known = {view.label for view in memory.views}
    return {
        "thing": name if truth[name] > 0.4 else "clutter",
        "taught": "yes" if truth[name] > 0.4 and name in known else "no",
        "answer": ranked[0],
        "degrees": ", ".join(f"{word} {degrees[word]:.3f}" for word in ranked),
    }


def _overlap(mask: NDArray[np.bool_], region: Region) -> float:
    return float((mask & region.mask).sum() / (mask | region.mask).sum())


def _sota() -> list[tuple[str, int, Percept]]:
    gallery = _stage(str(DATA / "sota_kinect"))
    looks = []
    for word in gallery.things():
        for i in range(20):
            looks.append((word, i, _shown(gallery, word)))
    return looks


def _first(name: str) -> Frame:
    return open_sensor(str(DATA / name)).frame()


def _all_frames(name: str) -> list[Frame]:
    sensor = open_sensor(str(DATA / name))
    return [replace(sensor.frame()) for _ in range(10)]


def _regions_row(name: str, frames: Sequence[Frame]) -> Row:
    found = objects = given = 0
    for frame in frames:
        some = segment(frame).regions
        given += len(some)
        objects += len(frame.outlines)
        found += sum(
            any(_overlap(mask, region) >= 0.5 for region in some)
            for mask in frame.outlines.values()
        )
    return {
        "set": name,
        "objects": objects,
        "found": round(found / objects, 2),
        "regions": given,
        "ms": round(_milliseconds(lambda: segment(frames[0])), 1),
    }


PARTS: Mapping[str, Callable[[], list[Row]]] = {
    "speed": speed,
    "synthetic": synthetic,
    "spatial": spatial,
    "real": real,
    "pictures": pictures,
    "regions": regions,
}


OF_CAPTURES = ("real", "pictures", "regions")


def _available(names: Sequence[str]) -> list[str]:
    """The parts that can be run here; what is left out is said."""
    if DATA.is_dir():
        return list(names)
    for name in names:
        if name in OF_CAPTURES:
            print(f"{name}: left out, no real captures in {DATA}", file=sys.stderr)
    return [name for name in names if name not in OF_CAPTURES]


def _table(rows: Sequence[Row]) -> str:
    cells = [list(rows[0]), *([str(value) for value in row.values()] for row in rows)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        for row in cells
    )


def main(arguments: Sequence[str]) -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("which", nargs="*", help=", ".join(PARTS))
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    if unknown := set(options.which) - set(PARTS):
        parser.error(f"unknown: {', '.join(unknown)}; known are {', '.join(PARTS)}")
    cv2.setNumThreads(1)
    results = {name: PARTS[name]() for name in _available(options.which or list(PARTS))}
    if options.json:
        print(json.dumps(results, default=float, indent=1))
        return
    for name, rows in results.items():
        print(
            f"\n{name}: {(PARTS[name].__doc__ or '').splitlines()[0]}\n{_table(rows)}"
        )


if __name__ == "__main__":
    main(sys.argv[1:])
