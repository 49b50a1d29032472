"""Tutors of a study, kind by kind, and what may be set of each.

simulated: knows the world, see `simulated`. scripted: says the lines of a file `.dlg`.
people: speaks as people's data have it. keyboard: a person types. several: some of the
others take turns, and may disagree. own: a class or function of one's own makes him.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from inspect import signature
from pathlib import Path

from kille.experiments.results import ExperimentError
from kille.studies.errors import StudyError
from kille.studies.settings import Setting, Settings
from kille.studies.study import Named, Study
from kille.studies.tutors.own import maker_of
from kille.studies.tutors.places import SIDES, rated
from kille.studies.tutors.simulated import FEEDBACK
from ttr.stories import StoryError, read_stories

__all__ = ["SETTINGS", "faults"]

_SIMULATED: Settings = {
    "calls": Setting(dict, {}, about='what he calls something else: {mug = "cup"}'),
    "vocabulary": Setting(str, (), several=True, about="the only words he has"),
    "errors": Setting(float, 0.0, most=1.0, about="the share of wrong lessons"),
    "feedback": Setting(str, "both", among=FEEDBACK),
    "patience": Setting(int, 3, about="questions that he answers in a row"),
    "politeness": Setting(float, 0.0, most=1.0, about="how often he says thank you"),
    "frame": Setting(
        (str, float),
        "viewer",
        among=("viewer", "landmark"),
        most=1.0,
        about="in whose frame he speaks, or how often in the landmark's own",
    ),
    "orients": Setting(bool, False, about="whether he says which way landmarks face"),
    "places": Setting(str, "likeliest", among=("likeliest", "drawn")),
    "inside": Setting(float, 0.45, most=1.0, about="how often he says near when it is"),
    "outside": Setting(
        float, 0.10, most=1.0, about="how often he says near farther off"
    ),
    "habit": Setting(float, 0.0, about="how people differ in that, in log-odds"),
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
        "of": Setting(str, needed=True, several=True, about="the names of the tutors"),
        "turns": Setting(str, "phase", among=("phase", "task")),
    },
}
"""What may be set of tutors, kind by kind."""


def faults(named: Named, study: Study) -> Iterator[str]:
    """What only the world, or the study, can tell is wrong with a tutor."""
    for key, kind in (("folder", "folder"), ("file", "file")):
        path = named.settings.get(key)
        if isinstance(path, str):
            yield from _unread(study.folder / os.path.expanduser(path), kind, path)
    if named.kind == "own":
        yield from _unmade(named, study)
    for one, called in named.settings.get("calls", {}).items():
        if not isinstance(called, str):
            told = f'calls: a {one} is called a text, as in {{ {one} = "cup" }}'
            yield f"{told}, and not {called}"
    of = named.settings.get("of")
    if of == []:
        yield f"of names no tutor: there is {', '.join(study.tutors)}"
    for name in of or ():
        if name not in study.tutors:
            yield f"there is no tutor {name}: there is {', '.join(study.tutors)}"
        elif study.tutors[name].kind == "several":
            yield f"{name} is several tutors already: name them one by one"


def _unmade(named: Named, study: Study) -> Iterator[str]:
    """Why a tutor of one's own cannot be made, if he cannot."""
    make, settings = named.settings["make"], named.settings.get("settings", {})
    try:
        taken = signature(maker_of(make, study.folder))
        taken.bind(name=named.name, words=None, **settings)
    except StudyError as error:
        yield from error.faults
    except (TypeError, ValueError) as error:
        yield f"{make} cannot be called with name, words and its settings: {error}"


def _unread(path: Path, kind: str, name: str) -> Iterator[str]:
    """Why a script or people's ratings cannot be used, if they cannot."""
    if not path.exists():
        yield f"there is no {kind} {name}"
        return
    try:
        if kind == "file":
            read_stories(path)
        elif not set(rated(path).words) >= SIDES:
            yield f"{name} has no ratings of left, right, above and below"
    except (ExperimentError, StoryError) as error:
        yield str(error)
