"""What is understood of sentences that the grammar does not read as a whole."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.language import LANGUAGES, Sentence, understand
from kille.dialogue.meanings import predicate_at
from kille.dialogue.robust_reading.clause_words import blank_harmless, words_of
from kille.dialogue.robust_reading.island_covers import best_covers
from kille.dialogue.robust_reading.island_kinds import CLAIMS
from kille.dialogue.robust_reading.sentence_reading import read_robustly
from kille.dialogue.robust_reading.situations import Situation, situation_of
from kille.dialogue.robust_reading.text_hearing import hear_in_parts, prepare_to_read
from kille.dialogue.robust_reading.whole_sentences import needs_parts
from kille.dialogue.tutoring import hear_sentences
from kille.dialogue.word_lists import word_lists

HERE = Path(__file__).parent
MARKS = {
    "": "", "partial": "?", "saying": "!", "remark": "!", "doubtful": "~", "name": "@",
    "cut off": "-", "contradictory": "%",
}  # fmt: skip
KNOWN = {
    "en": frozenset({"cup", "mug", "red", "blue", "box", "book"}),
    "sv": frozenset({"kopp", "mugg", "röd", "blå", "låda", "bok"}),
}


@cache
def classes(language: str) -> Sequence[dict[str, Any]]:
    path = HERE / f"parts.{language}.toml"
    listed: Sequence[dict[str, Any]]
    listed = tomllib.loads(path.read_text(encoding="utf-8"))["classes"]
    return listed


def utterances() -> Iterator[tuple[str, Situation, str, str]]:
    for language in LANGUAGES:
        for kind in classes(language):
            situation = Situation(**kind["situation"], known=KNOWN[language])
            for text, moves in kind["said"]:
                yield language, situation, text, moves


def moves_of(heard: Sequence[Sentence]) -> str:
    """The moves, in the notation of the lists."""
    return ", ".join(map(move_of, heard))


def move_of(sentence: Sentence) -> str:
    best = sentence.readings[0].type
    doubt = best["doubt"].value if "doubt" in best else ""
    words = [it.form.replace(" ", "_") for it in sentence.readings[0].signs]
    return " ".join([predicate_at(best, "e").name + MARKS[doubt], *words])


@pytest.mark.parametrize(("language", "situation", "text", "moves"), list(utterances()))
def test_what_is_understood(
    language: str, situation: Situation, text: str, moves: str
) -> None:
    heard = hear_in_parts(understand(text, language), situation, language)
    assert moves_of(heard.moves) == moves


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_class_has_ten_utterances(language: str) -> None:
    names = [it["name"] for it in classes(language)]
    english = [it["name"] for it in classes("en")]
    assert [it for it in names if it in english] == english
    assert all(len(it["said"]) >= 10 for it in classes(language))


def idioms() -> Iterator[tuple[str, str]]:
    for language in LANGUAGES:
        path = HERE / "tutors" / f"idioms_{language}.txt"
        for text in path.read_text("utf-8").splitlines():
            yield language, text


def test_no_idiom_teaches_anything_by_its_parts(scene: Callable[..., Any]) -> None:
    taught = []
    for language, text in idioms():
        robot = scene(1, nouns=["wug"], language=language)
        situation = situation_of(robot.state)
        for part in understand(text, language):
            for move in read_robustly(part.text, situation, language).moves:
                robot._take(hear_sentences(move))
        if robot.state.private.lessons:
            taught.append(text)
    assert not taught


@pytest.mark.parametrize(
    ("text", "claims"),
    [
        ("I have found a whisk today", "whisk"),
        ("my sister says this is a whisk", "whisk"),
        ("It rings, so it's a bell", "bell"),
        ("whisk", "whisk"),
        ("I told you that this cup is red", "red"),
    ],
)
def test_what_teaches_by_a_part_is_asked_about(text: str, claims: str) -> None:
    found = read_robustly(text, Situation(things=1, known=KNOWN["en"]))
    for move in found.moves:
        assert all(it.type["doubt"].value == "partial" for it in move.readings)
    assert claims in moves_of(found.moves)


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("en", "No problem."),
        ("en", "No worries!"),
        ("en", "No rush."),
        ("en", "No kidding."),
        ("sv", "Ingen orsak."),
        ("sv", "Ingen fara."),
        ("sv", "Inga problem."),
    ],
)
def test_a_no_of_an_idiom_denies_nothing(language: str, text: str) -> None:
    """Where the robot has claimed something, such a no would teach it the opposite."""
    claimed = Situation(things=1, asks_whether=True, known=KNOWN[language])
    for move in hear_in_parts(understand(text, language), claimed, language).moves:
        assert move_of(move).partition(" ")[0] in (
            "okay",
            "remark",
            "correct!",
            "reject!",
        )


FRAMES = ["no one says {}", "it is never {}", "if {}", "I wish {}", "as if {}"]


@pytest.mark.parametrize("frame", FRAMES)
def test_what_is_not_claimed_is_a_remark(frame: str) -> None:
    found = read_robustly(frame.format("this is a cup"), Situation(things=1))
    for move in found.moves:
        for it in move.readings:
            act = predicate_at(it.type, "e").name
            assert act not in CLAIMS or it.type["doubt"].value != "partial"


SAID = (
    "this is a the cup mug red not no yes it that well um and what where left of . , ?"
    " if I you think sorry all are two on right one so they have"
)
WORDS = st.sampled_from(SAID.split())


@given(st.lists(WORDS, min_size=1, max_size=12).map(" ".join))
def test_no_words_teach_at_once_what_the_grammar_does_not_read(text: str) -> None:
    """Whatever is left out, a lesson with words left out is asked about."""
    situation = Situation(things=1, asks_whether=True, known=KNOWN["en"])
    found = read_robustly(text, situation)
    for move in found.moves:
        act = predicate_at(move.readings[0].type, "e").name
        if act in CLAIMS and found.missed:
            assert all("doubt" in it.type for it in move.readings)


def test_covers_leave_out_harmless_words_for_nothing() -> None:
    english = word_lists("en")
    text = "Well, this is a cup, you know"
    assert "you know" not in blank_harmless(text, words_of(text, english))
    assert best_covers("", (), None, None, english) == []  # type: ignore[arg-type]


def test_a_long_text_is_not_read_by_its_parts() -> None:
    assert not read_robustly("so " * 60 + "a cup", Situation(things=1)).moves


@pytest.mark.parametrize("text", ["<b>cup", "a cup = 1", "\x1b]0;cup\x07", "[cup]"])
def test_what_is_no_talk_is_not_read(text: str) -> None:
    assert not read_robustly(text, Situation(things=1)).moves


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_prepared_changes_nothing(language: str) -> None:
    prepare_to_read(language)
    prepare_to_read(language)
    assert not read_robustly("", Situation(), language).moves


def test_what_was_only_seeming_is_what_is_denied() -> None:
    for text in ("It might look like a bowl, but it isn't.", "a bowl, but it isn't"):
        found = read_robustly(text, Situation(things=1))
        assert moves_of(found.moves) == "reject? bowl"


def test_a_sentence_of_the_grammar_needs_no_parts() -> None:
    for text in ("This is a cup.", "What is this?", "Where is the book?"):
        assert not needs_parts(understand(text), Situation(things=1))
    assert needs_parts(understand("No worries."), Situation(things=1))


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("en", "No. The one beside it. It's a cap."),
        ("en", "Not that one, the one beside it! A cap."),
        ("sv", "nä inte den, den bredvid, ja precis den! en bil"),
        ("sv", "Nej, den andra. Det är en bil."),
    ],
)
def test_what_turns_to_another_thing_teaches_nothing_of_this_one(
    language: str, text: str
) -> None:
    """But it does teach something of what the tutor points at now."""
    for anew in (False, True):
        situation = Situation(things=3, points=True, points_anew=anew)
        heard = hear_in_parts(understand(text, language), situation, language)
        acts = [predicate_at(it.readings[0].type, "e").name for it in heard.moves]
        assert ("instruct" in acts) == anew
