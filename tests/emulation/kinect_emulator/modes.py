"""The isochronous streams of the camera, and when each of their packets is due."""

from __future__ import annotations

from dataclasses import dataclass

MICROFRAMES_PER_SECOND = 8_000
TICKS_PER_SECOND = 60_000_000
HEADER = 12
VIDEO, DEPTH = 0x81, 0x82
_PERIOD = 800


@dataclass(frozen=True)
class Mode:
    """One kind of stream: its endpoint and flags, and how its frames are cut.

    `frames` of `size` bytes come in 800 microframes (a tenth of a second), each in
    packets of at most `payload` bytes behind a header.
    """

    name: str
    endpoint: int
    base: int
    size: int
    payload: int
    frames: int = 3

    @property
    def packets(self) -> int:
        """The packets of one frame."""
        return -(-self.size // self.payload)

    @property
    def last(self) -> int:
        """The payload of a frame's last packet."""
        return self.size - (self.packets - 1) * self.payload

    def due(self, packet: int) -> int:
        """The microframe in which the packet is sent, both counted from the start.

        Whole numbers all the way: a rounded step would now and then send a packet
        twice or not at all.

        >>> [DEPTH_11.due(packet) for packet in (0, 1, 9, 10, 242)]
        [0, 1, 9, 11, 266]
        """
        return packet * _PERIOD // (self.frames * self.packets)

    def before(self, microframe: int) -> int:
        """How many packets are due before the microframe.

        >>> DEPTH_11.before(800) == 3 * DEPTH_11.packets
        True
        """
        return -(-microframe * self.frames * self.packets // _PERIOD)

    def ticks(self, frame: int) -> int:
        """The device's clock at that frame, in 60 MHz ticks since the start."""
        per_second = 10 * self.frames
        return frame * TICKS_PER_SECOND // per_second


_DEPTH_PAYLOAD, _VIDEO_PAYLOAD = 1_748, 1_908
DEPTH_11 = Mode("depth, 11 bits", DEPTH, 0x70, 422_400, _DEPTH_PAYLOAD)
DEPTH_10 = Mode("depth, 10 bits", DEPTH, 0x70, 384_000, _DEPTH_PAYLOAD)
BAYER = Mode("colour", VIDEO, 0x80, 307_200, _VIDEO_PAYLOAD)
BAYER_LARGE = Mode("large colour", VIDEO, 0x80, 1_310_720, _VIDEO_PAYLOAD, frames=1)
INFRARED = Mode("infrared", VIDEO, 0x80, 390_400, _VIDEO_PAYLOAD)
