"""The shared cases, by their ids."""

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Plus,
    Pred,
    Rec,
    RecType,
    SetOf,
    Str,
    Theory,
    TTRError,
    Type,
    amerge,
    check,
    fun,
    merge,
    outer,
    record,
    rectype,
    subtype,
    this,
)
from ttr.building import subtract
from ttr.computing.path_cycles import describe_cycle
from ttr.errors import IllFormedError, RefusedError
from ttr.judging import proposition
from ttr.semantics import quantifiers
from ttr.semantics.learning import Counts, posterior
from ttr.semantics.parametric_content import content, strong, weak
from ttr.semantics.quantifiers import (
    Thresholds,
    every,
    exist,
    exist_pl,
    few,
    most,
    no,
    settle,
    share,
    truth,
)
from ttr.semantics.random_variables import RandomVariable
from ttr.signature.signature import Axiom, Signature
from ttr.types import EventString, Universe

man, run, dog, boy = (Pred(name, Ind) for name in ("man", "run", "dog", "boy"))
love, hug = Pred("love", Ind, Ind), Pred("hug", Ind, Ind)
A, B, C = Basic("A"), Basic("B"), Basic("C")


@pytest.fixture
def M():
    """What every case starts from: four individuals, and e1 : man(j)."""
    M = Model().given("e1", man("j"))
    for name in "jklm":
        M = M.given(name, Ind)
    return M


HUGGING = rectype(x=Ind, c1=boy(this.x), y=Ind, c2=dog(this.y), e=hug(this.x, this.y))


def test_J01_basic_type(M):
    assert M.judge("j", Ind).holds is True
    assert M.judge("h", Ind).holds is False


def test_J02_a_witness_condition(M):
    Real = Basic("Real")
    M = M.witnessed(Real, by=lambda a: isinstance(a, float))
    assert M.judge(0.5, Real).holds is True
    assert M.judge("a", Real).holds is False


def test_J04_intensionality():
    M = Model().given("a", A).given("b", A).given("b", B).given("a", B)
    assert A is not B
    assert M.judge("a", A).holds
    assert M.judge("a", B).holds


def test_J05_meet_and_join():
    M = Model().given("a", A).given("a", B).given("b", A)
    assert M.judge("a", A & B).holds is True
    assert M.judge("b", A & B).holds is False
    assert M.judge("b", A | B).holds is True


def test_J07_singleton(M):
    assert M.judge("j", Ind @ "j").holds is True
    assert M.judge("k", Ind @ "j").holds is False
    assert M.judge("x", Ind @ "j").holds is False
    assert M.judge("x", Ind @ "x").holds is False


def test_J08_function_types(M):
    assert M.judge(fun(x=Ind)(run(this.x)), Ind >> Type).holds is True
    assert M.judge(fun(x=Ind)(this.x), Ind >> Ind).holds is True
    assert M.judge(fun(x=Ind)(this.x), Ind >> Type).holds is False


def test_J10_dependent_field(M):
    T = rectype(x=Ind, c=man(this.x))
    assert M.judge(record(x="j", c="e1"), T).holds is True
    assert M.judge(record(x="k", c="e1"), T).holds is False


def test_J11_manifest_field(M):
    T = rectype(x=Ind, y=Ind @ this.x)
    assert M.judge(record(x="j", y="j", c="e1"), T).holds is True
    assert M.judge(record(x="j", y="k"), T).holds is False


def test_J13_a_boy_hugs_a_dog(M):
    M = M.given("s1", boy("j")).given("s2", dog("k")).given("s3", hug("j", "k"))
    events = {"c1": "s1", "c2": "s2", "e": "s3"}
    assert M.judge(record(events, x="j", y="k"), HUGGING).holds is True
    assert M.judge(record(events, x="k", y="j"), HUGGING).holds is False


def test_J14_a_circle_is_checked_but_not_built(M):
    T = rectype(x=Ind @ this.y, y=Ind @ this.x)
    assert M.judge(record(x="j", y="j"), T).holds is True
    assert M.judge(record(x="j", y="k"), T).holds is False
    assert describe_cycle(T)
    with pytest.raises(RefusedError, match="field x"):
        M.create(T)


def test_J16_strings_of_events(M):
    M = M.given("a", run("j")).given("b", run("k"))
    once = Str(run("j"), run("k"))
    assert M.judge(EventString("a", "b"), once).holds is True
    assert M.judge(EventString("b", "a"), once).holds is False
    assert M.judge(EventString("a", "b", "a", "b"), Plus(once)).holds is True
    assert M.judge(EventString("a", "b", "a"), Plus(once)).holds is False


