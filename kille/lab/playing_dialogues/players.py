"""Who plays: the robot and the tutor that a study names, in front of a run's scene."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from random import Random
from typing import Any

from kille.lab.people.person_as_robot import TypedRobot
from kille.lab.people.person_as_tutor import Keyboard
from kille.lab.robots import Robot
from kille.lab.robots.simulated import SimulatedRobot
from kille.lab.robots.whole import WholeRobot
from kille.lab.scenes import WHOLE, Scene
from kille.lab.settings import fill_settings
from kille.lab.study import PERSON, Run, Study, Theory
from kille.lab.theories import agent_of, game_of, language_of
from kille.lab.theories.meanings import meanings_of
from kille.lab.tutors import SETTINGS
from kille.lab.tutors.beliefs import Manner
from kille.lab.tutors.scripted import read_script
from kille.lab.tutors.several import Several
from kille.lab.tutors.simulated import SimulatedTutor as SimulatedTutor
from kille.lab.tutors.spatial_judges import Person, Placing, Speaker, read_ratings
from kille.lab.tutors.tutor import Tutor
from kille.lab.tutors.user_tutors import load_tutor_maker
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import COLOURS

CLOCK = datetime(2017, 1, 1, tzinfo=UTC)
"""What time it always is for the whole robot, so that its memory is the same."""


def robot_of(study: Study, run: Run, scene: Scene) -> Robot:
    """The robot that has the theory of a run."""
    theory = study.theories[run.theory]
    if theory.mode == PERSON:
        return TypedRobot(theory.language)
    if study.scenes[run.scene].kind in WHOLE:
        theatre = scene.theatre  # type: ignore[attr-defined]
        return WholeRobot(
            agent_of(theory, theatre, scans=1, now=lambda: CLOCK), theatre
        )
    taught = study.scenes[run.scene].settings.get("colours") == "taught"
    game = game_of(theory, scene.start, colours=() if taught else None)
    return SimulatedRobot(game, language_of(theory), meanings_of(theory))


def tutor_of(study: Study, run: Run, name: str, scene: Scene) -> Tutor:
    """The tutor of this name in a run, who speaks the robot's language."""
    named, theory = study.tutors[name], study.theories[run.theory]
    set_ = fill_settings(named.settings, SETTINGS[named.kind])
    match named.kind:
        case "scripted":
            return read_script(name, study.path(set_["file"]))
        case "own":
            words = Words(theory.language)
            make = load_tutor_maker(set_["make"], study.folder, study.consent)
            return make(name=name, words=words, **set_["settings"])
        case "keyboard":
            return Keyboard(name, theory.language)
        case "several":
            some = tuple(tutor_of(study, run, it, scene) for it in set_["of"])
            return Several(some, set_["turns"])
    return _simulated_tutor(study, run, name, set_, theory, scene)


def _simulated_tutor(
    study: Study,
    run: Run,
    name: str,
    set_: Mapping[str, Any],
    theory: Theory,
    scene: Scene,
) -> Tutor:
    frame = set_["frame"]
    own = {"viewer": 0.0, "landmark": 1.0}.get(frame, frame)
    draws = set_["places"] == "drawn"

    def speaker(of: str) -> Speaker:
        chance = Random(f"{of} {name} {run.scene} {run.seed}")
        placing = _placing_of(study, set_, chance)
        return Speaker(placing, float(own), draws, tuple(set_["vocabulary"]))

    manner = Manner(
        Words(theory.language, set_["calls"]),
        speaker("tutor"),
        speaker("judge"),
        kinds=scene.kinds,
        hues=tuple(COLOURS),
        vocabulary=tuple(set_["vocabulary"]),
        errors=set_["errors"],
        feedback=set_["feedback"],
        patience=set_["patience"],
        politeness=set_["politeness"],
        matters=tuple(set_["matters"]),
        orients=set_["orients"],
    )
    return SimulatedTutor(name, manner)


def _placing_of(study: Study, set_: Mapping[str, Any], chance: Random) -> Placing:
    if "folder" in set_:
        return read_ratings(study.path(set_["folder"]))
    usual = Person(set_["inside"], set_["outside"])
    return usual.shift(set_["habit"] * chance.gauss(0, 1))
