"""Output paths: nothing is replaced by accident, and a recording is whole or absent."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from kille.sensors.recordings.format_detection import is_recording
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
    if is_empty(out):
        return
    if out.exists() or out.is_symlink():
        raise SensorError(f"{out} is there already: name another, or add --force")
    _check_parent(out)


def check_file(out: Path) -> None:
    """SensorError if a folder is there, where a file is to be written."""
    if out.is_dir():
        raise SensorError(f"{out} is a folder, and this format is one file: name it")


def check_replaceable(out: Path) -> None:
    """SensorError if something is there that is no recording, and nothing else."""
    if out.is_symlink() or (out.exists() and not out.is_dir() and not out.is_file()):
        raise SensorError(f"{out} is no file or folder of its own: name another")
    if out.exists() and not is_empty(out) and not is_recording(out):
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


def is_empty(out: Path) -> bool:
    """Whether it is a folder with nothing in it."""
    return out.is_dir() and not any(out.iterdir())


def home(out: Path) -> Path:
    """The folder, and so the disk, that will hold what is written to this path."""
    return out if out.is_dir() else out.absolute().parent


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
    if any(os.path.realpath(os.path.expanduser(it)) == place for it in paths):
        raise SensorError(f"{out} would be written over: name another")


@contextmanager
def whole(out: Path, may_write: Callable[[Path], None]) -> Iterator[Path]:
    """A path to write to, which takes the place of `out` if nothing fails.

    `may_write` raises SensorError if `out` must be left as it is: something may have
    got there meanwhile.
    """
    into = is_empty(out)
    draft = _beside(out / "all" if into else out, "part")
    try:
        yield draft
        if into:
            _unpack(draft, out)
            return
        may_write(out)
        with set_aside(out):
            draft.replace(out)
    finally:
        remove(draft)


def _unpack(draft: Path, out: Path) -> None:
    """Move all that is in one folder into the other."""
    for path in draft.iterdir():
        path.rename(out / path.name)


@contextmanager
def set_aside(out: Path) -> Iterator[None]:
    """Make room at a path; what was there goes if something has taken its place.

    An empty folder stays: somebody may be in it, or a disk be mounted there.
    """
    if not out.exists() or is_empty(out):
        yield
        return
    old = _beside(out, "old")
    out.replace(old)
    try:
        yield
    finally:
        if out.exists():
            remove(old)
        else:
            old.replace(out)


def _beside(out: Path, what: str) -> Path:
    """A hidden path in the same folder, that nobody else uses."""
    path = out.absolute()
    return path.with_name(f".{path.name}.{os.getpid()}.{what}")


def empty(folder: Path) -> None:
    """Take away all that is in a folder, if there is one."""
    for path in folder.iterdir() if folder.is_dir() else ():
        remove(path)


def remove(path: Path) -> None:
    """Take away a file or folder, if there is one."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
