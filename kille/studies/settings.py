"""Settings: what may be set of a tutor, a scene or a phase, and what is unfit."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

__all__ = ["Setting", "Settings", "filled", "near", "unfit", "unknown"]

_SORTS: Mapping[type, str] = {
    str: "a text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    dict: "a table",
}

_MOST = 12
"""How many names are told where none of them is near."""


@dataclass(frozen=True)
class Setting:
    """A setting: of which types its values are, and what it is where it is not set.

    A text is one `among` some, if any are named, and a number from `least` to `most`.
    With `several` it is a list of such values. What is `needed` has no default.

    >>> Setting((str, float), "viewer", among=("viewer", "landmark"), most=1.0).unfit(2)
    'expected viewer, landmark or a number from 0 to 1, found 2'
    >>> Setting(float, 0.0).unfit(1)
    ''
    """

    types: type | tuple[type, ...] = str
    default: Any = None
    among: tuple[str, ...] = ()
    least: float = 0.0
    most: float = math.inf
    several: bool = False
    needed: bool = False
    about: str = ""

    def unfit(self, value: object) -> str:
        """Why a value is none for it, as a sentence without an end; else nothing."""
        if not self.several:
            return "" if self._fits(value) else self._expected(value)
        if not isinstance(value, list | tuple):
            return f"expected a list, each {self._wanted()}, found {_shown(value)}"
        wrong = (self._expected(one) for one in value if not self._fits(one))
        return next(wrong, "")

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

    def _expected(self, value: object) -> str:
        hint = ""
        if isinstance(value, str) and self.among:
            hint = near(value, self.among, " (did you mean {}?)")
        return f"expected {self._wanted()}, found {_shown(value)}{hint}"

    def _wanted(self) -> str:
        types = self.types if isinstance(self.types, tuple) else (self.types,)
        wanted: list[str] = []
        for one in types:
            if one is str and self.among:
                wanted += self.among
            elif one in (int, float):
                wanted.append(f"{_SORTS[one]}{self._bounds()}")
            else:
                wanted.append(_SORTS.get(one, one.__name__))
        return " or ".join(filter(None, (", ".join(wanted[:-1]), wanted[-1])))

    def _bounds(self) -> str:
        if math.isinf(self.most):
            return "" if math.isinf(self.least) else f" from {self.least:g} on"
        return f" from {self.least:g} to {self.most:g}"


Settings = Mapping[str, Setting]
"""What may be set, by the names of the settings."""


def filled(given: Mapping[str, Any], declared: Settings) -> dict[str, Any]:
    """All settings: those given, and the defaults of the others.

    >>> filled({"errors": 0.1}, {"errors": Setting(float, 0.0), "n": Setting(int, 9)})
    {'errors': 0.1, 'n': 9}
    """
    return {key: given.get(key, one.default) for key, one in declared.items()}


def unfit(
    given: Mapping[str, object], declared: Settings, what: str
) -> Iterator[tuple[str, str]]:
    """What is wrong with settings: the key, or nothing where one is missing, and why.

    >>> list(unfit({"erors": 0.1}, {"errors": Setting(float, 0.0)}, "a tutor"))
    [('erors', 'a tutor has no erors: did you mean errors?')]
    """
    meant = set(given)
    for key, value in given.items():
        if key not in declared:
            meant.add(near(key, declared, "{}"))
            yield key, f"{what} has no {key}: {unknown(key, declared)}"
        elif why := declared[key].unfit(value):
            yield key, f"{key} of {what}: {why}"
    for key, one in declared.items():
        if one.needed and key not in meant:
            yield "", f"{what} needs {key}: {one.about or 'write ' + key + ' = …'}"


def near(name: str, known: Collection[str], told: str) -> str:
    """The known name that is most like this one, told so; nothing if none is."""
    found = get_close_matches(name, list(known), n=1)
    return told.format(found[0]) if found else ""


def unknown(name: str, known: Collection[str]) -> str:
    """A way out for a name that nothing has: the nearest known one, or all of them."""
    if found := near(name, known, "did you mean {}?"):
        return found
    shown = ", ".join([*known][:_MOST]) + ", …" * (len(known) > _MOST)
    return f"there is {shown}" if known else "there is none"


def _shown(value: object) -> str:
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
