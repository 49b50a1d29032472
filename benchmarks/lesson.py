"""How well the robot learns from a tutor, and how long it takes to answer.

`python benchmarks/lesson.py [WHICH …]`, WHICH any of objects, spatial, real, times; all
without any. `--json` prints one JSON object. All goes through `Agent`: what is measured
is what a tutor gets. `real` needs the captures in ../shared/data or KILLE_DATA.

objects: the paper's protocol. In each of four rounds all ten objects are taught and
then asked about, each time in a new pose. A word's score is its degree, averaged over
the rounds; the answer is the word with the best score.

spatial: a book around a car, at 16 places: 2 rings of 25 and 32 cm, 8 points at 45° on
each. Every place is taught three times and asked about twice, in an order drawn by
chance, each time about half a centimetre off and turned. The tutor's words are those of
the paper, and come from a rule, not from people: on the inner ring, every third time,
"near" or "close to", by a coin; otherwise the direction from the tutor's side, and at
the four diagonal points one of the two that fit, by a coin. The geometry accepts of an
answer: every direction at most 60° off, so one at a straight point and two at a
diagonal one; and "near" and "close to" on the inner ring. An answer counts by its best
word, be it asserted or hedged; not to know is no right answer. "By chance" is what one
of the six words, drawn blindly, would get.

real: taught by outlines in ycbv_scenes 0001 and 0002, asked in 0050 about each thing
that the robot itself makes out there.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from kille import Agent
from kille.dialogue.lexicon import lexicon
from kille.sensors.sensor import SensorError
from kille.sensors.synthetic.catalogue import TOY_NAMES

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("KILLE_DATA") or ROOT.parent / "shared" / "data")
ROUNDS = 4
LESSONS, QUESTIONS = 3, 2
RINGS = (0.25, 0.32)
CAR = (0.0, 0.05)
WAYS = {
    "to the right of": 0,
    "behind": 90,
    "to the left of": 180,
    "in front of": 270,
}
NEARNESS = ("near", "close to")
LARGEST_TURN = 60  # degrees between a direction and one that is accepted

Row = Mapping[str, Any]


def objects() -> list[Row]:
    """Ten objects, four rounds: right by mean score, and how far ahead."""
    scores = {asked: dict.fromkeys(TOY_NAMES, 0.0) for asked in TOY_NAMES}
    sentences = dict.fromkeys(TOY_NAMES, 0)
    with Agent("synthetic:empty?seed=7") as robot:
        for _ in range(ROUNDS):
            for word in TOY_NAMES:
                robot.do(f"show {word}")
                robot.hear(f"This is {lexicon().with_article(word)}.")
            for word in TOY_NAMES:
                robot.do(f"show {word}")
                said = robot.hear("What is this?")
                sentences[word] += said == f"This is {lexicon().with_article(word)}."
                for belief in robot.state.private.beliefs:
                    scores[word][belief.sign.form] += belief.p / ROUNDS
    rows = [_object_row(word, scores[word], sentences[word]) for word in TOY_NAMES]
    rows.sort(key=lambda row: -row["margin"])
    right = sum(row["answer"] == row["object"] for row in rows)
    return [*rows, {**dict.fromkeys(rows[0], ""), "object": f"right: {right} of 10"}]


def _object_row(word: str, scores: Mapping[str, float], asserted: int) -> Row:
    other = _best({form: p for form, p in scores.items() if form != word})
    return {
        "object": word,
        "answer": _best(scores),
        "score": round(scores[word], 3),
        "runner-up": other,
        "its score": round(scores[other], 3),
        "margin": round(scores[word] - scores[other], 3),
        "asserted, of 4": asserted,
    }


def _best(scores: Mapping[str, float]) -> str:
    return max(scores, key=lambda form: scores[form])


@dataclass(frozen=True)
class Place:
    """A point of a ring around the car: metres from it, degrees from its right side."""

    ring: float
    angle: int

    @property
    def directions(self) -> list[str]:
        """The words whose direction is at most 60° off: one, or two on a diagonal."""
        return [w for w, way in WAYS.items() if _apart(self.angle, way) <= LARGEST_TURN]

    @property
    def accepted(self) -> set[str]:
        """The words that the geometry accepts here."""
        return {*self.directions, *(NEARNESS if self.ring == RINGS[0] else ())}

    def word(self, chance: np.random.Generator, lesson: int) -> str:
        """What the tutor says of this place in the n-th lesson about it."""
        near = self.ring == RINGS[0] and lesson % LESSONS == LESSONS - 1
        return str(chance.choice(NEARNESS if near else self.directions))

    def spot(self, chance: np.random.Generator) -> str:
        """Where the book is put, not quite where it should be."""
        right = CAR[0] + self.ring * np.cos(np.radians(self.angle))
        away = CAR[1] + self.ring * np.sin(np.radians(self.angle))
        dx, dy = chance.normal(0, 0.005, 2)
        turn = chance.uniform(-15, 15)
        return f"at {right + dx:.3f} {away + dy:.3f} turned {turn:.0f}"


PLACES = [Place(ring, angle) for ring in RINGS for angle in range(0, 360, 45)]


def _apart(one: int, other: int) -> int:
    return abs((one - other + 180) % 360 - 180)


def spatial() -> list[Row]:
    """Forty-eight lessons about where the book is, thirty-two questions."""
    chance = np.random.default_rng(5)
    with Agent("synthetic:empty?seed=5") as robot:
        _teach_the_things(robot)
        taught = [_lesson(robot, place, n, chance) for place, n in _draw_places(chance)]
        asked = [place for place in PLACES for _ in range(QUESTIONS)]
        order = chance.permutation(len(asked))
        answers = [_question(robot, asked[i], chance) for i in order]
    rows = [_place_row(place, answers) for place in PLACES]
    accepted = sum(word in place.accepted for place, word, _ in answers)
    return [
        *rows,
        {
            **dict.fromkeys(rows[0], ""),
            "place": f"accepted: {accepted} of {len(answers)} "
            f"(by chance {_by_chance():.1f}), "
            f"lessons kept: {sum(taught)} of {len(taught)}",
        },
    ]


def _by_chance() -> float:
    """How many answers would be accepted if each word were drawn blindly."""
    words = len(WAYS) + len(NEARNESS)
    return QUESTIONS * sum(len(place.accepted) for place in PLACES) / words


def _teach_the_things(robot: Agent) -> None:
    """Book and car, in three poses each."""
    for word in ("book", "car"):
        for _ in range(LESSONS):
            robot.do(f"show {word}")
            robot.hear(f"This is a {word}.")
    robot.do("remove car")
    robot.do(f"place car at {CAR[0]} {CAR[1]}")


def _draw_places(chance: np.random.Generator) -> list[tuple[Place, int]]:
    lessons = [(place, n) for n in range(LESSONS) for place in PLACES]
    return [lessons[i] for i in chance.permutation(len(lessons))]


def _lesson(
    robot: Agent, place: Place, number: int, chance: np.random.Generator
) -> bool:
    _put(robot, place, chance)
    word = place.word(chance, number)
    said = robot.hear(f"The book is {word} the car.")
    return said == f'OK, this relation is called "{word}".'


def _question(
    robot: Agent, place: Place, chance: np.random.Generator
) -> tuple[Place, str, float]:
    """The place, the best word of the robot's answer, and its degree."""
    _put(robot, place, chance)
    robot.hear("Where is the book?")
    beliefs = robot.state.private.beliefs
    said = len(robot.state.shared.pending) > 0
    return (place, beliefs[0].sign.form, beliefs[0].p) if said else (place, "", 0.0)


