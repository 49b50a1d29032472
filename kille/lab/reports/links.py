"""Addresses of the dialogues behind the numbers: pages beside the report, and parts.

There is a page for the dialogues of all theories with the same tutor, scene and seed,
two for the dialogues and the answers of each theory, and one for each two theories.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.study import Run

Pair = tuple[str, str, int]

_Name = TypeVar("_Name")


@dataclass(frozen=True)
class Places:
    """The addresses of dialogues; what they are of has numbers from 1.

    `folder` is the address of their folder, as seen from the report.
    """

    folder: str
    theories: Mapping[str, int]
    tutors: Mapping[str, int]
    scenes: Mapping[str, int]
    phases: Mapping[str, int]
    words: Mapping[tuple[str, str], int]
    kinds: Mapping[str, int]
    ways: Mapping[str, int]
    pairs: Mapping[Pair, int]

    def theory(self, name: str) -> str:
        """All dialogues of a theory."""
        return f"{self.folder}/theory-{self.theories[name]}.html"

    def tutor(self, name: str, tutor: str) -> str:
        """The dialogues of a theory with a tutor."""
        return f"{self.theory(name)}#tutor-{self.tutors[tutor]}"

    def scene(self, name: str, scene: str) -> str:
        """The dialogues of a theory in front of a scene."""
        return f"{self.theory(name)}#scene-{self.scenes[scene]}"

    def answers(self, name: str) -> str:
        """All answers of a theory."""
        return f"{self.folder}/theory-{self.theories[name]}-answers.html"

    def word(self, name: str, kind: str, word: str) -> str:
        """The answers of a theory where this word was right."""
        return f"{self.answers(name)}#word-{self.words[kind, word]}"

    def kind(self, name: str, kind: str) -> str:
        """The answers of a theory where a word of this kind was right."""
        return f"{self.answers(name)}#kind-{self.kinds[kind]}"

    def phase(self, name: str, phase: str) -> str:
        """The answers of a theory in a phase."""
        return f"{self.answers(name)}#phase-{self.phases[phase]}"

    def way(self, name: str, way: str) -> str:
        """The answers of a theory that were put in this way."""
        return f"{self.answers(name)}#way-{self.ways[way]}"

    def against(self, one: str, other: str) -> str:
        """Where two theories differ most."""
        first, second = sorted((self.theories[one], self.theories[other]))
        return f"{self.folder}/theories-{first}-{second}.html"

    def dialogue(self, run: Run) -> str:
        """One dialogue."""
        number, theory = self.pairs[run.pair], self.theories[run.theory]
        return f"{self.folder}/dialogue-{number}.html#theory-{theory}"

    def turn(self, run: Run, turn: int) -> str:
        """One turn of a dialogue."""
        return f"{self.dialogue(run)}-turn-{turn}"


def places_of(
    theories: Sequence[str], dialogues: Sequence[ScoredDialogue], folder: str
) -> Places:
    """The places of these dialogues, in their order.

    >>> from kille.lab.measures import ScoredDialogue
    >>> run = Run("cues", "Ann", "table", 3)
    >>> dialogue = ScoredDialogue(run, (), (), 0, 0.1)
    >>> places_of(["both", "cues"], [dialogue], "all").turn(run, 7)
    'all/dialogue-1.html#theory-2-turn-7'
    """
    answers = [answer for it in dialogues for answer in it.answers]
    phases = [
        *(one.phase for it in dialogues for one in it.efforts),
        *(it.phase for it in answers),
    ]
    return Places(
        folder,
        theories=_number(theories),
        tutors=_number([it.run.tutor for it in dialogues]),
        scenes=_number([it.run.scene for it in dialogues]),
        phases=_number(phases),
        words=_number(sorted({(it.kind, it.right) for it in answers})),
        kinds=_number(sorted({it.kind for it in answers})),
        ways=_number(sorted({it.way for it in answers})),
        pairs=_number([it.pair for it in dialogues]),
    )


def _number(names: Sequence[_Name]) -> dict[_Name, int]:
    """Each name once, in order, with its number from 1."""
    return {name: number for number, name in enumerate(dict.fromkeys(names), start=1)}
