"""Numbers as they are typed in a command line of `kille`."""

from __future__ import annotations

import argparse
import math
from contextlib import suppress


def seed(text: str) -> int:
    """A seed as it is typed."""
    if text.isascii() and text.isdigit():
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no whole number from 0, such as 7")


def counted(text: str) -> int:
    """A number of things as it is typed, at least one."""
    if text.isascii() and text.isdigit() and int(text):
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no whole number from 1, such as 300")


def positive(text: str) -> float:
    """A number above 0 as it is typed."""
    with suppress(ValueError):
        if 0 < float(text) < math.inf:
            return float(text)
    raise argparse.ArgumentTypeError(f"{text} is no number above 0, such as 10")
