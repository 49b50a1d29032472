"""Beliefs about the things in the latest look: how probably words are true of them.

Only what is asked about is judged. A belief is a record {sit, sign, p}: that a
situation is of the type that the sign means. The model that is returned with it has
its judgements.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from functools import lru_cache

from kille.dialogue.meanings import KINDS, is_denial, word_of
from kille.dialogue.reference.perspectives import front_of
from kille.dialogue.reference.resolving import taught_words, thing_at
from kille.dialogue.taxonomy import are_related, has_kind, is_kind_of, rank_names
from ttr import Model, Pred, Record, record, replace
from ttr.safety.budgets import cache_in_question
from ttr.types import PType

Beliefs = Sequence[Record]


def relations_of(s: Record, model: Model, x: str, y: str) -> tuple[Beliefs, Model]:
    """How probably x stands in each relation to y, the most probable first."""
    return about(model, _pair(s, x, y), s.private.relations)


def about(model: Model, sit: Record, signs: Iterable[Record]) -> tuple[Beliefs, Model]:
    """How probably a situation is of what each sign means, the most probable first."""
    beliefs = []
    for sign in signs:
        judgement = model.perceive(sit, sign.meaning)
        model = judgement.model
        beliefs.append(record(sit=judgement.sit, sign=sign, p=judgement.p.lo))
    return sorted(beliefs, key=lambda b: (-b.p, b.sign.form)), model


@cache_in_question
def beliefs_about(
    s: Record, model: Model, signs: Iterable[Record], x: str, *beside: str
) -> Beliefs:
    """How probably words are true of x, or of x beside y, the most probable first."""
    look = s.view.look
    front = [front_of(s, y) for y in beside]
    sit = _pair(s, x, *beside) if beside else record(x=x, look=look)
    beliefs = [
        record(
            sit=sit, sign=sign, p=degree(model, word_of(sign)(x, *beside, look, *front))
        )
        for sign in signs
    ]
    return sorted(beliefs, key=lambda b: (-b.p, b.sign.form))


def _pair(s: Record, x: str, y: str) -> Record:
    """The situation of two things, in the perspective that the talk has settled on."""
    look = s.view.look
    return record(
        look=look,
        frame=front_of(s, y),
        target=record(x=x, look=look),
        landmark=record(x=y, look=look),
    )


def names_of(s: Record, model: Model, x: str) -> Beliefs:
    """How probably each noun is true of x, the one that it would be called by first.

    After it come its rivals: nouns of which it is a kind, or which are kinds of it, may
    be true as well. As long as x is in view, what the tutor called it is certain, and
    its rivals are left out; what the tutor denied is out of the question. Of rivals
    that the tutor called it, each is as probable as its share in how often that was.
    """
    beliefs = as_told(s, beliefs_about(s, model, s.private.nouns, x))
    called = _nouns_called(s, x)
    return rank_names(s, _share_out(s, beliefs, called) if called else beliefs)


def _share_out(s: Record, beliefs: Beliefs, called: Sequence[Record]) -> Beliefs:
    """The beliefs in what a thing is, if it is called by these nouns."""
    words = frozenset(map(word_of, called))
    shared = []
    for it in beliefs:
        if word_of(it.sign) in words or (s.private.kinds and has_kind(s, it.sign)):
            p = min(it.p, _share(s, it.sign, called))
            shared.append(it if p == it.p else replace(it, p=p))
    return sorted(shared, key=lambda it: (-it.p, it.sign.form))


def _nouns_called(s: Record, x: str) -> Sequence[Record]:
    """What the tutor has called x since it came into view, once for each time."""
    here = frozenset(s.shared.here) if s.private.lessons else frozenset()
    return [
        it.sign
        for it in s.private.lessons
        if "c" in it.content
        and it.content in here
        and not is_denial(it.content)
        and thing_at(it.content, "target") == x
    ]


def _share(s: Record, noun: Record, called: Sequence[Record]) -> float:
    """How probable a noun is at most, if a thing is called by these nouns."""
    of_it = sum(is_kind_of(s, it, noun) for it in called)
    certain = of_it and all(are_related(s, noun, it) for it in called)
    return 1.0 if certain else of_it / len(called)


def as_told(s: Record, beliefs: Beliefs) -> Beliefs:
    """What it believes of things in view, where what it was told of them is certain.

    The tutor decides what words mean: the robot does not deny that a thing is red which
    the tutor has just called red, whatever most people would call it.
    """
    told = taught_words(s)
    certain = []
    for it in beliefs:
        so = told.get((word_of(it.sign), it.sit.x)) if "x" in it.sit else None
        certain.append(it if so is None else replace(it, p=float(so)))
    return sorted(certain, key=lambda it: (-it.p, it.sign.form))


def special_name(s: Record, model: Model, noun: Record, x: str) -> Record | None:
    """The likeliest noun that x is called by and that is a kind of this one.

    None if x would be called by the noun itself, whatever else it is.
    """
    kinds = [it for it in s.private.nouns if is_kind_of(s, it, noun)]
    if len(kinds) < 2:
        return None
    name = rank_names(s, beliefs_about(s, model, kinds, x))[0].sign
    return None if knows([noun], name) else name


def degree(model: Model, claim: PType) -> float:
    """How probable a claim is at least, by the witness function of its word."""
    seen = model.facts.perceive(None, claim)
    return 0.0 if seen is None else float(seen.lo)


def certainty(s: Record, beliefs: Beliefs) -> str:
    """How to say the first belief: Assert, Hedge, Guess, Doubt, or else Admit.

    It asserts what it is sure of, and does not say what is not worth saying. In between
    it names the rival, if there is one, and otherwise says how sure it is.
    """
    if is_sure(s, beliefs):
        return "Assert"
    if not thinks(s, beliefs):
        return "Admit"
    if has_rival(s, beliefs):
        return "Hedge"
    return "Guess" if beliefs[0].p >= s.private.strategy.bands.think else "Doubt"


def doubt(beliefs: Beliefs) -> float:
    """How far the first belief is from being certain and without a rival."""
    return 1.0 - lead(beliefs) if beliefs else 1.0


def lead(beliefs: Beliefs) -> float:
    """How far the first belief is ahead of the second."""
    first, second = [*(b.p for b in beliefs[:2]), 0.0, 0.0][:2]
    return float(first - second)


def is_sure(s: Record, beliefs: Beliefs) -> bool:
    """Whether the first belief is certain enough, and far enough from the second."""
    if not beliefs:
        return False
    sure = s.private.strategy.bands.sure
    ahead = _needed_lead(s, beliefs[0].sign)
    return bool(beliefs[0].p >= sure and lead(beliefs) >= ahead)


def _needed_lead(s: Record, sign: Record) -> float:
    """How far ahead of its rival a word must be to be asserted.

    A name the farther, the fewer strangers the robot reckons with.
    """
    strategy = s.private.strategy
    bands = strategy.bands
    if sign.kind != "noun":
        return float(bands.margin)
    familiar = 1.0 - 2.0 * strategy.strangers
    return float(bands.margin + (bands.name_margin - bands.margin) * familiar)


def thinks(s: Record, beliefs: Beliefs) -> bool:
    """Whether the first belief is worth saying."""
    return bool(beliefs) and bool(beliefs[0].p >= s.private.strategy.bands.likely)


def has_rival(s: Record, beliefs: Beliefs) -> bool:
    """Whether the second belief is worth naming: it always is if it is as probable."""
    if len(beliefs) < 2:
        return False
    first, second, *_ = beliefs
    return bool(second.p >= min(s.private.strategy.bands.might, first.p))


def knows(words: Iterable[Record], sign: Record) -> bool:
    """Whether a word with the sign's predicate is among these."""
    own = word_of(sign)
    return any(word_of(known) is own for known in words)


def knows_word(s: Record, sign: Record) -> bool:
    """Whether the robot knows a word with the sign's predicate."""
    return word_of(sign) in known_words(s)


@cache_in_question
def known_words(s: Record) -> Set[Pred]:
    """The predicates of the words that the robot knows."""
    private = s.private
    return frozenset().union(*(_words_in(private[f"{kind}s"]) for kind in KINDS))


@lru_cache(64)
def _words_in(signs: tuple[Record, ...]) -> frozenset[Pred]:
    return frozenset(map(word_of, signs))
