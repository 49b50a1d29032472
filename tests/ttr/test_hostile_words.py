"""Words that a terminal or a browser would obey, through the commands of `ttr`."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest

from ttr import Theory, TTRError
from ttr.cli.main import main

CODES = "\x1b]0;pwned\x07\x9b1m\u202egrab\u2028<script>x</script>"
SEEN = r"\x1b]0;pwned\x07\x9b1m\u202egrab\u2028<script>x</script>"

WRITTEN = json.dumps(CODES)[1:-1]
"""As the notation has it: a file with the codes themselves is refused."""

THEORY = f"""
basic Ind
pred dog(Ind), greet(Ind)
Dog := [x : Ind, name = "{WRITTEN}" : Ind, c : dog(x)]
given "{WRITTEN}" : Ind
Board := [said : list(RecType)]
Greet := [x : Ind, e : greet(x)]
rule hear(s : Board, e : Greet) "says {WRITTEN}" := [said = [Greet] : list(RecType)]
game talk({{said = []}} : Board) := hear
check Dog <= [name = "{WRITTEN}b" : Ind]
"""
STORY = f"--- a {CODES} greeting\n@ game {{file}} talk\nU> Greet\nS> {CODES}\n"

Run = Callable[..., tuple[int, str]]


def obeyed(text: str) -> list[str]:
    """What of a text a terminal would obey."""
    return [c for c in text.replace("\n", "") if not c.isprintable()]


@pytest.fixture
def ttr(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs the command, which prints nothing that a terminal would obey."""

    def run(*words: str, typed: str = "") -> tuple[int, str]:
        monkeypatch.setattr(sys, "stdin", io.StringIO(typed))
        try:
            code = main(words)
        except SystemExit as left:
            code = int(left.code or 0)
        out, err = capsys.readouterr()
        assert obeyed(out) == []
        assert obeyed(err) == []
        return code, out + err

    return run


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A theory with such words, in a file that is called so."""
    monkeypatch.chdir(tmp_path)
    name = "\x1b]0;x\x07\u202e.ttr"
    Path(name).write_text(THEORY, "utf-8")
    return name


class Tags(HTMLParser):
    """The tags of a page and the attributes of each, and its text."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags, self.text = set[str](), ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert not any(name.startswith("on") for name, _ in attrs)
        self.tags.add(tag)

    def handle_data(self, data: str) -> None:
        self.text += data


def test_checks_are_told_in_letters(ttr: Run, file: str) -> None:
    code, told = ttr("check", file)
    assert code == 1
    assert r"┌─ \x1b]0;x\x07\u202e.ttr:" in told
    assert WRITTEN in told
    _, facts = ttr("check", file, "--json")
    (fact,) = json.loads(facts)
    assert fact["file"] == file
    assert WRITTEN in fact["failures"][0]["check"]


@pytest.mark.parametrize(
    "line",
    [
        "X := dog({})",
        "{} := Ind",
        "basic {}",
        "# {}\nX := Idn",
        'X := [a = "{}" : Idn]',
        "check a : '{}",
        'import "{}.ttr"',
        "rule {}(s : Ind) := []",
        "\t'{}' = ) # {}",
    ],
)
def test_mistakes_are_told_in_letters(line: str, ttr: Run, file: str) -> None:
    Path(file).write_text(f"basic Ind\n{line.replace('{}', CODES)}\n", "utf-8")
    for command in (["check"], ["check", "--json"], ["test"], ["repl"]):
        code, _ = ttr(*command, file)
        assert code in (1, 2)
    code, _ = ttr("show", file, "X")
    assert code in (1, 2)


@pytest.mark.parametrize("form", ["text", "box", "latex", "html"])
def test_what_is_shown_is_only_seen(form: str, ttr: Run, file: str) -> None:
    code, told = ttr("show", file, "Dog", "--as", form)
    assert code == 0
    assert "script" not in Tags(told).tags or form != "html"
    for name in ("hear", "talk", CODES, "dog"):
        ttr("show", file, name, "--as", form)


def test_a_definition_that_is_shown_reads_back(ttr: Run, file: str) -> None:
    _, told = ttr("show", file, "Dog")
    theory = Theory.parse(f"basic Ind\npred dog(Ind)\n{told}")
    assert theory.Dog == Theory.parse(THEORY).Dog


def test_stories_logs_and_pages_are_only_seen(ttr: Run, file: str) -> None:
    Path("\x1b.dlg").write_text(STORY.format(file=file), "utf-8")
    outputs = "--html", "a.html", "--junit", "a.xml", "--log", "\x9ba.jsonl"
    code, told = ttr("play", "\x1b.dlg", "--trace", *outputs)
    assert code in (1, 2)
    ttr("play", "\x1b.dlg", "--json")
    ElementTree.fromstring(Path("a.xml").read_bytes())
    if Path("\x9ba.jsonl").exists():
        assert obeyed(Path("\x9ba.jsonl").read_text("utf-8")) == []
        ttr("replay", "\x9ba.jsonl", "--html", "b.html", "--story", "b.dlg")
    for page in Path().glob("*.html"):
        text = page.read_text("utf-8")
        assert obeyed(text.replace("\t", "")) == []
        assert "script" not in Tags(text).tags
    assert r"\x1b" in told


LOOP = f"""
rule again(s : [said = [Greet] : list(RecType)]) "{WRITTEN}" := [said = [] : list(RecType)]
rule back(s : [said = [] : list(RecType)]) "{WRITTEN}" := [said = [Greet] : list(RecType)]
game loop({{said = []}} : Board) := repeat(first(again, back))
"""  # noqa: E501


def test_rules_that_break_are_told_in_letters(ttr: Run, file: str) -> None:
    Path(file).write_text(THEORY + LOOP, "utf-8")
    code, told = ttr("test", file, "--game", "loop", "--examples", "5")
    assert code == 1
    assert WRITTEN in told
    _, facts = ttr("test", file, "--game", "loop", "--examples", "5", "--json")
    assert WRITTEN in json.loads(facts)[0]["faults"][0]


def test_a_session_answers_in_letters(ttr: Run, file: str) -> None:
    typed = f'Dog\n:box Dog\n:latex Dog\n"{WRITTEN}" : Ind\n{CODES}\n:{CODES}\n'
    code, told = ttr("repl", file, typed=typed)
    assert code == 0
    assert r"\u001b" in told


@pytest.mark.parametrize(
    "words",
    [(CODES,), ("check", CODES), ("show", CODES, CODES), ("check", f"--{CODES}", "x"),
     ("play", CODES), ("replay", CODES), ("fracas", CODES), ("test", CODES),
     ("test", "x.ttr", "--examples", CODES), ("repl", CODES),
     ("fracas", "x", "--lexicon", CODES), ("test", f"{CODES}.py:{CODES}")],
)  # fmt: skip
def test_a_complaint_repeats_no_code(words: tuple[str, ...], ttr: Run) -> None:
    code, told = ttr(*words)
    assert code == 2
    assert r"\x1b" in told


def test_an_error_in_a_script_repeats_no_code() -> None:
    with pytest.raises(TTRError) as caught:
        Theory.parse(f"X := {CODES}", CODES)
    assert obeyed(str(caught.value)) == []
