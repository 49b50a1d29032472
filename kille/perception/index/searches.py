"""What can search many descriptors, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from kille.perception.index.inverted_file import cells
from kille.perception.index.kd_trees import Trees
from kille.perception.index.views import Descriptors, Rows


class Search(Protocol):
    """A structure over descriptors that finds the nearest ones."""

    def found(self, query: Rows, count: int) -> NDArray[np.int32]:
        """The rows (n, count) of descriptors near each query, -1 where there are none.

        They need not be in order.
        """
        ...


Maker = Callable[[Sequence[Descriptors]], Search]
"""Makes a search over some blocks of descriptors, however long that takes."""

SEARCHES: Mapping[str, Callable[[], Maker]] = {"trees": lambda: Trees, "faiss": cells}
"""Trees are always there; `faiss` needs the extra kille[faiss]."""


def search_called(name: str) -> Maker:
    """The search of this name; ValueError if there is none, or it is not installed."""
    if name in SEARCHES:
        return SEARCHES[name]()
    known = ", ".join(SEARCHES)
    near = get_close_matches(name, SEARCHES, 1)
    hint = f"; did you mean {near[0]}?" if near else ""
    raise ValueError(f"no search is called {name!r}: there are {known}{hint}")
