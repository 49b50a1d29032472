"""Meanings compute: what is composed is equal to what it stands for."""

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    Rec,
    RecType,
    SetOf,
    Theory,
    budget,
    check,
    fun,
    outer,
    rectype,
    this,
)
from ttr.computing import consistent, equal, normal_form, subtype
from ttr.computing.kept_redexes import open_presupposition
from ttr.errors import IllFormedError, RefusedError
from ttr.types import Application, Function, merge_terms

LEXICON = r"""
basic Ind
pred man(Ind), dog(Ind), cat(Ind), run(Ind), red(Ind), chase(Ind, Ind)
object j, k : Ind
Man := \v:Ind. [e : man(v)]
Dog := \v:Ind. [e : dog(v)]
Cat := \v:Ind. [e : cat(v)]
Run := \v:Ind. [e : run(v)]
Some := \P:(Ind -> RecType). \Q:(Ind -> RecType). [x : Ind, r : P(x), s : Q(x)]
Every := \P:(Ind -> RecType). \Q:(Ind -> RecType). [f : ((x : Ind) -> (P(x) -> Q(x)))]
John := \P:(Ind -> RecType). P(j)
Chase := \q:((Ind -> RecType) -> RecType). \v:Ind. q(\w:Ind. [e : chase(v, w)])
Red := \P:(Ind -> RecType). \v:Ind. merge(P(v), [a : red(v)])
P := (Ind -> Type)
Det := \Q:P. \R:P. [x : Ind, r : Q(x), s : R(x)]
Dog1 := \v:Ind. dog(v)
Cat1 := \v:Ind. cat(v)
"""

SEEN = "[x : Ind, r : [e : dog(^.x)], s : [x : Ind, r : [e : cat(^.x)], s : %s]]"


@pytest.mark.parametrize(
    "claim",
    [
        "Some(Man)(Run) = [x : Ind, r : [e : man(^.x)], s : [e : run(^.x)]]",
        "Some(Man)(Run) = Some(\\v:Ind. Man(v))(\\v:Ind. [e : run(v)])",
        "John(Run) = [e : run(j)]",
        "John(Chase(Some(Dog))) = Some(Dog)(\\w:Ind. [e : chase(j, w)])",
        f"Some(Dog)(Chase(Some(Cat))) = {SEEN % '[e : chase(^^.x, ^.x)]'}",
        "Some(Red(Man))(Run) = [x : Ind, r : [a : red(^.x), e : man(^.x)], "
        "s : [e : run(^.x)]]",
        "Red(Red(Man))(j) = Red(Man)(j)",
        "Every(Dog)(Run) = [f : ((x : Ind) -> ([e : dog(x)] -> [e : run(x)]))]",
        "[x : Ind, c : (\\y:Ind. dog(y))(x)] = [x : Ind, c : dog(x)]",
        "[x = j : Ind, c : dog(x)] = [x = j : Ind, c : dog(j)]",
        "[x : Ind, r : Man(x)] <= [x : Ind, r : Rec]",
        "[x : Ind, r : Man(x), s : man(x)@r.e] <= [x : Ind, s : man(x)]",
        "[l : list(Run(j))] = [l : list([e : run(j)])]",
        "~Run(j) = ~[e : run(j)]",
        "(\\f:(Ind -> (Ind -> RecType)). \\x:Ind. \\y:Ind. f(y)(x)) : "
        "((Ind -> (Ind -> RecType)) -> (Ind -> (Ind -> RecType)))",
        "Det(Dog1)(\\y:Ind. Det(Cat1)(\\z:Ind. chase(y, z))) = "
        "[x : Ind, r : dog(x), s : [x : Ind, r : cat(x), s : chase(^.x, x)]]",
        "Det(Dog1)(\\y:Ind. Det(Cat1)(\\z:Ind. chase(y, z))) : RecType",
        "Det : (P -> (P -> RecType))",
        "(\\Q:P. \\v:Ind. Det(Q)(\\y:Ind. Det(Q)(\\z:Ind. chase(y, v)))) : "
        "(P -> (Ind -> RecType))",
        "not Man(j) = Run(j)",
        "not [x : Ind, c : man(x)] = [x : Ind, c : dog(x)]",
    ],
)
def test_what_is_composed_is_what_it_stands_for(claim):
    report = check(Theory.parse(f"{LEXICON}check {claim}"))
    assert report.holds, str(report)


