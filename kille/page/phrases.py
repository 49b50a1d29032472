"""Sentences that the page says for the tutor, at the press of a button."""

from __future__ import annotations

from typing import NamedTuple


class Phrases(NamedTuple):
    """What a tutor answers, in one language."""

    yes: str
    no: str
    right: str
    wrong: str
    undo: str
    undo_last: str
    why: str
    call: str
    """To say what "this" is called, with the word in the place of {a_word}."""


PHRASES = {
    "en": Phrases(
        "Yes.",
        "No.",
        "That is correct.",
        "That is wrong.",
        "Forget that.",
        "Forget the last thing.",
        "Why?",
        "This is {a_word}.",
    ),
    "sv": Phrases(
        "Ja.",
        "Nej.",
        "Det är rätt.",
        "Det är fel.",
        "Glöm det.",
        "Glöm det senaste.",
        "Varför?",
        "Det här är {a_word}.",
    ),
}


def phrases(language: str) -> Phrases:
    """The sentences in a language; in English where there are none."""
    return PHRASES.get(language, PHRASES["en"])
