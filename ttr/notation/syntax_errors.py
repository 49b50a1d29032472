"""What to say of a text that the grammar does not take, in a semanticist's words."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ttr.errors import NotationError, Span, suggestion
from ttr.notation.syntax_trees import Source

if TYPE_CHECKING:
    from lark.exceptions import UnexpectedInput

__all__ = ["KEYWORDS", "explained", "shown", "stopped"]

NEAR = 200
"""How much of the text before a failure is looked at for what was meant."""

LONGEST = 60
"""How many characters of a text an error repeats."""

KEYWORDS = (
    "basic",
    "check",
    "game",
    "given",
    "import",
    "object",
    "open",
    "pred",
    "rule",
    "strategy",
)
"""The words that begin a statement."""


def explained(
    error: UnexpectedInput, source: Source, start: int, end: int, wanted: frozenset[str]
) -> NotationError:
    """The parser's failure in text[start:end]: where, expected, found, a way out.

    `wanted` are the grammar's names of the signs it could have gone on with.
    """
    text = source.text[start:end].rstrip()
    at = stopped(error, text)
    before, after = text[:at], text[at:]
    found = _found(after)
    span = Span.of(source.name, source.text, start + at, start + at + len(found))
    found = shown(found)
    near = before[-NEAR:]
    return NotationError(
        f"expected {_expected(wanted, before)}, found {found or _end(source, end)}",
        span=span,
        hint=_hint(near, after),
    )


def _end(source: Source, end: int) -> str:
    return f"the end of the {'statement' if source.text[end:].strip() else 'text'}"


def stopped(error: UnexpectedInput, text: str) -> int:
    """Where in the text the parser failed: at most at its end."""
    token = getattr(error, "token", None)
    if getattr(token, "type", "") == "$END":
        return len(text)
    return min(error.pos_in_stream or 0, len(text))


_FOUND = re.compile(r"\w+|->|[:<>=/\\|]{2}|[\"'][^\n]*|\S", re.DOTALL)


def _found(after: str) -> str:
    """The word or sign where reading ended; at most forty letters."""
    found = _FOUND.match(after)
    return found[0][:40] if found else ""


def shown(text: str) -> str:
    """The text on one line, cut where it is long; what cannot be seen as escapes.

    >>> print(shown("[a,\\n b]"), shown("\\u202edog"))
    [a, b] '\\u202edog'
    """
    text = text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
    text = " ".join(text.split())
    return text if text.isprintable() else repr(text)


# --- what was expected ---------------------------------------------------------------

_SIGNS = {
    "COLON": ":",
    "EQUAL": "=",
    "_DEFINED": ":=",
    "_BELOW": "<:",
    "_SUBTYPE": "<=",
    "IN": "in",
    "COMMA": "a comma",
    "RSQB": "]",
    "RPAR": ")",
    "RBRACE": "}",
    "MORETHAN": ">",
    "_ARROW": "->",
    "_DOT": "a dot and the body",
    "LPAR": "(",
    "LSQB": "[",
    "_OF": "of",
    "_WHERE": "where",
    "_ACTS": "acts on",
    "_HEARS": "hears",
    "_ON": "on",
    "STRING": "a quoted name",
    "$END": "the end",
}
"""The words for the grammar's signs, in the order in which they are listed."""

_TERM = "NUMBER"
"""A sign that may stand only where a type or object begins."""

_OPERATOR = "_AND"
"""A sign that may stand only where a type or object ends."""

_AFTER = (
    (r"(?s)^(strategy|game)\b.*:=$", "a rule or a strategy"),
    (r"(?s)^game\b.*\bacts\s+on$", "a path"),
    (r"(?s)^game\b.*\bhears(\s[^:]*,)?$", "a type"),
    (r"(^|[^\w])(<:|<=|⊑|/\\|&|∧|\\/|\||∨|~|¬|->|→)$", "a type"),
    (r":=$", "a type or an object"),
    (r":$", "a type"),
    (r"(=|@)$", "an object"),
    (r"\bin$", "an interval [lo, hi]"),
    (r"\.$", "the body of the function"),
    (r"\+$", "a list or a string of events"),
    (r"\{$", "a setting x = a, an object or }"),
    (r"\w\($", "an argument or )"),
    (r"\[$", "a field x : T, an object or ]"),
)


def _expected(wanted: frozenset[str], before: str) -> str:
    """What the parser would have gone on with, in words."""
    head = before[-NEAR:].rstrip()
    if _TERM in wanted and "MORETHAN" in wanted:
        return "an event or >"
    if _TERM in wanted:
        words = (said for sign, said in _AFTER if re.search(sign, head))
        return next(words, "a type or an object")
    if re.search(r"\\$|λ$", head):
        return "a variable"
    names = ["a label" if _inside(before, "[{") else "a name"] * ("NAME" in wanted)
    signs = [word for sign, word in _SIGNS.items() if sign in wanted]
    if _OPERATOR in wanted:
        signs = [word for word in signs if word != "->"]
    if "_WHERE" in wanted:
        signs = [word for word in signs if word != _SIGNS["STRING"]]
    if len(signs) > 1:
        signs = [word for word in signs if word != "("]
    return _either(names + signs) or "the end"