def test_J17_converse_predicates():
    left, right = Pred("left", Ind, Ind), Pred("right", Ind, Ind)
    there = Axiom(right(this.b, this.a), left(this.a, this.b))
    back = Axiom(left(this.a, this.b), right(this.b, this.a))
    M = Model(Signature(axioms=(there, back))).given("s1", right("k", "j"))
    assert M.judge("s1", left("j", "k")).holds is True
    assert M.judge("s1", left("k", "j")).holds is False
    assert M.judge("s9", left("j", "k")).holds is False


def test_J19_a_list_that_is_a_concatenation(M):
    L = ListOf(Ind)
    T = rectype(x=L, y=L, z=L @ (this.x + this.y))
    assert M.judge(record(x=["j"], y=["m"], z=["j", "m"]), T).holds is True
    assert M.judge(record(x=["j"], y=["m"], z=["m", "j"]), T).holds is False


def test_S01_width():
    assert subtype(rectype(x=Ind, y=Ind), rectype(x=Ind)).yes
    assert subtype(rectype(x=Ind), rectype(x=Ind, y=Ind)).no


def test_S03_a_nested_field_tied_to_an_outer_one():
    tied = rectype(x=rectype(x=Ind @ outer.y, e=man(this.x)), y=Ind)
    free = rectype(x=rectype(x=Ind, e=man(this.x)), y=Ind)
    assert subtype(tied, free).yes
    assert subtype(free, tied).no


def test_S04_meet_and_join():
    assert A & B <= A
    assert subtype(A, A & B).no
    assert A <= A | B
    assert subtype(A | B, A).no
    assert A & B <= A | B


def test_S06_string_types_place_by_place():
    narrow, wide = Str(rectype(x=Ind), rectype(y=Ind)), Str(Rec, Rec)
    assert subtype(narrow, wide).yes
    assert subtype(wide, narrow).no


def test_S07_dependent_fields_with_other_paths():
    common = {"x": Ind >> RecType, "y": Ind, "w": Ind}
    of_y = rectype(common, z=RecType @ this.x(this.y))
    of_w = rectype(common, z=RecType @ this.x(this.w))
    assert subtype(of_y, of_w).no
    assert subtype(of_y, rectype(z=RecType)).yes


def test_M01_disjoint():
    assert merge(rectype(a=Ind), rectype(b=Ind)) is rectype(a=Ind, b=Ind)


def test_M02_the_more_specific_field_is_kept():
    merged = merge(rectype(a=Ind, b=Ind), rectype(a=Ind @ "j"))
    assert merged is rectype(a=Ind @ "j", b=Ind)


def test_M04_the_same_path():
    merged = merge(rectype(x=Ind, e=run(this.x)), rectype(x=Ind, e=man(this.x)))
    assert merged is rectype(x=Ind, e=run(this.x) & man(this.x))


def test_M05_other_paths():
    merged = merge(rectype(x=Ind, e=run(this.x)), rectype(y=Ind, e=man(this.y)))
    assert merged is rectype(x=Ind, y=Ind, e=run(this.x) & man(this.y))


def test_M07_and_X29_a_dependent_with_a_plain_field():
    merged = merge(rectype(x=Ind, e=man(this.x)), rectype(e=man("j")))
    assert merged is rectype(x=Ind, e=man(this.x) & man("j"))
    assert merged.labels[0] == "x"


def test_A01_amerge_replaces():
    second = rectype(x=Ind, e=man(this.x))
    assert amerge(rectype(x=Ind, e=run(this.x)), second) is second


def test_A03_amerge_of_what_is_no_record_type():
    assert amerge(Ind, RecType) is RecType


def test_A05_amerge_goes_into_nested_types():
    merged = amerge(rectype(a=rectype(x=Ind, y=Ind)), rectype(a=rectype(x=Type)))
    assert merged is rectype(a=rectype(x=Type, y=Ind))


def test_F02_an_argument_outside_the_domain(M):
    with pytest.raises(RefusedError, match="takes objects of Ind, which zz is not"):
        M.apply(fun(x=Ind)(run(this.x)), "zz")


