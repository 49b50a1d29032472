"""What a value is shown as where there is room for more than a line: a few parts.

A value of any floor says in `_shown_as_` what it is shown as, made of the parts below.
They hold types and objects as they are, and know nothing of HTML or LaTeX:
`ttr.display` draws them, and decides how much of them is drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Literal, Protocol, TypeAlias, TypeVar

from ttr.hooks import hook

Tone = Literal["plain", "strong", "quiet", "code", "yes", "no"]
"""How a text is set: `yes` and `no` are those of answers."""

ROWS = 60
"""A table shows at most so many rows."""

SOME = 200
"""A list of names shows at most so many."""

_Item = TypeVar("_Item")


@dataclass(frozen=True)
class Text:
    """Words for people, as they are."""

    text: str
    tone: Tone = "plain"


@dataclass(frozen=True, eq=False)
class Value:
    """A type, an object, a judgement or a derivation, drawn as in papers.

    What has changed since `before` is marked; `free` are the names of variables that
    paths in it start with. In a theory, `unfold` says how many definitions are opened.
    """

    value: object
    before: object = None
    free: tuple[str, ...] = ()
    unfold: int | None = None


@dataclass(frozen=True, eq=False)
class Beside:
    """Parts side by side, as far as there is room."""

    parts: tuple[Part, ...]


@dataclass(frozen=True, eq=False)
class Below:
    """Parts one below the other."""

    parts: tuple[Part, ...]


@dataclass(frozen=True, eq=False)
class Fields:
    """A feature structure: in square brackets, a name and a part in each row."""

    rows: tuple[tuple[str, Part], ...]


@dataclass(frozen=True, eq=False)
class Table:
    """Rows of cells under the heads of their columns; so many `more` are left out."""

    heads: tuple[str, ...]
    rows: tuple[tuple[Part, ...], ...]
    more: int = 0


@dataclass(frozen=True, eq=False)
class Fold:
    """A part that opens on a click on its summary."""

    summary: str
    body: Part
    opened: bool = False


@dataclass(frozen=True, eq=False)
class Figure:
    """A picture of some pixels' width: encoded, or SVG without script; and in words."""

    data: bytes
    kind: Literal["image/png", "image/jpeg", "image/svg+xml"]
    about: str
    width: int


@dataclass(frozen=True, eq=False)
class In:
    """A part in which the names of a theory stand for what it defines."""

    theory: object
    part: Part


Part: TypeAlias = Text | Value | Beside | Below | Fields | Table | Fold | Figure | In
"""What values are shown as."""


def below(*parts: Part | None) -> Below:
    """These parts one below the other; None is left out."""
    return Below(tuple([part for part in parts if part is not None]))


def beside(*parts: Part | None) -> Beside:
    """These parts side by side; None is left out."""
    return Beside(tuple([part for part in parts if part is not None]))


def table(
    heads: Sequence[str],
    items: Iterable[_Item],
    row: Callable[[_Item], Sequence[Part]],
    *,
    count: int | None = None,
    most: int = ROWS,
) -> Table:
    """A table with a row for each item, or for so many of them; `row` makes it.

    `count` is the number of items, where they do not know it themselves.

    >>> table(["n"], range(100), lambda n: [Text(str(n))], most=3).more
    97
    """
    shown = tuple([tuple(row(item)) for item in islice(items, most)])
    number = len(items) if count is None else count  # type: ignore[arg-type]
    return Table(tuple(heads), shown, max(0, number - len(shown)))


def name_list(found: Iterable[object], tone: Tone = "code") -> Text:
    """Some names in a line, and how many there are more.

    >>> name_list(["dog", "cat"]).text
    'cat, dog'
    """
    ordered = sorted(map(str, found))
    more = len(ordered) - SOME
    told = ", ".join(ordered[:SOME]) + f", … {more:,} more" * (more > 0)
    return Text(told, tone)


def count_of(number: int, one: str, several: str = "") -> str:
    """A number with its noun.

    >>> count_of(1, "rule"), count_of(2000, "rule")
    ('1 rule', '2,000 rules')
    """
    return f"{number:,} {one if number == 1 else several or one + 's'}"


# --- values that show themselves -----------------------------------------------------


class HasParts(Protocol):
    """A value that says what it is shown as."""

    def _shown_as_(self) -> Part: ...


@hook
def as_html(value: object) -> str:
    """What a notebook shows of the value, as HTML: `ttr.display.notebook`."""
    raise NotImplementedError


@hook
def as_latex(value: object) -> str | None:
    """What a paper shows of the value, as LaTeX, if it can: `ttr.display.notebook`."""
    raise NotImplementedError


class NotebookValue:
    """A value that a notebook shows as it is drawn in papers.

    >>> from ttr import Ind
    >>> Ind._repr_latex_()
    '$\\\\displaystyle \\\\mathit{Ind}$'
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        return as_html(self)

    def _repr_latex_(self) -> str | None:
        drawn = as_latex(self)
        return None if drawn is None else f"$\\displaystyle {drawn}$"
