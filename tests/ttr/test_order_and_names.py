"""The order of fields and the names of variables belong to the text of a theory."""

import subprocess
import sys

import pytest

from ttr import (
    Ind,
    Pi,
    Pred,
    Rec,
    RecType,
    Theory,
    Type,
    box,
    fun,
    latex,
    load,
    rectype,
)
from ttr.cli.main import main
from ttr.errors import IllFormedError
from ttr.types import Function, FunType, Path
from ttr.types.objects import BOUND
from ttr.types.printing import notation

TEXT = r"""
basic Ind
pred man(Ind), hug(Ind, Ind)
object j : Ind
Hug := [y : Ind, x : Ind, c : hug(x, y)]
Same := [x : Ind, y : Ind, c : hug(x, y)]
Man := \v:Ind. [e : man(v)]
Boy := \w:Ind. [e : man(w)]
Pair := [two : Hug, one : Hug, of = Man : (Ind -> RecType)]
Some := \A:(Ind -> RecType). [x : Ind, r : A(x), b : Ind]
All := ((who : Ind) -> (man(who) -> hug(who, j)))
"""
theory = Theory.parse(TEXT)

AS_WRITTEN = {
    "Hug": "[y : Ind, x : Ind, c : hug(x, y)]",
    "Same": "[x : Ind, y : Ind, c : hug(x, y)]",
    "Man": r"\v:Ind. [e : man(v)]",
    "Boy": r"\w:Ind. [e : man(w)]",
    "Some": r"\A:(Ind -> RecType). [x : Ind, r : A(x), b : Ind]",
    "All": "((who : Ind) -> (man(who) -> hug(who, j)))",
    "Pair": "[two : [y : Ind, x : Ind, c : hug(x, y)], "
    "one : [y : Ind, x : Ind, c : hug(x, y)], "
    r"of = \v:Ind. [e : man(v)] : (Ind -> RecType)]",
}


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "t.ttr"
    path.write_text(TEXT, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("name", AS_WRITTEN)
def test_a_name_is_shown_as_it_is_written(name, file, capsys):
    assert main(["show", file, name]) == 0
    assert capsys.readouterr().out == f"{name} := {AS_WRITTEN[name]}\n"
    assert theory.parse(AS_WRITTEN[name]) is theory[name]


def test_names_inside_are_shown_as_they_are_written(file, capsys):
    assert main(["show", file, "Pair", "--unfold", "0"]) == 0
    shown = "[two : Hug, one : Hug, of = Man : (Ind -> RecType)]"
    assert capsys.readouterr().out == f"Pair := {shown}\n"


def test_a_name_is_drawn_as_it_is_written(file, capsys):
    assert main(["show", file, "Hug", "--as", "box"]) == 0
    drawn = "⎡y : Ind      ⎤\n⎢x : Ind      ⎥\n⎣c : hug(x, y)⎦"
    assert capsys.readouterr().out.strip() == drawn == box(theory.Hug, theory=theory)
    main(["show", file, "Hug", "--as", "latex"])
    assert capsys.readouterr().out.strip() == latex(theory.Hug, theory=theory)
    assert "\\mathrm{y} & : " in latex(theory.Hug, theory=theory).splitlines()[1]


def test_a_node_has_one_order_and_names_of_its_own():
    assert theory.Hug is theory.Same
    assert theory.Man is theory.Boy
    assert str(theory.Hug) == "[x : Ind, y : Ind, c : hug(x, y)]"
    assert str(theory.Man) == str(theory.Boy) == r"\x:Ind. [e : man(x)]"


def test_a_name_that_is_taken_gets_a_number():
    scope = theory.spelling_of("Man")
    both = Function(Ind, theory.Man)
    assert notation(both, scope) == r"\x:Ind. \v:Ind. [e : man(v)]"
    twice = fun(x=Ind)(lambda x: theory.Man(x)).body
    inner = Function(Ind, Function(Ind, twice.function.body))
    assert notation(inner, scope) == r"\x:Ind. \v:Ind. [e : man(v)]"
    assert notation(Function(Ind, inner), scope).startswith(r"\x:Ind. \y:Ind. \v:")
    around = Theory.parse(r"basic Ind" "\n" r"F := \v:Ind. \v:Ind. v")
    assert notation(around.F, around.spelling_of("F")) == r"\v:Ind. \v1:Ind. v1"


@pytest.mark.parametrize(
    ("definition", "said"),
    [
        (r"F := \who:[x : Ind, f : Type]. hug(j, who.f)", "needs Ind for who.f"),
        (r"F := \who:(Ind -> Type). hug(j, who)", "hug(j, who) needs Ind for who"),
        (r"F := Man([z : Ind, a : Ind])", "Man takes objects of Ind, and [z : Ind, a"),
        (
            "F := [b : Ind, f : (Ind -> Type), c : [y : Ind, d : man(^.f)]]",
            "man(f) needs Ind for f",
        ),
    ],
)
def test_an_error_of_a_definition_has_its_names(definition, said):
    with pytest.raises(IllFormedError) as error:
        Theory.parse(f"{TEXT}{definition}")
    assert said in error.value.message


def test_what_is_printed_depends_on_no_other_node():
    program = (
        "from ttr import *\n"
        "keep = Theory.parse({other!r})\n"
        "from ttr.types.printing import notation\n"
        "t = Theory.parse({text!r})\n"
        "print(*[notation(t[n], t.spelling_of(n)) for n in t.definitions], sep='\\n')\n"
        "print(*[repr(t[n]) + str(t[n]) for n in t.definitions], sep='\\n')\n"
    )
    others = "", TEXT.replace("v", "q").replace("w:", "u:").replace("(w)", "(u)")
    printed = [
        subprocess.run(
            [sys.executable, "-c", program.format(other=other, text=TEXT)],
            capture_output=True,
            encoding="utf-8",
            check=True,
            env={"PYTHONIOENCODING": "utf-8"},
        ).stdout
        for other in others
    ]
    assert printed[0] == printed[1]


def test_variables_have_the_names_that_are_usual():
    man = Pred("man", Ind)
    assert str(fun(w=Rec)(lambda w: Rec @ w)) == r"\r:Rec. Rec@r"
    assert str(fun(a=Ind >> Type)(lambda a: a("j"))) == r"\P:(Ind -> Type). P(j)"
    assert str(fun(a=Ind >> RecType)(lambda a: a("j"))) == (
        r"\P:(Ind -> RecType). P(j)"
    )
    assert (
        str(fun(a=Ind >> Ind)(lambda a: man(a("j")))) == r"\f:(Ind -> Ind). man(f(j))"
    )
    assert str(Pi(a=Type)(lambda a: a >> a)) == "((T : Type) -> (T -> T))"
    assert repr(fun(a=Type)(lambda a: a)) == "fun(T=Type)(this.T)"


def test_a_name_given_to_a_node_is_forgotten():
    x = Path(0, (BOUND,))
    assert Function(Ind, x, "v") is Function(Ind, x)
    assert FunType(Ind, Ind, "v") is FunType(Ind, Ind)


def test_the_text_of_an_imported_theory_counts(tmp_path):
    (tmp_path / "one.ttr").write_text("basic A\nX := [b : A, a : A]", encoding="utf-8")
    path = tmp_path / "two.ttr"
    path.write_text('import "one.ttr"\nY := [z : X, y : X]', encoding="utf-8")

    found = load(path)
    wanted = "[z : [b : A, a : A], y : [b : A, a : A]]"
    assert notation(found.Y, found.spelling_of("Y")) == wanted


def test_rectype_of_python_has_the_order_of_the_node():
    assert rectype(y=Ind, x=Ind) is rectype(x=Ind, y=Ind)
    assert str(rectype(y=Ind, x=Ind)) == "[x : Ind, y : Ind]"
