"""The tutor, roles and starts that modules define beside a game."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import ModuleType

from hypothesis import strategies as st

from ttr.judging.models import Model
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.tutors import Tutor
from ttr.types.objects import Record
from ttr.updates.games import Game


def module_and_name(game: Game) -> tuple[ModuleType, str] | None:
    """A module that has the game, and the game's name there; None if no module has."""
    return next(_modules_with(game), None)


def tutor_of(game: Game) -> Tutor | None:
    """The tutor that a module of the game calls `tutor`."""
    found = (getattr(module, "tutor", None) for module, _ in _modules_with(game))
    return next((one for one in found if isinstance(one, Tutor)), None)


def roles_of(game: Game) -> Roles | None:
    """The roles that a module of the game calls `roles`."""
    found = (getattr(module, "roles", None) for module, _ in _modules_with(game))
    return next((one for one in found if isinstance(one, Roles)), None)


def starts_of(game: Game) -> st.SearchStrategy[tuple[Record, Model]] | None:
    """The strategy for states and models that a module of the game calls `starts`."""
    found = (getattr(module, "starts", None) for module, _ in _modules_with(game))
    return next((one for one in found if isinstance(one, st.SearchStrategy)), None)


def _modules_with(game: Game) -> Iterator[tuple[ModuleType, str]]:
    """The modules that have the game, in order of their names, each with its name."""
    for name, module in sorted(sys.modules.items()):
        if name == "__main__" or not isinstance(module, ModuleType):
            continue
        for label, value in list(vars(module).items()):
            if value is game:
                yield module, label
