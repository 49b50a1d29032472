"""The Markdown of the repository as pages of the site: links lead to pages there.

What readers see in the repository stays as it is. On the site a link to a page is one
to the page, a link to a file of the program one to its text, names of Python lead to
the reference, and works that are cited to the bibliography.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from tools.website.api_pages import FOLDER, page_of, room_page
from tools.website.public_names import ROOT, known_paths, public_rooms

DOCS = ROOT / "docs"

OTHER_PAGES = {
    "CONTRIBUTING.md": "contributing",
    "CHANGELOG.md": "changelog",
    "SECURITY.md": "security",
    "README.md": "index",
    "docs/index.md": "contents",
}
"""The pages of the site that stand at another place in the repository."""

_FENCE = re.compile(r"^(?P<fence>`{3,}|~{3,}).*?^(?P=fence)[ \t]*$", flags=re.M | re.S)
_LINK = re.compile(
    r"(?P<picture>!?)\[(?P<text>(?:[^\[\]`]|`[^`]*`|\[[^\]]*\])*)\]\((?P<target>[^)\s]+)\)"
)
_CODE = re.compile(r"`[^`\n]+`")


@dataclass
class Pages:
    """Pages of the repository, and the files that they link to."""

    bibliography: Mapping[str, str] = field(default_factory=dict)
    files: set[Path] = field(default_factory=set)

    def page(self, path: Path) -> str:
        """A page of the repository as it is on the site, in MyST."""
        text = (ROOT / path).read_text("utf-8")
        named = _names_of(text) if path.name == "python.md" else dict[str, str]()
        return _outside_of_fences(text, lambda it: self._prose(it, path, named))

    def _prose(self, text: str, path: Path, named: Mapping[str, str]) -> str:
        """Text outside of blocks of code, with its links."""
        pieces: list[str] = []

        def keep(piece: str) -> str:
            pieces.append(piece)
            return f"\0{len(pieces) - 1}\0"

        text = _rows(text, named) if named else text
        text = _LINK.sub(lambda it: keep(self._link(it, path)), text)
        text = "\n".join(
            it if it.startswith("#") else _CODE.sub(lambda m: keep(_code(m[0])), it)
            for it in text.split("\n")
        )
        text = re.sub(r"^#.*$", lambda it: keep(it[0]), text, flags=re.M)
        text = self._link_citations(text, path)
        while "\0" in text:
            text = re.sub("\0(\\d+)\0", lambda it: pieces[int(it[1])], text)
        return text

    def _link(self, found: re.Match[str], path: Path) -> str:
        picture, text, target = found["picture"], found["text"], found["target"]
        if "://" in target or target.startswith(("#", "mailto:", "/")):
            return found[0]
        file, _, anchor = target.partition("#")
        there = Path(os.path.normpath(path.parent / file))
        here = Path(page_of_file(path) or path)
        if picture:
            return f"![{text}]({os.path.relpath(_in_docs(there), here.parent)})"
        if page := page_of_file(there):
            to = os.path.relpath(page, here.parent)
            return f"[{text}]({to}.md{'#' if anchor else ''}{anchor})"
        self.files.add(there)
        name = "index" if (ROOT / there).is_dir() else ""
        href = os.path.relpath(Path("source") / there / name, here.parent)
        at = anchor or _defined_name(text, there)
        return f'<a href="{href}.html{"#" if at else ""}{at}">{text}</a>'

    def _link_citations(self, text: str, path: Path) -> str:
        """Text in which works that are cited are links to the bibliography."""
        if not self.bibliography:
            return text
        up = os.path.relpath(
            "reference/bibliography.html", Path(page_of_file(path) or "").parent
        )
        every = "|".join(
            re.escape(it).replace(r"\ ", r"\s+")
            for it in sorted(self.bibliography, key=len, reverse=True)
        )

        def link(found: re.Match[str]) -> str:
            place = self.bibliography[" ".join(found[0].split())]
            return f'<a class="cited" href="{up}#{place}">{found[0]}</a>'

        return re.sub(rf"(?<![\w(])(?:{every})(?!\w)", link, text)


def page_of_file(path: Path) -> str | None:
    """The page of the site that a file of the repository is, without a suffix."""
    if (name := path.as_posix()) in OTHER_PAGES:
        return OTHER_PAGES[name]
    if path.suffix == ".md" and path.parts[0] == "docs" and (ROOT / path).is_file():
        return path.relative_to("docs").with_suffix("").as_posix()
    return None


def title_of(text: str) -> str:
    """The first heading of a page."""
    found = re.search(r"^# +(.+)$", text, flags=re.M)
    return found[1].strip() if found else ""


def first_paragraph(text: str) -> str:
    """The first paragraph of prose of a page, without its links."""
    after = (
        re.sub(r"\A---\n.*?^---\n", "", text, flags=re.M | re.S).partition("\n# ")[2]
        or text
    )
    after = after.partition("\n")[2]
    for paragraph in re.split(r"\n\s*\n", _FENCE.sub("", after)):
        if (said := " ".join(paragraph.split())) and not said.startswith(
            ("#", "|", "!", "<")
        ):
            return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", said)
    return ""


def linked_pages(text: str) -> Iterator[Path]:
    """The pages that the index of the documentation links to, in its order."""
    for found in _LINK.finditer(text):
        there = Path(os.path.normpath(Path("docs") / found["target"].partition("#")[0]))
        if page_of_file(there):
            yield there


def _outside_of_fences(text: str, change: Callable[[str], str]) -> str:
    parts, last = [], 0
    for found in _FENCE.finditer(text):
        parts += [change(text[last : found.start()]), _fence(found[0])]
        last = found.end()
    return "".join([*parts, change(text[last:])])


def _fence(block: str) -> str:
    """A block of code: the name of a file stands above it, its language stays."""
    head, _, rest = block.partition("\n")
    mark = re.match(r"[`~]+", head)
    assert mark is not None
    language, _, file = head[mark.end() :].partition(" ")
    if language.startswith("{"):
        return block
    if language == "python" and ">>> " in rest:
        language = "pycon"
    language = language or "text"
    name = f'<div class="file-name">{file}</div>\n\n' if file else ""
    return f"{name}{mark[0]}{language}\n{rest}"


def _in_docs(path: Path) -> Path:
    return path.relative_to("docs") if path.parts[0] == "docs" else path


def _defined_name(text: str, file: Path) -> str:
    """The name that a link to a file of Python is about, if it is defined there."""
    if file.suffix != ".py" or not text.startswith("`"):
        return ""
    called = text.strip("`")
    if "::" in called:
        name = called.partition("::")[2]
    else:
        module = file.with_suffix("").as_posix().replace("/", ".")
        name = called.removeprefix(f"{module.removesuffix('.__init__')}.")
    source = (ROOT / file).read_text("utf-8")
    last = name.rpartition(".")[2]
    found = re.search(
        rf"^(?: {{4}})?(?:def |class |){re.escape(last)}\b", source, flags=re.M
    )
    return f"{name}" if found and re.fullmatch(r"[\w.]+", name) else ""


def _code(span: str) -> str:
    """A name of Python in backticks, as a link to its page."""
    name = re.sub(r"\(.*\)$", "", span.strip("`"))
    if not re.fullmatch(r"(?:ttr|kille)\.[\w.]+", name):
        return span
    if name in public_rooms():
        return f"[{span}](/{room_page(name)}.md)"
    if found := known_paths().get(name):
        return f"[{span}](/{page_of(found)}.md)"
    return span


def _names_of(text: str) -> dict[str, str]:
    """The pages of the names in the tables of the overview of Python."""
    found, room = dict[str, str](), ""
    for line in text.splitlines():
        if line.startswith("#"):
            room = line.strip("# `")
        if line.startswith("| `"):
            for name in re.findall(r"`(\w+)`", line.split("|")[1]):
                path = f"{room}.{name}"
                if public := known_paths().get(path):
                    found[f"{room}:{name}"] = page_of(public)
                elif public := known_paths().get(room):
                    described = name in {it.name for it in public.members}
                    at = f".md#{public.path}.{name}" if described else ""
                    found[f"{room}:{name}"] = f"{page_of(public)}{at}"
    return found


def _rows(text: str, named: Mapping[str, str]) -> str:
    """The tables of the overview of Python, each name a link to its page."""
    lines, room = [], ""
    for line in text.split("\n"):
        if line.startswith("#"):
            room = line.strip("# `")
            if room in public_rooms():
                line = f"{line}\n\n[Each name by itself](/{FOLDER}/{room}.md)"
        if line.startswith("| `"):
            _, first, rest = line.split("|", 2)
            first = re.sub(
                r"`(\w+)`", partial(_row_link, room=room, named=named), first
            )
            line = f"|{first}|{rest}"
        lines.append(line)
    return "\n".join(lines)


def _row_link(found: re.Match[str], room: str, named: Mapping[str, str]) -> str:
    page = named.get(f"{room}:{found[1]}")
    if page is None:
        return found[0]
    if "#" in page:
        return f'<a href="../{page.replace(".md#", ".html#")}">{found[0]}</a>'
    return f"[{found[0]}](/{page}.md)"
