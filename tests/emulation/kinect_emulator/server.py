"""The emulated bus for other programs: a unix socket behind the fake libusb.

Each client has two connections. Over the first it asks and waits for the answer; over
the second come the transfers that ended. One thread serves all and lets time pass.
"""

from __future__ import annotations

import os
import selectors
import socket
import struct
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import IntEnum
from pathlib import Path

from kinect_emulator.descriptors import Role
from kinect_emulator.host import Code, Completion, Device, Host, Transfer, UsbError
from kinect_emulator.kinect import Kinect
from kinect_emulator.modes import MICROFRAMES_PER_SECOND

_STEP = 0.002
_HELLO = struct.Struct("<2Q")
_REQUEST = struct.Struct("<Ii4II")
_RESPONSE = struct.Struct("<iI")
_EVENT = struct.Struct("<Q2i2I")
_TOLD = struct.Struct("<2HB7s18sH256s")
_EVENTS = 1

Answer = tuple[int, bytes]


class Ask(IntEnum):
    """What a client may ask, as the fake libusb numbers it."""

    LIST = 1
    OPEN = 2
    CLOSE = 3
    CLAIM = 4
    RELEASE = 5
    ALTERNATE = 6
    DRIVEN = 7
    DETACH = 8
    CONTROL = 9
    SUBMIT = 10
    CANCEL = 11
    ATTACH = 12


@dataclass(eq=False)
class _Connection:
    """One socket with what has come and what is still to go."""

    socket: socket.socket
    client: _Client | None = None
    came: bytearray = field(default_factory=bytearray)
    going: bytearray = field(default_factory=bytearray)


@dataclass(eq=False)
class _Client:
    """One program that has opened the library."""

    events: _Connection | None = None
    handles: set[int] = field(default_factory=set)
    transfers: dict[int, tuple[Transfer, int]] = field(default_factory=dict)


