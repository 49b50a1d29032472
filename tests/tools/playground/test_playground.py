"""The playground in a browser: the same answers as here, and nothing that runs away."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from browsers import IN_BROWSER, PATIENCE, Tab
from tools.playground.answers import Playground, command_output
from tools.playground.building import build
from tools.playground.links import (
    LONGEST_FRAGMENT,
    LinkError,
    link_fragment,
    text_of_fragment,
)
from tools.playground.pyodide import FetchError
from tools.playground.serving import server_of
from ttr.notation.tokens import NAME, NUMBER, QUOTED

ROOT = Path(__file__).resolve().parents[3]
THEORIES = sorted((ROOT / "tests" / "theories").glob("*.ttr"))
FETCH = (ROOT / "examples" / "fetch.ttr").read_text(encoding="utf-8")


HOSTILE = """
basic A
object '<img src=x onerror=window.ran=1>' : A
T := [x = '<img src=x onerror=window.ran=1>' : A]
check {x = '<img src=x onerror=window.ran=1>'} : T
check not T <= T  # <script>window.ran = 1</script>
"""
"""A theory that reads, with names that would run something if they were not escaped."""


def ask(page: Playground, **request: object) -> Any:
    return json.loads(page.respond(json.dumps(request)))


# --- links ---------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["", "basic Ind", "# ∧ λ ⊑ 𝔸\n", FETCH])
def test_a_link_gives_its_theory_back(text: str) -> None:
    assert text_of_fragment(link_fragment(text)) == text


@pytest.mark.parametrize("fragment", ["", "x", "t=!", "t=AAAA", "t=" + "A" * 30_000])
def test_a_damaged_link_is_refused_in_one_line(fragment: str) -> None:
    with pytest.raises(LinkError, match=r"^[^\n]+$"):
        text_of_fragment(fragment)


def test_a_link_that_unpacks_to_too_much_is_refused() -> None:
    with pytest.raises(LinkError, match="too long"):
        link_fragment("#" * 200_000)


# --- answers, in this Python ---------------------------------------------------------


def test_a_mistake_has_its_place() -> None:
    found = ask(Playground(), do="check", text="basic Ind\nD := [x : Idn]\n")
    (mistake,) = found["mistakes"]
    assert (mistake["line"], mistake["column"], mistake["length"]) == (2, 11, 3)
    assert mistake["help"] == "did you mean Ind?"


def test_an_answer_has_its_derivation() -> None:
    text = "basic Ind\nobject a : Ind\ncheck a : Ind\ncheck not Ind <= Ind\n"
    found = ask(Playground(), do="check", text=text)
    assert [one["holds"] for one in found["answers"]] == [True, False]
    assert "ttr-yes" in found["answers"][0]["html"]
    assert found["summary"] == "1 of 2 checks failed"


def test_hostile_names_are_escaped() -> None:
    text = "basic A\nobject '<img src=x onerror=alert(1)>' : A\n"
    text += "T := [x = '<img src=x onerror=alert(1)>' : A]\n"
    found = ask(Playground(), do="check", text=text)
    assert found["mistakes"] == []
    assert "<img" not in found["definitions"][0]["html"]


def test_a_game_is_played_step_by_step() -> None:
    page = Playground()
    assert ask(page, do="check", text=FETCH)["games"] == ["fetch"]
    assert "nothing happens" in ask(page, do="play", game="fetch")["offers"]
    moved = ask(page, do="move", move=0)
    assert [one["rule"] for one in moved["turns"][0]["steps"]][:2] == [
        "begin",
        "attract_next",
    ]
    assert ask(page, do="back")["turns"] == []


def test_a_game_is_tested_alike_with_the_same_seed() -> None:
    page = Playground()
    ask(page, do="check", text=FETCH)
    request = {"do": "test", "game": "fetch", "seed": 3, "examples": 5}
    first = ask(page, **request)
    assert first == ask(page, **request)
    assert first["summary"].startswith("fetch: ")


def test_a_request_without_a_game_is_answered_in_words() -> None:
    assert "no game" in ask(Playground(), do="play", game="x")["error"]


# --- in the browser ------------------------------------------------------------------


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("playground")
    try:
        build(folder)
    except FetchError as error:
        pytest.skip(str(error))
    with server_of(folder) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()
        thread.join()


def wait_until_checked(tab: Tab, times: int = 1) -> None:
    tab.wait_for_function(
        "n => Number(document.documentElement.dataset.checked) >= n",
        arg=times,
        timeout=PATIENCE,
    )


def in_browser(test: Any) -> Any:
    for one in IN_BROWSER:
        test = one(test)
    return test


@in_browser
class TestInTheBrowser:
    """Few tests with much in each: a tab takes seconds to load Python."""

    def test_it_answers_as_here(
        self,
        tab: Tab,
        address: str,
        tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:
        hostile = "T := <img src=x onerror=alert(1)>\n</script><script>alert(2)"
        tab.goto(f"{address}#{link_fragment(hostile)}")
        wait_until_checked(tab)
        assert tab.locator("#mistakes li").count() >= 1
        assert tab.locator(".is-wrong").count() >= 1
        assert tab.locator("img").count() == 1, "the icon alone"
        assert tab.locator("#text").input_value() == hostile
        monkeypatch.chdir(tmp_path)
        for file in THEORIES:
            text = file.read_text(encoding="utf-8")
            there = tab.evaluate(
                "([name, text]) => commandOutput(name, text)", [file.name, text]
            )
            assert there == command_output(file.name, text)
            assert there["output"] == file.with_suffix(".out").read_text("utf-8")
            names = tab.evaluate(
                "async text => (await import('./tokens.js')).tokens(text)", text
            )
            assert [
                text[it["start"] : it["end"]]
                for it in names
                if it["kind"] in ("name", "quoted", "number")
            ] == words_of(text)
        tab.evaluate("hash => { location.hash = hash; }", link_fragment(HOSTILE))
        wait_until_checked(tab, 2)
        assert tab.locator("#summary").inner_text() == "1 of 2 checks failed"
        assert "<img" in tab.locator("#definitions").inner_text()
        assert "<img" in tab.locator("#answers").inner_text()
        assert tab.locator("img").count() == 1, "the icon alone"
        assert tab.evaluate("window.ran") is None
        tab.evaluate("hash => { location.hash = hash; }", link_fragment(FETCH))
        wait_until_checked(tab, 3)
        tab.click("#play")
        tab.get_by_role("button", name="nothing happens").click()
        tab.locator(".step").first.wait_for()
        assert tab.locator(".step b").first.inner_text() == "begin"
        tab.fill("#examples-count", "1")
        tab.click("#test")
        tab.locator("#tested p").wait_for()
        assert tab.locator("#tested p").inner_text() == "fetch: holds, 1 dialogue"

    @pytest.mark.deep
    def test_what_runs_away_is_stopped(self, tab: Tab, address: str) -> None:
        tab.goto(f"{address}#{link_fragment(FETCH)}")
        wait_until_checked(tab)
        tab.fill("#examples-count", "2000")
        tab.click("#test")
        tab.click("#stop")
        tab.get_by_text("Stopped.").wait_for()
        tab.click("#check")
        wait_until_checked(tab, 2)
        assert tab.locator("#summary").inner_text()

    def test_a_link_too_long_is_one_clear_line(self, tab: Tab, address: str) -> None:
        tab.goto(f"{address}#t={'A' * (LONGEST_FRAGMENT + 1)}")
        tab.locator("#trouble").wait_for()
        assert "damaged or too long" in tab.locator("#trouble").inner_text()


_WORD = re.compile(
    rf"#[^\n]*|(?P<quoted>{QUOTED.pattern})|(?P<name>{NAME.pattern})"
    rf"|(?P<number>{NUMBER.pattern.removeprefix('-?')})".replace(" ", "")
)


def words_of(text: str) -> list[str]:
    """The names, quoted names and numbers, by the patterns of the notation."""
    return [it[0] for it in _WORD.finditer(text) if it.lastgroup]
