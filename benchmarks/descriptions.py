"""How often descriptions are understood: the robot's own, and those of people.

    python benchmarks/descriptions.py [--json] [--scenes N] [--pictures FOLDER]

A robot is taught ten kinds of things, two of each, and six relations, by saying them to
it before the simulated Kinect; colours it knows from the start. Then it looks at scenes
of two to eight things, often two of a kind. What it says to describe a thing must lead
its resolver to that thing in another look at the scene, with other noise. So must what
people say, in `descriptions.toml`; they were written from the pictures, before the
resolver had ever been run on them.
"""

from __future__ import annotations

import argparse
import json
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from kille.agent.agent import Agent
from kille.dialogue.describing import Description, describe
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import word_of
from kille.dialogue.phrases import phrase
from kille.scene import Frame, Percept
from kille.sensors.synthetic import catalogue
from kille.sensors.synthetic.faults import FAULTS, FaultyView
from kille.sensors.synthetic.posed_camera import SimulatedCamera
from kille.sensors.synthetic.render import Pose, PosedToy, RenderedScene, render_scene
from kille.sensors.synthetic.specimens import specimen
from ttr import replace
from ttr.updates import Run

HUMAN = Path(__file__).with_suffix(".toml")
SIZES = range(2, 9)
SPECIMENS = 2
SCANS = 3
OWN_LIMIT, HUMAN_LIMIT = 0.98, 0.90

PLACES = {
    "to the left of": [(-0.2, 0.0), (-0.3, 0.0)],
    "to the right of": [(0.2, 0.0), (0.3, 0.0)],
    "in front of": [(0.0, -0.16), (0.0, -0.22)],
    "behind": [(0.0, 0.18), (0.0, 0.26)],
    "near": [(0.14, 0.1), (-0.14, 0.1), (0.14, -0.1), (-0.14, -0.1), (0.2, 0.0)],
}
"""Where the target of a relation is taught to be, in metres from its landmark."""

Bodies = Mapping[str, PosedToy]


class Table:
    """A simulated Kinect before whatever is put on the table."""

    name = "table"

    def __init__(self) -> None:
        self._camera, self._frames = SimulatedCamera(), 0
        self.put({})

    def put(self, bodies: Bodies) -> None:
        image: RenderedScene = render_scene(self._camera, bodies)
        lens = self._camera.intrinsics
        self._outlines = image.outlines
        self._view = FaultyView(image.colour, image.depth, lens.fx, frozenset(FAULTS))

    def frame(self) -> Frame:
        self._frames += 1
        seed = (7, 1, self._frames)
        return Frame(
            colour=self._view.colour(seed),
            depth=self._view.depth(seed),
            intrinsics=self._camera.intrinsics,
            time=self._frames / 30,
            outlines=self._outlines,
        )

    def close(self) -> None: ...


# --- scenes --------------------------------------------------------------------------


def scene(size: int, seed: int) -> Bodies:
    """So many things, some of them two of a kind, apart from one another."""
    rng = np.random.default_rng([size, seed])
    every = [f"{kind} {n}" for kind in catalogue.TOY_NAMES for n in range(SPECIMENS)]
    names = [str(name) for name in rng.permutation(every)[:size]]
    if size > 2:
        twin = names[0].rsplit(" ", 1)
        names[1] = f"{twin[0]} {1 - int(twin[1])}"
    spots: list[tuple[float, float]] = []
    while len(spots) < len(set(names)):
        spot = float(rng.uniform(-0.38, 0.38)), float(rng.uniform(-0.26, 0.34))
        if all(np.hypot(spot[0] - x, spot[1] - y) > 0.19 for x, y in spots):
            spots.append(spot)
    return {
        name: body(name, Pose(*spot, float(rng.uniform(-25, 25))))
        for name, spot in zip(dict.fromkeys(names), spots, strict=True)
    }


def body(name: str, pose: Pose) -> PosedToy:
    kind, number = name.rsplit(" ", 1)
    return PosedToy(specimen(kind, int(number)), pose)


def teach_robot(table: Table) -> Agent:
    """A robot that was taught the things and the relations."""
    robot = Agent(sensor=table, scans=SCANS)
    for kind in catalogue.TOY_NAMES:
        for number in range(SPECIMENS):
            for x, turn in ((-0.1, -20.0), (0.1, 15.0)):
                table.put({kind: body(f"{kind} {number}", Pose(x, 0.0, turn))})
                article = "an" if kind[0] in "aeiou" else "a"
                robot.hear(f"This is {article} {kind}.")
    for word, places in PLACES.items():
        for x, y in places:
            spots = {"cup": Pose(x, y), "book": Pose(0, 0)}
            table.put({it: body(f"{it} 0", spot) for it, spot in spots.items()})
            robot.hear(f"The cup is {word} the book.")
    return robot


# --- what is understood --------------------------------------------------------------


