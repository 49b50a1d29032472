"""Where a story and what was played differ, shown word by word."""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import SequenceMatcher

from ttr.dialogues.stories.story_reader import Line
from ttr.showing import NotebookValue, Part, Text
from ttr.updates import Step

SILENCE = "silence"
"""What is found, or expected, where the system says nothing.

>>> from ttr.dialogues.stories import SILENCE
>>> print(SILENCE)
silence
"""

_EXPECTED, _FOUND = "  expected: ", "     found: "

_WIDTH = 100
"""The longest line of a trace that is shown; logs and transcripts have it all."""


@dataclass(frozen=True)
class Mismatch(NotebookValue):
    """A line of a story that differs from what was played: `expected` and `found`.

    `trace` has the rules that ran in the turn before, `hint` is a way out.

    >>> from ttr.dialogues.stories import Line
    >>> print(Mismatch(Line("a.dlg", 3, "S>", "Hello."), "Hello.", "Good day."))
    a.dlg:3
      expected: Hello.
         found: Good day.
    """

    line: Line
    expected: str
    found: str
    trace: tuple[Step, ...] = ()
    hint: str = ""

    def _shown_as_(self) -> Part:
        return Text(str(self), "code")

    def __str__(self) -> str:
        """The place, both texts with their different words marked, and the trace."""
        expected, found = self._marks()
        lines = [
            self.line.place,
            _EXPECTED + self.expected,
            *_caret_line(_EXPECTED, expected),
            _FOUND + self.found,
            *_caret_line(_FOUND, found),
        ]
        if self.hint:
            lines.append(f"  help: {self.hint}")
        if self.trace:
            lines.append("  the rules of this turn:")
        for step in self.trace:
            lines += [_shorten(f"    {line}") for line in str(step).splitlines()]
        return "\n".join(lines)

    def _marks(self) -> tuple[str, str]:
        """Carets under the words of one side only, if the two share a word."""
        if self.line.mark != "S>" or SILENCE in (self.expected, self.found):
            return "", ""
        mine, others = _words(self.expected), _words(self.found)
        matcher = SequenceMatcher(None, _texts(mine), _texts(others), autojunk=False)
        common = matcher.get_matching_blocks()
        if not any(_has_word(mine[i : i + n]) for i, _, n in common):
            return "", ""
        only, besides = list[re.Match[str]](), list[re.Match[str]]()
        for kind, i, j, k, m in matcher.get_opcodes():
            if kind != "equal":
                only += mine[i:j]
                besides += others[k:m]
        return _carets(only), _carets(besides)


def _words(text: str) -> list[re.Match[str]]:
    return list(re.finditer(r"\w+|[^\w\s]", text))


def _has_word(words: list[re.Match[str]]) -> bool:
    return any(word[0].isalnum() for word in words)


def _texts(words: list[re.Match[str]]) -> list[str]:
    return [word[0] for word in words]


def _carets(words: list[re.Match[str]]) -> str:
    line = ""
    for word in words:
        line = line.ljust(word.start()) + "^" * len(word[0])
    return line


def _shorten(line: str) -> str:
    return line if len(line) <= _WIDTH else f"{line[: _WIDTH - 1]}…"


def _caret_line(label: str, carets: str) -> list[str]:
    return [" " * len(label) + carets] if carets else []
