"""Making a dialogue that fails shorter, as long as it fails in the same way.

Turns are left out here, and not by Hypothesis, which shrinks the choices by which a
dialogue was drawn: for the planted faults of our tests it played five times as many
turns, and its stories were a quarter longer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from typing import Generic, TypeVar

from ttr.dialogues.dialogue import Dialogue, play
from ttr.testing.strategies.random_states import heard_by, variants
from ttr.types.objects import Object
from ttr.types.syntax import TypeNode
from ttr.updates.nbest import NBest

Why = TypeVar("Why")

Verdict = Callable[[Dialogue], Why | None]
"""What is wrong with a dialogue; None if nothing is."""

PLAYED = 500
"""How many turns are played at most to find a dialogue with fewer turns."""


@dataclass(frozen=True)
class Failure(Generic[Why]):
    """A dialogue with something wrong with it."""

    dialogue: Dialogue
    why: Why


def shorten(failure: Failure[Why], verdict: Verdict[Why]) -> Failure[Why]:
    """A dialogue that fails in the same way, with nothing in it that is not needed.

    First turns are left out, as long as that is possible. A move may make sense only
    because of an earlier one, so that neither can be left out alone: therefore all
    dialogues with fewer turns are tried then, of the same moves and of events about the
    state.
    """
    smaller: Failure[Why] | None = failure
    while smaller is not None:
        failure = smaller
        smaller = next(_reductions(failure, verdict), None)
    return next(_from_the_start(failure, verdict), failure)


# --- leaving out ---------------------------------------------------------------------


def _reductions(failure: Failure[Why], verdict: Verdict[Why]) -> Iterator[Failure[Why]]:
    """The failing dialogues with fewer or simpler turns."""
    game = failure.dialogue.game
    for given in _with_less(failure.dialogue.given, heard_by(game)):
        if found := _failing_alike(play(game, given), failure, verdict):
            yield found


def _with_less(
    given: Sequence[Object], types: Sequence[TypeNode]
) -> Iterator[tuple[Object, ...]]:
    """The same turns without some, as many as possible first; or with simpler ones."""
    for size in range(len(given) - 1, 0, -1):
        for start in range(len(given) - size, -1, -1):
            yield (*given[:start], *given[start + size :])
    for place, one in enumerate(given):
        for simpler in _simplifications(one, types):
            yield (*given[:place], simpler, *given[place + 1 :])


def _simplifications(given: Object, types: Sequence[TypeNode]) -> Iterator[Object]:
    """One event in place of an uncertain one, a general type in place of a special."""
    if isinstance(given, NBest):
        yield given.alternatives[0][0]
    if isinstance(given, TypeNode) and given not in types:
        yield from (T for T in types if given <= T)


# --- trying all dialogues with fewer turns -------------------------------------------


def _from_the_start(
    failure: Failure[Why], verdict: Verdict[Why]
) -> Iterator[Failure[Why]]:
    """Failing dialogues with fewer turns, breadth first."""
    level = [Dialogue(failure.dialogue.game)]
    left = PLAYED
    for _ in range(len(failure.dialogue.trials) - 1):
        longer = chain.from_iterable(_continuations(one, failure) for one in level)
        level = []
        for dialogue in islice(longer, left):
            left -= 1
            if found := _failing_alike(dialogue, failure, verdict):
                yield found
            if dialogue.fault is None and dialogue.trials[-1].steps:
                level.append(dialogue)


def _continuations(dialogue: Dialogue, failure: Failure[Why]) -> Iterator[Dialogue]:
    """The dialogue with one more turn, for each event that may happen in it.

    Events that print alike are taken for the same. Where a game reads words, an event
    that is made of its type alone is none that anybody could say.
    """
    state, model, _ = dialogue.now
    types = () if dialogue.game.hear else heard_by(dialogue.game)
    about = (variants(T, model, state) for T in types)
    seen: set[str] = set()
    for event in chain(failure.dialogue.given, *about):
        if str(event) not in seen:
            seen.add(str(event))
            yield dialogue.then(event)


# --- what it is to fail alike --------------------------------------------------------


def _failing_alike(
    dialogue: Dialogue, failure: Failure[Why], verdict: Verdict[Why]
) -> Failure[Why] | None:
    """The dialogue as a failure, if it fails in the same way as another one."""
    why = verdict(dialogue)
    if why is None or _kind(why) != _kind(failure.why):
        return None
    return Failure(dialogue, why)


def _kind(why: object) -> object:
    """The property that is broken, or the class of an error."""
    return getattr(why, "property", type(why))
