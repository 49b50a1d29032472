"""The source of an effect written in Python: its syntax tree, and places in its file.

Below are the functions that walk such a tree.
"""

from __future__ import annotations

import ast
import builtins
import linecache
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import CodeType, FunctionType, ModuleType
from typing import TypeAlias, cast

from ttr.errors import Span

_FunctionNode: TypeAlias = ast.FunctionDef | ast.Lambda


@dataclass(frozen=True, eq=False)
class Source:
    """A function with its syntax tree, and the tree of the file that it is in."""

    function: FunctionType
    node: _FunctionNode
    file: str
    module: ast.Module

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The names of its positional parameters, in order."""
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
        """The values of the names that it takes from outside."""
        cells = self.function.__closure__ or ()
        free = dict(zip(self.function.__code__.co_freevars, cells, strict=True))
        filled = {name: c.cell_contents for name, c in free.items() if _is_filled(c)}
        return {**vars(builtins), **self.function.__globals__, **filled}

    def value_of(self, expression: ast.expr) -> object:
        """The value of a name from outside, or of an attribute of a module.

        None for other expressions, and for names that the function sets itself.
        """
        match expression:
            case ast.Name(name) if name not in self._own_names:
                return self.names.get(name)
            case ast.Attribute(value, name):
                module = self.value_of(value)
                return (
                    _attribute(module, name) if isinstance(module, ModuleType) else None
                )
        return None

    @cached_property
    def _own_names(self) -> frozenset[str]:
        code = self.function.__code__
        return frozenset((*code.co_varnames, *code.co_cellvars))

    def span(self, node: ast.expr | ast.keyword, last: int = 0) -> Span:
        """The place of an expression, or of its `last` so many characters."""
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

    def label_span(self, node: ast.keyword, label: str) -> Span:
        """The place of the label of a keyword argument."""
        text = linecache.getline(self.file, node.lineno).rstrip("\n")
        start = _characters(text, node.col_offset)
        shown = text.replace("\t", " ")
        return Span(self.file, node.lineno, start + 1, len(label), shown)

    def undefined_names(self) -> Iterator[str]:
        """The names that neither the function, its file nor Python defines."""
        bound = _names_bound_in(self.module, self.node.lineno)
        if bound is None:
            return
        for name in _global_names(self.function.__code__):
            if name not in self.names and name not in bound:
                yield name


def _attribute(module: ModuleType, name: str) -> object:
    """The attribute of a module, which `ttr` loads when it is first asked for."""
    if module.__name__ == "ttr" and name in dir(module):
        return getattr(module, name)
    return vars(module).get(name)


def _is_filled(cell: object) -> bool:
    try:
        return hasattr(cell, "cell_contents")
    except ValueError:
        return False


def _characters(text: str, offset: int) -> int:
    """How many characters the first so many bytes of a line are."""
    return len(text.encode()[:offset].decode(errors="ignore"))


def _global_names(code: CodeType) -> Iterator[str]:
    """The names that code, or code inside it, looks up outside."""
    import dis

    for step in dis.get_instructions(code):
        if step.opname in ("LOAD_GLOBAL", "LOAD_NAME"):
            yield step.argval
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _global_names(inner)


@lru_cache(maxsize=64)
def _names_bound_in(module: ast.Module, line: int) -> frozenset[str] | None:
    """The names bound anywhere in a file.

    None where it imports `*` after this line: what that binds is not known yet.
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
                found |= set(map(_name_imported_as, names))
    return None if "*" in found else frozenset(found)


def source_of(effect: object) -> Source | None:
    """The source of a plain function; None if there is none, or it was edited since."""
    if not isinstance(effect, FunctionType) or hasattr(effect, "__wrapped__"):
        return None
    code = effect.__code__
    lines = linecache.getlines(code.co_filename, effect.__globals__)
    module = _parse("".join(lines))
    if module is None:
        return None
    found = [node for node in _functions(module) if _is_of(node, code)]
    if len(found) > 1:  # only lambdas can share a line and their parameters
        found = [one for one in cast("list[ast.Lambda]", found) if _is_at(one, code)]
    if len(found) != 1:
        return None
    return Source(effect, found[0], code.co_filename, module)


@lru_cache(maxsize=64)
def _parse(text: str) -> ast.Module | None:
    try:
        return ast.parse(text) if text else None
    except (SyntaxError, ValueError):
        return None


@lru_cache(maxsize=64)
def _functions(module: ast.Module) -> tuple[_FunctionNode, ...]:
    kinds = (ast.FunctionDef, ast.Lambda)
    return tuple(node for node in ast.walk(module) if isinstance(node, kinds))


