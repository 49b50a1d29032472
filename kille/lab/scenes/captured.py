"""Things as a camera has taken them: pictures by category, or labelled frames."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from random import Random
from typing import Any

from kille.lab.errors import StudyError
from kille.lab.scenes.galleries import Gallery, open_gallery
from kille.lab.scenes.labelled import LabelledScenes, open_scenes
from kille.lab.scenes.places import MIDDLE
from kille.lab.scenes.robot_views import CaptureView, PictureView, Theatre
from kille.lab.scenes.scene import Occasion, Scene
from kille.lab.settings import suggest_name
from kille.lab.worlds.worlds import Thing, World
from kille.sensors.captures import Shot


@dataclass(frozen=True)
class Captured(Scene):
    """Pictures, or frames, of things: some are taught, and others kept for later.

    What is `labelled` in them may be in frames that another seed draws.
    """

    taught: tuple[Occasion, ...]
    kept: tuple[Occasion, ...]
    theatre: Theatre = field(compare=False)
    labelled: tuple[str, ...] = ()

    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """Each of them once."""
        return self.kept if new else self.taught


@lru_cache(8)
def _open_gallery(folder: Path) -> Gallery:
    """The pictures in a folder, which are opened once to try them."""
    return open_gallery(folder, folder.name)


@lru_cache(8)
def _open_scenes(folder: Path) -> LabelledScenes:
    return open_scenes(folder, folder.name)


@lru_cache(512)
def _outlined_names(shot: Shot) -> tuple[str, ...]:
    """The names of the things in a frame."""
    return tuple(sorted(shot.read().outlines))


WordView = tuple[str, object]
"""A word and a view."""


def _scene_of(
    taught: Sequence[WordView], kept: Sequence[WordView], name: str
) -> Captured:
    things = tuple(Thing(word, "") for word, _ in (*taught, *kept))
    start = World(things)
    occasions = [
        Occasion("noun", start.move(x, MIDDLE).point_at(x), x, view=view, group=word)
        for x, (word, view) in enumerate((*taught, *kept), start=1)
    ]
    first = len(taught)
    return Captured(
        start, tuple(occasions[:first]), tuple(occasions[first:]), Theatre(name)
    )


def open_pictures(folder: Path, set_: Mapping[str, Any], chance: Random) -> Captured:
    """Pictures of each category, drawn by chance: so many to teach, and others.

    `ExperimentError` where there are none.
    """
    gallery = _open_gallery(folder)
    taught: list[WordView] = []
    kept: list[WordView] = []
    for word in set_["kinds"] or gallery.categories:
        if word not in gallery.categories:
            why = suggest_name(word, gallery.categories)
            raise StudyError([f"{folder} has no pictures of {word}: {why}"])
        paths = gallery.categories[word]
        drawn = chance.sample(paths, len(paths))
        each, new = set_["each"], set_["new"]
        taught += ((word, PictureView(it)) for it in drawn[:each])
        kept += ((word, PictureView(it)) for it in drawn[each : each + new])
    return _scene_of(taught, kept, folder.name)


def open_captures(folder: Path, set_: Mapping[str, Any], chance: Random) -> Captured:
    """The things in labelled frames: of some scenes to teach, of others for later."""
    scenes = _open_scenes(folder)
    if not scenes.shots:
        told = f"{folder} has no folders of labelled captures, one for each scene"
        raise StudyError([told])
    new = set_["new"] or [it for it in scenes.shots if it not in set_["teach"]][-1:]
    teach = set_["teach"] or [it for it in scenes.shots if it not in new]
    if not teach:
        told = f"all scenes of {folder} are kept for later: name some that are taught"
        raise StudyError([f"{told}, teach = […]"])
    if both := [it for it in teach if it in new]:
        raise StudyError([f"{both[0]} is taught, so it is none that is kept for later"])
    missing = [it for it in (*teach, *new) if it not in scenes.shots]
    if missing:
        known = ", ".join(scenes.shots)
        raise StudyError([f"{folder} has no scene {missing[0]}: it has {known}"])

    def views_of(names: Sequence[str]) -> Iterator[WordView]:
        for scene in names:
            shots = scenes.shots[scene]
            count = min(set_["each"], len(shots))
            for number in sorted(chance.sample(range(len(shots)), count)):
                for name in _outlined_names(shots[number]):
                    yield name, CaptureView(folder / scene, number, name)

    captured = _scene_of(list(views_of(teach)), list(views_of(new)), folder.name)
    labelled = {thing for it in (*teach, *new) for thing in scenes.things(it)}
    return replace(captured, labelled=tuple(sorted(labelled)))
