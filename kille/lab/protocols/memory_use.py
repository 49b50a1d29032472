"""How much memory the program takes, on systems that say so."""

from __future__ import annotations

import gc
import mmap
from pathlib import Path


class ResidentMemory:
    """How much more memory the program takes than before a method began.

    Unknown where the system does not say, or as long as memory that earlier methods
    have freed is enough.
    """

    def __init__(self) -> None:
        self._before = self._free = self._most = 0

    def begin(self) -> None:
        """Begin with another method."""
        gc.collect()
        self._before = resident_memory() or 0
        self._free = self._most = max(self._most, self._before)

    def growth(self) -> float | None:
        """The bytes that the program takes more now; None if unknown."""
        now = resident_memory()
        if now is None or now <= self._free:
            return None
        self._most = max(self._most, now)
        return float(now - self._before)


def resident_memory() -> int | None:
    """The bytes of memory that the program takes; None where the system says none."""
    statm = Path("/proc/self/statm")
    if not statm.exists():
        return None
    return int(statm.read_text().split()[1]) * mmap.PAGESIZE
