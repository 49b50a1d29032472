"""Quantifiers by witness sets: definition 18, degrees, reasons and mistakes."""

import pytest

from ttr import (
    Basic,
    Ind,
    Model,
    Pred,
    Theory,
    TTRError,
    fun,
    outer,
    record,
    rectype,
    this,
)
from ttr.errors import IllFormedError, RefusedError, UndecidedError
from ttr.semantics.quantifiers import (
    DETERMINERS,
    Extension,
    Thresholds,
    UndefinedError,
    absent,
    antecedents,
    at_least,
    at_most,
    every,
    exactly,
    exist,
    exist_pl,
    extension,
    few,
    judge_situation,
    many,
    most,
    no,
    not_every,
    number,
    quantify,
    settle,
    several,
    share,
    truth,
)
from ttr.types.objects import FiniteSet

dog, bark, boy = (Pred(name, Ind) for name in ("dog", "bark", "boy"))
hug = Pred("hug", Ind, Ind)

HALF = Thresholds(most=share("at least", 0.5), few=number("at most", 1))
HUGS_A_BOY = fun(x=Ind)(exist(boy, fun(y=Ind)(hug(outer.x, this.y))))


@pytest.fixture
def M():
    """Dogs f, r and s of four individuals; f and s bark."""
    M = Model()
    for name in "frsk":
        M = M.given(name, Ind)
    for name in "frs":
        M = M.given(f"d{name}", dog(name))
    return M.given("bf", bark("f")).given("bs", bark("s"))


EXPECTED = {
    exist: True,
    exist_pl: True,
    every: False,
    no: False,
    not_every: True,
    most: True,
    many: True,
    few: False,
    several: True,
    at_least(2): True,
    at_least(3): False,
    at_most(1): False,
    at_most(2): True,
    exactly(2): True,
    exactly(1): False,
}


@pytest.mark.parametrize("q", EXPECTED, ids=str)
def test_a_quantifier_counts(M, q):
    assert settle(M, q(dog, bark), HALF).holds is EXPECTED[q]


@pytest.mark.parametrize("q", [q for q, so in EXPECTED.items() if so], ids=str)
def test_the_witness_that_is_given_is_one(M, q):
    found = settle(M, q(dog, bark), HALF)
    assert found.witness == record(
        X={"f", "s"}, f=[record(x="f", e="bf"), record(x="s", e="bs")]
    )
    assert judge_situation(M, found.witness, found.type, HALF).holds is True


def test_every_quantifier_without_a_number_is_listed():
    assert set(DETERMINERS) == {q for q in EXPECTED if q.amount is None}


def test_a_smaller_witness_set_will_do_where_the_quantifier_rises(M):
    s = record(X={"f"}, f=[record(x="f", e="bf")])
    assert judge_situation(M, s, exist(dog, bark)).holds is True
    assert judge_situation(M, s, exist_pl(dog, bark)).holds is False


@pytest.mark.parametrize(
    ("s", "why"),
    [
        ("s1", "no record"),
        (record(X={"k"}, f=[]), "k in X is not of the first property"),
        (record(X={"f"}, f=[]), "f gives nothing for f"),
        (record(X={"f"}, f=[record(x="f", e="bs")]), "bs does not make f so"),
        (record(X={"f"}, f="f"), "no list of pairs"),
        (record(X=frozenset(), f=[]), "X has 0 of 3; it takes at least 1"),
    ],
)
def test_what_is_no_witness_is_refused_with_a_reason(M, s, why):
    j = judge_situation(M, s, exist(dog, bark))
    assert j.holds is False
    assert why in j.why.rule


def test_a_falling_quantifier_needs_all_that_are_both_in_the_set(M):
    T = at_most(2)(dog, bark)
    assert judge_situation(M, record(X={"f", "s"}), T).holds is True
    assert (
        judge_situation(M, record(X={"f", "r"}), T).why.rule
        == "s is both, but not in X"
    )


def test_a_quantified_type_is_a_type(M):
    T = every(dog, HUGS_A_BOY)
    theory = Theory.of(T)
    assert theory.parse(str(T)) is T
    s = settle(M.given("k1", boy("k")), exist(dog, bark)).witness
    after = M.given(s, exist(dog, bark))
    assert after.judge(record(e=s), rectype(e=exist(dog, bark))).holds is True


