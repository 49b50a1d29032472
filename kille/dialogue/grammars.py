"""Grammars in Lark's notation, read to the productions that sentences are parsed by.

What our grammars are made of - rules, groups, repetitions, aliases, terminals that are
regular expressions - is read here, in a tenth of the time. For anything else, and for
every mistake, Lark is asked. Law: where both can read a grammar, they find the same.

Expressions are looked for by `regex`, which unlike `re` can be told how long to try.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod
from time import process_time
from typing import Any, NamedTuple, TypeAlias

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


class Source(NamedTuple):
    """A grammar: its productions, the regular expressions of its terminals.

    A terminal is any of several, the first that fits; `ignored` are skipped.
    """

    productions: Sequence[Production]
    terminals: Mapping[str, Sequence[str]]
    ignored: Sequence[str]

    def expression(self, terminal: str) -> Expression:
        """The expression of a terminal; `GrammarError` where it is none."""
        found = _expression(self.terminals[terminal], f"the terminal {terminal}")
        nothing = found.match("", 0, process_time() + SECONDS)
        if nothing:
            raise GrammarError(f"{found.what} may not be nothing at all")
        return found

    def initials(self, terminal: str) -> str | None:
        """The ASCII letters with which a terminal can begin, in lower case.

        None where that cannot be seen at once: then any sign has to be tried.
        """
        found = [_initials(pattern) for pattern in self.terminals[terminal]]
        return None if None in found else "".join(map(str, found))

    def between(self) -> Expression:
        """The expression of what is skipped; `GrammarError` where it is none."""
        return _expression(self.ignored, "what is ignored", "(?:{})*")


SECONDS = 5.0
"""How long expressions may be looked for in a sentence, in seconds of a core."""

_LONGEST = 1_000_000
"""Signs of an expression; `regex` writes repetitions out, in some 100 bytes a sign."""

_COUNTS = re.compile(r"\{(\d*),?(\d*)\}")
"""How often something is repeated, at least and at most."""


def _expression(patterns: Sequence[str], what: str, as_: str = "{}") -> Expression:
    """One expression for several.

    `re` says first whether they are ones, since Lark reads grammars by it.
    """
    try:
        for pattern in patterns:
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


_WORDS = re.compile(r"\(\?i:([a-z ()|?*+]+)\)")
"""Words, some of which may be left out or repeated, in small letters or capitals."""

_FIRST = re.compile("(?<![a-z ])[a-z ]")
"""A sign with which such words can begin: none has to stand before it."""


def _initials(pattern: str) -> str | None:
    r"""The signs with which what a pattern fits can begin, at least these.

    >>> _initials(r"(?i:((quite |all )?wrong|colou?r)\b)"), _initials("[ab]c")
    ('qawcr', None)
    """
    words = _WORDS.fullmatch(pattern.replace("\\b", ""))
    return "".join(_FIRST.findall(words[1])) if words else None


def _length(pattern: str) -> int:
    """The signs of an expression, were all of it within each of its counts.

    >>> _length("(ab{3}){2,10}")
    390
    """
    counts = _COUNTS.findall(pattern)
    return len(pattern) * prod(max(int(it or 1) for it in both) for both in counts)


def read(text: str, starts: Sequence[str]) -> Source:
    """What can be reached from the start rules; `GrammarError` for what is no grammar.

    >>> read('start: A?' + chr(10) + 'A: /a/i', ["start"]).terminals
    {'A': ['(?i:a)']}
    """
    _check_ways(text)
    found = plainly(text, starts) or by_lark(text, starts)
    for name in starts:
        if not any(made.name == name for made in found.productions):
            raise GrammarError(f"the grammar has no rule {name}, with which it starts")
    return found


# --- how much it is -------------------------------------------------------------------

WAYS = 10_000
"""In how many ways all rules may be made: each is written out, here and by Lark."""

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


def by_lark(text: str, starts: Sequence[str]) -> Source:
    """The grammar as Lark reads it."""
    from lark import Lark
    from lark.exceptions import LarkError

    _refuse_backslashes(text)
    try:
        found = Lark(text, parser=None, lexer="basic", start=list(starts))
    except LarkError as mistake:
        raise GrammarError(str(mistake)) from mistake
    except TypeError as failure:  # of Lark, while it looks for words for a mistake
        raise GrammarError(_first_mistake(failure)) from failure
    except RecursionError:
        raise GrammarError("its brackets nest too deep to be read") from None
    except (ValueError, OverflowError) as mistake:
        raise GrammarError(f"it has a number that is too large: {mistake}") from mistake
    patterns = {it.name: [it.pattern.to_regexp()] for it in found.terminals}
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
        for rule in found.rules
    ]
    ignored = [it for name in found.ignore_tokens for it in patterns[name]]
    return Source(productions, patterns, ignored)


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


# --- by ourselves ---------------------------------------------------------------------

_TOKEN = re.compile(
    r"""(?P<skip>[ \t\r]+|//[^\n]*)
      | (?P<regexp>/(?!/)(?:\\.|[^/\\\n])*/[imslux]*)
      | (?P<name>(?:_?[a-z][_a-z0-9]*|_?[A-Z][_A-Z0-9]*)(?!\w))
      | (?P<times>~[ ]*(?P<least>\d{1,9})(?:[ ]*\.\.[ ]*(?P<most>\d{1,9}))?(?!\d))
      | (?P<mark>->|[|():*+]|[?](?![a-z_]))
      | (?P<ignore>%ignore\b)
      | (?P<end>\n\s*)
    """,
    re.VERBOSE,
)

_REGEXP = re.compile(r"/(.*)/([a-z]*)", re.DOTALL)


class _NotPlain(Exception):
    """What Lark has to be asked about."""


class _Token(NamedTuple):
    kind: str
    text: str
    times: tuple[int, int] = (1, 1)


Way: TypeAlias = tuple[Symbol, ...]
Ways: TypeAlias = tuple[Way, ...]
"""The different ways to make something, in the order in which Lark has them."""


def plainly(text: str, starts: Sequence[str]) -> Source | None:
    """The grammar as it is read here, or None where Lark has to be asked.

    >>> plainly("start: (", ["start"]), plainly('start: "a"', ["start"])
    (None, None)
    """
    try:
        return _Reading(_tokens(text)).source(starts)
    except (_NotPlain, RecursionError):
        return None


def _tokens(text: str) -> Iterator[_Token]:
    """The tokens; the end of a line counts where the next line goes on with no `|`."""
    at, ended = 0, False
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            raise _NotPlain
        at, kind = found.end(), str(found.lastgroup)
        if kind == "skip":
            continue
        if kind == "end":
            ended = True
            continue
        token = found.group()
        if ended and token != "|":
            yield _Token("end", "")
        ended = False
        if found["times"]:
            least, most = found["least"], found["most"]
            yield _Token("times", token, (int(least), int(most or least)))
        else:
            yield _Token("mark" if kind == "mark" else kind, token)
    yield _Token("end", "")
    yield _Token("stop", "")


class _Reading:
    """Reads the tokens of a grammar, definition by definition."""

    def __init__(self, tokens: Iterable[_Token]) -> None:
        self._tokens = list(tokens)
        self._at = 0
        self._rules: dict[str, int] = {}
        self._regexps: dict[str, list[str]] = {}
        self._ignored: list[str] = []
        self._found: list[Production] = []
        self._repeated: dict[Ways, Symbol] = {}
        self._used: list[str] = []

    def source(self, starts: Sequence[str]) -> Source:
        """All that can be reached; each rule is read when something needs it."""
        self._definitions()
        waiting, known = list(starts), set(starts)
        while waiting:
            name = waiting.pop()
            self._used = []
            self._rule(name)
            new = [it for it in dict.fromkeys(self._used) if it not in known]
            known.update(new)
            waiting += (it for it in new if it not in self._regexps)
        terminals = {k: some for k, some in self._regexps.items() if k in known}
        return Source(self._found, terminals, self._ignored)

    # --- what is defined ---

    def _definitions(self) -> None:
        while self._next().kind != "stop":
            token = self._take()
            if token.kind == "end":
                continue
            if token.kind == "ignore":
                self._ignored += self._alternatives()
                continue
            self._expect(":")
            name = token.text
            if token.kind != "name" or name in self._rules or name in self._regexps:
                raise _NotPlain
            if name.lower() != name:
                self._regexps[name] = self._alternatives()
                continue
            self._rules[name] = self._at
            while self._next().kind != "end":
                self._at += 1

    def _alternatives(self) -> list[str]:
        """Regular expressions, one or the other."""
        found = [_pattern(self._take("regexp").text)]
        while self._next().text == "|":
            self._at += 1
            found.append(_pattern(self._take("regexp").text))
        return found

    # --- rules ---

    def _rule(self, name: str) -> None:
        if name not in self._rules:
            raise _NotPlain
        self._at = self._rules[name]
        made: dict[Way, str | None] = {}
        for way, alias in self._aliased():
            if way in made or (alias and name.startswith("_")):
                raise _NotPlain
            made[way] = alias
        if self._next().kind != "end":
            raise _NotPlain
        self._found += (_production(name, way, to, False) for way, to in made.items())

    def _aliased(self) -> Iterator[tuple[Way, str | None]]:
        seen: set[tuple[Way, str | None]] = set()
        while True:
            ways, alias = self._expansion(), None
            if self._next().text == "->":
                self._at += 1
                alias = self._take("name").text
            for way in ways:
                if (way, alias) not in seen:
                    seen.add((way, alias))
                    yield way, alias
            if self._next().text != "|":
                return
            self._at += 1

    def _group(self) -> Ways:
        ways = list(self._expansion())
        while self._next().text == "|":
            self._at += 1
            ways += self._expansion()
        self._expect(")")
        return tuple(dict.fromkeys(ways))

    def _expansion(self) -> Ways:
        """The ways to make what stands in a row."""
        row: list[Ways] = []
        while self._next().kind == "name" or self._next().text == "(":
            row.append(self._counted(self._one()))
        if len(row) == 1:
            return row[0]
        ways = (sum(way, ()) for way in product(*row))
        return tuple(dict.fromkeys(ways))

    def _one(self) -> Ways:
        token = self._take()
        if token.text == "(":
            return self._group()
        name = token.text
        is_term = name.lower() != name
        if name not in self._regexps and name not in self._rules:
            raise _NotPlain
        self._used.append(name)
        return ((Symbol(name, is_term, is_term and name.startswith("_")),),)

    def _counted(self, ways: Ways) -> Ways:
        """What stands once, perhaps, several times."""
        token = self._next()
        if token.kind == "times":
            self._at += 1
            least, most = token.times
            if not least <= most <= _MOST:
                raise _NotPlain
            rows = (product(ways, repeat=n) for n in range(least, most + 1))
            return tuple(dict.fromkeys(sum(way, ()) for row in rows for way in row))
        if token.text in ("?", "*", "+"):
            self._at += 1
            if token.text != "?":
                ways = ((self._several(ways),),)
            return ways if token.text == "+" else tuple(dict.fromkeys((*ways, ())))
        return ways

    def _several(self, ways: Ways) -> Symbol:
        """The rule of one or more of something, made for it."""
        if () in ways:
            raise _NotPlain
        if ways not in self._repeated:
            symbol = Symbol(f"__several_{len(self._repeated)}", False, False)
            self._repeated[ways] = symbol
            for way in (*ways, *((symbol, *way) for way in ways)):
                self._found.append(_production(symbol.name, way, None, False))
        return self._repeated[ways]

    # --- tokens ---

    def _next(self) -> _Token:
        return self._tokens[self._at]

    def _take(self, kind: str = "") -> _Token:
        token = self._tokens[self._at]
        if token.kind == "stop" or (kind and token.kind != kind):
            raise _NotPlain
        self._at += 1
        return token

    def _expect(self, text: str) -> None:
        if self._take().text != text:
            raise _NotPlain


_MOST = 50
"""Up to how many times Lark writes a repetition out."""


def _together(patterns: Sequence[str]) -> str:
    """One pattern for several: what can be longest first, as Lark has them."""
    if len(patterns) == 1:
        return patterns[0]
    found = sorted(patterns, key=_longest_first)
    return f"(?:{'|'.join(found)})"


def _longest_first(pattern: str) -> tuple[int, int, int]:
    least, most = re._parser.parse(pattern).getwidth()
    return -most, -least, -len(pattern)


def _pattern(regexp: str) -> str:
    """A regular expression of the grammar as one of Python's."""
    found = _REGEXP.fullmatch(regexp)
    assert found is not None
    pattern, flags = found.groups()
    for flag in flags:
        pattern = f"(?{flag}:{pattern})"
    return pattern
