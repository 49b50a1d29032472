"""Dialogues about real captures, by a tutor who knows what is in them.

    python benchmarks/real_dialogues.py [--dialogues N] [--turns N] [--seed S] [--json]

The whole robot looks at the scenes of `ycbv_scenes` (in `../shared/data`, or where
KILLE_DATA says). The tutor points at things, names them, asks, confirms, corrects,
forgets, contradicts himself, talks nonsense and goes to another scene. Each turn has an
answer and leads to a state; what is learned was said. How often the robot names a thing
rightly that it was taught is told at the end: other scenes count as well. A frame that
was seen before is not taken apart again. Ctrl-C tells of what was played so far.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path
from random import Random

from kille.agent.agent import Agent
from kille.agent.attention import Attention
from kille.dialogue.commitments import affirmation
from kille.dialogue.meanings import is_denial, predicate_at, record_type, word_of
from kille.perception.look import Sighting, look
from kille.scene import Frame, Look
from kille.sensors.sensor import SensorError
from kille.sensors.sources import open_sensor

ROOT = Path(__file__).resolve().parent.parent
SCENES = ("0001", "0002", "0050")
KEPT = 800
"""How many looks are kept, with what was found in them."""

NONSENSE = ("", "?!", "Colourless green ideas sleep.", "The unicorn.", "no no no")
FORGOTTEN = ("Forget that.", "Forget the last thing.")
ASKED = (
    "Where is it?",
    "What do you see?",
    "How sure are you?",
    "Why?",
    "What colour is this?",
    "How many things are there?",
    "What do you know?",
    "Is this a banana?",
    "Is it yellow?",
    "Where is the banana?",
    "What is the yellow one?",
    "Show me the mustard bottle.",
)


def captures() -> Path:
    """The folder of the scenes."""
    data = os.environ.get("KILLE_DATA") or ROOT.parent / "shared" / "data"
    return Path(data) / "ycbv_scenes"


@cache
def frames_of(scene: Path) -> tuple[Frame, ...]:
    """The frames of a scene, in order of time."""
    recording, frames = open_sensor(f"{scene}?loop=no"), []
    with suppress(SensorError):
        while True:
            frames.append(recording.frame())
    recording.close()
    return tuple(frames)


@dataclass
class Frames:
    """A source that gives these frames, one after the other, again and again."""

    name: str
    frames: tuple[Frame, ...]
    given: int = 0

    def frame(self) -> Frame:
        """The next frame."""
        self.given += 1
        return self.frames[(self.given - 1) % len(self.frames)]

    def close(self) -> None:
        """Nothing is held."""


class Scene(Frames):
    """The frames of a scene, in which the same look is taken only once."""

    def look(self, scans: int, pointed: Sighting | None) -> Look:
        """The look that is taken now, at what the tutor points at."""
        following = tuple(self.frame() for _ in range(scans))
        return LOOKS(following, *(() if pointed is None else (Outline(pointed),)))


class Outline:
    """What is pointed at in a frame, which is the same where its pixels are."""

    def __init__(self, pointed: Sighting) -> None:
        self.pointed = pointed
        self.key = id(pointed[0]), pointed[1].mask.tobytes()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Outline) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)


def _look(frames: tuple[Frame, ...], at: Outline | None = None) -> Look:
    return look(Frames("", frames), len(frames), None if at is None else at.pointed)


LOOKS = lru_cache(KEPT)(_look)
"""The looks that were taken last."""


@dataclass
class Tutor:
    """A tutor in front of a robot: what it points at, and what came of what it said."""

    robot: Agent
    random: Random
    scenes: Path
    shown: str = ""
    counts: Counter[str] = field(default_factory=Counter)
    said: set[str] = field(default_factory=set)

    def turn(self) -> None:
        """Say or do one thing, as the talk is."""
        if self.robot.state.shared.pending and self.random.random() < 0.8:
            self.judge()
            return
        ways = (self.teach, self.ask, self.ask, self.wander, self.show, self.go)
        self.random.choices(ways, (6, 4, 4, 3, 2, 1))[0]()

    def go(self) -> None:
        """Go to a scene."""
        gaze = self.robot.gaze
        gaze.sensor, gaze.attention = open_scene(self.scenes, self.random), Attention()
        self.do("look")
        self.show()

    def show(self) -> None:
        """Point at a thing."""
        outlines = sorted(self.robot.gaze.sensor.frame().outlines)
        self.shown = self.random.choice(outlines)
        self.do(f"point {self.shown}")

    def teach(self) -> None:
        """Point at a thing and name it; now and then, wrongly."""
        self.show()
        self.name("This is a {}.")

    def ask(self) -> None:
        """Point at a thing and ask what it is."""
        self.show()
        taught = {sign.form for sign in self.robot.state.private.nouns}
        self.hear("What is this?")
        if _spoken_name(self.shown) in taught:
            self.counts["asked of what was taught"] += 1
            self.counts[f"{self.verdict()} of what was taught"] += 1

    def judge(self) -> None:
        """Agree with what the robot claims, or correct it."""
        if self.verdict() == "right":
            self.hear("That is correct.")
        elif self.random.random() < 0.7:
            self.name("No, this is a {}.")
        else:
            self.hear("No.")

    def wander(self) -> None:
        """Anything else."""
        forget = f"Forget {_spoken_name(self.shown)}."
        self.hear(self.random.choice((*ASKED, *NONSENSE, *FORGOTTEN, forget)))

    def name(self, sentence: str) -> None:
        """Name what is pointed at; one time in twenty, wrongly."""
        word = _spoken_name(self.shown)
        if self.random.random() < 0.05:
            word = "cracker box"
        self.said.add(word)
        self.hear(sentence.format(word))

    def verdict(self) -> str:
        """Whether the first claim of the robot's is right."""
        pending = self.robot.state.shared.pending
        if not pending:
            return "unsaid"
        claim = pending[0]
        if "c" not in claim:
            return "other"
        word = predicate_at(affirmation(claim), "c").name
        is_so = _forms(self.robot).get(word, "") == _spoken_name(self.shown)
        return "right" if is_so is not is_denial(claim) else "wrong"

    def hear(self, text: str) -> None:
        """Say something, which has an answer; who says nothing may get none."""
        start = time.process_time()
        answer = self.robot.hear(text)
        self.counts["turns"] += 1
        self.counts["milliseconds"] += round(1000 * (time.process_time() - start))
        assert answer.strip() or not text, text
        self.check()

    def do(self, command: str) -> None:
        """Do something."""
        self.robot.do(command)
        self.check()

    def check(self) -> None:
        """What must be so after every turn."""
        state = self.robot.state
        assert self.robot.model.judge(state, record_type("State")).holds
        learned = {sign.form for sign in state.private.nouns}
        assert learned <= self.said, f"never said: {learned - self.said}"
        kept = {int(lesson.key) for lesson in state.private.lessons}
        assert kept <= {lesson.key for lesson in self.robot.memory.lessons()}


