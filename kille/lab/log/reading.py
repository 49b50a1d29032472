"""Reading a log: its dialogues in the order of the study, however they ended.

A log can be read while another writes to it, and where nothing can be written.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, TypeVar

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.log.about import About, about_in
from kille.lab.log.cells import read_cells
from kille.lab.log.folders import FILE, connect, explain_errors, reading_mode
from kille.lab.log.outcomes import Broken, Finished, Outcome, RunError
from kille.lab.log.schema import check_ours, check_rows, table
from kille.lab.study import Run, Study
from kille.safety.databases import printable_name
from ttr.safety.consent import Consent

NO_PYTHON = Consent(python=False)
"""What a user consents to who names a log."""

Row = TypeVar("Row", Turn, Answer)


def read(folder: Path) -> Iterator[Finished]:
    """All dialogues that were played to their end, in the order of the study.

    RunError where there is no log.

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
    ...     [str(it.run) for it in read(Path(folder))]
    ['plain/ann/table/1']
    """
    for it in outcomes(folder):
        if isinstance(it, Finished):
            yield it


def broken_runs(folder: Path) -> tuple[Broken, ...]:
    """All dialogues that broke, in the order of the study.

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
    ...     broken_runs(Path(folder))
    ()
    """
    with _open_log(folder) as connection:
        rows = connection.execute(f"{_RUNS} WHERE reason <> '' ORDER BY place")
        return tuple(_read_broken(row) for row in rows)


def outcomes(folder: Path) -> Iterator[Outcome]:
    """What became of all runs so far, in the order of the study.

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
    ...     [it.seconds for it in outcomes(Path(folder))]
    [0.5]
    """
    with _open_log(folder) as connection:
        rows = connection.execute(f"{_RUNS} ORDER BY place")
        for row in rows:
            yield _read_outcome(connection, row)


def find_outcome(folder: Path, name: str) -> Outcome:
    """Find what became of a run by its name, or by its number from 1.

    RunError where there is no such run in the log.

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
    ...     print(find_outcome(Path(folder), "1").run)
    plain/ann/table/1
    """
    with _open_log(folder) as connection:
        for row in connection.execute(f"{_RUNS} ORDER BY place"):
            if name in (str(row[0] + 1), str(Run(*row[1:5]))):
                return _read_outcome(connection, row)
        example = connection.execute(f"{_RUNS} ORDER BY place LIMIT 1").fetchone()
    hint = "none is over yet" if example is None else f"one is {Run(*example[1:5])}"
    raise RunError(f"there is no dialogue {name} in {folder}: {hint}")


def count_outcomes(folder: Path) -> int:
    """Count the runs that are over, finished or broken.

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
    ...     count_outcomes(Path(folder))
    1
    """
    with _open_log(folder) as connection:
        (found,) = connection.execute("SELECT count(*) FROM runs").fetchone()
        return int(found)


def about(folder: Path) -> About:
    """What the log in a folder is of; RunError where there is none.

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
    ...     about(Path(folder)).planned
    1
    """
    with _open_log(folder) as connection:
        return about_in(connection, folder)


def fact_names(folder: Path) -> tuple[str, ...]:
    """The names of all facts that were counted, sorted."""
    with _open_log(folder) as connection:
        found = connection.execute("SELECT DISTINCT facts FROM runs").fetchall()
    return tuple(sorted({name for (it,) in found for name in json.loads(it)}))


def study(folder: Path, consent: Consent = NO_PYTHON) -> Study:
    """The study that the log in a folder is of, read from the text that was kept.

    A log says itself where its files are. So none of the Python that it names may be
    run, unless there is consent to that.

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
    ...     study(Path(folder)).title
    'Cups'
    """
    from kille.lab.study_files import parse

    it = about(folder)
    return parse(it.source, it.file, consent)


_RUNS = """
    SELECT place, theory, tutor, scene, seed, seconds, lessons, facts, reason, trace
    FROM runs
"""


def _read_outcome(connection: sqlite3.Connection, row: tuple[Any, ...]) -> Outcome:
    place, *run, seconds, lessons, facts, reason, _ = row
    if reason:
        return _read_broken(row)
    played = Played(
        _read_rows(connection, place, Turn),
        _read_rows(connection, place, Answer),
        lessons,
        json.loads(facts),
    )
    return Finished(Run(*run), played, seconds)


def _read_broken(row: tuple[Any, ...]) -> Broken:
    _, *run, seconds, _, _, reason, trace = row
    return Broken(Run(*run), reason, trace, seconds)


def _read_rows(
    connection: sqlite3.Connection, place: int, of: type[Row]
) -> tuple[Row, ...]:
    told = f"SELECT * FROM {table(of)} WHERE run = ? ORDER BY line"
    return tuple(read_cells(of, row[2:]) for row in connection.execute(told, (place,)))


@contextmanager
def _open_log(folder: Path) -> Iterator[sqlite3.Connection]:
    path = folder / FILE
    if not path.is_file():
        raise RunError(
            f"there is no {FILE} in {folder}: name a folder of results, such as "
            f"kille experiment run makes"
        )
    with (
        explain_errors(folder),
        closing(connect(path, reading_mode(path))) as connection,
    ):
        check_ours(connection, folder)
        check_rows(connection, folder)
        try:
            yield connection
        except (ValueError, TypeError, KeyError, RecursionError) as error:
            raise RunError(
                f"{path} is damaged ({printable_name(str(error))}): put back a copy"
            ) from error
