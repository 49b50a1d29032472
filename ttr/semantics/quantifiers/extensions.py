"""Extensions: the things that have a property in a model, found once, counted often."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ttr.errors import IllFormedError, RefusedError, TTRError
from ttr.judging.models import Model, as_model
from ttr.probability import CERTAIN, REFUTED, Degree, degree
from ttr.safety.budgets import within_budget
from ttr.semantics.quantifiers.degrees_of_truth import Atoms, Truth
from ttr.semantics.quantifiers.determiners import Property, as_property
from ttr.semantics.quantifiers.thresholds import Thresholds, thresholds_of
from ttr.semantics.quantifiers.truth import (
    known_objects,
    truth_of_instance,
    truth_of_judgement,
)
from ttr.types.interning import identity
from ttr.types.objects import Object, freeze
from ttr.types.printing import notation
from ttr.types.syntax import Basic, Function, TypeNode, kind_of


@dataclass(frozen=True)
class Member:
    """A thing that has, or may have, a property; and what makes it have it.

    `atoms` are the uncertain judgements that this rests on.
    """

    sit: Object
    p: Degree = CERTAIN
    atoms: Atoms = frozenset()
    found: Truth | None = None

    @property
    def situation(self) -> Object:
        """The situation of the type that the property gives for the thing."""
        return self.sit if self.found is None else self.found.witness


@dataclass(frozen=True, eq=False)
class Extension:
    """The things that have, or may have, a property: an immutable value, in order.

    It is made by `extension` of a model, or by `Extension.of` of things.

    >>> dogs = Extension.of(["fido", ("rex", 0.5)], "dog")
    >>> print(dogs)
    dog: fido, rex (0.5)
    """

    members: Mapping[object, Member]
    property: Property

    @classmethod
    def of(cls, things: Iterable[object], name: str = "P", /) -> Extension:
        """The extension of these things, or of pairs of a thing and a degree.

        Raises `TTRError` for a degree that is none, or a thing that is there twice.
        """
        if not isinstance(things, Iterable):
            raise TTRError(
                f"an extension is of several things, found {kind_of(things)}"
            )
        members: dict[object, Member] = {}
        for entry in things:
            value, certainty = _entry(entry)
            sit = freeze(value)
            key = identity(sit)
            if key in members:
                raise TTRError(f"{notation(sit)} is twice in the extension of {name}")
            if certainty != REFUTED:
                members[key] = Member(sit, certainty)
        return cls(members, Basic(name))

    def __len__(self) -> int:
        return len(self.members)

    def __str__(self) -> str:
        shown = [
            notation(one.sit) + (f" ({one.p})" if one.p != CERTAIN else "")
            for one in self.members.values()
        ]
        return f"{self.property}: {', '.join(shown) or 'nothing'}"


def _entry(entry: object) -> tuple[object, Degree]:
    """A thing and its degree, which may be left out."""
    match entry:
        case (thing, int() | float() | tuple() as p):
            return thing, degree(p)
    return entry, CERTAIN


@within_budget
def extension(
    M: Model, P: object, thresholds: Thresholds | None = None, /
) -> Extension:
    """What has the property P in a model, certainly or perhaps, in the order told.

    P is a predicate of one thing, a function to types, or a type; what is asked are the
    known objects of its domain. Raises `UnsupportedError` where these cannot be listed.

    >>> from ttr import Ind, Pred
    >>> dog = Pred("dog", Ind)
    >>> M = Model().given("fido", Ind).given("sam", Ind).given("s1", dog("fido"))
    >>> print(extension(M, dog))
    \\x:Ind. dog(x): fido
    """
    as_model(M)
    P = as_property(P)
    chosen = thresholds_of(thresholds)
    domain = P.domain if isinstance(P, Function) else P
    if not isinstance(domain, TypeNode):
        raise IllFormedError(f"{notation(domain)} is no domain of a property")
    members = {}
    for sit, p in known_objects(M, domain, chosen):
        if not isinstance(P, Function):
            atoms = truth_of_judgement(M, sit, P).atoms if p != CERTAIN else frozenset()
            members[identity(sit)] = Member(sit, p, atoms)
            continue
        one = member(M, P, sit, chosen)
        if p != CERTAIN:
            one = _restrict_to_domain(one, truth_of_judgement(M, sit, domain))
        if one.p != REFUTED:
            members[identity(sit)] = one
    return Extension(members, P)


def member(M: Model, P: Property, sit: Object, thresholds: Thresholds) -> Member:
    """How certainly a thing has a property."""
    if isinstance(P, Function):
        found = truth_of_instance(M, P, sit, thresholds)
        return Member(sit, found.p, found.atoms, found)
    found = truth_of_judgement(M, sit, P)
    return Member(sit, found.p, found.atoms)


def _restrict_to_domain(one: Member, domain: Truth) -> Member:
    """The member, if it is in the domain of the property at all."""
    p = Degree(one.p.lo * domain.p.lo, one.p.hi * domain.p.hi)
    return Member(one.sit, p, one.atoms | domain.atoms, one.found)


def in_domain(M: Model, Q: Property, sit: Object) -> None:
    """Raise `RefusedError` where a function does not take a thing at all."""
    if not isinstance(Q, Function):
        return
    inside = M.judge(sit, Q.domain).p
    if inside == REFUTED:
        raise RefusedError(
            f"{Q} takes objects of {Q.domain}, which {notation(sit)} is not",
            hint="let both properties be of individuals, or both of records",
        )
