"""The phases of a study: what each has a tutor do, task by task.

A study lists its phases; a protocol of the literature is such a list, and those that
are shipped are short files in `examples/studies/protocols`, to be copied.

teach: they say what is so. ask: they ask, and nobody learns from the answer. practise:
they ask, and say what is right. talk: they show things and leave the robot the floor,
as in Skočaj et al. 2011. find: they ask for a thing by its words. align: they say which
way things face, and in whose frame they speak. rest: another day begins. forget: they
have words forgotten. change_tutor, or swap: another tutor goes on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count, islice
from random import Random

from kille.lab import scenes
from kille.lab.scenes import Scene
from kille.lab.scenes.scene import KINDS, ORDERS, Occasion, order_occasions
from kille.lab.settings import Problem, Setting, Settings, fill_settings, suggest_name
from kille.lab.study import Named, Phase, Run, Study
from kille.lab.tutors.tutor import Task

MOST = 1000
"""The most rounds: more of them are nobody's study, but a slip."""

_WHAT = Setting(
    str, "nouns", among=tuple(KINDS), about="nouns, adjectives or relations"
)
_WHICH = Setting(str, "same", among=("same", "new"), about="what was taught, or not")
_OCCASIONS: Settings = {
    "what": _WHAT,
    "of": _WHICH,
    "rounds": Setting(int, 1, least=1, most=MOST),
    "turns": Setting(
        int, 0, most=100_000, about="how many of them, where that is not whole rounds"
    ),
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
        "rounds": Setting(int, 1, least=1, most=MOST),
        "order": Setting(str, "given", among=ORDERS),
        "by": Setting(str, "both", among=("both", "noun", "colour")),
    },
    "align": {
        "announce": Setting(bool, False, about="whether they say whose frame it is")
    },
    "rest": {},
    "forget": {"what": _WHAT, "words": Setting(str, needed=True, several=True)},
    **{key: {"to": Setting(str, "", about="the tutor's name")} for key in CHANGING},
}
"""What may be set of phases, by what is done in them."""

LOOKS = 16
"""The most looks of one task; those of the next task have other numbers."""


_LACKING = {
    "pictures": ("adjectives", "relations", "find", "align"),
    "captures": ("adjectives", "relations", "find", "align"),
    "rendered": ("adjectives", "find"),
}
"""What cannot be talked of in front of scenes of a kind."""


def faults(phase: Phase, study: Study) -> Iterator[Problem]:
    """Why a phase does not fit the tutors and scenes of a study."""
    key = ("what",) if "what" in phase.settings else ("do",)
    for scene in study.scenes.values():
        yield from (Problem(key, it) for it in _scene_faults(phase, scene))
    yield from (Problem(("to",), it) for it in _successor_faults(phase, study))
    if phase.settings.get("turns") and "rounds" in phase.settings:
        problem = "rounds and turns both say how much comes: write one of them"
        yield Problem(("turns",), problem)


def _scene_faults(phase: Phase, scene: Named) -> Iterator[str]:
    """Why a phase cannot be done with a scene."""
    lacking = _LACKING.get(scene.kind, ())
    for what in (phase.do, phase.settings.get("what", "")):
        if what in lacking:
            yield f"{what} cannot be done with {scene.name}, which is {scene.kind}"
    asks = phase.do in ("ask", "practise")
    if asks and phase.settings.get("what") == "relations" and _has_one_kind(scene):
        problem = (
            f"there is one kind of thing in {scene.name}, and the robot does not say"
        )
        yield f"{problem} how it stands to its like: name two kinds"
    if phase.do == "find" and (more := _settings_for_finding(phase, scene)):
        problem = f"one thing at a time is in view in {scene.name}, and is found"
        yield f"{problem} whatever is asked for: write {more}"


def _successor_faults(phase: Phase, study: Study) -> Iterator[str]:
    """Why nobody else could go on."""
    if phase.do not in CHANGING:
        return
    to = phase.settings.get("to", "")
    if to and to not in study.tutors:
        yield f"there is no tutor {to}: {suggest_name(to, study.tutors)}"
    if not to and len(study.tutors) < 2:
        yield "there is no other tutor: write one more, or to = NAME"


def _has_one_kind(scene: Named) -> bool:
    """Has a table things of one kind only?

    "The cup is to the left of the cup" says nothing, so that it is never said.
    """
    kinds = scene.settings.get("kinds")
    return scene.kind == "drawn" and kinds is not None and len(kinds) < 2


def _settings_for_finding(phase: Phase, scene: Named) -> str:
    """What to write where things are shown one by one; nothing where they are not."""
    if scene.kind != "drawn":
        is_one = scene.kind in ("around", "statements")
        return 'kind = "drawn" and in_view = 4' if is_one else ""
    of = "new" if phase.settings.get("of") == "new" else "each"
    if _count_things(scene, of) == 1:
        return f"{of} = 4 and in_view = 4"
    return "in_view = 4" if scene.settings.get("in_view", 1) == 1 else ""


def _count_things(scene: Named, of: str) -> int:
    """How many things there are of `each` kind together, or of the `new` ones."""
    set_ = fill_settings(scene.settings, scenes.SETTINGS[scene.kind])
    return len(set_["kinds"]) * int(set_[of])


def successor(study: Study, phase: Phase, now: str) -> str:
    """The tutor who goes on: the one named, or the one who comes after `now`."""
    to = str(phase.settings.get("to", ""))
    names = list(study.tutors)
    return to or names[(names.index(now) + 1) % len(names)]


def length(phase: Phase, scene: Scene) -> int:
    """How many tasks there are in a phase, in front of a scene."""
    set_ = fill_settings(phase.settings, SETTINGS[phase.do])
    if phase.do == "forget":
        return len(set_["words"])
    if phase.do in (*RESTING, *CHANGING):
        return 1
    if phase.do == "align":
        return len(scene.round("relation", False, Random(0))[:1])
    kind = KINDS.get(str(set_.get("what", "")), "noun")
    one = len(scene.round(kind, set_["of"] == "new", Random(0)))
    return (set_.get("turns") or set_["rounds"] * one) if one else 0


def tasks(study: Study, run: Run, scene: Scene) -> Iterator[tuple[Phase, Task]]:
    """The tasks of a run, phase by phase.

    A rest, a change of tutors, and a word to forget are tasks without an occasion.
    """
    number = count(1)
    for phase in study.phases:
        set_ = fill_settings(phase.settings, SETTINGS[phase.do])
        for of, settings in _occasions(phase, set_, run, scene):
            now = next(number)
            at = None if of is None else of.at_glance(now * LOOKS)
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
    for occasion in _occasions_of(phase, set_, run, scene):
        yield occasion, set_


def _occasions_of(
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
    found = order_occasions(given, str(set_["order"]), chance)
    return list(islice(found, turns or None))
