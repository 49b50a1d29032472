"""The text of files of the repository as pages of their own, to which others link."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from html import escape
from pathlib import Path

from pygments import highlight
from pygments.filter import Filter
from pygments.formatters import HtmlFormatter
from pygments.lexer import Lexer
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.token import Name, Operator, Punctuation, Token, Whitespace
from pygments.util import ClassNotFound

from tools.playground.texts import needs_files
from tools.website.playground_links import playground_link
from tools.website.public_names import ROOT

_PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title} – Kille</title>
<link rel="stylesheet" href="{up}_static/source.css">
<link rel="icon" href="data:,">
<script src="{up}_static/source.js"></script>
</head>
<body>
<header><a href="{up}index.html">Kille</a> <span>{trail}</span></header>
<main>{body}</main>
</body>
</html>
"""

_MARK = re.compile(r'<span class="(\w+)">([^<]*)</span>')
"""A word in a colour; the shorter marks are a fifth of the text of all files."""

_UNREAD = {".png", ".jpg", ".npz", ".gz", ".pack", ".db", ".pyc"}
_LONGEST = 400_000


def with_folders(files: Iterable[Path]) -> set[Path]:
    """The files, and those in the folders among them that can be read as text."""
    found = set[Path]()
    for it in files:
        whole = ROOT / it
        inside = sorted(whole.rglob("*")) if whole.is_dir() else [whole]
        found |= {file.relative_to(ROOT) for file in inside if _is_text(file)}
    return found


def write_source_pages(
    files: Iterable[Path], folder: Path, has_playground: bool = False
) -> int:
    """Writes a page for each file, and one for each folder that has any; how many.

    Pages of theories link to the playground, if there is one.
    """
    files = sorted(with_folders(files))
    folders = {parent for it in files for parent in it.parents}
    pages = [(f"{it}.html", file_page(it, has_playground)) for it in files]
    pages += [(f"{it}/index.html", _folder_page(it, files, folders)) for it in folders]
    for name, text in pages:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
    return len(pages)


def file_page(file: Path, has_playground: bool = False) -> str:
    """The page of a file, its lines and the names that it defines to be linked to."""
    text = (ROOT / file).read_text("utf-8", errors="replace")
    lexer = _lexer(file.name)
    lexer.add_filter(_Plain())
    names = {line: name for name, line in _definitions(file, text)}
    marked = highlight(text, lexer, HtmlFormatter(nowrap=True))
    lines = _MARK.sub(r"<i class=\1>\2</i>", marked).splitlines()
    body = "\n".join(_line(i, it, names.get(i)) for i, it in enumerate(lines, 1))
    runs = has_playground and file.suffix == ".ttr" and not needs_files(text)
    depth = len(file.parts)
    return _PAGE.format(
        title=escape(file.as_posix()),
        up="../" * depth,
        trail=_trail(file) + f" {playground_link(text, depth)}" * runs,
        body=f"<pre>{body}</pre>",
    )


def _line(number: int, text: str, name: str | None) -> str:
    """A line that can be linked to by its number, and by what it defines."""
    named = f'<a id="{name}"></a>' if name else ""
    return f"{named}<b id=L{number}>{text}</b>"


class _Plain(Filter):  # type: ignore[misc]
    """Leaves colours to comments, strings, numbers, keywords and what is defined."""

    def filter(
        self, lexer: Lexer, stream: Iterator[tuple[object, str]]
    ) -> Iterator[tuple[object, str]]:
        kept = (Name.Function, Name.Class, Name.Decorator)
        for kind, value in stream:
            plain = kind in Punctuation or kind in Operator or kind in Whitespace
            named = kind in Name and kind not in kept
            yield (Token.Text if plain or named else kind), value


def _lexer(name: str) -> Lexer:
    try:
        return get_lexer_for_filename(name)
    except ClassNotFound:
        return TextLexer()


def _definitions(file: Path, text: str) -> Iterator[tuple[str, int]]:
    """The names that a file of Python defines, each with its line."""
    if file.suffix == ".py":
        yield from _walk_definitions(ast.parse(text).body, "")


def _walk_definitions(body: list[ast.stmt], before: str) -> Iterator[tuple[str, int]]:
    for it in body:
        match it:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield f"{before}{name}", it.lineno
                if isinstance(it, ast.ClassDef):
                    yield from _walk_definitions(it.body, f"{before}{name}.")
            case ast.Assign(targets=[ast.Name(id=name)]):
                yield f"{before}{name}", it.lineno
            case ast.AnnAssign(target=ast.Name(id=name)):
                yield f"{before}{name}", it.lineno


def _trail(file: Path) -> str:
    """The folders that a file is in, as links."""
    depth = len(file.parts)
    links = [
        f'<a href="{"../" * (depth - i - 2) or "./"}index.html">{escape(it)}</a>'
        for i, it in enumerate(file.parts[:-1])
    ]
    return " / ".join([*links, escape(file.name)])


def _folder_page(folder: Path, files: list[Path], folders: set[Path]) -> str:
    inside = [it for it in sorted(folders) if it.parent == folder and it != folder]
    items = [f'<li><a href="{it.name}/index.html">{it.name}/</a></li>' for it in inside]
    items += [
        f'<li><a href="{it.name}.html">{it.name}</a></li>'
        for it in files
        if it.parent == folder
    ]
    depth = len(folder.parts)
    links = [
        f'<a href="{"../" * (depth - i - 1) or "./"}index.html">{escape(it)}</a>'
        for i, it in enumerate(folder.parts)
    ]
    return _PAGE.format(
        title=escape(folder.as_posix()),
        up="../" * (depth + 1),
        trail=" / ".join(links),
        body=f"<ul>{''.join(items)}</ul>",
    )


def _is_text(file: Path) -> bool:
    if not file.is_file() or file.suffix in _UNREAD or "__pycache__" in file.parts:
        return False
    return file.stat().st_size <= _LONGEST and b"\0" not in file.read_bytes()[:4096]
