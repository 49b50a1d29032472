"""Isochronous streams over libusb: many transfers under way, each used again and again.

While one transfer is read the others wait in the kernel, so that nothing is missed even
if Python is slow for some milliseconds.
"""

from __future__ import annotations

import ctypes
import logging
import threading
import time
from contextlib import ExitStack
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.sensors.kinect import libusb
from kille.sensors.kinect.transport import (
    Batch,
    DeviceGoneError,
    InterruptedTransferError,
    Receiver,
    TransportError,
)

_log = logging.getLogger(__name__)

TRANSFERS, PACKETS = 6, 256
"""How many are under way, and the microframes of each: together 192 ms.

Most of what a transfer costs does not depend on its size.
"""

_TICK = 0.1
PATIENCE = 1.0
"""Seconds in which libusb has to give back all transfers that are stopped together."""

_FAILURES = 64
"""Transfers that fail one after another before the stream is given up."""


class UsbEventLoop:
    """Lets libusb call back, in a thread of its own, while there are streams."""

    def __init__(self, backend: Any) -> None:
        self._backend = backend
        self._lock = threading.Lock()
        self._users = 0
        self._thread: _EventThread | None = None

    def enter(self) -> None:
        """Count one stream more."""
        with self._lock:
            self._users += 1
            if self._thread is None:
                self._thread = _EventThread(self._backend)
                self._thread.start()

    def leave(self) -> None:
        """Count one stream less; after the last, end the thread before this returns."""
        with self._lock:
            self._users -= 1
            if self._users:
                return
            thread, self._thread = self._thread, None
        if thread is not None:
            thread.end()


class _EventThread(threading.Thread):
    """The thread in which libusb calls back, until it is told to end."""

    def __init__(self, backend: Any) -> None:
        super().__init__(name="kinect events", daemon=True)
        self._backend = backend
        self._over = threading.Event()

    def run(self) -> None:
        """Serve libusb."""
        while not self._over.is_set():
            if libusb.handle_events(self._backend, _TICK) < 0:
                time.sleep(_TICK)

    def end(self) -> None:
        """End the thread, and wait for that, but not for ever."""
        self._over.set()
        self.join(PATIENCE)


class Slot:
    """One transfer, its buffer and NumPy's views of both."""

    def __init__(
        self, backend: Any, handle: Any, endpoint: int, size: int, completed: Any
    ) -> None:
        self.buffer = (ctypes.c_ubyte * (PACKETS * size))()
        self.transfer = libusb.allocate_transfer(
            backend, handle, endpoint, self.buffer, PACKETS, completed
        )
        self.address = ctypes.addressof(self.transfer.contents)
        records = libusb.outcomes(self.transfer, PACKETS)
        self.packets: NDArray[np.uint8] = np.ctypeslib.as_array(self.buffer).reshape(
            PACKETS, size
        )
        self._records: NDArray[np.int32] = np.ctypeslib.as_array(records)
        self.under_way = False

    def batch(self) -> Batch:
        """What came, as it lies in the buffer; failed packets have no length."""
        lengths, statuses = self._records[:, 1], self._records[:, 2]
        if statuses.any():
            lengths = lengths * (statuses == libusb.COMPLETED)
        return Batch(self.packets, lengths, time.monotonic())

    def empty_batch(self) -> Batch:
        """What came with a transfer that failed: as many packets without any length."""
        return Batch(self.packets, np.zeros(PACKETS, np.int32), time.monotonic())


