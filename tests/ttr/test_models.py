"""Models: telling, judging, and what axioms and witness functions add."""

import gc

import numpy as np
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
    Str,
    Theory,
    TTRError,
    Type,
    fun,
    meet,
    outer,
    record,
    rectype,
    this,
)
from ttr.errors import IllFormedError, RefusedError, UndecidedError, UnsupportedError
from ttr.judging.assignments import Assignment
from ttr.judging.certainty import is_certain
from ttr.judging.creation import create_witness
from ttr.judging.witnesses import candidates, listed_type, some_witnesses
from ttr.probability import Degree
from ttr.signature.signature import Axiom, Expected, Given, Signature
from ttr.types import Application, EventString, FunType, NonEmpty, TypeAt, fst
from ttr.types.derived_types import star

A, B, C = Basic("A"), Basic("B"), Basic("C")
p = Pred("p", A)
dog, puppy, hug = Pred("dog", Ind), Pred("puppy", Ind), Pred("hug", Ind, Ind)
left, right = Pred("left", Ind, Ind), Pred("right", Ind, Ind)

Dog = rectype(x=Ind, c=dog(this.x))
PUPPIES = Signature(axioms=(Axiom(puppy(this.x), dog(this.x)),))
SIDES = Signature(
    axioms=(
        Axiom(right(this.x, this.y), left(this.y, this.x)),
        Axiom(left(this.x, this.y), right(this.y, this.x)),
    )
)


def test_a_record_is_taken_apart():
    T = rectype(x=Ind, n=rectype(c=hug(outer.x, this.y), y=Ind), l=ListOf(Ind @ "j"))
    r = record(x="a", n={"c": "s", "y": "b"}, l=["j", "j"])
    M = Model().given(r, T)
    for sit, atom in [("a", Ind), ("b", Ind), ("s", hug("a", "b")), ("j", Ind)]:
        assert M.judge(sit, atom).holds is True
    assert M.judge(r, T).holds is True


def test_a_dictionary_is_a_record_and_a_list_a_tuple():
    M = Model().given({"x": "a"}, rectype(x=Ind)).given(["b"], ListOf(Ind))
    assert M.judge({"x": "a"}, rectype(x=Ind)).sit == record(x="a")
    assert M.judge(("b", "a"), ListOf(Ind)).holds is True


def test_a_situation_of_a_ptype_may_be_a_record():
    hugging = record(who="a", whom="b")
    M = Model().given(hugging, hug("a", "b"))
    assert M.judge(hugging, hug("a", "b")).holds is True
    assert M.judge(record(who="a", whom="c"), hug("a", "b")).holds is False
    assert M.witnesses(hug("a", "b")) == (hugging,)


def test_a_record_has_every_label_and_there_what_is_of_its_type():
    M, T = Model().given("a", A), rectype(x=A, y=A)
    assert M.judge(record(x="a", y="a", z="b"), T).holds is True
    assert M.judge(record(x="a"), T).holds is False
    assert M.judge(record(x="a", y="b"), T).holds is False


def test_something_may_be_of_a_type_whose_witnesses_cannot_be_listed():
    """In a closed model b is not of p("a"), so {w = a, g = b} is a witness."""
    M = Model().given("a", A).given("b", B)
    assert M.true(rectype(w=A, g=~p(this.w))) == (1, 1)
    assert M.true(rectype(w=A, n=rectype(g=~p(outer.w), l=ListOf(A)))) == (1, 1)
    assert M.true(rectype(w=A, g=~p(this.w) & A)) == (1, 1)


def test_nothing_is_of_what_contradicts_itself_however_it_is_written():
    assert Model().true(~(A | ~A)) == (0, 0)
    assert Model().given("a", A).true(rectype(x=A, y=~(B | ~B))) == (0, 0)


def test_each_element_of_a_list_is_of_its_type():
    M = Model().given("a", A)
    assert M.judge((), ListOf(A)).holds is True
    assert M.judge(("a", "a"), ListOf(A)).holds is True
    assert M.judge(("a", "b"), ListOf(A)).holds is False
    assert M.judge((), NonEmpty(A)).holds is False
    assert M.judge("a", ListOf(A)).holds is False


def test_a_string_has_as_many_events_as_its_type():
    M = Model().given("a", A).given("b", B)
    assert M.judge(EventString("a", "b"), Str(A, B)).holds is True
    for other in (EventString("a"), EventString("a", "b", "b"), EventString("b", "a")):
        assert M.judge(other, Str(A, B)).holds is False
    assert M.judge(EventString(), Plus(A)).holds is False
    assert M.judge(EventString(), star(A)).holds is True


def test_a_function_is_defined_for_all_of_its_domain():
    same = fun(r=Dog)(this.r)
    Thing = rectype(x=Ind)
    assert Model().judge(same, Dog >> Thing).holds is True
    assert Model().judge(same, Thing >> Thing).holds is False
    assert Model().judge(fun(r=Thing)(this.r), Dog >> Thing).holds is True


