"""What is found of one part of the robot or of this machine."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Finding"]


@dataclass(frozen=True)
class Finding:
    """The state of one part; `remedy` is the command or step that mends it."""

    part: str
    works: bool
    needed: bool
    state: str
    remedy: str = ""
