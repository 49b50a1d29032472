"""Signatures as Sphinx reads them, their types by the names that have pages."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ForwardRef

from tools.website.public_names import PublicName, named_in

_LONGEST_DEFAULT = 40


@dataclass(frozen=True)
class Parameter:
    """A parameter as it is written: `*` and `**` stand before its name."""

    name: str
    type: str
    default: str


@dataclass(frozen=True)
class Signature:
    """The parameters of a function and what it returns, types as they are written."""

    text: str
    parameters: tuple[Parameter, ...]
    returns: str
    module: str


def signature_of(value: object, module: str, *, bound: bool = False) -> Signature:
    """The signature of what can be called; empty for what has none, or takes anything.

    >>> def half(x: int, *, exact: bool = False) -> float: ...
    >>> signature_of(half, __name__).text
    '(x: int, *, exact: bool = False) -> float'
    """
    try:
        found = inspect.signature(_function(value))
    except (TypeError, ValueError):
        return Signature("", (), "", module)
    parameters = list(found.parameters.values())[bound:]
    if _takes_anything(parameters):
        return Signature("", (), "", module)
    returns = (
        "" if isinstance(value, type) else _annotation_text(found.return_annotation)
    )
    arrow = f" -> {qualify_type(returns, module)}" if returns else ""
    text = f"({', '.join(_parts(parameters, module))}){arrow}"
    return Signature(text, tuple(map(_parameter, parameters)), returns, module)


def annotation(node: ast.stmt | None) -> str:
    """The type that a statement says that a name has.

    >>> annotation(ast.parse("x: list[int] = []").body[0])
    'list[int]'
    """
    return ast.unparse(node.annotation) if isinstance(node, ast.AnnAssign) else ""


def qualify_type(text: str, module: str) -> str:
    """A type as it is written in a module, by the names that have pages.

    >>> qualify_type("list[TypeNode]", "ttr.judging.models")
    'list[ttr.types.TypeNode]'
    """
    try:
        tree = ast.parse(text, mode="eval")
    except SyntaxError:
        return text
    return ast.unparse(_Qualifier(module).visit(tree))


def linked_names(text: str, module: str) -> Iterator[tuple[str, PublicName | None]]:
    """A type in pieces, each with the public name that it is.

    >>> [piece for piece, name in linked_names("list[TypeNode]", "ttr.judging.models")]
    ['list', '[', 'TypeNode', ']']
    """
    word = ""
    for letter in f"{text}\0":
        if letter.isidentifier() or (word and letter.isalnum()):
            word += letter
            continue
        if word:
            yield word, named_in(module, word)
        word = ""
        if letter != "\0":
            yield letter, None


def _takes_anything(parameters: list[inspect.Parameter]) -> bool:
    """Are the parameters those of a class that others make, `(*args, **kwargs)`?"""
    empty = inspect.Parameter.empty
    names = [it.name for it in parameters if it.annotation is empty]
    return names == ["args", "kwargs"] and len(parameters) == 2


def _function(value: object) -> Any:
    return value.__func__ if isinstance(value, classmethod | staticmethod) else value


def _parts(parameters: list[inspect.Parameter], module: str) -> Iterator[str]:
    """The parameters as they are written, with the marks `/` and `*`."""
    before: inspect.Parameter | None = None
    kinds = inspect.Parameter
    for it in parameters:
        if before and before.kind is kinds.POSITIONAL_ONLY != it.kind:
            yield "/"
        starred = before and before.kind in (kinds.KEYWORD_ONLY, kinds.VAR_POSITIONAL)
        if it.kind is kinds.KEYWORD_ONLY and not starred:
            yield "*"
        yield _part(it, module)
        before = it
    if before and before.kind is kinds.POSITIONAL_ONLY:
        yield "/"


def _part(it: inspect.Parameter, module: str) -> str:
    made = _parameter(it)
    typed = (
        f"{made.name}: {qualify_type(made.type, module)}" if made.type else made.name
    )
    equals = " = " if made.type else "="
    return f"{typed}{equals}{made.default}" if made.default else typed


def _parameter(it: inspect.Parameter) -> Parameter:
    stars = "*" * ((it.kind is it.VAR_POSITIONAL) + 2 * (it.kind is it.VAR_KEYWORD))
    return Parameter(
        stars + it.name, _annotation_text(it.annotation), _default(it.default)
    )


def _annotation_text(annotation: object) -> str:
    if annotation is inspect.Signature.empty:
        return ""
    if isinstance(annotation, str):
        return annotation.strip("'\"")
    if annotation is None:
        return "None"
    if isinstance(annotation, ForwardRef):
        return annotation.__forward_arg__
    return getattr(annotation, "__name__", str(annotation))


def _default(value: object) -> str:
    if value is inspect.Parameter.empty:
        return ""
    text = repr(value)
    try:
        ast.parse(text, mode="eval")
    except SyntaxError:
        return "..."
    return text if len(text) <= _LONGEST_DEFAULT else "..."


class _Qualifier(ast.NodeTransformer):
    """Replaces names by the dotted names that have pages."""

    def __init__(self, module: str) -> None:
        self.module = module

    def visit_Name(self, node: ast.Name) -> ast.expr:
        found = named_in(self.module, node.id)
        return ast.parse(found.path, mode="eval").body if found else node

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        return node