def test_both_scopes_are_two_meanings():
    theory = Theory.parse(LEXICON)
    surface = theory.parse("Every(Dog)(Chase(Some(Cat)))")
    inverse = theory.parse(r"Some(Cat)(\y:Ind. Every(Dog)(\x:Ind. [e : chase(x, y)]))")
    assert equal(surface, inverse, theory).no
    assert normal_form(surface, theory) is theory.parse(
        "[f : ((z : Ind) -> ([e : dog(z)] -> "
        "[x : Ind, r : [e : cat(^.x)], s : [e : chase(z, ^.x)]]))]"
    )
    assert normal_form(inverse, theory) is theory.parse(
        "[x : Ind, r : [e : cat(^.x)], "
        "s : [f : ((z : Ind) -> ([e : dog(z)] -> [e : chase(z, ^^.x)]))]]"
    )


@pytest.mark.parametrize(
    ("definition", "why"),
    [
        ("A := Man([y : Ind])", "takes objects of Ind, and [y : Ind] cannot be one"),
        ("A := Man(Ind)", "takes objects of Ind, and Ind cannot be one"),
        ("A := Man(Run)", "Man takes objects of Ind, and Run cannot be one"),
        ("A := man(run)", "man takes individuals, but run is a predicate"),
        ("A := Man(run)", "and run cannot be one"),
        ("A := [r : Some(Man)(Run(j))]", "cannot be one"),
        (
            r"A := [x : list(Ind), r : (\y:[z : Ind]. [e : man(y.z)])(x)]",
            "takes objects of [z : Ind], and x cannot be one, as it is of list(Ind)",
        ),
        (
            r"A := \w:list(Ind). (\y:[z : Ind]. [e : man(y.z)])(w)",
            "takes objects of [z : Ind], and w cannot be one, as it is of list(Ind)",
        ),
        ("A := dog(Ind)", "dog takes individuals, but Ind is a type"),
        ("A := [x = x : Ind]", "set to each other in a circle: x → x"),
        ("A := [x = y : Ind, y = x : Ind]", "set to each other in a circle"),
        ("A := [s : [x = ^.s.x : Ind]]", "in a circle: s.x → s.x"),
        (
            "A := [r : [x = ^.s.x : Ind], s : [x = ^.r.x : Ind]]",
            "set to each other in a circle: ",
        ),
        ("A := \\v:Ind. [x = x : Ind]", "set to each other in a circle: x → x"),
        (
            r"A := dog(\x:Ind. x)",
            r"dog takes individuals, but \x:Ind. x is a function",
        ),
    ],
)
def test_what_cannot_be_computed_is_ill_formed(definition, why):
    with pytest.raises(IllFormedError) as error:
        Theory.parse(f"{LEXICON}{definition}")
    assert why in error.value.message
    assert error.value.span is not None


# --- what is kept --------------------------------------------------------------------

man, see = Pred("man", Ind), Pred("see", Ind, Ind)
Man = fun(v=Ind)(lambda v: rectype(e=man(v)))


def test_what_is_not_known_to_be_in_the_domain_is_kept():
    kept = Man("zoe")
    assert normal_form(kept) is kept
    answer = equal(kept, rectype(e=man("zoe")))
    assert answer.unknown
    assert "it is not known that zoe is of Ind" in answer.why
    assert equal(kept, kept).yes


def test_it_is_computed_where_more_is_known():
    declared = Theory.parse("basic Ind\nobject zoe : Ind")
    assert equal(Man("zoe"), rectype(e=man("zoe")), declared).yes
    assert Model().given("zoe", Ind).reduce(Man("zoe")) is rectype(e=man("zoe"))
    assert subtype(rectype(x=Ind, r=Man(this.x)), rectype(r=rectype(e=Ind))).no
    kept = rectype(x=rectype(y=Ind), r=Application(Man, this.x))
    assert normal_form(kept) is kept


def test_what_is_known_in_one_record_is_not_known_in_another():
    inner = rectype(x=Basic("B"), r=Man(this.x))
    T = rectype(a=rectype(x=Ind, r=Man(this.x)), b=inner)
    computed = rectype(x=Ind, r=rectype(e=man(outer.x)))
    assert normal_form(T) is rectype(a=computed, b=inner)


