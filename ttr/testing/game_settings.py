"""The tutor, roles and starts that modules define beside a game."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import ModuleType
from typing import TypeVar

from hypothesis import strategies as st

from ttr.judging.models import Model
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.tutors import Tutor
from ttr.types.objects import Record
from ttr.updates.games import Game

_T = TypeVar("_T")


def module_and_name(game: Game) -> tuple[ModuleType, str] | None:
    """A module that has the game, and the game's name there; None if no module has."""
    return next(_modules_with(game), None)


def tutor_of(game: Game) -> Tutor | None:
    """The tutor that a module of the game calls `tutor`."""
    return _beside(game, "tutor", Tutor)


def roles_of(game: Game) -> Roles | None:
    """The roles that a module of the game calls `roles`."""
    return _beside(game, "roles", Roles)


def starts_of(game: Game) -> st.SearchStrategy[tuple[Record, Model]] | None:
    """The strategy for states and models that a module of the game calls `starts`."""
    return _beside(game, "starts", st.SearchStrategy)


def _beside(game: Game, name: str, kind: type[_T]) -> _T | None:
    """What a module of the game has under a name, if it is of this kind."""
    found = (getattr(module, name, None) for module, _ in _modules_with(game))
    return next((one for one in found if isinstance(one, kind)), None)


def _modules_with(game: Game) -> Iterator[tuple[ModuleType, str]]:
    """The modules that have the game, in order of their names, each with its name."""
    for name, module in sorted(sys.modules.items()):
        if name == "__main__" or not isinstance(module, ModuleType):
            continue
        for label, value in list(vars(module).items()):
            if value is game:
                yield module, label
