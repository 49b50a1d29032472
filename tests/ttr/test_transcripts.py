"""Transcripts: one file that shows what was said, the states and the rules."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest

from ttr import record, rectype
from ttr.cli.main import main
from ttr.dialogues.dialogue import Dialogue, play
from ttr.dialogues.stories import Setting, setting
from ttr.dialogues.transcripts import transcript
from ttr.display.differences import layout_of_changes
from ttr.display.layout import Matrix

GAMES = Path(__file__).parent.parent / "games"
VOID = {"meta", "br", "hr"}


class Page(HTMLParser):
    """A page as its text and its elements; refuses what does not nest."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" not in self.open:
            self.words.append(data)

    @property
    def text(self) -> str:
        """What is read, with single spaces."""
        return " ".join(" ".join(self.words).split())


@pytest.fixture
def door() -> Setting:
    return setting("door.ttr door", GAMES)


def dialogue(door: Setting, *names: str, ending: str = "") -> Dialogue:
    given = [door.theory[name] for name in names]
    return replace(play(door.game, given), title="a <visit>", place=door, ending=ending)


def test_a_page_has_what_was_said_with_rules_and_docstrings(door: Setting) -> None:
    text = Page(transcript("door", [dialogue(door, "Greet", "Answer")])).text
    for words in (
        "a <visit>",
        "U> Greet S> GreetBack S> Ask 3 rules",
        "asked What was asked is open. private.agenda: − Ask shared.open: + Ask",
        "U> Answer S> Open 2 rules",
        "answered An answer to what is open closes it, and the door is opened.",
    ):
        assert words in text


def test_a_page_needs_nothing_else(door: Setting) -> None:
    text = transcript("door", [dialogue(door, "Greet")])
    page = Page(text)
    assert not re.search(r"https?:|url\(|@import|<script|<link|<img", text)
    assert {tag for tag, _ in page.elements}.isdisjoint({"script", "link", "img"})
    assert ("meta", {"charset": "utf-8"}) in page.elements
    viewport = [it for _, it in page.elements if it.get("name") == "viewport"]
    assert viewport
    assert text.count("<style>") == 1


def test_the_fields_that_a_turn_has_changed_are_marked(door: Setting) -> None:
    page = Page(transcript("door", [dialogue(door, "Greet", "Answer")]))
    changed = [it for tag, it in page.elements if it.get("class") == "ttr-changed"]
    assert len(changed) == 3  # said and open, then open


def test_only_innermost_fields_are_marked() -> None:
    before = record(a=record(x="a", y="b"), b="c", gone="d")
    after = record(a=record(x="a", y="c"), b="c", new=rectype())
    layout = layout_of_changes(before, after)
    assert isinstance(layout, Matrix)
    assert [(row.label.text, row.changed) for row in layout.rows] == [
        ("a", False),
        ("b", False),
        ("new", True),
    ]
    inner = layout.rows[0].has
    assert isinstance(inner, Matrix)
    assert [(row.label.text, row.changed) for row in inner.rows] == [
        ("x", False),
        ("y", True),
    ]


def test_several_dialogues_have_a_list_that_leads_to_them(door: Setting) -> None:
    shown = [dialogue(door, "Greet"), dialogue(door, "Answer", ending="<differs>")]
    page = Page(transcript("door", shown))
    links = [it["href"] for tag, it in page.elements if tag == "a"]
    anchors = {f"#{it['id']}" for _, it in page.elements if it.get("id")}
    assert {"#d1", "#d2"} <= set(links) <= anchors
    assert "<differs>" in page.text
    assert "no rule applied" in page.text


def test_play_and_replay_write_pages(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("door.ttr", "door.dlg"):
        (tmp_path / name).write_bytes((GAMES / name).read_bytes())
    played = ["play", "--quiet", "door.dlg", "--html", "a.html", "--log", "a.jsonl"]
    assert main(played) == 0
    assert main(["replay", "a.jsonl", "--html", "b.html"]) == 0
    played_page, replayed = (
        (tmp_path / name).read_text(encoding="utf-8") for name in ("a.html", "b.html")
    )
    assert played_page.replace("door.dlg", "a.jsonl") == replayed
    assert "an answer to nothing" in Page(replayed).text
