"""What each stream of the camera looks like on the wire, and how it is started.

Sizes are those of the device's own descriptors; a frame is cut into packets of which
all but the last are full, and each begins with a header of twelve bytes.
"""

from __future__ import annotations

from dataclasses import dataclass

HEADER = 12

Script = tuple[tuple[int, int], ...]
"""Registers and the values they are set to, in order."""

COLOUR_ENDPOINT, DEPTH_ENDPOINT = 0x81, 0x82


@dataclass(frozen=True)
class Mode:
    """One kind of stream.

    `packet_size` with the header; `mark` is the part of the packets' flags that names
    the stream; `frame_size` in bytes. The transfers must be under way before `start`.
    """

    name: str
    endpoint: int
    packet_size: int
    mark: int
    frame_size: int
    start: Script
    stop: Script

    @property
    def body(self) -> int:
        """The bytes of the frame in each packet but the last.

        >>> DEPTH_11.body, COLOUR.body
        (1748, 1908)
        """
        return self.packet_size - HEADER

    @property
    def packets(self) -> int:
        """How many packets make a frame.

        >>> DEPTH_11.packets, DEPTH_10.packets, COLOUR.packets, INFRARED.packets
        (242, 220, 162, 205)
        """
        return -(-self.frame_size // self.body)

    @property
    def last(self) -> int:
        """The bytes of the frame in the last packet.

        >>> DEPTH_11.last, COLOUR.last
        (1132, 12)
        """
        return self.frame_size - (self.packets - 1) * self.body


def _depth(name: str, bits: int, coding: int) -> Mode:
    return Mode(
        name,
        DEPTH_ENDPOINT,
        packet_size=1760,
        mark=0x70,
        frame_size=640 * 480 * bits // 8,
        start=(
            (0x105, 0),  # the projector is not switched off in turns
            (0x06, 0),
            (0x12, coding),
            (0x13, 1),  # 640x480
            (0x14, 30),  # frames a second
            (0x06, 2),
            (0x17, 0),  # not mirrored
        ),
        stop=((0x06, 0),),
    )


DEPTH_11 = _depth("depth of 11 bits", 11, coding=3)
DEPTH_10 = _depth("depth of 10 bits", 10, coding=2)

COLOUR = Mode(
    "colour",
    COLOUR_ENDPOINT,
    packet_size=1920,
    mark=0x80,
    frame_size=640 * 480,
    start=(
        (0x0C, 0),  # the Bayer pattern as it is
        (0x0D, 1),  # 640x480
        (0x0E, 30),  # frames a second
        (0x05, 1),
        (0x47, 0),  # not mirrored
    ),
    stop=((0x05, 0),),
)

INFRARED = Mode(
    "infrared",
    COLOUR_ENDPOINT,
    packet_size=1920,
    mark=0x80,
    frame_size=640 * 488 * 10 // 8,
    start=(
        (0x19, 0),  # ten bits, packed
        (0x1A, 1),  # 640x488
        (0x1B, 30),  # frames a second
        (0x105, 0),
        (0x05, 3),
        (0x48, 0),  # not mirrored
    ),
    stop=((0x05, 0),),
)
