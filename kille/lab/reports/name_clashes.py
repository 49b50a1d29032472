"""Tutors, scenes and phases that differ between two studies under the same name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from kille.lab.study import Named, Study

_ALSO = "differences may come of that as well."


def differing_names(one: Study, other: Study) -> Iterator[str]:
    """Warn of tutors and scenes with only their names in common; then of phases.

    Their dialogues are pairs by these names, but differ not only by the theories.
    """
    for what, ours, theirs in (
        ("tutor", one.tutors, other.tutors),
        ("scene", one.scenes, other.scenes),
    ):
        for name, it in ours.items():
            keys = ", ".join(_differing_settings(it, theirs.get(name, it)))
            if keys:
                yield f"The {what} {name} is not the same in both ({keys}): {_ALSO}"
    if one.phases != other.phases:
        yield f"The phases are not the same in both: {_ALSO}"


def _differing_settings(one: Named, other: Named) -> list[str]:
    """The settings in which two differ."""
    ours, theirs = _settings(one), _settings(other)
    return [
        key
        for key in dict.fromkeys([*ours, *theirs])
        if key not in ours or key not in theirs or ours[key] != theirs[key]
    ]


def _settings(it: Named) -> Mapping[str, Any]:
    return {"kind": it.kind, **it.settings}
