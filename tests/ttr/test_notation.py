"""The notation: what is read, and what is said of the rest."""

from __future__ import annotations

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pi,
    Plus,
    Pred,
    Rec,
    RecType,
    SetOf,
    Str,
    Theory,
    TTRError,
    Type,
    fun,
    join,
    meet,
    outer,
    parse,
    record,
    rectype,
    this,
)
from ttr.errors import IllFormedError, NotationError
from ttr.types import (
    Application,
    EventString,
    FiniteSet,
    Negation,
    NonEmpty,
    Universe,
    concat,
    fst,
    rst,
)
from ttr.types.objects import Object
from ttr.types.printing import notation

A, B = Basic("A"), Basic("B")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
sees = Pred("sees", (Ind,), (Ind, A))
rains = Pred("rains", ())
Prop = Ind >> Type

KENNEL = Theory.parse(
    r"""
    basic Ind, A, B
    pred  dog(Ind), hug(Ind, Ind), sees(Ind), sees(Ind, A), rains()
    Dog := [x : Ind, c : dog(x)]
    object fido, sam : Ind
    home := {x = fido, of = Dog}
    barks := \x:Ind. dog(x)
    both := \x:Ind. \y:Ind. hug(x, y)
    is_dog := dog
    """
)


# --- what is read --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("Ind", Ind),
        ("  ( Ind )  # a comment", Ind),
        ("dog(fido)", dog("fido")),
        ("rains()", rains()),
        ("sees(fido)", sees("fido")),
        ("sees(fido, 'a')", sees("fido", "a")),
        ("[x : Ind, c : dog(x)]", rectype(x=Ind, c=dog(this.x))),
        ("[c : dog(.x), x : Ind]", rectype(x=Ind, c=dog(this.x))),
        ("[x = fido : Ind]", rectype(x=Ind @ "fido")),
        ("[x = y : Ind, y : Ind]", rectype(x=Ind @ this.y, y=Ind)),
        (
            "[x : Ind, in : [c : dog(x)]]",
            rectype({"x": Ind, "in": rectype(c=dog(outer.x))}),
        ),
        (
            "[x : Ind, y : [x : Ind, c : dog(^.x)]]",
            rectype(x=Ind, y=rectype(x=Ind, c=dog(outer.x))),
        ),
        (
            "[x : Ind, y : [z : [c : dog(^^.x)]]]",
            rectype(x=Ind, y=rectype(z=rectype(c=dog(outer(2).x)))),
        ),
        (
            "[b : [x : Ind], c : dog(b.x)]",
            rectype(b=rectype(x=Ind), c=dog(this["b.x"])),
        ),
        ("[fido : Ind, c : dog(fido)]", rectype(fido=Ind, c=dog(this.fido))),
        ("[fido : Ind, c : dog('fido')]", rectype(fido=Ind, c=dog("fido"))),
        ("Ind@fido", Ind @ "fido"),
        ("(A /\\ B)@'b'", meet(A, B) @ "b"),
        ("A /\\ B", meet(A, B)),
        ("A & B", meet(A, B)),
        ("A ∧ B", meet(A, B)),
        ("list(list(A))", ListOf(ListOf(A))),
        ("[x : []]", rectype(x=Rec)),
        ("[x : Rec, t : Type, r : RecType]", rectype(x=Rec, t=Type, r=RecType)),
        ("[]", ()),
        ("[fido, 1, -2.5, 'a b']", ("fido", 1, -2.5, "a b")),
        ("{x = fido, y = {z = [A]}}", record(x="fido", y=record(z=(A,)))),
        (
            "[content = [x : Ind] : RecType]",
            rectype(content=RecType @ rectype(x=Ind)),
        ),
        (
            "[spkr : Ind, addr : Ind, moves = [hug(spkr, addr)] : list(Type)]",
            rectype(
                spkr=Ind, addr=Ind, moves=ListOf(Type) @ [hug(this.spkr, this.addr)]
            ),
        ),
        (
            "[t : Type^1, r : RecType_2]",
            rectype(t=Universe("Type", 1), r=Universe("RecType", 2)),
        ),
        ("[Type_1 : A, t : Type_1]", rectype(Type_1=A, t=Universe("Type", 1))),
        ("[moves = [] : list(Type)]", rectype(moves=ListOf(Type) @ ())),
        ("Dog", rectype(x=Ind, c=dog(this.x))),
        ("home.x", "fido"),
        ("list(home.of)", ListOf(rectype(x=Ind, c=dog(this.x)))),
        ("'it\\'s'", "it's"),
        ('"say \\"no\\" \\u00e9"', 'say "no" é'),
        ("[list : A, Type : A, check : A]", rectype(list=A, Type=A, check=A)),
    ],
)
def test_reads(text: str, value: Object) -> None:
    found = KENNEL.parse(text)
    assert type(found) is type(value)
    assert found == value


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("A \\/ B", join(A, B)),
        ("A | B", join(A, B)),
        ("A ∨ B", join(A, B)),
        ("A \\/ B /\\ Ind", join(A, meet(B, Ind))),
        ("(A \\/ B) /\\ Ind", meet(join(A, B), Ind)),
        ("~A", Negation(A)),
        ("¬¬A", Negation(Negation(A))),
        ("~A /\\ B", meet(Negation(A), B)),
        ("~Ind@fido", Negation(Ind @ "fido")),
        ("(~Ind)@fido", Negation(Ind) @ "fido"),
        ("~dog(fido)", Negation(dog("fido"))),
        ("nelist(A)", NonEmpty(A)),
        ("set(A \\/ B)", SetOf(join(A, B))),
        ("str(A, dog(fido))", Str(A, dog("fido"))),
        ("str()", Str()),
        ("plus(str(A, B))", Plus(Str(A, B))),
        ("merge([x : A], [y : B])", rectype(x=A, y=B)),
        ("amerge([x : A, y : A], [x : B])", rectype(x=B, y=A)),
        (
            "[x : Ind, r : merge([a : Ind], [a = x : Ind])]",
            rectype(x=Ind, r=rectype(a=Ind @ outer.x)),
        ),
        ("(Ind -> Type)", Prop),
        ("Ind → Type", Prop),
        ("A -> B -> Ind", A >> (B >> Ind)),
        ("(A -> B) -> Ind", (A >> B) >> Ind),
        ("A \\/ B -> ~Ind", join(A, B) >> Negation(Ind)),
        ("((x : Ind) -> dog(x))", Pi(x=Ind)(dog(this.x))),
        ("(x : Ind) → dog(x)", Pi(x=Ind)(dog(this.x))),
        (
            "(x : Ind) -> (y : Ind) -> hug(x, y)",
            Pi(x=Ind)(Pi(y=Ind)(hug(outer.x, this.y))),
        ),
        ("[f : A -> B, x : A]", rectype(f=A >> B, x=A)),
        ("list(A -> B)", ListOf(A >> B)),
    ],
)
def test_reads_types(text: str, value: Object) -> None:
    assert KENNEL.parse(text) is value


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("\\x:Ind. dog(x)", fun(x=Ind)(dog(this.x))),
        ("λx:Ind. dog(x)", fun(x=Ind)(dog(this.x))),
        ("λ x : Ind . dog(x)", fun(x=Ind)(dog(this.x))),
        ("fun x:Ind. dog(x)", fun(x=Ind)(dog(this.x))),
        ("\\y:Ind.\ndog(y)", fun(x=Ind)(dog(this.x))),
        ("λx:Ind. λy:Ind. hug(x, y)", fun(x=Ind)(fun(y=Ind)(hug(outer.x, this.y)))),
        ("\\x:Ind. A /\\ dog(x)", fun(x=Ind)(meet(A, dog(this.x)))),
        ("\\r:[x : Ind]. dog(r.x)", fun(r=rectype(x=Ind))(dog(this.r.x))),
        ("\\P:Ind -> Type. P(fido)", fun(P=Prop)(this.P("fido"))),
        ("\\x:Ind. [y = x : Ind]", fun(x=Ind)(rectype(y=Ind @ outer.x))),
        ("\\x:Ind. [x : Ind, c : dog(x)]", fun(y=Ind)(rectype(x=Ind, c=dog(this.x)))),
        ("\\x:Ind. \\x:Ind. x", fun(x=Ind)(fun(y=Ind)(this.y))),
        ("\\fido:Ind. dog(fido)", fun(x=Ind)(dog(this.x))),
        ("\\dog:(Ind -> Type). dog(fido)", fun(P=Prop)(this.P("fido"))),
        ("\\Ind:Ind. list(Ind)", fun(x=Ind)(ListOf(Ind))),
        (
            "[f = \\x:Ind. x : (Ind -> Ind)]",
            rectype(f=(Ind >> Ind) @ fun(x=Ind)(this.x)),
        ),
        (
            "[x : A, f = \\y:Ind. [y, .x, x] : A]",
            rectype(x=A, f=A @ fun(z=Ind)([this.z, outer.x, outer.x])),
        ),
        ("[\\x:A. x, λy:A. y]", (fun(x=A)(this.x),) * 2),
        ("(\\x:Ind. dog(x))(fido)", Application(fun(x=Ind)(dog(this.x)), "fido")),
        ("barks(fido)", Application(fun(x=Ind)(dog(this.x)), "fido")),
        ("fido(sam)", Application("fido", "sam")),
        ("'f g'(sam)(1)", Application(Application("f g", "sam"), 1)),
        ("both(fido, sam)", KENNEL.both("fido", "sam")),
        ("both(fido)(sam)", KENNEL.both("fido", "sam")),
        ("is_dog(fido)", dog("fido")),
        ("(dog)(fido)", dog("fido")),
        ("barks(dog)", Application(KENNEL.barks, dog)),
        (
            "[P : (Ind -> Type), x : Ind, c : P(x)]",
            rectype(P=Prop, x=Ind, c=this.P(this.x)),
        ),
        (
            "[dog : (Ind -> Type), x : Ind, c : dog(x), d : .dog(x)]",
            rectype(dog=Prop, x=Ind, c=dog(this.x), d=this.dog(this.x)),
        ),
        (
            "[b : [f : (Ind -> Ind)], x : Ind, y = b.f(x) : Ind]",
            rectype(b=rectype(f=Ind >> Ind), x=Ind, y=Ind @ this.b.f(this.x)),
        ),
    ],
)
def test_reads_functions(text: str, value: Object) -> None:
    assert KENNEL.parse(text) == value


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("{fido, sam, fido}", FiniteSet("fido", "sam")),
        ("{{fido}, set{}, {}}", FiniteSet(FiniteSet("fido"), FiniteSet(), record())),
        ("set{}", FiniteSet()),
        ("set{ fido }", FiniteSet("fido")),
        ("<fido sam>", EventString("fido", "sam")),
        ("<fido, sam 3,'a'>", EventString("fido", "sam", 3, "a")),
        ("<>", EventString()),
        ("<<fido> <>>", EventString(EventString("fido"), EventString())),
        ("<dog(fido) [sam] {x = 1}>", EventString(dog("fido"), ("sam",), record(x=1))),
        ("<fido, (A -> B), A /\\ B>", EventString("fido", A >> B, meet(A, B))),
        ("[fido] + [sam, 1] + []", ("fido", "sam", 1)),
        ("<fido> + <sam>", EventString("fido", "sam")),
        ("fst([fido, sam])", "fido"),
        ("rst([fido, sam])", ("sam",)),
        (
            "[x : list(A), y : list(A), z = x + [fido] + .y : list(A)]",
            rectype(
                x=ListOf(A),
                y=ListOf(A),
                z=ListOf(A) @ concat(this.x, ["fido"], this.y),
            ),
        ),
        (
            "[x : nelist(A), y = fst(x) : A, z = rst(x) : list(A)]",
            rectype(x=NonEmpty(A), y=A @ fst(this.x), z=ListOf(A) @ rst(this.x)),
        ),
        (
            "[set : A, in : A, s = <set in> : A]",
            rectype({"set": A, "in": A, "s": A @ EventString(this.set, this["in"])}),
        ),
    ],
)
def test_reads_collections_and_strings(text: str, value: Object) -> None:
    assert KENNEL.parse(text) == value


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("λ", "λ"),
        ("λx", "[λx : A, c = λx : A, f = λλx:A. λx : (A -> A)]"),
        ("fun", "[fun : A, s = <fun fun> : str(A, A)]"),
        ("λx", "{λx = 'λx', y = <λx 'λx'>}"),
    ],
)
def test_names_may_be_like_signs(name: str, text: str) -> None:
    theory = Theory.of(A, name)
    assert theory.parse(str(theory.parse(text))) == theory.parse(text)


