"""The words that a pattern of the grammar stands for, when these can be counted.

The small words of a language are terminals of its grammar: `/(right|quite right)/`. To
be recognised, each way to say them must be spelled out.
"""

from __future__ import annotations

from itertools import product

Texts = tuple[str, ...]
"""Different texts, in the order of the pattern."""


class UncountablePatternError(ValueError):
    """A pattern that stands for any word, or is not of the simple kind read here."""


def spellings(pattern: str) -> Texts:
    r"""All that a pattern matches, in lower case; what may be repeated, once.

    What a pattern only looks ahead for is not part of it. Raises
    `UncountablePatternError` for what cannot be listed.

    >>> spellings(r"(seen )?from\b")
    ('seen from', 'from')
    >>> spellings("(?:(?i:good ?bye)|(?i:['’]s))")
    ('good bye', 'goodbye', "'s", '’s')
    >>> spellings(r"\w+")
    Traceback (most recent call last):
    kille.speech.pattern_expansion.UncountablePatternError: \w+: \w stands for any c...
    """
    try:
        found, at = _alternatives(pattern, 0)
        if at != len(pattern):
            raise UncountablePatternError(f"character {at + 1} is not expected")
    except (UncountablePatternError, IndexError) as error:
        raise UncountablePatternError(f"{pattern}: {error}") from None
    return tuple(dict.fromkeys(text.lower() for text in found))


def _alternatives(pattern: str, at: int) -> tuple[Texts, int]:
    """What stands between bars, up to the end of the group."""
    found, at = _sequence(pattern, at)
    while pattern[at : at + 1] == "|":
        more, at = _sequence(pattern, at + 1)
        found += more
    return found, at


def _sequence(pattern: str, at: int) -> tuple[Texts, int]:
    """What stands side by side, each with its `?` or `+`."""
    found: Texts = ("",)
    while at < len(pattern) and pattern[at] not in "|)":
        piece, at = _piece(pattern, at)
        match pattern[at : at + 1]:
            case "?":
                piece, at = (*piece, ""), at + 1
            case "+":
                at += 1
            case "*" | "{":
                raise UncountablePatternError(f"{pattern[at]} may go on for ever")
        found = tuple(a + b for a, b in product(found, piece))
    return found, at


def _piece(pattern: str, at: int) -> tuple[Texts, int]:
    """A character, a choice of them, or a group."""
    match pattern[at]:
        case "(":
            return _group(pattern, at + 1)
        case "[":
            end = pattern.index("]", at)
            if pattern[at + 1] == "^":
                raise UncountablePatternError("[^ stands for nearly any character")
            return tuple(pattern[at + 1 : end]), end + 1
        case "\\":
            return _escaped_character(pattern, at + 1)
        case ".":
            raise UncountablePatternError(". stands for any character")
    return (pattern[at],), at + 1


def _escaped_character(pattern: str, at: int) -> tuple[Texts, int]:
    if pattern[at] == "b":
        return ("",), at + 1
    if pattern[at].isalpha():
        raise UncountablePatternError(f"\\{pattern[at]} stands for any character")
    return (pattern[at],), at + 1


def _group(pattern: str, at: int) -> tuple[Texts, int]:
    """What stands in brackets; nothing, where it is only looked for."""
    inside = at
    ahead = pattern.startswith(("?=", "?!", "?<"), at)
    if pattern[at] == "?":
        inside = at + 3 if pattern.startswith("?<", at) else at + 2
        if not ahead:
            inside = pattern.index(":", at) + 1
    found, end = _alternatives(pattern, inside)
    if pattern[end] != ")":
        raise UncountablePatternError(f"character {end + 1} is not expected")
    return (("",) if ahead else found), end + 1
