"""What is wrong with the text of a grammar, for whoever wrote it, and on which line.

Lark says it in words of its own, and often without a line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from lark.exceptions import UnexpectedToken

from kille.dialogue.grammars import GrammarError
from ttr.errors import suggestion

_DEFINITION = re.compile(r"^[ \t]*[?!]*(\w+)(?:\.-?\d+)?(?:\{[^}\n]*\})?[ \t]*:", re.M)
"""What a rule or a token begins with: its name, perhaps a priority, a colon."""

_UNKNOWN = re.compile(
    r"(?:Rule|Terminal) '(\w+)' used but not defined(?:.*rule (\w+))?"
)
_TWICE = re.compile(r"(?:Rule|Terminal) '(\w+)' defined more than once")
_NO_COLON = re.compile(r"missing colon.* line (\d+)")
_UNREAD = re.compile(r"Unexpected input at line (\d+) column (\d+)")

_SIGNS: Mapping[str, str] = {
    "_COLON": "a colon",
    "_RPAR": ")",
    "_RBRA": "]",
    "_RBRACE": "}",
    "_NL": "the end of the line",
}
"""What Lark calls the signs of its notation that are easily forgotten."""


def explain_grammar_error(error: GrammarError, text: str) -> tuple[int, str]:
    """The line of a mistake in a grammar, 1 if it is not known, and what is wrong.

    >>> from kille.dialogue.grammars import read_grammar
    >>> text = "start: greet\\ngreeet: HELLO\\nHELLO: /hello/"
    >>> try:
    ...     grammar = read_grammar(text, ["start"])
    ... except GrammarError as error:
    ...     print(explain_grammar_error(error, text))
    (1, 'there is no rule greet, which start uses: did you mean greeet?')
    """
    told = str(error).partition("\n")[0]
    if found := _UNKNOWN.search(told):
        return _explain_unknown(found[1], found[2], text)
    if found := _TWICE.search(told):
        first, *others = (n for n, name in _definitions(text) if name == found[1])
        told = f"the {_kind(found[1])} {found[1]} is defined on line {first} already"
        return next(iter(others), first), told
    if found := _NO_COLON.search(told):
        return int(found[1]), "expected a colon after the name of a rule or a token"
    if found := _UNREAD.search(told):
        line, column = int(found[1]), int(found[2])
        rest = text.splitlines()[line - 1][column - 1 :].strip()
        return line, f"{rest or 'the end of the line'} cannot stand there"
    if isinstance(error.__cause__, UnexpectedToken):
        return _explain_token(error.__cause__)
    found = re.search(r"line (\d+)", told)
    return int(found[1]) if found else 1, told


def _explain_unknown(name: str, user: str | None, text: str) -> tuple[int, str]:
    kind = _kind(name)
    known = [other for _, other in _definitions(text) if _kind(other) == kind]
    uses = (n for n, line in enumerate(text.splitlines(), 1) if _uses(line, name))
    told = f"there is no {kind} {name}" + f", which {user} uses" * bool(user)
    hint = suggestion(name, known)
    return next(uses, 1), told + f": {hint}" * bool(hint)


def _explain_token(error: UnexpectedToken) -> tuple[int, str]:
    found = str(error.token).strip() or "the end of the line"
    wanted = [_SIGNS[it] for it in sorted(error.expected) if it in _SIGNS]
    if not wanted:
        return error.line, f"{found} cannot stand there"
    return error.line, f"expected {' or '.join(wanted)}, found {found}"


def _definitions(text: str) -> Iterator[tuple[int, str]]:
    """The line and the name of each rule and each token that a text defines."""
    for found in _DEFINITION.finditer(text):
        yield text.count("\n", 0, found.start(1)) + 1, found[1]


def _kind(name: str) -> str:
    return "token" if name.isupper() else "rule"


def _uses(line: str, name: str) -> bool:
    return re.search(rf"\b{name}\b", line.partition("//")[0]) is not None
