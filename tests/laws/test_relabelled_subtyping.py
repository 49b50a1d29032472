"""Laws of subtyping up to relabelling: the relabelling is one, and none is missed."""

from itertools import permutations, product

from generators import chains, record_types, related, types
from hypothesis import given
from hypothesis import strategies as st

from ttr import RecordType, relabel, subtype
from ttr.building.relabelled_subtyping import subtype_up_to_relabelling
from ttr.computing import normal_form
from ttr.errors import IllFormedError

LABELS = ["x", "y", "z", "n", "c", "d", "l", "other"]


def relabellings(T, labels):
    """Every relabelling of T and of the record types inside it by some labels."""
    inner = [[{}]]
    for label, field in T.fields:
        if isinstance(field, RecordType):
            found = relabellings(field, labels)
            inner.append([{f"{label}.{k}": v for k, v in one.items()} for one in found])
    for new in permutations(labels, len(T.labels)):
        for parts in product(*inner):
            yield dict(
                zip(T.labels, new, strict=True),
                **{k: v for p in parts for k, v in p.items()},
            )


def below_by(S, T, names):
    """Is S below T with these names? None if they cannot be given."""
    try:
        return subtype(S, relabel(T, names))
    except IllFormedError:
        return None


@given(related(), st.permutations(LABELS))
def test_the_answer_has_a_relabelling_by_which_it_is_so(pair, labels):
    S, T = pair
    T = relabel(T, dict(zip(T.labels, labels, strict=False)))
    answer = subtype_up_to_relabelling(S, T)
    assert (answer.relabelling is not None) == answer.yes
    if answer.yes:
        renamed = relabel(normal_form(T), answer.relabelling)
        assert subtype(S, renamed).yes
        assert relabel(renamed, {}) is renamed


@given(record_types(), st.permutations(LABELS))
def test_a_type_is_below_itself_with_other_labels(T, labels):
    names = dict(zip(T.labels, labels, strict=False))
    answer = subtype_up_to_relabelling(T, relabel(T, names))
    assert answer.yes
    back = subtype_up_to_relabelling(relabel(T, names), T)
    assert back.yes


@given(chains())
def test_a_subtype_is_one_as_it_is(chain):
    S, T, _ = chain
    if subtype(S, T).yes:
        answer = subtype_up_to_relabelling(S, T)
        assert answer.yes
        assert answer.relabelling == {}


@given(types(), types())
def test_it_is_never_refuted_where_it_is_a_subtype(S, T):
    answer = subtype_up_to_relabelling(S, T)
    if answer.no:
        assert not subtype(S, T).yes


small = record_types().filter(lambda T: len(T.labels) <= 3)


@given(small, small)
def test_no_relabelling_is_missed(S, T):
    inside = normal_form(T)
    known = sorted(
        {
            k
            for R in (S, *(F for _, F in S.fields))
            if isinstance(R, RecordType)
            for k in R
        }
    )
    answer = subtype_up_to_relabelling(S, T)
    names = relabellings(inside, known) if isinstance(inside, RecordType) else [{}]
    tried = [found for one in names if (found := below_by(S, inside, one)) is not None]
    assert answer.yes == (subtype(S, T).yes or any(it.yes for it in tried))
    if answer.no:
        assert all(it.no for it in tried)
