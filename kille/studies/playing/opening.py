"""Who plays: the robot and the tutor that a study names, in front of a run's scene."""

from __future__ import annotations

import os
from collections.abc import Mapping
from datetime import UTC, datetime
from random import Random
from typing import Any

from kille.simulation.worlds import COLOURS
from kille.studies.robots import Robot
from kille.studies.robots.persons import Typed
from kille.studies.robots.simulated import Simulated
from kille.studies.robots.whole import Whole
from kille.studies.scenes import WHOLE, Scene
from kille.studies.settings import filled
from kille.studies.study import PERSON, Run, Study, Theory
from kille.studies.theories import agent_of, game_of, language_of
from kille.studies.theories.meanings import meanings_of
from kille.studies.tutors import SETTINGS
from kille.studies.tutors.holding import Manner
from kille.studies.tutors.keyboard import Keyboard
from kille.studies.tutors.own import maker_of
from kille.studies.tutors.places import Placing, Speaker, person, rated
from kille.studies.tutors.scripted import scripted
from kille.studies.tutors.several import Several
from kille.studies.tutors.simulated import Simulated as SimulatedTutor
from kille.studies.tutors.tutor import Tutor
from kille.studies.tutors.words import Words

CLOCK = datetime(2017, 1, 1, tzinfo=UTC)
"""What time it always is for the whole robot, so that its memory is the same."""


def robot_of(study: Study, run: Run, scene: Scene) -> Robot:
    """The robot that has the theory of a run."""
    theory = study.theories[run.theory]
    if theory.mode == PERSON:
        return Typed(theory.language)
    if study.scenes[run.scene].kind in WHOLE:
        theatre = scene.theatre  # type: ignore[attr-defined]
        return Whole(agent_of(theory, theatre, scans=1, now=lambda: CLOCK), theatre)
    taught = study.scenes[run.scene].settings.get("colours") == "taught"
    game = game_of(theory, scene.start, colours=() if taught else None)
    return Simulated(game, language_of(theory), meanings_of(theory))


def tutor_of(study: Study, run: Run, name: str, scene: Scene) -> Tutor:
    """The tutor of this name, as he is in a run: he speaks the robot's language."""
    named, theory = study.tutors[name], study.theories[run.theory]
    set_ = filled(named.settings, SETTINGS[named.kind])
    match named.kind:
        case "scripted":
            return scripted(name, study.folder / os.path.expanduser(set_["file"]))
        case "own":
            words = Words(theory.language)
            make = maker_of(set_["make"], study.folder, study.consent)
            return make(name=name, words=words, **set_["settings"])
        case "keyboard":
            return Keyboard(name, theory.language)
        case "several":
            some = tuple(tutor_of(study, run, it, scene) for it in set_["of"])
            return Several(some, set_["turns"])
    return _simulated(study, run, name, set_, theory, scene)


def _simulated(
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
        placing = _placing(study, set_, chance)
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
        orients=set_["orients"],
    )
    return SimulatedTutor(name, manner)


def _placing(study: Study, set_: Mapping[str, Any], chance: Random) -> Placing:
    if "folder" in set_:
        return rated(study.folder / os.path.expanduser(set_["folder"]))
    return person(set_["inside"], set_["outside"], set_["habit"], chance)