def test_quantifiers_nest(M):
    M = M.given("k1", boy("k"))
    for name in "fr":
        M = M.given(f"h{name}", hug(name, "k"))
    T = every(dog, HUGS_A_BOY)
    refuted = settle(M, T)
    assert refuted.holds is False
    assert "but for s" in str(refuted.why)
    assert "hug(s, k)" in str(refuted.why)
    M = M.given("hs", hug("s", "k"))
    found = settle(M, T)
    inner = record(X={"k"}, f=[record(x="k", e="hf")])
    assert found.refset[0].situation == inner
    assert judge_situation(M, found.witness, T).holds is True


def test_properties_may_be_of_records_or_types(M):
    dogs = fun(r=rectype(x=Ind))(rectype(e=dog(outer.r.x)))
    barks = fun(r=rectype(x=Ind))(rectype(e=bark(outer.r.x)))
    assert len(settle(M, exist(dogs, barks)).refset) == 2
    Dog = rectype(x=Ind, c=dog(this.x))
    assert len(extension(M, Dog)) == 3
    A, B = Basic("A"), Basic("B")
    M = M.given("a", A).given("b", A).given("a", B)
    assert settle(M, most(A, B), HALF).holds is True
    assert settle(M, every(A, B)).holds is False


def test_a_property_of_something_else_is_refused(M):
    Dog = rectype(x=Ind, c=dog(this.x))
    with pytest.raises(RefusedError, match=r"takes objects of Ind, which .* is not"):
        settle(M, every(Dog, bark))


# --- what is uncertain ---------------------------------------------------------------


def test_an_uncertain_thing_makes_it_a_degree(M):
    M = M.given("br", bark("r"), 0.25)
    assert settle(M, every(dog, bark)).p == (0.25, 0.25)
    assert settle(M, not_every(dog, bark)).p == (0.75, 0.75)
    assert settle(M, most(dog, bark)).holds is True
    assert settle(M, exactly(2)(dog, bark)).p == (0.75, 0.75)


def test_a_possible_thing_leaves_it_open(M):
    kennel = Theory.parse("basic Ind\npred dog(Ind), bark(Ind)\nopen bark")
    M = Model(kennel).given("f", Ind).given("df", dog("f"))
    found = settle(M, every(dog, bark))
    assert found.p == (0, 1)
    with pytest.raises(UndecidedError, match="neither certain nor refuted"):
        _ = found.holds


def test_independent_chances_are_those_of_the_binomial():
    P = Extension.of([(f"a{i}", 0.5) for i in range(4)])
    assert quantify(at_least(2), P, P).p.lo == pytest.approx(11 / 16)
    assert quantify(exactly(2), P, P).p.lo == pytest.approx(6 / 16)
    assert quantify(no, P, P).p.lo == pytest.approx(1 / 16)


def test_the_same_property_is_one_event():
    P = Extension.of([("a", 0.5), ("b", 0.5)])
    assert quantify(every, P, P).p == (1, 1)
    other = Extension.of([("a", 0.5), ("b", 0.5)])
    assert quantify(every, P, other).p.lo == pytest.approx(0.75**2)


def test_a_share_counts_both_who_is_and_who_is_not():
    P = Extension.of(["a", ("b", 0.5), ("c", 0.5)])
    Q = Extension.of(["a"])
    # a alone, or a and one of the others, is half or more of them.
    assert quantify(most, P, Q, HALF).p.lo == pytest.approx(0.75)


def test_if_there_may_be_none_a_share_is_left_open():
    P = Extension.of([("a", 0.5)])
    assert quantify(most, P, Extension.of(["a"])).p == (0.5, 1.0)


def test_things_that_rest_on_one_judgement_are_not_multiplied(M):
    M = M.given("k1", boy("k")).given("r1", boy("r"))
    M = M.given("h", hug("k", "k"), 0.5)
    hugged = fun(x=Ind)(hug("k", "k"))
    assert settle(M, exist_pl(boy, hugged)).p == (0, 1)


def test_many_uncertain_things_are_bounded():
    P = Extension.of([f"a{i}" for i in range(1000)])
    Q = Extension.of([(f"a{i}", 0.6) for i in range(1000)])
    lo, hi = quantify(most, P, Q).p
    assert 0.99 < lo < hi <= 1


