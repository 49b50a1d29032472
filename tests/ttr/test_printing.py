"""Notation and Python out of types and objects."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import ttr
from ttr import (
    Basic,
    Ind,
    ListOf,
    Pi,
    Pred,
    Rec,
    RecType,
    Type,
    fun,
    outer,
    record,
    rectype,
    this,
)
from ttr.errors import UnsupportedError
from ttr.types import Application, EventString, Universe
from ttr.types.printing import notation
from ttr.types.short_notation import shorten_notation

dog, hug, asks = Pred("dog", Ind), Pred("hug", Ind, Ind), Pred("asks", Type)
A, Type1 = Basic("A"), Universe("Type", 1)

WRITTEN = {
    "[x : Ind, c : dog(x)]": rectype(c=dog(this.x), x=Ind),
    "[x = j : Ind]": rectype(x=Ind @ "j"),
    "[x : Ind, y = x : Ind]": rectype(x=Ind, y=Ind @ this.x),
    "[x : Ind, n : [c : dog(x)]]": rectype(x=Ind, n=rectype(c=dog(outer.x))),
    "[x : Ind, n : [c : dog(^.x), x : Ind]]": rectype(
        x=Ind, n=rectype(x=Ind, c=dog(outer.x))
    ),
    '[c : dog("x"), x : Ind]': rectype(x=Ind, c=dog("x")),
    "Rec": Rec,
    "list(Rec)": ListOf(Rec),
    "list([x : Ind])": ListOf(rectype(x=Ind)),
    "Ind@j": Ind @ "j",
    "(Ind@j)@j": (Ind @ "j") @ "j",
    "Type@(Ind@j)": Type @ (Ind @ "j"),
    "A /\\ Ind": Ind & Basic("A"),
    "(A /\\ Ind)@j": (Ind & Basic("A")) @ "j",
    "[m = [greet(a, b)] : list(Type)]": rectype(
        m=ListOf(Type) @ [Pred("greet", Ind, Ind)("a", "b")]
    ),
    "dog({n = 1, x = [2.5, -3]})": dog(record(x=[2.5, -3], n=1)),
    "dog([])": dog([]),
    "dog({})": dog({}),
    'dog("Rec")': dog("Rec"),
    "dog(Rec)": dog(Rec),
    'dog("a b")': dog("a b"),
    'dog("a\\nb\\"")': dog('a\nb"'),
    'dog("")': dog(""),
    "dog(été)": dog("été"),
    "dog(RecType)": dog(RecType),
    '"f"(a)(b)': Application("f", "a")("b"),
    "[P : (Ind -> Type), x : Ind, c : .P(x), d : P(x)]": rectype(
        P=Ind >> Type, x=Ind, c=this.P(this.x), d=Pred("P", Ind)(this.x)
    ),
    "[A : Type, c : asks(A)]": rectype(A=Type, c=asks(this.A)),
    "[A : Ind, c : asks(A /\\ A)]": rectype(A=Ind, c=asks(A)),
    "[A : Ind, c : asks(list(A)), d : asks([y : A])]": rectype(
        A=Ind, c=asks(ListOf(A)), d=asks(rectype(y=A))
    ),
    "[A : Ind, Rec : Ind, T = Type /\\ Type : Type^1, Type : Ind, x = "
    "{l = [A /\\ A, Rec /\\ Rec]} : Rec]": rectype(
        A=Ind, Rec=Ind, Type=Ind, T=Type1 @ Type, x=Rec @ record(l=[A, Rec])
    ),
    "[A : Ind, c : (Type@(A /\\ A)) \\/ asks(<(A /\\ A), a>)]": rectype(
        A=Ind, c=(Type @ A) | asks(EventString(A, "a"))
    ),
    "[A : Ind, f = \\x:A. A /\\ A : (A -> Type)]": rectype(
        A=Ind, f=(A >> Type) @ fun(x=A)(A)
    ),
    "\\x:Ind. asks(A)": fun(A=Ind)(asks(A)),
    "((x : Ind) -> [c : asks(A), d : dog(x)])": Pi(A=Ind)(
        rectype(c=asks(A), d=dog(outer.A))
    ),
    "((z : Ind) -> [c : asks(x), y : dog(z)])": Pi(A=Ind)(
        rectype(c=asks(Basic("x")), y=dog(outer.A))
    ),
    "\\x1:Ind. [x : Ind, y : Ind, z : hug(x1, y)]": fun(v=Ind)(
        rectype(x=Ind, y=Ind, z=hug(outer.v, this.y))
    ),
    "dog(<bool True>)": dog(True),
    "dog(<NoneType None>)": dog(None),
    "dog(<float nan>)": dog(float("nan")),
    "dog(<Fraction 1/2>)": dog(Fraction(1, 2)),
    "dog(<ndarray 3>)": dog(np.zeros(3)),
    "dog(<float64 1.5>)": dog(np.float64(1.5)),
}


@pytest.mark.parametrize("text", WRITTEN)
def test_notation(text):
    assert str(WRITTEN[text]) == text


@pytest.mark.parametrize("text", [text for text in WRITTEN if "dog(<" not in text])
def test_notation_reads_back(text):
    names = ttr.Theory.of(WRITTEN[text])
    assert names.parse(text) is WRITTEN[text]


@pytest.mark.parametrize(
    "text",
    [
        "rectype(x=Basic('Ind'), c=Pred('dog', Basic('Ind'))(this.x))",
        "rectype({'if': Basic('Ind'), 'c': Pred('p', Basic('Ind'))(this['if'])})",
        "rectype(x=Basic('Ind'), n=rectype(c=Pred('dog', Basic('Ind'))(outer.x)))",
        "rectype(x=Rec, n=rectype(m=rectype(x=Singleton(Basic('Ind'), outer(2).x))))",
        "Pred('open', (Basic('Ind'),), (Basic('Ind'), Basic('Ind')))",
        "Pred('rain')()",
        "Singleton(ListOf(Type), ())",
        "Singleton(ListOf(RecType), (Rec,))",
        "meet(Basic('A'), Basic('B'))",
        "record(n=record(x='a'), x=(1, 2.5, True, None))",
        "record({'if': 1, 'x': 'a'})",
    ],
)
def test_python_is_its_own_repr(text):
    names = {name: getattr(it, name) for it in (ttr, ttr.types) for name in it.__all__}
    assert repr(eval(text, names)) == text


def test_a_path_out_of_everything_keeps_its_dots():
    assert str(dog(this.x)) == "dog(.x)"
    assert str(rectype(c=dog(outer.x))) == "[c : dog(^.x)]"
    assert notation(dog(this.x), (frozenset({"x"}),)) == "dog(x)"


@pytest.mark.parametrize("shown", [str, repr])
def test_what_nests_too_deep_to_be_printed_is_said_so(shown):
    T, r = rectype(x=Ind), record(x="a")
    for _ in range(2000):
        T, r = rectype(n=T), record(n=r)
    for deep in (T, r):
        with pytest.raises(UnsupportedError, match="nests deeper than can be followed"):
            shown(deep)


# --- in few columns ------------------------------------------------------------------


@given(st.text("[](){}'\", ab:=\\", max_size=80), st.integers(1, 60))
def test_shortening_takes_any_text_and_adds_nothing(text: str, room: int) -> None:
    shown = shorten_notation(text, room)
    assert len(shown) <= len(text)
    assert shown == text or len(text) > room


def test_brackets_are_shortened_from_inside() -> None:
    deep = "[x : Ind, y : [z : [a : Ind, b : hug(a, ^^.x)], c : dog(x)], s = '[,' : A]"
    assert shorten_notation(deep, 80) == deep
    shown = "[x : Ind, y : [z : […], c : dog(x)], s = '[,' : A]"
    assert shorten_notation(deep, 60) == shown
    assert shorten_notation(deep, 40) == "[x : Ind, y : […], s = '[,' : A]"
    assert shorten_notation(deep, 24) == "[x : Ind, … 2 more]"


def test_a_derivation_has_room_for_each_of_its_steps() -> None:
    names = [f"a_label_{n}" for n in range(30)]
    T = rectype(**dict.fromkeys(names, Ind))
    M = ttr.Model().given("fido", Ind)
    why = M.judge(record(**dict.fromkeys(names, "fido")), T).why
    first, *others = str(why).splitlines()
    assert first.endswith("(field by field)")
    assert len(first) < 160
    assert " more} : [" in first
    assert len(others) == 30
    assert "a_label_29" in ttr.box(why)
