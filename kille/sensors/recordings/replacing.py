"""Where a recording goes: never over what is there by accident, and whole or not."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from kille.sensors.recordings.opening import is_recording
from kille.sensors.sensor import SensorError

_OURS = re.compile(
    r"INDEX\.txt|device\.json|[rda]-[\d.]+-\d+\.\w+"
    r"|(rgb|depth|accelerometer|groundtruth|calibration|associations?)\.txt"
    r"|scene\.json|.+_(color|depth|label)\.png"
    r"|metadata\.yaml|.+\.(mcap|db3)(\.zstd)?"
)
"""The names of files in the folders of recordings."""

_PICTURES = ("rgb", "depth")


def check_new(out: Path) -> None:
    """SensorError if something is there already, that is no empty folder."""
    if out.is_dir() and not any(out.iterdir()):
        return
    if out.exists() or out.is_symlink():
        raise SensorError(f"{out} is there already: name another, or add --force")
    _check_parent(out)


def check_replaceable(out: Path) -> None:
    """SensorError if something is there that is no recording, and nothing else."""
    if out.is_symlink() or (out.exists() and not out.is_dir() and not out.is_file()):
        raise SensorError(f"{out} is no file or folder of its own: name another")
    if out.exists() and not _is_empty(out) and not is_recording(out):
        raise SensorError(f"{out} is no recording, and is not overwritten")
    stranger = next(_strangers(out), None) if out.is_dir() else None
    if stranger is not None:
        raise SensorError(
            f"{out} holds {stranger.name} too, which is no part of a recording: "
            "move it away first"
        )
    _check_parent(out)


def _check_parent(out: Path) -> None:
    if not out.absolute().parent.is_dir():
        raise SensorError(f"{out}: there is no folder {out.parent} to put it into")


def _is_empty(out: Path) -> bool:
    return out.is_dir() and not any(out.iterdir())


def _strangers(folder: Path) -> Iterator[Path]:
    for path in sorted(folder.iterdir()):
        if path.is_dir() and not path.is_symlink() and path.name in _PICTURES:
            pictures = path.iterdir()
            yield from (it for it in pictures if it.suffix not in (".png", ".jpg"))
        elif not path.is_file() or not _OURS.fullmatch(path.name):
            yield path


def check_other(source: str, out: Path) -> None:
    """SensorError if the source, as a user writes it, is what would be written over."""
    place = os.path.realpath(out)
    paths = (source, source.rpartition("?")[0] or source)
    if any(os.path.realpath(Path(it).expanduser()) == place for it in paths):
        raise SensorError(f"{out} would be written over: name another")


@contextmanager
def whole(out: Path) -> Iterator[Path]:
    """A path to write to, which takes the place of `out` if nothing fails."""
    draft = out.with_name(f".{out.name}.{os.getpid()}.part")
    try:
        yield draft
        with set_aside(out):
            draft.replace(out)
    finally:
        remove(draft)


@contextmanager
def set_aside(out: Path) -> Iterator[None]:
    """Make room at a path; what was there goes if something has taken its place."""
    if not out.exists():
        yield
        return
    old = out.with_name(f".{out.name}.{os.getpid()}.old")
    out.replace(old)
    try:
        yield
    finally:
        if out.exists():
            remove(old)
        else:
            old.replace(out)


def remove(path: Path) -> None:
    """Take away a file or folder, if there is one."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
