"""Step by step: the turn waits before each rule, until somebody lets it go on."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from threading import Condition
from time import perf_counter
from typing import Any

from kille.agent.exchanges import Exchange
from kille.page.state_changes import Insight, cut_text
from ttr.updates import Step

Event = dict[str, Any]

PATIENCE = 90.0
"""Seconds that a turn waits; then it goes on, and the next ones do not wait."""

CHANGES = 40
"""Changes of a rule that are told, at most."""

_LONGEST = 400

DEEDS = ("on", "off", "step", "rest")
"""Wait before each rule; do not; apply this one; apply the rest of the turn."""


class Stepper:
    """Waits before each rule of a turn if that is wanted.

    It is called in the robot's thread, with a step that is not taken yet, and asked by
    others, whom it never keeps waiting. `tell` is given events: `stepping`, whether it
    waits before rules; `step`, before which it waits now.
    """

    def __init__(
        self,
        tell: Callable[[Event], object],
        insight: Insight,
        patience: float = PATIENCE,
    ) -> None:
        self._tell, self._insight, self._patience = tell, insight, patience
        self._changed = Condition()
        self._on = self._rest = self._may = False
        self.waited = 0.0
        """Seconds that this turn has waited."""

    def ask(self, deed: str) -> None:
        """Do one of the `DEEDS`."""
        with self._changed:
            was = self._on
            if deed in ("on", "off"):
                self._on, self._rest = deed == "on", False
            elif deed == "rest":
                self._rest = True
            self._may = deed == "step"
            self._changed.notify_all()
            is_on = self._on
        if is_on != was:
            self._tell({"type": "stepping", "on": is_on})

    def begin_turn(self) -> None:
        """Wait in this turn, even if the rest of the one before was let go."""
        with self._changed:
            self._rest = self._may = False
        self.waited = 0.0

    def __call__(self, step: Step) -> None:
        """Wait before a step, if that is wanted."""
        with self._changed:
            if not self._on or self._rest:
                return
            self._may = False
        began = perf_counter()
        self._tell({"type": "step", **self._report(step)})
        with self._changed:
            went_on = self._changed.wait_for(
                lambda: self._may or self._rest or not self._on, self._patience
            )
        self.waited += perf_counter() - began
        if not went_on:
            self.ask("off")

    def _report(self, step: Step) -> Event:
        """The rule, and what it would change."""
        alone = Exchange("", None, (step,), (), datetime.now(UTC))
        lines = [text for kind, text in self._insight.derive(alone) if kind == ""]
        changes = lines or list(step.changes)
        return {
            "rule": step.rule.name,
            "does": step.rule.doc.split("\n")[0],
            "changes": [cut_text(it, _LONGEST) for it in changes[:CHANGES]],
        }
