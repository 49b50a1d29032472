"""Detect the format of a recording by its content, never by its name."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from pathlib import Path

from kille.sensors.captures import (
    DESCRIPTIONS,
    Shot,
    description_of,
    is_sequence,
    read_scenes,
    read_sequence,
)
from kille.sensors.pictures import is_picture, shows_picture
from kille.sensors.recordings.bag_files import is_bag
from kille.sensors.recordings.bag_reading import open_bag
from kille.sensors.recordings.fakenect import is_fakenect, open_fakenect
from kille.sensors.recordings.galleries import Gallery
from kille.sensors.recordings.moments import Moment, RecordedMoments
from kille.sensors.recordings.name_suggestions import (
    first_names,
    natural_order,
    suggest_name,
)
from kille.sensors.recordings.npz import is_npz, open_npz
from kille.sensors.recordings.playback import RawRecording, Recording
from kille.sensors.recordings.playback_options import Options, split_options
from kille.sensors.recordings.tum import is_tum, open_tum
from kille.sensors.sensor import Sensor, SensorError

KNOWN = (
    "a folder of NAME_color.png and NAME_depth.png with scene.json or index.json, "
    "a fakenect, TUM RGB-D or ROS 2 folder, a .bag, .mcap or .npz file, "
    "a folder of pictures, a folder of such folders, or one picture"
)

_SUFFIXES = frozenset({".bag", ".mcap", ".db3", ".npz"})
"""What recordings are called that are files."""

Opener = Callable[[str, Path, Options], RecordedMoments]


def open_recording(name: str) -> Sensor:
    """The recording at this path, `PATH?speed=1&loop=no&start=3.5` with options.

    `FOLDER/SCENE` names one scene of a folder of scenes. SensorError if nothing is
    there, it cannot be read, is empty or of no known format, or its first frame fails.
    A warning in the log says, once, what of the recording is lost.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.sensors.recordings import open_recording
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cup.ppm").write_bytes(b"P6 1 1 255 ...")
    ...     open_recording(f"{folder}/cup.ppm").frame().colour.shape
    (1, 1, 3)
    """
    try:
        path, options = split_options(name)
        return _open(name, path, options)
    except OSError as error:
        raise SensorError(f"{name}: cannot be read ({error.strerror})") from error


def is_recording(path: Path) -> bool:
    """Whether it is of a format that holds frames in order of time, or scenes."""
    if _opener(path) is not None:
        return True
    return path.is_dir() and description_of(path) is not None


def _open(name: str, path: Path, options: Options) -> Sensor:
    opener = _opener(path)
    if opener is not None:
        return _play(name, opener(name, path, options), options)
    if path.is_dir():
        return _timeless(name, options, _open_folder(name, path, options))
    if path.is_file() and (is_picture(path) or shows_picture(path)):
        still = RecordedMoments("picture", [_moment(Shot(path.stem, path))])
        return _play(name, still, options)
    if path.exists():
        _refuse_empty(name, path)
        raise SensorError(f"{name}: unknown format; known are {KNOWN}")
    if path.is_symlink():
        raise SensorError(f"{name}: cannot be read (it is a link that leads nowhere)")
    return _open_scene(name, path, options)


def _opener(path: Path) -> Opener | None:
    """What opens it, if it is of a format that has a module of its own."""
    if path.is_dir():
        kinds: list[tuple[Callable[[Path], bool], Opener]] = [
            (is_fakenect, open_fakenect),
            (is_tum, open_tum),
            (is_bag, open_bag),
        ]
    elif path.is_file():
        kinds = [(is_npz, open_npz), (is_bag, open_bag)]
    else:
        return None
    return next((opener for is_one, opener in kinds if is_one(path)), None)


def _play(name: str, reel: RecordedMoments, options: Options) -> Recording:
    """The moments as a sensor; a warning says what of them is lost."""
    if reel.remark:
        logging.getLogger(__name__).warning("%s: %s", name, reel.remark)
    try:
        if reel.calibration is None:
            return Recording(name, reel, options)
        return RawRecording(name, reel, options, reel.calibration)
    except BaseException:
        reel.close()
        raise


def _timeless(name: str, options: Options, sensor: Sensor) -> Sensor:
    """The sensor; SensorError if it holds stills, and is to be played in time."""
    if isinstance(sensor, Gallery) and options != Options():
        raise SensorError(
            f"{name}: holds stills, which know no time: leave out what is behind the ?"
        )
    return sensor


def _refuse_empty(name: str, path: Path) -> None:
    if path.is_file() and not path.stat().st_size:
        raise SensorError(f"{name}: the file is empty; expected {KNOWN}")


def _open_scene(name: str, path: Path, options: Options) -> Sensor:
    description = description_of(path.parent)
    if description is None:
        raise _not_there(name, path, [it.name for it in _entries(path.parent)])
    shots = {shot.name: shot for shot in _captures(description)}
    if path.name not in shots:
        raise _not_there(name, path, list(shots))
    return _play(name, RecordedMoments("capture", [_moment(shots[path.name])]), options)


def _open_folder(name: str, folder: Path, options: Options) -> Sensor:
    description = description_of(folder)
    if description is not None and is_sequence(description):
        moments = [_moment(shot) for shot in read_sequence(description)]
        return _play(name, RecordedMoments("captures", moments), options)
    if description is not None:
        return Gallery(name, {it.name: [it] for it in read_scenes(description)})
    if any(folder.glob("*_color.png")) and any(folder.glob("*_depth.png")):
        raise SensorError(
            f"{name}: has depth pictures but none of {', '.join(DESCRIPTIONS)} "
            "to say the camera's intrinsics and the unit of depth"
        )
    if pictures := _pictures(folder):
        each = {shot.name: [shot] for shot in pictures}
        return Gallery(name, {folder.resolve().name: pictures} | each)
    return _open_categories(name, folder)


def _open_categories(name: str, folder: Path) -> Sensor:
    entries = _entries(folder)
    inner = [it for it in entries if it.is_dir()]
    # Of other files, which may be many, none is opened.
    likely = [it for it in entries if it.is_file() and it.suffix in _SUFFIXES]
    scenes = [it.name for it in (*inner, *likely) if is_recording(it)]
    if scenes:
        raise SensorError(
            f"{name}: holds recordings, name one of them: "
            + first_names([f"{name.rstrip('/')}/{scene}" for scene in scenes])
        )
    categories: dict[str, list[Shot]] = {}
    for it in inner:
        categories.setdefault(it.name.replace("_", " "), []).extend(_pictures(it))
    shown = {thing: pictures for thing, pictures in categories.items() if pictures}
    if shown:
        return Gallery(name, shown)
    if not any(folder.iterdir()):
        raise SensorError(f"{name}: the folder is empty; expected {KNOWN}")
    raise SensorError(f"{name}: unknown format; known are {KNOWN}")


def _captures(description: Path) -> tuple[Shot, ...]:
    if is_sequence(description):
        return read_sequence(description)
    return read_scenes(description)


def _moment(shot: Shot) -> Moment:
    return Moment(shot.time, shot.read)


def _pictures(folder: Path) -> list[Shot]:
    return [Shot(path.stem, path) for path in _entries(folder) if is_picture(path)]


def _entries(folder: Path) -> list[Path]:
    """What is in the folder in the order people count: cup2 before cup10."""
    if not folder.is_dir():
        return []
    return sorted(folder.iterdir(), key=lambda path: natural_order(path.name))


def _not_there(name: str, path: Path, near: Sequence[str]) -> SensorError:
    return SensorError(
        f"{name}: there is no such folder{suggest_name(path.name, near)}"
    )
