"""What the mutation tester takes for a mutant, and what it counts."""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType

import pytest

pytest.importorskip("cosmic_ray", reason="kille[mutants] is not installed")
TOOL = Path(__file__).resolve().parent.parent / "tools" / "mutants.py"

CODE = """\
def twice(number, *, start=0):
    return start + 2 * number
"""


@pytest.fixture(scope="module")
def mutants() -> ModuleType:
    spec = importlib.util.spec_from_file_location("mutant_tester", TOOL)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


def test_a_change_that_is_no_python_is_not_tested(
    mutants: ModuleType, tmp_path: Path
) -> None:
    (tmp_path / "twice.py").write_text(CODE)
    name, no_tests = "ReplaceBinaryOperator_Mul_LShift", mutants.Reach({}, {}, {})
    outcomes = {}
    for (_, span), found in mutants.mutants_by_place("twice.py", CODE).items():
        for mutant in found:
            if mutant.operator == name:
                outcomes[span[0]] = mutants.outcome(mutant, tmp_path, no_tests)[0]
    assert outcomes == {(1, 18): "invalid", (2, 21): "unreached"}


def test_a_change_that_its_operator_cannot_make_is_not_tested(
    mutants: ModuleType, tmp_path: Path
) -> None:
    code = "try:\n    pass\nexcept (OSError, csv.Error):\n    pass\n"
    (tmp_path / "trying.py").write_text(code)
    outcomes = [
        mutants.outcome(mutant, tmp_path, mutants.Reach({}, {}, {}))[0]
        for changes in mutants.mutants_by_place("trying.py", code).values()
        for mutant in changes
        if mutant.operator == "ExceptionReplacer"
    ]
    assert outcomes == ["unreached", "invalid"]


@pytest.mark.parametrize(
    ("code", "changed", "is_tried"),
    [
        ("pairs = zip(a, b, strict=True)", "strict=False", False),
        ("pairs = zip(a, b, strict=False)", "strict=True", True),
        ("spend(2 + len(a))", "spend(3 + len(a))", False),
        ("use(2 + len(a))", "use(3 + len(a))", True),
        ("@lru_cache(4096)\ndef twice(n): return n", "cache(4097)", False),
        ("@repeat(4096)\ndef twice(n): return n", "repeat(4097)", True),
        ("def length(self) -> 2: ...", "-> 3", False),
        ("def length(self):\n    ...", "pass", False),
        ("def length(self):\n    stop()", "pass", True),
        ("def of(n):\n    assert n is not None", "pass", False),
        ("def of(n):\n    assert n is not None", "assert n is None", False),
        ("def of(n):\n    raise NotImplementedError", "pass", False),
        ("def of(n):\n    raise assert_never(n)", "pass", False),
        ("def of(n):\n    raise ValueError(n)", "pass", True),
        ("class Some:\n    @overload\n    def of(self): stop()", "overload", True),
        ("go()\n@overload\ndef of(n): return 2", "go()\ndef of", False),
        ("go()\n@property\ndef of(n): return 2", "go()\ndef of", True),
        ("class Point(Base, frozen=True): x: 3", "frozen=False", False),
        ("class Point(Base, frozen=True): x: 3", "x: 4", False),
        ("class Point(Base, open=True): x: 3", "open=False", True),
    ],
)
def test_what_no_answer_depends_on_is_left_alone(
    mutants: ModuleType, code: str, changed: str, is_tried: bool
) -> None:
    code = f"{code}\n"
    found = mutants.mutants_by_place("some.py", code).values()
    tried = [mutant.mutate(code) for several in found for mutant in several]
    tried = [one.replace("( ", "(") for one in tried]
    assert any(changed in one for one in tried) is is_tried


def test_the_tests_that_work_least_are_tried_however_long_they_waited(
    mutants: ModuleType,
) -> None:
    work = {"little": 1.0, "more": 15.0, "much": 30.0}
    lines = {"twice.py": {"2": list(work)}}
    waited = {"little": 90.0, "more": 50.0, "much": 0.0}
    mutant = mutants.Mutant("twice.py", "DropStatement", 0, 2, 2)
    assert mutants.Reach(lines, waited, work).tests(mutant) == ["little", "more"]


def test_only_mutants_are_counted(
    mutants: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = {"file": "a.py", "operator": "o", "occurrence": 0, "line": 1}
    outcomes = ("killed", "timeout", "survived", "unreached", "same", "invalid")
    log = tmp_path / "log.jsonl"
    log.write_text(
        "".join(
            json.dumps(
                {"mutant": {**place, "last_line": 1}, "outcome": one, "diff": ""}
            )
            + "\n"
            for one in outcomes
        )
    )
    mutants.report(log)
    assert capsys.readouterr().out.endswith("2 of 4 killed (50.0%)\n")
