"""What somebody may have meant to type: the nearest known word, or known sentence.

It is only ever offered. So a word counts as near if it is one slip away, of the four
that make most mistakes of typing: a letter too many, too few, another one, or two
changed about. Of short words only those slips count that hardly ever make another
word: who teaches "cap" and knows "cup" is not asked.

Source: Damerau, "A technique for computer detection and correction of spelling
errors" (1964).
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable

_ALIKE = 0.72
"""Share of characters in common, in their order, that makes two sentences alike."""

_LONG = 5
"""Letters from which on a letter too many or too few is more likely a slip."""

_LONGER = 7
"""Letters from which on another letter is more likely a slip than another word."""


def nearest(form: str, known: Iterable[str]) -> str | None:
    """The known word that the form is a slip of, if there is exactly one.

    >>> nearest("cupp", ["cup", "cap", "book"]), nearest("teddy baer", ["teddy bear"])
    ('cup', 'teddy bear')
    >>> nearest("cap", ["cup"]), nearest("cup", ["cup"]), nearest("xyz", ["cup"])
    (None, None, None)
    """
    several = dict.fromkeys(known)
    if form in several:
        return None
    near = [word for word in several if is_slip(form, word)]
    return near[0] if len(near) == 1 else None


def is_slip(form: str, word: str) -> bool:
    """Whether a form is likelier a slip of a word than a word of its own."""
    match slip(form, word):
        case "changed about" | "doubled":
            return min(len(form), len(word)) > 2
        case "too many" | "too few":
            return min(len(form), len(word)) >= _LONG
        case "another":
            return len(word) >= _LONGER
    return False


def slip(form: str, word: str) -> str | None:
    """The one slip by which a form differs from a word; None if there is not just one.

    >>> slip("baer", "bear"), slip("cupp", "cup"), slip("boks", "books")
    ('changed about', 'doubled', 'doubled')
    >>> slip("apples", "apple"), slip("appe", "apple"), slip("cap", "cup")
    ('too many', 'too few', 'another')
    >>> slip("cup", "mug") is None
    True
    """
    start = 0
    while start < min(len(form), len(word)) and form[start] == word[start]:
        start += 1
    a, b = form[start:], word[start:]
    if len(form) == len(word) and a:
        if a[:2] == b[1::-1] and len(a) > 1 and a[2:] == b[2:]:
            return "changed about"
        return "another" if a[1:] == b[1:] else None
    if abs(len(form) - len(word)) != 1:
        return None
    longer, rest = (form, b) if len(form) > len(word) else (word, a)
    if longer[start + 1 :] != rest:
        return None
    if start and longer[start] == longer[start - 1]:
        return "doubled"
    return "too many" if longer is form else "too few"


def nearest_sentence(text: str, sentences: Iterable[str]) -> str | None:
    """The sentence that is most like a text, if one is much like it."""
    near = difflib.get_close_matches(text, list(sentences), n=1, cutoff=_ALIKE)
    return next(iter(near), None)
