"""Rules of one's own that never applied."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.reports.layouts import Described
from kille.lab.study import Theory
from kille.lab.theories.descriptions import describe


def idle(
    theories: Mapping[str, Described], dialogues: Mapping[str, Sequence[ScoredDialogue]]
) -> Iterator[str]:
    """A line for each theory with rules of its own that its dialogues never came to.

    A state may have more than its type says. So a misspelt label in what a rule is for
    is no mistake that could be found before, but its theory is none of what was meant.
    """
    usual = _rules(describe(Theory("usual")))
    for name, them in dialogues.items():
        applied = {rule for it in them for turn in it.turns for rule in turn.rules}
        rules = _rules(theories[name])
        own = [rule for rule, it in rules.items() if usual.get(rule) != it]
        never = [rule for rule in own if rule not in applied]
        if never:
            yield _told(name, never)


def _told(name: str, rules: Sequence[str]) -> str:
    what, wait = ("rules", "they wait") if len(rules) > 1 else ("rule", "it waits")
    return (
        f"{name}: no dialogue came to its own {what} {', '.join(rules)}: what {wait} "
        "for may be misspelt"
    )


def _rules(theory: Described) -> Mapping[str, str]:
    found = theory.get("rules")
    return found if isinstance(found, Mapping) else {}
