"""Raw depth in millimetres and on the colour picture, against the plain definition."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from kille.sensors.kinect.calibration import (
    IDENTITY,
    Calibration,
    CalibrationError,
    Padding,
    Registration,
)
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture, frame_of
from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.metric import beyond, depths, millimetres, raw_of
from kille.sensors.kinect.registration import register_depth
from kinect_emulator.calibration import LIKELY

TYPICAL = Calibration.typical()
ALL_RAW = np.arange(2048, dtype=np.uint16)


def device() -> Calibration:
    """The emulated device's calibration, of which no number is zero."""
    return Calibration.from_replies(
        LIKELY.registration_reply(),
        LIKELY.padding_reply(),
        LIKELY.fixed_reply(322),
        LIKELY.shift_reply(),
    )


def scene(seed: int = 0) -> NDArray[np.uint16]:
    """A slope with boxes before it, and holes: what is near hides what is far."""
    rng = np.random.default_rng(seed)
    raw = (600 + np.add.outer(np.arange(480) // 4, np.arange(640) // 3)).astype(
        np.uint16
    )
    for _ in range(12):
        y, x = rng.integers(0, 420), rng.integers(0, 580)
        raw[y : y + 60, x : x + 60] = rng.integers(350, 1000)
    raw[rng.random(raw.shape) < 0.05] = 2047
    return raw


def test_replies_tell_the_calibration() -> None:
    known = device()
    assert all(known.registration)
    assert known.padding == Padding(1, 2, 3)
    assert known.zero_plane.dcmos_rcmos_distance == pytest.approx(2.4)
    assert known.zero_plane.dcmos_emitter_distance == pytest.approx(7.5)


def test_replies_that_make_no_sense_are_refused() -> None:
    good = (
        LIKELY.registration_reply(),
        LIKELY.padding_reply(),
        LIKELY.fixed_reply(322),
        LIKELY.shift_reply(),
    )
    for place, what in enumerate(("registration", "padding", "fixed", "constant")):
        replies = [*good]
        replies[place] = replies[place][:-2]
        with pytest.raises(BadReplyError, match=what):
            Calibration.from_replies(*replies)
    blank = [good[0], good[1], bytes(322), good[3]]
    with pytest.raises(BadReplyError, match="zero plane cannot be"):
        Calibration.from_replies(*blank)


@pytest.mark.parametrize("calibration", [TYPICAL, IDENTITY, device()])
def test_a_calibration_is_read_as_it_was_written(calibration: Calibration) -> None:
    assert Calibration.from_json(calibration.to_json()) == calibration


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "not JSON"),
        ("[]", "no reg_info"),
        ('{"reg_info": {}}', "no zero_plane_info"),
        (TYPICAL.to_json().replace('"ax"', '"az"'), "no number for ax"),
        (TYPICAL.to_json().replace("1964", '"1964"'), "no number for ax"),
        (TYPICAL.to_json().replace("1964", "NaN"), "nan for ax"),
    ],
)
def test_a_device_json_that_lacks_something_is_refused(text: str, said: str) -> None:
    with pytest.raises(CalibrationError, match=said):
        Calibration.from_json(text)


def test_device_json_has_libfreenects_keys() -> None:
    told = json.loads(TYPICAL.to_json())
    assert told["const_shift"] == 200
    assert told["reg_info"]["dx_center"] == 2048330528
    assert told["reg_info"]["pad_info"]["start_lines"] == 0
    assert told["reg_info"]["zero_plane_info"]["reference_distance"] == 120


def test_tables_agree_with_the_formula_known_by_measuring() -> None:
    """0.1236 tan(raw / 2842.5 + 1.1863) metres, fitted to devices by their users."""
    raw = ALL_RAW[450:950]
    measured = 1000 * 0.1236 * np.tan(raw / 2842.5 + 1.1863)
    assert np.abs(millimetres(raw, TYPICAL) / measured - 1).max() < 0.01


def test_farther_is_more_until_it_is_too_far() -> None:
    known = millimetres(ALL_RAW, TYPICAL)
    edge = beyond(TYPICAL)
    assert (np.diff(known[:edge].astype(int)) >= 0).all()
    assert known[edge - 1] < 10_000 == known[edge]
    assert known[2047] == 0


