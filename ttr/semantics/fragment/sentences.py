"""Sentences with their contents, to be judged in a model; what pronouns pick up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ttr.errors import TTRError
from ttr.judging.models import Model
from ttr.probability import CERTAIN
from ttr.semantics.fragment.composing_contents import Antecedent, compose_content
from ttr.semantics.fragment.content_types import conjuncts
from ttr.semantics.fragment.lexicon import Lexicon, lexicon_of
from ttr.semantics.fragment.sentence_parsing import parse_sentence
from ttr.semantics.quantifiers import (
    Quantification,
    Thresholds,
    Truth,
    antecedents,
    determiner_of,
    settle,
    truth,
)
from ttr.types.objects import FiniteSet, Object, Record
from ttr.types.syntax import PType, TypeNode


@dataclass(frozen=True)
class Sentence:
    """A sentence and its content: the type that is true if the sentence is.

    >>> print(understand("Fido does not like Kim.").content)
    absent(like(fido, kim))
    """

    text: str
    content: TypeNode

    def judge(self, M: Model, thresholds: Thresholds | None = None) -> Truth:
        """How certain the sentence is in a model, and why.

        Raises `UndefinedError` where it presupposes what is not so, as "most unicorns".
        """
        return truth(M, self.content, thresholds)


def understand(
    text: str, words: Lexicon | None = None, picked: Iterable[Antecedent] = ()
) -> Sentence:
    """The sentence that a text is.

    `picked` has the sets of things that its pronouns may stand for. Raises
    `OutsideFragmentError` for a word or a construction that is not known, and for a
    pronoun that has nothing to stand for.

    >>> understand("Every pupy barks.")
    Traceback (most recent call last):
    ttr...OutsideFragmentError: the lexicon has no word 'pupy'
    help: did you mean puppy?
    """
    chosen = lexicon_of(words)
    tree = parse_sentence(text, chosen)
    return Sentence(text, compose_content(tree, chosen, _check_antecedents(picked)))


def _check_antecedents(picked: object) -> tuple[Antecedent, ...]:
    """The sets that pronouns may stand for; `TTRError` for what is no set of things."""
    found = tuple(picked) if isinstance(picked, Iterable) else (picked,)
    for things in found:
        if not isinstance(things, FiniteSet | frozenset | set):
            raise TTRError(
                f"pronouns stand for sets of things, found {things!r}",
                hint="write picked=[{'fido'}], or use pronoun_antecedents(M, sentence)",
            )
    return tuple([FiniteSet(*things) for things in found])


def pronoun_antecedents(
    M: Model, sentence: Sentence, thresholds: Thresholds | None = None
) -> tuple[Antecedent, ...]:
    """What pronouns can stand for after a sentence, by its witnesses in a model.

    First the things that it is about, then those that its witnesses bring in: after
    "Every dog hugs a boy" the dogs, then the boys that are hugged. Nothing if the
    sentence is not certainly true.

    >>> from ttr import Ind
    >>> from ttr.semantics.fragment import english
    >>> dog = english().meaning("NOUN", "dog")
    >>> M = Model(english().theory).given("s1", dog("fido")).given("fido", Ind)
    >>> pronoun_antecedents(M, understand("There is a dog."))
    (FiniteSet('fido'),)
    """
    if sentence.judge(M, thresholds).p != CERTAIN:
        return ()
    found: list[Antecedent] = []
    for claim in conjuncts(sentence.content):
        if determiner_of(claim) is not None:
            found += _antecedents_of(settle(M, claim, thresholds))
        else:
            found += [FiniteSet(name) for name in _names_in(claim)]
    return tuple(dict.fromkeys(X for X in found if len(X) > 0))


def _antecedents_of(found: Quantification) -> Iterator[Antecedent]:
    sets = antecedents(found)
    yield sets.refset
    yield from _things_brought_in([it.situation for it in found.refset])
    yield from sets.accessible


def _things_brought_in(situations: list[Object]) -> Iterator[Antecedent]:
    """The things that the situations are about, one set for each level of scope."""
    inner = [
        it for it in situations if isinstance(it, Record) and set(it) == {"X", "f"}
    ]
    things = [x for it in inner for x in it._fields["X"]]
    if things:
        yield FiniteSet(*things)
        pairs = [pair for it in inner for pair in it._fields["f"]]
        yield from _things_brought_in([pair._fields["e"] for pair in pairs])


def _names_in(T: TypeNode) -> list[str]:
    """The names of things among the arguments of a ptype."""
    return [a for a in T.args if isinstance(a, str)] if isinstance(T, PType) else []
