"""How many cups are there? The robot counts, and says which ones it is not sure of."""

from __future__ import annotations

from kille.dialogue.beliefs import knows
from kille.dialogue.games.surveying import in_view
from kille.dialogue.meanings import DialogueTypes, mentions
from kille.dialogue.moves import content_of, plan
from kille.dialogue.reference import PhraseJudge, phrase_at
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from ttr import Model, Record, record
from ttr.updates import first


@rule(answers="AskCount")
def miss_counted(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks how many there are of what was never learned."""
    counted = phrase_at(content_of(s), "counted")
    for sign in s.shared.latest.signs:
        if mentions(counted, sign) and not knows(words(s), sign):
            act = f"Unknown{sign.kind.capitalize()}"
            return plan(s, act, sign.meaning, signs=[sign], types=types)
    return None


@rule(answers="AskCount")
def count(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """It counts what it is sure of, and what may be one besides."""
    counted = phrase_at(content_of(s), "counted")
    bands = s.private.strategy.bands
    found = PhraseJudge(s, model, types=types).fits(counted)
    sign = record(meaning=counted)
    fits = [
        record(sit=record(x=x), sign=sign, p=fit.weakest)
        for x, fit in found.items()
        if fit.weakest >= bands.likely
    ]
    sure = [it for it in fits if it.p >= bands.sure]
    likely = [it for it in fits if it.p < bands.sure]
    content = in_view(s, sure, likely, (), types=types)
    return plan(s, "TellCount", content, signs=s.shared.latest.signs, types=types)


COUNTING = first(miss_counted, count)
