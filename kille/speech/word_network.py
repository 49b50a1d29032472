"""All that may be said, word by word: what can come next, wherever one is.

A `State` in a sentence knows whether the sentence may end there, and which words lead
on. Two states from which the same can be said are one and the same object, so that
networks are as small as can be: minimal acyclic deterministic automata.

Source: Daciuk, Mihov, Watson and Watson, "Incremental construction of minimal acyclic
finite-state automata" (2000), for the register of states.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, reduce
from itertools import zip_longest
from weakref import WeakValueDictionary


@dataclass(frozen=True, eq=False, slots=True, weakref_slot=True)
class State:
    """Where one is in a sentence; made by the functions of this module only."""

    ends: bool
    after: tuple[tuple[str, State], ...] = field(repr=False)
    """The words that may come next, in order, and where each leads."""


_KEPT = 2**18
"""How many results are remembered: those of some dozens of new words."""

NOTHING = State(False, ())
"""Where nothing can be said, not even nothing."""

_register: WeakValueDictionary[object, State] = WeakValueDictionary()
_register[False, ()] = NOTHING


def _state(ends: bool, after: Mapping[str, State]) -> State:
    """The one state with this after it."""
    arcs = tuple((word, after[word]) for word in sorted(after))
    arcs = tuple(arc for arc in arcs if arc[1] is not NOTHING)
    key = (ends, tuple((word, id(it)) for word, it in arcs))
    found = _register.get(key)
    if found is None:
        found = _register[key] = State(ends, arcs)
    return found


END = _state(True, {})
"""Where the sentence is over."""


def sequence(words: Sequence[str]) -> State:
    """Just these words, one after the other.

    >>> sequence(["a", "cup"]) is sequence(["a", "cup"])
    True
    """
    return reduce(lambda rest, word: _state(False, {word: rest}), reversed(words), END)


def union(ways: Iterable[State]) -> State:
    """What can be said in one of these ways.

    >>> list(sentences(union([sequence(["a", "cup"]), sequence(["a", "mug"])])))
    ['a cup', 'a mug']
    """
    left = list(ways) or [NOTHING]
    while len(left) > 1:
        pairs = zip_longest(left[::2], left[1::2], fillvalue=NOTHING)
        left = [_union_of_two(one, other) for one, other in pairs]
    return left[0]


@lru_cache(_KEPT)
def _union_of_two(one: State, other: State) -> State:
    if one is other or other is NOTHING:
        return one
    if one is NOTHING:
        return other
    after = dict(one.after)
    for word, it in other.after:
        after[word] = _union_of_two(after[word], it) if word in after else it
    return _state(one.ends or other.ends, after)


def concatenation(parts: Iterable[State]) -> State:
    """What can be said part by part.

    >>> a_cup_or_none = union([sequence(["a", "cup"]), END])
    >>> list(sentences(concatenation([sequence(["yes"]), a_cup_or_none])))
    ['yes', 'yes a cup']
    """
    return reduce(
        lambda rest, part: _concatenate(part, rest), reversed(list(parts)), END
    )


@lru_cache(_KEPT)
def _concatenate(first: State, second: State) -> State:
    after = {word: _concatenate(it, second) for word, it in first.after}
    rest = _state(False, after)
    return _union_of_two(rest, second) if first.ends else rest


def fill_slots(state: State, slots: Mapping[str, State]) -> State:
    """The network with other networks in place of some of its words.

    >>> naming = sequence(["a", "NOUN"])
    >>> nouns = union([sequence(["cup"]), sequence(["teddy", "bear"])])
    >>> list(sentences(fill_slots(naming, {"NOUN": nouns})))
    ['a cup', 'a teddy bear']
    """
    known: dict[State, State] = {}

    def at(here: State) -> State:
        if here not in known:
            plain = {word: at(it) for word, it in here.after if word not in slots}
            ways = [
                _concatenate(slots[w], at(it)) for w, it in here.after if w in slots
            ]
            known[here] = union([_state(here.ends, plain), *ways])
        return known[here]

    return at(state)


def restrict(state: State, may_follow: Callable[[str, str], bool]) -> State:
    """What can be said of it where a word may follow the one before.

    Before the first word stands "", and after the last.

    >>> a_cup = union([sequence(["a", "cup"]), sequence(["an", "cup"])])
    >>> list(sentences(restrict(a_cup, lambda before, word: before != "an")))
    ['a cup']
    """
    known: dict[tuple[State, str], State] = {}

    def at(here: State, before: str) -> State:
        if (here, before) not in known:
            known[here, before] = _state(
                here.ends and may_follow(before, ""),
                {
                    word: at(it, word)
                    for word, it in here.after
                    if may_follow(before, word)
                },
            )
        return known[here, before]

    return at(state, "")


def fuse_words(state: State, words: Mapping[tuple[str, str], str]) -> State:
    """The network with one word in place of two neighbours: "is", "n't" is "isn't".

    >>> it_is_not = sequence(["it", "is", "n't"])
    >>> list(sentences(fuse_words(it_is_not, {("is", "n't"): "isn't"})))
    ["it isn't"]
    """
    known: dict[State, State] = {}
    firsts = {first for first, _ in words}

    def at(here: State) -> State:
        if here not in known:
            apart = {word: at(it) for word, it in here.after if word not in firsts}
            ways = [_state(here.ends, apart)]
            for word, it in here.after:
                if word not in firsts:
                    continue
                one = {w: at(end) for w, end in _fusions(word, it, words)}
                rest = at(_state(it.ends, _unfused_words(word, it, words)))
                ways.append(_state(False, {**one, word: rest}))
            known[here] = union(ways)
        return known[here]

    return at(state)


def _fusions(
    word: str, state: State, words: Mapping[tuple[str, str], str]
) -> Iterator[tuple[str, State]]:
    """The words that a word is fused to with what comes next."""
    for second, end in state.after:
        if (word, second) in words:
            yield words[word, second], end


def _unfused_words(
    word: str, state: State, words: Mapping[tuple[str, str], str]
) -> dict[str, State]:
    """What may come next and stays apart."""
    return {w: it for w, it in state.after if (word, w) not in words}


def allows(state: State, words: Iterable[str]) -> bool:
    """Whether just these words can be said.

    >>> allows(sequence(["a", "cup"]), ["a"])
    False
    """
    here = state
    for word in words:
        here = dict(here.after).get(word, NOTHING)
    return here.ends


def reachable_states(state: State) -> list[State]:
    """All states that can be reached, this one first."""
    found, ahead = {state: None}, [state]
    while ahead:
        for _, it in ahead.pop().after:
            if it not in found:
                found[it] = None
                ahead.append(it)
    return list(found)


def sentences(state: State) -> Iterator[str]:
    """All that can be said, in alphabetical order of the words."""
    if state.ends:
        yield ""
    for word, it in state.after:
        for rest in sentences(it):
            yield f"{word} {rest}".rstrip()
