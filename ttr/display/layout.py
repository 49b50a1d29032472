"""How values are laid out, however they are drawn: as words, rows and matrices.

`layout_of` turns a type or an object into a few kinds of layout, which are drawn as
text, LaTeX or HTML. Read from left to right, a layout is the value in notation.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, TypeAlias

from ttr.display.room import cut, ellipsis, shared_by, shorten, take_room
from ttr.escapes import columns, terminal_line
from ttr.safety.budgets import spend
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Object,
    Operation,
    Path,
    Record,
)
from ttr.types.paths import parts as contents
from ttr.types.precedence import (
    begins_with_bracket,
    binds,
    holds_as_head,
    is_loose,
    is_loose_beside,
)
from ttr.types.printing import (
    Scope,
    as_object,
    fields_in_order,
    format_head,
    labels_of,
    notation,
    variable,
)
from ttr.types.reserved_words import WORDS
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    Merge,
    Negation,
    NonEmpty,
    Plus,
    Pred,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
    Universe,
)

Role = Literal["type", "predicate", "label", "object", "variable", "text"]
"""What a word names, which decides the font."""


# --- kinds of layout -----------------------------------------------------------------
#
# `width` is the number of columns that a layout takes if it is not broken, and `tall`
# says whether it takes more than one line even then.


@dataclass(frozen=True)
class Word:
    """A name, a number or a path, never broken."""

    text: str
    role: Role
    tall = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", terminal_line(self.text))

    @cached_property
    def width(self) -> int:
        """The columns it takes."""
        return columns(self.text)


@dataclass(frozen=True)
class Sign:
    """A sign of the notation, with the space around it."""

    text: str
    tall = False

    @property
    def width(self) -> int:
        """The columns it takes."""
        return len(self.text)


@dataclass(frozen=True)
class Superscript:
    """A base with a number above: Type¹."""

    base: Word
    exponent: Word
    tall = False

    @property
    def width(self) -> int:
        """The columns it takes, with a sign between the parts."""
        return self.base.width + 1 + self.exponent.width


@dataclass(frozen=True)
class Subscript:
    """A base with an object below: the singleton type T@a."""

    base: Layout
    value: Layout

    @cached_property
    def width(self) -> int:
        """The columns it takes, with a sign between the parts."""
        return self.base.width + 1 + self.value.width

    @cached_property
    def tall(self) -> bool:
        """Is one of its parts tall?"""
        return self.base.tall or self.value.tall


@dataclass(frozen=True)
class Line:
    """Parts side by side."""

    parts: tuple[Layout, ...]

    @cached_property
    def width(self) -> int:
        """The columns it takes."""
        return sum(part.width for part in self.parts)

    @cached_property
    def tall(self) -> bool:
        """Is one of its parts tall?"""
        return any(part.tall for part in self.parts)


@dataclass(frozen=True)
class Chain:
    """Parts with a sign between; if they are too wide, one below the other."""

    sign: Sign
    parts: tuple[Layout, ...]

    @cached_property
    def width(self) -> int:
        """The columns it takes."""
        between = self.sign.width * (len(self.parts) - 1)
        return sum(part.width for part in self.parts) + between

    @cached_property
    def tall(self) -> bool:
        """Is one of its parts tall?"""
        return any(part.tall for part in self.parts)


@dataclass(frozen=True)
class Bracketed:
    """Parts in brackets; if they are too wide, on several lines."""

    opening: str
    parts: tuple[Layout, ...]
    closing: str
    between: Sign

    @cached_property
    def width(self) -> int:
        """The columns it takes."""
        between = self.between.width * max(0, len(self.parts) - 1)
        brackets = len(self.opening) + len(self.closing)
        return sum(part.width for part in self.parts) + between + brackets

    @cached_property
    def tall(self) -> bool:
        """Is one of its parts tall?"""
        return any(part.tall for part in self.parts)


@dataclass(frozen=True)
class Row:
    """A field: its label, the object of a manifest field, and its type or value.

    If it has `changed`, it is highlighted.
    """

    label: Word
    manifest: Layout | None
    has: Layout
    changed: bool = False

    @cached_property
    def name_width(self) -> int:
        """The columns of what stands before the sign of the matrix."""
        return self.label.width + (3 + self.manifest.width if self.manifest else 0)

    @cached_property
    def tall(self) -> bool:
        """Is one of its parts tall?"""
        return self.has.tall or bool(self.manifest and self.manifest.tall)


@dataclass(frozen=True)
class Matrix:
    """An attribute-value matrix, `label : type` or `label = value` in each row.

    In one line it has the brackets of the notation.
    """

    opening: str
    sign: Sign
    rows: tuple[Row, ...]
    closing: str

    @cached_property
    def name_width(self) -> int:
        """The columns of the widest name."""
        return max(row.name_width for row in self.rows)

    @cached_property
    def width(self) -> int:
        """The columns it takes."""
        has = max(row.has.width for row in self.rows)
        return self.name_width + self.sign.width + has + 2

    @cached_property
    def tall(self) -> bool:
        """Does it have several fields, or a tall one?"""
        return len(self.rows) > 1 or self.rows[0].tall


@dataclass(frozen=True)
class Folded:
    """What opens on a click on its summary, where there are clicks."""

    summary: Word
    inside: Layout

    @property
    def width(self) -> int:
        """The columns it takes."""
        return self.inside.width

    @property
    def tall(self) -> bool:
        """Is what is inside tall?"""
        return self.inside.tall


Layout: TypeAlias = (
    Word | Sign | Superscript | Subscript | Line | Chain | Bracketed | Matrix | Folded
)


@dataclass(frozen=True)
class Step:
    """A step of a derivation: its mark, its claim, the reason and the steps below it.

    `fails` is true of the first step at the bottom that fails, and of those above it.
    """

    mark: str
    where: str
    claim: Layout
    because: str
    parts: tuple[Step, ...]
    fails: bool

    def __post_init__(self) -> None:
        for text in ("where", "because"):
            object.__setattr__(self, text, terminal_line(getattr(self, text)))


def fill_lines(
    parts: Sequence[Layout], between: Sign, room: int
) -> Iterator[tuple[Layout, ...]]:
    """The parts in lines, of at most `room` columns or of a single part."""
    line: list[Layout] = []
    used = 0
    for part in parts:
        if line and used + part.width + between.width > room:
            yield tuple(line)
            line, used = [], 0
        line.append(part)
        used += part.width + between.width
    if line:
        yield tuple(line)


def words_in(layout: Layout) -> int:
    """The number of words in a layout, which is about how long it takes to read it."""
    match layout:
        case Word() | Sign() | Superscript():
            return 1
        case Subscript(base, value):
            return words_in(base) + words_in(value)
        case Line(parts) | Chain(_, parts) | Bracketed(_, parts):
            return sum(map(words_in, parts))
        case Matrix(rows=rows):
            return sum(1 + words_in(row.has) for row in rows)
        case Folded(_, inside):
            return words_in(inside)


LARGE = 40
"""A field with more words than this folds, in a matrix that has more than that."""


def fold_large_fields(layout: Layout) -> Layout:
    """The layout with what is large in the fields of a large matrix folded.

    What has changed stays open.
    """
    if not isinstance(layout, Matrix) or words_in(layout) <= 2 * LARGE:
        return layout
    return replace(layout, rows=tuple([_fold_if_large(row) for row in layout.rows]))


def _fold_if_large(row: Row) -> Row:
    inside = fold_large_fields(row.has)
    if not (many := _count_inside(row.has)):
        return row
    if row.changed or words_in(row.has) <= LARGE or _has_changes(row.has):
        return replace(row, has=inside)
    return replace(row, has=Folded(Word(many, "text"), inside))


def _count_inside(layout: Layout) -> str:
    """How many fields or items a matrix or a list has; empty of anything else."""
    match layout:
        case Matrix(rows=found):
            return f"{len(found):,} fields"
        case Bracketed(parts=parts):
            return f"{len(parts):,} items"
    return ""


LARGE_IN_CLAIM = 16
"""What has more words than this folds in the claim of a step that rests on others."""


def fold_claim(claim: Layout) -> Layout:
    """A claim with what is large in it folded: its parts stand in steps of their own.

    A bracket around a single thing, as in `list([x : Ind])`, stays.
    """
    if words_in(claim) <= LARGE_IN_CLAIM:
        return claim
    match claim:
        case Matrix(opening, _, rows, closing):
            many = f"{opening}{_count_inside(claim)}{closing}"
            return (
                Folded(Word(many, "text"), fold_large_fields(claim)) if rows else claim
            )
        case Bracketed(parts=[alone]):
            return replace(claim, parts=(fold_claim(alone),))
        case Bracketed(opening=opening, closing=closing):
            many = f"{opening}{_count_inside(claim)}{closing}"
            return Folded(Word(many, "text"), claim)
        case Line(parts) | Chain(parts=parts):
            return replace(claim, parts=tuple(map(fold_claim, parts)))
        case Subscript(base, value):
            return Subscript(fold_claim(base), fold_claim(value))
    return claim


def _has_changes(layout: Layout) -> bool:
    """Has a field in the matrix changed?"""
    return isinstance(layout, Matrix) and any(
        row.changed or _has_changes(row.has) for row in layout.rows
    )


# --- values --------------------------------------------------------------------------


_COMMA = Sign(", ")
_COLON = Sign(" : ")
_ELLIPSIS = Word("…", "text")


def layout_of(value: Object, scope: Scope = ()) -> Layout:
    """The layout of a type or an object; its variables are named as in print.

    Where there is only so much room (`room_for`), an ellipsis stands for the rest.
    """
    spend(4)  # the layout is kept, and drawn later
    if not take_room():
        return _ELLIPSIS
    match value:
        case Basic():
            return Word(notation(value, scope), "type")
        case Universe(name, 0):
            return Word(name, "type")
        case Universe(name, level):
            return Superscript(Word(name, "type"), Word(str(level), "text"))
        case Pred(name):
            return Word(name, "predicate")
        case PType(pred, args):
            return _call(Word(pred.name, "predicate"), _objects(args, scope))
        case RecordType(()):
            return Word("Rec", "type")
        case RecordType():
            inner = (labels_of(value), *scope)
            fields, left = cut(fields_in_order(value, scope), len(value.fields))
            rows = []
            for number, (label, T) in enumerate(fields):
                with shared_by(len(fields) - number):
                    rows.append(_row(label, T, inner))
            return Matrix("[", _COLON, (*rows, *_rows_left(left)), "]")
        case Singleton(base, obj):
            return Subscript(_tight(base, scope), _tight_object(obj, scope))
        case Merge(parts):
            inside = tuple([layout_of(T, scope) for T in parts])
            return _call(Word("merge", "text"), inside)
        case Meet(parts):
            return Chain(Sign(" ∧ "), _operands(parts, scope))
        case Join(parts):
            return Chain(Sign(" ∨ "), _operands(parts, scope))
        case Negation(body):
            return Line((Sign("¬"), *_operands((body,), scope)))
        case FunType():
            return _function_type(value, scope)
        case Function():
            return _function(value, scope)
        case Application(function, argument):
            return _call(_head(function, scope), _objects((argument,), scope))
        case Operation("+", args):
            summands = [_tight_object(arg, scope) for arg in args]
            return Chain(Sign(" + "), tuple(summands))
        case Operation(name, args):
            return _call(Word(name, "text"), _objects(args, scope))
        case TypeAt(Path() as path):
            return Word(notation(value, scope), _role(path))
        case TypeAt(term):
            return layout_of(term, scope)
        case ListOf() | NonEmpty() | SetOf() | Plus() | Str():
            types, _ = contents(value)
            word = Word(WORDS[type(value)], "text")
            return _call(word, tuple([layout_of(T, scope) for T in types]))
    return _object(value, scope)


def _object(value: Object, scope: Scope) -> Layout:
    spend()
    match value:
        case Record() if len(value):
            fields, left = cut(sorted(value._fields.items()), len(value))
            labels = [Word(label, "label") for label, _ in fields]
            values = _objects([v for _, v in fields], scope)
            rows = [Row(k, None, v) for k, v in zip(labels, values, strict=True)]
            return Matrix("{", Sign(" = "), (*rows, *_rows_left(left)), "}")
        case FiniteSet(items) if items:
            return Bracketed("{", _objects(items, scope), "}", _COMMA)
        case EventString(items):
            return _string(items, scope)
    if type(value) is tuple:
        return Bracketed("[", _objects(value, scope), "]", _COMMA)
    return Word(shorten(notation(value, scope)), _role(value))


def _role(value: Object) -> Role:
    match value:
        case Path(_, labels):
            return "variable" if labels[0] == BOUND else "label"
        case str():
            return "object"
    return "text"


def _row(label: str, field: TypeNode, scope: Scope) -> Row:
    spend()
    match field:
        case Singleton(base, obj):
            (given,) = _objects((obj,), scope)
            return Row(Word(label, "label"), given, layout_of(base, scope))
    return Row(Word(label, "label"), None, layout_of(field, scope))


def _rows_left(left: int) -> list[Row]:
    """A row for so many fields that are left out."""
    if not left:
        return []
    return [Row(Word("…", "text"), None, Word(f"{left:,} more fields", "text"))]


def _objects(values: Sequence[Object], scope: Scope) -> tuple[Layout, ...]:
    shown, left = cut(values, len(values))
    drawn = []
    for number, value in enumerate(shown):
        with shared_by(len(shown) - number):
            drawn.append(layout_of(as_object(value, scope), scope))
    if left:
        drawn.append(Word(ellipsis(left), "text"))
    return tuple(drawn)


def _call(applied: Layout, args: tuple[Layout, ...]) -> Line:
    return Line((applied, Bracketed("(", args, ")", _COMMA)))


def _string(items: Sequence[Object], scope: Scope) -> Bracketed:
    """<a b>; with commas if an event could be read as an argument of the one before."""
    shown, left = cut(items, len(items))
    events = [as_object(item, scope) for item in shown]
    between = _COMMA if any(map(begins_with_bracket, events)) else Sign(" ")
    drawn = [_tight(it, scope) for it in events]
    if left:
        drawn.append(Word(ellipsis(left), "text"))
    return Bracketed("<", tuple(drawn), ">", between)


# --- brackets, functions and their variables -----------------------------------------


def _in_brackets(layout: Layout) -> Layout:
    return Bracketed("(", (layout,), ")", _COMMA)


def _operand(value: Object, scope: Scope) -> Layout:
    """A part of a meet, join or negation: in brackets unless it binds more tightly."""
    layout = layout_of(value, scope)
    return _in_brackets(layout) if is_loose(value) else layout


def _operands(values: Sequence[Object], scope: Scope) -> tuple[Layout, ...]:
    shown, left = cut(values, len(values))
    drawn = [_operand(value, scope) for value in shown]
    if left:
        drawn.append(Word(ellipsis(left), "text"))
    return tuple(drawn)


def _tight(value: Object, scope: Scope) -> Layout:
    """A part beside @, + or an arrow: in brackets unless it binds tightly enough."""
    layout = layout_of(value, scope)
    return _in_brackets(layout) if is_loose_beside(value) else layout


def _tight_object(value: Object, scope: Scope) -> Layout:
    return _tight(as_object(value, scope), scope)


def _function(value: Function, scope: Scope) -> Chain:
    name = variable(value, scope)
    domain = _tight(value.domain, scope)
    binder = Line((Sign("λ"), Word(name, "variable"), Sign(":"), domain, Sign(".")))
    return Chain(Sign(" "), (binder, *_objects((value.body,), (name, *scope))))


def _function_type(value: FunType, scope: Scope) -> Layout:
    domain: Layout
    if binds(value.result):
        name = variable(value, scope)
        of = layout_of(value.domain, scope)
        domain = _in_brackets(Line((Word(name, "variable"), _COLON, of)))
    else:
        name, domain = "", _tight(value.domain, scope)
    result = _operand(value.result, (name, *scope))
    return _in_brackets(Chain(Sign(" → "), (domain, result)))


def _head(function: Object, scope: Scope) -> Layout:
    """The function that is applied, in brackets unless it binds tightly enough."""
    if isinstance(function, Path | str):
        return Word(format_head(function, scope), _role(function))
    layout = layout_of(function, scope)
    return layout if holds_as_head(function) else _in_brackets(layout)
