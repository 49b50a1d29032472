"""Laws of denied record types: what is below what is so of all records of few things.

The evaluator here is independent of the library: a basic type is a set of things, and a
record is of [x : S, y : T] if it has these labels, with things of these types.
"""

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, join, meet, rectype, subtype
from ttr.types import Join, Meet, Negation, RecordType

ATOMS = [Basic(name) for name in "AB"]
THINGS = range(3)
SETS = [frozenset(x for x in THINGS if bits >> x & 1) for bits in range(8)]
ASSIGNMENTS = [dict(zip(ATOMS, sets, strict=True)) for sets in product(SETS, repeat=2)]
RECORDS = [{}, *({"x": a} for a in THINGS), *({"y": a} for a in THINGS)]
RECORDS += [{"x": a, "y": b} for a, b in product(THINGS, repeat=2)]

plain = st.recursive(
    st.sampled_from(ATOMS), lambda inner: inner.map(lambda T: ~T), max_leaves=2
)
fields = st.dictionaries(st.sampled_from("xy"), plain, min_size=1)
compounds = st.recursive(
    fields.map(rectype),
    lambda inner: st.one_of(
        inner.map(lambda T: ~T),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: meet(*parts)),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: join(*parts)),
    ),
    max_leaves=3,
)


def is_of(a, T, sets):
    match T:
        case Basic():
            return not isinstance(a, dict) and a in sets[T]
        case Meet(parts):
            return all(is_of(a, part, sets) for part in parts)
        case Join(parts):
            return any(is_of(a, part, sets) for part in parts)
        case Negation(body):
            return not is_of(a, body, sets)
        case RecordType(inside):
            return isinstance(a, dict) and all(
                label in a and is_of(a[label], U, sets) for label, U in inside
            )


def is_below(S, T):
    """Is each record of S one of T, whatever things are of the basic types?"""
    return all(
        is_of(r, T, sets) for sets in ASSIGNMENTS for r in RECORDS if is_of(r, S, sets)
    )


@given(compounds, compounds)
def test_what_is_below_is_so_of_all_records(S, T):
    answer = subtype(S, T)
    assert not answer.yes or is_below(S, T), str(answer)


@given(fields.map(rectype), fields.map(rectype), compounds)
def test_a_record_type_without_another_is_decided(S, U, T):
    answer = subtype(S & ~U, T)
    assert answer.yes == is_below(S & ~U, T), str(answer)
