"""The host's side of the bus: what is plugged in, who has opened it, and its transfers.

Time is counted in microframes of an eighth of a millisecond and passes only when told
to (`pass_time`), so that everything is repeatable.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import IntEnum
from itertools import count
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kinect_emulator.descriptors import Part, Role
from kinect_emulator.kinect import Kinect, StalledError


class Code(IntEnum):
    """What libusb calls the ways in which a request fails."""

    IO = -1
    INVALID = -2
    ACCESS = -3
    NO_DEVICE = -4
    NOT_FOUND = -5
    BUSY = -6
    PIPE = -9


class Status(IntEnum):
    """How a transfer ended."""

    COMPLETED = 0
    ERROR = 1
    CANCELLED = 3
    NO_DEVICE = 5


class UsbError(Exception):
    """A request that fails with one of libusb's codes."""

    def __init__(self, code: Code) -> None:
        super().__init__(code.name)
        self.code = code


@dataclass(eq=False)
class Device:
    """One device on the bus; its address is its own until it is unplugged.

    `ports` lead to it from the root; it hangs on the hub at the address `parent`, or on
    the root if that is 0. `driven` says that a kernel driver has it.
    """

    address: int
    ports: tuple[int, ...]
    parent: int
    kinect: Kinect
    part: Part
    alternate: int = 0
    driven: bool = False
    claimed_by: int | None = None


@dataclass(frozen=True)
class Transfer:
    """An isochronous transfer: `packets` microframes of at most `size` bytes each."""

    number: int
    handle: int
    endpoint: int
    packets: int
    size: int


class Completion(NamedTuple):
    """A transfer that ended: the lengths of its packets, and their bytes end to end."""

    transfer: Transfer
    status: Status
    packet_status: int
    lengths: NDArray[np.uint32]
    data: bytes


@dataclass
class _Pipe:
    """The transfers that wait at one endpoint; the first begins at `begins`."""

    begins: int = 0
    waiting: deque[Transfer] = field(default_factory=deque)
    given_up: bool = False

    @property
    def ends(self) -> int:
        """The microframe behind the last of what waits."""
        return self.begins + sum(it.packets for it in self.waiting)