class IsoStream:
    """A running stream of one endpoint. If the receiver raises, it ends."""

    def __init__(
        self,
        backend: Any,
        events: UsbEventLoop,
        handle: Any,
        endpoint: int,
        packet_size: int,
        receive: Receiver,
    ) -> None:
        self.ended: TransportError | None = None
        self._backend = backend
        self._events = events
        self._endpoint = endpoint
        self._receive = receive
        self._stopping = False
        self._stopped = False
        self._failures = 0
        self._idle = threading.Condition()
        self._slots = [
            Slot(backend, handle, endpoint, packet_size, _completed)
            for _ in range(TRANSFERS)
        ]
        self._events.enter()
        try:
            self._begin()
        except BaseException:
            self.stop()
            raise

    def cancel(self) -> None:
        """Ask libusb to give all transfers back, without waiting for it."""
        self._stopping = True
        for slot in self._slots:
            if slot.under_way:
                self._backend.lib.libusb_cancel_transfer(slot.transfer)

    def stop(self, until: float | None = None) -> None:
        """Cancel all transfers and wait for them, until that time of `time.monotonic`.

        Those that libusb does not give back are left to it: a line in the log says so.
        """
        if self._stopped:
            return
        self._stopped = True
        deadline = time.monotonic() + PATIENCE if until is None else until
        # Also a Ctrl-C that comes while it waits leaves all in order.
        with ExitStack() as stack:
            stack.callback(self._let_go)
            stack.callback(self._events.leave)
            self.cancel()
            with self._idle:
                left = max(0.0, deadline - time.monotonic())
                self._idle.wait_for(self._all_back, left)

    def _let_go(self) -> None:
        kept = [slot for slot in self._slots if slot.under_way]
        for slot in self._slots:
            if not slot.under_way:
                self._backend.lib.libusb_free_transfer(slot.transfer)
        # libusb may still write to the others: they stay in `_UNDER_WAY` for ever.
        self._slots = []
        if kept:
            _log.warning(
                "kinect: %d of %d USB transfers of endpoint %#04x never ended; the "
                "Kinect was closed without them: unplug it if it does not start again",
                len(kept),
                TRANSFERS,
                self._endpoint,
            )

    def _begin(self) -> None:
        for slot in self._slots:
            # Said before it is so: libusb may call back at once.
            slot.under_way = True
            _UNDER_WAY[slot.address] = (self, slot)
            if not self._submit(slot):
                self._give_back(slot)
        if self.ended is not None:
            raise self.ended

    def _all_back(self) -> bool:
        return not any(slot.under_way for slot in self._slots)

    def _give_back(self, slot: Slot) -> None:
        """Mark the slot as idle, and wake whoever waits for that."""
        _UNDER_WAY.pop(slot.address, None)
        slot.under_way = False
        with self._idle:
            self._idle.notify_all()

    def _submit(self, slot: Slot) -> bool:
        """Let libusb fill the slot; if it does not want to, the stream has ended."""
        code = self._backend.lib.libusb_submit_transfer(slot.transfer)
        if code < 0:
            self.ended = self.ended or libusb.error_of(code)
        return bool(code >= 0)

    def complete(self, slot: Slot, status: int) -> None:
        """A transfer has ended: called by libusb, where an exception would be lost.

        libusb calls from any thread that waits for it: also from the main one, to
        which Ctrl-C goes. An exception ends the stream.
        """
        again = False
        try:
            again = self._take(slot, status)
        except BaseException as error:
            kind = (
                TransportError
                if isinstance(error, Exception)
                else InterruptedTransferError
            )
            self.ended = kind(f"the stream's receiver failed: {error!r}")
        # Until here it counts as under way, so that nobody frees it.
        if not (again and self._submit(slot)):
            self._give_back(slot)

    def _take(self, slot: Slot, status: int) -> bool:
        """Hand on what came; whether there is more to come."""
        over = self._stopping or self.ended is not None
        if over or status == libusb.CANCELLED:
            return False
        if status == libusb.NO_DEVICE:
            self.ended = DeviceGoneError("the device was unplugged")
            return False
        if status == libusb.COMPLETED:
            self._failures = 0
            self._receive(slot.batch())
            return True
        self._failures += 1
        if self._failures > _FAILURES:
            self.ended = TransportError(f"USB transfers end with status {status}")
            return False
        self._receive(slot.empty_batch())
        return True


_UNDER_WAY: dict[int, tuple[IsoStream, Slot]] = {}
"""The transfers that libusb has, by their addresses.

A stream and its buffers live as long as libusb may write to them, and no longer.
"""


def _complete(transfer: Any) -> None:
    """Hand a transfer that has ended to its stream."""
    stream, slot = _UNDER_WAY[ctypes.addressof(transfer.contents)]
    stream.complete(slot, transfer.contents.status)


_completed = libusb.completed_type(_complete)
"""What libusb calls for every transfer of every stream. It is never freed.

A function of each stream's own would keep the stream, which keeps the function.
"""
