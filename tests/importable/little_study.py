"""A study whose dialogues take no time: a robot that is told numbers, and guesses.

Processes that tests start can import it. What it says follows from the run alone, as
with every other study.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_info

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.study import Named, Phase, Run, Study, Theory

GOOD, BAD, DEADLY = "good", "bad", "deadly"


def study(
    seeds: int = 3, theories: tuple[str, ...] = (GOOD, "other"), **more: object
) -> Study:
    """So many seeds for each theory; one called bad breaks, one deadly kills."""
    settings: dict[str, object] = {"source": f"{theories} {seeds}", **more}
    return Study(
        "Numbers",
        {name: Theory(name) for name in theories},
        {"Ann": Named("Ann", "simulated")},
        {"table": Named("table", "drawn")},
        (Phase("lessons", "teach"), Phase("test", "ask")),
        tuple(range(1, seeds + 1)),
        **settings,  # type: ignore[arg-type]
    )


def play(study: Study, run: Run) -> Played:
    """Ann says three numbers, and the robot guesses the next."""
    if run.seed == 2 and run.theory == DEADLY:
        os.kill(os.getpid(), 9)
    chance = run.chance("numbers")
    numbers = [chance.randint(1, 9) for _ in range(3)]
    if run.seed == 2 and run.theory == BAD:
        raise ValueError(f"nobody\nlikes {numbers[0]}")
    turns = [
        Turn(at, "lessons", run.tutor, "instruct", f"This is {number}.", "OK.\nOh.", 3)
        for at, number in enumerate(numbers, start=1)
    ]
    right, said = str(chance.randint(1, 9)), str(chance.randint(1, 9))
    turns.append(Turn(4, "test", run.tutor, "ask_name", "What is next?", f"{said}."))
    degrees = {right: chance.random(), said: chance.random()}
    answer = Answer(4, "test", "noun", right, said, "hedge", degrees[said], degrees)
    return Played(tuple(turns), (answer,), 3, {"guesses": float(run.seed)})


def die(study: Study, run: Run) -> Played:
    """A dialogue that nothing survives."""
    os.kill(os.getpid(), 9)
    raise AssertionError


def give_what_cannot_be_sent(study: Study, run: Run) -> Played:
    """A dialogue with a result that no other process can be sent."""
    return Played((), (), 0, {"file": open(os.devnull)})  # type: ignore[dict-item]


def say_much(study: Study, run: Run) -> Played:
    """A dialogue of which more is to be sent than fits between two processes."""
    return Played((Turn(1, "lessons", run.tutor, "instruct", "a" * 3_000_000, ""),), ())


def count_threads(study: Study, run: Run) -> Played:
    """A dialogue that only counts the threads in which numpy would add up."""
    np.ones((2, 2)) @ np.ones((2, 2))
    found = [it["num_threads"] for it in threadpool_info() if it["user_api"] == "blas"]
    asked = os.environ["OPENBLAS_NUM_THREADS"]
    return Played((), (), 0, {"threads": max(found), "asked for": float(asked)})


def folder_of(path: Path) -> dict[str, bytes]:
    """What is in the files of a folder whose bytes do not differ each time."""
    names = (f"{name}.csv" for name in ("runs", "turns", "answers"))
    return {name: (path / name).read_bytes() for name in names}
