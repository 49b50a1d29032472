"""Tables and figures of what changes from tutor to tutor and from scene to scene."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeAlias

from kille.lab.measures.measures import Measure
from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.reports.controls import compare_with_first
from kille.lab.reports.figure_styles import HUES
from kille.lab.reports.findings import Theories, estimate_measure
from kille.lab.reports.links import Places
from kille.lab.reports.repeated_tests import main_measure, phases_of, restrict_to_phase
from kille.lab.reports.row_figures import row_figures
from kille.lab.reports.short_names import shorten_names
from kille.lab.results import Cell, Estimate, Figure, Result, Table

_ROBOT, _PEOPLE = "κ robot–tutor", "κ tutor–judge"
_SHOWN = (
    "accuracy",
    _ROBOT,
    "κ robot–judge",
    _PEOPLE,
    "accepted",
    "reference",
    "words",
    "corrections",
    "questions",
    "lessons",
)
_CHIEF = ("accuracy", _ROBOT, "accepted", "reference")
"""The measures shown of each tutor in front of each scene."""
_DRAWN = 40
"""The most conditions that are drawn."""
_ROWS = 48
"""Of more phases times conditions, only the last phase is shown."""

_Key: TypeAlias = tuple[str, ...]
_Parts: TypeAlias = dict[str, dict[_Key, list[ScoredDialogue]]]
_Heads: TypeAlias = Mapping[str, Callable[[ScoredDialogue], str]]

_TUTOR: _Heads = {"tutor": lambda it: it.run.tutor}
_SCENE: _Heads = {"scene": lambda it: it.run.scene}


def compare_conditions(
    theories: Theories, measures: Sequence[Measure], places: Places
) -> Iterator[Result]:
    """The measures for each tutor and for each scene, where there are several.

    Of a single theory it is said in words how much they matter.
    """
    heads = _varied_conditions(places)
    if not heads:
        return
    shown = [it for it in measures if it.name in _SHOWN]
    tables = [*_by_phase(theories, measures, heads, places)]
    figures: list[Figure] = []
    for head in heads:
        parts = _parts(theories, head)
        tables.append(_table(_by_heads(head), head, parts, shown, places))
        figures += _agreement_figures(_by_heads(head), parts, measures)
    against = list(compare_with_first(theories, measures, places))
    tables += [it.table for it in against]
    text = "\n\n".join(it.text for it in against if it.text)
    yield Result(
        "Tutors and scenes",
        tuple(tables),
        tuple(figures),
        text=text if len(theories) == 1 else "",
    )
    if len(heads) > 1:
        yield _cross_conditions(theories, measures, places)


def _cross_conditions(
    theories: Theories, measures: Sequence[Measure], places: Places
) -> Result:
    """The measures for each tutor in front of each scene."""
    heads = {**_TUTOR, **_SCENE}
    parts = _parts(theories, heads)
    chief = [it for it in measures if it.name in _CHIEF]
    table = _table(_by_heads(heads), heads, parts, chief, places)
    figures = tuple(_agreement_figures(_by_heads(heads), parts, measures))
    return Result("Each tutor in front of each scene", (table,), figures)


def _varied_conditions(places: Places) -> list[_Heads]:
    """Tutors if there are several, and scenes if there are."""
    conditions = (_TUTOR, _SCENE)
    return [
        it for it in conditions if all(len(places.numbers[name]) > 1 for name in it)
    ]


def _by_heads(heads: _Heads) -> str:
    return f"by {' and '.join(heads)}"


def _parts(theories: Theories, heads: _Heads) -> _Parts:
    parts: _Parts = {name: {} for name in theories}
    for name, them in theories.items():
        for it in them:
            key = tuple(of(it) for of in heads.values())
            parts[name].setdefault(key, []).append(it)
    return parts


def _keys(parts: _Parts) -> list[_Key]:
    return list(dict.fromkeys(key for of in parts.values() for key in of))


# --- tables --------------------------------------------------------------------------


def _table(
    by: str, heads: _Heads, parts: _Parts, measures: Sequence[Measure], places: Places
) -> Table:
    """The table of these measures, without those that are the same everywhere."""
    rows = []
    for measure in measures:
        found = _estimates(parts, measure)
        if len({it.value for of in found.values() for it in of.values()}) > 1:
            rows += [(measure.name, key, found) for key in _keys(parts)]
    columns = ("measure", *heads)
    return _estimate_table(by.capitalize(), columns, list(parts), rows, places)


_Row: TypeAlias = tuple[str, _Key, "_Estimates"]
"""What a row is of, the condition, and the estimates of all theories."""


def _estimate_table(
    title: str,
    heads: Sequence[str],
    theories: Sequence[str],
    rows: Sequence[_Row],
    places: Places,
) -> Table:
    """A table with a column for each theory, in which numbers lead to dialogues."""
    cells: tuple[tuple[Cell, ...], ...] = tuple(
        (first, *key, *(found[name][key] for name in theories))
        for first, key, found in rows
    )
    links = {
        (row, column): places.dialogues(name, heads[-1], key[-1])
        for row, (_, key, _) in enumerate(rows)
        for column, name in enumerate(theories, start=len(heads))
    }
    return Table(title, (*heads, *theories), cells, "", links)


def _by_phase(
    theories: Theories,
    measures: Sequence[Measure],
    varied: Sequence[_Heads],
    places: Places,
) -> Iterator[Table]:
    """How much is right in each phase, if something is asked in several."""
    main = main_measure(measures)
    if main is None:
        return
    phases = phases_of(theories, main)
    if len(phases) < 2:
        return
    heads = {name: of for it in varied for name, of in it.items()}
    keys = _keys(_parts(theories, heads))
    title = f"{main.name.capitalize()}, phase by phase"
    if len(phases) * len(keys) > _ROWS:
        phases = phases[-1:]
        title = f"{main.name.capitalize()} in {phases[-1]}"
    rows = []
    for phase in phases:
        parts = _parts(restrict_to_phase(theories, main, phase), heads)
        found = _estimates(parts, main, keys)
        rows += [(phase, key, found) for key in keys]
    yield _estimate_table(title, ("phase", *heads), list(theories), rows, places)


# --- figures -------------------------------------------------------------------------


def last_phase_figures(
    theories: Theories, main: Measure, places: Places
) -> Iterator[Figure]:
    """How much is right in the last phase with questions, by tutor and by scene."""
    phases = phases_of(theories, main)
    last = restrict_to_phase(theories, main, phases[-1])
    where = f" in {phases[-1]}" if len(phases) > 1 else ""
    for heads in _varied_conditions(places):
        title = f"{main.name.capitalize()}{where}, {_by_heads(heads)}"
        yield from _condition_figures(
            title, _estimates(_parts(last, heads), main), main.name
        )


_Estimates: TypeAlias = Mapping[str, Mapping[_Key, Estimate]]


def _estimates(
    parts: _Parts, measure: Measure, keys: Sequence[_Key] | None = None
) -> _Estimates:
    keys = _keys(parts) if keys is None else keys
    return {
        name: {key: estimate_measure(measure, of.get(key, ())) for key in keys}
        for name, of in parts.items()
    }


def _condition_figures(title: str, found: _Estimates, xlabel: str) -> Iterator[Figure]:
    keys = list(dict.fromkeys(key for of in found.values() for key in of))
    if not 1 < len(keys) <= _DRAWN:
        return
    called = shorten_names(part for key in keys for part in key)
    labels = [", ".join(called[part] for part in key) for key in keys]
    series = {name: [of[key] for key in keys] for name, of in found.items()}
    yield from row_figures(title, labels, series, {"xlabel": xlabel})


def _agreement_figures(
    by: str, parts: _Parts, measures: Sequence[Measure]
) -> Iterator[Figure]:
    """Kappa of robots and tutors, beside that of tutors and another judge.

    The latter is the same for every theory, and a ceiling; it is drawn as long as there
    is a hue left for it.
    """
    named = {it.name: it for it in measures}
    if _ROBOT not in named:
        return
    found = dict(_estimates(parts, named[_ROBOT]))
    if _PEOPLE in named and len(found) < len(HUES):
        people = list(_estimates(parts, named[_PEOPLE]).values())
        if all(repr(it) == repr(people[0]) for it in people):
            found["tutor and judge: the ceiling"] = people[0]
    yield from _condition_figures(f"{_ROBOT} {by}", found, "κ")
