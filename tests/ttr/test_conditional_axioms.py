"""Axioms with conditions: what follows from what, if one content is below another."""

import pytest

from ttr import Model, Theory, budget, check, subtype
from ttr.cli.session.replies import answer
from ttr.cli.session.sessions import Session
from ttr.errors import NotationError, RefusedError

HEAD = r"""
    basic Ind
    pred  dog(Ind), cat(Ind), puppy(Ind), view(Ind, RecType), think(Ind, RecType)
    pred  know(Ind, RecType), hope(Ind, RecType), see(Ind, RecType)
    object sam, kim, fido : Ind
    puppy(x) <: dog(x)
"""

THINK = "    view(a, V) <: think(a, C) if V <= C up to relabelling\n"
KNOW = "    think(a, C) <: know(a, C) if true(C)\n"


def theory_of(*lines):
    return Theory.parse(HEAD + "".join(f"    {line.strip()}\n" for line in lines))


def assert_holds(*lines):
    report = check(theory_of(*lines))
    assert report.asked > 0
    assert report.holds, report


def test_a_content_follows_from_a_view_below_it():
    assert_holds(
        THINK,
        "given m : view(sam, [i : Ind, e : puppy(i), j = fido : Ind, d : cat(j)])",
        "check m : think(sam, [x : Ind, c : dog(x)])",
        "check m : think(sam, [c : cat(fido)])",
        "check not m : think(sam, [c : dog(fido)])",
        "check not m : think(kim, [x : Ind])",
        "check not m : view(sam, [x : Ind])",
        "check P(think(sam, [x : Ind])) = 1",
        "check P(think(sam, [c : dog(fido)])) = 0",
    )


def test_without_the_words_labels_have_to_be_the_same():
    assert_holds(
        "view(a, V) <: think(a, C) if V <= C",
        "given m : view(sam, [i : Ind, e : dog(i)])",
        "check m : think(sam, [i : Ind])",
        "check not m : think(sam, [x : Ind])",
    )


def test_a_condition_may_be_that_something_is_of_a_type():
    assert_holds(
        THINK,
        KNOW,
        "given m : view(sam, [i : Ind, d : cat(i), e : dog(fido)])",
        "given s : dog(fido)",
        "check m : know(sam, [e : dog(fido)])",
        "check not m : know(sam, [x : Ind, e : cat(x)])",
        "check m : think(sam, [x : Ind, e : cat(x)])",
    )


def test_it_follows_along_several_axioms():
    assert_holds(
        THINK,
        "see(a, V) <: view(a, V)",
        "think(a, V) <: hope(a, C) if V <= C",
        "think(a, C) <: think(a, C) if true(C)",
        "given m : see(sam, [i : Ind, e : puppy(i)])",
        "check m : hope(sam, [i : Ind, e : dog(i)])",
        "check m : hope(sam, [i : Ind])",
        "check m : think(sam, [x : Ind, c : dog(x)])",
    )


def test_axioms_in_a_circle_come_to_an_end():
    assert_holds(
        "think(a, V) <: hope(a, C) if V <= C up to relabelling",
        "hope(a, V) <: think(a, C) if V <= C up to relabelling",
        "think(a, C) <: know(a, C) if true(C)",
        "know(a, C) <: think(a, C) if true(C)",
        "given m : think(sam, [i : Ind, e : puppy(i)])",
        "check m : think(sam, [x : Ind, c : dog(x)])",
        "check m : hope(sam, [x : Ind, c : dog(x)])",
        "check not m : know(sam, [x : Ind, c : dog(x)])",
    )


def test_a_content_that_is_true_only_if_it_is_is_left_open():
    theory = theory_of(
        "view(a, V) <: think(a, C) if V <= C up to relabelling, true(V)",
        "given m : view(sam, [x : Ind, b : think(sam, [x : Ind])])",
    )
    M, T = Model(theory), theory.parse("think(sam, [x : Ind])")
    with budget(steps=20_000):
        j = M.judge("m", T)
    assert j.p == (0, 1)
    assert "too large" in j.why.because


