"""Grammars in Lark's notation, read to the productions that sentences are parsed by.

Lark reads the notation and writes out groups, repetitions and templates; nothing else
of it is used. That takes a tenth of a second for a tutor's grammar, once in a process.

Expressions are looked for by `regex`, which unlike `re` can be told how long to try.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from math import prod
from time import process_time
from types import MappingProxyType
from typing import Any, NamedTuple

import regex

BACKSLASHES = 20
"""The number of backslashes in a grammar that may follow another backslash."""


class GrammarError(ValueError):
    """A grammar that cannot be used, and why."""


class Symbol(NamedTuple):
    """What stands in a production: a rule, or a terminal and whether it is kept."""

    name: str
    is_term: bool
    filter_out: bool


@dataclass(frozen=True)
class Production:
    """One way to make a rule: its symbols, and what becomes of what they find."""

    name: str
    symbols: tuple[Symbol, ...]
    made: str | None
    only_child: bool


@dataclass(frozen=True)
class Expression:
    """A regular expression of a grammar, and what it is for."""

    what: str
    pattern: Any

    def match(self, text: str, at: int, until: float) -> Any:
        """What fits the text at a place, or None: a match, as those of `re`.

        Raises `GrammarError` where that is not found until then, in seconds of
        `process_time`: an expression may fit a text in more ways than can be tried.
        """
        left = max(0.0, until - process_time())
        try:
            return self.pattern.match(text, at, timeout=left)
        except TimeoutError:
            raise GrammarError(
                f"{self.what} takes too long to look for, as it may fit the same text "
                "in many ways"
            ) from None


class GrammarSource(NamedTuple):
    """A grammar: its productions, the regular expressions of its terminals.

    What fits one of those in `ignored` is skipped. `known_beginnings` are those that
    were found before, when the grammar was read, of terminals whose expressions are
    ones.
    """

    productions: Sequence[Production]
    terminals: Mapping[str, str]
    ignored: Sequence[str]
    known_beginnings: Mapping[str, frozenset[str] | None] = MappingProxyType({})

    def expression(self, terminal: str) -> Expression:
        """The expression of a terminal; `GrammarError` where it is none."""
        found = _expression(
            [self.terminals[terminal]],
            f"the terminal {terminal}",
            known=terminal in self.known_beginnings,
        )
        nothing = found.match("", 0, process_time() + SECONDS)
        if nothing:
            raise GrammarError(f"{found.what} may not be nothing at all")
        return found

    def beginnings(self, terminal: str) -> frozenset[str] | None:
        """The one or two signs with which a terminal can begin, in lower case.

        None where that cannot be seen from its expression: then any sign has to be
        tried. So it is where there is a mistake in the expression.
        """
        if terminal in self.known_beginnings:
            return self.known_beginnings[terminal]
        try:
            return _beginnings(self.terminals[terminal])
        except (re.error, ValueError, OverflowError, RecursionError):
            return None

    def between(self) -> Expression:
        """The expression of what is skipped; `GrammarError` where it is none."""
        return _expression(self.ignored, "what is ignored", "(?:{})*")


SECONDS = 5.0
"""How long expressions may be looked for in a sentence, in seconds of a core."""

_LONGEST = 1_000_000
"""Signs of an expression; `regex` writes repetitions out, in some 100 bytes a sign."""

_COUNTS = re.compile(r"\{(\d*),?(\d*)\}")
"""How often something is repeated, at least and at most."""


def is_expression(pattern: str) -> bool:
    """Whether it is a regular expression, for `re`, by which Lark reads grammars."""
    try:
        re.compile(pattern)
    except (re.error, ValueError, OverflowError, RecursionError):
        return False
    return True


def _expression(
    patterns: Sequence[str], what: str, as_: str = "{}", *, known: bool = False
) -> Expression:
    """One expression for several.

    `re` says first whether they are ones, if that is not `known`.
    """
    try:
        for pattern in () if known else patterns:
            re.compile(pattern)
        found = _together(patterns)
        if _length(found) <= _LONGEST:
            return Expression(what, regex.compile(as_.format(found)))
    except (re.error, regex.error, ValueError, OverflowError, RecursionError) as error:
        told = f"{what} is no regular expression: {error}"
        raise GrammarError(told) from error
    raise GrammarError(
        f"{what} has over {_LONGEST:,} signs, its repetitions written out"
    )


LATIN = 256
"""Of so many signs, those that count as the same are known by `lower`.

