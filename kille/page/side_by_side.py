"""What two robots made of the same turn, side by side, with what differs marked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import Any

from kille.agent.exchanges import Exchange
from kille.page.state_changes import PARTS, Insight
from ttr import Record
from ttr.display.differences import mark_differences, omit_common_fields
from ttr.display.html import part_of_page
from ttr.display.layout import Layout, layout_of
from ttr.safety.budgets import within_budget
from ttr.updates import Step

Json = dict[str, Any]

Turns = Sequence[Exchange]

BOTH, FIRST, SECOND = "both", "first", "second"


@within_budget
def comparison_report(one: Turns, other: Turns, insight: Insight) -> Json:
    """What the two did in a turn: pairs, the first robot's before the second's.

    `lines` are what was heard, judged and said, as in the derivation. `rules` are those
    that fired, in order, each by `both`, the `first` or the `second`. `state` has for
    each part of the state after the turn the fields that differ, as matrices in HTML,
    empty where there is no such field; `alike` names the others.
    """
    return {
        "lines": [[*_lines(it, insight)] for it in (one, other)],
        "rules": [*_rules(_steps(one), _steps(other))],
        "state": [*_parts(_steps(one), _steps(other), insight)],
    }


def _lines(turns: Turns, insight: Insight) -> Iterator[tuple[str, str]]:
    """The lines of the derivation but the rules with their changes."""
    for turn in turns:
        changes = False
        for kind, text in insight.derive(turn):
            changes = kind == "rule" or (changes and not kind)
            if not changes:
                yield kind, text


def _steps(turns: Turns) -> list[Step]:
    return [step for turn in turns for step in turn.steps]


def _rules(one: Sequence[Step], other: Sequence[Step]) -> Iterator[Json]:
    """The rules in one order, in which each robot's are in the order that they had."""
    names = [it.rule.name for it in one], [it.rule.name for it in other]
    blocks = SequenceMatcher(None, *names, autojunk=False).get_opcodes()
    for kind, begin, end, begin2, end2 in blocks:
        if kind == "equal":
            yield from (_rule(it, BOTH) for it in one[begin:end])
            continue
        yield from (_rule(it, FIRST) for it in one[begin:end])
        yield from (_rule(it, SECOND) for it in other[begin2:end2])


def _rule(step: Step, by: str) -> Json:
    return {"name": step.rule.name, "does": step.rule.doc.split("\n")[0], "by": by}


def _parts(
    one: Sequence[Step], other: Sequence[Step], insight: Insight
) -> Iterator[Json]:
    if not one or not other:
        return
    states = [insight.shorten(it[-1].after) for it in (one, other)]
    if not all(isinstance(it, Record) for it in states):
        return
    for name in PARTS:
        first, second = (_fields(it[name]) for it in states)
        labels = [*dict.fromkeys([*first, *second])]
        apart = [it for it in labels if first.get(it) != second.get(it)]
        yield {
            "name": name,
            "fields": [
                {
                    "name": it,
                    "html": [
                        _draw_difference(first.get(it), second.get(it)),
                        _draw_difference(second.get(it), first.get(it)),
                    ],
                }
                for it in apart
            ],
            "alike": [it for it in labels if it not in apart],
        }


def _fields(part: object) -> dict[str, Layout]:
    assert isinstance(part, Record)
    return {label: layout_of(part[label]) for label in part}


def _draw_difference(layout: Layout | None, other: Layout | None) -> str:
    """A field as HTML, without what is the same in the other."""
    if layout is None:
        return ""
    others = [] if other is None else [other]
    return part_of_page(omit_common_fields(mark_differences(layout, others)))
