"""How values are laid out, whatever they are drawn with: words, rows and matrices.

`laid_out` turns a type or object into a few kinds of layout; text, LaTeX and HTML each
draw these. Read in one line, a layout has the words and signs of the notation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

from ttr.escapes import columns, terminal_line
from ttr.safety.budgets import spend
from ttr.types.paths import parts as contents
from ttr.types.precedence import (
    WORDS,
    begins_with_bracket,
    binds,
    holds_as_head,
    is_loose,
    is_loose_beside,
)
from ttr.types.printing import Scope, as_object, head, notation, variable
from ttr.types.syntax import (
    BOUND,
    Application,
    Basic,
    EventString,
    FiniteSet,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    Negation,
    NonEmpty,
    Object,
    Operation,
    Path,
    Plus,
    Pred,
    PType,
    Record,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
)

__all__ = [
    "Chain",
    "Layout",
    "Line",
    "Listed",
    "Matrix",
    "Raised",
    "Restricted",
    "Role",
    "Row",
    "Sign",
    "Step",
    "Word",
    "fill_lines",
    "laid_out",
]

Role = Literal["type", "predicate", "label", "object", "variable", "text"]
"""What a word names, so that a form can set it in the usual letters."""


# --- kinds of layout -----------------------------------------------------------------
#
# `width` is how many columns a layout takes where it need not be broken, and `tall`
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
class Raised:
    """A base with a number above: Type¹."""

    base: Word
    exponent: Word
    tall = False

    @property
    def width(self) -> int:
        """The columns it takes, with a sign between."""
        return self.base.width + 1 + self.exponent.width


@dataclass(frozen=True)
class Restricted:
    """A base with an object below: the singleton type T@a."""

    base: Layout
    value: Layout

    @cached_property
    def width(self) -> int:
        """The columns it takes, with a sign between."""
        return self.base.width + 1 + self.value.width

    @cached_property
    def tall(self) -> bool:
        """Whether a part is."""
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
        """Whether a part is."""
        return any(part.tall for part in self.parts)


@dataclass(frozen=True)
class Chain:
    """Parts with a sign between; where they are too wide, one below the other."""

    sign: Sign
    parts: tuple[Layout, ...]

    @cached_property
    def width(self) -> int:
        """The columns it takes."""
        between = self.sign.width * (len(self.parts) - 1)
        return sum(part.width for part in self.parts) + between

    @cached_property
    def tall(self) -> bool:
        """Whether a part is."""
        return any(part.tall for part in self.parts)


@dataclass(frozen=True)
class Listed:
    """Parts in brackets; where they are too wide, on several lines."""

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
        """Whether a part is."""
        return any(part.tall for part in self.parts)


@dataclass(frozen=True)
class Row:
    """A field: a label, for a manifest field its object, and what the label has.

    One that has `changed` stands out where there are colours.
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
        """Whether a part is."""
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
        """Whether it has several fields, or a field that is."""
        return len(self.rows) > 1 or self.rows[0].tall


Layout: TypeAlias = Word | Sign | Raised | Restricted | Line | Chain | Listed | Matrix


@dataclass(frozen=True)
class Step:
    """A step of a derivation: its mark, what is claimed, because of what, from what.

    `fails` holds for the step at the bottom that fails first, and for those above it.
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
    """The parts in lines of at most so many columns, or of one part."""
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


# --- values --------------------------------------------------------------------------


_COMMA = Sign(", ")
_COLON = Sign(" : ")


def laid_out(value: Object, scope: Scope = ()) -> Layout:
    """The layout of a type or object, with names as the notation chooses them."""
    spend(4)  # what is laid out is kept, and typeset after that
    match value:
        case Basic(name) | Universe(name, 0):
            return Word(name, "type")
        case Universe(name, level):
            return Raised(Word(name, "type"), Word(str(level), "text"))
        case Pred(name):
            return Word(name, "predicate")
        case PType(pred, args):
            return _call(Word(pred.name, "predicate"), _objects(args, scope))
        case RecordType(()):
            return Word("Rec", "type")
        case RecordType(fields):
            inner = (frozenset(value.labels), *scope)
            rows = tuple([_row(k, T, inner) for k, T in fields])
            return Matrix("[", _COLON, rows, "]")
        case Singleton(base, obj):
            return Restricted(_tight(base, scope), _tight_object(obj, scope))
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
        case ListOf() | NonEmpty() | SetOf() | Plus() | Str():
            types, _ = contents(value)
            word = Word(WORDS[type(value)], "text")
            return _call(word, tuple([laid_out(T, scope) for T in types]))
    return _object(value, scope)


def _object(value: Object, scope: Scope) -> Layout:
    spend()
    match value:
        case Record() if len(value):
            fields = sorted(value._fields.items())
            labels = [Word(label, "label") for label, _ in fields]
            values = _objects([v for _, v in fields], scope)
            rows = [Row(k, None, v) for k, v in zip(labels, values, strict=True)]
            return Matrix("{", Sign(" = "), tuple(rows), "}")
        case FiniteSet(items) if items:
            return Listed("{", _objects(items, scope), "}", _COMMA)
        case EventString(items):
            return _string(items, scope)
    if type(value) is tuple:
        return Listed("[", _objects(value, scope), "]", _COMMA)
    return Word(notation(value, scope), _role(value))


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
            return Row(Word(label, "label"), given, laid_out(base, scope))
    return Row(Word(label, "label"), None, laid_out(field, scope))


def _objects(values: Iterable[Object], scope: Scope) -> tuple[Layout, ...]:
    return tuple([laid_out(as_object(v, scope), scope) for v in values])


def _call(applied: Layout, args: tuple[Layout, ...]) -> Line:
    return Line((applied, Listed("(", args, ")", _COMMA)))


def _string(items: Sequence[Object], scope: Scope) -> Listed:
    """<a b>, with commas where an event could be read as an argument of the last."""
    events = [as_object(item, scope) for item in items]
    between = _COMMA if any(map(begins_with_bracket, events)) else Sign(" ")
    return Listed("<", tuple([_tight(it, scope) for it in events]), ">", between)


# --- brackets, functions and their variables -----------------------------------------


def _bracketed(layout: Layout) -> Layout:
    return Listed("(", (layout,), ")", _COMMA)


def _operand(value: Object, scope: Scope) -> Layout:
    """A part of a meet, join or negation: in brackets unless it binds closer."""
    layout = laid_out(value, scope)
    return _bracketed(layout) if is_loose(value) else layout


def _operands(values: Iterable[Object], scope: Scope) -> tuple[Layout, ...]:
    return tuple([_operand(value, scope) for value in values])


def _tight(value: Object, scope: Scope) -> Layout:
    """A part beside @, + or an arrow: in brackets unless it holds together."""
    layout = laid_out(value, scope)
    return _bracketed(layout) if is_loose_beside(value) else layout


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
        of = laid_out(value.domain, scope)
        domain = _bracketed(Line((Word(name, "variable"), _COLON, of)))
    else:
        name, domain = "", _tight(value.domain, scope)
    result = _operand(value.result, (name, *scope))
    return _bracketed(Chain(Sign(" → "), (domain, result)))


def _head(function: Object, scope: Scope) -> Layout:
    """What is applied: as it is printed, in brackets unless it holds together."""
    if isinstance(function, Path | str):
        return Word(head(function, scope), _role(function))
    layout = laid_out(function, scope)
    return layout if holds_as_head(function) else _bracketed(layout)
