"""Check numbers that should be those of a lens."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from kille.scene import Intrinsics


def lens_from(numbers: Sequence[float]) -> Intrinsics | None:
    """The lens of these fx, fy, cx, cy in pixels; None if no lens has them.

    >>> lens_from([525, 525, 319.5, 239.5])
    Intrinsics(fx=525, fy=525, cx=319.5, cy=239.5)
    >>> lens_from([0, 525, 319.5, 239.5]) is lens_from([525, 525]) is None
    True
    """
    if len(numbers) != 4 or not all(map(isfinite, numbers)):
        return None
    return Intrinsics(*numbers) if min(numbers[:2]) > 0 else None
