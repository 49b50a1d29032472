"""Playing a dialogue again, and whether it goes as it went."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import zip_longest
from typing import Any, NamedTuple

from kille.lab.dialogues import Played
from kille.lab.log.outcomes import Broken, Finished, Outcome, Play
from kille.lab.running_studies.crews import Crew, play_runs
from kille.lab.study import Study


class Difference(NamedTuple):
    """The first difference between two dialogues: where, and both values.

    >>> Difference("turn 3", "This is a cup.", "This is a mug.").now
    'This is a mug.'
    """

    where: str
    before: str
    now: str


def replay(
    study: Study,
    befores: Iterable[Outcome],
    play: Play | None = None,
    by: Crew | None = None,
) -> Iterator[tuple[Outcome, Difference | None]]:
    """Play these dialogues again; yield each with its first difference, or None.

    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> from kille.lab.dialogues import Played
    >>> def play(study, run):
    ...     return Played((), (), lessons=run.seed)
    >>> from kille.lab.log import Finished
    >>> cups = parse(text, Path("cups.toml"))
    >>> [run] = cups.runs()
    >>> before = Finished(run, Played((), (), lessons=2), 0.5)
    >>> [(_, difference)] = replay(cups, [before], play)
    >>> difference
    Difference(where='at the end, lessons', before='2', now='1')
    """
    known = {it.run: it for it in befores}
    with play_runs(study, tuple(known), play, by) as outcomes:
        for now in outcomes:
            before = known[now.run]
            yield before, difference(before, now)


def difference(before: Outcome, now: Outcome) -> Difference | None:
    """The first difference of two dialogues: in a turn, an answer, or a count.

    How long they took does not matter, nor where in the program they broke.
    """
    match before, now:
        case Finished(), Finished():
            return _difference(before.played, now.played)
        case Broken(), Broken() if before.reason == now.reason:
            return None
    return Difference("at the end", _format_outcome(before), _format_outcome(now))


def _format_outcome(it: Outcome) -> str:
    return f"broken: {it.reason}" if isinstance(it, Broken) else "played to its end"


def _difference(before: Played, now: Played) -> Difference | None:
    return (
        _first("turn", before.turns, now.turns)
        or _first("answer", before.answers, now.answers)
        or _first_part("at the end", _counts(before), _counts(now))
    )


def _first(what: str, before: Sequence[Any], now: Sequence[Any]) -> Difference | None:
    """The first difference between two lists of rows."""
    for number, (one, other) in enumerate(zip_longest(before, now), start=1):
        where = f"{what} {number}"
        if one is None or other is None:
            return Difference(where, _or_nothing(one), _or_nothing(other))
        if found := _first_part(where, one._asdict(), other._asdict()):
            return found
    return None


def _first_part(
    where: str, before: Mapping[str, Any], now: Mapping[str, Any]
) -> Difference | None:
    for name in dict.fromkeys((*before, *now)):
        one, other = before.get(name), now.get(name)
        if not _is_same(one, other):
            told = name.replace("_", " ")
            return Difference(f"{where}, {told}", str(one), str(other))
    return None


def _is_same(one: Any, other: Any) -> bool:
    """Whether two values are equal; NaN equals NaN."""
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return [*one] == [*other] and all(_is_same(one[key], other[key]) for key in one)
    return bool(one == other)


def _counts(it: Played) -> dict[str, float]:
    return {"lessons": it.lessons, **it.facts}


def _or_nothing(row: object) -> str:
    return "nothing" if row is None else str(row)
