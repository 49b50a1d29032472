"""Addresses of the dialogues behind the numbers: pages beside the report, and parts.

There is a page for the dialogues of all theories with the same tutor, scene and seed,
two for the dialogues and the answers of each theory, and one for each two theories.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.study import Run

Pair = tuple[str, str, int]

_Name = TypeVar("_Name")


@dataclass(frozen=True)
class Places:
    """The addresses of dialogues; what they are of has numbers from 1.

    `folder` is the address of their folder, as seen from the report. `numbers` are
    those of each tutor, scene, phase, way, kind and word, under these names.
    """

    folder: str
    theories: Mapping[str, int]
    pairs: Mapping[Pair, int]
    numbers: Mapping[str, Mapping[Any, int]]

    def theory(self, name: str) -> str:
        """All dialogues of a theory."""
        return f"{self.folder}/theory-{self.theories[name]}.html"

    def dialogues(self, name: str, what: str, one: str) -> str:
        """The dialogues of a theory with a `tutor`, or in front of a `scene`."""
        return f"{self.theory(name)}#{what}-{self.numbers[what][one]}"

    def answers(self, name: str, what: str = "", one: object = None) -> str:
        """The answers of a theory: all, or those in a `phase`, put in a `way`, …

        A `kind` and a `word` (a kind and a word of it) are those of the right answer.
        """
        page = f"{self.folder}/theory-{self.theories[name]}-answers.html"
        return f"{page}#{what}-{self.numbers[what][one]}" if what else page

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
    names: Mapping[str, Sequence[object]] = {
        "tutor": [it.run.tutor for it in dialogues],
        "scene": [it.run.scene for it in dialogues],
        "phase": phases,
        "word": sorted({(it.kind, it.right) for it in answers}),
        "kind": sorted({it.kind for it in answers}),
        "way": sorted({it.way for it in answers}),
    }
    return Places(
        folder,
        theories=_number(theories),
        pairs=_number([it.pair for it in dialogues]),
        numbers={what: _number(them) for what, them in names.items()},
    )


def _number(names: Sequence[_Name]) -> dict[_Name, int]:
    """Each name once, in order, with its number from 1."""
    return {name: number for number, name in enumerate(dict.fromkeys(names), start=1)}
