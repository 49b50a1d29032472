"""What tutors say, in each language, and the judgement that each of it must give."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from kille.dialogue.language import LANGUAGES, Utterance, understand
from kille.dialogue.meanings import predicate_at, record_type, theory
from ttr import Pred, parse


@cache
def utterances(language: str) -> dict[str, Any]:
    path = Path(__file__).with_name(f"utterances.{language}.toml")
    return tomllib.loads(path.read_text(encoding="utf-8"))


def judged() -> Iterator[tuple[str, str, str, str]]:
    for language in LANGUAGES:
        for group in utterances(language)["judged"]:
            for text in group["said"]:
                yield language, text, group["move"], group["content"]


REFUSED = [
    (language, text)
    for language in LANGUAGES
    for text in utterances(language)["refused"]
]


def known_best(language: str, readings: tuple[Utterance, ...]) -> Utterance:
    """The reading that somebody takes who knows the words of the list."""
    known = utterances(language)["known"]

    def unknown(reading: Utterance) -> int:
        new = [it for it in reading.signs if it.form not in known[it.kind]]
        return sum(len(it.form.split()) for it in new)

    return min(readings, key=unknown)


@cache
def in_notation(content: str) -> object:
    """What a content of the list is, with the words in it as predicates."""
    types = theory()
    two = re.findall(r"(\w+)\((?:target\.)?x, look\)", content)
    four = re.findall(r"(\w+)\((?:target\.)?x, landmark\.x, look, frame\)", content)
    own = [Pred(name, *types["noun"].arities) for name in two]
    own += [Pred(name, *types["relation"].arities) for name in four]
    basic = [types[name] for name in ("Ind", "Look", "Front", "Text", "Number")]
    return parse(content, using=[*basic, *dict.fromkeys(own), "faces_left"])


@pytest.mark.parametrize(("language", "text", "move", "content"), list(judged()))
def test_judged(language: str, text: str, move: str, content: str) -> None:
    (said,) = understand(text, language)
    assert said.readings, "not understood"
    best = known_best(language, said.readings)
    assert best.type <= record_type(move), predicate_at(best.type, "e")
    assert best.content is in_notation(content)


@pytest.mark.parametrize(("language", "text"), REFUSED)
def test_refused(language: str, text: str) -> None:
    assert not any(said.readings for said in understand(text, language))


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_list_is_long_enough(language: str) -> None:
    texts = [text for own, text, _, _ in judged() if own == language]
    assert len(set(texts)) == len(texts) >= 300
    assert len(set(utterances(language)["refused"])) >= 60
