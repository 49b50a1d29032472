"""Reading logs, up to the last complete turn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from ttr.dialogues.logs.entries import (
    Entry,
    EntryError,
    Header,
    LogError,
    read_entry,
    read_header,
)
from ttr.dialogues.logs.name_declarations import Declarations
from ttr.errors import TTRError
from ttr.safety.files import why_unread
from ttr.safety.inputs import parse_json, read_bytes
from ttr.safety.limits import LINE, LOG
from ttr.showing import Fold, NotebookValue, Part, Text, below, table


class UnreadableLogError(LogError):
    """A log that cannot be read at all: it is missing, or may not be opened.

    >>> from ttr.dialogues.logs import read_logs
    >>> read_logs(Path("nowhere.jsonl"))
    Traceback (most recent call last):
        ...
    ttr.dialogues.logs.log_reader.UnreadableLogError: there is no file nowhere.jsonl
    """


@dataclass(frozen=True)
class Log(NotebookValue):
    """A dialogue in a log: its header and turns, and where they are.

    `number` is the line of the header. `cut` says where the log is cut off in the
    middle of a turn, as when a process was killed; it is empty otherwise.

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
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(theory.games["notes"], ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> len(log.entries), len(log.until(0).entries)
    (1, 0)
    """

    file: str
    number: int
    header: Header
    entries: tuple[Entry, ...] = ()
    cut: str = ""

    @cached_property
    def declared(self) -> Declarations:
        """The declarations of all names in the log; raises `LogError`."""
        lines: list[Header | Entry] = [self.header, *self.entries]
        statements = [text for line in lines for text in line.declares]
        objects = [name for line in lines for name in line.objects]
        try:
            return Declarations().together_with(statements, objects)
        except TTRError as error:
            why = error.message.partition("\n")[0]
            raise LogError(
                f"{self.file}:{self.number}: the names declared here and below cannot "
                f"be read: {why}"
            ) from error

    def place(self, turn: int) -> str:
        """The file, the line and the number of a turn; the start is turn 0."""
        where = f"{self.file}:{self.number + turn}"
        return f"{where}: turn {turn}" if turn else f"{where}: the start"

    def _shown_as_(self) -> Part:
        def row(entry: Entry) -> tuple[Part, ...]:
            names = [str(it["rule"]) for it in entry.rules if "rule" in it]
            return (
                Text(str(entry.turn), "quiet"),
                below(
                    Text(entry.line, "strong"),
                    *[Text(f"S> {words}") for _, words in entry.said],
                ),
                Text(", ".join(names), "quiet"),
                Fold("the state", Text(entry.state, "code")),
            )

        title = self.header.title or f"a dialogue in {self.header.game}"
        return below(
            Text(title, "strong"),
            table(("", "turn", "rules", ""), self.entries, row),
            Text(self.cut, "no") if self.cut else None,
        )

    def until(self, turn: int) -> Log:
        """The log as it was after a turn."""
        return replace(self, entries=self.entries[:turn], cut="")


def read_logs(path: Path) -> tuple[Log, ...]:
    """The dialogues in a file; a last line that is cut off is left out.

    Raises `LogError` for a damaged line, and `UnreadableLogError` for a file that
    cannot be read at all.

    >>> import tempfile
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(theory.games["notes"], ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> [entry.line for entry in log.entries]
    ['U> ann']
    """
    try:
        text = read_bytes(path, LOG)
    except OSError as error:
        raise UnreadableLogError(why_unread(path, error)) from None
    *lines, rest = text.split(b"\n")
    logs = _group_lines(path, lines)
    if rest and logs:
        after = f"after turn {len(logs[-1].entries)}" if logs[-1].entries else "at once"
        told = f"{path}:{len(lines) + 1}: the log is cut off {after}"
        logs[-1] = replace(logs[-1], cut=told)
    if not logs:
        raise LogError(f"{path} is no log: it should begin with a header")
    return tuple(logs)


def _group_lines(path: Path, lines: list[bytes]) -> list[Log]:
    logs: list[Log] = []
    entries: list[Entry] = []
    for number, line in enumerate(_parse_lines(path, lines), start=1):
        if isinstance(line, Header):
            if logs:
                logs[-1] = replace(logs[-1], entries=tuple(entries))
            logs.append(Log(str(path), number, line))
            entries = []
            continue
        if not logs:
            raise LogError(f"{path} is no log: it should begin with a header")
        if line.turn != len(entries) + 1:
            raise LogError(
                f"{path}:{number}: expected turn {len(entries) + 1}, found turn "
                f"{line.turn}: lines have been moved, put in or taken out"
            )
        entries.append(line)
    if logs:
        logs[-1] = replace(logs[-1], entries=tuple(entries))
    return logs


def _parse_lines(path: Path, lines: list[bytes]) -> Iterator[Header | Entry]:
    for number, line in enumerate(lines, start=1):
        try:
            if len(line) > LINE.maximum:
                raise LogError(f"{path}:{number}: {LINE.too_much().strerror}")
            facts = parse_json(line.decode("utf-8"))
            yield read_header(facts) or read_entry(facts)
        except EntryError as fault:
            raise LogError(f"{path}:{number}: {fault}") from None
        except UnicodeDecodeError:
            raise LogError(f"{path}:{number}: this is no text in UTF-8") from None
        except ValueError:
            raise LogError(f"{path}:{number}: this is no JSON") from None
