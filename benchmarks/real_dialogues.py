"""Dialogues about real captures, by a tutor who knows what is in them.

    python benchmarks/real_dialogues.py [--dialogues N] [--turns N] [--seed S] [--json]

The whole robot looks at the scenes of `ycbv_scenes` (in `../shared/data`, or where
KILLE_DATA says). The tutor points at things, names them, asks, confirms, corrects,
forgets, contradicts himself, talks nonsense and goes to another scene. Each turn has an
answer and leads to a state; what is learned was said. How often the robot names a thing
rightly that it was taught is told at the end: other scenes count as well.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from kille.agent import Agent
from kille.dialogue.meanings import named, predicate_at, word_of

ROOT = Path(__file__).resolve().parent.parent
SCENES = ("0001", "0002", "0050")
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
        self.do(f"scene {self.scenes / self.random.choice(SCENES)}")
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
        if _spoken(self.shown) in taught:
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
        forget = f"Forget {_spoken(self.shown)}."
        self.hear(self.random.choice((*ASKED, *NONSENSE, *FORGOTTEN, forget)))

    def name(self, sentence: str) -> None:
        """Name what is pointed at; one time in twenty, wrongly."""
        word = _spoken(self.shown)
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
        form = _forms(self.robot).get(predicate_at(claim, "c").name, "")
        return "right" if form == _spoken(self.shown) else "wrong"

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
        assert self.robot.model.judge(state, named("State")).holds
        learned = {sign.form for sign in state.private.nouns}
        assert learned <= self.said, f"never said: {learned - self.said}"
        kept = {int(lesson.key) for lesson in state.private.lessons}
        assert kept <= {lesson.key for lesson in self.robot.memory.lessons()}


def _spoken(outline: str) -> str:
    return outline.replace("_", " ").lower()


def _forms(robot: Agent) -> dict[str, str]:
    nouns = robot.state.private.nouns
    return {word_of(sign).name: sign.form for sign in nouns}


def played(seed: int, turns: int, scenes: Path) -> Counter[str]:
    """What came of a dialogue."""
    random = Random(seed)
    with Agent(str(scenes / random.choice(SCENES)), scans=1) as robot:
        tutor = Tutor(robot, random, scenes)
        tutor.show()
        while tutor.counts["turns"] < turns:
            tutor.turn()
        return tutor.counts


def all_played(dialogues: int, turns: int, seed: int) -> Iterator[Counter[str]]:
    """What came of each of so many dialogues."""
    for number in range(dialogues):
        yield played(seed + number, turns, captures())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--dialogues", type=int, default=10, metavar="N")
    parser.add_argument("--turns", type=int, default=20, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    counts = Counter[str]()
    for one in all_played(options.dialogues, options.turns, options.seed):
        counts.update(one)
    counts["dialogues"] = options.dialogues
    if options.json:
        print(json.dumps(counts))
        return
    for what, count in sorted(counts.items()):
        print(f"{count:>8,} {what}")
    print(f"{counts['milliseconds'] / counts['turns']:>8.0f} milliseconds a turn")


if __name__ == "__main__":
    main()
