"""What each Kinect was measured to be when it was made, as it tells it on request."""

from __future__ import annotations

import struct
from dataclasses import dataclass


@dataclass(frozen=True)
class Making:
    """The constants of one device.

    `registration` are 29 signed integers in the order of the device: dx_center;
    ax bx cx dx dx_start; ay by cy dy dy_start; dx_beta_start dy_beta_start;
    rollout_blank rollout_size; dx_beta_inc dy_beta_inc; dxdx dxdy dydx dydy _start;
    dxdxdx dydxdx dxdxdy dydxdy _start; back_comp1; dydydx_start; back_comp2;
    dydydy_start. `padding` are start, end and cropping lines. Distances are in
    centimetres, the pixel in millimetres.
    """

    registration: tuple[int, ...]
    padding: tuple[int, int, int] = (1, 0, 0)
    const_shift: int = 200
    emitter_distance: float = 7.5
    colour_distance: float = 2.3
    reference_distance: float = 120.0
    pixel_size: float = 0.1042

    def registration_reply(self) -> bytes:
        """The answer to algorithm 0x40: two bytes, then the 29 integers."""
        return struct.pack("<H29i", 0, *self.registration)

    def padding_reply(self) -> bytes:
        """The answer to algorithm 0x41: two bytes, then three words."""
        return struct.pack("<4H", 0, *self.padding)

    def shift_reply(self) -> bytes:
        """The answer to algorithm 0x00: two bytes, then the shift."""
        return struct.pack("<2H", 0, self.const_shift)

    def fixed_reply(self, size: int) -> bytes:
        """The answer to command 0x04: `size` bytes with four floats at byte 94."""
        floats = struct.pack(
            "<4f",
            self.emitter_distance,
            self.colour_distance,
            self.reference_distance,
            self.pixel_size,
        )
        filler = bytes(7 * i & 0xFF for i in range(size))
        return filler[:94] + floats + filler[94 + len(floats) :]


LIKELY = Making(
    registration=(
        2_047_999_001,
        *(1_871, 61, -31, 577, 5_903),
        *(-17, 2_693, 655, 7, 6_207),
        *(9_871, 130_733),
        *(3, 5),
        *(163, 131),
        *(2_096_003, 861, 741, 2_096_401),
        *(134_215_590, 134_217_113, 134_217_003, 134_216_951),
        1,
        134_217_001,
        2,
        134_214_799,
    ),
    padding=(1, 2, 3),
)
"""No device in particular, but lifelike, and every integer of it counts.

The fields are two's complement numbers of 17 to 27 bits, so that 2 096 003 is a small
step downwards.
"""
