"""From text to trees: the grammar of `notation.lark`, and what to say where it fails.

This module loads the parser generator, so it is imported when a text is first read.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any, TypeVar

from lark import Lark, Token
from lark.exceptions import UnexpectedInput, UnexpectedToken, VisitError
from lark.tree import Meta
from lark.visitors import Transformer_NonRecursive, v_args

from ttr.errors import NotationError, Span
from ttr.notation import syntax_trees as trees
from ttr.notation.scanning import DEPTH, blocks, too_deep, vetted, with_backslashes
from ttr.notation.syntax_errors import explained, shown, stopped
from ttr.notation.syntax_trees import Source, Statement, Term

__all__ = ["blocks", "statement", "term", "vetted"]


def term(source: Source) -> Term:
    """The whole text as a type or an object; raises `NotationError`."""
    vetted(source)
    found: Term = _tree("term", source, 0, len(source.text))
    return found


def statement(source: Source, start: int, end: int) -> Statement:
    """text[start:end] as one statement; raises `NotationError`."""
    found: Statement = _tree("statement", source, start, end)
    return found


def _tree(rule: str, source: Source, start: int, end: int) -> Any:
    text = with_backslashes(source.text[start:end])
    deep = too_deep(text)
    if deep:
        raise NotationError(
            f"types and objects nest at most {DEPTH} deep",
            span=Span.of(source.name, source.text, start + deep[0], start + deep[1]),
            hint="give the inner part a name of its own: Name := …",
        )
    try:
        tree = _parser().parse(text, start=rule)
        return _Trees(source, start).transform(tree)
    except UnexpectedInput as error:
        wanted = _wanted(rule, text, error)
        raise explained(error, source, start, end, wanted) from None
    except VisitError as error:
        raise error.orig_exc from None


def _wanted(rule: str, text: str, error: UnexpectedInput) -> frozenset[str]:
    """The signs that could have stood where the parser failed.

    Where it met a sign that the grammar has not, what it expected is asked anew, with
    the text ending there.
    """
    if isinstance(error, UnexpectedToken):
        return frozenset(error.accepts or error.expected)
    try:
        _parser().parse(text[: stopped(error, text)], start=rule)
    except UnexpectedToken as ended:
        return frozenset(ended.accepts or ended.expected)
    return frozenset(("$END",))


@cache
def _parser() -> Lark:
    grammar = (
        files("ttr.notation").joinpath("notation.lark").read_text(encoding="utf-8")
    )
    return Lark(
        grammar,
        parser="lalr",
        start=["term", "statement"],
        propagate_positions=True,
        maybe_placeholders=False,
    )


# --- from the parser's trees to ours -------------------------------------------------

_P = TypeVar("_P", bound=trees.Part)


@v_args(meta=True)
class _Trees(Transformer_NonRecursive[Token, Any]):
    """One method for each rule of the grammar, with the rule's name."""

    def __init__(self, source: Source, offset: int) -> None:
        super().__init__()
        self._source = source
        self._offset = offset

    def _at(self, kind: Callable[..., _P], place: Any, *rest: object) -> _P:
        return kind(self._offset + place.start_pos, self._offset + place.end_pos, *rest)

    def _word(self, token: Token) -> trees.Word:
        """The token as a name; raises `NotationError` if it is no identifier."""
        word = self._at(trees.Word, token, str(token))
        self._identifier(word.text, word)
        return word

    def _identifier(self, text: str, place: trees.Part) -> None:
        if text.isidentifier():
            return
        curly = set(text) & set("‘’“”")
        raise NotationError(
            f"{shown(text)} is no name: a name is letters, digits and _",
            span=self._source.span(place),
            hint="quotes are straight: 'a name'" if curly else "",
        )

    def _labels(self, path: Token, dotted: str) -> tuple[str, ...]:
        labels = tuple(dotted.split("."))
        for label in labels:
            self._identifier(label, self._at(trees.Word, path, label))
        return labels

    def name(self, meta: Meta, children: list[Token]) -> trees.Name:
        token = children[0]
        label = str(token) if token.type == "LEVEL" else self._word(token).text
        return self._at(trees.Name, meta, (label,), None)

    def path(self, meta: Meta, children: list[Token]) -> trees.Name:
        dotted = children[0].lstrip("^")
        carets = len(children[0]) - len(dotted)
        up = carets if dotted.startswith(".") else None
        labels = self._labels(children[0], dotted.lstrip("."))
        return self._at(trees.Name, meta, labels, up)

    def text(self, meta: Meta, children: list[Token]) -> trees.Literal:
        return self._at(trees.Literal, meta, self._unquoted(children[0]))

    def number(self, meta: Meta, children: list[Token]) -> trees.Literal:
        literal = self._at(trees.Literal, meta, 0)
        try:
            return replace(literal, value=_number(children[0]))
        except ValueError:
            raise NotationError(
                "the number is too large", span=self._source.span(literal)
            ) from None

    def _unquoted(self, token: Token) -> str:
        body = token[1:-1]
        if token.startswith("'"):
            body = _SINGLE.sub(lambda found: _DOUBLED.get(found[0], found[0]), body)
        try:
            return str(json.loads(f'"{body}"', strict=False))
        except ValueError:
            raise NotationError(
                f"{shown(token)} has an unknown escape",
                span=self._source.span(self._at(trees.Word, token, str(token))),
                hint=r"the escapes are \" \' \\ \n \t \r \b \f and \u with four digits",
            ) from None

    def application(self, meta: Meta, children: list[Any]) -> trees.Application:
        head, *args = children
        return self._at(trees.Application, meta, head, tuple(args))

    def arity(self, meta: Meta, children: list[Any]) -> trees.Arity:
        name, *types = children
        return self._at(trees.Arity, meta, self._word(name), tuple(types))

    def function(self, meta: Meta, children: list[Any]) -> trees.Abstraction:
        variable, domain, body = children
        word = self._word(variable)
        return self._at(trees.Abstraction, meta, word, domain, body)

    def arrow(self, meta: Meta, children: list[Term]) -> trees.Arrow:
        return self._at(trees.Arrow, meta, None, *children)

    def product(self, meta: Meta, children: list[Any]) -> trees.Arrow:
        variable, domain, result = children
        word = self._word(variable)
        return self._at(trees.Arrow, meta, word, domain, result)

    def disjunction(self, meta: Meta, children: list[Term]) -> trees.Disjunction:
        return self._at(trees.Disjunction, meta, tuple(children))

    def negation(self, meta: Meta, children: list[Term]) -> trees.Denial:
        return self._at(trees.Denial, meta, *children)

    def concatenation(self, meta: Meta, children: list[Term]) -> trees.Concatenation:
        return self._at(trees.Concatenation, meta, tuple(children))

    def restriction(self, meta: Meta, children: list[Term]) -> trees.Restriction:
        return self._at(trees.Restriction, meta, *children)

    def conjunction(self, meta: Meta, children: list[Term]) -> trees.Conjunction:
        return self._at(trees.Conjunction, meta, tuple(children))

    def fields(self, meta: Meta, children: list[trees.Field]) -> trees.Fields:
        return self._at(trees.Fields, meta, tuple(children))

    def field(self, meta: Meta, children: list[Any]) -> trees.Field:
        label, *values, base = children
        value = values[0] if values else None
        return self._at(trees.Field, meta, self._word(label), value, base)

    def items(self, meta: Meta, children: list[Term]) -> trees.Items:
        return self._at(trees.Items, meta, tuple(children))

    def braces(self, meta: Meta, children: list[object]) -> trees.Braces:
        return self._at(trees.Braces, meta, tuple(children))

    def finite_set(self, meta: Meta, children: list[Term]) -> trees.Elements:
        return self._at(trees.Elements, meta, tuple(children))

    def events(self, meta: Meta, children: list[Term]) -> trees.Events:
        return self._at(trees.Events, meta, tuple(children))

    def setting(self, meta: Meta, children: list[Any]) -> tuple[trees.Word, Term]:
        return self._word(children[0]), children[1]

    def word(self, meta: Meta, children: list[Token]) -> trees.Word:
        return self._word(children[0])

    def subject(self, meta: Meta, children: list[Token]) -> trees.Word:
        token = children[0]
        if token.type == "NAME":
            return self._word(token)
        return self._at(trees.Word, meta, self._unquoted(token))

    def import_(self, meta: Meta, children: list[Token]) -> trees.Import:
        return self._at(trees.Import, meta, self._unquoted(children[0]))

    def basic(self, meta: Meta, children: list[trees.Word]) -> trees.BasicNames:
        return self._at(trees.BasicNames, meta, tuple(children))

    def pred(self, meta: Meta, children: list[object]) -> trees.Predicates:
        return self._at(trees.Predicates, meta, tuple(children))

    def open(self, meta: Meta, children: list[trees.Word]) -> trees.OpenNames:
        return self._at(trees.OpenNames, meta, tuple(children))

    def object(self, meta: Meta, children: list[Any]) -> trees.ObjectNames:
        *names, base = children
        return self._at(trees.ObjectNames, meta, tuple(names), base)

    def given(self, meta: Meta, children: list[Any]) -> trees.GivenFact:
        sit, base, *degree = children
        return self._at(trees.GivenFact, meta, sit, base, degree[0] if degree else None)

    def definition(self, meta: Meta, children: list[Any]) -> trees.Definition:
        return self._at(trees.Definition, meta, *children)

    def rule(self, meta: Meta, children: list[Any]) -> trees.RuleStatement:
        name, *inner, value = children
        given, doc, kind, where = (
            [part for part in inner if isinstance(part, sort)]
            for sort in (trees.Parameter, trees.Literal, trees.Word, trees.Fields)
        )
        return self._at(
            trees.RuleStatement,
            meta,
            name,
            tuple(given),
            *(found[0] if found else None for found in (doc, kind, where)),
            value,
        )

    def parameter(self, meta: Meta, children: list[Any]) -> trees.Parameter:
        name, base, *degree = children
        word = self._word(name)
        return self._at(
            trees.Parameter, meta, word, base, degree[0] if degree else None
        )

    def doc(self, meta: Meta, children: list[Token]) -> trees.Literal:
        return self.text(meta, children)

    def kind(self, meta: Meta, children: list[Token]) -> trees.Word:
        return self._word(children[0])

    def bindings(self, meta: Meta, children: list[trees.Field]) -> trees.Fields:
        return self.fields(meta, children)

    def strategy(self, meta: Meta, children: list[Any]) -> trees.StrategyStatement:
        return self._at(trees.StrategyStatement, meta, *children)

    def game(self, meta: Meta, children: list[Any]) -> trees.GameStatement:
        name, begin, base, *parts, value = children
        path = next((one for one in parts if isinstance(one, Term)), None)
        heard = next((one for one in parts if isinstance(one, tuple)), ())
        return self._at(
            trees.GameStatement, meta, name, begin, base, path, heard, value
        )

    def acting(self, meta: Meta, children: list[Term]) -> Term:
        return children[0]

    def hearing(self, meta: Meta, children: list[Term]) -> tuple[Term, ...]:
        return tuple(children)

    def axiom(self, meta: Meta, children: list[Term]) -> trees.AxiomClaim:
        return self._at(trees.AxiomClaim, meta, *children)

    def check(self, meta: Meta, children: list[Any]) -> trees.Question:
        *expected, query = children
        return self._at(trees.Question, meta, expected[0] if expected else "yes", query)

    def expected(self, meta: Meta, children: list[Token]) -> str:
        return "no" if children[0] == "not" else str(children[0])

    def exactly(self, meta: Meta, children: list[Term]) -> trees.Degree:
        return self._at(trees.Degree, meta, "=", *children)

    def within(self, meta: Meta, children: list[Any]) -> trees.Degree:
        _, value = children
        return self._at(trees.Degree, meta, "in", value)

    def judgement(self, meta: Meta, children: list[Term]) -> trees.Judged:
        return self._at(trees.Judged, meta, *children)

    def below(self, meta: Meta, children: list[Term]) -> trees.Comparison:
        return self._at(trees.Comparison, meta, "<=", *children)

    def same(self, meta: Meta, children: list[Term]) -> trees.Comparison:
        return self._at(trees.Comparison, meta, "=", *children)

    def probability(self, meta: Meta, children: list[Any]) -> trees.Probability:
        children, degree = _with_degree(children)
        head, sit, kind, *rest = children
        if not rest:
            return self._at(trees.Probability, meta, head, sit, kind, degree)
        kind, first = self._divided(kind)
        terms = [first, *rest]
        when = tuple(zip(terms[::2], terms[1::2], strict=True))
        return self._at(trees.Probability, meta, head, sit, kind, degree, when)

    def _divided(self, found: Term) -> tuple[Term, Term]:
        """T | b, read as a join, as the type T and the object b of a condition."""
        match found:
            case trees.Disjunction(start, _, (*parts, last)):
                kept = parts[-1]
                between = self._source.text[kept.end : last.start]
                if between.strip(" \t\n()") == "|":
                    whole = trees.Disjunction(start, kept.end, tuple(parts))
                    return (kept if len(parts) == 1 else whole), last
        raise NotationError(
            "a condition is written after |, as in P(a : T | b : S)",
            span=self._source.span(found),
            hint="a function type stands in brackets: P(f : (S -> T) | b : S)",
        )

    def expectation(self, meta: Meta, children: list[Any]) -> trees.Expectation:
        children, degree = _with_degree(children)
        head, kind, *when = children
        return self._at(trees.Expectation, meta, head, kind, tuple(when), degree)

    def given_chance(self, meta: Meta, children: list[Any]) -> trees.GivenChance:
        return self._at(trees.GivenChance, meta, *children)

    def claim(self, meta: Meta, children: list[Term]) -> trees.Claim:
        return self._at(trees.Claim, meta, *children)


def _with_degree(children: list[Any]) -> tuple[list[Any], trees.Degree | None]:
    """What stands before a degree, and the degree, where there is one."""
    if isinstance(children[-1], trees.Degree):
        return children[:-1], children[-1]
    return children, None


_SINGLE = re.compile(r"""\\.|\"""", re.DOTALL)
_DOUBLED = {"\\'": "'", '"': '\\"'}


def _number(token: str) -> int | float:
    """The number; raises `ValueError` where it is too large for a Python number."""
    if not set(token) & set(".eE"):
        return int(token)
    value = float(token)
    if math.isinf(value):
        raise ValueError(token)
    return value
