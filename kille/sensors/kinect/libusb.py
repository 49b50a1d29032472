"""libusb by way of pyusb: all of pyusb's own names that this driver leans on.

pyusb reads isochronous endpoints one transfer at a time and without the packets'
lengths, so that a Kinect's stream has gaps. Its structures and prototypes are right,
though, and are used here to do better; `PINNED` names them for a test.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import importlib.util
import sys
from typing import Any

import usb.backend.libusb1 as pyusb

from kille.sensors.kinect.transport import (
    AccessDeniedError,
    DeviceBusyError,
    DeviceGoneError,
    NoLibraryError,
    StalledError,
    TransportError,
)

PINNED = (
    "_libusb_transfer",
    "_libusb_transfer_cb_fn_p",
    "_libusb_iso_packet_descriptor",
    "_LibUSB.ctx",
    "_LibUSB.lib",
    "_Device.devid",
    "_DeviceHandle.handle",
)
"""What is private to pyusb and used; `_LibUSB.lib` is libusb with its prototypes."""

COMPLETED, CANCELLED, NO_DEVICE = (
    pyusb.LIBUSB_TRANSFER_COMPLETED,
    pyusb.LIBUSB_TRANSFER_CANCELLED,
    pyusb.LIBUSB_TRANSFER_NO_DEVICE,
)
"""How a transfer ends."""

Transfer = Any
"""A pointer to libusb's structure of a transfer."""

completed_type = pyusb._libusb_transfer_cb_fn_p
"""Makes a function that libusb calls when a transfer has ended."""

_KINDS: dict[int, type[TransportError]] = {
    pyusb.LIBUSB_ERROR_NO_DEVICE: DeviceGoneError,
    pyusb.LIBUSB_ERROR_NOT_FOUND: DeviceGoneError,
    pyusb.LIBUSB_ERROR_ACCESS: AccessDeniedError,
    pyusb.LIBUSB_ERROR_BUSY: DeviceBusyError,
    pyusb.LIBUSB_ERROR_PIPE: StalledError,
    pyusb.LIBUSB_ERROR_TIMEOUT: StalledError,
}


class _Time(ctypes.Structure):
    """struct timeval."""

    _fields_ = (("seconds", ctypes.c_long), ("microseconds", ctypes.c_long))


def backend() -> Any:
    """pyusb's backend, with what it does not declare declared.

    It is the system's libusb, else that of the package libusb-package. Raises
    `NoLibraryError` if there is neither, another `TransportError` if it does not start.
    """
    found = _library()
    if found is None:
        raise NoLibraryError("no libusb found")
    loaded = pyusb.get_backend(find_library=lambda _: found)
    if loaded is None:
        raise TransportError(
            "libusb is there but does not start; if this is a container, give it "
            "the USB of the computer, by --privileged -v /dev/bus/usb:/dev/bus/usb"
        )
    lib = loaded.lib
    lib.libusb_cancel_transfer.argtypes = [ctypes.POINTER(pyusb._libusb_transfer)]
    lib.libusb_handle_events_timeout.argtypes = [
        ctypes.c_void_p,
        ctypes.POINTER(_Time),
    ]
    return loaded


def handle_events(loaded: Any, seconds: float) -> int:
    """Let libusb call what has ended, for so long at most; its error code or 0."""
    wait = _Time(int(seconds), int(seconds % 1 * 1e6))
    return int(loaded.lib.libusb_handle_events_timeout(loaded.ctx, ctypes.byref(wait)))


def allocate_transfer(
    loaded: Any,
    handle: Any,
    endpoint: int,
    buffer: Any,
    packets: int,
    completed: Any,
) -> Transfer:
    """A transfer of so many packets of equal size, which fill the buffer."""
    lib = loaded.lib
    transfer = lib.libusb_alloc_transfer(packets)
    if not transfer:
        raise TransportError("no memory for a USB transfer")
    size = ctypes.sizeof(buffer)
    lib.libusb_fill_iso_transfer(
        transfer, handle, endpoint, buffer, size, packets, completed, None, 0
    )
    lib.libusb_set_iso_packet_lengths(transfer, size // packets)
    return transfer


def outcomes(transfer: Transfer, packets: int) -> Any:
    """The packets' own records: of each its length, actual length and status."""
    first = ctypes.addressof(transfer.contents.iso_packet_desc)
    return (ctypes.c_int * 3 * packets).from_address(first)


def error_of(code: int) -> TransportError:
    """What a code of libusb means to the driver."""
    return _KINDS.get(code, TransportError)(pyusb._strerror(code))


def _library() -> str | None:
    """The name or path under which libusb loads."""
    names = {"linux": "libusb-1.0.so.0", "darwin": "libusb-1.0.dylib"}
    named = names.get(sys.platform)
    if named and _loads(named):
        return named
    return ctypes.util.find_library("usb-1.0") or _packaged_library()


def _loads(name: str) -> bool:
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True


def _packaged_library() -> str | None:
    if importlib.util.find_spec("libusb_package") is None:
        return None
    import libusb_package

    path = libusb_package.get_library_path()
    return None if path is None else str(path)
