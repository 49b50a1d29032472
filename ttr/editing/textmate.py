"""TextMate's grammars of theories and stories, for editors that colour by these.

They are made of the same patterns as the tokens. A TextMate grammar sees one line at a
time and knows no declarations, so it tells keywords, strings, comments and numbers as
the tokens do, but the kinds of names only by how they are written.

The files `*.tmLanguage.json` beside this module are `grammar_text` of each grammar.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from typing import Any

from ttr.dialogues.stories.line_events import VERBS
from ttr.editing.story_tokens import BETWEEN, CHANCE, IN_NOTATION, MARK
from ttr.editing.tokens import BEFORE_BRACKETS, COMMENT, OPEN_QUOTE, OPERATORS
from ttr.notation.parser import BEFORE_NAMES
from ttr.notation.scanning import LETTER, LETTER_OR_DIGIT, STARTS
from ttr.notation.syntax_errors import KEYWORDS
from ttr.notation.term_parser import LEVEL
from ttr.notation.tokens import NAME, NUMBER, QUOTED
from ttr.theories.strategy_statements import COMBINING
from ttr.types.reserved_words import LOGICAL

Rule = dict[str, Any]

_END = rf"(?![{LETTER_OR_DIGIT}])(?!\.[{LETTER}])"
"""The end of a word that is not the beginning of a path."""

_AFTER_TERM = rf"(?:(?<=[{LETTER_OR_DIGIT}])|(?<=[\])}}\"'])|(?<=[^-]>))\s+"

_NEXT_STATEMENT = rf"(?=^{STARTS.pattern})"

_TAIL = r"in|if|only(?:\s+if)?|up(?:\s+to(?:\s+relabelling)?)?|of|where"
"""The keywords that follow a term."""


def _any_of(words: Iterable[str]) -> str:
    """One of the words; a longer one is tried before its beginning."""
    return "|".join(sorted(words, reverse=True))


def _match(scope: str, pattern: str) -> Rule:
    return {"name": f"{scope}.ttr", "match": pattern}


def _region(
    opening: str, closing: str, *inside: str, captures: Rule | None = None
) -> Rule:
    """What stands between brackets; an unclosed one ends where a statement starts."""
    found: Rule = {
        "begin": opening,
        "end": rf"{closing}|{_NEXT_STATEMENT}",
        "patterns": [*map(_include, inside), _include("term")],
    }
    return found | ({"beginCaptures": captures} if captures else {})


def _include(name: str) -> Rule:
    return {"include": f"#{name}"}


def _capture(*scopes: str) -> Rule:
    return {str(n): {"name": f"{it}.ttr"} for n, it in enumerate(scopes, start=1) if it}


def _groups_in(pattern: str) -> int:
    return re.compile(pattern).groups


def _statement_words() -> list[Rule]:
    """The words that begin statements, at the start of a line."""
    first = [word for word in KEYWORDS if word not in BEFORE_NAMES]
    named = _any_of(BEFORE_NAMES)
    modifiers = rf"(?:\s+(not|unknown|error){_END})?"
    keyword = "keyword.control"
    rule, game = (
        _region(
            rf"^[ \t]*({word})\s+({NAME.pattern})\s*\(",
            r"\)",
            f"in-{word}",
            captures=_capture(keyword, "entity.name.function"),
        )
        for word in ("rule", "game")
    )
    begins = [
        rf"^[ \t]*(check)(?=[ \t]+[^\s:=,.)\]}}]){modifiers}(?:\s+|$)",
        rf"^(check){_END}{modifiers}(?:\s+|$)",
        rf"^[ \t]*({_any_of(first)})(?=[ \t]+[^\s:=,.)\]}}])\s+",
        rf"^({_any_of(first)}){_END}\s*",
        rf"^[ \t]*({named})(?=[ \t]+[{LETTER_OR_DIGIT}])\s+",
    ]
    return [
        rule,
        game,
        *(
            {"match": begin, "captures": _capture(*[keyword] * _groups_in(begin))}
            for begin in begins
        ),
    ]


def _term() -> dict[str, list[Rule]]:
    """The rules for what may stand in a term."""
    before_brackets = _any_of(BEFORE_BRACKETS - {*COMBINING, "fun"})
    return {
        "comment": [_match("comment.line.number-sign", COMMENT.pattern)],
        "words": [
            {
                "name": "string.quoted.ttr",
                "match": QUOTED.pattern,
                "captures": {"0": {"patterns": [_include("escapes")]}},
            },
            _match("invalid.illegal", OPEN_QUOTE.pattern),
            _match(
                "keyword.control",
                rf"fun(?=\s+{NAME.pattern}\s*:(?!=))(?<![{LETTER_OR_DIGIT}.]fun)",
            ),
            _match("support.type", LEVEL.pattern),
            _match("support.type", rf"(?:{_any_of(LOGICAL)}){_END}(?!\s*[:=])"),
            _match("support.function", rf"(?:{before_brackets})(?=\()"),
            _match("variable.other.member", rf"(?<=\.){NAME.pattern}"),
            _match("entity.name.function", rf"{NAME.pattern}(?=\()"),
            _match("entity.name.type", rf"(?=\p{{Lu}}){NAME.pattern}(?!\s*[:=])"),
            _match("variable.other", NAME.pattern),
            _match(
                "keyword.operator",
                "|".join(map(re.escape, (*OPERATORS, "λ"))).replace(r"\-", "-"),
            ),
            _match("constant.numeric", NUMBER.pattern),
        ],
        "escapes": [_match("constant.character.escape", r"\\.")],
        "brackets": [
            _region(r"\[", r"\]"),
            _region(r"\{", r"\}"),
            _region(r"\(", r"\)"),
            _region("<", ">"),
        ],
        "term": [_include("comment"), _include("words"), _include("brackets")],
    }


def _following(words: str) -> list[Rule]:
    """These words as keywords behind a term, or at the start of a further line."""
    scopes = {"captures": _capture("keyword.control")}
    return [
        {"match": rf"{_AFTER_TERM}({words}){_END}", **scopes},
        {"match": rf"^\s+({words}){_END}", **scopes},
    ]


def theory_grammar() -> Rule:
    """The grammar of theory files."""
    heard = r"acts(?:\s+on)?|hears"
    scopes = {"captures": _capture("keyword.control")}
    return {
        "name": "Type Theory with Records",
        "scopeName": "source.ttr",
        "fileTypes": ["ttr"],
        "patterns": [_include("statements"), *_following(_TAIL), _include("term")],
        "repository": {
            name: {"patterns": rules}
            for name, rules in {
                "statements": _statement_words(),
                "in-rule": _following("in"),
                "in-game": [
                    {"match": rf",\s*({heard}){_END}", **scopes},
                    {"match": rf"^\s+({heard}){_END}", **scopes},
                ],
                **_term(),
            }.items()
        },
    }


def story_grammar() -> Rule:
    """The grammar of files of stories."""
    comment = _match("comment.line.number-sign", r"(?<=\s)#(?=\s|$).*$")
    marks = MARK.split("|")
    verbs = _any_of(word for word in VERBS if word not in IN_NOTATION.split("|"))
    chance = [
        comment,
        _match("constant.numeric", CHANCE),
        _match("keyword.operator", BETWEEN),
        _match("string.unquoted", r"\S+"),
    ]
    words = [comment, _match("string.unquoted", r"\S+")]

    def line(marked: str, patterns: list[Rule]) -> Rule:
        return {
            "begin": rf"^\s*({marked})(#(?=\s|$).*$)?",
            "end": "$",
            "beginCaptures": _capture("keyword.control", "comment.line.number-sign"),
            "patterns": patterns,
        }

    said = "|".join(mark for mark in marks if mark not in ("---", "@", "U~", "="))
    return {
        "name": "TTR story",
        "scopeName": "source.dlg",
        "fileTypes": ["dlg"],
        "patterns": [
            _match("comment.line.number-sign", r"^\s*#.*$"),
            line("---", [comment, _match("markup.heading", r"\S+")]),
            line("U~", chance),
            line(said, words),
            line(rf"@\s*(?:{IN_NOTATION})(?!\S)", [comment, _include("term")]),
            line(r"@\s*perhaps(?!\S)", chance),
            line(rf"@\s*(?:(?:{verbs})(?!\S)|\S*)", words),
            line("=", [comment, _include("term")]),
            _match("invalid.illegal", r"^\s*\S.*$"),
        ],
        "repository": {name: {"patterns": rules} for name, rules in _term().items()},
    }


GRAMMARS = {
    "ttr.tmLanguage.json": theory_grammar,
    "dlg.tmLanguage.json": story_grammar,
}
"""The files beside this module, and what each of them is made of."""


def grammar_text(grammar: Rule) -> str:
    """A grammar as the text of its file."""
    return json.dumps(grammar, indent=2) + "\n"
