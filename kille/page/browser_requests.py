"""What a browser may ask for, read from its messages; anything else is refused.

A message is one JSON object. `do` says what is asked for, `ref` is how the browser
calls it: the event that answers has it, too.

| `do` | with | does |
| --- | --- | --- |
| `say` | `text` | the tutor says it |
| `point` | `thing`, or `box`: left, top, right, bottom; `as`: `that` for a second | \
"this" is that |
| `look` | | the robot looks |
| `show`, `remove` | `thing` | changes the scene |
| `place` | `thing`, `right`, `away`, `turn` | puts it there: metres, degrees |
| `add` | `thing` | puts it where there is room |
| `stepping` | `on` | whether turns wait before each rule |
| `step` | `rest` | lets the turn that waits apply a rule, or all that are left |
| `seek` | `at` | goes to that second of the recording |
| `restart` | | a new dialogue with the same memory |
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from kille.agent.agent import Agent
from kille.agent.attention import THAT
from kille.agent.spoken_turns import answer_hypotheses, is_cut_off, tell_uttered
from kille.page.table import add_thing
from kille.sensors.sensor import SensorError, Stage
from kille.speech.recognition import Hypothesis
from kille.speech.synthesis import uttered_words
from ttr.safety.limits import UTTERANCE, InputLimitError

MESSAGE = 64 * 1024
"""Bytes of a message, at most."""

_REF = 64
_PIXELS = 100_000
_METRES, _DEGREES = 10.0, 3600.0
_THINGS = 10_000
_SECONDS = 1e6


class RequestError(ValueError):
    """A message that is not understood: one line says why; `ref` is what it called
    itself."""

    def __init__(self, why: str, ref: str = "") -> None:
        super().__init__(why)
        self.ref = ref


class BrowserRequest(NamedTuple):
    """Something that a browser asks the robot for."""

    ref: str
    shown: str
    """What the tutor has said or done, for the page."""
    act: Callable[[Agent], str]
    """Lets it happen to the robot; returns what that then says."""
    pointed: dict[str, Any] | None = None
    """What it points at, if it does."""
    restarts: bool = False
    """Whether a new dialogue begins first."""
    steps: str = ""
    """What it asks of a turn that waits, if it is about that."""
    arranges: bool = False
    """Whether it changes the scene: that it cannot is the tutor's concern alone."""
    perhaps: tuple[Hypothesis, ...] = ()
    """What was perhaps said, if it was spoken."""
    says: tuple[str, ...] = ()
    """The texts one of which was said, if any was."""
    uttered: int = 0
    """The number of the turn whose answer was uttered, if that is told."""
    cuts: Callable[[Agent], bool] = lambda _: False
    """Whether not all of that answer was uttered."""


def parse_message(text: str) -> dict[str, Any]:
    """The object that a message is. RequestError if it is none."""
    if len(text) > MESSAGE:
        raise RequestError(f"a message has at most {MESSAGE} characters")
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        raise RequestError("a message is one JSON object") from None
    if not isinstance(message, dict):
        raise RequestError("a message is one JSON object")
    return message


def parse_request(message: dict[str, Any]) -> BrowserRequest:
    """What a message asks for. RequestError if it is nothing that can be done.

    >>> parse_request({"do": "say", "text": "What  is this?", "ref": "1"}).shown
    'What is this?'
    """
    ref = message.get("ref", "")
    ref = ref if isinstance(ref, str) and len(ref) <= _REF else ""
    try:
        return _read_request(message, ref)
    except RequestError as error:
        raise RequestError(str(error), ref) from None


def _read_request(message: dict[str, Any], ref: str) -> BrowserRequest:
    match message.get("do"):
        case "say":
            text = _utterance(message.get("text"))
            return BrowserRequest(
                ref, text, lambda robot: robot.hear(text), says=(text,)
            )
        case "point" if "box" in message:
            box = _box(message["box"])
            return _point_request(ref, " ".join(map(str, box)), {"box": box})
        case "point":
            number = int(_number(message, "thing", 1, _THINGS))
            if message.get("as") == THAT:
                pointed = {"thing": number, "as": THAT}
                return _point_request(ref, f"{THAT} {number}", pointed)
            return _point_request(ref, str(number), {"thing": number})
        case "look":
            return BrowserRequest(ref, "", lambda robot: robot.look())
        case "stepping":
            steps = "off" if message.get("on") is False else "on"
            return BrowserRequest(ref, "", lambda _: "", steps=steps)
        case "step":
            steps = "rest" if message.get("rest") is True else "step"
            return BrowserRequest(ref, "", lambda _: "", steps=steps)
        case "restart":
            return BrowserRequest(ref, "", lambda robot: robot.look(), restarts=True)
        case "show" | "remove" as verb:
            return _change(ref, str(verb), _name(message))
        case "add":
            return _change(ref, "add", _name(message))
        case "seek":
            at = _number(message, "at", 0, _SECONDS)
            seek = f"seek {at:.3f}"
            return BrowserRequest(ref, seek, lambda it: it.do(seek), arranges=True)
        case "place":
            right = _number(message, "right", -_METRES, _METRES)
            away = _number(message, "away", -_METRES, _METRES)
            turn = _number(message, "turn", -_DEGREES, _DEGREES)
            spot = f" at {right:.3f} {away:.3f} turned {turn:.1f}"
            return _change(ref, "place", _name(message), spot)
    raise RequestError("a message has no `do` that is known")


