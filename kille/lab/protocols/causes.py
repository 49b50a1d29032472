"""The paper's spatial lessons and questions, played with what may have gone wrong.

A tutor says one of six words for 16 places around a landmark, three times each; then
two judges, one of them the tutor, and the robot each say a word for 32 more. The causes
that may have made the robot's kappa .05 are switched on one at a time.
Source: Dobnik and de Graaf 2017, section 4.2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from kille.lab.measures.statistics import kappa
from kille.lab.scenes.places import ring_places
from kille.lab.tutors.spatial_judges import (
    ACCEPTED,
    Person,
    Place,
    likeliest_word,
    mix_chances,
)
from kille.perception.learners import Learner
from kille.scene import Configuration

ROUNDS = 3
"""How often each place is taught."""
TABLE = 0.4
"""Metres from the landmark: where a misplaced thing may seem to be."""

_TESTS = 2
_RINGS = (0.12, 0.28)  # metres
_POINTS = 8
_SPREAD = 0.01  # metres: a hand does not put a thing exactly there
_FRONT = 0.0  # the landmark's own front is to the viewer's right
_BOOK, _CAR = 0.2, 0.16  # metres
_VIEWER = (0.0, 1.0, -0.5)  # from the viewer to the landmark


@dataclass(frozen=True)
class Cause:
    """What may have gone wrong, and how much of it.

    noise: the standard deviation of every place, in metres; misplaced: the share of
    places that are anywhere on the table; shift: how far the landmark was moved
    unnoticed between teaching and asking, in metres; tutor, judges: how often they
    speak in the landmark's own frame; habit: how people differ in when they say near.
    """

    name: str
    noise: float = 0.0
    misplaced: float = 0.0
    shift: float = 0.0
    tutor: float = 0.0
    judges: float = 0.0
    habit: float = 0.0


CAUSES = (
    Cause("none"),
    Cause("places 2 cm off", noise=0.02),
    Cause("places 5 cm off", noise=0.05),
    Cause("places 8 cm off", noise=0.08),
    Cause("places 12 cm off", noise=0.12),
    Cause("landmark moved by 5 cm", noise=0.02, shift=0.05),
    Cause("landmark moved by 10 cm", noise=0.02, shift=0.10),
    Cause("landmark moved by 25 cm", noise=0.02, shift=0.25),
    Cause("10 % misplaced", noise=0.02, misplaced=0.10),
    Cause("25 % misplaced", noise=0.02, misplaced=0.25),
    Cause("50 % misplaced", noise=0.02, misplaced=0.50),
    Cause("tutor 25 % in the landmark's frame", tutor=0.25),
    Cause("tutor 50 % in the landmark's frame", tutor=0.50),
    Cause("tutor always in the landmark's frame", tutor=1.0),
    Cause("all people 50 % in the landmark's frame", tutor=0.5, judges=0.5),
    Cause("people differ about near", habit=1.0),
    Cause(
        "5 cm off, tutor 25 % in its frame, people differ",
        noise=0.05,
        tutor=0.25,
        habit=0.5,
    ),
    Cause(
        "25 % misplaced, moved 10 cm, tutor 25 % in its frame",
        misplaced=0.25,
        shift=0.10,
        tutor=0.25,
    ),
)


@dataclass(frozen=True)
class RunScores:
    """The kappas of one run, and the share of the robot's answers that is accepted."""

    people: float
    robot: float
    accepted: float


@dataclass(frozen=True)
class Placement:
    """A place as it is, and as the robot sees it."""

    true: Place
    seen: Configuration


def play_protocol(
    make: Callable[[], Learner[Configuration]],
    cause: Cause,
    chance: np.random.Generator,
) -> RunScores:
    """Play one run of the protocol: 48 lessons and 32 questions."""
    tutor, other = (Person().shift(cause.habit * chance.normal()) for _ in range(2))
    learner = make()
    for key, scene in enumerate(placements(cause, ROUNDS, chance, 0.0)):
        word = _word_said(tutor, scene.true, cause.tutor, chance)
        learner.learn_one(scene.seen, word, key=key)
    way = chance.uniform(-pi, pi)
    asked = list(placements(cause, _TESTS, chance, cause.shift, way))
    answers = [likeliest_word(learner.predict_proba_one(it.seen)) for it in asked]
    judged = [
        [_word_said(judge, it.true, cause.judges, chance) for it in asked]
        for judge in (tutor, other)
    ]
    accepted = [
        _word_chance(judge, it.true, cause.judges, word) >= ACCEPTED
        for judge in (tutor, other)
        for it, word in zip(asked, answers, strict=True)
    ]
    return RunScores(
        people=kappa(judged[0], judged[1]),
        robot=kappa([*judged[0], *judged[1]], answers * 2),
        accepted=float(np.mean(accepted)),
    )


def placements(
    cause: Cause,
    rounds: int,
    chance: np.random.Generator,
    shift: float,
    way: float = 0.0,
) -> Iterator[Placement]:
    """Each place so often, after the landmark was moved by `shift` metres.

    `way` is the angle at which it was moved.
    """
    for _ in range(rounds):
        for place in places_around(_RINGS, _POINTS):
            right, away = np.array(place) + chance.normal(0, _SPREAD, 2)
            seen = np.array([right, away]) + chance.normal(0, 1, 2) * cause.noise
            seen += shift * np.array([cos(way), sin(way)])
            if chance.random() < cause.misplaced:
                seen = chance.uniform(-TABLE, TABLE, 2)
            yield Placement((float(right), float(away)), configuration_at(*seen))


def places_around(rings: Sequence[float], points: int) -> Iterator[Place]:
    """Places on rings around the landmark: metres to the right, and away."""
    for distance, bearing in ring_places(rings, points):
        yield distance * cos(bearing), distance * sin(bearing)


def configuration_at(right: float, away: float) -> Configuration:
    """The book at a place, as the robot sees it from where the viewer is."""
    return Configuration(
        offset=(float(right), float(away), 0.0),
        viewed=_VIEWER,
        target_size=_BOOK,
        landmark_size=_CAR,
    )


def _word_said(
    person: Person, place: Place, own: float, chance: np.random.Generator
) -> str:
    front = _FRONT if chance.random() < own else None
    return person.says(place, chance, front)


def _word_chance(person: Person, place: Place, own: float, word: str) -> float:
    """How likely the person says the word there, in either frame."""
    chances = person.chances(place), person.chances(place, _FRONT)
    return mix_chances(*chances, own).get(word, 0.0)