def test_what_is_given_is_not_assumed():
    """A fact holds in a model; equality holds in all of them."""
    theory = Theory.parse("basic Ind\npred man(Ind)\ngiven zoe : Ind")
    assert equal(Man("zoe"), rectype(e=man("zoe")), theory).unknown


def test_axioms_are_known():
    theory = Theory.parse("basic Ind, Dog\nDog <: Ind")
    Dog = theory.Dog
    computed = rectype({"x": Dog, "r": rectype(e=man(outer.x))}, theory)
    assert equal(rectype(x=Dog, r=Man(this.x)), computed, theory).yes
    assert equal(rectype(x=Dog, r=Man(this.x)), computed).unknown


# --- Python's own functions ----------------------------------------------------------


def test_composing_in_python_captures_nothing():
    def some(P, Q):
        return rectype(x=Ind, r=lambda r: P(r.x), s=lambda r: Q(r.x))

    both = some(man, lambda x: some(man, lambda y: see(x, y)))
    inner = rectype(x=Ind, r=man(this.x), s=see(outer.x, this.x))
    assert both is rectype(x=Ind, r=man(this.x), s=inner)


def test_variables_of_functions_are_python_variables():
    Some = fun(P=Ind >> RecType)(
        lambda P: fun(Q=Ind >> RecType)(
            lambda Q: rectype(x=Ind, r=lambda r: P(r.x), s=lambda r: Q(r.x))
        )
    )
    assert isinstance(Some, Function)
    assert Some is Theory.parse(LEXICON).Some
    twice = fun(f=Ind >> Ind)(lambda f: fun(x=Ind)(lambda x: f(f(x))))
    assert normal_form(twice(fun(x=Ind)(lambda x: x))) is fun(x=Ind)(this.x)


def test_a_variable_of_a_function_stands_in_any_type():
    below = fun(r=rectype(x=Ind))(
        lambda r: (man(r.x) | ~man(r.x)) & rectype(y=Ind @ r.x) & (Ind >> man(r.x))
    )
    path = outer.r.x
    assert below is fun(r=rectype(x=Ind))(
        (man(this.r.x) | ~man(this.r.x))
        & rectype(y=Ind @ path)
        & (Ind >> man(this.r.x))
    )


def test_a_record_as_a_whole_is_no_argument():
    with pytest.raises(IllFormedError, match="name a label"):
        rectype(x=Ind, c=lambda r: man(r))


# --- merges --------------------------------------------------------------------------


def test_a_merge_waits_for_what_it_merges():
    theory = Theory.parse(LEXICON)
    body = theory.parse(r"\P:(Ind -> RecType). \v:Ind. merge(P(v), [a : red(v)])")
    assert body is theory.Red
    assert str(body) == r"\P:(Ind -> RecType). \x:Ind. merge(P(x), [a : red(x)])"
    kind = theory.parse("((Ind -> RecType) -> (Ind -> RecType))")
    assert Model(theory).judge(body, kind).holds


def test_a_singleton_takes_what_is_plain():
    A = Theory.parse("basic A, Ind").A
    assert merge_terms(Ind @ "j", A) is (Ind & A) @ "j"
    assert merge_terms(rectype(x=Ind @ "j"), rectype(x=A)) is rectype(x=(Ind & A) @ "j")


def test_consistency_is_of_what_is_computed():
    excluded = Theory.parse("basic Ind, Cat\nDog := [x : Ind]\nCat <: ~Ind")
    F = fun(v=Ind)(lambda v: excluded.Cat)
    assert consistent(rectype(x=Ind, y=Ind & F(this.x)), theory=excluded).no


# --- what other fields say -----------------------------------------------------------

run = Pred("run", Ind)


@pytest.mark.parametrize(
    "T",
    [
        rectype(x=Ind, y=Ind @ this.x) & rectype(y=Ind @ "b"),
        rectype(x=Ind, y=Ind, z=(Ind @ this.x) & (Ind @ this.y)),
        rectype(x=Ind, r=rectype(y=Ind @ outer.x) & rectype(y=Ind @ "b")),
    ],
)
def test_a_witness_is_created_of_what_fields_say_of_each_other(T):
    witness, model = Model().create(T)
    assert model.judge(witness, T).holds


