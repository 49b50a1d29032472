"""Scenes that have less to show than is asked of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from kille.lab.scenes import SETTINGS, Scene
from kille.lab.scenes.captured import Captured
from kille.lab.scenes.statements import Statements
from kille.lab.settings import Problem, fill_settings
from kille.lab.study import Named, Study
from kille.lab.study_files.phases import TEACHING, kind_of


def scene_warnings(study: Study, opened: Mapping[str, Scene]) -> Iterator[Problem]:
    """What is probably not meant in the scenes of a study."""
    for name, scene in study.scenes.items():
        pictured = scene.kind in ("pictures", "statements")
        found = (
            *_useless_shift(scene, study),
            *(_missing_examples(scene, opened[name], study) if pictured else ()),
            *_missing_things(scene, study),
        )
        yield from (it.within("scenes", name) for it in found)


def _useless_shift(scene: Named, study: Study) -> Iterator[Problem]:
    """A landmark that moves when it is not asked about."""
    asked = [it for it in study.phases if it.settings.get("of") == "new"]
    if scene.settings.get("shift") and "relation" not in map(kind_of, asked):
        told = 'the landmark moves for relations of = "new", which none are'
        yield Problem(("shift",), told)


def _missing_examples(scene: Named, opened: Scene, study: Study) -> Iterator[Problem]:
    """Words of which the data have fewer examples than are to be taught and kept."""
    taught, kept = (Counter(it) for it in _examples(opened))
    set_ = fill_settings(scene.settings, SETTINGS[scene.kind])
    is_asked = any(it.settings.get("of") == "new" for it in study.phases)
    for word in {**taught, **kept}:
        for key, found in (("each", taught[word]), ("new", kept[word])):
            if found < set_[key] and (key == "each" or is_asked):
                told = f"of {word} there are {found} only, and not {key} = {set_[key]}"
                yield Problem((key if key in scene.settings else "folder",), told)


def _examples(opened: Scene) -> tuple[Sequence[str], Sequence[str]]:
    """What is taught, and what is kept, by its words, where these are data."""
    match opened:
        case Statements():
            return [it for it, _ in opened.taught], [it for it, _ in opened.kept]
        case Captured():
            return [it.group for it in opened.taught], [it.group for it in opened.kept]
    return (), ()


def _missing_things(scene: Named, study: Study) -> Iterator[Problem]:
    """Phases in which fewer things are in view than there should be."""
    if scene.kind != "drawn":
        return
    set_ = fill_settings(scene.settings, SETTINGS["drawn"])
    for phase in study.phases:
        if phase.do not in ("ask", "find", *TEACHING) or kind_of(phase) == "relation":
            continue
        of = {"same": "each", "new": "new"}.get(phase.settings.get("of", "same"), "")
        things = len(set_["kinds"]) * set_[of]
        if "in_view" in scene.settings and things < set_["in_view"]:
            told = f"{things} things only are in view in the phase {phase.name}"
            told = f"{told}: there are no more, by kinds and {of} = {set_[of]}"
            yield Problem(("in_view",), told)
