r"""Parses a text that is a term or a statement of a theory into a syntax tree.

There is one method for each form of statement, with the form as its docstring, written
as in `term_parser`.

>>> parse_term(Source("A | ~B")).parts[1]
Denial(start=4, end=6, body=Name(start=5, end=6, labels=('B',), up=None))
"""

from __future__ import annotations

import re
from collections.abc import Callable

from ttr.errors import NotationError
from ttr.notation import syntax_trees as trees
from ttr.notation.scanning import LETTER_OR_DIGIT, check_characters
from ttr.notation.syntax_errors import KEYWORDS
from ttr.notation.syntax_trees import Source, Statement, Term
from ttr.notation.term_parser import ANY, FUNCTION, SIMPLE, TermParser
from ttr.notation.tokens import NAME, PATH, QUOTED


def parse_term(source: Source) -> Term:
    """The whole text as a type or an object; raises `NotationError`."""
    check_characters(source)
    return _Parser(source, 0, len(source.text)).whole_term()


def parse_statement(source: Source, start: int, end: int) -> Statement:
    """text[start:end] as one statement; raises `NotationError`.

    >>> parse_statement(Source("basic A"), 0, 7)
    BasicNames(start=0, end=7, names=(Word(start=6, end=7, text='A'),))
    """
    return _Parser(source, start, end).whole_statement()


_SUBTYPE = re.compile("<=|⊑")

_GIVEN = re.compile(r"\|\|")

BEFORE_NAMES = ("game", "rule", "strategy")
"""Keywords only before a name: other things may be called `game`, too."""

_NAMED = re.compile(rf"\s+[{LETTER_OR_DIGIT}]")
"""What has to follow these words."""


def keyword_at(text: str, at: int) -> re.Match[str] | None:
    """The keyword by which a statement begins at a place; None if there is none."""
    word = PATH.match(text, at)
    if word is None or word[0] not in KEYWORDS:
        return None
    if word[0] in BEFORE_NAMES and not _NAMED.match(text, word.end()):
        return None
    return word


_Chance = trees.Probability | trees.Expectation


