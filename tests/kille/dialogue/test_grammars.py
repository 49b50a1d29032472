"""Grammars are read as Lark reads them, and what is not plain is left to Lark."""

from itertools import groupby

import pytest

from kille.dialogue.grammars import GrammarError, by_lark, plainly, read
from kille.dialogue.language import LANGUAGES, grammar_text
from kille.dialogue.lexicon import lexicon
from kille.dialogue.parsing import Grammar
from kille.dialogue.transcribing import CLOSELY, LOOSELY, robot_rules


def productions(source):
    """By rule; a rule made for a repetition stands as what it repeats."""
    by_name = {
        name: list(them)
        for name, them in groupby(
            sorted(source.productions, key=lambda it: it.name), lambda it: it.name
        )
    }

    def shown(symbol, within):
        if not symbol.name.startswith("__"):
            return symbol
        if symbol.name == within:
            return "itself"
        return frozenset(
            tuple(shown(it, symbol.name) for it in made.symbols)
            for made in by_name[symbol.name]
        )

    return {
        name: [
            (tuple(shown(it, name) for it in made.symbols), made.made, made.only_child)
            for made in them
        ]
        for name, them in by_name.items()
        if not name.startswith("__")
    }


def same(text, starts):
    own, larks = plainly(text, starts), by_lark(text, starts)
    assert own is not None
    assert productions(own) == productions(larks)
    used = {s.name for made in own.productions for s in made.symbols if s.is_term}
    assert used <= own.terminals.keys()
    assert all(own.pattern(it) == larks.pattern(it) for it in used)
    assert [*own.ignored] == [*larks.ignored]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_grammars_are_read_as_by_lark(language):
    tutors = grammar_text(language)
    same(tutors, ("start",))
    robots = tutors + robot_rules(lexicon(language), tutors)
    same(robots, (CLOSELY, LOOSELY))


@pytest.mark.parametrize(
    "rules",
    [
        "start: A b* | b A?\nb: A -> c | A A",
        "start: (A | b)+ A~2\nb: A~1..3",
        "start: A (b | A b)? -> two\n  | b b b\nb: A",
        "start: _b (A | A)\n// a comment\n_b: A? A? A",
        "start: A  // what is said\n\n\nunused: start",
    ],
)
def test_small_grammars_are_read_as_by_lark(rules):
    same(f"{rules}\nA: /a(?=b)/i | /aab/ | /ab?/\n%ignore / +/\n", ("start",))


@pytest.mark.parametrize(
    "text",
    [
        'start: "a"',
        "start: [A]\nA: /a/",
        "?start: A\nA: /a/",
        "start: A\nA: B\nB: /a/",
        "start: A\nA.2: /a/",
        "%import common.WORD\nstart: WORD",
    ],
)
def test_what_is_not_plain_is_left_to_lark(text):
    assert plainly(text, ["start"]) is None
    assert read(text, ["start"]).productions


@pytest.mark.parametrize(
    "text",
    [
        "start: (",
        "start: b",
        "b: A\nA: /a/",
        "start: A\nstart: A\nA: /a/",
        "_b: A -> c\nstart: _b\nA: /a/",
        "start: A | A -> b\nA: /a/",
        "start: A\nA: /(/",
        "start: A\nA: /a*/",
        "start: A~3..2\nA: /a/",
        "start: A ->\nA: /a/",
        "",
    ],
)
def test_what_is_no_grammar_is_refused(text):
    with pytest.raises(GrammarError):
        Grammar(text).parse("a")


MANY = {
    "a row of alternatives": "x:" + " (A | B)" * 40,
    "a row of what may be missing": "x:" + " A?" * 40,
    "a row in brackets": "x:" + " [A]" * 40,
    "a row of texts": "x:" + ' ("a" | "b")' * 40,
    "what stands often": "x: (A | B)~1..999",
    "what stands very often": "x: A~1..999999999",
    "rules that are many together": "x: A\n"
    + "".join(f"y{it}:" + " (A | B)" * 10 + "\n" for it in range(20)),
}


@pytest.mark.parametrize("rule", MANY.values(), ids=MANY)
def test_a_rule_that_can_be_made_in_too_many_ways_is_refused(rule: str) -> None:
    text = f"start: x\n{rule}\nA: /a/\nB: /b/\n"
    with pytest.raises(GrammarError, match="can be made in more than 10,000 ways"):
        read(text, ["start"])


def test_alternatives_are_added_and_not_multiplied() -> None:
    words = " | ".join(["A"] * 3000)
    text = f"start: {words}\nA: /a/\n%ignore /(b|c)?(d|e)?/ // (A|B)?(A|B)?\n"
    assert len(read(text, ["start"]).productions) == 1
