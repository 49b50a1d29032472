"""Dialogues as they were played: what was given to a game, and what came of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain
from typing import Any

from ttr.dialogues.snapshots import changed_since, copied, snapshot
from ttr.errors import NotHeard, TTRError, UpdateError
from ttr.judging.models import Model
from ttr.types.syntax import Object, Record, TypeNode
from ttr.updates.games import Game, Turn
from ttr.updates.running import Run, Step

__all__ = ["Dialogue", "Trial", "play", "taken"]


@dataclass(frozen=True, eq=False)
class Trial:
    """What was given to the game, the run before it, and the turn that came of it.

    There is no turn where the game did not take what was given; `fault` is what went
    wrong where a rule, a move or the language of the game broke. `tampered` is the path
    at which a rule changed the very state that it was given, if one did.
    """

    given: Object
    before: Run
    turn: Turn | None
    fault: Exception | None = None
    tampered: str = ""

    @property
    def after(self) -> Run:
        """The run after it: the one before, where there was no turn."""
        return self.before if self.turn is None else self.turn.run

    @property
    def steps(self) -> tuple[Step, ...]:
        """The rules that were applied."""
        return () if self.turn is None else self.turn.trace

    @property
    def applied(self) -> tuple[Step, ...]:
        """The rules that were applied, also in a turn that came to no end."""
        if isinstance(self.fault, UpdateError):
            return self.fault.steps
        return self.steps


@dataclass(frozen=True, eq=False)
class Dialogue:
    """A game with the trials of one dialogue in it; the last one may have a fault."""

    game: Game
    trials: tuple[Trial, ...] = ()

    @property
    def given(self) -> tuple[Object, ...]:
        """What was given to the game: events, types of events, texts, None."""
        return tuple(trial.given for trial in self.trials)

    @property
    def turns(self) -> tuple[Turn, ...]:
        """The turns, of all that the game took."""
        return tuple(m.turn for m in self.trials if m.turn is not None)

    @property
    def states(self) -> tuple[Record, ...]:
        """The states, from the start on."""
        return (self.game.start, *(trial.after.state for trial in self.trials))

    @property
    def steps(self) -> tuple[Step, ...]:
        """Every rule that was applied, in order."""
        return tuple(chain.from_iterable(trial.steps for trial in self.trials))

    @property
    def fault(self) -> Exception | None:
        """What went wrong at the end, if anything did."""
        return self.trials[-1].fault if self.trials else None

    @property
    def now(self) -> Run:
        """The run after the last trial."""
        if self.trials:
            return self.trials[-1].after
        begun = self.game.begin()
        return begun._replace(state=copied(begun.state))

    def then(self, given: object) -> Dialogue:
        """The dialogue with one more trial."""
        return Dialogue(self.game, (*self.trials, taken(self.game, self.now, given)))

    def __repr__(self) -> str:
        return f"<Dialogue of {len(self.trials)} turns in {self.game.name}>"

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        """How Hypothesis and notebooks print it: in a line, not with all its states."""
        printer.text(repr(self))


def play(game: Game, given: Iterable[object]) -> Dialogue:
    """The dialogue in which all of this is given to the game, up to the first fault.

    >>> from ttr.types.syntax import Basic, ListOf, Ind
    >>> from ttr.building.constructors import rectype
    >>> from ttr.types.records import replace
    >>> from ttr.updates import rule
    >>> Board = rectype(heard=ListOf(Ind))
    >>> @rule(when=Board, on=Ind)
    ... def note(s, e):
    ...     return replace(s, heard=[*s.heard, e])
    >>> game = Game("notes", Board, {"heard": []}, note)
    >>> print(*play(game, [Ind, None, Ind]).states)
    {heard = []} {heard = [a1]} {heard = [a1]} {heard = [a1, a2]}
    """
    dialogue = Dialogue(game)
    for one in given:
        dialogue = dialogue.then(one)
        if dialogue.fault is not None:
            break
    return dialogue


def taken(game: Game, before: Run, given: object) -> Trial:
    """What comes of one thing that is given to the game after a run."""
    before = before._replace(trace=())
    looked = snapshot(before.state)
    turn, fault = _turn(game, before, given)
    return Trial(given, before, turn, fault, changed_since(looked, before.state))


def _turn(
    game: Game, before: Run, given: object
) -> tuple[Turn | None, Exception | None]:
    """The turn, or what went wrong; neither where the game does not take it."""
    try:
        event = _meant(game, given)
    except TTRError:
        return None, None
    except Exception as error:
        return None, error
    try:
        return game.take(before, event), None
    except NotHeard:
        return None, None
    except Exception as error:
        return None, error if _can_happen(event, before.model) else None


def _meant(game: Game, given: object) -> object:
    """The event that a text is for; raises `TTRError` where it is not understood."""
    if isinstance(given, str) and game.hear is not None:
        return game.hear(given)
    return given


def _can_happen(event: object, model: Model) -> bool:
    """Whether an event of a type can be created; what is no type just happens."""
    if not isinstance(event, TypeNode):
        return True
    try:
        model.create(event)
    except TTRError:
        return False
    return True
