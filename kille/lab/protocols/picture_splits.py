"""Teach a part of the pictures and ask for the rest: every other, or the second half.

In many collections the second half shows other things of the same kind.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TypeAlias

from kille.lab.measures.statistics import kappa
from kille.lab.progress import Steps
from kille.lab.protocols.teaching import (
    ObjectAnswer,
    answers_figure,
    ask,
    right_cells,
    share_right,
    teach,
)
from kille.lab.results import (
    Cell,
    ExperimentError,
    Figure,
    Progress,
    Result,
    Table,
    silent,
)
from kille.lab.scenes.galleries import LOOKING, Gallery
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Methods

_SHOWN = 12  # wrong answers in a figure

_Paths: TypeAlias = Sequence[Path]


def every_other(
    gallery: Gallery, methods: Methods, *, seed: int, progress: Progress = silent
) -> Result:
    """The pictures with even places are taught, those with odd ones asked for."""
    return _teach_and_ask(
        "Even pictures taught, odd asked",
        gallery,
        methods,
        progress,
        lambda paths: (paths[0::2], paths[1::2]),
    )


def halves(
    gallery: Gallery, methods: Methods, *, seed: int, progress: Progress = silent
) -> Result:
    """The first half of each category is taught, the second asked for."""

    def split(paths: _Paths) -> tuple[_Paths, _Paths]:
        half = (len(paths) + 1) // 2
        return paths[:half], paths[half:]

    title = "First half taught, last half asked"
    return _teach_and_ask(title, gallery, methods, progress, split)


def _teach_and_ask(
    title: str,
    gallery: Gallery,
    methods: Methods,
    progress: Progress,
    split: Callable[[_Paths], tuple[_Paths, _Paths]],
) -> Result:
    """Teach and ask the two parts into which each category is split."""
    parts = {word: split(paths) for word, paths in gallery.categories.items()}
    taught_of = {word: taught for word, (taught, _) in parts.items()}
    asked_of = {word: asked for word, (_, asked) in parts.items()}
    if not any(asked_of.values()):
        raise ExperimentError(f"{gallery.name}: no category has a second picture")
    gallery.look(progress, LOOKING)
    lessons, questions = gallery.lessons(taught_of), gallery.lessons(asked_of)
    steps = Steps(progress, len(methods) * len(questions), LOOKING, 1)
    answers = {
        name: ask(teach(make, lessons), questions, partial(steps, name))
        for name, make in methods.items()
    }
    return Result(
        title,
        (
            Table(
                "Which category is it?",
                ("method", "right", "share", "95 % band", "κ"),
                tuple((name, *_score_cells(them)) for name, them in answers.items()),
                f"{len(lessons)} pictures taught. {gallery.note}".strip(),
            ),
            _by_category(answers),
        ),
        _figures(questions, answers),
        {
            "taught": len(lessons),
            "asked": len(questions),
            "left_out": list(gallery.unread),
            "methods": {name: share_right(them) for name, them in answers.items()},
        },
    )


def _score_cells(answers: Sequence[ObjectAnswer]) -> tuple[Cell, ...]:
    words, said = [it.word for it in answers], [it.said for it in answers]
    return (*right_cells(answers), kappa(words, said))


def _by_category(answers: Mapping[str, Sequence[ObjectAnswer]]) -> Table:
    words = list(dict.fromkeys(it.word for them in answers.values() for it in them))
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (
            word,
            *(
                share_right([it for it in them if it.word == word])
                for them in answers.values()
            ),
        )
        for word in words
    )
    return Table("Share right by category", ("category", *answers), rows)


def _figures(
    questions: Sequence[Lesson], answers: Mapping[str, Sequence[ObjectAnswer]]
) -> tuple[Figure, ...]:
    confusions = (
        answers_figure(f"Answers of {name}", them) for name, them in answers.items()
    )
    wrong = (_mistakes_figure(name, questions, them) for name, them in answers.items())
    return *confusions, *wrong


def _mistakes_figure(
    name: str, questions: Sequence[Lesson], answers: Sequence[ObjectAnswer]
) -> Figure:
    """The mistakes that were made with the highest degrees."""
    wrong = [i for i, answer in enumerate(answers) if not answer.right]
    surest = sorted(wrong, key=lambda i: -answers[i].best)[:_SHOWN]
    frames = [questions[i][0].frame for i in surest]
    pictures = [frame.colour for frame in frames if frame is not None]
    captions = [
        f"{answers[i].word}\nsaid: {answers[i].said} {answers[i].best:.2f}"
        for i in surest
    ]
    return Figure(
        "pictures",
        f"Mistakes of {name}, the surest first",
        {"pictures": pictures, "captions": captions, "good": [False] * len(captions)},
    )
