"""Commands that change the scene."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from kille.scene import Frame
from kille.sensors.sensor import At, Beside, SensorError
from kille.sensors.stage_commands import perform
from kille.sensors.synthetic import open_synthetic


@dataclass
class Notebook:
    """A stage that writes down what it is asked to do."""

    name: str = "notebook"
    done: list[tuple[object, ...]] = field(default_factory=list)

    def frame(self) -> Frame:
        raise SensorError("a notebook sees nothing")

    def close(self) -> None:
        self.done.append(("close",))

    def things(self) -> tuple[str, ...]:
        return ("cup",)

    def show(self, name: str) -> None:
        self.done.append(("show", name))

    def place(self, name: str, spot: At | Beside) -> None:
        self.done.append(("place", name, spot))

    def remove(self, name: str) -> None:
        self.done.append(("remove", name))


class Blind:
    """A sensor that is no stage."""

    name = "captures/kitchen"

    def frame(self) -> Frame:
        raise SensorError("nothing to see")

    def close(self) -> None:
        return None


@pytest.mark.parametrize(
    ("command", "done"),
    [
        ("show cup", ("show", "cup")),
        ("  Show   the  teddy bear ", ("show", "the teddy bear")),
        ("remove shoe box", ("remove", "shoe box")),
        ("place book left of car", ("place", "book", Beside("left of", "car"))),
        (
            "place the can of paint to the left of the shoe box",
            ("place", "the can of paint", Beside("to the left of", "the shoe box")),
        ),
        ("place cup In Front Of car", ("place", "cup", Beside("in front of", "car"))),
        ("place cup close to car", ("place", "cup", Beside("close to", "car"))),
        ("place book at 0.10 -0.05", ("place", "book", At(0.10, -0.05))),
        ("place book at 0.1, -0.05", ("place", "book", At(0.10, -0.05))),
        ("place book at 0 0 turned -45", ("place", "book", At(0, 0, -45))),
        ("place a/b c.obj at 0 0", ("place", "a/b c.obj", At(0, 0))),
    ],
)
def test_a_command_is_done(command: str, done: tuple[object, ...]) -> None:
    stage = Notebook()
    perform(stage, command)
    assert stage.done == [done]


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("", "unknown command"),
        ("shoo cup", "unknown command `shoo cup`: write `show cup`"),
        ("show", "names no object"),
        ("place", "names no object"),
        ("place book", "does not say where"),
        ("place book on car", "does not say where"),
        ("place book at", "does not say where"),
        ("place book at 0.1", "does not say where"),
        ("place book at here there", "`here` is not a number"),
        ("place book at 0 nan", "`nan` is not a number"),
        ("place book at 0 0 turned round", "`round` is not a number"),
    ],
)
def test_a_wrong_command_is_one_clear_line(command: str, words: str) -> None:
    stage = Notebook()
    with pytest.raises(SensorError, match=words) as caught:
        perform(stage, command)
    assert "\n" not in str(caught.value)
    assert stage.done == []


def test_what_is_no_stage_cannot_be_rearranged() -> None:
    with pytest.raises(SensorError, match="captures/kitchen cannot be rearranged"):
        perform(Blind(), "show cup")


def test_the_synthetic_kinect_is_rearranged_by_words() -> None:
    sensor = open_synthetic("synthetic:empty?seed=2&faults=none")
    perform(sensor, "show car")
    perform(sensor, "place book to the right of the car")
    assert sensor.true_place("book").x > sensor.true_place("car").x + 0.05
    perform(sensor, "remove car")
    assert set(sensor.frame().outlines) == {"book"}
