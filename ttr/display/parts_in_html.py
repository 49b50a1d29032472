"""Draws what values are shown as: the parts of `ttr.showing` as HTML.

An output has its style with it, once, and needs nothing else: no script, no file, no
network. Colours are those of the page around it, so that it fits a light and a dark
one; what is green or red also has a sign.
"""

from __future__ import annotations

from base64 import b64encode
from dataclasses import dataclass
from typing import cast

from ttr.display.differences import mark_changes
from ttr.display.html import (
    STYLE,
    derivation_markup,
    layout_markup,
    matrix_markup,
)
from ttr.display.layout import Layout, fold_large_fields
from ttr.display.pieces import Naming, ToLayout, layout_of_value, step_of
from ttr.display.room import OF_ONE, room_for, shorten
from ttr.escapes import html_text
from ttr.judging.judgements import Judgement, Why
from ttr.showing import (
    Below,
    Beside,
    Fields,
    Figure,
    Fold,
    In,
    Part,
    Table,
    Text,
    Value,
)
from ttr.signature.signature import Signature
from ttr.types.objects import freeze


def parts_as_html(part: Part) -> str:
    """The part with its style, to be put anywhere in a page."""
    drawn = _Drawing(Naming(None)).draw(part)
    style = STYLE if isinstance(part, Value) else STYLE + PART_STYLE
    return f'<div class="ttr"><style>{style}</style>{drawn}</div>'


PART_STYLE = """
.ttr .ttr-below > * + * { margin-top: .45em; }
.ttr .ttr-beside { display: flex; flex-wrap: wrap; align-items: center;
  gap: .4em 1.2em; }
.ttr .ttr-beside > * { min-width: 0; max-width: 100%; overflow-x: auto; }
.ttr .ttr-strong { font-weight: 600; }
.ttr .ttr-quiet { opacity: .75; }
.ttr .ttr-code { font-family: ui-monospace, SFMono-Regular, Menlo, Consolas, monospace;
  font-size: .92em; white-space: pre-wrap; overflow-wrap: anywhere; }
.ttr .ttr-is-yes::before { content: "✓ "; color: #2e9e4f; }
.ttr .ttr-is-no::before { content: "✗ "; color: #e5484d; }
.ttr .ttr-scroll { overflow-x: auto; max-width: 100%; }
.ttr table.ttr-table { display: table; width: auto; margin: .1em 0; border: 0;
  border-collapse: collapse; table-layout: auto; font-size: inherit;
  color: inherit; background: none; }
.ttr .ttr-table > * > tr, .ttr .ttr-table > * > tr > * { background: none !important;
  color: inherit !important; border: 0; text-align: left !important; max-width: none; }
.ttr .ttr-table > * > tr > * { padding: .25em 1.1em .25em 0; vertical-align: top;
  white-space: normal; font-size: inherit; line-height: inherit; }
.ttr .ttr-table > thead > tr > th { font-weight: 600; font-size: .9em; opacity: .75;
  white-space: nowrap; border-bottom: 1px solid rgba(128, 128, 128, .5); }
.ttr .ttr-table > tbody > tr + tr > td { border-top: 1px solid rgba(128, 128, 128, .25);
  }
.ttr details > summary { cursor: pointer; opacity: .85; }
.ttr .ttr-table .ttr-fold > summary { white-space: nowrap; }
.ttr .ttr-fold > .ttr-inside { margin: .3em 0 .3em .45em; padding-left: .8em;
  border-left: 1px solid rgba(128, 128, 128, .45); }
.ttr .ttr-figure { margin: .2em 0; }
.ttr .ttr-figure img { display: block; max-width: 100%; height: auto; margin: 0;
  border-radius: 3px; }
"""


@dataclass(frozen=True)
class _Drawing:
    """How parts are drawn: by the names of a theory, if there is one."""

    naming: Naming

    def draw(self, part: Part) -> str:
        match part:
            case Text():
                return _text(part)
            case Value():
                return self._value(part)
            case Beside(parts):
                return _block("ttr-beside", "".join(map(self._boxed, parts)))
            case Below(parts):
                return _block("ttr-below", "".join(map(self._boxed, parts)))
            case Fields(rows):
                drawn = [(html_text(name), self.draw(inner)) for name, inner in rows]
                return matrix_markup(drawn)
            case Table():
                return self._table(part)
            case Fold(summary, body, opened):
                is_open = ' open=""' if opened else ""
                inside = _block("ttr-inside", self.draw(body))
                return (
                    f'<details class="ttr-fold"{is_open}>'
                    f"<summary>{html_text(shorten(summary))}</summary>{inside}</details>"
                )
            case Figure():
                return _figure(part)
            case In(theory, inner):
                return _Drawing(Naming(cast(Signature, theory))).draw(inner)

    def _boxed(self, part: Part) -> str:
        return f"<div>{self.draw(part)}</div>"

    def _value(self, part: Value) -> str:
        to_layout = self.naming.layouts(part.unfold)
        with room_for(OF_ONE):
            if isinstance(part.value, Why):
                return derivation_markup(step_of(part.value, to_layout))
            return layout_markup(fold_large_fields(_layout(part, to_layout)))

    def _table(self, part: Table) -> str:
        heads = "".join([f"<th>{html_text(head)}</th>" for head in part.heads])
        head = f"<thead><tr>{heads}</tr></thead>" if any(part.heads) else ""
        rows = [
            "".join([f"<td>{self.draw(cell)}</td>" for cell in row])
            for row in part.rows
        ]
        if part.more:
            more = _text(Text(f"… {part.more:,} more", "quiet"))
            rows.append(f'<td colspan="{max(1, len(part.heads))}">{more}</td>')
        body = "".join([f"<tr>{row}</tr>" for row in rows])
        return (
            '<div class="ttr-scroll"><table class="ttr-table">'
            f"{head}<tbody>{body}</tbody></table></div>"
        )


def _layout(part: Value, to_layout: ToLayout) -> Layout:
    scope = (frozenset(part.free),) if part.free else ()
    layout = layout_of_value(part.value, to_layout, scope)
    if part.before is None or isinstance(part.value, Judgement):
        return layout
    return mark_changes(layout, freeze(part.before), freeze(part.value))


def _text(part: Text) -> str:
    kind = f' class="ttr-{_CLASSES[part.tone]}"' if part.tone != "plain" else ""
    return f"<span{kind}>{html_text(shorten(part.text))}</span>"


_CLASSES = {
    "strong": "strong",
    "quiet": "quiet",
    "code": "code",
    "yes": "is-yes",
    "no": "is-no",
}


def _block(kind: str, inside: str) -> str:
    return f'<div class="{kind}">{inside}</div>'


def _figure(part: Figure) -> str:
    data = b64encode(part.data).decode()
    return (
        f'<figure class="ttr-figure"><img src="data:{part.kind};base64,{data}" '
        f'alt="{html_text(part.about)}" width="{part.width}" /></figure>'
    )
