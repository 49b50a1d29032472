"""Nearest neighbours among all learned descriptors, whichever word they belong to.

There is one index over everything, never one for each learned view: large immutable
parts, searched by kd-trees, and an exact search over the newest views. Parts are merged
in the background, or when somebody asks.
"""

from kille.perception.descriptor_index.builders import AtOnce, Background, Builder
from kille.perception.descriptor_index.index import Index
from kille.perception.descriptor_index.index_parts import NOBODY, Neighbours
from kille.perception.descriptor_index.repeats import AGAIN, Repeats, find_repeats
from kille.perception.descriptor_index.searches import SEARCHES
from kille.perception.descriptor_index.views import (
    Descriptors,
    Rows,
    View,
    distances,
    rooted,
)

__all__ = [
    "AGAIN",
    "NOBODY",
    "SEARCHES",
    "AtOnce",
    "Background",
    "Builder",
    "Descriptors",
    "Index",
    "Neighbours",
    "Repeats",
    "Rows",
    "View",
    "distances",
    "find_repeats",
    "rooted",
]
