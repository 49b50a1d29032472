"""Letters of other scripts that look like Latin ones: a "сup" is a cup.

Source: confusables.txt of Unicode Technical Standard 39, its Cyrillic and Greek letters
that are confused with one Latin letter, as far as keyboards have them.
"""

from __future__ import annotations

import re

_OTHER = "аеорсухіјѕһԁԛԝүАВЕКМНОРСТУХІЈЅԌοινρυαΑΒΕΖΗΙΚΜΝΟΡΤΥΧϲ"
_LATIN = "aeopcyxijshdqwyABEKMHOPCTYXIJSGoivpuaABEZHIKMNOPTYXc"
_TABLE = str.maketrans(_OTHER, _LATIN)
_WORD = re.compile(r"[^\W\d_]+")


def replace_lookalikes(text: str) -> str:
    """The text with Latin letters in words that look Latin as a whole.

    A word with any other foreign letter stays as it is: it is of another language.

    >>> replace_lookalikes("This is a \u0441up."), replace_lookalikes("Это чашка")
    ('This is a cup.', 'Это чашка')
    """
    return text if text.isascii() else _WORD.sub(_replace_word, text)


def _replace_word(found: re.Match[str]) -> str:
    word = found[0]
    latin = word.translate(_TABLE)
    return latin if all(c < "\u0250" for c in latin) else word
