"""Kinds of things that are kinds of others: the axioms that a tutor teaches.

"A mug is a kind of cup." puts mug(x, look) <: cup(x, look) into the theory in which the
robot judges, as a theory file may: whatever is a mug is a cup, at least as probably. A
content that says so has two parts, `subkind` and `superkind`, what a noun means each.

"Tin is another word for can." is such an axiom in both directions; its content has the
parts `synonym` and `headword`.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from functools import lru_cache

from kille.dialogue.meanings import DialogueTypes, set_to, single_claims, word_of
from ttr import Model, Record, RecordType, rectype
from ttr.signature.axioms import supertypes
from ttr.signature.signature import Axiom, head
from ttr.types import PType

LOWER, UPPER = "subkind", "superkind"
"""The labels of what the two nouns mean."""

SYNONYM, HEADWORD = "synonym", "headword"
"""The labels of what two nouns mean that mean the same."""

Beliefs = Sequence[Record]


def subsumption(lower: Record, upper: Record) -> RecordType:
    """The content that one noun is a kind of another.

    >>> from kille.dialogue.meanings import noun
    >>> print(subsumption(noun("mug"), noun("cup")))  # doctest: +NORMALIZE_WHITESPACE
    [subkind : [look : Look, x : Ind, c : mug(x, look)],
     superkind : [look : Look, x : Ind, c : cup(x, look)]]
    """
    return rectype({LOWER: lower.meaning, UPPER: upper.meaning})


def synonymy(synonym: Record, headword: Record) -> RecordType:
    """The content that one noun is another word for what another noun means.

    >>> from kille.dialogue.meanings import noun
    >>> print(synonymy(noun("tin"), noun("can")))  # doctest: +NORMALIZE_WHITESPACE
    [headword : [look : Look, x : Ind, c : can(x, look)],
     synonym : [look : Look, x : Ind, c : tin(x, look)]]
    """
    return rectype({SYNONYM: synonym.meaning, HEADWORD: headword.meaning})


def single_kinds(content: RecordType) -> tuple[RecordType, ...]:
    """The contents about two kinds each that a content is joined of, in order.

    What a part leaves out is as in the part before it.

    >>> from kille.dialogue.meanings import join_claims, noun
    >>> forks = subsumption(noun("fork"), noun("cutlery"))
    >>> spoons = rectype({LOWER: noun("spoon").meaning})
    >>> [print(it["superkind"]["c"]) for it in single_kinds(join_claims(forks, spoons))]
    cutlery(.x, .look)
    cutlery(.x, .look)
    [None, None]
    """
    found: list[RecordType] = []
    for it in single_claims(content):
        found.append(set_to(found[-1], **dict(it.fields)) if found else it)
    return tuple(found)


def subsumptions_in(
    content: RecordType, signs: Sequence[Record]
) -> tuple[RecordType, ...]:
    """What a content about two nouns says of which kind is a kind of which.

    >>> from kille.dialogue.meanings import noun
    >>> signs = tin, can = noun("tin"), noun("can")
    >>> len(subsumptions_in(subsumption(tin, can), signs))
    1
    >>> len(subsumptions_in(synonymy(tin, can), signs))
    2
    """
    lower, upper = nouns_in(content, signs)
    if LOWER in content:
        return (subsumption(lower, upper),)
    return subsumption(lower, upper), subsumption(upper, lower)


@lru_cache(1024)
def axiom_of(content: RecordType) -> Axiom:
    """The axiom of a content that says that one kind is a kind of another.

    >>> from kille.dialogue.meanings import noun
    >>> print(axiom_of(subsumption(noun("mug"), noun("cup"))))
    mug(x, look) <: cup(x, look)
    """
    lower, upper = (_claim(content[label]) for label in (LOWER, UPPER))
    return Axiom(lower, upper)


def under_kinds(
    model: Model, kinds: Sequence[Record], *, types: DialogueTypes
) -> Model:
    """The model under the axioms of the theory and of these kinds."""
    axioms = (*types.theory.axioms, *(axiom_of(it.content) for it in kinds))
    if axioms == model.theory.axioms:
        return model
    return model.under(dataclasses.replace(model.theory, axioms=axioms))


def is_kind_of(s: Record, lower: Record, upper: Record) -> bool:
    """Whether a noun is a kind of another one, by what was taught: itself, too."""
    own = word_of(upper)
    return word_of(lower) is own or any(T.pred is own for T in _above(s, lower))


def has_kind(s: Record, noun: Record) -> bool:
    """Whether a noun is said to be a kind of another one, or another one of it."""
    word = word_of(noun)
    axioms = (axiom_of(it.content) for it in s.private.kinds)
    return any(word in (head(it.lower), head(it.upper)) for it in axioms)


def are_synonyms(s: Record, one: Record, other: Record) -> bool:
    """Whether each of two nouns is a kind of the other, so that they mean the same."""
    return is_kind_of(s, one, other) and is_kind_of(s, other, one)


def are_related(s: Record, one: Record, other: Record) -> bool:
    """Whether one of two nouns is a kind of the other, so that both may be true.

    So is a compound a kind of its head, if nothing else was said: "toy car" of "car".
    """
    if is_compound_of(one, other) or is_compound_of(other, one):
        return True
    return is_kind_of(s, one, other) or is_kind_of(s, other, one)


def is_compound_of(compound: Record, head: Record) -> bool:
    """Whether a noun is a compound whose head is another noun.

    >>> from kille.dialogue.meanings import noun
    >>> is_compound_of(noun("toy car"), noun("car"))
    True
    >>> is_compound_of(noun("pineapple"), noun("apple"))
    False
    """
    return bool(compound.form.endswith((f" {head.form}", f"-{head.form}")))


def rank_names(s: Record, beliefs: Beliefs) -> Beliefs:
    """The beliefs about what a thing is, without what the first one does not exclude.

    Of nouns that are as probable the most special one is first: a mug is called a mug,
    though it is a cup as well.
    """
    if not s.private.kinds or not beliefs:
        return beliefs
    best = beliefs[0].p
    first = next(
        it
        for it in beliefs
        if it.p == best
        and not any(
            other.p == best
            and other is not it
            and is_kind_of(s, other.sign, it.sign)
            and not is_kind_of(s, it.sign, other.sign)
            for other in beliefs
        )
    )
    rest = without_related(s, first.sign, beliefs)
    return [first, *(it for it in rest if it is not first)]


def without_related(s: Record, noun: Record, beliefs: Beliefs) -> Beliefs:
    """The beliefs in a noun and in its rivals.

    Left out are the nouns that it is a kind of, and those that are kinds of it.
    """
    if not s.private.kinds:
        return beliefs
    if not has_kind(s, noun):
        return beliefs
    own = word_of(noun)
    return [
        it
        for it in beliefs
        if word_of(it.sign) is own or not are_related(s, it.sign, noun)
    ]


def _above(s: Record, noun: Record) -> Iterator[PType]:
    axioms = tuple([axiom_of(it.content) for it in s.private.kinds])
    for _, upper in supertypes(_claim(noun.meaning), axioms):
        assert isinstance(upper, PType)
        yield upper


def _claim(meaning: object) -> PType:
    """What a noun claims of its thing."""
    assert isinstance(meaning, RecordType)
    claim = meaning["c"]
    assert isinstance(claim, PType)
    return claim


def nouns_in(content: RecordType, signs: Sequence[Record]) -> tuple[Record, Record]:
    """The two nouns of a content: of which kind which is one, or that mean the same."""
    labels = (LOWER, UPPER) if LOWER in content else (SYNONYM, HEADWORD)
    lower, upper = (
        next(it for it in signs if it.meaning == content[label]) for label in labels
    )
    return lower, upper
