"""The public names of the two libraries: what is in an `__all__`, and where it is made.

A name that several rooms have is one name, at home where it is imported from with the
fewest words.
"""

from __future__ import annotations

import ast
import inspect
import pkgutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path
from types import ModuleType

import kille
import ttr
from tools.website.docstrings import has_example
from ttr.aliases import Alias

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Source:
    """Where something is defined: a module, and a statement of it."""

    module: str
    name: str
    node: ast.stmt | None
    doc: str

    @property
    def file(self) -> Path:
        """The file, from the top folder of the repository."""
        return file_of(self.module)

    @property
    def line(self) -> int:
        """The line of the statement, or of the first decorator; 1 of a whole module."""
        if self.node is None:
            return 1
        decorators: Sequence[ast.expr] = getattr(self.node, "decorator_list", ())
        return min([self.node.lineno, *(it.lineno for it in decorators)])


@dataclass(frozen=True)
class Member:
    """A public method, property or attribute of a class."""

    name: str
    kind: str
    value: object
    source: Source
    owner: type


@dataclass(frozen=True, eq=False)
class PublicName:
    """A public name, at home in one room, perhaps to be had from others."""

    room: str
    name: str
    value: object
    source: Source
    elsewhere: tuple[str, ...] = ()

    @cached_property
    def doc(self) -> str:
        """What is said of it, where it is defined or by itself."""
        own = getattr(self.value, "doc", None)
        return self.source.doc or (own if isinstance(own, str) else "")

    @property
    def path(self) -> str:
        """The dotted name that it is imported by."""
        return f"{self.room}.{self.name}"

    @cached_property
    def kind(self) -> str:
        """What it is: module, exception, class, function or data."""
        match self.value:
            case ModuleType():
                return "module"
            case type() if issubclass(self.value, BaseException):
                return "exception"
            case type() if self.value.__name__ == self.name:
                return "class"
            case _ if isinstance(
                self.source.node, ast.FunctionDef | ast.AsyncFunctionDef
            ):
                return "function"
        return "data"

    @cached_property
    def members(self) -> tuple[Member, ...]:
        """The public members of a class that are not described with another class."""
        return tuple(_members(self.value)) if isinstance(self.value, type) else ()


@dataclass(frozen=True)
class Room:
    """A module with an `__all__`."""

    name: str
    names: tuple[PublicName, ...]
    doc: str


@cache
def public_rooms() -> Mapping[str, Room]:
    """The rooms, by name, each with its public names at home here or elsewhere."""
    found = {name: _all(name) for name in _module_names() if _all(name)}
    homes: dict[tuple[str, str], list[tuple[str, str]]] = {}
    for room in sorted(found, key=lambda it: (it.count("."), it)):
        for name in found[room]:
            homes.setdefault(_identity(room, name), []).append((room, name))
    made = {
        identity: PublicName(
            room,
            name,
            getattr(import_module(room), name),
            definition(room, name),
            tuple(".".join(it) for it in others),
        )
        for identity, [(room, name), *others] in homes.items()
    }
    return {
        room: Room(
            room,
            tuple(made[_identity(room, name)] for name in found[room]),
            inspect.getdoc(import_module(room)) or "",
        )
        for room in sorted(found)
    }


@cache
def public_names() -> Mapping[str, PublicName]:
    """The public names, by the dotted name that they are at home at."""
    every = (it for room in public_rooms().values() for it in room.names)
    return {it.path: it for it in every}


def names_without_example() -> list[str]:
    """The public names that neither their own docstring nor a member's shows in use."""
    return [
        path
        for path, it in public_names().items()
        if it.kind != "module"
        and not any(map(has_example, [it.doc, *(m.source.doc for m in it.members)]))
    ]


@cache
def known_paths() -> Mapping[str, PublicName]:
    """The public names by each dotted name that they can be had by, and made at."""
    found: dict[str, PublicName] = {}
    for it in public_names().values():
        found[f"{it.source.module}.{it.source.name}"] = it
        found.update(dict.fromkeys(it.elsewhere, it))
        found[it.path] = it
    return found


def named_in(module: str, name: str) -> PublicName | None:
    """The public name that a name of a module stands for."""
    if not _is_ours(module):
        return None
    source = definition(module, name)
    return known_paths().get(f"{source.module}.{source.name}")


@cache
def definition(module: str, name: str) -> Source:
    """Where a name of a module is defined, which may be in another module."""
    node, doc = _bindings(module).get(name, (None, ""))
    if isinstance(node, ast.ImportFrom):
        source, original = _import_source(module, node, name)
        if _is_ours(source) and (source, original) != (module, name):
            return definition(source, original)
    if not doc and _is_module(inner := f"{module}.{name}"):
        return Source(inner, "", None, ast.get_docstring(_tree(inner)) or "")
    return Source(module, name, node, doc)


