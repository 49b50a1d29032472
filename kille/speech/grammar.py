"""From a grammar in Lark's notation to the network of all that can be said by it.

Rules that find words which may be learned become slots, to be filled with the words
that are known; all other terminals are spelled out. A rule may stand within itself only
so often, so that the network ends.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from kille.speech.pattern_expansion import UncountablePatternError, spellings
from kille.speech.word_network import NOTHING, State, concatenation, sequence, union

if TYPE_CHECKING:
    from lark.grammar import Symbol

SLOTS = ("_noun", "_several", "_adjective", "_relation")
"""The rules of the grammar that find words of the tutor's."""

CONTRACTED = {
    (first, second): f"{first}{second}"
    for second, them in {
        "n't": ("is", "are", "do", "does"),
        "'s": ("that", "it", "what", "where"),
        "'re": ("you", "they"),
        "'m": ("i",),
        "'d": ("i",),
    }.items()
    for first in them
}
"""Words that are said as one with the one before, and as what."""

_IN_FULL = {"n't": "not", "'s": "is", "'re": "are", "'m": "am", "'d": "would"}

TAUGHT = "_noun taught"
"""The slot of a noun that is said of a thing in a lesson: it may be a new one."""

_TEACHING = frozenset({"instruct", "correct"})
_NAMING = frozenset({"naming", "plain"})
"""The moves that teach nouns, and the rules in which these then stand."""

UNHEARD = frozenset(
    {
        "compared",
        "_compared",
        "comparison",
        "ask_more",
        "ask_all",
        "ask_also",
        "ask_between",
        "ask_side",
        "ask_taught",
        "placed_between",
        "between",
        "of_all_so",
        "of_these_so",
        "so_several",
        "side_there",
        "what_most",
        "_which_most",
        "_which_of_them",
        "_how_many_of",
        "_what_one_is",
        "_after",
        "_any_of_them",
        "_most",
        "_measured",
        "_amid",
        "middle",
    }
)
"""The rules that are not listened for: the more may be said, the worse it is heard."""

_NESTED = 2
"""How often a rule may stand within itself, counting itself: "the cup by the box"."""


def split_words(text: str) -> list[str]:
    """The words of a text as they are heard: what hangs on a word is one of its own.

    Two that are mostly one, as in `CONTRACTED`, stay one.

    >>> split_words("Isn't this the car's left, then?")
    ["isn't", 'this', 'the', 'car', "'s", 'left', 'then']
    """
    words = " ".join(it.strip('.,!?;:…"“”') for it in text.lower().split())
    apart = words.replace("’", "'").replace("'", " '").replace("n 't", " n't")
    for (first, second), one in CONTRACTED.items():
        apart = f" {apart} ".replace(f" {first} {second} ", f" {one} ")
    return apart.split()


def in_full(words: Iterable[str]) -> str:
    """Words as a text without contractions, which mean the same.

    >>> in_full(["where's", "the", "cup"])
    'where is the cup'
    """
    return " ".join(_FULL.get(word, word) for word in words)


_FULL = {
    one: f"{first} {_IN_FULL[second]}" for (first, second), one in CONTRACTED.items()
}


@cache
def tutors_grammar(language: str, *unsaid: str) -> State:
    """All that a tutor may say in a language, with slots for their words."""
    source = files("kille.grammars").joinpath(f"tutor.{language}.lark")
    return sayable(source.read_text(encoding="utf-8"), unsaid)


def sayable(source: str, unsaid: Iterable[str] = ()) -> State:
    """All that can be said by a grammar, from `start` on; without the words unsaid.

    >>> from kille.speech.word_network import sentences
    >>> rules = ['start: _YES? "a" _noun', "_noun: /[^ ]+/", "_YES: /(yes|yeah)/"]
    >>> list(sentences(sayable(chr(10).join(rules))))
    ['a _noun', 'yeah a _noun', 'yes a _noun']
    """
    from lark import Lark

    read = Lark(source, parser=None, lexer="basic")
    patterns = {it.name: it.pattern.to_regexp() for it in read.terminals}
    rules: dict[str, list[Sequence[Symbol]]] = {}
    for rule in read.rules:
        rules.setdefault(str(rule.origin.name), []).append(rule.expansion)
    return _Unfolding(rules, patterns, frozenset(unsaid)).start()


def _terminal_network(pattern: str, unsaid: frozenset[str]) -> State:
    """The ways to say a terminal; none, if it stands for any word, or for a sign that
    is only written, such as "#"."""
    try:
        ways = [split_words(it.replace("-", " ")) for it in spellings(pattern)]
    except UncountablePatternError:
        return NOTHING
    return union(
        sequence(way)
        for way in ways
        if way and unsaid.isdisjoint(way) and all(map(_is_word, way))
    )


def _is_word(word: str) -> bool:
    return any(sign.isalnum() for sign in word)


class _Unfolding:
    """The rules of a grammar, each unfolded to its network where it stands."""

    def __init__(
        self,
        rules: Mapping[str, list[Sequence[Symbol]]],
        patterns: Mapping[str, str],
        unsaid: frozenset[str],
    ) -> None:
        self._rules, self._patterns, self._unsaid = rules, patterns, unsaid
        self._terminals: dict[str, State] = {}
        self._known: dict[tuple[str, tuple[str, ...], str], State] = {}
        self._endless = {name for name in rules if name in self._within(name)}

    def start(self) -> State:
        return self._rule("start", (), "")

    def _within(self, name: str) -> set[str]:
        """The rules that may stand within a rule."""
        found, ahead = set[str](), [name]
        while ahead:
            for symbols in self._rules[ahead.pop()]:
                new = {str(it.name) for it in symbols if not it.is_term} - found
                found |= new
                ahead += new
        return found

    def _rule(self, name: str, around: tuple[str, ...], teaching: str) -> State:
        """What a rule finds, within the rules around it that may hold themselves."""
        if name in UNHEARD:
            return NOTHING
        if name in SLOTS:
            taught = name == SLOTS[0] and teaching in _NAMING
            return sequence([TAUGHT if taught else name])
        if around.count(name) >= _NESTED:
            return NOTHING
        if name in self._endless:
            around = tuple(sorted((*around, name)))
        teaching = _teaching_rule(name, teaching)
        key = (name, around, teaching)
        if key not in self._known:
            self._known[key] = union(
                concatenation(self._symbol(it, around, teaching) for it in symbols)
                for symbols in self._rules[name]
            )
        return self._known[key]

    def _symbol(self, symbol: Symbol, around: tuple[str, ...], teaching: str) -> State:
        if symbol.is_term:
            return self._terminal(symbol.name)
        return self._rule(str(symbol.name), around, teaching)

    def _terminal(self, name: str) -> State:
        """What a terminal finds; worked out only where it stands in a rule heard."""
        if name not in self._terminals:
            pattern = self._patterns[name]
            self._terminals[name] = _terminal_network(pattern, self._unsaid)
        return self._terminals[name]


def _teaching_rule(name: str, around: str) -> str:
    """The rule that says that a new noun may be taught here, or nothing."""
    if name in _TEACHING or (around and name in _NAMING):
        return name
    return around if around in _TEACHING else ""
