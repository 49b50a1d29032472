"""Composes what Sphinx reads: the pages of the repository, and those that are made."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

from tools.website.api_pages import api_pages, source_files
from tools.website.bibliography import BIBLIOGRAPHY, cited_as
from tools.website.game_pages import game_pages
from tools.website.public_names import ROOT
from tools.website.repository_pages import (
    DOCS,
    OTHER_PAGES,
    Pages,
    first_paragraph,
    linked_pages,
    page_of_file,
    title_of,
)

HERE = Path(__file__).parent
FRONT = HERE / "front.md"

SECTIONS = {
    "how-to": (
        "How to",
        "A question a page.",
    ),
    "explanation": ("Explanation", "What it means, why it is so, and what was found."),
    "reference": ("Reference", "What there is, to look things up in."),
}
"""The sections of the documentation: their titles, and what is said of them."""

_ALWAYS_SHOWN = [
    "kille/dialogue/games",
    "examples",
    "grammars",
    "tests/theories",
    "tests/games",
    "LICENSE",
]
_MADE = ("api/", "decisions/", "games/")
"""Pages that an index of theirs lists, and not the list of contents at the side."""


def compose(folder: Path, has_playground: bool = False) -> set[Path]:
    """Writes the pages into a folder; gives the files of the repository they link to.

    A page that is as it was is not written, so that Sphinx reads only what is new.
    """
    pages = Pages(cited_as())
    made = {**_repository(pages), **_sections(), **api_pages(), **game_pages()}
    made["reference/bibliography"] = BIBLIOGRAPHY
    made["index"] = _front(has_playground)
    folder.mkdir(parents=True, exist_ok=True)
    written = {Path(f"{name}.md") for name in made}
    for old in folder.rglob("*.md"):
        if old.relative_to(folder) not in written:
            old.unlink()
    for name, text in made.items():
        _write(folder / f"{name}.md", text)
    for picture in sorted(DOCS.rglob("*.png")):
        target = folder / picture.relative_to(DOCS)
        if not target.exists() or target.stat().st_mtime < picture.stat().st_mtime:
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(picture, target)
    return pages.files | source_files() | set(map(Path, _ALWAYS_SHOWN))


def _repository(pages: Pages) -> Mapping[str, str]:
    """The pages that the repository has."""
    others = [Path(it) for it in OTHER_PAGES if it != "README.md"]
    files = [*others, *(it.relative_to(ROOT) for it in sorted(DOCS.rglob("*.md")))]
    found = {}
    for file in files:
        name = page_of_file(file)
        assert name is not None
        text = pages.page(file)
        if name.startswith(_MADE) and not name.endswith("README"):
            text = f"---\norphan: true\n---\n\n[All decisions](README.md)\n\n{text}"
        if name == "contents":
            text = f"---\norphan: true\n---\n\n{text}"
        found[name] = text
    if "gallery/index" in found:
        found["gallery/index"] += _toctree(
            it for it in found if it.startswith("gallery/") and it != "gallery/index"
        )
    return found


def _sections() -> Mapping[str, str]:
    """The pages that list what is in each section, in the order of the index."""
    index = (DOCS / "index.md").read_text("utf-8")
    listed = [*dict.fromkeys(filter(None, map(page_of_file, linked_pages(index))))]
    every = [
        str(page_of_file(it.relative_to(ROOT))) for it in sorted(DOCS.rglob("*.md"))
    ]
    made = {}
    for section, (title, said) in SECTIONS.items():
        inside = [it for it in [*listed, *every] if it.startswith(f"{section}/")]
        names = [*dict.fromkeys(inside)]
        more = ["reference/bibliography"] if section == "reference" else []
        cards = [_card(name, section) for name in names]
        if section == "reference":
            cards.insert(0, _API_CARD)
            names = ["/api/index", "/games/index", *names]
        made[f"{section}/index"] = "\n".join(
            [
                f"# {title}\n",
                f"{said}\n",
                *cards,
                _toctree(["/" + it.lstrip("/") for it in [*names, *more]]),
            ]
        )
    return made


_API_CARD = """\
**[Python, name by name](/api/index.md)**
: Every public name, with its signature, what it raises and an example.
"""


def _card(name: str, section: str) -> str:
    """A page as an entry of a list: its title, and how it begins."""
    text = (DOCS / f"{name}.md").read_text("utf-8")
    said = re.split(r"(?<=[.!?:]) ", first_paragraph(text))[0].rstrip(":")
    target = name.removeprefix(f"{section}/")
    return f"**[{title_of(text)}]({target}.md)**\n: {said}\n"


def _front(has_playground: bool) -> str:
    """The front page; its way to the playground leads to it, if there is one."""
    there = "playground/index.html" if has_playground else _ABOUT_PLAYGROUND
    text = FRONT.read_text("utf-8").replace("PLAYGROUND", there)
    return text + _contents()


_ABOUT_PLAYGROUND = "how-to/run-a-theory-in-a-browser.html"


def _contents() -> str:
    """What stands in the list of contents at the side."""
    main = ["tutorial", "gallery/index", "how-to/index", "explanation/index"]
    project = ["architecture", "contributing", "changelog", "security"]
    return _toctree([*main, "reference/index", "decisions/README"]) + _toctree(
        project, "The project"
    )


def _toctree(names: Iterator[str] | list[str], caption: str = "") -> str:
    said = f":caption: {caption}\n" if caption else ""
    lines = "\n".join(it if it.startswith("/") else f"/{it}" for it in names)
    return f"\n```{{toctree}}\n:hidden:\n{said}\n{lines}\n```\n"


def _write(file: Path, text: str) -> None:
    if not file.is_file() or file.read_text("utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
