"""Lines that a person types at the terminal, each after a text that they are shown."""

from __future__ import annotations

import re
import shutil
import sys
import textwrap
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from typing import TypeAlias

from ttr.escapes import terminal_text
from ttr.safety.inputs import ask_line
from ttr.safety.limits import UTTERANCE

Ask: TypeAlias = Callable[[str], str]
"""Shows a text, of which the last line is the prompt, and gives the line typed."""


_NO_CHARACTER = re.compile("[\N{REPLACEMENT CHARACTER}\ud800-\udfff]")
"""What stands for bytes that are no characters, where reading them is no error."""


class Gone(KeyboardInterrupt):
    """The input has ended: nobody is there any more who could type.

    It stops a study as Ctrl-C does, so that nothing is kept of what nobody has said.
    """


class _Garbled(ValueError):
    """A line with bytes that are no characters."""


def read_line(text: str) -> str:
    """Read the line that a person types, without blanks around it.

    Raises `Gone` where the input has ended, cannot be read, or the terminal was closed.
    """
    told, _, prompt = text.rpartition("\n")
    try:
        return _show_and_read(told, prompt)
    except KeyboardInterrupt:
        _end_line()
        raise
    except (UnicodeDecodeError, _Garbled) as error:
        _end_line("What was typed is not UTF-8: save it so, or set the terminal to it.")
        raise Gone from error
    except (EOFError, OSError, ValueError, RuntimeError) as error:
        _end_line("The input has ended.")
        raise Gone from error


def wait_until_ready(text: str) -> None:
    """Show a text, and at a terminal wait until the person is ready."""
    if sys.stdin is not None and sys.stdin.isatty():
        with suppress(ImportError):
            import_module("readline")  # so that lines can be edited as they are typed
        read_line(f"{text}\nPress Enter to begin: ")
    else:
        _show(text)


def _show_and_read(told: str, prompt: str) -> str:
    if told:
        _show(told)
    line = ask_line(prompt, UTTERANCE)
    if _NO_CHARACTER.search(line):
        raise _Garbled
    if not sys.stdin.isatty():  # what comes through a pipe is not on the screen yet
        _show(line)
    return line.strip()


def _show(text: str) -> None:
    sys.stdout.write(f"{_fit_to_terminal(terminal_text(text))}\n")
    sys.stdout.flush()


def _end_line(told: str = "") -> None:
    """Begin a new line after what was typed, if there still is a terminal."""
    try:
        _show(f"\n{told}" if told else "")
    except (OSError, ValueError):
        return


def _fit_to_terminal(text: str) -> str:
    """Wrap a text to the width of the terminal, with hanging indents."""
    if not sys.stdout.isatty():
        return text
    columns = shutil.get_terminal_size().columns
    return "\n".join(_wrap_line(line, columns) for line in text.split("\n"))


def _wrap_line(line: str, columns: int) -> str:
    blank = " " * (len(line) - len(line.lstrip()) + 2)
    return textwrap.fill(
        line,
        max(columns, 20),
        subsequent_indent=blank,
        break_long_words=False,
        break_on_hyphens=False,
    )
