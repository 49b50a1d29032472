"""What the driver asks of the wire: devices on a bus, control transfers, streams.

The USB implementation is in `kille.sensors.kinect.usb`; anything else that satisfies
these protocols, such as an emulated device, can stand in its place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray


class TransportError(Exception):
    """The wire failed; see the kinds below, or what it says."""


class DeviceGoneError(TransportError):
    """The device is no longer plugged in."""


class AccessDeniedError(TransportError):
    """The operating system does not let this user open the device."""


class DeviceBusyError(TransportError):
    """Something else has the device: another program, if no more is known."""


class KernelDriverError(DeviceBusyError):
    """A kernel driver has the device, and does not let go of it."""


class StalledError(TransportError):
    """The device refused a request, or did not answer in time."""


class InterruptedTransferError(TransportError):
    """Ctrl-C came while a stream was served, from where it cannot be passed on."""


class NoLibraryError(TransportError):
    """There is no libusb to talk to any device with."""


@dataclass(frozen=True)
class PluggedDevice:
    """One device on the bus, as its descriptors tell it.

    `release` is bcdDevice; `serial` is empty if it has none or may not be read; `place`
    is the bus and the ports on the way, such as (1, 2, 3); `key` is what the bus itself
    knows the device by.
    """

    vendor: int
    product: int
    release: int
    serial: str
    place: tuple[int, ...]
    key: object = None


class Batch(NamedTuple):
    """Some consecutive packets of a stream, in the order they came.

    `packets` (n, stride) uint8: what came, each packet in a row of its own;
    `lengths` (n,) int32: how many bytes of each row came, 0 for an empty microframe or
    a packet that failed; `time`: when, in seconds of `time.monotonic`. The arrays are
    only lent: they are overwritten as soon as the receiver returns.
    """

    packets: NDArray[np.uint8]
    lengths: NDArray[np.int32]
    time: float


Receiver = Callable[[Batch], None]
"""What takes the batches: called from another thread, never from two at once."""


class IsochronousStream(Protocol):
    """A running isochronous stream."""

    @property
    def ended(self) -> TransportError | None:
        """Why it ended by itself, or None while it runs."""
        ...

    def stop(self) -> None:
        """End it; after this returns the receiver is not called. Again: nothing."""
        ...


class Connection(Protocol):
    """One opened device. Each call may raise a `TransportError`."""

    def write(self, request: int, value: int, index: int, data: bytes) -> None:
        """A vendor control transfer to the device (bmRequestType 0x40)."""
        ...

    def read(self, request: int, value: int, index: int, length: int) -> bytes:
        """A vendor control transfer from the device (0xC0): `length` bytes or fewer."""
        ...

    def stream(
        self, endpoint: int, packet_size: int, receive: Receiver
    ) -> IsochronousStream:
        """Start to read an isochronous endpoint whose packets have at most that size.

        The rows of its batches are that wide, or wider.
        """
        ...

    def close(self) -> None:
        """Stop every stream and let go of the device; a second call does nothing."""
        ...


class TransportBus(Protocol):
    """Where devices are found."""

    def devices(self) -> tuple[PluggedDevice, ...]:
        """All of Microsoft's devices that are plugged in now, ordered by place."""
        ...

    def open(self, device: PluggedDevice, alternate: int) -> Connection:
        """The device with its interface 0 claimed and set to that alternate setting.

        Raises `DeviceGoneError`, `AccessDeniedError`, `DeviceBusyError` or another
        `TransportError` if it cannot be had.
        """
        ...
