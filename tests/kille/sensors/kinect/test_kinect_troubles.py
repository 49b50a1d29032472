"""What is told of trouble with a Kinect."""

from __future__ import annotations

import pytest

from kille.sensors.kinect import diagnosis, usb
from kille.sensors.kinect.transport import (
    DeviceBusyError,
    KernelDriverError,
    TransportError,
)


def test_a_kernel_driver_is_blamed_only_for_what_it_has(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is loaded on most computers, but moved aside by whoever opens the Kinect."""
    monkeypatch.setattr(diagnosis, "driver_loaded", lambda: True)
    assert diagnosis.explain_error("kinect", KernelDriverError("busy")).endswith(
        diagnosis.UNLOAD
    )
    assert diagnosis.trouble(DeviceBusyError("busy")).state == "another program has it"


def test_what_libusb_cannot_do_here_is_told() -> None:
    with (
        pytest.raises(TransportError, match="libusb says: Operation not supported"),
        usb._translate_errors(),
    ):
        raise NotImplementedError("Operation not supported")