def _put(robot: Agent, place: Place, chance: np.random.Generator) -> None:
    """Put the book there; where it would touch the car, try again a little off."""
    for _ in range(20):
        try:
            robot.do(f"place book {place.spot(chance)}")
        except SensorError as error:
            complaint = error
        else:
            return
    raise complaint


def _place_row(place: Place, answers: Sequence[tuple[Place, str, float]]) -> Row:
    own = [(word, p) for asked, word, p in answers if asked == place]
    return {
        "place": f"{place.ring * 100:.0f} cm, {place.angle}°",
        "answers": ", ".join(f"{word or 'none'} {p:.2f}" for word, p in own),
        "accepted": sum(word in place.accepted for word, _ in own),
        "the geometry accepts": ", ".join(sorted(place.accepted)),
    }


def real() -> list[Row]:
    """Taught in two real scenes by outlines, asked in a third."""
    with Agent(str(DATA / "ycbv_scenes" / "0001")) as robot:
        taught = set(_taught_by_outline(robot))
        robot.do(f"scene {DATA / 'ycbv_scenes' / '0002'}")
        taught |= set(_taught_by_outline(robot))
        robot.do(f"scene {DATA / 'ycbv_scenes' / '0050'}")
        assert robot.view is not None
        count = len(robot.view.look.percepts)
        return [_real_row(robot, number, taught) for number in range(1, count + 1)]


