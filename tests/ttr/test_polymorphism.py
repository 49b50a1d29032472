"""Types that fields and variables stand for: [T : Type, x : T], \\T:Type. \\x:T. x."""

import pickle

import pytest

import ttr.types
from ttr import (
    Ind,
    Model,
    Pi,
    RecType,
    Theory,
    Type,
    box,
    check,
    fun,
    html,
    latex,
    merge,
    outer,
    record,
    rectype,
    relabel,
    subtype,
    this,
)
from ttr.computing import consistent, normal_form
from ttr.errors import IllFormedError
from ttr.types import ListOf, TypeAt, Universe

LOGIC = r"""
basic Ind
pred man(Ind), dog(Ind), about(Type^1), saying((Ind -> Type^1))
pred noting([T : Type^1]), listing(list(Type^1))
object a, b : Ind
Some := [T : Type, x : T]
I := \A:Type. \x:A. x
K := \A:Type. \B:Type. \x:A. \y:B. x
S := \A:Type. \B:Type. \C:Type. \f:(A -> (B -> C)). \g:(A -> B). \x:A. f(x)(g(x))
B := \A:Type. \B:Type. \C:Type. \f:(B -> C). \g:(A -> B). \x:A. f(g(x))
C := \A:Type. \B:Type. \D:Type. \f:(A -> (B -> D)). \x:B. \y:A. f(y)(x)
"""
NAMES = {**vars(ttr.types), **vars(ttr)}
theory = Theory.parse(LOGIC)
Some = theory.Some


@pytest.mark.parametrize(
    "claim",
    [
        "{T = Ind, x = a} : Some",
        "not {T = Ind, x = Some} : Some",
        "not {T = a, x = a} : Some",
        "{T = [y : Ind], x = {y = a}} : Some",
        "[T = Ind : Type, x = a : T] <= Some",
        "[T = Ind : Type, x : T] = [T = Ind : Type, x : Ind]",
        "[T = Ind : Type, x : T] <= [x : Ind]",
        "not Some <= [x : Ind]",
        "[T : Type, U = T : Type, x : T] <= [U : Type, x : U]",
        "not [T : Type, U : Type, x : T] <= [U : Type, x : U]",
        "[T : RecType, x : T] <= Some",
        "([T : Type, x : T] /\\ [T = Ind : Type]) <= [x : Ind]",
        "merge(Some, [T = Ind : Type]) = [T = Ind : Type, x : T]",
        "[T = [y : Ind] : Type, x : T, c : man(x.y)] <= [x : [y : Ind], c : man(x.y)]",
        "create(Some)",
        "create([T : Type, x = a : T])",
        "create([n : [T : Type], y = a : n.T])",
        "create([T : Type^1, x = Ind : T])",
        "{n = {T = Ind, x = a}, y = a} : [n : Some, y : n.T]",
        "[n = {T = Ind} : [T : Type], y : n.T] = [n = {T = Ind} : [T : Type], y : Ind]",
        "[n : [T = Ind : Type], y : n.T] <= [y : Ind]",
        "[T : Type, x : T] <= [T : Type, x : T \\/ Ind]",
        "((T : Type) -> (T -> T)) <= ((T : RecType) -> (T -> T))",
        "not [T : Type, x : Ind] <= Some",
        "create([T : Type, l : nelist(T), f : (T -> T)])",
        "[l : nelist(Type), x : fst(l)] <= [l : nelist(Type)]",
        "{l = [Ind], x = a} : [l : nelist(Type), x : fst(l)]",
        "wellformed(Some)",
    ],
)
def test_a_field_has_the_type_at_another_field(claim):
    report = check(Theory.parse(f"{LOGIC}check {claim}"))
    assert report.holds, str(report)


POLYMORPHIC = {
    "I": "((A : Type) -> (A -> A))",
    "K": "((A : Type) -> ((B : Type) -> (A -> (B -> A))))",
    "S": "((A : Type) -> ((B : Type) -> ((C : Type) -> "
    "((A -> (B -> C)) -> ((A -> B) -> (A -> C))))))",
    "B": "((A : Type) -> ((B : Type) -> ((C : Type) -> "
    "((B -> C) -> ((A -> B) -> (A -> C))))))",
    "C": "((A : Type) -> ((B : Type) -> ((C : Type) -> "
    "((A -> (B -> C)) -> (B -> (A -> C))))))",
}


