"""The commands: exit codes, one line for each mistake, and what they do not load."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import cv2
import numpy as np
import pytest

from kille.memory import Memory

from .conftest import COMMAND, Run

# --- what is typed wrong -------------------------------------------------------------

MISSPELT = {
    ("demmo",): "did you mean demo?",
    ("xyzzy",): "try demo, talk, serve, replay, record, convert, memory, evaluate, ",
    ("memory", "lits"): "did you mean list?",
    ("talk", "--memry", "x"): "did you mean --memory?",
    ("talk", "--sensro=synthetic"): "did you mean --sensor?",
    ("talk", "--tra"): "did you mean --trace?",
    ("talk", "synthetic"): "synthetic is not expected here",
    ("demo", "--seed", "x"): "x is no whole number",
    ("demo", "--seed", "-1"): "-1 is no whole number",
    ("talk", "--lang", "fr"): "there is no fr: try en, sv",
    ("memory", "list", "--jsn"): "did you mean --json?",
    ("doctor", "--jason"): "did you mean --json?",
    ("--verison",): "did you mean --version?",
    ("replay",): "FILE.dlg",
    ("replay", "--quiet", "--json", "a.dlg"): "not allowed with",
    ("serve", "--prot", "80"): "did you mean --port?",
    ("serve", "--port", "70000"): "70000 is no port",
    (): "a command is missing",
    ("memory",): "a command is missing",
}


@pytest.mark.parametrize(("words", "told"), MISSPELT.items(), ids=" ".join)
def test_wrong_use_is_one_line_with_a_way_out(
    kille: Run, words: tuple[str, ...], told: str
) -> None:
    outcome = kille(*words)
    assert outcome.code == 2
    assert outcome.out == ""
    assert told in outcome.complaint
    assert "--help says more" in outcome.complaint


@pytest.mark.parametrize("words", [(), ("talk",), ("memory", "list"), ("replay",)])
def test_help(kille: Run, words: tuple[str, ...]) -> None:
    outcome = kille(*words, "--help")
    assert outcome.code == 0
    assert outcome.out.startswith("usage: kille")
    assert outcome.err == ""


def test_version(kille: Run) -> None:
    assert kille("--version").out.startswith("kille ")


def test_help_loads_neither_eyes_nor_learners() -> None:
    code = (
        "import sys\nfrom kille.interfaces.cli import main\n"
        "try: main(['--help'])\nexcept SystemExit: pass\n"
        "print(*{name.partition('.')[0] for name in sys.modules})"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    loaded = set(done.stdout.splitlines()[-1].split())
    assert loaded.isdisjoint({"cv2", "sklearn", "scipy", "numpy", "lark", "rich"})


# --- sensors that cannot be opened ---------------------------------------------------


def a_picture_that_does_not_open(folder: Path) -> Path:
    (folder / "cup.png").write_bytes(b"\x89PNG\r\n\x1a\nno more")
    return folder


def an_empty_picture(folder: Path) -> Path:
    (folder / "cup.png").touch()
    return folder / "cup.png"


def an_empty_folder(folder: Path) -> Path:
    return folder


def a_depth_of_another_size(folder: Path) -> Path:
    cv2.imwrite(str(folder / "1_color.png"), np.zeros((48, 64, 3), np.uint8))
    cv2.imwrite(str(folder / "1_depth.png"), np.ones((24, 32), np.uint16))
    described = {
        "intrinsics": {"fx": 50, "fy": 50, "cx": 32, "cy": 24},
        "depth_units_per_metre": 1000,
        "frames": {"1": []},
    }
    (folder / "scene.json").write_text(json.dumps(described))
    return folder


def a_path_that_is_not_there(folder: Path) -> Path:
    return folder / "nowhere"


SENSORS = {
    a_picture_that_does_not_open: "does not open",
    an_empty_picture: "the file is empty",
    an_empty_folder: "the folder is empty",
    a_depth_of_another_size: "is 32x24 but 1_color.png is 64x48",
    a_path_that_is_not_there: "there is no such folder",
}


@pytest.mark.parametrize("source", SENSORS, ids=lambda it: it.__name__)
def test_a_sensor_that_cannot_be_opened(
    kille: Run, tmp_path: Path, source: Callable[[Path], Path]
) -> None:
    folder = tmp_path / "captures"
    folder.mkdir()
    path = source(folder)
    outcome = kille("talk", "--sensor", str(path), typed="Hello.\n")
    assert outcome.code == 2
    assert outcome.out == ""
    assert SENSORS[source] in outcome.complaint
    assert str(path) in outcome.complaint


@pytest.mark.parametrize("name", ["synthetic:dsk", "synthetic?sed=1", "kinect", ""])
def test_a_sensor_that_is_not_known(kille: Run, memory: Path, name: str) -> None:
    outcome = kille("talk", "--sensor", name)
    assert outcome.code == 2
    assert outcome.complaint.startswith("kille: ")
    assert not memory.exists()


# --- memories that cannot be opened --------------------------------------------------


def test_a_memory_that_is_none(kille: Run, memory: Path) -> None:
    memory.parent.mkdir()
    memory.write_text("Dear diary, " * 100)
    outcome = kille("talk", "--sensor", "synthetic:empty", typed="Hello.\n")
    assert outcome.code == 2
    assert "is not a kille memory" in outcome.complaint
    assert memory.read_text().startswith("Dear diary")
    assert kille("memory", "list").code == 2


def test_a_memory_that_is_in_use(kille: Run, memory: Path) -> None:
    with Memory.open(memory):
        outcome = kille("talk", "--sensor", "synthetic:empty", typed="Hello.\n")
    assert outcome.code == 2
    assert "is in use" in outcome.complaint


def test_a_memory_that_is_a_folder(kille: Run, tmp_path: Path) -> None:
    outcome = kille("talk", "--memory", str(tmp_path))
    assert outcome.code == 2
    assert "is a folder" in outcome.complaint


def test_a_memory_in_a_file(kille: Run, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    outcome = kille("talk", "--memory", str(tmp_path / "file" / "memory.db"))
    assert outcome.code == 2
    assert "name a file elsewhere" in outcome.complaint


def test_a_memory_that_is_read_only(program: Run, memory: Path) -> None:
    Memory.open(memory).close()
    memory.chmod(0o444)
    memory.parent.chmod(0o555)
    outcome = program("talk", "--sensor", "synthetic:empty", typed=b"Hello.\n")
    memory.parent.chmod(0o755)
    assert outcome.code == 2
    assert "is read-only" in outcome.complaint
    assert outcome.out == ""


def test_a_memory_that_may_not_be_read(program: Run, memory: Path) -> None:
    Memory.open(memory).close()
    memory.chmod(0)
    outcome = program("memory", "list")
    assert outcome.code == 2
    assert "permissions" in outcome.complaint


def test_a_memory_that_is_not_there(kille: Run) -> None:
    outcome = kille("memory", "list")
    assert outcome.code == 2
    assert "teach a word first" in outcome.complaint


# --- pictures that cannot be written -------------------------------------------------


@pytest.mark.parametrize("where", ["nowhere/sheet.png", "file/sheet.png", "."])
def test_a_demo_that_could_not_write_its_picture_does_not_begin(
    kille: Run, tmp_path: Path, where: str
) -> None:
    (tmp_path / "file").touch()
    outcome = kille("demo", "--out", str(tmp_path / where))
    assert outcome.code == 2
    assert outcome.out == ""
    assert "--out" in outcome.complaint


def test_a_folder_that_may_not_be_written(program: Run, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    folder.chmod(0o555)
    outcome = program("demo", "--out", str(folder / "sheet.png"))
    assert outcome.code == 2
    assert "may be written" in outcome.complaint


# --- ends that come early ------------------------------------------------------------


def test_a_pipe_that_closes_ends_the_demo_quietly(tmp_path: Path) -> None:
    with subprocess.Popen(
        [*COMMAND, "demo", "--out", str(tmp_path / "sheet.png")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        assert child.stdout.readline() == b"\n"
        child.stdout.close()
        err = child.stderr.read()
    assert child.returncode == 141
    assert err == b""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk_is_one_line() -> None:
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(
            [*COMMAND, "--version"], stdout=full, stderr=subprocess.PIPE, check=False
        )
    told = b"kille: the output cannot be written: no space left on device\n"
    assert (done.returncode, done.stderr) == (1, told)


def test_ctrl_c_ends_the_demo(tmp_path: Path) -> None:
    with subprocess.Popen(
        [*COMMAND, "demo", "--out", str(tmp_path / "sheet.png")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.readline()
        child.send_signal(signal.SIGINT)
        child.stdout.read()
        err = child.stderr.read()
    assert child.returncode == 130
    assert err == b"\n"
    assert not (tmp_path / "sheet.png").exists()


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_a_stream_that_was_closed_beforehand(closed: str) -> None:
    command = (
        f'"{sys.executable}" -m kille.interfaces.cli talk --sensor synthetic:empty'
    )
    done = subprocess.run(
        ["bash", "-c", f"echo Hello. | {{ {command} {closed}; }}"],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ,
    )
    assert done.returncode == 0
    assert "Traceback" not in done.stderr


def test_characters_that_cannot_be_shown_are_replaced(program: Run) -> None:
    outcome = program(
        "talk", "--sensor", "synthetic", typed=b"Hello.\n", PYTHONIOENCODING="ascii"
    )
    assert outcome.code == 0
    assert "straight ahead  ? this" in outcome.out
    assert outcome.err == ""


# --- reports -------------------------------------------------------------------------


def test_memory_list_as_a_table_and_for_machines(kille: Run, memory: Path) -> None:
    Memory.open(memory).close()
    assert "holds no words yet" in kille("memory", "list").out
    assert json.loads(kille("memory", "list", "--json").out) == []
    typed = "@ show cup\nThis is a cup.\nThis is a cup.\nThis is an [apple].\n"
    kille("talk", "--sensor", "synthetic:empty", typed=typed)
    (entry,) = json.loads(kille("memory", "list", "--json").out)
    assert (entry["word"], entry["kind"], entry["lessons"]) == ("cup", "object", 2)
    row = kille("memory", "list").out.splitlines()[-1].split()
    assert row[:3] == ["cup", "object", "2"]


# --- replay --------------------------------------------------------------------------


@pytest.fixture
def stories(tmp_path: Path) -> Path:
    path = tmp_path / "two.dlg"
    path.write_text(
        "--- right\nU> Hello.\nS> Hello.\n--- wrong\nU> Hello.\nS> Good day.\n"
    )
    return path


@pytest.fixture
def fine(tmp_path: Path) -> Path:
    path = tmp_path / "fine.dlg"
    path.write_text("U> Hello.\nS> Hello.\n")
    return path


def test_replay_of_what_is_as_written(kille: Run, fine: Path) -> None:
    outcome = kille("replay", str(fine))
    assert outcome.code == 0
    assert outcome.out.splitlines() == [
        "--- fine",
        "U> Hello.",
        "S> Hello.",
        f"{fine}: 1 story as written",
    ]


def test_replay_says_what_differs(kille: Run, stories: Path, fine: Path) -> None:
    outcome = kille("replay", "--quiet", str(stories), str(fine))
    assert outcome.code == 1
    told = outcome.out.splitlines()
    assert told[:4] == [
        f"{stories}:6",
        "  expected: Good day.",
        "     found: Hello.",
        "  the rules of this turn:",
    ]
    assert "    hear: What the tutor says is the latest move" in outcome.out
    assert told[-2:] == [
        f"{stories}: 1 of 2 stories differs",
        f"{fine}: 1 story as written",
    ]


def test_replay_writes_a_report_for_ci(
    kille: Run, stories: Path, tmp_path: Path
) -> None:
    report = tmp_path / "report.xml"
    outcome = kille("replay", "--quiet", str(stories), "--junit", str(report))
    assert outcome.code == 1
    root = ElementTree.parse(report).getroot()
    assert (root.get("tests"), root.get("failures")) == ("2", "1")
    lost = kille("replay", "--quiet", str(stories), "--junit", "no/such/report.xml")
    assert lost.code == 2
    assert "no/such/report.xml cannot be written" in lost.complaint


def test_replay_for_machines(kille: Run, stories: Path) -> None:
    outcome = kille("replay", "--json", str(stories))
    assert outcome.code == 1
    right, wrong = json.loads(outcome.out)
    assert (right["title"], right["difference"]) == ("right", None)
    assert wrong["difference"]["expected"] == "Good day."
    assert wrong["difference"]["line"]["number"] == 6


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("U> Hello.\nS< Hello.\n", ":2: a line begins with"),
        ("U> Hello.\nS~ (\n", ":2: '(' is no regular expression"),
        ("U> Hello.\nS> Hello.\n= s : [\n", ":3: "),
        ("@ scene nowhere\n", ":1: nowhere"),
        ("", "has no story"),
    ],
)
def test_a_story_with_a_mistake(
    kille: Run, tmp_path: Path, text: str, told: str
) -> None:
    path = tmp_path / "wrong.dlg"
    path.write_text(text)
    outcome = kille("replay", str(path))
    assert outcome.code == 2
    assert f"{path}{told}" in outcome.complaint or told in outcome.complaint
    assert "wrong.dlg" in outcome.complaint


def test_a_story_that_is_not_there(kille: Run, fine: Path) -> None:
    outcome = kille("replay", str(fine), "nowhere.dlg")
    assert outcome.code == 2
    assert outcome.complaint == "kille: there is no file nowhere.dlg"


def test_a_story_that_may_not_be_read(program: Run, fine: Path) -> None:
    fine.chmod(0)
    outcome = program("replay", str(fine))
    assert outcome.code == 2
    assert "permission denied" in outcome.complaint


# --- what is no input ----------------------------------------------------------------

READING = {
    ("replay", "FILE"),
    ("talk", "--sensor", "FILE"),
    ("talk", "--hear", "FILE"),
    ("convert", "FILE", "out.bag"),
    ("memory", "import", "FILE"),
    ("experiment", "check", "FILE"),
    ("experiment", "run", "FILE"),
    ("evaluate", "objects", "FILE"),
    ("evaluate", "relations", "FILE"),
}


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is waited for longer than some hundredths of a second."""
    monkeypatch.setenv("KILLE_LIMITS", "0.005")
    monkeypatch.setenv("OPENCV_IO_MAX_IMAGE_PIXELS", "1000000")


