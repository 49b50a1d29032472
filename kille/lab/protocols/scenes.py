"""Teach in some scenes, and ask in another for known things and for strangers.

Every frame of a scene is one lesson, or one question, about each thing in it. Things
that are only in the scene that is asked are strangers: the degrees of all words for
them should be low.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from kille.lab.measures.statistics import auroc
from kille.lab.progress import Steps
from kille.lab.protocols.teaching import (
    ObjectAnswer,
    answers_figure,
    ask,
    mean_degrees,
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
    silent,
)
from kille.lab.scenes.labelled import LabelledScenes, Split
from kille.lab.scenes.labelled import taught_things as known_in
from kille.lab.theories.candidates import Methods

_SEEING = 0.5  # the share of the time that goes into seeing

Answers = Mapping[tuple[Split, str], Sequence[ObjectAnswer]]
"""What each method answered, by the split and the method's name."""


def across(
    scenes: LabelledScenes,
    chosen: Sequence[Split],
    methods: Methods,
    *,
    seed: int,
    progress: Progress = silent,
) -> Result:
    """How well taught things are told apart, and strangers noticed."""
    _look_at_scenes(scenes, chosen, progress)
    answers = _answers(scenes, chosen, methods, progress)
    known = {split: known_in(scenes, split) for split in chosen}
    return Result(
        "Taught in some scenes, asked in another",
        (
            _known_again(answers, known),
            *(_open_set(split, answers, known[split]) for split in chosen),
        ),
        tuple(
            figure
            for (split, name), them in answers.items()
            for figure in _figures(split, name, them, known[split])
        ),
        {
            "splits": [
                {
                    "teach": list(split.teach),
                    "ask": split.ask,
                    "method": name,
                    **_facts(them, known[split]),
                }
                for (split, name), them in answers.items()
            ]
        },
    )


def _look_at_scenes(
    scenes: LabelledScenes, chosen: Sequence[Split], progress: Progress
) -> None:
    """Look at every scene that is taught or asked."""
    needed = dict.fromkeys(it for split in chosen for it in (*split.teach, split.ask))
    steps = Steps(progress, len(needed), 0, _SEEING)
    for scene in needed:
        scenes.lessons(scene)
        steps(f"looking at {scene}")


def _answers(
    scenes: LabelledScenes,
    chosen: Sequence[Split],
    methods: Methods,
    progress: Progress,
) -> Answers:
    count = sum(len(scenes.lessons(split.ask)) for split in chosen) * len(methods)
    steps = Steps(progress, count, _SEEING, 1)
    return {
        (split, name): ask(
            teach(make, (it for scene in split.teach for it in scenes.lessons(scene))),
            scenes.lessons(split.ask),
            partial(steps, f"{name}, {split}"),
        )
        for split in chosen
        for name, make in methods.items()
    }


def _known_again(answers: Answers, known: Mapping[Split, set[str]]) -> Table:
    return Table(
        "Is what was taught known again, and are strangers noticed?",
        (
            "taught → asked",
            "method",
            "right, by frame",
            "share",
            "right, by thing",
            "AUROC, by frame",
            "AUROC, by thing",
        ),
        tuple(
            (str(split), name, *_scores(them, known[split]))
            for (split, name), them in answers.items()
        ),
        "Right: of the taught things only. By thing: the mean over the frames, "
        "of which each is nearly the other. AUROC: how likely the best degree "
        "for a taught thing is higher than for a stranger.",
    )


def _by_thing(answers: Sequence[ObjectAnswer]) -> list[ObjectAnswer]:
    words = dict.fromkeys(answer.word for answer in answers)
    return [mean_degrees([it for it in answers if it.word == word]) for word in words]


def _auroc(answers: Sequence[ObjectAnswer], known: set[str]) -> float:
    return auroc(
        [it.best for it in answers if it.word in known],
        [it.best for it in answers if it.word not in known],
    )


def _scores(answers: Sequence[ObjectAnswer], known: set[str]) -> tuple[Cell, ...]:
    things = _by_thing(answers)
    right, share, _ = right_cells([it for it in answers if it.word in known])
    return (
        right,
        share,
        right_cells([it for it in things if it.word in known])[0],
        _auroc(answers, known),
        _auroc(things, known),
    )


def _facts(answers: Sequence[ObjectAnswer], known: set[str]) -> dict[str, object]:
    things = _by_thing(answers)
    return {
        "taught": sorted(known),
        "strangers": sorted({it.word for it in things} - known),
        "right_by_frame": share_right([it for it in answers if it.word in known]),
        "right_by_thing": share_right([it for it in things if it.word in known]),
        "auroc_by_frame": _auroc(answers, known),
        "auroc_by_thing": _auroc(things, known),
    }


def _open_set(split: Split, answers: Answers, known: set[str]) -> Table:
    """Thing by thing, what it is taken for, and with which degree."""
    by_method = {
        name: {it.word: it for it in _by_thing(them)}
        for (of, name), them in answers.items()
        if of is split
    }
    things = next(iter(by_method.values()))
    rows = tuple(
        (
            thing,
            "taught" if thing in known else "stranger",
            *(
                f"{them[thing].said} {them[thing].best:.2f}"
                for them in by_method.values()
            ),
        )
        for thing in sorted(things, key=lambda it: (it not in known, it))
    )
    return Table(
        f"Thing by thing, {split}",
        ("thing", "it is", *by_method),
        rows,
        "The word of the highest mean degree over the frames.",
    )


def _figures(
    split: Split, name: str, answers: Sequence[ObjectAnswer], known: set[str]
) -> list[Figure]:
    groups = {
        "taught": [it.best for it in answers if it.word in known],
        "strangers": [it.best for it in answers if it.word not in known],
    }
    points = {
        group: {"x": sorted(them), "y": _cumulative_shares(them)}
        for group, them in groups.items()
        if them
    }
    labels = {"xlabel": "best degree", "ylabel": "share at most so high"}
    return [
        answers_figure(f"{name}, {split}", answers),
        Figure(
            "points", f"Best degrees of {name}, {split}", {"series": points, **labels}
        ),
    ]


def _cumulative_shares(values: Sequence[float]) -> list[float]:
    return [(place + 1) / len(values) for place in range(len(values))]
