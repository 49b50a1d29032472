"""The dialogue node: it owns the robot's state and memory, hears and answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from kille.agent.agent import Agent
from kille.agent.exchanges import Exchange
from kille.bus import Bus, BusError, Facts, Subscription, Text, serve
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import predicate_at
from kille.memory import MemoryFileError
from kille.nodes.program_calls import text_of
from kille.nodes.topics import (
    CALLS,
    HYPOTHESES,
    INTERRUPTED,
    PROBLEMS,
    STATE,
    SYSTEM_OUTPUT,
    USER_INPUT,
)
from kille.sensors.sensor import SensorError
from ttr import RecordType, TTRError
from ttr.aliases import former_names
from ttr.judging import Judgement
from ttr.types import TypeNode

__getattr__ = former_names(__name__, {"Talking": "DialogueNode"})


class DialogueNode:
    """Lets a tutor and programs talk to a robot, one turn after the other.

    A lesson is on disk before the robot says so. After a farewell a new dialogue
    begins. A turn that goes wrong is published as a problem, and leaves the state as it
    was. The robot is made, used and closed in one thread, as its memory requires;
    making it may raise SensorError and MemoryFileError.
    """

    def __init__(self, bus: Bus, make: Callable[[], Agent]) -> None:
        self._alone = ThreadPoolExecutor(max_workers=1, thread_name_prefix="robot")
        try:
            self._robot = self._alone.submit(make).result()
        except BaseException:
            self._alone.shutdown()
            raise
        self._turns = 0
        self._output = bus.publisher(SYSTEM_OUTPUT)
        self._state = bus.publisher(STATE)
        self._problems = bus.publisher(PROBLEMS)
        self._tell_state(())
        self._open: list[Subscription] = [
            bus.subscribe(USER_INPUT, self._hear_text),
            bus.subscribe(HYPOTHESES, self._hear_hypotheses),
            bus.subscribe(INTERRUPTED, self._hear_interruption),
            serve(bus, CALLS, self._answer_call),
        ]

    def close(self) -> None:
        """Hear no more, answer what was heard, and close the robot."""
        while self._open:
            self._open.pop().close()
        self._alone.submit(self._robot.close).result()
        self._alone.shutdown()
        for it in (self._output, self._state, self._problems):
            it.close()

    # --- what comes in ---------------------------------------------------------------

    def _hear_text(self, said: Text) -> None:
        """Take in what the tutor says."""
        self._take_or_report(lambda: self._hear(said.text))

    def _hear_hypotheses(self, said: Facts) -> None:
        self._take_or_report(lambda: self._robot.hear_perhaps(*_texts(said.facts)))

    def _hear_interruption(self, uttered: Text) -> None:
        """Take in that only this was uttered of the latest answer."""
        self._take_or_report(lambda: self._robot.interrupt(uttered.text))

    def _answer_call(self, call: Mapping[str, Any]) -> Facts:
        """Say to the robot what a program asks for; returns the answer and moves."""
        text = text_of(call, lexicon(self._robot.language), self._robot.types)
        done = self._take_turn(lambda: self._hear(text))
        answer = "\n".join(exchange.answer for exchange in done if exchange.answer)
        said = [it.judgement for exchange in done for it in exchange.said]
        return Facts({"heard": text, "answer": answer, "moves": _moves(said)})

    def _take_or_report(self, turn: Callable[[], object]) -> None:
        try:
            self._take_turn(turn)
        except BusError as error:
            self._problems.publish(Text(str(error)))

    def _take_turn(self, turn: Callable[[], object]) -> Sequence[Exchange]:
        """Take a turn and publish its outcome; BusError if it cannot be taken."""
        return self._alone.submit(self._take_turn_here, turn).result()

    def _take_turn_here(self, turn: Callable[[], object]) -> Sequence[Exchange]:
        """What has been told is let go: a node may run for weeks."""
        try:
            turn()
        except (SensorError, MemoryFileError, TTRError) as error:
            raise BusError(" ".join(str(error).split())) from error
        done = tuple(self._robot.exchanges)
        self._robot.exchanges.clear()
        self._turns += len(done)
        for exchange in done:
            if exchange.answer:
                self._output.publish(Text(exchange.answer))
        farewell = self._robot.types.record_type("Part")
        if any(_is(it, farewell) for it in done):
            self._robot.do("restart")
        self._tell_state(done)
        return done

    def _hear(self, text: str) -> None:
        """Take in a sentence, or a command that begins with `@`."""
        if not text.strip().startswith("@"):
            self._robot.hear(text)
            return
        command = text.strip()[1:].strip()
        verb = command.partition(" ")[0]
        if verb == "scene":
            raise BusError(
                "the sensor is a node of its own: start that with another --sensor"
            )
        self._robot.change_scene(command)
        if verb == "point":
            self._robot.look()

    # --- what goes out ---------------------------------------------------------------

    def _tell_state(self, done: Sequence[Exchange]) -> None:
        said = [it for exchange in done for it in exchange.said]
        facts = {
            "turn": self._turns,
            "said": [it.text for it in said],
            "moves": _moves([it.heard for it in done] + [it.judgement for it in said]),
            "state": str(self._robot.state),
        }
        self._state.publish(Facts(facts))


def _moves(judged: Sequence[Judgement | None]) -> list[Mapping[str, str]]:
    """The moves as programs read them: who made which, about what, in the notation."""
    return [
        {
            "by": str(move.sit.spkr),
            "act": _act(move.type),
            "content": str(move.sit.content),
        }
        for move in judged
        if move is not None
    ]


def _act(move: TypeNode) -> str:
    assert isinstance(move, RecordType)
    return predicate_at(move, "e").name


def _is(exchange: Exchange, act: RecordType) -> bool:
    """Whether the robot has made a move of this type in it."""
    judged = (said.judgement for said in exchange.said)
    return any(it is not None and it.type <= act for it in judged)


def _texts(facts: Mapping[str, Any]) -> list[tuple[str, float]]:
    """The texts with their probabilities; BusError if these are invalid."""
    match facts.get("texts"):
        case [_, *_] as texts if all(map(_is_text, texts)):
            return [(text, float(p)) for text, p in texts]
    raise BusError(
        f"{facts} are no hypotheses: send "
        '{"texts": [["This is a cup.", 0.7], ["This is a cap.", 0.2]]}'
    )


def _is_text(it: Any) -> bool:
    match it:
        case [str(), float() | int() as p]:
            return 0 < p <= 1
    return False
