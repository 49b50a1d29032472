"""What the default install leaves out is asked for in one line where it is needed."""

from __future__ import annotations

import ast
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from kille import extras
from kille.interfaces.cli import main
from kille.lab.study import Theory
from kille.lab.study_files.learners import learner_problems

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
MODULES = {it for modules in extras.NEEDED.values() for it in modules}


@pytest.fixture
def without_extras(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if nothing were installed that the default install leaves out."""
    monkeypatch.setattr(extras, "find_spec", lambda name: None)


@pytest.mark.parametrize(
    "command",
    [
        ["evaluate", "objects"],
        ["evaluate", "relations"],
        ["experiment", "run", "study.toml"],
        ["experiment", "resume", "study.results"],
        ["experiment", "report", "study.results"],
        ["experiment", "replay", "study.results"],
        ["experiment", "compare", "one.results", "other.results"],
    ],
    ids=" ".join,
)
@pytest.mark.usefixtures("without_extras")
def test_a_command_says_in_one_line_what_to_install(
    command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(command) == 2
    named = " ".join(command[:1] if command[0] == "evaluate" else command[:2])
    assert capsys.readouterr().err == (
        f"kille: kille {named} needs SciPy, scikit-learn, joblib: "
        "pip install 'kille[experiments]'\n"
    )


@pytest.mark.usefixtures("without_extras")
def test_so_does_the_check_of_a_theory_with_the_papers_learner() -> None:
    theory = Theory("paper", learners={"relation": "kille"})
    [problem] = learner_problems(theory, {"whole"})
    assert problem.what == (
        "the method kille failed: the paper's learner of spatial words needs SciPy, "
        "scikit-learn, joblib: pip install 'kille[experiments]'"
    )


def test_an_extra_brings_what_is_needed_of_it() -> None:
    brings = packages_distributions()
    for extra, modules in extras.NEEDED.items():
        required = " ".join(PROJECT["optional-dependencies"][extra])
        always = " ".join(PROJECT["dependencies"])
        for module in modules:
            assert any(it in required for it in brings[module])
            assert not any(it in always for it in brings[module])


def imports_on_loading(tree: ast.Module) -> Iterator[str]:
    """The packages that a module imports when it is loaded, but for types alone."""
    for node in tree.body:
        match node:
            case ast.Import(names=names):
                yield from (it.name.partition(".")[0] for it in names)
            case ast.ImportFrom(module=str(module)):
                yield module.partition(".")[0]


def test_no_module_needs_it_to_be_loaded() -> None:
    files = [it for room in ("ttr", "kille") for it in (ROOT / room).rglob("*.py")]
    loading = {
        str(file.relative_to(ROOT)): MODULES
        & {*imports_on_loading(ast.parse(file.read_text("utf-8")))}
        for file in files
    }
    assert not {file: found for file, found in loading.items() if found}


def test_a_lesson_does_without_it() -> None:
    lesson = f"""
import sys
sys.modules.update(dict.fromkeys({sorted(MODULES)}))
from kille.agent.agent import Agent
with Agent("synthetic:empty") as robot:
    robot.do("show cup")
    robot.hear("This is a cup.")
    print(robot.hear("What is this?"))
"""
    run = subprocess.run(
        [sys.executable, "-c", lesson], capture_output=True, text=True, check=False
    )
    assert (run.stdout, run.stderr) == ("This is a cup.\n", "")
