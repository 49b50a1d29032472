"""Names of simulated sources, and what is said about wrong ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from kille.sensors.sensor import SensorError
from kille.sensors.synthetic import open_synthetic
from kille.sensors.synthetic.address import SceneAddress, parse_address
from kille.sensors.synthetic.faults import FAULTS


@pytest.mark.parametrize(
    ("name", "address"),
    [
        ("synthetic", SceneAddress("desk", 0, frozenset(FAULTS), None)),
        ("synthetic:", SceneAddress("desk", 0, frozenset(FAULTS), None)),
        ("synthetic:all", SceneAddress("all", 0, frozenset(FAULTS), None)),
        ("synthetic:desk?seed=7", SceneAddress("desk", 7, frozenset(FAULTS), None)),
        ("synthetic?faults=none", SceneAddress("desk", 0, frozenset(), None)),
        (
            "synthetic?faults=all&seed=2",
            SceneAddress("desk", 2, frozenset(FAULTS), None),
        ),
        (
            "synthetic:Empty?faults=noise,Bayer",
            SceneAddress("empty", 0, frozenset({"noise", "bayer"}), None),
        ),
        (
            "synthetic:empty?meshes=a%20b/c",
            SceneAddress("empty", 0, frozenset(FAULTS), Path("a b/c")),
        ),
    ],
)
def test_an_address_reads(name: str, address: SceneAddress) -> None:
    assert parse_address(name) == address


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("synthetik", "no source 'synthetik' .did you mean synthetic"),
        ("synthetic:dsk", "no scene 'dsk' .did you mean desk.*desk, empty, all"),
        (
            "synthetic?sede=1",
            "no option 'sede' .did you mean seed.*seed, faults, meshes",
        ),
        ("synthetic?faults=nose", "no fault 'nose' .did you mean noise.*noise, steps"),
        ("synthetic?faults=none,noise", "stand alone"),
        ("synthetic?seed=x", "whole number"),
        ("synthetic?seed=-1", "whole number"),
        ("synthetic?specimen=x", "a specimen is a whole number"),
        ("synthetic?seed=1.5", "whole number"),
        ("synthetic?seed", "has no value"),
        ("synthetic?seed=", "has no value"),
        ("synthetic?meshes=/nowhere", "/nowhere: no such mesh"),
    ],
)
def test_a_wrong_address_is_one_clear_line(name: str, words: str) -> None:
    with pytest.raises(SensorError, match=words) as caught:
        open_synthetic(name)
    assert "\n" not in str(caught.value)


def test_the_sensor_keeps_its_name() -> None:
    assert open_synthetic("synthetic:empty?seed=7").name == "synthetic:empty?seed=7"