@pytest.mark.parametrize(
    "claim",
    [
        *[f"{name} : {T}" for name, T in POLYMORPHIC.items()],
        *[f"create({T})" for T in POLYMORPHIC.values()],
        "I(Ind) : (Ind -> Ind)",
        "I(Ind)(a) = a",
        "K(Ind)(Ind)(a)(b) = a",
        "S(Ind)(Ind)(Ind) : ((Ind -> (Ind -> Ind)) -> ((Ind -> Ind) -> (Ind -> Ind)))",
        "S(Ind)((Ind -> Ind))(Ind)(K(Ind)((Ind -> Ind)))(K(Ind)(Ind)) = I(Ind)",
        "B(Ind)(Ind)(Ind)(I(Ind))(I(Ind)) = I(Ind)",
        "C(Ind)(Ind)(Ind)(K(Ind)(Ind))(a)(b) = b",
        "I([x : Ind])({x = a}) : [x : Ind]",
        "not K : ((A : Type) -> ((B : Type) -> (A -> (B -> B))))",
        # the codomain at the argument
        "(\\f:((T : Type) -> (T -> T)). f(Ind)(a)) : (((T : Type) -> (T -> T)) -> Ind)",
        "(\\f:((x : Ind) -> dog(x)). f(a)) : (((x : Ind) -> dog(x)) -> dog(a))",
        "[f : ((T : Type) -> (T -> T)), y = f(Ind)(a) : Ind] <= [y : Ind]",
        # a function is of its own type
        "(\\f:(Ind -> (Ind -> Ind)). \\x:Ind. \\y:Ind. f(x)(y)) : "
        "((Ind -> (Ind -> Ind)) -> (Ind -> (Ind -> Ind)))",
        "(\\f:((x : Ind) -> (man(x) -> dog(x))). \\x:Ind. \\e:man(x). f(x)(e)) : "
        "(((x : Ind) -> (man(x) -> dog(x))) -> ((x : Ind) -> (man(x) -> dog(x))))",
        "(\\P:(Ind -> Type). \\Q:(Ind -> Type). "
        "\\f:((x : Ind) -> (P(x) -> Q(x))). \\x:Ind. \\e:P(x). f(x)(e)) : "
        "((P : (Ind -> Type)) -> ((Q : (Ind -> Type)) -> "
        "(((x : Ind) -> (P(x) -> Q(x))) -> ((x : Ind) -> (P(x) -> Q(x))))))",
        # merges wait for what is merged
        "(\\R:RecType. merge(R, [x : Ind])) : (RecType -> RecType)",
        "(\\R:RecType. merge(R, [x : Ind]))([y : Ind]) = [x : Ind, y : Ind]",
        "not (\\R:Type. merge(R, [x : Ind])) : (Type -> RecType)",
        "(\\R:Type. R /\\ list(R)) : (Type -> Type)",
        # levels
        "((A : Type) -> (A -> A)) : Type^1",
        "not ((A : Type) -> (A -> A)) : Type",
        "(\\A:Type. list(A)) : (Type -> Type)",
        "(\\A:Type^1. list(A)) : (Type^1 -> Type^1)",
        "not (\\A:Type^1. list(A)) : (Type^1 -> Type)",
        "not (\\P:(Ind -> Type^1). list(P(a))) : ((Ind -> Type^1) -> Type)",
        "(\\P:(Ind -> Type^1). list(P(a))) : ((Ind -> Type^1) -> Type^1)",
        "not (\\P:(Ind -> Type^1). ~P(a)) : ((Ind -> Type^1) -> Type)",
        "not (\\P:(Ind -> Type^1). \\x:Ind. list(P(x))) : "
        "((Ind -> Type^1) -> (Ind -> Type))",
        "not (\\P:(Ind -> Type^1). ((x : Ind) -> P(x))) : ((Ind -> Type^1) -> Type)",
        "(\\P:(Ind -> Type). ((x : Ind) -> P(x))) : ((Ind -> Type) -> Type)",
        "not (\\R:(Ind -> (Ind -> Type^1)). [x : Ind, y : Ind, l : list(R(x)(y))]) : "
        "((Ind -> (Ind -> Type^1)) -> RecType)",
        "(\\R:(Ind -> (Ind -> RecType)). [x : Ind, y : Ind, l : list(R(x)(y))]) : "
        "((Ind -> (Ind -> RecType)) -> RecType)",
        "not (\\r:[f : (Ind -> Type^1)]. [x : Ind, l : r.f(x)]) : "
        "([f : (Ind -> Type^1)] -> RecType)",
        "(\\r:[f : (Ind -> Type^1)]. [x : Ind, l : r.f(x)]) : "
        "([f : (Ind -> Type^1)] -> RecType^1)",
        "not (\\f:((Ind -> Type^1) -> Type^1). list(f(\\x:Ind. Ind))) : "
        "(((Ind -> Type^1) -> Type^1) -> Type)",
        "not (\\A:Type^1. about(A)) : (Type^1 -> Type)",
        "(\\A:Type. about(A)) : (Type -> Type)",
        "not (\\P:(Ind -> Type^1). about(P(a))) : ((Ind -> Type^1) -> Type)",
        "not (\\P:(Ind -> Type^1). saying(P)) : ((Ind -> Type^1) -> Type)",
        "(\\P:(Ind -> Type^1). saying(P)) : ((Ind -> Type^1) -> Type^1)",
        "(\\P:(Ind -> RecType). saying(P)) : ((Ind -> RecType) -> Type)",
        "not (\\r:[T : Type^1]. noting(r)) : ([T : Type^1] -> Type)",
        "(\\r:[T : Type]. noting(r)) : ([T : Type] -> Type)",
        "not (\\l:list(Type^1). listing(l)) : (list(Type^1) -> Type)",
    ],
)
def test_functions_over_types(claim):
    report = check(Theory.parse(f"{LOGIC}check {claim}"))
    assert report.holds, str(report)


