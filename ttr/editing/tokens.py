r"""The tokens of a theory's text: what each piece of it is, whether it parses or not.

The patterns are those of `ttr.notation`, so that an editor colours as a number what is
read as a number. What a name is called for is told by what stands around it and by the
declarations in the same text; nothing is read or computed. Every text has tokens, and
together they are the text.

>>> text = "Dog := [x : Ind, c : dog(x)]"
>>> for token in theory_tokens(text):
...     if token.kind in (Kind.TYPE, Kind.LABEL, Kind.PREDICATE):
...         print(token.kind, token.of(text))
type Dog
label x
type Ind
label c
predicate dog
label x
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

from ttr.notation.parser import keyword_at
from ttr.notation.scanning import LETTER, find_statements, with_backslashes
from ttr.notation.term_parser import LEVEL
from ttr.notation.tokens import NAME, NUMBER, QUOTED
from ttr.theories.strategy_statements import COMBINING
from ttr.types.reserved_words import LOGICAL, RESERVED


class Kind(StrEnum):
    """What a piece of a text is."""

    SPACE = "space"
    COMMENT = "comment"
    KEYWORD = "keyword"
    WORD = "word"
    TYPE = "type"
    PREDICATE = "predicate"
    OBJECT = "object"
    RULE = "rule"
    LABEL = "label"
    VARIABLE = "variable"
    NAME = "name"
    NUMBER = "number"
    STRING = "string"
    OPERATOR = "operator"
    PUNCTUATION = "punctuation"
    TITLE = "title"
    ERROR = "error"


NAMES = frozenset(
    {
        *(Kind.TYPE, Kind.PREDICATE, Kind.OBJECT, Kind.RULE),
        *(Kind.LABEL, Kind.VARIABLE, Kind.NAME),
    }
)
"""The kinds of what has a name of the author's choice."""


@dataclass(frozen=True, slots=True)
class Token:
    """The piece text[start:end]; does it declare the name that it is?"""

    kind: Kind
    start: int
    end: int
    declares: bool = False

    def of(self, text: str) -> str:
        """The piece itself."""
        return text[self.start : self.end]


OPERATORS = (
    *(":=", "<:", "<=", "->", "||", r"\/", "/\\"),
    *("⊑", "→", "∨", "∧", "¬", "|", "&", "~", "+", "@", "\\", "=", ":"),
)
"""The signs between terms, the longer ones first."""

PUNCTUATION = "[](){}<>,.^"

OPEN_QUOTE = re.compile(r"[\"'][^\n]*")
"""A quote that does not close on its line."""

COMMENT = re.compile(r"[#][^\n]*")

_PIECE = re.compile(
    rf"""(?P<space> \s+ )
       | (?P<comment> {COMMENT.pattern} )
       | (?P<string> {QUOTED.pattern} )
       | (?P<open_quote> {OPEN_QUOTE.pattern} )
       | (?P<level> {LEVEL.pattern} )
       | (?P<name> {NAME.pattern} )
       | (?P<operator> {"|".join(map(re.escape, OPERATORS))} )
       | (?P<number> {NUMBER.pattern} )
       | (?P<punctuation> [{re.escape(PUNCTUATION)}] )
       | (?P<error> . )""",
    re.VERBOSE | re.DOTALL,
)

_STRAY = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
"""Blanks that the notation does not read, besides line ends of any kind."""

_KINDS = {
    "space": Kind.SPACE,
    "comment": Kind.COMMENT,
    "string": Kind.STRING,
    "open_quote": Kind.ERROR,
    "level": Kind.WORD,
    "name": Kind.NAME,
    "number": Kind.NUMBER,
    "operator": Kind.OPERATOR,
    "punctuation": Kind.PUNCTUATION,
    "error": Kind.ERROR,
}

AFTER_TERMS = {
    "given": frozenset(("in",)),
    "check": frozenset(("in", "up")),
    "rule": frozenset(("in", "of", "where")),
    "": frozenset(("if", "only", "up")),
}
"""The keywords that follow a term, by the word that begins the statement."""

FOLLOWING = {
    "check": frozenset(("not", "unknown", "error")),
    "only": frozenset(("if",)),
    "up": frozenset(("to",)),
    "to": frozenset(("relabelling",)),
    "acts": frozenset(("on",)),
}
"""The keywords that follow another one at once."""

_IN_GAMES = frozenset(("acts", "hears"))

