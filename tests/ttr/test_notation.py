"""The notation: it reads back what is printed, and says what is wrong with the rest."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from ttr.errors import IllFormed, NotationError, TTRError
from ttr.notation import parse
from ttr.syntax import (
    Basic,
    Ind,
    ListOf,
    Object,
    Path,
    Pred,
    Rec,
    RecType,
    Singleton,
    Type,
    TypeNode,
    Universe,
    meet,
    outer,
    record,
    rectype,
    this,
)
from ttr.theories import Theory

A, B = Basic("A"), Basic("B")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
sees = Pred("sees", (Ind,), (Ind, A))
rains = Pred("rains", ())

KENNEL = Theory.parse(
    """
    basic Ind, A, B
    pred  dog(Ind), hug(Ind, Ind), sees(Ind), sees(Ind, A), rains()
    Dog := [x : Ind, c : dog(x)]
    object fido, sam : Ind
    home := {x = fido, of = Dog}
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


def test_types_read_are_the_types_built() -> None:
    assert parse("[x : Ind, c : dog(x)]", using=[Ind, dog]) is rectype(
        x=Ind, c=dog(this.x)
    )


def test_parse_alone_knows_the_logical_types_only() -> None:
    assert parse("[t : Type, r : Rec, l : list(RecType)]")["r"] is Rec
    with pytest.raises(NotationError, match="nothing is called Ind here"):
        parse("Ind")


# --- what is printed reads back ------------------------------------------------------


@dataclass(frozen=True)
class Place:
    """A field that a path may lead to: how far out, its labels, its basic type."""

    up: int
    labels: tuple[str, ...]
    type: Basic


LABELS = ("x", "y", "c", "fido", "list", "Type", "check", "not", "in", "größe")
NAMES = st.one_of(
    st.sampled_from(
        (
            "fido",
            "x",
            "y",
            "c",
            "list",
            "Type",
            "Rec",
            "basic",
            "Type_1",
            "a b",
            "",
            "it's",
            "é",
        )
    ),
    st.sampled_from(
        ('say "hi"', "a\\b", "\n\t\u2028\x00\x7f", "\\u0041", "[x : A]", "#")
    ),
    st.text(max_size=4).filter(lambda name: not name.startswith("λ")),
)
NUMBERS = st.integers() | st.floats(allow_nan=False, allow_infinity=False)
PREDICATES = (dog, hug, sees, rains, Pred("p", A, B))


@st.composite
def objects(draw: st.DrawFn, around: tuple[Place, ...], depth: int) -> Object:
    match draw(st.integers(0, 5 if depth else 1)):
        case 0:
            return draw(NAMES)
        case 1:
            return draw(NUMBERS)
        case 2:
            return tuple(draw(st.lists(objects(around, depth - 1), max_size=3)))
        case 3:
            labels = st.sampled_from(LABELS)
            fields = st.dictionaries(labels, objects(around, depth - 1), max_size=2)
            return record(draw(fields))
        case _:
            return draw(types(around, depth - 1))


@st.composite
def individuals(draw: st.DrawFn, wanted: TypeNode, around: tuple[Place, ...]) -> Object:
    fitting = [place for place in around if place.type is wanted]
    if fitting and draw(st.booleans()):
        place = draw(st.sampled_from(fitting))
        return Path(place.up, place.labels)
    return draw(NAMES)


@st.composite
def types(draw: st.DrawFn, around: tuple[Place, ...] = (), depth: int = 3) -> TypeNode:
    match draw(st.integers(0, 6 if depth else 2)):
        case 0:
            return draw(st.sampled_from((Ind, A, B)))
        case 1:
            return draw(st.sampled_from((Type, RecType, Rec, Universe("Type", 1))))
        case 2:
            pred = draw(st.sampled_from(PREDICATES))
            arity = draw(st.sampled_from(pred.arities))
            return pred(*[draw(individuals(wanted, around)) for wanted in arity])
        case 3:
            return ListOf(draw(types(around, depth - 1)))
        case 4:
            return meet(
                *draw(st.lists(types(around, depth - 1), min_size=2, max_size=3))
            )
        case 5:
            base = draw(types(around, depth - 1))
            if isinstance(base, Basic):
                return Singleton(base, draw(individuals(base, around)))
            return Singleton(base, draw(objects(around, depth - 1)))
    return draw(record_types(around, depth))


@st.composite
def record_types(draw: st.DrawFn, around: tuple[Place, ...], depth: int) -> TypeNode:
    labels = draw(
        st.lists(st.sampled_from(LABELS), min_size=1, max_size=4, unique=True)
    )
    basic = labels[: draw(st.integers(1, len(labels)))]
    fields: dict[str, TypeNode] = {
        label: draw(st.sampled_from((Ind, A, B))) for label in basic
    }
    inside = tuple(Place(p.up + 1, p.labels, p.type) for p in around)
    inside += tuple(Place(0, (label,), T) for label, T in fields.items())
    for label in labels[len(basic) :]:
        fields[label] = draw(types(inside, depth - 1))
    return rectype(fields)