@pytest.mark.parametrize(
    ("T", "made"),
    [
        ("((x : Ind) -> [y = x : Ind])", r"\x:Ind. {y = x}"),
        ("((x : Ind) -> (dog(x) -> dog(x)))", None),
        ("((r : [x : Ind, c : dog(x)]) -> [e : dog(r.x)])", None),
        ("((x : Ind) -> [y = x : Ind, l : list(dog(y)), z : Ind])", None),
        ("((P : (Ind -> Type)) -> ((x : Ind) -> (P(x) -> P(x))))", None),
    ],
)
def test_a_function_is_made_up_whose_values_depend_on_its_argument(T, made):
    kind = theory.parse(T)
    f, model = Model(theory).create(kind)
    assert model.judge(f, kind).holds
    if made:
        assert f is theory.parse(made)


@pytest.mark.parametrize(
    ("T", "made"),
    [
        ("((x : Ind) -> nelist([y = x : Ind]))", r"\x:Ind. [{y = x}]"),
        ("((x : Ind) -> set([y = x : Ind]))", r"\x:Ind. set{}"),
        ("((x : Ind) -> list([y = x : Ind]))", r"\x:Ind. []"),
        ("((x : Ind) -> ([z : man(x)] \\/ [y = x : Ind]))", r"\x:Ind. {y = x}"),
        ("((x : Ind) -> [y = x : Ind, z : dog(a)])", r"\x:Ind. {y = x, z = s1}"),
        ("((x : [y = a : Ind]) -> [z = x.y : Ind])", r"\r:[y = a : Ind]. {z = r.y}"),
        (
            "((x : Ind) -> ((Ind -> (Ind -> dog(x))) -> dog(x)))",
            r"\x:Ind. \f:(Ind -> (Ind -> dog(x))). f(x)(x)",
        ),
        (
            "((x : Ind) -> ((man(a) -> dog(x)) -> dog(x)))",
            r"\x:Ind. \f:(man(a) -> dog(x)). f(s1)",
        ),
    ],
)
def test_the_body_of_a_function_is_put_together(T, made):
    kind = theory.parse(T)
    f, model = Model(theory).create(kind)
    assert str(f) == made
    assert model.judge(f, kind).holds


def test_what_no_function_is_of_is_not_made_up():
    assert check(Theory.parse(f"{LOGIC}check error create(((A : Type) -> A))")).holds


