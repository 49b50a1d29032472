"""Every way to read a sentence by a grammar in Lark's notation.

Sentences are parsed word by word. As unknown words are allowed, almost every sentence
can be read in several ways; all of them are wanted, the simplest first, within a
millisecond or two.

Source: memoised descent that finds all parses, after Frost, Hafiz and Callaghan,
"Modular and efficient top-down parsing for ambiguous left-recursive grammars" (2007),
without the left recursion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import takewhile
from operator import itemgetter
from time import process_time
from typing import Any, NamedTuple

from kille.dialogue.grammars import (
    AHEAD,
    LATIN,
    SECONDS,
    Expression,
    GrammarError,
    GrammarSource,
    Production,
    Symbol,
    read_grammar,
)

_WAYS = 24
"""How many ways to read the same stretch of text are kept: those with fewest parts."""

MORE_SECONDS = 1.0
"""How long is looked on once the time is over, in seconds of a core."""

_MOST_WORDS = 120
"""Words; no sentence of a tutor's has more, and a longer one is not parsed."""


class Token(NamedTuple):
    """A stretch of text, and the terminal of the grammar that it is."""

    terminal: str
    text: str


class Tree(NamedTuple):
    """A part of a sentence: its rule, its children, and how many parts it has."""

    rule: str
    children: tuple[Tree | Token, ...]
    size: int


def parts(tree: Tree) -> list[Tree]:
    """The parts that a part of a sentence has."""
    return [child for child in tree.children if isinstance(child, Tree)]


def words(tree: Tree) -> list[Token]:
    """The words directly in a part, not those of its parts."""
    return [child for child in tree.children if isinstance(child, Token)]


Row = tuple[Tree | Token, ...]
Found = Mapping[int, list[Row]]
"""Where a stretch can end, and the ways to read it so far."""


class Grammar:
    """A grammar, ready to parse by.

    Raises `GrammarError` for a text that is not a grammar, and for left recursion.

    >>> g = Grammar('start: A* b' + chr(10) + 'A: "a"' + chr(10) + 'b: "b" | "b" b')
    >>> [tree.rule for tree in g.parse("aab")]
    ['start']
    >>> g.parse("aaba")
    []
    """

    def __init__(
        self,
        source: str,
        *starts: str,
        read: Callable[[str, Sequence[str]], GrammarSource] = read_grammar,
    ) -> None:
        """The grammar of a text in Lark's notation, as `read` reads it."""
        self.starts = starts or ("start",)
        self._source = read(source, self.starts)
        self._between = self._source.between()
        self._expressions: dict[str, Expression] = {}
        self._beginnings: dict[str, frozenset[str] | None] = {}
        self._terminals = list(self._source.terminals)
        self._bits = {it: 2 << number for number, it in enumerate(self._terminals)}
        self._impossible: dict[str, int] = {}
        by_name: dict[str, list[Production]] = {}
        for made in self._source.productions:
            by_name.setdefault(made.name, []).append(made)
        self._first = self._first_terminals(by_name)
        self._by_name = by_name
        self._prefixes: dict[str, _Prefix] = {}

    def parse(self, text: str, start: str = "start") -> list[Tree]:
        """Every way to read the whole text, those with the fewest parts first.

        Raises `GrammarError` if an expression takes too long to match, or if rules nest
        too deep.
        """
        if len(text.split()) > _MOST_WORDS:
            return []
        chart = _Chart(self, text)
        try:
            rows = chart.rule(start, chart.after(0)).get(len(text), [])
        except RecursionError:
            raise GrammarError("its rules nest too deep to be looked for") from None
        return [tree for row in rows for tree in row if isinstance(tree, Tree)]

    def parse_stretches(
        self, text: str, start: str, places: Iterable[int]
    ) -> dict[int, Mapping[int, list[Tree]]]:
        """Every way to read a stretch of the text that begins at one of the places.

        By where a stretch begins, and where the next word after it does. What several
        stretches have in common is parsed once.

        >>> g = Grammar('start: A+' + chr(10) + 'A: "a"' + chr(10) + '%ignore " "')
        >>> found = g.parse_stretches("a a b", "start", [0, 2, 4])
        >>> {begin: list(ends) for begin, ends in found.items()}
        {0: [2, 4], 2: [4], 4: []}
        """
        if len(text.split()) > _MOST_WORDS:
            return {}
        chart = _Chart(self, text)
        try:
            return {at: _trees_by_end(chart.rule(start, at)) for at in places}
        except RecursionError:
            raise GrammarError("its rules nest too deep to be looked for") from None

    def check_terminals(self) -> None:
        """Raise `GrammarError` for a terminal whose expression is wrong.

        Otherwise it would be raised when the terminal is first needed, in the middle of
        a dialogue.
        """
        for terminal in self._source.terminals:
            self.expression(terminal)

    def expression(self, terminal: str) -> Expression:
        """The expression of a terminal, compiled when it is first needed."""
        known = self._expressions.get(terminal)
        if known is None:
            known = self._expressions[terminal] = self._source.expression(terminal)
        return known

    def can_begin(self, terminal: str, ahead: str) -> bool:
        """Can a terminal begin so, as far as can be seen at the next `AHEAD` signs?

        Most cannot, and need no expression made for them. No sign is the end of a text.
        """
        if terminal not in self._beginnings:
            self._beginnings[terminal] = self._source.beginnings(terminal)
        known = self._beginnings[terminal]
        if known is None:
            return True
        plain = "".join(takewhile(lambda it: ord(it) < LATIN, ahead)).lower()
        if plain in known or plain[:1] in known:
            return True
        return len(plain) < len(ahead) and any(it.startswith(plain) for it in known)

    def terminal(self, number: int) -> str:
        """The name of the terminal of a number; 0 is no terminal, see `NOTHING`."""
        return self._terminals[number - 1]

    def possible(self, terminals: int, ahead: str) -> int:
        """Those of a set of terminals that can begin with these signs, as far as known.

        A set of terminals is a number: the bit of each is set that is in it.
        """
        return terminals & ~self._impossible.get(ahead, 0)

    def exclude(self, bit: int, ahead: str) -> None:
        """Keep in mind that the terminal of a bit cannot begin with these signs."""
        self._impossible[ahead] = self._impossible.get(ahead, 0) | bit

    def _first_terminals(
        self, by_name: Mapping[str, list[Production]]
    ) -> Mapping[str, int]:
        """The terminals with which each rule can begin."""
        empty = _rules_that_can_be_empty(by_name)
        own = dict.fromkeys(by_name, 0)
        for name, made in by_name.items():
            for symbol in (first for it in made for first in _firsts(it, empty)):
                own[name] |= self._bits[symbol.name] if symbol.is_term else 0
        first: dict[str, int] = {}
        for name, reached in _rules_that_begin(by_name, empty).items():
            first[name] = NOTHING if name in empty else 0
            for it in (name, *reached):
                first[name] |= own[it]
        return first

    def shared_prefixes(self, name: str) -> _Prefix:
        """What the productions of a rule begin with, each beginning once."""
        if name in self._prefixes:
            return self._prefixes[name]
        whole = _Prefix()
        for number, production in enumerate(self._by_name[name]):
            at, first = whole, self._first_of(production)
            for symbol in production.symbols:
                at = at.further.setdefault(symbol, _Prefix())
                at.first |= first
            at.made.append((number, production))
        self._prefixes[name] = whole
        return whole

    def _first_of(self, production: Production) -> int:
        """The terminals with which a production can begin."""
        found = 0
        for it in production.symbols:
            here = self._bits[it.name] if it.is_term else self._first[it.name]
            found |= here & ~NOTHING
            if not here & NOTHING:
                return found
        return found | NOTHING


