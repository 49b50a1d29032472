"""What a study names that its user has not consented to: Python, and odd files.

It is told before anything of the study is tried, so that nothing is run.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

from kille.dialogue.language_files import FILES
from kille.lab.errors import StudyError
from kille.lab.settings import Key, Problem
from kille.lab.study import Study, Theory
from kille.lab.study_files.problems import format_problems
from ttr.safety.consent import NotAllowedError, check_called


def python_in(study: Study) -> tuple[str, ...]:
    """The Python files and modules that a study names, each once."""
    return tuple(dict.fromkeys(name for _, name in _python_named(study)))


def check_allowed(study: Study) -> None:
    """Raise `StudyError` with a line for each thing that a study may not use."""
    if found := [*refused_names(study)]:
        raise StudyError(format_problems(found, study.source, study.file))


def refused_names(study: Study) -> Iterator[Problem]:
    """What a study may not use; nothing if it was made in Python."""
    consent = study.consent
    if consent is None:
        return
    for key, name in _python_named(study):
        yield from _refusals(
            key, lambda it: consent.check_python(it, study.folder), name
        )
    for name, theory in study.theories.items():
        for inner, path in _files_named(theory):
            key = ("theories", name, *inner)
            yield from _refusals(
                key, lambda it: check_called(it, _expected_ending(it)), path
            )
    for name, tutor in study.tutors.items():
        if tutor.kind == "scripted":
            path = str(study.path(tutor.settings["file"]))
            key = ("tutors", name, "file")
            yield from _refusals(key, lambda it: check_called(it, ".dlg"), path)


def _python_named(study: Study) -> Iterator[tuple[Key, str]]:
    """The Python that a study names, each with its key."""
    for name, theory in study.theories.items():
        if (module := _module_named(theory.rules)).endswith(".py"):
            yield ("theories", name, "rules"), module
        for kind, learner in theory.learners.items():
            if module := _module_named(learner):
                yield ("theories", name, "learners", kind), module
    for name, tutor in study.tutors.items():
        if tutor.kind == "own" and (module := _module_named(tutor.settings["make"])):
            yield ("tutors", name, "make"), module


def _module_named(reference: str) -> str:
    """The file or module in FILE.py:NAME or MODULE:NAME; empty for other names."""
    return os.path.expanduser(reference.rpartition(":")[0])


def _files_named(theory: Theory) -> Iterator[tuple[Key, str]]:
    """The files that a theory names, each with its key."""
    if theory.rules.endswith(".ttr"):
        yield ("rules",), theory.rules
    if isinstance(theory.meanings, str) and theory.meanings:
        yield ("meanings",), theory.meanings
    for file in FILES if theory.grammar is not None else ():
        assert theory.grammar is not None
        yield ("grammar",), str(theory.grammar / file.format(theory.language))


def _expected_ending(path: str) -> str:
    """The ending that a file must have: that of a packaged file, or `.ttr`."""
    ending = Path(path).suffix
    return ending if ending in {Path(it).suffix for it in FILES} else ".ttr"


def _refusals(key: Key, check: Callable[[str], None], name: str) -> Iterator[Problem]:
    try:
        check(name)
    except NotAllowedError as error:
        yield Problem(key, error.message)
