"""Cohen's kappa over dialogues, of the robot, the tutor and another judge."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from kille.lab.measures.measures import Measure, Vector
from kille.lab.measures.scored_dialogues import ScoredAnswer, ScoredDialogue
from kille.lab.measures.statistics import kappa_of_counts

Vocabulary = Mapping[str, Sequence[str]]
"""All that was said or held to be right, by kind of word."""

_Judge = Callable[[ScoredAnswer], str | None]
"""What somebody says of the question that an answer is to; None if nothing."""


def vocabulary(dialogues: Iterable[ScoredDialogue]) -> Vocabulary:
    """All words of the answers, by kind, in order.

    >>> from kille.lab.dialogues import Answer, Played
    >>> from kille.lab.measures import score_dialogue
    >>> from kille.lab.study import Run
    >>> answer = Answer(2, "test", "noun", "cup", "mug", "assert")
    >>> run = Run("a", "Ann", "table", 1)
    >>> vocabulary([score_dialogue(run, Played((), (answer,)), 0.1)])
    {'noun': ['', 'cup', 'mug']}
    """
    found: dict[str, set[str]] = {}
    for dialogue in dialogues:
        for it in dialogue.answers:
            if it.is_word:
                found.setdefault(it.kind, set()).update((it.right, it.said, it.judge))
    return {kind: sorted(found[kind]) for kind in sorted(found)}


def kappas(words: Vocabulary) -> tuple[Measure, Measure, Measure]:
    """Kappa of robot and tutor, of robot and another judge, of tutor and that judge.

    κ = (p_o - p_e) / (1 - p_e). Chance p_e is that within each kind of word, weighted
    by how many answers are of it: whoever is asked for a noun says no relation. The
    last of the three is the ceiling that people set: a robot cannot agree better with
    both of two who do not agree with each other.
    Source: Cohen 1960; Barlow, Lai and Azen 1991 on kappa in strata.

    >>> [it.name for it in kappas({"noun": ("cup", "mug")})]
    ['κ robot–tutor', 'κ robot–judge', 'κ tutor–judge']
    """

    def measure(
        name: str, meaning: str, one: _Judge, other: _Judge, better: int = 1
    ) -> Measure:
        kappa = _Kappa(words, one, other)
        meaning = f"{meaning}, beyond what chance would give (Cohen 1960)"
        return Measure(name, meaning, kappa.tally, kappa.of, better)

    return (
        measure("κ robot–tutor", "agreement of robot and tutor", _robot, _tutor),
        measure(
            "κ robot–judge", "agreement of the robot and another judge", _robot, _judge
        ),
        measure(
            "κ tutor–judge", "agreement of two people, the ceiling", _tutor, _judge, 0
        ),
    )


def _robot(answer: ScoredAnswer) -> str | None:
    return answer.said


def _tutor(answer: ScoredAnswer) -> str | None:
    return answer.right


def _judge(answer: ScoredAnswer) -> str | None:
    return answer.judge or None


@dataclass(frozen=True)
class _Kappa:
    """A tally holds, kind by kind, how often the two agree, and each one's words."""

    words: Vocabulary
    one: _Judge
    other: _Judge

    def tally(self, dialogue: ScoredDialogue) -> Vector:
        """How often they agree in a dialogue, and how often each says each word."""
        said: dict[str, list[tuple[str, str]]] = {kind: [] for kind in self.words}
        for it in dialogue.answers:
            first, second = self.one(it), self.other(it)
            if it.is_word and first is not None and second is not None:
                said[it.kind].append((first, second))
        counts: list[float] = []
        for kind, words in self.words.items():
            pairs = said[kind]
            counts.append(sum(a == b for a, b in pairs))
            counts += _count_each(words, [a for a, _ in pairs])
            counts += _count_each(words, [b for _, b in pairs])
        return np.array(counts, np.float64)

    def of(self, sums: Vector) -> Vector:
        """Kappa of summed tallies; 1 where both always say the same."""
        parts = list(self._parts(sums))
        if not parts:
            return np.full(sums.shape[:-1], np.nan)
        return kappa_of_counts(*(sum(them) for them in zip(*parts, strict=True)))

    def _parts(self, sums: Vector) -> Iterator[tuple[Vector, Vector, Vector]]:
        """For each kind how often they agree, how often by chance, of how many."""
        start = 0
        for words in self.words.values():
            first, second = start + 1, start + 1 + len(words)
            one = sums[..., first:second]
            other = sums[..., second : second + len(words)]
            count = one.sum(axis=-1)
            both = (one * other).sum(axis=-1)
            yield sums[..., start], both / np.maximum(count, 1), count
            start = second + len(words)


def _count_each(words: Sequence[str], said: Sequence[str]) -> list[float]:
    return [float(said.count(word)) for word in words]
