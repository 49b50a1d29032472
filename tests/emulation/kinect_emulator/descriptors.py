"""The USB devices inside a Kinect, and the descriptors by which a host knows them."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import Enum

MICROSOFT, NEC = 0x045E, 0x0409
NO_SERIAL = "0000000000000000"


class Role(Enum):
    """What a device inside a Kinect does."""

    HUB = "hub"
    MOTOR = "motor"
    CAMERA = "camera"
    AUDIO = "audio"
    OTHER = "other"


@dataclass(frozen=True)
class Part:
    """One USB device: who it says it is, and its interfaces' endpoints.

    Each of `alternates` is a setting of interface 0: the endpoints it has, each with
    its address, attributes (1 isochronous, 2 bulk) and wMaxPacketSize.
    """

    role: Role
    product: int
    release: int
    name: str
    vendor: int = MICROSOFT
    alternates: tuple[tuple[tuple[int, int, int], ...], ...] = ((),)
    tells_serial: bool = True

    def device(self) -> bytes:
        """The device descriptor."""
        kind = 9 if self.role is Role.HUB else 0
        return struct.pack(
            "<2BH4B3H4B",
            *(18, 1, 0x0200, kind, 0, 0, 64),
            *(self.vendor, self.product, self.release),
            *(1, 2, 3 if self.tells_serial else 0, 1),
        )

    def configuration(self) -> bytes:
        """The one configuration with all its interfaces and endpoints."""
        body = b"".join(
            _alternate(number, endpoints)
            for number, endpoints in enumerate(self.alternates)
        )
        head = struct.pack("<2BH5B", 9, 2, 9 + len(body), 1, 1, 0, 0xC0, 50)
        return head + body

    def string(self, index: int, serial: str) -> bytes | None:
        """The string descriptor of that index, if there is one."""
        if index == 0:
            return struct.pack("<2BH", 4, 3, 0x0409)
        texts = ("Microsoft", self.name, serial)
        if index > len(texts):
            return None
        text = texts[index - 1].encode("utf-16-le")
        return struct.pack("2B", 2 + len(text), 3) + text

    def packet_size(self, endpoint: int, alternate: int) -> int | None:
        """The most bytes an isochronous packet of the endpoint holds, if it has one."""
        for address, _, size in self.alternates[alternate]:
            if address == endpoint:
                return (size & 0x7FF) * (1 + (size >> 11 & 3))
        return None


def _alternate(number: int, endpoints: tuple[tuple[int, int, int], ...]) -> bytes:
    interface = struct.pack("9B", 9, 4, 0, number, len(endpoints), 255, 0, 0, 0)
    return interface + b"".join(
        struct.pack("<4BHB", 7, 5, address, attributes, size, 1)
        for address, attributes, size in endpoints
    )


@dataclass(frozen=True)
class Model:
    """A kind of Kinect: the devices in it, and the serial number its camera tells."""

    name: str
    parts: tuple[Part, ...]
    camera_tells_serial: bool = True
    fixed_size: int = 334


# 1920 bytes of video are two packets of 960 in a microframe, 1760 of depth two of 880.
_STREAMS = ((0x81, 1, 1 << 11 | 960), (0x82, 1, 1 << 11 | 880))
_BULK = ((0x01, 2, 512), (0x81, 2, 512))
_OLD_HUB = Part(Role.HUB, 0x005A, 0x0100, "USB2.0 Hub", NEC, tells_serial=False)
_NEW_HUB = Part(Role.HUB, 0x02C2, 0x0100, "Kinect USB Hub", tells_serial=False)
_MOTOR = Part(Role.MOTOR, 0x02B0, 0x0105, "Xbox NUI Motor", tells_serial=False)
_CAMERA = Part(Role.CAMERA, 0x02AE, 0x010B, "Xbox NUI Camera", alternates=(_STREAMS,))
_AUDIO = Part(Role.AUDIO, 0x02AD, 0x0100, "Xbox NUI Audio", alternates=(_BULK,))

MODEL_1414 = Model("1414", (_OLD_HUB, _MOTOR, _AUDIO, _CAMERA), fixed_size=322)
MODEL_1473 = Model(
    "1473",
    (
        _NEW_HUB,
        _AUDIO,
        Part(Role.CAMERA, 0x02AE, 0x0114, "Xbox NUI Camera", alternates=(_STREAMS,)),
    ),
    camera_tells_serial=False,
)
FOR_WINDOWS = Model(
    "Kinect for Windows",
    (
        _NEW_HUB,
        Part(Role.AUDIO, 0x02BE, 0x0100, "Microsoft Kinect", alternates=(_BULK,)),
        Part(Role.CAMERA, 0x02BF, 0x0114, "Kinect Camera", alternates=((), _STREAMS)),
    ),
    camera_tells_serial=False,
)
UNPOWERED = Model("1414 without its power supply", (_OLD_HUB, _MOTOR))
SECOND_KINECT = Model(
    "Kinect v2",
    (
        Part(Role.HUB, 0x02D9, 0x0070, "Kinect hub", tells_serial=False),
        Part(Role.OTHER, 0x02C4, 0x0100, "Xbox NUI Sensor"),
    ),
)
MODELS = (MODEL_1414, MODEL_1473, FOR_WINDOWS, UNPOWERED, SECOND_KINECT)