def test_a_witness_function_is_asked(M):
    M = M.witnessed(bark, by=lambda x: x != "r")
    assert settle(M, every(dog, bark)).holds is False
    assert settle(M, most(dog, bark)).holds is True


# --- sentence negation ---------------------------------------------------------------


def test_nothing_is_of_what_is_absent(M):
    assert truth(M, absent(bark("r"))).p == (1, 1)
    assert truth(M, absent(bark("f"))).p == (0, 0)
    assert truth(M.given("br", bark("r"), 0.25), absent(bark("r"))).p == (0.75, 0.75)
    assert truth(M, absent(every(dog, bark))).p == (1, 1)


# --- anaphora ------------------------------------------------------------------------


def test_the_sets_that_a_pronoun_can_pick_up(M):
    found = antecedents(settle(M, exist(dog, bark)))
    assert found.refset is FiniteSet("f", "s")
    assert found.maxset is FiniteSet("f", "r", "s")
    assert found.compset is None
    assert antecedents(settle(M, at_most(2)(dog, bark))).compset is FiniteSet("r")
    assert antecedents(settle(M, exist(boy, bark))).plural == ()


@pytest.mark.parametrize("q", [exist, exist_pl, at_least(2), several, exactly(2)])
def test_all_that_are_p_are_not_offered_after_a_number_of_them(M, q):
    found = antecedents(settle(M, q(dog, bark)))
    assert found.plural == (FiniteSet("f", "s"),)


@pytest.mark.parametrize("q", [most, many, few, at_most(2)])
def test_all_that_are_p_are_offered_after_a_share_and_what_falls(M, q):
    found = antecedents(settle(M, q(dog, bark)))
    assert FiniteSet("f", "r", "s") in found.plural


def test_one_thing_is_picked_up_in_the_singular(M):
    found = antecedents(settle(M.given("k1", boy("k")), exist(boy, boy)))
    assert found.singular == ("k",)


# --- mistakes ------------------------------------------------------------------------


def test_a_share_of_nothing_is_neither_true_nor_false(M):
    with pytest.raises(UndefinedError, match=r"most\(.*boy.*nothing is of"):
        settle(M, most(boy, bark))
    with pytest.raises(UndefinedError, match="nothing is of P"):
        quantify(few, Extension.of([]), Extension.of([]))
    assert settle(M, every(boy, bark)).holds is True
    assert settle(M, not_every(boy, bark)).holds is False


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: share("at least", 1.5), "a share is a number from 0 to 1, found 1.5"),
        (lambda: share("at least", "half"), "from 0 to 1, found 'half'"),
        (lambda: share("at least", float("nan")), "from 0 to 1"),
        (lambda: share("at least", 1 / 3), "at most 10000 parts"),
        (lambda: share("roughly", 0.5), "at least or more than .* found 'roughly'"),
        (lambda: number("at least", -1), "0, 1, 2 and so on, found -1"),
        (lambda: at_least("two"), "0, 1, 2 and so on, found 'two'"),
        (lambda: Thresholds(most=number("at most", 1)), "most is at least or more"),
        (lambda: Thresholds(few=share("at least", 0.1)), "few is at most or fewer"),
        (lambda: Thresholds(many=3), "many takes a threshold, found 3"),
        (lambda: Extension.of(["a", ("a", 0.5)]), "a is twice in the extension"),
        (lambda: Extension.of([("a", 1.5)]), r"number in \[0, 1\]"),
        (lambda: every("dog", bark), "a property is a function to types"),
        (lambda: every(hug, bark), "a property is of one thing, but hug takes 2"),
        (lambda: settle(Model(), dog("f")), r"dog\(f\) is no quantified type"),
    ],
)
def test_a_mistake_is_told(make, why):
    with pytest.raises(TTRError, match=why):
        make()


def test_a_property_that_gives_no_type_is_told(M):
    with pytest.raises((IllFormedError, RefusedError), match="type"):
        settle(M, every(dog, fun(x=Ind)(this.x)))


# --- shares, functions and mistakes --------------------------------------------------


