"""Phases that measure nothing, or something else than they seem to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from random import Random

from kille.lab.scenes import Scene
from kille.lab.settings import Problem
from kille.lab.study import PERSON, Study
from kille.lab.study_files.phases import (
    TEACHING,
    is_plain,
    kind_of,
    kinds_of,
    turns_before,
)
from kille.lab.study_files.words import SPEAKING
from kille.lab.tutors.scripted import script_lines

_ASKING = ("ask", "practise", "find")


def phase_warnings(study: Study, opened: Mapping[str, Scene]) -> Iterator[Problem]:
    """What is probably not meant in the phases of a study."""
    yield from _nothing_asked(study)
    if any(theory.mode != PERSON for theory in study.theories.values()):
        yield from _untaught_kinds(study)
        yield from _unnamed_landmarks(study)
    yield from _missing_fronts(study, opened)
    yield from _taught_before(study)
    yield from _missing_turns(study, opened)


def _nothing_asked(study: Study) -> Iterator[Problem]:
    """Warn that no question is asked that has a right answer."""
    asked = any(phase.do in _ASKING for phase in study.phases)
    kinds = {tutor.kind for tutor in study.tutors.values()}
    if kinds & {"own", "keyboard"} or (asked and kinds & {*SPEAKING}):
        return
    scripts = [it for it in study.tutors.values() if it.kind == "scripted"]
    marks = {
        line.mark
        for it in scripts
        for line in script_lines(study.path(it.settings["file"]))
    }
    if "S>" not in marks:
        told = 'nothing is asked, so that no answers are measured: write do = "ask"'
        yield Problem(("phases",), told)


def _untaught_kinds(study: Study) -> Iterator[Problem]:
    """Phases in which a robot needs words of a kind of which none is ever taught."""
    taught = {kind_of(it) for it in study.phases if it.do in TEACHING}
    if any(it.settings.get("colours") != "taught" for it in study.scenes.values()):
        taught.add("adjective")
    for number, phase in enumerate(study.phases if is_plain(study) else ()):
        for kind in kinds_of(phase) if phase.do in ("ask", "find") else ():
            if kind not in taught:
                told = f"{phase.name} asks for {kind}s, which no phase teaches"
                yield Problem(("phases", number), told)


def _unnamed_landmarks(study: Study) -> Iterator[Problem]:
    """The first phase about places before which no nouns are taught.

    Whoever has no noun for a landmark cannot say where something is.
    """
    for number, phase in enumerate(study.phases if is_plain(study) else ()):
        if phase.do not in (*TEACHING, "ask"):
            continue
        if kind_of(phase) == "noun" and phase.do in TEACHING:
            return
        if kind_of(phase) == "relation":
            told = f"no nouns are taught before {phase.name}, and without those of the"
            told += " landmarks the robot says of nothing where it is"
            yield Problem(("phases", number), told)
            return


def _missing_fronts(study: Study, opened: Mapping[str, Scene]) -> Iterator[Problem]:
    """Phases that say which way things face, where nothing has a front."""
    for number, phase in enumerate(study.phases):
        for name, scene in opened.items() if phase.do == "align" else ():
            shown = scene.round("relation", False, Random(0))[:1]
            things = [it.world.thing(x) for it in shown for x in it.world.in_view]
            if not any(thing.front for thing in things):
                told = f"nothing in {name} has a front, so that nothing is said in"
                yield Problem(("phases", number), f"{told} {phase.name}")


def _taught_before(study: Study) -> Iterator[Problem]:
    """Phases of what is new in which that has been taught before.

    Who asks for what is not new as well knows that there are two sorts of things.
    """
    before: dict[str, str] = {}
    if all(scene.kind == "around" for scene in study.scenes.values()):
        return
    asked = [it for it in study.phases if it.do == "ask"]
    both = {kind_of(it) for it in asked if it.settings.get("of") != "new"}
    for number, phase in enumerate(study.phases):
        if phase.settings.get("of") != "new":
            continue
        kind = kind_of(phase)
        if phase.do == "ask" and kind in before.keys() - both:
            told = f"what is new in {phase.name} has been taught in {before[kind]}"
            yield Problem(("phases", number, "of"), told)
        if phase.do in TEACHING:
            before.setdefault(kind, phase.name)


def _missing_turns(study: Study, opened: Mapping[str, Scene]) -> Iterator[Problem]:
    """Warn that dialogues end before all is done."""
    needed = max(
        (turns_before(study, scene)[-1] for scene in opened.values()), default=0
    )
    if needed > study.turns:
        told = f"a dialogue takes {needed} turns at least, and ends after {study.turns}"
        yield Problem(("turns",), f"{told}: write turns = {needed} or more")
