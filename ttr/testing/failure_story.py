"""A dialogue as a story that plays it again."""

from __future__ import annotations

from pathlib import Path

from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.dialogues.stories import Setting, StoryError, moment, setting, written
from ttr.testing.game_settings import named_in
from ttr.updates.games import Game, Turn

__all__ = ["place_of", "story"]


def story(dialogue: Dialogue, title: str, place: Setting | None = None) -> str:
    """The dialogue as a story of a `.dlg` file, which names the game that it is in.

    A game that no module has by a name cannot be named; then the story says where it
    starts.

    >>> from ttr.building.constructors import rectype
    >>> from ttr.dialogues.dialogue import play
    >>> from ttr.types.syntax import Ind
    >>> from ttr.updates import rule
    >>> @rule(when=rectype(), on=Ind)
    ... def see(s, e):
    ...     return s
    >>> print(story(play(Game("eyes", rectype(), {}, see), [Ind, None]), "two turns"))
    --- two turns
    @ start {}
    U> Ind
    U>
    <BLANKLINE>
    """
    game = dialogue.game
    place = place or place_of(game)
    lines = [moment(_turn(one), place, _words(one, game)) for one in dialogue.trials]
    start = game.start
    as_named = place.reference and start == place.game.start
    return written(title, lines, place, start=None if as_named else start)


def _turn(one: Trial) -> Turn:
    """The turn; where nothing came of what was given, one in which nothing was said."""
    return one.turn or Turn(one.given, None, (), one.before)


def _words(one: Trial, game: Game) -> str:
    """The line for what was given, if it was given in words."""
    in_words = isinstance(one.given, str) and game.hear is not None
    return f"U> {one.given}" if in_words else ""


def place_of(game: Game) -> Setting:
    """The setting of a game: by the module and the name that Python has it by."""
    found = named_in(game)
    if found is None:
        return Setting.of(game)
    module, name = found
    return _named(f"{module.__name__}:{name}", game)


def _named(reference: str, game: Game) -> Setting:
    try:
        return setting(reference, Path())
    except StoryError:
        return Setting.of(game)
