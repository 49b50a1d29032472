"""Models in which judgements depend on one another."""

import copy
import pickle
from itertools import pairwise

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    Theory,
    TTRError,
    check,
    meet,
    record,
    rectype,
    subtype,
    this,
)
from ttr.errors import RefusedError
from ttr.semantics.random_variables import RandomVariable
from ttr.signature.signature import Axiom, Exclusion, Signature

A, B, C = Basic("A"), Basic("B"), Basic("C")
Below = Signature(axioms=(Axiom(A, B),))
Apart = Signature(exclusions=(Exclusion(A, B), Exclusion(B, C), Exclusion(A, C)))


def test_one_judgement_under_a_condition():
    M = Model().given("s1", A, 0.6).given("s2", B, 0.7, when=[("s1", A)])
    M = M.given("s2", B, 0.2, when=[("s1", ~A)])
    assert M.judge("s2", B).p == pytest.approx((0.5, 0.5))
    assert M.judge("s1", A, when=[("s2", B)]).p == pytest.approx((0.84, 0.84))


def test_a_record_along_its_dependencies():
    cloudy, rain = Pred("cloudy", Ind), Pred("rain", Ind)
    M = Model().given("d", Ind).given("s1", cloudy("d"), 0.5)
    M = M.with_table(
        ("s2", rain("d")),
        on=[("s1", cloudy("d"))],
        rows={(True,): 0.8, (False,): 0.1},
    )
    day = rectype(x=Ind, c=cloudy(this.x), r=rain(this.x))
    j = M.judge(record(x="d", c="s1", r="s2"), day)
    assert j.p == pytest.approx((0.4, 0.4))
    assert "P(s2 : rain(d) | s1 : cloudy(d)) is 0.8" in str(j.why)


def test_what_is_said_again_replaces_what_was_said():
    M = Model().given("a", A, 0.5).given("a", B, 0.9, when=[("a", A)])
    M = M.given("a", B, 0.4, when=[("a", A)])
    assert M.judge("a", A & B).p == pytest.approx((0.2, 0.2))
    assert M.given("a", A, 1).judge("a", B).p == pytest.approx((0.4, 0.4))


def test_the_model_before_is_as_it_was():
    M = Model().given("a", A, 0.5).given("a", B, 0.5)
    M.with_unknown_dependence(("a", A), ("a", B))
    assert M.judge("a", A & B).p == pytest.approx((0.25, 0.25))


def test_what_is_said_of_an_object_goes_before_what_is_said_in_general():
    M = Model().with_conditional(B, 0.6, when=A).given("a", A).given("b", A)
    M = M.given("a", B, 0.1, when=[("a", A)])
    assert M.judge("a", B).p == (0.1, 0.1)
    assert M.judge("b", B).p == (0.6, 0.6)


def test_a_table_with_a_gap():
    with pytest.raises(TTRError, match=r"no row for \(True, False\)"):
        Model().with_table(C, on=[A, B], rows={(True, True): 1, (False, True): 0})


def test_a_table_with_a_row_too_many():
    rows = {(True,): 1, (False,): 0, (True, True): 0.5}
    with pytest.raises(TTRError, match="about 1 judgements"):
        Model().with_table(C, on=[A], rows=rows)


@pytest.mark.parametrize("p", [1.5, (0.4, 0.2), "half", float("nan")])
def test_a_conditional_that_is_no_probability(p):
    with pytest.raises(TTRError, match="is a number in"):
        Model().given("a", B, p, when=[("a", A)])
    with pytest.raises(TTRError, match=r"p\(B \|\| A\)"):
        Model().with_conditional(B, p, when=A)


def test_a_judgement_does_not_depend_on_itself():
    with pytest.raises(TTRError, match="cannot depend on itself"):
        Model().given("a", A, 0.5, when=[("a", A)])


def test_a_condition_is_a_pair():
    with pytest.raises(TTRError, match="pairs of an object and a type"):
        Model().judge("a", A, when=[A])
    with pytest.raises(TTRError, match="judgements are given as a list, found A"):
        Model().judge("a", A, when=A)


