"""A table-top robot that learns words for objects and places from a tutor.

>>> from kille import Agent
>>> with Agent(sensor="synthetic:empty") as robot:
...     robot.hear("What is this?")
'I see nothing on the table.'
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kille.former_modules import FORMER_MODULES
from ttr.aliases import find_former_modules
from ttr.hooks import set_providers

if TYPE_CHECKING:
    from kille.agent.agent import Agent
    from kille.dialogue import games
    from kille.memory import Memory

__all__ = ["Agent", "Memory", "games"]

_LATER = {"Agent": "kille.agent.agent", "Memory": "kille.memory"}

find_former_modules(FORMER_MODULES)

PROVIDERS = {
    "kille.scene.shown_look": "kille.perception.shown_looks",
    "kille.lab.results.shown_result": "kille.lab.reports.shown_results",
}
"""Which module provides what is declared below it (`ttr.hooks`)."""

set_providers(PROVIDERS)


def __getattr__(name: str) -> Any:
    """Loads the parts that see and parse only when they are asked for."""
    from importlib import import_module

    if name == "games":
        return import_module("kille.dialogue.games")
    if name in _LATER:
        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module 'kille' has no attribute {name!r}")