@given(types())
@example(rectype(x=Ind, y=rectype(x=Ind, c=dog(outer.x))))
@example(rectype(x=Ind, c=hug("x", this.x)))
@example(rectype(x=Ind, t=Type @ rectype(c=dog(outer.x))))
@example(Singleton(Singleton(Ind, "a"), "b"))
def test_what_is_printed_reads_back(T: TypeNode) -> None:
    assert Theory.of(T).parse(str(T)) is T


@given(types())
def test_the_order_and_the_spaces_do_not_matter(T: TypeNode) -> None:
    theory = Theory.of(T)
    if '"' in str(T):
        return
    spread = str(T).replace(",", " \n , ").replace("[", "[ # so\n").replace("/\\", "∧")
    assert theory.parse(spread) is T


def test_theory_of_refuses_two_predicates_of_one_name() -> None:
    with pytest.raises(IllFormed, match="two predicates are called dog"):
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
        ("[x : Ind, y : .x]", 15, "expected a type, found the path .x", ""),
        ("[x : Ind, y : x]", 15, "expected a type, found x, which is no type", ""),
        ("fido.x", 1, "fido is an object without labels", ""),
        ("home.z", 1, "the path z leads nowhere", ""),
        ("[c : dog(^.x)]", 10, "goes out of 1, but stands in 1", "each ^ goes out"),
        ("dog(.x)", 5, "a path stands in a record type", ""),
        ("[x : Ind, c dog(x)]", 13, "expected : or =, found dog", ""),
        ("[x : Ind", 9, "expected a comma or ], found the end of the text", ""),
        ("[x : Ind,]", 10, "expected a label, found ]", ""),
        ("[x = fido]", 10, "expected :, found ]", "[x = a : T]"),
        ("[x : Ind = fido]", 10, "expected a comma or ], found =", "[x = a : T]"),
        ("[x := Ind]", 5, "expected a type, found =", "x = a : T"),
        ("{x : fido}", 4, "expected =, found :", "{x = a}"),
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
        ("[" * 100_000, 101, "brackets nest at most 100 deep", "a name of its own"),
        ("^" * 100_000, 100_001, "expected", ""),
        (r"A \/ B", 3, r"a join S \/ T is not part of this version", ""),
        ("A | B", 3, r"a join S \/ T is not part of this version", ""),
        ("¬A", 1, "a negation ~T is not part", ""),
        ("(A -> B)", 4, "a function type (S -> T) is not part", ""),
        ("((x : A) -> B)", 5, "a dependent function type ((x : S) -> T) is not", ""),
        (r"\x:A. x", 1, r"a function \x:T. body is not part", ""),
        ("λx:A. x", 1, r"a function \x:T. body is not part", ""),
        ("fun x:A. x", 5, "a function fun x:T. body is not part", ""),
        ("<fido sam>", 1, "<…>, a string of events", ""),
        ("<ndarray 3>", 1, "an object without notation, is not part", ""),
        ("set(A)", 1, "set(…) is not part of this version", ""),
        ("plus(str(A))", 1, "plus(…) is not part of this version", ""),
        ("{fido, sam}", 6, "a set {a, b} is not part", ""),
        ("Type^1000", 5, "expected the end, found ^", "Type^1 to Type^999"),
        ("Type_1000", 1, "nothing is called Type_1000 here", ""),
        ("dog(fido)(sam)", 10, "an application of a function", ""),
        ("[f : A, y = f(fido) : A]", 13, "f(…), the application of a function", ""),
        ("fido + sam", 6, "a concatenation a + b is not part", ""),
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
    ],
)
def test_says_what_is_ill_formed(text: str, column: int, said: str) -> None:
    with pytest.raises(IllFormed) as caught:
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


def test_deep_types_are_read_and_printed() -> None:
    text = "[x : " * 99 + "list(A)" + "]" * 99
    assert str(KENNEL.parse(text)) == text


SIGNS = st.sampled_from(
    (
        *"[](){}:=,.@&#'\"^<>-+~\\|/ \n",
        *("/\\", "<:", ":=", "x", "Ind", "dog", "fido", "list", "Type", "1", "1.5"),
        *(
            "basic ",
            "pred ",
            "object ",
            "given ",
            "check ",
            "import ",
            "open ",
            "rule ",
        ),
        *("not ", "in ", "P(", "merge(", "create(", "\n  ", "é", "∧", "λ", "²", "\x00"),
    )
)
TEXTS = st.lists(SIGNS, max_size=30).map("".join) | st.text(max_size=30)


@given(TEXTS)
@example("[x = y : dog(y)")
@example("Rec@{x = .y}")
@example("import '\\u0000'")
@example("import '.'")
def test_no_text_does_worse_than_a_ttr_error(text: str) -> None:
    for read in (KENNEL.parse, Theory.parse):
        with suppress(TTRError):
            read(text)