def _is_at(node: ast.Lambda, code: CodeType) -> bool:
    """Is the code of just this place?"""
    start = (node.body.lineno, node.body.col_offset)
    end = (node.end_lineno, node.end_col_offset)
    places = [p for p in code.co_positions() if None not in p and p[2] != p[3]]
    return bool(places) and all(
        start <= (first, column) and (last, stop) <= end
        for first, last, column, stop in places
    )


def _is_of(node: _FunctionNode, code: CodeType) -> bool:
    """Does the code look like that of the function in the tree?"""
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


# --- walking a tree ------------------------------------------------------------------


def prefixes(node: ast.expr) -> Iterator[ast.expr]:
    """The expressions that a chain of labels, elements and calls extends, one by one.

    >>> chain = ast.parse("s.qud[0].name").body[0].value
    >>> [ast.unparse(one) for one in prefixes(chain)]
    ['s.qud[0]', 's.qud', 's']
    """
    while isinstance(node, ast.Attribute | ast.Subscript | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
        yield node


def walk_untried(body: list[ast.stmt]) -> Iterator[ast.AST]:
    """The nodes in these statements, outermost first, except what is in a `try`."""
    waiting: list[ast.AST] = list(reversed(body))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Try | ast.TryStar) and node.handlers:
            waiting += reversed([*node.handlers, *node.orelse, *node.finalbody])
            continue
        yield node
        waiting += reversed(list(ast.iter_child_nodes(node)))


def assigned_names(node: _FunctionNode) -> Iterator[str]:
    """The names that are set in a function, each as often as it is set."""
    own = set(ast.iter_child_nodes(node.args))
    for inner in ast.walk(node):
        match inner:
            case ast.Name(name, ast.Store() | ast.Del()):
                yield name
            case ast.arg(name) if inner not in own:
                yield name
            case ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)):
                yield name
            case ast.MatchStar(name=str(name)) | ast.MatchMapping(rest=str(name)):
                yield name
            case ast.FunctionDef(name) | ast.ClassDef(name) if inner is not node:
                yield name
            case ast.AsyncFunctionDef(name):
                yield name
            case ast.Import(names) | ast.ImportFrom(names=names):
                yield from map(_name_imported_as, names)
            case ast.Global(names) | ast.Nonlocal(names):
                yield from names


def _name_imported_as(one: ast.alias) -> str:
    return (one.asname or one.name).split(".")[0]


def guarded_labels(body: list[ast.stmt]) -> Iterator[str]:
    """The labels that an effect tests for with `in`, `hasattr` or `getattr`."""
    for statement in body:
        for node in ast.walk(statement):
            texts: list[ast.expr] = []
            match node:
                case ast.Compare(left, [ast.In() | ast.NotIn(), *_]):
                    texts = [left]
                case ast.Call(ast.Name("hasattr" | "getattr"), args):
                    texts = args[1:2]
            for text in texts:
                if isinstance(text, ast.Constant) and isinstance(text.value, str):
                    yield text.value


def tested_expressions(body: list[ast.stmt]) -> Iterator[ast.expr]:
    """The expressions whose type is tested: by `match`, a judgement or a class."""
    for statement in body:
        for node in ast.walk(statement):
            match node:
                case ast.Match(subject):
                    yield subject
                case ast.Call(ast.Attribute(_, "judge" | "perceive"), [sit, *_]):
                    yield sit
                case ast.Call(ast.Name("isinstance" | "type"), [sit, *_]):
                    yield sit


def returned_values(body: list[ast.stmt]) -> Iterator[ast.expr | None]:
    """The expressions that are returned, except by functions inside."""
    waiting: list[ast.AST] = list(reversed(body))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Return):
            yield node.value
        if isinstance(node, ast.FunctionDef | ast.Lambda | ast.ClassDef):
            continue
        waiting += reversed(list(ast.iter_child_nodes(node)))


def may_fall_through(body: list[ast.stmt]) -> bool:
    """May these statements come to their end without a return?"""
    match body[-1]:
        case ast.Return() | ast.Raise():
            return False
        case ast.If(_, yes, no):
            return not no or may_fall_through(yes) or may_fall_through(no)
        case ast.Match(_, cases):
            last = cases[-1]
            wild = (
                isinstance(last.pattern, ast.MatchAs) and last.pattern.pattern is None
            )
            complete = wild and last.guard is None
            return not complete or any(may_fall_through(case.body) for case in cases)
    return True
