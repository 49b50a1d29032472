"""What the parser makes of texts, and says of the rest, is what has been recorded.

Each line of `parsed.jsonl` is a text, whether it is a term or a statement, and its tree
or the column and message of the error. The trees and most of the messages were made by
a parser that was generated from a grammar, which this one replaced.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from ttr.errors import NotationError
from ttr.notation import syntax_trees
from ttr.notation.parser import parse_statement, parse_term
from ttr.notation.syntax_errors import KEYWORDS
from ttr.notation.syntax_trees import Part, Source, Statement, inside

RECORDED = [
    json.loads(line)
    for line in Path(__file__).with_name("parsed.jsonl").read_text("utf-8").splitlines()
]


def written(value: object) -> str:
    """A tree on one line: the kind and the place of each part, and what is in it."""
    match value:
        case Part(start, end):
            inner = (written(getattr(value, k)) for k in value.__match_args__[2:])
            return f"{type(value).__name__}({', '.join((f'{start}:{end}', *inner))})"
        case tuple():
            return f"[{', '.join(map(written, value))}]"
    return repr(value)


def parse_as(kind: str, text: str) -> Part:
    source = Source(text)
    if kind == "term":
        return parse_term(source)
    return parse_statement(source, 0, len(text))


@pytest.mark.parametrize(("kind", "text", "tree"), [x for x in RECORDED if len(x) == 3])
def test_trees_are_those_recorded(kind: str, text: str, tree: str) -> None:
    assert written(parse_as(kind, text)) == tree


@pytest.mark.parametrize(
    ("kind", "text", "column", "message"), [x for x in RECORDED if len(x) == 4]
)
def test_errors_are_those_recorded(
    kind: str, text: str, column: int, message: str
) -> None:
    with pytest.raises(NotationError) as caught:
        parse_as(kind, text)
    assert caught.value.span is not None
    assert (caught.value.span.column, caught.value.message) == (column, message)


def test_every_kind_of_part_is_recorded() -> None:
    trees = [parse_as(kind, text) for kind, text, *rest in RECORDED if len(rest) == 1]
    seen = {type(part) for tree in trees for part in inside(tree)}
    kinds = {x for x in vars(syntax_trees).values() if isinstance(x, type)}
    parts = {kind for kind in kinds if issubclass(kind, Part)}
    made_of_others = {Part, syntax_trees.Term, Statement, syntax_trees.Query}
    assert parts - seen == made_of_others


def test_every_keyword_begins_a_statement() -> None:
    rests = {"game": " g", "rule": " r", "strategy": " s"}
    for word in KEYWORDS:
        with pytest.raises(NotationError) as caught:
            parse_as("statement", word + rests.get(word, ""))
        assert ":= or <:" not in caught.value.message
