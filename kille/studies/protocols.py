"""Protocols: what the phases of a study have a tutor do, task by task.

A study lists its phases; a protocol of the literature is such a list, and those that
are shipped are short files in `examples/studies/protocols`, to be copied.

teach: he says what is so. ask: he asks, and nobody learns from the answer. practise: he
asks, and says what is right. talk: he shows things and leaves the robot the floor, as
in Skočaj et al. 2011. find: he asks for a thing by its words. align: he says which way
things face, and in whose frame he speaks. rest: another day begins. forget: he has
words forgotten. change_tutor, or swap: another tutor goes on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count, islice
from random import Random

from kille.studies import scenes
from kille.studies.scenes import Scene
from kille.studies.scenes.occasions import KINDS, ORDERS, Occasion, ordered
from kille.studies.settings import Setting, Settings, filled
from kille.studies.study import Named, Phase, Run, Study
from kille.studies.tutors.tutor import Task

__all__ = ["CHANGING", "RESTING", "SETTINGS", "faults", "tasks"]

_WHAT = Setting(
    str, "nouns", among=tuple(KINDS), about="nouns, adjectives or relations"
)
_WHICH = Setting(str, "same", among=("same", "new"), about="what was taught, or not")
_OCCASIONS: Settings = {
    "what": _WHAT,
    "of": _WHICH,
    "rounds": Setting(int, 1, least=1),
    "turns": Setting(int, 0, about="how many of them, where that is not whole rounds"),
    "order": Setting(str, "given", among=ORDERS),
}

CHANGING = ("change_tutor", "swap")
"""The phases after which another tutor goes on."""

RESTING = ("rest",)
"""The phases in which nobody says anything."""

SETTINGS: Mapping[str, Settings] = {
    "teach": _OCCASIONS,
    "ask": _OCCASIONS,
    "practise": _OCCASIONS,
    "talk": _OCCASIONS,
    "find": {
        "of": _WHICH,
        "rounds": Setting(int, 1, least=1),
        "order": Setting(str, "given", among=ORDERS),
        "by": Setting(str, "both", among=("both", "noun", "colour")),
    },
    "align": {
        "announce": Setting(bool, False, about="whether he says whose frame it is")
    },
    "rest": {},
    "forget": {"what": _WHAT, "words": Setting(str, needed=True, several=True)},
    **{key: {"to": Setting(str, "", about="the tutor's name")} for key in CHANGING},
}
"""What may be set of phases, by what is done in them."""

LOOKS = 16
"""As many looks as a task may take are kept apart from those of others."""


_LACKING = {
    "pictures": ("adjectives", "relations", "find", "align"),
    "captures": ("adjectives", "relations", "find", "align"),
    "rendered": ("adjectives", "find"),
}
"""What cannot be talked of in front of scenes of a kind."""


def faults(phase: Phase, study: Study) -> Iterator[str]:
    """What is wrong with a phase in this study: its tutors and scenes do not fit."""
    for scene in study.scenes.values():
        lacking = _LACKING.get(scene.kind, ())
        for what in (phase.do, phase.settings.get("what", "")):
            if what in lacking:
                yield f"{what} cannot be done with {scene.name}, which is {scene.kind}"
        if phase.settings.get("what") == "relations" and _is_single(scene):
            yield f"there is but one thing in {scene.name}: name kinds, or each = 2"
        if phase.do == "find" and _shows_one(scene):
            yield (
                f"one thing at a time is in view in {scene.name}, and is found "
                'whatever is asked for: write kind = "drawn" and in_view = 4'
            )
    to = phase.settings.get("to", "")
    if phase.do in CHANGING and to and to not in study.tutors:
        yield f"there is no tutor {to}: there is {', '.join(study.tutors)}"
    if phase.do in CHANGING and not to and len(study.tutors) < 2:
        yield "there is no other tutor: write one more, or to = NAME"


def _is_single(scene: Named) -> bool:
    """Whether a table has one thing only, which stands beside nothing."""
    set_ = filled(scene.settings, scenes.SETTINGS[scene.kind])
    return scene.kind == "drawn" and len(set_["kinds"]) * set_["each"] < 2


def _shows_one(scene: Named) -> bool:
    """Whether things that are not beside each other are shown one by one."""
    alone = scene.kind == "drawn" and scene.settings.get("in_view", 1) < 2
    return alone or scene.kind in ("around", "statements")


def tasks(study: Study, run: Run, scene: Scene) -> Iterator[tuple[Phase, Task]]:
    """What is to be done in a run, phase by phase.

    A phase in which there is nothing to talk of has one task without an occasion.
    """
    number = count(1)
    for phase in study.phases:
        set_ = filled(phase.settings, SETTINGS[phase.do])
        for of, settings in _occasions(phase, set_, run, scene):
            now = next(number)
            at = None if of is None else of.at(now * LOOKS)
            yield phase, Task(run, phase.name, phase.do, now, at, settings)


def _occasions(
    phase: Phase, set_: dict[str, object], run: Run, scene: Scene
) -> Iterator[tuple[Occasion | None, Mapping[str, object]]]:
    if phase.do == "forget":
        words = set_["words"]
        assert isinstance(words, Sequence)
        yield from ((None, {**set_, "word": word}) for word in words)
        return
    if phase.do in (*RESTING, *CHANGING):
        yield None, set_
        return
    for occasion in _shown(phase, set_, run, scene):
        yield occasion, set_


def _shown(
    phase: Phase, set_: dict[str, object], run: Run, scene: Scene
) -> Sequence[Occasion]:
    """The occasions of a phase: the same for every theory and every tutor."""
    kind = KINDS.get(str(set_.get("what", "")), "noun")
    chance = Random(f"{phase.name} {run.scene} {run.seed}")
    if phase.do == "align":
        return scene.round("relation", False, chance)[:1]
    new = set_["of"] == "new"
    rounds, turns = int(str(set_["rounds"])), int(str(set_.get("turns", 0)))
    one = len(scene.round(kind, new, Random(0))) if turns else 1
    rounds = max(rounds, -(-turns // max(one, 1)))
    given = [scene.round(kind, new, chance) for _ in range(rounds)]
    found = ordered(given, str(set_["order"]), chance)
    return list(islice(found, turns or None))