def test_a_type_in_a_condition_stands_for_itself():
    assert_holds(
        "Dog := [x : Ind, c : dog(x)]",
        "view(a, V) <: think(a, V) if V <= Dog",
        "given m : view(sam, [x : Ind, c : puppy(x), e : cat(x)])",
        "given n : view(kim, [x : Ind])",
        "check m : think(sam, [x : Ind, c : puppy(x), e : cat(x)])",
        "check not n : think(kim, [x : Ind])",
    )


def test_a_view_that_is_uncertain_makes_a_content_uncertain():
    assert_holds(
        THINK,
        KNOW,
        "given m : view(sam, [i : Ind, e : dog(i)]) = 0.8",
        "given s : dog(fido) = 0.6",
        "check P(m : think(sam, [x : Ind])) = [0.8, 1]",
        "check P(m : know(sam, [x : Ind])) = [0.8, 1]",
        "check P(m : know(sam, [x : Ind, c : dog(x)])) = [0.4, 1]",
        "check P(m : think(sam, [c : cat(fido)])) = [0, 1]",
    )


def test_what_follows_is_not_independent_of_what_it_follows_from():
    assert_holds(
        THINK,
        "given m : view(sam, [x : Ind]) = 0.8",
        "check P(m : view(sam, [x : Ind]) \\/ think(sam, [y : Ind])) = [0.8, 1]",
        "check P(m : view(sam, [x : Ind]) /\\ think(sam, [y : Ind])) = 0.8",
        "check P(m : view(sam, [x : Ind]) /\\ ~think(sam, [y : Ind])) = 0",
        "check P(m : think(sam, [y : Ind]) \\/ think(sam, [z : Ind])) = [0.8, 1]",
    )


def test_where_a_condition_is_uncertain_the_dependence_is_unknown():
    assert_holds(
        THINK,
        KNOW,
        "know(a, C) <: think(a, C)",
        "given m : view(sam, [e : dog(fido)]) = 0.8",
        "given s : dog(fido) = 0.6",
        "check P(m : know(sam, [e : dog(fido)])) = [0.4, 1]",
        "check P(m : view(sam, [e : dog(fido)]) \\/ know(sam, [e : dog(fido)])) "
        "= [0.8, 1]",
        "check P(m : view(sam, [e : dog(fido)]) /\\ know(sam, [e : dog(fido)])) "
        "in [0.2, 0.8]",
    )


def test_what_is_open_below_is_open_above():
    assert_holds(
        "open view",
        THINK,
        "check unknown 'n' : think(sam, [x : Ind])",
        "given m : view(sam, [i : Ind])",
        "check m : think(sam, [x : Ind])",
    )


def test_a_comparison_that_is_left_open_leaves_it_open():
    assert_holds(
        THINK,
        "given m : view(sam, [i : Ind])",
        "check unknown m : think(sam, [n : [a : dog(fido)] \\/ [b : dog(fido)]])",
        "check unknown [i : Ind] <= [n : [a : dog(fido)] \\/ [b : dog(fido)]] "
        "up to relabelling",
    )


def test_whether_something_is_of_types_on_a_circle_is_left_open():
    theory = theory_of("think(a, C) <: know(a, C) if true(C)")
    circle = "[x = y : Ind, y = x : Ind]"
    M = Model(theory).given("k", theory.parse(f"think(sam, {circle})"))
    j = M.judge("k", theory.parse(f"know(sam, {circle})"))
    assert j.p == (0, 1)
    assert j.why.rule.endswith(f": P({circle}) = [0, 1]")


def test_what_follows_cannot_be_denied():
    theory = theory_of(THINK, "given m : view(sam, [i : Ind])")
    M = Model(theory).given("m", theory.parse("think(sam, [x : Ind, y : Ind])"), 0.1)
    with pytest.raises(RefusedError, match=r"by view\(a, V\) <: think\(a, C\) if"):
        M.given("m", theory.parse("think(sam, [x : Ind])"), 0.3)


def test_what_was_denied_cannot_follow_from_what_is_given_later():
    theory = theory_of(THINK, "given m : ~think(sam, [x : Ind])")
    view = theory.parse("view(sam, [i : Ind])")
    with pytest.raises(RefusedError, match=r"and m : think\(sam, \[x : Ind\]\) with 0"):
        Model(theory).given("m", view)
    M = Model(theory_of(THINK)).given("m", theory.parse("think(sam, [x : Ind])"), 0.3)
    M = M.given("m", view, (0.1, 0.5))
    assert M.judge("m", view).p == (0.1, 0.3)


