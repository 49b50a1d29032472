"""How certain it is that a type is true: that something is of it.

Unlike `Model.true` it evaluates quantified types, sentence negation and function types
as "whatever is of S", takes the situations that are known to be of a type for all that
there are, and gives Fréchet's bounds where parts rest on the same judgements.
"""

from __future__ import annotations

from collections.abc import Iterator

from ttr.errors import IllFormedError, RefusedError, UnsupportedError
from ttr.hooks import hook
from ttr.judging.judgements import Why
from ttr.judging.models import Model, as_model
from ttr.judging.witnesses import can_be_listed, candidates, some_candidates
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.probability.degrees import degree_of_negation
from ttr.safety.budgets import spend, within_budget
from ttr.semantics.quantifiers.degrees_of_truth import (
    SHOWN,
    Truth,
    all_true,
    conjoin_fields,
    one_true,
    own_atoms,
    truth_of_derivation,
)
from ttr.semantics.quantifiers.determiners import determiner_of
from ttr.semantics.quantifiers.thresholds import Thresholds, thresholds_of
from ttr.types.objects import BOUND, Missing, Object, Record, UnresolvedError
from ttr.types.paths import free_paths, mentions, subterms
from ttr.types.printing import notation
from ttr.types.substitution import instantiate_body, resolve_paths
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Join,
    Pred,
    PType,
    RecordType,
    Type,
    TypeNode,
    as_type,
)

absent = Pred("absent", Type)
"""Sentence negation: `absent(T)` is true if nothing is of T.

It is not `~T`, which whatever is not of T is of.

>>> from ttr import Basic, Model
>>> from ttr.semantics.quantifiers import absent, truth
>>> print(truth(Model(), absent(Basic("Rain"))).p)
1
"""


@hook
def truth_of_quantified(M: Model, T: PType, thresholds: Thresholds) -> Truth:
    """How certain a quantified type is; `quantified_propositions` provides it."""
    raise NotImplementedError


@within_budget
def truth(M: Model, T: TypeNode, thresholds: Thresholds | None = None) -> Truth:
    """How certain it is that something is of T, by the facts of M.

    For a ptype this is the probability that one of the known situations is of it, or
    what its witness function says if it has one; where none is known and the type is
    open, it is unknown. Raises `IllFormedError` for a type with a path that leads out
    of it.

    >>> from ttr import Ind
    >>> from ttr.semantics.quantifiers import no
    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> M = Model().given("fido", Ind).given("s1", dog("fido"))
    >>> print(truth(M, absent(bark("fido"))).why)
    ✓ {} : absent(bark(fido))   (nothing is of it)
      ✗ nothing : bark(fido)   (nothing says so)
    """
    as_model(M)
    T = as_type(T)
    if free_paths(T):
        raise IllFormedError(
            f"{T} has paths that lead nowhere, so it is not true or false"
        )
    return _Truths(M, thresholds_of(thresholds)).of(T)


