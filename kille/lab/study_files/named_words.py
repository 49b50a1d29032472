"""Words that a study names: whether there is anything that they could be said of."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

from kille.lab.results import ExperimentError
from kille.lab.scenes import Scene
from kille.lab.scenes.captured import Captured
from kille.lab.scenes.occasions import KINDS as WORDS
from kille.lab.scenes.statements import Statements
from kille.lab.settings import Wrong, unknown
from kille.lab.study import Named, Phase, Study
from kille.lab.study_files.problems import Trouble
from kille.lab.tutors.spatial_judges import Person, Speaker, rated
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import COLOURS, KINDS

SPEAKING = ("simulated", "people")
"""The tutors of whom it is known what they say."""


@dataclass(frozen=True)
class Names:
    """What things, colours and places are called in a study, before anybody says it.

    Those are what tutors name in their settings, whatever they call them.
    """

    noun: tuple[str, ...]
    adjective: tuple[str, ...]
    relation: tuple[str, ...]


def names_in(study: Study, opened: Mapping[str, Scene]) -> Names:
    """All that there is in these scenes, and the words for places of all tutors."""
    places = [*_said_in(opened)]
    for tutor in study.tutors.values():
        places += _places(tutor, study) if tutor.kind in SPEAKING else ()
    nouns = (kind for scene in opened.values() for kind in _kinds_in(scene))
    return Names(_once(nouns), tuple(COLOURS), _once(places))


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
    """The words for places that a tutor has, if it is known where he has them from."""
    folder = tutor.settings.get("folder")
    try:
        placing = rated(study.folder / os.path.expanduser(folder)) if folder else None
    except ExperimentError:
        return
    yield from Speaker(placing or Person()).words


def _once(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))


# --- what is said of nothing ----------------------------------------------------------


def unsaid(study: Study, names: Names) -> Iterator[Trouble]:
    """Words in settings of tutors and phases that are said of nothing, ever."""
    for name, tutor in study.tutors.items():
        if tutor.kind in SPEAKING:
            for key, what in _of_tutor(tutor, study, names):
                yield Trouble(("tutors", name, *key), what)
    if any(it.kind not in (*SPEAKING, "several") for it in study.tutors.values()):
        return
    for number, phase in enumerate(study.phases):
        for what in _unforgettable(phase, study, names):
            yield Trouble(("phases", number, "words"), what)


def _of_tutor(tutor: Named, study: Study, names: Names) -> Iterator[Wrong]:
    things = _once([*names.noun, *names.adjective, *KINDS])
    known = _once([*things, *names.relation])
    for name in tutor.settings.get("calls", {}):
        if name not in known:
            told = f"there is nothing that others call {name}: {unknown(name, known)}"
            yield ("calls", name), told
    vocabulary = tutor.settings.get("vocabulary", ())
    forms = _forms(things, [tutor], study)
    wrong = [it for it in vocabulary if it not in known and it not in forms]
    for word in wrong:
        told = f"there is nothing of which {tutor.name} could say {word}"
        yield ("vocabulary",), f"{told}: {unknown(word, known)}"
    there = _once([*names.noun, *names.adjective, *names.relation])
    own = {*there, *_forms(there, [tutor], study)}
    if vocabulary and not wrong and not own & {*vocabulary}:
        told = f"of all that {tutor.name} has words for, nothing is in these scenes"
        yield ("vocabulary",), f"{told}: there is {', '.join(names.noun)}"


def _unforgettable(phase: Phase, study: Study, names: Names) -> Iterator[str]:
    """What is to be forgotten, and is taught by nobody."""
    plural = str(phase.settings.get("what", "nouns"))
    known: tuple[str, ...] = getattr(names, WORDS[plural])
    forms = _forms(known, study.tutors.values(), study)
    for word in phase.settings.get("words", ()):
        if word in known or word in forms:
            continue
        others = [it for it, kind in WORDS.items() if word in getattr(names, kind)]
        hint = f'write what = "{others[0]}"' if others else unknown(word, known)
        yield f"{word} is none of the {plural} that are taught: {hint}"


def _forms(
    names: Iterable[str], tutors: Iterable[Named], study: Study
) -> Collection[str]:
    """What the tutors call all this, in the languages of the theories."""
    several = [
        words_of(theory.language, tutor)
        for theory in study.theories.values()
        for tutor in tutors
    ]
    return {words.called(name) for words in several for name in names}


def words_of(language: str, tutor: Named) -> Words:
    """The words of a tutor, less what he calls by something that is no text."""
    calls = tutor.settings.get("calls", {})
    return Words(language, {k: it for k, it in calls.items() if isinstance(it, str)})
