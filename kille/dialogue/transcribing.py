"""A grammar of what the robot says, made of the wordings of its lexicon.

Each wording is a rule: each stretch of its words is a terminal, its slots are the rules
`slot_…` of the grammar. So there is one place to change what the robot says, and what
it says can be understood again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from string import Formatter

from kille.dialogue.lexicon import Lexicon

__all__ = ["CLOSELY", "LOOSELY", "robot_rules"]

CLOSELY, LOOSELY = "closely", "loosely"
"""The rules for what the robot says: all of it known, or with any text in a place."""

_FREE = "_FREE_TEXT"
"""The terminal of a slot that may hold any text."""


def robot_rules(lexicon: Lexicon, grammar: str) -> str:
    """Rules for every wording, in Lark's notation.

    A slot that the grammar has no rule for is any text.
    """
    slots = set(re.findall(r"^slot_(\w+)\s*:", grammar, re.MULTILINE))
    terminals: dict[str, str] = {}
    rules: list[str] = []
    starts = {CLOSELY: "", LOOSELY: ""}
    for act, wordings in lexicon.says.items():
        for wording in wordings:
            symbols = list(_symbols(lexicon.with_examples(wording), slots, terminals))
            name = f"wording_{len(rules)}"
            rules.append(f"{name}: {' '.join(symbols)} -> {act}")
            start = LOOSELY if _FREE in symbols else CLOSELY
            starts[start] += f" | {name}" if starts[start] else name
    return "\n".join(
        [
            "",
            *(f"{start}: {ways or _FREE}" for start, ways in starts.items()),
            *rules,
            *(f"{name}: /{pattern}/i" for pattern, name in terminals.items()),
            _FREE + r": /\S.*?(?=\W*$|[.,?!:;])/s",
            "",
        ]
    )


def _symbols(wording: str, slots: set[str], terminals: dict[str, str]) -> Iterator[str]:
    """What a wording is made of, as symbols of the grammar."""
    for literal, slot in _pieces(wording):
        pattern = _pattern(literal)
        if pattern:
            yield terminals.setdefault(pattern, f"_SAYS_{len(terminals)}")
        if slot:
            yield f"slot_{slot}" if slot in slots else _FREE


def _pieces(wording: str) -> Iterator[tuple[str, str | None]]:
    for literal, slot, _, _ in Formatter().parse(wording):
        yield literal, slot


def _pattern(literal: str) -> str:
    """The regular expression of some words of a wording, or nothing.

    Marks before the first word are skipped; a quotation mark at the end is not.
    """
    text = re.sub(r"^\W+", "", literal).rstrip()
    words = [re.escape(word).replace("/", r"\/") for word in text.split()]
    pattern = r"\s+".join(words)
    return f"{pattern}\\b" if pattern and text[-1].isalnum() else pattern
