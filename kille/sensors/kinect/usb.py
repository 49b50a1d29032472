"""The Kinect's devices over real USB: finding, claiming, asking, streaming."""

from __future__ import annotations

import ctypes
import time
from array import array
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import Any

from usb.core import USBError

from kille.sensors.kinect import isochronous_transfers, libusb
from kille.sensors.kinect.isochronous_transfers import IsoStream, UsbEventLoop
from kille.sensors.kinect.transport import (
    DeviceGoneError,
    KernelDriverError,
    PluggedDevice,
    Receiver,
    TransportError,
)

MICROSOFT = 0x045E
_TO_DEVICE, _FROM_DEVICE = 0x40, 0xC0
_INTERFACE = 0
_TIMEOUT = 1000
"""Milliseconds for a control transfer."""

_LONGEST_STRING = 256
_ATTEMPTS = 3
"""How often a serial number is asked for, as one reply may be lost."""


class UsbBus:
    """The computer's USB.

    NoLibraryError if there is no libusb, another TransportError if it does not start.
    """

    def __init__(self) -> None:
        self._backend = libusb.backend()
        self._events = UsbEventLoop(self._backend)

    def devices(self) -> tuple[PluggedDevice, ...]:
        """All of Microsoft's devices that are plugged in, by place."""
        with _translate_errors():
            found = [self._describe(it) for it in self._backend.enumerate_devices()]
        microsofts = (it for it in found if it.vendor == MICROSOFT)
        return tuple(sorted(microsofts, key=lambda it: it.place))

    def open(self, device: PluggedDevice, alternate: int) -> UsbConnection:
        """The device with its interface claimed, in that alternate setting."""
        with _translate_errors():
            handle = self._backend.open_device(device.key)
        connection = UsbConnection(self._backend, self._events, device.key, handle)
        try:
            connection.claim(alternate)
        except BaseException:
            connection.close()
            raise
        return connection

    def _describe(self, device: Any) -> PluggedDevice:
        told = self._backend.get_device_descriptor(device)
        microsofts = told.idVendor == MICROSOFT
        return PluggedDevice(
            told.idVendor,
            told.idProduct,
            told.bcdDevice,
            self._serial(device, told.iSerialNumber) if microsofts else "",
            (told.bus, *(told.port_numbers or ())),
            device,
        )

    def _serial(self, device: Any, index: int) -> str:
        """The serial number, or nothing if the device may not be opened for it."""
        if not index:
            return ""
        text = (ctypes.c_ubyte * _LONGEST_STRING)()
        try:
            handle = self._backend.open_device(device)
        except (USBError, NotImplementedError):
            return ""
        try:
            length = -1
            for _ in range(_ATTEMPTS):
                length = self._backend.lib.libusb_get_string_descriptor_ascii(
                    handle.handle, index, text, _LONGEST_STRING
                )
                if length >= 0:
                    break
        finally:
            self._backend.close_device(handle)
        return bytes(text[: max(length, 0)]).decode("ascii", "replace")


class UsbConnection:
    """One opened device."""

    def __init__(
        self, backend: Any, events: UsbEventLoop, device: Any, handle: Any
    ) -> None:
        self._backend = backend
        self._events = events
        self._device = device
        self._handle = handle
        self._driver_aside = False
        self._streams: list[IsoStream] = []
        self._closed = False

    def claim(self, alternate: int) -> None:
        """Have the interface for oneself, in that alternate setting."""
        self._move_driver_aside()
        with _translate_errors():
            self._backend.claim_interface(self._handle, _INTERFACE)
            if alternate:
                self._backend.set_interface_altsetting(
                    self._handle, _INTERFACE, alternate
                )

    def write(self, request: int, value: int, index: int, data: bytes) -> None:
        """A vendor control transfer to the device."""
        self._control(_TO_DEVICE, request, value, index, array("B", data))

    def read(self, request: int, value: int, index: int, length: int) -> bytes:
        """A vendor control transfer from the device."""
        room = array("B", bytes(length))
        came = self._control(_FROM_DEVICE, request, value, index, room)
        return room[:came].tobytes()

    def stream(self, endpoint: int, packet_size: int, receive: Receiver) -> IsoStream:
        """Start to read an endpoint."""
        lib = self._backend.lib
        told = lib.libusb_get_max_iso_packet_size(self._device.devid, endpoint)
        if told < packet_size:
            raise TransportError(
                f"endpoint {endpoint:#04x} has packets of {told} bytes, "
                f"not the {packet_size} of a Kinect"
            )
        stream = IsoStream(
            self._backend, self._events, self._handle.handle, endpoint, told, receive
        )
        self._streams.append(stream)
        return stream

    def close(self) -> None:
        """Stop every stream and let go; a moved kernel driver gets it back."""
        if self._closed:
            return
        self._closed = True
        streams, self._streams = self._streams, []
        # All are asked to end before any is waited for.
        for stream in streams:
            stream.cancel()
        until = time.monotonic() + isochronous_transfers.PATIENCE
        # Whatever interrupts a step, those behind it are taken: the last one first.
        with ExitStack() as stack:
            stack.callback(self._backend.close_device, self._handle)
            stack.callback(self._give_back)
            for stream in streams:
                stack.callback(stream.stop, until)

    def _move_driver_aside(self) -> None:
        try:
            if self._backend.is_kernel_driver_active(self._handle, _INTERFACE):
                self._backend.detach_kernel_driver(self._handle, _INTERFACE)
                self._driver_aside = True
        except NotImplementedError:
            return
        except USBError as error:
            problem = libusb.error_of(error.backend_error_code)
            if not isinstance(problem, DeviceGoneError):
                problem = KernelDriverError(f"a kernel driver has it: {error}")
            raise problem from error

    def _give_back(self) -> None:
        with suppress(USBError, NotImplementedError):
            self._backend.release_interface(self._handle, _INTERFACE)
        if self._driver_aside:
            with suppress(USBError, NotImplementedError):
                self._backend.attach_kernel_driver(self._handle, _INTERFACE)

    def _control(
        self, kind: int, request: int, value: int, index: int, data: Any
    ) -> int:
        if self._closed:
            raise DeviceGoneError("the device was closed")
        with _translate_errors():
            came: int = self._backend.ctrl_transfer(
                self._handle, kind, request, value, index, data, _TIMEOUT
            )
        return came


@contextmanager
def _translate_errors() -> Iterator[None]:
    """pyusb's failures in the words of the driver's transports."""
    try:
        yield
    except USBError as error:
        raise libusb.error_of(error.backend_error_code) from error
    except NotImplementedError as error:
        # So pyusb says what libusb cannot do on this system, or with its driver.
        raise TransportError(f"libusb says: {error}") from error
