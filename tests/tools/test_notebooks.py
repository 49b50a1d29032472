"""Notebooks run and show what they say; what fails is named by its page and cell."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("IPython", reason="needs kille[docs]")
pytest.importorskip("jupytext", reason="needs kille[docs]")
pytest.importorskip("matplotlib", reason="needs kille[plots]")

from tools.notebooks import ROOT, NotebookError, notebooks, read_cells, run_page
from tools.playground.texts import theories_in_notebook
from ttr import Theory, check

GALLERY = notebooks()


@pytest.mark.parametrize("page", GALLERY, ids=lambda page: page.stem)
def test_a_notebook_runs_and_shows_what_it_says(page: Path) -> None:
    run_page(page)


@pytest.mark.parametrize("page", GALLERY, ids=lambda page: page.stem)
def test_a_notebook_asks_a_question_and_says_what_to_change(page: Path) -> None:
    titles = [it for it in page.read_text("utf-8").splitlines() if it.startswith("#")]
    prose = [it for it in titles if it.startswith(("# ", "## "))]
    assert prose[0].endswith("?")
    assert prose[-1] == "## What to change"
    cells = read_cells(page)
    checked = [it for it in cells if it.shows or "assert " in it.source]
    assert len(checked) >= 3, "hardly anything that it says is checked"


@pytest.mark.parametrize("page", GALLERY, ids=lambda page: page.stem)
def test_a_notebook_has_a_theory_that_opens_or_says_why_not(page: Path) -> None:
    text = page.read_text("utf-8")
    opened = theories_in_notebook(text)
    for theory in opened:
        assert check(Theory.parse(theory)).holds
    assert opened or "../how-to/run-a-theory-in-a-browser.md" in text


def write_page(folder: Path, *parts: str) -> Path:
    """A notebook whose cells are the parts in backquotes; others are prose."""
    page = folder / "page.md"
    fenced = (
        f"```{{code-cell}} ipython3\n{part.strip('`')}\n```" if "`" in part else part
        for part in parts
    )
    page.write_text("\n\n".join(["# Why?", *fenced]) + "\n", encoding="utf-8")
    return page


def complaint(page: Path) -> str:
    with pytest.raises(NotebookError) as failure:
        run_page(page)
    return str(failure.value)


def test_a_cell_that_fails_is_named_with_its_page_and_first_line(
    tmp_path: Path,
) -> None:
    page = write_page(tmp_path, "`n = 0`", "Now divide.", "`m = 1\nm / n`", "`m = 2`")
    told = complaint(page)
    assert told.startswith(
        "page.md: cell 2 (m = 1): ZeroDivisionError: division by zero"
    )
    assert "\n" not in told


def test_a_cell_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    page = write_page(tmp_path, "`n = 0`", "`n = (`")
    assert complaint(page).startswith("page.md: cell 2 (n = (): ")
    assert "SyntaxError" in complaint(page)


def test_what_the_text_below_a_cell_says_has_to_be_shown(tmp_path: Path) -> None:
    parts = "`print('a cup')`", "So it is. <!-- shows: a  cup -->", "`print('a hat')`"
    shown = run_page(write_page(tmp_path, *parts))
    assert [it.text for it in shown] == ["a cup\n", "a hat\n"]
    told = complaint(write_page(tmp_path, *parts, "A mug. <!-- shows: a mug -->"))
    assert told.startswith(
        "page.md: cell 2 (print('a hat')): does not show 'a mug', but 'a hat'"
    )


def test_what_is_displayed_is_compared_as_it_is_read(tmp_path: Path) -> None:
    shown = "`import ttr\nttr.rectype(x=ttr.Ind)`", "<!-- shows: [x : Ind] -->"
    run_page(write_page(tmp_path, *shown))


def test_a_value_that_cannot_be_displayed_fails(tmp_path: Path) -> None:
    broken = "class Odd:\n    def _repr_html_(self):\n        raise ValueError('odd')"
    page = write_page(tmp_path, f"`{broken}`", "`Odd()`")
    assert complaint(page).startswith("page.md: cell 2 (Odd()): ")


def test_figures_are_shown_and_closed(tmp_path: Path) -> None:
    from matplotlib import pyplot as plt

    drawing = "`from matplotlib import pyplot as plt\nfig, ax = plt.subplots()`"
    [shown] = run_page(write_page(tmp_path, drawing, "<!-- shows: <Figure -->"))
    [picture] = shown.pictures
    assert picture.startswith(b"\x89PNG")
    assert not plt.get_fignums()


def test_a_notebook_leaves_nothing_behind(tmp_path: Path) -> None:
    before = os.getcwd()
    page = write_page(tmp_path, "`open('left.txt', 'w').close()`")
    assert "leaves left.txt behind" in complaint(page)
    assert os.getcwd() == before
    assert [*tmp_path.iterdir()] == [page]


def test_notebooks_know_nothing_of_each_other(tmp_path: Path) -> None:
    run_page(write_page(tmp_path, "`secret = 7`"))
    assert "NameError" in complaint(write_page(tmp_path, "`secret`"))


def test_a_page_without_cells_is_no_notebook(tmp_path: Path) -> None:
    assert "has no cells" in complaint(write_page(tmp_path, "Nothing."))


def test_the_program_names_what_fails_and_exits_with_1(tmp_path: Path) -> None:
    page = write_page(tmp_path, "`unknown`")
    command = [sys.executable, "tools/notebooks.py", str(page), str(tmp_path / "no.md")]
    done = subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, encoding="utf-8"
    )
    assert done.returncode == 1
    first, second = done.stderr.splitlines()
    assert first.startswith("page.md: cell 1 (unknown): NameError")
    assert "no.md: cannot be read" in second