CLAIMS = frozenset(("P", "create", "wellformed", "true"))
"""What may be claimed with a word and brackets, where no name is declared so."""

BEFORE_BRACKETS = frozenset((*RESERVED, "star", "merge", "amerge", *CLAIMS, *COMBINING))
"""The words of the notation before a bracket."""

_DECLARING = {"basic": Kind.TYPE, "pred": Kind.PREDICATE, "object": Kind.OBJECT}

_ENDING = NAMES | {Kind.WORD, Kind.NUMBER, Kind.STRING}
"""What a term may end with, besides a bracket."""

_CLOSING = {"[": "]", "(": ")", "{": "}", "<": ">"}


def theory_tokens(text: str) -> tuple[Token, ...]:
    """The tokens of a theory's text, one after the other; together they are the text.

    It takes time linear in the length of the text, and no text is refused.
    """
    signs, starts = _with_signs(text)
    waiting = list(_pieces(signs))[::-1]
    statements = []
    for end in [*starts[1:], len(text)]:
        pieces = []
        while waiting and waiting[-1].start < end:
            pieces.append(waiting.pop())
        statements.append(_Statement(signs, pieces))
    declared: dict[str, Kind] = {}
    for statement in statements:
        statement.scan()
        for token in statement.tokens:
            if token.declares:
                declared.setdefault(token.of(text), token.kind)
    return tuple(token for one in statements for token in one.resolve(declared))


def _with_signs(text: str) -> tuple[str, list[int]]:
    """The text as the parser reads it, and where its statements start."""
    parts, starts, at = [], [], 0
    for start, end in find_statements(text):
        starts.append(start)
        parts += [text[at:start], with_backslashes(text[start:end])]
        at = end
    return "".join([*parts, text[at:]]), starts


def _pieces(text: str) -> Iterator[Token]:
    for found in _PIECE.finditer(text):
        group = str(found.lastgroup)
        if group == "space" and _STRAY.search(found[0]):
            yield from _pieces_of_space(found)
        elif group == "name" and not found[0].isidentifier():
            yield Token(Kind.ERROR, *found.span())
        else:
            yield Token(_KINDS[group], *found.span())


def _pieces_of_space(found: re.Match[str]) -> Iterator[Token]:
    at = found.start()
    for stray in _STRAY.finditer(found[0]):
        start, end = (found.start() + place for place in stray.span())
        if start > at:
            yield Token(Kind.SPACE, at, start)
        yield Token(Kind.ERROR, start, end)
        at = end
    if at < found.end():
        yield Token(Kind.SPACE, at, found.end())


_DOTTED = re.compile(rf"\.[{LETTER}]")
"""What follows a name that begins a path."""

_NOTHING = Token(Kind.SPACE, -1, -1)


