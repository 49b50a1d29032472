"""What a turn did to the information state, for who wants to look inside.

Nothing of it is worked out before somebody asks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from kille.agent.exchanges import Exchange
from ttr import Record, record
from ttr.display.differences import layout_of_changes
from ttr.display.html import STYLE, part_of_page
from ttr.safety.budgets import within_budget
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.updates import Step

Json = dict[str, Any]

MATRIX_STYLE = STYLE
"""The style of the matrices, as a file of its own: the page has no style inline."""

LONGEST = 600
"""Characters of a condition or of what is bound, at most."""

PARTS = ("shared", "view", "private")


class Insight(NamedTuple):
    """How turns are told to people: their derivations, and values in short."""

    derive: Callable[[Exchange], Iterable[tuple[str, str]]] = lambda _: ()
    """The derivation of a turn: pairs of what a line is about, and its text."""
    shorten: Callable[[Object], Object] = lambda value: value


PLAIN = Insight()


@within_budget
def inside_report(
    turns: Sequence[Exchange], insight: Insight, earlier: Sequence[Exchange] = ()
) -> Json:
    """The derivation of a turn, and the state after it with what has changed marked.

    `steps` are the rules that fired, in order: their events and conditions, and what
    they have bound. `state` has a matrix for each field of the state's parts, as HTML;
    where no rule fired, it is the state after the `earlier` turns.
    """
    steps = [step for turn in turns for step in turn.steps]
    lines = [line for turn in turns for line in insight.derive(turn)]
    latest = [it.steps[-1].after for it in reversed(earlier) if it.steps][:1]
    states = [steps[0].before, steps[-1].after] if steps else latest * 2
    state: list[Json] = []
    match [*map(insight.shorten, states)]:
        case [Record() as before, Record() as after]:
            state = [_part(name, before[name], after[name]) for name in PARTS]
    return {"lines": lines, "steps": [*map(_step, steps)], "state": state}


def _step(step: Step) -> Json:
    """What a rule that fired was waiting for, and what it has bound."""
    rule = step.rule
    return {
        "on": "" if rule.on is None else cut_text(str(rule.on)),
        "when": cut_text(str(rule.when)),
        "bindings": [[it, cut_text(notation(at))] for it, at in step.bindings.items()],
    }


def cut_text(text: str, longest: int = LONGEST) -> str:
    """The beginning of a text that is longer than so many characters.

    >>> cut_text("This is a cup.", 7)
    'This is …'
    """
    return text if len(text) <= longest else text[:longest] + " …"


def _part(name: str, before: Record, after: Record) -> Json:
    return {"name": name, "fields": [*_fields(before, after)]}


def _fields(before: Record, after: Record) -> Iterator[Json]:
    for label in after:
        changes = layout_of_changes(before[label], after[label])
        yield {
            "name": label,
            "changed": identity(before[label]) != identity(after[label]),
            "empty": after[label] in ((), record(), ""),
            "html": part_of_page(changes),
        }
