"""Law of plain statements: what is read without the grammar is what it would give."""

from pathlib import Path

import pytest
from generators import types
from hypothesis import given
from hypothesis import strategies as st

from ttr import NotationError
from ttr.notation.grammar import statement
from ttr.notation.plain import plain_statement
from ttr.notation.scanning import blocks
from ttr.notation.syntax_trees import Source

ROOT = Path(__file__).parents[2]
THEORIES = sorted((ROOT / "grammars").glob("*.ttr")) + sorted(
    (ROOT / "tests" / "theories").rglob("*.ttr")
)

WORDS = (
    *("basic", "pred", "object", "given", "check", "rule", "strategy", "game", "open"),
    *(
        "in",
        "of",
        "on",
        "acts",
        "hears",
        "not",
        "fun",
        "list",
        "set",
        "Rec",
        "RecType",
        "RecType^1",
    ),
    *("A", "x", "x.y", ".x", "^.x", "^^.x.y", "_a", "f1", '"a b"', "'a'", '""', "1"),
    *("[", "]", "(", ")", "{", "}", "<", ">", ",", ":", ":=", "=", "~", "|", "||"),
    *("\\/", "/\\", "@", "+", "->", "<:", ".", "^", "\\", "# note\n", "\n", "é", "λ"),
)

names = st.sampled_from(["A", "x", "strategy", "rule", "of", "in", "x.y", "^.x"])
terms = st.recursive(
    names | st.sampled_from(['"a"', "Rec", "RecType^1", "[]", "1"]),
    lambda inner: st.one_of(
        st.builds("~{}".format, inner),
        st.builds("{} | {}".format, inner, inner),
        st.builds("({})".format, inner),
        st.builds("{}({})".format, names, st.lists(inner, max_size=3).map(", ".join)),
        st.builds("[{}]".format, st.lists(inner, max_size=3).map(", ".join)),
        st.builds("[{} : {}, {} = {} : {}]".format, names, inner, names, inner, inner),
    ),
    max_leaves=8,
)


def agrees(text: str) -> bool:
    """Whether a text is plain; if so the grammar has to agree on what it says."""
    source = Source.of(text, "<text>")
    plain = plain_statement(source, 0, len(text))
    if plain is None:
        return False
    try:
        assert plain == statement(source, 0, len(text))
    except NotationError as error:
        raise AssertionError(f"the grammar refuses {text!r}: {error}") from error
    return True


@pytest.mark.parametrize("path", THEORIES, ids=lambda path: path.stem)
def test_theories_are_read_as_the_grammar_does(path):
    text = path.read_text(encoding="utf-8")
    source = Source.of(text, path.name)
    for start, end in blocks(text):
        plain = plain_statement(source, start, end)
        assert plain is None or plain == statement(source, start, end)


def test_the_theory_of_tutoring_takes_no_grammar():
    text = (ROOT / "grammars" / "tutor.ttr").read_text(encoding="utf-8")
    source = Source.of(text, "tutor.ttr")
    assert all(plain_statement(source, *place) for place in blocks(text))


@given(st.lists(st.sampled_from(WORDS), min_size=1, max_size=12), st.booleans())
def test_words_in_any_order_are_read_as_the_grammar_does(words, apart):
    agrees((" " if apart else "").join(words))


@given(names, terms, st.sampled_from(["{} := {}", "object {} : {}", "pred {}({})"]))
def test_terms_are_read_as_the_grammar_does(name, term, form):
    agrees(form.format(name, term))


@given(types())
def test_types_in_print_are_read_as_the_grammar_does(T):
    agrees(f"X := {T}")


@pytest.mark.parametrize(
    "text",
    [
        "basic A, B",
        "pred p(A, B), q(A)",
        "object a, b : A",
        'X := [x = "a b" : A, c : p(x, ^.y) | ~q(.x.z), strategy : list(RecType^1)]',
        "X := [a, b, []]",
        "X := p()  # nothing",
    ],
)
def test_statements_of_these_forms_are_plain(text):
    assert agrees(text)


@pytest.mark.parametrize(
    "text",
    [
        "X := A @ a",
        "X := (A)",
        "X := {x = a}",
        "X := set{}",
        "X := 1",
        "X := A -> B",
        "A <: B",
        "of := A :",
        "basic",
        "X :=",
        "X := [x : A",
        "X := é",
        "",
    ],
)
def test_what_is_not_plain_is_left_to_the_grammar(text):
    assert not agrees(text)
