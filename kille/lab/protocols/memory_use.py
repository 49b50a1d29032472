"""How much memory the program takes, where the system tells it."""

from __future__ import annotations

import gc
import mmap
from pathlib import Path


class ResidentMemory:
    """What the program takes more than before a method began.

    None where the system does not tell, or while what earlier methods had let go of is
    enough.
    """

    def __init__(self) -> None:
        self._before = self._free = self._most = 0

    def begin(self) -> None:
        """Another method begins."""
        gc.collect()
        self._before = resident_memory() or 0
        self._free = self._most = max(self._most, self._before)

    def grown(self) -> float | None:
        """The bytes that it takes more now; None if they cannot be told."""
        now = resident_memory()
        if now is None or now <= self._free:
            return None
        self._most = max(self._most, now)
        return float(now - self._before)


def resident_memory() -> int | None:
    """The bytes of memory the program takes; None where the system does not tell."""
    statm = Path("/proc/self/statm")
    if not statm.exists():
        return None
    return int(statm.read_text().split()[1]) * mmap.PAGESIZE
