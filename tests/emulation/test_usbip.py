"""The emulated bus over USB/IP, asked as a Linux kernel asks."""

from __future__ import annotations

import socket
import struct
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from kinect_emulator.descriptors import MODEL_1414
from kinect_emulator.host import Host
from kinect_emulator.kinect import Kinect
from kinect_emulator.usbip import Exporter

CAMERA = b"1-1.3"
SUBMITTED, UNLINKED = 3, 4
ECONNRESET, EPIPE = -104, -32


class Kernel:
    """A kernel's side of one connection, by the letter of the protocol."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        self.incoming = self._socket.makefile("rb")
        self._number = 0

    def take(self, place: bytes) -> tuple[int, bytes]:
        """Ask for the device there: the status and what is told of the device."""
        self._socket.sendall(struct.pack(">2HI32s", 0x111, 0x8003, 0, place))
        _, _, status = struct.unpack(">2HI", self.incoming.read(8))
        return status, b"" if status else self.incoming.read(312)

    def submit(
        self,
        setup: bytes = bytes(8),
        data: bytes = b"",
        room: int = 0,
        packets: int = 0,
    ) -> int:
        """Send a transfer; inwards if there is room."""
        self._number += 1
        head = (1, self._number, 0, int(room > 0), 2 if packets else 0)
        length = room or len(data)
        told = struct.pack(">5II4i8s", *head, 0, length, 0, packets, 0, setup)
        places = (struct.pack(">4I", n * 1_760, 1_760, 0, 0) for n in range(packets))
        self._socket.sendall(told + data + b"".join(places))
        return self._number

    def unlink(self, number: int) -> int:
        """Take a transfer back."""
        self._number += 1
        told = struct.pack(">5II24x", 2, self._number, 0, 0, 0, number)
        self._socket.sendall(told)
        return self._number

    def ended(self) -> tuple[int, int, int, int]:
        """What kind of answer, to which number, its status and actual length."""
        told = struct.unpack(">5I2i20x", self.incoming.read(48))
        return told[0], told[1], told[5], told[6]

    def close(self) -> None:
        """Let go."""
        self.incoming.close()
        self._socket.close()


@contextmanager
def beside(exporter: Exporter) -> Iterator[Kernel]:
    """A kernel that is connected to it."""
    with exporter.running():
        kernel = Kernel(exporter.port)
        yield kernel
        kernel.close()


@pytest.fixture
def kernel() -> Iterator[Kernel]:
    """A kernel beside an emulated Kinect."""
    with beside(Exporter(Host(Kinect()), port=0)) as kernel:
        yield kernel


def order(kernel: Kernel, register: int, value: int) -> None:
    """Have the camera write a register."""
    message = struct.pack("<2s5H", b"GM", 2, 3, 1, register, value)
    setup = struct.pack("<2B3H", 0x40, 0, 0, 0, len(message))
    number = kernel.submit(setup, message)
    assert kernel.ended() == (SUBMITTED, number, 0, len(message))


def test_a_device_is_taken_by_its_place(kernel: Kernel) -> None:
    status, told = kernel.take(CAMERA)
    assert status == 0
    assert told[256:288].rstrip(b"\0") == CAMERA
    assert struct.unpack_from(">2H", told, 300) == (0x045E, 0x02AE)


def test_what_is_not_there_is_not_given(kernel: Kernel) -> None:
    assert kernel.take(b"1-9") == (1, b"")


def test_descriptors_are_told_and_unknown_requests_stall(kernel: Kernel) -> None:
    kernel.take(CAMERA)
    setup = struct.pack("<2B3H", 0x80, 6, 0x0100, 0, 18)
    number = kernel.submit(setup, room=18)
    assert kernel.ended() == (SUBMITTED, number, 0, 18)
    assert kernel.incoming.read(18) == MODEL_1414.parts[3].device()
    number = kernel.submit(struct.pack("<2B3H", 0xC0, 0x77, 0, 0, 4), room=4)
    assert kernel.ended() == (SUBMITTED, number, EPIPE, 0)


def test_packets_come_end_to_end_with_their_places(kernel: Kernel) -> None:
    kernel.take(CAMERA)
    for register, value in ((0x12, 3), (0x06, 2)):
        order(kernel, register, value)
    number = kernel.submit(room=16 * 1_760, packets=16)
    kind, answered, status, length = kernel.ended()
    assert (kind, answered, status) == (SUBMITTED, number, 0)
    data = kernel.incoming.read(length)
    places = [struct.unpack(">4I", kernel.incoming.read(16)) for _ in range(16)]
    assert [place[0] for place in places] == [1_760 * n for n in range(16)]
    assert sum(place[2] for place in places) == length > 0
    assert data[:2] == b"RB"


def test_a_waiting_transfer_can_be_taken_back() -> None:
    # While its clock stands still no transfer ends by itself.
    with beside(Exporter(Host(Kinect()), port=0, speed=0.0)) as kernel:
        kernel.take(CAMERA)
        waiting = kernel.submit(room=16 * 1_760, packets=16)
        number = kernel.unlink(waiting)
        assert kernel.ended()[:3] == (UNLINKED, number, ECONNRESET)
        number = kernel.unlink(waiting)
        assert kernel.ended()[:3] == (UNLINKED, number, 0)


@pytest.mark.parametrize("said", [b"", b"GET / HTTP/1.1\r\n"], ids=["nothing", "other"])
def test_who_hangs_up_before_asking_leaves_no_trace(said: bytes) -> None:
    with Exporter(Host(Kinect()), port=0).running() as exporter:
        caller = socket.create_connection(("127.0.0.1", exporter.port), timeout=60)
        caller.sendall(said)
        caller.shutdown(socket.SHUT_WR)
        assert caller.recv(1) == b""
        caller.close()
        kernel = Kernel(exporter.port)
        assert kernel.take(CAMERA)[0] == 0
        kernel.close()
