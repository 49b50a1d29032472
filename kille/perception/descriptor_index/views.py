"""Views: the descriptors of one lesson each, compared as RootSIFT."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import blake2b
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from kille.perception.learners import Key
from kille.scene import Traits

Rows = NDArray[np.float32]
"""Descriptors (n, 128) of length 1, as `rooted` gives them.

>>> import numpy as np
>>> from kille.perception.descriptor_index import Rows, rooted
>>> rows: Rows = rooted(np.full((2, 128), 7, np.uint8))
>>> rows.dtype.name
'float32'
"""
Descriptors = NDArray[np.uint8]
"""Descriptors (n, 128) as SIFT gives them.

>>> import numpy as np
>>> from kille.perception.descriptor_index import Descriptors
>>> none: Descriptors = np.empty((0, 128), np.uint8)
>>> none.shape
(0, 128)
"""

LENGTH = 128
"""Numbers of a descriptor, each a byte."""

_TOGETHER = 250  # views that are read at once
_ROUNDING = 1e-6  # of a squared distance: sums of 128 products of float32 are not exact


@dataclass(frozen=True, eq=False)
class View:
    """One lesson about one thing: its key, the word, its descriptors (n, 128) uint8.

    The traits are those it had as a whole, as far as they were measured.

    >>> shades = np.random.default_rng(1).integers(0, 255, (40, 128))
    >>> view = View(1, "cup", shades.astype(np.uint8))
    >>> view.label, len(view.descriptors)
    ('cup', 40)
    """

    key: Key
    label: str
    descriptors: Descriptors
    traits: Traits = field(default_factory=dict)

    @property
    def size(self) -> int:
        """The number of descriptors."""
        return len(self.descriptors)

    @cached_property
    def lot(self) -> bytes:
        """Its place in an order of chance by the key, the same on every machine."""
        return blake2b(repr(self.key).encode(), digest_size=8).digest()

    def load(self) -> None:
        """Have all of it in the working memory, wherever it was."""


class GoneError(Exception):
    """A view that can no longer be read, since what it was read from was closed."""


class ViewSource(Protocol):
    """From what views are read when they are needed, in any thread.

    Either method raises GoneError once the source is closed.
    """

    def descriptors(self, keys: Sequence[Key]) -> Sequence[Descriptors]:
        """The descriptors of the views of these keys."""
        ...

    def traits(self, keys: Sequence[Key]) -> Sequence[Traits]:
        """The traits of the views of these keys."""
        ...


class LateView(View):
    """A view whose descriptors and traits are read when they are first asked for.

    `size`, the number of descriptors, is known before. ValueError if another number is
    read.

    >>> class Source:
    ...     def descriptors(self, keys):
    ...         print("read", *keys)
    ...         return [np.zeros((40, 128), np.uint8) for key in keys]
    >>> view = LateView(7, "cup", 40, Source())
    >>> view.size, view.label
    (40, 'cup')
    >>> view.descriptors.shape, view.descriptors.shape
    read 7
    ((40, 128), (40, 128))
    """

    def __init__(self, key: Key, label: str, size: int, source: ViewSource) -> None:
        self.__dict__.update(key=key, label=label, _size=size, _source=source)

    @property
    def size(self) -> int:
        """The number of descriptors."""
        size: int = self.__dict__["_size"]
        return size

    def load(self) -> None:
        """Read what was not read yet."""
        for name in ("descriptors", "traits"):
            getattr(self, name)

    def __getattr__(self, name: str) -> Any:
        match name:
            case "descriptors":
                load_descriptors([self])
            case "traits":
                load_traits([self])
            case _:
                raise AttributeError(name)
        return self.__dict__[name]


def load_descriptors(views: Iterable[View]) -> None:
    """Read the descriptors of the views that have not been read yet, together."""
    for source, some in _by_source(views, "descriptors"):
        found = source.descriptors([view.key for view in some])
        for view, rows in zip(some, found, strict=True):
            if len(rows) != view.size:
                raise ValueError(f"{len(rows)} descriptors instead of {view.size}")
            view.__dict__.setdefault("descriptors", rows)


def load_traits(views: Iterable[View]) -> None:
    """Read the traits of the views that have not been read yet, together."""
    for source, some in _by_source(views, "traits"):
        found = source.traits([view.key for view in some])
        for view, traits in zip(some, found, strict=True):
            view.__dict__.setdefault("traits", traits)


def _by_source(
    views: Iterable[View], name: str
) -> Iterable[tuple[ViewSource, list[LateView]]]:
    """The views of which this has not been read, some hundreds of a source at once."""
    missing: dict[ViewSource, list[LateView]] = {}
    for view in views:
        if isinstance(view, LateView) and name not in view.__dict__:
            missing.setdefault(view.__dict__["_source"], []).append(view)
    for source, some in missing.items():
        for start in range(0, len(some), _TOGETHER):
            yield source, some[start : start + _TOGETHER]


def rooted(descriptors: Descriptors) -> Rows:
    """RootSIFT, d -> sqrt(d / sum d): (n, 128) float32 of length 1 from uint8.

    >>> float(np.linalg.norm(rooted(np.full((1, 128), 7, np.uint8))).round(3))
    1.0
    """
    rows = descriptors.astype(np.float32)
    rows /= np.maximum(rows.sum(axis=1, keepdims=True), 1)
    return np.sqrt(rows, out=rows)


def distances(query: Rows, others: Rows) -> Rows:
    """The distances (n, m) between descriptors of length 1.

    >>> rows = rooted(np.eye(2, 128, dtype=np.uint8))
    >>> [round(float(it), 2) for it in distances(rows, rows)[0]]
    [0.0, 1.41]
    """
    products: Rows = query @ others.T
    return apart(products)


def apart(products: Rows) -> Rows:
    """The distances between descriptors of length 1 with these dot products.

    Overwrites the products. The greater the product, the smaller the distance; that of
    equal descriptors is 0, however their product was rounded.
    """
    products *= -2
    products += 2
    products *= products > _ROUNDING
    return np.sqrt(products, out=products)


def stack_descriptors(views: Sequence[View]) -> Descriptors:
    """The descriptors of all views in one array."""
    blocks = [view.descriptors for view in views]
    return np.concatenate([np.empty((0, LENGTH), np.uint8), *blocks])


def count(views: Sequence[View]) -> int:
    """The number of descriptors of all views together."""
    return sum(view.size for view in views)


_THINNEST = 16  # of how many descriptors of a view one is left at least


def thin_views(views: Sequence[View], most: int) -> Sequence[View]:
    """The views with fewer descriptors each, about `most` together.

    Of so many views that little would be left of each, some are left out.

    >>> (few,) = thin_views([View(0, "cup", np.zeros((10, 128), np.uint8))], 5)
    >>> len(few.descriptors)
    5
    >>> many = [View(n, "cup", np.zeros((32, 128), np.uint8)) for n in range(1000)]
    >>> count(thin_views(many, 200))
    200
    """
    step = -(-count(views) // most)
    if step <= 1:
        return views
    within = min(step, _THINNEST)
    every = -(-step // within)
    some = views[(len(views) - 1) % every :: every]  # the newest is among them
    load_descriptors(some)
    return [View(it.key, it.label, it.descriptors[::within]) for it in some]
