"""Scenes by their kinds: what may be set of each, and how one is opened for a run."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from random import Random
from typing import Protocol

from kille.experiments.results import ExperimentError
from kille.sensors.sensor import SensorError
from kille.simulation.worlds import COLOURS, FRONTS, KINDS, World
from kille.studies.errors import StudyError
from kille.studies.scenes.occasions import KINDS as WORDS
from kille.studies.scenes.occasions import Occasion
from kille.studies.settings import Setting, Settings, filled, unknown
from kille.studies.study import Named, Run, Study

__all__ = ["SETTINGS", "WHOLE", "Scene", "faults", "opened"]

WHOLE = frozenset({"rendered", "pictures", "captures"})
"""The kinds of scenes that the whole robot sees."""

_NOISE: Settings = {
    "noise": Setting(float, 0.05, about="how much looks and things of a kind differ"),
    "off": Setting(
        float, 0.0, about="metres: the deviation of places as they are seen"
    ),
    "astray": Setting(float, 0.0, most=1.0, about="the share of places seen anywhere"),
    "colours": Setting(str, "known", among=("known", "taught")),
}
_SPECIMENS: Settings = {
    "each": Setting(int, 1, least=1, about="things of each kind that are taught"),
    "new": Setting(int, 1, about="things of each kind that are kept for later"),
}

SETTINGS: Mapping[str, Settings] = {
    "drawn": {
        **_NOISE,
        **_SPECIMENS,
        "kinds": Setting(str, KINDS, among=KINDS, several=True),
        "hues": Setting(str, tuple(COLOURS), among=tuple(COLOURS), several=True),
        "in_view": Setting(int, 1, least=1, most=100, about="things in view at once"),
    },
    "around": {
        **_NOISE,
        "target": Setting(str, "book", among=KINDS),
        "landmark": Setting(str, "car", among=KINDS),
        "front": Setting(str, "right", among=("", "any", *FRONTS)),
        "rings": Setting(float, (0.12, 0.28), least=0.02, most=0.45, several=True),
        "points": Setting(int, 8, least=1, about="places on each ring"),
        "spread": Setting(
            float, 0.01, about="metres: how exactly a thing is put there"
        ),
        "shift": Setting(float, 0.0, about="metres the landmark has moved when asked"),
    },
    "statements": {
        "folder": Setting(str, needed=True, about="people's judgements of places"),
        "each": Setting(
            int, 8, least=1, about="statements of each word that are taught"
        ),
        "new": Setting(int, 8, about="statements of each word that are kept for later"),
        "words": Setting(str, (), several=True, about="only these words"),
        "colours": Setting(str, "known", among=("known", "taught")),
    },
    "rendered": {
        "kinds": Setting(str, (), several=True, about="all ten where none is named"),
        "each": Setting(
            int, 1, least=1, about="specimens of each kind that are taught"
        ),
        "new": Setting(int, 1, about="specimens of each kind that are kept for later"),
        "target": Setting(str, "book"),
        "landmark": Setting(str, "car"),
        "faults": Setting(str, "all"),
    },
    "pictures": {
        "folder": Setting(str, needed=True, about="folders of pictures by category"),
        "each": Setting(int, 3, least=1, about="pictures of each word that are taught"),
        "new": Setting(int, 3, about="pictures of each word that are kept for later"),
        "kinds": Setting(str, (), several=True, about="all where none is named"),
    },
    "captures": {
        "folder": Setting(str, needed=True, about="folders of labelled captures"),
        "teach": Setting(str, (), several=True, about="the scenes that are taught"),
        "new": Setting(str, (), several=True, about="the scenes kept for later"),
        "each": Setting(int, 2, least=1, about="frames of each scene"),
    },
}
"""What may be set of scenes, kind by kind."""


class Scene(Protocol):
    """What there is to talk of in a run."""

    @property
    def start(self) -> World:
        """All things that there are, as the run begins."""
        ...

    @property
    def kinds(self) -> tuple[str, ...]:
        """What kinds of things there are."""
        ...

    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """An occasion for each thing, or place, that words of a kind may be said of.

        Those that are `new` are kept from all the others.
        """
        ...


def faults(named: Named, study: Study) -> Iterator[str]:
    """What is wrong with a scene in this study: its data are not there, or too few."""
    wrong = list(_unfit(named, study))
    yield from wrong
    if wrong:
        return
    try:
        scene = opened(study, Run("", "", named.name, 0))
        yield from _empty(scene, named, study)
    except (ExperimentError, SensorError) as error:
        yield str(error)
    except StudyError as error:
        yield from error.faults


def _unfit(named: Named, study: Study) -> Iterator[str]:
    """What is wrong with what is set of a scene."""
    if named.kind == "rendered":
        yield from _unrendered(named)
    set_ = filled(named.settings, SETTINGS[named.kind])
    if "target" in set_ and set_["target"] == set_["landmark"]:
        yield f"both target and landmark are the {set_['target']}: name two kinds"
    for key in ("kinds", "hues", "rings"):
        if named.kind in ("drawn", "around") and key in set_ and not set_[key]:
            yield f"{key} of {named.name} is empty: name some, or leave it out"
    folder = set_.get("folder")
    if folder is not None and not _path(folder, study).is_dir():
        yield f"there is no folder {folder}: name that of the data, from {study.folder}"


def _empty(scene: Scene, named: Named, study: Study) -> Iterator[str]:
    """Phases that are of what is new, where nothing is kept for later."""
    for phase in study.phases:
        if phase.settings.get("of") != "new":
            continue
        kind = WORDS[phase.settings.get("what", "nouns")]
        if not scene.round(kind, True, Random(0)):
            yield (
                f"nothing is kept in {named.name} for the phase {phase.name}, which is "
                "of what is new: write new = 1"
            )


def _unrendered(named: Named) -> Iterator[str]:
    """What cannot be rendered, of the things that a scene names."""
    from kille.sensors.synthetic.catalogue import NAMES

    set_ = filled(named.settings, SETTINGS["rendered"])
    for name in dict.fromkeys((*set_["kinds"], set_["target"], set_["landmark"])):
        if name not in NAMES:
            yield f"there is no {name} to be rendered: {unknown(name, NAMES)}"


def _path(folder: str, study: Study) -> Path:
    return study.folder / os.path.expanduser(folder)


def opened(study: Study, run: Run) -> Scene:
    """The scene of a run: drawn by its seed, whoever plays."""
    named = study.scenes[run.scene]
    set_ = filled(named.settings, SETTINGS[named.kind])
    chance = Random(f"scene {run.scene} {run.seed}")
    make = _maker(named.kind)
    if "folder" in set_:
        make = partial(make, _path(set_["folder"], study))
    return make(set_, chance)


def _maker(kind: str) -> Callable[..., Scene]:
    """What makes scenes of a kind. Eyes are imported by those who need them."""
    match kind:
        case "drawn":
            from kille.studies.scenes.drawn import drawn

            return drawn
        case "around":
            from kille.studies.scenes.around import around

            return around
        case "statements":
            from kille.studies.scenes.statements import statements

            return statements
        case "rendered":
            from kille.studies.scenes.rendered import rendered

            return rendered
    from kille.studies.scenes.captured import captures, pictures

    return {"pictures": pictures, "captures": captures}[kind]