def test_of_what_certainly_is_there_a_share_can_be_taken():
    dogs, barkers = Extension.of(["f"]), Extension.of([("f", (0.25, 0.5))])
    assert quantify(most, dogs, barkers).p == (0.25, 0.5)
    assert quantify(few, dogs, barkers).p == (0.5, 0.75)


def test_where_there_may_be_nothing_a_share_may_mean_nothing():
    dogs, barkers = Extension.of([("f", (0.25, 0.5))]), Extension.of(["f"])
    assert quantify(most, dogs, barkers).p == (0.25, 1)


def test_truth_and_quantification_are_printed(M):
    found = settle(M, every(dog, bark))
    assert str(found) == str(found.why)
    assert str(found.truth) == str(found.why)
    assert "_split" not in repr(settle(M, most(dog, bark)))


@pytest.mark.parametrize(
    ("f", "rule"),
    [
        (
            [record(x="f", e="bf"), record(x="s", e="bs")],
            "f says something of s, which is not in X",
        ),
        ([record(x="f", e="bs"), record(x="f", e="bf")], "f has two pairs for f"),
    ],
)
def test_f_is_a_function_from_X(M, f, rule):
    found = judge_situation(M, record(X={"f"}, f=f), exist(dog, bark))
    assert found.holds is False
    assert found.why.rule == rule


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (
            lambda M: settle("M", every(dog, bark)),
            "expected a model to judge in, found",
        ),
        (lambda M: extension(3, dog), "expected a model to judge in, found int 3"),
        (lambda M: truth(None, dog("f")), "expected a model to judge in, found"),
        (lambda M: settle(M, every(dog, bark), 3), "takes thresholds, found int 3"),
        (lambda M: truth(M, dog("f"), 3), "takes thresholds, found int 3"),
        (lambda M: truth(M, dog(this.x)), "has paths that lead nowhere"),
        (lambda M: quantify(every, 3, Extension.of([])), "two extensions, found int 3"),
        (lambda M: quantify(3, *[Extension.of([])] * 2), "no quantifier, found int 3"),
        (lambda M: Extension.of(3), "an extension is of several things, found int 3"),
    ],
)
def test_what_is_asked_is_checked(M, ask, message):
    with pytest.raises(TTRError, match=message):
        ask(M)


# --- what depends on what ------------------------------------------------------------

KENNEL = Theory.parse("""
    basic Ind, Cup, Thing
    pred puppy(Ind), dog(Ind), cat(Ind)
    puppy(x) <: dog(x)
    cat(x) <: ~dog(x)
    Cup <: Thing
""")


def test_what_may_be_of_a_type_by_an_axiom_counts():
    M = Model(KENNEL).given("fido", Ind).given("s", KENNEL.puppy("fido"), 0.5)
    M = M.given("o", KENNEL.Cup, 0.5)
    assert truth(M, KENNEL.dog("fido")).p == (0.5, 1)
    assert extension(M, KENNEL.Thing).members
    assert settle(M, exist(KENNEL.Thing, KENNEL.Thing)).p == (0.5, 1)
    assert settle(M, exist(KENNEL.dog, KENNEL.dog)).p == (0.5, 1)


def test_judgements_that_an_axiom_relates_are_not_multiplied():
    M = Model(KENNEL).given("fido", Ind).given("s", KENNEL.puppy("fido"), 0.5)
    found = settle(M, every(KENNEL.dog, KENNEL.puppy)).p
    assert found.lo <= 0.5
    assert found.hi == 1
    M = Model(KENNEL).given("fido", Ind)
    M = M.given("s", KENNEL.dog("fido"), 0.5).given("s", KENNEL.cat("fido"), 0.5)
    assert settle(M, exist(KENNEL.dog, KENNEL.cat)).p.lo == 0


def test_judgements_that_are_linked_are_not_multiplied(M):
    M = M.given("bf", bark("f"), 0.5).given("bs", bark("s"), 0.5)
    M = M.given("br", bark("r"), 0.5)
    assert settle(M, every(dog, bark)).p == (0.125, 0.125)
    M = M.with_unknown_dependence(("bf", bark("f")), ("bs", bark("s")))
    found = settle(M, every(dog, bark)).p
    assert found.lo == 0
    assert found.hi >= 0.5
