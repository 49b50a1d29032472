"""How sure are you? Why? The robot says how certain it is of a claim, and what decided.

The reasons are looked for when the answer is made, by who sees and remembers: the cues
that speak for the word, and the lesson that the thing is most like.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import itemgetter

from kille.dialogue.beliefs import (
    about,
    as_told,
    beliefs_about,
    degree,
    has_rival,
    special_name,
    thinks,
)
from kille.dialogue.commitments import (
    affirmation,
    kind_of,
    lessons_in,
    same,
    signs_for,
)
from kille.dialogue.criteria import last_subject
from kille.dialogue.games.citing import cite_reasons
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    is_denial,
    predicate_at,
    set_to,
    value_at,
    values_at,
    word_of,
)
from kille.dialogue.moves import content_of, instead, plan
from kille.dialogue.reference import thing_at
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from kille.dialogue.taxonomy import are_related, subsumption
from kille.dialogue.unknown_words import plan_first_unknown
from ttr import Model, Rec, Record, RecordType, record
from ttr.updates import first

Update = tuple[Record, Model]

EXPLAINED = {"c": "ExplainName", "a": "ExplainQuality", "rel": "ExplainRelation"}
"""What the robot says to explain a claim, by its label."""


@rule(answers="AskCertainty")
def miss_certain(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks how certain something is in a word that was never learned."""
    return _plan_unknown_word(s, types=types)


