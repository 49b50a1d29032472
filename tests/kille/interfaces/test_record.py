"""`kille record` and `kille convert`: what is written where, and what is left alone."""

from __future__ import annotations

import os
import pty
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.sensors.recordings.conversion import FORMATS
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.playback import Recording
from kille.sensors.sensor import Sensor
from kille.sensors.sources import open_sensor

from .conftest import COMMAND, Run

SENSOR = "synthetic:empty?seed=7"


def frames(path: Path) -> int:
    recording = open_recording(str(path))
    assert isinstance(recording, Recording)
    recording.close()
    return len(recording.reel.moments)


@pytest.fixture
def walk(kille: Run, tmp_path: Path) -> Path:
    """A recording of three frames."""
    out = tmp_path / "walk"
    assert kille("record", str(out), "--sensor", SENSOR, "--frames", "3").code == 0
    return out


# --- record --------------------------------------------------------------------------


def test_it_says_what_it_wrote_and_how_to_play_it(kille: Run, tmp_path: Path) -> None:
    out = tmp_path / "a walk"
    outcome = kille("record", str(out), "--sensor", SENSOR, "--seconds", "0.2")
    assert outcome.code == 0
    assert outcome.err == ""
    assert outcome.out.startswith(f"{out}: 6 frames, 0.2 s, 9 MB, written in ")
    assert outcome.out.endswith(f"play it with --sensor '{out}'\n")
    assert frames(out) == 6


def test_an_empty_folder_is_as_good_as_none(kille: Run, tmp_path: Path) -> None:
    assert kille("record", str(tmp_path), "--sensor", SENSOR, "--frames", "1").code == 0
    assert frames(tmp_path) == 1


