"""Run the notebooks of the gallery, and see that they show what they say.

    python tools/notebooks.py                          # all of docs/gallery
    python tools/notebooks.py docs/gallery/teach-the-robot.md

A notebook is a page of MyST Markdown with code cells. Each runs in this process, in a
namespace of its own and in an empty folder, as it would in Jupyter. What the prose says
of an answer is checked where it is said: a comment `<!-- shows: This is a cup. -->` in
the text below a cell has to be part of what that cell shows. A page that fails is named
in one line, with its cell.
"""

from __future__ import annotations

import contextlib
import html
import os
import re
import sys
import tempfile
import time
from base64 import b64decode
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import jupytext
import matplotlib
from IPython.core.displayhook import DisplayHook
from IPython.core.interactiveshell import InteractiveShell
from IPython.core.pylabtools import select_figure_formats
from IPython.display import publish_display_data
from IPython.utils.capture import RichOutput, capture_output
from matplotlib import pyplot as plt
from traitlets.config import Config

ROOT = Path(__file__).resolve().parent.parent
GALLERY = ROOT / "docs" / "gallery"

_SHOWS = re.compile(r"<!--\s*shows:\s*(.*?)\s*-->", flags=re.DOTALL)
_TAG = re.compile(r"<style.*?</style>|<[^>]*>", flags=re.DOTALL)
_WIDTH = 70  # letters of a cell's first line that are repeated
_CACHES = {".hypothesis"}  # of programs that keep what they find out in any folder
_SHOWN = 300  # and of what it shows


class Cell(NamedTuple):
    """A code cell: its number on the page, its text, and what it has to show."""

    number: int
    source: str
    shows: tuple[str, ...]


class _DisplayHook(DisplayHook):
    """Publishes what a cell's last line gives, as it publishes any display."""

    def write_output_prompt(self) -> None:
        """There is nobody to read `Out[1]:`."""

    def write_format_data(
        self, format_dict: dict[str, Any], md_dict: dict[str, Any] | None = None
    ) -> None:
        publish_display_data(format_dict, md_dict)  # type: ignore[no-untyped-call]


class _Shell(InteractiveShell):
    """IPython without a window: figures are shown below their cells."""

    displayhook_class = _DisplayHook

    def enable_gui(self, gui: str | None = None) -> None:
        """Nothing to do without a window."""


class Shown(NamedTuple):
    """What a cell shows: all that can be read, and its pictures as PNG files."""

    text: str
    pictures: tuple[bytes, ...]


class NotebookError(Exception):
    """A page or a cell cannot be run, or shows something else than the page says."""


def notebooks() -> list[Path]:
    """The pages of the gallery that have cells."""
    return [
        it
        for it in sorted(GALLERY.glob("*.md"))
        if "{code-cell}" in it.read_text("utf-8")
    ]


def read_cells(page: Path) -> list[Cell]:
    """The code cells of a page, in order; NotebookError if it has none."""
    try:
        parts = jupytext.reads(page.read_text("utf-8"), fmt="md:myst").cells
    except OSError as error:
        raise NotebookError(f"{page}: cannot be read: {error.strerror}") from error
    cells: list[Cell] = []
    for part in parts:
        if part.cell_type == "code":
            cells.append(Cell(len(cells) + 1, part.source, ()))
        elif cells and (shows := tuple(_SHOWS.findall(part.source))):
            cells[-1] = cells[-1]._replace(shows=cells[-1].shows + shows)
    if not cells:
        raise NotebookError(
            f"{page}: has no cells: a notebook has blocks ```{{code-cell}} ipython3"
        )
    return cells


def run_page(page: Path) -> list[Shown]:
    """Run a notebook from top to bottom; what each cell shows.

    NotebookError names the first cell that fails, or that does not show what the page
    says of it. The folder it runs in must be empty afterwards.
    """
    cells = read_cells(page)
    with _empty_folder() as folder, _shell() as shell:
        shown = [_run_cell(shell, page, cell) for cell in cells]
        left = sorted({it.name for it in folder.iterdir()} - _CACHES)
    if left:
        raise NotebookError(
            f"{page.name}: leaves {', '.join(left)} behind: write to a temporary folder"
        )
    return shown


def _run_cell(shell: InteractiveShell, page: Path, cell: Cell) -> Shown:
    with capture_output() as captured:
        done = shell.run_cell(cell.source)  # type: ignore[no-untyped-call]
    error = done.error_before_exec or done.error_in_exec
    if error is not None:
        what = str(error).strip().partition("\n")[0]
        told = f"{type(error).__name__}: {what}" if what else type(error).__name__
        raise NotebookError(
            _complaint(page, cell, f"{told}: mend the cell, or the page")
        ) from error
    text = captured.stdout + "".join(map(_text_of, captured.outputs))
    if "Traceback (most recent call last)" in text:
        raise NotebookError(_complaint(page, cell, "a value could not be displayed"))
    for told in cell.shows:
        if _without_blanks(told) not in _without_blanks(text):
            shown = " ".join(text.split())[-_SHOWN:] or "nothing"
            raise NotebookError(
                _complaint(
                    page,
                    cell,
                    f"does not show {told!r}, but {shown!r}: change the text below it",
                )
            )
    pictures = filter(None, (it.data.get("image/png") for it in captured.outputs))
    return Shown(text, tuple(map(_bytes_of, pictures)))


def _bytes_of(picture: str | bytes) -> bytes:
    """A picture as bytes; figures come in base64, what a value says of itself not."""
    return b64decode(picture) if isinstance(picture, str) else picture


def _complaint(page: Path, cell: Cell, what: str) -> str:
    first = cell.source.strip().partition("\n")[0][:_WIDTH]
    return f"{page.name}: cell {cell.number} ({first}): {what}"


def _text_of(output: RichOutput) -> str:
    page = html.unescape(_TAG.sub("", output.data.get("text/html", "")))
    return f"{output.data.get('text/plain', '')}\n{page}\n"


def _without_blanks(text: str) -> str:
    return "".join(text.split())


@contextlib.contextmanager
def _shell() -> Iterator[InteractiveShell]:
    """A shell that draws figures as a notebook does, and keeps no history."""
    settings = Config()
    settings.HistoryManager.enabled = False
    settings.InteractiveShell.colors = "nocolor"
    backend = matplotlib.get_backend()
    hook = sys.excepthook
    shell = _Shell.instance(config=settings, user_module=ModuleType("notebook"))
    try:
        with matplotlib.rc_context():
            shell.enable_matplotlib("inline")  # type: ignore[no-untyped-call]
            # The backend does it once in a process, for the first shell.
            select_figure_formats(shell, {"png"}, bbox_inches="tight")  # type: ignore[no-untyped-call]
            yield shell
    finally:
        _Shell.clear_instance()
        plt.close("all")
        plt.switch_backend(backend)
        sys.excepthook = hook


@contextlib.contextmanager
def _empty_folder() -> Iterator[Path]:
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(before)


def main(arguments: Sequence[str]) -> int:
    """Run the pages that are named, or all; 1 if one of them fails."""
    failed = 0
    for page in [Path(it).resolve() for it in arguments] or notebooks():
        started = time.process_time()
        try:
            run_page(page)
        except NotebookError as error:
            failed = 1
            print(error, file=sys.stderr)
        else:
            print(f"{page.name}: fine, {time.process_time() - started:.1f} s")
    return failed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
