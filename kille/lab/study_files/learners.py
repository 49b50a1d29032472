"""Learners of a theory tried: whether there are such, and one's own learn and judge."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cache
from pathlib import Path

from kille.lab.results import ExperimentError
from kille.lab.scenes import Occasion
from kille.lab.scenes.robot_views import Stand, TableView, Theatre
from kille.lab.settings import Problem, show_value, suggest_name, why_no_file
from kille.lab.study import Theory
from kille.lab.theories.classifiers import NAMES, learners_of, words_of
from kille.lab.user_code import failing_line
from kille.lab.worlds.worlds import World
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.scene import Configuration, Percept


def learner_problems(theory: Theory, eyes: Collection[str]) -> Iterator[Problem]:
    """What is wrong with a theory's learners, for `simulated` or `whole` robots."""
    for kind in theory.learners:
        for seen in sorted(eyes):
            yield from _learner_problems(kind, theory, seen)


def _learner_problems(kind: str, theory: Theory, seen: str) -> Iterator[Problem]:
    name = theory.learners[kind]
    known = tuple(NAMES[seen][kind])
    key = ("learners", kind)
    path, colon, _ = name.rpartition(":")
    if name not in known and (not colon or known == ("default",)):
        told = f"nothing named {show_value(name)} judges {kind}s {_SEEN[seen]}"
        yield Problem(key, f"{told}: {_suggestion(name, known)}")
        return
    if path.endswith(".py") and (why_not := why_no_file(Path(path))):
        yield Problem(key, why_not)
        return
    alone = Theory("", learners={kind: name}, consent=theory.consent)
    try:
        if seen == "simulated":
            words_of(alone)
            return
        learners = learners_of(alone)
        objects, relations = learners.objects(()), learners.relations()
        if colon and kind == "noun":
            _try_noun(objects)
        elif colon:
            _try_relation(relations)
    except ExperimentError as error:
        line = failing_line(path, error.__cause__)
        yield Problem(key, str(error), f"{path}:{line}" if line else "")


def _try_noun(objects: ObjectMemory) -> None:
    """Give a user's learner a lesson and a question, as the whole robot does."""
    x = _percept()
    objects.learn_one(x, "cup")
    objects.evidence(x)


def _try_relation(relations: RelationMemory) -> None:
    x = Configuration((0.1, 0.0, 0.0))
    relations.learn_one(x, "near")
    relations.degrees(x)


@cache
def _percept() -> Percept:
    """A cup on a rendered table, as the whole robot sees it."""
    table = Theatre("a cup")
    view = TableView("synthetic:empty", (Stand("cup", 0.0, 0.0, 0.0),))
    table.turn_to(Occasion("noun", World(), 1, view=view))
    return table.look(1, None).percepts[0]


def _suggestion(name: str, known: Collection[str]) -> str:
    """What was probably meant by the name of a learner."""
    if name.endswith(".py"):
        return f"write what it is called in the file, {Path(name).name}:NAME"
    return suggest_name(name, known)


_SEEN = {
    "simulated": "of simulated scenes",
    "whole": "of the scenes that the robot sees itself",
}
