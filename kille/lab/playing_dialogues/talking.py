"""Playing a dialogue of a study: a tutor, a robot, and the phases that they go through.

All of it follows from the study and the run. The chance of every task is named by the
tutor, the scene and the seed, and not by the theory, so that two theories meet the same
lessons and questions as long as what they answer is answered in the same way.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from math import nan

import numpy as np

from kille.dialogue.state import words
from kille.lab import scenes
from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.errors import StudyError
from kille.lab.playing_dialogues.players import robot_of, tutor_of
from kille.lab.protocols.phases import CHANGING, RESTING, successor, tasks
from kille.lab.robots import Robot
from kille.lab.robots.replies import Reply, degrees
from kille.lab.scenes.scene import Occasion
from kille.lab.study import Run, Study
from kille.lab.tutors.tutor import (
    Asked,
    Happens,
    Move,
    Says,
    Shows,
    Task,
    Turns,
    Tutor,
    Waits,
)
from kille.sensors.sensor import SensorError


def play(study: Study, run: Run) -> Played:
    """Play one dialogue from its beginning to its end, or to the study's last turn.

    A tutor is told if a move of theirs cannot be made, and may make another.
    Whatever a theory, a learner or a tutor of one's own raises ends it.

    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "ask"
    ... '''
    >>> cups = parse(text, Path("cups.toml"))
    >>> played = play(cups, next(cups.runs()))
    >>> len(played.turns) > 0
    True
    """
    with _seed_generators(run):
        return _play(study, run)


@contextmanager
def _seed_generators(run: Run) -> Iterator[None]:
    """Seed the global random generators by the run, for learners and rules of users.

    Many a classifier draws from the generators of Python or numpy that a process has.
    """
    before, before_of_arrays = random.getstate(), np.random.get_state()  # noqa: NPY002
    chance = run.chance("whatever draws without a generator of its own")
    random.seed(chance.getrandbits(32))
    np.random.seed(chance.getrandbits(32))  # noqa: NPY002
    try:
        yield
    finally:
        random.setstate(before)
        np.random.set_state(before_of_arrays)  # noqa: NPY002


def _play(study: Study, run: Run) -> Played:
    scene = scenes.open_scene(study, run)
    with closing(robot_of(study, run, scene)) as robot:
        talk, name = _Dialogue(study, run, robot), run.tutor
        tutor = tutor_of(study, run, name, scene)
        for phase, task in tasks(study, run, scene):
            if talk.is_over:
                break
            if phase.do in CHANGING:
                name = successor(study, phase, name)
                tutor = tutor_of(study, run, name, scene)
            elif phase.do in RESTING:
                talk.rest(task)
            else:
                talk.play(task, tutor)
    return talk.record()


class _Dialogue:
    """A dialogue that is being played."""

    def __init__(self, study: Study, run: Run, robot: Robot) -> None:
        self._most, self._robot = study.turns, robot
        self._turns: list[Turn] = []
        self._answers: list[Answer] = []
        self._last: Reply | None = None
        self._lost = 0

    @property
    def is_over(self) -> bool:
        """Whether the tutor has taken all the turns that the study allows."""
        return len(self._turns) >= self._most

    def rest(self, task: Task) -> None:
        """Another day begins."""
        reply = self._robot.rest()
        self._last = reply
        self._turns.append(
            Turn(len(self._turns) + 1, task.phase, "", "rests", "", reply.text)
        )

    def play(self, task: Task, tutor: Tutor) -> None:
        """Play a task: the moves of the tutor, and the replies to them."""
        asked: Asked | None = None
        with closing(tutor.turns(task)) as moves:
            move = next(moves, None)
            while move is not None:
                try:
                    reply = self._make_move(task, tutor, move)
                except (StudyError, SensorError) as error:
                    move = _move_instead(moves, error)
                    continue
                if isinstance(move, Says) and move.asks is not None:
                    asked = move.asks
                if asked is not None and _is_answer(move, reply, asked):
                    self._record_answer(task, tutor, asked, reply)
                    asked = None
                if self.is_over:
                    break
                move = _next_move(moves, reply)
        if asked is not None and self._last is not None:
            self._record_answer(task, tutor, asked, self._last)

    def record(self) -> Played:
        """The dialogue so far, as a value."""
        known = [] if self._last is None else list(words(self._last.state))
        facts = {"words known": float(len(known)), "not understood": float(self._lost)}
        return Played(tuple(self._turns), tuple(self._answers), self._lessons(), facts)

    def _lessons(self) -> int:
        """How many lessons the robot has kept, of this day and of those before."""
        if self._last is None:
            return 0
        private = self._last.state.private
        return len(private.lessons) + int(sum(it.lessons for it in private.taught))

    def _make_move(self, task: Task, tutor: Tutor, move: Move) -> Reply:
        """Make a move of the tutor's, record it, and return the robot's reply."""
        length, corrects = 0, False
        match move:
            case Says():
                act, given, reply = move.act, move.text, self._robot.hear(move.text)
                length, corrects = len(given.split()), move.corrects
                self._lost += reply.is_lost
            case Shows():
                act, given = "shows", _look_name(move.occasion)
                reply = self._robot.see(move.occasion)
            case Waits():
                act, given = "waits", _look_name(move.occasion)
                reply = self._robot.wait(move.occasion)
            case Happens():
                act, given = "happens", move.command
                reply = self._robot.happen(move.command)
        self._last = reply
        turn = Turn(
            len(self._turns) + 1,
            task.phase,
            tutor.name,
            act,
            given,
            reply.text,
            length,
            reply.asks,
            corrects,
            reply.rules,
        )
        self._turns.append(turn)
        return reply

    def _record_answer(
        self, task: Task, tutor: Tutor, asked: Asked, reply: Reply
    ) -> None:
        """Record what the robot has answered to a question."""
        kind, found = asked.kind, self._degrees(asked, reply)
        said = _answer_given(task, asked, reply)
        self._answers.append(
            Answer(
                turn=len(self._turns),
                phase=task.phase,
                kind=kind,
                right=asked.right,
                said=said,
                way=reply.way,
                degree=found.get(said, nan),
                degrees=found,
                accepted=said == asked.right or said in asked.accepted,
                judge=asked.judge,
                lessons=self._lessons(),
                tutor=tutor.name,
                thing=_thing_asked(task, asked),
            )
        )

    def _degrees(self, asked: Asked, reply: Reply) -> Mapping[str, float]:
        if asked.kind not in ("noun", "adjective", "relation"):
            return {}
        x = self._robot.name(asked.x)
        y = "" if asked.y is None else self._robot.name(asked.y)
        if x is None or y is None:
            return {}
        return degrees(reply.state, reply.model, asked.kind, x, y)


def _next_move(moves: Turns, reply: Reply) -> Move | None:
    """The tutor's next move after a reply; None at the end."""
    try:
        return moves.send(reply)
    except StopIteration:
        return None


def _move_instead(moves: Turns, error: StudyError | SensorError) -> Move | None:
    """The move that a tutor makes instead of one that is impossible, if any."""
    try:
        return moves.throw(error)
    except StopIteration:
        return None


def _is_answer(move: Move, reply: Reply, asked: Asked) -> bool:
    """Whether a reply answers the question; scripts expect the next reply.

    Nothing is answered while things are laid, or pointed at: the tutor has the floor.
    """
    if isinstance(move, Shows):
        return False
    return asked.kind == "reply" or not reply.is_open


def _answer_given(task: Task, asked: Asked, reply: Reply) -> str:
    match asked.kind:
        case "reference":
            pointed = reply.pointed_thing
            return "" if pointed is None else task.occasion.name(pointed)
        case "reply":
            return reply.text
    return reply.claimed_word(asked.kind)


def _thing_asked(task: Task, asked: Asked) -> str:
    """The name of what was asked about."""
    if task.of is None or not asked.x:
        return ""
    thing = task.of.name(asked.x)
    return thing if asked.y is None else f"{thing} / {task.of.name(asked.y)}"


def _look_name(occasion: Occasion) -> str:
    """The name of what was shown, from which it can be shown again."""
    return occasion.world_seen.name if occasion.view is None else str(occasion.view)
