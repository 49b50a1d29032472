"""What is heard of a sentence of which only hypotheses are known, none of the grammar.

Each hypothesis is read by its parts as a typed text is. Those that come to one move are
alternatives of one event, as probable as the hypotheses are. What was not heard for
sure teaches nothing without a question.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from kille.dialogue.language import Sentence, understand
from kille.dialogue.meanings import DialogueTypes, packaged_types
from kille.dialogue.robust_reading.lessons_together import doubt_lesson
from kille.dialogue.robust_reading.sentence_reading import NOTHING, Understanding
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.robust_reading.text_hearing import (
    claims_something,
    hear_in_parts,
    is_doubted,
)
from kille.dialogue.speech_hypotheses import SURE
from kille.dialogue.word_lists import PARTIAL

Hypotheses = Sequence[tuple[str, float]]
"""The texts that were perhaps said, and how probable each is."""


class UncertainMove(NamedTuple):
    """What may be one move: the sentences that it may be, and how probable each is."""

    sentences: tuple[Sentence, ...]
    p: tuple[float, ...]


class UncertainHearing(NamedTuple):
    """The moves that are heard, in order; without any, what was understood at all."""

    moves: tuple[UncertainMove, ...]
    understood: Understanding


def hear_hypotheses_in_parts(
    texts: Hypotheses,
    situation: Situation,
    language: str = "en",
    *,
    types: DialogueTypes | None = None,
) -> UncertainHearing:
    """What is heard of texts of which one was perhaps said, each read by its parts.

    Where the likeliest that is understood comes to several moves, it alone counts, and
    what the robot asks about comes last.

    >>> texts = [("i have found uh a cup", 0.5), ("i have found a cap", 0.3)]
    >>> [heard] = hear_hypotheses_in_parts(texts, Situation(things=1)).moves
    >>> [it.readings[0].signs[0].form for it in heard.sentences], heard.p
    (['cup', 'cap'], (0.5, 0.3))
    """
    types = types or packaged_types()
    ranked = sorted(texts, key=lambda it: -it[1])
    heard = [
        hear_in_parts(
            understand(text, language, types=types), situation, language, types=types
        )
        for text, _ in ranked
    ]
    ways = [
        ([_as_heard(move, p, types) for move in it.moves], p)
        for it, (_, p) in zip(heard, ranked, strict=True)
        if it.moves
    ]
    if not ways:
        missed = [found for it in heard[:1] for _, found in it.missed]
        return UncertainHearing((), missed[0] if missed else NOTHING)
    moves, p = ways[0]
    if len(moves) > 1:
        ordered = sorted(moves, key=is_doubted)
        several = tuple(UncertainMove((it,), (p,)) for it in ordered)
        return UncertainHearing(several, NOTHING)
    single = [(them[0], p) for them, p in ways if len(them) == 1]
    sentences, shares = zip(*single, strict=True)
    return UncertainHearing((UncertainMove(sentences, shares),), NOTHING)


def _as_heard(move: Sentence, p: float, types: DialogueTypes) -> Sentence:
    """The move, to be asked about if it claims something and was not heard for sure."""
    if p >= SURE or not claims_something(move):
        return move
    return doubt_lesson(move, PARTIAL, types=types)