class _Parser(TermParser):
    """Parses the statements in a text."""

    def whole_term(self) -> Term:
        """The text as one term."""
        found = self._term()
        self._expect_end()
        return found

    def whole_statement(self) -> Statement:
        """The text as one statement."""
        found = self._statement()
        self._expect_end()
        return found

    # --- statements ---

    def _statement(self) -> Statement:
        """x := T, or T <: T ‹‹only› if query, …›, or what begins with a keyword."""
        start = self._at
        word = keyword_at(self._text, start)
        if word:
            self._advance(word.end())
            return _STATEMENTS[word[0]](self, start)
        if self._has_name_before(":="):
            name = self._word("a name")
            self._expect(":=")
            return self._node(trees.Definition, start, name, self._term())
        lower = self._term()
        self._expect("<:")
        upper = self._term("a type")
        if self._accept_word("only", "only if"):
            self._expect_word("if")
            only = self._comma_separated(self._query)
            return self._node(trees.RestrictiveAxiomClaim, start, lower, upper, only)
        if self._accept_word("if", "if"):
            when = self._comma_separated(self._query)
            return self._node(trees.ConditionalAxiomClaim, start, lower, upper, when)
        return self._node(trees.AxiomClaim, start, lower, upper)

    def _import(self, start: int) -> Statement:
        """import "file"."""
        return self._node(trees.Import, start, self._read_quoted())

    def _basic(self, start: int) -> Statement:
        """basic x, …."""
        return self._node(trees.BasicNames, start, self._names())

    def _open(self, start: int) -> Statement:
        """open x, …."""
        return self._node(trees.OpenNames, start, self._names())

    def _pred(self, start: int) -> Statement:
        """pred x(‹T, …›), …."""
        return self._node(trees.Predicates, start, self._comma_separated(self._arity))

    def _arity(self) -> trees.Arity:
        start = self._at
        name = self._word("a name")
        self._expect("(")
        return self._node(trees.Arity, start, name, self._arguments())

    def _object(self, start: int) -> Statement:
        """object x, … : T, where the names may be quoted."""
        names = self._comma_separated(self._subject)
        self._expect(":")
        return self._node(trees.ObjectNames, start, names, self._term("a type"))

    def _subject(self) -> trees.Word:
        start = self._at
        if NAME.match(self._text, start):
            return self._word("a name")
        self._note_expected("a name")
        return self._node(trees.Word, start, self._read_quoted())

    def _given(self, start: int) -> Statement:
        """given T : T ‹degree›, or given probability."""
        sit = self._term_or_probability()
        if not isinstance(sit, Term):
            return self._node(trees.GivenChance, start, sit)
        self._expect(":")
        kind = self._term("a type")
        return self._node(trees.GivenFact, start, sit, kind, self._degree())

    def _check(self, start: int) -> Statement:
        """check ‹not› query; the word may also be unknown or error."""
        expected = "yes"
        for word in ("not", "unknown", "error"):
            if self._accept_word(word):
                expected = "no" if word == "not" else word
                break
        return self._node(trees.Question, start, expected, self._query())

    def _query(self) -> trees.Query:
        """T : T, T <= T ‹up to relabelling›, T = T, T, or a probability."""
        start = self._at
        left = self._term_or_probability()
        if not isinstance(left, Term):
            return left
        if self._accept(":", ":"):
            return self._node(trees.Judged, start, left, self._term("a type"))
        if self._accept("=", "="):
            right = self._term("an object")
            return self._node(trees.Comparison, start, "=", left, right)
        self._note_expected("<=")
        if self._accept_match(_SUBTYPE):
            right = self._term("a type")
            relation = "<= up to relabelling" if self._is_relabelled() else "<="
            return self._node(trees.Comparison, start, relation, left, right)
        return self._node(trees.Claim, start, left)

    def _is_relabelled(self) -> bool:
        """Do the words `up to relabelling` follow? If so, take them."""
        if not self._accept_word("up", "up to relabelling"):
            return False
        self._expect_word("to")
        self._expect_word("relabelling")
        return True

    def _rule(self, start: int) -> Statement:
        """rule x(x : T ‹in T›, …) ‹"text"› ‹of x› ‹where [field, …]› := T."""
        name = self._word("a name")
        self._expect("(")
        given = self._comma_separated(self._parameter)
        self._expect(")")
        doc = self._doc()
        self._note_expected(":=")
        kind = self._word("a name") if self._accept_word("of", "of") else None
        self._note_expected(":=")
        where = self._where()
        self._expect(":=")
        value = self._term()
        return self._node(
            trees.RuleStatement, start, name, given, doc, kind, where, value
        )

    def _parameter(self) -> trees.Parameter:
        start = self._at
        name = self._word("a name")
        self._expect(":")
        kind = self._term("a type")
        return self._node(trees.Parameter, start, name, kind, self._within())

    def _doc(self) -> trees.Literal | None:
        start = self._at
        if not QUOTED.match(self._text, start):
            return None
        return self._node(trees.Literal, start, self._read_quoted())

    def _where(self) -> trees.Fields | None:
        start = self._at
        if not self._accept_word("where", "where"):
            return None
        self._expect("[")
        return self._fields(start)

    def _strategy(self, start: int) -> Statement:
        """strategy x := T."""
        name = self._word("a name")
        self._expect(":=")
        value = self._term("a rule or a strategy")
        return self._node(trees.StrategyStatement, start, name, value)

    def _game(self, start: int) -> Statement:
        """game x(T : T ‹, acts on path› ‹, hears T, …›) := T."""
        name = self._word("a name")
        self._expect("(")
        begin = self._term()
        self._expect(":")
        base = self._term("a type")
        path: Term | None = None
        heard: tuple[Term, ...] = ()
        if self._accept(",", "a comma"):
            if self._accept_word("acts", "acts on"):
                self._expect_word("on")
                path = self._application("a path", in_brackets=False)
            if path is None or self._accept(",", "a comma"):
                self._expect_word("hears")
                heard = self._comma_separated(lambda: self._term("a type"))
        self._expect(")")
        self._expect(":=")
        value = self._term("a rule or a strategy")
        return self._node(
            trees.GameStatement, start, name, begin, base, path, heard, value
        )

    # --- probabilities ---

    def _degree(self) -> trees.Degree | None:
        """= T, or in T."""
        start = self._at
        if self._accept("=", "="):
            return self._node(trees.Degree, start, "=", self._term("an object"))
        return self._within()

    def _within(self) -> trees.Degree | None:
        start = self._at
        if not self._accept_word("in", "in"):
            return None
        return self._node(trees.Degree, start, "in", self._term("an interval [lo, hi]"))

    def _term_or_probability(self) -> Term | _Chance:
        """A term, or a probability such as P(a : T) = p."""
        start = self._at
        if FUNCTION.match(self._text, start) or not SIMPLE.match(self._text, start):
            return self._term()
        head = self._simple_term(ANY)
        while self._accept("("):
            args = self._terms_up_to(")", "an argument or )")
            if len(args) == 1:
                chance = self._probability(start, head, args[0])
                if chance:
                    return chance
            self._expect(")")
            head = self._node(trees.Application, start, head, args)
        return self._rest_of_term(start, self._restriction(start, head))

    def _probability(self, start: int, head: Term, first: Term) -> _Chance | None:
        """The rest of P(T : T ‹| T : T, …›) or P(T || T, …), then ‹degree›."""
        if self._accept_match(_GIVEN):
            when = self._comma_separated(lambda: self._term("a type"))
            self._expect(")")
            degree = self._degree()
            return self._node(trees.Expectation, start, head, first, when, degree)
        if not self._accept(":", ":"):
            return None
        kind = self._term("a type")
        conditions: list[tuple[Term, Term]] = []
        if self._accept(":", ":"):
            kind, sit = self._split_condition(kind)
            conditions.append((sit, self._term("a type")))
            while self._accept(",", "a comma"):
                sit = self._term()
                self._expect(":")
                conditions.append((sit, self._term("a type")))
        self._expect(")")
        degree = self._degree()
        return self._node(
            trees.Probability, start, head, first, kind, degree, tuple(conditions)
        )

    def _split_condition(self, found: Term) -> tuple[Term, Term]:
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


_STATEMENTS: dict[str, Callable[[_Parser, int], Statement]] = {
    keyword: getattr(_Parser, f"_{keyword}") for keyword in KEYWORDS
}
"""The keywords, and the method, of the same name, that parses what follows each."""
