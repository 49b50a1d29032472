r"""Vim's syntax of theories, for Vim and Neovim.

Like TextMate's grammars it is made of the words that the parser knows, and tells the
kinds of names only by how they are written.
"""

from __future__ import annotations

from collections.abc import Iterable

from ttr.editing.tokens import BEFORE_BRACKETS, OPERATORS
from ttr.notation.parser import BEFORE_NAMES
from ttr.notation.syntax_errors import KEYWORDS
from ttr.types.reserved_words import LOGICAL

_TAIL = r"in|if|only\s+if|only|up\s+to\s+relabelling|of|where|acts\s+on|hears"
"""The words that follow a term or a name."""


def vim_syntax() -> str:
    """The text of `syntax/ttr.vim`.

    >>> print(vim_syntax().splitlines()[0])
    " The syntax of theories, written by: ttr editor vim FILE
    """
    first = [word for word in KEYWORDS if word not in BEFORE_NAMES]
    functions = BEFORE_BRACKETS - {"fun"}
    operators = sorted(OPERATORS, key=len, reverse=True)
    matches = {
        "Operator": [r"\V" + _any_of(one.replace("\\", r"\\") for one in operators)],
        "Type": [r"\v<\u\w*>(\s*[:=])@!", rf"\v<({_alternatives(LOGICAL)})>"],
        "Function": [r"\v<\h\w*>\(@="],
        "Special": [rf"\v<({_alternatives(functions)})>\(@="],
        "Number": [r"\v<\d+(\.\d+)?([eE][+-]?\d+)?>"],
        "Keyword": [
            rf"\v^\s*({_alternatives(first)})>(\s+[^ \t:=,.)\]}}])@=",
            rf"\v^\s*({_alternatives(BEFORE_NAMES)})>(\s+\w)@=",
            r"\v(^\s*check\s+)@<=(not|unknown|error)>",
            rf"\v([A-Za-z0-9_\])}}\"'>,]\s+|^\s+)@<=({_TAIL})>(\s*[:=,.(\]])@!",
            r"\v<fun>(\s+\w+\s*:)@=",
        ],
        "String": [r'\v"([^"\\]|\\.)*"', r"\v'([^'\\]|\\.)*'"],
        "Comment": ["#.*$"],
    }
    lines = [
        '" The syntax of theories, written by: ttr editor vim FILE',
        'if exists("b:current_syntax") | finish | endif',
        *(
            f"syntax match ttr{kind} ~{pattern}~"
            for kind, patterns in matches.items()
            for pattern in map(_escape, patterns)
        ),
        *(f"highlight default link ttr{kind} {kind}" for kind in matches),
        'let b:current_syntax = "ttr"',
    ]
    return "\n".join(lines) + "\n"


def _escape(pattern: str) -> str:
    return pattern.replace("~", r"\~")


def _alternatives(words: Iterable[str]) -> str:
    return "|".join(sorted(words, reverse=True))


def _any_of(words: Iterable[str]) -> str:
    return r"\|".join(words)
