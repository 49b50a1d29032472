"""What only the world, or the study, can tell is wrong with a tutor."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from inspect import signature
from typing import Any

from kille.lab.errors import StudyError
from kille.lab.results import ExperimentError
from kille.lab.settings import Wrong, no_file, no_folder, shown, unknown
from kille.lab.study import Named, Study
from kille.lab.tutors.own import located, maker_of
from kille.lab.tutors.place_words import SIDES, rated
from kille.lab.tutors.scripted import unplayable
from kille.lab.tutors.words import Words
from ttr.dialogues.stories import StoryError, read_stories


def faults(named: Named, study: Study) -> Iterator[Wrong]:
    """What is wrong with a tutor in this study, each with the setting it is in."""
    match named.kind:
        case "scripted":
            yield from _at("file", _of_script(named.settings["file"], study))
        case "people":
            yield from _at("folder", _of_people(named.settings["folder"], study))
            yield from _of_calls(named)
        case "simulated":
            yield from _of_calls(named)
        case "own":
            yield from _of_own(named, study)
        case "several":
            yield from _at("of", _of_several(named, study))


def _at(key: str, what: Iterator[str]) -> Iterator[Wrong]:
    return (((key,), it) for it in what)


def _of_script(name: str, study: Study) -> Iterator[str]:
    """Why a script cannot be played, if it cannot."""
    path = study.folder / os.path.expanduser(name)
    if told := no_file(path):
        yield told
        return
    try:
        lines = [line for story in read_stories(path) for line in story.lines]
    except StoryError as error:
        yield str(error)
        return
    yield from unplayable(lines, study)


def _of_people(name: str, study: Study) -> Iterator[str]:
    """Why people's ratings cannot be used, if they cannot."""
    path = study.folder / os.path.expanduser(name)
    if told := no_folder(path):
        yield told
        return
    try:
        if not set(rated(path).words) >= SIDES:
            yield f"{name} has no ratings of left, right, above and below"
    except ExperimentError as error:
        yield str(error)


def _of_calls(named: Named) -> Iterator[Wrong]:
    for one, called in named.settings.get("calls", {}).items():
        if not isinstance(called, str):
            told = f'a {one} is called a text, as in {{ {one} = "cup" }}'
            yield ("calls", one), f"{told}, and not {shown(called)}"


def _of_several(named: Named, study: Study) -> Iterator[str]:
    of = [*dict.fromkeys(named.settings["of"])]
    for name in of:
        if name not in study.tutors:
            yield f"there is no tutor {name}: {unknown(name, study.tutors)}"
        elif study.tutors[name].kind == "several":
            yield f"{name} is several tutors already: name them one by one"
        elif of == [name]:
            yield f"{name} alone is not several: name another tutor, too"


# --- tutors of one's own --------------------------------------------------------------


def _of_own(named: Named, study: Study) -> Iterator[Wrong]:
    """Why a tutor of one's own cannot be made, if he cannot."""
    settings = named.settings.get("settings", {})
    if taken := [it for it in ("name", "words") if it in settings]:
        yield ("settings", taken[0]), f"{taken[0]} is not to be set: the study gives it"
        return
    given = {"name": named.name, "words": _words(study), **settings}
    yield from _at("make", _of_made(named.settings["make"], given, study))


def _of_made(make: str, given: Mapping[str, Any], study: Study) -> Iterator[str]:
    try:
        maker = maker_of(make, study.folder, study.consent)
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
        told = located(make.rpartition(":")[0], study.folder, error)
        yield f"{make} makes no tutor: {told}"
        return
    for needed in lacking:
        yield f"a tutor needs {needed}, and what {make} makes has none"


def _words(study: Study) -> Words:
    """The words of one of the languages that are spoken."""
    languages = (theory.language for theory in study.theories.values())
    return Words(next(languages, "en"))