class _Truths:
    def __init__(self, M: Model, thresholds: Thresholds) -> None:
        self._M, self._thresholds = M, thresholds

    def of(self, T: TypeNode) -> Truth:
        spend()
        match T:
            case PType() if determiner_of(T) is not None:
                return truth_of_quantified(self._M, T, self._thresholds)
            case PType(pred, (TypeNode() as denied,)) if pred is absent:
                return self._absent(T, denied)
            case Basic() | PType():
                return _truth_of_atom(self._M, T)
            case RecordType():
                return self._record(T)
            case Join(parts):
                return one_true(T, map(self.of, parts), "one part is true")
            case FunType(domain, result):
                return self._function_type(T, domain, result)
            case Application():
                return self._application(T)
        return self._other(T)

    def _absent(self, T: TypeNode, denied: TypeNode) -> Truth:
        found = self.of(denied)
        p = degree_of_negation(found.p)
        rules = {CERTAIN: "nothing is of it", REFUTED: "something is of it"}
        rule = rules.get(p, "as far as nothing is of it")
        why = Why(Record({}), T, p, rule, (found.why,), how="none")
        return Truth(p, why, found.atoms)

    def _record(self, T: RecordType) -> Truth:
        """A record type is true if its fields can be filled."""
        needed = {path.labels[0] for _, S in T.fields for path in free_paths(S)}
        if needed.isdisjoint(T.labels):
            parts = [(label, self.of(S)) for label, S in T.fields]
            return conjoin_fields(T, parts)
        ways = [conjoin_fields(T, way) for way in self.ways(T)]
        if not ways:
            p = UNKNOWN if _may_have_more(self._M, T) else REFUTED
            return Truth(
                p,
                Why(Missing(), T, p, "nothing known is of it"),
                own_atoms(self._M, p, T),
            )
        if len(ways) == 1 and not _may_have_more(self._M, T):
            return ways[0]
        found = one_true(T, ways, "there is one")
        if found.p != CERTAIN and _may_have_more(self._M, T):
            p = Degree(found.p.lo, 1.0)
            return Truth(p, found.why, found.atoms | own_atoms(self._M, p, T))
        return found

    def ways(self, T: RecordType) -> Iterator[list[tuple[str, Truth]]]:
        """The ways to fill the fields with known objects, without recursion."""
        paths = [path for _, S in T.fields for path in free_paths(S)]
        needed = {path.labels[0] for path in paths if path.up == 0}
        needed |= {
            label
            for label, S in T.fields
            if not isinstance(S, PType) and can_be_listed(S)
        }
        waiting: list[Iterator[list[tuple[str, Truth]]]] = [iter(([],))]
        while waiting:
            way = next(waiting[-1], None)
            if way is None:
                waiting.pop()
            elif len(way) == len(T.fields):
                yield way
            else:
                waiting.append(self._extend(T, way, needed))

    def _extend(
        self, T: RecordType, way: list[tuple[str, Truth]], needed: set[str]
    ) -> Iterator[list[tuple[str, Truth]]]:
        """The ways to fill one more field; with each object if others depend on it."""
        spend()
        label, field = T.fields[len(way)]
        try:
            S = resolve_paths(field, ({k: found.witness for k, found in way},))
        except UnresolvedError as lost:
            raise UnsupportedError(f"{T} cannot be followed: {lost.message}") from None
        if label not in needed:
            found = self.of(S)
            yield from [[*way, (label, found)]] if found.p != REFUTED else []
            return
        for sit, p in known_objects(self._M, S, self._thresholds):
            found = truth_of_derivation(self._M, Why(sit, S, p, "given"))
            yield [*way, (label, found)]

    def _function_type(self, T: FunType, domain: TypeNode, result: TypeNode) -> Truth:
        """((x : S) → T) is true if T is true for every x of S."""
        grounds = []
        for sit, p in known_objects(self._M, domain, self._thresholds):
            found = self.of(
                _reduce_to_type(self._M, resolve_paths(result, ({BOUND: sit},)))
            )
            if p != CERTAIN:
                found = Truth(Degree(found.p.lo, 1.0), found.why, found.atoms)
            grounds.append(found)
        p, atoms = all_true(grounds)
        if _may_have_more(self._M, domain) and p != REFUTED:
            p, atoms = Degree(0.0, p.hi), atoms | own_atoms(self._M, UNKNOWN, T)
        failing = [found.why for found in grounds if found.p != CERTAIN]
        shown = failing or [found.why for found in grounds]
        rule = f"for each of {len(grounds)} of {domain}"
        if failing:
            rule = f"not for {len(failing)} of {len(grounds)} of {domain}"
        return Truth(p, Why(Missing(), T, p, rule, tuple(shown[:SHOWN])), atoms)

    def _application(self, T: Application) -> Truth:
        return self.of(_reduce_to_type(self._M, T))

    def _other(self, T: TypeNode) -> Truth:
        """Any other type is true as the model says."""
        known = known_objects(self._M, T) if can_be_listed(T) else []
        found = next((sit for sit, p in known if p == CERTAIN), None)
        if found is not None:
            return truth_of_derivation(self._M, self._M.judge(found, T).why)
        p = self._M.true(T)
        if p not in (CERTAIN, REFUTED) and not can_be_listed(T):
            return self._of_unlisted(T)
        return Truth(
            p, Why(Missing(), T, p, "as far as is known"), own_atoms(self._M, p, T)
        )

    def _of_unlisted(self, T: TypeNode) -> Truth:
        """What there is no end of is at least as certain as what is known of it."""
        known = some_candidates(self._M.facts, T)
        grounds = [truth_of_judgement(self._M, sit, T) for sit in known]
        found = one_true(T, grounds, "one of these is of it")
        p = Degree(found.p.lo, 1.0)
        return Truth(p, found.why, found.atoms | own_atoms(self._M, p, T))