def test_types_read_are_the_types_built() -> None:
    assert parse("[x : Ind, c : dog(x)]", using=[Ind, dog]) is rectype(
        x=Ind, c=dog(this.x)
    )


def test_what_a_theory_calls_merge_is_meant() -> None:
    put = Pred("merge", Ind, Ind)
    assert parse("merge('a', 'b')", using=[put]) is put("a", "b")


def test_parse_alone_knows_the_logical_types_only() -> None:
    assert parse("[t : Type, r : Rec, l : list(RecType)]")["r"] is Rec
    with pytest.raises(NotationError, match="nothing is called Ind here"):
        parse("Ind")


def test_theory_of_refuses_two_predicates_of_one_name() -> None:
    with pytest.raises(IllFormedError, match="two predicates are called dog"):
        Theory.of(dog("a"), Pred("dog", A)("a"))


# --- what is no notation -------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "column", "said", "hint"),
    [
        ("", 1, "expected a type or an object, found the end of the text", ""),
        ("[x : Ind, c : dgo(x)]", 15, "there is no predicate dgo", "did you mean dog?"),
        ("[x : Idn]", 6, "nothing is called Idn here", "did you mean Ind?"),
        ("[c : dog(fdio)]", 10, "nothing is called fdio here", "did you mean fido?"),
        ("dog(rex)", 5, "nothing is called rex here", "quote it to name an object"),
        ("[x : Ind, c : dog]", 15, "the predicate dog without arguments", "(Ind)"),
        ("Ind(fido)", 1, "Ind is a type and takes no arguments", ""),
        ("[x : fido]", 6, "expected a type, found the object fido", ""),
        ("[x : 'a']", 6, "expected a type, found the object 'a'", ""),
        ("[x : [fido]]", 6, "expected a type, found the list [fido]", ""),
        ("[x : {a = 1}]", 6, "expected a type, found the record {a = 1}", ""),
        ("[x : Ind, y : .x]", 15, "expected a type, found x, which is of Ind", ""),
        ("[x : Ind, y : x]", 15, "expected a type, found x, which is of Ind", ""),
        ("fido.x", 1, "fido is an object without labels", ""),
        ("home.z", 1, "the path z leads nowhere", ""),
        ("[c : dog(^.x)]", 10, "goes out of every record type", "there is 1 around it"),
        ("dog(.x)", 5, "a path stands in a record type", ""),
        ("[x : Ind, c dog(x)]", 13, "expected : or =, found dog", ""),
        ("[x : Ind", 9, "expected a comma or ], found the end of the text", ""),
        ("[x : Ind,]", 10, "expected a label, found ]", ""),
        ("[x = fido]", 10, "expected :, found ]", "[x = a : T]"),
        ("[x : Ind = fido]", 10, "expected a comma or ], found =", "[x = a : T]"),
        ("[x := Ind]", 5, "expected a type, found =", "x = a : T"),
        ("{x : fido}", 4, "expected =, a comma or }, found :", "{x = a}"),
        ("dog(fido, c : Ind)", 13, "expected a comma or ), found :", ""),
        ("Ind Ind", 5, "expected the end, found Ind", ""),
        ("Ind@fido@sam", 9, "expected the end, found @", "(T@a)@b"),
        ("[x : A /\tall]", 8, "expected a comma or ], found /", "write r'…'"),
        ("[x : \x07Ind]", 6, "the control character '\\x07'", "write r'…'"),
        ("A /\right", 4, "the control character '\\r'", "write r'…'"),
        ("dog('a)", 5, "found 'a)", "does not close on this line"),
        ('dog("\\q")', 5, "has an unknown escape", "the escapes are"),
        ("dog(‘a’)", 5, "‘a’ is no name", "quotes are straight"),
        ("dog(1e999)", 5, "the number is too large", ""),
        ("dog(" + "9" * 5000 + ")", 5, "the number is too large", ""),
        ("list(A, B)", 1, "list takes one type, but has 2", ""),
        ("[" * 100_000, 101, "types and objects nest at most 100 deep", "a name"),
        ("^" * 100_000, 1, "expected", ""),
        ("Type^1000", 5, "expected the end, found ^", "Type^1 to Type^999"),
        ("Type_1000", 1, "nothing is called Type_1000 here", ""),
        (r"\x:Ind.dog(x)", 14, "expected a dot and the body", "a space after the dot"),
        ("fun x:Ind.dog(x)", 17, "expected a dot and the body", "a space after"),
        ("λx:Ind.dog(x)", 3, "expected the end, found :", "a space after the dot"),
        (r"\r:[x : Ind].dog(r.x)", 13, "expected a dot and the body", "a space after"),
        (r"\x:Ind dog(x)", 8, "expected a dot and the body, found dog", ""),
        (r"\x. dog(x)", 3, "expected :, found .", r"is written \x:T. body"),
        (r"\:Ind. x", 2, "expected a variable, found :", r"is written \x:T. body"),
        (r"\x:Ind.", 8, "expected the body of the function", ""),
        (r"A /\ \x:A. x", 6, "expected a type, found \\", "write brackets"),
        (r"\x:Idn. dog(x)", 4, "nothing is called Idn here", "did you mean Ind?"),
        (r"\tail:Ind. dog(tial)", 16, "nothing is called tial", "did you mean tail?"),
        (r"\x:Ind. .x", 9, "a path stands in a record type, but there is none", ""),
        (r"[f = \x:A. ^.y : A]", 12, "goes out of every record type", "each ^ goes"),
        (r"[x : \y:A. y]", 6, r"expected a type, found the function \y:A. y", ""),
        ("(x : Ind)", 10, "expected ->, found the end of the text", ""),
        ("(x : Ind) dog(x)", 11, "expected ->, found dog", ""),
        ("[f : A -> ]", 11, "expected a type, found ]", ""),
        ("A -> fido", 6, "expected a type, found the object fido", ""),
        ("A \\/", 5, "expected a type, found the end of the text", ""),
        ("~", 2, "expected a type, found the end of the text", ""),
        ("fido +", 7, "expected a list or a string of events", ""),
        ("fido + sam", 1, "only lists and strings can be concatenated", ""),
        ("fst([])", 1, "there is no first element: it is an empty list", ""),
        ("fst(fido, sam)", 1, "fst takes one list, but has 2", ""),
        ("merge(A)", 1, "merge takes two types, but has 1", ""),
        ("merge(A, fido)", 10, "expected a type, found the object fido", ""),
        ("merg(A, B)", 1, "there is no predicate merg", "did you mean merge?"),
        ("set(A, B)", 1, "set takes one type, but has 2", ""),
        ("str(fido)", 5, "expected a type, found the object fido", ""),
        ("set {}", 5, "expected the end, found {", "the empty one set{}"),
        ("{fido, x = 1}", 10, "expected a comma or }, found =", ""),
        ("[x : {fido}]", 6, "expected a type, found the set {fido}", ""),
        ("[x : <fido>]", 6, "expected a type, found the string of events <fido>", ""),
        ("[x : fst(A)]", 6, "there is no first element: it is no list", ""),
        ("<fido", 6, "expected an event, a comma or >, found the end of", ""),
        ("<fdio sam>", 2, "nothing is called fdio here", "did you mean fido?"),
        (
            "<ndarray 3>",
            1,
            "<ndarray 3> has no notation, so it cannot",
            "declare ndarray",
        ),
        ("<bool True>", 1, "<bool True> has no notation, so it cannot", ""),
        ("<Fraction 1/2>", 12, "expected an event, a comma or >", "does not read back"),
        ("barsk(fido)", 1, "there is no predicate barsk", "did you mean barks?"),
        ("home(fido)", 1, "home is no function and takes no arguments", ""),
        ("3(fido)", 1, "3 is no function and takes no arguments", ""),
        ("Dog(fido)", 1, "Dog is a type and takes no arguments", ""),
        ("barks()", 1, "a function is applied to an argument", ""),
        ("^ .x", 1, "found ^", "a path has no spaces in it"),
        ("\u202edog(fido)", 1, r"'\u202edog' is no name", ""),
        ("dog(fido)\u200f", 10, r"found '\u200f'", ""),
    ],
)
def test_says_what_is_wrong(text: str, column: int, said: str, hint: str) -> None:
    with pytest.raises(TTRError) as caught:
        KENNEL.parse(text)
    error = caught.value
    assert said in error.message
    assert hint in error.hint
    assert error.span is not None
    assert (error.span.line, error.span.column) == (1, column)


