"""A dialogue that was played: one value, with several spellings.

A `Dialogue` is a game with the trials of one dialogue in it; a `Trial` is one thing
that was given to the game, with all that came of it. `stories` spell a dialogue as a
test, `logs` as lines of JSON, `transcripts` as a page; the strategies of `ttr.testing`
draw dialogues at random.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import Any, Self

from ttr.dialogues.event_wording import line_of_event, wording
from ttr.dialogues.settings import Setting
from ttr.dialogues.state_snapshots import copy_of, first_change, snapshot
from ttr.errors import NotHeardError, TTRError, UpdateError, describe_error
from ttr.judging.models import Model
from ttr.showing import (
    Fold,
    In,
    NotebookValue,
    Part,
    Text,
    Value,
    below,
    count_of,
    table,
)
from ttr.types.objects import Object, Record
from ttr.types.syntax import TypeNode
from ttr.updates.games import Game, Turn, event_shown
from ttr.updates.running import Run, Step, trace_shown

__all__ = ["Dialogue", "Trial", "give", "play"]


@dataclass(frozen=True, eq=False)
class Trial(NotebookValue):
    """One thing that was given to a game, the run before it, and the turn it led to.

    There is no turn where the game did not take what was given; `fault` is what went
    wrong where a rule, a move or the language of the game broke. `tampered` is the path
    at which a rule changed the very state that it was given, if one did. `line` is the
    line of a story that gives this, and `said` what the system said, in words; both are
    empty until `in_words` finds them.

    >>> from ttr import Theory
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> trial = play(theory.games["notes"], ["ann"]).trials[0]
    >>> print(trial.given, trial.after.state)
    ann {heard = [ann]}
    """

    given: Object
    before: Run
    turn: Turn | None
    fault: Exception | None = None
    tampered: str = ""
    line: str = ""
    said: tuple[str, ...] = ()

    @classmethod
    def of(cls, turn: Turn, setting: Setting, line: str = "") -> Self:
        """The trial that led to a turn, in words.

        Without a line, the event is written in the notation.
        """
        said = tuple(wording(move, setting) for move in turn.said)
        line = line or line_of_event(turn.event, setting)
        return cls(turn.event, turn.before, turn, line=line, said=said)

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

    def _shown_as_(self) -> Part:
        return below(
            event_shown(self.given) if not self.line else Text(self.line, "strong"),
            *[Text(f"S> {words}") for words in self.said],
            trace_shown(self.applied),
            Fold("the state after it", self._state_shown()),
            Text(describe_error(self.fault), "no") if self.fault else None,
        )

    def _state_shown(self) -> Part:
        return Value(self.after.state, before=self.before.state)

    def in_words(self, setting: Setting) -> Trial:
        """The same with its line and what was said; raises `UpdateError` without words.

        Words that are there already stay as they are.
        """
        if self.line:
            return self
        if isinstance(self.given, str) and setting.game.hear is not None:
            line = f"U> {self.given}"
        else:
            line = line_of_event(self.given, setting)
        moves = () if self.turn is None else self.turn.said
        said = tuple(wording(move, setting) for move in moves)
        return replace(self, line=line, said=said)


@dataclass(frozen=True, eq=False)
class Dialogue(NotebookValue):
    """A game with the trials of one dialogue in it; the last one may have a fault.

    `place` says by what reference and with what names the game is spelled; `origin` is
    the run that the dialogue goes on from, if it does not begin where the game does.
    `title` stands above a dialogue on paper, and `ending` below it.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann, bo : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> print(*Dialogue(theory.games["notes"]).then("ann").then("bo").states)
    {heard = []} {heard = [ann]} {heard = [bo, ann]}
    """

    game: Game
    trials: tuple[Trial, ...] = ()
    title: str = ""
    place: Setting | None = None
    origin: Run | None = None
    ending: str = ""

    @cached_property
    def setting(self) -> Setting:
        """Its place; without one, all that occurs in the game can be named."""
        return self.place or Setting.of(self.game)

    @property
    def start(self) -> Run:
        """The state and the model before the first trial."""
        return self.origin or self.game.begin()

    @property
    def given(self) -> tuple[Object, ...]:
        """What was given to the game: events, types of events, texts, None."""
        return tuple(trial.given for trial in self.trials)

    @property
    def turns(self) -> tuple[Turn, ...]:
        """The turns, of all that the game took."""
        return tuple(trial.turn for trial in self.trials if trial.turn is not None)

    @property
    def states(self) -> tuple[Record, ...]:
        """The states, from the start on."""
        return (self.start.state, *(trial.after.state for trial in self.trials))

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
        """The run after the last trial.

        At the start it has a copy of the state, so that no rule can change the game's.
        """
        if self.trials:
            return self.trials[-1].after
        return self.start._replace(state=copy_of(self.start.state))

    def then(self, given: object) -> Dialogue:
        """The dialogue after one thing more has been given to the game."""
        return self.with_trial(give(self.game, self.now, given))

    def with_trial(self, trial: Trial) -> Dialogue:
        """The dialogue with one trial more."""
        return replace(self, trials=(*self.trials, trial))

    def in_words(self) -> Dialogue:
        """The dialogue with the line and the words of each trial."""
        setting = self.setting
        trials = tuple(trial.in_words(setting) for trial in self.trials)
        return replace(self, trials=trials, place=setting)

    def __repr__(self) -> str:
        return f"<Dialogue of {len(self.trials)} turns in {self.game.name}>"

    def _shown_as_(self) -> Part:
        shown = self._in_words_if_there_are()

        def row(numbered: tuple[int, Trial]) -> tuple[Part, ...]:
            number, trial = numbered
            return (
                Text(str(number), "quiet"),
                below(
                    Text(trial.line, "strong")
                    if trial.line
                    else event_shown(trial.given),
                    *[Text(f"S> {words}") for words in trial.said],
                ),
                below(
                    Fold(count_of(len(trial.steps), "rule"), trace_shown(trial.steps)),
                    Fold("the state", trial._state_shown()),
                    Text(describe_error(trial.fault), "no") if trial.fault else None,
                ),
            )

        trials = shown.trials
        whole = below(
            Text(self.title or f"a dialogue in {self.game.name}", "strong"),
            table(("", "turn", ""), enumerate(trials, 1), row, count=len(trials)),
            Text(self.ending, "code") if self.ending else None,
        )
        return In(shown.setting.theory, whole) if shown.setting.theory else whole

    def _in_words_if_there_are(self) -> Dialogue:
        try:
            return self.in_words()
        except UpdateError:
            return self

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        """How Hypothesis and notebooks print it: in a line, not with all its states."""
        printer.text(repr(self))


def play(game: Game, given: Iterable[object]) -> Dialogue:
    """The dialogue in which all of this is given to the game, up to the first fault.

    >>> from ttr import Basic, Ind, ListOf, rectype, replace
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


