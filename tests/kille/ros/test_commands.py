"""`kille ros` on a bus within this process."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from queue import Queue
from typing import Any

import pytest

from kille.bus import LocalBus, Text
from kille.interfaces.init import init
from kille.interfaces.ros import run_nodes
from kille.nodes.topics import SYSTEM_OUTPUT, USER_INPUT
from ttr.safety.consent import Consent

WAIT = 60.0

OWN = """\
from pathlib import Path
Path(__file__).with_name("ran").touch()
RULES = []
"""

STUDY = """\
title = "Greetings"
seeds = 1
[theories.own]
rules = "own.py:RULES"
[tutors.Ann]
kind = "simulated"
[scenes.table]
kind = "around"
[[phases]]
do = "teach"
"""


class Node(LocalBus):
    """A bus with parameters, on which a tutor says hello until the node may end."""

    node = "kille"

    def __init__(self, parameters: Mapping[str, Any]) -> None:
        super().__init__()
        self._parameters, self.answers = parameters, Queue[Text]()
        self.subscribe(SYSTEM_OUTPUT, self.answers.put)

    def parameter(self, name: str, default: Any) -> Any:
        return self._parameters.get(name, default)

    def wait(self) -> None:
        self.publisher(USER_INPUT).publish(Text("Hello."))
        self.answer = self.answers.get(timeout=WAIT).text


def run(
    options: Mapping[str, Any],
    parameters: Mapping[str, Any],
    consent: Consent = Consent(),  # noqa: B008
) -> tuple[int, str]:
    """The exit code of a robot that runs as nodes, and what it says to hello."""
    nodes: list[Node] = []

    def opened(name: str, arguments: Sequence[str]) -> Node:
        nodes.append(Node(parameters))
        return nodes[0]

    code = run_nodes(opened, "dialogue", options, [], consent)
    return code, getattr(nodes[0], "answer", "")


@pytest.fixture
def mine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder whose robot answers a greeting with a farewell, and a study."""
    monkeypatch.setenv("KILLE_MEMORY", str(tmp_path / "memory.db"))
    folder = tmp_path / "mine"
    init(folder, "en")
    types = folder / "tutor.ttr"
    text = types.read_text("utf-8")
    new = text.replace("e : greet_back(spkr, addr)", "e : part(spkr, addr)")
    assert new != text
    types.write_text(new, "utf-8")
    (folder / "study.toml").write_text(STUDY)
    (folder / "own.py").write_text(OWN)
    return folder


def test_the_theory_is_an_option_or_a_parameter(mine: Path) -> None:
    named = {"theory": str(mine)}
    assert run({}, {}) == (0, "Hello.")
    assert run(named, {}) == (0, "Goodbye.")
    assert run({}, named) == (0, "Goodbye.")


def test_what_is_no_theory_is_reported_in_a_line(
    mine: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    assert run({"theory": str(mine / "nowhere")}, {}) == (2, "")
    (line,) = capsys.readouterr().err.splitlines()
    assert "is no theory: expected FILE.ttr, a folder or STUDY.toml:NAME" in line


def test_python_runs_for_an_option_and_never_for_a_parameter(
    mine: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    named = {"theory": f"{mine / 'study.toml'}:own"}
    assert run({}, named) == (2, "")
    assert "own.py" in capsys.readouterr().err
    assert run(named, {}, Consent(python=False)) == (2, "")
    assert not (mine / "ran").exists()
    assert run(named, {}) == (2, "")
    assert "own.py:RULES has no rule" in capsys.readouterr().err
    assert (mine / "ran").exists()
