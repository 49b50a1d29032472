"""Looking for a dialogue with something wrong with it, among many random ones."""

from __future__ import annotations

from typing import TypeVar

from hypothesis import HealthCheck, Phase, Verbosity, given, seed, settings
from hypothesis import strategies as st
from hypothesis.errors import Flaky

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError, describe_error
from ttr.testing.shrinking import Failure, Verdict, shorten

Why = TypeVar("Why")


def number_of_examples(examples: int | None) -> int:
    """How many dialogues are drawn: by default as many as the Hypothesis profile says.

    >>> number_of_examples(20)
    20
    """
    if examples is None:
        count: int = settings().max_examples
        return count
    if not isinstance(examples, int) or examples < 1:
        raise TTRError(f"examples= is a number from 1 on, found {examples!r}")
    return examples


class _FoundError(Exception):
    """Something is wrong with the dialogue that was drawn."""


class UnsteadyError(Exception):
    """A dialogue went another way when the same moves were made again.

    `once` is the error that came the one time and not the other, if one did.
    """

    def __init__(self, dialogue: Dialogue, once: Exception | None = None) -> None:
        failed = "" if once is None else f": once there was {describe_error(once)}"
        super().__init__(
            f"the dialogue goes another way when it is played again{failed}"
        )
        self.dialogue = dialogue


def find_failure(
    drawn: st.SearchStrategy[Dialogue],
    verdict: Verdict[Why],
    verdict_again: Verdict[Why],
    *,
    examples: int,
    start: int,
    shrink_first: bool = False,
) -> Failure[Why] | None:
    """A short dialogue with something wrong with it; None if all are right.

    `verdict` is asked of the dialogues that are drawn, `verdict_again` of those that
    are made of the first that fails, to make it shorter. With `shrink_first` Hypothesis
    shrinks it before that, as needed where dialogues begin in a random state, too. The
    same `start` draws the same dialogues. Raises `UnsteadyError` where a dialogue is
    not the same when it is drawn again.
    """
    found: list[Failure[Why]] = []
    latest: list[Dialogue] = []

    @seed(start)
    @settings(
        max_examples=examples,
        database=None,
        deadline=None,
        phases=(Phase.generate, Phase.shrink) if shrink_first else (Phase.generate,),
        report_multiple_bugs=False,
        verbosity=Verbosity.quiet,
        suppress_health_check=list(HealthCheck),
    )
    @given(drawn)
    def look(dialogue: Dialogue) -> None:
        latest[:] = [dialogue]
        why = verdict_again(dialogue) if found else verdict(dialogue)
        if why is not None:
            found[:] = [Failure(dialogue, why)]
            raise _FoundError

    # The dialogue is made shorter after the `except`, so that no error that is raised
    # then comes "during the handling of another".
    try:
        look()
    except _FoundError:
        pass
    except Flaky as error:
        if not found:
            raise UnsteadyError(latest[0], _error_behind(error)) from error
    return shorten(found[0], verdict_again) if found else None


def _error_behind(error: Flaky) -> Exception | None:
    """The error that a dialogue failed with once; None if it only came out otherwise.

    A tutor may fail for a moment: while a file that they read is being written, say.
    """
    if not isinstance(error, ExceptionGroup):
        return None
    failures = (it for it in error.exceptions if not isinstance(it, Flaky))
    return next(failures, None)
