"""Theories that do not differ, and what of them makes no difference."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

from kille.lab.scenes import WHOLE
from kille.lab.settings import Problem
from kille.lab.study import PERSON, Study, Theory
from kille.lab.study_files.phases import is_plain, kinds_in
from kille.lab.theories import strategy_of
from kille.lab.theories.classifiers import WORDS


def theory_warnings(study: Study) -> Iterator[Problem]:
    """What is probably not meant in the theories of a study."""
    yield from _same_theories(study)
    for name, theory in study.theories.items():
        if theory.mode == PERSON:
            continue
        for it in (*_swapped_bands(theory), *_idle_learners(theory, study)):
            yield it.within("theories", name)


def _same_theories(study: Study) -> Iterator[Problem]:
    """Theories that are the same as one before them."""
    before: list[Theory] = []
    for name, theory in study.theories.items():
        same = [it.name for it in before if _normal_form(it) == _normal_form(theory)]
        if same and theory.mode != PERSON:
            told = f"{name} is the same theory as {same[0]}: they will not differ"
            yield Problem(("theories", name), told)
        before.append(theory)


def _normal_form(theory: Theory) -> tuple[object, ...]:
    """A theory without what it is called, and what is set to what it is anyhow."""
    bare = replace(
        theory,
        name="",
        about="",
        mode="",
        wording="",
        strategy={},
        without=tuple(sorted(theory.without)),
        learners={k: it for k, it in theory.learners.items() if it != "default"},
    )
    return bare, strategy_of(theory) if theory.mode != PERSON else PERSON


def _swapped_bands(theory: Theory) -> Iterator[Problem]:
    """Bands that begin below weaker ones, and so take their place."""
    bands = strategy_of(theory).bands
    for stronger, weaker in pairwise(("sure", "think", "likely")):
        if bands[stronger] < bands[weaker]:
            told = f"bands.{stronger} = {bands[stronger]:g} is below bands.{weaker} = "
            told += f"{bands[weaker]:g}, in whose place it is then"
            yield Problem(("strategy", "bands", stronger), told)


def _idle_learners(theory: Theory, study: Study) -> Iterator[Problem]:
    """Learners that judge nothing in the study."""
    kinds = kinds_in(study)
    for kind, name in theory.learners.items():
        if name == "default":
            continue
        key = ("learners", kind)
        if is_plain(study) and kind not in kinds:
            told = f"no phase is about {kind}s, so that {name} judges nothing"
            yield Problem(key, told)
        elif (
            kind == "adjective" and name not in WORDS and not _has_taught_colours(study)
        ):
            told = f"{name} judges no colours, as the robot knows them beforehand"
            yield Problem(key, f'{told}: write colours = "taught" for the scenes')


def _has_taught_colours(study: Study) -> bool:
    """Whether colours are taught in a scene, or it is not simulated."""
    return any(
        it.kind in WHOLE or it.settings.get("colours") == "taught"
        for it in study.scenes.values()
    )