class Host:
    """A computer's USB: Kinects are plugged in, clients open, claim and submit.

    A client that is slow to submit new transfers loses packets, as with a real host.
    So that a busy machine does not look like a lossy cable, the clock waits for it for
    `patience` microframes at most; with 0 it never waits.
    """

    def __init__(self, *kinects: Kinect, patience: int = 0) -> None:
        self.now = 0
        self.devices: dict[int, Device] = {}
        self.waited = 0
        self._patience = patience
        self._owed = 0
        self._addresses = count(2)
        self._numbers = count(1)
        self._handles: dict[int, Device] = {}
        self._pipes: dict[tuple[int, int], _Pipe] = {}
        self._ended: list[Completion] = []
        for kinect in kinects:
            self.plug(kinect)

    def plug(self, kinect: Kinect) -> None:
        """Plug it in: its devices get new addresses, and its settings are forgotten."""
        kinect.power_cycle()
        taken = {it.ports[0] for it in self.devices.values()}
        hub = next(it for it in count(1) if it not in taken)
        parent = 0
        for port, part in enumerate(kinect.model.parts):
            ports = (hub, port) if port else (hub,)
            device = Device(next(self._addresses), ports, parent, kinect, part)
            device.driven = kinect.faults.driven and part.role is Role.CAMERA
            self.devices[device.address] = device
            parent = parent or device.address

    def unplug(self, kinect: Kinect) -> None:
        """Pull it out: all that waits for it ends, whatever is asked of it fails."""
        self._remove([it for it in self.devices.values() if it.kinect is kinect])

    def drop(self, kinect: Kinect, role: Role) -> None:
        """One device inside it leaves the bus, while the others stay."""
        self._remove([self._device_of(kinect, role)])

    def bring_back(self, kinect: Kinect, role: Role) -> None:
        """That device is on the bus again, at its place but with a new address."""
        hub = self._device_of(kinect, Role.HUB)
        port = next(
            port for port, it in enumerate(kinect.model.parts) if it.role is role
        )
        part, ports = kinect.model.parts[port], (*hub.ports, port)
        device = Device(next(self._addresses), ports, hub.address, kinect, part)
        self.devices[device.address] = device

    def _device_of(self, kinect: Kinect, role: Role) -> Device:
        devices = self.devices.values()
        return next(
            it for it in devices if it.kinect is kinect and it.part.role is role
        )

    def _remove(self, gone: list[Device]) -> None:
        for device in gone:
            del self.devices[device.address]
        for (handle, endpoint), pipe in list(self._pipes.items()):
            if self._handles.get(handle) in gone:
                self._end_all(pipe, Status.NO_DEVICE)
                del self._pipes[handle, endpoint]

    def open(self, address: int) -> int:
        """A handle to the device at that address."""
        device = self.devices.get(address)
        if device is None:
            raise UsbError(Code.NO_DEVICE)
        if device.kinect.faults.forbidden:
            raise UsbError(Code.ACCESS)
        handle = next(self._numbers)
        self._handles[handle] = device
        return handle

    def close(self, handle: int) -> None:
        """Let go of the device: claims and transfers end with the handle."""
        device = self._handles.pop(handle, None)
        if device is None:
            return
        if device.claimed_by == handle:
            device.claimed_by = None
        for key in [key for key in self._pipes if key[0] == handle]:
            self._end_all(self._pipes.pop(key), Status.CANCELLED)

    def device(self, handle: int) -> Device:
        """The device behind the handle; UsbError if it is gone."""
        device = self._handles.get(handle)
        if device is None:
            raise UsbError(Code.NOT_FOUND)
        if device.address not in self.devices:
            raise UsbError(Code.NO_DEVICE)
        return device

    def claim(self, handle: int) -> None:
        """Have interface 0 for oneself."""
        device = self.device(handle)
        if device.kinect.faults.busy or device.driven:
            raise UsbError(Code.BUSY)
        if device.claimed_by not in (None, handle):
            raise UsbError(Code.BUSY)
        device.claimed_by = handle

    def release(self, handle: int) -> None:
        """Give interface 0 back."""
        device = self.device(handle)
        if device.claimed_by != handle:
            raise UsbError(Code.NOT_FOUND)
        device.claimed_by = None

    def detach_driver(self, handle: int) -> None:
        """Take the interface from a kernel driver."""
        device = self.device(handle)
        if not device.driven:
            raise UsbError(Code.NOT_FOUND)
        device.driven = False

    def attach_driver(self, handle: int) -> None:
        """Give the interface back to the kernel driver, where there is one."""
        device = self.device(handle)
        if not device.kinect.faults.driven:
            raise UsbError(Code.NOT_FOUND)
        device.driven = True

    def set_alternate(self, handle: int, alternate: int) -> None:
        """Choose a setting of interface 0, which must be claimed."""
        device = self.device(handle)
        if device.claimed_by != handle or alternate >= len(device.part.alternates):
            raise UsbError(Code.NOT_FOUND)
        device.alternate = alternate

    def write(
        self, handle: int, kind: int, request: int, value: int, data: bytes
    ) -> int:
        """A control transfer outwards: how many bytes were taken."""
        device = self.device(handle)
        if kind != 0x40:
            raise UsbError(Code.PIPE)
        try:
            device.kinect.write(device.part, request, value, data, self.now)
        except StalledError as stalled:
            raise UsbError(Code.PIPE) from stalled
        return len(data)

    def read(
        self, handle: int, kind: int, request: int, value: int, length: int
    ) -> bytes:
        """A control transfer inwards: at most `length` bytes."""
        device = self.device(handle)
        if (kind, request) == (0x80, 0x06):
            return _descriptor(device, value)[:length]
        if kind != 0xC0:
            raise UsbError(Code.PIPE)
        try:
            return device.kinect.read(device.part, request, self.now)[:length]
        except StalledError as stalled:
            raise UsbError(Code.PIPE) from stalled

    def submit(self, handle: int, endpoint: int, packets: int, size: int) -> Transfer:
        """Let an isochronous transfer wait for its microframes."""
        device = self.device(handle)
        largest = device.part.packet_size(endpoint, device.alternate)
        if largest is None or device.claimed_by != handle:
            raise UsbError(Code.NOT_FOUND)
        if packets <= 0 or size <= 0:
            raise UsbError(Code.INVALID)
        transfer = Transfer(next(self._numbers), handle, endpoint, packets, size)
        pipe = self._pipes.setdefault((handle, endpoint), _Pipe())
        if not pipe.waiting:
            pipe.begins = max(pipe.begins, self.now)
        pipe.waiting.append(transfer)
        pipe.given_up = False
        return transfer

    def cancel(self, transfer: Transfer) -> None:
        """End a transfer before its time; UsbError if it has ended already."""
        pipe = self._pipes.get((transfer.handle, transfer.endpoint))
        if pipe is None or transfer not in pipe.waiting:
            raise UsbError(Code.NOT_FOUND)
        if self._handles[transfer.handle].kinect.faults.endless:
            return
        if transfer is pipe.waiting[0]:
            pipe.begins += transfer.packets
        pipe.waiting.remove(transfer)
        if not pipe.waiting:
            del self._pipes[transfer.handle, transfer.endpoint]
        self._ended.append(_empty(transfer, Status.CANCELLED))

    def waiting(self) -> list[int]:
        """How many transfers wait at each endpoint that has any."""
        return [len(pipe.waiting) for pipe in list(self._pipes.values())]

    def pass_time(self, microframes: int) -> None:
        """Let so many microframes pass, fewer while the clock waits for a client."""
        wanted = self.now + microframes
        reached = min(wanted, self._horizon(wanted))
        self._owed = self._owed + wanted - reached if reached == self.now else 0
        if self._owed >= self._patience:
            self._give_up()
        self.waited += wanted - reached
        self.now = reached
        for pipe in self._pipes.values():
            self._run(pipe)

    def ended(self) -> list[Completion]:
        """The transfers that ended since this was last asked, in order."""
        ended, self._ended = self._ended, []
        return ended

    def _horizon(self, wanted: int) -> int:
        """How far the clock may go while it waits for clients to submit more."""
        if self._patience == 0:
            return wanted
        return max(self.now, min(self._ends_of_running(), default=wanted))

    def _ends_of_running(self) -> Iterator[int]:
        for (handle, endpoint), pipe in self._pipes.items():
            running = self._handles[handle].kinect.streams
            if endpoint in running and not pipe.given_up:
                yield pipe.ends

    def _give_up(self) -> None:
        """Wait no longer for those who have nothing left that waits."""
        self._owed = 0
        for pipe in self._pipes.values():
            pipe.given_up = pipe.given_up or not pipe.waiting

    def _run(self, pipe: _Pipe) -> None:
        """End the transfers whose microframes have passed."""
        while pipe.waiting and pipe.begins + pipe.waiting[0].packets <= self.now:
            if self._handles[pipe.waiting[0].handle].kinect.faults.endless:
                return
            transfer = pipe.waiting.popleft()
            self._ended.append(self._filled(transfer, pipe.begins))
            pipe.begins += transfer.packets

    def _filled(self, transfer: Transfer, begins: int) -> Completion:
        device = self._handles[transfer.handle]
        window = device.kinect.window(transfer.endpoint, begins, transfer.packets)
        if device.kinect.faults.failing:
            return _empty(transfer, Status.ERROR)
        if window is None:
            return _empty(transfer, Status.COMPLETED)
        if device.kinect.faults.broken:
            broken = _empty(transfer, Status.COMPLETED)
            return broken._replace(packet_status=Status.ERROR)
        return Completion(transfer, Status.COMPLETED, 0, *window)

    def _end_all(self, pipe: _Pipe, status: Status) -> None:
        self._ended += [_empty(transfer, status) for transfer in pipe.waiting]


def _empty(transfer: Transfer, status: Status) -> Completion:
    return Completion(transfer, status, 0, np.zeros(transfer.packets, np.uint32), b"")


def _descriptor(device: Device, value: int) -> bytes:
    kind, index = divmod(value, 256)
    match kind:
        case 1:
            return device.part.device()
        case 2:
            return device.part.configuration()
        case 3:
            text = device.part.string(index, device.kinect.serial_of(device.part))
            if text is not None:
                return text
    raise UsbError(Code.PIPE)