def test_every_record_and_nothing_else_is_of_rec():
    M = Model().given("a", A)
    for r in (record(), record(x="a"), record(x=record(y="nobody"))):
        assert M.judge(r, Rec).holds is True
    for other in ("a", (), A, 1):
        assert M.judge(other, Rec).holds is False


@pytest.mark.parametrize(
    ("sit", "T", "message"),
    [
        (record(x="a"), Dog, "{x = a} : [x : Ind, c : dog(x)] cannot be given: there"),
        ("a", Dog, "a : [x : Ind, c : dog(x)] cannot be given: it is no record"),
        ("a", ListOf(Ind), "a : list(Ind) cannot be given: it is no list"),
        ("a", Ind @ "b", "a : Ind@b cannot be given: it is another object"),
        ("a", Type, "a : Type cannot be given: it is no type"),
        (Type, Type, "Type : Type cannot be given: it is of level 1"),
        (Ind, RecType, "Ind : RecType cannot be given: it is no record type"),
        (
            record(x="a", n={"c": "s"}),
            rectype(x=Ind, n=rectype(c=dog(outer.x)) & rectype(d=dog("a"))),
            "cannot be given: there is no d",
        ),
    ],
)
def test_what_cannot_be_given(sit, T, message):
    with pytest.raises(RefusedError) as caught:
        Model().given(sit, T)
    assert message in str(caught.value)


def test_what_a_model_takes():
    M = Model()
    with pytest.raises(
        IllFormedError, match="expected a type, found the predicate dog"
    ):
        M.given("s", dog)
    with pytest.raises(IllFormedError, match="expected a type, found the object 'Ind'"):
        M.judge("s", "Ind")
    with pytest.raises(IllFormedError, match=r"dog\(\.x\) has paths that lead nowhere"):
        M.judge("s", dog(this.x))
    with pytest.raises(
        IllFormedError, match=r"\{x = \.y\} has paths that lead nowhere"
    ):
        M.given(record(x=this.y), rectype(x=Ind))
    with pytest.raises(IllFormedError, match="paths that lead nowhere"):
        M.create(rectype(c=dog(outer.x)))
    with pytest.raises(IllFormedError, match="paths that lead nowhere"):
        M.with_conditional(dog(this.x), 0.5, when=Ind)
    with pytest.raises(IllFormedError, match="paths that lead nowhere"):
        M.with_conditional(Ind, 0.5, when=dog(this.x))
    with pytest.raises(
        UnsupportedError, match="only basic types and ptypes take a degree"
    ):
        M.given("a", A & B, 0.5)
    with pytest.raises(TTRError, match="a model is of a theory, found 3"):
        Model(3)
    with pytest.raises(TTRError, match="for a basic type or a predicate, found dog"):
        M.witnessed(dog("a"), by=bool)
    with pytest.raises(TTRError, match="witness function of Ind is a Python function"):
        M.witnessed(Ind, by=0.5)


def test_open_and_closed():
    M = Model(Signature(opened=frozenset([A, dog])))
    assert M.judge("a", A).p == M.judge("s", dog("a")).p == (0, 1)
    assert M.judge("a", B).p == (0, 0)
    M = M.given("a", B, 0.5)
    assert M.judge("b", B).p == (0, 1)
    M = Model().given("a", B, 0).given("b", B, 1)
    assert M.judge("c", B).p == (0, 0)
    with pytest.raises(UndecidedError, match="neither certain nor refuted"):
        _ = Model(Signature(opened=frozenset([A]))).judge("a", A).holds


def test_a_theory_gives_what_it_starts_from():
    theory = Signature(givens=(Given("a", Ind), Given("s", dog("a"), (0.2, 0.4))))
    M = Model(theory)
    assert M.theory is theory
    assert M.judge(record(x="a", c="s"), Dog).p == (0.2, 0.4)


@pytest.mark.parametrize(
    ("givens", "why"),
    [
        ([Given("a", A, 0.2), Given("a", A)], "a : A is given as 0.2 and as 1 here"),
        (
            [Given(record(x="a"), rectype(x=A)), Given("b", B), Given("a", A, 0.2)],
            "a : A is given as 1 and as 0.2 here",
        ),
        (
            [Given("a", A), *[Given("b", B, p, when=(("a", A),)) for p in (0.5, 0.6)]],
            "P(b : B | a : A) is given as 0.5 and as 0.6 here",
        ),
        (
            [Expected(B, (A, C), p) for p in (0.5, (0.5, 0.6))],
            "P(B || A, C) is given as 0.5 and as [0.5, 0.6] here",
        ),
    ],
)
def test_a_theory_gives_no_judgement_two_degrees(givens, why):
    with pytest.raises(RefusedError) as error:
        Model(Signature(givens=tuple(givens)))
    assert error.value.message == why
    once = tuple(givens[:-1])
    assert Model(Signature(givens=once + once)).facts.replaced is None


