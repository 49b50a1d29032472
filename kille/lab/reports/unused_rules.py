"""Rules of a user's own that never applied."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.reports.layouts import Described
from kille.lab.study import Theory
from kille.lab.theories.descriptions import describe


def unused_rules(
    theories: Mapping[str, Described], dialogues: Mapping[str, Sequence[ScoredDialogue]]
) -> Iterator[str]:
    """A line for each theory with rules of its own that were never applied.

    A state may have more fields than its type says. So a misspelt label in what a rule
    waits for cannot be found before a study is played.
    """
    usual = _rules_of(describe(Theory("usual")))
    for name, them in dialogues.items():
        applied = {rule for it in them for turn in it.turns for rule in turn.rules}
        rules = _rules_of(theories[name])
        own = [rule for rule, it in rules.items() if usual.get(rule) != it]
        never = [rule for rule in own if rule not in applied]
        if never:
            yield _describe_unused(name, never)


def _describe_unused(name: str, rules: Sequence[str]) -> str:
    what, wait = ("rules", "they wait") if len(rules) > 1 else ("rule", "it waits")
    return (
        f"{name}: no dialogue came to its own {what} {', '.join(rules)}: what {wait} "
        "for may be misspelt"
    )


def _rules_of(theory: Described) -> Mapping[str, str]:
    found = theory.get("rules")
    return found if isinstance(found, Mapping) else {}
