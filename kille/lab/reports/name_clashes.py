"""What is called the same in two studies, and is not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from kille.lab.study import Named, Study

_ALSO = "differences may come of that as well."


def unlike(one: Study, other: Study) -> Iterator[str]:
    """The tutors and scenes that only their names have in common; then the phases.

    Dialogues with them are pairs by their names, and differ not by the theories alone.
    """
    for what, ours, theirs in (
        ("tutor", one.tutors, other.tutors),
        ("scene", one.scenes, other.scenes),
    ):
        for name, it in ours.items():
            keys = ", ".join(_keys(it, theirs.get(name, it)))
            if keys:
                yield f"The {what} {name} is not the same in both ({keys}): {_ALSO}"
    if one.phases != other.phases:
        yield f"The phases are not the same in both: {_ALSO}"


def _keys(one: Named, other: Named) -> list[str]:
    """The settings in which two differ."""
    ours, theirs = _settings(one), _settings(other)
    return [
        key
        for key in dict.fromkeys([*ours, *theirs])
        if key not in ours or key not in theirs or ours[key] != theirs[key]
    ]


def _settings(it: Named) -> Mapping[str, Any]:
    return {"kind": it.kind, **it.settings}
