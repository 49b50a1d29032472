"""`kille memory show`: what the robot was taught, by whom, and what it looked like."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console

from kille.interfaces.memory.choosing import lessons_named
from kille.interfaces.memory.describing import (
    colours,
    describe_sight,
    describe_turn,
    lengths,
    looks,
    title,
)
from kille.interfaces.terminal import (
    FINE,
    complain,
    console,
    hang_text,
    memory_path,
    print_json,
)
from kille.memory import (
    Criterion,
    Memory,
    MemoryFileError,
    NoSuchLessonError,
    Picture,
    Sighting,
    Subsumption,
)
from kille.memory.configurations import as_json as configuration_json
from kille.memory.lessons import SeenLesson
from kille.memory.pictures import JPEG
from kille.safety.private_files import open_private

_COLUMNS, _ROWS = 40, 12
_NAME = 50  # characters of a word in the name of a file


@dataclass(frozen=True)
class ShownLesson:
    """A lesson to show, and where its pictures were written."""

    lesson: SeenLesson
    files: Mapping[str, Path]


Report = Callable[[Iterable[ShownLesson]], None]
"""Shows lessons."""


def show(given: Path | None, named: str, out: Path | None, report: Report) -> int:
    """Show the lessons in a word, or the one with a number; returns the exit code.

    Their pictures go into a folder, if one is given.
    """
    path = memory_path(given)
    try:
        with Memory.open_to_read(path) as memory, memory.at_one_moment():
            keys = [lesson.key for lesson in lessons_named(memory, named)]
            report(_write_lesson(memory.lesson(key), out) for key in keys)
    except (MemoryFileError, NoSuchLessonError, _Unwritable) as error:
        return complain(error)
    return FINE


def as_json(shown: Iterable[ShownLesson]) -> None:
    """The lessons as a list of objects, for machines."""
    print_json([_facts(it) for it in shown])


def as_text(shown: Iterable[ShownLesson]) -> None:
    """The lessons for people, with a picture where the terminal can show one."""
    out = console()
    for number, it in enumerate(shown):
        if number:
            out.print()
        _tell(out, it)


def _tell(out: Console, shown: ShownLesson) -> None:
    out.print(title(shown.lesson), style="bold", markup=False)
    for line in _lines(shown):
        out.print(hang_text("  ", line), markup=False)
    picture = shown.lesson.seen.picture
    if picture is not None:
        _draw(out, picture)


def _lines(shown: ShownLesson) -> Iterator[str]:
    yield describe_turn(shown.lesson.turn)
    yield ", ".join(describe_sight(shown.lesson))
    if isinstance(shown.lesson.seen, Subsumption | Criterion):
        return
    if looked := looks(shown.lesson):
        yield looked
    if shown.lesson.seen.picture is None:
        yield "no picture was kept"
    for file in shown.files.values():
        yield str(file)


def _draw(out: Console, picture: Picture) -> None:
    from kille.interfaces.memory.half_blocks import half_blocks, shows_pictures

    if not shows_pictures(out):
        return
    from kille.perception.thumbnails import decode_picture, outline_things

    crop = picture.crop
    try:
        pixels = (
            outline_things(picture) if crop is None else decode_picture(crop.colour)
        )
    except ValueError as error:  # it came so from another program
        out.print(f"  {error}", markup=False)
        return
    out.print(half_blocks(pixels, min(_COLUMNS, out.width), _ROWS))


# --- pictures in a folder ------------------------------------------------------------


class _Unwritable(Exception):
    """Pictures that cannot be written where the user wants them."""


def _write_lesson(lesson: SeenLesson, out: Path | None) -> ShownLesson:
    """Write the pictures of a lesson into the folder; returns the lesson to show."""
    picture = lesson.seen.picture
    if out is None or picture is None:
        return ShownLesson(lesson, {})
    name = re.sub(r"[^\w-]", "_", lesson.word.name)[:_NAME]
    files: dict[str, Path] = {}
    try:
        out.mkdir(parents=True, exist_ok=True)
        for kind, (ending, content) in _pictures(picture).items():
            files[kind] = out / f"{lesson.key}-{name}-{kind}{ending}"
            with open(files[kind], "wb", opener=open_private) as file:
                file.write(content)
    except OSError as error:
        raise _Unwritable(
            f"the pictures cannot be written to {out} ({error.strerror}): "
            "name another folder with --out"
        ) from error
    return ShownLesson(lesson, files)


def _pictures(picture: Picture) -> Mapping[str, tuple[str, bytes]]:
    """The pictures by what they show, with the endings of their files."""
    found = {"frame": (".jpg", picture.frame)}
    if picture.crop is not None:
        jpeg = picture.crop.colour.startswith(JPEG)
        found["crop"] = ".jpg" if jpeg else ".png", picture.crop.colour
        found["mask"] = ".png", picture.crop.mask
        if picture.crop.depth is not None:
            found["depth"] = ".png", picture.crop.depth
    return found


# --- facts for machines --------------------------------------------------------------


def _facts(shown: ShownLesson) -> dict[str, Any]:
    lesson = shown.lesson
    facts = {
        "lesson": lesson.key,
        "word": lesson.word.surface,
        "kind": lesson.word.kind,
        "holds": lesson.holds,
        "turn": asdict(lesson.turn),
        "sensor": lesson.seen.sensor,
        "pictures": {kind: str(file) for kind, file in shown.files.items()},
    }
    if isinstance(lesson.seen, Sighting):
        return facts | _sighting_fields(lesson.seen)
    if isinstance(lesson.seen, Subsumption):
        return facts | {"kind_of": lesson.seen.upper.surface}
    if isinstance(lesson.seen, Criterion):
        known = lesson.seen
        said = {"by": known.by, "criterion": known.surface, "degree": known.degree}
        return facts | said
    stand = lesson.seen
    things = {"target": stand.target, "landmark": stand.landmark}
    return facts | things | {"configuration": configuration_json(stand.configuration)}


def _sighting_fields(sighting: Sighting) -> dict[str, Any]:
    return {
        "place": sighting.place,
        "metres": lengths(sighting.traits),
        "colours": colours(sighting.traits),
        "features": sum(len(scan.descriptors) for scan in sighting.scans),
        "cues": sorted(sighting.traits),
    }
