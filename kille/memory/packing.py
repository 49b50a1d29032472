"""Pack dialogues, turns and lessons as lines of JSON, with files of arrays and
pictures.

What is unpacked is checked: a `ValueError`, `KeyError`, `TypeError` or `OverflowError`
says that these are not values that were packed.
"""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any, get_args

import numpy as np

from kille.memory.configurations import as_json, from_json
from kille.memory.lessons import (
    Arrangement,
    By,
    Criterion,
    CriterionLesson,
    Dialogue,
    Kind,
    KindLesson,
    ObjectLesson,
    RelationLesson,
    Scan,
    SeenLesson,
    Sighting,
    Subsumption,
    Turn,
    Word,
)
from kille.memory.pictures import JPEG, Crop, Picture
from kille.safety.archives import read_arrays
from kille.scene import Box, Intrinsics, Point
from ttr.safety.limits import MEMBER

Line = dict[str, Any]
Files = Mapping[str, bytes]

FEATURES, FRAME, MASK, DEPTH = "features.npz", "frame.jpg", "mask.png", "depth.png"
COLOURS = {True: "crop.jpg", False: "crop.png"}
"""What the colours of a crop are called, by whether they are a JPEG."""
FILES = frozenset({FEATURES, FRAME, MASK, DEPTH, *COLOURS.values()})
TRAIT = "trait_"
_LARGEST = 2**53


def pack_dialogue(dialogue: Dialogue) -> Line:
    """Pack a dialogue as a line."""
    return {"dialogue": dialogue.number, "began": dialogue.began}


def unpack_dialogue(line: Line) -> Dialogue:
    """Unpack a dialogue from its line."""
    return Dialogue(whole(line, "dialogue"), _text(line, "began"))


def pack_turn(turn: Turn) -> Line:
    """Pack a turn as a line."""
    return asdict(turn)


def unpack_turn(line: Line) -> Turn:
    """Unpack a turn from its line."""
    texts = (_text(line, it) for it in ("speaker", "text", "judgement", "time"))
    return Turn(whole(line, "dialogue"), whole(line, "number"), *texts)


def pack_lesson(lesson: SeenLesson) -> tuple[Line, Files]:
    """Pack a lesson as a line, and the files that belong to it."""
    line: Line = {
        "lesson": lesson.key,
        **asdict(lesson.word),
        "holds": lesson.holds,
        "dialogue": lesson.turn.dialogue,
        "turn": lesson.turn.number,
        "sensor": lesson.seen.sensor,
        "time": lesson.seen.time,
    }
    files: dict[str, bytes] = {}
    match lesson.seen:
        case Sighting() as seen:
            line["place"] = seen.place
            files[FEATURES] = _features(seen)
        case Arrangement() as seen:
            line |= {"target": seen.target, "landmark": seen.landmark}
            line["configuration"] = as_json(seen.configuration)
        case Subsumption(upper=upper):
            line["upper"] = {
                "name": upper.name,
                "surface": upper.surface,
                "article": upper.article,
            }
        case Criterion(by, name, surface, degree, article):
            line["criterion"] = {
                "by": by,
                "name": name,
                "surface": surface,
                "article": article,
                "degree": degree,
            }
    if lesson.seen.picture is not None:
        picture_line, pictures = _pack_picture(lesson.seen.picture)
        line["picture"] = picture_line
        files |= pictures
    return line, files


def unpack_lesson(
    line: Line, files: Files, turns: Mapping[tuple[int, int], Turn]
) -> SeenLesson:
    """Unpack a lesson from its line and files; `turns` are by dialogue and number."""
    key = whole(line, "lesson")
    turn = turns[whole(line, "dialogue"), whole(line, "turn")]
    word, holds = _word(line), _truth(line)
    sensor, time = _text(line, "sensor"), _number(line["time"])
    picture = _unpack_picture(line["picture"], files) if "picture" in line else None
    match word.kind:
        case "object" | "attribute":
            place = None if line["place"] is None else _point(line["place"])
            scans, traits = _unpack_features(files[FEATURES])
            sighting = Sighting(sensor, time, scans, place, traits, picture)
            return ObjectLesson(key, word, turn, sighting, holds=holds)
        case "relation":
            target, landmark = _text(line, "target"), _text(line, "landmark")
            configuration = from_json(line["configuration"])
            stand = Arrangement(sensor, time, target, landmark, configuration, picture)
            return RelationLesson(key, word, turn, stand, holds=holds)
        case "subkind":
            upper = _word({**line["upper"], "kind": "object"})
            said = Subsumption(upper, sensor, time)
            return KindLesson(key, word, turn, said, holds=holds)
        case "criterion":
            by = _criterion(line["criterion"], sensor, time)
            return CriterionLesson(key, word, turn, by, holds=holds)


