"""The paper's protocol for objects: ten things on a table, taught and asked for.

There are four rounds. In each, the robot is shown and taught all things in a fixed
order, then shown all again, each in another pose, and asked. It takes ten scans each
time, whose scores are averaged. A thing is taken for the word with the highest mean
over the rounds; its margin, the mean of the right word less that of the best other,
says how distinct it is. After the last round everything is asked once more, turned by
45 degrees further.
Source: Dobnik and de Graaf 2017, KILLE: a framework for situated agents for learning
language through interaction, section 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from kille.lab.measures.statistics import brier, distinctness
from kille.lab.progress import Steps
from kille.lab.protocols.teaching import (
    ObjectAnswer,
    answers_figure,
    ask,
    format_mistakes,
    mean_degrees,
    right_cells,
    share_right,
)
from kille.lab.results import Cell, Figure, Progress, Result, Table, silent
from kille.lab.scenes.shown_things import LOOKING, OnTable, cut_out, show_each
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Make, Methods
from kille.sensors.synthetic.catalogue import TOY_NAMES

ROUNDS = 4
TURNED = 45.0

_PAPERS = (
    "book",
    "car",
    "shoe",
    "cup",
    "banana",
    "teddy bear",
    "apple",
    "can of paint",
    "shoe-box",
    "cap",
)


@dataclass(frozen=True)
class _MethodAnswers:
    """The answers of one method: round by round, and turned after the last round."""

    rounds: Sequence[Sequence[ObjectAnswer]]
    turned: Sequence[ObjectAnswer]

    @property
    def every(self) -> list[ObjectAnswer]:
        return [answer for answers in self.rounds for answer in answers]

    @property
    def means(self) -> list[ObjectAnswer]:
        """For each thing the means over the rounds."""
        return [mean_degrees(them) for them in zip(*self.rounds, strict=True)]


def paper(
    methods: Methods,
    *,
    seed: int,
    progress: Progress = silent,
    things: Sequence[str] = TOY_NAMES,
    rounds: int = ROUNDS,
    meshes: str = "",
) -> Result:
    """Rounds of lessons and questions, for all methods with the same looks."""
    table = OnTable(seed, meshes=meshes)
    steps = Steps(progress, (2 * rounds + 1) * len(things), 0, LOOKING)
    lessons, questions = [], []
    for number in range(1, rounds + 1):
        lessons.append(show_each(table, things, steps, f"round {number}, lessons"))
        questions.append(show_each(table, things, steps, f"round {number}, questions"))
    turned = show_each(table, things, steps, "questions, turned", turn=TURNED)
    steps = Steps(progress, len(methods) * (rounds + 1) * len(things), LOOKING, 1)
    courses = {
        name: _run_rounds(make, lessons, questions, turned, partial(steps, name))
        for name, make in methods.items()
    }
    size = f"{_count_in_words(len(things))} things, {_count_of(rounds, 'round')}"
    return Result(
        f"{size} of lessons and questions",
        (
            _scores(courses),
            _by_round(courses),
            _rank_table(courses, things),
            _mistakes(courses),
        ),
        _figures(courses, questions[0]),
        {
            "things": list(things),
            "rounds": rounds,
            "methods": {name: _facts(course) for name, course in courses.items()},
        },
    )


def _run_rounds(
    make: Make,
    lessons: Sequence[Sequence[Lesson]],
    questions: Sequence[Sequence[Lesson]],
    turned: Sequence[Lesson],
    step: Callable[[], None],
) -> _MethodAnswers:
    learner = make()
    rounds = []
    for some, asking in zip(lessons, questions, strict=True):
        for percept, word in some:
            learner.learn_one(percept, word)
        rounds.append(ask(learner, asking, step))
    return _MethodAnswers(rounds, ask(learner, turned, step))


def _scores(courses: Mapping[str, _MethodAnswers]) -> Table:
    return Table(
        "Which thing is it?",
        (
            "method",
            "right",
            "right, single questions",
            f"right, turned {TURNED:.0f}°",
            "mean margin",
            "least margin",
            "least, turned",
            "Brier",
        ),
        tuple((name, *_score(course)) for name, course in courses.items()),
        "Right: the word with the highest mean over the rounds; KILLE had 9 of 10. "
        "Margin: the right word's degree less that of the best other. "
        "Brier: 0 is best, 2 worst.",
    )


def _score(course: _MethodAnswers) -> tuple[Cell, ...]:
    margins = [it.margin for it in course.means]
    return (
        right_cells(course.means)[0],
        right_cells(course.every)[0],
        right_cells(course.turned)[0],
        float(np.mean(margins)),
        min(margins),
        min(it.margin for it in course.turned),
        brier([it.word for it in course.every], [it.degrees for it in course.every]),
    )


def _by_round(courses: Mapping[str, _MethodAnswers]) -> Table:
    rows = tuple(
        (name, *(right_cells(answers)[0] for answers in course.rounds))
        for name, course in courses.items()
    )
    rounds = len(next(iter(courses.values())).rounds)
    heads = tuple(f"round {number}" for number in range(1, rounds + 1))
    return Table("Right by round", ("method", *heads), rows)


def _rank_table(courses: Mapping[str, _MethodAnswers], things: Sequence[str]) -> Table:
    columns = {
        name: [
            f"{word} {margin:.2f}"
            for word, margin in distinctness(
                {it.word: [it.margin] for it in course.means}
            )
        ]
        for name, course in courses.items()
    }
    if set(things) == set(_PAPERS):
        columns = {"KILLE's robot": list(_PAPERS)} | columns
    rows = tuple(
        (place, *words)
        for place, words in enumerate(zip(*columns.values(), strict=True), start=1)
    )
    return Table(
        "Ranking by distinctness",
        ("", *columns),
        rows,
        "The most distinct first, with its margin."
        + " The first column is of the paper's own ten things, which were others."
        * ("KILLE's robot" in columns),
    )


def _mistakes(courses: Mapping[str, _MethodAnswers]) -> Table:
    rows = []
    for name, course in courses.items():
        kinds = (course.means, course.every, course.turned)
        rows.append((name, *(format_mistakes(them) for them in kinds)))
    return Table(
        "What was taken for what",
        ("method", "over the rounds", "in single questions", "turned"),
        tuple(rows),
    )


def _figures(
    courses: Mapping[str, _MethodAnswers], questions: Sequence[Lesson]
) -> tuple[Figure, ...]:
    """The confusions and margins of each method, and the looks of the first round."""
    confusions = (
        answers_figure(f"Answers of {name}, all rounds", course.every)
        for name, course in courses.items()
    )
    margins = (_margins(name, course) for name, course in courses.items())
    return *confusions, *margins, _pictures(questions, courses)


def _margins(name: str, course: _MethodAnswers) -> Figure:
    ranked = sorted(course.means, key=lambda it: -it.margin)
    by_word = {
        mean.word: [them[i].margin for them in course.rounds]
        for i, mean in enumerate(course.means)
    }
    return Figure(
        "bars",
        f"Margins of {name}",
        {
            "labels": [it.word for it in ranked],
            "values": [it.margin for it in ranked],
            "low": [min(by_word[it.word]) for it in ranked],
            "high": [max(by_word[it.word]) for it in ranked],
            "ylabel": "margin, mean and range of the rounds",
        },
    )


def _pictures(
    questions: Sequence[Lesson], courses: Mapping[str, _MethodAnswers]
) -> Figure:
    """The things as they were asked for in the first round, and what was answered."""
    first = {name: course.rounds[0] for name, course in courses.items()}
    shown = [
        (cut_out(percept), [(name, answers[i]) for name, answers in first.items()])
        for i, (percept, _) in enumerate(questions)
    ]
    kept = [(picture, said) for picture, said in shown if picture is not None]
    return Figure(
        "pictures",
        "The first round, and what was answered",
        {
            "pictures": [picture for picture, _ in kept],
            "captions": [
                "\n".join(f"{name}: {it.said} {it.best:.2f}" for name, it in said)
                for _, said in kept
            ],
            "good": [all(it.right for _, it in said) for _, said in kept],
        },
    )


def _facts(course: _MethodAnswers) -> dict[str, object]:
    return {
        "right": sum(it.right for it in course.means),
        "right_turned": sum(it.right for it in course.turned),
        "share_of_single_questions": share_right(course.every),
        "margins": {it.word: it.margin for it in course.means},
        "margins_turned": {it.word: it.margin for it in course.turned},
    }


def _count_in_words(count: int) -> str:
    return "Ten" if count == 10 else str(count)


def _count_of(count: int, noun: str) -> str:
    return f"{count} {noun}{'s' * (count != 1)}"
