"""Test functions of one's own that pytest runs on many dialogues."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.escapes import terminal_text
from ttr.testing.failure_story import story
from ttr.testing.search import find_failure, number_of_examples
from ttr.testing.strategies.random_dialogues import TURNS, dialogues
from ttr.testing.strategies.tutors import Speaker, Tutor
from ttr.updates.games import Game

Test = Callable[[Dialogue], object]


def on_dialogues(
    game: Game,
    tutor: Tutor | Speaker | None = None,
    *,
    turns: int = TURNS,
    examples: int | None = None,
    seed: int = 0,
) -> Callable[[Test], Callable[[], None]]:
    """Turn a function of a dialogue into a test, run on many dialogues of a tutor.

    It raises what the function raises on the shortest dialogue found, and adds the
    story of that dialogue.

    >>> from ttr import Ind, ListOf, rectype, replace
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
    drawn, count = dialogues(game, tutor, turns=turns), number_of_examples(examples)

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
                # The traceback shows where the test fails, not this call of it.
                own = error.__traceback__
                return error.with_traceback(own.tb_next if own else None)
            return None

        @wraps(test)
        def play_many() -> None:
            __tracebackhide__ = True
            broken = find_failure(drawn, verdict, verdict, examples=count, start=seed)
            if broken is None:
                return
            title = test.__name__.removeprefix("test_").replace("_", " ")
            text = story(broken.dialogue, title)
            note = f"The shortest dialogue found:\n\n{text}"
            broken.why.add_note(terminal_text(note))
            raise broken.why from None

        # pytest takes parameters for fixtures; this test has none.
        del play_many.__dict__["__wrapped__"]
        return play_many

    return decorate
