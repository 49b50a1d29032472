"""The commands that a tutor gives beside the dialogue: `@` of `kille talk`, `do`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from kille.dialogue.state import words
from kille.perception.picture_sheet import write_picture
from kille.sensors.sensor import Stage
from ttr import TTRError
from ttr.misspellings import nearest_names

if TYPE_CHECKING:
    from kille.agent.agent import Agent
    from kille.scene import Colour

COMMANDS = """\
Lines that begin with @ change what there is to see:
  @ show cup                    only the cup is on the table
  @ place book left of cup      also right of, in front of, behind, near
  @ place book at 0.10 -0.05    metres right and away from the middle
  @ remove cup
  @ point 2                     "this" is thing #2 from now on; also in a sentence:
                                #2 This is a book.
  @ point that 3                "that" is thing #3, in what you say next
  @ look                        what is in view
  @ picture [FILE.png]          a picture of it, with the numbers and names
  @ why [FILE.png]              the reason that it gave last, as a picture
  @ meaning cup                 the type that a word means
  @ trace                       what the latest turn did to the state, in full
  @ things                      all that can be shown
  @ scene SENSOR                look through another sensor
  @ restart                     a new dialogue, with the same memory
Ctrl-D or "Goodbye." ends the conversation; what was learned stays."""

_NAMES = tuple(re.findall(r"^  @ ([a-z]+)", COMMANDS, re.MULTILINE))


def meant_command(verb: str) -> str:
    """The command that is meant by what is none; empty for a command, and for nothing.

    >>> meant_command("pictrue"), meant_command("picture"), meant_command("xyzzy")
    ('picture', '', '')
    """
    return "" if verb in _NAMES else "".join(nearest_names(verb, _NAMES))


def normalise_command(typed: str) -> str:
    """A command as it is looked up: without its @, and its verb in small letters.

    >>> normalise_command(" @ Show  cup"), normalise_command("@")
    ('show cup', 'help')
    """
    verb, _, rest = typed.strip().removeprefix("@").strip().partition(" ")
    return f"{verb.lower()} {rest.strip()}".strip() or "help"


def answer_command(robot: Agent, command: str) -> str | None:
    """What a command that only asks shows; None for one that changes anything.

    `picture` and `why` write the picture and say where it is. Raises `TTRError` where
    there is nothing to show, or no place to write it.
    """
    verb, _, rest = command.partition(" ")
    ask = _QUESTIONS.get(verb)
    return None if ask is None else ask(robot, rest)


def _picture(robot: Agent, file: str) -> str:
    path = Path(file or "kille-view.png")
    _write(path, robot.picture().pixels)
    return f"The picture is in {path}."


def _why(robot: Agent, file: str) -> str:
    path = Path(file or "kille-why.png")
    try:
        picture = robot.reason_picture()
    except ValueError as error:
        raise _unwritten(path, error) from error
    if picture is None:
        raise TTRError(
            'there is no reason to show: ask "Why?" after the robot has said what '
            "something is"
        )
    _write(path, picture.pixels)
    return f"Its reason is in {path}."


def _write(path: Path, picture: Colour) -> None:
    try:
        write_picture(path, picture)
    except OSError as error:
        raise _unwritten(path, error.strerror or error) from error


def _unwritten(path: Path, why: object) -> TTRError:
    return TTRError(f"the picture cannot be written to {path}: {why}")


def _meaning(robot: Agent, form: str) -> str:
    """The types that a word means, one for each kind of word that it is."""
    if not form:
        raise TTRError("@ meaning needs a word: write, for example, @ meaning cup")
    found = [it for it in words(robot.state) if it.form == form.lower()]
    if not found:
        raise TTRError(f'the word "{form}" is not known: "What do you know?" lists all')
    return "\n".join([f"{it.form} ({it.kind}): {it.meaning}" for it in found])


def _trace(robot: Agent, _: str) -> str:
    steps = [step for turn in robot.exchanges[-1:] for step in turn.steps]
    return "\n".join(map(str, steps)) or "The latest turn changed nothing."


def _things(robot: Agent, _: str) -> str:
    sensor = robot.gaze.sensor
    if isinstance(sensor, Stage):
        return "You can show: " + ", ".join(sensor.things())
    return f"{sensor.name} shows what was recorded, nothing else."


_QUESTIONS: Mapping[str, Callable[[Agent, str], str]] = {
    "picture": _picture,
    "why": _why,
    "meaning": _meaning,
    "trace": _trace,
    "things": _things,
    "help": lambda _, __: COMMANDS,
}
