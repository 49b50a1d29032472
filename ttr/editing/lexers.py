"""Lexers for Pygments, which find theories and stories by `ttr` and `dlg`.

Pygments finds them by itself where this package is installed: `pygmentize -l ttr`, or
a block of code marked `ttr` in Sphinx. It comes with Rich, and is imported only here.

>>> from pygments.lexers import get_lexer_by_name
>>> get_lexer_by_name("ttr").name
'Type Theory with Records'
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from pygments import token
from pygments.lexer import Lexer

from ttr.editing.story_tokens import story_tokens
from ttr.editing.tokens import Kind, Token, theory_tokens

_AS: Mapping[Kind, token._TokenType] = {
    Kind.SPACE: token.Whitespace,
    Kind.COMMENT: token.Comment.Single,
    Kind.KEYWORD: token.Keyword,
    Kind.WORD: token.Name.Builtin,
    Kind.TYPE: token.Name.Class,
    Kind.PREDICATE: token.Name.Function,
    Kind.OBJECT: token.Name.Constant,
    Kind.RULE: token.Name.Decorator,
    Kind.LABEL: token.Name.Attribute,
    Kind.VARIABLE: token.Name.Variable,
    Kind.NAME: token.Name,
    Kind.NUMBER: token.Number,
    Kind.STRING: token.String,
    Kind.OPERATOR: token.Operator,
    Kind.PUNCTUATION: token.Punctuation,
    Kind.TITLE: token.Generic.Heading,
    Kind.ERROR: token.Error,
}


class _LexerOfTokens(Lexer):  # type: ignore[misc]
    """A lexer that gives Pygments the tokens of a text."""

    def _tokens_of(self, text: str) -> tuple[Token, ...]:
        raise NotImplementedError

    def get_tokens_unprocessed(
        self, text: str
    ) -> Iterator[tuple[int, token._TokenType, str]]:
        """Where each token begins, what it is for Pygments, and its text."""
        for one in self._tokens_of(text):
            yield one.start, _AS[one.kind], one.of(text)


class TheoryLexer(_LexerOfTokens):
    """Theories: `.ttr`."""

    name = "Type Theory with Records"
    aliases: ClassVar = ["ttr"]
    filenames: ClassVar = ["*.ttr"]

    def _tokens_of(self, text: str) -> tuple[Token, ...]:
        return theory_tokens(text)


class StoryLexer(_LexerOfTokens):
    """Stories: `.dlg`."""

    name = "TTR story"
    aliases: ClassVar = ["dlg"]
    filenames: ClassVar = ["*.dlg"]

    def _tokens_of(self, text: str) -> tuple[Token, ...]:
        return story_tokens(text)
