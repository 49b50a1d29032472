"""The words of a study: is there anything to say them of, and are they understood?

What nobody understands is never learned, and a word that is heard as another is never
answered as the tutor has it: both would count as mistakes of the theory.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from kille.dialogue.grammars import GrammarError
from kille.dialogue.language import understand
from kille.dialogue.meanings import value_at
from kille.lab.results import ExperimentError
from kille.lab.scenes import Scene
from kille.lab.scenes.captured import Captured
from kille.lab.scenes.scene import KINDS as WORDS
from kille.lab.scenes.statements import Statements
from kille.lab.settings import Problem, show_value, suggest_name
from kille.lab.study import Named, Phase, Study
from kille.lab.theories.games import language_of
from kille.lab.tutors.spatial_judges import Person, Speaker, read_ratings
from kille.lab.tutors.words import Words
from kille.lab.worlds.sayings import Phrase
from kille.lab.worlds.worlds import COLOURS, KINDS, Thing

SPEAKING = ("simulated", "people")
"""The tutors of whom it is known what they say."""


@dataclass(frozen=True)
class NamesInScenes:
    """What things, colours and places are called in a study, before anybody says it.

    Those are what tutors name in their settings, whatever they call them.
    """

    noun: tuple[str, ...]
    adjective: tuple[str, ...]
    relation: tuple[str, ...]


def names_in_scenes(study: Study, opened: Mapping[str, Scene]) -> NamesInScenes:
    """All that there is in these scenes, and the words for places of all tutors."""
    places = [*_said_in(opened)]
    for tutor in study.tutors.values():
        places += _places(tutor, study) if tutor.kind in SPEAKING else ()
    nouns = (kind for scene in opened.values() for kind in _kinds_in(scene))
    return NamesInScenes(_unique(nouns), tuple(COLOURS), _unique(places))


def _kinds_in(scene: Scene) -> Iterator[str]:
    """The kinds of things in a scene, whatever seed it is drawn by."""
    yield from scene.kinds
    if isinstance(scene, Captured):
        yield from scene.labelled


def _said_in(opened: Mapping[str, Scene]) -> Iterator[str]:
    """The words for places that people have said."""
    for scene in opened.values():
        if isinstance(scene, Statements):
            yield from (word for word, _ in (*scene.taught, *scene.kept))


def _places(tutor: Named, study: Study) -> Iterator[str]:
    """The words for places that a tutor has, if it is known where they are from."""
    folder = tutor.settings.get("folder")
    try:
        placing = read_ratings(study.path(folder)) if folder else None
    except ExperimentError:
        return
    yield from Speaker(placing or Person()).words


def _unique(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))


# --- what is said of nothing ----------------------------------------------------------


def unused_words(study: Study, names: NamesInScenes) -> Iterator[Problem]:
    """Words in settings of tutors and phases that are said of nothing, ever."""
    for name, tutor in study.tutors.items():
        if tutor.kind in SPEAKING:
            for it in _unused_words_of(tutor, study, names):
                yield it.within("tutors", name)
    if any(it.kind not in (*SPEAKING, "several") for it in study.tutors.values()):
        return
    for number, phase in enumerate(study.phases):
        for what in _never_taught(phase, study, names):
            yield Problem(("phases", number, "words"), what)


def _unused_words_of(
    tutor: Named, study: Study, names: NamesInScenes
) -> Iterator[Problem]:
    things = _unique([*names.noun, *names.adjective, *KINDS])
    known = _unique([*things, *names.relation])
    for name in tutor.settings.get("calls", {}):
        if name not in known:
            told = (
                f"there is nothing that others call {name}: {suggest_name(name, known)}"
            )
            yield Problem(("calls", name), told)
    vocabulary = tutor.settings.get("vocabulary", ())
    forms = _forms(things, [tutor], study)
    wrong = [it for it in vocabulary if it not in known and it not in forms]
    for word in wrong:
        told = f"there is nothing of which {tutor.name} could say {word}"
        yield Problem(("vocabulary",), f"{told}: {suggest_name(word, known)}")
    there = _unique([*names.noun, *names.adjective, *names.relation])
    own = {*there, *_forms(there, [tutor], study)}
    if vocabulary and not wrong and not own & {*vocabulary}:
        told = f"of all that {tutor.name} has words for, nothing is in these scenes"
        told = f"{told}: there is {', '.join(names.noun)}"
        yield Problem(("vocabulary",), told)


def _never_taught(phase: Phase, study: Study, names: NamesInScenes) -> Iterator[str]:
    """Words to be forgotten that nobody teaches."""
    plural = str(phase.settings.get("what", "nouns"))
    known: tuple[str, ...] = getattr(names, WORDS[plural])
    forms = _forms(known, study.tutors.values(), study)
    for word in phase.settings.get("words", ()):
        if word in known or word in forms:
            continue
        others = [it for it, kind in WORDS.items() if word in getattr(names, kind)]
        hint = f'write what = "{others[0]}"' if others else suggest_name(word, known)
        yield f"{word} is none of the {plural} that are taught: {hint}"


def _forms(
    names: Iterable[str], tutors: Iterable[Named], study: Study
) -> Collection[str]:
    """The tutors' words for these names, in the languages of the theories."""
    several = [
        words_of(theory.language, tutor)
        for theory in study.theories.values()
        for tutor in tutors
    ]
    return {words.word_for(name) for words in several for name in names}


