"""`kille evaluate`: tables, JSON, the report, and one line for each mistake."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import subprocess
import time
from html.parser import HTMLParser
from pathlib import Path

import cv2
import numpy as np
import pytest
from rich.console import Console

from kille.interfaces import evaluate as interface
from kille.interfaces.grids import print_table
from kille.lab.reports import drawing
from kille.lab.results import Figure, Result, Table

from .conftest import COMMAND, Run

LEARNERS = """
import math

class Nearest:
    def __init__(self):
        self.lessons = []
    def learn_one(self, x, y):
        self.lessons.append((self.colour(x), y))
    def predict_proba_one(self, x):
        colour = self.colour(x)
        return {min(self.lessons, key=lambda it: math.dist(it[0], colour))[1]: .9}
    def colour(self, x):
        return tuple(x.frame.colour[x.region.mask].mean(axis=0))

class Failing(Nearest):
    def predict_proba_one(self, x):
        raise ZeroDivisionError("of what?")
"""
INKS = {"lime": (40, 200, 60), "<b>plum</b>": (120, 30, 120)}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to work in, with pictures of two categories and learners."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("COLUMNS", raising=False)
    Path("mine.py").write_text(LEARNERS)
    for word, ink in INKS.items():
        for number in range(4):
            picture = np.full((60, 80, 3), 190, np.uint8)
            cv2.circle(picture, (40 + number, 30), 18, ink, -1)
            path = Path("photos", word.replace("/", "\u2044"), f"{number}.png")
            path.parent.mkdir(parents=True, exist_ok=True)
            assert cv2.imwrite(str(path), picture)
    return tmp_path


OBJECTS = ("evaluate", "objects")
MINE = (*OBJECTS, "photos", "--method", "mine.py:Nearest")


def test_tables_for_people(kille: Run, place: Path) -> None:
    outcome = kille(*MINE, "--protocol", "even-odd")
    assert (outcome.code, outcome.err) == (0, "")
    assert re.search(
        r"mine\.py:Nearest +4 of 4 +1\.000 +51 %–100 % +1\.000", outcome.out
    )
    assert "Share right by category" in outcome.out


@pytest.mark.parametrize("columns", [30, 40, 100])
def test_nothing_is_cut_off_on_a_narrow_terminal(
    kille: Run, place: Path, monkeypatch: pytest.MonkeyPatch, columns: int
) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    out = kille(*MINE, "--protocol", "even-odd").out
    assert max(map(len, out.splitlines())) <= columns
    assert "…" not in out
    assert "4 of 4" in out


def test_json_for_machines(kille: Run, place: Path) -> None:
    outcome = kille(*MINE, "--json", "--seed", "5")
    report = json.loads(outcome.out, parse_constant=pytest.fail)
    assert (outcome.code, outcome.err) == (0, "")
    assert [it["protocol"] for it in report["results"]] == [
        "even-odd",
        "halves",
        "shots",
        "degrees",
    ]
    assert (report["seed"], report["failed"]) == (5, [])
    assert report["results"][0]["facts"]["methods"] == {"mine.py:Nearest": 1.0}
    assert kille(*MINE, "--json", "--seed", "5").out == outcome.out


def test_the_methods_named_are_those_that_took_part(
    kille: Run, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    result = Result("r", (), (), {})
    apart = interface.Plan("apart", lambda *_, **__: result, compares=("one", "other"))
    monkeypatch.setattr(interface, "object_plans", lambda *_: (apart,))
    report = json.loads(kille(*MINE, "--json", "--report", "a.html").out)
    assert report["methods"] == ["one", "other"]
    assert "<dt>methods</dt><dd>one, other</dd>" in Path("a.html").read_text()


def test_a_learner_that_fails_is_named_and_the_others_go_on(
    kille: Run, place: Path
) -> None:
    outcome = kille(*MINE, "--method", "mine.py:Failing", "--protocol", "halves")
    assert outcome.code == 1
    assert outcome.complaint == (
        "kille: the method mine.py:Failing failed: "
        "predict_proba_one: ZeroDivisionError: of what?"
    )
    assert "mine.py:Nearest" in outcome.out
    assert "Failing" not in outcome.out


def test_where_all_fail_there_is_no_table(kille: Run, place: Path) -> None:
    outcome = kille(*OBJECTS, "photos", "--method", "mine.py:Failing", "--json")
    assert outcome.code == 1
    report = json.loads(outcome.out)
    assert report["results"] == []
    assert "of what?" in report["failed"][0]


WRONG = {
    ("photoz",): "there is no folder photoz: did you mean photos?",
    ("mine.py",): "mine.py is a file, not a folder; expected a folder category",
    ("empty",): "empty is empty; expected a folder category/picture.png",
    ("single",): "it takes pictures of two categories at least",
    (".",): ". holds several collections, name one: ./photos, ./single",
    ("photos", "--protocol", "shotz"): "did you mean shots?",
    (
        "photos",
        "--protocol",
        "paper",
    ): "for this data there is even-odd, halves, shots, degrees",
    ("photos", "--method", "defualt"): "did you mean default?",
    ("photos", "--method", "mine.py:Neerest"): "mine.py has no Neerest: did you mean",
    ("photos", "--report", "empty"): "empty is a folder",
    ("photos", "--report", "no/a.html"): "there is no folder no",
    ("photos", "--report", "photos/lime/0.png"): "ends in .html",
    ("photos", "--teach", "0001"): "for a folder of labelled scenes only",
}


WRONG_RELATIONS = {
    ("photos",): "photos",
    ("--protocol", "judgements"): (
        "the protocol judgements is for people's judgements; "
        "for this data there is paper"
    ),
    ("--protocol", "shots"): "there is no protocol shots: there is paper",
}


@pytest.mark.parametrize(
    ("words", "told"), WRONG_RELATIONS.items(), ids=map(" ".join, WRONG_RELATIONS)
)
def test_a_mistake_about_relations_is_one_line(
    kille: Run, place: Path, words: tuple[str, ...], told: str
) -> None:
    outcome = kille("evaluate", "relations", *words)
    assert (outcome.code, outcome.out) == (2, "")
    assert told in outcome.complaint


@pytest.mark.parametrize(("words", "told"), WRONG.items(), ids=map(" ".join, WRONG))
def test_a_mistake_is_one_line(
    kille: Run, place: Path, words: tuple[str, ...], told: str
) -> None:
    Path("empty").mkdir()
    Path("single/lime").mkdir(parents=True)
    Path("single/lime/0.png").write_bytes(Path("photos/lime/0.png").read_bytes())
    method = () if "--method" in words else ("--method", "mine.py:Nearest")
    outcome = kille(*OBJECTS, *words, *method)
    assert (outcome.code, outcome.out) == (2, "")
    assert told in outcome.complaint


def test_a_single_picture_leaves_out_the_learning_curve(
    kille: Run, place: Path
) -> None:
    for number in (1, 2, 3):
        Path("photos/lime", f"{number}.png").unlink()
    outcome = kille(*MINE, "--json")
    found = [it["protocol"] for it in json.loads(outcome.out)["results"]]
    assert (outcome.code, found) == (0, ["even-odd", "halves"])
    assert "one picture only" in kille(*MINE, "--protocol", "shots").complaint


# --- the report ----------------------------------------------------------------------


class _Page(HTMLParser):
    """What a page refers to, and whether its elements are nested well."""

    VOID = frozenset({"meta", "img", "br"})

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.names: list[str] = []
        self.outside: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)
        if tag not in self.VOID:
            self.open.append(tag)
        for name, value in attrs:
            refers = name in ("src", "href", "xlink:href", "data")
            if refers and not (value or "").startswith(("#", "data:")):
                self.outside.append(f"{tag} {name}={value}")

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def parsed(page: str) -> _Page:
    found = _Page()
    found.feed(page)
    assert found.open == []
    return found


def test_the_report_stands_alone_and_is_escaped(kille: Run, place: Path) -> None:
    outcome = kille(*MINE, "--report", "it's <here>.html")
    assert (outcome.code, outcome.err) == (0, "report: it's <here>.html\n")
    text = Path("it's <here>.html").read_text("utf-8")
    page = parsed(text)
    assert page.outside == []
    assert "b" not in page.names
    assert "&lt;b&gt;plum&lt;" in text
    assert page.names.count("table") >= 5
    assert str(place) not in text


def test_the_same_seed_writes_the_same_report(kille: Run, place: Path) -> None:
    texts = []
    for _ in range(2):
        kille(*MINE, "--protocol", "shots", "--report", "a.html")
        texts.append(Path("a.html").read_text("utf-8"))
    assert texts[0] == texts[1]


def test_without_matplotlib_tables_still_come(
    kille: Run, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drawing, "find_spec", lambda name: None)
    outcome = kille(*MINE, "--protocol", "halves", "--report", "a.html")
    assert outcome.code == 0
    assert "4 of 4" in outcome.out
    assert "pip install 'kille[plots]'" in outcome.complaint
    assert "svg" not in parsed(Path("a.html").read_text("utf-8")).names


def test_a_report_that_cannot_be_written_is_told(program: Run, place: Path) -> None:
    (place / "locked").mkdir(mode=0o500)
    outcome = program(*MINE, "--protocol", "halves", "--report", "locked/a.html")
    assert outcome.code == 2
    assert "locked/a.html cannot be written: permission denied" in outcome.err
    assert [*(place / "locked").iterdir()] == []


@pytest.mark.parametrize("what", ["objects", "relations"])
@pytest.mark.parametrize("mode", [0o000, 0o444])
def test_a_folder_that_may_not_be_looked_into_is_told(
    program: Run, place: Path, what: str, mode: int
) -> None:
    (place / "photos").chmod(mode)
    outcome = program("evaluate", what, "photos")
    (place / "photos").chmod(0o755)
    assert outcome.code == 2
    assert "Traceback" not in outcome.err
    assert outcome.err.startswith("kille: ")


def test_after_ctrl_c_there_is_no_half_report(place: Path) -> None:
    started = place / "started"
    slow = f"""
