"""The emulated bus for a Linux kernel: USB/IP, the protocol of its vhci-hcd.

    python -m kinect_emulator.usbip [--port 3240]

`usbip attach -r HOST -b 1-1.3` plugs the device at that place into the kernel: for it
and for all programs above it, it is a device on a real bus.
"""

from __future__ import annotations

import argparse
import io
import socket
import struct
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kinect_emulator.host import Code, Completion, Device, Host, Transfer, UsbError
from kinect_emulator.kinect import Kinect
from kinect_emulator.modes import MICROFRAMES_PER_SECOND

PORT = 3240
PATIENCE = 16_000
"""Microframes (two seconds) that the bus waits for a kernel that is itself emulated."""
_STEP = 0.008
_VERSION, _IMPORT, _IMPORTED = 0x0111, 0x8003, 0x0003
_SUBMIT, _UNLINK, _SUBMITTED, _UNLINKED = 1, 2, 3, 4
_IN = 1
_HIGH_SPEED = 3
_OPERATION = struct.Struct(">2HI")
_HEADER = struct.Struct(">5I")
_COMMAND = struct.Struct(">I4i8s")
_RESULT = struct.Struct(">5i8x")
_PACKET = np.dtype([(it, ">u4") for it in ("offset", "length", "actual", "status")])
_EPIPE, _ENODEV, _ECONNRESET, _EPROTO = -32, -19, -104, -71
_ERRORS = {Code.PIPE: _EPIPE, Code.NO_DEVICE: _ENODEV}


@dataclass(eq=False)
class _Import:
    """One device that a kernel has taken, and its transfers that wait."""

    connection: socket.socket
    device: Device
    handle: int
    waiting: dict[int, tuple[int, Transfer]] = field(default_factory=dict)
    going: list[bytes] = field(default_factory=list)


class Exporter:
    """Serves a host to kernels, one connection for each device they take."""

    def __init__(self, host: Host, port: int = PORT, speed: float = 1.0) -> None:
        self.host = host
        self._speed = speed
        self._lock = threading.RLock()
        self._over = threading.Event()
        self._imports: list[_Import] = []
        self._listener = socket.create_server(("127.0.0.1", port))

    @property
    def port(self) -> int:
        """Where it listens."""
        return int(self._listener.getsockname()[1])

    @contextmanager
    def running(self) -> Iterator[Exporter]:
        """Serve from threads of its own; kernels should have let go at the end."""
        threads = [
            threading.Thread(target=self._pass_time),
            threading.Thread(target=self._accept),
        ]
        for thread in threads:
            thread.start()
        try:
            yield self
        finally:
            self._over.set()
            self._listener.shutdown(socket.SHUT_RDWR)
            for thread in threads:
                thread.join()
            self._listener.close()

    def _accept(self) -> None:
        while not self._over.is_set():
            try:
                connection, _ = self._listener.accept()
            except OSError:
                return
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            threading.Thread(
                target=self._attend, args=(connection,), daemon=True
            ).start()

    def _pass_time(self) -> None:
        begun, passed = time.monotonic(), 0
        while not self._over.wait(_STEP):
            elapsed = (time.monotonic() - begun) * self._speed
            due = int(elapsed * MICROFRAMES_PER_SECOND) - passed
            passed += due
            with self._lock:
                self.host.pass_time(due)
                for completion in self.host.ended():
                    self._give_back(completion)
                for imported in self._imports:
                    _send_all(imported)

    def _attend(self, connection: socket.socket) -> None:
        """Serve one connection until it hangs up, whenever it does."""
        with (
            connection,
            connection.makefile("rb", buffering=1 << 16) as incoming,
            suppress(OSError),
        ):
            assert isinstance(incoming, io.BufferedReader)
            imported = self._import(connection, incoming)
            if imported is None:
                connection.sendall(_OPERATION.pack(_VERSION, _IMPORTED, 1))
                return
            try:
                self._serve(imported, incoming)
            finally:
                self._forget(imported)

    def _import(
        self, connection: socket.socket, incoming: io.BufferedReader
    ) -> _Import | None:
        """Hand the device over that is asked for, if it is there and free."""
        _OPERATION.unpack(_exactly(incoming, _OPERATION.size))
        place = _exactly(incoming, 32).rstrip(b"\0").decode(errors="replace")
        with self._lock:
            devices = self.host.devices.values()
            found = next((it for it in devices if _place(it) == place), None)
            if found is None or found.claimed_by is not None:
                return None
            handle = self.host.open(found.address)
            self.host.claim(handle)
            imported = _Import(connection, found, handle)
            self._imports.append(imported)
        return imported

    def _serve(self, imported: _Import, incoming: io.BufferedReader) -> None:
        told = _OPERATION.pack(_VERSION, _IMPORTED, 0) + _description(imported.device)
        imported.connection.sendall(told)
        while True:
            self._command(imported, incoming)

    def _forget(self, imported: _Import) -> None:
        with self._lock:
            self._imports.remove(imported)
            self.host.close(imported.handle)

    def _command(self, imported: _Import, incoming: io.BufferedReader) -> None:
        head = _exactly(incoming, _HEADER.size + _COMMAND.size)
        command, number, _, direction, endpoint = _HEADER.unpack_from(head)
        rest = head[_HEADER.size :]
        if command == _UNLINK:
            self._unlink(imported, number, struct.unpack_from(">I", rest)[0])
            return
        _, length, _, packets, _, setup = _COMMAND.unpack(rest)
        data = b"" if direction == _IN else _exactly(incoming, length)
        if packets <= 0:
            self._control(imported, number, setup, data)
            return
        _, size = struct.unpack_from(">2I", _exactly(incoming, 16 * packets))
        with self._lock:
            self._submit(imported, number, endpoint | 0x80, packets, size)

    def _submit(
        self, imported: _Import, number: int, endpoint: int, packets: int, size: int
    ) -> None:
        try:
            transfer = self.host.submit(imported.handle, endpoint, packets, size)
        except UsbError:
            _answer(imported, number, _ENODEV, b"")
            return
        imported.waiting[transfer.number] = (number, transfer)

    def _unlink(self, imported: _Import, number: int, which: int) -> None:
        with self._lock:
            found = [it for it in imported.waiting.values() if it[0] == which]
            for _, transfer in found:
                del imported.waiting[transfer.number]
                self.host.cancel(transfer)
            status = _ECONNRESET if found else 0
            head = _HEADER.pack(_UNLINKED, number, 0, 0, 0)
            imported.connection.sendall(head + struct.pack(">i24x", status))

    def _control(
        self, imported: _Import, number: int, setup: bytes, data: bytes
    ) -> None:
        kind, request, value, _, length = struct.unpack("<2B3H", setup)
        with self._lock:
            try:
                answer = self._asked(imported, kind, request, value, length, data)
            except UsbError as error:
                _answer(imported, number, _ERRORS.get(error.code, _EPROTO), b"")
                return
            _answer(imported, number, 0, answer, len(answer) or len(data))

    def _asked(
        self,
        imported: _Import,
        kind: int,
        request: int,
        value: int,
        length: int,
        data: bytes,
    ) -> bytes:
        """What the device answers; what every device has to know is answered here."""
        match kind, request:
            case (0x00, 0x09) | (0x02, 0x01):
                return b""
            case 0x01, 0x0B:
                self.host.set_alternate(imported.handle, value)
                return b""
            case (0x80, 0x00):
                return b"\1\0"[:length]
        if kind & 0x80:
            return self.host.read(imported.handle, kind, request, value, length)
        self.host.write(imported.handle, kind, request, value, data)
        return b""

    def _give_back(self, completion: Completion) -> None:
        for imported in self._imports:
            found = imported.waiting.pop(completion.transfer.number, None)
            if found is not None:
                _answer_packets(imported, found[0], completion)


