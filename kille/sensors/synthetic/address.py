"""Names of simulated sources: `synthetic`, `synthetic:desk?seed=7&faults=noise`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

from kille.sensors.sensor import SensorError
from kille.sensors.synthetic.faults import FAULTS
from kille.sensors.synthetic.layout import SCENES
from kille.sensors.synthetic.name_recognition import recognise_name


@dataclass(frozen=True)
class SceneAddress:
    """A scene, the seed of all chance, the faults in force, and a place of meshes.

    `specimen` says which of the things of each kind are shown, 0 the catalogue's own.
    """

    scene: str = "desk"
    seed: int = 0
    faults: frozenset[str] = frozenset(FAULTS)
    meshes: Path | None = None
    specimen: int = 0


def parse_address(name: str) -> SceneAddress:
    """The address that a name such as `synthetic:desk?seed=7` gives.

    Raises SensorError for a scene, option, fault or value that is not known.

    >>> parse_address("synthetic:empty?seed=7&faults=none")
    SceneAddress(scene='empty', seed=7, faults=frozenset(), meshes=None, specimen=0)
    """
    source, _, query = name.strip().partition("?")
    kind, _, scene = source.partition(":")
    recognise_name("source", kind, ["synthetic"])
    options = dict(_option(text) for text in query.split("&") if text)
    meshes = options.get("meshes")
    return SceneAddress(
        scene=recognise_name("scene", scene or "desk", SCENES),
        seed=_number("seed", options.get("seed", "0")),
        faults=_faults(options.get("faults", "all")),
        meshes=None if meshes is None else Path(meshes).expanduser(),
        specimen=_number("specimen", options.get("specimen", "0")),
    )


def _option(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    option = recognise_name("option", key, ["seed", "faults", "meshes", "specimen"])
    if not equals or not value:
        raise SensorError(f"option '{option}' has no value: write {option}=...")
    return option, unquote(value)


def _number(option: str, text: str) -> int:
    if not (text.isascii() and text.isdigit()):
        raise SensorError(
            f"{option}={text}: a {option} is a whole number from 0, such as {option}=7"
        )
    return int(text)


def _faults(text: str) -> frozenset[str]:
    known = ["all", "none", *FAULTS]
    words = [recognise_name("fault", word, known) for word in text.split(",")]
    if words in (["all"], ["none"]):
        return frozenset(FAULTS if words == ["all"] else ())
    if "all" in words or "none" in words:
        raise SensorError(f"faults={text}: 'all' and 'none' stand alone")
    return frozenset(words)
