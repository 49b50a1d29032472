"""Reads a text by a TextMate grammar, line by line, as editors do.

It knows what the grammars of `ttr.editing` use: matches, regions from `begin` to `end`,
captures, and includes from the grammar's own repository.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import regex

Rule = dict[str, Any]

_Ahead = dict[str, "regex.Match[str] | None"]
"""The next match of each pattern in a line, as far as it has been looked for."""


@cache
def compiled(pattern: str) -> regex.Pattern[str]:
    return regex.compile(pattern, regex.MULTILINE)


def scopes(grammar: Rule, text: str) -> list[str]:
    """The name of the innermost rule at each character; empty where there is none."""
    return [scope for line in _lines(grammar, text) for scope in line]


def _lines(grammar: Rule, text: str) -> Iterator[list[str]]:
    around: list[Rule] = [grammar]
    for line in text.splitlines(keepends=True):
        found = [""] * len(line)
        at = 0
        ahead: _Ahead = {}
        while True:
            step = _next_match(grammar, around, line, at, ahead)
            if step is None:
                break
            match, rule, ends = step
            names = rule.get("endCaptures" if ends else "captures", {})
            if "begin" in rule and not ends:
                names = rule.get("beginCaptures", {})
            else:
                _paint(found, match.span(), rule.get("name", "") if not ends else "")
            for group, capture in names.items():
                if int(group) and match.start(int(group)) >= 0:
                    _paint(found, match.span(int(group)), capture.get("name", ""))
            if ends:
                around.pop()
            elif "begin" in rule:
                around.append(rule)
            elif match.end() == match.start():
                raise AssertionError(f"{rule} matches nothing at all")
            at = match.end()
        yield found


def _paint(found: list[str], span: tuple[int, int], name: str) -> None:
    for place in range(*span) if name else ():
        found[place] = name


def _next_match(
    grammar: Rule, around: list[Rule], line: str, at: int, ahead: _Ahead
) -> tuple[regex.Match[str], Rule, bool] | None:
    """The leftmost match; of those at one place the end, then the first in order."""
    best: tuple[regex.Match[str], Rule, bool] | None = None
    candidates = [(around[-1].get("end"), around[-1], True)]
    candidates += [
        (rule.get("match") or rule["begin"], rule, False)
        for rule in _rules_in(grammar, around[-1])
    ]
    for pattern, rule, ends in candidates:
        found = pattern and _search(pattern, line, at, ahead)
        if found and (best is None or found.start() < best[0].start()):
            best = found, rule, ends
    return best


def _flat(grammar: Rule, rules: list[Rule]) -> Iterator[Rule]:
    for rule in rules:
        if "include" in rule:
            inner = grammar["repository"][rule["include"].removeprefix("#")]
            yield from _flat(grammar, inner["patterns"])
        elif "match" in rule or "begin" in rule:
            yield rule
        else:
            yield from _flat(grammar, rule["patterns"])


def _search(pattern: str, line: str, at: int, ahead: _Ahead) -> regex.Match[str] | None:
    known = ahead.get(pattern)
    if pattern in ahead and (known is None or known.start() >= at):
        return known
    ahead[pattern] = compiled(pattern).search(line, at)
    return ahead[pattern]


_RULES: dict[int, tuple[Rule, list[Rule]]] = {}


def _rules_in(grammar: Rule, around: Rule) -> list[Rule]:
    """The rules in a region, with what it includes; worked out once."""
    if id(around) not in _RULES:
        _RULES[id(around)] = around, [*_flat(grammar, around["patterns"])]
    return _RULES[id(around)][1]
