"""Reads `check` statements: what is asked, as a query."""

from __future__ import annotations

from dataclasses import dataclass

from ttr.errors import IllFormedError, TTRError
from ttr.notation import syntax_trees as trees
from ttr.notation.names import is_declared
from ttr.notation.reader import Reader
from ttr.notation.syntax_trees import Application, Name, Term
from ttr.theories.queries import (
    Check,
    Creates,
    Expects,
    HasDegree,
    IsBelow,
    IsBelowRelabelled,
    IsOf,
    IsSame,
    IsTrue,
    IsWellFormed,
    Merges,
    Query,
    Updates,
)
from ttr.types.objects import Object, UnresolvedError
from ttr.types.syntax import TypeNode
from ttr.updates.rules import Rule

_MERGES = ("merge", "amerge")


@dataclass(frozen=True)
class CheckReader:
    """Reads the questions of `check` statements."""

    reader: Reader

    def check(self, tree: trees.Question) -> Check:
        """The check that a statement makes; raises `NotationError` if it makes none."""
        source = self.reader.source
        text = " ".join(source.text[tree.start : tree.end].split())
        return Check(
            tree.expected, self._query_or_error(tree.query), source.span(tree), text
        )

    def _query_or_error(self, tree: trees.Query) -> Query | TTRError:
        """The query, or the error if a type is ill-formed: a check may ask for one."""
        try:
            return self._read_query(tree)
        except (IllFormedError, UnresolvedError) as error:
            return error

    def _read_query(self, tree: trees.Query) -> Query:
        read, kind = self._object, self._type
        match tree:
            case trees.Judged(_, _, sit, T):
                return IsOf(read(sit), kind(T))
            case trees.Comparison(_, _, "<=", left, right):
                return IsBelow(kind(left), kind(right))
            case trees.Comparison(_, _, "<= up to relabelling", left, right):
                return IsBelowRelabelled(kind(left), kind(right))
            case trees.Comparison(_, _, _, left, right):
                return self._equation(left, right)
            case trees.Probability(_, _, Name(_, _, ("P",)), sit, T, _, when):
                on = tuple([(read(one), kind(S)) for one, S in when])
                relation, interval = self.reader.claimed_probability(tree)
                return HasDegree(read(sit), kind(T), relation, interval, on)
            case trees.Expectation(_, _, Name(_, _, ("P",)), T, types):
                of = tuple(map(kind, types))
                return Expects(kind(T), of, *self.reader.claimed_probability(tree))
            case trees.Claim(_, _, Application(_, _, Name(_, _, ("create",)), (T,))):
                return Creates(kind(T))
            case trees.Claim(
                _, _, Application(_, _, Name(_, _, ("wellformed",)), (T,))
            ):
                return IsWellFormed(self._type_or_error(T))
        self.reader.refuse(
            tree,
            "this cannot be checked",
            "ask a : T, S <= T, S <= T up to relabelling, S = T, f(a) = b, "
            "merge(S, T) = U, amerge(S, T) = U, "
            "create(T), wellformed(T), P(a : T) = p, P(a : T) in [lo, hi], "
            "P(a : T | b : S) = p, P(T || S) = p or P(T) = p",
        )

    def _equation(self, left: Term, right: Term) -> Query:
        match left:
            case Application(_, _, Name(_, _, (operation,)), (S, T)) if (
                operation in _MERGES
            ):
                result = self._type(right)
                return Merges(operation, self._type(S), self._type(T), result)
            case Application(_, _, Name(_, _, ("P",)), (T,)) if not is_declared(
                self.reader.theory, "P"
            ):
                degree = trees.Degree(right.start, right.end, "=", right)
                return IsTrue(self._type(T), self.reader.degree(degree))
            case Application(_, _, Name(_, _, (name,), None)) if (
                name in self.reader.theory.rules
            ):
                return Updates(*self.step(left, name), self._object(right))
        return IsSame(self._object(left), self._object(right))

    def step(self, term: Application, name: str) -> tuple[Rule, tuple[Object, ...]]:
        """The rule in r(s, e), with its state and its event."""
        rule = self.reader.theory.rules[name]
        if len(term.args) != len(rule.names):
            wanted = "the state and the event" if rule.on else "the state alone"
            self.reader.refuse(term, f"{name} takes {wanted}, but has {len(term.args)}")
        return rule, tuple(map(self._object, term.args))

    def _type_or_error(self, term: Term) -> TypeNode | TTRError:
        try:
            return self._type(term)
        except IllFormedError as error:
            return error

    def _object(self, term: Term) -> Object:
        return self.reader.object(term, ())

    def _type(self, term: Term) -> TypeNode:
        return self.reader.type(term, ())
