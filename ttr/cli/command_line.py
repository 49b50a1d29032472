"""The parser of a command line: a mistake is one line that names a way out.

`ttr` and `kille` share it.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from ttr.errors import suggestion
from ttr.escapes import terminal_line, terminal_text

WRONG_USE = 2
"""The exit code where a command was not understood."""


class Parser(argparse.ArgumentParser):
    """A parser whose complaint is one line, safe to print whatever was typed.

    An action sets `run`, the function that does what was asked for.
    """

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)
        self.set_defaults(parser=self)

    def options_of(self, argv: Sequence[str] | None) -> argparse.Namespace:
        """The options in a command line; leaves where it is not understood."""
        options, unknown = self.parse_known_args(argv)
        if unknown:
            options.parser.error(_unknown(unknown[0], options.parser))
        if "run" not in options:
            options.parser.error("a command is missing")
        return options

    def error(self, message: str) -> NoReturn:
        """Says in one line what is wrong, and leaves."""
        told = f"{self.prog}: {_with_way_out(message)} ({self.prog} --help says more)"
        self.exit(WRONG_USE, f"{terminal_line(told)}\n")

    def exit(self, status: int = 0, message: str | None = None) -> NoReturn:
        """Leaves, after saying why if there is a reason."""
        super().exit(status, terminal_text(message or ""))


def _with_way_out(message: str) -> str:
    """What argparse says, shorter, and with what was perhaps meant.

    >>> _with_way_out("argument --as: invalid choice: 'bx' (choose from 'box', 'html')")
    '--as: there is no bx: did you mean box?'
    """
    message = message.removeprefix("argument ")
    found = re.fullmatch(
        r"(.*?): invalid choice: '(.*)' \(choose from (.*)\)", message, re.DOTALL
    )
    if found is None:
        return message
    argument, word, choices = found.groups()
    known = re.findall(r"[\w-]+", choices)
    told = _no_such(word, known, f"try {', '.join(known)}")
    return f"{argument}: {told}" if argument.startswith("-") else told


def _unknown(word: str, parser: argparse.ArgumentParser) -> str:
    if not word.startswith("-"):
        return f"{word} is not expected here"
    options = re.findall(r"--[\w-]+", parser.format_help())
    return _no_such(word.partition("=")[0], options, "it is not understood here")


def _no_such(word: str, known: Sequence[str], otherwise: str) -> str:
    return f"there is no {word}: {suggestion(word, known) or otherwise}"


class Version(argparse.Action):
    """Prints the version, which is looked up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Prints it, and leaves."""
        from importlib.metadata import version

        sys.stdout.write(f"{parser.prog} {version('kille')}\n")
        parser.exit()
