"""Which known name may be meant by one that is misspelt."""

from __future__ import annotations

from collections.abc import Iterable

_LETTERS_PER_SLIP = 4
"""For so many letters of a name one slip is taken for a misspelling; one for fewer."""

_SHORT = 3
"""The most letters of a name in which only vowels are mistaken for one another."""

_LONGEST = 100
"""The most letters of a name that is looked at."""


def nearest_names(name: str, known: Iterable[str], most: int = 1) -> list[str]:
    """The known names that a name may be a misspelling of, the most similar first.

    A slip is a letter too many, one too few, another one, or two changed about; large
    letters are like small ones. A name has at most one for each four letters, or one if
    it is shorter, and its first letter is right or changed about. In a name of three
    letters only a vowel is another one: "cap" may be "cup", but "cat" is not "car". A
    name may also be the beginning of what was meant.

    >>> nearest_names("hgu", ["dog", "hug"]), nearest_names("pupy", ["puppy"])
    (['hug'], ['puppy'])
    >>> nearest_names("proto", ["default", "prototype"])
    ['prototype']
    >>> nearest_names("somebody", ["comed"]), nearest_names("cat", ["car"])
    ([], [])
    """
    small = name.casefold()
    found: list[tuple[int, bool, int, str]] = []
    for one in set(known):
        slips = _slips(small, one.casefold())
        if slips is not None:
            goes_on = one.casefold().startswith(small)
            found.append((slips, not goes_on, _edit_distance(name, one), one))
    return [one for *_, one in sorted(found)[:most]]


def _slips(name: str, known: str) -> int | None:
    """How many slips lead from one name to the other; None if these are too many."""
    longest = max(len(name), len(known))
    if longest > _LONGEST:
        return None
    most = max(1, longest // _LETTERS_PER_SLIP)
    if len(name) > _SHORT and known.startswith(name):
        return min(most, len(known) - len(name))
    if abs(len(name) - len(known)) > most:
        return None
    if name[:1] != known[:1] and name[1::-1] != known[:2]:
        return None
    if len(name) == len(known) <= _SHORT and _consonants(name) != _consonants(known):
        return None
    slips = _edit_distance(name, known)
    return slips if slips <= most else None


def _consonants(name: str) -> list[str]:
    """The letters that a short name cannot have mistaken, in alphabetical order."""
    return sorted(letter for letter in name if letter not in "aeiouy")


def _edit_distance(one: str, other: str) -> int:
    """The fewest slips that lead from one text to another, each letter moved once.

    Source: Damerau 1964; the distance of optimal string alignment.

    >>> _edit_distance("kichten", "kitchen"), _edit_distance("hgu", "hug")
    (2, 1)
    """
    before: list[int] = []
    row = list(range(len(other) + 1))
    for i, a in enumerate(one, 1):
        above, row = row, [i]
        for j, b in enumerate(other, 1):
            best = min(above[j] + 1, row[j - 1] + 1, above[j - 1] + (a != b))
            if i > 1 < j and a == other[j - 2] and b == one[i - 2]:
                best = min(best, before[j - 2] + 1)
            row.append(best)
        before = above
    return row[-1]
