"""Laws of the index of facts: it changes no witness, and no order of them."""

from __future__ import annotations

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from ttr import Ind, Model, Pred, RecordType, rectype, this
from ttr.judging import witnesses as listing
from ttr.signature.signature import Axiom, Signature
from ttr.types import Path, PType, TypeNode

p, r, s = Pred("p", Ind), Pred("r", Ind, Ind), Pred("s", Ind, Ind)
NAMES = "abcd"
names = st.sampled_from(NAMES)
facts = st.lists(
    st.one_of(
        st.builds(lambda x: p(x), names),
        st.builds(lambda q, x, y: q(x, y), st.sampled_from([r, s]), names, names),
    ),
    unique=True,
    max_size=16,
)
degrees = st.sampled_from([1.0, 1.0, 1.0, 0.0, 0.5, (0.2, 0.7)])
theories = st.sampled_from(
    [Signature(), Signature(axioms=(Axiom(r(this.x, this.y), s(this.x, this.y)),))]
)


@st.composite
def models(draw: st.DrawFn) -> Model:
    M = Model(draw(theories))
    for name in draw(st.permutations(NAMES)):
        M = M.given(name, Ind)
    for number, T in enumerate(draw(facts)):
        M = M.given(f"e{number}", T, draw(degrees))
    return M


@st.composite
def patterns(draw: st.DrawFn) -> RecordType:
    """Individuals in relations to one another, some in a record inside."""
    labels = "xyz"[: draw(st.integers(1, 3))]
    fields: dict[str, TypeNode] = dict.fromkeys(labels, Ind)

    def situation(up: int) -> PType:
        args = st.one_of(st.sampled_from([Path(up, (k,)) for k in labels]), names)
        pred = draw(st.sampled_from([p, r, s]))
        return pred(*[draw(args) for _ in pred.arities[0]])

    for number in range(draw(st.integers(1, 3))):
        fields[f"c{number}"] = situation(0)
    if draw(st.booleans()):
        both = situation(0) & situation(0)
        fields["d"] = draw(st.sampled_from([both, rectype(e=situation(1))]))
    return rectype(fields)


@given(models(), patterns())
def test_witnesses_are_those_of_going_through_everything(M, T):
    def ask() -> list[str]:
        return [str(one) for one in M.witnesses(T)]

    usual, listing._TRIED_PER_INDEXED = listing._TRIED_PER_INDEXED, 10**9
    try:
        always = ask()
        listing._TRIED_PER_INDEXED = 0
        never = ask()
    finally:
        listing._TRIED_PER_INDEXED = usual
    assert always == never == ask()


@given(models(), patterns())
def test_what_is_true_is_that_some_record_is_of_the_type(M, T):
    """Brute force: each way to take individuals for x, y and z, and situations."""
    found = M.witnesses(T)
    assert all(M.judge(one, T).holds for one in found)
    labels = [label for label, field in T.fields if field is Ind]
    taken = {tuple(one[label] for label in labels) for one in found}
    for values in product(NAMES, repeat=len(labels)):
        some = rectype(
            {
                label: Ind @ dict(zip(labels, values, strict=True))[label]
                if label in labels
                else field
                for label, field in T.fields
            }
        )
        assert (M.true(some) == (1, 1)) == (values in taken)
