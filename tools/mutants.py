"""Do the tests of a room notice small mistakes in its code? A sample of mutants tells.

A mutant is the code with one small change: another comparison, a condition dropped, a
statement left out. Cosmic Ray makes the changes; two more operators are defined here.
Places are drawn by the seed, then one change for each. A mutant is killed when one of
the tests that reach the changed line fails, quickest tests first.

    make mutants ROOM=memory
    python tools/mutants.py memory --sample 300 --seed 0 --jobs 2

Rooms, and what tests them, are listed in pyproject.toml, in [tool.kille.rooms]. Results
are kept in .mutants/ROOM-SEED.jsonl; the same command goes on where it was stopped.
"""

from __future__ import annotations

import argparse
import ast
import difflib
import json
import os
import queue
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import tomllib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.operators.operator import Operator
from cosmic_ray.plugins import get_operator, operator_names
from parso.python.tree import Keyword

ROOT = Path(__file__).resolve().parent.parent
TESTS = 20.0
"""Seconds of tests for one mutant: the quickest that reach the changed line.

They are seconds of work, so that the choice is the same on a busy machine.
"""

_SHOWN = 60
"""Lines that are shown of tests that fail without any change."""

UNCOUNTED = ("same", "invalid")
"""Outcomes of what is no mutant."""

Span = tuple[tuple[int, int], tuple[int, int]]


# --- changes that Cosmic Ray does not make -------------------------------------------


class DropOperand(Operator):
    """Drops one side of `and` or `or`: `a and b` becomes `a`, or `b`."""

    def mutation_positions(self, node: Any) -> Iterator[Span]:
        if node.type in ("and_test", "or_test"):
            for operand in node.children[::2]:
                yield operand.start_pos, operand.end_pos

    def mutate(self, node: Any, index: int) -> Any:
        at = 2 * index
        del node.children[max(at - 1, 0) : max(at - 1, 0) + 2]
        return node

    @classmethod
    def examples(cls) -> tuple[()]:
        return ()


class DropStatement(Operator):
    """Leaves out a statement of a function, other than its docstring."""

    def mutation_positions(self, node: Any) -> Iterator[Span]:
        if node.type != "simple_stmt" or _function_around(node) is None:
            return
        statement = node.children[0]
        if statement.type not in ("string", "keyword", "import_name", "import_from"):
            yield statement.start_pos, statement.end_pos

    def mutate(self, node: Any, index: int) -> Any:
        first = node.children[0].get_first_leaf()
        node.children[0] = Keyword("pass", first.start_pos, first.prefix)
        return node

    @classmethod
    def examples(cls) -> tuple[()]:
        return ()


def _function_around(node: Any) -> Any:
    around = node.parent
    while around is not None and around.type not in ("funcdef", "classdef"):
        around = around.parent
    return None if around is None or around.type == "classdef" else around


@cache
def operators() -> Mapping[str, Operator]:
    """Every kind of change, by name."""
    theirs = [(name.partition("/")[2], get_operator(name)) for name in operator_names()]
    usable = {name: kind() for name, kind in theirs if not kind.arguments()}
    usable.pop("NoOp", None)
    return {**usable, "DropOperand": DropOperand(), "DropStatement": DropStatement()}


# --- mutants -------------------------------------------------------------------------


@dataclass(frozen=True)
class Mutant:
    """One change: which operator, and which of its places in the file."""

    file: str
    operator: str
    occurrence: int
    line: int
    last_line: int

    def mutate(self, code: str) -> str | None:
        """The file with this change."""
        new: str | None = mutate_code(code, operators()[self.operator], self.occurrence)
        return new

    def __str__(self) -> str:
        return f"{self.file}:{self.line} {self.operator} {self.occurrence}"


def mutants_by_place(file: str, code: str) -> dict[tuple[str, Span], list[Mutant]]:
    """All changes of a file, by place, but for those that no answer depends on."""
    idle = [*_idle_spans(code)]
    nodes = list(ast_nodes(get_ast(code)))
    places: dict[tuple[str, Span], list[Mutant]] = {}
    for name, operator in operators().items():
        spans = [span for node in nodes for span in operator.mutation_positions(node)]
        for occurrence, span in enumerate(spans):
            if any(start <= span[0] and span[1] <= end for start, end in idle):
                continue
            mutant = Mutant(file, name, occurrence, span[0][0], span[1][0])
            places.setdefault((file, span), []).append(mutant)
    return places


def _idle_spans(code: str) -> Iterator[Span]:
    """The parts of the code that no answer depends on.

    They are what the type checker alone reads, such as annotations and `frozen=True`;
    `strict=True` of `zip` and assertions, which say what the code around them sees to;
    what is raised where nothing gets; how much work is charged to the budget; and how
    many answers a cache keeps.
    """
    for node in ast.walk(ast.parse(code)):
        for part in _idle_parts(node):
            assert part.end_lineno is not None
            assert part.end_col_offset is not None
            yield (
                (part.lineno, part.col_offset),
                (part.end_lineno, part.end_col_offset),
            )
        for it in getattr(node, "decorator_list", ()):
            if ast.unparse(it) == "overload":
                yield (it.lineno, 0), (it.lineno + 1, 0)