def _inside(before: str, brackets: str) -> bool:
    """Whether the innermost bracket still open is one of these."""
    opened: list[str] = []
    for sign in re.findall(r"[\[({\])}]", before):
        if sign in "[({":
            opened.append(sign)
        elif opened:
            opened.pop()
    return bool(opened) and opened[-1] in brackets


def _either(words: list[str]) -> str:
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} or {words[-1]}"


# --- what is written another way -----------------------------------------------------

_DOTTED = r"a function is written \x:T. body, with a space after the dot"

_RULE = "a rule is written rule name(s : S, e : E) := T"
_PARTS = "between the brackets and := stand a 'text', of kind and where [x = a : T]"
_STRATEGY = "a strategy is written strategy name := first(a, b)"
_GAME = "a game is written game name({x = a} : S) := strategy"

_HINTS = (
    (r"^rule\s*\([^()]*$", r":", _RULE),
    (r"^rule\s+\w+\s*$", r"", _RULE),
    (r"^rule\s+\w+\s*\((\s*\w+\s*:[^()]*,)?\s*\w*\s*$", r"", _RULE),
    (r"\bwhere\s*$", r"", "what is bound stands in brackets: where [x = s.y : T]"),
    (r"(?s)^rule\b.*\)\s*$", r"=|->|→|:(?!=)|\[|\{", _RULE),
    (r"(?s)^rule\b.*[)\]\w'\"]\s+$", r"(of|where)\b|['\"]", _PARTS),
    (r"^strategy\s+\w*\s*$", r"", _STRATEGY),
    (r"^game\s*\([^()]*$", r":", _GAME),
    (r"^game\s+\w+\s*$", r"", _GAME),
    (r"(?s)^game\b.*\bhears\b.*,\s*acts\s*$", r"on\b", "acts on stands before hears"),
    (r"(?s)^game\s+\w+\s*\(.*[^,\s]\s*$", r"acts\b", "a comma stands before acts on"),
    (r"(?s)^game\s+\w+\s*\(.*[^,\s]\s*$", r"hears\b", "a comma stands before hears"),
    (r"^game\s+\w+\s*\([^:]*$", r"\)", _GAME),
    (r"(?s)^game\b.*\)\s*$", r"=|->|→", _GAME),
    (r"(\\|\bfun\s)\s*\w+\s*:[^:]*[^\W\d]\.\w[^:]*$", r"", _DOTTED),
    (r"(\\|\bfun\s|λ)\s*\w*\s*$", r"[:.\w](?!=)", _DOTTED),
    (r"(\\|\bfun\s)\s*\w+\s*:[^.]*$", r"\.\w", _DOTTED),
    (r"<\w+ [^<>]*$", r"", "an object that prints as <ndarray 3> does not read back"),
    (r"\bset\s+$", r"\{", "a set is written {a, b}, the empty one set{}"),
    (r"", r"\^+\s+\.", "a path has no spaces in it: ^.x"),
    (r"\b(Type|RecType)\s*$", r"\^", "a level of types is written Type^1 to Type^999"),
    (r":$", r"=", "a field is written x : T, a manifest field x = a : T"),
    (r"\[[^\[\]]*:[^\[\],]*$", r"=", "a manifest field is written [x = a : T]"),
    (r"=[^:]*$", r"[,\]]", "a manifest field has a type as well: [x = a : T]"),
    (r"\{[^\[\]{}]*$", r":", "a record is written {x = a}, a record type [x : T]"),
    (r"^\w+\s*$", r"=", "a definition is written Name := T"),
    (r"^import\s+$", r"\w", 'a file is named in quotes: import "kennel.ttr"'),
    (r"^check\b.*\s$", r"<", "subtyping is written S <= T"),
    (r"^check\b.*=$", r">", "subtyping is written S <= T"),
    (r"^check\b.*=$", r"=", "that two are the same is written S = T"),
    (
        r"^[^\[({\\λ]*$",
        r":(?!=)",
        "to start from a judgement write given a : T; to ask for it, check a : T",
    ),
    (r"^[^\[({]*$", r"<=", "an axiom is written S <: T; to ask for it, check S <= T"),
    (r"([/\\&|∧∨~¬+@]|->|→)\s*$", r"\\|λ|fun\b", r"write brackets: (\x:T. body)"),
    (r"\)\s*$", r":=", r"a function is defined as f := \x:T. body"),
    (r"", r"/(?!\\)|\\(?!/)", r"a meet is written S /\ T; in Python write r'…'"),
    (r"", r"[\"']", "the quote does not close on this line"),
    (r"@\s*[^\s@]+\s*$", r"@", "write brackets: (T@a)@b"),
)
"""What may have been meant: before, after, the way to write it."""


def _hint(before: str, after: str) -> str:
    for left, right, hint in _HINTS:
        if re.match(right, after) and re.search(left, before):
            return hint
    return _misspelt(before, after)


_WORDS = (
    (r"(?s)^rule\b.*[)\]'\"]\s*$", ("of", "where")),
    (r"(?s)^game\b.*,\s*$", ("acts", "hears")),
    (r"\bacts\s*$", ("on",)),
)
"""What words stand behind what."""


def _misspelt(before: str, after: str) -> str:
    """The word that may have been meant by the one before, or by the one found."""
    first = re.match(r"(\w+)\s+$", before)
    if first:
        return suggestion(first[1], KEYWORDS)
    found = _found(after)
    known = (words for left, words in _WORDS if re.search(left, before))
    return suggestion(found, next(known, ()))
