"""Each fault of the Kinect, alone and among the others."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.scene import Frame
from kille.sensors.synthetic import open_synthetic
from kille.sensors.synthetic.faults import (
    FAULTS,
    NOISE,
    FaultyView,
    depth_jumps,
    depth_of,
    infrared_shadow,
    lost_edges,
    mosaic,
    raw_of,
    standard_noise,
    with_bayer,
    with_noise,
    with_steps,
)


def frame(faults: str) -> Frame:
    return open_synthetic(f"synthetic:desk?seed=5&faults={faults}").frame()


def depth(faults: str) -> np.ndarray:
    seen = frame(faults).depth
    assert seen is not None
    return seen


@given(st.floats(0.45, 8.0))
def test_raw_and_depth_are_inverse(z: float) -> None:
    assert depth_of(raw_of(np.array([z]))) == pytest.approx(z, rel=1e-4)


@pytest.mark.parametrize(
    ("raw", "millimetres"), [(450, 540), (600, 706), (800, 1194), (1000, 3864)]
)
def test_the_raw_curve_is_a_devices(raw: int, millimetres: int) -> None:
    assert depth_of(np.array([raw])) * 1000 == pytest.approx(millimetres, rel=0.002)


def test_steps_lie_on_the_eleven_bits() -> None:
    raw = raw_of(depth("steps"))
    assert np.abs(raw - np.rint(raw)).max() < 0.01
    assert np.abs(raw - raw_of(depth("none"))).max() <= 0.51
    assert raw.min() >= 0
    assert raw.max() < 2047


def test_steps_are_lost_beyond_the_last() -> None:
    assert np.isnan(with_steps(np.array([[0.1]], np.float32))).all()


def test_noise_grows_with_the_square_of_the_distance() -> None:
    for z in (0.6, 1.0, 2.0, 3.0):
        noise = standard_noise((200, 200), (int(10 * z),))
        errors = with_noise(np.full((200, 200), z, np.float32), noise) - z
        assert errors.std() == pytest.approx(NOISE * z**2, rel=0.05)
        assert abs(errors.mean()) < 0.1 * NOISE * z**2 + 1e-4


def test_the_shadow_is_as_wide_as_the_baseline_says() -> None:
    scene = np.full((4, 640), 1.5, np.float32)
    scene[:, 300:400] = 0.9
    dark = infrared_shadow(scene, 525.0)
    width = 525.0 * 0.075 * (1 / 0.9 - 1 / 1.5)
    assert dark[:, 300:].sum() == 0
    assert dark[0].sum() == pytest.approx(width, abs=1.5)
    assert dark[0, 300 - int(width) : 300].all()


def test_a_plain_table_has_no_shadow_and_no_edges() -> None:
    rows = np.linspace(0.6, 1.3, 480, dtype=np.float32)[::-1, None]
    table = np.ascontiguousarray(np.broadcast_to(rows, (480, 640)))
    assert not infrared_shadow(table, 525.0).any()
    assert not depth_jumps(table).any()


def test_edges_are_lost_at_jumps_only() -> None:
    scene = np.full((50, 60), 1.2, np.float32)
    scene[:, 30:] = 0.9
    jumps = depth_jumps(scene)
    lost = lost_edges(jumps, np.random.default_rng(0))
    assert set(np.nonzero(lost)[1]) == {29, 30}
    assert 0.6 < lost[:, 29:31].mean() < 0.9
    again = lost_edges(jumps, np.random.default_rng(1))
    assert (lost != again).any()


def test_the_mosaic_keeps_one_colour_a_pixel() -> None:
    rng = np.random.default_rng(0)
    colour = rng.integers(0, 256, (8, 8, 3), np.uint8)
    seen = mosaic(colour)
    assert seen[0, 0] == colour[0, 0, 1]
    assert seen[0, 1] == colour[0, 1, 0]
    assert seen[1, 0] == colour[1, 0, 2]
    assert seen[1, 1] == colour[1, 1, 1]


def test_flat_colour_stays_but_for_the_noise() -> None:
    colour = np.empty((64, 64, 3), np.uint8)
    colour[:] = (200, 100, 40)
    noise = standard_noise((64, 64), (0,))
    seen = with_bayer(mosaic(colour), noise).astype(float)
    assert np.abs(seen.mean(axis=(0, 1)) - (200, 100, 40)).max() < 0.5
    assert 0.5 < seen.std(axis=(0, 1)).max() < 3


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_changes_just_what_it_says(fault: str) -> None:
    plain, faulty = frame("none"), frame(fault)
    assert plain.depth is not None
    assert faulty.depth is not None
    colour_same = np.array_equal(plain.colour, faulty.colour)
    lost = np.isnan(faulty.depth)
    values_same = np.array_equal(plain.depth[~lost], faulty.depth[~lost])
    assert colour_same == (fault != "bayer")
    assert values_same == (fault not in ("noise", "steps"))
    assert lost.any() == (fault in ("shadow", "edges"))
    for name, mask in plain.outlines.items():
        assert np.array_equal(mask, faulty.outlines[name])


def test_switching_one_fault_off_leaves_the_others_as_they_were() -> None:
    everything, rest = frame("all"), frame("noise,steps,edges,bayer")
    assert everything.depth is not None
    assert rest.depth is not None
    assert np.array_equal(everything.colour, rest.colour)
    kept = ~np.isnan(everything.depth)
    assert np.array_equal(everything.depth[kept], rest.depth[kept])
    assert (~kept).sum() > np.isnan(rest.depth).sum()


def test_the_frames_of_a_view_are_those_of_a_view_seen_for_the_first_time() -> None:
    clean = frame("none")
    assert clean.depth is not None

    def view() -> FaultyView:
        assert clean.depth is not None
        return FaultyView(clean.colour, clean.depth, clean.intrinsics.fx, FAULTS)

    seen = view()
    for number in (3, 1, 2):
        seed = 5, number
        assert np.array_equal(seen.colour(seed), view().colour(seed))
        assert np.array_equal(seen.depth(seed), view().depth(seed), equal_nan=True)
