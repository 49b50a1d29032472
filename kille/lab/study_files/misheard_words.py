"""Whether robots hear the words of tutors as these are meant.

What nobody understands is never learned, and a word that is heard as another is never
answered as the tutor has it: both would count as mistakes of the theory.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache

from kille.dialogue.grammars import GrammarError
from kille.dialogue.language import understand
from kille.dialogue.meanings import value_at
from kille.lab.settings import shown
from kille.lab.study import Named, Study
from kille.lab.study_files.named_words import SPEAKING, Names, words_of
from kille.lab.study_files.problems import Trouble
from kille.lab.theories.games import language_of
from kille.lab.tutors.words import Words
from kille.lab.worlds.sayings import Phrase
from kille.lab.worlds.worlds import Thing

_KINDS = ("noun", "adjective", "relation")


def misheard(study: Study, names: Names) -> Iterator[Trouble]:
    """Words that are heard as others, or not at all, by the language of a theory."""
    for tutor in study.tutors.values():
        if tutor.kind in SPEAKING:
            yield from _of_tutor(tutor, study, names)


def _of_tutor(tutor: Named, study: Study, names: Names) -> Iterator[Trouble]:
    theories = [*study.theories.values()]
    languages = {language_of(theory): theory for theory in theories[::-1]}
    for language, theory in languages.items():
        words = words_of(theory.language, tutor)
        for kind, name in _named(names):
            word = words.called(name)
            try:
                heard = _heard(kind, word, language, theory.language)
            except GrammarError as error:
                what = f"this grammar cannot be used for lessons in {shown(word)}"
                yield Trouble(("theories", theory.name, "grammar"), f"{what}: {error}")
                break
            if word not in heard:
                key = ("tutors", tutor.name, "calls", name)
                told = _told(word, name, next(iter(heard), ""))
                yield Trouble(key, f"to {theory.name} {tutor.name} says {told}")


def _named(names: Names) -> Iterator[tuple[str, str]]:
    return ((kind, name) for kind in _KINDS for name in getattr(names, kind))


def _told(word: str, name: str, heard: str) -> str:
    found = f"which is heard as {shown(heard)}" if heard else "which is not understood"
    other = heard if heard and heard.casefold() == word.casefold() else "…"
    hint = f"write calls = {{ {shown(name)} = {shown(other)} }}"
    return f"{shown(word)}, {found}: {hint}"


@lru_cache(4096)
def _heard(kind: str, word: str, language: str, plain: str) -> Sequence[str]:
    """The words of a kind that a lesson in this word is heard to be of."""
    words = Words(plain)
    text = words.lesson(kind, word, _beside(words) if kind == "relation" else None)
    readings = [it.type for one in understand(text, language) for it in one.readings]
    signs = [it for said in readings for it in value_at(said, "signs")]
    return tuple(dict.fromkeys(str(it.form) for it in signs if it.kind == kind))


def _beside(words: Words) -> Phrase:
    return words.described(Thing("car", "red"), "adjective")