@pytest.mark.parametrize(
    "written",
    [
        "[T : Type, x : T]",
        "[T : Type, x : T, y : [T : Ind, z : ^.T]]",
        '[Ind : Type, x : Ind, y : "Ind", l : list("Ind")]',
        "[P : [T : Type], x : .P.T]",
        r"\T:Type. \x:T. x",
        "((T : Type) -> (T -> (list(T) -> T)))",
        "[l : nelist(Type), x : fst(l)]",
        "[T : Type, n : [x : T, s = T : Type]]",
        "[T : Type, a : T /\\ Ind, b : T \\/ Ind, c : ~T]",
    ],
)
def test_it_reads_back_as_it_is_printed(written):
    T = theory.parse(written)
    assert Theory.of(T).parse(str(T)) is T
    assert eval(repr(T), NAMES) is T
    assert pickle.loads(pickle.dumps(T)) is T


def test_a_label_of_types_hides_the_type_of_its_name():
    T = theory.parse("[Ind : Type, x : Ind]")
    assert T is rectype(Ind=Type, x=this.Ind)
    assert theory.parse("[Ind : Ind, x : Ind]") is rectype(Ind=Ind, x=Ind)
    assert theory.parse(r"\Ind:Type. \x:Ind. x") is theory.I


def test_it_is_drawn():
    assert box(Some) == "⎡T : Type⎤\n⎣x : T   ⎦"
    assert "\\mathrm{x} & : & \\mathrm{T}" in latex(Some)
    assert "T" in html(Some)


def test_it_is_written_in_python():
    assert rectype(T=Type, x=this.T) is Some
    assert rectype(T=Type, x=lambda r: r.T) is Some
    assert Pi(T=Type)(lambda T: T >> T) is theory.parse(POLYMORPHIC["I"])
    assert fun(T=Type)(fun(x=outer_variable())(this.x)) is theory.I
    T = rectype(T=Type, x=this.T & Ind, y=~this.T | Ind, n=rectype(z=outer.T @ "a"))
    assert T is theory.parse(
        "[T : Type, x : T /\\ Ind, y : ~T \\/ Ind, n : [z = a : T]]"
    )


def outer_variable():
    """The variable of the function that is put around."""
    return TypeAt(this.T)


def test_as_an_object_it_is_the_path():
    assert (Type @ TypeAt(this.T)).value is (Type @ this.T).value
    assert rectype(T=Type, l=ListOf(Type) @ (this.T,)) is rectype(
        T=Type, l=ListOf(Type) @ (TypeAt(this.T),)
    )


def test_labels_that_are_renamed_are_followed():
    assert relabel(Some, T="U", x="y") is rectype(U=Type, y=this.U)


def test_merging():
    U = rectype(T=Type @ Ind)
    assert merge(Some, U) is rectype(T=Type @ Ind, x=this.T)
    assert normal_form(merge(Some, U)) is rectype(T=Type @ Ind, x=Ind)


def test_a_counterexample_is_found():
    answer = subtype(Some, rectype(T=Type, x=Ind))
    assert answer.no
    assert answer.counter.sit.T is not Ind


def test_consistency_is_of_what_it_stands_for():
    assert consistent(rectype(T=Type @ (Ind @ "a"), x=this.T), rectype(x=Ind @ "b")).no
    assert consistent(Some, rectype(T=Type @ Ind)).yes


@pytest.mark.parametrize(
    ("written", "why"),
    [
        (
            "[T : Ind, x : T]",
            "in the field x, expected a type, found T, which is of Ind",
        ),
        (r"\T:Ind. \x:T. x", "expected a type, found T, which is of Ind"),
        ("[T = a : Ind, x : .T]", "expected a type, found T"),
        ("[f : (Ind -> Type), x : f]", "expected a type, found f"),
    ],
)
def test_only_types_stand_for_types(written, why):
    with pytest.raises(IllFormedError) as error:
        theory.parse(written)
    assert why in error.value.message


def test_what_turns_out_to_be_no_type_has_no_witnesses():
    T = rectype(T=Type, x=this.T)
    judgement = Model().judge(record(T="a", x="b"), T)
    assert not judgement.holds
    assert not Model().judge("a", TypeAt("b")).holds


def test_levels_go_along():
    high = rectype(T=Universe("Type", 1), x=this.T)
    M = Model()
    assert M.judge(record(T=Type, x=Ind), high).holds
    assert not M.judge(record(T=Type, x=Ind), Some).holds
    assert M.judge(record(T=RecType, x=Ind), high).holds is False
