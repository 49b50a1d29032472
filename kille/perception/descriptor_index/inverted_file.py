"""Faiss's inverted file, which searches only the cells nearest to a query.

It is the extra `kille[faiss]`. Descriptors are kept as bytes in some 4 √n cells, of
which the eight nearest to a query are searched.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index.views import LENGTH, Descriptors, Rows, rooted

_CELLS_VISITED = 8
_TAUGHT_BY = 50  # descriptors a cell whose places the cells are learned from
_BLOCK = 200  # views whose descriptors are added at a time


def inverted_file() -> Callable[[Sequence[Descriptors]], InvertedFile]:
    """A function that makes inverted files; ValueError if faiss is not installed."""
    try:
        import faiss
    except ImportError:
        raise ValueError(
            "the search faiss needs the package faiss-cpu: pip install 'kille[faiss]'"
        ) from None
    return lambda blocks: InvertedFile(blocks, faiss)


class InvertedFile:
    """An inverted file over RootSIFT descriptors, each number a byte."""

    def __init__(self, blocks: Sequence[Descriptors], faiss: Any) -> None:
        size = sum(map(len, blocks))
        count = max(1, int(4 * size**0.5))
        self._index = faiss.index_factory(LENGTH, f"IVF{count},SQ8")
        self._index.cp.seed = 1
        self._index.cp.max_points_per_centroid = _TAUGHT_BY
        self._index.cp.min_points_per_centroid = 1
        self._index.nprobe = _CELLS_VISITED
        step = max(1, size // (_TAUGHT_BY * count))
        self._index.train(rooted(np.concatenate([it[::step] for it in blocks])))
        for start in range(0, len(blocks), _BLOCK):
            self._index.add(rooted(np.concatenate(blocks[start : start + _BLOCK])))

    def find_rows(self, query: Rows, count: int) -> NDArray[np.int32]:
        """The rows (n, count) of descriptors near each query; -1 where there are
        fewer."""
        rows = self._index.search(np.ascontiguousarray(query), count)[1]
        return np.asarray(rows, np.int32)
