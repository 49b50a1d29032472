"""Draws what values are shown as: the parts of `ttr.showing` as LaTeX.

Folds are open on paper, and a picture has no LaTeX.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

from ttr.display.latex import (
    array,
    derivation_rows,
    enclose,
    guard_fonts,
    keep_apart,
    latex_of,
    latex_text,
)
from ttr.display.pieces import Naming, layout_of_value, step_of
from ttr.display.room import OF_ONE, room_for, shorten
from ttr.judging.judgements import Why
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


def parts_as_latex(part: Part) -> str | None:
    """The part as mathematics, without the dollars around it; None for a picture."""
    kept = _without_pictures(part)
    if kept is None:
        return None
    drawing = _Drawing(Naming(None))
    whole = drawing.value(kept) if isinstance(kept, Value) else drawing.draw(kept)
    return guard_fonts(whole)


def _without_pictures(part: Part) -> Part | None:
    """What is left of a part without its pictures, if anything is."""
    match part:
        case Figure():
            return None
        case Beside(parts) | Below(parts):
            kept = [it for it in map(_without_pictures, parts) if it is not None]
            if len(kept) < 2:
                return kept[0] if kept else None
            return replace(part, parts=tuple(kept))
        case Fold(_, inner):
            left = _without_pictures(inner)
            return None if left is None else replace(part, body=left)
        case In(_, inner):
            left = _without_pictures(inner)
            return None if left is None else replace(part, part=left)
    return part


@dataclass(frozen=True)
class _Drawing:
    """How parts are drawn: by the names of a theory, if there is one."""

    naming: Naming

    def draw(self, part: Part) -> str:
        match part:
            case Text():
                return latex_text(shorten(part.text))
            case Value():
                return keep_apart(self.value(part))
            case Beside(parts):
                return "\\kern1em ".join(map(self.draw, parts))
            case Below(parts):
                return array("l", map(self.draw, parts))
            case Fields(rows):
                lines = [
                    f"{latex_text(name, 'label')} & : & {self.draw(inner)}"
                    for name, inner in rows
                ]
                return enclose("[", array("lcl", lines), "]")
            case Table():
                return self._table(part)
            case Fold(summary, body):
                return array("l", [latex_text(summary), self.draw(body)])
            case Figure():
                return latex_text(part.about)
            case In(theory, inner):
                return _Drawing(Naming(cast(Signature, theory))).draw(inner)

    def value(self, part: Value) -> str:
        """A type, an object, a judgement or a derivation."""
        to_layout = self.naming.layouts(part.unfold)
        with room_for(OF_ONE):
            if isinstance(part.value, Why):
                return derivation_rows(step_of(part.value, to_layout))
            scope = (frozenset(part.free),) if part.free else ()
            return latex_of(layout_of_value(part.value, to_layout, scope))

    def _table(self, part: Table) -> str:
        rows = [" & ".join(map(self.draw, row)) for row in part.rows]
        if any(part.heads):
            heads = [f"\\underline{{{latex_text(it)}}}" for it in part.heads]
            rows.insert(0, " & ".join(heads))
        if part.more:
            rows.append(latex_text(f"… {part.more:,} more"))
        columns = max(map(len, (part.heads, *part.rows)))
        return array("l" * columns, rows)
