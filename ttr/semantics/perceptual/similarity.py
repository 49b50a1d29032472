"""How similar two meanings are: how often they agree, and in what they differ."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ttr.errors import TTRError
from ttr.probability import Degree
from ttr.semantics.argument_checks import as_tuple
from ttr.semantics.perceptual.meanings import Meaning, as_meaning
from ttr.semantics.perceptual.speakers import Speaker, as_speaker
from ttr.showing import NotebookValue, Part, Text, below, table
from ttr.types.objects import Record
from ttr.types.records import differences


@dataclass(frozen=True)
class Agreement(NotebookValue):
    """How two meanings judge the same situations.

    `both`, `first`, `second` and `neither` count the situations by who would say the
    word; `apart` is the mean distance of their degrees, where an interval counts as its
    midpoint.

    >>> found = Agreement(both=4, first=1, second=1, neither=4, apart=0.1)
    >>> found.share, round(found.kappa, 2)
    (0.8, 0.6)
    """

    both: int
    first: int
    second: int
    neither: int
    apart: float

    @property
    def count(self) -> int:
        """The number of situations."""
        return self.both + self.first + self.second + self.neither

    @property
    def share(self) -> float:
        """The share of situations in which they agree."""
        return (self.both + self.neither) / self.count

    @property
    def kappa(self) -> float | None:
        """Cohen's κ, how far they agree beyond chance: (share − chance) / (1 − chance).

        None where chance = 1: both always say the word, or both never do.
        """
        yes = (self.both + self.first) * (self.both + self.second)
        no = (self.neither + self.first) * (self.neither + self.second)
        chance = (yes + no) / self.count**2
        return None if chance == 1.0 else (self.share - chance) / (1.0 - chance)

    def _shown_as_(self) -> Part:
        counts = (
            ("both say it", self.both),
            ("the first alone", self.first),
            ("the second alone", self.second),
            ("neither", self.neither),
        )
        return below(
            Text(str(self), "strong"),
            table(
                ("", "situations"), counts, lambda it: (Text(it[0]), Text(str(it[1])))
            ),
        )

    def __str__(self) -> str:
        kappa = "undefined" if self.kappa is None else f"{self.kappa:.2f}"
        return f"{self.share:.0%} alike, κ {kappa}, {self.apart:.2f} apart"


def agreement(one: Meaning, other: Meaning, situations: Iterable[Record]) -> Agreement:
    """How alike two meanings judge some situations; `TTRError` where there are none.

    >>> from ttr import Ind, Pred, fun, outer, record, rectype
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, meaning
    >>> interp = fun(r=rectype(x=Ind, pos=RealVector))(
    ...     rectype(c=Pred("right", Ind)(outer.r.x))
    ... )
    >>> mine = meaning(interp, Perceptron(), record(w=[1.0, 0.0], t=0.5), of="pos")
    >>> yours = mine.with_params(record(w=[1.0, 0.0], t=0.8))
    >>> scenes = [record(x="o", pos=[x, 0.0]) for x in (0.2, 0.4, 0.6, 0.9)]
    >>> agreement(mine, yours, scenes).share
    0.75
    """
    one, other = as_meaning(one), as_meaning(other)
    pairs = [
        (one.degree(r), other.degree(r)) for r in as_tuple(situations, "situations")
    ]
    if not pairs:
        raise TTRError("two meanings are compared over one situation or more, not none")
    said = [(p.lo >= 0.5, q.lo >= 0.5) for p, q in pairs]
    apart = sum(abs(_midpoint(p) - _midpoint(q)) for p, q in pairs) / len(pairs)
    return Agreement(
        both=said.count((True, True)),
        first=said.count((True, False)),
        second=said.count((False, True)),
        neither=said.count((False, False)),
        apart=apart,
    )


def _midpoint(p: Degree) -> float:
    return (p.lo + p.hi) / 2


@dataclass(frozen=True)
class Convergence(NotebookValue):
    """The agreement of two speakers before a series of exchanges and after each.

    >>> before = Agreement(both=2, first=3, second=0, neither=5, apart=0.3)
    >>> after = Agreement(both=5, first=0, second=0, neither=5, apart=0.0)
    >>> [it.share for it in Convergence((before, after)).series]
    [0.7, 1.0]
    """

    series: tuple[Agreement, ...]

    def _shown_as_(self) -> Part:
        def row(numbered: tuple[int, Agreement]) -> tuple[Part, ...]:
            number, it = numbered
            kappa = "undefined" if it.kappa is None else f"{it.kappa:.2f}"
            cells = (f"{number}", f"{it.share:.0%}", kappa, f"{it.apart:.2f}")
            return tuple(map(Text, cells))

        heads = ("after", "alike", "κ", "degrees apart")
        return table(heads, enumerate(self.series), row, count=len(self.series))

    def __str__(self) -> str:
        width = len(str(len(self.series) - 1))
        lines = [f"after {i:{width}}: {it}" for i, it in enumerate(self.series)]
        return "\n".join(lines)


def convergence(
    teacher: Speaker, pupils: Sequence[Speaker], word: str, situations: Iterable[Record]
) -> Convergence:
    """The agreement of a teacher with each of the pupils on these situations.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, blank
    >>> from ttr.semantics.perceptual import history, interpretation, meaning
    >>> T = rectype(x=Ind, pos=RealVector, c=Pred("right", Ind)(this.x))
    >>> right = meaning(interpretation(T, "c"), Perceptron(), blank(2), of="pos")
    >>> ann = Speaker("ann", {"right": right.with_params(record(w=[1, 0], t=0.5))})
    >>> scenes = [record(x="o1", pos=[x, 0.0]) for x in (0.9, 0.7, -0.8, 0.2)]
    >>> pupils = history(ann, Speaker("bo", {"right": right}), "right", scenes)
    >>> [it.share for it in convergence(ann, pupils, "right", scenes).series]
    [0.5, 0.5, 0.5, 0.75, 1.0]
    """
    probes = as_tuple(situations, "situations")
    meant = as_speaker(teacher)[word]
    learned = [as_speaker(it)[word] for it in as_tuple(pupils, "pupils")]
    return Convergence(tuple([agreement(meant, it, probes) for it in learned]))


def difference(one: Meaning, other: Meaning) -> tuple[str, ...]:
    """The differences of two meanings, path by path.

    Here and in `agreement`, meanings may be given as their records.

    >>> from ttr import Ind, Pred, fun, outer, record, rectype
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, meaning
    >>> interp = fun(r=rectype(x=Ind, pos=RealVector))(
    ...     rectype(c=Pred("right", Ind)(outer.r.x))
    ... )
    >>> mine = meaning(interp, Perceptron(), record(w=[1.0, 0.0], t=0.5), of="pos")
    >>> difference(mine, mine.with_params(record(w=[1.0, 0.0], t=0.25)))
    ('params.t: 0.5 → 0.25',)
    """
    return tuple(differences(as_meaning(one).record, as_meaning(other).record))
