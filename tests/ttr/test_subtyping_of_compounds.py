"""Subtyping of joins, negations, functions, collections and strings."""

import pytest

from ttr import (
    Basic,
    ListOf,
    Model,
    Pi,
    Plus,
    Pred,
    Rec,
    RecType,
    SetOf,
    Str,
    Type,
    consistent,
    fun,
    join,
    rectype,
    subtype,
    this,
)
from ttr.types import Application, EventString, NonEmpty, Universe, fst, rst
from ttr.types.derived_types import star

A, B, C = Basic("A"), Basic("B"), Basic("C")
p = Pred("p", A)
self_equal = rectype(y=A, z=A | B, x=ListOf(A) @ rst(this.x))

YES = {
    "a part of a join": (A, A | B),
    "every part of a join": (A | B, B | C | A),
    "distribution": (A & (B | C), (A & B) | (A & C)),
    "distribution back": ((A & B) | (A & C), A & (B | C)),
    "a join in a field": (rectype(x=A | B), rectype(x=A) | rectype(x=B)),
    "a join of record types": (rectype(x=A) | rectype(x=B), rectype(x=A | B)),
    "an equation in a circle": (self_equal, self_equal | A),
    "an equation in a circle, seen from another field": (
        rectype(x=ListOf(A) @ rst(this.x), z=ListOf(A) @ this.x),
        rectype(x=ListOf(A), z=ListOf(A) @ rst(this.x)),
    ),
    "excluded middle": (A, B | ~B),
    "a contradiction": (A & ~A, B),
    "double negation": (~~A, A),
    "double negation back": (A, ~~A),
    "contraposition": (~A, ~(A & B)),
    "De Morgan": (~(A | B), ~A & ~B),
    "De Morgan back": (~A & ~B, ~(A | B)),
    "other singletons": (A @ "a", ~(A @ "b")),
    "other forms": (Rec, ~ListOf(A)),
    "a disjunctive syllogism": ((A | B) & ~A, B),
    "a negation in a field": (rectype(x=A & ~B), rectype(x=~B)),
    "a list that is not of a type has elements": (
        ListOf(A) & ~ListOf(B),
        NonEmpty(A),
    ),
    "a list without elements": (ListOf(A) & ~NonEmpty(A), ListOf(B)),
    "a list has elements or none": (ListOf(A), NonEmpty(A) | ListOf(B)),
    "a denied record type": (rectype(x=A, y=B) & ~rectype(x=A), C),
    "one of two fields is not": (
        rectype(x=A, y=A) & ~rectype(x=B, y=C),
        rectype(x=~B) | rectype(y=~C),
    ),
    "one of two fields inside is not": (
        rectype(r=rectype(x=A, y=A)) & ~rectype(r=rectype(x=B, y=C)),
        rectype(r=rectype(x=~B)) | rectype(r=rectype(y=~C)),
    ),
    "excluded middle in a field": (rectype(x=A), rectype(x=B) | rectype(x=~B)),
    "excluded middle further in": (
        rectype(r=rectype(x=A)),
        rectype(r=rectype(x=B)) | rectype(r=~rectype(x=B)),
    ),
    "elements of lists": (ListOf(A & B), ListOf(A)),
    "elements that are a join": (ListOf(A | B), ListOf(B | C | A)),
    "lists that must be empty": (ListOf(A & ~A), ListOf(B)),
    "lists that are not empty": (NonEmpty(A), ListOf(A | B)),
    "elements of sets": (SetOf(A), SetOf(A | B)),
    "a written set": (SetOf(A) @ {"a", "b"}, SetOf(A | B)),
    "event by event": (Str(A, B), Str(A | C, B)),
    "a join in a string": (Str(A | B), Str(A) | Str(B)),
    "a string of one piece or more": (Str(A, A), Plus(A)),
    "pieces of two events": (Str(A, B, A, B), Plus(Str(A, B))),
    "pieces taken apart": (Plus(Str(A, B)), Plus(A | B)),
    "repeated repetitions": (Plus(Plus(A)), Plus(A)),
    "a smaller result": (A >> (B & C), A >> B),
    "a union of domains": ((A >> C) & (B >> C), (A | B) >> C),
    "a union of domains back": ((A | B) >> C, (A >> C) & (B >> C)),
    "a meet of results": ((A >> B) & (A >> C), A >> (B & C)),
    "a meet of results back": (A >> (B & C), (A >> B) & (A >> C)),
    "a smaller domain and a larger result": (A >> B, (A & C) >> (B | C)),
    "a meet of both": ((A >> B) & (B >> C), (A & B) >> (B & C)),
    "a union of both": ((A >> B) & (C >> A), (A | C) >> (B | A)),
    "two domains that are all there is": ((A >> C) & (~A >> C), B >> C),
    "results that are not possible": (A >> (B & ~B), A >> C),
    "an impossible domain": (A >> B, (C & ~C) >> B),
    "a meet of dependent results": (
        Pi(x=A)(p(this.x)) & Pi(x=A)(B),
        Pi(x=A)(p(this.x) & B),
    ),
    "a denied function type": (
        (A >> B) & ~(A >> C),
        ~(A >> (B & C)),
    ),
    "a denied function type in a field": (
        rectype(f=A >> B) & ~rectype(f=A >> C),
        rectype(f=~(A >> (B & C))),
    ),
    "functions of functions": (
        (A >> (B >> C)) & (A >> (B >> A)),
        A >> (B >> (A & C)),
    ),
    "functions in fields": (
        rectype(f=A >> C) & rectype(f=B >> C),
        rectype(f=(A | B) >> C),
    ),
    "a larger domain": ((A | B) >> C, A >> C),
    "functions of each part of a domain": ((A >> C) & (B >> C), (A | B) >> C),
    "functions with results of their own": (
        (A >> C) & (B >> Rec),
        (A | B) >> (C | Rec),
    ),
    "results of several types": ((A >> B) & (A >> C), A >> (B & C)),
    "dependent results of several types": (
        Pi(x=A)(p(this.x)) & Pi(x=A)(A @ this.x),
        Pi(x=A)(p(this.x) & A @ this.x),
    ),
    "a result that the other type leaves": ((A >> (B | C)) & (A >> ~B), A >> C),
    "a dependent result": (Pi(x=A)(A @ this.x), A >> A),
    "a dependent result on less": (Pi(x=A)(p(this.x)), Pi(x=A & B)(p(this.x))),
    "a function as a field": (
        rectype(f=(A >> Type) @ fun(x=A)(p(this.x)), a=A, c=this.f(this.a)),
        rectype(a=A, c=p(this.a)),
    ),
    "what a function gives": (
        rectype(f=A >> B, a=A, b=B @ this.f(this.a)),
        rectype(b=B),
    ),
    "the same application": (
        rectype(f=A >> Type, a=A, b=A @ this.a, c=this.f(this.a)),
        rectype(f=A >> Type, b=A, c=this.f(this.b)),
    ),
    "a concatenation of lists": (
        rectype(l=ListOf(A), m=NonEmpty(A), n=ListOf(A) @ (this.l + this.m)),
        rectype(n=NonEmpty(A)),
    ),
    "the rest and the first": (
        rectype(l=NonEmpty(A), f=A @ fst(this.l), r=ListOf(A) @ rst(this.l)),
        rectype(f=A, r=ListOf(A | B)),
    ),
    "a list that a function gives": (
        rectype(f=A >> ListOf(A & B), a=A, l=NonEmpty(A & B) @ this.f(this.a)),
        rectype(l=ListOf(A)),
    ),
    "a list that a function gives, of which more is known": (
        rectype(
            f=A >> ListOf(A), a=A, l=(NonEmpty(C) & ListOf(A & B)) @ this.f(this.a)
        ),
        rectype(l=NonEmpty(A)),
    ),
    "a set that a function gives": (
        rectype(f=A >> SetOf(A & B), a=A, s=(SetOf(A & B) & C) @ this.f(this.a)),
        rectype(s=SetOf(A)),
    ),
    "a rest that is there": (
        (NonEmpty(A) >> ListOf(A)) @ fun(l=NonEmpty(A))(rst(this.l)),
        NonEmpty(A) >> ListOf(A | B),
    ),
    "a concatenation that a function gives": (
        (ListOf(A) >> ListOf(A)) @ fun(l=ListOf(A))(this.l + this.l),
        ListOf(A) >> ListOf(A | B),
    ),
    "equal lists of equal elements": (
        rectype(x=A, y=A & B, l=ListOf(A) @ (this.x,) & ListOf(A) @ (this.y,)),
        rectype(x=B),
    ),
    "equal strings of equal events": (
        rectype(
            x=A,
            y=A & B,
            s=Str(A) @ EventString(this.x) & Str(A) @ EventString(this.y),
        ),
        rectype(x=B),
    ),
    "equal records of equal parts": (
        rectype(x=A, y=A & B, r=Rec @ {"a": this.x} & Rec @ {"a": this.y}),
        rectype(x=B),
    ),
    "either string in a record": (
        rectype(s=Str(A | B)),
        rectype(s=Str(A)) | rectype(s=Str(B)),
    ),
    "more cases than are told apart": (
        rectype({f"x{i}": A | B for i in range(9)}) >> A,
        rectype({f"x{i}": A | B for i in range(10)}) >> (A | B),
    ),
    "an application in a result": (
        A >> B,
        Pi(x=A)(Application(fun(y=A)(B), this.x)),
    ),
    "a set that a function gives, after something else is known of it": (
        rectype(f=A >> C, a=A, b=C @ this.f(this.a), s=SetOf(A & B) @ this.f(this.a)),
        rectype(s=SetOf(A)),
    ),
    "an object of a join": ((A | B) @ "a", (A @ "a") | (B @ "a")),
    "a join of many wide record types": (
        rectype({f"{x}{i}": A for i in range(5) for x in "ab"}),
        join(*[rectype({f"{x}{i}": A for i in range(5)}) for x in "abc"]),
    ),
    "levels": (RecType, Type | A),
    "lower levels": (Type, Universe("Type", 2)),
}