def test_an_axiom_may_say_on_which_condition_alone_something_is_so():
    theory = theory_of("know(a, C) <: think(a, C) only if true(C)")
    known = theory.parse("know(sam, [c : dog(fido)])")
    with pytest.raises(RefusedError, match=r"only if true\(C\): P\(.*\) = 0"):
        Model(theory).given("k", known)
    M = Model(theory).given("s", theory.parse("dog(fido)"), 0.6).given("k", known, 0.5)
    assert M.judge("k", theory.parse("think(sam, [c : dog(fido)])")).p == (0.5, 1)
    M = Model(theory).given("s", theory.parse("dog(fido)")).given("k", known)
    assert M.judge("k", theory.parse("think(sam, [c : dog(fido)])")).holds


def test_a_witness_is_made_up_with_what_it_needs():
    assert_holds(
        "know(a, C) <: think(a, C) only if true(C)",
        "see(a, C) <: know(a, C)",
        "check create(see(sam, [c : dog(fido)]))",
        "check know(sam, [x : Ind]) <= think(sam, [x : Ind])",
        "check not think(sam, [x : Ind]) <= know(sam, [x : Ind])",
        "check not know(sam, [x : Ind]) <= know(kim, [x : Ind])",
    )


def test_the_reason_shows_the_axiom_and_the_relabelling():
    theory = theory_of(THINK, KNOW, "given m : view(sam, [e : dog(fido)])")
    M = Model(theory)
    j = M.judge("m", theory.parse("think(sam, [c : dog(fido)])"))
    assert j.why.because == (
        "by view(a, V) <: think(a, C) if V <= C up to relabelling and "
        "m : view(sam, [e : dog(fido)]): with c as e"
    )
    j = M.judge("m", theory.parse("think(sam, [c : cat(fido)])"))
    assert "no field of [e : dog(fido)] can be c : cat(fido)" in j.why.because
    M = M.given("s", theory.parse("dog(fido)"))
    j = M.judge("m", theory.parse("know(sam, [c : dog(fido)])"))
    assert "with c as e; [c : dog(fido)] is true" in j.why.because


# --- types ---------------------------------------------------------------------------


def test_subtyping_goes_by_them():
    assert_holds(
        THINK,
        "know(a, C) <: think(a, C)",
        "V := [i : Ind, e : puppy(i)]",
        "check view(sam, V) <= think(sam, [x : Ind, c : dog(x)])",
        "check not view(sam, V) <= think(sam, [x : Ind, c : cat(x)])",
        "check not view(sam, V) <= think(kim, [x : Ind])",
        "check know(sam, V) <= think(sam, V)",
        "check not think(sam, V) <= think(sam, [x : Ind])",
        "check [a : Ind, m : view(a, V)] <= [a : Ind, m : think(a, [x : Ind])]",
        "check not [a : Ind, b : Ind, m : view(a, V)] "
        "<= [a : Ind, b : Ind, m : think(b, [x : Ind])]",
        "check [m : view(sam, V)] <= [n : think(sam, [x : Ind])] up to relabelling",
    )


def test_the_reason_of_subtyping_shows_the_relabelling():
    theory = theory_of(THINK)
    S, T = theory.parse("view(sam, [e : dog(fido)])"), "think(sam, [c : dog(fido)])"
    found = subtype(S, theory.parse(T), theory)
    assert str(found) == (
        "yes: by the axiom view(a, V) <: think(a, C) if V <= C up to relabelling: "
        "with c as e"
    )


def test_a_predicate_may_be_closed_under_subtyping():
    assert_holds(
        "think(a, V) <: think(a, C) if V <= C up to relabelling",
        "V := [i : Ind, e : puppy(i)]",
        "given m : think(sam, V)",
        "check m : think(sam, [x : Ind])",
        "check think(sam, V) <= think(sam, [x : Ind])",
        "check not think(sam, [x : Ind]) <= think(sam, V)",
    )


def test_a_condition_on_the_world_proves_no_subtyping():
    theory = theory_of(THINK, KNOW, "given m : view(sam, [i : Ind])")
    S, T = theory.parse("view(sam, [i : Ind])"), theory.parse("know(sam, [i : Ind])")
    assert not subtype(S, T, theory).yes
    assert Model(theory).judge("m", T).holds


