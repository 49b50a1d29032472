"""Resolving a phrase while it is being said: what is probably meant, word by word.

How salient things are by what is seen and said is in `salience`; this is about how well
the words so far fit them.

Source: Kennington and Schlangen 2015 (words as classifiers, incremental resolution).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import reduce

from kille.dialogue.meanings import (
    DialogueTypes,
    merge_of,
    packaged_types,
)
from kille.dialogue.reference.parts import PhraseParts, put_together, take_apart
from kille.dialogue.reference.resolving import PhraseJudge
from ttr import Model, Record, RecordType, rectype


def ranking(
    s: Record,
    model: Model,
    words: Iterable[Record],
    *,
    types: DialogueTypes | None = None,
) -> tuple[Mapping[str, float], ...]:
    """How the things in view share the probability to be meant, after each word.

    The words are signs, in the order of the phrase: "red", "cup", "to the left of",
    "book". Where nothing fits, no thing has a share.

    >>> from kille.dialogue.meanings import noun
    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> things = Thing("cup", "red", place=(2, 3)), Thing("book", "red", place=(7, 3))
    >>> game = simulated_game(World(things, focus=1))
    >>> run = game.take(game.begin(), game.hear("This is a cup.")).run
    >>> [shares] = ranking(run.state, run.model, [noun("cup")])
    >>> max(shares, key=shares.get)
    'o1'
    """
    types = types or packaged_types()
    said: list[Record] = []
    judging = PhraseJudge(s, model, types=types)
    shares = []
    for sign in words:
        said.append(sign)
        fits = judging.fits_part(said_by(said, types=types))
        whole = sum(fit.p for fit in fits.values())
        shares.append({x: fit.p / whole for x, fit in fits.items() if whole > 0.0})
    return tuple(shares)


def said_by(
    words: Sequence[Record], *, types: DialogueTypes | None = None
) -> PhraseParts:
    """The parts of a phrase of these words, without putting its type together first.

    >>> from kille.dialogue.meanings import adjective, noun
    >>> parts = said_by([adjective("red"), noun("cup")])
    >>> parts
    PhraseParts(thing=None, claims=(Pred('is_red', Basic('Ind'), Basic('Look'))(this.x,
    this.look), Pred('cup', Basic('Ind'), Basic('Look'))(this.x, this.look)),
    qualities=frozenset({Pred('is_red', Basic('Ind'), Basic('Look'))}), relations=(),
    choices=(), landmark=None)
    """
    types = types or packaged_types()
    at = next((i for i, it in enumerate(words) if it.kind == "relation"), None)
    before = [take_apart(sign.meaning) for sign in words[:at]]
    phrase = put_together(take_apart(types.record_type("Phrase")), *before)
    if at is None:
        return phrase
    nearby = take_apart(types.meaning_at(words[at], "Nearby"))
    return put_together(
        phrase, replace(nearby, landmark=said_by(words[at + 1 :], types=types))
    )


def meant_by(
    words: Sequence[Record], *, types: DialogueTypes | None = None
) -> RecordType:
    """The type of a phrase of these words: the merge of what they mean.

    What follows a relation is said of what the thing stands beside.

    >>> from kille.dialogue.meanings import adjective, noun
    >>> print(meant_by([adjective("red"), noun("cup")]))
    [look : Look, x : Ind, a : is_red(x, look), c : cup(x, look)]
    """
    types = types or packaged_types()
    phrase = types.record_type("Phrase")
    for i, sign in enumerate(words):
        if sign.kind == "relation":
            beside = types.meaning_at(sign, "Nearby")
            landmark = rectype(landmark=meant_by(words[i + 1 :], types=types))
            return reduce(
                merge_of, [types.record_type("Beside"), beside, landmark], phrase
            )
        phrase = merge_of(phrase, sign.meaning)
    return phrase
