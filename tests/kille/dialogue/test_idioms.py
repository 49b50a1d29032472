"""Idioms and odd sentences, in front of one thing: none of them teaches anything."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from kille.dialogue.language import LANGUAGES, understand
from kille.dialogue.tutoring import hear_sentences

LISTS = Path(__file__).with_name("tutors")

STARTS = {
    "en": (
        "This is",
        "That is",
        "It is",
        "I think this is",
        "Well, that's",
        "Oh, it's",
        "And that is",
    ),
    "sv": ("Det här är", "Det där är", "Det är", "Jag tror att det är"),
}
ENDS = {
    "en": (
        "a good question", "a great idea", "a long story", "a real shame", "a pity",
        "a piece of cake", "a can of worms", "a test", "a joke", "a miracle", "life",
        "a matter of opinion", "a question of time", "a pleasure", "an honour", "love",
        "a red herring", "a dead end", "a tall order", "a mixed bag", "a paper tiger",
        "a waste of time", "a shame", "an emergency", "a disaster", "fun", "enough",
        "nothing", "everything", "Monday", "a mistake", "a lie", "a secret", "history",
        "a sign of hope", "an opinion", "a fact", "a dream", "a wild goose chase",
        "a sight for sore eyes", "sugar", "cup", "called cup", "Sparta", "nonsense",
    ),
    "sv": (
        "en bra fråga", "en lång historia", "en skam", "synd", "en dröm", "livet",
        "en smaksak", "en tidsfråga", "en katastrof", "ett elände", "en ära", "fredag",
        "en sanning med modifikation", "en gåta", "ett under", "en lögn", "ingenting",
        "en gammal käpphäst", "nog", "mycket", "kärlek", "en överdrift", "socker",
        "rena grekiskan", "inte hela världen", "en möjlighet", "en ny upplevelse",
    ),
}  # fmt: skip


def sentences(language: str) -> Iterator[str]:
    """The idioms of the list, and sentences made of parts."""
    yield from (LISTS / f"idioms_{language}.txt").read_text("utf-8").splitlines()
    for start in STARTS[language]:
        yield from (f"{start} {end}{mark}" for end in ENDS[language] for mark in ".!")


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_idiom_teaches_anything(scene: Callable[..., Any], language: str) -> None:
    taught = []
    texts = list(dict.fromkeys(sentences(language)))
    for text in texts:
        robot = scene(1, nouns=["wug"], language=language)
        for said in understand(text, language):
            if said.readings:
                robot._take(hear_sentences(said))
        if robot.state.private.lessons:
            taught.append(text)
    assert not taught, f"{len(taught)} of {len(texts)}"
