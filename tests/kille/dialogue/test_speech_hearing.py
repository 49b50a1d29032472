"""What is heard of hypotheses of which none is a sentence of the grammar."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.language import understand
from kille.dialogue.meanings import predicate_at
from kille.dialogue.robust_reading.island_kinds import CLAIMS
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.robust_reading.speech_hearing import (
    Hypotheses,
    UncertainMove,
    hear_hypotheses_in_parts,
)
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.dialogue.speech_hypotheses import SURE


def hear_moves(texts: Hypotheses, language: str = "en") -> tuple[UncertainMove, ...]:
    return hear_hypotheses_in_parts(texts, Situation(things=1), language).moves


def acts(move: UncertainMove) -> list[str]:
    found = (predicate_at(it.readings[0].type, "e").name for it in move.sentences)
    return [str(it) for it in found]


# What open recognisers write: small letters, no punctuation, words that sound alike.
ALIKE = [
    (
        "en",
        [("so what is this thing called then", 0.6), ("so what is his", 0.3)],
        ["ask_name", "ask_deed"],
    ),
    (
        "en",
        [("i have found a cup", 0.5), ("i have found a cap", 0.4)],
        ["instruct", "instruct"],
    ),
    ("en", [("um okay where is the book", 0.8)], ["ask_place"]),
    (
        "sv",
        [("öh vad är det här", 0.5), ("öh va är det här", 0.4)],
        ["ask_name", "ask_name"],
    ),
    (
        "sv",
        [("jag har hittat en kopp", 0.5), ("jag har hittat en knopp", 0.4)],
        ["instruct", "instruct"],
    ),
]


@pytest.mark.parametrize(("language", "texts", "moves"), ALIKE)
def test_hypotheses_are_alternatives_of_one_move(
    language: str, texts: Hypotheses, moves: list[str]
) -> None:
    [move] = hear_moves(texts, language)
    assert acts(move) == moves
    assert list(move.p) == [p for _, p in texts][: len(moves)]


def test_the_likeliest_alone_counts_where_it_is_several_moves() -> None:
    texts = [("um this is a cup and where is the book", 0.6), ("well hello", 0.3)]
    assert [acts(it) for it in hear_moves(texts)] == [["ask_place"], ["instruct"]]
    assert {it.p for it in hear_moves(texts)} == {(0.6,)}


def test_where_nothing_is_understood_the_phrases_of_the_likeliest_are_kept() -> None:
    found = hear_hypotheses_in_parts(
        [("blah blah", 0.2), ("blubb has are", 0.7)], Situation(things=1)
    )
    assert not found.moves
    assert found.understood.missed == ("blubb", "has", "are")


WORDS = (
    "this", "that", "is", "a", "the", "cup", "mug", "red", "um", "well", "yes", "no",
    "not", "i", "have", "found", "and", "it",
)  # fmt: skip


@given(st.lists(st.sampled_from(WORDS), min_size=1, max_size=9), st.floats(0.01, 1.0))
def test_no_claim_that_was_not_heard_for_sure_is_without_doubt(
    words: list[str], p: float
) -> None:
    text, situation = " ".join(words), Situation(things=1)
    typed = hear_in_parts(understand(text), situation).moves
    moves = hear_moves([(text, p)])
    assert len(moves) == len(typed)
    for move in moves:
        if p < SURE and acts(move)[0] in CLAIMS:
            assert "doubt" in move.sentences[0].readings[0].type