class Outcome(NamedTuple):
    """What became of a description: which thing it was of, and which was understood."""

    scene: str
    target: str
    text: str
    understood: str


def names_of(percepts: tuple[Percept, ...]) -> dict[str, str]:
    """What each thing in view truly is, as far as it is one of them."""
    names = {}
    for number, percept in enumerate(percepts, start=1):
        inside = {
            name: float((percept.region.mask & mask).sum()) / max(mask.sum(), 1)
            for name, mask in percept.frame.outlines.items()
        }
        best = max(inside, key=lambda name: inside[name], default="")
        if best and inside[best] > 0.3:
            names[f"o{number}"] = best
    return names


def look_again(robot: Agent) -> dict[str, str]:
    """The names of the things in a new look."""
    robot.look()
    assert robot.view is not None
    return names_of(tuple(robot.view.look.percepts))


def own(robot: Agent, table: Table, scenes: int) -> Iterator[Outcome]:
    """The robot's descriptions, as they are understood in another look."""
    for size in SIZES:
        for seed in range(scenes):
            table.put(scene(size, seed))
            told = {
                name: describe(robot.state, robot.model, x)
                for x, name in look_again(robot).items()
            }
            names = look_again(robot)
            for name, description in told.items():
                text = "" if description is None else words_of(description)
                yield ask_where(robot, names, f"{size}/{seed}", name, text)


def human(robot: Agent, table: Table) -> Iterator[Outcome]:
    """People's descriptions, as they are understood."""
    for place in tomllib.loads(HUMAN.read_text(encoding="utf-8"))["scene"]:
        table.put(scene(place["size"], place["seed"]))
        names = look_again(robot)
        for text, name in place["descriptions"]:
            yield ask_where(
                robot, names, f"{place['size']}/{place['seed']}", name, text
            )


def words_of(description: Description) -> str:
    """The description in words."""
    words = {word_of(sign): sign for sign in description.signs}
    return phrase(lexicon(), description.phrase, words, "definite") or ""


def ask_where(
    robot: Agent, names: Mapping[str, str], place: str, name: str, text: str
) -> Outcome:
    """Ask where it is, and see which thing is taken to be meant, if one is."""
    assert robot.game.hear is not None
    state = replace(robot.state, {"shared.salient": (), "shared.qud": ()})
    event = robot.game.hear(f"Where is {text}?") if text else None
    if event is None:
        return Outcome(place, name, text, "")
    turn = robot.game.take(Run(state, robot.model, ()), event)
    understood = any(str(step.rule) == "refer" for step in turn.trace)
    x = turn.run.state.shared.salient[0] if understood else ""
    return Outcome(place, name, text, names.get(x, "?") if x else "")


# --- telling -------------------------------------------------------------------------


def pictures(table: Table, folder: Path) -> None:
    """Write a picture of each scene that people describe, and what is where in it."""
    folder.mkdir(parents=True, exist_ok=True)
    for size in SIZES:
        for seed in (100, 101):
            bodies = scene(size, seed)
            table.put(bodies)
            frame = table.frame()
            for name, mask in frame.outlines.items():
                rows, columns = np.nonzero(mask)
                print(size, seed, name, "at", int(columns.mean()), int(rows.mean()))
            bgr = cv2.cvtColor(frame.colour, cv2.COLOR_RGB2BGR)
            cv2.imwrite(str(folder / f"{size}_{seed}.png"), bgr)


def facts(outcomes: list[Outcome], limit: float) -> dict[str, object]:
    """How many led to the right thing, and what became of the others."""
    said = [it for it in outcomes if it.text]
    right = [it for it in said if it.understood == it.target]
    wrong = [it for it in said if it.understood not in ("", it.target)]
    share = len(right) / max(len(said), 1)
    return {
        "things": len(outcomes),
        "described": len(said),
        "right": len(right),
        "wrong": len(wrong),
        "share": round(share, 4),
        "limit": limit,
        "holds": share >= limit,
        "others": [list(it) for it in said if it not in right],
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    parser.add_argument("--scenes", type=int, default=5, help="for each size")
    parser.add_argument("--pictures", type=Path, help="write pictures of scenes here")
    options = parser.parse_args()
    table = Table()
    if options.pictures:
        pictures(table, options.pictures)
        return
    with teach_robot(table) as robot:
        found = {
            "own": facts(list(own(robot, table, options.scenes)), OWN_LIMIT),
            "human": facts(list(human(robot, table)), HUMAN_LIMIT),
        }
    if options.json:
        print(json.dumps(found))
        return
    for whose, it in found.items():
        others = it.pop("others")
        print(f"{whose} descriptions:", ", ".join(f"{k} {v}" for k, v in it.items()))
        for place, target, text, understood in others:  # type: ignore[attr-defined]
            print(f"  {place} {target}: {text!r} was {understood or 'not resolved'}")


if __name__ == "__main__":
    main()