def test_what_was_said_last_counts():
    M = Model().given("a", A, 0.3).given("a", A, (0.4, 0.6)).given("a", A)
    assert M.judge("a", A).p == (1, 1)
    assert M.given("a", A) is M
    assert M.given(("a", "a"), ListOf(A)) is M


def test_each_fact_is_counted_once():
    M = Model().given("a", A).given("b", A, 0.5).given("b", A, 0.5).given("b", A, 0.6)
    assert Model().facts.facts == 0
    assert M.facts.facts == 3


def test_arrays_are_kept_apart():
    M = Model()
    for _ in range(50):
        M = M.given(np.zeros(3), A)
    gc.collect()
    assert not any(M.judge(np.zeros(3), A).holds for _ in range(200))
    a = np.ones(2)
    M = M.given(a, A).given([a], ListOf(A))
    assert M.judge(a, A).holds is True
    assert M.judge([a], ListOf(A @ a)).holds is True
    assert M.judge({"x": a}, rectype(x=A)) == M.judge({"x": a}, rectype(x=A))


def test_objects_of_other_classes():
    M = Model().given(1, A)
    assert [M.judge(a, A).holds for a in (1, True, 1.0, "1", (1,))] == [
        True,
        False,
        False,
        False,
        False,
    ]


def test_a_declared_subtype():
    M = Model(PUPPIES).given("s", puppy("rex"), 0.7)
    j = M.judge("s", dog("rex"))
    assert j.p == (0.7, 1)
    assert j.why.rule == "by puppy(x) <: dog(x) and s : puppy(rex)"
    assert M.judge("s", puppy("fido")).p == M.judge("s", dog("fido")).p == (0, 1)
    assert M.judge("s", dog("rex") & puppy("rex")).p == (0.7, 0.7)


def test_what_says_the_same_is_one_event():
    M = Model(SIDES).given("s", right("a", "b"), 0.6)
    assert M.judge("s", left("b", "a")).p == (0.6, 0.6)
    assert M.judge("s", left("b", "a") & right("a", "b")).p == (0.6, 0.6)
    T = rectype(c=left("b", "a"), d=right("a", "b"))
    assert M.judge(record(c="s", d="s"), T).p == (0.6, 0.6)
    assert M.given("t", right("a", "b"), 0.5).judge(
        record(c="s", d="t"), T
    ).p == pytest.approx((0.3, 0.3))


def test_a_bound_from_above():
    M = Model(PUPPIES).given("s", dog("rex"), (0.1, 0.4)).given("t", puppy("rex"), 0.2)
    assert M.judge("s", puppy("rex")).p == (0, 0.4)
    M = M.given("s", puppy("rex"), (0.05, 0.4))
    assert M.judge("s", dog("rex")).p == (0.1, 0.4)
    assert M.judge("s", puppy("rex") & dog("rex")).p == (0.05, 0.4)


def test_a_model_refuses_what_an_axiom_contradicts():
    M = Model(PUPPIES).given("s", dog("rex"), 0)
    with pytest.raises(
        RefusedError,
        match=r"s : puppy\(rex\) cannot have the probability 1: by puppy\(x\) <: dog",
    ):
        M.given("s", puppy("rex"))
    M = Model(PUPPIES).given("s", puppy("rex"))
    with pytest.raises(
        RefusedError, match=r"by puppy\(x\) <: dog\(x\) and s : puppy\(rex\)"
    ):
        M.given("s", dog("rex"), (0, 0.5))


def test_the_reason_does_not_depend_on_addresses():
    p, q = Pred("p", Ind), Pred("q", Ind, Ind)
    theory = Signature(axioms=(Axiom(q(this.x, this.y), p(this.x)),))
    M = Model(theory)
    for name in "edcba":
        M = M.given("s", q("j", name))
    assert M.judge("s", p("j")).why.rule == "by q(x, y) <: p(x) and s : q(j, a)"


# --- witness functions ----------------------------------------------------------------


def test_a_witness_function_of_a_basic_type():
    M = Model().witnessed(A, by=lambda a: a == "a")
    assert M.judge("a", A).holds is True
    assert M.judge("b", A).holds is False
    assert M.judge("a", A).why.rule == "by the witness function of A"
    with pytest.raises(
        RefusedError, match="b : A is refused by the witness function of A"
    ):
        M.given("b", A)
    assert M.given("b", A, 0).judge("b", A).holds is False


def test_a_witness_function_rules_over_declared_subtypes():
    M = Model(Signature(axioms=(Axiom(A, B),))).witnessed(B, by=lambda b: False)
    with pytest.raises(
        RefusedError, match="b : A is refused by the witness function of B"
    ):
        M.given("b", A)


def test_the_word_of_the_tutor_outweighs_a_degree():
    M = Model().witnessed(dog, by=lambda x: 0.1).given("s", dog("a"))
    assert M.judge("s", dog("a")).holds is True