def _taught_by_outline(robot: Agent) -> Iterator[str]:
    for name in robot.gaze.sensor.frame().outlines:
        robot.do(f"point {name}")
        robot.hear(f"This is {lexicon().with_article(name)}.")
        yield name


def _real_row(robot: Agent, number: int, taught: set[str]) -> Row:
    said = robot.hear(f"#{number} What is this?")
    assert robot.view is not None
    assert robot.view.focus is not None
    look = robot.view.look
    seen = look.percepts[robot.view.focus - 1].region.mask
    truth = {
        name: float((mask & seen).sum() / (mask | seen).sum())
        for name, mask in look.frame.outlines.items()
    }
    name = _best(truth) if max(truth.values()) > 0.4 else "clutter"
    beliefs = robot.state.private.beliefs
    own = next((b.p for b in beliefs if b.sign.form == name), 0.0)
    return {
        "thing": name,
        "taught": "yes" if name in taught else "no",
        "own degree": round(own, 3),
        "best degrees": ", ".join(f"{b.sign.form} {b.p:.3f}" for b in beliefs[:2]),
        "said": said,
    }


def times() -> list[Row]:
    """Starting up, and turns with and without seeing, in milliseconds."""
    rows = [
        _time_act(f"{module} --help", lambda module=module: _help_of(module), 9)
        for module in ("kille.interfaces.cli", "ttr.cli.main")
    ]
    with Agent("synthetic:empty?seed=7") as robot:
        for word in TOY_NAMES:
            robot.do(f"show {word}")
            robot.hear(f"This is {lexicon().with_article(word)}.")
        robot.do("show cup")
        rows += [
            _time_act("hear: Hello.", lambda: robot.hear("Hello."), 15),
            _time_act("hear: not understood", lambda: robot.hear("Blah blah."), 15),
            _time_act("hear: What is this?", lambda: robot.hear("What is this?"), 15),
            _time_act("hear: This is a cup.", lambda: robot.hear("This is a cup."), 15),
        ]
        robot.do("place book left of cup")
        robot.hear("The book is to the left of the cup.")
        ask = "Where is the book?"
        rows.append(_time_act(f"hear: {ask}", lambda: robot.hear(ask), 15))
    return rows


def _help_of(module: str) -> None:
    subprocess.run(
        [sys.executable, "-m", module, "--help"],
        stdout=subprocess.DEVNULL,
        check=True,
    )


def _time_act(what: str, act: Callable[[], object], times: int) -> Row:
    taken = []
    for _ in range(times):
        start = time.perf_counter()
        act()
        taken.append(1000 * (time.perf_counter() - start))
    return {
        "what": what,
        "median ms": round(statistics.median(taken), 1),
        "slowest ms": round(max(taken), 1),
    }


PARTS: Mapping[str, Callable[[], list[Row]]] = {
    "objects": objects,
    "spatial": spatial,
    "real": real,
    "times": times,
}


def _table(rows: Sequence[Row]) -> str:
    cells = [list(rows[0]), *([str(value) for value in row.values()] for row in rows)]
    # A row that sums up is a sentence in the first column, and may be wider.
    whole = [row for row in cells if len([*filter(None, row)]) > 1]
    widths = [max(len(row[i]) for row in whole) for i in range(len(cells[0]))]
    return "\n".join(
        "  ".join(
            f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)
        ).rstrip()
        for row in cells
    )


def main(arguments: Sequence[str]) -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("which", nargs="*", help=", ".join(PARTS))
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    if unknown := set(options.which) - set(PARTS):
        parser.error(f"unknown: {', '.join(unknown)}; known are {', '.join(PARTS)}")
    wanted = options.which or list(PARTS)
    if "real" in wanted and not DATA.is_dir():
        print(f"real: left out, no real captures in {DATA}", file=sys.stderr)
        wanted = [name for name in wanted if name != "real"]
    results = {name: PARTS[name]() for name in wanted}
    if options.json:
        print(json.dumps(results, default=float, indent=1))
        return
    for name, rows in results.items():
        doc = (PARTS[name].__doc__ or "").splitlines()[0]
        print(f"\n{name}: {doc}\n{_table(rows)}")


if __name__ == "__main__":
    main(sys.argv[1:])
