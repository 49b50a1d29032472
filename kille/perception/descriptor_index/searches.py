"""The searches over many descriptors, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index.inverted_file import inverted_file
from kille.perception.descriptor_index.kd_trees import Trees
from kille.perception.descriptor_index.views import Descriptors, Rows
from ttr.misspellings import nearest_names


class Search(Protocol):
    """A data structure over descriptors that finds the nearest ones."""

    def find_rows(self, query: Rows, count: int) -> NDArray[np.int32]:
        """The rows (n, count) of descriptors near each query; -1 where there are fewer.

        They need not be in order.
        """
        ...


Maker = Callable[[Sequence[Descriptors]], Search]
"""Makes a search over some blocks of descriptors, however long that takes."""

SEARCHES: Mapping[str, Callable[[], Maker]] = {
    "trees": lambda: Trees,
    "faiss": inverted_file,
}
"""`trees` is always available; `faiss` needs the extra kille[faiss].

>>> from kille.perception.descriptor_index import SEARCHES
>>> sorted(SEARCHES)
['faiss', 'trees']
"""


def search_called(name: str) -> Maker:
    """The search of this name; ValueError if it is unknown or not installed."""
    if name in SEARCHES:
        return SEARCHES[name]()
    known = ", ".join(SEARCHES)
    near = nearest_names(name, SEARCHES)
    hint = f"; did you mean {near[0]}?" if near else ""
    raise ValueError(f"no search is called {name!r}: there are {known}{hint}")
