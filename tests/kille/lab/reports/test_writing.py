"""A report as a page: all that it says is there, and all that it leads to."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from random import Random
from urllib.parse import unquote

import numpy as np
import pytest

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.measures.comparison import Contrast, McNemar, PairedDifference
from kille.lab.measures.scored_dialogues import ScoredDialogue, score_dialogue
from kille.lab.reports.contrasts import unreachable_significance
from kille.lab.reports.drawing import MISSING
from kille.lab.reports.findings import group_by_theory
from kille.lab.reports.latex_tables import latex_table
from kille.lab.reports.links import places_of
from kille.lab.reports.study_report import Subject, every_two, results_of, write
from kille.lab.results import Estimate, Table
from kille.lab.study import Run
from ttr import record

WORDS = ("cup", "car", "book")
SURE, ODD = "sure", "<b>odd</b> & shy"
SKILL = {SURE: 0.9, ODD: 0.5}


def dialogue(theory: str, seed: int, judged: bool = True) -> ScoredDialogue:
    """A tutor says what three things are, and asks; the better theory knows more."""
    shown, own = Random(f"shown {seed}"), Random(f"{theory} {seed}")
    turns, answers = [], []
    for number in range(1, 13):
        word, luck = shown.choice(WORDS), shown.random()
        said = word if luck < SKILL[theory] else own.choice((*WORDS, ""))
        degrees = {it: own.random() / 4 for it in WORDS} | {said or "cup": 0.7}
        if number % 2:
            turns.append(
                Turn(number, "teach", "Ann", "instruct", f"A {word}.", "OK.", 2)
            )
            continue
        turns.append(
            Turn(number, "test", "Ann", "ask_name", "What is <this>?", said, 3)
        )
        judge = shown.choice((word, *WORDS)) if judged else ""
        answers.append(
            Answer(
                number, "test", "noun", word, said, "assert", degrees.get(said, 0.0)
            )._replace(degrees=degrees, judge=judge, lessons=number // 2)
        )
    run = Run(theory, "Ann", "table & chairs", seed)
    return score_dialogue(run, Played(tuple(turns), tuple(answers), 6), 0.25)


def subject(*theories: str, seeds: int = 6, **more: object) -> Subject:
    names = theories or (SURE, ODD)
    talks = [dialogue(name, seed) for seed in range(1, seeds + 1) for name in names]
    found = group_by_theory(names, talks)
    described = {
        name: {"strategy": record(mode=name[:4], sure=0.6), "rules": {"hedge": name}}
        for name in names
    }
    about = {"command": "kille experiment run <me>.toml", "seeds": f"1 to {seeds}"}
    return Subject(
        "Who's <i>sure</i>?",
        found,
        described,
        every_two(found),
        [["teach"], ["test"]],
        about,
        **more,
    )  # type: ignore[arg-type]


class Reader(HTMLParser):
    """What a page leads to, what can be led to in it, and whether its tags close."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: list[str] = []
        self.open: list[str] = []
        self.feed(page.read_text("utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if tag == "a" and given.get("href"):
            self.links.append(str(given["href"]))
        if given.get("id"):
            self.ids.append(str(given["id"]))
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        pass


def pages_of(folder: Path) -> Iterator[Path]:
    yield from sorted(folder.rglob("*.html"))


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("results")
    (folder / "runs.csv").write_text("run\n")
    write(reported(), folder / "report.html")
    return folder


def reported() -> Subject:
    return subject(
        broken=[(f"{SURE}/Ann/{n}", "KeyError: <cup>") for n in range(7)],
        files=["runs.csv"],
        lead="Why?\n\nSo.",
        numbers="12 dialogues of <two> theories",
        source="title = '<x>'",
    )


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it is where matplotlib is not installed, which is quicker, too."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)


def test_every_link_leads_somewhere(written: Path) -> None:
    readers = {page.resolve(): Reader(page) for page in pages_of(written)}
    assert len(readers) == 1 + 6 + 2 * 2 + 1
    for page, reader in readers.items():
        assert not reader.open
        assert len(reader.ids) == len({*reader.ids})
        for link in reader.links:
            path, _, anchor = unquote(link).partition("#")
            target = (page.parent / path).resolve() if path else page
            assert target.is_file(), link
            assert not anchor or anchor in readers[target].ids, link


def test_nothing_is_fetched_and_all_is_escaped(written: Path) -> None:
    for page in pages_of(written):
        text = page.read_text("utf-8")
        assert "<script" not in text
        assert not re.search(r"""(?:src|href)=["']?(?:https?:)?//""", text)
        assert ODD not in text
        assert "<this>" not in text
        assert "<cup>" not in text


def test_the_page_says_what_there_is_to_say(written: Path) -> None:
    text = (written / "report.html").read_text("utf-8")
    for told in (
        "<p>So.</p>",
        "7 dialogues broke: KeyError: &lt;cup&gt;: sure/Ann/0, sure/Ann/1, ",
        "sure/Ann/4 and 2 more",
        "12 dialogues of &lt;two&gt; theories",
        "κ tutor–judge",
        "p (Holm)",
        "How many dialogues it takes",
        "Learning curve",
        "Reliability",
        "title = &#x27;&lt;x&gt;&#x27;",
        'href="runs.csv"',
        "kille experiment run &lt;me&gt;.toml",
    ):
        assert told in text, told


def test_what_was_found_comes_first(written: Path) -> None:
    text = (written / "report.html").read_text("utf-8")
    told = (
        "The accuracy of &lt;b&gt;odd&lt;/b&gt; &amp; shy differs from that of sure by"
    )
    assert text.index(told) < text.index('id="part-2">The theories')
    titles = re.findall(r'<h2 id="part-\d+">([^<]+)', text)
    assert titles[:4] == ["In short", "The theories", "What they do", "How they differ"]
    assert re.findall(r'<a href="#part-\d+">([^<]+)', text) == titles


def test_warnings_are_told_once_on_a_page_and_with_what_was_found(
    tmp_path: Path, undrawn: None
) -> None:
    results = write(subject(warnings=["Too <few> turns."]), tmp_path / "report.html")
    assert results[0].text == "Too <few> turns."
    text = (tmp_path / "report.html").read_text("utf-8")
    assert text.count("Too &lt;few&gt; turns.") == 1
    assert text.index("Too &lt;few&gt; turns.") < text.index("In short</h2>")


@pytest.mark.usefixtures("undrawn")
def test_many_reasons_for_which_dialogues_broke_are_counted(tmp_path: Path) -> None:
    broken = [(f"a/b/c/{n}", f"E{n}") for n in range(1, 8)]
    write(subject(broken=[*broken, ("a/b/c/9", "E7")]), tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text("utf-8")
    assert "1 dialogue broke: E5: a/b/c/5<" in text
    assert "broke: E6" not in text
    assert "3 dialogues more broke, for other reasons." in text


def test_every_number_of_a_theory_leads_to_its_dialogues(written: Path) -> None:
    text = (written / "report.html").read_text("utf-8")
    found = re.search(r"<tr><td[^>]*>accuracy</td>(.*?)</tr>", text)
    assert found
    assert re.findall(r'href="([^"]+)"', found[1]) == [
        "report-dialogues/theory-1.html",
        "report-dialogues/theory-2.html",
    ]


def test_a_dialogue_is_told_phase_by_phase_of_all_theories(written: Path) -> None:
    text = (written / "report-dialogues" / "dialogue-2.html").read_text("utf-8")
    assert "<h1>Dialogue 2: Ann, table &amp; chairs, seed 2</h1>" in text
    teach, test = text.index("<h3>teach</h3>"), text.index("<h3>test</h3>")
    for number in (1, 2):
        assert teach < text.index(f'id="theory-{number}-turn-1"') < test
        assert test < text.index(f'id="theory-{number}-turn-2"')
    assert 'class="who"' not in text


@pytest.mark.usefixtures("undrawn")
def test_who_of_several_tutors_speaks_is_told(tmp_path: Path) -> None:
    talk = dialogue(SURE, 1)
    first, *others = talk.turns
    turns = (first._replace(tutor="<Bo>"), *others)
    about = replace(subject(SURE), theories={SURE: [replace(talk, turns=turns)]})
    write(about, tmp_path / "report.html")
    page = tmp_path / "report-dialogues" / "dialogue-1.html"
    text = page.read_text("utf-8")
    assert '<span class="who">&lt;Bo&gt;:</span> A ' in text
    assert text.count('<span class="who">Ann:</span>') == len(others)


def test_what_differs_is_marked_in_print_too(written: Path) -> None:
    """Marks and brackets are backgrounds, which browsers do not print by themselves."""
    text = (written / "report.html").read_text("utf-8")
    assert re.search(r"@media print {[^@]*print-color-adjust: exact", text)


def test_figures_lie_beside_the_page_for_a_paper(written: Path) -> None:
    files = sorted((written / "report-figures").iterdir())
    assert all(it.read_bytes().startswith(b"%PDF") for it in files)
    assert {"1-1-accuracy.pdf", "3-1-learning-curve.pdf"} <= {it.name for it in files}


def test_the_same_dialogues_are_the_same_report(written: Path, tmp_path: Path) -> None:
    write(reported(), tmp_path / "report.html")
    files = sorted(it for it in tmp_path.rglob("*") if it.is_file())
    assert len(files) > 10
    for file in files:
        twin = written / file.relative_to(tmp_path)
        assert file.read_bytes() == twin.read_bytes(), file.name


@pytest.mark.usefixtures("undrawn")
def test_what_an_earlier_report_left_is_gone(tmp_path: Path) -> None:
    page = tmp_path / "report.html"
    write(subject(seeds=3), page)
    own = tmp_path / "report-dialogues" / "my-notes.html"
    own.write_text("mine")
    write(subject(seeds=2), page)
    kept = {it.name for it in own.parent.iterdir()}
    assert "dialogue-2.html" in kept
    assert "dialogue-3.html" not in kept
    assert own.name in kept


@pytest.mark.usefixtures("undrawn")
def test_one_theory_is_compared_with_none(tmp_path: Path) -> None:
    write(subject(SURE), tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text("utf-8")
    assert "How they differ" not in text
    assert "the same in all" not in text


def test_without_dialogues_there_is_a_page_all_the_same(tmp_path: Path) -> None:
    write(subject(seeds=0, broken=[("a/b/c/1", "no")]), tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text("utf-8")
    assert "1 dialogue broke: no: a/b/c/1" in text
    assert "No dialogue was played to its end." in text


@pytest.mark.usefixtures("undrawn")
def test_without_matplotlib_it_says_so(tmp_path: Path) -> None:
    write(subject(), tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text("utf-8")
    assert MISSING.replace("'", "&#x27;") in text
    assert "<svg" not in text
    assert "accuracy" in text


def test_the_better_theory_is_found_to_be_better() -> None:
    about = subject(seeds=20)
    talks = [it for them in about.theories.values() for it in them]
    found = results_of(about, places_of(list(about.theories), talks, ""))
    (table,) = (
        it for one in found for it in one.tables if it.title == "Paired differences"
    )
    (row,) = (row for row in table.rows if row[1] == "accuracy")
    assert isinstance(row[2], Estimate)
    assert row[2].high < 0
    assert row[3] == "< 0.001"
    assert row[5] == 20


@pytest.mark.parametrize(
    ("theories", "seeds", "told"),
    [
        ((SURE, ODD), 5, "with 5 pairs of dialogues p is 0.062 at best. It takes 6 "),
        ((SURE, ODD), 1, "with 1 pair of dialogues p is 1.000 at best. It takes 6 "),
        ((SURE, ODD), 6, ""),
    ],
)
def test_too_few_seeds_for_any_difference_are_told_first(
    theories: tuple[str, ...], seeds: int, told: str, tmp_path: Path
) -> None:
    page = tmp_path / "report.html"
    found = write(subject(*theories, seeds=seeds), page)
    if not told:
        assert "can be significant" not in page.read_text("utf-8")
        return
    line = next(it for it in found[1].text.splitlines() if "significant" in it)
    assert line.startswith(f"No difference in accuracy can be significant: {told}")
    assert line in page.read_text("utf-8").partition("The theories</h2>")[0]


def test_the_correction_for_many_theories_is_counted_among_what_is_out_of_reach() -> (
    None
):
    def contrast(pairs: int) -> Contrast:
        told = PairedDifference(
            Estimate(0.1, 0.0, 0.2), 0.5, pairs, 0.1, np.zeros(pairs)
        )
        return Contrast("a", "b", {"accuracy": told}, McNemar(0, 0, 1.0))

    (line,) = unreachable_significance([contrast(6), contrast(6), contrast(5)])
    assert "p is 0.094 at best after Holm's correction for 3 tests. It takes 7" in line
    (line,) = unreachable_significance([contrast(20)] * 1000)
    assert line.endswith("Compare fewer theories.")
    assert not [
        *unreachable_significance(
            [contrast(6), Contrast("a", "c", {}, McNemar(0, 0, 1.0))]
        )
    ]
    assert not [*unreachable_significance([contrast(0)])]
    assert not [*unreachable_significance([])]


@pytest.mark.parametrize("seeds", range(1, 13))
def test_no_band_says_otherwise_of_zero_than_the_p_beside_it(seeds: int) -> None:
    told = subject(seeds=seeds)
    talks = [it for them in told.theories.values() for it in them]
    found = results_of(told, places_of([SURE, ODD], talks, ""))
    (table,) = (
        it for one in found for it in one.tables if it.title == "Paired differences"
    )
    for _, _, difference, p, _, _ in table.rows:
        assert isinstance(difference, Estimate)
        if math.isfinite(difference.low) and p != "–":
            small = p.startswith("<") or float(p) < 0.05
            assert small == (not difference.low <= 0 <= difference.high)


def test_every_table_is_there_as_latex_in_which_no_name_acts(written: Path) -> None:
    files = sorted((written / "report-tables").iterdir())
    assert "3-1-all-measures.tex" in [it.name for it in files]
    for file in files:
        lines = file.read_text("utf-8").splitlines()
        comments = [it for it in lines if it.startswith("%")]
        begins, *rows, ends = [it for it in lines if it not in (*comments, r"\hline")]
        sides = re.fullmatch(r"\\begin\{tabular\}\{([lr]+)\}", begins)
        assert sides
        assert ends == r"\end{tabular}"
        for row in rows:
            assert row.endswith(r" \\")
            assert len(re.findall(r"(?<!\\)&", row)) == len(sides[1]) - 1
            assert len(re.findall(r"(?<!\\)\$", row)) % 2 == 0
            assert not re.search(r"(?<!\\)[%#]", row)


def test_a_name_with_commands_is_set_as_it_is() -> None:
    table = Table("%\n\\input{a}", (r"\input{x} & y_$#%",), ((r"\\ 50 %\n",), (None,)))
    title, *lines = latex_table(table).splitlines()
    assert title == r"% % \input{a}"
    assert all("\\input" not in it for it in lines)
    assert lines.count(r"\hline") == 3
    assert r"-- \\" in lines
