"""Random variables: mutually exclusive types, of which exactly one is the case.

For a variable V over A₁, …, Aₙ, p_V(a : Aᵢ) = p(a : Aᵢ) / Σⱼ p(a : Aⱼ). With intervals,
that is lowest where p(a : Aᵢ) is lowest and all others are highest. The type of V is
the join of its values. Source: Cooper, Dobnik, Lappin and Larsson 2015.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ttr.errors import IllFormedError, RefusedError
from ttr.judging.judgements import Judgement, Why
from ttr.judging.models import Conditions, Model, as_model, conditions
from ttr.probability import REFUTED, Degree
from ttr.probability.degrees import format_probability, share
from ttr.types.interning import identity
from ttr.types.objects import Object, freeze
from ttr.types.printing import notation
from ttr.types.syntax import Join, Meet, Negation, TypeNode, as_type, join, kind_of

__all__ = ["RandomVariable"]

_Values = frozenset[TypeNode]


@dataclass(frozen=True, init=False)
class RandomVariable:
    """A name, and types of which an object is taken to be of exactly one.

    That they exclude one another is assumed by the variable, not a fact of the model.

    >>> from ttr import Basic
    >>> A, B = Basic("A"), Basic("B")
    >>> V = RandomVariable("V", A, B)
    >>> M = Model().given("a", A, (0.2, 0.4)).given("a", B, (0.1, 0.3))
    >>> print(V.judge(M, "a", A).why)
    p = [0.4, 0.8] a : A   (as a value of V; 0.2 / (0.2 + 0.3), 0.4 / (0.4 + 0.1))
      p = [0.2, 0.4] a : A   (given)
      p = [0.1, 0.3] a : B   (given)
    """

    name: str
    values: tuple[TypeNode, ...]

    def __init__(self, name: str, /, *values: TypeNode) -> None:
        if not isinstance(name, str):
            raise IllFormedError(f"a random variable has a name, found {kind_of(name)}")
        kinds = tuple(dict.fromkeys(map(as_type, values)))
        if len(kinds) < 2:
            raise IllFormedError(f"{name} needs two values or more that differ")
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "values", kinds)

    @property
    def type(self) -> TypeNode:
        """The type of the variable, A₁ ∨ … ∨ Aₙ.

        >>> from ttr import Basic
        >>> A, B = Basic("A"), Basic("B")
        >>> A <= RandomVariable("V", A, B).type
        True
        """
        return join(*self.values)

    def judge(
        self, M: Model, sit: object, T: TypeNode, /, *, when: Conditions = ()
    ) -> Judgement:
        """p_V(sit : T), or p_V(sit : T | b : S, …), where T is made of values.

        T is a value, or a meet, join or negation of such types.

        A condition on the same object with such a type limits the values, too. Raises
        `IllFormedError` for other types, and `RefusedError` where no value is possible.

        >>> from ttr import Basic
        >>> A, B, C = Basic("A"), Basic("B"), Basic("C")
        >>> V = RandomVariable("V", A, B, C)
        >>> M = Model().given("a", A, 0.3).given("a", B, 0.3).given("a", C, 0.4)
        >>> print(V.judge(M, "a", A & B).p, V.judge(M, "a", A, when=[("a", B | A)]).p)
        0 0.5
        """
        M, sit, T = as_model(M), freeze(sit), as_type(T)
        mine, others = self._split_conditions(sit, conditions(when))
        whys = self._weights(M, sit, others)
        wanted = self._covered_values(T)
        p, said = _share_in_words(whys, wanted & mine, mine - wanted)
        if p is None:
            raise RefusedError(
                f"{notation(sit)} is of no value of {self.name} that is possible here",
                hint=f"the values are {', '.join(map(str, self.values))}",
            )
        grounds = tuple([whys[value] for value in self.values if value in mine])
        rule = f"as a value of {self.name}; {said}"
        return Judgement(sit, T, p, Why(sit, T, p, rule, grounds), M)

    def distribution(
        self, M: Model, sit: object, /, *, when: Conditions = ()
    ) -> dict[TypeNode, Degree]:
        """The probability of each value; they add up to 1 where they are numbers.

        >>> from ttr import Basic
        >>> A, B = Basic("A"), Basic("B")
        >>> M = Model().given("a", A, 0.2).given("a", B, 0.6)
        >>> for value, p in RandomVariable("V", A, B).distribution(M, "a").items():
        ...     print(value, p)
        A 0.25
        B 0.75
        """
        given = conditions(when)
        return {value: self.judge(M, sit, value, when=given).p for value in self.values}

    def _split_conditions(
        self, sit: Object, when: list[tuple[Object, TypeNode]]
    ) -> tuple[_Values, list[tuple[Object, TypeNode]]]:
        """The values that conditions on the object leave, and the other conditions."""
        mine, others = frozenset(self.values), []
        for one, S in when:
            if identity(freeze(one)) == identity(sit) and self._is_of_values(S):
                mine &= self._covered_values(S)
            else:
                others.append((one, S))
        return mine, others

    def _weights(
        self, M: Model, sit: Object, when: list[tuple[Object, TypeNode]]
    ) -> Mapping[TypeNode, Why]:
        return {value: M.judge(sit, value, when=when).why for value in self.values}

    def _is_of_values(self, T: TypeNode) -> bool:
        try:
            self._covered_values(T)
        except IllFormedError:
            return False
        return True

    def _covered_values(self, T: TypeNode) -> _Values:
        """The values that a Boolean combination T of values covers."""
        if T in self.values:
            return frozenset((T,))
        match T:
            case Meet(parts):
                return frozenset(self.values).intersection(
                    *map(self._covered_values, parts)
                )
            case Join(parts):
                return frozenset[TypeNode]().union(*map(self._covered_values, parts))
            case Negation(body):
                return frozenset(self.values) - self._covered_values(body)
        raise IllFormedError(
            f"{T} is no value of {self.name}, nor made of its values",
            hint=f"the values are {', '.join(map(str, self.values))}",
        )


def _share_in_words(
    whys: Mapping[TypeNode, Why], wanted: _Values, others: _Values
) -> tuple[Degree | None, str]:
    """The share of the values wanted among these and the others, and its arithmetic.

    None where all of them have probability 0.
    """
    mine, rest = _sums(whys, wanted), _sums(whys, others)
    p = share(mine, rest)
    if p is None:
        return None, ""
    if mine.hi == 0.0 or rest.hi == 0.0:
        return p, f"{'no' if p == REFUTED else 'every'} value that is possible"
    ends = dict.fromkeys(((mine.lo, rest.hi), (mine.hi, rest.lo)))
    said = ", ".join(
        f"{format_probability(x)} / ({format_probability(x)} + {format_probability(y)})"
        for x, y in ends
    )
    return p, said


def _sums(whys: Mapping[TypeNode, Why], values: Iterable[TypeNode]) -> Degree:
    known = [whys[value].p for value in whys if value in set(values)]
    return Degree(sum(p.lo for p in known), sum(p.hi for p in known))