def _word(line: Line) -> Word:
    kinds: dict[str, Kind] = {it: it for it in get_args(Kind)}
    if line["kind"] not in kinds:
        raise ValueError(f"there are no lessons of the kind {line['kind']}")
    article = _text(line, "article") if "article" in line else ""
    return Word(
        _text(line, "name"), _text(line, "surface"), kinds[line["kind"]], article
    )


def _criterion(line: Line, sensor: str, time: float) -> Criterion:
    ways: dict[str, By] = {it: it for it in get_args(By)}
    if line["by"] not in ways:
        raise ValueError(f"nothing is known by its {line['by']}")
    name, surface, article = (_text(line, it) for it in ("name", "surface", "article"))
    degree = _number(line["degree"])
    return Criterion(ways[line["by"]], name, surface, degree, article, sensor, time)


def _truth(line: Line) -> bool:
    """Does the lesson say that the word applies? Older lines without this field do."""
    holds = line.get("holds", True)
    if not isinstance(holds, bool):
        raise TypeError(f"holds is {holds!r}, neither true nor false")
    return holds


def whole(line: Line, name: str) -> int:
    """The whole number in this field, which must not be negative."""
    value = _integer(line[name])
    if value < 0:
        raise ValueError(f"{name} is below zero")
    return value


def _features(seen: Sighting) -> bytes:
    arrays: dict[str, Any] = {}
    for number, scan in enumerate(seen.scans):
        arrays[f"descriptors_{number}"] = scan.descriptors
        arrays[f"points_{number}"] = scan.points
    arrays |= {TRAIT + cue: vector for cue, vector in seen.traits.items()}
    packed = io.BytesIO()
    np.savez(packed, **arrays)
    return packed.getvalue()


def _unpack_features(packed: bytes) -> tuple[tuple[Scan, ...], dict[str, Any]]:
    found = read_arrays(packed, MEMBER)
    scans = tuple(
        Scan(found.pop(f"descriptors_{number}"), found.pop(f"points_{number}"))
        for number in range(sum(name.startswith("points_") for name in found))
    )
    return scans, {name.removeprefix(TRAIT): found[name] for name in found}


def _pack_picture(picture: Picture) -> tuple[Line, Files]:
    line: Line = {"boxes": [box._asdict() for box in picture.boxes]}
    files = {FRAME: picture.frame}
    if picture.crop is not None:
        crop = picture.crop
        files |= {COLOURS[crop.colour.startswith(JPEG)]: crop.colour, MASK: crop.mask}
        if crop.depth is not None:
            files[DEPTH] = crop.depth
        if crop.intrinsics is not None:
            line["intrinsics"] = asdict(crop.intrinsics)
    return line, files


def _unpack_picture(line: Line, files: Files) -> Picture:
    boxes = tuple(_box(box) for box in line["boxes"])
    return Picture(files[FRAME], boxes, _unpack_crop(line, files))


def _unpack_crop(line: Line, files: Files) -> Crop | None:
    if MASK not in files:
        return None
    (colour,) = (files[name] for name in COLOURS.values() if name in files)
    lens = line.get("intrinsics")
    intrinsics = None
    if lens is not None:
        intrinsics = Intrinsics(*(_number(lens[it]) for it in ("fx", "fy", "cx", "cy")))
    return Crop(colour, files[MASK], files.get(DEPTH), intrinsics)


def _box(line: Line) -> Box:
    return Box(*(_integer(line[side]) for side in Box._fields))


def _text(line: Line, name: str) -> str:
    value = line[name]
    if not isinstance(value, str):
        raise TypeError(f"{name} is no text")
    value.encode()  # halves of characters, which JSON can name, are ValueErrors
    return value


def _integer(value: object) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) > _LARGEST:
        raise TypeError(f"{value!r} is no whole number that a memory can keep")
    return value


def _number(value: object) -> float:
    if not isinstance(value, float | int) or isinstance(value, bool):
        raise TypeError(f"{value!r} is no number")
    if not math.isfinite(value):
        raise ValueError(f"{value!r} is no finite number")
    return float(value)


def _point(values: Any) -> Point:
    right, down, forward = map(_number, values)
    return Point(right, down, forward)