from pathlib import Path
import time
from mine import Nearest
class Slow(Nearest):
    def learn_one(self, x, y):
        Path({str(started)!r}).touch()
        time.sleep(60)
"""
    Path("slow.py").write_text(slow)
    words = [*OBJECTS, "photos", "--method", "slow.py:Slow", "--report", "a.html"]
    run = subprocess.Popen([*COMMAND, *words], stderr=subprocess.PIPE)
    while not started.exists():
        assert run.poll() is None
        time.sleep(0.05)
    os.kill(run.pid, signal.SIGINT)
    _, err = run.communicate(timeout=120)
    assert (run.returncode, err.strip()) == (130, b"")
    assert not [*place.glob("*a.html*")]


# --- printing ------------------------------------------------------------------------


def test_what_could_not_be_told_is_a_dash_or_null(
    kille: Run, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    table = Table("t", ("method", "AUROC", "κ"), (("m", float("nan"), None),))
    facts = {"numbers": np.arange(2), "one": np.float32(0.5), "none": float("inf")}
    result = Result("r", (table,), (), facts)
    monkeypatch.setattr(
        interface, "run_plan", lambda plan, methods, **_: (result, methods)
    )
    assert re.search(r"^m +– +–", kille(*MINE, "--protocol", "shots").out, re.MULTILINE)
    (told,) = json.loads(kille(*MINE, "--protocol", "shots", "--json").out)["results"]
    assert told["tables"][0]["rows"] == [["m", None, None]]
    assert told["facts"] == {"numbers": [0, 1], "one": 0.5, "none": None}


FIGURES = {
    "confusion": {"labels": ["a", "b"], "counts": [[2, 1], [0, 3]]},
    "curves": {
        "x": [1, 3],
        "series": {"$m_1$": {"mean": [0.2, 0.9], "low": [0.1, 0.8], "high": [0.3, 1]}},
        "xlabel": "x",
        "ylabel": "y",
    },
    "bars": {"labels": ["a", "b"], "values": [0.5, -0.2], "ylabel": "margin"},
    "map": {
        "words": ["left of"],
        "right": [-1, 0, 1],
        "away": [0, 1],
        "degrees": {"left of": [[1, 0.4, 0], [0.9, 0.3, 0]]},
    },
    "pictures": {
        "pictures": [np.zeros((4, 6, 3), np.uint8)],
        "captions": ["$a_b$ & <c>"],
        "good": [False],
    },
    "points": {"series": {"a": {"x": [1], "y": [2]}}, "xlabel": "x", "ylabel": "y"},
}


@pytest.mark.parametrize("kind", FIGURES)
def test_every_kind_of_figure_is_drawn(kind: str) -> None:
    pytest.importorskip("matplotlib")
    figure = Figure(kind, "title", FIGURES[kind])  # type: ignore[arg-type]
    text = drawing.svg(figure, 3)
    assert text == drawing.svg(figure, 3)
    assert text.startswith("<svg")
    assert "currentColor" in text
    assert not re.search(r"<!DOCTYPE|<metadata|id=\"figure", text)


def test_a_curve_without_a_point_is_drawn_as_nothing() -> None:
    pytest.importorskip("matplotlib")
    series = {"a": {"mean": []}, "b": {"mean": [None, 0.5], "x": [1, 3]}}
    text = drawing.svg(Figure("curves", "title", {"x": [], "series": series}))
    assert text.startswith("<svg")


def test_words_of_any_kind_are_drawn_as_they_are() -> None:
    pytest.importorskip("matplotlib")
    words = ["$\\bad{$", "<b>&", "日本語 \x1b[31m", "", "long " * 60]
    counts = np.eye(len(words)).tolist()
    text = drawing.svg(Figure("confusion", "odd", {"labels": words, "counts": counts}))
    assert "$\\bad{$" in text
    assert "<b>" not in text
    assert "\x1b" not in text


def test_a_head_is_broken_only_where_there_is_no_room(
    kille: Run, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    heads = ("method", "degree of .5 or more", "right of these")
    table = Table("t", heads, (("m", 1.0, 0.5),))
    result = Result("r", (table,), (), {})
    monkeypatch.setattr(
        interface, "run_plan", lambda plan, methods, **_: (result, methods)
    )
    wide = kille(*MINE, "--protocol", "shots").out
    assert "method  degree of .5 or more  right of these" in wide
    monkeypatch.setenv("COLUMNS", "30")
    narrow = kille(*MINE, "--protocol", "shots").out.splitlines()
    assert "         degree of  right of" in narrow
    assert "method  .5 or more     these" in narrow


@pytest.mark.parametrize("columns", [10, 100])
@pytest.mark.parametrize("heads", [("method",), ("method", "right", "share")])
def test_a_table_without_rows_is_its_heads(
    columns: int, heads: tuple[str, ...]
) -> None:
    out = Console(file=io.StringIO(), width=columns)
    print_table(out, Table("nobody", heads, ()))
    assert isinstance(out.file, io.StringIO)
    assert all(head in out.file.getvalue() for head in heads)


def test_a_table_of_one_column_is_printed_however_wide() -> None:
    out = Console(file=io.StringIO(), width=10)
    print_table(out, Table("words", ("word",), (("a word that is long",), ("cup",))))
    assert isinstance(out.file, io.StringIO)
    assert "cup" in out.file.getvalue()


def test_each_part_of_a_table_says_what_its_rows_are_of() -> None:
    """What comes before the first number names a row, in all parts."""
    heads = ("measure", "tutor", *(f"theory {n}" for n in range(6)))
    rows = tuple(
        (measure, tutor, *[0.5] * 6)
        for measure in ("accuracy", "accepted", "words")
        for tutor in ("Ann", "Bo", "Cleo")
    )
    out = Console(file=io.StringIO(), width=40)
    print_table(out, Table("by tutor", heads, rows))
    assert isinstance(out.file, io.StringIO)
    lines = out.file.getvalue().splitlines()
    heading = [line for line in lines if "measure" in line]
    assert len(heading) > 1
    assert all("tutor" in line for line in heading)
    assert sum("Cleo" in line for line in lines) == 3 * len(heading)
