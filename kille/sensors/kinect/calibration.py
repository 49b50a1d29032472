"""What a camera knows of itself: how its depth is measured and lies in its colour.

Every device has numbers of its own, which it reports on request. libfreenect's
recordings keep them in `device.json`, which is read and written here.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from kille.sensors.kinect.commands import BadReplyError
from ttr.safety.inputs import parse_json

_REGISTRATION = struct.Struct("<2x29i")
_PADDING = struct.Struct("<2x3H")
_CONST_SHIFT = struct.Struct("<2xH")
_ZERO_PLANE = struct.Struct("<4f")
_ZERO_PLANE_AT = 94
_FIXED_LENGTHS = (322, 334)
"""Of the fixed parameters: model 1414, and all others."""

COLOUR_DISTANCE = float(np.float32(2.4))
"""From the infrared camera to the colour camera, in centimetres.

The devices say 2.3; OpenNI and libfreenect take 2.4 for all of them.
"""


class Registration(NamedTuple):
    """The 29 numbers of the map from depth to colour, in the device's own order."""

    dx_center: int
    ax: int
    bx: int
    cx: int
    dx: int
    dx_start: int
    ay: int
    by: int
    cy: int
    dy: int
    dy_start: int
    dx_beta_start: int
    dy_beta_start: int
    rollout_blank: int
    rollout_size: int
    dx_beta_inc: int
    dy_beta_inc: int
    dxdx_start: int
    dxdy_start: int
    dydx_start: int
    dydy_start: int
    dxdxdx_start: int
    dydxdx_start: int
    dxdxdy_start: int
    dydxdy_start: int
    back_comp1: int
    dydydx_start: int
    back_comp2: int
    dydydy_start: int


class Padding(NamedTuple):
    """Lines of the sensor that the picture leaves out."""

    start_lines: int
    end_lines: int
    cropping_lines: int


class ZeroPlane(NamedTuple):
    """The plane at which the pattern was recorded; lengths in centimetres.

    From the infrared camera to the projector, to the colour camera and to the plane;
    and the size on the plane of a pixel, of which the sensor has 1280 in a row.
    """

    dcmos_emitter_distance: float
    dcmos_rcmos_distance: float
    reference_distance: float
    reference_pixel_size: float


class CalibrationError(ValueError):
    """A `device.json` that is incomplete or wrong: one line says where."""


@dataclass(frozen=True)
class Calibration:
    """All that a device reports about its depth; see the types of the fields."""

    registration: Registration
    padding: Padding
    zero_plane: ZeroPlane
    const_shift: int

    @classmethod
    def from_replies(
        cls, registration: bytes, padding: bytes, fixed: bytes, const_shift: bytes
    ) -> Calibration:
        """Read from the replies of the device.

        Raises `BadReplyError` if a reply is too short or makes no sense.

        The four are the payloads of REGISTRATION, PADDING, FIXED_PARAMETERS and
        CONST_SHIFT, see `kille.sensors.kinect.commands`.
        """
        for what, reply, lengths in (
            ("registration", registration, (_REGISTRATION.size,)),
            ("padding", padding, (_PADDING.size,)),
            ("fixed parameters", fixed, _FIXED_LENGTHS),
            ("constant shift", const_shift, (_CONST_SHIFT.size,)),
        ):
            if len(reply) not in lengths:
                raise BadReplyError(
                    f"{what}: {len(reply)} bytes instead of {lengths[0]}"
                )
        told = ZeroPlane(*_ZERO_PLANE.unpack_from(fixed, _ZERO_PLANE_AT))
        if not all(math.isfinite(length) and length > 0 for length in told):
            raise BadReplyError(f"the zero plane cannot be {tuple(told)}")
        return cls(
            Registration(*_REGISTRATION.unpack(registration)),
            Padding(*_PADDING.unpack(padding)),
            told._replace(dcmos_rcmos_distance=COLOUR_DISTANCE),
            _CONST_SHIFT.unpack(const_shift)[0],
        )

    @classmethod
    def typical(cls) -> Calibration:
        """A device's numbers, for recordings that do not have their own.

        They are those that libfreenect once had as its default.
        """
        return _TYPICAL

    @classmethod
    def from_json(cls, text: str) -> Calibration:
        """Read from a `device.json`; CalibrationError if something is missing or wrong.

        >>> Calibration.from_json(IDENTITY.to_json()) == IDENTITY
        True
        """
        try:
            told = parse_json(text)
        except ValueError as error:
            raise CalibrationError(f"device.json is not JSON: {error}") from None
        registration = _part(told, "reg_info")
        plane = _numbers(_part(registration, "zero_plane_info"), ZeroPlane._fields)
        return cls(
            Registration(*map(int, _numbers(registration, Registration._fields))),
            Padding(
                *map(int, _numbers(_part(registration, "pad_info"), Padding._fields))
            ),
            ZeroPlane(*(float(np.float32(length)) for length in plane)),
            int(_numbers(told, ("const_shift",))[0]),
        )

    def to_json(self) -> str:
        """The text of a `device.json` as libfreenect writes and reads it."""
        inner = {
            "pad_info": self.padding._asdict(),
            "zero_plane_info": self.zero_plane._asdict(),
        }
        told = {
            "reg_info": self.registration._asdict() | inner,
            "const_shift": self.const_shift,
        }
        return json.dumps(told, indent=4) + "\n"


def _part(told: Any, key: str) -> Mapping[str, Any]:
    part = told.get(key) if isinstance(told, dict) else None
    if not isinstance(part, dict):
        raise CalibrationError(f"device.json has no {key}")
    return part


def _numbers(part: Mapping[str, Any], keys: tuple[str, ...]) -> list[float]:
    for key in keys:
        value = part.get(key)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise CalibrationError(f"device.json has no number for {key}")
        if not math.isfinite(value):
            raise CalibrationError(f"device.json has {value} for {key}")
    return [part[key] for key in keys]


_PLANE = ZeroPlane(
    7.5, COLOUR_DISTANCE, 120.0, reference_pixel_size=float(np.float32(0.1042))
)

# fmt: off
_TYPICAL = Calibration(
    Registration(
        2048330528, 1964, 56, -26, 600, 6161, -13, 2825, 684, 5, 6434, 10062, 130801,
        0, 0, 170, 136, 2095986, 890, 763, 2096378, 134215474, 134217093, 134216989,
        134216925, 0, 134216984, 0, 134214659,
    ),
    Padding(0, 0, 0), _PLANE, const_shift=200,
)
# fmt: on

_STRAIGHT = Registration(*[0] * len(Registration._fields))

IDENTITY = Calibration(
    # The map moves every pixel by one to the right and down before it begins.
    _STRAIGHT._replace(dx_start=-256, dy_start=-256),
    Padding(0, 0, 0),
    _PLANE._replace(dcmos_rcmos_distance=0.0),
    const_shift=200,
)
"""A camera whose depth lies in its colour picture already, pixel for pixel."""