NO = {
    "a join in its part": (A | B, A),
    "a type in a negation": (A, ~B),
    "a negation": (~A, A),
    "contraposition the wrong way": (~(A & B), ~A),
    "a join of lists": (ListOf(A | B), ListOf(A) | ListOf(B)),
    "a list that may be empty": (ListOf(A), NonEmpty(A)),
    "sets": (SetOf(A), SetOf(B)),
    "longer strings": (Str(A, A), Str(A)),
    "how often": (Plus(A), Str(A)),
    "another piece": (Str(A, B, A), Plus(Str(A, B))),
    "a smaller domain": ((A & B) >> A, A >> A),
    "a larger result": (A >> Type, A >> RecType),
    "other arguments": (
        rectype(f=A >> RecType, x=A, y=A, z=RecType @ this.f(this.x)),
        rectype(f=A >> RecType, x=A, y=A, z=RecType @ this.f(this.y)),
    ),
    "a record that is empty": (Rec, Rec @ {}),
    "a denied record type with a field that need not be": (
        rectype(x=A) & ~rectype(x=B, y=C),
        rectype(x=~B),
    ),
    "a list that a function gives": (
        rectype(f=A >> ListOf(A), a=A, l=(NonEmpty(C) & ListOf(A)) @ this.f(this.a)),
        rectype(l=ListOf(B)),
    ),
    "levels back": (Universe("Type", 1), Type),
    "an object of one part of a join": ((A | B) @ "a", A @ "a"),
    "a join of many wide record types": (
        rectype(x=A),
        join(*[rectype({f"{x}{i}": A for i in range(5)}) for x in "abc"]),
    ),
    "a concatenation of lists that may be empty": (
        rectype(l=ListOf(A), m=ListOf(A), n=ListOf(A) @ (this.l + this.m)),
        rectype(n=NonEmpty(A)),
    ),
    "a concatenation is no set": (
        rectype(l=ListOf(A), n=ListOf(A) @ (this.l + this.l)),
        rectype(n=SetOf(A)),
    ),
    "a set that a function gives": (
        rectype(f=A >> SetOf(A), a=A, s=SetOf(A) @ this.f(this.a)),
        rectype(s=SetOf(B)),
    ),
}


