"""Things that are turned, and other things of the same kind: what carries over to them.

"We also tested" both, says the paper, without numbers.
Source: Dobnik and de Graaf 2017, section 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from kille.lab.measures.statistics import wilson
from kille.lab.progress import Steps
from kille.lab.protocols.teaching import (
    Answer,
    asked,
    confusion_figure,
    mistaken,
    right_cells,
    share_right,
    taught,
)
from kille.lab.results import Cell, Figure, Progress, Result, Table, silent
from kille.lab.scenes.shown_things import LOOKING, OnTable, show_each
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Make, Methods
from kille.sensors.synthetic.catalogue import TOY_NAMES

ANGLES = tuple(range(0, 181, 15))

_FEW = 3  # scans of a look, where the paper's ten would take minutes
_TAUGHT, _ASKED = (0, 1), (2, 3, 4, 5)  # specimens of each kind

Answers = Mapping[str, Mapping[int, Sequence[Answer]]]
"""What each method answered, by the angle things were turned by."""


def rotation(
    methods: Methods,
    *,
    seed: int,
    progress: Progress = silent,
    things: Sequence[str] = TOY_NAMES,
    meshes: str = "",
) -> Result:
    """Each thing is taught once, and asked for turned by ever more, up to its back."""
    table = OnTable(seed, meshes=meshes)
    steps = Steps(progress, (1 + len(ANGLES)) * len(things), 0, LOOKING)
    lessons = show_each(table, things, steps, "lessons")
    questions = {
        angle: show_each(table, things, steps, f"{angle}°", turn=angle, scans=_FEW)
        for angle in ANGLES
    }
    steps = Steps(progress, len(methods) * len(ANGLES) * len(things), LOOKING, 1)
    answers = {
        name: _at_angles(make, lessons, questions, partial(steps, name))
        for name, make in methods.items()
    }
    return Result(
        "Turned things",
        (_turned(answers, len(things)),),
        (_by_angle(answers),),
        {
            "angles": list(ANGLES),
            "methods": {
                name: [share_right(them[angle]) for angle in ANGLES]
                for name, them in answers.items()
            },
        },
    )


def _turned(answers: Answers, things: int) -> Table:
    """The share right at every third angle."""
    told = ANGLES[::3]
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (name, *(share_right(them[angle]) for angle in told))
        for name, them in answers.items()
    )
    return Table(
        "Share right of things that are turned",
        ("method", *(f"{angle}°" for angle in told)),
        rows,
        f"One lesson a thing, {things} things, {_FEW} scans a question.",
    )


def _by_angle(answers: Answers) -> Figure:
    return Figure(
        "curves",
        "Share right of things that are turned",
        {
            "x": list(ANGLES),
            "series": {name: _curve(them) for name, them in answers.items()},
            "xlabel": "turned by, degrees",
            "ylabel": "share right",
        },
    )


def _at_angles(
    make: Make,
    lessons: Sequence[Lesson],
    questions: Mapping[int, Sequence[Lesson]],
    step: Callable[[], None],
) -> dict[int, list[Answer]]:
    learner = taught(make, lessons)
    return {angle: asked(learner, them, step) for angle, them in questions.items()}


def _curve(by_angle: Mapping[int, Sequence[Answer]]) -> dict[str, list[float]]:
    bands = [
        wilson(sum(it.right for it in them), len(them)) for them in by_angle.values()
    ]
    return {
        "mean": [share_right(them) for them in by_angle.values()],
        "low": [low for low, _ in bands],
        "high": [high for _, high in bands],
    }


# --- other things of the same kind ---------------------------------------------------


def specimens(methods: Methods, *, seed: int, progress: Progress = silent) -> Result:
    """Two of each kind are taught, and others of the kind are asked for."""
    count = (len(_TAUGHT) + len(_ASKED)) * len(TOY_NAMES)
    steps = Steps(progress, count, 0, LOOKING)
    lessons = _of_each_kind(_TAUGHT, seed, steps, "lessons")
    questions = _of_each_kind(_ASKED, seed, steps, "new things")
    steps = Steps(progress, len(methods) * len(questions), LOOKING, 1)
    answers = {
        name: asked(taught(make, lessons), questions, partial(steps, name))
        for name, make in methods.items()
    }
    rows = [
        (name, *right_cells(them), mistaken(them)) for name, them in answers.items()
    ]
    return Result(
        "New things of a known kind",
        (
            Table(
                "Is a new cup a cup?",
                ("method", "right", "share", "95 % band", "taken for what"),
                tuple(rows),
                f"{len(_TAUGHT)} things of each kind taught, {len(_ASKED)} others "
                "asked for: other proportions, colours and prints.",
            ),
        ),
        tuple(
            confusion_figure(f"New things, answers of {name}", them)
            for name, them in answers.items()
        ),
        {"methods": {name: share_right(them) for name, them in answers.items()}},
    )


def _of_each_kind(
    specimens: Sequence[int], seed: int, steps: Steps, doing: str
) -> list[Lesson]:
    tables = (OnTable(seed, specimen=number) for number in specimens)
    return [
        lesson
        for table in tables
        for lesson in show_each(table, TOY_NAMES, steps, doing, scans=_FEW)
    ]
