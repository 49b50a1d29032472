"""Types, objects, judgements and derivations as layouts, by the names of a theory."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from types import BuiltinFunctionType, FunctionType, ModuleType, NoneType

from ttr.display.abbreviations import abbreviator
from ttr.display.layout import Layout, Line, Sign, Step, Word, layout_of
from ttr.display.room import cut, ellipsis
from ttr.errors import IllFormedError
from ttr.judging.judgements import Judgement, Why, mark
from ttr.showing import NotebookValue
from ttr.signature.signature import Signature
from ttr.types.interning import Node
from ttr.types.objects import Object, Record, freeze
from ttr.types.printing import Scope, as_object

ToLayout = Callable[[Object, Scope], Layout]
"""Lays out an object, in the scope of what is around it."""


def layout_function(theory: Signature | None, unfold: int | None) -> ToLayout:
    """Lays out objects with the theory's names after so many levels of definitions."""
    fold = abbreviator(theory, unfold)
    text = theory.spelling if isinstance(theory, Signature) else ()

    def to_layout(value: Object, scope: Scope = ()) -> Layout:
        folded = fold(value)
        around = (*scope, *fold.spelling(text))
        return layout_of(as_object(folded, scope) if scope else folded, around)

    return to_layout


@dataclass(frozen=True)
class Naming:
    """How values are laid out by the names of a theory, if there is one."""

    theory: Signature | None
    _made: dict[int | None, ToLayout] = field(default_factory=dict)

    def layouts(self, unfold: int | None) -> ToLayout:
        """What lays out objects; in a theory, names stand for all definitions."""
        if self.theory is not None and unfold is None:
            unfold = 0
        if unfold not in self._made:
            self._made[unfold] = layout_function(self.theory, unfold)
        return self._made[unfold]


def layout_of_value(value: object, to_layout: ToLayout, scope: Scope = ()) -> Layout:
    """The layout of a type, an object or a judgement."""
    if not isinstance(value, Judgement):
        return to_layout(freeze(value), scope)
    degree = (Word("p", "variable"), Sign(" = "), Word(str(value.p), "text"))
    claim = _claim(value, to_layout)
    return Line((*claim.parts, Sign("   "), *degree))


_OF_PYTHON = (NoneType, type, FunctionType, BuiltinFunctionType, ModuleType)
"""Kinds of Python objects that nobody means to draw."""


def drawable(value: object) -> object:
    """The judgement itself, or the value as an object.

    Raises `IllFormedError` for what is no value of the theory: a function, a module, …
    A value that has a `record`, such as a meaning, is drawn as this record.
    """
    kept = isinstance(value, Node | Record | Judgement)
    behind = None if kept else getattr(value, "record", None)
    found = behind if isinstance(behind, Record) else freeze(value)
    kind: type = type(found)
    is_ours = kind.__module__.startswith("ttr.")
    if isinstance(found, _OF_PYTHON) or (
        is_ours and (not isinstance(found, NotebookValue) or has_parts(found))
    ):
        raise IllFormedError(
            "types, objects, judgements and derivations are drawn, "
            f"found {kind.__name__}"
        )
    return found


def has_parts(value: object) -> bool:
    """Does the value say what it is shown as (`ttr.showing`)?"""
    return hasattr(type(value), "_shown_as_")


def _claim(value: Judgement | Why, to_layout: ToLayout) -> Line:
    return Line((to_layout(value.sit, ()), Sign(" : "), to_layout(value.type, ())))


# --- derivations ---------------------------------------------------------------------


def step_of(why: Why, to_layout: ToLayout) -> Step:
    """A derivation; it points at what fails only if the claim certainly fails."""
    return _follow(why, to_layout, why.failure() if why.p.lo == 0.0 else None)


def _follow(why: Why, to_layout: ToLayout, failing: Why | None) -> Step:
    """The step and those below it; `failing` is the one of them that fails, if any."""
    branch = _part_with(why, failing)
    shown, left = cut(why.parts, len(why.parts))
    parts = [_follow(p, to_layout, failing if p is branch else None) for p in shown]
    if left:
        parts.append(Step("…", "", Word(ellipsis(left), "text"), "", (), fails=False))
    return Step(
        mark(why.p),
        why.where,
        _claim(why, to_layout),
        why.because,
        tuple(parts),
        fails=failing is not None,
    )


def _part_with(why: Why, failing: Why | None) -> Why | None:
    """The part that contains the failing step, if there is one."""
    if failing is None or why is failing:
        return None
    return next(part for part in why.parts if part.failure() is failing)
