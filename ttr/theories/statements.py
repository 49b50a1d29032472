"""Reads the statements of a theory, each of which adds to those before it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from ttr.building.conditions import IsBelow
from ttr.computing.normalisation import check_computable
from ttr.errors import IllFormedError, suggestion
from ttr.judging.truth_of_types import IsTrue
from ttr.notation import syntax_trees as trees
from ttr.notation.names import is_declared
from ttr.notation.reader import Reader
from ttr.notation.syntax_trees import (
    Application,
    Arity,
    Name,
    Source,
    Statement,
    Term,
    Word,
    inside,
)
from ttr.signature.signature import (
    Axiom,
    Condition,
    Exclusion,
    Expected,
    Given,
)
from ttr.theories.game_statements import read_game
from ttr.theories.rule_statements import read_rule
from ttr.theories.strategy_statements import kinds_gathered, read_strategy
from ttr.theories.theory_draft import Draft
from ttr.types.interning import Node
from ttr.types.objects import Object, Path
from ttr.types.paths import free_paths
from ttr.types.printing import Written, notation, spelling_of
from ttr.types.reserved_words import LOGICAL, RESERVED
from ttr.types.syntax import Basic, Function, Pred, PType, TypeNode


@dataclass(frozen=True)
class StatementReader:
    """Reads the statements of one text into a draft.

    `later` has the line of each declaration that is still to come.
    """

    draft: Draft
    source: Source
    later: Mapping[str, int] = field(default_factory=dict)

    @cached_property
    def reader(self) -> Reader:
        """Reads terms with the names that have been declared so far."""
        return Reader(self.draft, self.source, self.later)

    def declare(self, tree: Statement) -> None:
        """Add what a statement declares; raises `NotationError` or `IllFormedError`.

        A statement with a mistake adds nothing.
        """
        match tree:
            case trees.BasicNames(_, _, names):
                self._basic(names)
            case trees.Predicates(_, _, arities):
                self._predicates(arities)
            case trees.OpenNames(_, _, names):
                self.draft.opened.update(
                    [self._basic_or_predicate(word) for word in names]
                )
            case trees.ObjectNames():
                self._objects(tree)
            case trees.GivenFact():
                self._read_given(tree)
            case trees.GivenChance():
                self._given_chance(tree)
            case trees.Definition():
                self._definition(tree)
            case trees.RuleStatement():
                self._rule(tree)
            case trees.StrategyStatement():
                self._strategy(tree)
            case trees.GameStatement():
                self._game(tree)
            case trees.AxiomClaim(_, _, lower, upper):
                self._axiom(tree, lower, upper)
            case trees.ConditionalAxiomClaim(_, _, lower, upper, when):
                self._axiom(tree, lower, upper, when=when)
            case trees.RestrictiveAxiomClaim(_, _, lower, upper, only):
                self._axiom(tree, lower, upper, only=only)
            case trees.Question():
                from ttr.theories.check_statements import CheckReader

                self.draft.checks.append(CheckReader(self.reader).check(tree))
            case _:
                raise AssertionError(tree)
        self.draft.used |= names_mentioned(tree)

    def _basic(self, names: tuple[Word, ...]) -> None:
        for word in names:
            self._check_free(word, "a basic type", self.draft.basics)
        self.draft.basics.update({word.text: Basic(word.text) for word in names})

    def _predicates(self, arities: tuple[Arity, ...]) -> None:
        found: dict[str, Pred] = {}
        for one in arities:
            self._check_free(one.name, "a predicate", self.draft.predicates)
            arity = tuple(self.reader.type(T, ()) for T in one.types)
            name = one.name.text
            pred = found.get(name, self.draft.predicates.get(name))
            known = pred.arities if pred is not None else ()
            if arity in known:
                continue
            if name in self.draft.used:
                self.reader.refuse(
                    one,
                    f"{name} gets another arity after it has been used",
                    f"declare all arities of {name} before its first use",
                )
            found[name] = Pred(name, *known, arity)
        self.draft.predicates.update(found)

    def _basic_or_predicate(self, word: Word) -> Basic | Pred:
        for declared in (self.draft.basics, self.draft.predicates):
            if word.text in declared:
                return declared[word.text]
        known = [*self.draft.basics, *self.draft.predicates]
        self.reader.refuse(
            word,
            f"there is no basic type or predicate {word.text}",
            suggestion(word.text, known),
        )

    def _objects(self, tree: trees.ObjectNames) -> None:
        kind = self.reader.type(tree.type, ())
        for word in tree.names:
            self._check_free(word, "an object", self.draft.objects)
        span = self.source.span(tree)
        self.draft.objects.update([word.text for word in tree.names])
        self.draft.declared.update({word.text: kind for word in tree.names})
        self.draft.givens += [Given(word.text, kind, span=span) for word in tree.names]

    def _read_given(self, tree: trees.GivenFact) -> None:
        kind = self.reader.type(tree.type, ())
        declares: tuple[str, ...] = ()
        sit: Object
        match tree.sit:
            case Name(start, end, (name,), None) if not is_declared(self.draft, name):
                self._check_free(Word(start, end, name), "an object", ())
                declares, sit = (name,), name
            case term:
                sit = self.reader.object(term, ())
        p = self.reader.degree(tree.degree) if tree.degree else (1.0, 1.0)
        self.draft.objects.update(declares)
        self.draft.givens.append(Given(sit, kind, p, self.source.span(tree)))

    def _given_chance(self, tree: trees.GivenChance) -> None:
        """P(a : T | b : S), of these objects, or P(T || S), of any object."""
        span, read = self.source.span(tree), self.reader
        match tree.chance:
            case trees.Probability(_, _, Name(_, _, ("P",)), sit, T, _, when):
                on = [(read.object(one, ()), read.type(S, ())) for one, S in when]
                _, p = read.claimed_probability(tree.chance)
                subject = read.object(sit, ())
                given = Given(subject, read.type(T, ()), p, span, tuple(on))
                self.draft.givens.append(given)
            case trees.Expectation(_, _, Name(_, _, ("P",)), T, types):
                of = tuple([read.type(S, ()) for S in types])
                _, p = read.claimed_probability(tree.chance)
                self.draft.givens.append(Expected(read.type(T, ()), of, p, span))
            case other:
                found = read.text_of(other.head)
                read.refuse(
                    other.head, f"a probability is written P(…), found {found}(…)"
                )

    def _definition(self, tree: trees.Definition) -> None:
        self._check_free(tree.name, "defined", ())
        reader = replace(self.reader, written={})
        value = reader.object(tree.value, ())
        try:
            check_computable(value, self.draft.signature)
        except IllFormedError:
            error = self._error_as_written(value, reader.written)
            hint = error.hint or self._hint_to_definition(tree.value)
            message = self._with_names(error.message, tree.value)
            span = self.source.span(tree.value)
            raise IllFormedError(message, hint=hint, span=span) from None
        self.draft.definitions[tree.name.text] = value
        self.draft.written[tree.name.text] = reader.written
        self.draft.defined_at[tree.name.text] = self.source.span(tree.value)

    def _hint_to_definition(self, term: Term) -> str:
        """A hint where a predicate stands, and a definition differs in case alone."""
        defined = {name.lower(): name for name in self.draft.definitions}
        for part in trees.inside(term):
            if isinstance(part, Name) and part.labels[0] in self.draft.predicates:
                meant = defined.get(part.labels[0].lower())
                if meant is not None:
                    return f"did you mean {meant}?"
        return ""

    def _with_names(self, message: str, term: Term) -> str:
        """A message with the names of functions of a term that are spelt out in it."""
        names = [it.labels[0] for it in trees.inside(term) if isinstance(it, Name)]
        spelling = spelling_of(self.draft.written.values())
        functions = {
            notation(self.draft.definitions[name], spelling): name
            for name in names
            if isinstance(self.draft.definitions.get(name), Function)
        }
        for text in sorted(functions, key=len, reverse=True):
            message = message.replace(text, functions[text])
        return message

    def _error_as_written(
        self, value: Object, written: dict[Node, Written]
    ) -> IllFormedError:
        """What is wrong with a value, in the order and with the names of the text."""
        spelling = spelling_of([written, *self.draft.written.values()])
        try:
            check_computable(value, replace(self.draft.signature, spelling=spelling))
        except IllFormedError as error:
            return error
        raise AssertionError(value)

    def _rule(self, tree: trees.RuleStatement) -> None:
        self._check_free(tree.name, "a rule", ())
        self._check_gathered(tree)
        self.draft.rules[tree.name.text] = read_rule(tree, self.reader)

    def _check_gathered(self, tree: trees.RuleStatement) -> None:
        """Refuse a rule of a kind whose rules have been gathered before."""
        if tree.kind is None:
            return
        kind = tree.kind.text
        if kind in self.draft.gathered:
            self.reader.refuse(
                tree.kind,
                f"{self.draft.gathered[kind]} has been made of the rules of {kind} "
                "before",
                "move the rule up",
            )

    def _strategy(self, tree: trees.StrategyStatement) -> None:
        self._check_free(tree.name, "a strategy", ())
        self.draft.strategies[tree.name.text] = read_strategy(tree.value, self.reader)
        self._gather(tree.name, tree.value)

    def _game(self, tree: trees.GameStatement) -> None:
        self._check_free(tree.name, "a game", ())
        self.draft.openings[tree.name.text] = read_game(tree, self.reader)
        self._gather(tree.name, tree.value)

    def _gather(self, name: Word, value: Term) -> None:
        """Remember which kinds of rules have been gathered, and where."""
        for kind in sorted(kinds_gathered(value)):
            self.draft.gathered.setdefault(kind, name.text)

    def _axiom(
        self,
        tree: Statement,
        left: Term,
        right: Term,
        when: tuple[trees.Query, ...] = (),
        only: tuple[trees.Query, ...] = (),
    ) -> None:
        lower = self._schema(left)
        if isinstance(right, trees.Denial):
            excluded = self._schema(right.body)
            if when or only:
                first, *_ = (*when, *only)
                self.reader.refuse(first, "an exclusion has no conditions")
            self.draft.exclusions[Exclusion(lower, excluded)] = None
            return
        upper = self._schema(right)
        conditions = tuple([self._condition(one) for one in when])
        bound = {one.upper for one in conditions if isinstance(one, IsBelow)}
        for path in sorted(free_paths(upper) - free_paths(lower) - bound, key=str):
            self.reader.refuse(
                right,
                f"the variable {path.labels[0]} stands on the right only",
                f"quote it to name the object: '{path.labels[0]}'",
            )
        axiom = Axiom(lower, upper, conditions, tuple(map(self._condition, only)))
        sides = free_paths(lower) | free_paths(upper)
        for path in sorted(axiom.variables - sides, key=str):
            self.reader.refuse(
                tree, f"the variable {path.labels[0]} stands in a condition only"
            )
        self.draft.axioms[axiom] = None

    def _condition(self, tree: trees.Query) -> Condition:
        """A condition of an axiom: S <= T, perhaps up to relabelling, or true(T)."""
        match tree:
            case trees.Comparison(_, _, "<=", lower, upper):
                return IsBelow(self._content(lower), self._content(upper))
            case trees.Comparison(_, _, "<= up to relabelling", lower, upper):
                return IsBelow(self._content(lower), self._content(upper), True)
            case trees.Claim(_, _, Application(_, _, Name(_, _, ("true",)), (T,))):
                return IsTrue(self._content(T))
        self.reader.refuse(
            tree,
            "this is no condition of an axiom",
            "write S <= T, S <= T up to relabelling or true(T)",
        )

    def _content(self, term: Term) -> Path | TypeNode:
        """A side of a condition: a variable, or a type."""
        match term:
            case Name(_, _, (name,), None) if not self._is_type(name):
                return Path(0, (name,))
        return self.reader.type(term, ())

    def _schema(self, term: Term) -> Basic | PType:
        """A side of an axiom, in which the names that are no types are variables."""
        terms = term.args if isinstance(term, Application) else (term,)
        found_in = (part for one in terms for part in inside(one))
        names = {part for part in found_in if isinstance(part, Name)}
        for name in names:
            if name.up is not None or len(name.labels) > 1:
                self.reader.refuse(
                    name, "in an axiom only names stand for objects, not paths"
                )
        heads = {name.labels[0] for name in names}
        variables = frozenset(name for name in heads if not self._is_type(name))
        found = self.reader.type(term, (variables,))
        args = found.args if isinstance(found, PType) else ()
        nested = any(not isinstance(arg, Path) and free_paths(arg) for arg in args)
        if nested or not isinstance(found, Basic | PType):
            self.reader.refuse(
                term,
                "an axiom relates basic types and predicates applied to names, "
                f"found {self.reader.text_of(term)}",
            )
        return found

    def _is_type(self, name: str) -> bool:
        draft = self.draft
        kinds = (LOGICAL, draft.basics, draft.predicates, draft.definitions)
        return any(name in kind for kind in kinds)

    def _check_free(self, word: Word, kind: str, mine: Collection[str]) -> None:
        """Refuse a name that is declared as something else, or that is reserved."""
        if word.text in RESERVED:
            self.reader.refuse(word, f"{word.text} is a reserved word")
        if word.text not in mine and is_declared(self.draft, word.text):
            self.reader.refuse(
                word, f"{word.text} is already {self._kind_of_name(word.text)}"
            )

    def _kind_of_name(self, name: str) -> str:
        kinds = {
            "defined": self.draft.definitions,
            "a basic type": self.draft.basics,
            "a predicate": self.draft.predicates,
            "a rule": self.draft.rules,
            "a strategy": self.draft.strategies,
            "a game": self.draft.openings,
        }
        return next((k for k, names in kinds.items() if name in names), "an object")


def names_mentioned(tree: Statement) -> frozenset[str]:
    """The names that a statement mentions, but not those it declares."""
    match tree:
        case trees.OpenNames(_, _, words):
            return frozenset(word.text for word in words)
        case trees.Predicates(_, _, arities):
            parts = [part for one in arities for T in one.types for part in inside(T)]
        case _:
            parts = list(inside(tree))
    return frozenset(part.labels[0] for part in parts if isinstance(part, Name))
