"""The theory that a user names: a file, a folder of one's own, or one of a study.

| `--theory` | has |
| --- | --- |
| `FILE.ttr` | the types of this file |
| `FOLDER` | what there is of the files that `kille init` writes; RULES of `rules.py` |
| `STUDY.toml:NAME` | all that the theory has in the study |
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from kille.agent.agent import Agent
from kille.dialogue.language import LANGUAGES
from kille.dialogue.language_files import FILES, ISLANDS, STRATEGIES, WORDS
from kille.dialogue.theory_files import SOURCE
from kille.lab.errors import StudyError
from kille.lab.settings import suggest_name
from kille.lab.study import PERSON, Theory
from kille.lab.study_files import read
from kille.lab.study_files.consent import check_allowed
from kille.lab.study_files.theory_trials import theory_problems
from kille.lab.theories import agent_of
from kille.memory import Memory
from kille.sensors.sensor import Sensor
from ttr.errors import suggestion
from ttr.safety.consent import Consent

RULES = "rules.py"
"""The file of a folder that has rules, as `RULES`."""


def theory_named(
    named: str, language: str, mode: str, wording: str, consent: Consent
) -> Theory:
    """The theory of this name, which has been tried.

    One of a study has the language, the mode and the wording that it has there.
    `StudyError` with a line for each mistake in it.
    """
    study, colon, name = named.rpartition(":")
    if colon and study.endswith(".toml"):
        theory = _of_study(Path(study), name, consent)
    else:
        theory = _of_files(Path(named), Theory(named, language, mode, wording), consent)
    if wrong := [*theory_problems(theory, {"whole"})]:
        raise StudyError(f"{it.at or named}: {it.what}" for it in wrong)
    return theory


def robot_of(
    theory: Theory, sensor: str | Sensor, memory: Memory | Path | None, **settings: Any
) -> Agent:
    """The robot of a theory; its language, mode and wording are those of that.

    Of the other settings those count that are no part of a theory: when it takes turns,
    its clock, who is told of its events, and what watches its game.
    """
    kept = ("turns", "now", "record_event", "change")
    own = {it: settings[it] for it in kept if it in settings}
    return agent_of(theory, sensor, memory=memory, **own)


def maker_of(named: str, consent: Consent, language: str) -> Callable[..., Agent]:
    """What makes robots of the theory of this name that speak a language.

    `StudyError` where the theory cannot be used, or has another language.
    """
    theory = theory_named(named, language, "", "", consent)
    if theory.language != language:
        raise StudyError([f"{named} speaks {theory.language}, not {language}"])
    return partial(robot_of, theory)


def _of_study(file: Path, name: str, consent: Consent) -> Theory:
    study = read(file, consent)
    check_allowed(study)
    if name not in study.theories:
        raise StudyError(
            [f"{file} has no theory {name}: {suggest_name(name, study.theories)}"]
        )
    theory = study.theories[name]
    if theory.mode == PERSON:
        raise StudyError([f"{name} of {file} is played by a person: name another"])
    return theory


def _of_files(place: Path, theory: Theory, consent: Consent) -> Theory:
    """The theory with what is in a file of types, or in a folder."""
    if not place.is_dir():
        if place.suffix != ".ttr":
            expected = "FILE.ttr, a folder or STUDY.toml:NAME"
            raise StudyError([f"{place} is no theory: expected {expected}"])
        return replace(theory, meanings=str(place), consent=consent)
    place = place.resolve()
    if strays := [*_misnamed_files(place)]:
        raise StudyError(strays)
    own = [it.format(theory.language) for it in FILES]
    has_words = any((place / it).is_file() for it in (*own, STRATEGIES))
    has_types = (place / SOURCE).is_file()
    has_rules = (place / RULES).is_file()
    if not (has_words or has_types or has_rules):
        names = ", ".join((SOURCE, *own, STRATEGIES))
        raise StudyError([f"{place} has none of {names}: `kille init` writes them"])
    return replace(
        theory,
        grammar=place if has_words else None,
        meanings=str(place / SOURCE) if has_types else "",
        rules=f"{place / RULES}:RULES" if has_rules else "",
        consent=consent.with_folders(place),
    )


def _misnamed_files(folder: Path) -> Iterator[str]:
    """Files that look as if they were of a theory, under a name that nothing reads."""
    named = [it.format(one) for it in (*FILES, WORDS, ISLANDS) for one in LANGUAGES]
    known = {*named, STRATEGIES, SOURCE, RULES}
    missing = [it for it in known if not (folder / it).exists()]
    for file in sorted(folder.iterdir()):
        alike = [it for it in missing if Path(it).suffix == file.suffix]
        if file.name not in known and (hint := suggestion(file.name, alike)):
            yield f"nothing reads {file}: {hint}"
