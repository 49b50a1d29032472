"""Laws of attitudes: judging and subtyping go by the same matching."""

from generators import made_up, record_types, relatives
from hypothesis import given
from hypothesis import strategies as st

from ttr import Ind, Model, join, meet, rectype, relabel, subtype
from ttr.building import subtype_up_to_relabelling
from ttr.judging.certainty import is_certain
from ttr.semantics.attitudes import believe, know, ltm, matches, with_attitudes

LABELS = ["x", "y", "z", "n", "c", "d", "l", "other"]
NOBODY = with_attitudes(Model().given("sam", Ind))


@st.composite
def views_and_contents(draw):
    """A view, and a content that has something to do with it."""
    V = draw(record_types())
    C = draw(relatives(V))
    new = draw(st.permutations(LABELS))
    return V, relabel(C, dict(zip(C.labels, new, strict=False)))


@given(views_and_contents())
def test_believing_is_subtyping_up_to_relabelling(pair):
    V, C = pair
    answer = subtype_up_to_relabelling(V, C)
    M = NOBODY.given("m", ltm("sam", V))
    p = M.judge("m", believe("sam", C)).p
    verdicts = {(1, 1): "yes", (0, 0): "no", (0, 1): "unknown"}
    assert verdicts[p] == answer.verdict
    assert is_certain(M.facts, "m", believe("sam", C)) == answer.yes
    assert subtype(ltm("sam", V), believe("sam", C), M.theory).yes == answer.yes
    assert bool(matches(M, "sam", C)) == answer.yes
    if answer.no:
        assert not subtype(ltm("sam", V), believe("sam", C), M.theory).yes


@given(views_and_contents())
def test_a_refuted_belief_has_a_counterexample(pair):
    V, C = pair
    for S in (ltm("sam", V), believe("sam", V)):
        answer = subtype(S, believe("sam", C), NOBODY.theory)
        if answer.no:
            against = answer.counter
            assert against.model.judge(against.sit, S).holds
            assert against.p == (0, 0)


@given(views_and_contents())
def test_knowing_is_believing_what_is_true(pair):
    V, C = pair
    M = NOBODY.given("m", ltm("sam", V))
    found = made_up(C, M)
    M = M if found is None else found[1]
    believed = M.judge("m", believe("sam", C)).p == (1, 1)
    known = M.judge("m", know("sam", C)).p == (1, 1)
    assert known == (believed and M.true(C) == (1, 1))
    assert subtype(know("sam", V), believe("sam", C), M.theory).yes == (
        subtype_up_to_relabelling(V, C).yes
    )


@given(views_and_contents(), st.sampled_from([0.2, 0.5, 0.9]))
def test_a_view_and_what_it_matches_are_not_independent(pair, p):
    V, C = pair
    M = NOBODY.given("m", ltm("sam", V), p)
    S, T = ltm("sam", V), believe("sam", C)
    if subtype_up_to_relabelling(V, C).yes:
        assert M.judge("m", T).p == (p, 1)
        assert M.judge("m", join(S, T)).p == (p, 1)
        assert M.judge("m", meet(S, T)).p == (p, p)
        assert M.judge("m", meet(S, ~T)).p == (0, 0)
    either = join(T, believe("sam", relabel(C, {k: f"{k}_" for k in C.labels})))
    assert M.judge("m", either).p == M.judge("m", T).p


@given(views_and_contents())
def test_a_record_of_beliefs_is_judged_field_by_field(pair):
    V, C = pair
    M = NOBODY.given("m", ltm("sam", V))
    T = rectype(x=Ind, b=believe("sam", C))
    held = M.judge("m", believe("sam", C)).holds if _is_decided(M, C) else None
    if held is not None:
        assert M.judge({"x": "sam", "b": "m"}, T).holds == held
        assert bool(M.witnesses(T)) == held


def _is_decided(M, C):
    return M.judge("m", believe("sam", C)).p in ((0, 0), (1, 1))
