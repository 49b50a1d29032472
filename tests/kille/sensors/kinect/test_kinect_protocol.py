"""Commands, motor and unpacking: bytes as the device has them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from kille.sensors.kinect import commands
from kille.sensors.kinect.bayer import colour_of
from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.motor import Tilt, tilt_value
from kille.sensors.kinect.streams import DEPTH_10, DEPTH_11
from kille.sensors.kinect.unpacking import unpack_10, unpack_11

REPLY = bytes.fromhex("52 42 02 00 02 00 09 00 06 00 02 00")


def test_a_reply_carries_its_payload() -> None:
    carried = commands.payload(REPLY, commands.READ_REGISTER, 9)
    assert commands.register_value(carried, 0x06) == 2


@pytest.mark.parametrize(
    ("reply", "said"),
    [
        (REPLY[:5], "a reply of 5 bytes"),
        (b"XB" + REPLY[2:], "begins with 5842"),
        (REPLY[:4] + b"\x03" + REPLY[5:], "a reply to command 0x03, tag 9"),
        (REPLY[:6] + b"\x08" + REPLY[7:], "a reply to command 0x02, tag 8"),
        (REPLY[:-1], "3 bytes of a reply of 4"),
        (REPLY[:2] + b"\xff\xff" + REPLY[4:], "4 bytes of a reply of 131070"),
    ],
)
def test_a_reply_that_does_not_fit_is_refused(reply: bytes, said: str) -> None:
    with pytest.raises(BadReplyError, match=said):
        commands.payload(reply, commands.READ_REGISTER, 9)


@given(st.binary(max_size=40))
def test_any_bytes_are_a_reply_or_refused(reply: bytes) -> None:
    try:
        carried = commands.payload(reply, commands.READ_REGISTER, 9)
    except BadReplyError:
        return
    assert reply[:8] + carried == reply


def test_a_state_has_an_angle_gravity_and_motion() -> None:
    tilt = Tilt.from_reply(bytes.fromhex("00 00 ff cd 03 33 00 00 ec 04"))
    assert (tilt.degrees, tilt.moving) == (-10.0, True)
    assert tilt.gravity == pytest.approx((-51 / 819, 1.0, 0.0))
    with pytest.raises(BadReplyError, match="9 bytes instead of 10"):
        Tilt.from_reply(bytes(9))


@given(st.floats(-31, 31))
def test_a_tilt_is_sent_in_halves_of_a_degree(degrees: float) -> None:
    value = tilt_value(degrees)
    signed = value - 0x10000 if value >= 0x8000 else value
    assert signed / 2 == pytest.approx(degrees, abs=0.25)


def in_bits(packed: np.ndarray, bits: int) -> np.ndarray:
    """Pixels from the bits one after another, as the format is defined."""
    rows = np.unpackbits(packed).reshape(-1, bits).astype(np.uint32)
    return (rows @ (1 << np.arange(bits - 1, -1, -1))).astype(np.uint16)


@pytest.mark.parametrize(
    ("unpack", "bits", "size"),
    [
        (unpack_11, 11, DEPTH_11.frame_size),
        (unpack_10, 10, DEPTH_10.frame_size),
        (unpack_10, 10, 640 * 488 * 10 // 8),
    ],
)
def test_pixels_are_taken_out_of_the_bits(unpack, bits: int, size: int) -> None:
    packed = np.random.default_rng(bits).integers(0, 256, size).astype(np.uint8)
    pixels = unpack(packed)
    assert pixels.dtype == np.uint16
    assert pixels.shape == (size * 8 // bits // 640, 640)
    assert np.array_equal(pixels.ravel(), in_bits(packed, bits))


@given(arrays(np.uint8, 3, elements=st.integers(0, 255)))
def test_one_colour_is_seen_behind_every_filter(rgb: np.ndarray) -> None:
    mosaic = np.empty((8, 8), np.uint8)
    mosaic[0::2, 0::2] = mosaic[1::2, 1::2] = rgb[1]
    mosaic[0::2, 1::2] = rgb[0]
    mosaic[1::2, 0::2] = rgb[2]
    assert (colour_of(mosaic) == rgb).all()
