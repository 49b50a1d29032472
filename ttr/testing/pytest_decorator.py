"""A property of one's own, as a test that pytest runs on many dialogues."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.escapes import terminal_text
from ttr.testing.failure_story import story
from ttr.testing.search import how_many, search
from ttr.testing.strategies.random_dialogues import TURNS, dialogues
from ttr.testing.strategies.tutors import Speaker, Tutor
from ttr.updates.games import Game

__all__ = ["on_dialogues"]

Test = Callable[[Dialogue], object]


def on_dialogues(
    game: Game,
    tutor: Tutor | Speaker | None = None,
    *,
    turns: int = TURNS,
    examples: int | None = None,
    seed: int = 0,
) -> Callable[[Test], Callable[[], None]]:
    """Makes a test of a function of a dialogue: it is run on many, drawn by a tutor.

    What it raises on the shortest dialogue found is raised, with the story added.

    >>> from ttr.building.constructors import rectype
    >>> from ttr.types.records import replace
    >>> from ttr.types.syntax import Ind, ListOf
    >>> from ttr.updates import rule
    >>> Board = rectype(heard=ListOf(Ind))
    >>> @rule(when=Board, on=Ind)
    ... def note(s, e):
    ...     return replace(s, heard=[*s.heard, e])
    >>> @on_dialogues(Game("notes", Board, {"heard": []}, note), examples=50)
    ... def test_nothing_is_forgotten(dialogue):
    ...     for before, after in zip(dialogue.states, dialogue.states[1:]):
    ...         assert set(before.heard) <= set(after.heard)
    >>> test_nothing_is_forgotten()
    """
    if not isinstance(game, Game):
        raise TTRError(
            "dialogues are drawn of a game: @on_dialogues(game), "
            f"found {type(game).__name__}"
        )
    drawn, count = dialogues(game, tutor, turns=turns), how_many(examples)

    def decorate(test: Test) -> Callable[[], None]:
        asked = list(inspect.signature(test).parameters)
        if len(asked) != 1:
            raise TTRError(
                f"the test {test.__name__} takes one dialogue, "
                f"but its parameters are ({', '.join(asked)})"
            )

        def verdict(dialogue: Dialogue) -> Exception | None:
            try:
                test(dialogue)
            except Exception as error:
                # What is shown is where the test fails, not who called it.
                own = error.__traceback__
                return error.with_traceback(own.tb_next if own else None)
            return None

        @wraps(test)
        def play_many() -> None:
            __tracebackhide__ = True
            broken = search(drawn, verdict, verdict, examples=count, start=seed)
            if broken is None:
                return
            title = test.__name__.removeprefix("test_").replace("_", " ")
            shown = story(broken.dialogue, title)
            told = f"The shortest dialogue found:\n\n{shown}"
            broken.why.add_note(terminal_text(told))
            raise broken.why from None

        # pytest takes the parameters of a test for fixtures: this one has none.
        del play_many.__dict__["__wrapped__"]
        return play_many

    return decorate
