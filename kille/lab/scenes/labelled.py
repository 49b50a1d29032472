"""Labelled scenes to teach and to ask in, and how they are parted.

The outlines of labelled captures are the tutor's finger: they say which thing is meant,
in lessons and in questions, and nothing else is read off them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from kille.lab.results import ExperimentError
from kille.lab.scenes.stills import Lesson, look_at_outlined
from kille.sensors.captures import Shot, description_of, is_sequence, read_sequence


@dataclass(frozen=True, eq=False)
class LabelledScenes:
    """Labelled scenes by name; what is seen in one is computed once."""

    name: str
    shots: Mapping[str, tuple[Shot, ...]]
    seen: dict[str, list[Lesson]]

    def things(self, scene: str) -> set[str]:
        """The names of what is labelled in a scene."""
        return {name for shot in self.shots[scene] for name in shot.things.values()}

    def lessons(self, scene: str) -> list[Lesson]:
        """Each thing in each frame, pointed at, and its name."""
        if scene not in self.seen:
            frames = [shot.read() for shot in self.shots[scene]]
            self.seen[scene] = [
                (look_at_outlined(frame, name).percepts[0], name)
                for frame in frames
                for name in frame.outlines
            ]
        return self.seen[scene]


@dataclass(frozen=True)
class Split:
    """The scenes to teach in, and the one to ask in."""

    teach: tuple[str, ...]
    ask: str

    def __str__(self) -> str:
        return f"{' + '.join(self.teach)} → {self.ask}"


def is_scenes(folder: Path) -> bool:
    """Whether the folder holds folders of labelled captures that follow each other."""
    return any(_is_labelled(it) for it in folder.iterdir() if it.is_dir())


def open_scenes(folder: Path, name: str) -> LabelledScenes:
    """The labelled scenes in this folder; SensorError if one is broken."""
    inner = sorted(it for it in folder.iterdir() if it.is_dir())
    described = {it.name: description_of(it) for it in inner if _is_labelled(it)}
    shots = {
        scene: read_sequence(description)
        for scene, description in described.items()
        if description is not None
    }
    return LabelledScenes(name, shots, {})


def _is_labelled(folder: Path) -> bool:
    description = description_of(folder)
    return (
        description is not None
        and any(folder.glob("*_label.png"))
        and is_sequence(description)
    )


def splits(
    scenes: LabelledScenes, teach: Sequence[str], ask: Sequence[str]
) -> list[Split]:
    """The requested splits; by default each scene is asked, and the others taught.

    ExperimentError for a scene that is not there, and where no thing of an asked scene
    is taught in any other.
    """
    for scene in (*teach, *ask):
        if scene not in scenes.shots:
            there = ", ".join(scenes.shots)
            raise ExperimentError(f"{scenes.name} has no scene {scene}: it has {there}")
    if twice := sorted({*teach} & {*ask}):
        raise ExperimentError(f"the scene {twice[0]} is both taught and asked")
    found = [
        Split(tuple(teach or (it for it in scenes.shots if it != scene)), scene)
        for scene in (ask or [it for it in scenes.shots if it not in teach])
    ]
    sensible = [split for split in found if taught_things(scenes, split)]
    if not sensible:
        raise ExperimentError(
            f"{scenes.name}: nothing that is taught in one scene is seen in another"
        )
    return sensible


def taught_things(scenes: LabelledScenes, split: Split) -> set[str]:
    """The things that are both taught and asked for."""
    taught = {thing for scene in split.teach for thing in scenes.things(scene)}
    return taught & scenes.things(split.ask)
