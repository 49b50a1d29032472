"""What each statement of a theory file adds to the theory before it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from ttr.errors import suggestion
from ttr.notation import trees
from ttr.notation.questions import Asking
from ttr.notation.reader import LOGICAL, Reader
from ttr.notation.trees import Application, Arity, Name, Statement, Term, Word, inside
from ttr.paths import escaping
from ttr.printing import RESERVED
from ttr.syntax import Basic, Path, Pred, PType
from ttr.theories import Axiom, Given, Theory

__all__ = ["Declaring", "mentioned"]


@dataclass(frozen=True)
class Declaring:
    """Reads statements on top of the reader's theory.

    `settled` are the names that earlier statements rest on: a predicate among them has
    its final arities.
    """

    reader: Reader
    settled: frozenset[str]

    @property
    def theory(self) -> Theory:
        """The theory before the statement."""
        return self.reader.theory

    def declared(self, tree: Statement) -> Theory:
        """The theory after the statement; raises `NotationError` or `IllFormed`."""
        match tree:
            case trees.BasicNames(_, _, names):
                return self._basic(names)
            case trees.Predicates(_, _, arities):
                return self._predicates(arities)
            case trees.OpenNames(_, _, names):
                opened = frozenset(map(self._openable, names))
                return replace(self.theory, opened=self.theory.opened | opened)
            case trees.ObjectNames():
                return self._objects(tree)
            case trees.GivenFact():
                return self._given(tree)
            case trees.Definition():
                return self._definition(tree)
            case trees.AxiomClaim():
                return self._axiom(tree)
            case trees.Question():
                return self._question(tree)
        raise AssertionError(tree)

    def _basic(self, names: tuple[Word, ...]) -> Theory:
        for word in names:
            self._claim(word, "a basic type", self.theory.basics)
        found = {word.text: Basic(word.text) for word in names}
        return replace(self.theory, basics={**self.theory.basics, **found})

    def _predicates(self, arities: tuple[Arity, ...]) -> Theory:
        predicates = dict(self.theory.predicates)
        for one in arities:
            self._claim(one.name, "a predicate", predicates)
            arity = tuple(self.reader.type(T, ()) for T in one.types)
            name = one.name.text
            known = predicates[name].arities if name in predicates else ()
            if arity in known:
                continue
            if name in self.settled:
                self.reader.refuse(
                    one,
                    f"{name} gets another arity after it has been used",
                    f"declare all arities of {name} before its first use",
                )
            predicates[name] = Pred(name, *known, arity)
        return replace(self.theory, predicates=predicates)

    def _openable(self, word: Word) -> Basic | Pred:
        for declared in (self.theory.basics, self.theory.predicates):
            if word.text in declared:
                return declared[word.text]
        known = [*self.theory.basics, *self.theory.predicates]
        self.reader.refuse(
            word,
            f"there is no basic type or predicate {word.text} to be open",
            suggestion(word.text, known),
        )

    def _objects(self, tree: trees.ObjectNames) -> Theory:
        kind = self.reader.type(tree.type, ())
        for word in tree.names:
            self._claim(word, "an object", self.theory.objects)
        span = self.reader.source.span(tree)
        found = tuple(Given(word.text, kind, span=span) for word in tree.names)
        return replace(
            self.theory,
            objects=self.theory.objects | {word.text for word in tree.names},
            givens=self.theory.givens + found,
        )

    def _given(self, tree: trees.GivenFact) -> Theory:
        kind = self.reader.type(tree.type, ())
        theory = self.theory
        match tree.sit:
            case Name(start, end, (name,), None) if not _is_declared(theory, name):
                self._claim(Word(start, end, name), "an object", ())
                theory = replace(theory, objects=theory.objects | {name})
        sit = replace(self.reader, theory=theory).object(tree.sit, ())
        p = self.reader.degree(tree.degree) if tree.degree else (1.0, 1.0)
        given = Given(sit, kind, p, self.reader.source.span(tree))
        return replace(theory, givens=(*theory.givens, given))

    def _definition(self, tree: trees.Definition) -> Theory:
        self._claim(tree.name, "defined", ())
        value = self.reader.object(tree.value, ())
        definitions = {**self.theory.definitions, tree.name.text: value}
        return replace(self.theory, definitions=definitions)

    def _axiom(self, tree: trees.AxiomClaim) -> Theory:
        lower, upper = self._schema(tree.lower), self._schema(tree.upper)
        for path in sorted(escaping(upper) - escaping(lower), key=str):
            self.reader.refuse(
                tree.upper,
                f"the variable {path.labels[0]} stands on the right only",
                f"quote it to name the object: '{path.labels[0]}'",
            )
        axioms = (*self.theory.axioms, Axiom(lower, upper))
        return replace(self.theory, axioms=tuple(dict.fromkeys(axioms)))

    def _schema(self, term: Term) -> Basic | PType:
        """A side of an axiom: the bare names in it that are no types are variables."""
        terms = term.args if isinstance(term, Application) else (term,)
        found_in = (part for one in terms for part in inside(one))
        names = {part for part in found_in if isinstance(part, Name)}
        for name in names:
            if name.up is not None or len(name.labels) > 1:
                self.reader.refuse(
                    name, "in an axiom only names stand for objects, not paths"
                )
        variables = {name.labels[0] for name in names} - self._types()
        found = self.reader.type(term, (frozenset(variables),))
        args = found.args if isinstance(found, PType) else ()
        nested = any(not isinstance(arg, Path) and escaping(arg) for arg in args)
        if nested or not isinstance(found, Basic | PType):
            self.reader.refuse(
                term,
                "an axiom relates basic types and predicates applied to names, "
                f"found {self.reader.written(term)}",
            )
        return found

    def _types(self) -> set[str]:
        theory = self.theory
        return {*LOGICAL, *theory.basics, *theory.predicates, *theory.definitions}

    def _question(self, tree: trees.Question) -> Theory:
        check = Asking(self.reader).check(tree)
        return replace(self.theory, checks=(*self.theory.checks, check))

    def _claim(self, word: Word, kind: str, mine: Collection[str]) -> None:
        """Refuses a name that means something else already."""
        if word.text in RESERVED:
            self.reader.refuse(word, f"{word.text} is a word of the notation itself")
        if word.text not in mine and _is_declared(self.theory, word.text):
            self.reader.refuse(word, f"{word.text} is already {self._kind(word.text)}")

    def _kind(self, name: str) -> str:
        kinds = {
            "defined": self.theory.definitions,
            "a basic type": self.theory.basics,
            "a predicate": self.theory.predicates,
        }
        return next((k for k, names in kinds.items() if name in names), "an object")


def _is_declared(theory: Theory, name: str) -> bool:
    """Whether a name is among those of a theory, without listing them all."""
    kinds = (theory.objects, theory.definitions, theory.basics, theory.predicates)
    return any(name in kind for kind in kinds)


def mentioned(tree: Statement) -> frozenset[str]:
    """The names that a statement rests on, not those it declares."""
    match tree:
        case trees.OpenNames(_, _, words):
            return frozenset(word.text for word in words)
        case trees.Predicates(_, _, arities):
            parts = [part for one in arities for T in one.types for part in inside(T)]
        case _:
            parts = list(inside(tree))
    return frozenset(part.labels[0] for part in parts if isinstance(part, Name))
