"""A study as a value: which theories are taught by whom, of what, how, and how often.

Whatever a name stands for – a learner, a grammar, a tutor of one's own – is found when
the study is checked, before anything is played.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

from ttr.safety.consent import Consent

__all__ = ["PERSON", "Named", "Phase", "Run", "Study", "Theory"]

PERSON = "person"
"""The mode of a theory that is none: a person plays the robot.

>>> from kille.lab.study import PERSON, Theory
>>> Theory("wizard", mode=PERSON).mode
'person'
"""

Settings = Mapping[str, Any]

MAIN_MEASURES: Mapping[str, str] = {
    "accuracy": "accuracy",
    "kappa": "κ robot–tutor",
    "accepted": "accepted",
    "reference": "reference",
    "brier": "Brier score",
    "margin": "margin",
    "turns": "turns",
    "words": "words",
    "corrections": "corrections",
}
"""What a study calls the measures of which one may be its main one, and reports do."""


@dataclass(frozen=True)
class Theory:
    """A theory of what is meant and said, by all in which it may differ from another.

    `strategy` sets values of the strategy apart from its mode and wording; `without`
    names rules that it lacks; `rules` are of one's own (`FILE.py:NAME`, `FILE.ttr`),
    `grammar` a folder with a grammar and a lexicon of one's own, `meanings` types that
    are defined otherwise than in `tutor.ttr`, or a file in its place. `learners` say,
    for nouns, adjectives and relations, what judges the words.

    >>> shy = Theory("shy", wording="four", strategy={"bands": {"sure": 0.9}})
    >>> shy.language, shy.wording
    ('en', 'four')
    """

    name: str
    language: str = "en"
    mode: str = ""
    wording: str = ""
    strategy: Settings = field(default_factory=dict)
    without: tuple[str, ...] = ()
    rules: str = ""
    grammar: Path | None = None
    learners: Mapping[str, str] = field(default_factory=dict)
    meanings: str | Mapping[str, str] = ""
    about: str = ""
    consent: Consent | None = field(default=None, compare=False, repr=False)
    """What the user lets the files of a study use; None if Python made the theory."""


@dataclass(frozen=True)
class Named:
    """A tutor, or scenes: its name in the study, its kind, and the settings of that.

    >>> ann = Named("ann", "simulated", {"errs": 0.1})
    >>> ann.kind, ann.settings["errs"]
    ('simulated', 0.1)
    """

    name: str
    kind: str
    settings: Settings = field(default_factory=dict)


@dataclass(frozen=True)
class Phase:
    """A part of every dialogue: what the tutor does in it, and for how long.

    `do` is one of those of `kille.lab.protocols.phases`; `settings` are its own.

    >>> Phase("places", "teach", {"what": "relations"}).do
    'teach'
    """

    name: str
    do: str
    settings: Settings = field(default_factory=dict)


@dataclass(frozen=True)
class Run:
    """One dialogue of a study, named by what is combined in it.

    >>> str(Run("both cues", "Ann", "table", 3))
    'both cues/Ann/table/3'
    """

    theory: str
    tutor: str
    scene: str
    seed: int

    def __str__(self) -> str:
        return f"{self.theory}/{self.tutor}/{self.scene}/{self.seed}"

    @property
    def pair(self) -> tuple[str, str, int]:
        """What a run has in common with those of other theories."""
        return self.tutor, self.scene, self.seed

    def chance(self, of: str) -> Random:
        """The random generator for something in it, the same for all theories."""
        return Random(f"{of} {self.tutor} {self.scene} {self.seed}")


@dataclass(frozen=True)
class Study:
    """All that is to be played. `turns` bounds what a tutor does in one dialogue.

    `main` is one of `MAIN_MEASURES`; `contrasts` are the theories that are compared,
    the second of each two with the first, or if there are none, every two.

    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> cups = parse(text, Path("cups.toml"))
    >>> [str(run) for run in cups.runs()]
    ['plain/ann/table/1']
    """

    title: str
    theories: Mapping[str, Theory]
    tutors: Mapping[str, Named]
    scenes: Mapping[str, Named]
    phases: tuple[Phase, ...]
    seeds: tuple[int, ...]
    about: str = ""
    turns: int = 1000
    main: str = "accuracy"
    contrasts: tuple[tuple[str, str], ...] = ()
    source: str = ""
    """The file's text, by which the study is known again."""
    folder: Path = Path()
    """Where the file is, from which the paths in it begin."""
    file: Path = Path("study.toml")
    """The file, as it was named."""
    consent: Consent | None = field(default=None, compare=False, repr=False)
    """As that of a theory."""

    def path(self, name: str) -> Path:
        """The file or folder that a setting names, from the folder of the study."""
        return self.folder / os.path.expanduser(name)

    def in_numbers(self, played: int | None = None) -> str:
        """What it combines, in numbers; `played` says of how many there are results.

        >>> study = Study("", {"a": Theory("a")}, {}, {}, (), (1, 2))
        >>> study.in_numbers()
        '0 dialogues: 1 theory × 0 tutors × 0 scenes × 2 seeds'
        """
        parts = (
            _count_of(len(self.theories), "theory", "theories"),
            _count_of(len(self.tutors), "tutor", "tutors"),
            _count_of(len(self.scenes), "scene", "scenes"),
            _count_of(len(self.seeds), "seed", "seeds"),
        )
        planned = sum(1 for _ in self.runs())
        some = "" if played is None or played == planned else f"{played:,} of "
        dialogues = _count_of(planned, "dialogue", "dialogues")
        return f"{some}{dialogues}: {' × '.join(parts)}"

    def runs(self) -> Iterator[Run]:
        """All dialogues; those that are compared with each other stand in a row."""
        for seed, scene, tutor, theory in product(
            self.seeds, self.scenes, self.tutors, self.theories
        ):
            yield Run(theory, tutor, scene, seed)


def _count_of(count: int, one: str, many: str) -> str:
    return f"{count:,} {one if count == 1 else many}"
