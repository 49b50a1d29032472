"""Draws layouts as text on several lines, with brackets as tall as what they hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ttr.display.layout import (
    Bracketed,
    Chain,
    Folded,
    Layout,
    Line,
    Matrix,
    Row,
    Sign,
    Step,
    Subscript,
    Superscript,
    Word,
    fill_lines,
)
from ttr.escapes import columns
from ttr.safety.budgets import spend

_LEAST = 24
"""Every part gets at least this many columns, however deep inside it stands."""


@dataclass(frozen=True)
class _Block:
    """Lines of the same width; words beside the block stand on its line `base`."""

    lines: tuple[str, ...]
    width: int
    base: int

    @classmethod
    def of(cls, text: str) -> _Block:
        """A text of one line."""
        return cls((text,), columns(text), 0)

    @property
    def below(self) -> int:
        """The number of lines below the base."""
        return len(self.lines) - 1 - self.base


def layout_as_text(layout: Layout, room: int) -> str:
    """The layout as text, in `room` columns if that is possible."""
    return _text(_draw(layout, room))


def derivation_as_text(step: Step, room: int) -> str:
    """The derivation as an indented tree, each claim above what it rests on."""
    return "\n".join([_text(block) for block in _steps(step, "", room)])


def _steps(step: Step, indent: str, room: int) -> Iterator[_Block]:
    where = f"{step.where}: " if step.where else ""
    start = _Block.of(f"{indent}{step.mark} {where}")
    claim = _draw(step.claim, max(_LEAST, room - start.width))
    yield _beside([start, claim, _Block.of(f"   ({step.because})")])
    for part in step.parts:
        yield from _steps(part, indent + "  ", room)


def _text(block: _Block) -> str:
    return "\n".join([line.rstrip() for line in block.lines])


# --- blocks --------------------------------------------------------------------------


def _beside(blocks: Iterable[_Block]) -> _Block:
    """The blocks from left to right, on one base line."""
    row = list(blocks)
    if len(row) == 1:
        return row[0]
    above = max([block.base for block in row])
    below = max([block.below for block in row])
    columns_of_lines = [_padded_lines(block, above, below) for block in row]
    lines = tuple(["".join(line) for line in zip(*columns_of_lines, strict=True)])
    return _Block(lines, sum(block.width for block in row), above)


def _padded_lines(block: _Block, above: int, below: int) -> Sequence[str]:
    """The lines of the block, with this many lines above and below its base."""
    if block.base == above and block.below == below:
        return block.lines
    empty = " " * block.width
    over, under = above - block.base, below - block.below
    return [empty] * over + list(block.lines) + [empty] * under


def _below(blocks: Iterable[_Block]) -> _Block:
    """The blocks from top to bottom; the middle line is their base."""
    stack = list(blocks)
    width = max([block.width for block in stack])
    lines = [
        line + " " * (width - block.width) for block in stack for line in block.lines
    ]
    return _Block(tuple(lines), width, (len(lines) - 1) // 2)


_TALL = {
    "[": ("⎡", "⎢", "⎢", "⎣"),
    "]": ("⎤", "⎥", "⎥", "⎦"),
    "(": ("⎛", "⎜", "⎜", "⎝"),
    ")": ("⎞", "⎟", "⎟", "⎠"),
    "{": ("⎧", "⎪", "⎨", "⎩"),
    "}": ("⎫", "⎪", "⎬", "⎭"),
    "<": (" ", " ", "⟨", " "),
    ">": (" ", " ", "⟩", " "),
}
"""Brackets of several lines: the top, between, on the base line, the bottom."""


def _flat(bracket: str) -> str:
    return {"<": "⟨", ">": "⟩"}.get(bracket, bracket)


def _enclose(opening: str, block: _Block, closing: str) -> _Block:
    return _beside([_bracket(opening, block), block, _bracket(closing, block)])


def _bracket(sign: str, block: _Block) -> _Block:
    height = len(block.lines)
    if height == 1:
        return _Block.of(_flat(sign))
    top, between, middle, bottom = _TALL[sign]
    lines = [top] + [between] * (height - 2) + [bottom]
    if middle != between and (0 < block.base < height - 1 or between == " "):
        lines[block.base] = middle
    return _Block(tuple(lines), 1, block.base)


# --- layouts -------------------------------------------------------------------------


def _draw(layout: Layout, room: int) -> _Block:
    spend()
    match layout:
        case Word(text, _) | Sign(text):
            return _Block.of(text)
        case Superscript(base, exponent):
            return _Block.of(f"{base.text}^{exponent.text}")
        case Subscript(base, value):
            return _in_line((base, Sign("@"), value), room)
        case Line(parts):
            return _in_line(parts, room)
        case Chain():
            return _chain(layout, room)
        case Bracketed():
            return _list(layout, room)
        case Folded(_, inside):
            return _draw(inside, room)
        case Matrix():
            return _matrix(layout, room)


def _in_line(parts: Sequence[Layout], room: int) -> _Block:
    """The parts side by side, each in the room that those after it leave."""
    after = sum(part.width for part in parts)
    blocks = []
    for part in parts:
        after -= part.width
        block = _draw(part, max(_LEAST, room - min(after, room // 2)))
        room -= block.width
        blocks.append(block)
    return _beside(blocks)


def _chain(chain: Chain, room: int) -> _Block:
    sign = chain.sign.text
    if chain.width <= room:
        blocks = [_draw(part, room) for part in chain.parts]
        return _beside(_interleave(_Block.of(sign), blocks))
    lead = _Block.of(sign.strip().ljust(2))
    rest = max(_LEAST, room - lead.width)
    first, *others = [_draw(part, rest) for part in chain.parts]
    if sign.strip():
        first = _beside([_Block.of(" " * lead.width), first])
    return _below([first, *[_beside([lead, block]) for block in others]])


def _interleave(between: _Block, blocks: Iterable[_Block]) -> Iterator[_Block]:
    """The blocks, with a block between every two."""
    for number, block in enumerate(blocks):
        if number:
            yield between
        yield block


def _list(listed: Bracketed, room: int) -> _Block:
    if not listed.parts:
        return _Block.of(_flat(listed.opening) + _flat(listed.closing))
    rest = max(_LEAST, room - 2)
    lines = list(fill_lines(listed.parts, listed.between, rest))
    between = _Block.of(listed.between.text)
    at_end = _Block.of(listed.between.text.rstrip())
    rows = []
    for number, line in enumerate(lines):
        blocks = [*_interleave(between, [_draw(part, rest) for part in line])]
        if number < len(lines) - 1:
            blocks.append(at_end)
        rows.append(_beside(blocks))
    return _enclose(listed.opening, _below(rows), listed.closing)


def _matrix(matrix: Matrix, room: int) -> _Block:
    """The fields one below the other, with their signs in one column."""
    rest = max(_LEAST, room - 2)
    fits = matrix.width <= room
    names = [_name(row, rest if fits else rest // 2) for row in matrix.rows]
    width = max([name.width for name in names])
    rest = max(_LEAST, rest - width - matrix.sign.width)
    rows = []
    for name, row in zip(names, matrix.rows, strict=True):
        sign = _Block.of(" " * (width - name.width) + matrix.sign.text)
        rows.append(_beside([name, sign, _draw(row.has, rest)]))
    return _enclose("[", _below(rows), "]")


def _name(row: Row, room: int) -> _Block:
    """What stands before the sign of the matrix."""
    label = _Block.of(row.label.text)
    if row.manifest is None:
        return label
    sign = _Block.of(" = ")
    value = _draw(row.manifest, max(_LEAST, room - label.width - sign.width))
    return _beside([label, sign, value])
