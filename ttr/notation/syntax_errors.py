"""What to say about a text that does not parse, in a semanticist's words."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ttr.errors import NotationError, Span, suggestion
from ttr.notation.syntax_trees import Source

_NEAR = 200
"""The number of characters before an error that are searched for what was meant."""

_LONGEST = 60
"""The number of characters of a text that an error message repeats."""

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


def syntax_error(
    wanted: Sequence[str], source: Source, start: int, length: int, at: int
) -> NotationError:
    """The error at a place in a text: what was expected, what was found, and a hint.

    The text begins at `start` in the source, and `at` is counted from there.
    """
    text = source.text[start : start + length].rstrip()
    at = min(at, len(text))
    before, after = text[:at], text[at:]
    found = _word_at_error(after)
    span = Span.of(source.name, source.text, start + at, start + at + len(found))
    found = excerpt(found) or _end(source, start + length)
    return NotationError(
        f"expected {_either(wanted)}, found {found}",
        span=span,
        hint=_hint(before[-_NEAR:], after),
    )


def _end(source: Source, end: int) -> str:
    return f"the end of the {'statement' if source.text[end:].strip() else 'text'}"


_FOUND = re.compile(r"\w+|->|[:<>=/\\|]{2}|[\"'][^\n]*|\S", re.DOTALL)


def _word_at_error(after: str) -> str:
    """The word or sign at the error; at most forty characters."""
    found = _FOUND.match(after)
    return found[0][:40] if found else ""


def excerpt(text: str) -> str:
    """The text on one line, cut if it is long, with escapes for what cannot be seen.

    >>> print(excerpt("[a,\\n b]"), excerpt("\\u202edog"))
    [a, b] '\\u202edog'
    """
    text = text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
    text = " ".join(text.split())
    return text if text.isprintable() else repr(text)


def _either(words: Sequence[str]) -> str:
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} or {words[-1]}"


# --- hints -----------------------------------------------------

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
"""Patterns of the text before and after the error, and what was probably meant."""


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
"""The words that may follow a text."""


def _misspelt(before: str, after: str) -> str:
    """A keyword like the word before the error, or like the one found there."""
    first = re.match(r"(\w+)\s+$", before)
    if first:
        return suggestion(first[1], KEYWORDS)
    found = _word_at_error(after)
    known = (words for left, words in _WORDS if re.search(left, before))
    return suggestion(found, next(known, ()))
