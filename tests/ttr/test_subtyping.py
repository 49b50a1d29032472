"""Subtyping: what follows from form, from equations and from axioms, and why not."""

import pickle

import pytest

import ttr
from ttr import (
    Basic,
    Ind,
    ListOf,
    Pred,
    Rec,
    RecType,
    Str,
    Theory,
    Type,
    fun,
    outer,
    record,
    rectype,
    subtype,
    this,
)
from ttr.computing import prover
from ttr.errors import IllFormedError, UnsupportedError
from ttr.signature.signature import Axiom, Signature
from ttr.types import Application, NonEmpty

A, B, C = Basic("A"), Basic("B"), Basic("C")
p, q = Pred("p", (A,), (B,)), Pred("q", (A, A), (B, B))

YES = {
    "equal through a path": (
        rectype(x=A, y=A @ this.x, c=p(this.y)),
        rectype(x=A, c=p(this.x)),
    ),
    "equal to the same object": (
        rectype(x=A @ "a", y=A @ "a", c=p(this.x)),
        rectype(y=A, c=p(this.y)),
    ),
    "a type through another field": (rectype(x=A, y=B @ this.x), rectype(x=B)),
    "a type through an object": (rectype(x=A @ "a", y=B @ "a"), rectype(y=A)),
    "a type out of a nested record": (
        rectype(n=rectype(x=B @ outer.x), x=A),
        rectype(x=A & B),
    ),
    "a circle": (
        rectype(x=A @ this.y, y=B @ this.x, c=p(this.x)),
        rectype(x=A & B, y=A, c=p(this.y)),
    ),
    "a chain": (
        rectype(x=A @ this.y, y=A @ this.z, z=A @ "a", c=p(this.x)),
        rectype(c=p("a")),
    ),
    "equal records": (
        rectype(n=rectype(x=A), m=rectype(x=B) @ this.n, c=p(this["n.x"])),
        rectype(m=rectype(x=A & B), c=p(this["m.x"])),
    ),
    "a record that is written": (
        rectype(n=rectype(x=A) @ {"x": "a"}),
        rectype(n=rectype(x=A @ "a")),
    ),
    "two fields of a meet": (rectype(x=A) & rectype(x=B), rectype(x=A & B)),
    "lists of both": (ListOf(A) & ListOf(B), ListOf(A & B)),
    "the empty list": (ListOf(A) @ [], ListOf(B)),
    "a written list": (
        rectype(x=A, y=B, l=ListOf(Ind) @ [this.x, this.x]),
        rectype(l=ListOf(A)),
    ),
    "lists of types": (ListOf(Type) @ [p("a")], ListOf(Type)),
    "a written record type": (Type @ rectype(x=A), RecType),
    "types of types": (RecType, Type),
    "a meet with a singleton": (A @ "a" & B, B @ "a"),
    "elements tied to a field outside": (
        rectype(x=A, l=ListOf(rectype(y=B @ outer.x, z=C))),
        rectype(x=A, l=ListOf(rectype(y=(A & B) @ outer.x))),
    ),
    "lists that must be empty": (ListOf(A @ "a" & A @ "b"), ListOf(C)),
    "nothing": (rectype(x=A @ "a" & A @ "b"), rectype(z=C)),
    "no list is a record": (ListOf(A) & Rec, C),
    "no name is a list": (ListOf(A) @ "a", C),
}

NO = {
    "other types": (A, B),
    "no record": (A, Rec),
    "no basic type": (rectype(x=A), A),
    "another path": (rectype(x=A, y=A, c=p(this.x)), rectype(x=A, y=A, c=p(this.y))),
    "not only that": (A, A @ "a"),
    "another object": (A @ "a", A @ "b"),
    "1 is not True": (A @ 1, A @ True),
    "types of types": (Type, RecType),
    "no record type": (Type @ A, RecType),
    "lists of others": (ListOf(A), ListOf(B)),
    "a list that may be empty says nothing of a field": (
        rectype(x=A, l=ListOf(rectype(y=B @ outer.x))),
        rectype(x=B),
    ),
    "arguments in another order": (q("a", "b"), q("b", "a")),
}


@pytest.mark.parametrize("name", YES)
def test_yes(name):
    S, T = YES[name]
    assert subtype(S, T).yes, subtype(S, T).why
    assert S <= T
    assert T >= S


@pytest.mark.parametrize("name", NO)
def test_no(name):
    S, T = NO[name]
    assert subtype(S, T).no, subtype(S, T).why
    assert not (S <= T)


def test_unknown_where_equations_are_not_followed():
    S = rectype(x=A @ {"r": this.x})
    assert subtype(S, rectype(x=B)).unknown
    assert "nothing may be of" in subtype(S, rectype(x=B)).why


