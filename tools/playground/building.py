"""Builds the playground: the page, Pyodide, `ttr` and the examples, in one folder."""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

from tools.playground.links import LONGEST_FRAGMENT, LONGEST_TEXT
from tools.playground.pyodide import pyodide_files, wheels
from tools.playground.texts import theories_in_notebook
from ttr.display.html import STYLE
from ttr.notation.scanning import LETTER, LETTER_OR_DIGIT
from ttr.notation.syntax_errors import KEYWORDS
from ttr.types.reserved_words import RESERVED

ROOT = Path(__file__).resolve().parent.parent.parent
ASSETS = Path(__file__).resolve().parent / "assets"
THEORIES = ("functions", "gameboard", "collections", "attitudes", "scopes", "mistakes")
"""Which theories of the tests are examples, too."""

_DOCUMENTATION = "<!-- documentation -->"
"""Where the page has the link to the documentation."""

_WHEN = (2000, 1, 1, 0, 0, 0)


def build(folder: Path, documentation: str = "") -> None:
    """Write the playground into a folder; raises `FetchError` without Pyodide.

    It links to the front page of the `documentation`, if that is somewhere.
    """
    for name, data in pyodide_files().items():
        _write(folder / "pyodide" / name, data)
    for file in sorted(ASSETS.iterdir()):
        _write(folder / file.name, file.read_bytes())
    page = (ASSETS / "index.html").read_text(encoding="utf-8")
    link = f'<a class="bar__link" href="{documentation}">Documentation</a>'
    page = page.replace(_DOCUMENTATION, link if documentation else "")
    _write(folder / "index.html", page.encode())
    icon = ROOT / "kille" / "page" / "assets" / "icon.svg"
    _write(folder / "icon.svg", icon.read_bytes())
    _write(folder / "matrix.css", STYLE.encode())
    _write(folder / "vocabulary.js", _vocabulary().encode())
    _write(folder / "python.zip", _python())
    _write(folder / "examples.json", json.dumps(_examples(), indent=1).encode())


def _write(path: Path, data: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def _vocabulary() -> str:
    """What the editor has to know of the notation, from the notation itself."""
    known = {
        "KEYWORDS": sorted(KEYWORDS),
        "RESERVED": sorted(RESERVED),
        "LETTER": LETTER,
        "LETTER_OR_DIGIT": LETTER_OR_DIGIT,
        "LONGEST_FRAGMENT": LONGEST_FRAGMENT,
        "LONGEST_TEXT": LONGEST_TEXT,
    }
    lines = [f"export const {k} = {json.dumps(v)};\n" for k, v in known.items()]
    return "// Made from ttr/notation.\n" + "".join(lines)


def _python() -> bytes:
    """`ttr` and its libraries, as an archive that is the same each time."""
    files = {
        path.relative_to(ROOT).as_posix(): path.read_bytes()
        for path in (ROOT / "ttr").rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }
    files["playground_answers.py"] = (Path(__file__).parent / "answers.py").read_bytes()
    for wheel in wheels():
        with zipfile.ZipFile(io.BytesIO(wheel)) as library:
            files |= {name: library.read(name) for name in library.namelist()}
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, _WHEN)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, files[name])
    return packed.getvalue()


def _examples() -> list[dict[str, str]]:
    """The examples: name, group, title and text, as the page lists them."""
    return [*_examples_of_gallery(), *_examples_in_files()]


def _examples_of_gallery() -> Iterator[dict[str, str]]:
    """The theories of the notebooks, by what these ask."""
    for page in sorted((ROOT / "docs" / "gallery").glob("*.md")):
        text = page.read_text(encoding="utf-8")
        title = re.search(r"^# (.+)$", text, re.MULTILINE)
        for number, theory in enumerate(theories_in_notebook(text)):
            assert title is not None
            yield _example(f"{page.stem}-{number}", "Gallery", title[1], theory)


def _examples_in_files() -> Iterator[dict[str, str]]:
    """Theories in files, by the comment in the first line of each."""
    paths = [*sorted((ROOT / "examples").glob("*.ttr"))]
    paths += [ROOT / "tests" / "theories" / f"{name}.ttr" for name in THEORIES]
    for path in paths:
        text = path.read_text(encoding="utf-8")
        first = text.splitlines()[0].lstrip("# ").rstrip(".")
        yield _example(path.stem, "Files", first, text)


def _example(name: str, group: str, title: str, text: str) -> dict[str, str]:
    return {"name": name, "group": group, "title": title, "text": text}
