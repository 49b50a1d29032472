"""Configurations as text: JSON with their fields by name.

What a later version adds to them is passed over by this one, and what this one adds is
unknown where an older one wrote.
"""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from typing import Any

from kille.scene import Configuration, Direction

FIELDS = frozenset(it.name for it in fields(Configuration))
DIRECTIONS = frozenset({"offset", "viewed"})


def as_json(it: Configuration) -> dict[str, Any]:
    """The known fields of a configuration, by name.

    >>> as_json(Configuration((0.1, 0.0, 0.2), contact=1.0))
    {'offset': (0.1, 0.0, 0.2), 'contact': 1.0}
    """
    return {name: x for name, x in asdict(it).items() if x is not None and x != ()}


def from_json(known: dict[str, Any]) -> Configuration:
    """A configuration from its known fields; other fields are ignored.

    Raises ValueError for what is no configuration.

    >>> from_json({"offset": [0.1, 0.0, 0.2], "weather": "fine"}).offset
    (0.1, 0.0, 0.2)
    """
    told = {name: x for name, x in known.items() if name in FIELDS and x is not None}
    if "offset" not in told:
        raise ValueError("a configuration needs an offset")
    return Configuration(**{name: _field(name, x) for name, x in told.items()})


def to_text(it: Configuration) -> str:
    """Write the configuration as one line, with every number exact."""
    return json.dumps(as_json(it), allow_nan=False)


def from_text(text: str) -> Configuration:
    """Read a configuration written by `to_text`."""
    return from_json(json.loads(text))


def _field(name: str, value: Any) -> Any:
    if name == "others":
        return tuple(_direction(name, it) for it in _require_list(name, value))
    if name in DIRECTIONS:
        return _direction(name, value)
    return _number(name, value)


def _direction(name: str, value: Any) -> Direction:
    right, away, up = (_number(name, it) for it in _require_list(name, value))
    return right, away, up


def _require_list(name: str, value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise ValueError(f"{name} is no list")
    return value


def _number(name: str, value: Any) -> float:
    if not isinstance(value, float | int) or isinstance(value, bool):
        raise ValueError(f"{name} needs numbers, not {value!r}")
    return value
