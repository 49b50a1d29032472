"""A sentence that nearly is one of the language: what may have been meant by it."""

from __future__ import annotations

import re

from kille.dialogue.language import understand
from kille.dialogue.lexicon import Lexicon
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.typos import nearest_sentence, slip

_WORD = re.compile(r"[^\W\d_]+")

_LONGEST = 200
"""Characters; of a longer text nobody mistyped a word only."""


def suggest_sentence(
    lexicon: Lexicon, text: str, *, types: DialogueTypes
) -> str | None:
    """What could be said instead of a text that is not understood, if anything is near.

    It is the text with its slips mended if that is understood, else the example that is
    most like it, if one is much like it.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import packaged_types
    >>> types = packaged_types()
    >>> suggest_sentence(lexicon(), "Waht is teh blicket?", types=types)
    'What is the blicket?'
    >>> suggest_sentence(lexicon("sv"), "Vda är det här?", types=types)
    'Vad är det här?'
    >>> suggest_sentence(lexicon(), "Xyzzy!", types=types)
    """
    return _mend_slips(lexicon, text, types=types) or nearest_sentence(
        text, lexicon.examples
    )


def _mend_slips(lexicon: Lexicon, text: str, *, types: DialogueTypes) -> str | None:
    """The text with words of the examples in place of slips of them."""
    if len(text) > _LONGEST:
        return None
    examples = " ".join(lexicon.examples).lower()
    known: set[str] = set(_WORD.findall(examples))

    def mend(found: re.Match[str]) -> str:
        form = str(found[0]).lower()
        near = [word for word in sorted(known) if slip(form, word)]
        if form in known or len(near) != 1:
            return str(found[0])
        return near[0].capitalize() if form != found[0] else near[0]

    mended: str = _WORD.sub(mend, text)
    understood = all(
        it.readings for it in understand(mended, lexicon.language, types=types)
    )
    return mended if understood else None