@rule(answers="AskCertainty")
def tell_certainty(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """It says how certain the claim is, and what else it might be."""
    claim = claim_in_question(s)
    return None if claim is None else _plan_certainty(s, model, claim, types=types)


@rule(answers="AskSo")
def tell_conviction(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """The tutor asks back if it is so: it says of what it is how certain."""
    claim = claim_in_question(s)
    if claim is None:
        return None
    return _plan_certainty(s, model, claim, "TellConviction", types=types)


@rule(answers="AskWhy")
def miss_explained(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks why something is so in a word that was never learned."""
    return _plan_unknown_word(s, types=types)


@rule(answers="AskWhy")
def explain_kind(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It thinks so as it takes the thing for another kind, which is a kind of that."""
    claim = claim_in_question(s)
    if claim is None or kind_of(claim) != "c" or is_denial(claim):
        return None
    asked = next((it for it in s.private.nouns if claims(claim, it)), None)
    x = thing_at(claim, "target")
    if asked is None or x is None or x not in s.view.things:
        return None
    below = special_name(s, model, asked, x)
    own = beliefs_about(s, model, [asked], x)
    if below is None or not thinks(s, as_told(s, own)):
        return None
    cited = set_to(
        instead(claim, below, types=types), **dict(subsumption(below, asked).fields)
    )
    return plan(
        s,
        "ExplainKind",
        cited,
        signs=[below, asked],
        pending=_still_claimed(s, claim),
        types=types,
    )


@rule(answers="AskWhy")
def explain(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """It thinks so: it says by which cues, and what it was reminded of."""
    claim = claim_in_question(s)
    if claim is None or is_denial(claim):
        return None
    own, rival, model = _judge_claim(s, model, claim)
    if own is None or not thinks(s, [own]):
        return None
    p, other = _with_rival(s, claim, own, rival, types=types)
    explained = plan(
        s,
        EXPLAINED[kind_of(claim) or ""],
        claim,
        other,
        signs=signs_for(s, claim, other),
        degrees=p,
        explains=[claim],
        pending=_still_claimed(s, claim),
        types=types,
    )
    x = thing_at(claim, "target")
    if s.private.criteria and kind_of(claim) == "c" and x is not None:
        explained = cite_reasons(explained, model, own.sign, x, types=types)
    return explained, model


@rule(answers="AskWhy")
def explain_denial(s: Record, *, types: DialogueTypes) -> Record | None:
    """It thinks that it is not so, since the tutor said so: it says when."""
    claim = claim_in_question(s)
    if claim is None or not is_denial(claim):
        return None
    said = lessons_in(s, claim, types=types)
    if not said:
        return None
    return plan(
        s,
        "ExplainDenial",
        claim,
        signs=signs_for(s, claim),
        cites=[said[-1].key],
        pending=_still_claimed(s, claim),
        types=types,
    )


@rule(answers="AskWhy")
def doubt(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """It does not think so: it says how certain it is instead."""
    claim = claim_in_question(s)
    return None if claim is None else _plan_certainty(s, model, claim, types=types)


@rule(answers="AskWhy")
def lack_lessons(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks why it does not know: it has not been taught that well enough."""
    said = [predicate_at(move, "e").name for move in s.private.last]
    if not any(it.startswith(IGNORANCE) for it in said):
        return None
    return plan(s, "LackLessons", types=types)


IGNORANCE = ("admit_", "unknown_", "doubt_", "guess_")
"""How the names of the acts begin by which the robot says that it does not know."""


@rule(answers=("AskCertainty", "AskSo"))
def be_sure_of_nothing(s: Record, *, types: DialogueTypes) -> Record:
    """It has claimed nothing that it could be sure of."""
    return plan(s, "NoClaim", types=types)


@rule(answers="AskWhy")
def explain_nothing(s: Record, *, types: DialogueTypes) -> Record:
    """It has claimed nothing that it could explain."""
    return plan(s, "NoClaim", types=types)


def _plan_unknown_word(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to say that the word of the claim that is asked about is not known."""
    content = content_of(s)
    signs = (it for it in s.shared.latest.signs if claims(content, it))
    return plan_first_unknown(s, signs, pending=s.shared.pending, types=types)


def claim_in_question(s: Record) -> RecordType | None:
    """The claim that a question is about: the one in it, or what was claimed last.

    What has just been confirmed, corrected, taught or explained is a claim too, and so
    is what it has just said to be sure of, or not.
    """
    asked = content_of(s)
    if kind_of(asked) is not None:
        return asked
    if s.shared.pending:
        claimed: RecordType = s.shared.pending[0]
        return claimed
    told: list[RecordType] = [
        it
        for move in s.private.last
        for label in ("teaches", "explains")
        for it in values_at(move, label)
    ]
    judged: list[RecordType] = [
        value_at(move, "content")
        for move in s.private.last
        if predicate_at(move, "e").name in ("tell_certainty", "tell_conviction")
    ]
    return [_claim_of_criterion(s), *(told or judged)][-1]


def _claim_of_criterion(s: Record) -> RecordType | None:
    """The latest lesson in the noun of a criterion just taught, of a thing in view."""
    subject = last_subject(s)
    for it in s.private.lessons[::-1] if subject is not None else ():
        if it.sign.meaning == subject and it.content in s.shared.here:
            claim: RecordType = it.content
            return claim
    return None


def _still_claimed(s: Record, claim: RecordType) -> Sequence[RecordType]:
    """What was claimed and may be confirmed; nothing if asked about another claim."""
    pending: Sequence[RecordType] = s.shared.pending
    asked = affirmation(claim)
    return pending if any(same(asked, affirmation(it)) for it in pending) else ()


def _plan_certainty(
    s: Record,
    model: Model,
    claim: RecordType,
    act: str = "TellCertainty",
    *,
    types: DialogueTypes,
) -> Update:
    """The plan to say how certain a claim is."""
    own, rival, model = _judge_claim(s, model, affirmation(claim))
    if own is None:
        return plan(s, "NoClaim", types=types), model
    p, other = _with_rival(s, claim, own, rival, types=types)
    told = plan(
        s,
        act,
        claim,
        other,
        signs=signs_for(s, claim, other),
        degrees=p,
        pending=_still_claimed(s, claim),
        types=types,
    )
    return told, model


def _judge_claim(
    s: Record, model: Model, claim: RecordType
) -> tuple[Record | None, Record | None, Model]:
    """The robot's belief in a claim, and in the best other word of the same kind.

    A quality that the tutor has taught of this thing is certain, as in `checking`.
    """
    sign = next((it for it in words(s) if claims(claim, it)), None)
    if sign is None:
        return None, None, model
    sit = _situation(claim)
    rival = None if sign.kind == "adjective" else _best_other(s, model, sit, sign)
    [own], model = about(model, sit, [sign])
    if sign.kind == "adjective":
        [own] = as_told(s, [own])
    if rival is None:
        return own, None, model
    [other], model = about(model, sit, [rival])
    return own, other, model


def _best_other(s: Record, model: Model, sit: Record, sign: Record) -> Record | None:
    """The likeliest other word of its kind for a situation, if there is one.

    Of nouns it is one that may not be true as well, of another kind of thing.
    """
    args = (
        (sit.target.x, sit.landmark.x, sit.look, sit.frame)
        if sign.kind == "relation"
        else (sit.x, sit.look)
    )
    others = [
        (-degree(model, word_of(it)(*args)), it.form, it)
        for it in s.private[f"{sign.kind}s"]
        if it != sign and not (sign.kind == "noun" and are_related(s, it, sign))
    ]
    return min(others, key=itemgetter(0, 1))[2] if others else None


def _situation(claim: RecordType) -> Record:
    """What a claim is about, as words are judged of it."""
    look = value_at(claim, "look")
    x = thing_at(claim, "target")
    if "rel" not in claim:
        return record(x=x, look=look)
    return record(
        look=look,
        frame=value_at(claim, "frame"),
        target=record(x=x, look=look),
        landmark=record(x=thing_at(claim, "landmark"), look=look),
    )


def _with_rival(
    s: Record,
    claim: RecordType,
    own: Record,
    rival: Record | None,
    *,
    types: DialogueTypes,
) -> tuple[list[float], RecordType]:
    """How certain a claim is, and a rival to it that is worth naming, if any."""
    if is_denial(claim):
        return [1.0 - own.p], Rec
    if rival is None or not has_rival(s, [own, rival]):
        return [own.p], Rec
    return [own.p, rival.p], instead(claim, rival.sign, types=types)


EXPLAINING = first(
    miss_certain,
    tell_certainty,
    tell_conviction,
    miss_explained,
    explain_kind,
    explain,
    explain_denial,
    doubt,
    be_sure_of_nothing,
    lack_lessons,
    explain_nothing,
)