def test_an_application_that_is_not_worked_out_refutes_nothing():
    """A record is no list, so Rec ⊑ ¬nelist(A), however nelist(A) is written."""
    applied = Application(fun(r=Rec)(NonEmpty(A)), record())
    assert subtype(Rec, ~NonEmpty(A)).yes
    assert not subtype(Rec, ~applied).no


def test_an_application_that_is_not_worked_out_is_not_refuted():
    """The function gives Rec for every argument, which is below itself."""
    assert not subtype(Application(fun(y=B)(Rec), "b"), Rec).no


def test_what_speaks_against_it_is_judged_of_the_type_as_it_is_written():
    applied = A & ~Application(fun(r=Rec)(A), record())
    against = subtype(A, applied).counter
    assert against.type is applied
    assert against.holds is False


def test_what_may_have_no_witness_is_not_refuted():
    S = rectype(f=B, x=ListOf(B) @ this.f)  # an f would be of B and a list
    assert subtype(S, rectype(f=C)).unknown
    assert "but nothing may be of" in subtype(S, rectype(f=C)).why


def test_nothing_is_refuted_by_a_witness_of_a_circle_that_nobody_can_build():
    S = rectype(y=B @ this["n.y"], n=rectype(y=B @ outer.y))
    T = rectype({"z": A, **dict(S.fields)})
    assert subtype(T, S).yes
    assert subtype(S, T).unknown
    assert subtype(S, T).why.startswith(f"{S} has no field z")


WHY = [
    (rectype(x=A), rectype(x=A, c=p(this.x)), "[x : A] has no field c"),
    (rectype(x=A), rectype(x=A & B), "in the field x, A is not below B"),
    (
        rectype(n=rectype(x=A, c=p(this.x))),
        rectype(n=rectype(x=A, c=p("a"))),
        "in the field n.c, p(n.x) is not below p(a)",
    ),
    (rectype(x=A), rectype(x=A @ "a"), "in the field x, x need not be a"),
    (A, A @ "a", "a witness of A need not be a"),
    (A, A, "A is below itself"),
    (A & B, A, "A /\\ B is below A by its form"),
    (A @ "a" & A @ "b", C, "nothing can be of (A@a) /\\ (A@b)"),
    (Type @ Type, C, "nothing can be of Type@Type"),
    (A @ Type, Type, "Type: it is of level 1"),
]


@pytest.mark.parametrize(("S", "T", "why"), WHY)
def test_why(S, T, why):
    assert subtype(S, T).why == why


@pytest.mark.parametrize(
    "S",
    [
        r"B /\ ~A",
        r"[x : B /\ ~A]",
        r"str(A) /\ str(A, A)",
        r"[s : str(A) /\ str(A, A)]",
        r"[r : [s : plus(str(A, A)) /\ str(A)]]",
        r"nelist(str(A) /\ str(A, A))",
        r"list(A) /\ [x : A]",
        r"nelist(list(A) /\ [x : A])",
        r"[l : nelist(list(A) /\ [x : A])]",
        r"(A@a) /\ (A@b)",
        r"[x = a : A, y = x : A, z = y : A] /\ [z = b : A]",
        r"[r = {x = a} : [x : A]] /\ [r : [x = b : A]]",
        "[r = {x = a} : [x : A, y : A]]",
        "[r = {x = a} : Rec, l = r : list(A)]",
        "[l = [] : nelist(A)]",
    ],
)
def test_nothing_is_of_it_so_that_anything_follows(S):
    """A list of such things is empty."""
    names = "basic A, B, C\nB <: A\nobject a, b : A"
    theory = Theory.parse(f"{names}\nS := {S}\nSome := list({S})\nNone_ := list(C)\n")
    assert subtype(theory.S, theory.C, theory).yes
    assert subtype(theory.Some, theory.None_, theory).yes


@pytest.mark.parametrize(
    ("S", "T"),
    [
        (r"(B \/ C) /\ (B \/ D)", r"A \/ C"),
        (r"(C \/ D) /\ (B \/ ~D)", r"B \/ C"),
        (r"(C \/ D) /\ (B \/ ~D) /\ (B \/ ~C)", "A"),
        (r"[x : (C \/ D) /\ (B \/ ~D) /\ (B \/ ~C)]", "[x : A]"),
        (r"(C \/ D) /\ (B \/ D)", r"A \/ D"),
    ],
)
def test_what_follows_whichever_part_of_a_join_it_is(S, T):
    theory = Theory.parse(f"basic A, B, C, D\nB <: A\nS := {S}\nT := {T}\n")
    assert subtype(theory.S, theory.T, theory).yes
    assert subtype(theory.S, theory.C, theory).no