@dataclass
class _Statement:
    """The tokens of one statement, and what has been seen of it so far.

    `around` has the brackets that are open, each with whether it holds arguments;
    `variables` and `labels` are the names that the statement binds.
    """

    text: str
    tokens: list[Token]
    keyword: str = ""
    is_axiom: bool = False
    around: list[tuple[str, bool]] = field(default_factory=list)
    variables: set[str] = field(default_factory=set)
    labels: set[str] = field(default_factory=set)

    def scan(self) -> None:
        """Say what the pieces are, as far as the statement alone tells it."""
        seen = [
            n
            for n, piece in enumerate(self.tokens)
            if piece.kind not in (Kind.SPACE, Kind.COMMENT)
        ]
        words = ["", *(self.tokens[n].of(self.text) for n in seen), "", ""]
        self.is_axiom = "<:" in words
        before = _NOTHING
        for i, n in enumerate(seen, start=1):
            here = self.tokens[n]
            if here.kind is Kind.NAME:
                self.tokens[n] = self._scan_name(here, before, words[i - 1 : i + 3])
            elif here.kind in (Kind.PUNCTUATION, Kind.OPERATOR):
                self._scan_bracket(words[i], before)
            before = self.tokens[n]

    def _scan_bracket(self, word: str, before: Token) -> None:
        if word in _CLOSING:
            self.around.append((word, word == "(" and self._ends_term(before)))
        elif self.around and word == _CLOSING[self.around[-1][0]]:
            self.around.pop()

    def _ends_term(self, token: Token) -> bool:
        """May a term end with this token?"""
        if token.kind is Kind.PUNCTUATION:
            return token.of(self.text) in ("]", ")", "}", ">")
        return token.kind in _ENDING

    def _scan_name(self, here: Token, before: Token, words: list[str]) -> Token:
        """What a name is; it is the second of the words, the others stand around."""
        last, word, after, _ = words
        if before is _NOTHING:
            if keyword_at(self.text, here.start):
                self.keyword = word
                return replace(here, kind=Kind.KEYWORD)
            if after == ":=":
                return Token(Kind.TYPE, here.start, here.end, declares=True)
        if last == "." and before.end == here.start:
            return replace(here, kind=Kind.LABEL)
        if self._is_keyword(here, before, words):
            return replace(here, kind=Kind.KEYWORD)
        inner, holds_arguments = self.around[-1] if self.around else ("", False)
        if inner in ("[", "{") and last in ("[", "{", ",") and after in (":", "="):
            self.labels.add(word)
            return replace(here, kind=Kind.LABEL)
        is_parameter = self.keyword == "rule" and len(self.around) == 1
        if (
            last == "\\"
            or (last == "fun" and before.kind is Kind.KEYWORD)
            or (
                inner == "("
                and after == ":"
                and (
                    (last == "(" and not holds_arguments)
                    or (last in ("(", ",") and is_parameter)
                )
            )
        ):
            self.variables.add(word)
            return replace(here, kind=Kind.VARIABLE)
        if not self.around:
            declared = self._declared_kind(last, before, after)
            if declared:
                return Token(declared, here.start, here.end, declares=True)
            if last == "of" and before.kind is Kind.KEYWORD:
                return replace(here, kind=Kind.RULE)
        if word in COMBINING and self.keyword not in ("strategy", "game"):
            return here
        if word in LOGICAL or (
            word in BEFORE_BRACKETS and (after == "(" or (word, after) == ("set", "{"))
        ):
            return replace(here, kind=Kind.WORD)
        return here

    def _is_keyword(self, here: Token, before: Token, words: list[str]) -> bool:
        """Is a name, the second of the words, a keyword inside a statement?"""
        last, word, after, next_but_one = words
        if word == "fun":
            is_name = after[:1].isalpha() or after[:1] == "_"
            return is_name and next_but_one == ":" and not self._ends_term(before)
        if _DOTTED.match(self.text, here.end):
            return False
        if before.kind is Kind.KEYWORD and word in FOLLOWING.get(last, ()):
            return True
        depth = len(self.around)
        if self.keyword == "game" and depth == 1 and last == ",":
            return word in _IN_GAMES
        if depth > (self.keyword == "rule"):
            return False
        return word in AFTER_TERMS.get(self.keyword, ()) and self._ends_term(before)

    def _declared_kind(self, last: str, before: Token, after: str) -> Kind | None:
        """What kind of name is declared here, outside of all brackets, if one is."""
        is_first = before.kind is Kind.KEYWORD and last == self.keyword
        match self.keyword:
            case "rule" | "strategy" | "game" if is_first:
                return Kind.RULE
            case "given" if is_first and after == ":":
                return Kind.OBJECT
            case "basic" | "pred" | "object" if is_first or last == ",":
                return _DECLARING[self.keyword]
        return None

    def resolve(self, declared: Mapping[str, Kind]) -> list[Token]:
        """The tokens, where names are what the text declares them as."""
        after, found = "", []
        for token in reversed(self.tokens):
            word = token.of(self.text)
            if token.kind is Kind.NAME:
                kind = self._resolved_kind(word, after, declared)
                token = replace(token, kind=kind)
            found.append(token)
            if token.kind not in (Kind.SPACE, Kind.COMMENT):
                after = word
        return found[::-1]

    def _resolved_kind(
        self, word: str, after: str, declared: Mapping[str, Kind]
    ) -> Kind:
        if word in self.variables:
            return Kind.VARIABLE
        kind = declared.get(word, Kind.NAME)
        if kind in (Kind.TYPE, Kind.PREDICATE, Kind.RULE):
            return kind
        if word in self.labels:
            return Kind.LABEL
        if kind is Kind.NAME:
            if after == "(":
                return Kind.PREDICATE
            if word[0].isupper():
                return Kind.TYPE
            if self.is_axiom:
                return Kind.VARIABLE
            if self.keyword == "strategy":
                return Kind.RULE
        return kind
