"""Replaying a log: the same events again; is everything else the same, too?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ttr.aliases import Alias
from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.dialogues.logs.entries import Entry, LogError
from ttr.dialogues.logs.learned_facts import Fact, new_facts, restore_facts
from ttr.dialogues.logs.log_reader import Log
from ttr.dialogues.logs.log_writer import LogFile, rule_field
from ttr.dialogues.settings import Setting
from ttr.dialogues.stories.story_writer import format_story, turn_lines
from ttr.errors import TTRError
from ttr.probability import Degree
from ttr.showing import NotebookValue, Part, Text, below
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.records import differences, value_at
from ttr.types.syntax import Basic, PType
from ttr.updates import Run, Step, Turn, nbest


@dataclass(frozen=True)
class Divergence(NotebookValue):
    """The first difference of a log and its replay: what differs, and both values.

    >>> print(Divergence("a.jsonl:3", "the state", "{qud = []}", "{qud = [q1]}"))
    a.jsonl:3: the state differs
        logged: {qud = []}
         found: {qud = [q1]}
    """

    place: str
    what: str
    logged: str
    found: str

    def _shown_as_(self) -> Part:
        return Text(str(self), "code")

    def __str__(self) -> str:
        return (
            f"{self.place}: {self.what} differs\n"
            f"    logged: {self.logged}\n"
            f"     found: {self.found}"
        )


@dataclass(frozen=True)
class Replayed(NotebookValue):
    """A log that was replayed: the dialogue, and where it differs, if it does.

    It ends with the first turn that differs.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(notes.game, ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> replay(log, notes).divergence is None
    True
    """

    dialogue: Dialogue
    divergence: Divergence | None

    start = Alias("dialogue.start")
    moments = Alias("dialogue.trials")
    run = Alias("dialogue.now")

    def _shown_as_(self) -> Part:
        if self.divergence is None:
            verdict = Text("replayed as it was", "yes")
        else:
            verdict = Text(f"differs at {self.divergence.place}", "no")
        return below(verdict, self.dialogue._shown_as_())


def replay(log: Log, setting: Setting, *, from_: int = 0) -> Replayed:
    """Plays the events of a log again, from the state after one of its turns.

    The state and the facts of that turn are taken from the log, and all later turns are
    compared. Raises `LogError` where the log has no such turn, or cannot be taken up
    there.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(notes.game, ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> print(replay(log, notes).dialogue.now.state)
    {heard = [ann]}
    """
    now = start = run_after(log, setting, from_)
    trials: list[Trial] = []
    divergence: Divergence | None = None
    for entry in log.entries[from_:]:
        turn, divergence = _replay_turn(log, entry, setting, now)
        if turn is not None:
            now = turn.run
            trials.append(Trial.of(turn, setting, entry.line))
        if divergence is not None:
            break
    ending = "" if divergence is None else str(divergence)
    dialogue = Dialogue(
        setting.game, tuple(trials), _title(log), setting, start, ending
    )
    return Replayed(dialogue, divergence)


def run_after(log: Log, setting: Setting, turn: int) -> Run:
    """The state and the model after a turn of a log; turn 0 is the start.

    Raises `LogError` where the log has no such turn, or does not say all of it.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(notes.game, ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> print(run_after(log, notes, 0).state, run_after(log, notes, 1).state)
    {heard = []} {heard = [ann]}
    """
    if not 0 <= turn <= len(log.entries):
        raise LogError(
            f"{log.file}: there is no turn {turn}: the dialogue has {len(log.entries)}"
        )
    model = setting.game.model
    for entry in log.entries[:turn]:
        if not entry.whole:
            raise LogError(
                f"{log.place(entry.turn)} has changed the model by more than facts, so "
                "that the log can be replayed from its start only"
            )
        facts = [_read_fact(log, entry, *judged) for judged in entry.judged]
        try:
            model = restore_facts(model, facts, entry.names)
        except TTRError as error:
            place = log.place(entry.turn)
            raise LogError(f"{place}: the facts cannot be: {error.message}") from error
    text = log.entries[turn - 1].state if turn else log.header.start
    return Run(_read_state(log, turn, text), model, ())


def continue_log(log: Log, setting: Setting) -> tuple[LogFile, Run]:
    """A log file to write on, and the state and the model at the log's end.

    The beginning of a turn that was cut off is removed. Raises `LogError`.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann, bo : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "a.jsonl")
    ...     write_log(path, [play(notes.game, ["ann"])])
    ...     [log] = read_logs(path)
    ...     file, so_far = continue_log(log, notes)
    ...     with file:
    ...         file.write(notes.game.take(so_far, "bo"))
    ...     print(read_logs(path)[0].entries[-1].state)
    {heard = [bo, ann]}
    """
    run = run_after(log, setting, len(log.entries))
    turns = len(log.entries)
    file = LogFile.resume(Path(log.file), setting, turns, run, log.declared)
    return file, run


def story_of(log: Log, setting: Setting, folder: Path | None = None) -> str:
    """The text of the story that a log tells, as a file in a folder would have it.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory, "notes.ttr notes")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(notes.game, ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> print(story_of(log, notes))
    --- a dialogue
    @ game notes.ttr notes
    U> ann
    """
    if folder is not None:
        reference = setting.reference_from(folder)
        setting = replace(setting, reference=reference, folder=folder)
    usual = notation(setting.game.start) == log.header.start
    start = None if usual else _read_state(log, 0, log.header.start)
    lines = [format_story(_title(log), [], setting, start=start)]
    for entry in log.entries:
        said = [words for _, words in entry.said]
        lines += [f"{line}\n" for line in turn_lines(entry.line, said)]
    return "".join(lines)


def _title(log: Log) -> str:
    return log.header.title or "a dialogue"


# --- one turn ------------------------------------------------------------------------


def _replay_turn(
    log: Log, entry: Entry, setting: Setting, now: Run
) -> tuple[Turn | None, Divergence | None]:
    event = _read_event(log, entry)
    place = log.place(entry.turn)
    try:
        turn = setting.game.take(now, event)
    except TTRError as error:
        return None, Divergence(place, "the turn", "no error", error.message)
    for what, logged, found in _differences(log, entry, now, turn):
        return turn, Divergence(place, what, logged, found)
    return turn, None


def _differences(
    log: Log, entry: Entry, now: Run, turn: Turn
) -> Iterator[tuple[str, str, str]]:
    """The differences in a turn: in what, as logged, and as found."""
    rules = [one["rule"] for one in entry.rules]
    ran = [step.rule.name for step in turn.trace]
    if rules != ran:
        yield "which rules ran", ", ".join(rules) or "none", ", ".join(ran) or "none"
    moves = [T for T, _ in entry.said]
    made = [notation(move.type) for move in turn.said]
    if moves != made:
        yield (
            "what was said",
            ", ".join(moves) or "nothing",
            ", ".join(made) or "nothing",
        )
    if entry.state != notation(turn.state):
        yield _first_difference(_read_state(log, entry.turn, entry.state), turn.state)
    for one, step in zip(entry.rules, turn.trace, strict=True):
        yield from _step_differences(one, step)
    facts = tuple(_read_fact(log, entry, *judged) for judged in entry.judged)
    new = new_facts(now.model, turn.model)
    if facts != new:
        yield "what was judged", _list_facts(facts), _list_facts(new)
    if entry.names != turn.model.facts.created:
        count = turn.model.facts.created
        yield "how many names were given", str(entry.names), str(count)


def _step_differences(
    one: Mapping[str, Any], step: Step
) -> Iterator[tuple[str, str, str]]:
    """The differences in what a rule did."""
    name, other = step.rule.name, rule_field(step)
    if one["event"] != other["event"]:
        yield f"what {name} took", str(one["event"]), other["event"]
    if one["with"] != other["with"]:
        logged, found = (_list_bindings(some["with"]) for some in (one, other))
        yield f"what {name} bound", logged, found
    if one["changes"] != other["changes"]:
        logged, found = ("; ".join(some["changes"]) for some in (one, other))
        yield f"what {name} changed", logged, found


def _list_bindings(bound: Mapping[str, object]) -> str:
    return ", ".join(f"{label} = {value}" for label, value in bound.items()) or "none"


def _list_facts(facts: Iterable[Fact]) -> str:
    told = (f"{notation(one.sit)} : {one.type} {one.p}" for one in facts)
    return ", ".join(told) or "nothing"


def _first_difference(logged: Record, found: Record) -> tuple[str, str, str]:
    path = next(differences(logged, found), "").partition(":")[0]
    return f"the state at {path}", _notation_at(logged, path), _notation_at(found, path)


def _notation_at(state: Record, path: str) -> str:
    value = value_at(state, path)
    return "nothing" if value is None else notation(value)


# --- values --------------------------------------------------------------------------


def _read_event(log: Log, entry: Entry) -> object:
    match entry.event:
        case None:
            return None
        case str(text):
            return _read_value(log, entry.turn, "the event", text)
    pairs = [
        (_read_value(log, entry.turn, "the event", text), p) for text, p in entry.event
    ]
    try:
        return nbest(*pairs)
    except TTRError as error:
        raise LogError(f"{log.place(entry.turn)}: {error.message}") from error


def _read_fact(log: Log, entry: Entry, sit: str, T: str, lo: float, hi: float) -> Fact:
    found = _read_value(log, entry.turn, "a fact", T)
    if not isinstance(found, Basic | PType):
        raise LogError(f"{log.place(entry.turn)}: no fact is of the type {T}")
    return Fact(_read_value(log, entry.turn, "a fact", sit), found, Degree(lo, hi))


def _read_state(log: Log, turn: int, text: str) -> Record:
    found = _read_value(log, turn, "the state", text)
    if isinstance(found, Record):
        return found
    raise LogError(f"{log.place(turn)}: the state is no record, but {text[:60]}")


def _first_line(error: TTRError) -> str:
    return error.message.partition("\n")[0]


def _read_value(log: Log, turn: int, what: str, text: str) -> Object:
    try:
        return log.declared.read_value(text, log.file)
    except TTRError as error:
        raise LogError(
            f"{log.place(turn)}: {what} cannot be read: {_first_line(error)}"
        ) from error
