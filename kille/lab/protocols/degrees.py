"""Do degrees mean what they say, and what would a robot assert that goes by them?

A run draws categories and shuffles the pictures of each. Half of the categories are
taught, from one, three, five and ten pictures, and the last six pictures (or a third,
where a category has few) are asked for, first of what was taught, then of the rest: so
half of what is asked was never taught, and whatever is said of it is wrong. A robot
asserts its best word where this has a degree of .6, and .3 more than any other word,
and says that it does not know below .2, as in the paper's wording. A learner that can
reckon with strangers (`kille.perception.strangers`) is asked once more in an order of
chance, only for what was taught and for both, by a tutor who tells it after each answer
whether the thing was known; the fewer strangers it reckons with, the farther ahead a
word must be, up to .6.

The calibration error is the mean distance, over ten bins, of the degrees of the best
word from the share in which it is right. Wrong assertions are counted among all that
is asked, not among assertions.
Source: Guo et al. 2017, On calibration of modern neural networks; for open sets,
Scheirer et al. 2013, Toward open set recognition.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from kille.lab.measures.statistics import (
    calibration_error,
    mean_and_range,
    reliability,
    wilson,
)
from kille.lab.progress import Steps
from kille.lab.protocols.shots import RUNS, SHOTS, asked_of_each, draw_pictures
from kille.lab.protocols.teaching import ObjectAnswer, ask, share_right, teach
from kille.lab.results import (
    Cell,
    Estimate,
    ExperimentError,
    Figure,
    Progress,
    Result,
    Table,
    interval_series,
    silent,
)
from kille.lab.scenes.galleries import LOOKING, Gallery
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Methods
from kille.perception.strangers import share_of_strangers

SURE, MARGIN, LIKELY = 0.6, 0.3, 0.2
"""From which degree on a robot asserts, how far ahead of others, and when it speaks."""

NAME_MARGIN = 0.6
"""How far ahead of others where it reckons with no strangers at all."""

_Run = tuple[Sequence[ObjectAnswer], Sequence[ObjectAnswer]]
"""The answers about what was taught, and about what was not."""

_Answers = Mapping[int, Sequence[_Run]]
"""The answers of each run, by the number of pictures taught of each category."""


def degrees(
    gallery: Gallery, methods: Methods, *, seed: int, progress: Progress = silent
) -> Result:
    """How far degrees are off, and what would be asserted, rightly and wrongly."""
    count = asked_of_each(gallery)
    numbers = [shot for shot in SHOTS if shot <= gallery.least - count]
    if not numbers or len(gallery.categories) < 2:
        raise ExperimentError(
            f"{gallery.name}: to teach one category and ask another it takes two of "
            "two pictures at least"
        )
    gallery.look(progress, LOOKING)
    steps = Steps(progress, RUNS * len(numbers) * len(methods), LOOKING, 1)
    found: dict[str, dict[int, list[_Run]]] = {
        name: {number: [] for number in numbers} for name in methods
    }
    told: dict[str, dict[int, list[_Run]]] = {}
    chance = np.random.default_rng([seed, 93])
    for number, lessons, taught, strange in _runs(gallery, numbers, count, seed):
        for name, make in methods.items():
            learner = teach(make, lessons)
            answers = ask(learner, taught), ask(learner, strange)
            found[name][number].append(answers)
            if hasattr(learner, "reckon_with"):
                runs = told.setdefault(name, {it: [] for it in numbers})
                runs[number].append(_tell(*answers, chance))
            steps(name)
    return Result(
        "Do degrees mean what they say?",
        (*_tables(found, numbers, gallery), *_told_tables(told, numbers)),
        tuple(_figures(found, numbers)),
        {
            "runs": RUNS,
            "shots": numbers,
            "asked_of_each": count,
            "left_out": list(gallery.unread),
            "methods": {name: _facts(them) for name, them in found.items()},
            "told": {name: _told_facts(them) for name, them in told.items()},
        },
    )


def _runs(
    gallery: Gallery, numbers: Sequence[int], count: int, seed: int
) -> Iterator[tuple[int, list[Lesson], list[Lesson], list[Lesson]]]:
    """Lessons, questions about what is taught, and others, by pictures taught."""
    for run in range(RUNS):
        chance = np.random.default_rng([RUNS * seed + run, len(gallery.categories)])
        order = chance.permutation(sorted(gallery.categories)).tolist()
        drawn = draw_pictures(gallery, order, chance)
        half = (len(order) + 1) // 2
        asked = {word: them[-count:] for word, them in drawn.items()}
        taught, strange = (
            gallery.lessons({word: asked[word] for word in words})
            for words in (order[:half], order[half:])
        )
        for number in numbers:
            lessons = gallery.lessons({it: drawn[it][:number] for it in order[:half]})
            yield number, lessons, taught, strange


def _tell(
    taught: Sequence[ObjectAnswer],
    strange: Sequence[ObjectAnswer],
    chance: np.random.Generator,
) -> _Run:
    """The answers of who is told after each whether the thing was known: where only
    what was taught is asked for, and where strangers are, too."""
    return (
        _tell_in_turn([(it, True) for it in taught], chance),
        _tell_in_turn(
            [*((it, True) for it in taught), *((it, False) for it in strange)], chance
        ),
    )


def _tell_in_turn(
    asked: Sequence[tuple[ObjectAnswer, bool]], chance: np.random.Generator
) -> Sequence[ObjectAnswer]:
    answers, told = [], list[bool]()
    for i in chance.permutation(len(asked)).tolist():
        answer, is_known = asked[i]
        answers.append(_reckon_with(answer, told))
        told.append(is_known)
    return answers


def _reckon_with(answer: ObjectAnswer, known: Sequence[bool]) -> ObjectAnswer:
    """The answer where so many strangers are to be reckoned with."""
    rest = max(1.0 - sum(answer.degrees.values()), 0.0)
    share = share_of_strangers(known)
    whole = 1.0 - rest + rest * share / (1.0 - share)
    degrees = {word: degree / whole for word, degree in answer.degrees.items()}
    return ObjectAnswer(answer.word, degrees, share)


def is_asserted(answer: ObjectAnswer) -> bool:
    """Would a robot assert the word that is said?

    >>> is_asserted(ObjectAnswer("cup", {"cup": 0.7, "mug": 0.2}))
    True
    >>> is_asserted(ObjectAnswer("cup", {"cup": 0.6, "mug": 0.4}))
    False
    """
    _, second, *_ = *sorted(answer.degrees.values(), reverse=True), 0.0, 0.0
    ahead = MARGIN + (NAME_MARGIN - MARGIN) * (1 - 2 * answer.strangers)
    return answer.best >= SURE and answer.best - second >= ahead


def _tables(
    found: Mapping[str, _Answers], numbers: Sequence[int], gallery: Gallery
) -> Iterator[Table]:
    half = (len(gallery.categories) + 1) // 2
    for number in numbers:
        of_each = f"{number} picture{'s' * (number > 1)} of each"
        yield Table(
            f"What is said of what was taught, {half} categories, {of_each}",
            ("method", "right", "asserted, rightly", "nothing said", "best, mean"),
            tuple((name, *_taught_cells(them[number])) for name, them in found.items()),
        )
        yield Table(
            f"How far degrees are off, {of_each}",
            (
                "method",
                "error, half untaught",
                "error, all taught",
                "wrongly asserted, half untaught",
                "wrongly asserted, all taught",
                "of assertions, half untaught",
            ),
            tuple((name, *_error_cells(them[number])) for name, them in found.items()),
            f"Errors: of the {RUNS} runs together. Shares: the mean over the runs, and "
            f"the middle 80 % of them. Asserted: a degree of {SURE} and {MARGIN} more "
            f"than the next; nothing said: below {LIKELY}. {gallery.note}".strip(),
        )


def _told_tables(
    told: Mapping[str, _Answers], numbers: Sequence[int]
) -> Iterator[Table]:
    for number in numbers if told else ():
        yield Table(
            "What a tutor tells after each answer, whether the thing was known, "
            f"{number} picture{'s' * (number > 1)} of each",
            (
                "method",
                "error, half untaught",
                "error, all taught",
                "asserted, rightly, half untaught",
                "asserted, rightly, all taught",
                "wrongly asserted, half untaught",
                "wrongly asserted, all taught",
            ),
            tuple((name, *_told_cells(them[number])) for name, them in told.items()),
            "What is asserted rightly is among what was taught.",
        )


def _told_cells(runs: Sequence[_Run]) -> tuple[Cell, ...]:
    closed, mixed = zip(*runs, strict=True)
    asserted = (
        mean_and_range([_share_asserted(_of_labels(them), True) for them in some])
        for some in (mixed, closed)
    )
    wrong = (
        mean_and_range([_share_asserted(them, False) for them in some])
        for some in (mixed, closed)
    )
    return (_error(mixed), _error(closed), *asserted, *wrong)


def _told_facts(answers: _Answers) -> dict[str, object]:
    """The numbers of the tables of who is told, by the number of pictures taught."""
    facts: dict[str, object] = {}
    for number, runs in answers.items():
        closed, mixed = zip(*runs, strict=True)
        facts[str(number)] = {
            "asserted_taught": [_share_asserted(them, True) for them in closed],
            "asserted_half": [_share_asserted(_of_labels(it), True) for it in mixed],
            "wrong_taught": [_share_asserted(them, False) for them in closed],
            "wrong_half": [_share_asserted(them, False) for them in mixed],
            "error_taught": _error(closed),
            "error_half": _error(mixed),
        }
    return facts


def _of_labels(answers: Sequence[ObjectAnswer]) -> list[ObjectAnswer]:
    """The answers about what was taught."""
    return [it for it in answers if it.word in it.degrees]


def _taught_cells(runs: Sequence[_Run]) -> tuple[Cell, ...]:
    taught = [answers for answers, _ in runs]
    return (
        mean_and_range([share_right(them) for them in taught]),
        mean_and_range([_share_asserted(them, True) for them in taught]),
        mean_and_range([_share(it.best < LIKELY for it in them) for them in taught]),
        float(np.mean([it.best for them in taught for it in them])),
    )


def _error_cells(runs: Sequence[_Run]) -> tuple[Cell, ...]:
    taught = [answers for answers, _ in runs]
    every = [[*answers, *strange] for answers, strange in runs]
    asserted = [it for them in every for it in them if is_asserted(it)]
    return (
        _error(every),
        _error(taught),
        mean_and_range([_share_asserted(them, False) for them in every]),
        mean_and_range([_share_asserted(them, False) for them in taught]),
        _share(not it.right for it in asserted) if asserted else None,
    )


def _share_asserted(answers: Sequence[ObjectAnswer], right: bool) -> float:
    """The share of the answers that are asserted, and right, or wrong."""
    return _share(is_asserted(it) and it.right == right for it in answers)


def _share(hold: Iterator[bool] | Sequence[bool]) -> float:
    return float(np.mean(list(hold)))


def _error(runs: Sequence[Sequence[ObjectAnswer]]) -> float:
    every = [it for them in runs for it in them]
    return calibration_error([it.best for it in every], [it.right for it in every])


def _figures(found: Mapping[str, _Answers], numbers: Sequence[int]) -> Iterator[Figure]:
    for number in numbers:
        series = {name: _points(them[number]) for name, them in found.items()}
        yield Figure(
            "reliability",
            f"Reliability, half untaught, {number} of each",
            {
                "series": series,
                "xlabel": "degree of the best word",
                "ylabel": "share that is right",
            },
            "On the dashed line degrees are what they say.",
        )


def _points(runs: Sequence[_Run]) -> dict[str, list[float]]:
    """The bins of the reliability diagram, with the intervals of their shares."""
    every = [it for taught, strange in runs for it in (*taught, *strange)]
    bins = reliability([it.best for it in every], [it.right for it in every])
    shares = [
        Estimate(share, *wilson(round(share * count), count))
        for _, share, count in bins
    ]
    return {
        "x": [said for said, _, _ in bins],
        **interval_series(shares, "y"),
        "counts": [count for _, _, count in bins],
    }


def _facts(answers: _Answers) -> dict[str, object]:
    """The numbers of the tables, run by run, by the number of pictures taught."""
    facts: dict[str, object] = {}
    for number, runs in answers.items():
        taught = [them for them, _ in runs]
        every = [[*them, *strange] for them, strange in runs]
        wrong = partial(_share_asserted, right=False)
        facts[str(number)] = {
            "right": [share_right(them) for them in taught],
            "asserted": [_share_asserted(them, True) for them in taught],
            "silent": [_share([it.best < LIKELY for it in them]) for them in taught],
            "wrong_taught": [wrong(them) for them in taught],
            "wrong_half": [wrong(them) for them in every],
            "error_taught": _error(taught),
            "error_half": _error(every),
        }
    return facts
