"""Builds the playground: the page, Pyodide, `ttr` and the examples, in one folder."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

from tools.playground.links import LONGEST_FRAGMENT, LONGEST_TEXT
from tools.playground.pyodide import pyodide_files, wheels
from ttr.display.html import STYLE
from ttr.notation.scanning import LETTER, LETTER_OR_DIGIT
from ttr.notation.syntax_errors import KEYWORDS
from ttr.types.reserved_words import RESERVED

ROOT = Path(__file__).resolve().parent.parent.parent
ASSETS = Path(__file__).resolve().parent / "assets"
THEORIES = ("functions", "gameboard", "collections", "attitudes", "scopes", "mistakes")
"""Which theories of the tests are examples, too."""

_WHEN = (2000, 1, 1, 0, 0, 0)


def build(folder: Path) -> None:
    """Write the playground into a folder; raises `FetchError` without Pyodide."""
    for name, data in pyodide_files().items():
        _write(folder / "pyodide" / name, data)
    for file in sorted(ASSETS.iterdir()):
        _write(folder / file.name, file.read_bytes())
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
    """The examples: name, title and text; the title is the first line's comment."""
    paths = [*sorted((ROOT / "examples").glob("*.ttr"))]
    paths += [ROOT / "tests" / "theories" / f"{name}.ttr" for name in THEORIES]
    found = []
    for path in paths:
        text = path.read_text(encoding="utf-8")
        first = text.splitlines()[0].lstrip("# ").rstrip(".")
        found.append({"name": path.stem, "title": first, "text": text})
    return found
