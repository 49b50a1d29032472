"""What stands in a study, and what is wrong with how one is written."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from kille.dialogue.language import LANGUAGES
from kille.dialogue.meanings import KINDS
from kille.dialogue.strategies import MODES, WORDINGS
from kille.lab import scenes, tutors
from kille.lab.protocols import phases
from kille.lab.settings import (
    Problem,
    Setting,
    Settings,
    nearest_name,
    setting_problems,
    show_value,
    suggest_name,
)
from kille.lab.study import MAIN_MEASURES, PERSON

MOST_SEEDS = 100_000
"""Dialogues of one theory, tutor and scene; the power of any test is 1 long before."""

STUDY: Settings = {
    "title": Setting(needed=True, about='write title = "…"'),
    "about": Setting(),
    "turns": Setting(int, 1000, least=1, most=1_000_000),
    "main": Setting(default="accuracy", among=tuple(MAIN_MEASURES)),
    "contrasts": Setting(list, (), several=True, twice=True),
    "seeds": Setting(
        int,
        (),
        most=2**32 - 1,
        several=True,
        needed=True,
        about="write seeds = 20, or a list of numbers",
    ),
    "theories": Setting(dict, needed=True, about="write [theories.NAME]"),
    "tutors": Setting(dict, needed=True, about="write [tutors.NAME]"),
    "scenes": Setting(dict, needed=True, about="write [scenes.NAME]"),
    "phases": Setting(
        dict,
        (),
        several=True,
        twice=True,
        needed=True,
        about='write [[phases]] and do = "…"',
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

LEARNERS: Settings = {kind: Setting() for kind in KINDS}


def shape_problems(data: Mapping[str, Any]) -> Iterator[Problem]:
    """What is wrong with how a study is written."""
    shape = dict(data)
    if not isinstance(shape.get("seeds", []), list):
        shape["seeds"] = (
            [min(shape["seeds"], 1)] if _is_count(data) else [data["seeds"]]
        )
    for it in setting_problems(shape, STUDY, "a study"):
        key = str(it.key[0]) if it.key else ""
        is_needed = key in STUDY and STUDY[key].needed
        hint = f": {STUDY[key].about}" if is_needed else ""
        yield it._replace(what=f"{it.what}{hint}")
    if _is_count(data):
        yield from _count_problems(data["seeds"])
    for what in _contrast_problems(data):
        yield Problem(("contrasts",), what)
    yield from _table_problems(data, "theories", _theory_problems)
    kinds = (
        ("tutors", "kind of tutor", tutors.SETTINGS),
        ("scenes", "kind of scene", scenes.SETTINGS),
    )
    for table, what, known in kinds:
        yield from _table_problems(data, table, _check_kind("kind", what, known))
    phases = data.get("phases")
    for number, phase in enumerate(phases if isinstance(phases, list) else []):
        if isinstance(phase, dict):
            for it in _phase_problems(f"phase {number + 1}", phase):
                yield it.within("phases", number)


def _is_count(data: Mapping[str, Any]) -> bool:
    """Whether the number of seeds is given, and not a list."""
    seeds = data.get("seeds")
    return isinstance(seeds, int) and not isinstance(seeds, bool)


def _count_problems(seeds: int) -> Iterator[Problem]:
    if seeds == 0:
        told = "there is no seed, so nothing to play: write seeds = 20"
        yield Problem(("seeds",), told)
    elif seeds > MOST_SEEDS:
        told = f"so many as {seeds} are more than anybody plays: write {MOST_SEEDS}"
        yield Problem(("seeds",), f"{told} at most, or a list of seeds")


def _contrast_problems(data: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with the contrasts of theories."""
    theories, contrasts = data.get("theories"), data.get("contrasts")
    known = [*theories] if isinstance(theories, dict) else []
    lists = contrasts if isinstance(contrasts, list) else []
    for one in (it for it in lists if isinstance(it, list)):
        if len(one) != 2 or not all(isinstance(it, str) for it in one):
            yield 'a contrast is of two theories: write contrasts = [["one", "other"]]'
        elif one[0] == one[1]:
            yield f"a contrast is of two theories, found {show_value(one[0])} twice"
        elif lists.count(one) + lists.count(one[::-1]) > 1:
            both = " and ".join(map(show_value, one))
            yield f"the contrast of {both} is there twice"
        for name in one:
            if isinstance(name, str) and known and name not in known:
                yield (
                    f"contrasts: there is no theory {show_value(name)}: "
                    + suggest_name(name, known)
                )


Check = Callable[[str, Mapping[str, Any]], Iterator[Problem]]
"""What is wrong with something of this name, as it is written."""


def _table_problems(
    data: Mapping[str, Any], table: str, check: Check
) -> Iterator[Problem]:
    """What is wrong with each thing of a table of named things."""
    named = data.get(table)
    if not isinstance(named, dict):
        return
    if not named:
        yield Problem((table,), f"there is nothing in {table}: write [{table}.NAME]")
    for name, one in named.items():
        if not re.fullmatch(r"[^/\s]([^/]*[^/\s])?", name) or not name.isprintable():
            told = f"{name!r} is no name: expected a word without a slash"
            yield Problem((table, name), told)
        if not isinstance(one, dict):
            told = f"{name} of {table} is a table: write [{table}.{name}]"
            yield Problem((table, name), told)
            continue
        for it in check(name, one):
            yield it.within(table, name)


def _theory_problems(name: str, given: Mapping[str, Any]) -> Iterator[Problem]:
    yield from setting_problems(given, THEORY, f"the theory {name}")
    types = given.get("meanings")
    for key, value in types.items() if isinstance(types, dict) else ():
        if not isinstance(value, str):
            told = (
                f'a type is written as a text, {key} = "[…]", found {show_value(value)}'
            )
            yield Problem(("meanings", key), told)
    learners = given.get("learners")
    if isinstance(learners, dict):
        for it in setting_problems(learners, LEARNERS, f"learners of {name}"):
            yield it.within("learners")


def _phase_problems(name: str, given: Mapping[str, Any]) -> Iterator[Problem]:
    called = given.get("name", "")
    if why := Setting().problem_with(called):
        yield Problem(("name",), f"name of {name}: {why}")
    elif not called.isprintable():
        told = f"name of {name}: expected one line, found {called!r}"
        yield Problem(("name",), told)
    yield from _check_kind("do", "phase to do", phases.SETTINGS)(name, given)


def _check_kind(key_of_kind: str, what: str, known: Mapping[str, Settings]) -> Check:
    """A check of something whose kind says which settings it has."""

    def check(name: str, given: Mapping[str, Any]) -> Iterator[Problem]:
        kind = given.get(key_of_kind)
        if kind is None:
            slip = nearest_name(key_of_kind, [*given], "{}")
            found = f", and has {slip}" if slip else ""
            told = f"{name} needs {key_of_kind}{found}: {_one_of(known)}"
            yield Problem((slip,) if slip else (), told)
            return
        if not isinstance(kind, str) or kind not in known:
            meant = nearest_name(str(kind), known, "did you mean {}? ")
            told = f"{name}: there is no {what} {show_value(kind)}: "
            told += f"{meant}{_one_of(known)}"
            yield Problem((key_of_kind,), told)
            return
        own = {key: it for key, it in given.items() if key not in APART[key_of_kind]}
        named = f'{name} ({key_of_kind} = "{kind}")'
        yield from setting_problems(own, known[kind], named)

    return check


APART = {"kind": ("kind",), "do": ("do", "name")}
"""What is not among the settings, by what names the kind."""


def _one_of(known: Mapping[str, Settings]) -> str:
    return f"it is one of {', '.join(known)}"