def words_of(language: str, tutor: Named) -> Words:
    """The words of a tutor, without names that are not texts."""
    calls = tutor.settings.get("calls", {})
    return Words(language, {k: it for k, it in calls.items() if isinstance(it, str)})


# --- what is misheard -----------------------------------------------------------------

_KINDS = ("noun", "adjective", "relation")


def misheard_words(study: Study, names: NamesInScenes) -> Iterator[Problem]:
    """Words that are heard as others, or not at all, by the language of a theory."""
    for tutor in study.tutors.values():
        if tutor.kind in SPEAKING:
            yield from _misheard_words_of(tutor, study, names)


def _misheard_words_of(
    tutor: Named, study: Study, names: NamesInScenes
) -> Iterator[Problem]:
    theories = [*study.theories.values()]
    languages = {language_of(theory): theory for theory in theories[::-1]}
    for language, theory in languages.items():
        words = words_of(theory.language, tutor)
        for kind, name in _names_by_kind(names):
            word = words.word_for(name)
            try:
                heard = _words_heard(kind, word, language, theory.language)
            except GrammarError as error:
                what = f"this grammar cannot be used for lessons in {show_value(word)}"
                yield Problem(("theories", theory.name, "grammar"), f"{what}: {error}")
                break
            if word not in heard:
                key = ("tutors", tutor.name, "calls", name)
                told = _describe_mishearing(word, name, next(iter(heard), ""))
                yield Problem(key, f"to {theory.name} {tutor.name} says {told}")


def _names_by_kind(names: NamesInScenes) -> Iterator[tuple[str, str]]:
    return ((kind, name) for kind in _KINDS for name in getattr(names, kind))


def _describe_mishearing(word: str, name: str, heard: str) -> str:
    found = (
        f"which is heard as {show_value(heard)}" if heard else "which is not understood"
    )
    other = heard if heard and heard.casefold() == word.casefold() else "…"
    hint = f"write calls = {{ {show_value(name)} = {show_value(other)} }}"
    return f"{show_value(word)}, {found}: {hint}"


@lru_cache(4096)
def _words_heard(kind: str, word: str, language: str, plain: str) -> Sequence[str]:
    """The words of a kind that a lesson in this word is heard to be of."""
    words = Words(plain)
    text = words.lesson(
        kind, word, _example_landmark(words) if kind == "relation" else None
    )
    readings = [it.type for one in understand(text, language) for it in one.readings]
    signs = [it for said in readings for it in value_at(said, "signs")]
    return tuple(dict.fromkeys(str(it.form) for it in signs if it.kind == kind))


def _example_landmark(words: Words) -> Phrase:
    return words.phrase_for(Thing("car", "red"), "adjective")
