"""What is imported, and what must not be."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
CODE = sorted(
    file
    for folder in ("ttr", "kille", "grammars", "examples", "benchmarks", "tools")
    for file in (ROOT / folder).rglob("*.py")
)

# What reads these runs whatever the file says.
UNSAFE = {"pickle", "cPickle", "dill", "cloudpickle", "joblib", "shelve", "marshal"}


def imported(*statements: str) -> set[str]:
    """The packages that a new Python holds after these statements."""
    listing = "import sys; print(*{name.partition('.')[0] for name in sys.modules})"
    run = subprocess.run(
        [sys.executable, "-c", "\n".join([*statements, listing])],
        capture_output=True,
        text=True,
        check=True,
    )
    return set(run.stdout.split())


def test_the_theory_needs_no_numerics() -> None:
    assert imported("import ttr").isdisjoint({"kille", "numpy", "cv2", "sklearn"})


SCRIPTS = [*(ROOT / "benchmarks").glob("*.py"), *(ROOT / "tools").rglob("*.py")]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_what_a_script_imports_is_there(script: Path) -> None:
    """Nobody runs benchmarks every day, and type checkers do not look into them."""
    missing = [
        f"{node.module}.{alias.name}"
        for node in ast.walk(ast.parse(script.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom)
        if (node.module or "").partition(".")[0] in {"ttr", "kille", "tools"}
        for alias in node.names
        if not is_importable(str(node.module), alias.name)
    ]
    assert not missing


def is_importable(module: str, name: str) -> bool:
    """Is this a name or a module in that module?"""
    try:
        return hasattr(import_module(module), name) or bool(
            import_module(f"{module}.{name}")
        )
    except ModuleNotFoundError as error:
        return not str(error.name).startswith(("ttr", "kille", "tools"))


@pytest.mark.parametrize("module", ["kille", "kille.memory", "kille.scene"])
def test_what_does_not_see_loads_no_eyes(module: str) -> None:
    assert imported(f"import {module}").isdisjoint({"cv2", "sklearn", "scipy"})


def imports(tree: ast.Module, known: set[str]) -> Iterator[str]:
    """What a module imports of the known ones, inside functions too.

    What only types ask for is left out.
    """
    waiting: list[ast.AST] = [tree]
    while waiting:
        match waiting.pop():
            case ast.If(test=ast.Name("TYPE_CHECKING"), orelse=orelse):
                waiting += orelse
            case ast.Import(names=names):
                yield from (it.name for it in names if it.name in known)
            case ast.ImportFrom(module=str(source), names=names):
                inner = {f"{source}.{it.name}" for it in names} & known
                yield from inner
                if source in known and len(inner) < len(names):
                    yield source
            case node:
                waiting += ast.iter_child_nodes(node)


@pytest.mark.parametrize("package", ["ttr", "kille", "tools"])
def test_no_module_imports_itself_by_way_of_others(package: str) -> None:
    files = {
        ".".join(file.relative_to(ROOT).with_suffix("").parts): file
        for file in sorted((ROOT / package).rglob("*.py"))
    }
    files = {name.removesuffix(".__init__"): file for name, file in files.items()}
    graph = {
        name: {*imports(ast.parse(file.read_text("utf-8")), {*files})} - {name}
        for name, file in files.items()
    }
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" imports ".join(error.args[1][::-1]))


def unsafe_uses(tree: ast.Module) -> Iterator[str]:
    """What a module has to do with pickles, in any of their forms."""
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                modules = {alias.name.partition(".")[0] for alias in names}
                yield from modules & UNSAFE
            case ast.ImportFrom(module=str(module)):
                yield from {module.partition(".")[0]} & UNSAFE
            case ast.keyword(arg="allow_pickle", value=ast.Constant(value=True)):
                yield "allow_pickle"


@pytest.mark.parametrize(
    "text",
    [
        "import pickle",
        "from pickle import loads",
        "def f():\n    import joblib.externals as j",
        "numpy.load(file, allow_pickle=True)",
    ],
)
def test_a_pickle_is_found(text: str) -> None:
    assert list(unsafe_uses(ast.parse(text)))


BETWEEN_PROCESSES = {
    "kille/sensors/kinect/channel.py",
    *(f"kille/lab/running_studies/{it}.py" for it in ("clusters", "local", "workers")),
}
"""What is sent between processes that one has started, or that one trusts to play."""


READ_AS_DATA = {
    "kille/dialogue/theory_cache.py",
    "kille/perception/networks/torch_files.py",
}
"""What reads a pickle without running what it names: only arrays, only theories."""


def test_nothing_is_pickled_but_between_processes() -> None:
    uses = {
        str(file.relative_to(ROOT)): list(unsafe_uses(ast.parse(file.read_bytes())))
        for file in CODE
    }
    assert {file for file, found in uses.items() if found} == (
        BETWEEN_PROCESSES | READ_AS_DATA
    )