def file_of(module: str) -> Path:
    """The file of a module, from the top folder of the repository."""
    path = Path(module.replace(".", "/"))
    package = path / "__init__.py"
    return package if (ROOT / package).is_file() else path.with_suffix(".py")


def _module_names() -> Iterator[str]:
    for package in (ttr, kille):
        yield package.__name__
        for it in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not it.name.endswith("__main__") and _says_all(it.name):
                yield it.name


def _says_all(module: str) -> bool:
    return "\n__all__" in (ROOT / file_of(module)).read_text("utf-8")


def _all(module: str) -> tuple[str, ...]:
    return tuple(getattr(import_module(module), "__all__", ()))


def _identity(room: str, name: str) -> tuple[str, str]:
    source = definition(room, name)
    if not source.name:  # a module
        package, _, name = source.module.rpartition(".")
        return package, name
    return source.module, source.name


def _is_ours(module: str) -> bool:
    return module.partition(".")[0] in ("ttr", "kille")


@cache
def _is_module(name: str) -> bool:
    path = ROOT / name.replace(".", "/")
    return path.with_suffix(".py").is_file() or (path / "__init__.py").is_file()


@cache
def _tree(module: str) -> ast.Module:
    return ast.parse((ROOT / file_of(module)).read_text("utf-8"))


@cache
def _bindings(module: str) -> Mapping[str, tuple[ast.stmt, str]]:
    return dict(_walk_bindings(_tree(module).body))


def _walk_bindings(
    body: Sequence[ast.stmt],
) -> Iterator[tuple[str, tuple[ast.stmt, str]]]:
    """The names that statements bind, each with its statement and its docstring."""
    for statement, after in zip(body, [*body[1:], None], strict=True):
        said = _string(after)
        match statement:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield name, (statement, ast.get_docstring(statement) or "")
            case ast.AsyncFunctionDef(name=name):
                yield name, (statement, ast.get_docstring(statement) or "")
            case ast.AnnAssign(target=ast.Name(id=name)):
                yield name, (statement, said)
            case ast.Assign(targets=targets):
                for target in targets:
                    for it in ast.walk(target):
                        if isinstance(it, ast.Name):
                            yield it.id, (statement, said)
            case ast.ImportFrom(names=names):
                for alias in names:
                    yield alias.asname or alias.name, (statement, "")
            case ast.If(body=inner, orelse=other) | ast.Try(body=inner, orelse=other):
                yield from _walk_bindings([*other, *inner])


def _string(statement: ast.stmt | None) -> str:
    match statement:
        case ast.Expr(value=ast.Constant(value=str() as text)):
            return inspect.cleandoc(text)
    return ""


def _import_source(module: str, node: ast.ImportFrom, name: str) -> tuple[str, str]:
    """The module that a statement imports from, and the name that it has there."""
    original = next(it.name for it in node.names if name in (it.asname, it.name))
    base = node.module or ""
    if node.level:
        parts = module.split(".")
        inside = file_of(module).name == "__init__.py"
        kept = parts[: len(parts) - node.level + inside]
        base = ".".join([*kept, *([base] if base else [])])
    return base, original


def _members(cls: type) -> Iterator[Member]:
    seen = set[str]()
    for owner in cls.__mro__:
        if not _is_ours(owner.__module__):
            continue
        if owner is not cls and named_in(owner.__module__, owner.__name__):
            continue
        for name, source in _class_bindings(owner).items():
            value = inspect.getattr_static(cls, name, None)
            if name.startswith("_") or name in seen or isinstance(value, Alias):
                continue
            seen.add(name)
            yield Member(name, _member_kind(value, source.node), value, source, owner)


def _class_bindings(cls: type) -> Mapping[str, Source]:
    """What the text of a class defines, each with its source."""
    tree = _tree(cls.__module__)
    name = cls.__qualname__.rpartition(".")[2]
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef) and node.name == name:
            return {
                bound: Source(cls.__module__, f"{cls.__qualname__}.{bound}", *what)
                for bound, what in _walk_bindings(node.body)
            }
    return {}


def _member_kind(value: object, node: ast.stmt | None) -> str:
    if isinstance(node, ast.AnnAssign):
        return "attribute"
    match value:
        case classmethod():
            return "classmethod"
        case staticmethod():
            return "staticmethod"
        case property() | cached_property():
            return "property"
    return "method" if callable(value) and inspect.isroutine(value) else "attribute"
