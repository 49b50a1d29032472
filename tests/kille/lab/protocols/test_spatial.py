"""The paper's spatial protocol with simulated people."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kille.lab.protocols.causes import Cause, play_protocol
from kille.lab.protocols.rendered_scenes import play_rendered_scenes
from kille.lab.protocols.spatial import paper, published_agreement
from kille.lab.results import silent
from kille.lab.tutors.spatial_judges import WORDS, Person
from kille.perception.relations import PaperRelations, RelationMemory

METHODS = {"default": RelationMemory, "kille": PaperRelations}


def robots(cause: Cause, runs: int = 12) -> tuple[float, float, float]:
    """The mean kappa of the people, that of the robot, and what was accepted."""
    found = [
        play_protocol(RelationMemory, cause, np.random.default_rng([0, run]))
        for run in range(runs)
    ]
    return (
        float(np.mean([it.people for it in found])),
        float(np.mean([it.robot for it in found])),
        float(np.mean([it.accepted for it in found])),
    )


def test_the_robot_agrees_with_people_as_well_as_they_do() -> None:
    people, robot, accepted = robots(Cause("none"))
    assert robot >= people
    assert accepted >= 0.9


def test_it_bears_places_that_are_off() -> None:
    assert robots(Cause("noise", noise=0.05))[1] >= 0.35
    assert robots(Cause("wrong", noise=0.02, misplaced=0.25))[1] >= 0.25


def test_a_tutor_in_another_frame_teaches_other_words() -> None:
    _, robot, accepted = robots(Cause("frame", tutor=1.0), runs=4)
    assert robot < 0.1
    assert accepted < 0.5


@pytest.mark.parametrize("front", [None, 0.0, 2.0])
def test_a_person_says_one_of_six_words(front: float | None) -> None:
    for bearing in np.linspace(-3, 3, 7):
        chances = Person().chances((math.cos(bearing), math.sin(bearing)), front)
        assert set(chances) == set(WORDS)
        assert sum(chances.values()) == pytest.approx(1.0)


def test_frames_of_reference() -> None:
    """What faces the viewer has its left at the viewer's right."""
    right = (0.3, 0.0)
    assert Person().chances(right)["to the right of"] > 0.8
    facing_the_viewer = Person().chances(right, front=-math.pi / 2)
    assert facing_the_viewer["to the left of"] > 0.8
    ahead = Person().chances(right, front=0.0)
    assert ahead["in front of"] > 0.8


def test_people_differ_in_their_habits() -> None:
    shares = [Person().shift(habit).inside for habit in (-1.0, 0.0, 1.0)]
    assert shares == sorted({*shares})
    assert shares[1] == pytest.approx(0.45)


def test_the_published_kappas_follow_from_their_margins() -> None:
    """Agreement on 17 of 32 and on 15 of 64, with the words used as often as shown."""
    (_, _, _, judges), (_, _, _, robot) = published_agreement().rows
    assert judges == pytest.approx(0.4313, abs=5e-4)
    assert robot == pytest.approx(0.0537, abs=5e-4)


def test_the_report_has_a_row_for_each_cause_and_is_seeded(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kille.lab.protocols.rendered_scenes.POINTS", 2)
    monkeypatch.setattr("kille.lab.protocols.rendered_scenes.RINGS", (0.25,))
    causes = (Cause("none"), Cause("places 8 cm off", noise=0.08))
    shares: list[float] = []

    def heard(share: float, doing: str) -> None:
        shares.append(share)

    one = paper(METHODS, seed=3, progress=heard, runs=1, causes=causes)
    other = paper(METHODS, seed=3, progress=silent, runs=1, causes=causes)
    assert one.tables == other.tables
    assert shares == sorted(shares)
    agreement, why, _, rendered = one.tables
    assert [row[0] for row in why.rows] == ["none", "places 8 cm off"]
    assert [row[0] for row in agreement.rows] == ["the paper's robot", *METHODS]
    assert [row[0] for row in rendered.rows] == [*METHODS]
    assert {it.kind for it in one.figures} == {"bars", "map"}


def test_rendered_scenes_seen_by_the_robots_own_eyes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kille.lab.protocols.rendered_scenes.POINTS", 4)
    table = play_rendered_scenes(METHODS, seed=2, progress=silent)
    assert all(float(row[-1] or 0) > 0.7 for row in table.rows)
