"""Parse numbers typed in a command line of `kille`."""

from __future__ import annotations

import argparse
import math
from contextlib import suppress


def parse_seed(text: str) -> int:
    """Parse a seed."""
    if text.isascii() and text.isdigit():
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no whole number from 0, such as 7")


def parse_count(text: str) -> int:
    """Parse a number of things, at least one."""
    if text.isascii() and text.isdigit() and int(text):
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no whole number from 1, such as 300")


def parse_port(text: str) -> int:
    """Parse a port, or 0 for any that is free."""
    if text.isascii() and text.isdigit() and int(text) < 2**16:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no port from 0 to 65535, such as 8765")


def positive(text: str) -> float:
    """Parse a number above 0."""
    with suppress(ValueError):
        if 0 < float(text) < math.inf:
            return float(text)
    raise argparse.ArgumentTypeError(f"{text} is no number above 0, such as 10")
