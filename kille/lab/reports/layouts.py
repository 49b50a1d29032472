"""Theories side by side, as the matrices of papers, with their differences marked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import cycle
from typing import NamedTuple

from kille.lab.reports.elements import (
    NOTHING,
    Markup,
    description_list,
    element,
    fold,
    join,
    scrolling_table,
)
from kille.lab.reports.figure_styles import HUES
from ttr import Record
from ttr.display.differences import mark_differences, omit_common_fields
from ttr.display.html import part_of_page
from ttr.display.layout import Layout, layout_of
from ttr.types import TypeNode

Described = Mapping[str, object]
"""A theory by the names of its parts: types and records, texts, and texts by name."""


def side_by_side(theories: Mapping[str, Described]) -> Iterator[Markup]:
    """The theories as a piece of a page, part by part; last what is the same in all.

    Theories that are alike in a part share a place there.
    """
    parts = dict.fromkeys(part for it in theories.values() for part in it)
    hues = dict(zip(theories, cycle(HUES), strict=False))
    same: dict[str, object] = {}
    for part in parts:
        groups = _groups({name: it.get(part) for name, it in theories.items()})
        if len(groups) == 1:
            same[part] = groups[0].value
            continue
        yield element("h3", part)
        yield from _group_elements(groups, hues)
    yield from _common_parts({part: it for part, it in same.items() if it}, theories)


class _Group(NamedTuple):
    """Theories that have the same value."""

    names: Sequence[str]
    value: object


def _groups(values: Mapping[str, object]) -> list[_Group]:
    """The values that differ, each with the names of those that have it."""
    groups: list[_Group] = []
    for name, value in values.items():
        place = next((i for i, it in enumerate(groups) if _same(value, it.value)), None)
        if place is None:
            groups.append(_Group([name], value))
        else:
            groups[place] = _Group([*groups[place].names, name], value)
    return groups


def _group_elements(
    groups: Sequence[_Group], hues: Mapping[str, str]
) -> Iterator[Markup]:
    values = [it.value for it in groups]
    if all(map(_has_entries, values)):
        yield from _entry_table(groups, hues)
    elif all(isinstance(it, str) for it in values):
        yield description_list(
            (_group_name(it.names, hues), _value(it.value)) for it in groups if it.value
        )
    else:
        yield from _matrices(groups, hues)


def _common_parts(
    parts: Mapping[str, object], theories: Mapping[str, Described]
) -> Iterator[Markup]:
    """The parts that are the same in all theories, folded except for `about`."""
    about = parts.get("about")
    if about:
        yield element("p", str(about))
    others = {part: it for part, it in parts.items() if part != "about"}
    if others:
        head = "the same in all: " if len(theories) > 1 else ""
        inside = (fold(part, _value(it)) for part, it in others.items())
        yield fold(f"{head}{', '.join(others)}", *inside)


# --- matrices ------------------------------------------------------------------------


def _matrices(groups: Sequence[_Group], hues: Mapping[str, str]) -> Iterator[Markup]:
    layouts = [_layout(it.value) for it in groups]
    short, whole = [], []
    for place, (group, layout) in enumerate(zip(groups, layouts, strict=True)):
        if layout is None:
            short.append(_value(group.value))
            whole.append(short[-1])
            continue
        marked = mark_differences(layout, _others(layouts, place))
        short.append(_drawing(omit_common_fields(marked)))
        whole.append(_drawing(marked))
    names = [_group_name(it.names, hues) for it in groups]
    styles = [f"--hue: {hues[it.names[0]]}" for it in groups]

    def columns(drawings: Sequence[Markup]) -> Markup:
        cards = (
            element("div", element("h4", name), drawing, style=style)
            for name, drawing, style in zip(names, drawings, styles, strict=True)
        )
        return element("div", *cards, class_="theories")

    yield columns(short)
    if short != whole:
        yield fold("with all fields", columns(whole))


def _others(layouts: Sequence[Layout | None], place: int) -> list[Layout]:
    return [it for i, it in enumerate(layouts) if i != place and it]


def _same(one: object, other: object) -> bool:
    """Are two parts the same? Of types and records, do they look the same?"""
    return one == other or (_layout(one) is not None and _layout(one) == _layout(other))


def _layout(value: object) -> Layout | None:
    return layout_of(value) if isinstance(value, TypeNode | Record) else None


def _drawing(layout: Layout) -> Markup:
    return Markup(part_of_page(layout))


def _value(value: object) -> Markup:
    layout = _layout(value)
    if layout is not None:
        return _drawing(layout)
    if isinstance(value, Mapping):
        return _entry_list(value)
    return element("div", _text(str(value))) if value else element("p", "–")


def _group_name(names: Sequence[str], hues: Mapping[str, str]) -> Markup:
    """The names of theories, each with its hue where there are several."""
    if len(names) == 1:
        return join(names)
    return join(
        element("span", name, class_="of", style=f"--hue: {hues[name]}")
        for name in names
    )


# --- texts by name -------------------------------------------------------------------


def _has_entries(value: object) -> bool:
    return value is None or (
        isinstance(value, Mapping) and not isinstance(value, Record)
    )


def _entry_table(groups: Sequence[_Group], hues: Mapping[str, str]) -> Iterator[Markup]:
    """First the entries that differ, one a row; then the names of all others."""
    lists = [dict(it.value) if isinstance(it.value, Mapping) else {} for it in groups]
    entries = {name: [it.get(name) for it in lists] for it in lists for name in it}
    differing = {name: of for name, of in entries.items() if len(set(map(str, of))) > 1}
    if differing:
        heads = [NOTHING, *(_group_name(it.names, hues) for it in groups)]
        yield scrolling_table(
            (element("th", head) for head in heads),
            (
                [element("td", element("code", name)), *_entry_cells(of)]
                for name, of in differing.items()
            ),
        )
    same = {name: of[0] for name, of in entries.items() if name not in differing}
    if same:
        yield fold(f"{len(same)} the same in all", _entry_list(same))


def _entry_cells(entries: Sequence[object]) -> Iterator[Markup]:
    """An entry of each, types as matrices in which what differs is marked."""
    layouts = [_layout(it) for it in entries]
    for place, (entry, layout) in enumerate(zip(entries, layouts, strict=True)):
        if layout is not None:
            marked = mark_differences(layout, _others(layouts, place))
            yield element("td", _drawing(marked), class_="type")
        else:
            text = "–" if entry is None else _text(str(entry))
            yield element("td", text, class_="apart")


def _entry_list(texts: Mapping[str, object]) -> Markup:
    return description_list(
        (element("code", name), _text(str(text))) for name, text in texts.items()
    )


def _text(text: str) -> Markup:
    """A text; one of several lines is code."""
    return element("pre", text) if "\n" in text else join([text])
