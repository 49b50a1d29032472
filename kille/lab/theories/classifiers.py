"""What judges the words of a theory, by name: in simulated worlds and for real eyes.

In a simulated world words are judged by their instances or by a prototype each; those
for places also by what the robot itself, or KILLE, has for them. The robot's own words
for things are judged by instances (the features of what was seen), by cues (what it
looks like as a whole) or, by default, by both; what each weighs was fitted for each of
the three in the same way. Anybody's own learner may judge, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

from kille.dialogue.meanings import KINDS
from kille.grounding.lessons_and_learners import Learners
from kille.lab.study import Theory
from kille.lab.theories.candidates import Make, candidates
from kille.lab.theories.guest_learners import GuestObjects, GuestRelations
from kille.lab.theories.pupils import Pupil
from kille.lab.theories.simulated_words import (
    CueWord,
    GuestWord,
    MakeWord,
    PrototypeWord,
)
from kille.lab.worlds.word_learning import LearnedWord
from kille.perception.descriptor_index import View
from kille.perception.evidence import weighing
from kille.perception.methods import OBJECTS, RELATIONS
from kille.perception.objects import ObjectMemory

Known = Mapping[str, Mapping[str, Any]]
"""What has a name, by the kind of words that it judges."""

WORDS: Mapping[str, type[LearnedWord]] = {
    "default": LearnedWord,
    "instances": LearnedWord,
    "prototype": PrototypeWord,
}

NOUNS: Mapping[str, type[LearnedWord]] = {**WORDS, "cues": CueWord}
"""The same of nouns, which may be judged by several cues."""

_OF_EYES: Mapping[str, Callable[[Iterable[View]], ObjectMemory]] = {
    "default": ObjectMemory,
    "both": ObjectMemory,
    "instances": partial(ObjectMemory, weighed=weighing("instances")),
    "cues": partial(ObjectMemory, weighed=weighing("cues")),
}

NAMES: Mapping[str, Known] = {
    "simulated": {
        "noun": NOUNS,
        "adjective": WORDS,
        "relation": {**RELATIONS, **WORDS, "robot": RELATIONS["default"]},
    },
    "whole": {
        "noun": {**OBJECTS, **_OF_EYES},
        "adjective": {"default": None},
        "relation": RELATIONS,
    },
}
"""The learners that have names, for simulated perception and for the whole robot."""


def words_of(theory: Theory) -> Mapping[str, MakeWord]:
    """What makes words of each kind in a simulated world, for one dialogue.

    `ExperimentError` for a learner that there is not, or that cannot be made.
    """
    return {kind: _word(kind, theory) for kind in KINDS}


def _word(kind: str, theory: Theory) -> MakeWord:
    name = theory.learners.get(kind, "default")
    named = NOUNS if kind == "noun" else WORDS
    if name in named:
        return named[name]
    known = NAMES["simulated"][kind]
    return partial(GuestWord, pupil=Pupil(_maker(name, known, theory)))


def learners_of(theory: Theory) -> Learners:
    """What makes the learners of one robot; `ExperimentError` as `words_of`.

    They build what they need at once, so that no answer depends on how fast it was.
    """
    noun, place = (theory.learners.get(it, "default") for it in ("noun", "relation"))
    objects, relations = _OF_EYES.get(noun), Learners().relations
    if objects is None:
        objects = partial(GuestObjects, _maker(noun, OBJECTS, theory), {})
    if place != "default":
        relations = partial(GuestRelations, _maker(place, RELATIONS, theory))
    return Learners(objects, relations)


def _maker(name: str, known: Mapping[str, Make], theory: Theory) -> Make:
    """What makes a learner of a theory; its later errors carry its name."""
    return candidates([name], known, theory.consent)[name]
