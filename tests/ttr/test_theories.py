"""Theories: what statements declare, what they refuse, and what their checks find."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from contextlib import suppress
from pathlib import Path
from types import FrameType

import pytest

import ttr
from ttr.building.constructors import rectype
from ttr.computing.subtyping import subtype
from ttr.errors import (
    IllFormedError,
    MistakesError,
    NotationError,
    RefusedError,
    Span,
    TTRError,
)
from ttr.judging.models import Model
from ttr.notation.parser import parse_statement
from ttr.notation.syntax_trees import Part, Source
from ttr.signature.signature import Axiom
from ttr.theories.checking import check
from ttr.theories.loading import UnreadableError
from ttr.theories.statements import StatementReader
from ttr.theories.theory import Theory, load, theory_of_draft
from ttr.theories.theory_draft import Draft
from ttr.types.objects import Path as LabelPath
from ttr.types.path_notation import this
from ttr.types.syntax import Basic, Ind, Pred

NAMES = """
basic Ind, Image
pred  dog(Ind), puppy(Ind), hug(Ind, Ind), left(Ind, Ind), right(Ind, Ind)
"""


def theory(text: str) -> Theory:
    return Theory.parse(NAMES + text)


def mistake(text: str) -> TTRError:
    with pytest.raises(TTRError) as caught:
        theory(text)
    return caught.value


# --- declaring -----------------------------------------------------------------------


def test_what_is_declared_is_an_item_and_an_attribute() -> None:
    kennel = theory("Dog := [x : Ind, c : dog(x)]")
    dog = Pred("dog", Ind)
    assert kennel["Dog"] is kennel.Dog is rectype(x=Ind, c=dog(this.x))
    assert kennel.Ind is Ind
    assert kennel["dog"] is dog


def test_a_misspelt_attribute_is_told_with_a_suggestion() -> None:
    kennel = theory("Dog := [x : Ind, c : dog(x)]")
    with pytest.raises(AttributeError, match="the theory has no Dgo: did you mean Dog"):
        _ = kennel.Dgo
    with pytest.raises(KeyError, match="the theory has no zebra"):
        _ = kennel["zebra"]


def test_a_theory_is_a_signature() -> None:
    kennel = theory("puppy(x) <: dog(x)\nopen hug, Image")
    puppy, dog = kennel.predicates["puppy"], kennel.predicates["dog"]
    x = LabelPath(0, ("x",))
    assert kennel.signature.axioms == (Axiom(puppy(x), dog(x)),)
    assert str(kennel.axioms[0]) == "puppy(x) <: dog(x)"
    assert kennel.opened == {kennel.predicates["hug"], Basic("Image")}
    assert subtype(puppy("rex"), dog("rex"), kennel).yes


def test_a_predicate_has_the_arities_it_is_declared_with() -> None:
    found = Theory.parse("basic A, B\npred p(A), q(), p(A, B)\npred p(B)\nT := p('a')")
    A, B = Basic("A"), Basic("B")
    assert found["p"] is Pred("p", (A,), (A, B), (B,))
    assert found["q"] is Pred("q", ())


def test_statements_go_on_in_brackets_and_over_indented_lines() -> None:
    plain = theory("Dog := [x : Ind, c : dog(x)]").Dog
    assert theory("Dog := [\nx : Ind, # the dog\nc : dog(x)\n]\nbasic A").Dog is plain
    assert theory("Dog :=\n  [x : Ind,\n  c : dog(x)]\nbasic A").Dog is plain
    assert Theory.parse("basic A\n    basic B").names == {"A", "B"}
    assert Theory.parse("\n  basic A,\n    B\n  basic C\n").names == {"A", "B", "C"}
    assert Theory.parse("basic A\r\nbasic B\r\n").names == {"A", "B"}
    assert Theory.parse("").names == frozenset()


def test_objects_are_given_and_may_be_quoted() -> None:
    found = theory("object fido, 'rex 1' : Ind\ngiven s1 : hug(fido, 'rex 1') = 0.5")
    assert found.objects == {"fido", "rex 1", "s1"}
    assert [(g.sit, str(g.type), g.p) for g in found.givens] == [
        ("fido", "Ind", (1.0, 1.0)),
        ("rex 1", "Ind", (1.0, 1.0)),
        ("s1", 'hug(fido, "rex 1")', (0.5, 0.5)),
    ]


def test_a_quoted_name_in_an_axiom_is_an_object() -> None:
    found = theory("right(x, 'car') <: left('car', x)")
    right, left = found.predicates["right"], found.predicates["left"]
    assert subtype(right("a", "car"), left("car", "a"), found).yes
    assert not subtype(right("a", "b"), left("b", "a"), found).yes
    assert str(found.axioms[0]) == 'right(x, "car") <: left("car", x)'


@pytest.mark.parametrize(
    ("text", "place", "said", "hint"),
    [
        (
            "Dog := [x : Ind, c : dgo(x)]",
            (4, 22),
            "no predicate dgo",
            "did you mean dog",
        ),
        ("A := [b : B]\nB := [x : Ind]", (4, 11), "B is used before its def", "move"),
        ("A := [x : A]", (4, 11), "A is used before its definition in line 4", ""),
        ("A := p(a)\npred p(Ind)", (4, 6), "p is used before its definition", ""),
        ("dog := Ind", (4, 1), "dog is already a predicate", ""),
        ("Ind := Image", (4, 1), "Ind is already a basic type", ""),
        ("X := Ind\nX := Ind", (5, 1), "X is already defined", ""),
        ("basic dog", (4, 7), "dog is already a predicate", ""),
        ("pred list(Ind)", (4, 6), "list is a reserved word", ""),
        ("object Type : Ind", (4, 8), "Type is a reserved word", ""),
        ("object dog : Ind", (4, 8), "dog is already a predicate", ""),
        ("X := dog('a')\npred dog(Image)", (5, 6), "dog gets another arity after", ""),
        ("open dgo", (4, 6), "there is no basic type or predicate dgo", "dog"),
        ("given s : dog('a') = 1.5", (4, 22), "a number in [0, 1]", ""),
        ("given s : dog('a') in [0.5, 0.2]", (4, 23), "lower first", ""),
        ("dog(x) <: hug(x, y)", (4, 11), "the variable y stands on the right", "'y'"),
        ("dog(x.y) <: dog(x)", (4, 5), "only names stand for objects", ""),
        ("[x : Ind] <: Rec", (4, 1), "an axiom relates basic types and", ""),
        ("bsaic A", (4, 7), "expected := or <:, found A", "did you mean basic?"),
        ("Dog = Ind", (4, 5), "expected := or <:, found =", "written Name := T"),
        ("fido : Ind", (4, 6), "expected := or <:, found :", "write given a : T"),
        ("rule greet", (4, 11), "expected (, found the end of", "rule name(s : S"),
        ("check dog('a')", (4, 7), "this cannot be checked", "a : T"),
        ("check P(Ind) = [0.5]", (4, 16), "a number in [0, 1]", ""),
        (
            "check P('a' : Ind /\\ 'b' : Ind) = 1",
            (4, 15),
            "a condition is written after |, as in P(a : T | b : S)",
            "a function type stands in brackets",
        ),
        ('import "no such file.ttr"', (4, 1), "there is no file no such file.ttr", ""),
        (
            "F := \\x:Ind.dog(x)",
            (4, 19),
            "expected a dot and the body",
            "a space after",
        ),
        ("f(x) := dog(x)", (4, 6), "expected <:, found :=", "f := \\x:T. body"),
        ("F := \\x:Image. dog(x)", (4, 16), "needs Ind for x, but", ""),
        ("F := \\x:Ind. dog(x)\nT := list(F)", (5, 11), "expected a type, found F", ""),
        ("F := \\x:Ind. dog(x)\npred p(F)", (5, 8), "expected a type, found F", ""),
        ("check P('a') = 0.5", (4, 9), "expected a type, found the object 'a'", ""),
        ("Dog := [x : Ind", (4, 16), "expected a comma or ], found the end", ""),
    ],
)
def test_a_mistake_is_told_with_its_place(
    text: str, place: tuple[int, int], said: str, hint: str
) -> None:
    error = mistake(text)
    assert said in error.message
    assert hint in error.hint
    assert error.span is not None
    assert (error.span.line, error.span.column) == place


def test_an_ill_formed_definition_is_ill_formed() -> None:
    error = mistake("Hug := [x : Ind, e : hug(x)]")
    assert isinstance(error, IllFormedError)
    assert error.message == "hug takes 2 arguments (Ind, Ind), but has 1"
    assert error.span is not None
    assert (error.span.line, error.span.column, error.span.length) == (4, 22, 6)


def test_reading_stops_after_a_hundred_mistakes() -> None:
    error = mistake("X := Y\n" * 1000)
    assert isinstance(error, MistakesError)
    *first, last = error.errors
    assert len(first) == 100
    assert last.message == "reading stops after 100 mistakes"
    assert last.span is not None
    assert last.span.line == 104


def test_every_mistake_is_told_and_each_only_once() -> None:
    error = mistake(
        """
