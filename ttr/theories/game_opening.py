"""The games that a theory states, each in the model of its givens."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ttr.errors import TTRError
from ttr.judging.models import model_of
from ttr.updates.games import Game

if TYPE_CHECKING:
    from ttr.theories.theory import Theory


def open_games(theory: Theory) -> Mapping[str, Game]:
    """The games of a theory, in the model of its givens.

    Raises `TTRError`, with its place, if the givens contradict one another or the start
    of a game is not of its type.
    """
    if not theory.openings:
        return {}
    model = model_of(theory)
    games: dict[str, Game] = {}
    for one in theory.openings.values():
        try:
            games[one.name] = Game(
                one.name,
                one.type,
                one.start,
                one.algorithm,
                model,
                agenda=one.agenda,
                hears=one.hears,
                theory=theory,
            )
        except TTRError as error:
            raise error.at(one.span) if one.span else error from None
    return games
