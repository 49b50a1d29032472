r"""Draws layouts as LaTeX that needs only amsmath, for MathJax 2, 3 and KaTeX, too.

These four disagree about what may stand in \text, so names are set as mathematics,
letter by letter, where they agree about an escaped underscore. Macros that MathJax and
KaTeX define by other macros, such as \quad or \boxed, are not used: in long formulas
they are taken for an endless expansion.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ttr.display.layout import (
    Bracketed,
    Chain,
    Folded,
    Layout,
    Line,
    Matrix,
    Role,
    Row,
    Sign,
    Step,
    Subscript,
    Superscript,
    Word,
    fill_lines,
)
from ttr.escapes import terminal_line
from ttr.safety.budgets import spend

_ROOM = 90
"""A meet or a list that is wider than this is broken into lines."""


def layout_as_latex(layout: Layout) -> str:
    """The layout as mathematics, without the dollars around it."""
    return guard_fonts(latex_of(layout))


_SHORT = 5_000
"""A formula of at most this length needs no guard for MathJax 2."""


def guard_fonts(text: str) -> str:
    """The formula with each font command inside an argument, if it is long.

    To MathJax 2 font commands are macros, and it expands a macro only if at most 5,120
    characters follow. Inside an argument none do.
    """
    if len(text) <= _SHORT:
        return text
    return re.sub(r"\\(?:mathrm|mathit|textit)\{[^{}]*\}", r"\\mathord{\g<0>}", text)


def latex_of(layout: Layout) -> str:
    """The layout as a part of a formula."""
    spend()
    match layout:
        case Word(text, role):
            return latex_text(text, role)
        case Sign(text):
            return _sign(text)
        case Superscript(base, exponent):
            return f"{latex_of(base)}^{{{latex_of(exponent)}}}"
        case Subscript(base, value):
            return f"{{{latex_of(base)}}}_{{{latex_of(value)}}}"
        case Line(parts):
            return "".join(map(latex_of, parts))
        case Chain():
            return _chain(layout)
        case Bracketed():
            return _list(layout)
        case Folded(_, inside):
            return latex_of(inside)
        case Matrix():
            return _matrix(layout)


def derivation_as_latex(step: Step) -> str:
    r"""The derivation as an array: a mark, √ or ×, then the claim, then the reason.

    What a step rests on stands below it, indented; the first step that fails is
    underlined.
    """
    return guard_fonts(derivation_rows(step))


def derivation_rows(step: Step) -> str:
    """The array of a derivation, as a part of a formula."""
    return array("ll", _steps(step, 0))


def _steps(step: Step, depth: int) -> Iterator[str]:
    mark = _MARKS.get(step.mark) or latex_text(step.mark, "text")
    where = f"{latex_text(step.where, 'label')}{{:}}\\text{{ }}" if step.where else ""
    claim = where + _in_row(step.claim)
    if step.fails and not any(part.fails for part in step.parts):
        claim = f"\\underline{{{claim}}}"
    indent = f"\\kern{depth}em " if depth else ""
    yield f"{mark} & {indent}{claim}\\kern1em {latex_text(f'({step.because})')}"
    for part in step.parts:
        yield from _steps(part, depth + 1)


_MARKS = {"✓": "\\surd", "✗": "\\times"}


# --- matrices, chains and lists ------------------------------------------------------


def array(format_of_columns: str, rows: Iterable[str]) -> str:
    """Rows with a little space between; without it, a [ below would be an option."""
    lines = " \\\\[2pt]\n".join(rows)
    return f"\\begin{{array}}{{{format_of_columns}}}\n{lines}\n\\end{{array}}"


def _matrix(matrix: Matrix) -> str:
    sign = matrix.sign.text.strip()
    rows = [f"{_name(row)} & {sign} & {_in_row(row.has)}" for row in matrix.rows]
    return enclose("[", array("lcl", rows), "]")


def _name(row: Row) -> str:
    """What stands before the sign of the matrix."""
    if row.manifest is None:
        return latex_of(row.label)
    return f"{latex_of(row.label)} = {_in_row(row.manifest)}"


def _in_row(layout: Layout) -> str:
    """A layout in a row; invisible indices keep a tall one from touching the next."""
    if not layout.tall:
        return latex_of(layout)
    return keep_apart(latex_of(layout))


def keep_apart(drawn: str) -> str:
    """A tall formula with invisible indices, which keep it from touching the next."""
    return f"{{{drawn}}}^{{\\vphantom{{(}}}}_{{\\vphantom{{(}}}}"


def _chain(chain: Chain) -> str:
    sign = _sign(chain.sign.text)
    if chain.width <= _ROOM:
        return sign.join(map(latex_of, chain.parts))
    first, *others = map(_in_row, chain.parts)
    if not chain.sign.text.strip():
        return array("l", [first, *[f"\\kern1em {part}" for part in others]])
    lead = f"{{}}{sign}{{}}"
    return array(
        "l", [f"\\phantom{{{lead}}}{first}", *[f"{lead}{part}" for part in others]]
    )


def _list(listed: Bracketed) -> str:
    between = _sign(listed.between.text)
    lines = [
        between.join(map(latex_of, line))
        for line in fill_lines(listed.parts, listed.between, _ROOM)
    ]
    if len(lines) > 1:
        inside = array("l", [*[line + between for line in lines[:-1]], lines[-1]])
        return enclose(listed.opening, inside, listed.closing)
    if listed.tall:
        return enclose(listed.opening, "".join(lines), listed.closing)
    opening, closing = _BRACKETS[listed.opening], _BRACKETS[listed.closing]
    return f"{opening}{''.join(lines)}{closing}"


def enclose(opening: str, inside: str, closing: str) -> str:
    """The formula in brackets as tall as it is."""
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
    r"""A text from outside as LaTeX, in mathematics; none of it acts as a command.

    A name is set in the font of its role: types slanted, all others upright. A remark,
    which has no role, is set as text, with signs for what is special in LaTeX. What
    cannot be seen is escaped as in a terminal.

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
"""Signs of arithmetic and logic that plain LaTeX does not take in a text."""

_SPECIAL = "_%&#${}~^\\`<>"
"""Characters that are special in LaTeX."""

_PIECE = re.compile(f"[^{re.escape(_SPECIAL)}{''.join(_MATHS)}]+|.", re.DOTALL)
