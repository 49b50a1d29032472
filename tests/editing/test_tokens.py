"""Tokens of theories and stories: all of a text, and what the parser makes of it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from pygments.lexers import get_lexer_by_name, get_lexer_for_filename

from textmate_interpreter import scopes
from ttr.editing.story_tokens import story_tokens
from ttr.editing.textmate import GRAMMARS, grammar_text
from ttr.editing.tokens import NAMES, Kind, Token, theory_tokens
from ttr.errors import NotationError
from ttr.notation import syntax_trees as trees
from ttr.notation.parser import parse_statement
from ttr.notation.scanning import find_statements
from ttr.notation.syntax_trees import Part, Source, inside

ROOT = Path(__file__).resolve().parents[2]


def written(suffix: str) -> list[str]:
    """All theories, or stories, of the repository, as they are when this is read."""
    folders = ("docs", "examples", "grammars", "tests", "tools")
    paths = sorted(it for one in folders for it in (ROOT / one).rglob(f"*{suffix}"))
    return [it.read_text("utf-8") for it in paths if "planted" not in it.parts]


THEORIES, STORIES = written(".ttr"), written(".dlg")

RECORDED = [
    json.loads(line)
    for line in (ROOT / "tests/ttr/parsed.jsonl").read_text("utf-8").splitlines()
]

STATEMENTS = [
    text
    for kind, text, *rest in RECORDED
    if kind == "statement" and len(rest) == 1
    if [*find_statements(text)] == [(0, len(text))]
]

theories = st.lists(
    st.sampled_from([*STATEMENTS, "# a comment", "", "  # another: [x : A"]),
    max_size=8,
).map("\n".join)
"""Theories of statements that parse, with comments and empty lines."""

SIGNS = "abλΓ_ \t\n\r\\\"'#[](){}<>.,:=|&~+@^-→⊑0123456789\x00\x0b\u2028😀’"
"""The characters of the notation, and some that are none."""

PIECES = ("basic ", "check ", "rule r(", "where [", "fun x:", "U> ", "S~ ", "@ event ")

texts = st.lists(st.sampled_from(SIGNS) | st.sampled_from(PIECES)).map("".join)

OPENERS = ("[", "(x", "<", "{x=", "'", '"', "\\x:", "λ", "λx:", "-", ".", "^", "a(")


# --- everything is a token -----------------------------------------------------------


@pytest.mark.parametrize("tokens_of", [theory_tokens, story_tokens])
@settings(max_examples=60)
@given(text=st.text() | texts)
@example(text="")
@example(text="rule")
@example(text="\x0b\x1c a")
def test_the_tokens_are_the_text(
    tokens_of: Callable[[str], tuple[Token, ...]], text: str
) -> None:
    found = tokens_of(text)
    assert "".join(one.of(text) for one in found) == text
    assert all(one.start < one.end for one in found)


@pytest.mark.parametrize("opener", OPENERS)
def test_a_long_text_of_one_thing_has_tokens(opener: str) -> None:
    """What takes time quadratic in the length of these would take minutes."""
    text = "".join((opener * 4_000, f"{opener}\n" * 1_000, f"\nU~ {opener} " * 1_000))
    for tokens_of in (theory_tokens, story_tokens):
        assert tokens_of(text)[-1].end == len(text)


# --- what the parser reads -----------------------------------------------------------


def parsed(text: str) -> Iterator[Part]:
    """The parts of the statements of a theory that parse."""
    source = Source(text)
    for start, end in find_statements(text):
        try:
            yield parse_statement(source, start, end)
        except NotationError:
            continue


def expected_kinds(part: Part) -> Iterator[tuple[Part, Kind]]:
    """The kinds that are plain from a part of a syntax tree."""
    match part:
        case trees.Literal(_, _, str()):
            yield part, Kind.STRING
        case trees.Literal():
            yield part, Kind.NUMBER
        case trees.Field(_, _, label):
            yield label, Kind.LABEL
        case trees.Braces(_, _, settings):
            yield from ((label, Kind.LABEL) for label, _ in settings)
        case trees.Abstraction(_, _, variable) | trees.Parameter(_, _, variable):
            yield variable, Kind.VARIABLE
        case trees.Arrow(_, _, trees.Word() as variable):
            yield variable, Kind.VARIABLE
        case trees.BasicNames(_, _, names):
            yield from ((name, Kind.TYPE) for name in names)
        case trees.Arity(_, _, name):
            yield name, Kind.PREDICATE
        case trees.Definition(_, _, name):
            yield name, Kind.TYPE
        case (
            trees.RuleStatement(_, _, name)
            | trees.StrategyStatement(_, _, name)
            | trees.GameStatement(_, _, name)
        ):
            yield name, Kind.RULE


def check_against_parser(text: str) -> None:
    kinds: dict[tuple[int, int], Kind] = {}
    at: dict[int, Token] = {}
    for token in theory_tokens(text):
        kinds[token.start, token.end] = token.kind
        at[token.start] = token
    for statement in parsed(text):
        for part in inside(statement):
            for place, kind in expected_kinds(part):
                assert kinds[place.start, place.end] == kind, text[place.start :][:40]
            if isinstance(part, trees.Name) and part.up is None:
                assert at[part.start].kind in NAMES | {Kind.WORD}, part
        here = [at[n] for n in range(statement.start, statement.end) if n in at]
        assert [one.of(text) for one in here if one.kind is Kind.ERROR] == []


def test_what_parses_in_the_repository_is_shown_as_it_is_read() -> None:
    for text in THEORIES:
        check_against_parser(text)


@given(theories)
def test_what_parses_is_shown_as_it_is_read(text: str) -> None:
    check_against_parser(text)


# --- other readers of the same text --------------------------------------------------

_LIKE = {
    "keyword.control": Kind.KEYWORD,
    "comment": Kind.COMMENT,
    "string": Kind.STRING,
    "constant.numeric": Kind.NUMBER,
}


@cache
def shipped(name: str) -> Any:
    return json.loads((files("ttr.editing") / name).read_text("utf-8"))


def kinds_by_textmate(name: str, text: str) -> list[str]:
    return [
        next((kind for start, kind in _LIKE.items() if scope.startswith(start)), "")
        for scope in scopes(shipped(name), text)
    ]


def kinds_by_tokens(found: tuple[Token, ...]) -> list[str]:
    told = (
        [one.kind if one.kind in _LIKE.values() else ""] * (one.end - one.start)
        for one in found
    )
    return [kind for one in told for kind in one]


def differences(name: str, text: str) -> list[tuple[str, str, str]]:
    """Where a grammar says something else of a keyword, string, comment or number."""
    tokens_of = theory_tokens if name.startswith("ttr") else story_tokens
    mine, others = kinds_by_tokens(tokens_of(text)), kinds_by_textmate(name, text)
    return [
        (text[max(0, n - 20) : n + 20], one, other)
        for n, (one, other) in enumerate(zip(mine, others, strict=True))
        if one != other and not text[n].isspace()
    ]


def test_textmate_says_the_same_of_all_theories_of_the_repository() -> None:
    assert not [
        it for text in THEORIES for it in differences("ttr.tmLanguage.json", text)
    ]


def test_textmate_says_the_same_of_all_stories_of_the_repository() -> None:
    assert not [
        it for text in STORIES for it in differences("dlg.tmLanguage.json", text)
    ]


@given(theories)
def test_textmate_says_the_same_of_theories(text: str) -> None:
    assert differences("ttr.tmLanguage.json", text) == []


@pytest.mark.parametrize("name", GRAMMARS)
def test_the_grammars_are_made_of_the_patterns(name: str) -> None:
    text = (files("ttr.editing") / name).read_text("utf-8")
    assert text == grammar_text(GRAMMARS[name]())


@pytest.mark.parametrize(("alias", "text"), [("ttr", THEORIES[0]), ("dlg", STORIES[0])])
def test_pygments_finds_the_lexers(alias: str, text: str) -> None:
    lexer = get_lexer_by_name(alias, stripnl=False, ensurenl=False)
    assert "".join(piece for _, piece in lexer.get_tokens(text)) == text
    assert type(get_lexer_for_filename(f"a.{alias}")) is type(lexer)


# --- single cases --------------------------------------------------------------------


def shown(text: str) -> str:
    return " ".join(
        f"{one.of(text)}/{one.kind}"
        for one in theory_tokens(text)
        if one.kind not in (Kind.SPACE, Kind.PUNCTUATION, Kind.OPERATOR)
    )


CASES = {
    "pred dog(Ind)": "pred/keyword dog/predicate Ind/type",
    "object a : A": "object/keyword a/object A/type",
    "object a : A\ncheck a = a": "object/keyword a/object A/type check/keyword "
    "a/object a/object",
    "basic check": "basic/keyword check/type",
    "check in : A": "check/keyword in/name A/type",
    "check not a : A": "check/keyword not/keyword a/name A/type",
    "puppy(x) <: dog(x)": "puppy/predicate x/variable dog/predicate x/variable",
    "X := [of : A, c : p(of)]": "X/type of/label A/type c/label p/predicate of/label",
    "f := λx:A. p(x, s.y)": "f/type x/variable A/type p/predicate x/variable s/name "
    "y/label",
    "strategy s := first(a, b)": "strategy/keyword s/rule first/word a/rule b/rule",
    "X := [x : 'a\nbasic B": "X/type x/label 'a/error basic/keyword B/type",
    "X := a’b": "X/type a’b/error",
}


@pytest.mark.parametrize(("text", "expected"), CASES.items())
def test_names_are_told_by_where_they_stand(text: str, expected: str) -> None:
    assert shown(text) == expected
