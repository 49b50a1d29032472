"""Where in the text of a rule a label stands."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from ttr.errors import Span
from ttr.updates.checks.python_sources import Source, source_of
from ttr.updates.checks.state_layout import Labels
from ttr.updates.rules import Body, Rule

__all__ = ["place"]


def place(rule: Rule, label: str, path: Labels = (), role: str = "") -> Span | None:
    """The place of a label in a rule, as part of a path if it is written so.

    In Python it is looked for where the `role` is given to the decorator; in a file,
    without a role, in the body first. Where it is not written in the rule itself, it is
    the place of the rule.
    """
    if isinstance(rule.effect, Body):
        return _in_text(rule, label, path, role) or rule.span
    source = source_of(rule.effect)
    found = None if source is None else _in_decorator(source, label, role)
    return found or rule.span


# --- in files of rules ---------------------------------------------------------------


def _in_text(rule: Rule, label: str, path: Labels, role: str) -> Span | None:
    """The label in the text of the rule: as the end of the path, as a field, or so."""
    if rule.span is None:
        return None
    dotted = r"\s*\.\s*".join(map(re.escape, path))
    field, word = rf"\b{label}(?=\s*[:=])", rf"\b{label}\b"
    plain = _QUOTED.sub(_blank, rule.text)
    starts = (0,) if role else (plain.rindex(":="), 0)
    for pattern in (rf"(?<![\w.]){dotted}\b", field, word)[not path :]:
        for start in starts:
            found = re.compile(pattern).search(plain, start)
            if found:
                return _within(rule, rule.span, found.end() - len(label), found.end())
    return None


_QUOTED = re.compile(r"""(["'])(?:\\.|(?!\1)[^\\\n])*\1|#.*""")
"""What says nothing of the state: words in quotes, and comments."""


def _blank(found: re.Match[str]) -> str:
    return " " * len(found[0])


def _within(rule: Rule, start: Span, first: int, last: int) -> Span:
    """The place of some characters of a rule's text, which starts at a place."""
    indented = " " * (start.column - 1) + rule.text
    shift = start.column - 1
    inner = Span.of(start.source, indented, first + shift, last + shift)
    text = start.text if inner.line == 1 else inner.text
    line = start.line + inner.line - 1
    return Span(inner.source, line, inner.column, inner.length, text)


# --- in Python -----------------------------------------------------------------------


def _in_decorator(source: Source, label: str, role: str) -> Span | None:
    """The label in what the decorator is given, or where a name there is defined."""
    for decorator in getattr(source.node, "decorator_list", ()):
        keywords = decorator.keywords if isinstance(decorator, ast.Call) else ()
        for keyword in keywords:
            if keyword.arg == role:
                return _labelled(source, keyword.value, label)
    return None


def _labelled(source: Source, node: ast.expr, label: str) -> Span | None:
    if isinstance(node, ast.Name):
        return next(_definitions(source, node.id, label), None)
    for inner in ast.walk(node):
        match inner:
            case ast.keyword(arg) if arg == label:
                return source.label_span(inner, label)
            case ast.Constant(str(text)) if label in text.split("."):
                return source.span(inner)
    return None


def _definitions(source: Source, name: str, label: str) -> Iterator[Span]:
    """The label where a name is given its value in the same file."""
    for statement in source.module.body:
        match statement:
            case ast.Assign([ast.Name(target)], value) if target == name:
                found = None
                if not isinstance(value, ast.Name):
                    found = _labelled(source, value, label)
                if found:
                    yield found