def test_a_refutation_has_a_counterexample():
    theory = theory_of(THINK)
    S = theory.parse("view(sam, [i : Ind])")
    T = theory.parse("think(sam, [c : dog('fido')])")
    found = subtype(S, T, theory)
    assert found.no
    assert found.counter.model.judge(found.counter.sit, S).holds
    assert not found.counter.holds


def test_contents_that_depend_on_a_place_are_compared_when_it_is_known():
    assert_holds(
        THINK,
        "given m : view(sam, [c : cat(fido)])",
        "Of := [x : Ind, b : think(sam, [e : cat(^.x)])]",
        "check {x = fido, b = m} : Of",
        "check not {x = kim, b = m} : Of",
        "check P(Of) = 1",
        "check not Of <= [x : Ind, b : think(sam, [e : dog(^.x)])]",
        "check Of <= [x : Ind, b : think(sam, [e : cat(^.x)])]",
    )


def test_witnesses_are_listed():
    theory = theory_of(
        THINK,
        "given m : view(sam, [i : Ind, e : dog(i)])",
        "given n : view(sam, [i : Ind, e : cat(i)])",
        "given o : view(kim, [i : Ind, e : cat(i)])",
    )
    M = Model(theory)
    assert M.witnesses(theory.parse("think(sam, [x : Ind])")) == ("m", "n")
    assert M.witnesses(theory.parse("think(sam, [x : Ind, c : cat(x)])")) == ("n",)
    sit, M = M.create(theory.parse("think(sam, [c : cat(fido)])"))
    assert M.judge(sit, theory.parse("think(sam, [c : cat(fido)])")).holds


# --- notation ------------------------------------------------------------------------


def test_an_axiom_prints_as_it_is_written():
    theory = theory_of(
        THINK,
        KNOW,
        "see(a, V) <: hope(a, C) if V <= C, true(C)",
        "know(a, C) <: think(a, C) only if true(C)",
    )
    assert [str(axiom) for axiom in theory.conditional_axioms] == [
        "view(a, V) <: think(a, C) if V <= C up to relabelling",
        "think(a, C) <: know(a, C) if true(C)",
        "see(a, V) <: hope(a, C) if V <= C, true(C)",
    ]
    assert [str(axiom) for axiom in theory.restrictive_axioms] == [
        "know(a, C) <: think(a, C) only if true(C)"
    ]
    again = theory_of(*map(str, theory.axioms))
    assert again.axioms == theory.axioms


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("view(a, V) <: think(a, C) if V = C", "this is no condition of an axiom"),
        ("view(a, V) <: think(a, C) if C <= V", "the variable C stands on the right"),
        ("view(a, V) <: think(a, C)", "the variable C stands on the right only"),
        ("view(a, V) <: think(a, C) if V <= C, true(W)", "W stands in a condition"),
        ("view(a, V) <: ~think(a, V) if true(V)", "an exclusion has no conditions"),
        ("view(a, V) <: think(a, C) if", "expected"),
        ("view(a, V) <: think(a, C) only if V <= C", "the variable C stands on the"),
        ("view(a, V) <: think(a, V) only if true(C)", "C stands in a condition only"),
        ("view(a, V) <: think(a, V) only true(V)", "expected if, found true"),
        ("view(a, V) <: ~think(a, V) only if true(V)", "an exclusion has no"),
        ("view(a, V) <: think(a, C) if create(V)", "this is no condition"),
        (
            "view(a, V) <: think(a, C) when V <= C",
            "expected only if, if or the end, found when",
        ),
    ],
)
def test_what_is_no_condition_is_refused(line, message):
    with pytest.raises(NotationError, match=message):
        theory_of(line)


def test_if_may_be_a_name():
    theory = Theory.parse("basic if, A\nif <: A\ncheck if <= A")
    assert check(theory).holds


def test_the_prompt_takes_them():
    session = Session()
    for line in (*HEAD.strip().split("\n"), THINK, "given m : view(sam, [i : Ind])"):
        session = answer(session, line.strip()).session
    assert answer(session, "m : think(sam, [x : Ind])").text.startswith("yes: by view")
    assert answer(session, "m : think(kim, [x : Ind])").text.startswith("no: nothing")
