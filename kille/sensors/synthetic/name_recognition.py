"""Names as people write them, and errors that help them to the right one."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from kille.sensors.sensor import SensorError
from ttr.misspellings import nearest_names


def simplify_name(name: str) -> str:
    """The name without article, case, spaces and marks.

    >>> [simplify_name(name) for name in ("The Shoe-Box", "shoe box", "an apple")]
    ['shoebox', 'shoebox', 'apple']
    """
    bare = re.sub(r"^(the|a|an)\s+", "", name.strip().lower())
    return re.sub(r"[\W_]", "", bare)


def recognise_name(
    kind: str, name: str, known: Iterable[str], others: Mapping[str, str] | None = None
) -> str:
    """The known name that is meant; `others` are further ways to say one of them.

    Raises SensorError with the nearest name and all known ones.

    >>> recognise_name("object", "the Shoe Box", ["cup", "shoe-box"])
    'shoe-box'
    """
    names = list(known)
    ways = {simplify_name(other): meant for other, meant in (others or {}).items()}
    ways |= {simplify_name(each): each for each in names}
    if simplify_name(name) in ways:
        return ways[simplify_name(name)]
    near = nearest_names(simplify_name(name), ways)
    hint = f" (did you mean {ways[near[0]]}?)" if near else ""
    raise SensorError(
        f"there is no {kind} '{name}'{hint}: known are {', '.join(names)}"
    )
