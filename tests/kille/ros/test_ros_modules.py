"""ROS is found where the system has it, and nothing else gets in with it."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree

import pytest

import kille.ros
from kille.bus import BusError
from kille.ros.system_modules import Finder, ros

PACKAGE = Path(kille.ros.__file__).parent / "package"

ALONE = """
import sys
from kille.ros.system_modules import ros
ros("rospy"), ros("sensor_msgs.msg")
import cv2, numpy
for module in (numpy, cv2):
    assert "dist-packages" not in module.__file__, module.__file__
try:
    import rosbag
except ImportError:
    print("only what a node is made of")
"""


@pytest.mark.ros
@pytest.mark.usefixtures("master")
def test_ros_is_found_and_nothing_of_the_systems_shadows_ours() -> None:
    done = subprocess.run(
        [sys.executable, "-c", ALONE], text=True, capture_output=True, check=False
    )
    assert done.stdout == "only what a node is made of\n", done.stderr


PLAIN = """
import sys
import kille.ros.bus
sys.path[:] = [folder for folder in sys.path if "site-packages" not in folder]
kille.ros.bus.open_ros("plain").close()
"""


@pytest.mark.ros
@pytest.mark.usefixtures("master")
def test_a_node_begins_where_the_environment_has_nothing_for_ros() -> None:
    done = subprocess.run(
        [sys.executable, "-c", PLAIN], text=True, capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_only_named_modules_are_found_in_a_folder(tmp_path: Path) -> None:
    for name in ("wanted", "numpy"):
        (tmp_path / f"{name}.py").write_text("")
    finder = Finder([str(tmp_path)], ["wanted"])
    found = finder.find_spec("wanted", None)
    assert found is not None
    assert found.origin == str(tmp_path / "wanted.py")
    assert finder.find_spec("numpy", None) is None
    assert finder.find_spec("wanted", ["inside a package"]) is None
    assert Finder([], ["wanted"]).find_spec("wanted", None) is None


def test_where_ros_is_absent_one_line_says_how_to_get_it() -> None:
    with pytest.raises(BusError) as caught:
        ros("nonesuch_msgs")
    assert "nonesuch_msgs is missing" in str(caught.value)
    assert "sudo apt install" in str(caught.value)


def test_the_package_for_roslaunch_is_of_this_version() -> None:
    told = ElementTree.parse(PACKAGE / "package.xml")
    assert told.findtext("version") == version("kille")
    assert told.findtext("name") == "kille"


def test_what_roslaunch_starts_is_there_and_can_be_run() -> None:
    launch = ElementTree.parse(PACKAGE / "launch" / "kille.launch")
    for node in launch.iter("node"):
        started = PACKAGE / "scripts" / node.attrib["type"]
        assert started.stat().st_mode & 0o111
