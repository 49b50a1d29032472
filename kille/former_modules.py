"""Modules of `kille` by the names that they had: these still work, and warn.

>>> import warnings
>>> with warnings.catch_warnings(record=True) as said:
...     warnings.simplefilter("always")
...     from kille.studies.tutors.tutor import Says
>>> Says.__module__
'kille.lab.tutors.tutor'
"""

from __future__ import annotations

FORMER_MODULES = {
    "kille.experiments": "kille.lab.protocols",
    "kille.experiments.candidates": "kille.lab.theories.candidates",
    "kille.experiments.figures": "kille.lab.reports.drawing",
    "kille.experiments.gallery": "kille.lab.scenes.galleries",
    "kille.experiments.judged": "kille.lab.scenes.published_judgements",
    "kille.experiments.labelled": "kille.lab.scenes.labelled",
    "kille.experiments.metrics": "kille.lab.measures.statistics",
    "kille.experiments.report": "kille.lab.reports.result_pages",
    "kille.experiments.results": "kille.lab.results",
    "kille.dialogue.games.classifying": "kille.dialogue.games.kinds_of_kinds",
    "kille.grounding.knowledge": "kille.grounding.lessons_and_learners",
    "kille.lab.playing": "kille.lab.playing_dialogues",
    "kille.lab.protocols.parted": "kille.lab.protocols.picture_splits",
    "kille.lab.running": "kille.lab.running_studies",
    "kille.perception.index": "kille.perception.descriptor_index",
    "kille.simulation": "kille.lab.worlds",
    "kille.simulation.perceiving": "kille.lab.worlds.perception",
    "kille.simulation.playing": "kille.lab.worlds.games",
    "kille.simulation.tutoring": "kille.lab.tutors.tested_game",
    "kille.simulation.tutors": "kille.lab.tutors.exploring",
    "kille.studies": "kille.lab",
    "kille.studies.measuring": "kille.lab.measures",
    "kille.studies.played": "kille.lab.dialogues",
    "kille.studies.reading": "kille.lab.study_files",
    "kille.studies.reporting": "kille.lab.reports",
}
"""Where the modules are now that users could know by another name."""
