r"""Layouts as LaTeX: amsmath is all it needs, and MathJax 2, 3 and KaTeX read it too.

These four differ in what they take inside \text, so names are set letter by letter as
mathematics, where an escaped underscore is the same for all. What MathJax and KaTeX
define as macros by other macros, such as \quad or \boxed, is not used: in long formulas
they count it as endless expansion.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ttr.display.layout import (
    Chain,
    Layout,
    Line,
    Listed,
    Matrix,
    Raised,
    Restricted,
    Role,
    Row,
    Sign,
    Step,
    Word,
    fill_lines,
)
from ttr.escapes import terminal_line
from ttr.safety.budgets import spend

__all__ = ["latex_text", "layout_as_latex", "derivation_as_latex"]

_ROOM = 90
"""So many letters go beside one another before a meet or a list is broken."""


def layout_as_latex(layout: Layout) -> str:
    """The layout as mathematics, without the dollars around it."""
    return _guarded(_typeset(layout))


_SHORT = 5_000
"""So many letters MathJax 2 takes as they are."""


def _guarded(text: str) -> str:
    """The text with its letters as arguments where it is long.

    To MathJax 2 the fonts are macros, which it expands only where at most 5,120 letters
    follow; inside an argument none do.
    """
    if len(text) <= _SHORT:
        return text
    return re.sub(r"\\(?:mathrm|mathit|textit)\{[^{}]*\}", r"\\mathord{\g<0>}", text)


def _typeset(layout: Layout) -> str:
    spend()
    match layout:
        case Word(text, role):
            return latex_text(text, role)
        case Sign(text):
            return _sign(text)
        case Raised(base, exponent):
            return f"{_typeset(base)}^{{{_typeset(exponent)}}}"
        case Restricted(base, value):
            return f"{{{_typeset(base)}}}_{{{_typeset(value)}}}"
        case Line(parts):
            return "".join(map(_typeset, parts))
        case Chain():
            return _chain(layout)
        case Listed():
            return _listed(layout)
        case Matrix():
            return _matrix(layout)


def derivation_as_latex(step: Step) -> str:
    r"""The derivation as an array: √ and × for what holds and fails, then the reason.

    Grounds stand below what they are grounds for, further in; the step that fails first
    is underlined.
    """
    return _guarded(_array("ll", _steps(step, 0)))


def _steps(step: Step, depth: int) -> Iterator[str]:
    mark = _MARKS.get(step.mark) or latex_text(step.mark, "text")
    where = f"{latex_text(step.where, 'label')}{{:}}\\text{{ }}" if step.where else ""
    claim = where + _spaced(step.claim)
    if step.fails and not any(part.fails for part in step.parts):
        claim = f"\\underline{{{claim}}}"
    indent = f"\\kern{depth}em " if depth else ""
    yield f"{mark} & {indent}{claim}\\kern1em {latex_text(f'({step.because})')}"
    for part in step.parts:
        yield from _steps(part, depth + 1)


_MARKS = {"✓": "\\surd", "✗": "\\times"}


# --- matrices, chains and lists ------------------------------------------------------


def _array(format_of_columns: str, rows: Iterable[str]) -> str:
    """Rows with a little space between; so LaTeX looks for none in a list there."""
    lines = " \\\\[2pt]\n".join(rows)
    return f"\\begin{{array}}{{{format_of_columns}}}\n{lines}\n\\end{{array}}"


def _matrix(matrix: Matrix) -> str:
    sign = matrix.sign.text.strip()
    rows = [f"{_name(row)} & {sign} & {_spaced(row.has)}" for row in matrix.rows]
    return _enclosed("[", _array("lcl", rows), "]")


def _name(row: Row) -> str:
    """What stands before the sign of the matrix."""
    if row.manifest is None:
        return _typeset(row.label)
    return f"{_typeset(row.label)} = {_spaced(row.manifest)}"


def _spaced(layout: Layout) -> str:
    """What stands in a row; a tall one would touch the next, but for unseen indices."""
    if not layout.tall:
        return _typeset(layout)
    return f"{{{_typeset(layout)}}}^{{\\vphantom{{(}}}}_{{\\vphantom{{(}}}}"


def _chain(chain: Chain) -> str:
    sign = _sign(chain.sign.text)
    if chain.width <= _ROOM:
        return sign.join(map(_typeset, chain.parts))
    first, *others = map(_spaced, chain.parts)
    if not chain.sign.text.strip():
        return _array("l", [first, *[f"\\kern1em {part}" for part in others]])
    lead = f"{{}}{sign}{{}}"
    return _array(
        "l", [f"\\phantom{{{lead}}}{first}", *[f"{lead}{part}" for part in others]]
    )


def _listed(listed: Listed) -> str:
    between = _sign(listed.between.text)
    lines = [
        between.join(map(_typeset, line))
        for line in fill_lines(listed.parts, listed.between, _ROOM)
    ]
    if len(lines) > 1:
        inside = _array("l", [*[line + between for line in lines[:-1]], lines[-1]])
        return _enclosed(listed.opening, inside, listed.closing)
    if listed.tall:
        return _enclosed(listed.opening, "".join(lines), listed.closing)
    opening, closing = _BRACKETS[listed.opening], _BRACKETS[listed.closing]
    return f"{opening}{''.join(lines)}{closing}"


def _enclosed(opening: str, inside: str, closing: str) -> str:
    return f"\\left{_BRACKETS[opening]}{inside}\\right{_BRACKETS[closing]}"


_BRACKETS = {
    "(": "(",
    ")": ")",
    "[": "[",
    "]": "]",
    "{": "\\{",
    "}": "\\}",
    "<": "\\langle ",
    ">": "\\rangle ",
}


# --- words and signs -----------------------------------------------------------------


_SIGNS = {
    " ∧ ": " \\wedge ",
    " ∨ ": " \\vee ",
    " → ": " \\to ",
    " + ": " + ",
    " = ": " = ",
    " : ": " : ",
    "¬": "\\neg ",
    "λ": "\\lambda ",
    ":": "{:}",
    ".": "{.}",
    ", ": ", ",
    " ": "\\text{ }",
    "   ": "\\kern1em ",
}


def _sign(text: str) -> str:
    return _SIGNS[text]


def latex_text(text: str, role: Role | None = None) -> str:
    r"""A text from outside as LaTeX, in mathematics: it is set, and does nothing else.

    A name is set in the letters of its role, types slanted and all others upright; a
    remark, without a role, as text, with what LaTeX reads otherwise as signs. What
    cannot be seen is written as in a terminal.

    >>> print(latex_text(r"\input{a}", "label"))
    \backslash \mathrm{input}\{\mathrm{a}\}
    >>> print(latex_text(r"by $x^^5e"))
    \text{by }\$\text{x}{}^{\wedge}{}^{\wedge}\text{5e}
    """
    text = terminal_line(text)
    if role is None:
        known = _ESCAPED | _MATHS
        pieces = _PIECE.findall(text)
        return "".join(known.get(it, f"\\text{{{it}}}") for it in pieces)
    font, in_text = ("mathit", "textit") if role == "type" else ("mathrm", "text")
    return "".join(_runs(text, font, in_text))


def _runs(text: str, font: str, in_text: str) -> Iterator[str]:
    for match in re.finditer(r"[A-Za-z0-9]+|[^\W_]+|.", text, flags=re.DOTALL):
        run = match.group()
        if not run.isalnum():
            yield _ESCAPED.get(run) or (run if run.isascii() else f"\\text{{{run}}}")
        elif run.isdigit() and run.isascii():
            yield run if font == "mathrm" else f"\\{font}{{{run}}}"
        elif run.isascii():
            yield f"\\{font}{{{run}}}"
        else:
            yield f"\\{in_text}{{{run}}}"


_ESCAPED = {
    "_": "\\_",
    "%": "\\%",
    "&": "\\& ",
    "#": "\\#",
    "$": "\\$",
    "{": "\\{",
    "}": "\\}",
    "~": "{\\sim}",
    "^": "{}^{\\wedge}",
    "\\": "\\backslash ",
    "`": "\\text{`}",
    "'": "\\text{'}",
    '"': '\\text{"}',
    " ": "\\text{ }",
    ".": "{.}",
    "<": "{< }",
    ">": "{>}",
    "-": "{-}",
    "+": "{+}",
    "*": "{*}",
    "=": "{=}",
    ":": "{:}",
    ",": "{,}",
    ";": "{;}",
    "•": "\\bullet ",
    "[": "{[}",
    "]": "{]}",
}


_MATHS = {
    "−": "-",
    "×": "\\times ",
    "≤": "\\le ",
    "≥": "\\ge ",
    "→": "\\to ",
    "∧": "\\wedge ",
    "∨": "\\vee ",
    "¬": "\\neg ",
    "⊑": "\\sqsubseteq ",
}
"""The signs of arithmetic and logic, which plain LaTeX does not read in a text."""

_SPECIAL = "_%&#${}~^\\`<>"
"""What LaTeX reads otherwise in a text."""

_PIECE = re.compile(f"[^{re.escape(_SPECIAL)}{''.join(_MATHS)}]+|.", re.DOTALL)