def test_the_folder_one_is_in_stays_where_it_is(
    kille: Run, walk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for number, words in enumerate(
        [
            ("record", ".", "--sensor", SENSOR, "--frames", "3"),
            ("convert", str(walk), ".", "--to", "tum"),
            ("convert", str(walk), ".", "--to", "fakenect"),
        ]
    ):
        here = walk.parent / f"here{number}"
        here.mkdir()
        monkeypatch.chdir(here)
        assert kille(*words).code == 0
        assert here.samefile(".")
        assert frames(here) == 3
        assert not list(here.glob(".*"))


def test_an_empty_folder_stays_empty_if_nothing_comes_of_it(
    kille: Run, tmp_path: Path
) -> None:
    cv2.imwrite(str(tmp_path / "cup.png"), np.zeros((9, 9, 3), np.uint8))
    (tmp_path / "here").mkdir()
    sensor = str(tmp_path / "cup.png")
    assert kille("record", str(tmp_path / "here"), "--sensor", sensor).code == 1
    words = ("convert", sensor, str(tmp_path / "here"), "--to", "captures")
    assert kille(*words).code == 1
    assert list((tmp_path / "here").iterdir()) == []


def test_a_file_does_not_take_the_place_of_a_folder(kille: Run, walk: Path) -> None:
    (walk.parent / "here").mkdir()
    for out in ("here", "walk2"):
        kille("convert", str(walk), str(walk.parent / "walk2"), "--to", "tum")
        words = ("convert", str(walk), str(walk.parent / out), "--to", "bag", "--force")
        told = kille(*words).complaint
        assert told.endswith("is a folder, and this format is one file: name it")
        assert (walk.parent / out).is_dir()


def test_what_gets_there_meanwhile_is_left_alone(
    kille: Run, walk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As two programs do that are started at the same time."""
    from kille.interfaces import convert, record

    out = walk.parent / "w.npz"

    def opened(name: str) -> Sensor:
        out.write_bytes(b"mine")
        return open_sensor(name)

    for module, words in (
        (record, ("record", str(out), "--sensor", SENSOR, "--frames", "1")),
        (convert, ("convert", str(walk), str(out))),
    ):
        out.unlink(missing_ok=True)
        name = "open_sensor" if module is record else "open_recording"
        monkeypatch.setattr(module, name, opened)
        assert "is there already" in kille(*words).complaint
        assert out.read_bytes() == b"mine"


def test_nothing_is_written_over_unless_forced(kille: Run, walk: Path) -> None:
    words = ("record", str(walk), "--sensor", SENSOR, "--frames", "1")
    outcome = kille(*words)
    assert outcome.code == 2
    assert outcome.complaint == (
        f"kille: {walk} is there already: name another, or add --force"
    )
    assert frames(walk) == 3
    assert kille(*words, "--force").code == 0
    assert frames(walk) == 1


def test_force_leaves_alone_what_is_no_recording(kille: Run, walk: Path) -> None:
    words = ("record", "--sensor", SENSOR, "--frames", "1", "--force")
    (walk / "thesis.tex").write_text("all of it")
    complaint = kille(*words, str(walk)).complaint
    assert "holds thesis.tex too, which is no part of a recording" in complaint
    assert frames(walk) == 3
    other = walk.parent / "photos"
    other.mkdir()
    (other / "cat.png").write_bytes(b"")
    assert (
        "is no recording, and is not overwritten" in kille(*words, str(other)).complaint
    )
    assert (other / "cat.png").exists()
    link = walk.parent / "link"
    link.symlink_to(other)
    assert "is no file or folder of its own" in kille(*words, str(link)).complaint


def test_what_fails_before_it_begins_keeps_the_old_one(kille: Run, walk: Path) -> None:
    cv2.imwrite(str(walk.parent / "cup.png"), np.zeros((9, 9, 3), np.uint8))
    for sensor in ("synthetic:nowhere", str(walk.parent / "cup.png")):
        outcome = kille("record", str(walk), "--sensor", sensor, "--force")
        assert outcome.code in (1, 2)
        assert outcome.complaint
        assert frames(walk) == 3


def test_a_recording_is_not_recorded_over_itself(kille: Run, walk: Path) -> None:
    outcome = kille("record", str(walk), "--sensor", str(walk), "--force")
    assert outcome.complaint == f"kille: {walk} would be written over: name another"
    assert frames(walk) == 3


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--seconds", "0"), "0 is no number above 0, such as 10"),
        (("--seconds", "nan"), "nan is no number above 0"),
        (("--frames", "0"), "0 is no whole number from 1, such as 300"),
        (("--frames", "1", "--seconds", "1"), "not allowed with"),
        (("--frames", "100000000000"), "are needed, and"),
        (("--seconds", "1e308"), "are needed, and"),
        (("--sensor", "~nobody-at-all/walk"), "there is no such"),
        (("--sensor", "nowhere"), "there is no such"),
    ],
)
def test_what_is_asked_wrong(
    kille: Run, tmp_path: Path, words: tuple[str, ...], told: str
) -> None:
    outcome = kille("record", str(tmp_path / "walk"), *words)
    assert outcome.code in (1, 2)
    assert told in outcome.complaint
    assert not (tmp_path / "walk").exists()


def test_where_there_is_no_folder(kille: Run, tmp_path: Path) -> None:
    outcome = kille("record", str(tmp_path / "no" / "walk"), "--frames", "1")
    assert outcome.code == 2
    assert f"there is no folder {tmp_path / 'no'} to put it into" in outcome.complaint


def test_a_name_that_is_too_long(kille: Run, walk: Path) -> None:
    name = str(walk.parent / ("a" * 300))
    for words in (("record", name), ("convert", str(walk), f"{name}.bag")):
        outcome = kille(*words)
        assert outcome.code == 1
        assert outcome.complaint.endswith("cannot be written: file name too long")
    assert "name too long" in kille("convert", name, f"{walk}.bag").complaint


def test_where_nobody_may_write(program: Run, tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    try:
        outcome = program("record", str(tmp_path / "walk"), "--frames", "1")
    finally:
        tmp_path.chmod(0o700)
    assert outcome.code == 1
    assert outcome.complaint.endswith("walk cannot be written: permission denied")


def test_ctrl_c_ends_it(tmp_path: Path) -> None:
    out = tmp_path / "walk"
    words = [*COMMAND, "record", str(out), "--sensor", SENSOR]
    program = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    index = out / "INDEX.txt"
    while program.poll() is None and not (index.exists() and index.stat().st_size):
        time.sleep(0.01)
    program.send_signal(signal.SIGINT)
    told, complaints = program.communicate(timeout=120)
    assert program.returncode == 0
    assert complaints == b""
    count = frames(out)
    assert told.decode().startswith(f"{out}: {count} frame")


def test_a_terminal_shows_how_far_it_is(tmp_path: Path) -> None:
    out = tmp_path / "walk"
    ours, theirs = pty.openpty()
    words = [*COMMAND, "record", str(out), "--sensor", SENSOR, "--seconds", "2"]
    program = subprocess.Popen(
        words, stdout=theirs, stderr=theirs, env=os.environ | {"TERM": "xterm"}
    )
    os.close(theirs)
    shown = b""
    try:
        while chunk := os.read(ours, 4096):
            shown += chunk
    except OSError:  # how a terminal says that nobody is there any more
        pass
    finally:
        os.close(ours)
    assert program.wait() == 0
    text = shown.decode()
    assert "a second" in text
    assert "Ctrl-C ends it" in text
    assert "walk: 60 frames, 2.0 s" in text


def test_what_fails_at_its_first_frame_keeps_the_old_one(
    kille: Run, walk: Path
) -> None:
    other = walk.parent / "other"
    kille("record", str(other), "--sensor", SENSOR, "--frames", "1")
    (other / "INDEX.txt").write_text(
        "".join(sorted(it.name for it in other.glob("r-*")))
    )
    outcome = kille("record", str(walk), "--sensor", str(other), "--force")
    assert outcome.code == 1
    assert "gives no depth" in outcome.complaint
    assert "what came before" not in outcome.complaint
    assert frames(walk) == 3


def test_a_source_that_fails_on_the_way_leaves_what_came_before(
    kille: Run, walk: Path
) -> None:
    last = sorted(walk.glob("r-*"))[-1]
    last.write_bytes(b"P6 1 2 3\n" + bytes(480 * 640 * 3))
    out = walk.parent / "again"
    outcome = kille("record", str(out), "--sensor", str(walk))
    assert outcome.code == 1
    assert f"{last.name}: is damaged" in outcome.complaint
    assert outcome.complaint.endswith(f"; what came before is in {out}")
    assert frames(out) == 2


# --- convert -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "to", "told"),
    [
        ("w.bag", (), "3 frames, 0.1 s, as a ROS 1 bag, 6 MB"),
        ("w.mcap", (), "3 frames, 0.1 s, as a ROS 2 bag in one file, 6 MB"),
        ("w.npz", (), "3 frames, 0.1 s, as a NumPy archive, 6 MB"),
        ("w", ("--to", "ros2"), "3 frames, 0.1 s, as a ROS 2 bag folder, 6 MB"),
        ("w", ("--to", "tum"), "3 frames, 0.1 s, as a TUM RGB-D folder, "),
        ("w", ("--to", "captures"), "3 frames, 0.1 s, as a capture folder, "),
        ("w", ("--to", "fakenect"), "3 frames, 0.1 s, as a fakenect folder, 5 MB"),
        ("w.npz", ("--to", "bag"), "3 frames, 0.1 s, as a ROS 1 bag, 6 MB"),
    ],
)
def test_a_recording_is_converted(
    kille: Run, walk: Path, name: str, to: tuple[str, ...], told: str
) -> None:
    out = walk.parent / name
    outcome = kille("convert", str(walk), str(out), *to)
    assert outcome.code == 0
    assert outcome.err == ""
    assert outcome.out.startswith(f"{out}: {told}")
    assert frames(out) == 3
    assert {it.name for it in walk.parent.iterdir()} <= {"walk", name, "home"}


def test_the_formats_offered_are_those_there_are(kille: Run) -> None:
    offered = re.search(r"--to {([^}]*)}", kille("convert", "--help").out)
    assert offered is not None
    assert set(re.split(r",\s*", offered[1])) == set(FORMATS)


def test_a_disk_that_fails_at_once_keeps_the_old_one(walk: Path) -> None:
    code = (
        "import resource, signal, sys\n"
        "from kille.interfaces.cli import main\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
        "sys.exit(main(sys.argv[1:]))\n"
    )
    words = ["record", str(walk), "--sensor", SENSOR, "--frames", "1", "--force"]
    done = subprocess.run(
        [sys.executable, "-c", code, *words],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr == f"kille: {walk} cannot be written: file too large\n"
    assert frames(walk) == 3


def test_a_part_of_it_is_converted(kille: Run, walk: Path) -> None:
    out = walk.parent / "end.npz"
    assert kille("convert", f"{walk}?start=0.05", str(out)).code == 0
    assert frames(out) == 1


def test_outlines_that_get_lost_are_told(
    kille: Run, walk: Path, tmp_path: Path
) -> None:
    kille("convert", str(walk), str(tmp_path / "c"), "--to", "captures")
    label = np.ones((480, 640), np.uint8)
    for number in range(3):
        cv2.imwrite(str(tmp_path / "c" / f"{number:06}_label.png"), label)
    described = tmp_path / "c" / "scene.json"
    named = described.read_text().replace("[]", '[{"label": 1, "name": "cup"}]')
    described.write_text(named)
    outcome = kille("convert", str(tmp_path / "c"), str(tmp_path / "c.npz"))
    assert "The outlines of the things are lost" in outcome.out
    again = kille(
        "convert", str(tmp_path / "c"), str(tmp_path / "d"), "--to", "captures"
    )
    assert "are lost" not in again.out


@pytest.mark.parametrize(
    ("source", "out", "more", "told"),
    [
        ("walk", "w", (), "say which format by --to, fakenect, tum,"),
        ("walk", "w", ("--to", "mp4"), "there is no mp4: try fakenect"),
        ("walk", "walk", ("--to", "tum", "--force"), "would be written over"),
        ("walk", "pictures", ("--to", "tum"), "is there already"),
        ("wlak", "w.bag", (), "did you mean walk?"),
        ("walk?start=9", "w.bag", (), "is behind the end"),
        ("pictures", "w.bag", (), "pictures: holds stills, no recording"),
        ("pictures/cup.png", "w", ("--to", "captures"), "captures have depth"),
        ("walk", "no/w.bag", (), "there is no folder"),
        ("walk", "notes.npz", ("--force",), "is no recording, and is not overwritten"),
    ],
)
def test_what_cannot_be_converted(
    kille: Run, walk: Path, source: str, out: str, more: tuple[str, ...], told: str
) -> None:
    folder = walk.parent
    (folder / "pictures").mkdir()
    (folder / "notes.npz").write_text("mine")
    for name in ("cup", "car"):
        picture = np.zeros((9, 9, 3), np.uint8)
        cv2.imwrite(str(folder / "pictures" / f"{name}.png"), picture)
    before = {it.name for it in folder.iterdir()}
    outcome = kille("convert", str(folder / source), str(folder / out), *more)
    assert outcome.code in (1, 2)
    assert told in outcome.complaint
    assert {it.name for it in folder.iterdir()} == before
    assert (folder / "notes.npz").read_text() == "mine"
    assert frames(walk) == 3


def test_what_is_damaged_on_the_way_leaves_no_half(kille: Run, walk: Path) -> None:
    last = sorted(walk.glob("r-*"))[-1]
    last.write_bytes(b"P6 1 2 3\n" + bytes(480 * 640 * 3))
    before = {it.name for it in walk.parent.iterdir()}
    outcome = kille("convert", str(walk), str(walk.parent / "w.bag"))
    assert outcome.code == 1
    assert f"{last.name}: is damaged" in outcome.complaint
    assert {it.name for it in walk.parent.iterdir()} == before


def test_without_rosbags_the_way_to_get_it_is_told(
    kille: Run, walk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "rosbags.typesys", None)
    outcome = kille("convert", str(walk), str(walk.parent / "w.bag"))
    assert outcome.code == 1
    assert "ROS bags need rosbags: pip install 'kille[record]'" in outcome.complaint


def test_ctrl_c_leaves_no_half(kille: Run, walk: Path) -> None:
    kille("record", str(walk), "--sensor", SENSOR, "--frames", "60", "--force")
    words = [*COMMAND, "convert", str(walk), str(walk.parent / "w"), "--to", "tum"]
    before = {it.name for it in walk.parent.iterdir()}
    program = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    while (
        program.poll() is None and {it.name for it in walk.parent.iterdir()} == before
    ):
        time.sleep(0.001)
    program.send_signal(signal.SIGINT)
    program.communicate(timeout=120)
    assert program.returncode == 130
    assert {it.name for it in walk.parent.iterdir()} == before


def test_force_takes_the_place_of_a_recording(kille: Run, walk: Path) -> None:
    out = walk.parent / "w.npz"
    kille("convert", f"{walk}?start=0.05", str(out))
    assert kille("convert", str(walk), str(out)).code == 2
    assert frames(out) == 1
    assert kille("convert", str(walk), str(out), "--force").code == 0
    assert frames(out) == 3


def test_what_is_cut_short_is_told_once(program: Run, walk: Path) -> None:
    last = sorted(walk.glob("d-*"))[-1]
    os.truncate(last, 99)
    outcome = program("convert", str(walk), str(walk.parent / "w.npz"))
    assert outcome.code == 0
    assert outcome.complaint.startswith(f"{walk}: cut short: 1 of 6 files is missing")
    assert frames(walk.parent / "w.npz") == 2


# --- what is recorded can be talked about --------------------------------------------


def test_a_recording_is_talked_about_as_the_scene_was(
    kille: Run, tmp_path: Path
) -> None:
    from kille import Agent

    out = tmp_path / "desk"
    kille("record", str(out), "--sensor", "synthetic:desk?seed=7", "--frames", "12")
    with Agent(sensor=str(out)) as robot:
        learned = "OK, the one in the middle (#1) is a cup."
        assert robot.hear("#1 This is a cup.") == learned
        assert robot.hear("What is this?") == "This is a cup."
