"""What `kille doctor` says of this machine, and of worse ones."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from kille.interfaces.doctor import as_text
from kille.interfaces.doctor.findings import DoctorFinding
from kille.interfaces.doctor.packages import packages, pip
from kille.memory import Memory

Run = Callable
Findings = Callable[..., dict[str, dict]]


@pytest.fixture
def found(kille: Run) -> Findings:
    """What is found of each part, in this process."""

    def look() -> dict[str, dict]:
        return {it["part"]: it for it in json.loads(kille("doctor", "--json").out)}

    return look


@pytest.fixture
def found_by_anyone(program: Run) -> Findings:
    """What is found of each part by a program that may not do what only root may."""

    def look(**settings: str) -> dict[str, dict]:
        outcome = program("doctor", "--json", **settings)
        assert outcome.err == ""
        findings = {it["part"]: it for it in json.loads(outcome.out)}
        broken = [it for it in findings.values() if it["needed"] and not it["works"]]
        assert outcome.code == (1 if broken else 0)
        return findings

    return look


def test_what_is_needed_is_found_and_lines_up(kille: Run) -> None:
    outcome = kille("doctor")
    assert outcome.code == 0
    *lines, upshot = outcome.out.splitlines()
    assert upshot.startswith("All that is needed works")
    marked = [line for line in lines if line[:7].strip() in ("ok", "no")]
    parts = {line[9:].split("  ")[0].strip() for line in marked}
    assert {"Python", "packages", "synthetic Kinect", "memory", "Kinect"} <= parts
    width = max(map(len, parts))
    assert all(line[9 + width : 11 + width] == "  " for line in marked)
    assert all(line[11 + width] != " " for line in marked)


def test_it_is_told_to_machines(found: Findings) -> None:
    findings = found()
    assert "numpy" in findings["packages"]["state"]
    assert findings["synthetic Kinect"]["state"] == "640x480 frames"
    assert findings["Kinect"]["needed"] is False
    extras = {part for part in findings if part.startswith("extra")}
    assert {"extra [plots]", "extra [test]", "extra [dev]"} <= extras
    assert not any(findings[it]["needed"] for it in extras)


def test_a_command_is_never_broken_into_lines(
    capsys: pytest.CaptureFixture[str],
) -> None:
    command = "echo 'a long rule' | sudo tee /etc/a-file && " * 5 + "true"
    as_text([DoctorFinding("Kinect", False, False, "it may not be opened", command)])
    _, remedy, *_ = capsys.readouterr().out.splitlines()
    assert remedy.strip() == command


def test_a_needed_part_that_is_missing_stands_out(
    capsys: pytest.CaptureFixture[str],
) -> None:
    numpy = DoctorFinding("numpy", False, True, "not installed", "pip install numpy")
    as_text([DoctorFinding("Python", True, True, "3.11"), numpy])
    text = capsys.readouterr().out
    assert "  FAILS  numpy   not installed: pip install numpy\n" in text
    assert text.endswith("has to be mended before the robot works here.\n")


def test_a_broken_package_does_not_break_the_doctor(
    found_by_anyone: Findings, tmp_path: Path
) -> None:
    for package in ("numpy", "usb"):
        (tmp_path / f"{package}.py").write_text(f"raise ImportError('no {package}')")
    findings = found_by_anyone(PYTHONPATH=str(tmp_path))
    for part in ("synthetic Kinect", "memory", "Kinect"):
        assert not findings[part]["works"]
        assert findings[part]["state"] in ("no numpy", "no usb")
    assert findings["line editing"]["state"]


def test_pip_is_that_of_this_python(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent))
    assert pip("kille[usb]") == "pip install 'kille[usb]'"
    monkeypatch.setenv("PATH", str(tmp_path))
    assert pip("kille[usb]") == f"{sys.executable} -m pip install 'kille[usb]'"


def test_what_another_python_needs_is_not_missed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """`immutables` is installed with Python 3.13 and below only."""
    wanted = [
        "numpy>=1.26",
        "not-there>=1; python_version < '3.0'",
        'not-there-either; python_version > "9.9" and extra == "plots"',
    ]
    module = sys.modules[packages.__module__]
    monkeypatch.setattr(module, "requires", lambda name: wanted)
    [finding] = packages()
    assert (finding.part, finding.works) == ("packages", True)


# --- memory --------------------------------------------------------------------------


def test_a_memory_that_is_none(kille: Run, found: Findings, memory: Path) -> None:
    memory.parent.mkdir()
    memory.write_text("Dear diary, " * 100)
    assert kille("doctor").code == 1
    finding = found()["memory"]
    assert "is not a kille memory" in finding["state"]
    assert finding["remedy"].startswith("move it away")


def test_a_memory_that_does_not_let_itself_be_taught(
    found: Findings, found_by_anyone: Findings, memory: Path
) -> None:
    Memory.open(memory).close()
    assert found()["memory"]["state"] == f"0 words in {memory}"
    memory.chmod(0o400)
    finding = found_by_anyone()["memory"]
    assert (finding["works"], finding["needed"]) == (False, True)
    assert finding["state"].startswith(f"0 words in {memory}")
    assert "writable" in finding["remedy"]


def test_a_memory_that_cannot_be_made(
    found: Findings, found_by_anyone: Findings, memory: Path
) -> None:
    assert found()["memory"]["state"] == f"none yet; it will be {memory}"
    memory.parent.mkdir(mode=0o500)
    finding = found_by_anyone()["memory"]
    assert (finding["works"], finding["needed"]) == (False, True)
    assert f"cannot be made in {memory.parent}" in finding["state"]
    memory.parent.rmdir()
    memory.parent.touch()
    assert not found()["memory"]["works"]


# --- sound ---------------------------------------------------------------------------


@pytest.fixture
def recorder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A program in the place of ALSA's recorder; nothing else is installed."""
    monkeypatch.setenv("PATH", str(tmp_path))
    path = tmp_path / "arecord"
    path.write_text("#!/bin/sh\n")
    path.chmod(0o755)
    return path


def test_a_microphone_is_one_that_opens(recorder: Path, found: Findings) -> None:
    assert found()["microphone"]["works"]
    recorder.write_text(
        "#!/bin/sh\n"
        "echo \"ALSA lib confmisc.c:855:(parse_card) cannot find card '0'\" >&2\n"
        'echo "arecord: main:831: audio open error: Device or resource busy" >&2\n'
        "exit 1\n"
    )
    finding = found()["microphone"]
    assert not finding["works"]
    assert "(audio open error: Device or resource busy)" in finding["state"]
    assert "`arecord -l`" in finding["remedy"]


def test_what_is_not_installed_comes_with_its_command(
    recorder: Path, found: Findings
) -> None:
    findings = found()
    assert findings["speaking"]["remedy"] == "sudo apt install espeak-ng"
    assert findings["loudspeaker"]["remedy"] == "sudo apt install alsa-utils"
