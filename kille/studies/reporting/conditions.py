"""What changes from tutor to tutor and from scene to scene: tables and figures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from kille.experiments.results import Cell, Figure, Result, Table
from kille.studies.measuring.measures import Measure
from kille.studies.measuring.scored import Dialogue
from kille.studies.reporting.controls import against_the_first
from kille.studies.reporting.findings import Theories, as_drawn, estimated
from kille.studies.reporting.places import Places

__all__ = ["by_conditions"]

_TOLD = (
    "accuracy",
    "κ robot–tutor",
    "κ robot–judge",
    "κ tutor–judge",
    "accepted",
    "reference",
    "words",
    "corrections",
    "questions",
    "lessons",
)
_CHIEF = ("κ robot–tutor", "κ tutor–judge")
"""What is told of each tutor in front of each scene, and drawn."""
_DRAWN = 30
"""At most so many conditions are drawn."""

_Key: TypeAlias = tuple[str, ...]
_Parts: TypeAlias = dict[str, dict[_Key, list[Dialogue]]]


def by_conditions(
    theories: Theories, measures: Sequence[Measure], places: Places
) -> Iterator[Result]:
    """What is told of each tutor and each scene, where there are several."""
    told = [it for it in measures if it.name in _TOLD]
    chief = [it for it in measures if it.name in _CHIEF]
    tutors = _parts(theories, lambda it: (it.run.tutor,))
    scenes = _parts(theories, lambda it: (it.run.scene,))
    both = _parts(theories, lambda it: (it.run.tutor, it.run.scene))
    tables: list[Table] = []
    figures: list[Figure] = []
    if len(places.tutors) > 1:
        tables.append(_table("By tutor", ("tutor",), tutors, told, places))
        figures += _figures("by tutor", tutors, chief)
    if len(places.scenes) > 1:
        tables.append(_table("By scene", ("scene",), scenes, told, places))
        figures += _figures("by scene", scenes, chief)
    if len(tables) > 1:
        heads = ("tutor", "scene")
        tables.append(_table("By tutor and scene", heads, both, chief, places))
        figures += _figures("by tutor and scene", both, chief[:1])
    tables += against_the_first(theories, measures, places)
    if tables:
        yield Result("Tutors and scenes", tuple(tables), tuple(figures))


def _parts(theories: Theories, key: Callable[[Dialogue], _Key]) -> _Parts:
    parts: _Parts = {name: {} for name in theories}
    for name, them in theories.items():
        for it in them:
            parts[name].setdefault(key(it), []).append(it)
    return parts


def _keys(parts: _Parts) -> list[_Key]:
    return list(dict.fromkeys(key for of in parts.values() for key in of))


def _table(
    title: str, heads: _Key, parts: _Parts, measures: Sequence[Measure], places: Places
) -> Table:
    """Measure by measure; what is the same everywhere is left out."""
    rows: list[tuple[Cell, ...]] = []
    links = {}
    keys = _keys(parts)
    for measure in measures:
        found = {
            key: [estimated(measure, of.get(key, ())) for of in parts.values()]
            for key in keys
        }
        if len({it.value for of in found.values() for it in of}) == 1:
            continue
        for key, estimates in found.items():
            for column, name in enumerate(parts, start=1 + len(key)):
                links[len(rows), column] = _place(places, name, heads, key)
            rows.append((measure.name, *key, *estimates))
    return Table(title, ("measure", *heads, *parts), tuple(rows), "", links)


def _place(places: Places, theory: str, heads: _Key, key: _Key) -> str:
    to = places.scene if heads[-1] == "scene" else places.tutor
    return to(theory, key[-1])


def _figures(by: str, parts: _Parts, measures: Sequence[Measure]) -> Iterator[Figure]:
    keys = _keys(parts)
    for measure in measures if 1 < len(keys) <= _DRAWN else ():
        series = {}
        for name, of in parts.items():
            found = [estimated(measure, of.get(key, ())) for key in keys]
            series[name] = as_drawn(found)
        data = {
            "labels": [", ".join(key) for key in keys],
            "series": series,
            "xlabel": measure.name,
        }
        title = f"{measure.name} {by}"
        yield Figure("intervals", title, data, "Bands of 95 %.")