@pytest.mark.parametrize("kind", ["pipe", "loop", "device"])
@pytest.mark.parametrize("words", sorted(READING), ids=" ".join)
@pytest.mark.usefixtures("impatient")
def test_what_is_no_file_is_refused_in_one_line(
    kille: Run, tmp_path: Path, kind: str, words: tuple[str, ...]
) -> None:
    file = tmp_path / "file"
    match kind:
        case "pipe":
            os.mkfifo(file)
        case "loop":
            file.symlink_to(file)
        case "device":
            file = Path("/dev/zero")
    outcome = kille(*(str(file) if it == "FILE" else it for it in words))
    assert outcome.code == 2
    assert outcome.out == ""
    assert outcome.complaint.startswith("kille: ")
    assert "developers" not in outcome.complaint


def test_a_line_without_end_ends_the_talk(kille: Run) -> None:
    outcome = kille("talk", "--sensor", "synthetic:empty", typed="x" * 20_000)
    assert outcome.code == 2
    assert "it has more than 10,000 characters" in outcome.complaint


def test_opencv_refuses_what_is_too_large_by_itself(tmp_path: Path) -> None:
    picture = tmp_path / "large.ppm"
    picture.write_bytes(b"P5 30000 30000 255\n" + bytes(99))
    script = (
        "import sys; from kille.interfaces.cli import main; main(['memory', 'list']);"
        "import cv2; cv2.imread(sys.argv[1])"
    )
    run = subprocess.run(
        [sys.executable, "-c", script, picture], capture_output=True, text=True
    )
    assert "pixels <= CV_IO_MAX_IMAGE_PIXELS" in run.stderr