def _idle_parts(node: ast.AST) -> Iterator[ast.expr | ast.stmt]:
    match node:
        case ast.FunctionDef(returns=ast.expr() as kind):
            yield kind
        case ast.AsyncFunctionDef(returns=ast.expr() as kind):
            yield kind
        case ast.arg(annotation=ast.expr() as kind) | ast.AnnAssign(annotation=kind):
            yield kind
        case ast.keyword(arg="frozen", value=value):
            yield value
        case ast.keyword(arg="strict", value=ast.Constant(value=True) as value):
            yield value
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            yield node
        case ast.Expr(value=ast.Constant(value=value)) if value is ...:
            yield node
        case ast.Assert() | ast.Raise(exc=ast.Name(id="NotImplementedError")):
            yield node
        case ast.Raise(exc=ast.Call(func=ast.Name(id="assert_never"))):
            yield node
        case ast.Call(func=ast.Name(id="spend" | "lru_cache"), args=arguments):
            yield from arguments


def sample(files: Sequence[str], size: int, seed: int) -> list[Mutant]:
    """Places drawn at random, and one change for each, by the seed alone."""
    chance = random.Random(seed)
    places = [
        changes
        for file in sorted(files)
        for changes in mutants_by_place(file, (ROOT / file).read_text()).values()
    ]
    drawn = chance.sample(places, min(size, len(places)))
    return [chance.choice(changes) for changes in drawn]


# --- tests ---------------------------------------------------------------------------

PLUGIN = """
import json, os, time
import coverage, pytest
cover = coverage.Coverage.current() or coverage.Coverage(
    data_file=None, source=os.environ["ROOM_SOURCES"].split(os.pathsep))
cover.start()
seconds, work = {}, {}
def spent_seconds():
    spent = os.times()
    return time.process_time() + spent.children_user + spent.children_system
@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item, nextitem):
    cover.switch_context(item.nodeid)
    start, before = time.perf_counter(), spent_seconds()
    try:
        return (yield)
    finally:
        seconds[item.nodeid] = time.perf_counter() - start
        work[item.nodeid] = spent_seconds() - before
        cover.switch_context("")
failed = set()
def pytest_runtest_logreport(report):
    if report.failed:
        failed.add(report.nodeid)
def pytest_sessionfinish(session):
    cover.stop()
    data = cover.get_data()
    lines = {}
    for file in data.measured_files():
        lines[os.path.relpath(file)] = {
            line: [name for name in names if name]
            for line, names in data.contexts_by_lineno(file).items()}
    with open(os.environ["ROOM_COVERAGE"], "w") as out:
        json.dump({"lines": lines, "seconds": seconds, "work": work,
                   "failed": sorted(failed)}, out)
"""


@dataclass(frozen=True)
class Reach:
    """Which tests reach which line, how long each took, and how much it worked."""

    lines: Mapping[str, Mapping[str, Sequence[str]]]
    seconds: Mapping[str, float]
    work: Mapping[str, float]

    def tests(self, mutant: Mutant) -> list[str]:
        """The tests for a mutant, quickest first; all for what runs at import."""
        lines = self.lines.get(mutant.file, {})
        span = range(mutant.line, mutant.last_line + 1)
        reached = {name for line in span for name in lines.get(str(line), ())}
        at_import = any(str(line) in lines for line in span) and not reached
        if at_import:
            reached = {name for names in lines.values() for name in names}
        chosen, spent = [], 0.0
        for name in sorted(reached, key=lambda name: (self.work[name], name)):
            spent += self.work[name]
            if chosen and spent > TESTS:
                break
            chosen.append(name)
        return chosen


def reach_of(folder: Path, tests: Sequence[str], sources: Sequence[str]) -> Reach:
    """Runs all tests of the room once, and notes which lines each runs."""
    (folder / "room_coverage.py").write_text(PLUGIN)
    out = folder / "coverage.json"
    run = subprocess.run(
        pytest_command("-p", "room_coverage", "--tb=short", *tests),
        cwd=folder,
        env={
            **environment(folder),
            "HYPOTHESIS_PROFILE": "dev",
            "ROOM_COVERAGE": str(out),
            "ROOM_SOURCES": os.pathsep.join(str(folder / one) for one in sources),
        },
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    found = json.loads(out.read_text())
    if found["failed"]:
        print("\n".join(run.stdout.splitlines()[-_SHOWN:]))
        sys.exit(f"these tests fail without any change: {', '.join(found['failed'])}")
    return Reach(found["lines"], found["seconds"], found["work"])


def pytest_command(*arguments: str) -> list[str]:
    """Pytest in this environment, until the first test fails."""
    return [
        *(sys.executable, "-m", "pytest", "-x", "-q", "--no-header", "--tb=no"),
        *("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:randomly"),
        *arguments,
    ]


def environment(folder: Path) -> dict[str, str]:
    """The variables under which the code in this folder is tested."""
    threads = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    data = {"KILLE_DATA": str(ROOT.parent / "shared" / "data")}
    return {**os.environ, **threads, **data, "CI": "1", "PYTHONPATH": str(folder)}


def copy_tree(folder: Path) -> None:
    """A copy of all files that git knows or would add."""
    names = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
        text=True,
    ).stdout.split("\0")
    for name in filter(None, names):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