def give(game: Game, before: Run, given: object) -> Trial:
    """The trial in which one thing is given to the game after a run.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = theory.games["notes"]
    >>> print(give(notes, notes.begin(), "ann").after.state)
    {heard = [ann]}
    """
    before = before._replace(trace=())
    seen = snapshot(before.state)
    turn, fault = _attempt(game, before, given)
    return Trial(given, before, turn, fault, first_change(seen, before.state))


def _attempt(
    game: Game, before: Run, given: object
) -> tuple[Turn | None, Exception | None]:
    """The turn, or what went wrong; neither where the game does not take it."""
    try:
        event = event_heard(game, given)
    except TTRError:
        return None, None
    except Exception as error:
        return None, error
    try:
        return game.take(before, event), None
    except NotHeardError:
        return None, None
    except Exception as error:
        return None, error if _can_happen(event, before.model) else None


def event_heard(game: Game, given: object) -> object:
    """The event that the game hears a text as; anything else is the event itself.

    Raises `TTRError` for a text that is not understood.
    """
    if isinstance(given, str) and game.hear is not None:
        return game.hear(given)
    return given


def _can_happen(event: object, model: Model) -> bool:
    """Can an event of this type be created? What is no type just happens."""
    if not isinstance(event, TypeNode):
        return True
    try:
        model.create(event)
    except TTRError:
        return False
    return True