@dataclass
class _Prefix:
    """What some productions of a rule begin with.

    `made` are those that end here, with their numbers in the rule, `further` what
    others go on with, and `first` the terminals with which any of them can begin.
    """

    made: list[tuple[int, Production]] = field(default_factory=list)
    further: dict[Symbol, _Prefix] = field(default_factory=dict)
    first: int = 0


NOTHING = 1
"""The bit in a set of terminals that says that none of them is needed."""


def _rules_that_can_be_empty(by_name: Mapping[str, list[Production]]) -> set[str]:
    empty: set[str] = set()
    while True:
        found = {
            name
            for name, made in by_name.items()
            if any(all(s.name in empty for s in it.symbols) for it in made)
        }
        if found == empty:
            return empty
        empty = found


def _rules_that_begin(
    by_name: Mapping[str, list[Production]], empty: set[str]
) -> Mapping[str, set[str]]:
    """The rules that each rule may begin with, also by others.

    Raises `GrammarError` for one that may begin with itself: descent would never end.
    """
    begins = {
        name: {
            it.name for made in them for it in _firsts(made, empty) if not it.is_term
        }
        for name, them in by_name.items()
    }
    found: dict[str, set[str]] = {}
    for name in begins:
        reached, ahead = set[str](), list(begins[name])
        while ahead:
            first = ahead.pop()
            if first not in reached:
                reached.add(first)
                ahead += begins[first]
        if name in reached:
            raise GrammarError(
                f"the rule {name} begins with itself, so that it would never end: "
                "write it the other way round"
            )
        found[name] = reached
    return found


def _firsts(made: Production, empty: set[str]) -> Iterator[Symbol]:
    """The symbols that a production may begin with."""
    for symbol in made.symbols:
        yield symbol
        if symbol.is_term or symbol.name not in empty:
            return


