"""A finding about one part of the robot or of this machine."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class DoctorFinding:
    """The state of one part; `remedy` is the command or step that mends it."""

    part: str
    works: bool
    needed: bool
    state: str
    remedy: str = ""


def failed_part(part: str, needed: bool, complaint: Exception) -> DoctorFinding:
    """The finding for an error: what is wrong, and after `: ` or `; ` what to do.

    >>> failed_part("lamp", False, OSError("the lamp is dark: light it")).remedy
    'light it'
    """
    state, *remedy = re.split("[:;] ", str(complaint), maxsplit=1)
    return DoctorFinding(part, False, needed, state, "".join(remedy))