@pytest.mark.parametrize(
    ("S", "T"),
    [
        (rectype(x=Ind), rectype(x=~(Ind @ "b"))),
        (rectype(x=Ind, c=man(this.x)), rectype(x=Ind, c=~run(this.x))),
        (rectype(r=rectype(x=Ind)), rectype(r=rectype(x=~(Ind @ "b")))),
        (rectype(x=Ind, y=Ind), rectype(x=Ind, y=~(Ind @ this.x))),
        (ListOf(Ind), ListOf(~(Ind @ "b"))),
        (rectype(l=SetOf(Ind)), rectype(l=SetOf(~(Ind @ "b")))),
        (
            rectype(x=Ind, l=ListOf(man(this.x))),
            rectype(x=Ind, l=ListOf(~run(this.x))),
        ),
        (
            rectype(l=ListOf(rectype(x=Ind, l=ListOf(man(this.x))))),
            rectype(l=ListOf(rectype(x=Ind, l=ListOf(~run(this.x))))),
        ),
        (Ind >> Ind, Ind >> ~(Ind @ "b")),
        (
            rectype(x=Ind, f=Ind >> man(this.x)),
            rectype(x=Ind, f=Ind >> ~run(this.x)),
        ),
    ],
)
def test_what_is_denied_of_a_field_is_refuted_by_one_that_has_it(S, T):
    answer = subtype(S, T)
    assert answer.no
    judgement = answer.counter
    assert judgement.model.judge(judgement.sit, S).holds
    assert not judgement.holds


@pytest.mark.parametrize(
    "S",
    [
        rectype(x=Ind, y=Ind @ this.x) & rectype(y=Ind @ "b"),
        rectype(x=Ind, y=Ind, z=(Ind @ this.x) & (Ind @ this.y)),
    ],
)
@pytest.mark.parametrize(
    "T",
    [
        rectype(x=Ind, c=man(this.x)),
        rectype(x=man("b")),
        rectype(y=~(Ind @ "b")),
        rectype(x=Ind, w=Ind),
    ],
)
def test_what_fields_say_of_each_other_is_not_below_what_says_more(S, T):
    answer = subtype(S, T)
    assert answer.no
    against = answer.counter
    assert against.type is T
    assert against.model.judge(against.sit, S).holds
    assert not against.holds
    assert "Ind /\\ Ind" not in answer.why
    assert subtype(S, rectype(x=Ind)).yes


# --- presuppositions -----------------------------------------------------------------


def test_what_is_kept_is_unknown_and_says_what_it_presupposes():
    B = Basic("B")
    S = rectype(x=B, r=Application(Man, this.x))
    for T in (rectype(x=B, r=rectype()), rectype(x=B, r=rectype(e=B))):
        for ask in (equal, subtype):
            answer = ask(S, T)
            assert answer.unknown
            assert "it is not known that x is of Ind, in (" in answer.why


OPEN_IN = {
    "a list in a field": (lambda T: rectype(x=Rec, l=ListOf(T(this.x))), "x"),
    "a record inside": (lambda T: rectype(x=Rec, n=rectype(r=T(outer.x))), "x"),
    "a domain": (lambda T: rectype(x=Rec, f=T(this.x) >> Ind), "x"),
    "the body of a function": (lambda T: fun(x=Rec)(T(this.x)), "r"),
    "a list": (lambda T: ListOf(T("j")), "j"),
}


@pytest.mark.parametrize("name", OPEN_IN)
def test_what_is_presupposed_inside_is_named_as_it_is_called_there(name):
    make, called = OPEN_IN[name]
    value = make(lambda argument: Application(Man, argument))
    said = open_presupposition(value)
    assert said.startswith(f"it is not known that {called} is of Ind, in (")


def test_nothing_is_presupposed_where_nothing_is_kept():
    assert open_presupposition(rectype(x=Ind), ListOf(Ind)) == ""


def test_a_path_leads_through_the_parts_of_a_meet():
    run = Pred("run", Ind)
    n = rectype(m=rectype(x=Ind @ "a") & rectype(y=Ind)) & rectype(z=Ind)
    T = rectype(n=n, c=run(this.n.m.x), d=run(this.n.m.y), e=run(this.n.z))
    assert normal_form(T) is rectype(
        n=n, c=run("a"), d=run(this.n.m.y), e=run(this.n.z)
    )


def test_whether_two_are_equal_is_unknown_where_the_budget_ends():
    large = Ind
    for _ in range(12):
        large = rectype(l=large, r=large)
    with budget(steps=100):
        answer = equal(rectype(x=large, y=Application(Man, "j")), large)
    assert answer.unknown
    assert answer.why.startswith("too large: it takes more than 100 steps")


