"""What is no mistake in a study, but is probably not meant.

Such a study can be played, and may say something else than whoever wrote it thinks: two
theories are the same, what is asked was never taught, or something that is set makes no
difference.
"""

from __future__ import annotations

from collections.abc import Iterator

from kille.lab.scenes import open_scene
from kille.lab.settings import Problem
from kille.lab.study import Run, Study
from kille.lab.study_files.problems import format_problems
from kille.lab.study_files.warnings import phases, scenes, scripts, theories, tutors


def warnings_of(study: Study) -> tuple[str, ...]:
    """A line for all that is probably not meant, of a study without mistakes."""
    return format_problems(_all_warnings(study), study.source, study.file)


def _all_warnings(study: Study) -> Iterator[Problem]:
    seen = {name: open_scene(study, Run("", "", name, 0)) for name in study.scenes}
    yield from theories.theory_warnings(study)
    yield from tutors.tutor_warnings(study, seen)
    yield from scripts.script_warnings(study)
    yield from scenes.scene_warnings(study, seen)
    yield from phases.phase_warnings(study, seen)
