"""The motor of model 1414: tilt, light and accelerometer, as control transfers."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum
from numbers import Real

from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.sensor import SensorError

SET_TILT, SET_LIGHT, GET_STATE = 0x31, 0x06, 0x32
STATE_LENGTH = 10

STEEPEST = 31.0
"""Degrees up or down from the horizontal that the motor may be told."""

COUNTS = 819.0
"""What the accelerometer counts for the pull of the earth, 1 g."""

_MOVING = 4


class Light(IntEnum):
    """What the light can show, as the device numbers it."""

    OFF = 0
    GREEN = 1
    RED = 2
    YELLOW = 3
    BLINKING_GREEN = 4
    BLINKING_RED_AND_YELLOW = 6


@dataclass(frozen=True)
class Tilt:
    """How the Kinect stands: the accelerometer's counts, the motor's angle and state.

    `doubled` is twice the angle in degrees above the horizontal; `status` is 0 when the
    motor rests, 1 at its limit, 4 while it moves.
    """

    x: int
    y: int
    z: int
    doubled: int
    status: int

    @classmethod
    def from_reply(cls, reply: bytes) -> Tilt:
        """Read from the ten bytes of GET_STATE; BadReplyError if there are not ten.

        >>> Tilt.from_reply(bytes.fromhex("00 00 00 10 03 30 00 20 f6 00")).degrees
        -5.0
        """
        if len(reply) != STATE_LENGTH:
            raise BadReplyError(
                f"the motor's state has {len(reply)} bytes instead of 10"
            )
        return cls(*struct.unpack(">2x3hbB", reply))

    @property
    def degrees(self) -> float:
        """The motor's angle above the horizontal."""
        return self.doubled / 2

    @property
    def gravity(self) -> tuple[float, float, float]:
        """The accelerometer's reading, where 1 is the pull of the earth."""
        return (self.x / COUNTS, self.y / COUNTS, self.z / COUNTS)

    @property
    def moving(self) -> bool:
        """Whether the motor is at work."""
        return self.status == _MOVING


def tilt_value(degrees: object) -> int:
    """The wValue that sets the angle: int16 of twice the degrees.

    SensorError for what is not a number from -31 to 31.

    >>> hex(tilt_value(-10)), tilt_value(31)
    ('0xffec', 62)
    """
    if not isinstance(degrees, bool) and isinstance(degrees, Real):
        number = float(degrees)
        if -STEEPEST <= number <= STEEPEST:
            return round(2 * number) & 0xFFFF
    raise SensorError(
        "a tilt is a number of degrees from -31 (down) to 31 (up), such as -10, "
        f"and not {degrees!r}"
    )


def light_value(light: object) -> int:
    """The wValue that sets the light; SensorError for what is no `Light`.

    >>> light_value(Light.GREEN)
    1
    """
    if isinstance(light, Light):
        return int(light)
    known = ", ".join(f"Light.{it.name}" for it in Light)
    raise SensorError(f"a light is one of {known}, and not {light!r}")