@given(st.integers(0, beyond(TYPICAL) - 1))
def test_raw_numbers_come_back(raw: int) -> None:
    mm = millimetres(np.array([[raw]], np.uint16), TYPICAL)
    back = raw_of(mm, TYPICAL)
    assert depths(TYPICAL)[back[0, 0]] == mm[0, 0]


@given(st.floats(320, 9_900))
def test_the_nearest_raw_number_is_found(mm: float) -> None:
    known = depths(TYPICAL)[: beyond(TYPICAL)].astype(float)
    found = int(raw_of(np.array([mm]), TYPICAL)[0])
    assert abs(known[found] - mm) == pytest.approx(np.abs(known - mm).min())


def test_without_depth_there_is_no_raw_number() -> None:
    none = raw_of(np.array([0.0, np.nan, 20_000.0, 100.0]), TYPICAL)
    assert (none == 2047).all()


def signed(value: int, bits: int) -> int:
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value


def plainly_bent(numbers: Registration, axis: str) -> NDArray[np.float64]:
    """One of the two maps, summed up pixel by pixel as the device defines it."""
    told = numbers._asdict()
    value = signed(told[f"d{axis}_start"], 19) * 512
    right, down = (signed(told[f"d{it}d{axis}_start"], 21) * 256 for it in "xy")
    right_right, down_right, down_down = (
        signed(told[f"d{it}d{axis}_start"], 24) * 256 for it in ("xdx", "ydx", "ydy")
    )
    a, b, c, d = (told[f"{it}{axis}"] for it in "abcd")
    bent = np.empty((480, 640))
    for row in bent:
        right_right += c
        right, down_right = right + (down_right >> 8), down_right + d
        value, down = value + (down >> 6), down + (down_down >> 8)
        down_down += b
        here, step, growth = value, right, right_right
        for column in range(640):
            row[column] = here / (1 << 17)
            here, step, growth = here + (step >> 6), step + (growth >> 8), growth + a
    return bent


def plainly_registered(raw: NDArray[np.uint16], it: Calibration) -> NDArray[np.uint16]:
    """The map, one pixel after another."""
    right, down = (plainly_bent(it.registration, axis) for axis in "xy")
    plane, mm_of = it.zero_plane, depths(it)
    tenths = np.float32(plane.reference_pixel_size) * np.float32(20)
    step = 1 / float(tenths)
    reference = plane.reference_distance * step * 10
    seen = np.zeros(480 * 640, np.uint16)
    for y, x in np.ndindex(480, 640):
        mm = int(mm_of[raw[y, x]])
        there = (x + right[y, x] + 1, y + down[y, x] + 1)
        if not (0 < mm < 10_000 and 0 <= there[0] < 640 and 0 <= there[1] < 480):
            continue
        apart = plane.dcmos_rcmos_distance * step * 10 * (mm * step - reference)
        shift = int((apart / (mm * step) + 0.375) * 256)
        column = int((int(there[0] * 256) + shift) / 256)
        place = int(there[1]) * 640 + column - 480 * it.padding.start_lines
        if 0 <= column < 640 and place >= 0 and not 0 < seen[place] <= mm:
            seen[place] = mm
    return seen.reshape(480, 640)


@pytest.mark.parametrize("calibration", [TYPICAL, device()])
def test_depth_lands_where_the_definition_says(calibration: Calibration) -> None:
    raw = scene()
    assert np.array_equal(
        register_depth(raw, calibration), plainly_registered(raw, calibration)
    )


def test_identity_moves_nothing() -> None:
    mm = millimetres(scene(), IDENTITY)
    assert np.array_equal(
        register_depth(scene(), IDENTITY), np.where(mm < 10_000, mm, 0)
    )


def test_a_frame_has_metres_where_depth_is_known() -> None:
    raw = np.full((480, 640), 700, np.uint16)
    raw[:, 100] = 2047
    raw[:, 200] = beyond(IDENTITY)
    raw[:, 201] = 1090  # behind everything; in sixteen bits it would wrap around
    colour = np.zeros((480, 640, 3), np.uint8)
    frame = frame_of(KinectCapture(1.5, colour, raw, 1, 2), IDENTITY)
    assert frame.depth is not None
    assert frame.depth.dtype == np.float32
    assert frame.depth[5, 5] == pytest.approx(0.887)
    assert np.isnan(frame.depth[:, [100, 200, 201]]).all()
    assert np.isnan(frame.depth).sum() == 3 * 480
    assert (frame.time, frame.intrinsics) == (1.5, COLOUR_CAMERA)
