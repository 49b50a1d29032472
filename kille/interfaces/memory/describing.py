"""Describe a lesson in words: who taught it, when, and what was to be seen."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from kille.memory import (
    Arrangement,
    Criterion,
    Lesson,
    Sighting,
    Subsumption,
    Turn,
)
from kille.memory.lessons import SeenLesson
from kille.scene import Direction, Point, Traits
from ttr.escapes import terminal_word

_KINDS = {
    "object": "a thing",
    "attribute": "how a thing is",
    "relation": "where a thing is",
    "subkind": "a kind of thing",
    "criterion": "by what a kind of thing is known",
}
_NEARLY_NOTHING = 0.01  # metres: the cue of size is the logarithm of a length and this
_HOLDS, _MOST_COLOURS = 0.5, 3
_UNMOVED = 0.005  # metres that nobody would mention


def when(time: str) -> str:
    """A time in ISO 8601 as people write it, to the minute."""
    return time.replace("T", " ")[:16]


def describe_turn(turn: Turn) -> str:
    """The speaker, the time and the text of a turn."""
    return terminal_word(f"{turn.speaker}, {when(turn.time)}: {turn.text}")


def title(lesson: Lesson) -> str:
    """The lesson's word, also if it is denied, its kind and its number."""
    word = lesson.word
    what = word.surface if lesson.holds else f"not {word.surface}"
    return terminal_word(f"{what} ({_KINDS[word.kind]}), lesson {lesson.key}")


def describe_sight(lesson: SeenLesson) -> Iterator[str]:
    """Describe what was to be seen, or what was said of a kind, line by line."""
    yield f"dialogue {lesson.turn.dialogue}, turn {lesson.turn.number}"
    match lesson.seen:
        case Sighting() as sighting:
            yield from _describe_sighting(sighting)
        case Arrangement() as stand:
            yield f"seen through {terminal_word(stand.sensor)}"
            things = f"{_words(stand.target)} from {_words(stand.landmark)}"
            yield f"{things}: {_where(stand.configuration.offset)}"
        case Subsumption() as said:
            yield f"a kind of {terminal_word(said.upper.surface)}"
        case Criterion() as criterion:
            yield _describe_criterion(criterion)


def _describe_criterion(criterion: Criterion) -> str:
    """By what things of a kind were said to be known: a cue, a quality, a part."""
    surface = terminal_word(criterion.surface)
    match criterion.by:
        case "cue":
            return (
                f"the {surface} {'matters' if criterion.degree else 'does not matter'}"
            )
        case "quality":
            return f"{surface} with a degree of {criterion.degree:g}"
    return f"with {surface} as a part with a degree of {criterion.degree:g}"


def looks(lesson: SeenLesson) -> str:
    """The size and the colours of the thing, as far as they are known; else ""."""
    if not isinstance(lesson.seen, Sighting):
        return ""
    traits = lesson.seen.traits
    return ", ".join(filter(None, (_list_words(colours(traits)), _size(traits))))


def lengths(traits: Traits) -> tuple[float, ...] | None:
    """The extent of a thing in metres, longest first, by the cue `size`."""
    if "size" not in traits or len(traits["size"]) != len(Point._fields):
        return None
    found = np.exp(traits["size"].astype(np.float64)) - _NEARLY_NOTHING
    return tuple(max(0.0, x) for x in found.tolist())


def colours(traits: Traits) -> tuple[str, ...]:
    """The colour words that apply to a thing, the best first."""
    from kille.perception.colours import BASIC, colour_words, colours_in, xkcd

    if "colour" not in traits:
        return ()
    try:
        palette = colours_in(traits["colour"])
    except ValueError:  # another cue had that name when this was learned
        return ()
    degrees = colour_words(palette, xkcd().among(BASIC))
    best = sorted(degrees, key=lambda word: -degrees[word])[:_MOST_COLOURS]
    return tuple(word for word in best if degrees[word] >= _HOLDS)


def _describe_sighting(sighting: Sighting) -> Iterator[str]:
    features = sum(len(scan.descriptors) for scan in sighting.scans)
    yield f"seen through {terminal_word(sighting.sensor)}, by {features} features"
    if sighting.place is not None:
        yield f"{math.hypot(*sighting.place):.2f} m from the camera"


def _list_words(words: Sequence[str]) -> str:
    """Words as a list in a sentence: red, grey and white."""
    *others, last = words or ("",)
    return f"{', '.join(others)} and {last}" if others else last


def _size(traits: Traits) -> str:
    reach = lengths(traits)
    return "" if reach is None else " x ".join(_centimetres(x) for x in reach) + " cm"


def _centimetres(metres: float) -> str:
    return f"{100 * metres:.0f}" if metres >= 0.01 else f"{100 * metres:.1f}"


def _where(offset: Direction) -> str:
    """An offset in a tutor's words: 20 cm left and 10 cm nearer."""
    pairs = (("right", "left"), ("farther", "nearer"), ("up", "down"))
    moved = [
        f"{100 * abs(metres):.0f} cm {more if metres > 0 else less}"
        for metres, (more, less) in zip(offset, pairs, strict=True)
        if abs(metres) >= _UNMOVED
    ]
    return ", ".join(moved) or "at the same place"


def _words(name: str) -> str:
    return terminal_word(name.replace("_", " "))