def test_what_is_said_of_what_is_above_outweighs_a_witness_function_of_it():
    theory = Theory.parse("basic Animal, Dog\nDog <: Animal")
    seen = Model(theory).witnessed(theory.Animal, by=lambda x: (0.1, 0.3))
    assert seen.given("a", theory.Dog, (0, 0.9)).judge("a", theory.Dog).p == (0, 0.3)
    told = seen.given("a", theory.Animal).given("a", theory.Dog, (0, 0.9))
    assert told.judge("a", theory.Dog).p == (0, 0.9)


@pytest.mark.parametrize("p", [0, (0, 0.5)])
def test_what_a_witness_function_refuses_may_be_said_not_to_be(p):
    A = Basic("A")
    refusing = Model().witnessed(A, by=lambda x: False)
    assert refusing.given("a", A, p).judge("a", A).p.lo == 0
    with pytest.raises(RefusedError, match="refused by the witness function of A"):
        refusing.given("a", A, (0.1, 0.5))


@pytest.mark.parametrize(
    ("sit", "T"),
    [("a", ~rectype(x=Ind)), ("a", ~ListOf(Ind)), (record(x="b"), ~rectype(x=Ind))],
)
def test_what_is_certainly_not_of_a_type_may_be_denied_of_it(sit, T):
    assert Model().given(sit, T).judge(sit, T).holds


def test_what_is_denied_of_a_join_is_denied_of_its_parts():
    M = Model().given("a", ~(A | B)).given("b", ~~A)
    assert M.facts.told_degree("a", A) == M.facts.told_degree("a", B) == (0, 0)
    assert M.judge("b", A).holds is True


def test_only_atoms_are_denied_of_what_may_be_of_them():
    known = Model().given("b", Ind)
    with pytest.raises(RefusedError, match="cannot be given: only of atoms"):
        known.given(record(x="b"), ~rectype(x=Ind))


def test_elements_of_a_list_that_is_created_are_of_their_type():
    made, known = Model().create(rectype(l=ListOf(Ind) @ ["new"]))
    assert made == record(l=["new"])
    assert known.judge("new", Ind).holds


@pytest.mark.parametrize(
    ("result", "shown"),
    [
        (Ind, r"\x:Ind. a1"),
        (Basic("B"), r"\x:Ind. a1"),
        (Basic("B") @ "b", r"\x:Ind. b"),
        (RecType, r"\x:Ind. Rec"),
        (rectype(y=Ind), r"\x:Ind. {y = a1}"),
        (FunType(Ind, Ind), r"\x:Ind. \y:Ind. a1"),
    ],
)
def test_a_function_that_is_created_is_constant(result, shown):
    T = FunType(Ind, result)
    made, known = Model().create(T)
    assert str(made) == shown
    assert known.judge(made, T).holds


@pytest.mark.parametrize(
    ("T", "p"),
    [
        (NonEmpty(ListOf(~Ind)), (1, 1)),
        (NonEmpty(FunType(Ind, Ind)), (0, 1)),
        (Plus(ListOf(~Ind)), (1, 1)),
    ],
)
def test_something_is_of_a_list_where_something_is_of_its_elements(T, p):
    assert Model().given("c", Ind).true(T) == p


def test_judging_asks_no_function_of_a_predicate():
    asked = []
    M = Model().witnessed(dog, by=asked.append)
    assert M.judge("s", dog("a")).p == (0, 1)
    assert asked == []


@pytest.mark.parametrize(
    ("answer", "p"),
    [(True, (1, 1)), (0, (0, 0)), (0.25, (0.25, 0.25)), ((0.1, 0.2), (0.1, 0.2))],
)
def test_answers_of_witness_functions(answer, p):
    assert Model().witnessed(A, by=lambda a: answer).judge("a", A).p == p
    assert Model().witnessed(A, by=lambda a: np.float64(0.5)).judge("a", A).p[0] == 0.5


def test_faults_of_witness_functions():
    M = Model().witnessed(A, by=lambda a: a.missing)
    with pytest.raises(TTRError, match=r"function of A\(a\) failed: AttributeError"):
        M.judge("a", A)
    M = Model().witnessed(A, by=lambda a: "yes")
    with pytest.raises(TTRError, match=r"of A\(<ndarray 3>\): the answer is a number"):
        M.judge(np.zeros(3), A)


# --- perceiving -----------------------------------------------------------------------

Image = Basic("Image")
cup = Pred("cup", Ind, Image)
Cup = rectype(x=Ind, img=Image, c=cup(this.x, this.img))


@pytest.fixture
def seeing():
    degrees = {"frame7": 0.8, "frame8": (0.1, 0.3), "frame9": 0}
    M = Model().witnessed(cup, by=lambda x, img: degrees[img])
    M = M.given("o1", Ind)
    for image in degrees:
        M = M.given(image, Image)
    return M


