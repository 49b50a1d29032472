"""`kille ros talk`: a tutor at a keyboard or a pipe, the robot on a bus."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import suppress
from importlib import import_module

from kille.bus import Asking, Bus, BusError, Facts
from kille.interfaces.ros import Opening
from kille.interfaces.terminal import FINE, complain, console
from kille.nodes.topics import CALLS, STAGE
from ttr.safety.inputs import ask_line
from ttr.safety.limits import UTTERANCE, InputLimitError

_PATIENCE = 30.0
"""Seconds to wait for an answer."""


def talk_as_node(opened: Opening, arguments: Sequence[str]) -> int:
    """Talks to the dialogue node on a bus that is opened for it; the exit code.

    The parameter `patience` is how many seconds it waits for an answer.
    """
    from kille.ros.bus import anonymous

    try:
        bus = opened(anonymous("kille_tutor"), arguments)
    except BusError as error:
        return complain(error)
    try:
        return talk_over(bus, bus.parameter("patience", _PATIENCE))
    finally:
        bus.close()


def talk_over(bus: Bus, patience: float = _PATIENCE) -> int:
    """Send what the tutor types to the robot, and print its answers.

    A call is answered even if the robot is restarted in the middle of it.
    """
    calling, staging = Asking(bus, CALLS, patience), Asking(bus, STAGE, patience)
    try:
        for line in _lines():
            try:
                for told in _take_line(line, calling, staging):
                    console().print(told, markup=False)
            except BusError as error:
                complain(error)
    except InputLimitError as error:
        return complain(f"the input cannot be read: {error.strerror}")
    return FINE


def _take_line(
    line: str, calling: Asking[Facts], staging: Asking[Facts]
) -> Iterator[str]:
    """The answer to a line that the tutor types."""
    if line.replace(" ", "") == "@things":
        yield f"You can show: {', '.join(staging.ask({'command': 'things'})['things'])}"
        return
    answer = calling.ask({"do": "say", "text": line})["answer"]
    for sentence in answer.split("\n") if answer else ():
        yield f"S> {sentence}"


def _lines() -> Iterator[str]:
    """What the tutor types, without empty lines from a pipe."""
    typed = sys.stdin.isatty()
    with suppress(ImportError):
        # What is typed can be edited, where this Python has what it takes.
        import_module("readline")
    while True:
        try:
            line = ask_line("U> " if typed else "", UTTERANCE).strip()
        except EOFError:
            return
        if not typed and line:
            console().print(f"U> {line}", markup=False)
        if line or typed:
            yield line