def test_V01_well_formed():
    with pytest.raises(IllFormedError, match="the path x leads nowhere"):
        rectype(x=Ind, c=rectype(c=man(this.x)))
    assert rectype(x=rectype(x=Ind, e=man(this.x)), y=Ind @ this.x.x).labels
    with pytest.raises(IllFormedError, match=r"the field e, man\(x\) needs Ind for x"):
        rectype(x=Type, e=man(this.x))


def test_P01_nothing_known():
    T = Basic("T")
    M = Model(Signature(opened=frozenset([T])))
    assert M.judge("b", T).p == (0, 1)


def test_P07_a_record():
    M = Model().given("a", Ind).given("b", Ind)
    M = M.given("s1", boy("a"), 0.9).given("s2", dog("b"), 0.95)
    M = M.given("s3", hug("a", "b"), 0.7)
    r = record(x="a", c1="s1", y="b", c2="s2", e="s3")
    assert M.judge(r, HUGGING).p == pytest.approx((0.5985, 0.5985))


def test_P09_a_missing_field(M):
    assert M.judge(record(x="a"), rectype(x=Ind, y=Ind)).p == (0, 0)
    assert M.judge(record(x="j"), rectype(x=Ind, y=Ind)).p == (0, 0)


def test_X01_lists_are_covariant():
    Dog = Basic("Dog")
    theory = Signature(axioms=(Axiom(Dog, Ind),))
    assert subtype(ListOf(Dog), ListOf(Ind), theory).yes
    assert subtype(ListOf(Dog), ListOf(Ind)).no


def test_X03_domains_are_compared_by_what_they_are(M):
    assert M.judge(fun(r=rectype(x=Ind))(man("j")), rectype(x=Ind) >> Type).holds


def test_X05_applying_a_function_changes_nothing(M):
    f = fun(r=rectype(x=Ind))(man(this.r.x))
    assert M.apply(f, record(x="j")) is man("j")
    assert M.apply(f, record(x="k")) is man("k")


def test_X07_a_singleton_of_an_unknown_object():
    assert subtype(Ind @ "zz", Ind).yes


def test_X09_asking_invents_no_witness():
    M = Model(Signature(opened=frozenset([A])))
    before = M.judge(record(x="a"), rectype(x=A)).p
    assert subtype(rectype(x=A, y=A), rectype(x=A)).yes
    assert M.judge(record(x="a"), rectype(x=A)).p == before == (0, 1)


def test_X11_the_order_of_fields():
    assert rectype({"x": Ind, "y": Ind}) is rectype({"y": Ind, "x": Ind})


def test_X13_distribution():
    assert A & (B | C) <= (A & B) | (A & C)
    assert A & (B & C) is (A & B) & C
    assert A & (B & C) <= (A & B) & C


def test_X15_plus_backtracks(M):
    M = M.given("a", run("j")).given("b", run("k"))
    pieces = Plus(Str(run("j")) | Str(run("j"), run("k")))
    assert M.judge(EventString("a", "b"), pieces).holds is True


def test_X17_a_name_is_not_identity():
    assert Basic("run(j)") is not run("j")
    assert str(Basic("run(j)")) == str(run("j"))
    assert Basic("run(j)") & run("j") is run("j") & Basic("run(j)")


def test_X19_arity():
    with pytest.raises(
        IllFormedError, match=r"run takes 1 argument \(Ind\), but has 3"
    ):
        run("j", "k", "l")


def test_X21_arrays():
    import numpy as np

    Image = Basic("Image")
    M = Model().witnessed(Image, by=lambda a: isinstance(a, np.ndarray))
    assert M.judge(np.zeros(3), Image).holds
    assert M.judge(np.ones(3), Image).holds
    assert M.judge(np.ones(3), Image).holds


def test_X23_a_meet_is_judged_in_its_model_only():
    outside = Model()
    inside = outside.given("a", A & B)
    assert inside.judge("a", A).holds is True
    assert outside.judge("a", A).holds is False


def test_X25_stratification(M):
    assert M.judge(Type, Type).holds is False


def test_X27_amerge_forgets_a_more_specific_field():
    assert amerge(rectype(x=Ind @ "j"), rectype(x=Ind)) is rectype(x=Ind)


def test_X33_negation_inside_other_types():
    M = Model().given("a", A, 0.4)
    assert M.judge("a", ~A).p == pytest.approx((0.6, 0.6))
    assert M.judge("a", A & ~A).p == pytest.approx((0, 0))
    assert M.judge("a", A | ~A).p == pytest.approx((1, 1))


