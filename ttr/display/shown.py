"""Several values in one picture, as a notebook shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ttr.display.pieces import drawable, has_parts
from ttr.display.render import box
from ttr.judging.judgements import Why
from ttr.showing import (
    Beside,
    In,
    NotebookValue,
    Part,
    Text,
    Value,
    beside,
    table,
)
from ttr.signature.signature import Signature


@dataclass(frozen=True, eq=False, repr=False)
class Shown(NotebookValue):
    """What `show` gives: values that a notebook draws, and that print as text.

    `values` are those that were given; mappings have the names above their values.
    """

    values: tuple[object, ...]
    unfold: int | None = None
    theory: Signature | None = None

    def _shown_as_(self) -> Part:
        shown = Beside(tuple([self._part(value) for value in self.values]))
        return shown if self.theory is None else In(self.theory, shown)

    def _part(self, value: object) -> Part:
        if has_parts(value):
            return value._shown_as_()  # type: ignore[attr-defined, no-any-return]
        if isinstance(value, Mapping):
            return table(
                ("", ""),
                value.items(),
                lambda it: (Text(str(it[0]), "code"), self._part(it[1])),
            )
        if type(value) in (list, tuple):
            return beside(*map(self._part, value))  # type: ignore[call-overload]
        kept = value if isinstance(value, Why) else drawable(value)
        return Value(kept, unfold=self.unfold)

    def __repr__(self) -> str:
        return "\n".join(self._lines(self.values))

    def _lines(self, values: object) -> list[str]:
        if isinstance(values, Mapping):
            return [
                line
                for name, value in values.items()
                for line in (f"{name}:", *self._lines([value]))
            ]
        lines: list[str] = []
        for value in values:  # type: ignore[attr-defined]
            if type(value) in (list, tuple) or isinstance(value, Mapping):
                lines += self._lines(value)
            elif has_parts(value):
                lines.append(str(value))
            else:
                lines.append(box(value, unfold=self.unfold, theory=self.theory))
        return lines


def show(
    *values: object, unfold: int | None = None, theory: Signature | None = None
) -> Shown:
    """Values side by side, as a notebook draws them; `print` gives them as text.

    A value is all that a notebook draws, or a list, a tuple or a mapping of such: a
    Python list of types has no picture of its own. For `unfold`, `theory` and errors
    see `box`.

    >>> from ttr import Ind, Pred, rectype, this
    >>> dog = Pred("dog", Ind)
    >>> show([Ind, dog("fido")], rectype(x=Ind, c=dog(this.x)))
    Ind
    dog(fido)
    ⎡x : Ind   ⎤
    ⎣c : dog(x)⎦
    """
    shown = Shown(values, unfold, theory)
    shown._shown_as_()  # raises for what cannot be drawn
    return shown