@pytest.mark.parametrize(
    ("text", "column", "said"),
    [
        ("[x : Ind, c : dog(x, x)]", 15, "dog takes 1 argument (Ind), but has 2"),
        ("[x : Ind, c : dog(.y)]", 15, "the path y leads nowhere"),
        ("[x : A, c : dog(x)]", 13, "needs Ind for x, but that is of A"),
        ("[x : Ind, x : Ind]", 11, "the label x is there twice"),
        ("{x = 1, x = 2}", 9, "the label x is there twice"),
        ("[_x : Ind]", 2, "a label is an identifier that does not start with _"),
        (r"\x:A. dog(x)", 7, "needs Ind for x, but that is of A"),
        (r"((x : A) -> dog(x))", 13, "needs Ind for x, but that is of A"),
        (r"\r:[x : A]. [y : A, z : [c : dog(r.x)]]", 30, "needs Ind for r.x"),
        ("[x : A, n : [y : Ind, c : dog(y), d : dog(x)]]", 39, "needs Ind for x"),
        ("[x = y : A, y = x : A, c : dog(x)]", 28, "needs Ind for x"),
        (r"[x : A, f = \y:A. [c : dog(x)] : A]", 9, "needs Ind for x"),
        (r"\r:[x : Ind]. dog(r.y)", 15, "leads nowhere: [x : Ind] has no y"),
        (r"\_x:Ind. dog('a')", 2, "an identifier that does not start with _"),
    ],
)
def test_says_what_is_ill_formed(text: str, column: int, said: str) -> None:
    with pytest.raises(IllFormedError) as caught:
        KENNEL.parse(text)
    assert said in caught.value.message
    assert caught.value.span is not None
    assert caught.value.span.column == column