def test_a_failed_presupposition_names_the_argument_its_type_and_the_domain():
    B = Basic("B")
    M = Model().given("b1", B)
    why = M.judge("s", Man("b1")).why.rule
    assert "takes objects of Ind, which b1 is not" in why
    assert why.endswith("b1 is of B")
    with pytest.raises(RefusedError) as error:
        M.reduce(Man("b1"))
    assert error.value.message == why
    assert "\n" not in why


# --- no η ----------------------------------------------------------------------------


def test_a_function_and_its_expansion_are_two():
    """They do the same to whatever they are applied to; but equality is by form."""
    theory = Theory.parse(LEXICON)
    kind = theory.parse("((Ind -> RecType) -> (Ind -> RecType))")
    expanded = theory.parse(r"\f:(Ind -> RecType). \v:Ind. f(v)")
    itself = theory.parse(r"\f:(Ind -> RecType). f")
    assert equal(expanded, itself, theory).no
    assert equal(expanded, expanded, theory).yes
    for function in (expanded, itself):
        assert Model(theory).judge(function, kind).holds
    one, other = (
        rectype(f=Ind >> RecType, g=(Ind >> RecType) @ body)
        for body in (this.f, fun(v=Ind)(outer.f(this.v)))
    )
    for S, T in ((one, other), (other, one)):
        answer = subtype(S, T, theory)
        assert not answer.yes
        if answer.no:
            against = answer.counter
            assert against.model.judge(against.sit, S).holds
            assert not against.holds
    applied = theory.parse(r"(\f:(Ind -> RecType). \v:Ind. f(v))(Man)(j)")
    assert equal(applied, theory.parse("Man(j)"), theory).yes
    assert equal(theory.parse(r"\v:Ind. Man(v)"), theory.Man, theory).yes


def test_without_its_theory_a_sentence_with_a_name_is_not_compared_and_says_so():
    english = Theory.parse(LEXICON)
    narrow, wide = map(english.parse, ("John(Chase(Some(Red(Dog))))", SOME_DOG))
    assert subtype(narrow, wide, theory=english).yes
    answer = subtype(narrow, wide)
    assert answer.unknown
    assert "it is not known that j is of Ind" in answer.why
    assert answer.why.endswith("a theory may say so: subtype(S, T, theory)")
    refuted = subtype(english.parse("Some(Man)(Run)"), wide)
    assert refuted.no
    assert "it is not known that j is of Ind" in refuted.why


SOME_DOG = "John(Chase(Some(Dog)))"


def test_an_open_question_about_types_says_that_nothing_refutes_it():
    theory = Theory.parse(LEXICON + "check Every(Man)(Run) <= Some(Man)(Run)")
    (failure,) = check(theory).failures
    assert failure.found == "unknown"
    assert failure.why.endswith(
        "has no field x, but no counterexample was found: there may be no witness"
    )


@pytest.mark.parametrize(
    ("text", "function", "domain", "argument"),
    [
        ("Some(Man)(Chase(Dog))", "Chase", "Quantifier", "Dog"),
        ("Chase(Man)(Some(Dog))", "Chase", "Quantifier", "Man"),
        ("Red(Some)(Man)", "Red", "Property", "Some"),
        ("Dog('zoe')", "Dog", "Ind", "zoe"),
    ],
)
def test_a_sentence_that_does_not_compute_is_a_warning(
    text, function, domain, argument
):
    named = "Property := (Ind -> RecType)\nQuantifier := (Property -> RecType)\n"
    report = check(Theory.parse(f"{LEXICON}{named}X := {text}\nY := Some(Man)(Run)"))
    (fault,) = report.faults
    assert report.holds
    assert report.summary == "no mistakes and no checks, no fault and 1 warning"
    assert fault.span is not None
    assert fault.message == (
        f"X does not compute: {function} takes what is of {domain}, "
        f"and it is not known that {argument} is"
    )


def test_a_predicate_in_place_of_a_noun_is_told_with_the_noun():
    with pytest.raises(IllFormedError) as refused:
        Theory.parse(LEXICON + "X := Some(man)(Run)")
    error = refused.value
    assert (
        error.message == "Some takes objects of (Ind -> RecType), and man cannot be one"
    )
    assert error.hint == "did you mean Man?"