@pytest.mark.parametrize(
    ("say", "message"),
    [
        (
            lambda M: M.with_conditional(A, 0.5, when=[]),
            "A has to depend on some other",
        ),
        (lambda M: M.with_conditional(A, 0.5, when=A), "A has to depend on some other"),
        (
            lambda M: M.with_conditional(A, 0.5, when=~(B & C)),
            "a condition is of a basic",
        ),
        (
            lambda M: M.given("a", A, 0.5, when=[("b", ListOf(A))]),
            "a condition is of a",
        ),
        (
            lambda M: M.given("a", ListOf(A), 0.5, when=[("b", A)]),
            "what depends on others is of a basic type or a ptype, found list\\(A\\)",
        ),
        (lambda M: M.with_unknown_dependence(("a", A)), "two judgements or more"),
    ],
)
def test_what_is_said_of_dependence_is_of_several_atoms(say, message):
    with pytest.raises(TTRError, match=message):
        say(Model())


def test_a_condition_may_be_a_meet():
    M = Model().given("a", A, 0.6).given("a", C, 0.5)
    meets = M.given("a", B, 0.5, when=[("a", A & ~C)])
    both = M.given("a", B, 0.5, when=[("a", A), ("a", ~C)])
    assert meets.judge("a", A & B & ~C).p == pytest.approx((0.15, 0.15))
    assert both.judge("a", A & B & ~C).p == pytest.approx((0.15, 0.15))


def test_classifiers_that_cannot_all_be_right():
    M = Model(Apart)
    for T in (A, B, C):
        M = M.witnessed(T, by=sure(0.4))
    with pytest.raises(RefusedError, match=r"cannot all be so: a : A with 0\.4, a : B"):
        M.judge("a", A | B | C)


def test_what_excludes_one_another_is_no_chain():
    M = Model(Apart).given("a", A, 0.3).given("a", B, 0.2).given("a", C, 0.2)
    found = M.judge("a", A & B & C)
    assert found.p == (0, 0)
    pairs = [(A, B), (A, C), (B, C)]
    links = [f"a : {S} excludes a : {T}" for S, T in pairs]
    assert found.why.because == "; ".join(["each part", *links])


def test_given_what_cannot_be():
    M = Model().given("a", A, 0.5).given("b", B, 0)
    with pytest.raises(RefusedError, match="nothing follows given b : B"):
        M.judge("a", A, when=[("b", B)])


def test_an_axiom_and_a_negation():
    M = Model(Below).given("a", A, 0.3).given("a", B, 0.5)
    assert M.judge("a", A & ~B).p == (0, 0)
    assert M.judge("a", B & ~A).p == pytest.approx((0.2, 0.2))
    assert M.judge("a", A | B).p == pytest.approx((0.5, 0.5))
    assert M.judge("a", A, when=[("a", B)]).p == pytest.approx((0.6, 0.6))


def test_what_excludes_one_another():
    M = Model(Apart).given("a", A, 0.3).given("a", B, 0.5)
    assert M.judge("a", A & B).p == (0, 0)
    assert M.judge("a", A | B).p == pytest.approx((0.8, 0.8))
    M = M.given("a", C, (0, 1))
    assert M.judge("a", C).p == pytest.approx((0, 0.2))


def test_degrees_that_cannot_all_be_are_refused():
    M = Model(Apart).given("a", A, 0.4).given("a", B, 0.4)
    with pytest.raises(RefusedError, match=r"cannot all be so: a : C with 0\.3"):
        M.given("a", C, 0.3)
    assert M.given("a", C, 0.2).judge("a", A | B | C).p == pytest.approx((1, 1))


def test_a_conditional_that_contradicts_what_is_given_is_refused():
    M = Model().given("a", A, 0.9).given("a", B, 0.1)
    with pytest.raises(RefusedError, match="these cannot all be so"):
        M.given("a", B, 0.9, when=[("a", A)])