@pytest.mark.parametrize(
    ("image", "p"), [("frame7", (0.8, 0.8)), ("frame8", (0.1, 0.3)), ("frame9", (0, 0))]
)
def test_perceiving_fills_what_is_missing(seeing, image, p):
    r = record(x="o1", img=image)
    assert seeing.judge(r, Cup).holds is False
    j = seeing.perceive(r, Cup)
    assert j.sit == record(x="o1", img=image, c="e1")
    assert j.p == p
    assert j.model.judge("e1", cup("o1", image)).p == p
    assert j.model.judge(j.sit, Cup).p == p
    assert seeing.judge("e1", cup("o1", image)).p == (0, 1)


def test_perceiving_fills_what_is_missing_in_a_record_inside(seeing):
    M = seeing.witnessed(dog, by=lambda x: 0.5)
    T = rectype(x=Ind, n=rectype(y=Ind, c=dog(this.y)))
    j = M.perceive(record(x="o1", n={"y": "o1"}), T)
    assert j.sit == record(x="o1", n={"y": "o1", "c": "e1"})
    assert j.p == (0.5, 0.5)


def test_perceiving_in_nested_types_and_meets(seeing):
    M = seeing.witnessed(dog, by=lambda x: 0.5)
    T = rectype(x=Ind, n=rectype(c=dog(outer.x)), m=rectype(y=Ind))
    j = M.perceive(record(x="o1"), T & rectype(d=dog("o1") & cup("o1", "frame7")))
    assert j.sit == record(x="o1", n={"c": "e2"}, d="e1")
    assert j.p == (0, 0)
    assert j.why.path() == "m"
    j = M.perceive({"x": "o1", "m": {"y": "o1"}}, T)
    assert j.p == (0.5, 0.5)


def test_what_is_there_is_not_looked_for(seeing):
    r = record(x="o1", img="frame7", c="s")
    j = seeing.perceive(r, Cup)
    assert j.sit == r
    assert j.p == (0, 1)


def test_what_cannot_be_perceived(seeing):
    assert seeing.perceive("o1", Ind).holds is True
    assert seeing.perceive(record(img="frame7"), Cup).sit == record(img="frame7")
    assert seeing.perceive(record(), rectype(x=Ind)).p == (0, 0)


# --- creating -------------------------------------------------------------------------


def test_a_created_name_is_new():
    M = Model().given("a1", Ind).given("s", hug("a2", "a3")).given(["a4"], ListOf(Ind))
    a, M = M.create(Ind)
    assert a == "a5"
    b, M = M.create(Ind)
    assert b == "a6"
    s, M = M.create(dog(a))
    assert s == "s7"
    assert M.judge(record(x=a, c=s), Dog).holds


def test_creating_what_has_a_form():
    M = Model()
    assert M.create(ListOf(A))[0] == ()
    assert M.create(ListOf(A) & ListOf(B) & C)[0] == ()
    assert M.create(RecType)[0] is Rec
    assert M.create(Ind @ "j")[0] == "j"
    assert M.create(A & B @ "j")[0] == "j"
    r, after = M.create(rectype(x=A) & rectype(x=B, y=C @ this.x) & A)
    assert r.x == r.y
    for T in (A & B & C,):
        assert after.judge(r.x, T).holds
    assert after.judge(r, A).holds


@pytest.mark.parametrize(
    "T",
    [
        A @ "a" & B @ "b",
        ListOf(A) & Rec,
        ListOf(A) @ "a",
        Type @ Type,
        rectype(c=dog("a") @ this.d, d=dog("a") @ this.c),
        rectype(x=A @ {"y": this.x}),
    ],
)
def test_what_cannot_be_created(T):
    with pytest.raises(RefusedError):
        Model().create(T)


def test_a_witness_function_may_refuse_what_is_made_up():
    M = Model().witnessed(A, by=lambda a: isinstance(a, float))
    with pytest.raises(RefusedError, match="refused by the witness function of A"):
        M.create(A)
    assert M.create(A @ 0.5)[0] == 0.5


# --- size -----------------------------------------------------------------------------


