"""One part of the pictures taught, the other asked: every other, or the second half.

In many collections the second half are other things of the same kind.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

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
from kille.lab.scenes.galleries import LOOKING, Categories, Gallery
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Methods

_SHOWN = 12  # wrong answers in a figure


def every_other(
    gallery: Gallery, methods: Methods, *, seed: int, progress: Progress = silent
) -> Result:
    """The pictures with even places are taught, those with odd ones asked for."""
    taught_of = {word: paths[0::2] for word, paths in gallery.categories.items()}
    asked_of = {word: paths[1::2] for word, paths in gallery.categories.items()}
    return _teach_and_ask(
        "Even pictures taught, odd asked",
        gallery,
        methods,
        progress,
        taught_of,
        asked_of,
    )


def halves(
    gallery: Gallery, methods: Methods, *, seed: int, progress: Progress = silent
) -> Result:
    """The first half of each category is taught, the second asked for."""
    cut = {word: (len(paths) + 1) // 2 for word, paths in gallery.categories.items()}
    taught_of = {w: paths[: cut[w]] for w, paths in gallery.categories.items()}
    asked_of = {w: paths[cut[w] :] for w, paths in gallery.categories.items()}
    return _teach_and_ask(
        "First half taught, last half asked",
        gallery,
        methods,
        progress,
        taught_of,
        asked_of,
    )


def _teach_and_ask(
    title: str,
    gallery: Gallery,
    methods: Methods,
    progress: Progress,
    taught_of: Categories,
    asked_of: Categories,
) -> Result:
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
