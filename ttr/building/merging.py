"""Merge and asymmetric merge: putting two types together, label by label."""

from __future__ import annotations

from functools import reduce

from ttr.building.constructors import rectype
from ttr.computing.subtyping import subtype
from ttr.errors import TTRError
from ttr.safety.budgets import spend, within_budget
from ttr.signature.signature import Signature, signature_of
from ttr.types.interning import identity
from ttr.types.objects import Record, sort_canonically
from ttr.types.paths import subterms
from ttr.types.syntax import Meet, RecordType, Singleton, TypeNode, as_type, meet


@within_budget
def merge(S: TypeNode, T: TypeNode, /, theory: Signature | None = None) -> TypeNode:
    """The merge S ∧̣ T: what is of it is of S and of T, in the simplest form.

    If one is below the other it is that one. Record types are merged label by label,
    dependent fields keeping their paths; any other two types give their meet. Raises
    `IllFormedError` for what is no type.
    Law: r : merge(S, T) iff r : S and r : T. Source: Cooper 2023.

    >>> from ttr import Ind, Pred, this
    >>> run, man = Pred("run", Ind), Pred("man", Ind)
    >>> print(merge(rectype(x=Ind), rectype(y=Ind)))
    [x : Ind, y : Ind]
    >>> print(merge(rectype(x=Ind, e=run(this.x)), rectype(x=Ind @ "j")))
    [x = j : Ind, e : run(x)]
    """
    spend()
    S, T, theory = as_type(S), as_type(T), signature_of(theory)
    if S is T:
        return S
    match S, T:
        case RecordType(), RecordType() if _is_compatible(S, T):
            return _merge_compatible(S, T, theory)
    simplest = [one for one, other in ((S, T), (T, S)) if _is_below(one, other, theory)]
    if simplest:
        return min(sort_canonically(simplest), key=_count_terms)
    match S, T:
        case RecordType(), RecordType():
            return _merge_records(S, T, theory)
        case Singleton(base, a), Singleton(other, b) if identity(a) == identity(b):
            return Singleton(merge(base, other, theory), a)
        case Singleton(base, a), _ if not isinstance(T, Singleton):
            return Singleton(merge(base, T, theory), a)
        case _, Singleton(base, a) if not isinstance(S, Singleton):
            return Singleton(merge(S, base, theory), a)
    return meet(S, T)


def _is_compatible(S: RecordType, T: RecordType) -> bool:
    """Do the record types have the same field at each label that both have?"""
    return all(S[label] is field for label, field in T.fields if label in S)


def _merge_compatible(
    S: RecordType, T: RecordType, theory: Signature | None
) -> RecordType:
    """The merge of record types that have the same fields at the labels they share."""
    if all(label in S for label in T):
        return S
    if all(label in T for label in S):
        return T
    return rectype({**dict(S.fields), **dict(T.fields)}, theory)


def _count_terms(T: TypeNode) -> int:
    """How many different types and objects T is made of."""
    return sum(1 for _ in subterms([T]))


def _is_below(S: TypeNode, T: TypeNode, theory: Signature | None) -> bool:
    """Is S below T, with all labels of T even if nothing can be of S?"""
    match S, T:
        case RecordType(), RecordType() if any(label not in S for label in T):
            return False
    return subtype(S, T, theory).yes


def _merge_records(
    S: RecordType, T: RecordType, theory: Signature | None
) -> RecordType:
    fields = dict(S.fields)
    for label, field in T.fields:
        mine = fields.get(label)
        fields[label] = field if mine is None else merge(mine, field, theory)
    return rectype(fields, theory)


@within_budget
def amerge(S: TypeNode, T: TypeNode, /, theory: Signature | None = None) -> TypeNode:
    """The asymmetric merge: T wins wherever S and T are not both record types.

    Raises `IllFormedError` where a path of S would lead nowhere in the result.
    Source: Cooper 2023, where it models non-monotonic update.

    >>> from ttr import Basic, Ind
    >>> print(amerge(rectype(x=Ind @ "j", y=Ind), rectype(x=Ind)))
    [x : Ind, y : Ind]
    """
    spend()
    S, T, theory = as_type(S), as_type(T), signature_of(theory)
    if not isinstance(S, RecordType) or not isinstance(T, RecordType):
        return T
    fields = dict(S.fields)
    for label, field in T.fields:
        mine = fields.get(label)
        fields[label] = field if mine is None else amerge(mine, field, theory)
    return rectype(fields, theory)


def merge_meet(T: TypeNode) -> TypeNode:
    """A meet of record types as the one record type that is their merge.

    Any other type is given back as it is.

    >>> from ttr import Basic, Ind
    >>> print(merge_meet(rectype(x=Ind) & rectype(y=Ind)))
    [x : Ind, y : Ind]
    >>> print(merge_meet(Basic("A") & Basic("B")))
    A /\\ B
    """
    if isinstance(T, Meet) and all(isinstance(part, RecordType) for part in T.parts):
        return reduce(merge, T.parts)
    return T


def singleton_type(
    state: Record, T: RecordType, /, theory: Signature | None = None
) -> RecordType:
    """T with every field set to what the record has there: the type of just it.

    Raises `TTRError` where the record lacks a field of T.

    >>> from ttr import Ind, record
    >>> print(singleton_type(record(x="j"), rectype(x=Ind)))
    [x = j : Ind]
    """
    fields: dict[str, TypeNode] = {}
    for label, field in T.fields:
        if label not in state:
            raise TTRError(f"{state} has no {label}, so it is not of {T}")
        value = state[label]
        if isinstance(field, RecordType) and isinstance(value, Record):
            fields[label] = singleton_type(value, field, theory)
            continue
        base = field.base if isinstance(field, Singleton) else field
        fields[label] = Singleton(base, value)
    return rectype(fields, theory)
