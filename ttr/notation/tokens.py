"""The words and signs of a text, taken one by one from left to right.

Whatever could have stood at a place is noted, so that an error can list it.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from typing import NoReturn, TypeVar

from ttr.errors import NotationError
from ttr.notation.scanning import (
    DEPTH,
    LETTER,
    LETTER_OR_DIGIT,
    find_excess_depth,
    with_backslashes,
)
from ttr.notation.syntax_errors import excerpt, syntax_error
from ttr.notation.syntax_trees import Literal, Part, Source, Word

NAME = re.compile(rf"[{LETTER}][{LETTER_OR_DIGIT}]*")
"""Wider than a Python identifier, so that an error can show the whole wrong name."""

PATH = re.compile(rf"(?:\^*\.)?{NAME.pattern}(?:\.{NAME.pattern})*")
"""A name or a path; there are no spaces in a path."""

NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")

QUOTED = re.compile(
    r'"[^"\\\n]*(?:\\.[^"\\\n]*)*"' + "|" + r"'[^'\\\n]*(?:\\.[^'\\\n]*)*'"
)

_SPACE = re.compile(r"(?:\s|#[^\n]*+)*+")

_T = TypeVar("_T")
_P = TypeVar("_P", bound=Part)


class Tokens:
    """The words and signs of text[start:end] in a source.

    `_at` is where the next one begins, `_end` where the last one ended. `_expected`
    lists what may stand at a place.
    """

    def __init__(self, source: Source, start: int, end: int) -> None:
        self._source = source
        self._offset = start
        self._text = with_backslashes(source.text[start:end])
        self._length = end - start
        self._expected: dict[int, list[str]] = {}
        self._check_depth()
        self._advance(0)

    def _check_depth(self) -> None:
        deep = find_excess_depth(self._text)
        if deep:
            raise NotationError(
                f"types and objects nest at most {DEPTH} deep",
                span=self._source.span(
                    Part(self._offset + deep[0], self._offset + deep[1])
                ),
                hint="give the inner part a name of its own: Name := …",
            )

    # --- what is next ---

    def _has_name_before(self, *signs: str, at: int | None = None) -> bool:
        """Is a name next, with one of these signs after it?"""
        name = NAME.match(self._text, self._at if at is None else at)
        if name is None:
            return False
        behind = self._skip_space(name.end())
        for sign in signs:
            self._note_expected(sign, behind)
        return self._text.startswith(signs, behind)

    def _accept(self, sign: str, expected: str = "") -> bool:
        """Is this sign next? If so, take it."""
        if self._text.startswith(sign, self._at):
            self._advance(self._at + len(sign))
            return True
        if expected:
            self._note_expected(expected)
        return False

    def _accept_match(self, signs: re.Pattern[str]) -> bool:
        """Is one of these signs next? If so, take it."""
        found = signs.match(self._text, self._at)
        if found:
            self._advance(found.end())
        return found is not None

    def _accept_word(self, word: str, expected: str = "") -> bool:
        """Is this word next? If so, take it."""
        if expected:
            self._note_expected(expected)
        found = PATH.match(self._text, self._at)
        if found is None or found[0] != word:
            return False
        self._advance(found.end())
        return True

    def _expect(self, sign: str) -> None:
        if not self._accept(sign):
            self._fail(sign)

    def _expect_word(self, word: str) -> None:
        if not self._accept_word(word):
            self._fail(word)

    def _expect_end(self) -> None:
        if self._at < len(self._text):
            self._fail("the end")

    def _advance(self, end: int) -> None:
        """Go on after the word or sign that ends there, spaces and comments."""
        self._end, self._at = end, self._skip_space(end)

    def _skip_space(self, at: int) -> int:
        if "#" < self._text[at : at + 1] <= "~":  # most often there is none
            return at
        space = _SPACE.match(self._text, at)
        assert space is not None
        return space.end()

    def _node(self, kind: Callable[..., _P], start: int, *rest: object) -> _P:
        """The part of the text from `start` to the end of the last word or sign."""
        return kind(self._offset + start, self._offset + self._end, *rest)

    # --- names, numbers and quoted names ---

    def _names(self) -> tuple[Word, ...]:
        """One or more names."""
        return self._comma_separated(lambda: self._word("a name"))

    def _comma_separated(self, one: Callable[[], _T]) -> tuple[_T, ...]:
        """One or more, with commas between them."""
        found = [one()]
        while self._accept(",", "a comma"):
            found.append(one())
        return tuple(found)

    def _word(self, expected: str) -> Word:
        """A name; raises `NotationError` if it is no identifier."""
        start = self._at
        name = NAME.match(self._text, start)
        if name is None:
            self._fail(expected)
        self._advance(name.end())
        word = self._node(Word, start, name[0])
        self._check_identifier(word.text, word)
        return word

    def _check_identifier(self, text: str, place: Part) -> None:
        if text.isidentifier():
            return
        curly = set(text) & set("‘’“”")
        raise NotationError(
            f"{excerpt(text)} is no name: a name is letters, digits and _",
            span=self._source.span(place),
            hint="quotes are straight: 'a name'" if curly else "",
        )

    def _read_quoted(self) -> str:
        """The text in quotes; raises `NotationError` for an unknown escape."""
        start = self._at
        found = QUOTED.match(self._text, start)
        if found is None:
            self._fail("a quoted name")
        self._advance(found.end())
        try:
            return _unquote(found[0])
        except ValueError:
            raise NotationError(
                f"{excerpt(found[0])} has an unknown escape",
                span=self._source.span(self._node(Word, start, found[0])),
                hint=r"the escapes are \" \' \\ \n \t \r \b \f and \u with four digits",
            ) from None

    def _number(self, start: int, text: str) -> Literal:
        try:
            return self._node(Literal, start, _number(text))
        except ValueError:
            raise NotationError(
                "the number is too large",
                span=self._source.span(self._node(Word, start, text)),
            ) from None

    # --- errors ---

    def _note_expected(self, what: str, at: int | None = None) -> None:
        """Note what may stand at a place: here, if none is given."""
        self._expected.setdefault(self._at if at is None else at, []).append(what)

    def _fail(self, expected: str) -> NoReturn:
        """Raise the error that this was expected here, or what else may stand here."""
        words = dict.fromkeys((*self._expected.get(self._at, ()), expected))
        raise syntax_error(
            list(words), self._source, self._offset, self._length, self._at
        )


_SINGLE = re.compile(r"""\\.|\"""", re.DOTALL)
_DOUBLED = {"\\'": "'", '"': '\\"'}


def _unquote(text: str) -> str:
    """The text in quotes; raises `ValueError` for an unknown escape."""
    body = text[1:-1]
    if text.startswith("'"):
        body = _SINGLE.sub(lambda found: _DOUBLED.get(found[0], found[0]), body)
    return str(json.loads(f'"{body}"', strict=False))


def _number(text: str) -> int | float:
    """The number; raises `ValueError` if it is too large for Python."""
    if not set(text) & set(".eE"):
        return int(text)
    value = float(text)
    if math.isinf(value):
        raise ValueError(text)
    return value
