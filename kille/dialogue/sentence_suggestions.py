"""What may have been meant by a sentence that is nearly one of the language."""

from __future__ import annotations

import re
from collections.abc import Sequence

from kille.dialogue.language import understand
from kille.dialogue.lexicon import Lexicon
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.typos import nearest_sentence, slip

_WORD = re.compile(r"[^\W\d_]+")

_LONGEST = 200
"""Characters; a longer text has more wrong with it than a typo."""


def suggest_sentence(
    lexicon: Lexicon, text: str, *, anyhow: bool = False, types: DialogueTypes
) -> str | None:
    """The nearest sentence to a text that is not understood, if any is near.

    It is the text with its typos corrected, if that is understood, or else the most
    similar example, if one is similar enough, or `anyhow`: then it may only have some
    words in common with the text, or else as little as that it is a question too.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import packaged_types
    >>> types = packaged_types()
    >>> suggest_sentence(lexicon(), "Waht is teh blicket?", types=types)
    'What is the blicket?'
    >>> suggest_sentence(lexicon("sv"), "Vda är det här?", types=types)
    'Vad är det här?'
    >>> suggest_sentence(lexicon(), "Xyzzy!", types=types)
    """
    return (
        _mend_slips(lexicon, text, types=types)
        or nearest_sentence(text, lexicon.examples)
        or (_most_in_common(text, lexicon.examples) if anyhow else None)
    )


def _most_in_common(text: str, examples: Sequence[str]) -> str | None:
    """The example with most words of a text in it, a question for a question."""
    said = set(_WORD.findall(text.lower()))
    alike = [it for it in examples if it.endswith("?") == text.endswith("?")]
    shared = {it: len(said & set(_WORD.findall(it.lower()))) for it in alike}
    return max(shared, key=lambda it: shared[it], default=None)


def _mend_slips(lexicon: Lexicon, text: str, *, types: DialogueTypes) -> str | None:
    """The text with its typos corrected, by the words of the examples."""
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
