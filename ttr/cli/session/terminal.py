"""A session at a terminal or through a pipe: reading lines, printing the replies."""

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

__all__ = ["talk"]

Say: TypeAlias = Callable[[str], None]
Ask: TypeAlias = Callable[[str], str]

PROMPT, FURTHER = "ttr> ", "...> "

LINES = 2000
"""How many lines the history keeps."""

_BREAKS = " \t\n()[]{}<>,;:=@&|+~\\/\"'.→∧∨¬⊑λ^"
"""What a word to be completed does not hold."""


def talk(session: Session, say: Say, ask: Ask) -> None:
    """Answers what is typed until it is enough: prompts only where someone types.

    `say` prints a text, and `ask` a prompt, after which it gives the line typed.
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
    """What is on the desk: the session, and the lines of an input not yet whole."""

    def __init__(self, session: Session, say: Say) -> None:
        self.session, self._say = session, say
        self.clear()

    def clear(self) -> None:
        """Takes the lines away that wait for more."""
        self.waiting: list[str] = []
        self._characters = 0
        self._pending = Pending()

    def take(self, typed: str) -> None:
        """Goes on with what was typed; what was pasted may have several lines."""
        for line in typed.split("\n"):
            if not self.session.over:
                self._take_line(line)

    def _take_line(self, line: str) -> None:
        """Goes on with a line; an empty one ends an input that is not whole."""
        self.waiting.append(line)
        self._characters += len(line)
        if self._characters > LINE.allowed:
            raise LINE.exceeded()
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
        """The ways to go on with the word at the end of the line."""
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
    """History and completion, where Python has readline: some systems leave it out."""
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
    """The file of the lines typed, where desktops keep such things."""
    return state_folder("ttr") / "history"
