"""All that may be said, word by word: what can come next, wherever one is.

A `Place` in a sentence knows whether the sentence may end there, and which words lead
on. Two places from which the same can be said are one and the same object, so that
networks are as small as can be: minimal acyclic deterministic automata.

Source: Daciuk, Mihov, Watson and Watson, "Incremental construction of minimal acyclic
finite-state automata" (2000), for the register of places.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, reduce
from itertools import zip_longest
from weakref import WeakValueDictionary


@dataclass(frozen=True, eq=False, slots=True, weakref_slot=True)
class Place:
    """Where one is in a sentence; made by the functions of this module only."""

    ends: bool
    after: tuple[tuple[str, Place], ...]
    """The words that may come next, in order, and where each leads."""


_KEPT = 2**18
"""How many results are remembered: those of some dozens of new words."""

NOTHING = Place(False, ())
"""Where nothing can be said, not even nothing."""

_register: WeakValueDictionary[object, Place] = WeakValueDictionary()
_register[False, ()] = NOTHING


def _place(ends: bool, after: Mapping[str, Place]) -> Place:
    """The one place with this after it."""
    arcs = tuple((word, after[word]) for word in sorted(after))
    arcs = tuple(arc for arc in arcs if arc[1] is not NOTHING)
    key = (ends, tuple((word, id(it)) for word, it in arcs))
    found = _register.get(key)
    if found is None:
        found = _register[key] = Place(ends, arcs)
    return found


END = _place(True, {})
"""Where the sentence is over."""


def said(words: Sequence[str]) -> Place:
    """Just these words, one after the other.

    >>> said(["a", "cup"]) is said(["a", "cup"])
    True
    """
    return reduce(lambda rest, word: _place(False, {word: rest}), reversed(words), END)


def either(ways: Iterable[Place]) -> Place:
    """What can be said in one of these ways.

    >>> list(sentences(either([said(["a", "cup"]), said(["a", "mug"])])))
    ['a cup', 'a mug']
    """
    left = list(ways) or [NOTHING]
    while len(left) > 1:
        pairs = zip_longest(left[::2], left[1::2], fillvalue=NOTHING)
        left = [_either_of_two(one, other) for one, other in pairs]
    return left[0]


@lru_cache(_KEPT)
def _either_of_two(one: Place, other: Place) -> Place:
    if one is other or other is NOTHING:
        return one
    if one is NOTHING:
        return other
    after = dict(one.after)
    for word, it in other.after:
        after[word] = _either_of_two(after[word], it) if word in after else it
    return _place(one.ends or other.ends, after)


def following(parts: Iterable[Place]) -> Place:
    """What can be said part by part.

    >>> a_cup_or_none = either([said(["a", "cup"]), END])
    >>> list(sentences(following([said(["yes"]), a_cup_or_none])))
    ['yes', 'yes a cup']
    """
    return reduce(lambda rest, part: _then(part, rest), reversed(list(parts)), END)


@lru_cache(_KEPT)
def _then(first: Place, second: Place) -> Place:
    after = {word: _then(it, second) for word, it in first.after}
    rest = _place(False, after)
    return _either_of_two(rest, second) if first.ends else rest


def filled(place: Place, slots: Mapping[str, Place]) -> Place:
    """The network with other networks in place of some of its words.

    >>> naming = said(["a", "NOUN"])
    >>> nouns = either([said(["cup"]), said(["teddy", "bear"])])
    >>> list(sentences(filled(naming, {"NOUN": nouns})))
    ['a cup', 'a teddy bear']
    """
    known: dict[Place, Place] = {}

    def at(here: Place) -> Place:
        if here not in known:
            plain = {word: at(it) for word, it in here.after if word not in slots}
            ways = [_then(slots[w], at(it)) for w, it in here.after if w in slots]
            known[here] = either([_place(here.ends, plain), *ways])
        return known[here]

    return at(place)


def only(place: Place, may_follow: Callable[[str, str], bool]) -> Place:
    """What can be said of it where a word may follow the one before.

    Before the first word stands "", and after the last.

    >>> a_cup = either([said(["a", "cup"]), said(["an", "cup"])])
    >>> list(sentences(only(a_cup, lambda before, word: before != "an")))
    ['a cup']
    """
    known: dict[tuple[Place, str], Place] = {}

    def at(here: Place, before: str) -> Place:
        if (here, before) not in known:
            known[here, before] = _place(
                here.ends and may_follow(before, ""),
                {
                    word: at(it, word)
                    for word, it in here.after
                    if may_follow(before, word)
                },
            )
        return known[here, before]

    return at(place, "")


def fused(place: Place, words: Mapping[tuple[str, str], str]) -> Place:
    """The network with one word in place of two neighbours: "is", "n't" is "isn't".

    >>> it_is_not = said(["it", "is", "n't"])
    >>> list(sentences(fused(it_is_not, {("is", "n't"): "isn't"})))
    ["it isn't"]
    """
    known: dict[Place, Place] = {}

    def at(here: Place) -> Place:
        if here not in known:
            ways = [_place(here.ends, {})]
            for word, it in here.after:
                one = {w: at(end) for w, end in _fusing(word, it, words)}
                rest = at(_place(it.ends, _unfused(word, it, words)))
                ways.append(_place(False, {**one, word: rest}))
            known[here] = either(ways)
        return known[here]

    return at(place)


def _fusing(
    word: str, place: Place, words: Mapping[tuple[str, str], str]
) -> Iterator[tuple[str, Place]]:
    """The words that a word is fused to with what comes next."""
    for second, end in place.after:
        if (word, second) in words:
            yield words[word, second], end


def _unfused(
    word: str, place: Place, words: Mapping[tuple[str, str], str]
) -> dict[str, Place]:
    """What may come next and stays apart."""
    return {w: it for w, it in place.after if (word, w) not in words}


def allows(place: Place, words: Iterable[str]) -> bool:
    """Whether just these words can be said.

    >>> allows(said(["a", "cup"]), ["a"])
    False
    """
    here = place
    for word in words:
        here = dict(here.after).get(word, NOTHING)
    return here.ends


def places(place: Place) -> list[Place]:
    """All places that can be reached, this one first."""
    found, ahead = {place: None}, [place]
    while ahead:
        for _, it in ahead.pop().after:
            if it not in found:
                found[it] = None
                ahead.append(it)
    return list(found)


def sentences(place: Place) -> Iterator[str]:
    """All that can be said, in alphabetical order of the words."""
    if place.ends:
        yield ""
    for word, it in place.after:
        for rest in sentences(it):
            yield f"{word} {rest}".rstrip()
