"""The shortest dialogue in which something goes wrong in the same way."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from typing import Generic, TypeVar

from ttr.dialogues.dialogue import Dialogue, play
from ttr.testing.strategies.random_states import heard_by, variants
from ttr.types.syntax import Object, TypeNode
from ttr.updates.nbest import NBest

__all__ = ["Broken", "Verdict", "shortest"]

Why = TypeVar("Why")

Verdict = Callable[[Dialogue], Why | None]
"""What is wrong with a dialogue, or None."""

PLAYED = 500
"""How many turns are played to find a dialogue that is still shorter."""


@dataclass(frozen=True)
class Broken(Generic[Why]):
    """A dialogue with something wrong with it."""

    dialogue: Dialogue
    why: Why


def shortest(broken: Broken[Why], verdict: Verdict[Why]) -> Broken[Why]:
    """The dialogue without what it does not take to go wrong in the same way.

    First turns are left out as long as that is possible; then dialogues with fewer
    turns are tried from the start, of the same moves and of events about the state.
    """
    smaller: Broken[Why] | None = broken
    while smaller is not None:
        broken = smaller
        smaller = next(_smaller(broken, verdict), None)
    return next(_shorter(broken, verdict), broken)


def _smaller(broken: Broken[Why], verdict: Verdict[Why]) -> Iterator[Broken[Why]]:
    game = broken.dialogue.game
    for given in _with_less(broken.dialogue.given, heard_by(game)):
        if found := _same(play(game, given), broken, verdict):
            yield found


def _with_less(
    given: Sequence[Object], types: Sequence[TypeNode]
) -> Iterator[tuple[Object, ...]]:
    """The same without some turns, most of them first; or with less in a turn."""
    for size in range(len(given) - 1, 0, -1):
        for start in range(len(given) - size, -1, -1):
            yield (*given[:start], *given[start + size :])
    for place, one in enumerate(given):
        for less in _less(one, types):
            yield (*given[:place], less, *given[place + 1 :])


def _less(given: Object, types: Sequence[TypeNode]) -> Iterator[Object]:
    """Simpler things to be given: one event for several, any for a certain one."""
    if isinstance(given, NBest):
        yield given.alternatives[0][0]
    if isinstance(given, TypeNode) and given not in types:
        yield from (T for T in types if given <= T)


def _shorter(broken: Broken[Why], verdict: Verdict[Why]) -> Iterator[Broken[Why]]:
    """Dialogues of fewer turns that go wrong so, those of the fewest first."""
    level = [Dialogue(broken.dialogue.game)]
    left = PLAYED
    for _ in range(len(broken.dialogue.trials) - 1):
        ways = chain.from_iterable(_onwards(one, broken) for one in level)
        level = []
        for dialogue in islice(ways, left):
            left -= 1
            if found := _same(dialogue, broken, verdict):
                yield found
            if dialogue.fault is None and dialogue.trials[-1].steps:
                level.append(dialogue)


def _onwards(dialogue: Dialogue, broken: Broken[Why]) -> Iterator[Dialogue]:
    """The dialogue with one turn more, for all that may happen in it."""
    state, model, _ = dialogue.now
    known = dict.fromkeys(map(_Given, broken.dialogue.given))
    about = (variants(T, model, state) for T in heard_by(dialogue.game))
    for one in dict.fromkeys((*known, *map(_Given, chain.from_iterable(about)))):
        yield dialogue.then(one.given)


@dataclass(frozen=True, eq=False)
class _Given:
    """Something given to a game; the same if it prints the same."""

    given: Object

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Given) and str(self.given) == str(other.given)

    def __hash__(self) -> int:
        return hash(str(self.given))


def _same(
    dialogue: Dialogue, broken: Broken[Why], verdict: Verdict[Why]
) -> Broken[Why] | None:
    """The dialogue, if it goes wrong in the same way."""
    why = verdict(dialogue)
    if why is None or _kind(why) != _kind(broken.why):
        return None
    return Broken(dialogue, why)


def _kind(why: object) -> object:
    """What makes two findings the same: their property, or the class of an error."""
    return getattr(why, "property", type(why))
