"""Amounts as people say them."""

from __future__ import annotations

from pathlib import Path


def in_bytes(count: int) -> str:
    """A number of bytes as people write it.

    >>> in_bytes(1_536_000), in_bytes(71_400_000_000)
    ('2 MB', '71 GB')
    """
    if count < 1_000_000:
        return f"{count / 1000:.0f} kB"
    if count < 10_000_000_000:
        return f"{count / 1_000_000:.0f} MB"
    return f"{count / 1_000_000_000:.0f} GB"


def in_frames(count: int) -> str:
    """A number of frames as people write it.

    >>> in_frames(1), in_frames(2)
    ('1 frame', '2 frames')
    """
    return "1 frame" if count == 1 else f"{count} frames"


def why_unwritten(path: Path, error: OSError) -> str:
    """Explain in one line why something could not be written."""
    return f"{path} cannot be written: {(error.strerror or str(error)).lower()}"
