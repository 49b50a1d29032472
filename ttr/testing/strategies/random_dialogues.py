"""Strategies for whole dialogues, drawn turn by turn as they are played."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.judging.models import Model
from ttr.testing.strategies.tutors import Speaker, Tutor, Voice, voice_of
from ttr.types.objects import Record
from ttr.types.syntax import kind_of
from ttr.updates.games import Game

TURNS = 10
"""How many turns a dialogue has at most by default."""


def dialogues(
    game: Game,
    tutor: Tutor | Speaker | None = None,
    *,
    turns: int = TURNS,
    starts: st.SearchStrategy[tuple[Record, Model]] | None = None,
) -> st.SearchStrategy[Dialogue]:
    """Dialogues of a tutor with the game; most of them have `turns` turns.

    The tutor looks at the state before each turn. An error in a turn is not raised: it
    ends the dialogue, which then has a `fault`. If `starts` is given, it draws states
    and models, as `states` does, in which dialogues begin instead of the game's start.
    Raises `TTRError` for what is no game, tutor or number of turns.

    >>> from hypothesis import find
    >>> from ttr import Ind, ListOf, rectype, replace
    >>> from ttr.updates import rule
    >>> Board = rectype(heard=ListOf(Ind))
    >>> @rule(when=Board, on=Ind)
    ... def note(s, e):
    ...     return replace(s, heard=[*s.heard, e])
    >>> game = Game("notes", Board, {"heard": []}, note)
    >>> played = find(dialogues(game), lambda played: len(played.now.state.heard) > 1)
    >>> print(*played.states)
    {heard = []} {heard = [a1]} {heard = [a1, a2]}
    """
    if not isinstance(game, Game):
        raise TTRError(f"dialogues are drawn of a game, found {kind_of(game)}")
    if type(turns) is not int or turns < 1:
        raise TTRError(f"a dialogue has a turn at least, found turns={turns!r}")
    lengths = st.sampled_from([*range(1, turns), *[turns] * (3 * turns)])
    voice = voice_of(tutor, game)
    if starts is None:
        return _draw_dialogue(st.just(game), voice, lengths)
    begun = starts.map(lambda start: replace(game, start=start[0], model=start[1]))
    return _draw_dialogue(begun, voice, lengths)


@st.composite
def _draw_dialogue(
    draw: st.DrawFn,
    games: st.SearchStrategy[Game],
    voice: Voice,
    lengths: st.SearchStrategy[int],
) -> Dialogue:
    dialogue = Dialogue(draw(games))
    for _ in range(draw(lengths)):
        dialogue = dialogue.then(voice(draw, dialogue))
        if dialogue.fault is not None:
            break
    return dialogue
