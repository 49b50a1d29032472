"""Searches in a text before it is parsed: how deep it nests, where statements stand.

Each takes one pass, in time linear in the length of the text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NoReturn

from ttr.errors import NotationError, Span
from ttr.notation.syntax_errors import KEYWORDS
from ttr.notation.syntax_trees import UNNAMED, Source

DEPTH = 100
"""How deep brackets, functions, arrows and negations may nest."""

LETTER_OR_DIGIT = r"^\s\x00-/:-@\[-^`{-\x7f∧∨¬→⊑"
"""The characters of names, as the inside of [ ] in a regular expression.

These are all but spaces, the signs of ASCII and those of the notation."""

LETTER = rf"{LETTER_OR_DIGIT}0-9"
"""The characters with which a name may begin."""

_QUOTED = r"""(?P<quoted> "[^"\\\n]*(?:\\.[^"\\\n]*)*"?
                     | '[^'\\\n]*(?:\\.[^'\\\n]*)*'? | \#[^\n]* )"""

_WORDS = re.compile(
    rf""" {_QUOTED} | (?P<opening> [\[({{] ) | (?P<closing> [\])}}] ) """, re.VERBOSE
)

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f]")
"""Control characters other than tabs and line ends."""


def check_characters(source: Source) -> None:
    """Refuse a text with control characters."""
    stray = _CONTROL.search(source.text)
    if stray:
        _refuse_control(source, stray)


_IN_PYTHON = r"in a plain string Python reads \ as the start of an escape: write r'…'"


def _refuse_control(source: Source, stray: re.Match[str]) -> NoReturn:
    # A terminal that acts on the character would shift the underlining.
    shown = _CONTROL.sub(" ", source.text)
    raise NotationError(
        f"the control character {stray[0]!r} is no notation",
        span=Span.of(source.name, shown, *stray.span()),
        hint=_IN_PYTHON if source.name == UNNAMED else "",
    )


_NESTING = re.compile(
    rf""" {_QUOTED}
        | (?P<sign> /\\ | \\/ | [&|∧∨+@:=.] | <[:=] )
        | (?P<deeper> \\ | \bfun\s | -> | → )
        | (?P<denial> [~¬] )
        | (?P<opening> [\[({{<] )
        | (?P<again> \)(?=\s*\() )
        | (?P<closing> [\])}}>] )
        | (?P<comma> , ) """,
    re.VERBOSE,
)


def find_excess_depth(text: str) -> tuple[int, int] | None:
    """The place where a text first nests deeper than `DEPTH`; None if it does not.

    Functions, arrows, negations and arguments nest like brackets. `start` is the depth
    just inside the innermost bracket, `part` the depth behind the functions and arrows
    in it, and `depth` that behind negations and arguments as well.
    """
    if len(text) <= DEPTH:
        return None
    around: list[tuple[int, int, int]] = []
    start = part = depth = 0
    for found in _NESTING.finditer(text):
        match found.lastgroup:
            case "opening":
                around.append((start, part, depth))
                start = part = depth = depth + 1
            case "again" if around:
                start, part, depth = around.pop()
                depth += 1
            case "closing" if around:
                start, part, _ = around.pop()
                depth = part
            case "deeper":
                part = depth = part + 1
            case "denial":
                depth += 1
            case "sign":
                depth = part
            case "comma":
                part = depth = start
        if depth > DEPTH:
            return found.span()
    return None


_BINDING = re.compile(
    rf""" {_QUOTED}
        | (?P<opening> [\[({{<] )
        | (?P<closing> [\])}}>] )
        | (?P<comma> , )
        | (?P<sign> -> | \\/ | /\\ )
        | (?P<number> (?<![{LETTER_OR_DIGIT}])[0-9]+\.[0-9]+ )
        | (?P<function> \\ \s* λ?
            | (?<![{LETTER_OR_DIGIT}])(?: fun\s++ λ? | λ )
              (?= \s*+ [{LETTER_OR_DIGIT}]*+ \s*+ :(?!=) ) )
        | (?P<dot> \.(?![{LETTER}]) ) """,
    re.VERBOSE,
)


def with_backslashes(text: str) -> str:
    r"""The text with \ for every λ that begins a function.

    A name may begin with λ, too. So λx: begins a function only if the dot of a function
    follows within the same brackets.

    >>> print(with_backslashes("[λx : A, f = λx:A. x : (A -> A)]"))
    [λx : A, f = \x:A. x : (A -> A)]
    """
    if "λ" not in text:
        return text
    signs = list(text)
    around: list[list[int]] = [[]]
    for found in _BINDING.finditer(text):
        match found.lastgroup:
            case "opening":
                around.append([])
            case "closing" if len(around) > 1:
                around.pop()
            case "comma":
                around[-1].clear()
            case "function":
                around[-1].append(found.start())
            case "dot" if around[-1]:
                at = around[-1].pop()
                signs[at] = "\\" if signs[at] == "λ" else signs[at]
    return "".join(signs)


STARTS = re.compile(
    rf"[ \t]*(?:(?:{'|'.join(KEYWORDS)})[ \t]+[^\s:=,.)\]}}]"
    r"|\w+[ \t]*:="
    r"|\w+(?:\([^()]*\))?[ \t]*<:)"
)
"""A line that always starts a statement, whatever brackets are open before it."""


def find_statements(text: str) -> Iterator[tuple[int, int]]:
    """The statements of a theory: [start, end) of each.

    A statement continues on lines that are indented further than the first statement,
    and inside brackets. But a line that looks like a statement always starts one, so
    that a forgotten bracket spoils one statement and not the rest of the text.

    >>> list(find_statements("basic A\\nX :=\\n  [x : A]\\n"))
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
            if start >= 0 and (STARTS.match(line) or (not depth and indent <= margin)):
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
    """Keep a bracket, put a dot for a quoted name and nothing for a comment."""
    if found.lastgroup != "quoted":
        return found[0]
    return "" if found[0].startswith("#") else "."


def _code_end(line: str) -> int:
    for found in _WORDS.finditer(line):
        if found[0].startswith("#"):
            line = line[: found.start()]
    return len(line.rstrip())
