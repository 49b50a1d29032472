"""The word shelf: what the robot learned each word from, and what it makes of it."""

from __future__ import annotations

from functools import cache
from itertools import accumulate
from typing import Any, get_args

import numpy as np

from kille.agent.agent import Agent
from kille.memory import MemoryFileError
from kille.memory.lessons import Kind
from kille.perception.colours.space import lab_of
from kille.perception.colours.words import xkcd

Json = dict[str, Any]

WORDS = 48
"""Words of a page."""

EXAMPLES = 24
"""The latest examples of a word that are shown."""

LESSONS = 200
"""The latest lessons over which a word is followed."""

ACROSS, AWAY = 21, 17
"""Columns and rows of a spatial template."""

CELL = 0.05
"""Metres from one cell of it to the next."""

_SHADES = 12


def shelf_page(robot: Agent, start: int) -> Json:
    """The words from a number on, at most a page of them, and how many there are."""
    words, counts = robot.memory.words(), robot.memory.counts()
    return {
        "count": len(words),
        "start": start,
        "words": [
            {
                "kind": it.kind,
                "name": it.name,
                "form": it.surface,
                "lessons": counts[it.kind, it.name],
                "swatch": swatch(it.name) if it.kind == "attribute" else "",
            }
            for it in words[start : start + WORDS]
        ],
    }


def word_report(robot: Agent, kind: str, name: str) -> Json | None:
    """What a word was learned from; None if it was not taught.

    `examples` are its latest lessons; `curve` is how many examples for and against it
    there had been after each of the latest lessons in any word. `template` has rows of
    degrees, the farthest first, for where a target stands to the landmark in the
    middle. `swatch` is the colour that is called by it.
    """
    if (known := next((it for it in get_args(Kind) if it == kind), None)) is None:
        return None
    keys = robot.memory.keys_of(known, name)
    if not keys:
        return None
    shown = [robot.memory.lesson_without_sight(it) for it in keys[-EXAMPLES:]]
    latest = robot.memory.latest(LESSONS)
    mine = [it.word.kind == kind and it.word.name == name for it in latest]
    pro = [int(me and it.holds) for me, it in zip(mine, latest, strict=True)]
    con = [int(me and not it.holds) for me, it in zip(mine, latest, strict=True)]
    return {
        "kind": kind,
        "name": name,
        "form": shown[-1].word.surface,
        "lessons": len(keys),
        "examples": [
            {"key": it.key, "holds": it.holds, "day": it.turn.time[:10]}
            for it in reversed(shown)
        ],
        "curve": {"for": [*accumulate(pro)], "against": [*accumulate(con)]},
        "template": _template(robot, name) if kind == "relation" else None,
        "cell": CELL,
        "swatch": swatch(name) if kind == "attribute" else "",
    }


def _template(robot: Agent, name: str) -> list[list[float]]:
    places = [
        ((column - ACROSS // 2) * CELL, (AWAY // 2 - row) * CELL)
        for row in range(AWAY)
        for column in range(ACROSS)
    ]
    degrees = [round(it, 3) for it in robot.spatial_degrees(name, places)]
    return [degrees[at : at + ACROSS] for at in range(0, len(degrees), ACROSS)]


@cache
def swatch(name: str) -> str:
    """The colour that people call so most of all, as `#rrggbb`; by its predicate.

    Empty for what is no colour word that people were asked about.

    >>> swatch("is_red"), swatch("is_soft")
    ('#e70017', '')
    """
    words, colour = xkcd(), name.removeprefix("is_").replace("_", " ")
    if colour not in words.names:
        return ""
    steps = np.linspace(0, 255, _SHADES).astype(np.uint8)
    rgb = np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3)
    chances = words.chances(lab_of(rgb))[:, words.names.index(colour)]
    red, green, blue = rgb[int(chances.argmax())].tolist()
    return f"#{red:02x}{green:02x}{blue:02x}"


def example_picture(robot: Agent, key: int) -> bytes | None:
    """What was seen in a lesson, as a JPEG or PNG; None if nothing was kept.

    It is the thing itself where there is one, else the whole frame.
    """
    try:
        picture = robot.memory.picture(key)
    except MemoryFileError:
        return None
    if picture is None:
        return None
    return picture.frame if picture.crop is None else picture.crop.colour
