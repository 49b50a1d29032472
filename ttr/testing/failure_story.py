"""Writing a dialogue as a story that reproduces it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ttr.dialogues.dialogue import Dialogue
from ttr.dialogues.stories import Setting, StoryError, setting, story_text
from ttr.testing.game_settings import module_and_name
from ttr.updates.games import Game


def story(dialogue: Dialogue, title: str, place: Setting | None = None) -> str:
    """The dialogue as a story of a `.dlg` file, with the name of its game.

    A game has a name if a module has it under one; otherwise the story gives the state
    that it starts in.

    >>> from ttr import Ind, rectype
    >>> from ttr.dialogues.dialogue import play
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
    place = place or place_of(dialogue.game)
    return story_text(replace(dialogue, title=title, place=place))


def place_of(game: Game) -> Setting:
    """The setting of a game, by the module that has it and its name there."""
    found = module_and_name(game)
    if found is None:
        return Setting.of(game)
    module, name = found
    return _setting_by_name(f"{module.__name__}:{name}", game)


def _setting_by_name(reference: str, game: Game) -> Setting:
    try:
        return setting(reference, Path())
    except StoryError:
        return Setting.of(game)
