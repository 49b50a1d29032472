"""Coverage: which rules were applied in dialogues, and which right after which."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from ttr.aliases import Alias
from ttr.dialogues.dialogue import Dialogue
from ttr.showing import NotebookValue, Part, Text, Tone, below, count_of, table
from ttr.updates.games import Game


@dataclass
class Coverage(NotebookValue):
    """Counts of the dialogues, turns, rules and pairs of rules of one game.

    A pair (r, s) counts how often s was applied right after r in a turn. `add` counts
    one more dialogue; `table` gives the counts as text, `facts` as plain data.
    """

    game: Game
    dialogues: int = 0
    turns: int = 0
    rules: Counter[str] = field(default_factory=Counter)
    pairs: Counter[tuple[str, str]] = field(default_factory=Counter)

    def add(self, dialogue: Dialogue) -> None:
        """Count a dialogue."""
        self.dialogues += 1
        self.turns += len(dialogue.trials)
        for trial in dialogue.trials:
            names = [step.rule.name for step in trial.applied]
            self.rules.update(names)
            self.pairs.update(pairwise(names))

    @property
    def missed_rules(self) -> tuple[str, ...]:
        """The rules that no dialogue applied, in the order of the game."""
        return tuple(name for name in self.names if not self.rules[name])

    missed = Alias("missed_rules")

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the game's rules, in its order."""
        return tuple(dict.fromkeys(rule.name for rule in self.game.rules))

    def table(self) -> str:
        """The rules, how often each was applied, and which rules followed most often.

        >>> from ttr import rectype
        >>> from ttr.updates import rule
        >>> @rule(when=rectype())
        ... def rest(s):
        ...     return s
        >>> print(Coverage(Game("idle", rectype(), {}, rest)).table())
        rule  applied  most often followed by
        rest        0  never applied
        0 of 1 rules applied, 0 pairs of rules, in 0 turns of 0 dialogues
        """
        width = max(map(len, [*self.names, "rule"]))
        count = max(len("applied"), *(len(f"{n}") for n in [*self.rules.values(), 0]))
        lines = [f"{'rule':{width}}  {'applied':>{count}}  most often followed by"]
        for name in self.names:
            n = self.rules[name]
            lines.append(
                f"{name:{width}}  {n:>{count}}  {self._most_frequent_successors(name)}"
            )
        applied = len(self.names) - len(self.missed_rules)
        pairs = sum(1 for n in self.pairs.values() if n)
        lines.append(
            f"{applied} of {len(self.names)} rules applied, "
            f"{pairs} pair{'s' * (pairs != 1)} of rules, "
            f"in {self.turns} turn{'s' * (self.turns != 1)} "
            f"of {self.dialogues} dialogue{'s' * (self.dialogues != 1)}"
        )
        return "\n".join(line.rstrip() for line in lines)

    def _most_frequent_successors(self, name: str) -> str:
        if not self.rules[name]:
            return "never applied"
        after = {then: n for (first, then), n in self.pairs.items() if first == name}
        most = sorted(after, key=lambda then: (-after[then], then))[:3]
        rest = f" and {len(after) - 3} more" if len(after) > 3 else ""
        return ", ".join(f"{then} {after[then]}" for then in most) + rest

    def _shown_as_(self) -> Part:
        def row(name: str) -> tuple[Part, ...]:
            n = self.rules[name]
            follow = self._most_frequent_successors(name)
            tone: Tone = "plain" if n else "no"
            return Text(name, "strong"), Text(f"{n:,}"), Text(follow, tone)

        played = count_of(self.turns, "turn"), count_of(self.dialogues, "dialogue")
        return below(
            table(("rule", "applied", "most often followed by"), self.names, row),
            Text(" of ".join(played), "quiet"),
        )

    def facts(self) -> Mapping[str, object]:
        """The counts as plain data."""
        pairs = sorted(self.pairs.items())
        return {
            "dialogues": self.dialogues,
            "turns": self.turns,
            "rules": {name: self.rules[name] for name in self.names},
            "never_applied": list(self.missed_rules),
            "pairs": [{"rule": a, "then": b, "times": n} for (a, b), n in pairs],
        }
