"""The tokens of a file of stories (`.dlg`): what each piece of its text is.

>>> text = "U~ Greet 0.6 | Leave 0.3 # heard badly"
>>> [(str(it.kind), it.of(text)) for it in story_tokens(text) if it.of(text).strip()]
... # doctest: +NORMALIZE_WHITESPACE
[('keyword', 'U~'), ('string', 'Greet'), ('number', '0.6'), ('operator', '|'),
 ('string', 'Leave'), ('number', '0.3'), ('comment', '# heard badly')]
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from ttr.dialogues.stories.line_events import VERBS
from ttr.dialogues.stories.story_reader import COMMENT, MARKS
from ttr.editing.tokens import Kind, Token, theory_tokens

MARK = "|".join(map(re.escape, MARKS))

IN_NOTATION = "|".join(word for word in VERBS if word not in ("game", "perhaps"))
"""The words after `@` behind which the notation stands."""

CHANCE = r"(?<=\s)\d*\.?\d+(?=\s+\|\s|\s*$)"
"""The probability at the end of an alternative."""

BETWEEN = r"(?<=\s)\|(?=\s)"
"""The sign between alternatives."""

_BEGINNING = re.compile(rf"\s*({MARK})")

_VERB = re.compile(r"\s*(\S+)")

_IN_ALTERNATIVES = re.compile(
    rf"(?P<space>\s+)|(?P<chance>{CHANCE})|(?P<between>{BETWEEN})|(?P<word>\S+)"
)

_WORDS = re.compile(r"(?P<space>\s+)|(?P<word>\S+)")

_PIECES = {"chance": Kind.NUMBER, "between": Kind.OPERATOR, "space": Kind.SPACE}


def story_tokens(text: str) -> tuple[Token, ...]:
    """The tokens of a file of stories; together they are the text.

    It takes time linear in the length of the text, and no text is refused.
    """
    found: list[Token] = []
    at = 0
    for line in text.splitlines(keepends=True):
        found += _tokens_of_line(line, at)
        at += len(line)
    return tuple(token for token in found if token.start < token.end)


def _tokens_of_line(line: str, at: int) -> Iterator[Token]:
    def token(kind: Kind, start: int, end: int) -> Token:
        return Token(kind, at + start, at + end)

    first = len(line) - len(line.lstrip())
    ending = len(line.rstrip())
    mark = _BEGINNING.match(line)
    yield token(Kind.SPACE, 0, first)
    if first < ending:
        if mark is None:
            is_comment = line.startswith("#", first)
            yield token(Kind.COMMENT if is_comment else Kind.ERROR, first, ending)
        else:
            yield token(Kind.KEYWORD, first, mark.end())
            cut = COMMENT.search(f" {line[mark.end() : ending]}")
            end = mark.end() + cut.start() if cut else ending
            for inner in _tokens_of_text(mark[1], line[mark.end() : end]):
                start = at + mark.end()
                yield replace(inner, start=start + inner.start, end=start + inner.end)
            hash_sign = line.find("#", end) if cut else ending
            yield token(Kind.SPACE, end, hash_sign)
            yield token(Kind.COMMENT, hash_sign, ending)
    yield token(Kind.SPACE, max(first, ending), len(line))


def _tokens_of_text(mark: str, text: str) -> Iterator[Token]:
    """The tokens of what stands behind a mark."""
    match mark:
        case "---":
            yield from _pieces(_WORDS, text, 0, Kind.TITLE)
        case "=":
            yield from theory_tokens(text)
        case "U~":
            yield from _pieces(_IN_ALTERNATIVES, text, 0, Kind.STRING)
        case "@":
            verb = _VERB.match(text)
            if verb is None:
                yield Token(Kind.SPACE, 0, len(text))
                return
            start, end = verb.span(1)
            yield Token(Kind.SPACE, 0, start)
            yield Token(Kind.KEYWORD, start, end)
            if verb[1] in IN_NOTATION.split("|"):
                for one in theory_tokens(text[end:]):
                    yield replace(one, start=end + one.start, end=end + one.end)
            elif verb[1] == "perhaps":
                yield from _pieces(_IN_ALTERNATIVES, text, end, Kind.STRING)
            else:
                yield from _pieces(_WORDS, text, end, Kind.STRING)
        case _:
            yield from _pieces(_WORDS, text, 0, Kind.STRING)


def _pieces(
    pattern: re.Pattern[str], text: str, start: int, kind: Kind
) -> Iterator[Token]:
    for found in pattern.finditer(text, start):
        yield Token(_PIECES.get(str(found.lastgroup), kind), *found.span())
