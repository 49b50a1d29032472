"""The evidence that a classifier keeps: what was learned under which key."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any, TypeAlias

from ttr.errors import TTRError
from ttr.persistent_maps import Map
from ttr.semantics.learning.features import Features

Key: TypeAlias = int | str
"""The name of an observation, by which it can be taken back."""


class KeyTakenError(TTRError, ValueError):
    """A key under which something was already learned."""


class NoSuchKeyError(TTRError, KeyError):
    """A key under which nothing was learned."""


_EMPTY: Map[Any, Any] = Map()


@dataclass(frozen=True)
class Evidence:
    """Examples (features and label) by key, and how often each was learned.

    Equal where the same was learned under the same keys, in whatever order.
    """

    held: Map[Key, tuple[Features, str]] = _EMPTY
    times: Map[tuple[Features, str], int] = _EMPTY

    def learned(self, seen: Features, label: str, key: Key) -> Evidence:
        """The evidence with one more observation.

        Raises `KeyTakenError`, and `TTRError` for a label that is no word.
        """
        if not isinstance(label, str) or not label:
            raise TTRError(f"a label is a word, found {label!r}")
        if not isinstance(key, int | str):
            raise TTRError(f"a key is a number or a text, found {key!r}")
        if key in self.held:
            raise KeyTakenError(
                f"the key {key!r} is taken, by a lesson of {self.held[key][1]!r}",
                hint="take that back first, or use another key",
            )
        example = seen, label
        again = self.times.get(example, 0) + 1
        return Evidence(self.held.set(key, example), self.times.set(example, again))

    def retracted(self, key: Key) -> Evidence:
        """The evidence without the observation of a key; raises `NoSuchKeyError`."""
        if not isinstance(key, int | str) or key not in self.held:
            raise NoSuchKeyError(f"nothing was learned under the key {key!r}")
        example = self.held[key]
        left = self.times[example] - 1
        times = self.times.set(example, left) if left else self.times.delete(example)
        return Evidence(self.held.delete(key), times)

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        return tuple(sorted({label for _, label in self.times}))

    def __str__(self) -> str:
        """The number of lessons, and of those for each label.

        >>> print(Evidence().learned((True,), "cup", 1).learned((False,), "cup", 2))
        2 lessons: 2 cup
        """
        counts = Counter[str]()
        for (_, label), n in self.times.items():
            counts[label] += n
        shown = ", ".join(f"{counts[label]} {label}" for label in self.labels)
        return f"{len(self.held)} lessons" + f": {shown}" * bool(shown)

    def rows(self) -> list[tuple[Features, str, int]]:
        """The examples and how often each was learned, in sorted order."""
        return sorted((seen, label, n) for (seen, label), n in self.times.items())


NO_EVIDENCE = Evidence()
"""The evidence before any learning."""