def test_what_a_conditional_makes_impossible_cannot_be_given_for_certain():
    never = Model().given("a", A, 0, when=[("b", B)]).given("b", B)
    with pytest.raises(RefusedError, match="these cannot all be so"):
        never.given("a", A)


def test_why_multiplies_along_the_dependencies():
    known = Model().given("a", A, 0.6).given("a", B, 0.5, when=[("a", A)])
    reason = str(known.judge("a", A & B).why).splitlines()[0]
    assert "0.6 × 0.5, each given those before; P(a : B | a : A) is 0.5" in reason


@pytest.mark.parametrize(("number", "named"), [(5, 5), (6, 6), (9, 6)])
def test_of_many_objects_the_least_and_the_most_probable_are_named(number, named):
    model = Model()
    for n in range(number):
        model = model.given(f"o{n}", A).given(f"o{n}", B, (n + 1) / 10)
    head, *lines = str(model.chance(B, when=A)).splitlines()
    assert head.endswith(f"({number} objects)")
    ends = [*range(3), *range(number - 3, number)]
    shown = list(dict.fromkeys(ends)) if number > 5 else list(range(number))
    assert lines == [f"  {(n + 1) / 10}: o{n}" for n in shown]
    assert len(lines) == named


def test_certainly_of_one_is_not_of_what_it_excludes():
    M = Model(Apart).given("a", A)
    assert M.judge("a", B).holds is False
    with pytest.raises(RefusedError, match="A <: ~B"):
        M.given("a", B)


def test_exclusions_in_subtyping():
    kennel = Theory.parse("""
        basic Ind
        pred dog(Ind), cat(Ind), puppy(Ind)
        object fido : Ind
        puppy(x) <: dog(x)
        dog(x) <: ~cat(x)
        check dog(fido) <= ~cat(fido)
        check puppy(fido) <= ~cat(fido)
        check cat(fido) <= ~puppy(fido)
        check not dog(fido) <= cat(fido)
        check puppy(fido) /\\ cat(fido) <= [x : Ind]
        check [x : Ind, c : dog(x), d = c : cat(x)] <= [y : Ind]
        check not [x : Ind, c : dog(x), d : cat(x)] <= [y : Ind]
    """)
    assert check(kennel).holds, check(kennel)


def test_conditionals_in_a_file():
    theory = Theory.parse("""
        basic Flu, Ill, Old
        object kim, sam : Flu
        given kim : Old
        given P(Ill || Flu, Old) = 0.6
        given P(Ill || Flu, ~Old) in [0.2, 0.3]
        given P(sam : Old | kim : Ill) = 0.5
        given P(sam : Old | kim : ~Ill) = 0
        check P(kim : Ill) = 0.6
        check P(sam : Old | kim : Ill) = 0.5
        check P(sam : Ill | kim : ~Ill, sam : Flu) = [0.2, 0.3]
        check P(Ill || Flu) in [0.2, 0.6]
    """)
    assert check(theory).holds, check(theory)


def test_something_is_of_a_type():
    M = Model().given("a", A, 0.3).given("b", A, 0.4)
    assert M.true(A) == pytest.approx((0.58, 1))
    assert M.true(A, among=["a", "b"]) == pytest.approx((0.58, 0.58))
    assert M.true(A | B, when=A) == (1, 1)
    with pytest.raises(RefusedError, match="nothing is of B"):
        M.true(A, when=B)


def test_any_one_object():
    M = (
        Model()
        .with_conditional(B, 0.6, when=[A, C])
        .with_conditional(B, 0.3, when=[A, ~C])
    )
    assert M.chance(B, when=A).p == (0, 1)
    M = M.given("a", A).given("b", A, 0.5).given("b", C)
    assert M.chance(B, when=A).p == (0.3, 0.6)
    assert M.chance(A | C, when=A).p == (1, 1)
    assert M.chance(B, when=A, among=["a"]).p == (0.3, 0.3)