def test_a_type_with_very_many_clauses_is_named():
    many = join(*[Basic(f"P{i}") & Basic(f"Q{i}") for i in range(9)])
    found = subtype(rectype(x=A), rectype(x=many))
    assert found.no
    assert found.why == f"in the field x, {many} has too many cases"


def test_an_answer_is_equal_to_answers_only():
    assert subtype(A, A) == subtype(A, A)
    assert subtype(A, A) != subtype(A, B)
    assert subtype(A, A) != "yes"


@pytest.mark.parametrize("name", YES)
def test_yes(name):
    S, T = YES[name]
    assert str(subtype(S, T)).startswith("yes: ")
    assert subtype(S, T).counter is None


@pytest.mark.parametrize("name", NO)
def test_no_with_a_counter_assignment(name):
    S, T = NO[name]
    answer = subtype(S, T)
    assert answer.no
    against = answer.counter
    assert against.model.judge(against.sit, S).holds
    assert against.model.judge(against.sit, T).holds is False


def test_what_is_not_derivable_is_unknown():
    assert subtype(rectype(x=A @ this.y, y=ListOf(A) @ this.x), rectype(z=A)).unknown


def test_the_rest_of_a_list_that_may_be_empty_need_not_be_there():
    rest = fun(l=ListOf(A))(rst(this.l))
    assert subtype((A >> B) @ rest, NonEmpty(A) >> ListOf(A)).yes
    assert not subtype((A >> B) @ rest, ListOf(A) >> ListOf(A)).yes


