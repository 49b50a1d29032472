"""Draws layouts as HTML: nested tables with their own style, and no script.

Colours are those of the page. Brackets are drawn as borders; the notation is there as
well, invisible, so that it is what gets copied or read aloud.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
    fold_claim,
)
from ttr.escapes import html_text
from ttr.safety.budgets import spend


def layout_as_html(layout: Layout) -> str:
    """The layout with its style, to be put anywhere in a page."""
    return _with_style(layout_markup(layout))


def derivation_as_html(step: Step) -> str:
    """The derivation as steps that fold; those that fail or are likely are open."""
    return _with_style(derivation_markup(step))


def derivation_markup(step: Step) -> str:
    """The same without its style."""
    return f'<ul class="ttr-why"><li>{_derivation(step)}</li></ul>'


def part_of_page(layout: Layout) -> str:
    """The layout without its style, for a page that has the style already."""
    return f'<div class="ttr">{layout_markup(layout)}</div>'


def page(title: str, body: str, style: str = "") -> str:
    """A whole page around a piece of HTML."""
    styled = f"<style>{style}</style>\n" if style else ""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n'
        f"<title>{html_text(title)}</title>\n{styled}</head>\n<body>\n{body}\n</body>\n"
        "</html>"
    )


STYLE = """
.ttr { position: relative; color: inherit; overflow-x: auto; padding: .2em 0;
  line-height: 1.4; }
.ttr table.ttr-matrix { display: inline-table; width: auto;
  table-layout: auto; margin: .1em .15em;
  vertical-align: middle; border-collapse: separate; border-spacing: 0; border: 0;
  padding: 0 .35em; font-size: inherit; color: inherit; }
.ttr .ttr-tall { display: inline-block; vertical-align: middle; margin: 0 .12em;
  padding: 0 .35em; }
.ttr .ttr-square { background:
    linear-gradient(currentColor, currentColor) 0 0 / 1.5px 100%,
    linear-gradient(currentColor, currentColor) 0 0 / .4em 1.5px,
    linear-gradient(currentColor, currentColor) 0 100% / .4em 1.5px,
    linear-gradient(currentColor, currentColor) 100% 0 / 1.5px 100%,
    linear-gradient(currentColor, currentColor) 100% 0 / .4em 1.5px,
    linear-gradient(currentColor, currentColor) 100% 100% / .4em 1.5px;
  background-repeat: no-repeat; }
.ttr .ttr-round { border: solid currentColor; border-width: 0 1.5px;
  border-radius: .7em; }
.ttr .ttr-big { font-size: 2em; line-height: 1; vertical-align: middle; }
.ttr .ttr-matrix tr, .ttr .ttr-matrix td { background: none !important;
  border: 0 !important; color: inherit; }
.ttr .ttr-matrix td { padding: .1em .2em; text-align: left; vertical-align: middle;
  white-space: nowrap; font-size: inherit; line-height: inherit; max-width: none; }
.ttr .ttr-matrix td:last-child { white-space: normal; }
.ttr .ttr-matrix tr.ttr-changed > td { background: rgba(229, 160, 13, .2) !important; }
.ttr .ttr-matrix tr.ttr-changed > td:first-child { font-weight: bold; }
.ttr .ttr-type { font-style: italic; }
.ttr .ttr-unseen { position: absolute; width: 1px; height: 1px; overflow: hidden;
  clip-path: inset(50%); white-space: pre; }
.ttr ul.ttr-why, .ttr .ttr-why ul { list-style: none; margin: 0; padding: 0; }
.ttr .ttr-why ul { margin-left: .45em; padding-left: 1em;
  border-left: 1px solid rgba(128, 128, 128, .45); }
.ttr .ttr-why li { margin: .1em 0; padding: 0; }
.ttr .ttr-why summary { cursor: pointer; }
.ttr .ttr-why .ttr-folded { display: inline-block; vertical-align: middle; }
.ttr .ttr-why .ttr-folded[open] { vertical-align: top; }
.ttr .ttr-why .ttr-folded > summary { list-style: none;
  text-decoration: underline dotted; text-underline-offset: .2em; }
