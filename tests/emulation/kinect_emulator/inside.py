"""The emulated bus for a driver in the same process, as its transports are asked for.

No USB library is in between: a batch holds just what the emulated device sent.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from kille.sensors.kinect.transport import (
    AccessDeniedError,
    Batch,
    DeviceBusyError,
    DeviceGoneError,
    PluggedDevice,
    Receiver,
    StalledError,
    TransportError,
)
from kinect_emulator.descriptors import MICROSOFT, Role
from kinect_emulator.host import (
    Code,
    Completion,
    Device,
    Host,
    Status,
    Transfer,
    UsbError,
)
from kinect_emulator.kinect import Kinect
from kinect_emulator.modes import MICROFRAMES_PER_SECOND

_TRANSFERS, _PACKETS = 8, 64
_FAILURES = 64
_STEP = 0.002
_ERRORS: dict[Code, type[TransportError]] = {
    Code.ACCESS: AccessDeniedError,
    Code.BUSY: DeviceBusyError,
    Code.NO_DEVICE: DeviceGoneError,
    Code.PIPE: StalledError,
}


@contextmanager
def _translated() -> Iterator[None]:
    """The host's failures in the words of the driver's transports."""
    try:
        yield
    except UsbError as error:
        kind = _ERRORS.get(error.code, TransportError)
        raise kind(f"the emulated bus says {error.code.name}") from error


class InsideBus:
    """A bus on which time passes by `pass_time`, or by itself within `running`."""

    def __init__(self, host: Host) -> None:
        self.host = host
        self.lock = threading.RLock()
        self.awaited: dict[int, InsideStream] = {}

    def devices(self) -> tuple[PluggedDevice, ...]:
        """All of Microsoft's that is plugged in, by place."""
        with self.lock:
            present = list(self.host.devices.values())
        plugged = (_plugged(it) for it in present if it.part.vendor == MICROSOFT)
        return tuple(sorted(plugged, key=lambda it: it.place))

    def open(self, device: PluggedDevice, alternate: int) -> InsideConnection:
        """The device with its interface claimed, in that alternate setting."""
        assert isinstance(device.key, int)
        with self.lock, _translated():
            handle = self.host.open(device.key)
            try:
                self.host.claim(handle)
                self.host.set_alternate(handle, alternate)
            except UsbError:
                self.host.close(handle)
                raise
        return InsideConnection(self, handle)

    def plug(self, kinect: Kinect) -> None:
        """Plug it in while time passes."""
        with self.lock:
            self.host.plug(kinect)

    def unplug(self, kinect: Kinect) -> None:
        """Pull it out while time passes."""
        with self.lock:
            self.host.unplug(kinect)
        self.deliver()

    def drop(self, kinect: Kinect, role: Role) -> None:
        """One device inside it leaves the bus while time passes."""
        with self.lock:
            self.host.drop(kinect, role)
        self.deliver()

    def bring_back(self, kinect: Kinect, role: Role) -> None:
        """That device is on the bus again."""
        with self.lock:
            self.host.bring_back(kinect, role)

    def pass_time(self, microframes: int) -> None:
        """Let time pass, and hand every batch to its receiver."""
        for begun in range(0, microframes, _PACKETS):
            with self.lock:
                self.host.pass_time(min(_PACKETS, microframes - begun))
            self.deliver()

    def deliver(self) -> None:
        """Hand what has ended to its receivers."""
        with self.lock:
            ended = self.host.ended()
            takers = [self.awaited.pop(it.transfer.number, None) for it in ended]
        for taker, completion in zip(takers, ended, strict=True):
            if taker is not None:
                taker.take(completion)

    @contextmanager
    def running(self, speed: float = 1.0) -> Iterator[InsideBus]:
        """Time passes by itself, `speed` times as fast as on the wall."""
        over = threading.Event()
        thread = threading.Thread(target=self._run, args=(over, speed))
        thread.start()
        try:
            yield self
        finally:
            over.set()
            thread.join()

    def _run(self, over: threading.Event, speed: float) -> None:
        begun, passed = time.monotonic(), 0
        while not over.wait(_STEP):
            elapsed = (time.monotonic() - begun) * speed
            due = int(elapsed * MICROFRAMES_PER_SECOND) - passed
            self.pass_time(due)
            passed += due