def spoken_request(
    ref: str, perhaps: tuple[Hypothesis, ...], language: str = "en"
) -> BrowserRequest:
    """That the tutor has perhaps said one of these texts.

    >>> spoken_request("1", (Hypothesis("Hello.", 0.8), Hypothesis("No.", 0.1))).shown
    'Hello.'
    """
    return BrowserRequest(
        ref,
        perhaps[0].text if perhaps else "…",
        lambda robot: answer_hypotheses(robot, perhaps, language),
        perhaps=perhaps,
        says=tuple(it.text for it in perhaps) or ("",),
    )


def uttered_request(
    turn: Mapping[str, Any], line: object, share: object
) -> BrowserRequest:
    """That of the answer in the event of a turn these lines, and of the next one this
    share, were uttered before it was cut off. RequestError if that is no such event.

    Whoever has said something since is not told of it any more.
    """
    if turn["type"] != "turn":
        raise RequestError("a `turn` is the number of a turn")
    lines = str(turn["said"]).split("\n")
    about = {"line": line, "share": share}
    whole = int(_number(about, "line", 0, len(lines)))
    part = _number(about, "share", 0, 1)
    begun = uttered_words(lines[whole], part) if whole < len(lines) else ""
    uttered = " ".join([*lines[:whole], begun]).strip()
    first, last = turn["turns"]

    def tell(robot: Agent) -> str:
        if len(robot.exchanges) == last:
            tell_uttered(robot, uttered, first)
        return uttered

    def cuts(robot: Agent) -> bool:
        return len(robot.exchanges) == last and is_cut_off(robot, uttered, first)

    return BrowserRequest("", uttered, tell, uttered=int(turn["id"]), cuts=cuts)


def _point_request(ref: str, target: str, pointed: dict[str, Any]) -> BrowserRequest:
    return BrowserRequest(
        ref, "", lambda robot: robot.do(f"point {target}"), pointed=pointed
    )


def _change(ref: str, verb: str, name: str, spot: str = "") -> BrowserRequest:
    """A change of the scene; only what the sensor has by name can be shown.

    A sensor also takes the path of a mesh for a name, and no browser may name files.
    """

    def change(robot: Agent) -> str:
        sensor = robot.gaze.sensor
        if not isinstance(sensor, Stage):
            raise SensorError(f"{sensor.name} cannot be rearranged")
        if name not in sensor.things():
            raise SensorError(f"there is no {name[:40]!r} to be shown")
        if verb == "add":
            return add_thing(robot, name)
        return robot.do(f"{verb} {name}{spot}")

    return BrowserRequest(ref, f"{verb} {name}", change, arranges=True)


def _utterance(text: object) -> str:
    if not isinstance(text, str):
        raise RequestError("`say` has a `text`")
    try:
        UTTERANCE.check(len(text))
    except InputLimitError as error:
        raise RequestError(f"what was said is too long: {error.strerror}") from None
    return " ".join(text.split())


def _name(message: dict[str, Any]) -> str:
    name = message.get("thing")
    if not isinstance(name, str) or not name.strip():
        raise RequestError("a change of the scene names a `thing`")
    return name


def _box(value: object) -> list[int]:
    if not isinstance(value, list) or len(value) != 4:
        raise RequestError("a `box` is left, top, right and bottom")
    box = [_whole(it) for it in value]
    if box[0] >= box[2] or box[1] >= box[3]:
        raise RequestError("a `box` is left, top, right and bottom")
    return box


def _whole(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise RequestError("a `box` has whole numbers")
    if not 0 <= value <= _PIXELS:
        raise RequestError("a `box` is in the picture")
    return value


def _number(message: dict[str, Any], name: str, least: float, most: float) -> float:
    value = message.get(name, 0)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise RequestError(f"`{name}` is a number")
    if not least <= value <= most:  # so is no NaN
        raise RequestError(f"`{name}` is from {least:g} to {most:g}")
    return value