.ttr .ttr-why .ttr-leaf { padding-left: 1em; }
.ttr .ttr-mark { font-weight: bold; margin-right: .3em; }
.ttr .ttr-yes { color: #2e9e4f; }
.ttr .ttr-no { color: #e5484d; }
.ttr .ttr-fails { background: rgba(229, 72, 77, .13); border-radius: .3em; }
.ttr .ttr-rule { opacity: .75; margin-left: .8em; }
@media (prefers-reduced-transparency: reduce) { .ttr .ttr-rule { opacity: 1; } }
"""


def _with_style(body: str) -> str:
    return f'<div class="ttr"><style>{STYLE}</style>{body}</div>'


# --- values --------------------------------------------------------------------------


def layout_markup(layout: Layout) -> str:
    """The layout inside a piece of HTML that has its style."""
    spend()
    match layout:
        case Word(text, role):
            return f'<span class="ttr-{role}">{html_text(text)}</span>'
        case Sign(text):
            return _sign(text)
        case Superscript(base, exponent):
            above = f"<sup>{html_text(exponent.text)}</sup>"
            return f"{layout_markup(base)}{_unseen('^')}{above}"
        case Subscript(base, value):
            return (
                f"{layout_markup(base)}{_unseen('@')}<sub>{layout_markup(value)}</sub>"
            )
        case Line(parts):
            return "".join(map(layout_markup, parts))
        case Chain(sign, parts):
            return _sign(sign.text).join(map(layout_markup, parts))
        case Bracketed():
            return _list(layout)
        case Folded(summary, inside):
            return (
                f'<details class="ttr-folded"><summary>{layout_markup(summary)}'
                f"</summary>{layout_markup(inside)}</details>"
            )
        case Matrix():
            return _matrix(layout)


def _sign(text: str) -> str:
    return text if text.strip() else text.replace("   ", "\N{EM SPACE}")


def _unseen(text: str) -> str:
    return f'<span class="ttr-unseen">{html_text(text)}</span>'


def _list(listed: Bracketed) -> str:
    inside = html_text(listed.between.text).join(map(layout_markup, listed.parts))
    if not listed.tall:
        return f"{html_text(listed.opening)}{inside}{html_text(listed.closing)}"
    if listed.opening in _DRAWN:
        inside = f"{_unseen(listed.opening)}{inside}{_unseen(listed.closing)}"
        return f'<span class="ttr-tall {_DRAWN[listed.opening]}">{inside}</span>'
    opening, closing = map(html_text, (listed.opening, listed.closing))
    return (
        f'<span class="ttr-big">{opening}</span>{inside}'
        f'<span class="ttr-big">{closing}</span>'
    )


_DRAWN = {"(": "ttr-round", "[": "ttr-square"}
"""Brackets that grow with what they hold; others get a larger font."""


def matrix_markup(rows: Sequence[tuple[str, str]]) -> str:
    """A matrix of names and pieces of HTML."""
    inside = [
        f'<td><span class="ttr-label">{name}</span></td><td>:</td><td>{has}</td>'
        for name, has in rows
    ]
    return _table_of(inside)


def _table_of(rows: Iterable[str]) -> str:
    """A table in square brackets, of rows of cells."""
    body = "".join([f"<tr>{row}</tr>" for row in rows])
    start = '<table class="ttr-matrix ttr-square" role="presentation">'
    return f"{start}<tbody>{body}</tbody></table>"


def _matrix(matrix: Matrix) -> str:
    last = len(matrix.rows) - 1
    sign = matrix.sign.text.strip()
    rows = []
    for number, row in enumerate(matrix.rows):
        before = _unseen(matrix.opening) if number == 0 else ""
        after = _unseen(matrix.closing if number == last else ",")
        cells = (before + _name(row), sign, layout_markup(row.has) + after)
        inside = "".join([f"<td>{cell}</td>" for cell in cells])
        kind = ' class="ttr-changed"' if row.changed else ""
        rows.append(f"<tr{kind}>{inside}</tr>")
    body = "".join(rows)
    start = '<table class="ttr-matrix ttr-square" role="presentation">'
    return f"{start}<tbody>{body}</tbody></table>"


def _name(row: Row) -> str:
    """What stands before the sign of the matrix."""
    if row.manifest is None:
        return layout_markup(row.label)
    return f"{layout_markup(row.label)} = {layout_markup(row.manifest)}"


# --- derivations ---------------------------------------------------------------------


def _derivation(step: Step) -> str:
    claim = _claim(step)
    if not step.parts:
        return f'<div class="ttr-leaf{_class_of_failure(step)}">{claim}</div>'
    parts = "".join([f"<li>{_derivation(part)}</li>" for part in step.parts])
    kind = _class_of_failure(step).strip()
    opened = ' open=""' if step.fails or step.mark not in "✓✗" else ""
    return (
        f'<details{opened}><summary class="{kind}">{claim}</summary>'
        f"<ul>{parts}</ul></details>"
    )


def _class_of_failure(step: Step) -> str:
    return " ttr-fails" if step.fails else ""


def _claim(step: Step) -> str:
    kind = {"✓": " ttr-yes", "✗": " ttr-no"}.get(step.mark, "")
    mark = f'<span class="ttr-mark{kind}">{html_text(step.mark)}</span> '
    where = f'<span class="ttr-label">{html_text(step.where)}</span>: '
    because = f' <span class="ttr-rule">({html_text(step.because)})</span>'
    return (
        mark
        + where * bool(step.where)
        + layout_markup(fold_claim(step.claim))
        + because
    )