def _spoken_name(outline: str) -> str:
    return outline.replace("_", " ").lower()


def _forms(robot: Agent) -> dict[str, str]:
    nouns = robot.state.private.nouns
    return {word_of(sign).name: sign.form for sign in nouns}


def open_scene(scenes: Path, random: Random) -> Scene:
    """One of the scenes, from its first frame on."""
    scene = scenes / random.choice(SCENES)
    return Scene(str(scene), frames_of(scene))


def play_dialogue(seed: int, turns: int, scenes: Path) -> Counter[str]:
    """What came of a dialogue."""
    random = Random(seed)
    with Agent(open_scene(scenes, random), scans=1) as robot:
        tutor = Tutor(robot, random, scenes)
        tutor.show()
        while tutor.counts["turns"] < turns:
            tutor.turn()
        return tutor.counts


def play_dialogues(dialogues: int, turns: int, seed: int) -> Iterator[Counter[str]]:
    """What came of each of so many dialogues; what went wrong names its seed."""
    for number in range(seed, seed + dialogues):
        try:
            yield play_dialogue(number, turns, captures())
        except Exception as error:
            error.add_note(f"in the dialogue of --seed {number}")
            raise


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--dialogues", type=int, default=10, metavar="N")
    parser.add_argument("--turns", type=int, default=20, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    counts = Counter[str]()
    with suppress(KeyboardInterrupt):
        for one in play_dialogues(options.dialogues, options.turns, options.seed):
            counts.update(one)
            counts["dialogues"] += 1
    if options.json:
        print(json.dumps(counts))
        return
    for what, count in sorted(counts.items()):
        print(f"{count:>8,} {what}")
    if counts["turns"]:
        spent = counts["milliseconds"] / counts["turns"]
        print(f"{spent:>8.0f} milliseconds a turn")


if __name__ == "__main__":
    main()
