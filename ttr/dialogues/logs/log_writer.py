"""Writing a log: a line for each turn, written in full or not at all."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import FileIO
from pathlib import Path
from typing import Any, Self

from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.dialogues.logs.entries import Entry, Header, LogError
from ttr.dialogues.logs.learned_facts import Fact, differs_by_facts_only, new_facts
from ttr.dialogues.logs.name_declarations import Declarations
from ttr.dialogues.settings import Setting
from ttr.errors import TTRError
from ttr.judging.models import Model
from ttr.safety.closing import Closing
from ttr.safety.files import why_unwritten
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.updates import NBest, Run, Step, Turn


@dataclass(frozen=True)
class _Progress:
    """How far a dialogue that is being logged has come."""

    setting: Setting
    turn: int
    model: Model
    declared: Declarations


class LogFile(Closing):
    """A log that is written turn by turn; it is its own context manager.

    A turn is written in one piece as soon as it is over, so that a process that is
    killed leaves complete turns, and at most the beginning of one more.

    >>> import tempfile
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     pred greet(Ind)
    ...     Greet := [x : Ind, e : greet(x)]
    ...     Board := [said : list(RecType)]
    ...     rule hear(s : Board, e : Greet) := [said = [Greet] : list(RecType)]
    ...     game talk({said = []} : Board) := hear
    ... ''')
    >>> talk = Setting.of(theory.games["talk"], theory, "talk.ttr talk")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with LogFile(Path(folder, "talk.jsonl")) as log:
    ...         log.begin(talk, "a greeting")
    ...         for turn in talk.game.play([theory.Greet]):
    ...             log.write(turn)
    ...     [dialogue] = read_logs(Path(folder, "talk.jsonl"))
    >>> dialogue.entries[0].state
    '{said = [[x : Ind, e : greet(x)]]}'
    """

    def __init__(self, path: Path) -> None:
        """A new log; its file is made when a dialogue begins."""
        self.path = path
        self._file: FileIO | None = None
        self._now: _Progress | None = None

    @classmethod
    def resume(
        cls, path: Path, setting: Setting, turn: int, run: Run, declared: Declarations
    ) -> Self:
        """Continues a log after the given turn of its last dialogue."""
        log = cls.__new__(cls)
        log.path = path
        with _as_log_error(path):
            log._file = file = FileIO(path, "r+")
            whole = file.readall().rfind(b"\n") + 1  # the rest was cut off
            file.seek(whole)
            file.truncate()
        log._now = _Progress(setting, turn, run.model, declared)
        return log

    def begin(
        self, setting: Setting, title: str = "", start: Run | None = None
    ) -> None:
        """Begins a dialogue, by default at the start of the game.

        Raises `LogError` where the log cannot be written.
        """
        run = start or setting.game.begin()
        statements, objects = Declarations().missing_declarations([run.state])
        declared = _declare(Declarations(), statements, objects)
        if not declared.reads_back(run.state):
            raise _no_notation("the state at the start", run.state)
        self._write(
            Header(
                setting.reference_from(self.path.parent),
                title,
                notation(run.state),
                tuple(statements),
                tuple(objects),
            )
        )
        self._now = _Progress(setting, 0, run.model, declared)

    def write(self, turn: Turn | Trial) -> None:
        """Adds a turn; raises `LogError` for an event without a notation.

        A trial that the game did not take has no turn, and is left out.
        """
        now = self._now
        if now is None:
            raise LogError(f"{self.path}: begin a dialogue before writing its turns")
        trial = turn if isinstance(turn, Trial) else Trial.of(turn, now.setting)
        if trial.turn is None:
            return
        entry, declared = _make_entry(trial.in_words(now.setting), trial.turn, now)
        self._write(entry)
        self._now = _Progress(now.setting, entry.turn, trial.turn.model, declared)

    def _write(self, line: Header | Entry) -> None:
        waiting = memoryview(_encode(f"{line.text()}\n"))
        with _as_log_error(self.path):
            if self._file is None:
                self._file = FileIO(self.path, "w")
            while waiting:  # in one piece, unless the disk is nearly full
                waiting = waiting[self._file.write(waiting) :]

    def close(self) -> None:
        """Closes the file."""
        if self._file is not None:
            self._file.close()


def write_log(path: Path, dialogues: Iterable[Dialogue]) -> None:
    """Writes the log of some dialogues; raises `LogError`.

    >>> import tempfile
    >>> from ttr import Ind, rectype
    >>> from ttr.dialogues.dialogue import play
    >>> from ttr.dialogues.logs import read_logs
    >>> from ttr.updates import Game, rule
    >>> @rule(when=rectype(), on=Ind)
    ... def see(s, e):
    ...     return s
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "eyes.jsonl")
    ...     write_log(file, [play(Game("eyes", rectype(), {}, see), [Ind, None])])
    ...     [log] = read_logs(file)
    >>> [entry.line for entry in log.entries]
    ['U> Ind', 'U>']
    """
    with LogFile(path) as log:
        for dialogue in dialogues:
            log.begin(dialogue.setting, dialogue.title, dialogue.start)
            for trial in dialogue.trials:
                log.write(trial)


@contextmanager
def _as_log_error(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise LogError(why_unwritten(path, error)) from None


def _encode(text: str) -> bytes:
    try:
        return text.encode()
    except UnicodeEncodeError as error:
        found = ascii(text[error.start : error.end])
        raise LogError(f"no log can keep the character {found}") from None


def _no_notation(what: str, value: object) -> LogError:
    shown = str(value)
    shown = shown if len(shown) < 60 else f"{shown[:60]}…"
    return LogError(f"{what} has no notation, so that no log can keep it: {shown}")


# --- entries -------------------------------------------------------------------------


def _make_entry(trial: Trial, turn: Turn, now: _Progress) -> tuple[Entry, Declarations]:
    number = now.turn + 1
    facts = new_facts(now.model, turn.model)
    values = list(_values_of(turn, facts))
    statements, objects = now.declared.missing_declarations(values)
    declared = _declare(now.declared, statements, objects)
    for event in _events(turn.event):
        if not declared.reads_back(event):
            raise _no_notation(f"the event of turn {number}", event)
    entry = Entry(
        number,
        trial.line,
        _event_field(turn.event),
        tuple(
            (notation(move.type), words)
            for move, words in zip(turn.said, trial.said, strict=True)
        ),
        tuple(map(rule_field, turn.trace)),
        notation(turn.state),
        tuple(map(_fact_field, facts)),
        turn.model.facts.created,
        differs_by_facts_only(now.model, turn.model),
        tuple(statements),
        tuple(objects),
    )
    return entry, declared


def _declare(
    before: Declarations, statements: list[str], objects: list[str]
) -> Declarations:
    try:
        return before.together_with(statements, objects)
    except TTRError as error:
        raise LogError(f"the names of this game cannot be logged: {error}") from error


def _values_of(turn: Turn, facts: tuple[Fact, ...]) -> Iterator[object]:
    """The values that must be readable from the entry."""
    yield turn.state
    yield from _events(turn.event)
    yield from (move.type for move in turn.said)
    for fact in facts:
        yield from (fact.sit, fact.type)


def _events(event: object) -> list[Any]:
    match event:
        case None:
            return []
        case NBest():
            return [alternative for alternative, _ in event]
    return [event]


def _event_field(event: Any) -> str | list[list[Any]] | None:
    match event:
        case None:
            return None
        case NBest():
            return [[notation(alternative), p] for alternative, p in event]
    return notation(event)


def rule_field(step: Step) -> dict[str, Any]:
    """What a log says of a rule that was applied."""
    return {
        "rule": step.rule.name,
        "event": "" if step.event is None else notation(step.event),
        "with": {label: notation(value) for label, value in step.bindings.items()},
        "changes": list(step.changes),
    }


def _fact_field(fact: Fact) -> tuple[str, str, float, float]:
    sit: Object = fact.sit
    return notation(sit), notation(fact.type), fact.p.lo, fact.p.hi
