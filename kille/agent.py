"""The robot: it looks, hears, updates its state, learns for good, and speaks."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from types import TracebackType
from typing import Self

from kille.dialogue import games
from kille.dialogue.language import NotUnderstood, understand
from kille.dialogue.meanings import (
    named,
    noun,
    predicate_at,
    relation,
    theory,
    value_at,
    word_of,
)
from kille.dialogue.state import STATE, blank_model, forms, initial
from kille.dialogue.wording import english
from kille.exchange import Exchange, Said
from kille.gaze import Gaze, View
from kille.knowledge import Evidence, Knowledge, Named
from kille.memory import Memory, Turn
from kille.perception.look import SCANS
from kille.sensors.sensor import Sensor
from kille.witness import Witnesses, thing
from kille.words import Vocabulary
from ttr import Model, Record, RecordType, record
from ttr.perceptual import Meaning, Speaker
from ttr.updates import Algorithm, Run, Step, run

__all__ = ["Agent"]

_POINTING = re.compile(r"#([0-9]{1,6})\b")

Played = tuple[Exchange, Run]
"""A turn, and the state and model that it leads to."""


class Agent:
    """A robot that looks through a sensor and keeps what it learns in a memory.

    It is its own context manager. `hear` takes what the tutor says, `do` changes the
    scene, and both give the robot's answer. SensorError and MemoryFileError come as the
    sensor and the memory raise them: the state is then as it was before the turn.

    >>> with Agent(sensor="synthetic:empty") as robot:
    ...     robot.hear("This is a cup.")
    'I see nothing on the table.'
    """

    def __init__(
        self,
        sensor: str | Sensor = "synthetic",
        memory: Memory | Path | str | None = None,
        *,
        scans: int = SCANS,
        now: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        self.gaze = Gaze(sensor, scans)
        self._now = now
        self._lexicon = english()
        self.exchanges: list[Exchange] = []
        with ExitStack() as failing:
            failing.callback(self.gaze.close)
            opened = _opened(memory)
            failing.callback(opened.close)
            self._wake(opened)
            failing.pop_all()

    def _wake(self, memory: Memory) -> None:
        """Begin a dialogue, knowing what the memory holds."""
        knowledge = Knowledge(memory)
        witnesses = Witnesses(knowledge.objects, knowledge.relations)
        words = memory.words()
        nouns = [noun(word.surface) for word in words if word.kind == "object"]
        links = [relation(word.surface) for word in words if word.kind == "relation"]
        self._dialogue = memory.begin_dialogue(self._time())
        self._turns = self._looks = 0
        self.memory, self._knowledge, self._witnesses = memory, knowledge, witnesses
        self.state: Record = initial(nouns, links, self._lexicon.bands)
        self.model: Model = witnesses.in_model(blank_model(), nouns, links)

    # --- what a user does ------------------------------------------------------------

    def hear(self, text: str) -> str:
        """Take in what the tutor says; the robot's answer, a sentence a line.

        `#2` in the text points at the thing with that number. What is not understood
        leaves the state as it was.
        """
        return self._taking(lambda: self._hearing(_legible(text)))

    def look(self) -> str:
        """Look at the scene of one's own accord; what the robot then says, if anything.

        It may ask about what it sees.
        """
        return self._taking(self._looking)

    def do(self, command: str) -> str:
        """Change what there is to see, and look; what the robot then says, if anything.

        Commands are those of `kille.sensors.stage`, and `look`, `point 2`,
        `point 320 240`, `scene SENSOR`, `restart`. Pointing and restarting take no
        look.
        """
        verb, _, rest = command.strip().partition(" ")
        match verb:
            case "point":
                self.gaze.point(rest)
                return ""
            case "restart":
                self._wake(self.memory)
                return ""
            case "scene":
                self.gaze.turn_to(rest)
            case "look":
                pass
            case _:
                self.gaze.change(command)
        return self.look()

    def words(self) -> Speaker:
        """Its words as perceptual meanings, as it knows them now.

        They judge what is in the looks that it remembers. What they learn is learned by
        new meanings: it is neither kept nor known to the robot.
        """
        private, known = self.state.private, self._knowledge
        vocabulary = Vocabulary(self._witnesses, known.objects, known.relations)
        return vocabulary.speaker("robot", private.nouns, private.relations)

    def meaning(self, word: str) -> Meaning:
        """One of its words as a perceptual meaning; `TTRError` if it knows none such.

        >>> with Agent(sensor="synthetic:empty?seed=7") as robot:
        ...     _ = robot.do("show cup")
        ...     _ = robot.hear("This is a cup.")
        ...     print(robot.meaning("cup").params)
        {labels = [cup], learner = <Handle ObjectMemory>}
        """
        return self.words()[word]

    @property
    def view(self) -> View | None:
        """The latest view of the scene, with the numbers of the things in it."""
        return self.gaze.attention.view

    @property
    def trace(self) -> tuple[Step, ...]:
        """Every rule that ran, in order, with the states before and after it."""
        return tuple(step for exchange in self.exchanges for step in exchange.steps)

    def close(self) -> None:
        """Let go of the sensor and the memory."""
        self.gaze.close()
        self.memory.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    # --- taking turns ----------------------------------------------------------------

    def _taking(self, turn: Callable[[], Played]) -> str:
        """Take a turn, and keep it for good; or, if anything fails, none of it.

        The state is taken over, and the answer given, when all of it is on disk.
        """
        attention, turns = self.gaze.attention, self._turns
        try:
            with self._knowledge.together():
                exchange, after = turn()
                self._record_answer(exchange)
        except BaseException:
            self.gaze.attention, self._turns = attention, turns
            self._witnesses.reconsider()
            raise
        self.state, self.model = after.state, after.model
        self.exchanges.append(exchange)
        return exchange.answer

    def _hearing(self, text: str) -> Played:
        turn = self._turn("tutor", text)
        so_far = Run(self.state, self.model, ())
        words = _POINTING.sub(" ", text)
        try:
            utterance = understand(words)
        except NotUnderstood:
            self._record(turn)
            sorry = Said(self._lexicon.did_not_understand(words), None)
            return Exchange(text, None, (), (sorry,)), so_far
        for number in _POINTING.findall(text):
            self.gaze.point(number)
        if "look" in utterance.content:
            so_far = self._seeing(games.LOOKED, so_far)
        event, model = so_far.model.create(utterance.type)
        heard = model.judge(event, utterance.type)
        so_far = self._playing(games.HEARD, so_far._replace(model=model), event)
        turn = replace(turn, judgement=str(heard))
        self._record(turn)
        after, said = self._acting(so_far, turn)
        return Exchange(text, heard, after.trace, said), after

    def _looking(self) -> Played:
        """A look of one's own accord, about which nothing can be learned yet."""
        so_far = self._seeing(games.SCENE_CHANGED, Run(self.state, self.model, ()))
        after, said = self._acting(so_far, self._turn("world", ""))
        return Exchange("", None, after.trace, said), after

    # --- seeing ----------------------------------------------------------------------

    def _seeing(self, algorithm: Algorithm, so_far: Run) -> Run:
        """Take a look, and play it as an event."""
        view = self.gaze.look()
        self._looks += 1
        handle = f"look{self._looks}"
        self._witnesses.remember(handle, view.look, _looks_of(so_far.state))
        percepts = view.look.percepts
        things = [thing(number) for number in range(1, len(percepts) + 1)]
        placed = [
            x
            for x, percept in zip(things, percepts, strict=True)
            if percept.region.place is not None
        ]
        focus = [] if view.focus is None else [thing(view.focus)]
        model = so_far.model.given(handle, theory()["Look"])
        for x in things:
            model = model.given(x, theory()["Ind"])
        seen = record(look=handle, things=things, placed=placed, focus=focus)
        event = record(view=seen)
        return self._playing(algorithm, so_far._replace(model=model), event)

    def _playing(self, algorithm: Algorithm, so_far: Run, event: Record) -> Run:
        """Play an event through an algorithm, and add to the trace."""
        state, model, _ = so_far
        after = run(algorithm, state, type=STATE, model=model, events=[event])
        return after._replace(trace=so_far.trace + after.trace)

    # --- acting ----------------------------------------------------------------------

    def _acting(self, so_far: Run, turn: Turn) -> tuple[Run, tuple[Said, ...]]:
        """Make the moves on the agenda: learn, then say it, then it has been said."""
        said: list[Said] = []
        while so_far.state.private.agenda:
            planned = so_far.state.private.agenda[0]
            move, model = so_far.model.create(planned)
            model = self._learned(planned, move, model, turn)
            private = so_far.state.private
            known = forms(private.nouns, private.relations, move.signs)
            sentence = self._lexicon.say(move, predicate_at(planned, "e").name, known)
            said.append(Said(sentence, model.judge(move, planned)))
            so_far = self._playing(games.SAID, so_far._replace(model=model), move)
        return so_far, tuple(said)

    def _learned(
        self, planned: RecordType, move: Record, model: Model, turn: Turn
    ) -> Model:
        """The model after the lesson that a move claims to have been, if it does."""
        if planned <= named("Learned"):
            self._learn_noun(move, turn)
            self._witnesses.reconsider()
            return self._witnesses.in_model(model, move.signs, ())
        if planned <= named("LearnedRelation"):
            self._learn_relation(move, turn)
            return self._witnesses.in_model(model, (), move.signs)
        return model

    def _learn_noun(self, move: Record, turn: Turn) -> None:
        (sign,) = move.signs
        look = value_at(move.content, "look")
        percept = self._witnesses.percept(value_at(move.content, "x"), look)
        if percept is None:
            raise RuntimeError(f"{look} was let go before its lesson")
        evidence = self._evidence(turn, look)
        name = word_of(sign).name
        self._knowledge.learn_noun(name, sign.form, percept, evidence)

    def _learn_relation(self, move: Record, turn: Turn) -> None:
        (sign,) = move.signs
        look = value_at(move.content, "look")
        target, landmark = move.content["target"], move.content["landmark"]
        x, y = value_at(target, "x"), value_at(landmark, "x")
        stand = self._witnesses.configuration(x, y, look)
        if stand is None:
            raise RuntimeError(f"{look} was let go before its lesson")
        things = self._named(target, x, look), self._named(landmark, y, look)
        evidence = self._evidence(turn, look)
        name = word_of(sign).name
        self._knowledge.learn_relation(name, sign.form, things, stand, evidence)

    def _named(self, content: RecordType, x: str, look: str) -> Named:
        """A thing in a look, by the word that is said of it there."""
        percept = self._witnesses.percept(x, look)
        if percept is None:
            raise RuntimeError(f"{look} was let go before its lesson")
        return predicate_at(content, "c").name, percept

    def _evidence(self, turn: Turn, handle: str) -> Evidence:
        look = self._witnesses.look(handle)
        time = 0.0 if look is None else look.frame.time
        return Evidence(turn, self.gaze.sensor.name, time)

    # --- keeping track ---------------------------------------------------------------

    def _record_answer(self, exchange: Exchange) -> None:
        for said in exchange.said:
            judged = "" if said.judgement is None else str(said.judgement)
            self._record(self._turn("robot", said.text, judged))

    def _record(self, turn: Turn) -> None:
        self.memory.record_turn(turn)
        self._turns = turn.number

    def _turn(self, speaker: str, text: str, judgement: str = "") -> Turn:
        number = self._turns + 1
        return Turn(self._dialogue, number, speaker, text, judgement, self._time())

    def _time(self) -> str:
        return self._now().isoformat(timespec="milliseconds")


def _opened(memory: Memory | Path | str | None) -> Memory:
    match memory:
        case None:
            return Memory.transient()
        case Memory():
            return memory
    return Memory.open(Path(memory))


def _looks_of(s: Record) -> set[str]:
    """The looks that the tutor may still confirm something about."""
    return {str(value_at(content, "look")) for content in s.shared.pending}


def _legible(text: str) -> str:
    """The text without halves of characters, which no file can keep."""
    return text.encode("utf-8", "replace").decode("utf-8")
