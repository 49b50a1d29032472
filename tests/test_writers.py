"""Who may write: what leaves the program leaves it through a few functions."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
MODULES = sorted(
    str(path.relative_to(ROOT))
    for package in ("ttr", "kille")
    for path in (ROOT / package).rglob("*.py")
)

WRITERS = {
    "ttr/cli/output.py": "what the commands of ttr print",
    "ttr/cli/command_line.py": "the version",
    "ttr/safety/inputs.py": "prompts",
    "ttr/safety/unforeseen_errors.py": "the error that nobody foresaw",
    "ttr/testing/hash_seeds.py": "digests, read by the process that asked for them",
    "kille/interfaces/live_prompt.py": "the prompt, again and again",
    "kille/interfaces/standard_streams.py": "what the commands of kille complain of",
    "kille/interfaces/terminal.py": "what the commands of kille print",
    "kille/lab/people/typed_lines.py": "what people in a study are shown",
    "kille/sensors/kinect/process_server.py": "what it found when nobody else is left",
}
"""The modules that may write to a stream, and what it is that they write."""

ESCAPES = "ttr/escapes.py"
UNSEEN_IN_JSON = {
    "kille/bus/packing.py",  # messages between nodes
    "kille/memory/exporting.py",  # files, by a package that cannot know `ttr`
    "kille/lab/log/cells.py",  # cells of a database
    "kille/lab/log/writing.py",
}
"""Where JSON goes to neither a terminal nor a file of `ttr`."""


FINDS = re.compile(
    r"\b(?:print|track|rprint|input|Console|TextColumn)\(|sys\.(?:__)?std|rich\.print|"
    r"import print|markup=|html|saxutils|csv|ensure_ascii"
)
"""What stands in each module with something to be found."""

WRITING = {"print()", "sys.__stdout__", "sys.__stderr__", "rich.print"}


@lru_cache
def trees() -> dict[str, ast.Module]:
    """The modules in which there is anything to find, as they are written."""
    texts = {it: (ROOT / it).read_text("utf-8") for it in MODULES}
    return {it: ast.parse(text) for it, text in texts.items() if FINDS.search(text)}


def names(node: ast.AST) -> Iterator[str]:
    """The dotted names in a node: what is imported, called or looked up."""
    match node:
        case ast.Import(found):
            yield from (one.name for one in found)
        case ast.ImportFrom(module, found):
            yield from (f"{module}.{one.name}" for one in found)
        case ast.Attribute(ast.Name(first), last):
            yield f"{first}.{last}"
        case ast.Call(ast.Name(name)):
            yield f"{name}()"


def is_constant(node: ast.AST) -> bool:
    """Is a text one of our own?"""
    match node:
        case ast.IfExp(_, one, other):
            return is_constant(one) and is_constant(other)
    return isinstance(node, ast.Constant)


def is_writing(node: ast.AST) -> bool:
    """Does a node write past the writers, or have words read as markup?"""
    match node:
        case ast.Attribute(ast.Attribute(ast.Name("sys"), "stdout" | "stderr"), verb):
            return verb.startswith("write")
        case ast.Call(ast.Name("Console" | "track" | "rprint")):
            return True
        case ast.Call(ast.Name("input"), prompts):
            return not all(map(is_constant, prompts))
        case ast.keyword("markup", value):
            return not (isinstance(value, ast.Constant) and value.value is False)
        case ast.Call(ast.Name("TextColumn"), [ast.Constant(text)], settings):
            return "description" in text and all(it.arg != "markup" for it in settings)
    return bool(WRITING & set(names(node)))


def is_escaping(node: ast.AST) -> bool:
    """Does a node escape for a page, a table or JSON in a way of its own?"""
    match node:
        case ast.keyword("ensure_ascii"):
            return True
    used = set(names(node))
    return bool(used & {"html.escape", "xml.sax.saxutils.escape", "csv.writer"})


def places(found: Callable[[ast.AST], bool], *but: str) -> list[str]:
    """Where this is found, except in these modules."""
    return [
        f"{module}:{getattr(node, 'lineno', 0)}"
        for module, tree in trees().items()
        if module not in but
        for node in ast.walk(tree)
        if found(node)
    ]


def test_only_the_writers_write() -> None:
    assert places(is_writing, *WRITERS) == [], "print by say(), complain(), console()"


def test_one_function_escapes_for_each_place() -> None:
    assert places(is_escaping, ESCAPES, *UNSEEN_IN_JSON) == [], (
        f"use those of {ESCAPES}"
    )


def test_the_writers_are_there() -> None:
    assert {*WRITERS, *UNSEEN_IN_JSON, ESCAPES} <= set(MODULES)


@pytest.mark.parametrize(
    "text",
    [
        "print(word)",
        "sys.stdout.write(word)",
        "sys.stderr.writelines([word])",
        "Console().print(word)",
        "track(words, description=word)",
        "input(f'{word}? ')",
        "out.print(word, markup=True)",
        "TextColumn('{task.description}')",
        "from rich import print",
    ],
)
def test_what_writes_is_noticed(text: str) -> None:
    assert any(map(is_writing, ast.walk(ast.parse(text))))


@pytest.mark.parametrize(
    "text",
    [
        "from html import escape",
        "html.escape(word)",
        "csv.writer(file)",
        "json.dumps(word, ensure_ascii=False)",
    ],
)
def test_what_escapes_is_noticed(text: str) -> None:
    assert any(map(is_escaping, ast.walk(ast.parse(text))))