def test_a_list_that_may_be_empty_need_have_no_first():
    first = fun(l=ListOf(A))(fst(this.l))
    assert subtype((A >> B) @ first, NonEmpty(A) >> A).yes
    assert not subtype((A >> B) @ first, ListOf(A) >> A).yes


def test_functions_are_put_together_only_where_each_part_of_the_domain_is_covered():
    assert not subtype((A >> C) & (B >> Rec), (A | B) >> C).yes
    assert not subtype((A >> C) & (B >> C), (A | B | Rec) >> C).yes
    assert not subtype((A >> B) & (A >> C), A >> Rec).yes


def test_many_cases_are_left_together():
    many = rectype({f"x{i}": A | B for i in range(20)})
    assert subtype(many, rectype(x0=A | B)).yes
    assert not subtype(many, rectype(x0=A)).yes


@pytest.mark.parametrize(
    ("types", "verdict"),
    [
        ((A, B), "yes"),
        ((A | B, ~A), "yes"),
        ((A, ~A), "no"),
        ((A @ "a", A @ "b"), "no"),
        ((ListOf(A), rectype(x=A)), "no"),
        ((ListOf(A), A @ "a"), "no"),
        ((SetOf(A), A @ "a"), "no"),
        ((SetOf(A), Rec @ {}), "no"),
        ((Plus(A), A @ "a"), "no"),
        ((Plus(A), A @ EventString()), "no"),
        ((Plus(star(A)), Str() @ EventString()), "yes"),
        ((rectype(x=A), rectype(x=~A, y=B)), "no"),
        ((NonEmpty(A), NonEmpty(A & B)), "yes"),
        ((NonEmpty(A & ~A),), "no"),
    ],
)
def test_consistency(types, verdict):
    assert consistent(*types).verdict == verdict


def test_a_string_that_is_written_may_be_of_a_repetition():
    assert not consistent(Plus(A), Str(A) @ EventString("a")).no


def test_known_witnesses():
    M = Model().given("a", A).given("b", A).given("b", B).given("s", p("a"))
    assert M.witnesses(A) == ("a", "b")
    assert M.witnesses(A & B) == ("b",)
    assert M.witnesses(A | B) == ("a", "b")
    assert M.witnesses(A & ~B) == ("a",)
    assert M.witnesses(A @ "a") == ("a",)
    assert M.witnesses(A @ "c") == ()
    assert [str(r) for r in M.witnesses(rectype(x=A, c=p(this.x)))] == [
        "{c = s, x = a}"
    ]
    assert M.witnesses(Str(A, B)) == (EventString("a", "b"), EventString("b", "b"))


def test_truth_of_types_and_propositions():
    M = Model().given("a", A)
    assert M.true(A) == M.true(ListOf(B)) == (1, 1)
    assert M.true(B) == M.true(rectype(x=A, y=B)) == (0, 0)
    assert M.given("b", B, 0.5).true(B) == (0.5, 1)


@pytest.mark.parametrize("of", [ListOf, SetOf, star])
@pytest.mark.parametrize("whole", [lambda T: T, lambda T: rectype(x=T)])
def test_what_is_empty_is_of_elements_that_exclude_each_other(of, whole):
    answer = consistent(whole(of(A)), whole(of(~A)))
    assert answer.yes, str(answer)


def test_what_has_an_element_is_not():
    assert consistent(NonEmpty(A), ListOf(~A)).no
    assert consistent(rectype(x=NonEmpty(A)), rectype(x=ListOf(~A))).no
    assert consistent(NonEmpty(A), ListOf(~B)).yes
    assert consistent(NonEmpty(ListOf(A)), ListOf(ListOf(~A))).yes
    assert consistent(Plus(A), Plus(~A)).no


@pytest.mark.parametrize(
    ("S", "T"),
    [
        (ListOf(A) & ~ListOf(B), NonEmpty(B)),
        (ListOf(A) & ~NonEmpty(B), ListOf(B)),
        (ListOf(A), NonEmpty(B) | ListOf(B)),
        (~ListOf(B), NonEmpty(A)),
    ],
)
def test_what_is_denied_of_lists_says_no_more(S, T):
    assert not subtype(S, T).yes


def test_functions_of_several_types_are_consistent():
    assert consistent(A >> B, A >> C).yes
    assert consistent(A >> B, C >> A).yes
    assert consistent(rectype(f=A >> B), rectype(f=A >> C)).yes
    assert not consistent(A >> B, A >> ~B).yes