@pytest.mark.parametrize("p", [-1, 1.5, "0.5", None, (0.5, 0.2), float("nan"), 10**400])
def test_X35_probabilities_out_of_range(p):
    with pytest.raises(TTRError, match=r"a : A: .* is a number in \[0, 1\]"):
        Model().given("a", A, p)


def test_T01_the_hierarchy_of_types(M):
    assert M.judge(Type, Universe("Type", 1)).holds is True
    assert M.judge(Universe("Type", 1), Universe("Type", 1)).holds is False
    assert M.judge(rectype(x=Ind), RecType).holds is True
    assert M.judge(rectype(x=RecType), RecType).holds is False


def test_T13_path_subtraction():
    T = rectype(x=Ind, y=Ind, e=hug(this.x, this.y))
    assert subtract(T, "e") is rectype(x=Ind, y=Ind)


def test_T15_merge_is_meet(M):
    S, T = rectype(x=Ind, c=man(this.x)), rectype(x=Ind, y=Ind @ this.x)
    for r in (record(x="j", c="e1", y="j"), record(x="j", c="e1", y="k"), record()):
        both = M.judge(r, S).holds and M.judge(r, T).holds
        assert M.judge(r, merge(S, T)).holds is both


def test_T17_set_types(M):
    assert M.judge({"j", "k"}, SetOf(Ind)).holds is True
    assert M.judge({"j", "zz"}, SetOf(Ind)).holds is False
    assert M.judge(set(), SetOf(Ind)).holds is True


def test_I01_the_game_of_fetch_one_step(M):
    throw, pick_up = Pred("throw", Ind, Ind), Pred("pick_up", Ind, Ind)
    picked, thrown = rectype(e=pick_up("h", "s")), rectype(e=throw("h", "s"))

    def agenda(*moves):
        return rectype(agenda=ListOf(RecType) @ list(moves))

    u1 = fun(r=agenda())(agenda(picked))
    u2 = fun(r=agenda(picked))(fun(e=picked)(agenda(thrown)))
    M = M.given("ev", pick_up("h", "s"))
    assert M.apply(u1, record(agenda=[])) is agenda(picked)
    waiting = M.apply(u2, record(agenda=[picked]))
    assert M.apply(waiting, record(e="ev")) is agenda(thrown)
    with pytest.raises(RefusedError, match="in the field agenda"):
        M.apply(u2, record(agenda=[]))


def test_D01_turn_change_then_greeting():
    greet = Pred("greet", Ind, Ind)
    pair = {"spkr": Ind, "addr": Ind}
    none_yet = ListOf(Type) @ []
    board = rectype(spkr=Ind @ "a", addr=Ind @ "b", moves=none_yet)
    turn = fun(r=rectype(pair))(
        rectype(spkr=Ind @ outer.r.addr, addr=Ind @ outer.r.spkr)
    )
    move = fun(r=rectype(pair, moves=none_yet))(
        rectype(moves=ListOf(Type) @ [greet(outer.r.spkr, outer.r.addr)])
    )
    r, M = Model().create(board)
    turned = amerge(board, M.apply(turn, r))
    assert turned is rectype(spkr=Ind @ "b", addr=Ind @ "a", moves=none_yet)
    r, M = M.create(turned)
    greeted = amerge(turned, M.apply(move, r))
    assert str(greeted) == (
        "[addr = a : Ind, moves = [greet(b, a)] : list(Type), spkr = b : Ind]"
    )
    r, M = M.create(greeted)
    assert M.judge(r, greeted).holds


# --- probability ---------------------------------------------------------------------


def holds(text):
    """Whether a theory's checks hold, over open types A, B and S, T, L, R."""
    theory = Theory.parse(f"basic A, B, S, T, L, R\nopen A, B, S, T, L, R\n{text}")
    return check(theory).holds


def test_P03_an_unrelated_condition():
    text = "given a : T = 0.6\nobject b : S\ncheck P(a : T | b : S) = 0.6"
    assert holds(text)


def test_P05_a_conjunction_with_a_conditional():
    assert holds("""
        given a : L = 0.6
        given P(a : R | a : L) in [0.7, 0.8]
        check P(a : L /\\ R) = [0.42, 0.48]
    """)


