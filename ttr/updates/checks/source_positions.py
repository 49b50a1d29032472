"""Positions of labels in the text of a rule."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from ttr.errors import Span
from ttr.updates.checks.python_sources import Source, source_of
from ttr.updates.checks.state_layout import Labels
from ttr.updates.rules import Body, Rule


def span_of_label(
    rule: Rule, label: str, path: Labels = (), role: str = ""
) -> Span | None:
    """The place of a label in a rule, as part of a path if it is written that way.

    In Python it is searched for in the argument `role` of the decorator; in a file,
    if there is no role, in the body first. Otherwise it is the place of the rule.
    """
    if isinstance(rule.effect, Body):
        return _span_in_text(rule, label, path, role) or rule.span
    source = source_of(rule.effect)
    found = None if source is None else _span_in_decorator(source, label, role)
    return found or rule.span


# --- in files of rules ---------------------------------------------------------------


def _span_in_text(rule: Rule, label: str, path: Labels, role: str) -> Span | None:
    """The label in the text of a rule: at the end of the path, of a field, or alone."""
    if rule.span is None:
        return None
    dotted = r"\s*\.\s*".join(map(re.escape, path))
    field, word = rf"\b{label}(?=\s*[:=])", rf"\b{label}\b"
    plain = _QUOTED.sub(_blanks, rule.text)
    starts = (0,) if role else (plain.rindex(":="), 0)
    for pattern in (rf"(?<![\w.]){dotted}\b", field, word)[not path :]:
        for start in starts:
            found = re.compile(pattern).search(plain, start)
            if found:
                return _span_within(
                    rule, rule.span, found.end() - len(label), found.end()
                )
    return None


_QUOTED = re.compile(r"""(["'])(?:\\.|(?!\1)[^\\\n])*\1|#.*""")
"""Quoted text and comments, which say nothing about the state."""


def _blanks(found: re.Match[str]) -> str:
    return " " * len(found[0])


def _span_within(rule: Rule, start: Span, first: int, last: int) -> Span:
    """The place of the characters `first` to `last` of a rule's text."""
    indented = " " * (start.column - 1) + rule.text
    shift = start.column - 1
    inner = Span.of(start.source, indented, first + shift, last + shift)
    text = start.text if inner.line == 1 else inner.text
    line = start.line + inner.line - 1
    return Span(inner.source, line, inner.column, inner.length, text)


# --- in Python -----------------------------------------------------------------------


def _span_in_decorator(source: Source, label: str, role: str) -> Span | None:
    """The label in an argument of the decorator, or where a name in it is defined."""
    for decorator in getattr(source.node, "decorator_list", ()):
        keywords = decorator.keywords if isinstance(decorator, ast.Call) else ()
        for keyword in keywords:
            if keyword.arg == role:
                return _span_in_expression(source, keyword.value, label)
    return None


def _span_in_expression(source: Source, node: ast.expr, label: str) -> Span | None:
    if isinstance(node, ast.Name):
        return next(_spans_in_definitions(source, node.id, label), None)
    for inner in ast.walk(node):
        match inner:
            case ast.keyword(arg) if arg == label:
                return source.label_span(inner, label)
            case ast.Constant(str(text)) if label in text.split("."):
                return source.span(inner)
    return None


def _spans_in_definitions(source: Source, name: str, label: str) -> Iterator[Span]:
    """The label in the definitions of a name in the same file."""
    for statement in source.module.body:
        match statement:
            case ast.Assign([ast.Name(target)], value) if target == name:
                found = None
                if not isinstance(value, ast.Name):
                    found = _span_in_expression(source, value, label)
                if found:
                    yield found