class InsideConnection:
    """One opened device."""

    def __init__(self, bus: InsideBus, handle: int) -> None:
        self._bus = bus
        self._handle = handle
        self._streams: list[InsideStream] = []
        self._closed = False

    def write(self, request: int, value: int, index: int, data: bytes) -> None:
        """A vendor control transfer to the device."""
        with self._bus.lock, _translated():
            self._bus.host.write(self._handle, 0x40, request, value, data)

    def read(self, request: int, value: int, index: int, length: int) -> bytes:
        """A vendor control transfer from the device."""
        with self._bus.lock, _translated():
            return self._bus.host.read(self._handle, 0xC0, request, value, length)

    def stream(
        self, endpoint: int, packet_size: int, receive: Receiver
    ) -> InsideStream:
        """Start to read an endpoint."""
        stream = InsideStream(self._bus, self._handle, endpoint, packet_size, receive)
        self._streams.append(stream)
        return stream

    def close(self) -> None:
        """Stop every stream and let go."""
        if self._closed:
            return
        self._closed = True
        for stream in self._streams:
            stream.stop()
        with self._bus.lock:
            self._bus.host.close(self._handle)


class InsideStream:
    """A running stream: transfers that are submitted again as they end."""

    def __init__(
        self,
        bus: InsideBus,
        handle: int,
        endpoint: int,
        packet_size: int,
        receive: Receiver,
    ) -> None:
        self.ended: TransportError | None = None
        self._bus = bus
        self._where = (handle, endpoint, _PACKETS, packet_size)
        self._receive = receive
        self._taking = threading.RLock()
        self._stopped = False
        self._failures = 0
        self._waiting: list[Transfer] = []
        for _ in range(_TRANSFERS):
            self._submit()

    def take(self, completion: Completion) -> None:
        """Hand a batch on and submit its transfer again; not after `stop`."""
        with self._taking:
            if self._stopped:
                return
            self._waiting.remove(completion.transfer)
            if completion.status is Status.NO_DEVICE:
                self.ended = DeviceGoneError("the emulated device was unplugged")
                return
            failed = completion.status is Status.ERROR
            self._failures = self._failures + 1 if failed else 0
            if self._failures > _FAILURES:
                self.ended = TransportError("emulated transfers end in errors")
                return
            self._receive(_batch(completion))
            self._submit_again()

    def stop(self) -> None:
        """End it; the receiver is not called any more when this returns."""
        with self._taking:
            self._stopped = True
            waiting, self._waiting = self._waiting, []
        with self._bus.lock:
            for transfer in waiting:
                self._cancel(transfer)

    def _submit_again(self) -> None:
        try:
            self._submit()
        except TransportError as error:
            self.ended = error

    def _submit(self) -> None:
        with self._bus.lock, _translated():
            transfer = self._bus.host.submit(*self._where)
            self._bus.awaited[transfer.number] = self
            self._waiting.append(transfer)

    def _cancel(self, transfer: Transfer) -> None:
        self._bus.awaited.pop(transfer.number, None)
        try:
            self._bus.host.cancel(transfer)
        except UsbError:
            return


def _plugged(device: Device) -> PluggedDevice:
    part = device.part
    return PluggedDevice(
        part.vendor,
        part.product,
        part.release,
        device.kinect.serial_of(part) if part.tells_serial else "",
        (1, *device.ports),
        device.address,
    )


def _batch(completion: Completion) -> Batch:
    """The packets in rows; what does not fit into a row is cut off."""
    size = completion.transfer.size
    lengths = completion.lengths.astype(np.int32)
    packets = np.zeros((len(lengths), size), np.uint8)
    ends = np.cumsum(lengths)
    data = np.frombuffer(completion.data, np.uint8)
    for row, (end, length) in enumerate(zip(ends, lengths, strict=True)):
        packets[row, : min(length, size)] = data[end - length : end][:size]
    if completion.packet_status:
        lengths[:] = 0
    return Batch(packets, np.minimum(lengths, size), time.monotonic())
