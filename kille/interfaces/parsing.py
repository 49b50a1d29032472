"""The parser of `kille`: a mistake is one line that names a way out."""

from __future__ import annotations

import argparse
import difflib
import math
import re
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

from kille.interfaces.streams import write, write_error

__all__ = ["Parser", "Version", "add_consent", "counted", "positive", "seed"]

WRONG_USE = 2


class Parser(argparse.ArgumentParser):
    """A parser whose complaint is one line, with a way out."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)
        self.set_defaults(parser=self)

    def error(self, message: str) -> NoReturn:
        """Say what is wrong in one line, and leave."""
        message = self._with_way_out(message)
        write_error(f"{self.prog}: {message} ({self.prog} --help says more)")
        self.exit(WRONG_USE)

    def _with_way_out(self, message: str) -> str:
        if found := re.search(r"invalid choice: '(.*)' \(choose from (.*)\)", message):
            known = re.findall(r"[\w-]+", found[2])
            return _no_such(found[1], known, f"try {', '.join(known)}")
        if found := re.fullmatch(r"unknown option: ([^=]*).*", message, re.DOTALL):
            options = re.findall(r"--[\w-]+", self.format_help())
            return _no_such(found[1], options, "it is not understood here")
        return message


def _no_such(word: str, known: Sequence[str], otherwise: str) -> str:
    near = difflib.get_close_matches(word, known, n=1)
    return f"there is no {word}: {f'did you mean {near[0]}?' if near else otherwise}"


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


def add_consent(action: argparse.ArgumentParser, log: str = "") -> None:
    """Declares by which options the user consents to what a file names.

    What `ttr` has by the same names; `--trust` is for what names a log, called so.
    """
    action.add_argument(
        "--allow",
        action="append",
        type=_folder,
        default=[],
        metavar="FOLDER",
        help="files may also use what lies in this folder or below, besides their own; "
        "may be repeated",
    )
    either = action.add_mutually_exclusive_group()
    either.add_argument(
        "--no-python", action="store_true", help="refuse what names Python"
    )
    if log:
        told = f"run the Python that {log} names"
        either.add_argument("--trust", action="store_true", help=told)


def _folder(text: str) -> Path:
    if Path(text).is_dir():
        return Path(text)
    raise argparse.ArgumentTypeError(f"there is no folder {text}")


class Version(argparse.Action):
    """Prints the version, which is looked up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print it, and leave."""
        from importlib.metadata import version

        write(f"kille {version('kille')}")
        parser.exit()
