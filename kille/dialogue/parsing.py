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
from time import process_time
from typing import NamedTuple

from kille.dialogue.grammars import (
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
        self._initials: dict[str, str | None] = {}
        self._productions: dict[str, list[Production]] = {}
        for made in self._source.productions:
            self._productions.setdefault(made.name, []).append(made)
        self._refuse_left_recursion()

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

    def can_begin(self, terminal: str, letter: str) -> bool:
        """Can a terminal begin with this sign, as far as can be seen at once?

        Most cannot, and need no expression made for them. Of letters other than those
        of ASCII some count as the same in a way that only expressions know.
        """
        if terminal not in self._initials:
            self._initials[terminal] = self._source.initials(terminal)
        initials = self._initials[terminal]
        ascii_letter = letter.isascii() and letter.isalpha()
        return initials is None or not ascii_letter or letter.lower() in initials

    def _refuse_left_recursion(self) -> None:
        """Raise for a rule that may begin with itself: descent would never end."""
        empty = self._can_be_empty()
        begins = {
            name: {first for it in made for first in _firsts(it, empty)}
            for name, made in self._productions.items()
        }
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

    def _can_be_empty(self) -> set[str]:
        empty: set[str] = set()
        while True:
            found = {
                name
                for name, made in self._productions.items()
                if any(all(s.name in empty for s in it.symbols) for it in made)
            }
            if found == empty:
                return empty
            empty = found


def _firsts(made: Production, empty: set[str]) -> Iterator[str]:
    """The rules that a production may begin with."""
    for symbol in made.symbols:
        if symbol.is_term:
            return
        yield str(symbol.name)
        if symbol.name not in empty:
            return


class _Chart:
    """What has been found in one text so far."""

    def __init__(self, grammar: Grammar, text: str) -> None:
        self._grammar = grammar
        self._text = text
        self._until = process_time() + SECONDS
        self._rules: dict[tuple[str, int], Found] = {}
        self._terminals: dict[tuple[str, int], tuple[int, str] | None] = {}

    def after(self, at: int) -> int:
        """Where the next word begins."""
        between = self._grammar._between.match(self._text, at, self._until)
        return between.end() if between else at

    def rule(self, name: str, at: int) -> Found:
        """The ways in which a rule finds something from here on."""
        known = self._rules.get((name, at))
        if known is None:
            known = self._rules[name, at] = self._by_rule(name, at)
        return known

    def _by_rule(self, name: str, at: int) -> Found:
        found: dict[int, list[Row]] = {}
        for production in self._grammar._productions[name]:
            if not self._may_begin(production, at):
                continue
            for end, rows in self._by_production(production, at).items():
                found.setdefault(end, []).extend(_build_trees(production, rows))
        return {end: _simplest(rows) for end, rows in found.items()}

    def _may_begin(self, production: Production, at: int) -> bool:
        """Whether what a production begins with is here; most are ruled out by that."""
        if not production.symbols:
            return True
        first = production.symbols[0]
        if first.is_term:
            return self._terminal(first.name, at) is not None
        return bool(self.rule(first.name, at))

    def _by_production(self, production: Production, at: int) -> Found:
        so_far: Found = {at: [()]}
        for symbol in production.symbols:
            further: dict[int, list[Row]] = {}
            for here, rows in so_far.items():
                for end, more in self._by_symbol(symbol, here).items():
                    both = [(*row, *next_) for row in rows for next_ in more]
                    further.setdefault(end, []).extend(both)
            if not further:
                return {}
            so_far = {end: _simplest(rows) for end, rows in further.items()}
        return so_far

    def _by_symbol(self, symbol: Symbol, at: int) -> Found:
        if not symbol.is_term:
            return self.rule(symbol.name, at)
        matched = self._terminal(symbol.name, at)
        if matched is None:
            return {}
        end, text = matched
        kept = not symbol.filter_out
        return {end: [(Token(symbol.name, text),) if kept else ()]}

    def _terminal(self, name: str, at: int) -> tuple[int, str] | None:
        """Where the next word begins if here is this terminal, and its text."""
        key = (name, at)
        if key not in self._terminals:
            self._terminals[key] = self._look_for(name, at)
        return self._terminals[key]

    def _look_for(self, name: str, at: int) -> tuple[int, str] | None:
        if not self._grammar.can_begin(name, self._text[at : at + 1]):
            return None
        expression = self._grammar.expression(name)
        found = expression.match(self._text, at, self._until)
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