def sure(p):
    return lambda *_: p


def test_classifiers_that_contradict_an_axiom():
    M = Model(Below).witnessed(A, by=sure(0.9)).witnessed(B, by=sure(0.5))
    for kind in (A, B):
        with pytest.raises(RefusedError, match="A <: B"):
            M.judge("a", kind)
    assert M.witnessed(B, by=sure(0.95)).judge("a", A).p == (0.9, 0.9)
    assert M.witnessed(B, by=sure((0.2, 1))).judge("a", B).p == (0.9, 1)


def test_what_is_seen_of_a_ptype_is_seen_of_those_above_it():
    dog, puppy = Pred("dog", Ind), Pred("puppy", Ind)
    theory = Signature(axioms=(Axiom(puppy(this.x), dog(this.x)),))
    M = Model(theory).given("o", Ind)
    M = M.witnessed(puppy, by=sure(0.9)).witnessed(dog, by=sure(0.5))
    both = rectype(x=Ind, p=puppy(this.x) & dog(this.x))
    # However sure the classifier of dogs is, what is seen as a puppy is one.
    assert M.perceive(record(x="o"), both).p == pytest.approx((0.9, 0.9))
    just_dog = rectype(x=Ind, p=dog(this.x))
    assert M.perceive(record(x="o"), just_dog).p == pytest.approx((0.9, 0.9))
    j = M.witnessed(dog, by=sure(0.95)).perceive(record(x="o"), both)
    assert j.p == pytest.approx((0.9, 0.9))


def test_rounding_is_no_contradiction():
    M = Model(Apart).given("a", A, 0.9).given("a", B, 0.1)
    assert M.judge("a", A | B).p == (1, 1)


def test_two_types_below_a_third_of_which_nothing_is_told():
    theory = Signature(axioms=(Axiom(A, C), Axiom(B, C)))
    M = Model(theory).given("a", A, 0.25).given("a", B, 0.25)
    assert M.judge("a", A | B).p == pytest.approx((0.4375, 0.4375))
    assert M.judge("a", C).p == M.judge("a", C | A).p == pytest.approx((0.4375, 1))
    assert M.judge("a", A & ~C).p == (0, 0)


def test_a_type_below_two_that_are_independent():
    theory = Signature(axioms=(Axiom(C, A), Axiom(C, B)))
    M = Model(theory).given("a", A, 0.5).given("a", B, 0.5)
    assert M.judge("a", A & B).p == (0.25, 0.25)
    M = Model(Signature(theory.axioms, opened=frozenset((C,))))
    M = M.given("a", A, 0.5).given("a", B, 0.5)
    assert M.judge("a", C).p == (0, 0.25)


def test_classifiers_and_what_excludes():
    M = Model(Apart).witnessed(A, by=sure(0.9))
    with pytest.raises(RefusedError, match="A <: ~B and the witness function of A"):
        M.given("a", B, 0.5)
    assert M.given("a", B, 0.1).judge("a", A | B).p == (1, 1)
    with pytest.raises(RefusedError):
        M.witnessed(B, by=sure(0.8)).judge("a", B)


EXCLUSIVE = [Basic(f"X{i}") for i in range(15)]
ALL_APART = Signature(
    exclusions=tuple(
        Exclusion(S, T) for S in EXCLUSIVE for T in EXCLUSIVE if str(S) < str(T)
    )
)


def test_many_that_exclude_each_other():
    M = Model(ALL_APART)
    for T in EXCLUSIVE[:-1]:
        M = M.given("a", T, 0.07)
    last = EXCLUSIVE[-1]
    assert M.given("a", last, (0, 1)).judge("a", last).p == pytest.approx((0, 0.02))
    with pytest.raises(RefusedError, match="these cannot all be so"):
        M.given("a", last, 0.03)


