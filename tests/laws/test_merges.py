"""Laws of merging by form, which asks no question: it may be done at any time."""

from generators import models, record_types, samples, types
from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, Ind, Pred, RecType, Theory, fun, outer, rectype, this
from ttr.computing.normalisation import normal_value
from ttr.signature.signature import signature_of
from ttr.types import Application, Merge, merge_terms
from ttr.types.paths import mentions
from ttr.types.substitution import substitute_variable

run = Pred("run", Ind)


@given(types(), types(), types())
def test_associative_commutative_idempotent(R, S, T):
    assert merge_terms(S, T) is merge_terms(T, S)
    assert merge_terms(merge_terms(R, S), T) is merge_terms(R, merge_terms(S, T))
    assert merge_terms(R, S, T) is merge_terms(R, merge_terms(S, T))
    merged = merge_terms(S, T)
    assert merge_terms(merged, merged) is merged
    assert merge_terms(merged, T) is merged


@given(types(), types(), models(), samples())
def test_what_is_of_a_merge_is_of_both(S, T, M, sample):
    for a in (sample, "a", "x", ()):
        assert M.judge(a, merge_terms(S, T)).p == M.judge(a, S & T).p


@given(st.lists(types(), min_size=1, max_size=3), types(), models(), samples())
def test_what_is_not_known_yet_may_be_merged_before_or_after_it_is(others, S, M, a):
    variable = Application(this.f, "a")
    late = merge_terms(variable, *others)
    assert late is variable or mentions(late, Merge)
    f = fun(f=Basic("A") >> RecType)(late)
    constant = fun(x=Basic("A"))(S)
    found = substitute_variable(f.body, constant)
    assert found is merge_terms(Application(constant, "a"), *others)


@given(record_types(), record_types())
def test_record_types_are_merged_label_by_label(S, T):
    merged = merge_terms(S, T)
    assert set(merged) == {*S, *T}
    for label in merged:
        both = [one[label] for one in (S, T) if label in one]
        assert merged[label] is merge_terms(*both)


@given(st.lists(types(), min_size=1, max_size=3), types(), types())
def test_a_part_of_a_meet_may_be_known_late_too(others, S, also):
    late = merge_terms(Application(this.f, "a") & also, *others)
    f = fun(f=Basic("A") >> RecType)(late)
    constant = fun(x=Basic("A"))(S)
    whole = Application(constant, "a") & also
    assert substitute_variable(f.body, constant) is merge_terms(whole, *others)
    reduced = normal_value(f.body, signature_of(None))
    assert normal_value(reduced, signature_of(None)) is reduced


def test_a_merge_under_a_meet_waits():
    one, other = rectype(x=Ind), rectype(y=Ind)
    late = merge_terms(Application(this.f, "a") & Basic("A"), one)
    body = fun(f=Ind >> RecType)(late).body
    found = substitute_variable(body, fun(z=Ind)(other))
    theory = Theory.parse("basic Ind, A\nobject a : Ind")
    wanted = Basic("A") & rectype(x=Ind, y=Ind)
    assert normal_value(found, theory) is wanted
    assert merge_terms(other & Basic("A"), one) is wanted


def test_paths_stay_paths_of_the_whole():
    S = rectype(x=Ind, r=rectype(c=run(outer.x)))
    T = rectype(x=Ind, r=rectype(d=run(outer.x)))
    inner = rectype(c=run(outer.x), d=run(outer.x))
    assert merge_terms(S, T) is rectype(x=Ind, r=inner)