def _answer(
    imported: _Import, number: int, status: int, data: bytes, actual: int = 0
) -> None:
    head = _HEADER.pack(_SUBMITTED, number, 0, 0, 0)
    result = _RESULT.pack(status, actual, 0, 0, 0)
    imported.connection.sendall(head + result + data)


def _answer_packets(imported: _Import, number: int, completion: Completion) -> None:
    """The packets end to end, then for each where its place was and what came."""
    lengths = completion.lengths
    described = _places(len(lengths), completion.transfer.size).copy()
    described["actual"] = lengths
    head = _HEADER.pack(_SUBMITTED, number, 0, 0, 0)
    result = _RESULT.pack(0, len(completion.data), 0, len(lengths), 0)
    imported.going += (head, result, completion.data, described.tobytes())


def _send_all(imported: _Import) -> None:
    """Send what has ended, in one go; a connection that is gone ends elsewhere."""
    going, imported.going = imported.going, []
    if not going:
        return
    with suppress(OSError):
        imported.connection.sendall(b"".join(going))


@lru_cache
def _places(packets: int, size: int) -> NDArray[np.void]:
    described = np.zeros(packets, _PACKET)
    described["offset"] = np.arange(packets) * size
    described["length"] = size
    return described


def _exactly(incoming: io.BufferedReader, size: int) -> bytes:
    came = incoming.read(size)
    if len(came) < size:
        raise ConnectionError("the kernel has let go")
    return came


def _place(device: Device) -> str:
    """The name of its place, as the kernel writes it: `1-1.3`."""
    return "1-" + ".".join(map(str, device.ports))


def _description(device: Device) -> bytes:
    place, part = _place(device), device.part
    path = f"/sys/devices/emulated/usb1/{place}"
    return struct.pack(
        ">256s32s3I3H6B",
        path.encode(),
        place.encode(),
        *(1, device.address, _HIGH_SPEED),
        *(part.vendor, part.product, part.release),
        *(0, 0, 0, 1, 1, 1),
    )


def main() -> None:
    """Export one Kinect."""
    parser = argparse.ArgumentParser(prog="python -m kinect_emulator.usbip")
    parser.add_argument("--port", type=int, default=PORT)
    parser.add_argument("--speed", type=float, default=1.0, help="of its clock")
    given = parser.parse_args()
    host = Host(Kinect(), patience=PATIENCE)
    with Exporter(host, given.port, given.speed).running():
        threading.Event().wait()


if __name__ == "__main__":
    main()
