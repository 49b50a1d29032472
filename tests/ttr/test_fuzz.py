"""No text does worse than an error that says where it is, nor takes long to refuse.

`HYPOTHESIS_PROFILE=deep` tries a hundred times as many texts. What a long run has found
stands as an example.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from ttr import Theory, TTRError
from ttr.errors import MistakesError, NotationError
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.printing import notation

DECLARED = r"""
basic Ind, A
pred  dog(Ind), hug(Ind, Ind), rains()
object fido, sam : Ind
Dog := [x : Ind, c : dog(x)]
home := {x = fido, of = Dog}
barks := \x:Ind. dog(x)
"""

KENNEL = Theory.parse(DECLARED)

THEORIES = Path(__file__).resolve().parent.parent / "theories"
STATEMENTS = [file.read_text(encoding="utf-8") for file in THEORIES.glob("*.ttr")]
STATEMENTS.sort()

TERMS = [
    "[x : Ind, c : dog(x), y : [x = ^.x : Ind, e : hug(x, .x)]]",
    r"(A \/ ~Ind /\ Dog)@fido",
    r"\P:(Ind -> Type). [x : Ind, c : P(x), f = \y:Ind. .x : (Ind -> Ind)]",
    r"((x : Ind) -> (dog(x) -> Type^1))",
    r"(λx:Ind. λy:Ind. hug(x, y))(fido)('a b')",
    "fun r:[x : Ind]. {a = r.x, b = [fido, 1.5e3], c = {r, set{}}, d = {}}",
    "<fido, (A -> A) dog(sam) <> -3>",
    "[l : nelist(A), m = l + [home.x] + rst(l) : list(A), h = fst(l) : A]",
    "plus(str(set(A), list(Rec)))  # a comment",
]
"""Texts with every sign of the notation."""

SIGNS = (
    *"[](){}<>:=,.@&|+~^#'\"\\/-∧∨¬→λ⊑_é²‘\t\n ",
    *("/\\", "\\/", "->", ":=", "<:", "<=", "set{", "\\x:", "λx:", "fun x:", ". "),
    *("x", "y", "Ind", "A", "dog", "fido", "sam", "Dog", "home", "barks", ".x", "^.x"),
    *("list(", "nelist(", "set(", "str(", "plus(", "fst(", "rst(", "dog(", "(x)"),
    *("Type", "RecType^1", "Rec", "1", "-2.5", "1e9", "1e999", "'a b'", '"', "x.y"),
    *("basic ", "pred ", "object ", "given ", "check ", "import ", "open ", "rule "),
    *("rule r(s : Dog) := ", "strategy ", "game g({} : Rec) := ", "where [", " of "),
    *("acts on ", "first(", "repeat(", "by_class(", "s.x", "s.", "e : Dog"),
    *("not ", "unknown ", "error ", "in ", "P(", "merge(", "create(", "wellformed("),
    *("\n  ", "\r\n", "\x00", "\x07", "\x1f", "\u2028", "\u202e", "\u200f", "\ufeff"),
)

soups = st.lists(st.sampled_from(SIGNS), max_size=40).map("".join)


@dataclass(frozen=True)
class Cut:
    """Puts another text, or a piece of the text, in the place of a piece of it."""

    start: float
    end: float
    other: str | tuple[float, float]

    def of(self, text: str) -> str:
        start, end = sorted(int(place * len(text)) for place in (self.start, self.end))
        other = self.other
        if not isinstance(other, str):
            first, last = sorted(int(place * len(text)) for place in other)
            other = text[first:last]
        return text[:start] + other + text[end:]


places = st.floats(0, 1)
cuts = st.builds(
    Cut, places, places, st.sampled_from(SIGNS) | st.tuples(places, places)
)


@st.composite
def mutants(draw: st.DrawFn, texts: list[str]) -> str:
    """A valid text with a few pieces of it lost, moved, doubled or replaced."""
    text = draw(st.sampled_from(texts))
    for cut in draw(st.lists(cuts, min_size=1, max_size=4)):
        text = cut.of(text)
    return text


@st.composite
def chips(draw: st.DrawFn) -> str:
    """A valid term with one sign more, less or another."""
    text = draw(st.sampled_from(TERMS))
    at = draw(st.integers(0, len(text)))
    lost = draw(st.integers(0, 2))
    return text[:at] + draw(st.sampled_from(("", *SIGNS))) + text[at + lost :]


@contextmanager
def a_mistake_at_most() -> Iterator[None]:
    """Lets a `TTRError` pass whose mistakes all have a place."""
    try:
        yield
    except TTRError as error:
        mistakes = error.errors if isinstance(error, MistakesError) else (error,)
        placeless = [one.message for one in mistakes if one.span is None]
        if placeless or not str(error):
            raise AssertionError(f"errors without a place: {placeless}") from error


def reads_back(value: Object) -> None:
    """What is read is printed so that it reads back, but where names are ambiguous."""
    theory = Theory.of(value)
    if theory.objects & {*theory.basics, *theory.predicates}:
        return
    assert identity(theory.parse(notation(value))) == identity(value)


@given(soups | st.text(max_size=40) | mutants(TERMS) | chips())
@example("[x = y : dog(y)")
@example("Rec@{x = .y}")
@example("'\\u0000'")
def test_a_term_or_a_mistake(text: str) -> None:
    with a_mistake_at_most():
        reads_back(KENNEL.parse(text))


@given(soups | st.text(max_size=40) | mutants(STATEMENTS) | chips())
@example("import '\\u0000'")
@example("import '.'")
def test_a_theory_or_mistakes(text: str) -> None:
    with a_mistake_at_most():
        Theory.parse(text)
    with a_mistake_at_most():
        Theory.parse(f"{DECLARED}\nX := {text}")
    with a_mistake_at_most():
        Theory.parse(f"{DECLARED}\ncheck {text}")


# --- texts that are too long, too deep or too odd -------------------------------------

EXTREMES = {
    "brackets": "[" * 100_000,
    "parentheses": "(" * 100_000,
    "pairs": "(" * 50_000 + "A" + ")" * 50_000,
    "strings": "<" * 100_000,
    "records": "{x = " * 100_000,
    "arguments": "dog(" * 100_000,
    "applications": "fido" + "(sam)" * 100_000,
    "negations": "~" * 100_000 + "A",
    "functions": "\\x:A. " * 100_000,
    "lambdas": "λx:A. " * 100_000,
    "words": "fun x:A. " * 100_000,
    "arrows": "A -> " * 100_000 + "A",
    "products": "(x : A) -> " * 50_000 + "A",
    "closing": "]" * 1_000_000,
    "quotes": "'" * 1_000_000,
    "a quote": "'" + "a" * 1_000_000,
    "backslashes": "\\" * 1_000_000,
    "dots": "." * 1_000_000,
    "carets": "^" * 1_000_000,
    "λ": "λ" * 1_000_000,
    "λ‘": "λ‘" * 500_000,
    "λ and spaces": "λ" + " " * 1_000_000,
    "λ fun and spaces": "λ fun" + " " * 1_000_000,
    "fun": "fun " * 250_000,
    "fun x": "fun" + " " * 1_000_000 + "x",
    "noise": "@]:~{.=<\\,λ'>(" * 70_000,
    "digits": "1" * 1_000_000,
    "a name": "x" * 1_000_000 + " y",
    "a path": "x" + ".x" * 500_000 + " y",
    "NUL": "A\x00" * 500_000,
    "right to left": "\u202eA" * 500_000,
    "spaces": " " * 1_000_000 + "]",
    "lines": "\n" * 1_000_000 + "]",
    "announced": "\nbasic " + "(" * 1_000_000,
    "comment": "#" * 1_000_000 + "\n]",
}


@pytest.mark.parametrize("text", EXTREMES.values(), ids=EXTREMES)
def test_what_is_long_deep_or_odd_is_a_mistake(text: str) -> None:
    with pytest.raises(NotationError) as caught:
        KENNEL.parse(text)
    assert caught.value.span is not None
    assert len(str(caught.value)) < 2_000
    with a_mistake_at_most():
        Theory.parse(f"{DECLARED}\nX := {text}")


# --- how long it takes ----------------------------------------------------------------


def steps(read: Callable[[str], object], text: str) -> int:
    """How many calls it takes to read a text, or to refuse it."""
    count = 0

    def called(*_: object) -> None:
        nonlocal count
        count += 1

    before = sys.getprofile()
    sys.setprofile(called)
    try:
        read(text)
    except TTRError:
        pass
    finally:
        sys.setprofile(before)
    return count


def theory(text: str) -> Theory:
    return Theory.parse(f"{DECLARED}\nX := {text}")


GROWING: dict[str, Callable[[int], str]] = {
    "names": lambda n: f"[{', '.join(['fido'] * n)}]",
    "events": lambda n: f"<{' '.join(['fido'] * n)}>",
    "fields": lambda n: f"[{', '.join(f'x{i} : dog(x{i // 2})' for i in range(n))}]",
    "ill-formed fields": lambda n: (
        f"[{', '.join(f'x{i} : dog(x{i // 2})' for i in range(n))}, y : A, z : dog(y)]"
    ),
    "meets": lambda n: " /\\ ".join(f"dog({i})" for i in range(n)),
    "functions": lambda n: f"[{', '.join(['(λx:A. x)(fido)'] * n)}]",
    "nothing closes": lambda n: "[x : dog(fido), " * n,
    "mistake at the end": lambda n: f"[{', '.join(['fido'] * n)}",
    "unknown at the end": lambda n: f"[{', '.join(['fido'] * n)}, fdio]",
    "statements": lambda n: "A" + "".join(f"\nX{i} := list(A)" for i in range(n)),
    "rules": lambda n: (
        "A" + "".join(f"\nrule r{i}(s : Dog) := [x = s.x : Ind]" for i in range(n))
    ),
    "bindings": lambda n: (
        "A\nrule r(s : Dog) where ["
        + ", ".join(f"x{i} = s.x : Ind" for i in range(n))
        + f"] := [l = [{', '.join(['s.x'] * n)}] : list(Ind)]"
    ),
    "lost paths": lambda n: (
        f"A\nrule r(s : Dog) := [l = [{', '.join(['s.x'] * n)}, s.y] : list(Ind)]"
    ),
    "parts": lambda n: (
        f"A\nrule r(s : Dog) := Dog\nstrategy t := all({', '.join(['maybe(r)'] * n)})"
    ),
    "mistakes": lambda n: "A" + "\nY := list(B)" * n,
}


@pytest.mark.parametrize("kind", GROWING)
@pytest.mark.parametrize("read", [KENNEL.parse, theory], ids=["term", "theory"])
def test_four_times_the_text_takes_four_times_the_steps(
    kind: str, read: Callable[[str], object]
) -> None:
    read_once = GROWING[kind]
    steps(read, read_once(10))
    few, many = steps(read, read_once(100)), steps(read, read_once(400))
    assert many < 4.4 * few