def chain(length):
    """A model in which each judgement depends on the one before it."""
    kinds = [Basic(f"K{i}") for i in range(length)]
    M = Model().given("a", kinds[0], 0.5)
    for before, T in pairwise(kinds):
        M = M.given("a", T, 0.9, when=[("a", before)])
        M = M.given("a", T, 0.2, when=[("a", ~before)])
    return kinds, M


def test_a_long_chain_of_conditionals():
    kinds, M = chain(40)
    p = 0.5
    for _ in kinds[1:]:
        p = 0.9 * p + 0.2 * (1 - p)
    assert M.judge("a", kinds[-1]).p == pytest.approx((p, p))
    every = M.judge("a", meet(*kinds)).p
    assert every == pytest.approx((0.5 * 0.9**39,) * 2)
    back = M.judge("a", kinds[0], when=[("a", kinds[-1])]).p
    assert back.lo == back.hi == pytest.approx(0.5, abs=1e-3)


def test_what_is_given_goes_before_what_is_expected():
    M = Model().with_conditional(B, 0.9, when=A)
    for one in (
        M.given("a", A, 0.9).given("a", B, 0.1),
        Model().given("a", A, 0.9).given("a", B, 0.1).with_conditional(B, 0.9, when=A),
    ):
        assert one.judge("a", A & B).p == pytest.approx((0.09, 0.09))


def test_nothing_is_of_a_type_that_contradicts_itself():
    theory = Signature(axioms=(Axiom(A, B),), exclusions=(Exclusion(A, B),))
    assert subtype(A, C, theory).yes
    assert Model(theory).judge("a", A).p == (0, 0)


def test_what_excludes_is_never_found():
    theory = Signature(exclusions=(Exclusion(A, B),))
    assert Model(theory).chance(A, when=B).p == (0, 0)
    assert Model(theory).chance(~A, when=B).p == (1, 1)


def test_models_can_be_copied_and_kept():
    M = Model(Apart).given("a", A, 0.3).given("a", B, 0.5, when=[("a", ~A)])
    for copied in (pickle.loads(pickle.dumps(M)), copy.deepcopy(M)):
        assert copied.judge("a", A | B).p == M.judge("a", A | B).p


@pytest.mark.parametrize(
    "wrong",
    [
        lambda M: M.with_table(C, on="A", rows={}),
        lambda M: M.with_table(C, on=None, rows={}),
        lambda M: M.with_table(C, on=[A] * 30, rows={}),
        lambda M: M.with_table(C, on=[A], rows=None),
        lambda M: M.true(A, among=5),
        lambda M: M.true(A, among="ab"),
        lambda M: M.chance(A, when=B, among=5),
        lambda M: M.with_given("x"),
        lambda M: M.judge("a", A, when=3),
        lambda M: RandomVariable("V", A, B).judge("M", "a", A),
        lambda M: RandomVariable("V", A, B).judge(M, "a", A, when=3),
        lambda M: RandomVariable(3, A, B),
        lambda M: RandomVariable("V", A),
    ],
)
def test_wrong_input_is_told(wrong):
    with pytest.raises(TTRError) as told:
        wrong(Model().given("a", A, 0.5))
    assert len(str(told.value).splitlines()) <= 2


def test_a_field_that_is_a_join_is_perceived():
    cup, mug = Pred("cup", Ind), Pred("mug", Ind)
    M = (
        Model()
        .given("o", Ind)
        .witnessed(cup, by=sure(0.8))
        .witnessed(mug, by=sure(0.5))
    )
    j = M.perceive(record(x="o"), rectype(x=Ind, c=cup(this.x) | mug(this.x)))
    assert j.p == pytest.approx((0.9, 0.9))


def test_why_says_that_nothing_is_known_of_dependence():
    M = (
        Model()
        .given("a", A, 0.6)
        .given("a", B, 0.5)
        .with_unknown_dependence(("a", A), ("a", B))
    )
    why = M.judge("a", A & B).why
    assert "nothing is known of how they depend" in why.because


