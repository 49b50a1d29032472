"""Is this a cup? The robot says yes or no, as far as it is certain.

What it answers is a claim, which the tutor may confirm or deny.
"""

from __future__ import annotations

from kille.dialogue.beliefs import (
    Beliefs,
    as_told,
    beliefs_about,
    is_sure,
    knows,
    special_name,
)
from kille.dialogue.games.colouring import plan_colour
from kille.dialogue.language import UNLIKELY
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    set_to,
    word_of,
)
from kille.dialogue.moves import content_of, instead, plan
from kille.dialogue.reference import thing_at
from kille.dialogue.reference.resolving import taught_words
from kille.dialogue.rules import rule
from kille.dialogue.taxonomy import subsumption, without_related
from kille.dialogue.unknown_words import plan_first_unknown
from ttr import Model, Record, RecordType, replace
from ttr.updates import first, seq


@rule(answers="AskWhether")
def miss_claimed(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks by a word that was never learned."""
    if _is_taught(s):
        return None
    return plan_first_unknown(s, [_asked_word(s)], types=types)


@rule(answers="AskWhether")
def miss_place(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks how things stand of which it does not know where they are."""
    if _asked_word(s).kind != "relation" or set(_things(s)) <= set(s.view.placed):
        return None
    return plan(s, "NeedDepth", types=types)


@rule(answers="AskWhether")
def weigh(s: Record, *, model: Model) -> Record | None:
    """It judges the word that is asked about, and those it might be instead."""
    things = _things(s)
    if not things:
        return None
    beliefs = as_told(s, beliefs_about(s, model, _alternatives(s), *things))
    if _asked_word(s).kind == "noun":
        beliefs = without_related(s, _asked_word(s), beliefs)
    return replace(s, {"private.beliefs": beliefs})


@rule(answers="AskWhether")
def say_yes(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It is sure that it is so, by what it sees or by an axiom, which it then cites."""
    if not _is_so(s):
        return None
    content, asked = content_of(s), _asked_word(s)
    below = special_name(s, model, asked, *_things(s)) if asked.kind == "noun" else None
    if below is None:
        return _plan_claim(s, "SayYes", content, types=types)
    cited = set_to(content, **dict(subsumption(below, asked).fields))
    signs = (*s.shared.latest.signs, below)
    return plan(s, "SayYes", cited, signs=signs, pending=[content], types=types)


@rule(answers="AskWhether")
def say_rather(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is sure of another word, and this one is not likely: it says which."""
    best = s.private.beliefs[0]
    if _p(s) >= s.private.strategy.bands.likely or not _sure_of_first(s):
        return None
    content = instead(content_of(s), best.sign, types=types)
    signs = [*s.shared.latest.signs, best.sign]
    rival = denial(content_of(s))
    return plan(
        s, "SayRather", content, rival, signs=signs, pending=[content], types=types
    )


@rule(answers="AskWhether")
def say_no(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is hardly possible that it is so."""
    unlikely = _p(s) <= s.private.strategy.bands.unlikely
    return (
        _plan_claim(s, "SayNo", denial(content_of(s)), types=types)
        if unlikely
        else None
    )


@rule(answers="Directed")
def say_converse(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It is sure that it is the other way round, which excludes what is asked."""
    if not types.has(s.shared.latest, "AskWhether", model):
        return None
    content, things = content_of(s), _things(s)
    beliefs = beliefs_about(s, model, [_asked_word(s)], *reversed(things))
    if _p(s) >= s.private.strategy.bands.likely or not is_sure(s, beliefs):
        return None
    turned = set_to(content, target=content["landmark"], landmark=content["target"])
    signs = s.shared.latest.signs
    return plan(
        s,
        "SayRather",
        turned,
        denial(content),
        signs=signs,
        pending=[turned],
        types=types,
    )


@rule(answers="AskWhether")
def say_probably(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is more likely so than not."""
    probable = _p(s) >= s.private.strategy.bands.probable
    return (
        _plan_claim(s, "SayProbably", content_of(s), types=types) if probable else None
    )


@rule(answers="AskWhether")
def say_what_colour(s: Record, *, types: DialogueTypes) -> Record | None:
    """It cannot tell if it is of this colour: it says of which one it thinks it is."""
    if not knows(s.private.colours, _asked_word(s)):
        return None
    return plan_colour(s, types=types)


@rule(answers="AskWhether")
def admit_whether(s: Record, *, types: DialogueTypes) -> Record:
    """It does not know, and says of what: the tutor may then answer that themselves.

    Not where they suppose that it is not so, as a yes or no may mean either then.
    """
    said = s.shared.latest
    if "stance" in said and said.stance == UNLIKELY:
        return plan(s, "AdmitWhether", types=types)
    return plan(s, "AdmitWhether", content_of(s), signs=said.signs, types=types)


def _asked_word(s: Record) -> Record:
    """The word that the tutor asks about."""
    content = content_of(s)
    asked: Record = next(it for it in s.shared.latest.signs if claims(content, it))
    return asked


def _things(s: Record) -> list[str]:
    """The thing that is asked about, and what it is said to stand beside."""
    labels = ("target", "landmark")
    found = [thing_at(content_of(s), it) for it in labels if it in content_of(s)]
    return [x for x in found if x is not None]


def _alternatives(s: Record) -> list[Record]:
    """The words it might be instead: of a thing one noun is true, and one colour."""
    asked = _asked_word(s)
    match asked.kind:
        case "noun":
            nouns = list(s.private.nouns)
            return nouns if knows(nouns, asked) else [*nouns, asked]
        case "relation":
            return list(s.private.relations)
    return list(s.private.colours) if knows(s.private.colours, asked) else [asked]


def _is_taught(s: Record) -> bool:
    """Whether the tutor has said or denied just this of the thing in view.

    Who has only been told what is no cup does not know what a cup is, but that.
    """
    things = _things(s)
    return (word_of(_asked_word(s)), *things) in taught_words(s)


def _belief(s: Record) -> Beliefs:
    """The belief about the word that is asked about."""
    return [b for b in s.private.beliefs if knows([b.sign], _asked_word(s))]


def _p(s: Record) -> float:
    return max((b.p for b in _belief(s)), default=0.0)


def _is_so(s: Record) -> bool:
    """Whether it is sure; of nouns there must be no near rival, or it was told so."""
    if _asked_word(s).kind == "noun":
        if taught_words(s).get((word_of(_asked_word(s)), _things(s)[0])):
            return True
        return _sure_of_first(s) and knows([s.private.beliefs[0].sign], _asked_word(s))
    return bool(_p(s) >= s.private.strategy.bands.sure)


def _sure_of_first(s: Record) -> bool:
    return is_sure(s, s.private.beliefs)


def _plan_claim(
    s: Record, act: str, content: RecordType, *, types: DialogueTypes
) -> Record:
    return plan(
        s, act, content, signs=s.shared.latest.signs, pending=[content], types=types
    )


CHECKING = first(
    miss_claimed,
    miss_place,
    seq(
        weigh,
        first(
            say_yes,
            say_rather,
            say_no,
            say_converse,
            say_probably,
            say_what_colour,
            admit_whether,
        ),
    ),
)
