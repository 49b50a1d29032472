"""What is wrong with a study, all of it at once, before anything is played.

A mistake is one line: where it is, what it is, and what to do.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path

from kille.lab import scenes, tutors
from kille.lab.errors import StudyError
from kille.lab.protocols import phases
from kille.lab.settings import Wrong
from kille.lab.study import Run, Study, Theory
from kille.lab.study_files.consent import unallowed
from kille.lab.study_files.dialogue_length import unreached
from kille.lab.study_files.file import data_of, study_of, text_of
from kille.lab.study_files.lines import Key
from kille.lab.study_files.misheard_words import misheard
from kille.lab.study_files.named_words import names_in, unsaid
from kille.lab.study_files.problems import Trouble, told
from kille.lab.study_files.shape import faults
from kille.lab.study_files.theory_trials import troubles
from kille.lab.study_files.valid_part import UNKNOWN, sound
from ttr.safety.consent import OWN_FOLDER, Consent


def checked(path: Path, consent: Consent = OWN_FOLDER) -> Study:
    """The study in a file, ready to be played; `StudyError` with a line for each
    mistake, in how it is written and in what it names.

    Of a study that names what there is no consent to, nothing is tried.
    """
    text = text_of(path)
    data = data_of(text, path)
    wrong = [*faults(data)]
    left = sound(data, [it.key for it in wrong]) if wrong else data
    study = study_of(left, text, path, consent)
    if lines := told([*wrong, *_troubles(study)], text, path):
        raise StudyError(lines)
    return study


def check(study: Study) -> tuple[str, ...]:
    """A line for everything that is wrong with a study, in the order of its file."""
    return told(_troubles(study), study.source, study.file)


def _troubles(study: Study) -> Iterator[Trouble]:
    """What a study must not use; or else what is wrong with its parts."""
    refused = [*unallowed(study)]
    yield from refused or _tried(study)


def _tried(study: Study) -> Iterator[Trouble]:
    """What is wrong with the parts of a study, and with how they fit together."""
    known = [it.kind for it in study.scenes.values() if it.kind != UNKNOWN]
    eyes = {"whole" if kind in scenes.WHOLE else "simulated" for kind in known}
    of_theories = [*_of_theories(study.theories, eyes)]
    yield from of_theories
    for name, tutor in study.tutors.items():
        yield from _at(("tutors", name), tutors.faults(tutor, study))
    for number, phase in enumerate(study.phases):
        yield from _at(("phases", number), phases.faults(phase, study))
    opened = {}
    for name, scene in study.scenes.items():
        if wrong := [*_at(("scenes", name), scenes.faults(scene, study))]:
            yield from wrong
        elif scene.kind != UNKNOWN:
            opened[name] = scenes.opened(study, Run("", "", name, 0))
    yield from unreached(study, opened)
    modes = [theory.mode for theory in study.theories.values()]
    if len(opened) == len(study.scenes) and UNKNOWN not in modes:
        names = names_in(study, opened)
        yield from unsaid(study, names)
        yield from misheard(study, names) if not of_theories else ()


def _of_theories(
    theories: Mapping[str, Theory], eyes: Collection[str]
) -> Iterator[Trouble]:
    for name, theory in theories.items():
        for it in troubles(theory, eyes) if theory.mode != UNKNOWN else ():
            yield it._replace(key=("theories", name, *it.key))


def _at(key: Key, what: Iterable[Wrong]) -> Iterator[Trouble]:
    return (Trouble((*key, *inner), it) for inner, it in what)
