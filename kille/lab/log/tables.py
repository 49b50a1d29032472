"""The dialogues of a study as tables in tidy form: one line for each thing observed.

They are written from the log in the order of the study, so that they are the same bytes
whoever played it. How long dialogues took is not the same each time, and has a table of
its own. Where pyarrow is installed, each table is written as Parquet, too.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TypeAlias

from kille.lab.dialogues import Answer, Turn
from kille.lab.log.cells import Cell, cells, columns
from kille.lab.log.outcomes import Broken, Finished, Outcome, RunError
from kille.lab.log.reading import fact_names, outcomes
from ttr.escapes import csv_line
from ttr.safety.files import why_unwritten

TEXT, INTEGER, REAL = "TEXT", "INTEGER", "REAL"
CHUNK = 10_000
"""So many rows are in one group of a Parquet file."""

Row: TypeAlias = tuple[Cell, ...]


def write_tables(folder: Path) -> tuple[Path, ...]:
    """Write all tables beside the log in a folder, and return their files.

    RunError where there is no log, or they cannot be written.

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
    ...     files = {file.name for file in write_tables(Path(folder))}
    >>> "answers.csv" in files
    True
    """
    counted = fact_names(folder)
    with ExitStack() as files:
        paths, sinks = [], []
        for name in TABLES:
            heads, rows = _MADE[name]
            kinds = {
                **_RUN,
                **heads,
                **(_fact_columns(counted) if name == "runs" else {}),
            }
            for ending, writing in _writers().items():
                path = folder / f"{name}.{ending}"
                write = files.enter_context(_write_draft(path, kinds, writing))
                paths.append(path)
                sinks.append((rows, write))
        for it in outcomes(folder):
            run = (str(it.run), *vars(it.run).values())
            for rows, write in sinks:
                write([(*run, *row) for row in rows(it, counted)])
    return tuple(paths)


def _fact_columns(names: Iterable[str]) -> dict[str, str]:
    return dict.fromkeys((f"fact_{name}" for name in names), REAL)


# --- rows ----------------------------------------------------------------------------

_Rows: TypeAlias = Callable[[Outcome, tuple[str, ...]], Iterable[Row]]


def _run_rows(it: Outcome, facts: tuple[str, ...]) -> Iterable[Row]:
    if isinstance(it, Broken):
        return [(it.reason, *(None for _ in ("lessons", "turns", "answers", *facts)))]
    played = it.played
    counts = played.lessons, len(played.turns), len(played.answers)
    return [("", *counts, *(played.facts.get(name) for name in facts))]


def _turn_rows(it: Outcome, _: tuple[str, ...]) -> Iterable[Row]:
    turns = it.played.turns if isinstance(it, Finished) else ()
    return map(cells, turns)


def _answer_rows(it: Outcome, _: tuple[str, ...]) -> Iterable[Row]:
    answers = it.played.answers if isinstance(it, Finished) else ()
    return ((*cells(one), *_derived_cells(one)) for one in answers)


def _derived_cells(it: Answer) -> Row:
    return int(it.is_right), it.margin if it.degrees else None


def _time_rows(it: Outcome, _: tuple[str, ...]) -> Iterable[Row]:
    return [(it.seconds,)]


def _heads(of: type) -> dict[str, str]:
    """The columns of turns or answers; the tutor of a turn is not that of its run."""
    prefix = f"{of.__name__.lower()}_"
    return {prefix * (it.name in _RUN) + it.name: it.kind for it in columns(of)}


_RUN = {"run": TEXT, "theory": TEXT, "tutor": TEXT, "scene": TEXT, "seed": INTEGER}
_COUNTS = dict.fromkeys(("lessons", "turns", "answers"), INTEGER)
_MADE: Mapping[str, tuple[Mapping[str, str], _Rows]] = {
    "runs": ({"broken": TEXT, **_COUNTS}, _run_rows),
    "turns": (_heads(Turn), _turn_rows),
    "answers": (
        {**_heads(Answer), "is_right": INTEGER, "margin": REAL},
        _answer_rows,
    ),
    "times": ({"seconds": REAL}, _time_rows),
}
TABLES = tuple(_MADE)
"""The names of all tables."""


# --- files ---------------------------------------------------------------------------

_Write: TypeAlias = Callable[[Sequence[Row]], object]
_Writing: TypeAlias = Callable[
    [Mapping[str, str], Path], AbstractContextManager[_Write]
]


def _writers() -> Mapping[str, _Writing]:
    if find_spec("pyarrow"):
        return {"csv": _csv, "parquet": _parquet}
    return {"csv": _csv}


@contextmanager
def _csv(kinds: Mapping[str, str], path: Path) -> Iterator[_Write]:
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(csv_line(kinds))
        yield lambda rows: file.writelines(map(csv_line, rows))


@contextmanager
def _parquet(kinds: Mapping[str, str], path: Path) -> Iterator[_Write]:
    import pyarrow as pa
    from pyarrow.parquet import ParquetWriter

    known = {TEXT: pa.string(), INTEGER: pa.int64(), REAL: pa.float64()}
    schema = pa.schema([(name, known[kind]) for name, kind in kinds.items()])
    waiting: list[Row] = []
    # By its name a file might be taken for an address on the network.
    with path.open("wb") as file, ParquetWriter(file, schema) as out:

        def write_group() -> None:
            parts = zip(schema, zip(*waiting, strict=True), strict=True)
            found = [pa.array(cells, field.type) for field, cells in parts]
            out.write_table(pa.Table.from_arrays(found, schema=schema))
            waiting.clear()

        def write(rows: Sequence[Row]) -> None:
            waiting.extend(rows)
            if len(waiting) >= CHUNK:
                write_group()

        yield write
        if waiting:
            write_group()


@contextmanager
def _write_draft(
    path: Path, kinds: Mapping[str, str], writing: _Writing
) -> Iterator[_Write]:
    """Write a draft that takes the place of the file when it is whole."""
    draft = path.with_name(f".{path.name}.part")
    try:
        with writing(kinds, draft) as write:
            yield write
        os.replace(draft, path)
    except OSError as error:
        raise RunError(why_unwritten(path, error)) from error
    finally:
        draft.unlink(missing_ok=True)
