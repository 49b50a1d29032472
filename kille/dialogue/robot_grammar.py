"""A grammar of what the robot says, made of the wordings of its lexicon.

Each wording becomes a rule: each stretch of its words is a terminal, and its slots are
the rules `slot_…` of the grammar. So what the robot says is changed in one place, and
can be understood again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from string import Formatter

from kille.dialogue.lexicon import Lexicon

CLOSELY, LOOSELY = "closely", "loosely"
"""The rules for what the robot says: all of it known, or with any text in a place."""

_ASKS = "_ASKS"
"""The terminal of the grammar for a question mark at the end."""

_FREE = "_FREE_TEXT"
"""The terminal of a slot that may hold any text."""


def robot_rules(lexicon: Lexicon, grammar: str) -> str:
    """Rules for every wording, in Lark's notation.

    A slot that the grammar has no rule for is any text.
    """
    rules = re.findall(r"^(_?slot_(\w+))\s*:", grammar, re.MULTILINE)
    slots = {slot: rule for rule, slot in rules}
    terminals: dict[str, str] = {}
    wordings: list[str] = []
    starts = {CLOSELY: "", LOOSELY: ""}
    for act, sentences in lexicon.wordings.items():
        for wording in sentences:
            symbols = list(_symbols(lexicon.with_examples(wording), slots, terminals))
            name = f"wording_{len(wordings)}"
            wordings.append(f"{name}: {' '.join(symbols)} -> {act}")
            start = LOOSELY if any(map(_is_loose, symbols)) else CLOSELY
            starts[start] += f" | {name}" if starts[start] else name
    return "\n".join(
        [
            "",
            *(f"{start}: ({ways or _FREE}) {_ASKS}?" for start, ways in starts.items()),
            *wordings,
            *(f"{name}: /{pattern}/i" for pattern, name in terminals.items()),
            _FREE + r": /\S.*?(?=\W*$|\s*[.,?!:;()])/s",
            "",
        ]
    )


def _is_loose(symbol: str) -> bool:
    """Whether a symbol matches a text without a meaning."""
    return symbol == _FREE or symbol.startswith("_slot_")


def _symbols(
    wording: str, slots: Mapping[str, str], terminals: dict[str, str]
) -> Iterator[str]:
    """What a wording is made of, as symbols of the grammar."""
    for literal, slot in _pieces(wording):
        pattern = _pattern(literal)
        if pattern:
            yield terminals.setdefault(pattern, f"_SAYS_{len(terminals)}")
        if slot:
            yield slots.get(slot, _FREE)


def _pieces(wording: str) -> Iterator[tuple[str, str | None]]:
    for literal, slot, _, _ in Formatter().parse(wording):
        yield literal, slot


def _pattern(literal: str) -> str:
    """The regular expression of some words of a wording, or nothing.

    Marks before it that mean nothing are skipped; a quotation mark at the end is not.
    """
    text = re.sub(r"^[\s.,!?;:…\"“”]+", "", literal).rstrip()
    words = [re.escape(word).replace("/", r"\/") for word in text.split()]
    pattern = r"\s+".join(words)
    return f"{pattern}\\b" if pattern and text[-1].isalnum() else pattern
