"""Laws of modal systems: possibilities apart, box and diamond, the two notions."""

from contextlib import suppress

import pytest
from generators import (
    NAMES,
    A,
    B,
    models,
    names,
    record_types,
    records,
    related,
    samples,
    types,
)
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import rectype, subtype
from ttr.computing.subtyping import consistent
from ttr.errors import RefusedError, UnsupportedError
from ttr.judging import proposition
from ttr.semantics.modality import modal_system, necessarily, possibly
from ttr.types import Application
from ttr.types.paths import subterms

systems = st.lists(models(), min_size=1, max_size=3).map(
    lambda found: modal_system({f"w{n}": M for n, M in enumerate(found)})
)
propositions = st.builds(proposition, names, st.sampled_from([A, B, A & B, A | B, ~A]))


@pytest.mark.slow
@given(systems, types(), types())
def test_structural_subtyping_is_subtyping_in_every_possibility(w, S, T):
    """Asked of the witnesses themselves, not only of the rules."""
    if not subtype(S, T).yes:
        return
    assert w.restrictive.subtype(S, T).yes
    for name in w.names:
        with suppress(UnsupportedError):
            for witness in w[name].witnesses(S):
                assert w.judge(name, witness, T).holds


@given(systems, record_types(), record_types())
def test_a_subtyping_that_is_refuted_has_a_counter_judgement(w, S, T):
    answer = w.restrictive.subtype(S, T)
    if answer.no:
        assert w.judge(answer.possibility, answer.counter.sit, S).holds
        assert not w.judge(answer.possibility, answer.counter.sit, T).holds


@pytest.mark.slow
@given(systems, record_types(), record_types())
def test_witnesses_agree_with_modal_subtyping(w, S, T):
    if w.restrictive.subtype(S, T).yes:
        for name in w.names:
            with suppress(UnsupportedError):
                for witness in w[name].witnesses(S):
                    assert w.judge(name, witness, T).holds


kinds = st.sampled_from([A, B, A & B, A | B, ~A, rectype(x=A), rectype(x=B, y=A)])
pairs = related() | st.tuples(kinds | types(), kinds | types())


@given(systems, pairs, records() | samples())
def test_whatever_is_of_S_is_of_T_where_that_was_said(w, pair, r):
    """Also what was never told, such as a record with further fields."""
    S, T = pair
    if not w.restrictive.subtype(S, T).yes:
        return
    for name in w.names:
        if w.judge(name, r, S).p == (1, 1):
            assert w.judge(name, r, T).p == (1, 1)


@given(systems, types() | propositions)
def test_what_is_necessary_is_possible(w, P):
    for notion in (w.restrictive, w.inclusive):
        box, diamond = notion.necessary(P).p, notion.possible(P).p
        assert box.lo <= diamond.lo
        assert box.hi <= diamond.hi


@given(systems, names, st.sampled_from([A, B, A & B, A | B]))
def test_duality_of_propositions(w, a, T):
    """□(a : T) is not ◇(a : ¬T)."""
    box = w.restrictive.necessary(proposition(a, T)).p
    diamond = w.restrictive.possible(proposition(a, ~T)).p
    assert box == pytest.approx((1 - diamond.hi, 1 - diamond.lo))


@given(systems, types())
def test_box_types_are_judged_as_necessity(w, T):
    assume(not any(isinstance(part, Application) for part in subterms([T])))
    box, diamond = w.restrictive.necessary(T).p, w.restrictive.possible(T).p
    assert w.judge("w0", "s", necessarily(T)).p == box
    assert w.judge("w0", "s", possibly(T)).p == diamond
    assert w.restrictive.necessary(necessarily(T)).p.hi <= box.hi


@pytest.mark.slow
@given(systems, names, types(), samples())
def test_possibilities_are_apart(w, a, T, b):
    try:
        after = w.given("w0", a, T)
    except (RefusedError, UnsupportedError):
        return
    for name in w.names[1:]:
        assert after[name] is w[name]
        assert after.judge(name, b, T).p == w.judge(name, b, T).p


@pytest.mark.slow
@given(systems, types(), types())
def test_where_all_exists_the_two_notions_agree(w, S, T):
    for ask in ("necessary", "possible"):
        one, other = getattr(w.restrictive, ask)(T), getattr(w.inclusive, ask)(T)
        assert (one.p, one.why) == (other.p, other.why)
    assert str(w.restrictive.subtype(S, T)) == str(w.inclusive.subtype(S, T))


@given(systems, types(), st.sampled_from(NAMES))
def test_restrictively_necessary_is_inclusively_necessary(w, T, a):
    w = modal_system({**dict(w.models), "last": w["w0"]}).without("last", A)
    if w.restrictive.necessary(T).yes:
        assert w.inclusive.necessary(T).yes


@given(systems, types())
def test_what_is_impossible_by_its_form_is_not_possible(w, T):
    if consistent(T).no:
        assert not w.restrictive.possible(T).yes