class Server:
    """Serves a host on a socket. Whoever touches the host from outside takes `lock`."""

    def __init__(self, host: Host, path: Path, speed: float = 1.0) -> None:
        self.host = host
        self.path = path
        self.lock = threading.RLock()
        self._speed = speed
        self._over = threading.Event()
        self._selector = selectors.DefaultSelector()
        self._clients: dict[int, _Client] = {}
        self._listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        os.fchmod(self._listener.fileno(), 0o600)  # nobody else is to turn the Kinect
        self._listener.bind(str(path))
        self._listener.listen()
        self._listener.setblocking(False)
        self._selector.register(self._listener, selectors.EVENT_READ)

    def plug(self, kinect: Kinect) -> None:
        """Plug it in while clients run."""
        with self.lock:
            self.host.plug(kinect)

    def unplug(self, kinect: Kinect) -> None:
        """Pull it out while clients run."""
        with self.lock:
            self.host.unplug(kinect)

    def drop(self, kinect: Kinect, role: Role) -> None:
        """One device inside it leaves the bus while clients run."""
        with self.lock:
            self.host.drop(kinect, role)

    def bring_back(self, kinect: Kinect, role: Role) -> None:
        """That device is on the bus again."""
        with self.lock:
            self.host.bring_back(kinect, role)

    @contextmanager
    def running(self) -> Iterator[Server]:
        """Serve from a thread of its own."""
        thread = threading.Thread(target=self.serve)
        thread.start()
        try:
            yield self
        finally:
            self.stop()
            thread.join()

    def stop(self) -> None:
        """Let `serve` return."""
        self._over.set()

    def serve(self) -> None:
        """Answer and let time pass until stopped; whatever happens, let clients go."""
        try:
            self._serve()
        finally:
            self._close()

    def _serve(self) -> None:
        begun, passed = time.monotonic(), 0
        while not self._over.is_set():
            ready = self._selector.select(_STEP)
            with self.lock:
                for key, events in ready:
                    self._attend(key, events)
                elapsed = (time.monotonic() - begun) * self._speed
                due = int(elapsed * MICROFRAMES_PER_SECOND) - passed
                self.host.pass_time(due)
                passed += due
                self._send_ended()

    def _attend(self, key: selectors.SelectorKey, events: int) -> None:
        if key.fileobj is self._listener:
            self._accept()
            return
        connection = key.data
        if events & selectors.EVENT_WRITE:
            self._flush(connection)
        if events & selectors.EVENT_READ:
            self._receive(connection)

    def _accept(self) -> None:
        accepted, _ = self._listener.accept()
        accepted.setblocking(False)
        connection = _Connection(accepted)
        self._selector.register(accepted, selectors.EVENT_READ, connection)

    def _receive(self, connection: _Connection) -> None:
        try:
            came = connection.socket.recv(1 << 16)
        except OSError:
            came = b""
        if not came:
            self._forget(connection)
            return
        connection.came += came
        if connection.client is None and len(connection.came) >= _HELLO.size:
            self._greet(connection)
        if connection.client is not None:
            self._answer_all(connection, connection.client)

    def _greet(self, connection: _Connection) -> None:
        kind, token = _HELLO.unpack_from(connection.came)
        del connection.came[: _HELLO.size]
        connection.client = self._clients.setdefault(token, _Client())
        if kind == _EVENTS:
            connection.client.events = connection

    def _answer_all(self, connection: _Connection, client: _Client) -> None:
        while len(connection.came) >= _REQUEST.size:
            head = _REQUEST.unpack_from(connection.came)
            end = _REQUEST.size + head[-1]
            if len(connection.came) < end:
                return
            data = bytes(connection.came[_REQUEST.size : end])
            del connection.came[:end]
            try:
                result, answer = self._answer(client, head, data)
            except UsbError as error:
                result, answer = error.code, b""
            self._send(connection, _RESPONSE.pack(result, len(answer)) + answer)

    def _answer(self, client: _Client, head: tuple[int, ...], data: bytes) -> Answer:
        operation, number, *arguments, _ = head
        match Ask(operation):
            case Ask.LIST:
                devices = list(self.host.devices.values())
                return len(devices), b"".join(_told(it) for it in devices)
            case Ask.OPEN:
                handle = self.host.open(number)
                client.handles.add(handle)
                return handle, b""
            case Ask.CONTROL:
                return self._control(number, arguments, data)
            case Ask.SUBMIT:
                transfer = self.host.submit(number, *arguments[:3])
                cookie = int.from_bytes(data, "little")
                client.transfers[transfer.number] = (transfer, cookie)
                return transfer.number, b""
            case Ask.CANCEL:
                self.host.cancel(_submitted(client, int.from_bytes(data, "little")))
                return 0, b""
            case Ask.DRIVEN:
                return int(self.host.device(number).driven), b""
            case other:
                self._do(client, other, number, arguments[0])
                return 0, b""

    def _do(self, client: _Client, ask: Ask, number: int, argument: int) -> None:
        """What needs no answer but that it was done."""
        match ask:
            case Ask.CLOSE:
                self._close_handle(client, number)
            case Ask.CLAIM:
                self.host.claim(number)
            case Ask.RELEASE:
                self.host.release(number)
            case Ask.ALTERNATE:
                self.host.set_alternate(number, argument)
            case Ask.DETACH:
                self.host.detach_driver(number)
            case Ask.ATTACH:
                self.host.attach_driver(number)

    def _control(self, handle: int, arguments: list[int], data: bytes) -> Answer:
        request, kind = divmod(arguments[0], 256)
        value, _, length = arguments[1:4]
        if not kind & 0x80:
            return self.host.write(handle, kind, request, value, data), b""
        answer = self.host.read(handle, kind, request, value, length)
        return len(answer), answer

    def _close_handle(self, client: _Client, handle: int) -> None:
        """Close it; of its transfers nothing more is told."""
        client.handles.discard(handle)
        gone = [
            number
            for number, (transfer, _) in client.transfers.items()
            if transfer.handle == handle
        ]
        for number in gone:
            del client.transfers[number]
        self.host.close(handle)

    def _send_ended(self) -> None:
        for completion in self.host.ended():
            for client in self._clients.values():
                found = client.transfers.pop(completion.transfer.number, None)
                if found and client.events:
                    self._send(client.events, _event(completion, found[1]))

    def _send(self, connection: _Connection, message: bytes) -> None:
        connection.going += message
        self._flush(connection)

    def _flush(self, connection: _Connection) -> None:
        """Send what can be sent now; the rest when the client has read."""
        try:
            sent = connection.socket.send(connection.going)
        except BlockingIOError:
            sent = 0
        except OSError:
            connection.going.clear()
            return
        del connection.going[:sent]
        writing = selectors.EVENT_WRITE if connection.going else 0
        self._selector.modify(
            connection.socket, selectors.EVENT_READ | writing, connection
        )

    def _forget(self, connection: _Connection) -> None:
        """A program has ended, or closed the library: let go of all it had."""
        self._selector.unregister(connection.socket)
        connection.socket.close()
        client = connection.client
        if client is None:
            return
        for handle in list(client.handles):
            self._close_handle(client, handle)
        self._clients = {
            token: it for token, it in self._clients.items() if it is not client
        }

    def _close(self) -> None:
        for key in list(self._selector.get_map().values()):
            key.fileobj.close()  # type: ignore[union-attr]
        self._selector.close()
        self.path.unlink(missing_ok=True)


def _submitted(client: _Client, wanted: int) -> Transfer:
    """The client's transfer of that cookie, which it is still waiting for."""
    for transfer, cookie in client.transfers.values():
        if cookie == wanted:
            return transfer
    raise UsbError(Code.NOT_FOUND)


def _event(completion: Completion, cookie: int) -> bytes:
    lengths = completion.lengths.astype("<u4").tobytes()
    head = _EVENT.pack(
        cookie,
        completion.status,
        completion.packet_status,
        len(completion.lengths),
        len(completion.data),
    )
    return head + lengths + completion.data


def _told(device: Device) -> bytes:
    configuration = device.part.configuration()
    return _TOLD.pack(
        device.address,
        device.parent,
        len(device.ports),
        bytes(device.ports),
        device.part.device(),
        len(configuration),
        configuration,
    )
