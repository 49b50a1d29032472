"""Play a story to a robot, and compare what it says with what is written."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

from kille.agent.agent import Agent
from kille.dialogue.language import LANGUAGES
from kille.dialogue.strategies import MODES, TURNS, WORDINGS
from kille.memory import Memory, MemoryFileError
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
"""Makes a robot of a sensor and a memory; `language` is that of the story.

If the story says so, also of a `mode`, a `wording`, `turns`, and a clock, `now`.
"""

_DEFAULT_SCENE = "synthetic:empty"

_OPENING = ("sensor", "strategy", "memory", "time")
"""The verbs of the `@` lines that say how a story begins, before anything happens."""

_CHOICES = {"mode": MODES, "wording": WORDINGS, "turns": TURNS}
"""What an `@ strategy` line may choose, by the words that it has for it."""

_TIMES = frozenset({"time", "wait"})
"""The verbs of the `@` lines that say when something happens."""

_NOON = datetime(2026, 1, 1, 12, tzinfo=UTC)
"""When a story with times begins, unless it says so."""


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
    opening = _read_opening(story)
    clock = StoryClock(opening.begins)
    settings = {**opening.settings, **({"now": clock} if _is_timed(story) else {})}
    try:
        if opening.memory is not None:
            memory = Memory.copy_of(opening.memory)
        robot = make(opening.scene, memory, language=story_language(story), **settings)
    except (SensorError, MemoryFileError) as error:
        raise story.lines[0].wrong(str(error)) from error
    with robot:
        return _StoryPlayer(robot, echo, clock).play(story.lines[opening.lines :])


class StoryClock:
    """The clock of a story, which goes on when the story says so."""

    def __init__(self, begins: datetime = _NOON) -> None:
        self._begins = self._now = begins

    def __call__(self) -> datetime:
        """What time it is in the story."""
        return self._now

    def set(self, seconds: float) -> None:
        """Go on to so many seconds after the beginning; ValueError to go back."""
        then = self._begins + timedelta(seconds=seconds)
        if then < self._now:
            raise ValueError("time only goes on: it is later than that already")
        self._now = then

    def advance(self, seconds: float) -> None:
        """Go on for so many seconds."""
        self._now += timedelta(seconds=seconds)


@dataclass(frozen=True)
class _Opening:
    """How a story begins, and how many lines say so."""

    scene: str = _DEFAULT_SCENE
    memory: Path | None = None
    settings: Mapping[str, str] = field(default_factory=dict)
    begins: datetime = _NOON
    lines: int = 0


def _read_opening(story: Story) -> _Opening:
    """How a story begins; a first `@ scene` is opened at once, so that no other is."""
    opening, first = _Opening(), story.lines[0]
    if first.mark == "@" and first.text.startswith("scene "):
        return replace(opening, scene=_sensor_of_line(first, "scene"))
    for line in story.lines:
        verb, _, rest = line.text.partition(" ")
        if line.mark != "@" or verb not in _OPENING or _is_seconds(line):
            break
        match verb:
            case "sensor":
                opening = replace(opening, scene=_sensor_of_line(line, verb))
            case "memory":
                opening = replace(opening, memory=Path(line.file).parent / rest.strip())
            case "strategy":
                opening = replace(opening, settings=_read_strategy(line))
            case _:
                opening = replace(opening, begins=_read_date(line))
        opening = replace(opening, lines=opening.lines + 1)
    return opening


def _is_timed(story: Story) -> bool:
    """Whether a story says when something happens."""
    verbs = (it.text.partition(" ")[0] for it in story.lines if it.mark == "@")
    return not _TIMES.isdisjoint(verbs)


def _is_seconds(line: Line) -> bool:
    """Whether a line says how many seconds after the beginning something happens."""
    return re.fullmatch(r"time +\d+(\.\d+)?", line.text) is not None


def _read_date(line: Line) -> datetime:
    """When a story begins, as its line says; without a zone, in universal time."""
    try:
        date = datetime.fromisoformat(line.text.partition(" ")[2].strip())
    except ValueError:
        raise line.wrong(
            "a time is seconds since the beginning, `@ time 3.2`, or a date at the "
            "beginning, `@ time 2026-11-23T15:24:18+00:00`"
        ) from None
    return date if date.tzinfo is not None else date.replace(tzinfo=UTC)


def _read_strategy(line: Line) -> dict[str, str]:
    """The settings that an `@ strategy` line chooses, each by one of its words."""
    chosen = {}
    for word in line.text.split()[1:]:
        about = next((it for it, words in _CHOICES.items() if word in words), None)
        if about is None:
            words = ", ".join(it for words in _CHOICES.values() for it in words)
            raise line.wrong(f"there is no strategy {word!r}: choose of {words}")
        chosen[about] = word
    return chosen


def story_language(story: Story) -> str:
    """The language of a story, by the name of its file, as in `naming.sv.dlg`."""
    return language_of_file(Path(story.lines[0].file))


def language_of_file(path: Path) -> str:
    """The language of the stories in a file of this name."""
    suffixes = [suffix.lstrip(".") for suffix in path.suffixes]
    return next((it for it in suffixes if it in LANGUAGES), LANGUAGES[0])


def _sensor_of_line(line: Line, verb: str = "scene") -> str:
    """The sensor that an `@` line names; a path is from the story's folder."""
    name = os.path.expandvars(line.text.removeprefix(verb).strip())
    if unset := re.search(r"\$\{?(\w+)", name):
        raise line.wrong(f"set the variable {unset[1]} before")
    beside = Path(line.file).parent / name
    return str(beside) if not Path(name).is_absolute() and beside.exists() else name


class _StoryPlayer:
    """Plays a story; `_said` is what the robot said that the story has not yet had."""

    def __init__(self, robot: Agent, echo: Echo, clock: StoryClock) -> None:
        self._robot, self._echo, self._clock = robot, echo, clock
        self._said: list[str] = []
        self._started = False

    def play(self, lines: Sequence[Line]) -> Mismatch | None:
        for line in lines:
            mismatch = self._step(line)
            if mismatch is not None:
                return mismatch
        return self._left_over(lines[-1]) if lines else None

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
        verb, _, rest = line.text.partition(" ")
        if verb == "time":
            return self._set_clock(line)
        if verb == "wait":
            return self._wait(line)
        if verb != "scene" or not rest:
            return self._robot.change_scene(line.text)
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

    def _set_clock(self, line: Line) -> str:
        """Go on to the time that a line says; nothing else happens."""
        if not _is_seconds(line):
            raise line.wrong(
                "a time is seconds since the beginning, as in `@ time 3.2`; a date "
                "stands before anything else"
            )
        try:
            self._clock.set(float(line.text.split()[1]))
        except ValueError as error:
            raise line.wrong(str(error)) from None
        except OverflowError:
            raise line.wrong("no dialogue goes on for so long") from None
        return ""

    def _wait(self, line: Line) -> str:
        """Let the robot watch for some seconds in which nobody speaks."""
        if not re.fullmatch(r"wait +\d{1,6}(\.\d+)?", line.text):
            raise line.wrong("waiting takes some seconds, as in `@ wait 2.5`")
        said = [self._robot.watch()]
        self._clock.advance(float(line.text.split()[1]))
        said.append(self._robot.watch())
        return "\n".join(filter(None, said))

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