# --- what the model has been told ----------------------------------------------------


def _truth_of_atom(M: Model, T: Basic | PType) -> Truth:
    """The probability that one of the known situations is of T."""
    facts = M.facts
    seen = facts.perceive(Missing(), T) if isinstance(T, PType) else None
    if seen is not None:
        why = Why(Missing(), T, seen, "by the witness function")
        return Truth(seen, why, own_atoms(M, seen, T))
    possible = known_objects(M, T)
    sure = next((sit for sit, p in possible if p == CERTAIN), None)
    if sure is not None:
        return Truth(CERTAIN, Why(sure, T, CERTAIN, "given"))
    if possible:
        grounds = [
            truth_of_derivation(M, Why(sit, T, p, "given")) for sit, p in possible
        ]
        return one_true(T, grounds, "one of these is of it")
    if facts.leaves_open(T):
        why = Why(Missing(), T, UNKNOWN, "nothing is known of it")
        return Truth(UNKNOWN, why, own_atoms(M, UNKNOWN, T))
    return Truth(REFUTED, Why(Missing(), T, REFUTED, "nothing says so"))


def known_objects(
    M: Model, T: TypeNode, thresholds: Thresholds | None = None
) -> list[tuple[Object, Degree]]:
    """The objects that are or may be of T by the facts, in their order.

    Of a record type they are records of such objects, with one situation for each
    field that no other field mentions. Raises `UnsupportedError` for a type of which
    there may be others without end.
    """
    if isinstance(T, RecordType):
        ways = _Truths(M, thresholds_of(thresholds)).ways(T)
        records = [conjoin_fields(T, way) for way in ways]
        return [(found.witness, found.p) for found in records]
    if not isinstance(T, Basic | PType):
        return [(sit, CERTAIN) for sit in M.witnesses(T)]
    return [(sit, _degree_of(M, sit, T)) for sit in candidates(M.facts, T)]


def _degree_of(M: Model, sit: Object, T: Basic | PType) -> Degree:
    """The probability that an object is of a type, dependences included."""
    p, _ = M.facts.degree_of(sit, T)
    return p if p == CERTAIN else M.judge(sit, T).p


def _may_have_more(M: Model, T: TypeNode) -> bool:
    """May other objects be of T than the known ones, by the types in it?"""
    return any(
        M.facts.leaves_open(part)
        for part in subterms([T])
        if isinstance(part, Basic | PType)
    )


def truth_of_judgement(M: Model, sit: Object, T: TypeNode) -> Truth:
    """How certain it is that one object is of T."""
    return truth_of_derivation(M, M.judge(sit, T).why)


def truth_of_instance(
    M: Model, f: Function, sit: Object, thresholds: Thresholds
) -> Truth:
    """How certain it is that the type a function gives for an object is true."""
    body = _reduce_to_type(M, instantiate_body(f, sit))
    return _Truths(M, thresholds).of(body)


def _reduce_to_type(M: Model, value: Object) -> TypeNode:
    if mentions(value, Application):
        value = M.reduce(value)
    if isinstance(value, TypeNode):
        return value
    raise RefusedError(f"{notation(value)} is no type, so it is neither true nor false")
