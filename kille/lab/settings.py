"""Settings: what may be set of a tutor, a scene or a phase, and what is unfit."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from ttr.misspellings import nearest_names

Key = tuple[str | int, ...]
"""The names that lead to a value, and the numbers of the tables in a list."""


class Problem(NamedTuple):
    """What is wrong with a study, or probably not meant.

    `key` leads to the value that is to be changed; `at` is where the mistake is, if it
    is in another file.
    """

    key: Key
    what: str
    at: str = ""

    def within(self, *outer: str | int) -> Problem:
        """The same problem, of a value that is inside of another one.

        >>> Problem(("kind",), "there is no such kind").within("tutors", "ann").key
        ('tutors', 'ann', 'kind')
        """
        return self._replace(key=(*outer, *self.key))


_SORTS: Mapping[type, str] = {
    str: "a text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    dict: "a table",
    list: "a list",
}

_MOST = 12
"""How many names are told where none of them is near."""


@dataclass(frozen=True)
class Setting:
    """A setting: the types of its values, and its default.

    A text is one `among` some, if any are named, and a number from `least` to `most`,
    in a `unit` if it has one. With `several` it is a list of such values, in which none
    is there `twice` unless that says something. What is `needed` has no default, and is
    not empty.

    >>> frame = Setting((str, float), "viewer", among=("viewer", "landmark"), most=1.0)
    >>> frame.problem_with(2)
    'expected viewer, landmark or a number from 0 to 1, found 2'
    >>> Setting(float, 0.0).problem_with(1)
    ''
    """

    types: type | tuple[type, ...] = str
    default: Any = None
    among: tuple[str, ...] = ()
    least: float = 0.0
    most: float = math.inf
    several: bool = False
    twice: bool = False
    needed: bool = False
    unit: str = ""
    about: str = ""

    def problem_with(self, value: object) -> str:
        """Why a value does not fit, without a full stop; empty if it fits."""
        if self.several:
            return self._problem_with_list(value)
        is_blank = self.needed and isinstance(value, str) and not value.strip()
        return self._expectation(value) if is_blank or not self._fits(value) else ""

    def _problem_with_list(self, value: object) -> str:
        if not isinstance(value, list | tuple):
            each, found = self._wanted_values(), show_value(value)
            return f"expected a list, each {each}, found {found}"
        for one in value:
            if not self._fits(one):
                return self._expectation(one)
        if self.needed and not value:
            return "expected one at least, found an empty list"
        if self.twice:
            return ""
        again = (it for it, count in Counter(value).items() if count > 1)
        return next((f"{show_value(it)} is there twice" for it in again), "")

    def _fits(self, value: object) -> bool:
        types = self.types if isinstance(self.types, tuple) else (self.types,)
        match value:
            case bool():
                return bool in types
            case int() | float():
                whole = isinstance(value, int) and int in types
                fits = self.least <= value <= self.most and abs(value) < math.inf
                return fits and (whole or float in types)
            case str():
                return str in types and (not self.among or value in self.among)
        return isinstance(value, types)

    def _expectation(self, value: object) -> str:
        hint = ""
        if isinstance(value, str) and self.among:
            hint = nearest_name(value, self.among, " (did you mean {}?)")
        return f"expected {self._wanted_values()}, found {show_value(value)}{hint}"

    def _wanted_values(self) -> str:
        types = self.types if isinstance(self.types, tuple) else (self.types,)
        wanted: list[str] = []
        for one in types:
            if one is str and self.among:
                wanted += (name or '""' for name in self.among)
            elif one in (int, float):
                of = f" of {self.unit}" if self.unit else ""
                wanted.append(f"{_SORTS[one]}{of}{self._bounds()}")
            else:
                wanted.append(_SORTS.get(one, one.__name__))
        return " or ".join(filter(None, (", ".join(wanted[:-1]), wanted[-1])))

    def _bounds(self) -> str:
        if math.isinf(self.most):
            return (
                ""
                if math.isinf(self.least)
                else f" from {_format_plain(self.least)} on"
            )
        return f" from {_format_plain(self.least)} to {_format_plain(self.most)}"


Settings = Mapping[str, Setting]
"""What may be set, by the names of the settings."""


def fill_settings(given: Mapping[str, Any], declared: Settings) -> dict[str, Any]:
    """All settings: those given, and the defaults of the others.

    >>> declared = {"errors": Setting(float, 0.0), "n": Setting(int, 9)}
    >>> fill_settings({"errors": 0.1}, declared)
    {'errors': 0.1, 'n': 9}
    """
    return {key: given.get(key, one.default) for key, one in declared.items()}


def setting_problems(
    given: Mapping[str, object], declared: Settings, what: str
) -> Iterator[Problem]:
    """What is wrong with settings; what is missing has no key.

    >>> declared = {"errors": Setting(float, 0.0)}
    >>> [it] = setting_problems({"erors": 0.1}, declared, "a tutor")
    >>> it.key, it.what
    (('erors',), 'a tutor has no erors: did you mean errors?')
    """
    meant = set(given)
    for key, value in given.items():
        if key not in declared:
            meant.add(nearest_name(key, declared, "{}"))
            told = f"{what} has no {key}: {suggest_name(key, declared)}"
            yield Problem((key,), told)
        elif why := declared[key].problem_with(value):
            yield Problem((key,), f"{key} of {what}: {why}")
    for key, one in declared.items():
        if one.needed and key not in meant:
            told = f"{what} needs {key}: {one.about or f'write {key} = …'}"
            yield Problem((), told)


def nearest_name(name: str, known: Collection[str], told: str) -> str:
    """Format the known name that is most like this one; empty if none is like it.

    >>> nearest_name("NUONS", ["nouns", "relations"], "did you mean {}?")
    'did you mean nouns?'
    """
    found = nearest_names(name, known)
    return told.format(found[0]) if found else ""


def suggest_name(name: str, known: Collection[str]) -> str:
    """A hint for an unknown name: the nearest known one, or all of them."""
    if found := nearest_name(name, known, "did you mean {}?"):
        return found
    listed = ", ".join([*known][:_MOST]) + ", …" * (len(known) > _MOST)
    return f"there is {listed}" if known else "there is none"


def why_no_file(path: Path) -> str:
    """Why a path is not a file; empty if it is one."""
    if os.path.isfile(path):
        return ""
    if os.path.isdir(path):
        return f"{path} is a folder, not a file"
    return _no_such_path("file", path, [it for it in _siblings(path) if it.is_file()])


def why_no_folder(path: Path) -> str:
    """Why a path is not a folder; empty if it is one."""
    if os.path.isdir(path):
        return ""
    if os.path.exists(path):
        return f"{path} is a file, not a folder"
    return _no_such_path("folder", path, [it for it in _siblings(path) if it.is_dir()])


def _no_such_path(kind: str, path: Path, others: Sequence[Path]) -> str:
    """The message that there is no such path, with the nearest that exists."""
    names = [it.name for it in others if it.suffix == path.suffix]
    hint = f": {suggest_name(path.name, names)}" if names else ""
    return f"there is no {kind} {path}{hint}"


def _siblings(path: Path) -> Sequence[Path]:
    try:
        return sorted(it for it in path.parent.iterdir() if it.name[:1] != ".")
    except (OSError, ValueError):  # no text with a zero in it is a path
        return ()


def show_value(value: object) -> str:
    """A value in short, as it would be written in TOML.

    >>> show_value(True), show_value("cup"), show_value([1, 2])
    ('true', '"cup"', 'a list')
    """
    match value:
        case bool():
            return str(value).lower()
        case str():
            return f'"{value}"' if len(value) <= 40 else f'"{value[:40]}…"'
        case list() | tuple():
            return "a list"
        case dict():
            return "a table"
    return str(value)


def _format_plain(number: float) -> str:
    return str(int(number)) if float(number).is_integer() else f"{number:g}"