Of other letters some count as these in a way that only expressions know, as the sign
for kelvins does as a k.
"""


def _beginnings(pattern: str) -> frozenset[str] | None:
    r"""What a pattern fits begins with one of these, of one or two signs in lower case.

    None where it may begin with any sign, or with none at all, or with a letter beyond
    `LATIN`.

    >>> sorted(_beginnings(r"(?i:((quite |all )?wrong|colou?r)\b)"))
    ['al', 'co', 'qu', 'wr']
    >>> sorted(_beginnings(r"(?!nothing)[nsx]\w|är")), _beginnings("[^ab]c")
    (['n', 's', 'x', 'är'], None)
    """
    read = _read_beginnings(re._parser.parse(pattern))
    found = read.whole | read.open
    if "" in found:
        return None
    return frozenset(it for it in found if len(it) < AHEAD or it[0] not in found)


AHEAD = 2
"""How many signs of what is to come are looked at before an expression is tried."""

_MANY = 1000
"""Of more beginnings only the first signs are kept."""


class _Beginnings(NamedTuple):
    """How what a part of a pattern fits can begin, as far as `AHEAD` signs tell.

    It may be one of `whole` and no more, so that what follows begins after it; or it
    begins with one of `open`, and how it goes on is not known or does not matter.
    """

    whole: frozenset[str] = frozenset()
    open: frozenset[str] = frozenset()

    def either(self, other: _Beginnings) -> _Beginnings:
        """How it can begin if it may be the other as well."""
        return _Beginnings(self.whole | other.whole, self.open | other.open)

    def then(self, other: _Beginnings) -> _Beginnings:
        """How it can begin if the other follows."""
        if len(self.whole) * (len(other.whole) + len(other.open)) > _MANY:
            return _Beginnings(open=self.open | self.whole)
        both = {(a + b)[:AHEAD] for a in self.whole for b in other.whole}
        whole = frozenset(it for it in both if len(it) < AHEAD)
        ahead = {(a + b)[:AHEAD] for a in self.whole for b in other.open}
        return _Beginnings(whole, self.open | (both - whole) | ahead)


_NOTHING, _ANYTHING = _Beginnings(frozenset([""])), _Beginnings(open=frozenset([""]))


def _read_beginnings(parsed: Iterable[tuple[Any, Any]]) -> _Beginnings:
    """How what a parsed pattern fits can begin."""
    found = _NOTHING
    for op, of in parsed:
        if not found.whole:
            break
        found = found.then(_beginnings_of(str(op), of))
    return found


def _beginnings_of(op: str, of: Any) -> _Beginnings:
    match op:
        case "LITERAL" if _is_plain(of):
            return _Beginnings(frozenset([chr(of).lower()]))
        case "IN":
            return _one_sign_of(of)
        case "BRANCH":
            return reduce(_Beginnings.either, map(_read_beginnings, of[1]))
        case "SUBPATTERN":
            return _read_beginnings(of[-1])
        case "MAX_REPEAT" | "MIN_REPEAT":
            least, most, parts = of
            once = _read_beginnings(parts)
            found = once.either(once.then(once)) if most > 1 else once
            return found if least else found.either(_NOTHING)
        case "AT" | "ASSERT" | "ASSERT_NOT":
            return _NOTHING
    return _ANYTHING


def _one_sign_of(listed: Iterable[tuple[Any, Any]]) -> _Beginnings:
    """One of the signs that are listed between square brackets."""
    found: set[str] = set()
    for op, of in listed:
        match str(op):
            case "LITERAL" if _is_plain(of):
                found.add(chr(of).lower())
            case "RANGE" if of[1] < LATIN:
                found |= {chr(it).lower() for it in range(of[0], of[1] + 1)}
            case _:
                return _ANYTHING
    return _Beginnings(frozenset(found))


def _is_plain(code: int) -> bool:
    """Whether it is a sign that counts as the same only as those with its `lower`."""
    return code < LATIN or not chr(code).isalpha()


def _together(patterns: Sequence[str]) -> str:
    """One pattern for several: what can be longest first, as Lark has them."""
    if len(patterns) == 1:
        return patterns[0]
    found = sorted(patterns, key=_longest_first)
    return f"(?:{'|'.join(found)})"


def _longest_first(pattern: str) -> tuple[int, int, int]:
    least, most = re._parser.parse(pattern).getwidth()
    return -most, -least, -len(pattern)


def _length(pattern: str) -> int:
    """The signs of an expression, were all of it within each of its counts.

    >>> _length("(ab{3}){2,10}")
    390
    """
    counts = _COUNTS.findall(pattern)
    return len(pattern) * prod(max(int(it or 1) for it in both) for both in counts)


def read_grammar(text: str, starts: Sequence[str]) -> GrammarSource:
    """What can be reached from the start rules; `GrammarError` for what is no grammar.

    >>> dict(read_grammar('start: A?' + chr(10) + 'A: /a/i', ["start"]).terminals)
    {'A': '(?i:a)'}
    """
    _check_ways(text)
    _refuse_backslashes(text)
    found = _read_by_lark(text, starts)
    for name in starts:
        if not any(made.name == name for made in found.productions):
            raise GrammarError(f"the grammar has no rule {name}, with which it starts")
    return found


# --- how much it is -------------------------------------------------------------------

WAYS = 10_000
"""In how many ways all rules may be made: Lark writes each of them out."""

_OFTEN = 20
"""How often a thing with several ways never stands: two ways are a million then."""

_SIGNS = re.compile(
    r"""(?P<skip>//[^\n]*)
      | (?P<rule>^[ \t]*[?!]*(?P<called>_?[a-z][_a-z0-9]*)(?:\.-?\d+)?[ \t]*[:{])
      | (?P<other>^[ \t]*[%_A-Z])
      | (?P<item>"(?:\\.|[^"\\\n])*"i?|/(?!/)(?:\\.|[^/\\\n])*/[imslux]*|[_a-zA-Z]\w*)
      | (?P<opening>[(\[])
      | (?P<closing>[)\]])
      | (?P<perhaps>[?*])
      | (?P<times>~[ ]*(?P<least>\d{1,9})(?:[ ]*\.\.[ ]*(?P<most>\d{1,9}))?)
      | (?P<alternative>\|)
    """,
    re.VERBOSE | re.MULTILINE,
)


def _check_ways(text: str) -> None:
    """Refuses rules that can be made in too many ways, before they are written out.

    The ways of what stands in a row are multiplied: twenty words, each of which may be
    left out, are a million.
    """
    name, levels, whole = "", [_Ways()], 0
    for found in _SIGNS.finditer(text):
        match found.lastgroup:
            case "rule" | "other":
                whole += levels[0].all()
                name, levels = found["called"] or "", [_Ways()]
            case "item":
                levels[-1].add(1)
            case "opening":
                levels.append(_Ways())
            case "closing" if len(levels) > 1:
                levels[-2].add(levels.pop().all() + (found[0] == "]"))
            case "perhaps":
                levels[-1].last += 1
            case "times":
                least = int(found["least"])
                levels[-1].repeat(least, int(found["most"] or least))
            case "alternative":
                levels[-1].end()
        if name and whole + max(it.all() for it in levels[-2:]) > WAYS:
            raise GrammarError(
                f"up to the rule {name}, the rules can be made in more than {WAYS:,} "
                "ways: give their parts rules of their own"
            )


@dataclass
class _Ways:
    """The ways to make what is between two brackets, as far as it has been read."""

    before: int = 0
    row: int = 1
    last: int = 1

    def all(self) -> int:
        """How many there are."""
        return self.before + self.row * self.last

    def add(self, ways: int) -> None:
        """Goes on with something that can be made in so many ways."""
        self.row, self.last = self.row * self.last, ways

    def repeat(self, least: int, most: int) -> None:
        """What was last stands several times."""
        if self.last == 1:
            self.last = max(1, most - least + 1)
        elif most > _OFTEN:
            self.last = WAYS + 1
        else:
            self.last = sum(self.last**it for it in range(least, most + 1))

    def end(self) -> None:
        """An alternative begins."""
        self.before, self.row, self.last = self.all(), 1, 1


# --- by Lark --------------------------------------------------------------------------


def _read_by_lark(text: str, starts: Sequence[str]) -> GrammarSource:
    from lark.exceptions import LarkError, VisitError
    from lark.load_grammar import GrammarBuilder

    try:
        builder = GrammarBuilder()
        builder.load_grammar(text, "<string>")
        terminals, rules, ignored = builder.build().compile(list(starts), set())
    except VisitError as mistake:
        said = f"it has an expression that is none: {mistake.orig_exc}"
        raise GrammarError(said) from mistake
    except LarkError as mistake:
        raise GrammarError(str(mistake)) from mistake
    except TypeError as failure:  # of Lark, while it looks for words for a mistake
        raise GrammarError(_first_mistake(failure)) from failure
    except RecursionError:
        raise GrammarError("its brackets nest too deep to be read") from None
    except (ValueError, OverflowError) as mistake:
        raise GrammarError(f"it has a number that is too large: {mistake}") from mistake
    patterns = {str(it.name): it.pattern.to_regexp() for it in terminals}
    productions = [
        _production(
            str(rule.origin.name),
            tuple(
                Symbol(str(it.name), it.is_term, bool(getattr(it, "filter_out", False)))
                for it in rule.expansion
            ),
            str(rule.alias) if rule.alias else None,
            bool(rule.options.expand1),
        )
        for rule in rules
    ]
    used = {it.name for made in productions for it in made.symbols if it.is_term}
    return GrammarSource(
        productions,
        {name: pattern for name, pattern in patterns.items() if name in used},
        [patterns[name] for name in ignored],
    )


def _refuse_backslashes(text: str) -> None:
    """Refuse what Lark would read for hours: an open quote with many backslashes.

    Each of two backslashes in a row may be read alone or with the other, so that the
    ways to look for the end of the quote grow exponentially with them.
    """
    doubled = sum(len(run) - 1 for run in regex.findall(r"\\{2,}", text))
    if doubled > BACKSLASHES:
        raise GrammarError(
            f"it has {doubled} backslashes that follow another, expected at most "
            f"{BACKSLASHES}: write [\\x5c] for a backslash in an expression"
        )


def _first_mistake(failure: BaseException) -> str:
    """What Lark said at first, where an error led to others."""
    from lark.exceptions import LarkError

    first: BaseException | None = failure
    while first is not None:
        if isinstance(first, LarkError):
            failure = first
        first = first.__context__
    return str(failure)


def _production(
    name: str, symbols: tuple[Symbol, ...], alias: str | None, only_child: bool
) -> Production:
    """A rule of Lark's; its repetitions (`x*`) are turned to go from left to right."""
    if name.startswith("__") and symbols and symbols[0].name == name:
        symbols = (*symbols[1:], symbols[0])
    made = None if name.startswith("_") else alias or name
    return Production(name, symbols, made, only_child)
