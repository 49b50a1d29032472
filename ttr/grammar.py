"""From text to trees: the grammar of `notation.lark`, and what to say where it fails.

This module loads the parser generator, so it is imported when a text is first read.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any, NoReturn, TypeVar

from lark import Lark, Token
from lark.exceptions import UnexpectedInput, UnexpectedToken, VisitError
from lark.tree import Meta
from lark.visitors import Transformer_NonRecursive, v_args

from ttr import trees
from ttr.errors import NotationError, Span
from ttr.misreadings import KEYWORDS, explained, stopped
from ttr.trees import Source, Statement, Term

__all__ = ["DEPTH", "blocks", "statement", "term", "vetted"]

DEPTH = 100
"""How deep brackets may nest."""


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
    try:
        tree = _parser().parse(source.text[start:end], start=rule)
        return _Trees(source, start).transform(tree)
    except UnexpectedInput as error:
        wanted = _wanted(rule, source.text[start:end], error)
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
    grammar = files("ttr").joinpath("notation.lark").read_text(encoding="utf-8")
    return Lark(
        grammar,
        parser="lalr",
        start=["term", "statement"],
        propagate_positions=True,
        maybe_placeholders=False,
    )


# --- before the grammar --------------------------------------------------------------

_WORDS = re.compile(
    r""" (?P<quoted> "(?:\\.|[^"\\\n])*"? | '(?:\\.|[^'\\\n])*'? | \#[^\n]* )
       | (?P<opening> [\[({] )
       | (?P<closing> [\])}] ) """,
    re.VERBOSE,
)

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f]")
"""What is never meant in a text: control characters but for tabs and line ends."""


def vetted(source: Source) -> None:
    """Refuses control characters, and brackets nested deeper than `DEPTH`."""
    stray = _CONTROL.search(source.text)
    if stray:
        _refuse_control(source, stray)
    depth = 0
    for found in _WORDS.finditer(source.text):
        depth += (found.lastgroup == "opening") - (found.lastgroup == "closing")
        depth = max(0, depth)
        if depth > DEPTH:
            raise NotationError(
                f"brackets nest at most {DEPTH} deep",
                span=Span.of(source.name, source.text, *found.span()),
                hint="give the inner part a name of its own: Name := …",
            )


def _refuse_control(source: Source, stray: re.Match[str]) -> NoReturn:
    # Where a terminal acts on the character, what is underlined would be shifted.
    shown = _CONTROL.sub(" ", source.text)
    raise NotationError(
        f"the control character {stray[0]!r} is no notation",
        span=Span.of(source.name, shown, *stray.span()),
        hint=r"in a plain string Python reads \ as the start of an escape: write r'…'",
    )


_STARTS = re.compile(
    rf"""[ \t]* (?: (?:{"|".join(KEYWORDS)}) [ \t]+ [^\s:=,.)\]}}]
                  | \w+ [ \t]* :=
                  | \w+ (?:\([^()]*\))? [ \t]* <: )""",
    re.VERBOSE,
)


def blocks(text: str) -> Iterator[tuple[int, int]]:
    """Where the statements of a theory stand: [start, end) of each.

    A statement goes on over lines that are indented further than the first statement,
    and inside brackets. A line that looks like a statement starts one all the same, so
    that a forgotten bracket spoils one statement and not the rest of the text.

    >>> list(blocks("basic A\\nX :=\\n  [x : A]\\n"))
    [(0, 7), (8, 22)]
    """
    start, end, depth, margin = -1, -1, 0, None
    at = 0
    for line in text.split("\n"):
        words = _WORDS.sub(_bracket, line)
        written = words.strip()
        if written:
            indent = len(line) - len(line.lstrip())
            margin = indent if margin is None else margin
            if start >= 0 and (_STARTS.match(line) or (not depth and indent <= margin)):
                yield start, end
                start = -1
            if start < 0:
                start, depth = at + indent, 0
            end = at + _code_end(line)
        depth = max(
            0, depth + sum(map(words.count, "[({")) - sum(map(words.count, "])}"))
        )
        at += len(line) + 1
    if start >= 0:
        yield start, end


def _bracket(found: re.Match[str]) -> str:
    """Brackets as they are; a quoted name as a dot; a comment as nothing."""
    if found.lastgroup != "quoted":
        return found[0]
    return "" if found[0].startswith("#") else "."


def _code_end(line: str) -> int:
    for found in _WORDS.finditer(line):
        if found[0].startswith("#"):
            line = line[: found.start()]
    return len(line.rstrip())


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
        if word.text.isidentifier():
            return word
        curly = set(word.text) & set("‘’“”")
        raise NotationError(
            f"{word.text} is no name: a name is letters, digits and _",
            span=self._source.span(word),
            hint="quotes are straight: 'a name'" if curly else "",
        )

    def _labels(self, tokens: list[Token]) -> tuple[str, ...]:
        return tuple(self._word(token).text for token in tokens)

    def bare(self, meta: Meta, children: list[Token]) -> trees.Name:
        return self._at(trees.Name, meta, self._labels(children), None)

    def level(self, meta: Meta, children: list[Token]) -> trees.Name:
        return self._at(trees.Name, meta, (str(children[0]),), None)

    def path(self, meta: Meta, children: list[Token]) -> trees.Name:
        carets = [token for token in children if token.type == "UP"]
        labels = self._labels(children[len(carets) :])
        return self._at(trees.Name, meta, labels, sum(map(len, carets)))

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
                f"{token} has an unknown escape",
                span=self._source.span(self._at(trees.Word, token, str(token))),
                hint=r"the escapes are \" \' \\ \n \t \r \b \f and \u with four digits",
            ) from None

    def application(self, meta: Meta, children: list[Any]) -> trees.Application:
        head, *args = children
        return self._at(trees.Application, meta, self._word(head), tuple(args))

    arity = application

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

    def axiom(self, meta: Meta, children: list[Term]) -> trees.AxiomClaim:
        return self._at(trees.AxiomClaim, meta, *children)

    def check(self, meta: Meta, children: list[Any]) -> trees.Question:
        *expected, query = children
        return self._at(trees.Question, meta, expected[0] if expected else "yes", query)

    def expectation(self, meta: Meta, children: list[Token]) -> str:
        return "no" if children[0] == "not" else str(children[0])

    def exactly(self, meta: Meta, children: list[Term]) -> trees.Degree:
        return self._at(trees.Degree, meta, "=", *children)

    def within(self, meta: Meta, children: list[Term]) -> trees.Degree:
        return self._at(trees.Degree, meta, "in", *children)

    def judgement(self, meta: Meta, children: list[Term]) -> trees.Judged:
        return self._at(trees.Judged, meta, *children)

    def below(self, meta: Meta, children: list[Term]) -> trees.Comparison:
        return self._at(trees.Comparison, meta, "<=", *children)

    def same(self, meta: Meta, children: list[Term]) -> trees.Comparison:
        return self._at(trees.Comparison, meta, "=", *children)

    def probability(self, meta: Meta, children: list[Any]) -> trees.Probability:
        head, *rest = children
        return self._at(trees.Probability, meta, self._word(head), *rest)

    def claim(self, meta: Meta, children: list[Term]) -> trees.Claim:
        return self._at(trees.Claim, meta, *children)


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
