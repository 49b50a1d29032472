"""Grammars that were read before: the same ones again, whatever lies in the cache."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from kille.dialogue.grammar_cache import recall_grammar
from kille.dialogue.grammars import GrammarError, GrammarSource, read_grammar
from kille.dialogue.language import LANGUAGES, grammar_text
from kille.dialogue.user_cache import MOST, cache_folder

SMALL = 'start: _a+ [b]\n_a: "a"i c?\nc: /c+/ -> as\nb: "b"\n%ignore " "\n'

STARTS = ("start",)


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of grammars, empty as yet."""
    monkeypatch.setattr(
        "kille.dialogue.user_cache.user_cache_dir", lambda *_, **__: str(tmp_path)
    )
    return cache_folder("grammars")


def recall_without_lark(monkeypatch: pytest.MonkeyPatch, text: str) -> GrammarSource:
    """What is recalled where nothing can be read anew."""

    def refuse(text: str, starts: object) -> GrammarSource:
        raise AssertionError("it is read anew")

    with monkeypatch.context() as patched:
        patched.setattr("kille.dialogue.grammar_cache.read_grammar", refuse)
        return recall_grammar(text, STARTS)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_grammar_is_recalled_as_it_was_read(
    language: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = grammar_text(language)
    read = read_grammar(text, STARTS)
    assert recall_grammar(text, STARTS) == read
    recalled = recall_without_lark(monkeypatch, text)
    assert recalled[:3] == read[:3]
    assert all(recalled.beginnings(it) == read.beginnings(it) for it in read.terminals)


def test_a_recalled_grammar_is_of_the_same_text_and_the_same_starts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    recall_grammar(SMALL, STARTS)
    for text, starts in ((SMALL.replace("/c+/", "/d+/"), STARTS), (SMALL, ("c",))):
        assert recall_grammar(text, starts) == read_grammar(text, starts)
    monkeypatch.setattr("kille.dialogue.grammar_cache._reader", lambda: "another")
    with pytest.raises(AssertionError, match="read anew"):
        recall_without_lark(monkeypatch, SMALL)


def change_a_letter(text: str) -> str:
    return text.replace("c+", "d+")


def change_the_shape(text: str) -> str:
    return json.dumps({"a": 1})


@pytest.mark.parametrize(
    "damage", [change_a_letter, change_the_shape, lambda text: text[:-9], lambda _: ""]
)
def test_a_damaged_file_is_made_anew(
    damage: Callable[[str], str], cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = recall_grammar(SMALL, STARTS)
    (kept,) = cache.iterdir()
    kept.write_text(damage(kept.read_text("utf-8")), "utf-8")
    assert recall_grammar(SMALL, STARTS) == read
    assert recall_without_lark(monkeypatch, SMALL)[:3] == read[:3]


def test_what_is_no_text_is_made_anew(cache: Path) -> None:
    read = recall_grammar(SMALL, STARTS)
    (kept,) = cache.iterdir()
    kept.write_bytes(b"\xff\xfe")
    assert recall_grammar(SMALL, STARTS) == read


def test_where_nothing_can_be_written_nothing_is_kept(cache: Path) -> None:
    cache.parent.mkdir(exist_ok=True)
    cache.write_text("a file where the folder would be", "utf-8")
    assert recall_grammar(SMALL, STARTS) == read_grammar(SMALL, STARTS)
    assert cache.is_file()


def test_what_is_no_grammar_is_refused_as_ever_and_not_kept(cache: Path) -> None:
    with pytest.raises(GrammarError):
        recall_grammar("start: nothing", STARTS)
    assert not cache.exists()


def test_only_the_latest_are_kept(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number in range(MOST + 2):
        recall_grammar(f'start: "{number}"', STARTS)
        for age, kept in enumerate(sorted(cache.iterdir())):
            assert age < MOST
            os.utime(kept, (kept.stat().st_mtime - 60,) * 2)
    assert len([*cache.iterdir()]) == MOST
    latest = f'start: "{MOST + 1}"'
    recalled = recall_without_lark(monkeypatch, latest)
    assert recalled[:3] == read_grammar(latest, STARTS)[:3]
    with pytest.raises(AssertionError, match="read anew"):
        recall_without_lark(monkeypatch, 'start: "0"')


def test_a_program_that_recalls_its_grammar_does_without_lark(tmp_path: Path) -> None:
    code = (
        "import sys; from kille.dialogue.language import understand; "
        "print(len(understand('This is a cup.'))); print('lark' in sys.modules)"
    )
    around = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    printed = [
        subprocess.run(
            [sys.executable, "-c", code],
            env=around,
            check=True,
            capture_output=True,
            text=True,
        ).stdout.split()
        for _ in range(2)
    ]
    assert printed == [["1", "True"], ["1", "False"]]