Dog := [x : Ind, c : dgo(x)]
Dogs := list(Dog)
check Dogs <= list(Ind)
Cat := [x : Ind
pred meow(Ind)
Meow := [x : Ind, c : meow(x), d : hug(x)]
"""
    )
    assert isinstance(error, MistakesError)
    assert isinstance(error, NotationError)
    spans = [one.span for one in error.errors]
    assert [span and span.line for span in spans] == [5, 8, 10]
    assert "there is no predicate dgo" in str(error)


def test_mistakes_can_be_sent_to_another_process() -> None:
    # In a process of its own: Dask would send what led to an error with it.
    sent = r"""
        import pickle, ttr
        try:
            ttr.Theory.parse("Dog := [x : Ind, c : dgo(x)]\nCat := [x : Ind")
        except ttr.TTRError as error:
            again = pickle.loads(pickle.dumps(error))
            assert len(error.errors) > 1 and str(again) == str(error)
            print("the same")
    """
    command = [sys.executable, "-c", textwrap.dedent(sent)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout == "the same\n", done.stderr


# --- importing -----------------------------------------------------------------------


def test_an_import_is_relative_to_the_file_and_read_once(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "base.ttr").write_text("basic Ind\nobject fido : Ind\ncheck fido : Ind")
    (tmp_path / "sub" / "dogs.ttr").write_text(
        'import "../base.ttr"\npred dog(Ind)\nDog := [x : Ind, c : dog(x)]'
    )
    (tmp_path / "all.ttr").write_text(
        'import "base.ttr"\nimport "sub/dogs.ttr"\ncheck Dog <= [x : Ind]'
    )
    found = load(tmp_path / "all.ttr")
    assert found.names == {"Ind", "fido", "dog", "Dog"}
    assert len(found.givens) == 1
    assert len(found.checks) == 1
    assert check(found).holds


def test_imports_in_a_circle_are_told(tmp_path: Path) -> None:
    (tmp_path / "a.ttr").write_text('basic A\nimport "b.ttr"')
    (tmp_path / "b.ttr").write_text('import "a.ttr"')
    with pytest.raises(NotationError) as caught:
        load(tmp_path / "a.ttr")
    assert caught.value.message == "the imports go in a circle: a.ttr → b.ttr → a.ttr"


def test_a_mistake_in_an_import_has_its_place_there(tmp_path: Path) -> None:
    (tmp_path / "a.ttr").write_text('import "b.ttr"\nX := list(B)')
    (tmp_path / "b.ttr").write_text("basic A\nB := list(C)")
    with pytest.raises(NotationError, match="nothing is called C here") as caught:
        load(tmp_path / "a.ttr")
    assert caught.value.span is not None
    assert Path(caught.value.span.source).name == "b.ttr"
    assert caught.value.span.line == 2


def test_an_import_must_agree_with_what_is_there(tmp_path: Path) -> None:
    (tmp_path / "b.ttr").write_text("basic A, B\npred p(A)")
    for text, said in (
        ("basic A, B\npred p(B)", "the import declares p in another way"),
        ("basic A, p", "the import declares p in another way"),
    ):
        (tmp_path / "a.ttr").write_text(f'{text}\nimport "b.ttr"')
        with pytest.raises(NotationError, match=said):
            load(tmp_path / "a.ttr")


def test_what_cannot_be_read_is_told(tmp_path: Path) -> None:
    (tmp_path / "latin.ttr").write_bytes(b"basic Gr\xf6\xdfe")
    for name, said in (
        ("none.ttr", "there is no file"),
        ("latin.ttr", "is no text: it must be UTF-8"),
        (".", "is a folder, not a file"),
        ("\0", "is no path of a file"),
    ):
        with pytest.raises(UnreadableError, match=said):
            load(tmp_path / name)


# --- checking ------------------------------------------------------------------------

WORLD = """
puppy(x) <: dog(x)
Dog := [x : Ind, c : dog(x)]
object fido, sam : Ind
given s1 : puppy(fido)
given s2 : hug(fido, sam) = 0.5
given s3 : hug(sam, fido) in [0.2, 0.4]
barks := \\x:Ind. dog(x)
hugs := λx:Ind. λy:Ind. hug(x, y)
of := fun P:(Ind -> Type). [x : Ind, c : P(x)]
"""


@pytest.mark.parametrize(
    "claim",
    [
        "fido : Ind",
        "not 'nobody' : Ind",
        "{x = fido, c = s1} : Dog",
        "not {x = sam, c = s1} : Dog",
        "unknown s2 : hug(fido, sam)",
        "unknown s9 : hug(fido, sam)".replace("s9", "'s9'"),
        "error {x = fido} : [x : Ind, c : dog(x, x)]",
        "[x : Ind, c : dog(x), y : Ind] <= Dog",
        "not [x : Ind] <= Dog",
        "[x : Ind, c : puppy(x)] ⊑ Dog",
        "Dog = [c : dog(x), x : Ind]",
        "not Dog = Ind",
        "not 1 = 1.0",
        "fido = 'fido'",
        "merge([x : Ind], [c : dog('a')]) = [x : Ind, c : dog('a')]",
        "not merge([x : Ind], [y : Ind]) = [x : Ind]",
        "amerge([x = fido : Ind], [x : Ind]) = [x : Ind]",
        "create(Dog)",
        "error create([x = y : Ind, y = x : Ind])",
        "wellformed(Dog)",
        "not wellformed([x : Ind, c : dog(x, x)])",
        "not wellformed([x = y : Ind, y = x : Ind])",
        "not wellformed([x : [a = ^.y : Ind], y = x.a : Ind])",
        "not wellformed([x : Image, c : dog(x)])",
        "P(s2 : hug(fido, sam)) = 0.5",
        "P(s3 : hug(sam, fido)) = [0.2, 0.4]",
        "P(s3 : hug(sam, fido)) in [0, 0.5]",
        "not P(s3 : hug(sam, fido)) in [0.3, 0.5]",
        "P(fido : Ind) = 1",
        "barks(fido) = dog(fido)",
        "not barks(fido) = dog(sam)",
        "dog(fido) = barks(fido)",
        "hugs(fido, sam) = hug(fido, sam)",
        "hugs(fido)(sam) = hug(fido, sam)",
        "of(barks) = [x : Ind, c : barks(x)]",
        "(\\x:Ind. x)(fido) = fido",
        "error barks('nobody') = dog('nobody')",
        "error fido(sam) = sam",
        "s1 : barks(fido)",
        "error s1 : barks('nobody')",
        "not s1 : ~barks(fido)",
        "of(barks) <= [x : Ind]",
        "merge(hugs(fido, sam), dog(sam)) = hug(fido, sam) /\\ dog(sam)",
        "create(of(barks))",
        "barks : (Ind -> Type)",
        "\\x:Ind. x : (Ind -> Ind)",
        "[fido] + [sam] = [fido, sam]",
        "fst([fido, sam]) = fido",
        "{fido, sam} : set(Ind)",
        "<s1 s1> : plus(dog(fido))",
        "Image <= ~~Image",
        "Ind <= Ind \\/ Image",
    ],
)
def test_a_true_claim_holds_and_its_opposite_fails(claim: str) -> None:
    assert check(theory(WORLD + "check " + claim)).holds
    words = claim.split(" ", 1)
    expected = words[0] if words[0] in ("not", "unknown", "error") else ""
    opposite = words[1] if expected else "not " + claim
    report = check(theory(WORLD + "check " + opposite))
    assert not report.holds
    assert str(report.failures[0]).startswith("failed: check ")


def test_a_failure_says_what_was_found_and_why() -> None:
    report = check(theory("check [x : Ind] <= [x : Ind, y : Ind]"))
    (failure,) = report.failures
    assert (failure.check.expected, failure.found) == ("yes", "no")
    assert failure.why == "[x : Ind] has no field y"
    assert failure.check.span.line == 4


def test_givens_that_contradict_one_another_are_told_with_their_place() -> None:
    with pytest.raises(TTRError) as caught:
        check(theory("given {x = 1} : [x = 2 : Ind]\ncheck 1 : Ind"))
    assert caught.value.span is not None
    assert caught.value.span.line == 4


def test_the_package_offers_theories() -> None:
    assert ttr.Theory is Theory
    assert ttr.load is load
    assert str(ttr.check(theory("check Ind <= Ind"))) == "1 check holds"


# --- how long it takes ---------------------------------------------------------------

STATEMENTS = {
    "definitions": "T{} := [x : Ind, c : dog(x)]",
    "objects": "object a{} : Ind",
    "facts": "given s{} : dog('rex')",
    "checks": "check unknown 'rex{}' : Image",
    "axioms": "hug(x, 'a{}') <: dog(x)",
    "rules": "rule r{}(s : [x : Ind]) of k := [x = s.x : Ind]",
    "strategies": "rule r{0}(s : Rec) := Rec\nstrategy s{0} := maybe(r{0})",
    "names nobody declared": "T{} := [x : Spoilt]",
}


@pytest.mark.parametrize("kind", STATEMENTS)
def test_a_text_is_read_in_linear_time(kind: str) -> None:
    """Counted are calls, of Python and of what is built in, rather than seconds."""
    line = STATEMENTS[kind]
    spoilt = "Spoilt := Nobody\n" * (kind == "names nobody declared")

    def calls(count: int) -> int:
        text = spoilt + "\n".join(line.format(i) for i in range(count))
        counted = 0

        def count_call(frame: FrameType, event: str, argument: object) -> None:
            nonlocal counted
            counted += event in ("call", "c_call")

        sys.setprofile(count_call)
        try:
            with suppress(NotationError):
                theory(text)
        finally:
            sys.setprofile(None)
        return counted

    calls(50)
    assert calls(2000) < 4.5 * calls(500)


def test_a_mistake_in_a_statement_adds_nothing_of_it() -> None:
    draft = Draft.of(theory(""))
    for text in (
        "basic A, dog",
        "pred p(Ind), q(Idn)",
        "object a, dog : Ind",
        "given a : Ind = 3",
        "open Ind, Nobody",
        "X := [x : Idn]",
        "puppy(x) <: dog(y)",
        "rule r(s : [x : Ind]) := [x = s.y : Ind]",
        "strategy n := by_class(k)",
        "game g({x = a} : [x : Ind]) := n",
        "check dog",
    ):
        source = Source(text)
        with pytest.raises(TTRError):
            StatementReader(draft, source).declare(
                parse_statement(source, 0, len(text))
            )
    left, before = theory_of_draft(draft), theory("")
    assert left.names == before.names
    assert (left.givens, left.axioms, left.opened, left.checks) == ((), (), set(), ())


def test_a_finished_theory_does_not_follow_its_draft() -> None:
    draft = Draft.of(theory("Dog := [x : Ind, c : dog(x)]"))
    kennel = theory_of_draft(draft)
    source = Source("Cat := [y : Ind]")
    StatementReader(draft, source).declare(parse_statement(source, 0, len(source.text)))
    assert "Cat" in theory_of_draft(draft).names - kennel.names


# --- slips ---------------------------------------------------------------------------


def test_a_text_is_no_theory_by_itself() -> None:
    with pytest.raises(IllFormedError, match="found the object 'basic Ind'") as caught:
        Theory("basic Ind")  # type: ignore[arg-type]
    assert "Theory.parse(text)" in caught.value.hint


def test_items_are_asked_for_by_name() -> None:
    with pytest.raises(
        IllFormedError, match="a theory is asked for a name, found int 3"
    ):
        theory("")[3]  # type: ignore[index]


def test_a_type_nobody_declared_is_not_to_be_quoted() -> None:
    assert mistake("X := [x : fido]").hint == "declare it first"
    assert "or quote it" in mistake("X := Ind@fido").hint


def test_only_a_text_in_python_has_escapes_of_python(tmp_path: Path) -> None:
    assert "write r'…'" in mistake("X := \x07").hint
    file = tmp_path / "a.ttr"
    file.write_text("X := \x07", encoding="utf-8")
    with pytest.raises(NotationError, match="control character") as caught:
        load(file)
    assert caught.value.hint == ""


@pytest.mark.parametrize("at", [0, 5, 6, 7, 12, 13, 14, 99])
@pytest.mark.parametrize("text", ["basic A\nX := B", "\n\nab\n", "", "one"])
def test_a_place_is_the_same_with_lines_counted_once(text: str, at: int) -> None:
    for length in (0, 1, 4, 20):
        found = Source(text, "a").span(Part(min(at, len(text)), at + length))
        assert found == Span.of("a", text, min(at, len(text)), at + length)


def test_a_name_is_in_a_theory_or_not():
    theory = Theory.parse("basic Ind\npred dog(Ind)\nobject fido : Ind")
    assert "Ind" in theory
    assert "dog" in theory
    assert "Dog" not in theory
    assert 3 not in theory


def test_star_is_a_word_unless_something_is_called_so():
    theory = Theory.parse("basic A\ncheck star(A) = str() \\/ plus(A)")
    assert check(theory).holds
    heavenly = Theory.parse("basic Ind\npred star(Ind)\nobject venus : Ind")
    assert str(heavenly.parse("star(venus)")) == "star(venus)"
    assert "star" in str(heavenly.parse(r"[star : Ind, y = star : Ind]"))


# --- what is given twice -------------------------------------------------------------


@pytest.mark.parametrize(
    ("givens", "why"),
    [
        (["given a : A", "given a : A = 0"], "a : A is given as 1 at t.ttr:2 and as 0"),
        (["given a : A", "given a : ~A"], "a : A is given as 1 at t.ttr:2 and as 0"),
        (["object a : A", "given a : A = 0.5"], "given as 1 at t.ttr:2 and as 0.5"),
        (
            ["given a : A", "given b : B = 0.5", r"given b : A /\ B"],
            "b : B is given as 0.5 at t.ttr:3 and as 1 here",
        ),
        (
            [
                "given a : A",
                "given P(a : B | a : A) = 0.3",
                "given P(a : B | a : A) = 0.6",
            ],
            "P(a : B | a : A) is given as 0.3 at t.ttr:3 and as 0.6 here",
        ),
        (
            ["given P(A || B) = 0.3", "given P(A || B) in [0.3, 0.4]"],
            "P(A || B) is given as 0.3 at t.ttr:2 and as [0.3, 0.4] here",
        ),
    ],
)
def test_what_is_given_with_two_degrees_is_refused(givens, why):
    theory = Theory.parse("\n".join(["basic A, B", *givens]), "t.ttr")
    for ask in (check, Model):
        with pytest.raises(RefusedError) as error:
            ask(theory)
        assert why in error.value.message
        assert "\n" not in error.value.message
        assert error.value.span.line == len(givens) + 1
        assert error.value.hint == "keep one of the two"


def test_what_is_given_twice_with_one_degree_is_given():
    text = "basic A, B\nobject a : A\ngiven a : A\ngiven a : B = 0.3\n"
    theory = Theory.parse(f"{text}given a : B = 0.3\ncheck P(a : B) = 0.3")
    assert check(theory).holds


def test_in_python_what_is_given_later_counts():
    A = Basic("A")
    M = Model().given("a", A).given("a", A, 0)
    assert M.judge("a", A).p == (0, 0)