@pytest.mark.parametrize(
    ("S", "T", "verdict"),
    [
        ("[l : nelist(B), y = fst(l) : C]", "[y : A]", "yes"),
        ("[l : list(B) /\\ nelist(C), y = fst(l) : C]", "[y : A]", "yes"),
        ("[l : list(B), y = fst(l) : C]", "[y : A]", "no"),
        ("[l : nelist(A), y = fst(l) : C]", "[y : B]", "no"),
        ("[f : (B -> C), x : B, y = f(x) : D]", "[y : C]", "yes"),
        ("[f : (A -> C), x : B, y = f(x) : D]", "[y : C]", "yes"),
        ("[f : (B -> B), x : B, y = f(x) : D]", "[y : A]", "yes"),
        ("[f : (B -> C), x : B, y = f(x) : D]", "[y : B]", "no"),
        ("[f : (A -> B \\/ C), x : A, y = f(x) : D]", "[y : A \\/ C]", "yes"),
        ("[f : (B -> C) /\\ (A -> D), x : B, y = f(x) : E]", "[y : C /\\ D]", "yes"),
        # what f gives for what is of B says nothing of what it gives for x
        ("[f : (B -> C) /\\ (A -> D), x : A, y = f(x) : E]", "[y : C]", "unknown"),
        ("[f : (B -> C) /\\ (A -> D), x : A, y = f(x) : E]", "[y : D]", "yes"),
    ],
)
def test_what_a_list_has_first_and_what_a_function_gives(S, T, verdict):
    theory = Theory.parse(f"basic A, B, C, D, E\nB <: A\nS := {S}\nT := {T}\n")
    assert subtype(theory.S, theory.T, theory).verdict == verdict


def test_axioms():
    theory = Signature(
        axioms=(
            Axiom(p(this.x), q(this.x, this.x)),
            Axiom(A, B),
            Axiom(B, C),
            Axiom(C, A),
        )
    )
    S = rectype(x=A, c=p(this.x))
    T = rectype({"x": C, "c": q(this.x, this.x)}, theory)
    assert subtype(S, T, theory).yes
    assert subtype(S, T).no
    assert str(subtype(A, C, theory)) == "yes: by the axiom B <: C"
    assert subtype(p("a"), q("a", "b"), theory).no


def test_an_answer_is_no_truth_value():
    with pytest.raises(TypeError, match=r"ask for \.yes or \.no"):
        bool(subtype(A, B))


def test_reasons_are_made_when_they_are_asked_for(monkeypatch):
    printed = []

    def notation(value, scope=()):
        printed.append(value)
        return "a type"

    with monkeypatch.context() as patched:
        patched.setattr(prover, "notation", notation)
        answer = subtype(A, B)
        assert answer.no
        assert printed == []
        assert answer.why == answer.why == "a type is not below a type"
        assert printed == [A, B]


def test_an_answer_is_a_value():
    answer = subtype(rectype(x=A), B)
    assert answer == subtype(rectype(x=A), B) != subtype(A, B)
    assert len({answer, subtype(rectype(x=A), B)}) == 1
    assert pickle.loads(pickle.dumps(answer)) == answer
    assert repr(answer) == "Answer(verdict='no', why='[x : A] is not below B')"


def test_a_reason_that_is_too_large_is_said_to_be():
    with ttr.budget(steps=10):
        assert subtype(A, A).why == "A is below itself"
        many = rectype({f"x{i}": A for i in range(8)})
    with ttr.budget(steps=5):
        assert str(subtype(many, many)).startswith("yes: too large: it takes more")


def test_what_is_no_type():
    with pytest.raises(IllFormedError, match="expected a type, found the predicate p"):
        subtype(A, p)
    with pytest.raises(IllFormedError, match="expected a type, found the object 'a'"):
        _ = A <= "a"


def test_long_chains_of_equations():
    n = 2000
    chain = {f"x{i}": A @ this[f"x{i + 1}"] for i in range(n)}
    S = rectype({**chain, f"x{n}": A, "c": p(this.x0)})
    assert subtype(S, rectype({f"x{n}": A, "c": p(this[f"x{n}"])})).yes


def test_what_nests_too_deep_is_said_so():
    T = rectype(x=A)
    for _ in range(3000):
        T = rectype(n=T)
    with pytest.raises(UnsupportedError, match="nests deeper than can be followed"):
        subtype(T, rectype(n=rectype(y=A)))


def test_what_is_said_of_an_event_is_said_of_whatever_is_such_a_string():
    nothing = rectype(x=Ind @ "a") & rectype(x=Ind @ "b")
    for event in (nothing, A & ~A, ListOf(A) & rectype(x=A)):
        answer = subtype(Str(event, B), C)
        assert str(answer) == f"yes: nothing can be of {Str(event, B)}"
    same = rectype(x=Ind, s=Str(rectype(y=Ind @ outer.x) & rectype(y=Ind @ "b"), B))
    assert subtype(same, rectype(x=Ind @ "b")).yes