def test_P11_values_exclude_each_other():
    A1, A2, A3 = Basic("A1"), Basic("A2"), Basic("A3")
    M = Model().given("a", A1, 0.3).given("a", A2, 0.3).given("a", A3, 0.4)
    V = RandomVariable("V", A1, A2, A3)
    assert V.judge(M, "a", A1 & A2).p == (0, 0)
    assert V.judge(M, "a", A1, when=[("a", A2)]).p == (0, 0)
    assert M.judge("a", A1 & A2).p == pytest.approx((0.09, 0.09))


def test_P13_an_interval_where_cases_differ():
    ages = {"Child": 0.1, "Young": 0.05, "Middle": 0.3, "Old": 0.6}
    Flu, Ill = Basic("Flu"), Basic("Ill")
    M = Model()
    for age, p in ages.items():
        M = M.with_conditional(Ill, p, when=[Flu, Basic(age)])
    for number in range(10):
        age = list(ages)[number % 4]
        M = M.given(f"p{number}", Basic(age)).given(f"p{number}", Flu)
    assert M.chance(Ill, when=Flu).p == (0.05, 0.6)


def test_X31_a_normalised_interval():
    A, B = Basic("A"), Basic("B")
    M = Model().given("a", A, (0.2, 0.4)).given("a", B, (0.1, 0.3))
    V = RandomVariable("V", A, B)
    assert V.judge(M, "a", A).p == pytest.approx((0.4, 0.8))


# --- learning from judgements --------------------------------------------------------


def test_T05_a_frequency_over_judgements():
    Dog, Bark = Basic("Dog"), Basic("Bark")
    J = Counts().learned(*(proposition(name, Dog & Bark) for name in ("f", "s")))
    J = J.learned(proposition("r", Dog), proposition("the fourth", Ind))
    assert J.p(Bark, given=Dog) == pytest.approx((0.6667, 0.6667), abs=5e-5)


def test_T09_naive_bayes():
    Apple, Pear = Basic("Apple"), Basic("Pear")
    Red, Round = Basic("Red"), Basic("Round")
    apples = [Apple & Red & Round] * 4 + [Apple & Red, Apple & Round]
    pears = [Pear & Red, Pear & Round, Pear, Pear]
    J = Counts().learned(
        *(proposition(f"o{n}", T) for n, T in enumerate([*apples, *pears]))
    )
    found = posterior(J, [Apple, Pear], [Red, Round])
    assert found[Apple] == pytest.approx((0.9434, 0.9434), abs=5e-5)


# --- cases of later parts of the theory ----------------------------------------------


def test_T07_the_perceptual_meaning_of_right():
    from ttr.semantics.perceptual import Perceptron, RealVector, meaning

    right = Pred("right", Ind)
    bg = rectype(foo=Ind, spkr=Ind, pos=RealVector)
    interp = fun(r=bg)(rectype(c=right(outer.r.foo)))
    params = record(w=[0.800, 0.010], t=0.090)
    to_the_right = meaning(interp, Perceptron(), params, of="pos")
    situation = record(foo="o1", spkr="a", pos=(0.9, 0.1))
    assert to_the_right.score(situation) == pytest.approx(0.721)
    assert to_the_right.classify(situation) is right("o1")


# --- quantifiers ---------------------------------------------------------------------


def test_T03_quantifier_witness_sets():
    bark = Pred("bark", Ind)
    M = Model()
    for name in "frsk":
        M = M.given(name, Ind)
    for name in "frs":
        M = M.given(f"d{name}", dog(name))
    M = M.given("bf", bark("f")).given("bs", bark("s"))
    agent = Thresholds(
        most=share("at least", 0.5), few=quantifiers.number("at most", 1)
    )
    asked = (exist, exist_pl, every, no, most, few)
    answers = [settle(M, q(dog, bark), agent).holds for q in asked]
    assert answers == [True, True, False, False, True, False]


def test_T11_a_donkey_sentence():
    donkey, own = Pred("donkey", Ind), Pred("own", Ind, Ind)
    beat = Pred("beat", Ind, Ind)
    M = Model().given("f1", Ind).given("b1", beat("f1", "d1"))
    for name in ("d1", "d2"):
        M = M.given(name, Ind).given(f"c{name}", donkey(name))
        M = M.given(f"o{name}", own("f1", name))
    owned = rectype(y=Ind, c=donkey(this.y), o=own("f1", this.y))
    beats = content(owned, fun(r=owned)(beat("f1", this.r.y)))
    assert truth(M, weak(beats)).p == (1, 1)
    assert truth(M, strong(beats)).p == (0, 0)
