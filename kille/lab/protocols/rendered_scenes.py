"""The spatial protocol on rendered scenes: a book round a car, as the robot sees it.

Each scene is rendered and taken apart by the robot's own eyes; the outlines of the
simulation only say which of the regions is the book and which the car, as a tutor's
finger would. The people are simulated, see `kille.lab.tutors.spatial_judges`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from kille.lab.measures.statistics import kappa
from kille.lab.protocols.causes import Placement, places_around
from kille.lab.results import Cell, Progress, Table
from kille.lab.scenes.rendered import LANDMARK_PLACE, POINTS, RINGS, TRIES, TURN
from kille.lab.scenes.stills import place_in_outline
from kille.lab.tutors.spatial_judges import ACCEPTED, Person, Place, likeliest_word
from kille.perception.relations.configurations import configuration
from kille.perception.segment import segment
from kille.scene import Frame
from kille.sensors.sensor import At, SensorError
from kille.sensors.synthetic.sensor import Synthetic, open_synthetic

_TARGET, _LANDMARK = "book", "car"
_MIDDLE = At(*LANDMARK_PLACE, 0.0)


def play_rendered_scenes(
    methods: Mapping[str, Any], *, seed: int, progress: Progress
) -> Table:
    """Play two rounds of 16 lessons and one of 16 questions, with each method."""
    chance = np.random.default_rng([seed, 1])
    stage = open_synthetic(f"synthetic:empty?seed={seed}")
    progress(0.0, "rendered scenes")
    rounds = [list(_round(stage, chance)) for _ in range(3)]
    stage.close()
    taught, asked = [*rounds[0], *rounds[1]], rounds[2]
    person = Person()
    words = [person.says(it.true, chance) for it in taught]
    judged = [[person.says(it.true, chance) for it in asked] for _ in range(2)]
    rows: list[tuple[Cell, ...]] = []
    for name, make in methods.items():
        answers = _answers(make(), taught, words, asked)
        accepted = [
            person.chances(it.true).get(word, 0.0) >= ACCEPTED
            for it, word in zip(asked, answers, strict=True)
        ]
        agreed = kappa([*judged[0], *judged[1]], answers * 2)
        rows.append((name, kappa(*judged), agreed, float(np.mean(accepted))))
    return Table(
        title="The same on rendered scenes, seen by the robot's own eyes",
        columns=("method", "judges' kappa", "robot's kappa", "accepted"),
        rows=tuple(rows),
        note=f"{len(taught)} lessons and {len(asked)} questions, one run; "
        f"places are {_median_error(taught + asked):.1f} cm off (median).",
    )


def _answers(
    learner: Any,
    taught: Sequence[Placement],
    words: Sequence[str],
    asked: Sequence[Placement],
) -> list[str]:
    """The answers of a learner that was taught these words."""
    for key, (it, word) in enumerate(zip(taught, words, strict=True)):
        learner.learn_one(it.seen, word, key=key)
    return [likeliest_word(learner.predict_proba_one(it.seen)) for it in asked]


def _round(stage: Synthetic, chance: np.random.Generator) -> Iterator[Placement]:
    """The book at each of 16 places, if there is room and the robot sees both."""
    for place in places_around(RINGS, POINTS):
        seen = _place_book(stage, place, chance)
        if seen is not None:
            yield seen


def _place_book(
    stage: Synthetic, place: Place, chance: np.random.Generator
) -> Placement | None:
    for _ in range(TRIES):
        right = place[0] + chance.normal(0, 0.01)
        away = place[1] + chance.normal(0, 0.01)
        try:
            stage.show(_LANDMARK)
            stage.place(_LANDMARK, _MIDDLE)
            stage.place(
                _TARGET,
                At(
                    _MIDDLE.right + right,
                    _MIDDLE.away + away,
                    chance.uniform(-TURN, TURN),
                ),
            )
        except SensorError:
            continue
        return _look(stage.frame(), (right, away))
    return None


def _look(frame: Frame, true: Place) -> Placement | None:
    scene = segment(frame)
    x = place_in_outline(scene.regions, frame.outlines[_TARGET])
    y = place_in_outline(scene.regions, frame.outlines[_LANDMARK])
    if x is None or y is None or x == y:
        return None
    target, landmark = scene.regions[x], scene.regions[y]
    others = [it for it in scene.regions if it is not target and it is not landmark]
    seen = configuration(frame, target, landmark, others, scene.up)
    return None if seen is None else Placement(true, seen)


def _median_error(seen: list[Placement]) -> float:
    """The median error of the places on the table, in centimetres."""
    off = [np.array(it.seen.offset[:2]) - it.true for it in seen]
    return float(np.median(np.linalg.norm(off, axis=1))) * 100 if off else 0.0
