"""Several tutors who teach one robot in turns, and may disagree."""

from __future__ import annotations

from collections.abc import Sequence

from kille.lab.tutors.tutor import Task, Turns, Tutor


class Several:
    """Several tutors who take turns, with every phase or with every task.

    Which one it is follows from the number of the task alone, or from how many phases
    there were.
    """

    def __init__(self, of: Sequence[Tutor], by: str = "phase") -> None:
        self._of, self._by = tuple(of), by
        self._phases: list[str] = []
        self._now = self._of[0]

    @property
    def name(self) -> str:
        """Whose turn it is."""
        return self._now.name

    def turns(self, task: Task) -> Turns:
        """The moves of the one whose turn it is."""
        if task.phase not in self._phases:
            self._phases.append(task.phase)
        turn = len(self._phases) - 1 if self._by == "phase" else task.number - 1
        self._now = self._of[turn % len(self._of)]
        return self._now.turns(task)
