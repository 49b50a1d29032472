"""How many cups are there? The robot counts, and says which ones it is not sure of.

Whether all of them are red it answers by how many are.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.games.surveying import in_view
from kille.dialogue.meanings import DialogueTypes, mentions, set_to
from kille.dialogue.moves import content_of, number_field, plan
from kille.dialogue.reference import PhraseJudge, fits_well, phrase_at
from kille.dialogue.rules import rule
from kille.dialogue.unknown_words import plan_first_unknown
from ttr import Model, Record, record
from ttr.updates import first


@rule(answers=("AskCount", "AskAll", "AskMoreOf"))
def miss_counted(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks how many there are, or if all are, by a word never learned."""
    content = content_of(s)
    asked = [phrase_at(content, it) for it in COUNTED if it in content]
    said = s.shared.latest.signs
    signs = (sign for sign in said if any(mentions(it, sign) for it in asked))
    return plan_first_unknown(s, signs, types=types)


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


@rule(answers="AskMoreOf")
def compare_counts(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """The tutor asks if there are more of one sort: it says how many of each."""
    bands, judge = s.private.strategy.bands, PhraseJudge(s, model, types=types)
    seen: list[list[Record]] = []
    for label in ("counted", "others"):
        counted = phrase_at(content_of(s), label)
        found = judge.fits(counted)
        if any(bands.likely <= it.weakest < bands.sure for it in found.values()):
            return plan(s, "AdmitWhether", types=types)
        sign = record(meaning=counted)
        sure = [x for x, fit in found.items() if fit.weakest >= bands.sure]
        seen.append([record(sit=record(x=x), sign=sign, p=1.0) for x in sure])
    own, other = (in_view(s, it, (), (), types=types) for it in seen)
    more = len(seen[0]) - len(seen[1])
    act = "SayMore" if more > 0 else "SayNotMore" if more < 0 else "SayAsMany"
    return plan(s, act, own, other, signs=s.shared.latest.signs, types=types)


@rule(answers="AskAll")
def count_all(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """The tutor asks if something is so of all: it says of how many it is."""
    content, bands = content_of(s), s.private.strategy.bands
    judge = PhraseJudge(s, model, types=types)
    things: Sequence[str] = s.view.things
    if "among" in content:
        things = fits_well(s, judge.fits(phrase_at(content, "among")))
    if not things:
        return plan(s, "SeeNothing", types=types)
    fits = judge.fits(phrase_at(content, "counted"), things)
    sure = [x for x in things if x in fits and fits[x].weakest >= bands.sure]
    unlikely = [x for x in things if x not in fits or fits[x].weakest < bands.likely]
    if len(sure) + len(unlikely) < len(things):
        return plan(s, "AdmitWhether", types=types)
    act = "SayOnly" if sure else "SayNone"
    if not unlikely:
        act = {1: "SaySingle", 2: "SayBoth"}.get(len(things), "SayAll")
    sign = record(meaning=phrase_at(content, "counted"))
    seen = [record(sit=record(x=x), sign=sign, p=1.0) for x in sure]
    told = in_view(s, seen, (), (), types=types)
    if len(sure) == 1:
        told = set_to(told, **number_field(s, sure[0], types=types))
    return plan(s, act, told, points=sure[:1], types=types)


COUNTED = ("counted", "among", "others")
"""The labels of the phrases whose things are counted."""

COUNTING = first(miss_counted, count, compare_counts, count_all)
