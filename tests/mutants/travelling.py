"""The travel agency of the examples, with the tutor who is there beside it."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples" / "travel"))

from tested import book, game, roles, tutor

__all__ = ["book", "game", "roles", "tutor"]
