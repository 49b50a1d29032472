"""Which protocols there are for which data; data is recognised by its content."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol as Shape

from kille.lab.results import ExperimentError, Progress, Result
from kille.lab.settings import nearest_name, why_no_folder
from kille.lab.theories.candidates import Make, MethodFailedError, Methods


class RunProtocol(Shape):
    """A protocol with its data, which measures methods."""

    def __call__(self, methods: Methods, *, seed: int, progress: Progress) -> Result:
        """The result; the same seed gives the same numbers."""
        ...


@dataclass(frozen=True)
class Plan:
    """A protocol with its name; the `usual` ones are run when none is named.

    `compares` are the names of what it compares instead of methods, if it does.
    """

    name: str
    run: RunProtocol
    usual: bool = True
    compares: tuple[str, ...] = ()


OBJECTS = {
    "paper": "the simulated table",
    "rotation": "the simulated table",
    "specimens": "the simulated table",
    "growth": "any data",
    "shots": "pictures by category",
    "degrees": "pictures by category",
    "even-odd": "pictures by category",
    "halves": "pictures by category",
    "scenes": "labelled scenes",
    "regions": "labelled captures",
}
"""The protocols for objects, and which data each is for."""

RELATIONS = {
    "paper": "simulated judges",
    "judgements": "people's judgements",
}
"""The protocols for relations, and which data each is for."""

_KNOWN = (
    "a folder category/picture.png, a folder of labelled scenes, a folder of labelled "
    "captures with index.json, or a folder of OBJ meshes"
)


def object_plans(
    data: str | None, teach: Sequence[str] = (), ask: Sequence[str] = ()
) -> tuple[Plan, ...]:
    """The protocols for objects with this data, the usual ones first.

    No data means the simulated table with the paper's ten things. ExperimentError and
    SensorError for data that nothing can be measured with.
    """
    kind = None if data is None else _plans_for_data(data)
    if (teach or ask) and kind is not _scene_plans:
        raise ExperimentError(
            "scenes to teach or to ask are named for a folder of labelled scenes only"
        )
    if data is None or kind is None:
        return _table_plans()
    if kind is _scene_plans:
        return _scene_plans(data, teach, ask)
    return kind(data)


def choose_plans(
    plans: Sequence[Plan], name: str | None, known: Mapping[str, str]
) -> list[Plan]:
    """The plan of this name, or the usual ones; ExperimentError if there is none.

    `known` are all protocols there are, and which data each is for.
    """
    if name is None:
        return [plan for plan in plans if plan.usual]
    found = [plan for plan in plans if plan.name == name]
    if found:
        return found
    here = [plan.name for plan in plans]
    if name in known:
        raise ExperimentError(
            f"the protocol {name} is for {known[name]}; "
            f"for this data there is {', '.join(here)}"
        )
    meant = nearest_name(name, here, "{}") or nearest_name(name, known, "{}")
    hint = f"did you mean {meant}?" if meant else f"there is {', '.join(here)}"
    raise ExperimentError(f"there is no protocol {name}: {hint}")


def run_plan(
    plan: Plan,
    methods: Methods,
    *,
    seed: int,
    progress: Progress,
    failed: Callable[[MethodFailedError], None],
) -> tuple[Result | None, dict[str, Make]]:
    """The result, and the methods that did not fail; without any there is no result.

    `failed` hears of each method that fails; the protocol is run again without it.
    """
    able = dict(methods)
    while able:
        try:
            return plan.run(able, seed=seed, progress=progress), able
        except MethodFailedError as failure:
            failed(failure)
            del able[failure.name]
    return None, able


# --- what data is --------------------------------------------------------------------


def _plans_for_data(data: str) -> Callable[..., tuple[Plan, ...]]:
    folder = _existing_folder(data)
    if kind := _plans_for(folder):
        return kind
    inner = [it for it in sorted(folder.iterdir()) if it.is_dir()]
    if known := [it.name for it in inner if _plans_for(it)]:
        named = ", ".join(f"{data.rstrip('/')}/{name}" for name in known)
        raise ExperimentError(f"{data} holds several collections, name one: {named}")
    if not any(folder.iterdir()):
        raise ExperimentError(f"{data} is empty; expected {_KNOWN}")
    raise ExperimentError(f"{data}: nothing here is known; expected {_KNOWN}")


def _plans_for(folder: Path) -> Callable[..., tuple[Plan, ...]] | None:
    """What makes the plans for the content of a folder; None if it is not known."""
    from kille.lab.scenes.galleries import is_gallery
    from kille.lab.scenes.labelled import is_scenes
    from kille.sensors.captures import description_of

    if is_scenes(folder):
        return _scene_plans
    if description_of(folder) is not None:
        return _capture_plans
    if any(folder.glob("*.obj")) or any(folder.glob("*/*.obj")):
        return _mesh_plans
    return _picture_plans if is_gallery(folder) else None


def _existing_folder(data: str) -> Path:
    folder = Path(data).expanduser()
    if told := why_no_folder(folder):
        raise ExperimentError(f"{told}; expected {_KNOWN}" if folder.exists() else told)
    return folder


def _table_plans() -> tuple[Plan, ...]:
    from kille.lab.protocols import objects, variations

    return (
        Plan("paper", objects.paper),
        Plan("rotation", variations.rotation),
        Plan("specimens", variations.specimens),
        *_growth_plans(),
    )


def _mesh_plans(data: str) -> tuple[Plan, ...]:
    from kille.lab.protocols import objects, variations
    from kille.sensors.synthetic import obj_files

    things = tuple(obj_files.find_meshes(Path(data).expanduser()))
    if len(things) < 2:
        raise ExperimentError(f"{data}: it takes two meshes at least to tell apart")
    return (
        Plan("paper", partial(objects.paper, things=things, meshes=data)),
        Plan("rotation", partial(variations.rotation, things=things, meshes=data)),
        *_growth_plans(),
    )


def _picture_plans(data: str) -> tuple[Plan, ...]:
    from kille.lab.protocols import degrees, picture_splits, shots
    from kille.lab.scenes.galleries import open_gallery

    gallery = open_gallery(Path(data).expanduser(), data)
    return (
        Plan("even-odd", partial(picture_splits.every_other, gallery)),
        Plan("halves", partial(picture_splits.halves, gallery)),
        Plan("shots", partial(shots.shots, gallery), usual=gallery.least > 1),
        Plan("degrees", partial(degrees.degrees, gallery), usual=gallery.least > 1),
        *_growth_plans(),
    )


def _scene_plans(
    data: str, teach: Sequence[str], ask: Sequence[str]
) -> tuple[Plan, ...]:
    from kille.lab.protocols import scenes
    from kille.lab.scenes import labelled

    found = labelled.open_scenes(Path(data).expanduser(), data)
    split = labelled.splits(found, teach, ask)
    return (
        Plan("scenes", partial(scenes.across, found, split)),
        *_region_plans(data),
        *_growth_plans(),
    )


def _capture_plans(data: str) -> tuple[Plan, ...]:
    return (*_region_plans(data), *_growth_plans())


def _region_plans(data: str) -> tuple[Plan, ...]:
    from kille.lab.protocols.regions import captures, regions
    from kille.perception.segment import SEGMENTATIONS

    found = captures(Path(data).expanduser())

    def measure_regions(methods: Methods, *, seed: int, progress: Progress) -> Result:
        """Regions are found before any learner sees them, and without chance."""
        return regions(found, progress=progress)

    return (Plan("regions", measure_regions, compares=tuple(SEGMENTATIONS)),)


def _growth_plans() -> tuple[Plan, ...]:
    from kille.lab.protocols.growth import growth

    return (Plan("growth", growth, usual=False),)


# --- relations -----------------------------------------------------------------------


def relation_plans(data: str | None) -> tuple[Plan, ...]:
    """The protocol for relations: simulated judges, or people's own judgements.

    ExperimentError for a folder that holds none that are known.
    """
    from kille.lab.protocols import judgements, spatial
    from kille.lab.scenes import published_judgements

    if data is None:
        return (Plan("paper", spatial.paper),)
    study = published_judgements.read(_existing_folder(data))
    return (Plan("judgements", partial(judgements.judgements, study)),)