def test_two_types_that_exclude_each_other_and_of_which_nothing_is_told():
    theory = Signature(
        exclusions=(Exclusion(A, B),),
        axioms=(Axiom(C, A),),
        opened=frozenset((A, B, C)),
    )
    M = Model(theory)
    assert M.judge("a", A & B).p == M.judge("a", C & B).p == (0, 0)
    assert M.judge("a", C & ~A).p == (0, 0)
    assert M.judge("a", ~(A & B)).p == (1, 1)


def test_any_one_of_many_objects_is_any():
    M = Model().with_conditional(B, 0.6, when=A)
    for number in range(1_001):
        M = M.given(f"o{number}", A)
    assert M.given("o1000", B, 0.1).chance(B, when=A).p == (0.1, 0.6)


def test_evidence_of_another_type_changes_how_probable_each_value_is():
    V = RandomVariable("V", A, B)
    M = Model(Signature(exclusions=(Exclusion(A, B),)))
    M = M.given("a", A, 0.2).given("a", B, 0.8)
    M = M.given("a", C, 0.9, when=[("a", A)]).given("a", C, 0.3, when=[("a", ~A)])
    assert V.judge(M, "a", A).p == pytest.approx((0.2, 0.2))
    seen = V.judge(M, "a", A, when=[("a", C)])
    assert seen.p == pytest.approx((0.18 / (0.18 + 0.24),) * 2)


def test_bounds_of_a_chain_in_which_something_is_not_so():
    M = Model().given("a", A, (0.5, 0.6)).given("b", B, (0.2, 0.4), when=[("a", A)])
    found = M.judge(record(x="a", y="b"), rectype(x=A, y=~B)).p
    assert found == pytest.approx((0.5 * (1 - 0.4), 0.6 * (1 - 0.2)))


# --- degree 0 ------------------------------------------------------------------------

OPEN = Signature(opened=frozenset((A, B, C)))


def model_of(*said):
    M = Model(OPEN)
    for T, p, *when in said:
        M = M.given("a", T, p, when=[("a", S) for S in when])
    return M


@pytest.mark.parametrize("in_order", [1, -1])
def test_a_condition_of_degree_0_says_nothing_of_what_depends_on_it(in_order):
    M = model_of(*[(A, 0), (C, 0.3, A), (C, 0.1, ~A)][::in_order])
    assert M.judge("a", C).p == (0.1, 0.1)
    with pytest.raises(RefusedError, match="that cannot be"):
        M.judge("a", C, when=[("a", A)])


@pytest.mark.parametrize("in_order", [1, -1])
def test_what_is_0_makes_its_conditions_0(in_order):
    M = model_of(*[(C, 0), (C, 0.3, A)][::in_order])
    assert M.judge("a", A).p == (0, 0)
    with pytest.raises(RefusedError, match="cannot all be so"):
        M.given("a", A, 0.5)


def test_a_degree_is_told_through_what_nothing_else_is_known_of():
    M = model_of((B, 0.5, A), (C, 1, B), (C, 0))
    assert M.judge("a", B).p == (0, 0)
    assert M.judge("a", A).p == (0, 0)
    likely = model_of((B, 0.5, A), (C, 1, B), (C, 0.1))
    assert likely.judge("a", A).p == pytest.approx((0, 0.2))


def test_a_degree_is_told_by_what_an_axiom_puts_above_it():
    M = Model(Signature(axioms=(Axiom(B, C),), opened=frozenset((A,))))
    M = M.given("a", B, 0.9, when=[("a", A)])
    M = M.given("b", A).given("a", C, 0.1, when=[("b", A)])
    assert M.judge("a", A).p == pytest.approx((0, 0.1 / 0.9))


def test_the_reason_of_one_judgement_is_what_it_was_conditioned_on():
    M = model_of((A, 0.6), (B, 0.5, A), (B, 0.2, ~A))
    rule = "P(a : B | a : A) is 0.5; P(a : B | not a : A) is 0.2"
    assert M.judge("a", B).why.rule == rule


