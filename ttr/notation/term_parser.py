r"""Parses types and objects, with one method for each rule of the grammar.

Types and objects share one syntax, that of terms: only the place of a term says which
is meant, so that the reader decides. The docstring of a method states its rule: `T` is
a term and `x` a name, parts in ‹ › may be left out, and `…` stands for more of the same
with commas between. No method goes back in the text, so that parsing takes linear time.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from ttr.notation import syntax_trees as trees
from ttr.notation.scanning import LETTER
from ttr.notation.syntax_trees import Term
from ttr.notation.tokens import NAME, NUMBER, PATH, QUOTED, Tokens

ANY = "a type or an object"
"""What is expected where any term may stand."""

SIMPLE = re.compile(rf"""[\[{{<"']|-?[0-9]|(?:\^*\.)?[{LETTER}]""")
"""The start of a simple term (see `_simple_term`)."""

FUNCTION = re.compile(rf"\\|fun(?=\s+{NAME.pattern}\s*:(?!=))")
r"""The start of a function. Labels, objects and types may be called `fun`, too.

Every λ that begins a function has been replaced by \ (`with_backslashes`)."""

LEVEL = re.compile(r"(?:Type|RecType)\^[0-9]{1,3}(?![0-9])")
"""Type_1 means the same, but is a name like others, and may be a label."""

_DOT = re.compile(rf"\.(?![{LETTER}])")
"""The dot of a function: no name follows it, unlike the dot in a path."""

_ARROW = re.compile("->|→")

_NOT = re.compile("[~¬]")

_OPERATOR = re.compile(r"(?P<join>\\/|\|(?!\|)|∨)|(?P<meet>/\\|&|∧)|(?P<sum>\+)")

_OPERATORS: dict[str, tuple[int, str, Callable[..., Term]]] = {
    "join": (0, "a type", trees.Disjunction),
    "meet": (1, "a type", trees.Conjunction),
    "sum": (2, "a list or a string of events", trees.Concatenation),
}
"""How tightly an operator binds, what is expected after it, and its syntax tree."""


_AFTER_TERMS = ",:])}"
"""Signs that no operator begins with."""


class TermParser(Tokens):
    """Parses the terms in a text."""

    def _term(self, expected: str = ANY, *, may_be_function: bool = True) -> Term:
        r"""\x:T. T, or (x : T) -> T, or operands with operators and arrows."""
        start = self._at
        if may_be_function and self._accept_match(FUNCTION):
            variable = self._word("a variable")
            self._expect(":")
            domain = self._term("a type", may_be_function=False)
            if not self._accept_match(_DOT):
                self._fail("a dot and the body")
            body = self._term("the body of the function")
            return self._node(trees.Abstraction, start, variable, domain, body)
        if self._begins_product():
            self._expect("(")
            variable = self._word("a variable")
            self._expect(":")
            domain = self._term("a type")
            self._expect(")")
            if not self._accept_match(_ARROW):
                self._fail("->")
            result = self._term("a type", may_be_function=False)
            return self._node(trees.Arrow, start, variable, domain, result)
        return self._rest_of_term(start, self._operand(expected))

    def _rest_of_term(self, start: int, first: Term) -> Term:
        """The term that begins, at `start`, with this operand."""
        if self._text[self._at : self._at + 1] in _AFTER_TERMS:
            return first
        found = self._infix(start, first, 0)
        if not self._accept_match(_ARROW):
            return found
        result = self._term("a type", may_be_function=False)
        return self._node(trees.Arrow, start, None, found, result)

    def _infix(self, start: int, first: Term, least: int) -> Term:
        r"""T \/ T …, T /\ T … or T + T …, if the operator binds at least so tightly."""
        found = first
        while (kind := self._operator()) and _OPERATORS[kind][0] >= least:
            level, expected, made = _OPERATORS[kind]
            parts = [found]
            while self._operator() == kind:
                self._accept_match(_OPERATOR)
                at = self._at
                parts.append(self._infix(at, self._operand(expected), level + 1))
            found = self._node(made, start, tuple(parts))
        return found

    def _operator(self) -> str | None:
        found = _OPERATOR.match(self._text, self._at)
        return found and found.lastgroup

    def _operand(self, expected: str) -> Term:
        """~T, or T ‹@ T›."""
        start = self._at
        if self._accept_match(_NOT):
            return self._node(trees.Denial, start, self._operand("a type"))
        return self._restriction(start, self._application(expected))

    def _restriction(self, start: int, base: Term) -> Term:
        if not self._accept("@"):
            return base
        value = self._application("an object")
        return self._node(trees.Restriction, start, base, value)

    def _application(self, expected: str, *, in_brackets: bool = True) -> Term:
        """(T) or a simple term, with or without arguments: T(‹T, …›) …."""
        start = self._at
        if in_brackets and self._accept("("):
            found = self._term()
            self._expect(")")
        else:
            found = self._simple_term(expected)
        while self._accept("("):
            found = self._node(trees.Application, start, found, self._arguments())
        return found

    def _arguments(self) -> tuple[Term, ...]:
        found = self._terms_up_to(")", "an argument or )")
        self._expect(")")
        return found

    def _terms_up_to(self, closing: str, expected: str) -> tuple[Term, ...]:
        """‹T, …› before a closing bracket."""
        if self._text.startswith(closing, self._at):
            return ()
        found = [self._term(expected)]
        while self._accept(",", "a comma"):
            found.append(self._term())
        return tuple(found)

    def _simple_term(self, expected: str) -> Term:
        """A name, path, number or quoted name, or something in [ ], { } or < >."""
        start, text = self._at, self._text
        if path := PATH.match(text, start):
            return self._named_term(start, path)
        if self._accept("["):
            is_fields = self._has_name_before(":", "=")
            return self._fields(start) if is_fields else self._items(start)
        if self._accept("{"):
            is_record = text.startswith("}", self._at) or self._has_name_before("=")
            if is_record:
                return self._settings(start)
            return self._elements(start, "a setting x = a, an object or }")
        if self._accept("<"):
            return self._events(start)
        if QUOTED.match(text, start):
            return self._node(trees.Literal, start, self._read_quoted())
        if number := NUMBER.match(text, start):
            self._advance(number.end())
            return self._number(start, number[0])
        self._fail(expected)

    def _named_term(self, start: int, path: re.Match[str]) -> Term:
        """A name or a path, Type^1, or set{…}."""
        if path[0] == "set" and self._accept("set{"):
            return self._elements(start, "an object or }")
        level = LEVEL.match(self._text, start)
        if level:
            self._advance(level.end())
            return self._node(trees.Name, start, (level[0],), None)
        self._advance(path.end())
        return self._name(start, path[0])

    def _name(self, start: int, path: str) -> trees.Name:
        """x.y, or .x.y, with a caret in front for each record type to leave."""
        dotted = path.lstrip("^")
        up = len(path) - len(dotted) if dotted.startswith(".") else None
        labels = tuple(dotted.lstrip(".").split("."))
        found = self._node(trees.Name, start, labels, up)
        for label in labels:
            self._check_identifier(label, found)
        return found

    def _items(self, start: int) -> trees.Items:
        """[‹T, …›]."""
        items = self._terms_up_to("]", "a field x : T, an object or ]")
        self._expect("]")
        return self._node(trees.Items, start, items)

    def _fields(self, start: int) -> trees.Fields:
        """[field, …], where a field is x : T or x = T : T."""
        fields: list[trees.Field] = []
        while not fields or self._accept(",", "a comma"):
            at = self._at
            label, value = self._word("a label"), None
            self._note_expected(":")
            if self._accept("=", "="):
                value = self._term("an object")
            self._expect(":")
            kind = self._term("a type")
            fields.append(self._node(trees.Field, at, label, value, kind))
        self._expect("]")
        return self._node(trees.Fields, start, tuple(fields))

    def _settings(self, start: int) -> trees.Braces:
        """{‹x = T, …›}."""
        settings: list[tuple[trees.Word, Term]] = []
        if not self._text.startswith("}", self._at):
            while not settings or self._accept(",", "a comma"):
                label = self._word("a label")
                self._expect("=")
                settings.append((label, self._term("an object")))
        self._expect("}")
        return self._node(trees.Braces, start, tuple(settings))

    def _elements(self, start: int, expected: str) -> trees.Elements:
        """{T, …}, or set{‹T, …›}."""
        items = self._terms_up_to("}", expected)
        self._expect("}")
        return self._node(trees.Elements, start, items)

    def _events(self, start: int) -> trees.Events:
        """<‹T …, …›>: simple terms may stand beside one another without commas."""
        items: list[Term] = []
        if not self._text.startswith(">", self._at):
            items += self._events_before_comma("an event or >")
            while self._accept(",", "a comma"):
                items += self._events_before_comma(ANY)
        self._expect(">")
        return self._node(trees.Events, start, tuple(items))

    def _events_before_comma(self, expected: str) -> list[Term]:
        start = self._at
        is_sign = FUNCTION.match(self._text, start) or _NOT.match(self._text, start)
        if is_sign or self._begins_product():
            return [self._term(expected)]
        found = [self._application(expected)]
        self._note_expected("an event")
        while SIMPLE.match(self._text, self._at):
            found.append(self._application("an event or >", in_brackets=False))
            self._note_expected("an event")
        if len(found) > 1:
            return found
        return [self._rest_of_term(start, self._restriction(start, found[0]))]

    def _begins_product(self) -> bool:
        """Is (x : next?"""
        if not self._text.startswith("(", self._at):
            return False
        return self._has_name_before(":", at=self._skip_space(self._at + 1))