def test_the_place_is_shown() -> None:
    with pytest.raises(NotationError) as caught:
        KENNEL.parse("[x : Ind,\n c : dgo(x)]")
    assert str(caught.value).splitlines() == [
        "there is no predicate dgo",
        "  ┌─ <text>:2:6",
        "2 │  c : dgo(x)]",
        "  │      ^^^",
        "help: did you mean dog?",
    ]


def test_what_is_no_text_is_refused() -> None:
    with pytest.raises(NotationError, match="expected a text to read, found int"):
        KENNEL.parse(3)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "text",
    [
        "[" * 200,
        "(" * 200 + "A" + ")" * 200,
        "<" * 200,
        "~" * 200 + "A",
        "A -> " * 200 + "A",
        "(x : A) -> " * 200 + "A",
        r"\x:A. " * 200 + "x",
        "λx:A. " * 200 + "x",
        "fun x:A. " * 200 + "x",
        "fido" + "(sam)" * 200,
        "(A -> ~" * 60 + "A" + ")" * 60,
        "A -> A /\\ B -> ~" * 60 + "A",
    ],
)
def test_how_deep_a_text_may_nest_is_told(text: str) -> None:
    with pytest.raises(NotationError, match="nest at most 100 deep") as caught:
        KENNEL.parse(text)
    assert caught.value.span is not None
    assert caught.value.span.column > 1


@pytest.mark.parametrize(
    "text",
    [
        r" /\ ".join(f"~~dog({i})" for i in range(200)),
        "[" + ", ".join(f"x{i} : (A -> A) -> A" for i in range(200)) + "]",
        " + ".join(["[~A, 'f'(1)(2)]"] * 200),
        "<" + " ".join(["'f'(1)(2)"] * 200) + ">",
    ],
)
def test_a_text_may_be_as_broad_as_it_likes(text: str) -> None:
    value = KENNEL.parse(text)
    assert Theory.of(value).parse(notation(value)) == value


def test_deep_types_are_read_and_printed() -> None:
    text = "[x : " * 99 + "list(A)" + "]" * 99
    assert str(KENNEL.parse(text)) == text


@pytest.mark.parametrize("text", ["dog(x.a°)", "dog(^.a°)", "dog(.a°.b)"])
def test_each_label_of_a_path_is_a_name(text):
    with pytest.raises(NotationError, match="a° is no name: a name is letters, digit"):
        KENNEL.parse(f"[x : [a : Ind], y : {text}]")