def test_wide_types():
    n = 5000
    fields = {f"x{i}": Ind for i in range(n // 2)}
    events = {f"c{i}": dog(this[f"x{i}"]) for i in range(n // 2)}
    T = rectype({**fields, **events})
    r, M = Model().create(T)
    assert M.judge(r, T).holds
    assert Model().given(r, T).judge(r, T).holds


def test_long_lists():
    names = [f"a{i}" for i in range(100_000)]
    M = Model().given("a", A, 0.5)
    assert M.judge(["a"] * 100_000, ListOf(A)).p == (0.5, 0.5)
    failed = Model().judge(names, ListOf(A)).why
    assert failed.failure().sit == "a0"


def test_what_nests_too_deep_is_said_so():
    r, T = record(), Rec
    for _ in range(3000):
        r, T = record(n=r), rectype(n=T)
    with pytest.raises(UnsupportedError, match="nests deeper than can be followed"):
        Model().judge(r, T)


def test_degrees_are_intervals():
    assert Model().given("a", A, [0.25, 0.5]).judge("a", A).p == Degree(0.25, 0.5)


NOT_SURELY = {
    "what is known speaks against it": (fun(x=A)(this.x), A >> ~B),
    "one part of a join": (fun(x=A | B)(this.x), (A | B) >> A),
    "the first of a list that may be empty": (
        fun(x=ListOf(A))(fst(this.x)),
        ListOf(A) >> A,
    ),
    "a list that may be empty": (fun(x=ListOf(A))(this.x), ListOf(A) >> NonEmpty(A)),
    "a name that may be given to a fresh object": (fun(x=A)(this.x), A >> (A @ "a1")),
    "an object that nobody knows": (fun(x=A)("nobody"), A >> B),
}


@pytest.mark.parametrize("name", NOT_SURELY)
def test_a_function_that_is_not_surely_of_a_type(name):
    M = Model().given("a", A).given("a", B)
    f, T = NOT_SURELY[name]
    assert M.judge(f, T).p.lo == 0


OF_FIDO = fun(y=dog("fido"))
NO_VALUES = {
    "in an argument": (dog(Application(OF_FIDO(this.y), "a")), "takes objects of"),
    "as a type": (Application(OF_FIDO(A), "a"), "takes objects of dog(fido)"),
    "as a value": (Ind @ Application(OF_FIDO(this.y), "a"), "takes objects of"),
    "an object": (Application(fun(x=Ind)(this.x), "a"), "a is no type"),
    "no function": (Application("f", "a"), 'f is no function, so "f"(a) is nothing'),
    "a name": (TypeAt("a"), "a is no type"),
    "of what has no value": (
        Application(Application(OF_FIDO(fun(x=Ind)(A)), "a"), "a"),
        "takes objects of dog(fido)",
    ),
}


@pytest.mark.parametrize("name", NO_VALUES)
def test_nothing_is_of_what_has_no_value(name):
    T, why = NO_VALUES[name]
    M = Model().given("a", Ind).given("s", dog("a"))
    for sit in ("a", "s"):
        j = M.judge(sit, T)
        assert j.holds is False
        assert why in j.why.rule
        assert M.judge(record(x=sit), rectype(x=T)).holds is False
        assert M.judge(sit, T | Ind | dog("a")).holds is True
    assert M.witnesses(T) == ()


@pytest.mark.parametrize("name", NO_VALUES)
def test_nothing_can_be_made_of_what_has_no_value(name):
    T, _ = NO_VALUES[name]
    M = Model().given("a", Ind)
    for ask in (lambda: M.given("a", T), lambda: M.create(T)):
        with pytest.raises(
            RefusedError, match=r"takes objects|is no type|is no function"
        ):
            ask()


def test_what_has_no_value_is_not_denied_in_vain():
    T, _ = NO_VALUES["in an argument"]
    M = Model().given("a", Ind)
    assert M.given("s", ~T) is M
    with pytest.raises(RefusedError, match="takes objects of"):
        M.given("s", T, 0.5)


def test_facts_are_about_what_the_arguments_of_a_type_come_to():
    """The facts alone say that e is of dog(fido): without them nothing is computed."""
    T = dog(Application(OF_FIDO("a"), "e"))
    M = Model().given("e", dog("fido")).given("a", Ind).given("s", dog("a"))
    assert M.witnesses(T) == ("s",)
    assert M.true(T) == (1, 1)
    assert M.given("t", T).judge("t", T & dog("a")).holds is True
    assert M.given("t", T, 0.5).judge("t", T & dog("a")).p == (0.5, 0.5)
    assert M.given(record(c="t"), rectype(c=T)).judge("t", dog("a")).holds is True
    assert M.given("t", ~T).facts.told_degree("t", dog("a")) == (0, 0)
    made, after = M.create(rectype(c=T))
    assert after.judge(made, rectype(c=T)).holds is True


def test_a_function_may_give_a_function_that_gives_a_type():
    f = OF_FIDO(fun(x=Ind)(dog(this.x)))
    M = Model().given("e", dog("fido")).given("a", Ind).given("s", dog("a"))
    T = Application(Application(f, "e"), "a")
    assert M.judge("s", T).holds is True
    assert M.judge("e", T).holds is False
    assert M.witnesses(T) == ("s",)


def test_something_is_made_of_a_type_with_very_many_cases():
    T = meet(*[Basic(f"P{n}") | Basic(f"Q{n}") for n in range(9)])
    made, M = Model().create(T)
    assert M.judge(made, T).holds is True


def test_a_string_of_events_that_cannot_be_is_not_made():
    with pytest.raises(RefusedError, match="Type : Type cannot be given"):
        Model().create(Str(A, Type @ Type))


def test_whether_something_is_on_a_circle_is_left_open():
    M = Model().given("a", Ind)
    circle = rectype(x=Ind @ this.y, y=Ind @ this.x)
    assert M.true(circle) == (0, 1)
    assert (
        list(some_witnesses(M.facts, rectype(x=Ind @ this.y, y=Ind @ this.x, z=~Ind)))
        == []
    )


def test_what_can_be_listed_of_a_type_bounds_how_probable_something_of_it_is():
    M = Model().given("a", Ind).given("s", dog("a"), 0.5).given("n", A, 0)
    assert M.true(rectype(x=Ind, c=dog(this.x), z=~Ind)) == (0.5, 1)
    assert M.true(NonEmpty(A)) == M.true(Plus(A)) == M.true(ListOf(B) & A) == (0, 0)
    listed = [
        NonEmpty(A),
        Plus(A),
        A & ListOf(B),
        rectype(x=Ind, c=dog(this.x), z=~Ind),
    ]
    assert list(map(listed_type, listed)) == [A, A, A, Dog]
    assert listed_type(NonEmpty(~A)) is listed_type(ListOf(A) & ~B) is None


def test_a_function_is_of_no_type_where_it_has_no_value():
    bark = fun(x=Ind)(Application(fun(y=dog("fido"))(this.y), this.x))
    j = Model().given("a", Ind).judge(bark, Ind >> Ind)
    assert j.holds is False
    assert j.why.rule == "applied to a"
    assert [part.p for part in j.why.parts] == [(1, 1), (0, 0)]
    assert j.why.failure().rule.endswith(
        "takes objects of dog(fido), which a is not: nothing says so; a is of Ind"
    )


def test_the_witnesses_of_what_a_function_gives_where_the_facts_say_it_is_defined():
    of_fido = fun(y=dog("fido"))(A)
    M = Model().given("s", dog("fido")).given("a", A)
    assert M.witnesses(Application(of_fido, "s")) == ("a",)
    assert M.witnesses(Application(of_fido, "a")) == ()


def test_a_function_of_what_is_known():
    M = Model().given("a", A).given("j", B)
    assert M.judge(fun(x=A)("j"), A >> B).holds
    assert M.judge(fun(x=A)([this.x, "a"]), A >> ListOf(A)).holds
    assert M.judge(fun(x=Rec)(this.x), (Rec & Plus(A)) >> Rec).holds


def test_what_cannot_be_is_not_given():
    with pytest.raises(RefusedError, match="it denies what it says"):
        Model().given("a", A & ~A)
    seen = Model().witnessed(p, by=lambda x: 0)
    with pytest.raises(RefusedError, match="refused by the witness function of p"):
        seen.given("s", p("a"), 0.5)


def test_a_witness_function_speaks_for_what_is_above():
    theory = Signature(axioms=(Axiom(A, B),))
    M = Model(theory).witnessed(A, by=lambda a: a == "x")
    assert M.judge("x", B).holds
    assert M.judge("y", B).p == (0, 1)
    assert M.judge("x", A & ~B).holds is False


def test_perceiving_through_a_function():
    T = rectype(f=A >> Type, x=A, c=this.f(this.x))
    M = Model().given("o", A).witnessed(p, by=lambda x: 0.8)
    seen = M.perceive(record(f=fun(v=A)(p(this.v)), x="o"), T)
    assert seen.p == (0.8, 0.8)


PIECES = [
    Plus(A),
    Plus(Plus(A)),
    Plus(A | Str(B)),
    Plus(Str(A) & B),
    Plus(Application(fun(x=Rec)(Str()), record())),
]


@pytest.mark.parametrize("T", PIECES, ids=str)
def test_a_made_up_repetition(T):
    witness, M = Model().create(T)
    assert M.judge(witness, T).holds


def test_something_is_of_a_meet_of_record_types():
    M = Model().given("a", A)
    assert M.true(rectype(x=A) & rectype(y=A)) == (1, 1)
    assert M.true(rectype(x=A) & rectype(x=B)) == (0, 0)


def test_what_is_below_an_open_type_leaves_it_open():
    theory = Signature(axioms=(Axiom(B, A),), opened=frozenset((B,)))
    assert Model(theory).true(A) == (0, 1)
    assert Model(theory).judge("x", A).p == (0, 1)


def test_something_empty_is_of_star_and_list():
    assert Model(Signature(opened=frozenset((A,)))).true(star(A)) == (1, 1)
    assert Model().true(ListOf(A)) == (1, 1)


def test_what_an_application_gives_is_told_of_the_parts_of_an_object():
    is_dog = fun(x=Ind)(dog(this.x))
    M = Model().given("fido", Ind).given(("s",), ListOf(Application(is_dog, "fido")))
    assert M.judge("s", dog("fido")).holds is True


def test_an_argument_that_is_refused_is_refused_for_what_is_wrong_in_it():
    barks = fun(r=rectype(x=Ind, n=rectype(c=dog(outer.x))))(dog(this.r.x))
    M = Model().given("fido", Ind)
    found = M.judge("s", Application(barks, record(x="fido", n=record(c="e"))))
    assert str(found.why).endswith("is not in the field n.c: nothing says so)")


def test_an_axiom_about_two_arguments_says_nothing_of_one():
    ready = Pred("ready", (Ind,), (Ind, Ind))
    able = Pred("able", Ind)
    M = Model(Signature(axioms=(Axiom(ready(this.x), able(this.x)),)))
    M = M.given("fido", Ind).given("bone", Ind)
    assert M.given("s", ready("fido")).judge("s", able("fido")).holds is True
    assert M.given("s", ready("fido", "bone")).judge("s", able("fido")).holds is False


def test_what_certainly_is_not_of_a_type_is_no_candidate():
    M = Model().given("a", A).given("b", A, 0).given("c", A, 0.5)
    assert list(candidates(M.facts, A)) == ["a", "c"]


@pytest.mark.parametrize(
    ("former", "now"),
    [
        ("expects", "with_conditional"),
        ("tabled", "with_table"),
        ("dependent", "with_unknown_dependence"),
        ("stated", "with_given"),
        ("reduced", "reduce"),
    ],
)
def test_former_names_of_methods_work_and_warn(former, now):
    M = Model()
    with pytest.warns(DeprecationWarning, match=f"Model.{former} is now Model.{now}$"):
        assert getattr(M, former) == getattr(M, now)


# --- axioms and what is seen of ptypes ------------------------------------------------

wren, bird, animal = (Pred(name, Ind) for name in ("wren", "bird", "animal"))
KINDS = Signature(
    (Axiom(wren(this.x), bird(this.x)), Axiom(bird(this.x), animal(this.x)))
)


def look_at(**degrees):
    """A model of one thing, of which these words are seen to be true so far."""
    model = Model().given("o1", Ind)
    for pred in (wren, bird, animal):
        if pred.name in degrees:
            degree = degrees[pred.name]
            model = model.witnessed(pred, by=lambda x, degree=degree: degree)
    return model.under(KINDS)


@pytest.mark.parametrize(
    ("degrees", "of_bird", "of_animal"),
    [
        ({"wren": 0.9, "bird": 0.2, "animal": 0.0}, (0.9, 0.9), (0.9, 0.9)),
        ({"wren": 0.2, "bird": 0.9, "animal": 0.0}, (0.9, 0.9), (0.9, 0.9)),
        ({"wren": 0.9}, (0.9, 1.0), (0.9, 1.0)),
        ({"wren": 0.0, "bird": (0.1, 0.6)}, (0.1, 0.6), (0.1, 1.0)),
        ({"wren": (0.5, 0.8), "bird": (0.1, 0.6)}, (0.5, 0.6), (0.5, 1.0)),
    ],
)
def test_what_is_seen_of_a_kind_is_seen_of_those_above(degrees, of_bird, of_animal):
    model = look_at(**degrees)
    for pred, bounds in ((bird, of_bird), (animal, of_animal)):
        found = model.facts.perceive(None, pred("o1"))
        assert (found.lo, found.hi) == bounds


def test_what_is_seen_of_a_kind_says_nothing_of_those_below():
    model = look_at(wren=0.1, bird=0.9)
    assert model.facts.perceive(None, wren("o1")).lo == 0.1


def test_what_nothing_is_seen_of_has_no_degree():
    assert look_at(bird=0.9).facts.perceive(None, wren("o1")) is None
    assert look_at(wren=0.0).facts.perceive(None, bird("o1")) is None


def test_a_situation_that_is_perceived_is_as_probable_as_the_axioms_say():
    model = look_at(wren=0.9, bird=0.2)
    judged = model.perceive(record(x="o1"), rectype(x=Ind, c=bird(this.x)))
    assert judged.p.lo == 0.9


def test_a_model_under_another_theory_keeps_what_was_judged():
    model = Model().given("o1", Ind).given("s1", wren("o1"))
    assert not model.judge("s1", animal("o1")).holds
    assert model.under(KINDS).judge("s1", animal("o1")).holds
    assert not model.under(KINDS).under(Signature()).judge("s1", animal("o1")).holds


# --- what assignments remember and find ----------------------------------------------


def test_what_is_certain_by_a_fact_is_not_so_where_the_fact_is_not_given() -> None:
    dog = Pred("dog", Ind)
    T, sit = rectype(x=Ind, c=dog(this.x)), record(x="fido", c="e")
    before = Model().given("fido", Ind)
    after = before.given("e", dog("fido"))
    assert is_certain(after.facts, sit, T)
    assert not is_certain(before.facts, sit, T)


def test_objects_are_in_the_order_of_the_first_fact_about_each() -> None:
    A, B = Basic("A"), Basic("B")
    model = Model().given("c", A).given("a", B).given("b", A).given("a", A)
    assert model.facts.objects() == ["c", "a", "b"]


@pytest.mark.parametrize(
    ("size", "made"),
    [(0, r"\x:A. []"), (1, r"\x:A. [a1]"), (2, r"\x:A. [a1, a2]")],
)
def test_lists_that_a_function_gives_are_of_the_length_asked_for(
    size: int, made: str
) -> None:
    T = FunType(Basic("A"), ListOf(Basic("B")))
    sit, _ = create_witness(Assignment(Signature()), T, size)
    assert str(sit) == made
