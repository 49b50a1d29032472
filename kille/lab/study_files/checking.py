"""What is wrong with a study, all of it at once, before anything is played.

A mistake is one line: where it is, what it is, and what to do.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

from kille.lab import scenes, tutors
from kille.lab.errors import StudyError
from kille.lab.protocols import phases
from kille.lab.settings import Key, Problem
from kille.lab.study import Run, Study, Theory
from kille.lab.study_files.consent import unallowed
from kille.lab.study_files.file import data_of, study_of, text_of
from kille.lab.study_files.phases import unreached
from kille.lab.study_files.problems import told
from kille.lab.study_files.shape import STUDY, faults
from kille.lab.study_files.theory_trials import troubles
from kille.lab.study_files.words import misheard, names_in, unsaid
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


def _troubles(study: Study) -> Iterator[Problem]:
    """What a study must not use; or else what is wrong with its parts."""
    refused = [*unallowed(study)]
    yield from refused or _tried(study)


def _tried(study: Study) -> Iterator[Problem]:
    """What is wrong with the parts of a study, and with how they fit together."""
    known = [it.kind for it in study.scenes.values() if it.kind != UNKNOWN]
    eyes = {"whole" if kind in scenes.WHOLE else "simulated" for kind in known}
    of_theories = [*_of_theories(study.theories, eyes)]
    yield from of_theories
    for name, tutor in study.tutors.items():
        yield from (it.within("tutors", name) for it in tutors.faults(tutor, study))
    for number, phase in enumerate(study.phases):
        yield from (it.within("phases", number) for it in phases.faults(phase, study))
    opened = {}
    for name, scene in study.scenes.items():
        if wrong := [*scenes.faults(scene, study)]:
            yield from (it.within("scenes", name) for it in wrong)
        elif scene.kind != UNKNOWN:
            opened[name] = scenes.open_scene(study, Run("", "", name, 0))
    yield from unreached(study, opened)
    modes = [theory.mode for theory in study.theories.values()]
    if len(opened) == len(study.scenes) and UNKNOWN not in modes:
        names = names_in(study, opened)
        yield from unsaid(study, names)
        yield from misheard(study, names) if not of_theories else ()


def _of_theories(
    theories: Mapping[str, Theory], eyes: Collection[str]
) -> Iterator[Problem]:
    for name, theory in theories.items():
        for it in troubles(theory, eyes) if theory.mode != UNKNOWN else ():
            yield it.within("theories", name)


# --- what is left of a study with mistakes ------------------------------------------

UNKNOWN = "unknown"
"""The kind, or mode, of what is written wrongly, of which nothing else is told."""

STAND_INS: Mapping[str, Mapping[str, str]] = {
    "theories": {"mode": UNKNOWN},
    "tutors": {"kind": UNKNOWN},
    "scenes": {"kind": UNKNOWN},
    "phases": {"do": "rest"},
}
"""What takes the place of what is written wrongly, but named or counted by others."""

PLAIN: Mapping[str, Any] = {
    "title": "",
    "about": "",
    "turns": STUDY["turns"].most,
    "seeds": 1,
}
"""What takes the place of wrong values; so many turns that all phases are reached."""


def sound(data: Mapping[str, Any], wrong: Collection[Key]) -> Mapping[str, Any]:
    """A study without what is written wrongly, so that the rest of it can be tried."""
    left = {key: _sound(data, key, wrong) for key in ("theories", "tutors", "scenes")}
    phases = data.get("phases")
    named = [
        STAND_INS["phases"]
        if not isinstance(one, dict) or _is_wrong(("phases", number), wrong)
        else one
        for number, one in enumerate(phases if isinstance(phases, list) else ())
    ]
    plain = {
        key: stand_in if (key,) in wrong else data[key]
        for key, stand_in in PLAIN.items()
        if key in data
    }
    return {"title": "", "seeds": 1, **plain, **left, "phases": named}


def _sound(
    data: Mapping[str, Any], table: str, wrong: Collection[Key]
) -> Mapping[str, Any]:
    """What is left of a table of named things."""
    given = data.get(table)
    found: dict[str, Any] = {}
    for name, one in given.items() if isinstance(given, dict) else ():
        is_wrong = _is_wrong((table, name), wrong)
        found[name] = STAND_INS[table] if is_wrong else one
    return found


def _is_wrong(key: Key, wrong: Collection[Key]) -> bool:
    """Whether something is wrong with what has this key, or in it."""
    return any(it[: len(key)] == key for it in wrong)
