"""How much of a value is drawn: all of it, or as much as there is room for.

What nobody asked to see in full, as in a notebook, is drawn in a `Room` of so many
words. What does not fit is never laid out: an ellipsis stands for it, and says how much
it is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from itertools import islice
from typing import TypeVar

WORDS = 4_000
"""How many words a notebook shows of one output."""

OF_ONE = 1_000
"""How many of them a single type or object may take."""

ITEMS = 40
"""How many fields of a record or items of a list are shown there."""

LETTERS = 2_000
"""How many letters of a text are shown there."""

_Item = TypeVar("_Item")


class _Room:
    __slots__ = ("left",)

    def __init__(self, left: int) -> None:
        self.left = left


_open: ContextVar[_Room | None] = ContextVar("room", default=None)


@contextmanager
def room_for(words: int) -> Iterator[None]:
    """Draws what is drawn inside in so many words, and in what is left around it."""
    around = _open.get()
    mine = words if around is None else min(words, max(0, around.left))
    own = _Room(mine)
    token = _open.set(own)
    try:
        yield
    finally:
        _open.reset(token)
        if around is not None:
            around.left -= mine - own.left


def shared_by(number: int) -> AbstractContextManager[None]:
    """Draws what is drawn inside in one of so many shares of what is left."""
    own = _open.get()
    return nullcontext() if own is None else room_for(max(0, own.left) // number)


def is_bounded() -> bool:
    """Is there only so much room?"""
    return _open.get() is not None


def take_room() -> bool:
    """Takes the room of one word; False where there is none left."""
    own = _open.get()
    if own is None:
        return True
    own.left -= 1
    return own.left >= 0


def cut(items: Iterable[_Item], count: int) -> tuple[list[_Item], int]:
    """As many of the items as there is room for, and the number of those left out.

    >>> cut(range(100), 100)[1]
    0
    >>> with room_for(30):
    ...     cut(range(100), 100)[1]
    70
    """
    own = _open.get()
    if own is None:
        return list(items), 0
    most = min(ITEMS, max(0, own.left))
    shown = list(islice(items, most if count > most + 1 else count))
    return shown, count - len(shown)


def ellipsis(left: int) -> str:
    """What stands for so many that are left out."""
    return f"… {left:,} more"


def shorten(text: str) -> str:
    """The text, or its beginning where there is only so much room."""
    if len(text) <= LETTERS or not is_bounded():
        return text
    return f"{text[:LETTERS]}… {len(text) - LETTERS:,} more letters"
