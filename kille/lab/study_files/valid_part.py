"""What is left of a study in which something is written wrongly, to be tried too."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from kille.lab.study_files.lines import Key
from kille.lab.study_files.shape import STUDY

UNKNOWN = "unknown"
"""The kind, or mode, of what is written wrongly, of which nothing else is told."""

STAND_INS: Mapping[str, Mapping[str, str]] = {
    "theories": {"mode": UNKNOWN},
    "tutors": {"kind": UNKNOWN},
    "scenes": {"kind": UNKNOWN},
    "phases": {"do": "rest"},
}
"""What takes the place of what is written wrongly, but named or counted by others."""

PLAIN: Mapping[str, Any] = {
    "title": "",
    "about": "",
    "turns": STUDY["turns"].most,
    "seeds": 1,
}
"""What takes the place of wrong values; so many turns that all phases are reached."""


def sound(data: Mapping[str, Any], wrong: Collection[Key]) -> Mapping[str, Any]:
    """A study without what is written wrongly, so that the rest of it can be tried."""
    left = {key: _sound(data, key, wrong) for key in ("theories", "tutors", "scenes")}
    phases = data.get("phases")
    named = [
        STAND_INS["phases"]
        if not isinstance(one, dict) or _is_wrong(("phases", number), wrong)
        else one
        for number, one in enumerate(phases if isinstance(phases, list) else ())
    ]
    plain = {
        key: stand_in if (key,) in wrong else data[key]
        for key, stand_in in PLAIN.items()
        if key in data
    }
    return {"title": "", "seeds": 1, **plain, **left, "phases": named}


def _sound(
    data: Mapping[str, Any], table: str, wrong: Collection[Key]
) -> Mapping[str, Any]:
    """What is left of a table of named things."""
    given = data.get(table)
    found: dict[str, Any] = {}
    for name, one in given.items() if isinstance(given, dict) else ():
        is_wrong = _is_wrong((table, name), wrong)
        found[name] = STAND_INS[table] if is_wrong else one
    return found


def _is_wrong(key: Key, wrong: Collection[Key]) -> bool:
    """Whether something is wrong with what has this key, or in it."""
    return any(it[: len(key)] == key for it in wrong)
