"""Does what was learned carry over to turned things, and to others of the same kind?

"We also tested" both, says the paper, without numbers.
Source: Dobnik and de Graaf 2017, section 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from kille.lab.progress import Steps
from kille.lab.protocols.teaching import (
    ObjectAnswer,
    answers_figure,
    ask,
    estimate_right,
    format_mistakes,
    right_cells,
    share_right,
    teach,
)
from kille.lab.results import (
    Cell,
    Figure,
    Progress,
    Result,
    Table,
    interval_series,
    silent,
)
from kille.lab.scenes.shown_things import LOOKING, OnTable, show_each
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Make, Methods
from kille.sensors.synthetic.catalogue import TOY_NAMES

ANGLES = tuple(range(0, 181, 15))

_FEW = 3  # scans of a look, where the paper's ten would take minutes
_TAUGHT, _ASKED = (0, 1), (2, 3, 4, 5)  # specimens of each kind

Answers = Mapping[str, Mapping[int, Sequence[ObjectAnswer]]]
"""What each method answered, by the angle things were turned by."""


def rotation(
    methods: Methods,
    *,
    seed: int,
    progress: Progress = silent,
    things: Sequence[str] = TOY_NAMES,
    meshes: str = "",
) -> Result:
    """Teach each thing once, and ask for it turned ever further, up to its back."""
    table = OnTable(seed, meshes=meshes)
    steps = Steps(progress, (1 + len(ANGLES)) * len(things), 0, LOOKING)
    lessons = show_each(table, things, steps, "lessons")
    questions = {
        angle: show_each(table, things, steps, f"{angle}°", turn=angle, scans=_FEW)
        for angle in ANGLES
    }
    steps = Steps(progress, len(methods) * len(ANGLES) * len(things), LOOKING, 1)
    answers = {
        name: _ask_at_angles(make, lessons, questions, partial(steps, name))
        for name, make in methods.items()
    }
    return Result(
        "Turned things",
        (_turned_table(answers, len(things)),),
        (_angle_figure(answers),),
        {
            "angles": list(ANGLES),
            "methods": {
                name: [share_right(them[angle]) for angle in ANGLES]
                for name, them in answers.items()
            },
        },
    )


def _turned_table(answers: Answers, things: int) -> Table:
    """The share right at every third angle."""
    angles = ANGLES[::3]
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (name, *(share_right(them[angle]) for angle in angles))
        for name, them in answers.items()
    )
    return Table(
        "Share right of things that are turned",
        ("method", *(f"{angle}°" for angle in angles)),
        rows,
        f"One lesson a thing, {things} things, {_FEW} scans a question.",
    )


def _angle_figure(answers: Answers) -> Figure:
    return Figure(
        "curves",
        "Share right of things that are turned",
        {
            "x": list(ANGLES),
            "series": {
                name: interval_series([*map(estimate_right, them.values())], "mean")
                for name, them in answers.items()
            },
            "xlabel": "turned by, degrees",
            "ylabel": "share right",
        },
    )


def _ask_at_angles(
    make: Make,
    lessons: Sequence[Lesson],
    questions: Mapping[int, Sequence[Lesson]],
    step: Callable[[], None],
) -> dict[int, list[ObjectAnswer]]:
    learner = teach(make, lessons)
    return {angle: ask(learner, them, step) for angle, them in questions.items()}


# --- other things of the same kind ---------------------------------------------------


def specimens(methods: Methods, *, seed: int, progress: Progress = silent) -> Result:
    """Teach two things of each kind, and ask for others of the same kind."""
    count = (len(_TAUGHT) + len(_ASKED)) * len(TOY_NAMES)
    steps = Steps(progress, count, 0, LOOKING)
    lessons = _of_each_kind(_TAUGHT, seed, steps, "lessons")
    questions = _of_each_kind(_ASKED, seed, steps, "new things")
    steps = Steps(progress, len(methods) * len(questions), LOOKING, 1)
    answers = {
        name: ask(teach(make, lessons), questions, partial(steps, name))
        for name, make in methods.items()
    }
    rows = [
        (name, *right_cells(them), format_mistakes(them))
        for name, them in answers.items()
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
            answers_figure(f"New things, answers of {name}", them)
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
