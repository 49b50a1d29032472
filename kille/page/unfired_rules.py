"""The rules that did not fire in a turn, and why: worked out when somebody asks.

What takes an event up is judged in the state before it, all other rules in the state
after that: there they had their chance.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from kille.agent.exchanges import Exchange
from kille.page.state_changes import cut_text
from ttr.errors import UpdateError
from ttr.safety.budgets import within_budget
from ttr.updates import Game, Rule, Step, run
from ttr.updates.nbest import match_event
from ttr.updates.rule_application import why_not

Json = dict[str, Any]

LONGEST = 240
"""Characters of a reason, at most: it may mention all of the state."""

FOUND_NOTHING, CAME_LATER = "found nothing", "came later"
"""Why a rule did not fire whose condition held: its function gave no state; or another
rule fired in its place."""


def unfired_report(game: Game, turns: Iterable[Exchange]) -> list[Json]:
    """For each event of a turn, the rules that did not fire, by the reasons why.

    `fired` are those that did; `others` is how many wait for events of other types. A
    reason is a text, or one of those above.
    """
    events: list[list[Step]] = []
    for step in (step for turn in turns for step in turn.steps):
        if step.rule.on is not None or not events:
            events.append([])
        events[-1].append(step)
    return [_event_report(game, steps) for steps in events]


@within_budget
def _event_report(game: Game, steps: Sequence[Step]) -> Json:
    fired = {it.rule.name for it in steps}
    others, reasons = 0, dict[str, list[Json]]()
    for rule in game.rules:
        if rule.name in fired:
            continue
        if _waits_for_another(rule, steps[0]):
            others += 1
            continue
        does = rule.doc.split("\n")[0]
        why = _why(game, rule, steps)
        reasons.setdefault(why, []).append({"name": rule.name, "does": does})
    return {
        "fired": [it.rule.name for it in steps],
        "others": others,
        "reasons": [*_in_order(reasons)],
    }


def _waits_for_another(rule: Rule, at: Step) -> bool:
    """Whether it takes events of another type than this one."""
    if rule.on is None:
        return False
    return match_event(at.given, rule.on, rule.p, at.model) is None


def _why(game: Game, rule: Rule, steps: Sequence[Step]) -> str:
    """Why a rule did not fire: one that takes the event before, others after that."""
    first, model = steps[0], steps[min(1, len(steps) - 1)].model
    taken = first.rule.on is not None
    event = first.given if rule.on is not None else None
    state = first.after if event is None and taken else first.before
    reason = why_not(rule, state, event, model)
    if reason:
        return cut_text(reason, LONGEST)
    events = [] if event is None else [event]
    try:
        after = run(rule, state, type=game.type, model=model, events=events)
    except UpdateError as error:  # it was never tried in this state
        return str(error)
    return CAME_LATER if after.trace else FOUND_NOTHING


def _in_order(reasons: dict[str, list[Json]]) -> Iterator[Json]:
    """What nearly fired first, then the reasons of the fewest rules."""
    near = (CAME_LATER, FOUND_NOTHING)
    found = sorted(
        reasons.items(),
        key=lambda it: (near.index(it[0]) if it[0] in near else 2, len(it[1])),
    )
    for why, rules in found:
        yield {"why": why, "rules": rules}
