"""The bus over the topics of ROS 2, between processes of ours."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from kille.bus import BusError, Text

pytestmark = pytest.mark.slow

pytest.importorskip("cyclonedds", reason="the extra ros2 is not installed")
pytest.importorskip("rosbags", reason="the extra ros2 is not installed")

HERE = Path(__file__).resolve().parent

ALONE = """
<CycloneDDS><Domain>
<General>
<Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
<AllowMulticast>false</AllowMulticast>
</General>
<Discovery><Peers><Peer address="127.0.0.1"/></Peers></Discovery>
</Domain></CycloneDDS>
"""
"""No packet leaves this machine."""


@pytest.fixture(autouse=True)
def _alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A domain of one's own, on this machine.

    The ports of those up to 100 are none that connections are given by chance.
    """
    monkeypatch.setenv("CYCLONEDDS_URI", ALONE)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(1 + os.getpid() % 100))
    monkeypatch.setenv("KILLE_MEMORY", str(tmp_path / "memory.db"))


def test_the_bus_over_dds_keeps_to_what_every_bus_keeps_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("KILLE_TEST_BUS", "ros2")
    arguments = ("-q", "-p", "no:cacheprovider", "test_bus.py")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *arguments],
        cwd=HERE,
        text=True,
        capture_output=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "skipped" not in done.stdout


def test_the_robot_talks_over_dds(
    run: Callable[..., Any], tmp_path: Path, eventually: Callable[..., Any]
) -> None:
    command = (sys.executable, "-m", "kille.interfaces.cli", "ros")
    how = ("--over", "ros2", "--sensor", "synthetic:empty?seed=7", "--rate", "10")
    run("all", *command, "all", *how)
    log = tmp_path / "all.log"
    eventually(lambda: "is running" in log.read_text("utf-8"))
    talked = subprocess.run(
        [*command, "talk", "--over", "ros2"],
        input="@ show cup\nThis is a cup.\nWhat is this?\n@ point 9\n",
        text=True,
        capture_output=True,
        timeout=300,
        check=False,
    )
    said = [line for line in talked.stdout.splitlines() if line.startswith("S> ")]
    assert said == ["S> OK, I learned a cup.", "S> This is a cup."]
    assert talked.stderr == ("kille: there is no thing #9 to point at: there are 1\n")


def test_words_are_sent_as_ros_2_sends_them() -> None:
    from kille.ros2.conversion import form_of
    from kille.ros2.types import sample_type

    form = form_of(Text)
    assert form.name == "std_msgs/msg/String"
    # CDR, little-endian: its header, then the length with the final zero, and that.
    assert form.to(Text("Hi")) == b"\0\x01\0\0\x03\0\0\0Hi\0"
    assert form.of(b"\0\x01\0\0\x03\0\0\0Hi\0") == Text("Hi")
    declared = sample_type("sensor_msgs/msg/Image").__idl__
    assert declared.idl_transformed_typename == "sensor_msgs::msg::dds_::Image_"


@pytest.mark.parametrize(
    ("domain", "arguments", "because"),
    [
        ("lab", [], "ROS_DOMAIN_ID is `lab`; it is a number"),
        ("3", ["user_input"], "`user_input` is no remapping"),
    ],
)
def test_what_is_wrong_is_one_line(
    monkeypatch: pytest.MonkeyPatch, domain: str, arguments: list[str], because: str
) -> None:
    from kille.ros2.bus import open_ros2

    monkeypatch.setenv("ROS_DOMAIN_ID", domain)
    with pytest.raises(BusError, match=because):
        open_ros2("node", arguments)
