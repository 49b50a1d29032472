"""What stands in the syntax tree of a function: names, nodes, and what it returns."""

from __future__ import annotations

import ast
from collections.abc import Iterator

__all__ = [
    "asked_for",
    "examined",
    "falls_through",
    "heads",
    "nodes",
    "returned",
    "stored",
]


def heads(node: ast.expr) -> Iterator[ast.expr]:
    """What an expression of labels and elements begins with, longest first."""
    while isinstance(node, ast.Attribute | ast.Subscript | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
        yield node


def nodes(body: list[ast.stmt]) -> Iterator[ast.AST]:
    """All that is in these statements, outermost first, but what is tried."""
    waiting: list[ast.AST] = list(reversed(body))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Try | ast.TryStar) and node.handlers:
            waiting += reversed([*node.handlers, *node.orelse, *node.finalbody])
            continue
        yield node
        waiting += reversed(list(ast.iter_child_nodes(node)))


def stored(node: ast.AST) -> Iterator[str]:
    """The names that are set in a function, as often as they are."""
    own = getattr(node, "args", None)
    for inner in ast.walk(node):
        match inner:
            case ast.Name(name, ast.Store() | ast.Del()):
                yield name
            case ast.arguments() if inner is not own:
                every = (*inner.posonlyargs, *inner.args, *inner.kwonlyargs)
                yield from (a.arg for a in every)
            case ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)):
                yield name
            case ast.MatchStar(name=str(name)):
                yield name
            case ast.FunctionDef(name) | ast.ClassDef(name) if inner is not node:
                yield name
            case ast.Global(names) | ast.Nonlocal(names):
                yield from names


def asked_for(body: list[ast.stmt]) -> Iterator[str]:
    """The labels that an effect asks for before it uses them, as far as they are told.

    That is by `in`, by `hasattr` or by `getattr`.
    """
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


def examined(body: list[ast.stmt]) -> Iterator[ast.expr]:
    """The expressions whose type is found out: by a match, a judgement or a class."""
    for statement in body:
        for node in ast.walk(statement):
            match node:
                case ast.Match(subject):
                    yield subject
                case ast.Call(ast.Attribute(_, "judge" | "perceive"), [sit, *_]):
                    yield sit
                case ast.Call(ast.Name("isinstance" | "type"), [sit, *_]):
                    yield sit


def returned(body: list[ast.stmt]) -> Iterator[ast.expr | None]:
    """The expressions that are returned, but by functions inside."""
    waiting: list[ast.AST] = list(reversed(body))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Return):
            yield node.value
        if isinstance(node, ast.FunctionDef | ast.Lambda | ast.ClassDef):
            continue
        waiting += reversed(list(ast.iter_child_nodes(node)))


def falls_through(body: list[ast.stmt]) -> bool:
    """Whether statements may come to their end without a return."""
    match body[-1]:
        case ast.Return() | ast.Raise():
            return False
        case ast.If(_, yes, no):
            return not no or falls_through(yes) or falls_through(no)
        case ast.Match(_, cases):
            last = cases[-1]
            wild = (
                isinstance(last.pattern, ast.MatchAs) and last.pattern.pattern is None
            )
            complete = wild and last.guard is None
            return not complete or any(falls_through(case.body) for case in cases)
    return True