# --- running -------------------------------------------------------------------------


def is_python(code: str) -> bool:
    """Can this be run at all? A star in a signature that became `<<` cannot."""
    try:
        compile(code, "<mutant>", "exec", dont_inherit=True)
    except SyntaxError:
        return False
    return True


def outcome(mutant: Mutant, folder: Path, reach: Reach) -> tuple[str, str]:
    """What became of a mutant, and its change as a diff.

    killed, timeout (also killed), survived, or unreached: no test runs the line. Not
    counted is what is the same code, or invalid: no Python, which needs no test, or a
    change that the operator announces and cannot make, such as another name for the
    dotted one in `except (OSError, csv.Error)`.
    """
    path = folder / mutant.file
    code = path.read_text()
    try:
        mutated = mutant.mutate(code)
    except AttributeError:
        return "invalid", ""
    if mutated is None or mutated == code:
        return "same", ""
    diff = "".join(
        line
        for line in difflib.unified_diff(
            code.splitlines(keepends=True), mutated.splitlines(keepends=True), n=0
        )
        if line[:3] not in ("---", "+++")
    )
    if not is_python(mutated):
        return "invalid", diff
    tests = reach.tests(mutant)
    if not tests:
        return "unreached", diff
    limit = 30 + 10 * sum(reach.seconds[name] for name in tests)
    path.write_text(mutated)
    try:
        code_of_exit = run_for(pytest_command(*tests), folder, limit)
    finally:
        path.write_text(code)
    if code_of_exit is None:
        return "timeout", diff
    return ("survived" if code_of_exit == 0 else "killed"), diff


def run_for(command: Sequence[str], folder: Path, seconds: float) -> int | None:
    """The exit code, or None after so many seconds; nothing it started is left."""
    with subprocess.Popen(
        command,
        cwd=folder,
        env=environment(folder),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as process:
        try:
            return process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)


def run_all(
    mutants: Sequence[Mutant], reach: Reach, folders: Sequence[Path], log: Path
) -> None:
    """Tries the mutants, in as many threads as there are copies of the tree."""
    waiting: queue.SimpleQueue[Mutant] = queue.SimpleQueue()
    for mutant in mutants:
        waiting.put(mutant)
    lock = threading.Lock()

    def work(folder: Path) -> None:
        while True:
            try:
                mutant = waiting.get_nowait()
            except queue.Empty:
                return
            what, diff = outcome(mutant, folder, reach)
            with lock, log.open("a") as out:
                row = {"mutant": asdict(mutant), "outcome": what, "diff": diff}
                out.write(json.dumps(row) + "\n")
                print(f"{what:9} {mutant}", flush=True)

    threads = [threading.Thread(target=work, args=(one,)) for one in folders]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def report(log: Path) -> None:
    """Prints the survivors and the score."""
    rows = [json.loads(line) for line in log.read_text().splitlines()]
    rows = [row for row in rows if row["outcome"] not in UNCOUNTED]
    left = [row for row in rows if row["outcome"] in ("survived", "unreached")]
    for row in sorted(left, key=lambda row: (row["mutant"]["file"], row["diff"])):
        print(f"\n{row['outcome']}: {Mutant(**row['mutant'])}\n{row['diff']}", end="")
    killed = len(rows) - len(left)
    print(f"\n{killed} of {len(rows)} killed ({killed / max(len(rows), 1):.1%})")


def main() -> None:
    """Reads the command line, tries the mutants, and reports."""
    warnings.simplefilter("ignore", SyntaxWarning)  # of mutants, such as `1 is x`
    rooms = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]
    rooms = rooms["kille"]["rooms"]
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("room", choices=rooms)
    parser.add_argument("--sample", type=int, default=300, help="places; default 300")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    chosen = parser.parse_args()
    room = rooms[chosen.room]
    files = [
        str(path.relative_to(ROOT))
        for pattern in room["sources"]
        for path in sorted(ROOT.glob(pattern))
    ]
    log = ROOT / ".mutants" / f"{chosen.room}-{chosen.seed}.jsonl"
    log.parent.mkdir(exist_ok=True)
    log.touch()
    done = {
        str(Mutant(**json.loads(line)["mutant"]))
        for line in log.read_text().splitlines()
    }
    mutants = sample(files, chosen.sample, chosen.seed)
    mutants = [mutant for mutant in mutants if str(mutant) not in done]
    with tempfile.TemporaryDirectory(prefix="kille-mutants-") as place:
        folders = [Path(place, str(number)) for number in range(chosen.jobs)]
        for folder in folders:
            copy_tree(folder)
        if mutants:
            print(f"{len(mutants)} mutants of {chosen.room}; first, what tests reach")
            sources = sorted({file.partition("/")[0] for file in files})
            run_all(mutants, reach_of(folders[0], room["tests"], sources), folders, log)
    report(log)


if __name__ == "__main__":
    main()