def test_without_a_degree_what_depends_on_it_tells_nothing():
    M = model_of((A, 0.4), (B, 0.5, A), (B, 0.2, ~A), (C, 1, B), (C, 0.4, ~B))
    assert M.judge("a", A).p == (0.4, 0.4)
    assert M.judge("a", B).p == pytest.approx((0.32, 0.32))


@pytest.mark.parametrize("in_order", [1, -1])
def test_degrees_that_are_rounded_fractions_do_not_contradict_one_another(in_order):
    # p(A and B) is 2/9 either way, but 4/9 and 5/9 are no floats.
    M = Model(OPEN).given("a", A, 4 / 9).given("a", B, 5 / 9)
    for T, p, when in [(A, 0.4, B), (B, 0.5, A)][::in_order]:
        M = M.given("a", T, p, when=[("a", when)])
    assert M.judge("a", A & B).p == pytest.approx((2 / 9, 2 / 9))
    with pytest.raises(RefusedError, match="cannot all be so"):
        Model(OPEN).given("a", A, 4 / 9).given("a", B, 5 / 9).given(
            "a", A, 0.81, when=[("a", B)]
        )


def test_a_condition_that_follows_from_another_adds_nothing():
    # B is below C, so C happens with B or without it.
    M = Model(Signature((Axiom(B, C),), frozenset((A, B, C))))
    M = M.given("a", B, 0.01).given("a", A, 0.01)
    for more in (C | A, C | ~B, C | ~(A | B), (C | A) & (C | B)):
        for conditions in ((C, more), (more, C)):
            p = M.judge("a", A, when=[("a", T) for T in conditions]).p
            assert p == pytest.approx((0.01, 0.01)), str(more)


# --- conditions that are no conjunction ----------------------------------------------


def test_what_follows_from_a_condition_adds_nothing_to_it():
    M = model_of((A, 0.5), (C, 0.3, A))
    for more in ([A | C], [A | B], [A & (A | C)], [~(~A & ~C)]):
        when = [("a", S) for S in (A, *more)]
        assert M.judge("a", C, when=when).p == (0.3, 0.3)
    unknown = model_of((A, (0.01, 1)), (C, 0.3, A))
    assert unknown.judge("a", C, when=[("a", A), ("a", A | C)]).p == (0.3, 0.3)


B_IF_A = "P(a : B | a : A) is 0.5"


@pytest.mark.parametrize(
    ("T", "p_of_A", "when", "reckoned"),
    [
        (B, 0.6, [("a", A)], f"given a : A; 0.3 / 0.6; {B_IF_A}"),
        (A, 0.6, [("a", B)], f"given a : B; {B_IF_A}"),
        (A, 0.6, [("a", A | B)], f"given a : A \\/ B; {B_IF_A}"),
        (A, (0.5, 0.6), [("a", A)], "given a : A"),
        (A, 0.6, [("a", A)], "given a : A; 0.6 / 0.6"),
        (A, 0.6, [("b", C)], "given b : C; which has nothing to do with it"),
        (A, 0.6, [("c", A)], "given c : A; which has nothing to do with it"),
        (
            A,
            0.6,
            [("b", C), ("c", A)],
            "given b : C, c : A; which has nothing to do with it",
        ),
    ],
)
def test_the_reason_of_a_conditional_degree_is_a_quotient(T, p_of_A, when, reckoned):
    M = Model().given("a", A, p_of_A).given("a", B, 0.5, when=[("a", A)])
    M = M.given("b", C, 0.3).given("c", A)
    assert M.judge("a", T, when=when).why.because == reckoned


def test_a_disjunction_is_asked_of_the_worlds():
    M = model_of((A, 0.5), (C, 0.3, A))
    assert M.judge("a", C, when=[("a", A | C)]).p == pytest.approx((0.3, 0.65))
    M = M.given("a", C, 0.1, when=[("a", ~A)])
    assert M.judge("a", C, when=[("a", A | C)]).p == pytest.approx((4 / 11, 4 / 11))
