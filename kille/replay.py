"""Playing a story to a robot, and comparing what it says with what is written."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path

from kille.agent import Agent
from kille.dialogue.meanings import theory
from kille.memory import Memory
from kille.sensors.sensor import SensorError
from kille.stories import Line, Mismatch, Story, StoryError
from ttr import TTRError, TypeNode
from ttr.probability import CERTAIN

__all__ = ["play"]

Echo = Callable[[str], None]

_DEFAULT_SCENE = "synthetic:empty"


def play(
    story: Story, memory: Memory | None = None, echo: Echo = lambda line: None
) -> Mismatch | None:
    """Plays a story to a robot with this memory, an empty one if there is none.

    The first difference, or None if there is none. `echo` is given each line as it is
    played. Raises StoryError for a line that cannot be played.
    """
    try:
        robot = Agent(_first_scene(story), memory)
    except SensorError as error:
        raise StoryError(f"{story.lines[0].place}: {error}") from error
    with robot:
        return _Playing(robot, echo).play(story)


def _first_scene(story: Story) -> str:
    """The scene that the story begins with, so that no other is opened first."""
    first = story.lines[0]
    if first.mark == "@" and first.text.startswith("scene "):
        return _expanded(first)
    return _DEFAULT_SCENE


def _expanded(line: Line) -> str:
    """The sensor that an `@ scene` line names; a path is from the story's folder."""
    name = os.path.expandvars(line.text.removeprefix("scene ").strip())
    if unset := re.search(r"\$\{?(\w+)", name):
        raise StoryError(f"{line.place}: set the variable {unset[1]} before")
    beside = Path(line.file).parent / name
    return str(beside) if not Path(name).is_absolute() and beside.exists() else name


class _Playing:
    """A story being played: the robot, and what it said that the story has not had."""

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
            raise StoryError(f"{line.place}: {error}") from error
        self._said = answer.split("\n") if answer else []
        for sentence in self._said:
            self._echo(f"S> {sentence}")
        self._started = True

    def _answer(self, line: Line) -> str:
        if line.mark == "U>":
            return self._robot.hear(line.text)
        if not line.text.startswith("scene "):
            return self._robot.do(line.text)
        if not self._started:
            return self._robot.look()
        return self._robot.do(f"scene {_expanded(line)}")

    def _compare(self, line: Line) -> Mismatch | None:
        found = self._said.pop(0) if self._said else ""
        if line.mark == "S>" and found == line.text:
            return None
        if line.mark == "S~" and _fits(line, found):
            return None
        return Mismatch(line, line.text or "silence", found or "silence")

    def _left_over(self, line: Line) -> Mismatch | None:
        """What the robot said more than the story has, before this line."""
        if not self._said:
            return None
        return Mismatch(line, "nothing more to be said before this", self._said[0])

    def _judge(self, line: Line) -> Mismatch | None:
        T = _type_of_state(line)
        judgement = self._robot.model.judge(self._robot.state, T)
        if judgement.p == CERTAIN:
            return None
        failed = judgement.why.failure()
        reason = f"{failed.sit} : {failed.type}, {failed.rule}" if failed else ""
        path = judgement.why.path() or "the state"
        return Mismatch(line, str(T), f"at {path}: {reason}")


def _fits(line: Line, found: str) -> bool:
    try:
        return re.fullmatch(line.text, found) is not None
    except re.error as error:
        raise StoryError(
            f"{line.place}: {line.text!r} is no regular expression: {error}"
        ) from None


def _type_of_state(line: Line) -> TypeNode:
    """The type in `s : T`."""
    name, colon, text = line.text.partition(":")
    if not colon or name.strip() != "s":
        raise StoryError(
            f"{line.place}: a judgement of the state is written `= s : T`, as in "
            "`= s : [shared : [latest : Learned]]`"
        )
    try:
        T = theory().parse(text.strip())
    except TTRError as error:
        raise StoryError(f"{line.place}: {error}") from None
    if not isinstance(T, TypeNode):
        raise StoryError(f"{line.place}: {text.strip()} is no type of states")
    return T
