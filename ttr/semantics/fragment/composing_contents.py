"""From the tree of a sentence to its content: a type that is true iff the sentence is.

A clause means a type, a verb phrase and a noun a property, a noun phrase a function
from properties to types. What stands further left has wider scope.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from ttr.building.constructors import rectype
from ttr.semantics.fragment.content_types import (
    Property,
    Variables,
    all_of,
    equality,
)
from ttr.semantics.fragment.determiner_meanings import apply_determiner
from ttr.semantics.fragment.lexicon import Lexicon
from ttr.semantics.fragment.sentence_parsing import OutsideFragmentError, Phrase
from ttr.semantics.parametric_content import content, strong, weak
from ttr.semantics.quantifiers import Determiner, absent, every, exist
from ttr.types.objects import BOUND, FiniteSet
from ttr.types.substitution import replace_name
from ttr.types.syntax import Function, Ind, PType, Singleton, TypeNode, as_type, join

_NounPhrase: TypeAlias = Callable[[Property], TypeNode]
"""The meaning of a noun phrase: a function from properties to types."""

Antecedent: TypeAlias = FiniteSet
"""A set of things that a pronoun can stand for."""

_MODIFIERS = 8
"""The most modifiers of the kinds below that a sentence may have."""

_REPEATING = (
    *("INTENSIFIER", "MODADJ", "NEGADJ", "ADVERB", "vp_pp"),
    *("the", "both", "neither"),
)
"""Kinds whose content repeats what they modify, so that it doubles with each."""


def compose_content(
    tree: Phrase, words: Lexicon, picked: tuple[Antecedent, ...] = ()
) -> TypeNode:
    """The content of a sentence.

    A pronoun stands for the first of `picked` that agrees with it in number. Raises
    `OutsideFragmentError` for a construction that is read but has no meaning here.
    """
    if sum(1 for kind in _REPEATING for _ in tree.below(kind)) > _MODIFIERS:
        raise OutsideFragmentError(
            f"a sentence has at most {_MODIFIERS} adverbs, words like very, "
            "prepositions after a verb, adjectives that need a noun, the, both and "
            "neither, counted together"
        )
    return _Composer(words, picked).clause(_only_part(tree))


class _Composer:
    def __init__(self, words: Lexicon, picked: tuple[Antecedent, ...]) -> None:
        self._words, self._picked = words, picked
        self._variables = Variables()
        self._bound: list[str] = []

    # --- clauses -------------------------------------------------------------------

    def clause(self, tree: Phrase) -> TypeNode:
        match tree.kind, tree.parts:
            case "clause", [inner]:
                return self.clause(inner)
            case "denied", [inner]:
                return absent(self.clause(inner))
            case "both_clauses", [left, right]:
                return all_of(self.clause(left), self.clause(right))
            case "existence", [np]:
                return self._existence(np)
            case "predication", [np, vp]:
                return self._predication(np, vp)
        raise _without_meaning(tree)

    def _existence(self, np: Phrase) -> TypeNode:
        """There is or are NP: the noun restricts, and what follows it is the scope."""
        if np.kind not in ("quantified", "bare"):
            raise OutsideFragmentError(
                "there is takes a noun phrase such as a dog, or no dogs"
            )
        nbar = np.parts[-1]
        head, rest = self._head_and_rest(nbar)
        if np.kind == "bare":
            return exist(self._bind(head), self._bind(rest))
        det = np.parts[0].kind
        if det in ("every", "most", "both", "neither", "the", "not_every"):
            raise OutsideFragmentError(f"there is takes no noun phrase with {det}")
        if det in ("many", "few") and len(nbar.parts) == 1:
            raise OutsideFragmentError(
                f"there are {det} needs to say of which share, as in there are {det} "
                "dogs in Rome"
            )
        return self._by_determiner(np.parts[0], head, rest)

    def _head_and_rest(self, nbar: Phrase) -> tuple[Property, Property]:
        """The property of the noun, and of what follows it (or the noun once more)."""
        modified, *rest = nbar.parts
        head = self._noun_with_adjectives(modified)
        if not rest:
            return head, head
        return head, _conjunction(*[self._postnominal(part) for part in rest])

    def _predication(self, np: Phrase, vp: Phrase) -> TypeNode:
        donkey = self._donkey_sentence(np, vp)
        if donkey is not None:
            return donkey
        if np.kind == "bare":
            return self._by_quantifier(every, self._nbar(np.parts[0]), self._vp(vp))
        return self._np(np)(self._vp(vp))

    # --- donkey sentences ----------------------------------------------------------

    def _donkey_sentence(self, np: Phrase, vp: Phrase) -> TypeNode | None:
        """The content of: every farmer who owns a donkey beats it. None for others.

        It is strong (all of the donkeys) after every, else weak (some donkey); see
        decision 021.
        """
        found = _verb_and_indefinite(np)
        if found is None or not _has_object_pronoun(vp):
            return None
        verb, indefinite = found
        owning, restriction = self._tv(verb), self._nbar(indefinite.parts[-1])
        purified = strong if np.parts[0].kind == "every" else weak

        def beating(x: str) -> TypeNode:
            y = self._variables.fresh()
            fields = {"c": restriction(y), "o": owning(x, y)}
            bg = rectype(
                y=Ind,
                **{k: as_type(replace_name(T, y, "y")) for k, T in fields.items()},
            )
            self._bound.append(y)
            said = self._vp(vp)(x)
            self._bound.pop()
            fg = Function(bg, replace_name(said, y, BOUND, "y"))
            return purified(content(bg, fg))

        return self._np(np)(beating)

    # --- noun phrases --------------------------------------------------------------

    def _np(self, tree: Phrase) -> _NounPhrase:
        match tree.kind, tree.parts:
            case "name", [token]:
                name = str(self._words.word("NAME", token.word).meaning)
                return lambda said: said(name)
            case "pronoun", [token]:
                return self._pronoun(token.word)
            case "bare", [nbar]:
                some = self._nbar(nbar)
                return lambda said: self._by_quantifier(exist, some, said)
            case "quantified", [det, nbar]:
                restriction = self._nbar(nbar)
                return lambda said: self._by_determiner(det, restriction, said)
        raise _without_meaning(tree)

    def _pronoun(self, form: str) -> _NounPhrase:
        if self._bound and form.lower() == "it":
            bound = self._bound[-1]
            return lambda said: said(bound)
        plural = form.lower() in ("they", "them")
        for things in self._picked:
            if plural == (len(things) > 1):
                return lambda said: self._of_each(things, said)
        raise OutsideFragmentError(
            f"{form!r} has nothing to stand for: no sentence before it is about "
            f"{'several things' if plural else 'one thing'}"
        )

    def _of_each(self, things: Antecedent, said: Property) -> TypeNode:
        """The type: it is said of each of these things."""
        if len(things) == 1:
            return said(str(next(iter(things))))
        one_of = join(*[Singleton(Ind, thing) for thing in things])
        return every(one_of, self._bind(said))

    def _by_determiner(self, det: Phrase, P: Property, Q: Property) -> TypeNode:
        return apply_determiner(det, self._bind(P), self._bind(Q))

    def _by_quantifier(self, q: Determiner, P: Property, Q: Property) -> PType:
        return q(self._bind(P), self._bind(Q))

    def _bind(self, said: Property) -> Function:
        return self._variables.bind(said)

    # --- nouns and what goes with them ---------------------------------------------

    def _nbar(self, tree: Phrase) -> Property:
        modified, *rest = tree.parts
        return _conjunction(
            self._noun_with_adjectives(modified),
            *[self._postnominal(part) for part in rest],
        )

    def _noun_with_adjectives(self, tree: Phrase) -> Property:
        match tree.kind, tree.parts:
            case "noun", [token]:
                return self._unary("NOUN", token)
            case "with_adj", [adj, inner]:
                return self._adjective(adj, self._noun_with_adjectives(inner))
        raise _without_meaning(tree)

    def _adjective(self, adj: Phrase, noun: Property) -> Property:
        """The property of a noun with an adjective."""
        *intensifiers, token = adj.parts
        match adj.kind:
            case "intersective":
                said = _conjunction(self._unary("ADJ", token), noun)
            case "subsective" if token.kind == "ADJ":
                said = _conjunction(self._unary("ADJ", token), noun)
            case "subsective":
                said = self._modification("MODADJ", token, noun)
            case "privative":
                fake = self._words.meaning("NEGADJ", token.word)
                return lambda x: all_of(absent(noun(x)), fake(x, self._bind(noun)))
            case _:
                raise _without_meaning(adj)
        for intensifier in reversed(intensifiers):
            said = self._modification("INTENSIFIER", intensifier, said)
        return said

    def _postnominal(self, tree: Phrase) -> Property:
        match tree.kind, tree.parts:
            case "pp", [token, np]:
                pred, of = self._words.meaning("PREP", token.word), self._np(np)
                return lambda x: of(lambda y: pred(x, y))
            case "subject_relative", [vp]:
                return self._vp(vp)
            case "object_relative", [np, verb]:
                doing, who = self._tv(verb), self._np(np)
                return lambda y: who(lambda x: doing(x, y))
        raise _without_meaning(tree)

    # --- verb phrases --------------------------------------------------------------

    def _vp(self, tree: Phrase) -> Property:
        match tree.kind, tree.parts:
            case "plain_vp", [inner]:
                return self._vp(inner)
            case "denied_vp", [inner]:
                return _negation(self._vp(inner))
            case "both_vps", [left, right]:
                return _conjunction(self._vp(left), self._vp(right))
            case "modal_vp", [token, inner]:
                return self._operator("MODAL", token, self._vp(inner))
            case "denied_modal_vp", [token, inner]:
                return _negation(self._operator("MODAL", token, self._vp(inner)))
            case "attitude_vp", [token, inner]:
                return self._operator("ATTITUDE", token, self._vp(inner))
            case "intransitive", [token, *modifiers]:
                return self._with_modifiers(self._unary("IV", token), modifiers)
            case "transitive", [token, np, *adverbs]:
                doing, what = self._tv(token), self._np(np)
                plain: Property = lambda x: what(lambda y: doing(x, y))  # noqa: E731
                return self._with_modifiers(plain, adverbs)
            case "is_adj", [adj, *pps]:
                return _conjunction(
                    self._predicate_adjective(adj),
                    *[self._postnominal(pp) for pp in pps],
                )
            case "is_pp", [pp]:
                return self._postnominal(pp)
            case "is_np", [np]:
                return self._predicate_nominal(np)
        raise _without_meaning(tree)

    def _predicate_adjective(self, adj: Phrase) -> Property:
        """The property of an adjective on its own, as if its noun were "thing"."""
        if adj.kind == "privative":
            raise OutsideFragmentError(f"{adj.parts[-1].word} needs a noun after it")
        if adj.parts[-1].kind == "ADJ" and len(adj.parts) == 1:
            return self._unary("ADJ", adj.parts[0])
        return self._adjective(adj, _universal_property)

    def _predicate_nominal(self, np: Phrase) -> Property:
        """The property of being a dog, being dogs, or being Fido."""
        match np.kind, np.parts:
            case "bare", [nbar]:
                return self._nbar(nbar)
            case "quantified", [det, nbar] if det.kind in ("exist", "the"):
                return self._nbar(nbar)
            case "name", [token]:
                name = str(self._words.word("NAME", token.word).meaning)
                return lambda x: equality(x, name)
        raise OutsideFragmentError(
            "after is stands an adjective, a noun with a, or a name"
        )

    def _with_modifiers(self, said: Property, modifiers: Sequence[Phrase]) -> Property:
        """The property of a verb phrase with its modifiers, the innermost first."""
        for modifier in modifiers:
            said = self._modified_vp(said, modifier)
        return said

    def _modified_vp(self, said: Property, modifier: Phrase) -> Property:
        if modifier.kind == "ADVERB":
            return self._modification("ADVERB", modifier, said)
        if modifier.kind == "adverb":
            return self._modification("ADVERB", modifier.parts[0], said)
        token, np = modifier.parts[0].parts
        pred, of = self._words.meaning("PREP", token.word), self._np(np)
        return lambda x: all_of(said(x), of(lambda y: pred(x, y, self._bind(said))))

    def _modification(self, terminal: str, token: Phrase, said: Property) -> Property:
        """Being P, and P in a certain way: a skilful vet is a vet."""
        way = self._operator(terminal, token, said)
        return way if said is _universal_property else _conjunction(said, way)

    def _operator(self, terminal: str, token: Phrase, said: Property) -> Property:
        pred = self._words.meaning(terminal, token.word)
        return lambda x: pred(x, self._bind(said))

    def _unary(self, terminal: str, token: Phrase) -> Property:
        return self._words.meaning(terminal, token.word)

    def _tv(self, token: Phrase) -> Callable[[str, str], PType]:
        return self._words.meaning("TV", token.word)


def _conjunction(*said: Property) -> Property:
    if len(said) == 1:
        return said[0]
    return lambda x: all_of(*[one(x) for one in said])


def _negation(said: Property) -> Property:
    return lambda x: absent(said(x))


def _universal_property(x: str) -> TypeNode:
    """The property of everything."""
    return Singleton(Ind, x)


def _only_part(tree: Phrase) -> Phrase:
    (inner,) = tree.parts
    return inner


def _verb_and_indefinite(np: Phrase) -> tuple[Phrase, Phrase] | None:
    """The verb and the indefinite in: every farmer who *owns a donkey*."""
    if np.kind != "quantified":
        return None
    for part in np.parts[-1].parts[1:]:
        if part.kind != "subject_relative":
            continue
        for verb in part.below("transitive"):
            token, thing, *_ = verb.parts
            if thing.kind == "quantified" and thing.parts[0].kind == "exist":
                return token, thing
    return None


def _has_object_pronoun(vp: Phrase) -> bool:
    pronouns = [it.parts[0].word.lower() for it in vp.below("pronoun")]
    return "it" in pronouns


def _without_meaning(tree: Phrase) -> OutsideFragmentError:
    return OutsideFragmentError(f"the fragment gives no meaning to {tree.kind}")
