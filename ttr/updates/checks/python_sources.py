"""Where a Python effect is written: its syntax tree, and places in its file."""

from __future__ import annotations

import ast
import builtins
import linecache
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import CodeType, FunctionType, ModuleType
from typing import TypeAlias

from ttr.errors import Span

__all__ = ["FunctionNode", "Source", "source_of"]

FunctionNode: TypeAlias = ast.FunctionDef | ast.Lambda


@dataclass(frozen=True, eq=False)
class Source:
    """A function with its syntax tree and the text of the file that it stands in."""

    function: FunctionType
    node: FunctionNode
    file: str
    module: ast.Module

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The names of its parameters, as the state and the event come first."""
        given = self.node.args
        return tuple(a.arg for a in (*given.posonlyargs, *given.args))

    @cached_property
    def body(self) -> list[ast.stmt]:
        """Its statements; a lambda has one that returns its value."""
        if isinstance(self.node, ast.FunctionDef):
            return self.node.body
        return [ast.Return(self.node.body)]

    @cached_property
    def names(self) -> Mapping[str, object]:
        """What its names that are not its own stand for."""
        cells = self.function.__closure__ or ()
        free = dict(zip(self.function.__code__.co_freevars, cells, strict=True))
        filled = {name: c.cell_contents for name, c in free.items() if _is_filled(c)}
        return {**vars(builtins), **self.function.__globals__, **filled}

    def meant(self, expression: ast.expr) -> object:
        """What a name, or an attribute of a module, stands for; else None."""
        match expression:
            case ast.Name(name):
                return self.names.get(name)
            case ast.Attribute(ast.Name(module), name):
                found = self.names.get(module)
                return vars(found).get(name) if isinstance(found, ModuleType) else None
        return None

    def span(self, node: ast.expr | ast.keyword, last: int = 0) -> Span:
        """The place of an expression, or of as many characters at its end."""
        line = (last and node.end_lineno) or node.lineno
        text = linecache.getline(self.file, line).rstrip("\n")
        start = _characters(text, node.col_offset)
        end = _characters(text, node.end_col_offset or 0)
        if last:
            start = end - last
        elif node.end_lineno != node.lineno:
            end = len(text)
        shown = text.replace("\t", " ")
        return Span(self.file, line, start + 1, max(1, end - start), shown)

    def opening(self, node: ast.keyword, label: str) -> Span:
        """The place of the label that a keyword argument begins with."""
        text = linecache.getline(self.file, node.lineno).rstrip("\n")
        start = _characters(text, node.col_offset)
        shown = text.replace("\t", " ")
        return Span(self.file, node.lineno, start + 1, len(label), shown)

    def undefined(self) -> Iterator[str]:
        """The names that neither the function, its file nor Python knows."""
        bound = _bound_in(self.module, self.node.lineno)
        if bound is None:
            return
        for name in _globals_of(self.function.__code__):
            if name not in self.names and name not in bound:
                yield name


def _is_filled(cell: object) -> bool:
    try:
        return hasattr(cell, "cell_contents")
    except ValueError:
        return False


def _characters(text: str, offset: int) -> int:
    """A number of bytes of a line as a number of characters."""
    return len(text.encode()[:offset].decode(errors="ignore"))


def _globals_of(code: CodeType) -> Iterator[str]:
    """The names that code, and code inside it, looks up outside."""
    import dis

    for step in dis.get_instructions(code):
        if step.opname in ("LOAD_GLOBAL", "LOAD_NAME"):
            yield step.argval
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _globals_of(inner)


@lru_cache(maxsize=64)
def _bound_in(module: ast.Module, line: int) -> frozenset[str] | None:
    """The names bound anywhere in a file.

    None where after this line it imports all of another's: what it has imported before
    is known.
    """
    found: set[str] = set()
    for node in ast.walk(module):
        match node:
            case ast.Name(name, ast.Store()) | ast.FunctionDef(name):
                found.add(name)
            case ast.ClassDef(name) | ast.AsyncFunctionDef(name):
                found.add(name)
            case ast.ImportFrom(names=[ast.alias("*")]) if node.lineno < line:
                continue
            case ast.Import(names) | ast.ImportFrom(names=names):
                found |= {(a.asname or a.name).split(".")[0] for a in names}
    return None if "*" in found else frozenset(found)


def source_of(effect: object) -> Source | None:
    """The source of a plain function, if it can be had and is what is run."""
    if not isinstance(effect, FunctionType) or hasattr(effect, "__wrapped__"):
        return None
    code = effect.__code__
    lines = linecache.getlines(code.co_filename, effect.__globals__)
    module = _parsed("".join(lines))
    if module is None:
        return None
    found = [node for node in _functions(module) if _is_of(node, code)]
    if len(found) > 1:
        found = [node for node in found if _is_at(node, code)]
    if len(found) != 1:
        return None
    return Source(effect, found[0], code.co_filename, module)


@lru_cache(maxsize=64)
def _parsed(text: str) -> ast.Module | None:
    try:
        return ast.parse(text) if text else None
    except (SyntaxError, ValueError):
        return None


@lru_cache(maxsize=64)
def _functions(module: ast.Module) -> tuple[FunctionNode, ...]:
    kinds = (ast.FunctionDef, ast.Lambda)
    return tuple(node for node in ast.walk(module) if isinstance(node, kinds))


def _is_at(node: FunctionNode, code: CodeType) -> bool:
    """Whether the code is of just this place, where several share a line."""
    body = node.body[0] if isinstance(node, ast.FunctionDef) else node.body
    start, end = (body.lineno, body.col_offset), (node.end_lineno, node.end_col_offset)
    places = [p for p in code.co_positions() if None not in p and p[2] != p[3]]
    return bool(places) and all(
        start <= (first, column) and (last, stop) <= end
        for first, last, column, stop in places
    )


def _is_of(node: FunctionNode, code: CodeType) -> bool:
    """Whether the code is that of the function in the tree, to all appearance."""
    decorators = getattr(node, "decorator_list", [])
    first = min([node.lineno, *(d.lineno for d in decorators)])
    name = node.name if isinstance(node, ast.FunctionDef) else "<lambda>"
    given = node.args
    every = [*given.posonlyargs, *given.args, *given.kwonlyargs]
    count = code.co_argcount + code.co_kwonlyargcount
    return (
        first == code.co_firstlineno
        and name == code.co_name
        and tuple(a.arg for a in every) == code.co_varnames[:count]
    )
