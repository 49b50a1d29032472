"""`kille ros`: the parts of the robot as nodes on a bus, of ROS 1 or 2."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import FrameType
from typing import Any, Protocol

from kille.bus import Bus, BusError, Text
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain,
    complain_all,
    console,
    memory_path,
)
from kille.lab.errors import StudyError
from kille.memory import MemoryFileError
from kille.nodes.topics import PROBLEMS
from kille.sensors.sensor import SensorError
from ttr.safety.consent import Consent

PARTS = ("sensor", "perception", "dialogue")
"""What the robot is made of, from the senses on."""

ALL = "all"

DEFAULTS: Mapping[str, Any] = {
    "sensor": "synthetic",
    "rate": 30.0,
    "memory": "",
    "lang": "en",
    "mode": "assisted",
    "wording": "paper",
    "theory": "",
    "patience": 10.0,
}
"""The parameters of nodes, with what is meant where they are not set."""

_CHOICES = {
    "lang": ("en", "sv"),
    "mode": ("driven", "assisted", "autonomous"),
    "wording": ("paper", "four", "varied"),
}

_PACKAGE = Path(__file__).resolve().parent.parent / "ros" / "package"

Setting = Callable[[str], Any]
"""The value of a parameter, by its name."""


class NodeBus(Bus, Protocol):
    """A bus on which this process is a node with a name and parameters."""

    @property
    def node(self) -> str:
        """The name of the node."""
        ...

    def parameter(self, name: str, default: Any) -> Any:
        """A parameter of the node, or what is meant where it is not set."""
        ...

    def wait(self) -> None:
        """Wait until the node is told to end."""
        ...


Opening = Callable[[str, Sequence[str]], NodeBus]
"""Opens a bus as a node of this name, with arguments as ROS writes them."""


def _over_ros(name: str, arguments: Sequence[str]) -> NodeBus:
    from kille.ros.bus import open_ros

    return open_ros(name, arguments)


def _over_ros2(name: str, arguments: Sequence[str]) -> NodeBus:
    from kille.ros2.bus import open_ros2

    return open_ros2(name, arguments)


OPENING: Mapping[str, Opening] = {"ros": _over_ros, "ros2": _over_ros2}
"""How a bus is opened, by its name."""


def run_nodes(
    opened: Opening,
    part: str,
    options: Mapping[str, Any],
    arguments: Sequence[str],
    consent: Consent,
) -> int:
    """Run a part of the robot, or all of it, until it must end; returns the exit code.

    Whatever no option gives is a parameter of the node. Others on the network can set
    parameters: a theory that a parameter names runs no Python, whatever the user
    consents to.
    """
    if not options.get("theory"):
        consent = replace(consent, python=False)
    try:
        bus = opened("kille" if part == ALL else f"kille_{part}", arguments)
        with _ended_by_terminate(), ExitStack() as running:
            running.callback(bus.close)
            bus.subscribe(PROBLEMS, _print_event)
            for one in PARTS if part == ALL else (part,):
                running.callback(_STARTS[one](bus, _setting(bus, options), consent))
            console().print(f"{bus.node} is running; Ctrl-C ends it.", markup=False)
            bus.wait()
    except StudyError as error:
        return complain_all(error)
    except (BusError, SensorError, MemoryFileError) as error:
        return complain(error)
    return FINE


def launch(arguments: Sequence[str]) -> int:
    """Hands over to `roslaunch` with the launch file that is shipped."""
    paths = os.environ.get("ROS_PACKAGE_PATH", "")
    os.environ["ROS_PACKAGE_PATH"] = os.pathsep.join(
        filter(None, (str(_PACKAGE), paths))
    )
    here = str(Path(sys.executable).parent)
    os.environ["PATH"] = os.pathsep.join((here, os.environ.get("PATH", os.defpath)))
    sys.stdout.flush()
    try:
        os.execvp("roslaunch", ["roslaunch", "kille", "kille.launch", *arguments])
    except OSError as error:
        return complain(
            f"roslaunch cannot be run ({error.strerror}): on Debian, `sudo apt install "
            "python3-roslaunch`; elsewhere `source` the setup.bash of your ROS",
            FAILED,
        )


# --- the parts -----------------------------------------------------------------------


def _sensor(bus: Bus, setting: Setting, consent: Consent) -> Callable[[], None]:
    """Starts the sensor node; what ends it."""
    from kille.nodes.sensor import SensorNode
    from kille.sensors.sources import open_sensor

    rate = setting("rate")
    sensor = open_sensor(setting("sensor"))
    sensing = SensorNode(bus, sensor, rate=rate)

    def end() -> None:
        sensing.close()
        sensor.close()

    return end


def _perception(bus: Bus, setting: Setting, consent: Consent) -> Callable[[], None]:
    """Starts the perception node; what ends it."""
    from kille.nodes.perception import PerceptionNode

    return PerceptionNode(bus, patience=setting("patience") / 2).close


def _dialogue(bus: Bus, setting: Setting, consent: Consent) -> Callable[[], None]:
    """Starts the dialogue node; what ends it."""
    from kille.agent.agent import Agent
    from kille.interfaces.theories import robot_of, theory_named
    from kille.nodes.dialogue import DialogueNode
    from kille.nodes.remote_sensor import RemoteSensor

    patience = setting("patience")
    memory = memory_path(Path(setting("memory")) if setting("memory") else None)
    language, mode, wording = map(setting, ("lang", "mode", "wording"))
    make: Callable[..., Agent] = partial(
        Agent, language=language, mode=mode, wording=wording
    )
    if named := setting("theory"):
        theory = theory_named(named, language, mode, wording, consent)
        make = partial(robot_of, theory)
    return DialogueNode(bus, lambda: make(RemoteSensor(bus, patience), memory)).close


_STARTS = {"sensor": _sensor, "perception": _perception, "dialogue": _dialogue}


# --- how they are set ----------------------------------------------------------------


def _setting(bus: NodeBus, options: Mapping[str, Any]) -> Setting:
    """Settings from the options, else from the parameters of the node."""

    def setting(name: str) -> Any:
        default = DEFAULTS[name]
        given = options.get(name)
        value = bus.parameter(name, default) if given is None else given
        choices = _CHOICES.get(name)
        if choices is not None and value not in choices:
            raise BusError(
                f"the parameter {name} is `{value}`; it is one of {', '.join(choices)}"
            )
        if not isinstance(default, float):
            return str(value)
        if isinstance(value, int | float) and 0 < value < float("inf"):
            return float(value)
        raise BusError(f"the parameter {name} is `{value}`; it is a number above 0")

    return setting


def _print_event(problem: Text) -> None:
    complain(problem.text)


@contextmanager
def _ended_by_terminate() -> Iterator[None]:
    """SIGTERM, by which others end a node, ends it as cleanly as Ctrl-C."""

    def end(number: int, frame: FrameType | None) -> None:
        raise SystemExit(FINE)

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
