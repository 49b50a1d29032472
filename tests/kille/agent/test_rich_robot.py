"""What a notebook shows of a robot, and the commands that only ask."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

import ttr
from kille import Agent
from kille.agent.commands import COMMANDS
from kille.lab.results import Estimate, Figure, Result, Table
from kille.memory import MemoryFileError
from kille.perception.shown_looks import Picture
from rich_values import check_html, check_latex
from ttr import TTRError


@pytest.fixture(scope="module")
def robot() -> Iterator[Agent]:
    with Agent(sensor="synthetic:empty?seed=7", scans=1) as robot:
        robot.do("show cup")
        robot.hear("This is a cup.")
        yield robot


def test_all_of_a_robot_is_shown(robot: Agent) -> None:
    view = robot.view
    assert view is not None
    turn = robot.exchanges[-1]
    values = [robot, view, view.look, turn, robot.state, robot.model, robot.trace[-1]]
    for value in values:
        check_html(value._repr_html_())
        assert value._repr_latex_().startswith("$")
    check_latex(ttr.latex(turn))
    shown = robot._repr_html_()
    for words in ("synthetic:empty", "This is a cup.", "it knows", "cup", "#1"):
        assert words in shown


def test_the_picture_of_a_robot_has_what_it_sees(robot: Agent, tmp_path: Path) -> None:
    turns = len(robot.exchanges)
    picture = robot.picture()
    assert len(robot.exchanges) == turns
    seen = cv2.imdecode(np.frombuffer(picture._repr_png_(), np.uint8), -1)
    assert (seen[..., ::-1] == picture.pixels).all()
    picture.save(tmp_path / "view.png")
    assert (tmp_path / "view.png").read_bytes() == picture._repr_png_()
    check_html(picture._repr_html_())
    assert picture._repr_latex_() is None
    assert robot.view is not None
    assert picture.pixels.shape == robot.view.look.frame.colour.shape
    assert (picture.pixels != robot.view.look.frame.colour).any()


def test_a_large_picture_is_small_in_a_notebook() -> None:
    noise = np.random.default_rng(3).integers(0, 255, (1500, 3000, 3), np.uint8)
    shown = Picture(noise, "noise")._repr_html_()
    (data,) = re.findall(r"base64,([^\"]*)", shown)
    small = cv2.imdecode(np.frombuffer(b64decode(data), np.uint8), -1)
    assert small.shape == (480, 960, 3)


def test_do_answers_what_only_asks(robot: Agent, tmp_path: Path) -> None:
    turns = len(robot.exchanges)
    assert robot.do("help") == COMMANDS
    assert "cup" in robot.do("things")
    assert robot.do("meaning CUP").startswith("cup (noun): ")
    assert robot.trace[-1].rule.name in robot.do("trace")
    path = tmp_path / "seen.png"
    assert robot.do(f"picture {path}") == f"The picture is in {path}."
    assert path.exists()
    assert len(robot.exchanges) == turns


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("pictrue", "no command @ pictrue: did you mean @ picture"),
        ("meaning", "@ meaning needs a word"),
        ("meaning xyzzy", "is not known"),
        ("why", "there is no reason to show"),
        ("picture /nowhere/a.png", "cannot be written to /nowhere/a.png: No such file"),
        (
            "picture a\0b.png",
            r"cannot be written to a\\x00b.png: that is no path",
        ),
        ("Pictrue", "no command @ pictrue: did you mean @ picture"),
    ],
)
def test_do_says_what_is_wrong(robot: Agent, command: str, said: str) -> None:
    with pytest.raises(TTRError, match=said):
        robot.do(command)


@pytest.mark.parametrize("command", ["Show cup", "@ show cup", "  @SHOW  cup "])
def test_do_takes_a_command_however_it_is_typed(robot: Agent, command: str) -> None:
    robot.do(command)
    assert robot.view is not None
    assert len(robot.view.look.percepts) == 1
    assert robot.do("@") == robot.do("Help") == COMMANDS


def test_a_memory_has_a_name_that_a_file_can_have() -> None:
    for name in ("a\0b.db", "a\0/b.db"):
        with pytest.raises(MemoryFileError, match="is no path of a file: name another"):
            Agent("synthetic:empty", memory=name)


def test_commands_from_elsewhere_write_nothing(robot: Agent, tmp_path: Path) -> None:
    with pytest.raises(Exception, match="unknown command `picture"):
        robot.change_scene(f"picture {tmp_path}/a.png")
    assert not list(tmp_path.iterdir())


def test_results_are_tables_and_figures() -> None:
    table = Table("scores", ("theory", "score"), (("<b>", Estimate(0.5, 0.4, 0.6)),))
    figure = Figure(
        "bars", "words", {"labels": ["cup"], "values": [0.4], "ylabel": "p"}
    )
    shown = Result("a study", (table,), (figure,), text="The text.")._repr_html_()
    check_html(shown)
    assert "&lt;b&gt;" in shown
    assert "0.500 [0.400, 0.600]" in shown
    assert "image/svg+xml" in shown or "matplotlib" in shown
