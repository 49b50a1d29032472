"""The game of fetch of the examples, in which the partners do all that is planned."""

from __future__ import annotations

from pathlib import Path

from ttr.dialogues.stories import setting
from ttr.testing import Roles, Tutor

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

court = setting("fetch.ttr fetch", EXAMPLES)
game = court.game
theory = court.theory
tutor = Tutor()
roles = Roles(moves=6)
