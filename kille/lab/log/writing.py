"""Writing a log: each dialogue is one transaction.

So a kill at any moment leaves a dialogue whole or not there.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any, Self

from kille.lab.dialogues import Answer, Turn
from kille.lab.log.about import about_in, about_rows, check_same
from kille.lab.log.cells import cells
from kille.lab.log.folders import FILE, connect, explain_errors, lock_folder
from kille.lab.log.outcomes import Broken, Finished, Outcome, broken_run
from kille.lab.log.schema import check_rows, is_empty, make, marks, table
from kille.lab.study import Run, Study
from kille.safety.private_files import create_private_file
from ttr.aliases import Alias


class Log:
    """The log of a study that is open to write; `open` makes or continues one.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.log import Finished, Log
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with Log.open(cups, Path(folder)) as log:
    ...         for run in cups.runs():
    ...             _ = log.write(Finished(run, Played((), ()), 0.5))
    ...     (Path(folder) / "log.db").exists()
    True
    """

    def __init__(self, study: Study, folder: Path, connection: sqlite3.Connection):
        self.folder = folder
        self._connection = connection
        self._places = {run: place for place, run in enumerate(study.runs())}

    @classmethod
    @contextmanager
    def open(cls, study: Study, folder: Path) -> Iterator[Self]:
        """Open the log of a study in a folder, for one writer at a time.

        RunError where another study's log is there, where another writes to it, or
        where it cannot be written.
        """
        with (
            lock_folder(folder),
            closing(_open_connection(study, folder)) as connection,
        ):
            yield cls(study, folder, connection)
            # One file is easier to keep; what still reads it may leave it as it is.
            with suppress(sqlite3.OperationalError):
                connection.execute("PRAGMA journal_mode = DELETE")

    def reasons(self) -> Mapping[Run, str]:
        """Why each run that is over broke; empty for those that did not."""
        told = "SELECT theory, tutor, scene, seed, reason FROM runs ORDER BY place"
        rows: list[tuple[Any, ...]] = self._connection.execute(told).fetchall()
        return {Run(*run): reason for *run, reason in rows}

    def forget_broken(self) -> int:
        """Delete all broken runs, so that they are played again; how many."""
        told = "DELETE FROM runs WHERE reason <> ''"
        with explain_errors(self.folder), self._connection:
            return self._connection.execute(told).rowcount

    def write(self, outcome: Outcome) -> Outcome:
        """Write what became of a run, all of it or nothing; return what was written.

        A dialogue with something in it that cannot be kept, such as a tutor's half of a
        character, is a broken one.
        """
        try:
            self._write(outcome)
        except (TypeError, ValueError, OverflowError) as error:
            outcome = broken_run(outcome.run, error, outcome.seconds)
            self._write(outcome)
        return outcome

    def _write(self, outcome: Outcome) -> None:
        place = self._places[outcome.run]
        with explain_errors(self.folder), self._connection:
            match outcome:
                case Finished(run, played, seconds):
                    facts = json.dumps(dict(played.facts), ensure_ascii=False)
                    self._insert_run(place, run, seconds, played.lessons, facts, "", "")
                    self._insert_rows(place, Turn, played.turns)
                    self._insert_rows(place, Answer, played.answers)
                case Broken(run, reason, trace, seconds):
                    self._insert_run(
                        place, run, seconds, 0, "{}", reason or "broken", trace
                    )

    def _insert_run(self, place: int, run: Run, *rest: object) -> None:
        values = (place, run.theory, run.tutor, run.scene, run.seed, *rest)
        self._connection.execute(f"INSERT INTO runs VALUES ({marks(values)})", values)

    def _insert_rows(self, place: int, of: type, rows: Sequence[Turn | Answer]) -> None:
        found = [(place, number, *cells(row)) for number, row in enumerate(rows)]
        if found:
            told = f"INSERT INTO {table(of)} VALUES ({marks(found[0])})"
            self._connection.executemany(told, found)

    opened = Alias("open")
    over = Alias("reasons")


def _open_connection(study: Study, folder: Path) -> sqlite3.Connection:
    """Connect to the log of this study, and make it if there is none."""
    with explain_errors(folder):
        create_private_file(folder / FILE)
        connection = connect(folder / FILE)
        try:
            _prepare(connection, study, folder)
        except BaseException:
            connection.close()
            raise
    return connection


def _prepare(connection: sqlite3.Connection, study: Study, folder: Path) -> None:
    # First of all: another program's database stays as it is.
    if is_empty(connection):
        _create_log(connection, study, folder)
    else:
        check_same(about_in(connection, folder), study, folder)
        check_rows(connection, folder)
    connection.execute("PRAGMA journal_mode = WAL")
    # A kill loses nothing; a loss of power may lose the last dialogues, whole ones.
    connection.execute("PRAGMA synchronous = NORMAL")
    connection.execute("PRAGMA foreign_keys = ON")


def _create_log(connection: sqlite3.Connection, study: Study, folder: Path) -> None:
    """Create the tables of a new log, and write what it is of."""
    with connection:
        connection.execute("BEGIN IMMEDIATE")
        make(connection)
        rows = about_rows(study, folder).items()
        connection.executemany("INSERT INTO about VALUES (?, ?)", rows)
