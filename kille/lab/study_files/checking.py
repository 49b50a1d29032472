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
from kille.lab.study_files.consent import refused_names
from kille.lab.study_files.file import parse_data, read_source, study_of
from kille.lab.study_files.phases import unreached_phases
from kille.lab.study_files.problems import format_problems
from kille.lab.study_files.shape import STUDY, shape_problems
from kille.lab.study_files.theory_trials import theory_problems
from kille.lab.study_files.words import misheard_words, names_in_scenes, unused_words
from ttr.safety.consent import OWN_FOLDER, Consent


def read_and_check(path: Path, consent: Consent = OWN_FOLDER) -> Study:
    """The study in a file, ready to be played; `StudyError` with a line for each
    mistake, in how it is written and in what it names.

    Of a study that names what there is no consent to, nothing is tried.

    >>> import tempfile
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cups.toml").write_text(text)
    ...     read_and_check(Path(folder, "cups.toml")).seeds
    (1,)
    """
    text = read_source(path)
    data = parse_data(text, path)
    wrong = [*shape_problems(data)]
    left = valid_part(data, [it.key for it in wrong]) if wrong else data
    study = study_of(left, text, path, consent)
    if lines := format_problems([*wrong, *_study_problems(study)], text, path):
        raise StudyError(lines)
    return study


def check(study: Study) -> tuple[str, ...]:
    """A line for everything that is wrong with a study, in the order of its file.

    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> check(parse(text, Path("cups.toml")))
    ()
    """
    return format_problems(_study_problems(study), study.source, study.file)


def _study_problems(study: Study) -> Iterator[Problem]:
    """What a study may not use, or else what is wrong with its parts."""
    refused = [*refused_names(study)]
    yield from refused or _part_problems(study)


def _part_problems(study: Study) -> Iterator[Problem]:
    """What is wrong with the parts of a study, and with how they fit together."""
    known = [it.kind for it in study.scenes.values() if it.kind != UNKNOWN]
    eyes = {"whole" if kind in scenes.WHOLE else "simulated" for kind in known}
    of_theories = [*_theory_problems(study.theories, eyes)]
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
    yield from unreached_phases(study, opened)
    modes = [theory.mode for theory in study.theories.values()]
    if len(opened) == len(study.scenes) and UNKNOWN not in modes:
        names = names_in_scenes(study, opened)
        yield from unused_words(study, names)
        yield from misheard_words(study, names) if not of_theories else ()


def _theory_problems(
    theories: Mapping[str, Theory], eyes: Collection[str]
) -> Iterator[Problem]:
    for name, theory in theories.items():
        for it in theory_problems(theory, eyes) if theory.mode != UNKNOWN else ():
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


def valid_part(data: Mapping[str, Any], wrong: Collection[Key]) -> Mapping[str, Any]:
    """The part of a study that is written correctly, so that it can be tried."""
    left = {
        key: _valid_table(data, key, wrong) for key in ("theories", "tutors", "scenes")
    }
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


def _valid_table(
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
    """Whether the value of this key, or something in it, is wrong."""
    return any(it[: len(key)] == key for it in wrong)
