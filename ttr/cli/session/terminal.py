"""A session at a terminal or through a pipe: read lines, print the replies."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from itertools import islice
from pathlib import Path
from typing import TypeAlias

from ttr.cli.session.completion import completions
from ttr.cli.session.repl import Pending, respond
from ttr.cli.session.sessions import Session
from ttr.safety.inputs import read_line
from ttr.safety.limits import LINE
from ttr.safety.unforeseen_errors import state_folder

Say: TypeAlias = Callable[[str], None]
Ask: TypeAlias = Callable[[str], str]

PROMPT, FURTHER = "ttr> ", "...> "

LINES = 2000
"""How many lines the history keeps."""

_BREAKS = " \t\n()[]{}<>,;:=@&|+~\\/\"'.→∧∨¬⊑λ^"
"""The characters at which a word to be completed begins anew."""


def talk(session: Session, say: Say, ask: Ask) -> None:
    """Answers inputs until the session is over; prompts only at a terminal.

    `say` prints a text; `ask` prints a prompt and gives the line that is typed.
    """
    if sys.stdin.isatty() and sys.stdout.isatty():
        _talk_at_terminal(session, say, ask)
    else:
        _talk_through_pipe(session, say)


def _talk_through_pipe(session: Session, say: Say) -> None:
    if isinstance(sys.stdin, TextIOWrapper):  # not where a program has replaced it
        sys.stdin.reconfigure(errors="backslashreplace")
    desk = _Desk(session, say)
    while line := read_line(sys.stdin):
        desk.take(line.rstrip("\n"))
        if desk.session.over:
            return
    desk.take("")


class _Desk:
    """The session, and the lines of an input that is not yet complete."""

    def __init__(self, session: Session, say: Say) -> None:
        self.session, self._say = session, say
        self.clear()

    def clear(self) -> None:
        """Drops the lines of an incomplete input."""
        self.waiting: list[str] = []
        self._characters = 0
        self._pending = Pending()

    def take(self, typed: str) -> None:
        """Takes an input line; pasted text may have several."""
        for line in typed.split("\n"):
            if not self.session.over:
                self._take_line(line)

    def _take_line(self, line: str) -> None:
        """Takes one line; an empty one ends an incomplete input."""
        self.waiting.append(line)
        self._characters += len(line)
        if self._characters > LINE.maximum:
            raise LINE.too_much()
        self._pending = self._pending.after(line)
        if line.strip() and not self._pending.is_complete:
            return
        text = "\n".join(self.waiting)
        self.clear()
        reply = respond(self.session, text)
        self.session = reply.session
        if reply.text:
            self._say(reply.text)

    def completions(self, line: str) -> list[str]:
        """The completions of the word at the end of the line."""
        return completions(self.session, "\n".join((*self.waiting, line)))


# --- at a terminal -------------------------------------------------------------------


def _talk_at_terminal(session: Session, say: Say, ask: Ask) -> None:
    say("Type Theory with Records; :help lists what can be typed")
    desk = _Desk(session, say)
    with _line_editing(desk):
        while not desk.session.over:
            try:
                desk.take(ask(FURTHER if desk.waiting else PROMPT))
            except KeyboardInterrupt:
                desk.clear()
                say("")
            except EOFError:
                say("")
                return


@contextmanager
def _line_editing(desk: _Desk) -> Iterator[None]:
    """History and completion, where Python has readline; some systems lack it."""
    try:
        import readline
    except ImportError:
        yield
        return

    def complete(_: str, number: int) -> str | None:
        before = readline.get_line_buffer()[: readline.get_endidx()]
        return next(islice(desk.completions(before), number, None), None)

    readline.set_completer(complete)
    readline.set_completer_delims(_BREAKS)
    editline = "libedit" in (readline.__doc__ or "")
    readline.parse_and_bind("bind ^I rl_complete" if editline else "tab: complete")
    file = _history_file()
    with suppress(OSError):
        readline.read_history_file(file)
    readline.set_history_length(LINES)
    try:
        yield
    finally:
        # A history that cannot be kept is no reason to complain.
        with suppress(OSError):
            file.parent.mkdir(parents=True, exist_ok=True)
            file.touch(0o600)
            readline.write_history_file(file)


def _history_file() -> Path:
    """The file that keeps the lines typed."""
    return state_folder("ttr") / "history"
