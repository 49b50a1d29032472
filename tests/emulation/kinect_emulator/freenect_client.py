"""A client of Debian's libfreenect, for modes that none of its programs asks for.

    python freenect_client.py KIND FORMAT RESOLUTION COUNT OUT.npz

Opens the first Kinect, streams `depth` or `video` in that format and resolution (the
numbers of libfreenect.h) and saves so many whole frames with their ticks. It needs
nothing but ctypes and numpy, so that it runs apart from emulator and product.
"""

from __future__ import annotations

import ctypes
import sys

import numpy as np

CAMERA = 2


class FrameMode(ctypes.Structure):
    """freenect_frame_mode."""

    _fields_ = (
        ("reserved", ctypes.c_uint32),
        ("resolution", ctypes.c_int),
        ("format", ctypes.c_int),
        ("bytes", ctypes.c_int32),
        ("width", ctypes.c_int16),
        ("height", ctypes.c_int16),
        ("data_bits_per_pixel", ctypes.c_int8),
        ("padding_bits_per_pixel", ctypes.c_int8),
        ("framerate", ctypes.c_int8),
        ("is_valid", ctypes.c_int8),
    )


Arrived = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_uint32)


def main(kind: str, form: int, resolution: int, count: int, out: str) -> None:
    """Stream and save."""
    library = ctypes.CDLL("libfreenect.so.0.5")
    find = getattr(library, f"freenect_find_{kind}_mode")
    find.restype = FrameMode
    mode = find(resolution, form)
    context, device = ctypes.c_void_p(), ctypes.c_void_p()
    check(library.freenect_init(ctypes.byref(context), None), "init")
    library.freenect_select_subdevices(context, CAMERA)
    check(library.freenect_open_device(context, ctypes.byref(device), 0), "open")
    frames: list[bytes] = []
    ticks: list[int] = []

    def arrived(_device: int, data: int, timestamp: int) -> None:
        frames.append(ctypes.string_at(data, mode.bytes))
        ticks.append(timestamp)

    callback = Arrived(arrived)
    check(getattr(library, f"freenect_set_{kind}_mode")(device, mode), "mode")
    getattr(library, f"freenect_set_{kind}_callback")(device, callback)
    check(getattr(library, f"freenect_start_{kind}")(device), "start")
    while len(frames) < count:
        check(library.freenect_process_events(context), "events")
    getattr(library, f"freenect_stop_{kind}")(device)
    library.freenect_close_device(device)
    library.freenect_shutdown(context)
    pixels = np.frombuffer(b"".join(frames[:count]), np.uint8)
    np.savez(out, frames=pixels.reshape(count, -1), ticks=np.array(ticks[:count]))


def check(result: int, what: str) -> None:
    """Stop if libfreenect says that this failed."""
    if result < 0:
        sys.exit(f"libfreenect: {what} failed: {result}")


if __name__ == "__main__":
    form, resolution, count = map(int, sys.argv[2:5])
    main(sys.argv[1], form, resolution, count, sys.argv[5])
