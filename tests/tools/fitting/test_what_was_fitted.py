"""The page on what the numbers were fitted to leaves none of them out."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "reference" / "fitted-numbers.md"
NUMBERS = {".json", ".npz", ".npy", ".csv", ".tsv"}
"""Files of numbers, not of code, texts, models of toys or settings."""

DATA = re.compile(
    r"\b(sota_kinect|SOTA|ycbv_scenes|YCB-V|ycb_meshes|mosd_scenes|mOSD|ETH-80"
    r"|colour_names_xkcd|spatial_rooms|spatial_logan_sadler|spatial_functional_2019)\b"
)
FITTED = re.compile(r"(?<!be )\bfitted\s+to\b")


def page() -> str:
    return PAGE.read_text("utf-8")


def files(*folders: str) -> list[Path]:
    """The files of the project in these folders, without what was built or cached."""
    found = (path for folder in folders for path in (ROOT / folder).rglob("*"))
    return [it for it in found if it.is_file() and "__pycache__" not in it.parts]


def test_every_packaged_file_of_numbers_is_on_the_page() -> None:
    packaged = [
        it
        for it in files("kille", "ttr", "grammars")
        if it.suffix in NUMBERS and ROOT / "ttr" / "editing" not in it.parents
    ]
    assert len(packaged) >= 4
    room = ROOT / "kille" / "perception"
    named = [
        (
            it.relative_to(room) if room in it.parents else it.relative_to(ROOT)
        ).as_posix()
        for it in packaged
    ]
    assert [it for it in named if f"`{it}`" not in page()] == []


def test_every_script_that_fits_numbers_is_on_the_page() -> None:
    scripts = [
        it.stem
        for it in files("tools/fitting")
        if it.suffix == ".py" and '__name__ == "__main__"' in it.read_text("utf-8")
    ]
    assert len(scripts) >= 4
    assert [it for it in scripts if f"`{it}`" not in page()] == []


def test_every_module_that_speaks_of_a_fit_is_on_the_page() -> None:
    """What a module says was fitted has its place on the page, file or code."""
    speaks = [
        it
        for it in files("kille/perception")
        if it.suffix == ".py" and FITTED.search(it.read_text("utf-8"))
    ]
    assert speaks
    known = {
        "kille/perception/evidence.py": "weighing.json",
        "kille/perception/surfaces/merging.py": "surfaces/merge.npz",
        "kille/perception/colours/words.py": "colours/xkcd.json",
    }
    lost = []
    for it in speaks:
        name = it.relative_to(ROOT).as_posix()
        folder = it.parent.relative_to(ROOT).as_posix()
        if not any(f"`{x}`" in page() for x in (name, folder, known.get(name, name))):
            lost.append(name)
    assert lost == []


def test_every_page_with_figures_on_data_is_on_the_page() -> None:
    """A page that names a data set and has figures is told of: in-sample or not."""
    with_figures = [
        it
        for it in files("docs")
        if it.suffix == ".md"
        and it != PAGE
        and DATA.search(text := it.read_text("utf-8"))
        and re.search(r"(?<![\d\w])(0?\.\d\d\b|\d+ %)", text)
    ]
    assert len(with_figures) >= 4
    links = set(re.findall(r"\]\(([^)#\s]+)", page()))
    linked = {(PAGE.parent / link).resolve() for link in links if "://" not in link}
    assert sorted(set(with_figures) - linked) == []
