"""Tutors by their kinds: what may be set of each, and what is wrong with one.

What only the world, or the rest of the study, can tell is found by `faults`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from inspect import signature
from typing import Any

from kille.dialogue.criteria import CUES
from kille.lab.errors import StudyError
from kille.lab.results import ExperimentError
from kille.lab.settings import (
    Problem,
    Setting,
    Settings,
    show_value,
    suggest_name,
    why_no_file,
    why_no_folder,
)
from kille.lab.study import Named, Study
from kille.lab.tutors.scripted import script_lines, unplayable_lines
from kille.lab.tutors.simulated import FEEDBACK
from kille.lab.tutors.spatial_judges import SIDES, read_ratings
from kille.lab.tutors.user_tutors import describe_error, load_tutor_maker
from kille.lab.tutors.words import Words
from ttr.dialogues.stories import StoryError

_SIMULATED: Settings = {
    "calls": Setting(dict, {}, about='what they call something else: {mug = "cup"}'),
    "vocabulary": Setting(str, (), several=True, about="the only words they have"),
    "errors": Setting(float, 0.0, most=1.0, about="the share of wrong lessons"),
    "feedback": Setting(str, "both", among=FEEDBACK),
    "matters": Setting(
        str,
        (),
        among=CUES,
        several=True,
        about="the cues that matter for nouns: they correct other reasons",
    ),
    "patience": Setting(int, 3, about="questions that they answer in a row"),
    "politeness": Setting(float, 0.0, most=1.0, about="how often they say thank you"),
    "frame": Setting(
        (str, float),
        "viewer",
        among=("viewer", "landmark"),
        most=1.0,
        about="in whose frame they speak, or how often in the landmark's own",
    ),
    "orients": Setting(bool, False, about="whether they say which way landmarks face"),
    "places": Setting(str, "likeliest", among=("likeliest", "drawn")),
    "inside": Setting(
        float, 0.45, most=1.0, about="how often they say near when it is"
    ),
    "outside": Setting(
        float, 0.10, most=1.0, about="how often they say near farther off"
    ),
    "habit": Setting(
        float, 0.0, most=10.0, about="how people differ in that, in log-odds"
    ),
}

SETTINGS: Mapping[str, Settings] = {
    "simulated": _SIMULATED,
    "people": {
        **_SIMULATED,
        "folder": Setting(
            str, needed=True, about="people's ratings of places on a grid"
        ),
    },
    "scripted": {"file": Setting(str, needed=True, about="a dialogue, NAME.dlg")},
    "keyboard": {},
    "own": {
        "make": Setting(str, needed=True, about="FILE.py:NAME or MODULE:NAME"),
        "settings": Setting(dict, {}, about="what NAME is called with, by name"),
    },
    "several": {
        "of": Setting(
            str,
            needed=True,
            several=True,
            twice=True,
            about="the names of the tutors; who is there twice has two turns",
        ),
        "turns": Setting(str, "phase", among=("phase", "task")),
    },
}
"""What may be set of tutors, kind by kind."""


def faults(named: Named, study: Study) -> Iterator[Problem]:
    """What is wrong with a tutor in this study, each with the setting it is in."""
    match named.kind:
        case "scripted":
            yield from _problems_at(
                "file", _script_problems(named.settings["file"], study)
            )
        case "people":
            yield from _problems_at(
                "folder", _ratings_problems(named.settings["folder"], study)
            )
            yield from _calls_problems(named)
        case "simulated":
            yield from _calls_problems(named)
        case "own":
            yield from _own_problems(named, study)
        case "several":
            yield from _problems_at("of", _several_problems(named, study))


def _problems_at(key: str, what: Iterator[str]) -> Iterator[Problem]:
    return (Problem((key,), it) for it in what)


def _script_problems(name: str, study: Study) -> Iterator[str]:
    """Why a script cannot be played, if it cannot."""
    path = study.path(name)
    if told := why_no_file(path):
        yield told
        return
    try:
        lines = script_lines(path)
    except StoryError as error:
        yield str(error)
        return
    yield from unplayable_lines(lines, study)


def _ratings_problems(name: str, study: Study) -> Iterator[str]:
    """Why people's ratings cannot be used, if they cannot."""
    path = study.path(name)
    if told := why_no_folder(path):
        yield told
        return
    try:
        if not set(read_ratings(path).words) >= SIDES:
            yield f"{name} has no ratings of left, right, above and below"
    except ExperimentError as error:
        yield str(error)


def _calls_problems(named: Named) -> Iterator[Problem]:
    for one, called in named.settings.get("calls", {}).items():
        if not isinstance(called, str):
            told = f'a {one} is called a text, as in {{ {one} = "cup" }}'
            yield Problem(("calls", one), f"{told}, and not {show_value(called)}")


def _several_problems(named: Named, study: Study) -> Iterator[str]:
    of = [*dict.fromkeys(named.settings["of"])]
    for name in of:
        if name not in study.tutors:
            yield f"there is no tutor {name}: {suggest_name(name, study.tutors)}"
        elif study.tutors[name].kind == "several":
            yield f"{name} is several tutors already: name them one by one"
        elif of == [name]:
            yield f"{name} alone is not several: name another tutor, too"


# --- tutors of one's own --------------------------------------------------------------


def _own_problems(named: Named, study: Study) -> Iterator[Problem]:
    """Why a tutor of one's own cannot be made."""
    settings = named.settings.get("settings", {})
    if taken := [it for it in ("name", "words") if it in settings]:
        told = f"{taken[0]} is not to be set: the study gives it"
        yield Problem(("settings", taken[0]), told)
        return
    given = {"name": named.name, "words": _some_words(study), **settings}
    yield from _problems_at(
        "make", _maker_problems(named.settings["make"], given, study)
    )


def _maker_problems(make: str, given: Mapping[str, Any], study: Study) -> Iterator[str]:
    try:
        maker = load_tutor_maker(make, study.folder, study.consent)
    except StudyError as error:
        yield from error.faults
        return
    try:
        with suppress(ValueError):  # some, made in C, do not tell how they are called
            signature(maker).bind(**given)
    except TypeError as error:
        yield f"{make} cannot be called with name, words and its settings: {error}"
        return
    try:
        tutor = maker(**given)
        lacking = [it for it in ("name", "turns") if not hasattr(tutor, it)]
    except (Exception, SystemExit) as error:
        told = describe_error(make, study.folder, error)
        yield f"{make} makes no tutor: {told}"
        return
    for needed in lacking:
        yield f"a tutor needs {needed}, and what {make} makes has none"


def _some_words(study: Study) -> Words:
    """The words of one of the languages that are spoken."""
    languages = (theory.language for theory in study.theories.values())
    return Words(next(languages, "en"))