class _Chart:
    """What has been found in one text so far."""

    def __init__(self, grammar: Grammar, text: str) -> None:
        self._grammar = grammar
        self._text = text
        self._until = process_time() + SECONDS
        self._is_last_time = False
        self._rules: dict[tuple[str, int], Found] = {}
        self._terminals: dict[tuple[str, int], tuple[int, str] | None] = {}
        self._here: dict[int, int] = {}
        self._tried: dict[int, int] = {}

    def after(self, at: int) -> int:
        """Where the next word begins."""
        between = self._match(self._grammar._between, at)
        return between.end() if between else at

    def _match(self, expression: Expression, at: int) -> Any:
        """What fits the text at a place, as `Expression.match` gives it.

        The time may have gone to something else, such as collecting the garbage of a
        large process: once for each text there is a little more of it.
        """
        try:
            return expression.match(self._text, at, self._until)
        except GrammarError:
            if self._is_last_time:
                raise
        self._is_last_time = True
        self._until = process_time() + MORE_SECONDS
        return expression.match(self._text, at, self._until)

    def rule(self, name: str, at: int) -> Found:
        """The ways in which a rule finds something from here on."""
        known = self._rules.get((name, at))
        if known is None:
            known = self._rules[name, at] = self._by_rule(name, at)
        return known

    def _by_rule(self, name: str, at: int) -> Found:
        found: dict[int, list[Row]] = {}
        here = self._terminals_here(self._grammar._first[name], at)
        if not here:
            return found
        for production, ends in self._productions_here(name, at, here):
            for end, rows in ends.items():
                found.setdefault(end, []).extend(_build_trees(production, rows))
        return {end: _simplest(rows) for end, rows in found.items()}

    def _productions_here(
        self, name: str, at: int, here: int
    ) -> Iterator[tuple[Production, Found]]:
        """The productions of a rule that find something, in the order of the grammar.

        What several of them begin with is looked for once.
        """
        whole = self._grammar.shared_prefixes(name)
        nothing: Found = {at: [()]}
        ahead = [
            (prefix, self._by_symbol(symbol, at))
            for symbol, prefix in whole.further.items()
            if prefix.first & here
        ]
        found = [(*it, nothing) for it in whole.made]
        while ahead:
            prefix, so_far = ahead.pop()
            if so_far:
                found += [(*it, so_far) for it in prefix.made]
                ahead += [
                    (longer, self._extend(so_far, symbol))
                    for symbol, longer in prefix.further.items()
                ]
        for _, production, ends in sorted(found, key=itemgetter(0)):
            yield production, ends

    def _terminals_here(self, terminals: int, at: int) -> int:
        """Those of a set of terminals that are here; most productions need others."""
        here, tried = self._here.get(at, NOTHING), self._tried.get(at, NOTHING)
        ahead = self._text[at : at + AHEAD]
        left = self._grammar.possible(terminals & ~tried, ahead)
        if left:
            self._tried[at] = tried | left
        while left:
            bit = left & -left
            left ^= bit
            name = self._grammar.terminal(bit.bit_length() - 1)
            if not self._grammar.can_begin(name, ahead):
                self._grammar.exclude(bit, ahead)
            elif self._terminal(name, at) is not None:
                here |= bit
        self._here[at] = here
        return terminals & here

    def _extend(self, so_far: Found, symbol: Symbol) -> Found:
        """Where what was found can go on with a symbol, and in which ways."""
        found: dict[int, list[Row]] = {}
        for here, rows in so_far.items():
            for end, more in self._by_symbol(symbol, here).items():
                both = [(*row, *next_) for row in rows for next_ in more]
                if end in found:
                    found[end] += both
                else:
                    found[end] = both
        return {end: _simplest(rows) for end, rows in found.items()}

    def _by_symbol(self, symbol: Symbol, at: int) -> Found:
        if not symbol.is_term:
            return self.rule(symbol.name, at)
        matched = self._terminal(symbol.name, at)
        if matched is None:
            return {}
        end, text = matched
        return {end: [() if symbol.filter_out else (Token(symbol.name, text),)]}

    def _terminal(self, name: str, at: int) -> tuple[int, str] | None:
        """Where the next word begins if here is this terminal, and its text."""
        key = (name, at)
        if key not in self._terminals:
            self._terminals[key] = self._look_for(name, at)
        return self._terminals[key]

    def _look_for(self, name: str, at: int) -> tuple[int, str] | None:
        if not self._grammar.can_begin(name, self._text[at : at + AHEAD]):
            return None
        expression = self._grammar.expression(name)
        found = self._match(expression, at)
        return (self.after(found.end()), found.group()) if found else None


def _trees_by_end(found: Found) -> dict[int, list[Tree]]:
    return {
        end: [tree for row in rows for tree in row if isinstance(tree, Tree)]
        for end, rows in found.items()
    }


def _build_trees(production: Production, rows: list[Row]) -> Iterable[Row]:
    """The rows that a production makes of what it has found: trees, mostly."""
    if production.made is None:
        return rows
    if production.only_child:
        return [row if len(row) == 1 else _tree(production.made, row) for row in rows]
    return [_tree(production.made, row) for row in rows]


def _tree(rule: str, row: Row) -> Row:
    """The row of the one tree that a rule makes of a row."""
    return (Tree(rule, row, 1 + _size(row)),)


def _size(row: Row) -> int:
    return sum(part.size for part in row if isinstance(part, Tree))


def _simplest(rows: list[Row]) -> list[Row]:
    """The rows with the fewest parts, in the order of the grammar."""
    if len(rows) < 2:
        return rows
    return sorted(dict.fromkeys(rows), key=_size)[:_WAYS]
