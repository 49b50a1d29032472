"""What only the world, or the study, can tell is wrong with scenes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from random import Random
from urllib.parse import quote

from kille.lab.errors import StudyError
from kille.lab.results import ExperimentError
from kille.lab.scenes.occasions import KINDS as WORDS
from kille.lab.scenes.occasions import Scene
from kille.lab.scenes.scene import SETTINGS, opened
from kille.lab.settings import Wrong, filled, no_folder, unknown
from kille.lab.study import Named, Run, Study
from kille.sensors.sensor import SensorError


def faults(named: Named, study: Study) -> Iterator[Wrong]:
    """What is wrong with a scene in this study: its data are not there, or too few."""
    if named.kind not in SETTINGS:
        return
    wrong = [*_unfit(named), *_without_data(named, study)]
    yield from wrong
    if wrong:
        return
    try:
        scene = opened(study, Run("", "", named.name, 0))
        yield from _empty(scene, named, study)
    except (ExperimentError, SensorError) as error:
        yield (), str(error)
    except StudyError as error:
        yield from (((), it) for it in error.faults)


def _unfit(named: Named) -> Iterator[Wrong]:
    """What is wrong with what is set of a scene."""
    if named.kind == "rendered":
        yield from _unrendered(named)
    set_ = filled(named.settings, SETTINGS[named.kind])
    if "target" in set_ and set_["target"] == set_["landmark"]:
        told = f"both target and landmark are the {set_['target']}: name two kinds"
        yield ("target" if "target" in named.settings else "landmark",), told
    for key in ("kinds", "hues", "rings"):
        if named.kind in ("drawn", "around") and key in set_ and not set_[key]:
            yield (key,), f"{key} of {named.name} is empty: name some, or leave it out"


def _without_data(named: Named, study: Study) -> Iterator[Wrong]:
    folder = named.settings.get("folder")
    if folder is None:
        return
    if told := no_folder(study.folder / os.path.expanduser(folder)):
        yield ("folder",), told


def _empty(scene: Scene, named: Named, study: Study) -> Iterator[Wrong]:
    """Phases that are of what is new, where nothing is kept for later."""
    for phase in study.phases:
        if phase.settings.get("of") != "new":
            continue
        kind = WORDS[phase.settings.get("what", "nouns")]
        if not scene.round(kind, True, Random(0)):
            told = f"nothing is kept in {named.name} for the phase {phase.name}, which"
            yield ("new",), f"{told} is of what is new: {_keeping(named)}"


def _keeping(named: Named) -> str:
    """What has something kept for later."""
    set_ = filled(named.settings, SETTINGS[named.kind])
    if named.kind == "captures":
        return "name the scenes that are, new = […]"
    if named.kind in ("pictures", "statements") and set_["new"]:
        return "write a smaller each"
    return f"write new = {set_['new'] + 1}"


def _unrendered(named: Named) -> Iterator[Wrong]:
    """What cannot be rendered, of the things that a scene names, and how."""
    from kille.sensors.synthetic import open_synthetic
    from kille.sensors.synthetic.catalogue import TOY_NAMES

    set_ = filled(named.settings, SETTINGS["rendered"])
    things = [("kinds", name) for name in set_["kinds"]]
    things += [(key, set_[key]) for key in ("target", "landmark")]
    for key, name in things:
        if name not in TOY_NAMES:
            yield (
                (key,),
                f"there is no {name} to be rendered: {unknown(name, TOY_NAMES)}",
            )
    try:
        open_synthetic(f"synthetic:empty?faults={quote(set_['faults'])}").close()
    except SensorError as error:
        yield ("faults",), str(error)
