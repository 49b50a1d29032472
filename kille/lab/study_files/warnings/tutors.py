"""What makes no difference in tutors, and words that they lack."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from kille.lab.scenes import Scene
from kille.lab.settings import Problem
from kille.lab.study import Named, Study
from kille.lab.study_files.phases import TEACHING, kind_of
from kille.lab.study_files.words import SPEAKING, names_in_scenes, words_of
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import KINDS


def tutor_warnings(study: Study, opened: Mapping[str, Scene]) -> Iterator[Problem]:
    """What is probably not meant in the tutors of a study."""
    for name, tutor in study.tutors.items():
        if tutor.kind in SPEAKING:
            found = (
                *_unused_settings(tutor, study, opened),
                *_missing_words(tutor, study, opened),
            )
            yield from (it.within("tutors", name) for it in found)


def _unused_settings(
    tutor: Named, study: Study, opened: Mapping[str, Scene]
) -> Iterator[Problem]:
    """Settings that make no difference."""
    does = {phase.do for phase in study.phases}
    if "feedback" in tutor.settings and not does & {"practise", "talk"}:
        told = "feedback makes no difference: no phase is practise or talk"
        yield Problem(("feedback",), told)
    there = names_in_scenes(study, opened).noun
    for name in tutor.settings.get("calls", ()):
        if name in KINDS and name not in there:
            told = f"there is no {name} in any scene that they could call so"
            yield Problem(("calls",), told)
    if tutor.settings.get("frame", "viewer") in ("viewer", 0):
        return
    for scene in study.scenes.values():
        if _is_frontless(scene):
            told = f"the landmark of {scene.name} has no front"
            told = f"{told}, so that they always speak there as a viewer"
            yield Problem(("frame",), told)


def _is_frontless(scene: Named) -> bool:
    alone = scene.kind == "around" and scene.settings.get("front") == ""
    return alone or scene.kind == "statements"


def _missing_words(
    tutor: Named, study: Study, opened: Mapping[str, Scene]
) -> Iterator[Problem]:
    """Phases for which a tutor has no word, and in which they say nothing."""
    vocabulary = tutor.settings.get("vocabulary", ())
    if not vocabulary:
        return
    languages = {theory.language for theory in study.theories.values()}
    spoken = [words_of(language, tutor) for language in sorted(languages)]
    for name, scene in opened.items():
        names = names_in_scenes(study, {name: scene})
        for phase in study.phases:
            if phase.do not in (*TEACHING, "ask"):
                continue
            there = getattr(names, kind_of(phase))
            if not any(_has_one(words, vocabulary, there) for words in spoken):
                told = f"{tutor.name} has no word for the {kind_of(phase)}s of {name}"
                told = f"{told}, and says nothing in {phase.name}"
                yield Problem(("vocabulary",), told)


def _has_one(words: Words, own: Iterable[str], there: Iterable[str]) -> bool:
    """Whether one of these words is for something that is there."""
    return bool(
        {words.word_for(it) for it in own} & {words.word_for(it) for it in there}
    )
