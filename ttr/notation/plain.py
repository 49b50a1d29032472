"""Plain statements, read without the grammar: most of a theory is of a few forms.

To make ready the parser of the whole notation takes longer than to read a theory of a
few hundred plain statements. What is none of them is left to the grammar, which says
what is wrong with it, too. Law: what is read here is what the grammar makes of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple, TypeVar

from ttr.notation.scanning import DEPTH
from ttr.notation.syntax_errors import KEYWORDS
from ttr.notation.syntax_trees import (
    Application,
    Arity,
    BasicNames,
    Definition,
    Denial,
    Disjunction,
    Field,
    Fields,
    Items,
    Literal,
    Name,
    ObjectNames,
    Predicates,
    Source,
    Statement,
    Term,
    Word,
)

__all__ = ["plain_statement"]

_OTHERS = frozenset(
    (
        *(*KEYWORDS, "acts", "error", "fun", "hears", "in"),
        *("not", "of", "on", "unknown", "where"),
    )
)
"""Words of the notation: what begins with them or has them in it is not plain."""

_LABEL = re.compile(r"(?:game|rule|strategy)\s*[:=,)\]]")
"""These are words of the notation only before a name."""

_TOKEN = re.compile(
    r"""\s* (?: \#[^\n]* \s* )*
        (?: (?P<level> (?:Type|RecType)\^[0-9]{1,3} (?![0-9]) )
          | (?P<path> (?: \^*\.[A-Za-z_]\w* | [A-Za-z_]\w*\.[A-Za-z_]\w* )
                      (?: \.[A-Za-z_]\w* )* (?! \.) )
          | (?P<name> [A-Za-z_]\w* (?! [.{]) )
          | (?P<text> "[^"\\\n]*" )
          | (?P<defined> := )
          | (?P<or> \\/ | \|(?!\|) )
          | (?P<sign> [\[\](),:=~] )
          | (?P<end> \Z )
          | (?P<other> . ) )""",
    re.VERBOSE | re.ASCII,
)


class _Token(NamedTuple):
    kind: str
    text: str
    start: int
    end: int


class _Other(Exception):
    """The statement is not a plain one."""


_T = TypeVar("_T")


def plain_statement(source: Source, start: int, end: int) -> Statement | None:
    """text[start:end] as a statement, or None where it takes the grammar to read it."""
    text = source.text[start:end]
    if not text.isascii() or sum(map(text.count, "[(~")) > DEPTH:
        return None
    try:
        return _Plain(_tokens(text, start)).statement()
    except _Other:
        return None


def _tokens(text: str, offset: int) -> list[_Token]:
    """The words and signs of a text, of one kind for each sign of its own."""
    found: list[_Token] = []
    for match in _TOKEN.finditer(text):
        kind = match.lastgroup
        assert kind is not None
        written = match[kind]
        here, there = match.span(kind)
        if kind == "other":
            raise _Other
        if found and written in _OTHERS and not _LABEL.match(text, here):
            raise _Other
        kind = written if kind == "sign" else kind
        found.append(_Token(kind, written, offset + here, offset + there))
        if kind == "end":
            break
    return found


class _Plain:
    """Reads tokens from left to right, by a method for each form."""

    def __init__(self, tokens: list[_Token]) -> None:
        self._tokens = tokens
        self._at = 0

    # --- statements ---

    def statement(self) -> Statement:
        first, *rest = self._tokens
        second = rest[0] if rest else first
        found: Statement
        if second.kind == "defined" and first.text not in _OTHERS:
            name = self._word()
            self._at += 1
            value = self._term()
            found = Definition(name.start, value.end, name, value)
        elif first.kind != "name" or second.kind != "name":
            raise _Other
        else:
            found = self._declared(first)
        self._take("end")
        return found

    def _declared(self, keyword: _Token) -> Statement:
        """What is declared behind a word of the notation."""
        self._at += 1
        match keyword.text:
            case "basic":
                names = self._several(self._word)
                return BasicNames(keyword.start, names[-1].end, names)
            case "pred":
                arities = self._several(self._arity)
                return Predicates(keyword.start, arities[-1].end, arities)
            case "object":
                names = self._several(self._word)
                self._take(":")
                kind = self._term()
                return ObjectNames(keyword.start, kind.end, names, kind)
        raise _Other

    def _arity(self) -> Arity:
        name = self._word()
        self._take("(")
        types, end = self._rest(")")
        return Arity(name.start, end, name, types)

    # --- terms ---

    def _term(self) -> Term:
        """Alternatives, of which there may be one."""
        parts = [self._denied()]
        while self._next() == "or":
            self._at += 1
            parts.append(self._denied())
        if len(parts) == 1:
            return parts[0]
        return Disjunction(parts[0].start, parts[-1].end, tuple(parts))

    def _denied(self) -> Term:
        if self._next() != "~":
            return self._simple()
        start = self._take("~").start
        body = self._denied()
        return Denial(start, body.end, body)

    def _simple(self) -> Term:
        token = self._tokens[self._at]
        self._at += 1
        found: Term
        match token.kind:
            case "name" | "level":
                found = Name(token.start, token.end, (token.text,), None)
            case "path":
                found = self._path(token)
            case "text":
                found = Literal(token.start, token.end, token.text[1:-1])
            case "[":
                found = self._listed(token.start)
            case _:
                raise _Other
        while self._next() == "(":
            self._at += 1
            args, end = self._rest(")")
            found = Application(token.start, end, found, args)
        return found

    def _path(self, token: _Token) -> Name:
        dotted = token.text.lstrip("^")
        up = len(token.text) - len(dotted) if dotted.startswith(".") else None
        labels = tuple(dotted.lstrip(".").split("."))
        if not _OTHERS.isdisjoint(labels):
            raise _Other
        return Name(token.start, token.end, labels, up)

    def _listed(self, start: int) -> Term:
        """What stands between square brackets: fields, or a list."""
        if self._next() == "name" and self._tokens[self._at + 1].kind in (":", "="):
            fields = self._several(self._field)
            return Fields(start, self._take("]").end, fields)
        items, end = self._rest("]")
        return Items(start, end, items)

    def _field(self) -> Field:
        label, value = self._word(), None
        if self._next() == "=":
            self._at += 1
            value = self._term()
        self._take(":")
        kind = self._term()
        return Field(label.start, kind.end, label, value, kind)

    # --- parts of forms ---

    def _rest(self, closing: str) -> tuple[tuple[Term, ...], int]:
        """The terms up to a bracket, and where it ends."""
        terms = () if self._next() == closing else self._several(self._term)
        return terms, self._take(closing).end

    def _several(self, one: Callable[[], _T]) -> tuple[_T, ...]:
        """One or more, with commas between."""
        found = [one()]
        while self._next() == ",":
            self._at += 1
            found.append(one())
        return tuple(found)

    def _word(self) -> Word:
        token = self._take("name")
        return Word(token.start, token.end, token.text)

    def _next(self) -> str:
        return self._tokens[self._at].kind

    def _take(self, kind: str) -> _Token:
        token = self._tokens[self._at]
        if token.kind != kind:
            raise _Other
        self._at += 1
        return token
