"""Reports of a folder of results, and of two folders side by side."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path
from shlex import quote
from typing import NamedTuple

from kille.lab import log
from kille.lab.errors import StudyError, TheoryError
from kille.lab.log.reading import NO_PYTHON
from kille.lab.measures.measures import ACCURACY
from kille.lab.measures.scored_dialogues import (
    ScoredAnswer,
    ScoredDialogue,
    score_dialogue,
)
from kille.lab.reports.findings import group_by_theory
from kille.lab.reports.layouts import Described
from kille.lab.reports.links import places_of
from kille.lab.reports.name_clashes import differing_names
from kille.lab.reports.repeated_tests import group_tests
from kille.lab.reports.study_report import Subject, every_two, results_of, write
from kille.lab.reports.unused_rules import unused_rules
from kille.lab.results import ExperimentError, Result
from kille.lab.study import MAIN_MEASURES, Study, Theory
from kille.lab.theories.descriptions import describe
from ttr import TTRError
from ttr.safety.consent import Consent

_NAME = "report.html"
_USUAL = ".results"
"""How the names of folders of results end, unless the user names them."""
_NAMED = 5
"""The most words that a warning names."""


class Report(NamedTuple):
    """A page that was written, and the results on it.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.log import Finished, Log
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
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with Log.open(cups, Path(folder)) as log:
    ...         for run in cups.runs():
    ...             _ = log.write(Finished(run, Played((), ()), 0.5))
    ...     made = report(Path(folder), study=cups)
    >>> made.page.name, len(made.results) > 0
    ('report.html', True)
    """

    page: Path
    results: list[Result]


def report(folder: Path, *, command: str = "", study: Study | None = None) -> Report:
    """Write the report of a folder of results into it.

    It is of this study, or else of the one in the log, whose Python is not run. Raises
    StudyError where there are no results, TTRError where the page cannot be written.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.log import Finished, Log
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
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with Log.open(cups, Path(folder)) as log:
    ...         for run in cups.runs():
    ...             _ = log.write(Finished(run, Played((), ()), 0.5))
    ...     report(Path(folder), study=cups).page.name
    'report.html'
    """
    page = folder / _NAME
    subject = _subject(folder, command, study or log.study(folder))
    return Report(page, write(subject, page))


def compare(
    one: Path,
    other: Path,
    page: Path,
    *,
    command: str = "",
    consent: Consent = NO_PYTHON,
) -> Report:
    """Write a report of two folders of results side by side.

    To show their theories, Python is run only with consent.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.log import Finished, Log
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
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     one, other = Path(folder, "one"), Path(folder, "other")
    ...     for it in (one, other):
    ...         with Log.open(cups, it) as log:
    ...             for run in cups.runs():
    ...                 _ = log.write(Finished(run, Played((), ()), 0.5))
    ...     compare(one, other, Path(folder, "both.html")).page.name
    'both.html'
    """
    return Report(page, write(_subject_of_two(one, other, command, consent), page))


def compare_results(
    one: Path, other: Path, consent: Consent = NO_PYTHON
) -> list[Result]:
    """The results of two folders side by side, for a terminal.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.log import Finished, Log
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
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     one, other = Path(folder, "one"), Path(folder, "other")
    ...     for it in (one, other):
    ...         with Log.open(cups, it) as log:
    ...             for run in cups.runs():
    ...                 _ = log.write(Finished(run, Played((), ()), 0.5))
    ...     found = compare_results(one, other)
    >>> len(found) > 0
    True
    """
    subject = _subject_of_two(one, other, "", consent)
    everything = [it for them in subject.theories.values() for it in them]
    return results_of(subject, places_of(list(subject.theories), everything, ""))


# --- one folder ----------------------------------------------------------------------


def _subject(folder: Path, command: str, study: Study) -> Subject:
    dialogues = [score_dialogue(*it) for it in log.read(folder)]
    theories = group_by_theory(list(study.theories), dialogues)
    shown = _describe_theories(study, theories or study.theories)
    return Subject(
        study.title,
        theories,
        shown,
        [it for it in study.contrasts if theories.keys() >= {*it}]
        or every_two(theories),
        group_tests(study.phases),
        _about(folder, study, command, len(dialogues)),
        main=MAIN_MEASURES[study.main],
        lead=study.about,
        numbers=study.in_numbers(played=len(dialogues)),
        source=study.source,
        broken=[(str(it.run), it.reason) for it in log.broken_runs(folder)],
        warnings=[
            *_cut_short_lines(theories, study.turns),
            *_never_taught_lines(theories),
            *unused_rules(shown, theories),
        ],
        files=sorted(
            it.name for it in folder.iterdir() if it.suffix in (".csv", ".parquet")
        ),
    )


def _cut_short_lines(
    theories: Mapping[str, Sequence[ScoredDialogue]], most: int
) -> list[str]:
    """Warn of theories whose dialogues came to the last turn that the study allows.

    A theory that talks more is then asked less.
    """
    counts = {
        name: sum(len(it.turns) >= most for it in them)
        for name, them in theories.items()
    }
    return [
        f"{name}: {count:,} of {len(theories[name]):,} dialogues came to turn "
        f"{most:,}, the last that the study allows: if there was anything still to be "
        f"asked, it was not asked in them. Give the study more turns."
        for name, count in counts.items()
        if count
    ]


def _never_taught_lines(
    theories: Mapping[str, Sequence[ScoredDialogue]],
) -> Iterator[str]:
    """Warn if most questions were about words that nobody had said by then.

    The robot did not know them either: no theory can answer such a question.
    """
    asked, missing = 0, []
    for talk in chain.from_iterable(theories.values()):
        questions = [it for it in talk.answers if it.is_word]
        asked += len(questions)
        missing += [it.right for it in questions if not _can_be_known(it, talk)]
    if not missing or 2 * len(missing) < asked:
        return
    words = ", ".join(sorted(set(missing))[:_NAMED])
    more = " and others" if len(set(missing)) > _NAMED else ""
    yield (
        f"{len(missing):,} of {asked:,} questions were about words that nobody had "
        f"said by then and that the robot did not know ({words}{more}): no theory "
        "can be right. Teach more things, as with each = 6 in a drawn scene."
    )


def _can_be_known(answer: ScoredAnswer, talk: ScoredDialogue) -> bool:
    """Had somebody said the word of an answer before, or did the robot know it?"""
    if answer.is_possible:
        return True
    said = (it.given for it in talk.turns if it.number < answer.turn and it.words)
    word = re.compile(rf"\b{re.escape(answer.right)}\b")
    return any(map(word.search, said))


def _describe_theories(study: Study, names: Iterable[str]) -> dict[str, Described]:
    return {name: _describe_theory(study.theories[name]) for name in names}


def _describe_theory(theory: Theory) -> Described:
    """Describe a theory by its parts, or say why it cannot be shown."""
    try:
        return describe(theory)
    except (TheoryError, ExperimentError, TTRError, OSError) as error:
        return {"about": f"{theory.about} It cannot be shown: {error}".strip()}


def _about(folder: Path, study: Study, command: str, count: int) -> Mapping[str, str]:
    about = log.about(folder)
    versions = ", ".join(f"{name} {it}" for name, it in about.versions.items())
    lines = {
        "command": command,
        "to repeat it": f"kille experiment run {quote(study.file.name)}",
        "theories": ", ".join(study.theories),
        "tutors": ", ".join(study.tutors),
        "scenes": ", ".join(study.scenes),
        "seeds": _format_seeds(study.seeds),
        "dialogues": f"{count:,} of {about.planned:,} played to their end",
        "begun": about.began,
        "versions": versions,
    }
    return {head: text for head, text in lines.items() if text}


def _format_seeds(seeds: tuple[int, ...]) -> str:
    """Format seeds in short.

    >>> _format_seeds((1, 2, 3, 4)), _format_seeds((3, 7))
    ('1 to 4', '3, 7')
    """
    first, last = min(seeds), max(seeds)
    if len(seeds) > 2 and seeds == tuple(range(first, last + 1)):
        return f"{first} to {last}"
    return ", ".join(map(str, seeds))


# --- two folders ---------------------------------------------------------------------


def _subject_of_two(one: Path, other: Path, command: str, consent: Consent) -> Subject:
    """Both folders as one subject.

    Theories of the same name are compared; if there are none, each with each.
    """
    studies = [log.study(folder, consent) for folder in (one, other)]
    first = _subject(one, command, studies[0])
    second = _subject(other, command, studies[1])
    names = _name_folders(one, other)
    common = [name for name in first.theories if name in second.theories]
    which = [(name, name) for name in common] or [
        (name, it) for name in first.theories for it in second.theories
    ]
    subjects = dict(zip(names, (first, second), strict=True))
    theories = {
        f"{label}: {name}": [_rename_theory(it, f"{label}: {name}") for it in them]
        for label, subject in subjects.items()
        for name, them in subject.theories.items()
    }
    shared = _common_occasions(first, second, one, other)
    return Subject(
        f"{names[1]} against {names[0]}",
        theories,
        {
            f"{label}: {name}": it
            for label, subject in subjects.items()
            for name, it in subject.described.items()
        },
        [(f"{names[0]}: {a}", f"{names[1]}: {b}") for a, b in which],
        tuple(dict.fromkeys([*first.tests, *second.tests])),
        {
            "command": command,
            **{
                f"{label}: {head}": text
                for label, subject in subjects.items()
                for head, text in subject.about.items()
                if head != "command"
            },
        },
        main=first.main if first.main == second.main else ACCURACY.name,
        numbers="; ".join(f"{label}: {it.numbers}" for label, it in subjects.items()),
        broken=[
            (f"{label}: {name}", reason)
            for label, subject in subjects.items()
            for name, reason in subject.broken
        ],
        warnings=[
            *shared,
            *differing_names(*studies),
            *(
                f"{label}: {text}"
                for label, subject in subjects.items()
                for text in subject.warnings
            ),
        ],
    )


def _name_folders(one: Path, other: Path) -> tuple[str, str]:
    """Names for two folders: their own, or their paths if these are the same."""
    if os.path.realpath(one) == os.path.realpath(other):
        raise StudyError([f"{one} and {other} are one folder: name two"])
    names = [
        Path(os.path.realpath(it)).name.removesuffix(_USUAL) for it in (one, other)
    ]
    return (names[0], names[1]) if names[0] != names[1] else (str(one), str(other))


def _rename_theory(dialogue: ScoredDialogue, theory: str) -> ScoredDialogue:
    return replace(dialogue, run=replace(dialogue.run, theory=theory))


def _common_occasions(
    first: Subject, second: Subject, one: Path, other: Path
) -> list[str]:
    """Warn if two studies were not played on the same occasions."""
    mine, theirs = (
        {it.pair for them in subject.theories.values() for it in them}
        for subject in (first, second)
    )
    both = len(mine & theirs)
    if not both:
        raise StudyError(
            [
                f"{one} and {other} have no dialogues with the same tutor, scene and "
                f"seed: compare results of studies with the same tutors, scenes and "
                f"seeds"
            ]
        )
    if mine == theirs:
        return []
    return [
        f"Of {len(mine):,} and {len(theirs):,} occasions (tutor, scene and seed) "
        f"{both:,} are the same: differences are of these alone, all else is of all."
    ]
