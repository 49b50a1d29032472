"""The pages of the reference of Python: one for each public name, one for each room."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import cache
from html import escape
from pathlib import Path

from tools.website.docstrings import docstring_as_myst, prose_as_myst, sentences
from tools.website.public_names import (
    ROOT,
    Member,
    PublicName,
    Room,
    Source,
    file_of,
    known_paths,
    named_in,
    public_names,
    public_rooms,
)
from tools.website.signatures import (
    Signature,
    annotation,
    linked_names,
    qualify_type,
    signature_of,
)

FOLDER = "api"

_LISTED = ("class", "function", "data", "exception", "module")
_HEADINGS = {
    "class": "Classes",
    "function": "Functions",
    "data": "Values and types",
    "exception": "Errors",
    "module": "Modules",
}
_MEMBERS = {
    "attribute": "Attributes",
    "property": "Properties",
    "classmethod": "Class methods",
    "staticmethod": "Static methods",
    "method": "Methods",
}


def api_pages() -> Mapping[str, str]:
    """The pages by their names, without a suffix."""
    names = {page_of(it): _page(it) for it in public_names().values()}
    rooms = {room_page(it.name): _room_page(it) for it in public_rooms().values()}
    return {**names, **rooms, f"{FOLDER}/index": _index()}


def page_of(name: PublicName) -> str:
    """The page of a public name; of a module, that of the room."""
    if name.kind == "module":
        return room_page(name.source.module)
    same = _pages_by_small_letters()[name.path.lower()] > 1
    suffix = f"-{name.kind}" if same and name.kind != "function" else ""
    return f"{FOLDER}/{name.path}{suffix}"


def room_page(room: str) -> str:
    """The page of a room."""
    return f"{FOLDER}/{room}"


def link_in(module: str, page: str) -> _Linker:
    """What links names in backticks, as they are meant in a module, from a page."""
    return _Linker(module, page)


@cache
def overview() -> Mapping[str, str]:
    """What the tables of the overview of Python say of names, by their dotted names."""
    text = (ROOT / "docs" / "reference" / "python.md").read_text("utf-8")
    found, room = {}, ""
    for line in text.splitlines():
        if line.startswith("#"):
            room = line.strip("# `")
        if line.startswith("| `"):
            _, names, said = re.split(r"(?<!\\)\|", line.strip().removesuffix("|"))
            said = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", said.strip())
            for name in re.findall(r"`(\w+)`", names):
                found[f"{room}.{name}"] = said.replace("\\|", "|")
    return found


def _text_of(path: str, doc: str) -> str:
    """A docstring, or what the overview says where there is none."""
    return doc or overview().get(path, "")


@cache
def _pages_by_small_letters() -> Counter[str]:
    """How many names there are that some file systems take for one."""
    rooms = (it.lower() for it in public_rooms())
    return Counter([*(it.lower() for it in public_names()), *rooms])


class _Linker:
    """The links of names in backticks on a page of the reference."""

    def __init__(self, module: str, page: str) -> None:
        self.module = module
        self.page = page

    def __call__(self, code: str) -> str | None:
        name = re.sub(r"\(.*\)$", "", code, flags=re.S)
        if not re.fullmatch(r"[A-Za-z_][\w.]*", name):
            return None
        if name in public_rooms():
            target = room_page(name)
        elif found := (
            named_in(self.module, name)
            or known_paths().get(name)
            or known_paths().get(f"ttr.errors.{name}")
        ):
            target = page_of(found)
        else:
            return None
        return None if target == self.page else f"/{target}.md"


def _page(name: PublicName) -> str:
    if name.kind == "module":
        return _room_page(public_rooms()[name.source.module])
    page = page_of(name)
    link = link_in(name.source.module, page)
    return "\n".join(
        [
            "---\norphan: true\n---\n",
            f"# {prose_as_myst(name.name)}\n",
            _where(name),
            _directive(name, link),
            *_relatives(name),
        ]
    )


def _where(name: PublicName) -> str:
    """From which room it is imported, and the way up."""
    room = f"[`{name.room}`](/{room_page(name.room)}.md)"
    also = ", ".join(f"`{it}`" for it in name.elsewhere)
    return f"```{{rst-class}} where\n```\n{_kind_in_words(name)} of {room}" + (
        f", also {also}\n" if also else "\n"
    )


def _kind_in_words(name: PublicName) -> str:
    words = {"data": "A value", "exception": "An error", "class": "A class"}
    return words.get(name.kind, "A function")


def _directive(name: PublicName, link: _Linker) -> str:
    module = name.source.module
    options, signature = [], Signature("", (), "", module)
    if name.kind == "data":
        if typed := annotation(name.source.node):
            options.append(f":type: {qualify_type(typed, module)}")
        elif shown := _value(name.source.node):
            options.append(f":value: {shown}")
    elif name.kind != "exception":
        signature = signature_of(name.value, module)
    inner = [
        _source_link(name.source),
        docstring_as_myst(_text_of(name.path, name.doc), link),
        _table(signature, name.doc, name.source),
    ]
    body = "\n\n".join(it for it in inner if it)
    members = "\n\n".join(_members(name, link))
    head = f"{{py:{name.kind}}} {name.path}{signature.text}"
    lines = "".join(f"{it}\n" for it in options)
    return f"``````{head}\n{lines}\n{body}\n``````\n\n{members}"


def _value(node: ast.stmt | None) -> str:
    """What a statement gives a name, if it is short."""
    value = node.value if isinstance(node, ast.Assign) else None
    text = ast.unparse(value) if value else ""
    return text if len(text) <= 60 else ""


def _members(name: PublicName, link: _Linker) -> Iterator[str]:
    for kind, heading in _MEMBERS.items():
        found = [it for it in name.members if it.kind == kind]
        if found:
            yield f"## {heading}"
        for it in found:
            yield _member(name, it, link)


def _member(name: PublicName, it: Member, link: _Linker) -> str:
    module = it.source.module
    link = link_in(module, link.page)
    signature, options = Signature("", (), "", module), []
    if it.kind in ("method", "classmethod", "staticmethod"):
        bound = it.kind != "staticmethod"
        signature = signature_of(it.value, module, bound=bound)
    directive = {"attribute": "attribute", "property": "property"}.get(
        it.kind, "method"
    )
    if it.kind in ("classmethod", "staticmethod"):
        options.append(f":{it.kind}:")
    if typed := _member_type(it):
        options.append(f":type: {qualify_type(typed, module)}")
    inner = [
        _source_link(it.source),
        docstring_as_myst(_text_of(f"{name.path}.{it.name}", it.source.doc), link),
        _table(signature, it.source.doc, it.source),
    ]
    body = "\n\n".join(part for part in inner if part)
    lines = "".join(f"{option}\n" for option in options)
    head = f"{{py:{directive}}} {name.path}.{it.name}{signature.text}"
    return f"``````{head}\n{lines}\n{body}\n``````"


def _member_type(it: Member) -> str:
    node = it.source.node
    if it.kind == "property" and isinstance(node, ast.FunctionDef) and node.returns:
        return ast.unparse(node.returns)
    return annotation(node)


def _source_link(source: Source) -> str:
    """A link to the line of the source where something is defined."""
    href = f"../source/{source.file.as_posix()}.html#L{source.line}"
    return f'<a class="source-link" href="{href}">source</a>'


def _table(signature: Signature, doc: str, source: Source) -> str:
    """Parameters, what is returned and what is raised, as a table."""
    said = sentences(doc)
    rows = [
        (
            f"`{it.name}`",
            _type_as_html(it.type, signature.module),
            f"`{it.default}`" if it.default else "",
            _said_of(it.name.strip("*"), said),
        )
        for it in signature.parameters
    ]
    parts = [_rows_as_table(rows)] if rows else []
    if signature.returns and signature.returns != "None":
        typed = _type_as_html(signature.returns, signature.module)
        parts.append(f"**Returns** {typed}")
    if errors := _errors(doc, source):
        parts.append(f"**Raises** {', '.join(errors)}")
    return "\n\n".join(parts)


_HEADS = ("parameter", "type", "default", "what is said of it")


def _rows_as_table(rows: list[tuple[str, str, str, str]]) -> str:
    """The table, without the columns in which no row has anything."""
    columns = [
        (head, *cells)
        for head, cells in zip(_HEADS, zip(*rows, strict=True), strict=True)
        if any(cells)
    ]
    head, *lines = zip(*columns, strict=True)
    escaped = [[it.replace("|", "\\|") for it in line] for line in lines]
    marks = ["---"] * len(columns)
    return "\n".join(f"| {' | '.join(line)} |" for line in (head, marks, *escaped))


def _said_of(name: str, said: list[str]) -> str:
    """The first sentence that names a parameter."""
    found = next((it for it in said if re.search(rf"`{re.escape(name)}\b", it)), "")
    return prose_as_myst(found)


def _type_as_html(text: str, module: str) -> str:
    if not text:
        return ""
    pieces = [
        f'<a href="{page_of(name).partition("/")[2]}.html">{escape(piece)}</a>'
        if name
        else escape(piece)
        for piece, name in linked_names(text, module)
    ]
    return f"<code>{''.join(pieces)}</code>".replace("|", "&#124;").replace(
        "*", "&#42;"
    )


def _errors(doc: str, source: Source) -> list[str]:
    """The errors that the docstring names, and those that the code itself raises."""
    named = re.findall(r"`(\w+(?:Error|Exception|Interrupt))`", doc)
    raised = [
        node.exc.func.id
        for node in ast.walk(source.node or ast.Module([], []))
        if isinstance(node, ast.Raise)
        and isinstance(node.exc, ast.Call)
        and isinstance(node.exc.func, ast.Name)
        and isinstance(source.node, ast.FunctionDef)
    ]
    found = dict.fromkeys([*named, *raised])
    links = {
        it: named_in(source.module, it) or named_in("ttr.errors", it) for it in found
    }
    return [
        f"[`{it}`](/{page_of(name).strip()}.md)" if name else f"`{it}`"
        for it, name in links.items()
    ]


def _relatives(name: PublicName) -> Iterator[str]:
    """The public classes that a class is made of."""
    if not isinstance(name.value, type):
        return
    bases = [named_in(it.__module__, it.__name__) for it in name.value.__mro__[1:]]
    found = [f"[`{it.name}`](/{page_of(it)}.md)" for it in bases if it]
    if found:
        yield f"\nIt is also a {', a '.join(found)}.\n"


def _room_page(room: Room) -> str:
    page = room_page(room.name)
    link = link_in(room.name, page)
    source = Source(room.name, "", None, "")
    parts = [
        "---\norphan: true\n---\n",
        f"# `{room.name}`\n",
        f"[The reference of Python](/{FOLDER}/index.md)\n",
        _source_link(source),
        f"\n{docstring_as_myst(room.doc, link)}\n",
    ]
    for kind in _LISTED:
        found = [it for it in room.names if it.kind == kind]
        if found:
            parts += [
                f"## {_HEADINGS[kind]}\n",
                "| name | what it is |",
                "| --- | --- |",
            ]
            parts += [_table_row(it, link) for it in found]
            parts.append("")
    return "\n".join(parts)


def _table_row(name: PublicName, link: _Linker) -> str:
    said = prose_as_myst(first_sentence(_text_of(name.path, name.doc)), link).replace(
        "|", "\\|"
    )
    return f"| [`{name.name}`](/{page_of(name)}.md) | {said} |"


def first_sentence(doc: str) -> str:
    """The first paragraph of a docstring, on one line."""
    return " ".join(doc.strip().split("\n\n")[0].split()) if doc else ""


def _index() -> str:
    """The page of all rooms."""
    parts = [
        "# Python, name by name\n",
        "Every public name of the two libraries has a page, with its signature, what",
        "it means and what it raises. For an overview that you can read from top to",
        "bottom, see [Python](/reference/python.md).\n",
    ]
    for package, said in (
        ("ttr", "Type Theory with Records"),
        ("kille", "the robot, and the laboratory of dialogues"),
    ):
        rooms = [
            it for it in public_rooms().values() if it.name.partition(".")[0] == package
        ]
        parts += [f"## `{package}`: {said}\n", "| room | has |", "| --- | --- |"]
        for it in rooms:
            link = link_in(it.name, f"{FOLDER}/index")
            doc = prose_as_myst(first_sentence(it.doc), link).replace("|", "\\|")
            parts.append(f"| [`{it.name}`](/{room_page(it.name)}.md) | {doc} |")
        parts.append("")
    return "\n".join(parts)


def source_files() -> set[Path]:
    """The files that the pages link to, from the top folder."""
    names = public_names().values()
    files = {it.source.file for it in names}
    files |= {member.source.file for it in names for member in it.members}
    return files | {file_of(it) for it in public_rooms()}
