"""What stands in a study, and what is wrong with how one is written."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from kille.dialogue.language import LANGUAGES
from kille.dialogue.meanings import KINDS
from kille.dialogue.strategies import MODES, WORDINGS
from kille.studies import protocols, scenes, tutors
from kille.studies.reading.lines import Key
from kille.studies.reading.troubles import Trouble
from kille.studies.settings import Setting, Settings, unfit, unknown
from kille.studies.study import PERSON

__all__ = ["APART", "STUDY", "faults"]

STUDY: Settings = {
    "title": Setting(needed=True, about='write title = "…"'),
    "about": Setting(),
    "turns": Setting(int, 1000, least=1),
    "seeds": Setting(int, (), several=True),
    "theories": Setting(dict, needed=True, about="write [theories.NAME]"),
    "tutors": Setting(dict, needed=True, about="write [tutors.NAME]"),
    "scenes": Setting(dict, needed=True, about="write [scenes.NAME]"),
    "phases": Setting(
        dict, (), several=True, needed=True, about='write [[phases]] and do = "…"'
    ),
}
"""What stands in a study."""

THEORY: Settings = {
    "about": Setting(),
    "language": Setting(among=LANGUAGES),
    "mode": Setting(among=(*MODES, PERSON)),
    "wording": Setting(among=WORDINGS),
    "without": Setting(several=True),
    "rules": Setting(),
    "grammar": Setting(),
    "meanings": Setting((str, dict)),
    "strategy": Setting(dict),
    "learners": Setting(dict),
}
"""What stands in a theory."""

MOST_SEEDS = 100_000
"""Dialogues of one theory, tutor and scene; the power of any test is 1 long before."""

LEARNERS: Settings = {kind: Setting() for kind in KINDS}


def faults(data: Mapping[str, Any]) -> Iterator[Trouble]:
    """What is wrong with how a study is written."""
    for key, what in _faults(data):
        yield Trouble(key, what)


def _faults(data: Mapping[str, Any]) -> Iterator[tuple[Key, str]]:
    shape = dict(data)
    if not isinstance(shape.get("seeds", []), list):
        shape["seeds"] = [shape["seeds"]]
    for key, what in unfit(shape, STUDY, "a study"):
        yield (key,) if key else (), what
    yield from _wrong_seeds(data)
    yield from _each(data, "theories", _wrong_theory)
    kinds = (
        ("tutors", "a tutor", tutors.SETTINGS),
        ("scenes", "scenes", scenes.SETTINGS),
    )
    for table, what, known in kinds:
        yield from _each(data, table, _of_kind("kind", what, known))
    phases = data.get("phases")
    for number, phase in enumerate(phases if isinstance(phases, list) else []):
        if isinstance(phase, dict):
            for inner, what in _wrong_phase(f"phase {number + 1}", phase):
                yield ("phases", number, *inner), what


def _wrong_seeds(data: Mapping[str, Any]) -> Iterator[tuple[Key, str]]:
    seeds = data.get("seeds")
    if seeds is None:
        yield (), "a study needs seeds: write seeds = 20, or a list of numbers"
    elif seeds in (0, []):
        yield ("seeds",), "there is no seed, so nothing to play: write seeds = 20"
    elif isinstance(seeds, int) and seeds > MOST_SEEDS:
        told = f"so many as {seeds} are more than anybody plays: write {MOST_SEEDS}"
        yield ("seeds",), f"{told} at most, or a list of seeds"
    elif isinstance(seeds, list) and len({str(it) for it in seeds}) < len(seeds):
        yield ("seeds",), "a seed is there twice: the same dialogue is not played again"


Wrong = Callable[[str, Mapping[str, Any]], Iterator[tuple[Key, str]]]


def _each(
    data: Mapping[str, Any], table: str, wrong: Wrong
) -> Iterator[tuple[Key, str]]:
    """What is wrong with each thing of a table of named things."""
    named = data.get(table)
    if not isinstance(named, dict):
        return
    if not named:
        yield (table,), f"there is nothing in {table}: write [{table}.NAME]"
    for name, one in named.items():
        if not re.fullmatch(r"[^/\s]([^/\n]*[^/\s])?", name):
            yield (table, name), f"{name!r} is no name: expected a word without a slash"
        if not isinstance(one, dict):
            yield (table, name), f"{name} of {table} is a table: write [{table}.{name}]"
            continue
        for key, what in wrong(name, one):
            yield (table, name, *key), what


def _wrong_theory(name: str, given: Mapping[str, Any]) -> Iterator[tuple[Key, str]]:
    for key, what in unfit(given, THEORY, f"the theory {name}"):
        yield (key,), what
    types = given.get("meanings")
    for key, value in types.items() if isinstance(types, dict) else ():
        if not isinstance(value, str):
            told = f'a type is written as a text, {key} = "[…]", found {value}'
            yield ("meanings", key), told
    learners = given.get("learners")
    if isinstance(learners, dict):
        for key, what in unfit(learners, LEARNERS, f"learners of {name}"):
            yield ("learners", key), what


def _wrong_phase(name: str, given: Mapping[str, Any]) -> Iterator[tuple[Key, str]]:
    if why := Setting().unfit(given.get("name", "")):
        yield ("name",), f"name of {name}: {why}"
    yield from _of_kind("do", "a phase", protocols.SETTINGS)(name, given)


def _of_kind(key_of_kind: str, what: str, known: Mapping[str, Settings]) -> Wrong:
    """What is wrong with something whose kind says what may be set of it."""

    def wrong(name: str, given: Mapping[str, Any]) -> Iterator[tuple[Key, str]]:
        kind = given.get(key_of_kind)
        if kind is None:
            yield (), f"{name} needs {key_of_kind}: {_one_of(known)}"
            return
        if not isinstance(kind, str) or kind not in known:
            hint = unknown(str(kind), known)
            yield (key_of_kind,), f"{name}: {what} is of no kind {kind}: {hint}"
            return
        own = {key: it for key, it in given.items() if key not in APART[key_of_kind]}
        named = f'{name} ({key_of_kind} = "{kind}")'
        for key, why in unfit(own, known[kind], named):
            yield (key,) if key else (), why

    return wrong


APART = {"kind": ("kind",), "do": ("do", "name")}
"""What is not among the settings, by what names the kind."""


def _one_of(known: Mapping[str, Settings]) -> str:
    return f"it is one of {', '.join(known)}"
