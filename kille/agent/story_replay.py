"""Play a story to a robot, and compare what it says with what is written."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path

from kille.agent.agent import Agent
from kille.dialogue.language import LANGUAGES
from kille.memory import Memory
from kille.sensors.sensor import SensorError
from ttr import Theory, TTRError
from ttr.dialogues.stories import (
    SILENCE,
    Line,
    Mismatch,
    Story,
    alternatives,
    failure_reason,
    fits,
)
from ttr.errors import UpdateError
from ttr.probability import CERTAIN
from ttr.types import TypeNode

Echo = Callable[[str], None]

Make = Callable[..., Agent]
"""Makes a robot of a sensor and a memory; `language` is that of the story."""

_DEFAULT_SCENE = "synthetic:empty"


def play(
    story: Story,
    memory: Memory | None = None,
    echo: Echo = lambda line: None,
    make: Make = Agent,
) -> Mismatch | None:
    """Play a story to a robot with this memory, by default an empty one.

    Returns the first difference, or None. `echo` gets each line as it is played; `make`
    makes the robot, by default one of the packaged theory. Raises StoryError for a line
    that cannot be played.
    """
    if story.game is not None:
        raise story.game.wrong("a story that names its game is played by `ttr play`")
    try:
        robot = make(_first_scene(story), memory, language=story_language(story))
    except SensorError as error:
        raise story.lines[0].wrong(str(error)) from error
    with robot:
        return _StoryPlayer(robot, echo).play(story)


def story_language(story: Story) -> str:
    """The language of a story, by the name of its file, as in `naming.sv.dlg`."""
    suffixes = [suffix.lstrip(".") for suffix in Path(story.lines[0].file).suffixes]
    return next((it for it in suffixes if it in LANGUAGES), LANGUAGES[0])


def _first_scene(story: Story) -> str:
    """The scene that the story begins with, so that no other is opened first."""
    first = story.lines[0]
    if first.mark == "@" and first.text.startswith("scene "):
        return _sensor_of_line(first)
    return _DEFAULT_SCENE


def _sensor_of_line(line: Line) -> str:
    """The sensor that an `@ scene` line names; a path is from the story's folder."""
    name = os.path.expandvars(line.text.removeprefix("scene ").strip())
    if unset := re.search(r"\$\{?(\w+)", name):
        raise line.wrong(f"set the variable {unset[1]} before")
    beside = Path(line.file).parent / name
    return str(beside) if not Path(name).is_absolute() and beside.exists() else name


class _StoryPlayer:
    """Plays a story; `_said` is what the robot said that the story has not yet had."""

    def __init__(self, robot: Agent, echo: Echo) -> None:
        self._robot, self._echo = robot, echo
        self._said: list[str] = []
        self._started = False

    def play(self, story: Story) -> Mismatch | None:
        for line in story.lines:
            mismatch = self._step(line)
            if mismatch is not None:
                return mismatch
        return self._left_over(story.lines[-1])

    def _step(self, line: Line) -> Mismatch | None:
        match line.mark:
            case "S>" | "S~":
                return self._compare(line)
            case "=":
                return self._judge(line)
        left_over = self._left_over(line)
        if left_over is None:
            self._happen(line)
        return left_over

    def _happen(self, line: Line) -> None:
        """The world changes, or the tutor speaks."""
        self._echo(f"{line.mark} {line.text}")
        try:
            answer = self._answer(line)
        except SensorError as error:
            raise line.wrong(str(error)) from error
        self._said = answer.split("\n") if answer else []
        for sentence in self._said:
            self._echo(f"S> {sentence}")
        self._started = True

    def _answer(self, line: Line) -> str:
        if line.mark == "U>":
            return self._robot.hear(line.text)
        if line.mark == "U~":
            return self._hear_alternatives(line)
        if not line.text.startswith("scene "):
            return self._robot.do(line.text)
        if not self._started:
            return self._robot.look()
        return self._robot.do(f"scene {_sensor_of_line(line)}")

    def _hear_alternatives(self, line: Line) -> str:
        """The robot's answer to what the tutor perhaps said."""
        said = [(it.text, it.p) for it in alternatives(line)]
        try:
            return self._robot.hear_perhaps(*said)
        except UpdateError as error:
            raise line.wrong(error.message) from error

    def _compare(self, line: Line) -> Mismatch | None:
        found = self._said.pop(0) if self._said else ""
        if line.mark == "S>" and found == line.text:
            return None
        if line.mark == "S~" and fits(line, found):
            return None
        return self._mismatch(line, line.text or SILENCE, found or SILENCE)

    def _left_over(self, line: Line) -> Mismatch | None:
        """The mismatch if the robot said more than the story has before this line."""
        if not self._said:
            return None
        expected = "nothing more to be said before this"
        return self._mismatch(line, expected, self._said[0])

    def _judge(self, line: Line) -> Mismatch | None:
        T = _type_of_state(line, self._robot.types.theory)
        judgement = self._robot.model.judge(self._robot.state, T)
        if judgement.p == CERTAIN:
            return None
        return self._mismatch(line, str(T), failure_reason(judgement))

    def _mismatch(self, line: Line, expected: str, found: str) -> Mismatch:
        latest = self._robot.exchanges[-1:]
        trace = latest[0].steps if latest else ()
        return Mismatch(line, expected, found, trace)


def _type_of_state(line: Line, theory: Theory) -> TypeNode:
    """The type in `s : T`."""
    name, colon, text = line.text.partition(":")
    if not colon or name.strip() != "s":
        raise line.wrong(
            "a judgement of the state is written `= s : T`, as in "
            "`= s : [shared : [latest : Learned]]`"
        )
    try:
        T = theory.parse(text.strip())
    except TTRError as error:
        raise line.wrong(str(error)) from None
    if not isinstance(T, TypeNode):
        raise line.wrong(f"{text.strip()} is no type of states")
    return T
