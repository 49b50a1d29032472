"""Typos: the nearest known word, or the nearest known sentence.

A correction is only ever offered. A word counts as near if it is one slip away, of the
four kinds that make most typos: a letter too many, one too few, another one, or two
swapped. In short words only those slips count that hardly ever make another word: if
"cap" is taught to a robot that knows "cup", it does not ask.

Source: Damerau, "A technique for computer detection and correction of spelling
errors" (1964).
"""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Iterable

_ALIKE = 0.72
"""Share of common characters, in order, from which two sentences are similar."""

_LONG = 5
"""From this many letters on, a letter too many or too few is rather a slip."""

_LONGER = 7
"""From this many letters on, another letter is rather a slip."""


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


def is_misspelling(form: str, word: str) -> bool:
    """Whether a new form is likely a common word, badly typed.

    Besides a slip it may lack the marks on letters, or repeat a letter. A letter too
    many at the end may be an ending of the word: then it is none.

    >>> is_misspelling("botle", "bottle"), is_misspelling("apple", "äpple")
    (True, True)
    >>> is_misspelling("cuuuup", "cup"), is_misspelling("cap", "cup")
    (True, False)
    >>> is_misspelling("spoons", "spoon")
    False
    """
    if form == word or form[:-1] == word:
        return False  # a letter more at the end may be an ending
    if is_slip(form, word) or _without_marks(form) == _without_marks(word):
        return True
    return _REPEATED.search(form) is not None and word in {
        _REPEATED.sub(r"\1", form),
        _REPEATED.sub(r"\1\1", form),
    }


_REPEATED = re.compile(r"(.)\1\1+")
"""A letter that is typed three times or more."""


def _without_marks(form: str) -> str:
    """The form without the marks on its letters: "apple" for *äpple*."""
    apart = unicodedata.normalize("NFD", form)
    return "".join(it for it in apart if not unicodedata.combining(it))


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
    """The sentence that is most similar to a text, if one is similar enough."""
    near = difflib.get_close_matches(text, list(sentences), n=1, cutoff=_ALIKE)
    return next(iter(near), None)
