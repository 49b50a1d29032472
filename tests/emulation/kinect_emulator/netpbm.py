"""Reading the pictures that libfreenect's programs write."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray


def depth(path: Path) -> NDArray[np.uint16]:
    """A P5 picture; its 16-bit numbers are little-endian, against the format's rule."""
    return np.frombuffer(_body(path, b"P5 640 480 65535\n"), "<u2").reshape(480, 640)


def colour(path: Path) -> NDArray[np.uint8]:
    """A P6 picture."""
    return np.frombuffer(_body(path, b"P6 640 480 255\n"), "u1").reshape(480, 640, 3)


def _body(path: Path, header: bytes) -> bytes:
    content = path.read_bytes()
    if not content.startswith(header):
        raise ValueError(f"{path.name} begins with {content[:20]!r}")
    return content[len(header) :]
