"""Grammars in Lark's notation are read, and what is no grammar is refused."""

import re
from functools import cache
from itertools import count, groupby
from time import process_time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.grammars import AHEAD, LATIN, GrammarError, read_grammar
from kille.dialogue.language import LANGUAGES, grammar_text, reader
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import packaged_types
from kille.dialogue.parsing import Grammar
from kille.dialogue.robot_grammar import CLOSELY, LOOSELY, robot_rules


def productions(text, starts=("start",)):
    """The ways to make each rule; a rule made for a repetition stands as its parts."""
    by_name = {
        name: list(them)
        for name, them in groupby(
            sorted(read_grammar(text, starts).productions, key=lambda it: it.name),
            lambda it: it.name,
        )
    }

    def shown(symbol):
        if not symbol.name.startswith("__"):
            return f"({symbol.name})" if symbol.filter_out else symbol.name
        ways = {
            " ".join(it.name for it in made.symbols if it.name != symbol.name)
            for made in by_name[symbol.name]
        }
        return f"{{{'|'.join(sorted(ways))}}}"

    return {
        name: [
            " ".join(map(shown, made.symbols))
            + (f" -> {made.made}" if made.made != name else "")
            for made in them
        ]
        for name, them in by_name.items()
        if not name.startswith("__")
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_all_that_a_grammar_mentions_is_in_it(language):
    tutors = grammar_text(language)
    robots = tutors + robot_rules(lexicon(language), tutors)
    for text, starts in ((tutors, ("start",)), (robots, (CLOSELY, LOOSELY))):
        source = read_grammar(text, starts)
        rules = {made.name for made in source.productions}
        for symbol in (it for made in source.productions for it in made.symbols):
            assert symbol.name in (source.terminals if symbol.is_term else rules)
        for terminal in source.terminals:
            assert source.expression(terminal).pattern.pattern


SMALL = {
    "start: A b* | b A?\nb: A -> c | A A": {
        "b": ["A -> c", "A A"],
        "start": ["A {b}", "A", "b A", "b"],
    },
    "start: (A | b)+ A~2\nb: A~1..3": {
        "b": ["A", "A A", "A A A"],
        "start": ["{A|b} A A"],
    },
    "start: A (b | A b)? -> two\n  | b b b\nb: A": {
        "b": ["A"],
        "start": ["A b -> two", "A A b -> two", "A -> two", "b b b"],
    },
    "start: _b (A | A)\n// a comment\n_b: A? A? A": {
        "_b": ["A A A -> None", "A A -> None", "A -> None"],
        "start": ["_b A"],
    },
    "start: A  // what is said\n\n\nunused: start": {"start": ["A"]},
    "start: _A b\nb: A\n_A: /b/": {"b": ["A"], "start": ["(_A) b"]},
}


@pytest.mark.parametrize(("rules", "found"), SMALL.items(), ids=SMALL)
def test_rules_are_written_out(rules, found):
    text = f"{rules}\nA: /a(?=b)/i | /aab/ | /ab?/\n%ignore / +/\n"
    source = read_grammar(text, ["start"])
    assert productions(text) == found
    assert source.terminals["A"] == "(?:aab|ab?|(?i:a(?=b)))"
    assert source.ignored == [" +"]


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
def test_all_of_larks_notation_is_read(text):
    assert read_grammar(text, ["start"]).productions


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
    "a row within brackets": "x: (" + " A?" * 14 + " | B)",
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
        read_grammar(text, ["start"])


def test_alternatives_are_added_and_not_multiplied() -> None:
    words = " | ".join(["A"] * 3000)
    text = f"start: {words}\nA: /a/\n%ignore /(b|c)?(d|e)?/ // (A|B)?(A|B)?\n"
    assert len(read_grammar(text, ["start"]).productions) == 1


def test_a_long_text_that_is_no_grammar_is_refused() -> None:
    with pytest.raises(GrammarError):
        read_grammar("x" * 100_000, ["start"])


@pytest.mark.parametrize(
    "rule", ["(A |)+", "( | b)+", "(A | | b)+", "(A | )+ b?", "(A | | | b)+"]
)
def test_a_repetition_of_perhaps_nothing_is_refused(rule: str) -> None:
    with pytest.raises(GrammarError, match="begins with itself"):
        Grammar(f"start: {rule}\nb: A\nA: /a/\n")


@pytest.mark.parametrize(
    "text",
    [
        f"start: A~{'9' * 6000}\nA: /a/",
        f"start: A\nA.{'9' * 6000}: /a/",
        f"start: A\nA: /a{{{'9' * 6000}}}/",
        f"start: A\nA: /{'(' * 3000}a{')' * 3000}/",
        f"start: {'(' * 3000}A{')' * 3000}\nA: /a/",
        "start: A\nA: /a/\n%ignore /*/",
        "start: A\nA: /a/\n%ignore /(/",
    ],
    ids=["times", "priority", "count", "groups", "brackets", "ignored", "open"],
)
def test_huge_numbers_and_deep_brackets_are_refused(text: str) -> None:
    with pytest.raises(GrammarError):
        Grammar(text).parse("a")


WORDS = st.recursive(
    st.text("abså’ ", min_size=1, max_size=3),
    lambda inner: st.one_of(
        st.lists(inner, min_size=2, max_size=3).map("".join),
        st.lists(inner, min_size=2, max_size=3).map("|".join).map("({})".format),
        st.tuples(inner, st.sampled_from("?*+")).map(lambda it: f"({it[0]}){it[1]}"),
        inner.map("{}\\b".format),
        inner.map("(?!x){}".format),
        inner.map("[åb-d’]{}".format),
    ),
    max_leaves=6,
)


@given(st.data(), WORDS)
def test_what_words_fit_begins_with_one_of_their_beginnings(data, words):
    """Except letters beyond `LATIN`, of which some count as others."""
    rule = f"start: A{chr(10)}A: /{words}/i"
    beginnings = read_grammar(rule, ["start"]).beginnings("A")
    text = data.draw(st.from_regex(re.compile(words, re.I), fullmatch=True))
    if text and beginnings is not None and all(ord(it) < LATIN for it in text[:AHEAD]):
        assert text.lower().startswith(tuple(beginnings))
        assert Grammar(rule).can_begin("A", text[:AHEAD])
    if not re.search(r"\)[?*]", words):
        assert beginnings is not None


@pytest.mark.parametrize(
    ("pattern", "beginnings"),
    [
        ("[ab]c", "ac bc"),
        ("(?!b)a", "a"),
        ("a{0,1}b", "ab b"),
        ("å|Ä", "å ä"),
        ("['’]s", "'s ’s"),
        ("(it |they )?wear", "it th we"),
        ("(?<=x)[a-c]", "a b c"),
        ("a+b|a?c", "aa ab ac c"),
        (r"a\w|bc", "a bc"),
        ("aΩ|aß", "a"),
    ],
)
def test_beginnings_are_seen_in_an_expression(pattern, beginnings):
    source = read_grammar(f"start: A{chr(10)}A: /{pattern}/i", ["start"])
    assert source.beginnings("A") == {*beginnings.split()}


@pytest.mark.parametrize("pattern", ["[^ab]c", "Ωb", ".a", "[a-ω]", r"\w", "(a)?(?=b)"])
def test_beginnings_that_may_be_any_sign_are_unknown(pattern):
    rule = f"start: A | B{chr(10)}A: /{pattern}/i{chr(10)}B: /a/i | /{pattern}/i"
    source = read_grammar(rule, ["start"])
    assert source.beginnings("A") is None
    assert source.beginnings("B") is None


@cache
def island_grammar(language):
    return reader(language, packaged_types()).island_grammar


@given(st.text("abcåÅitwvdn’' ", max_size=4), st.sampled_from(LANGUAGES))
def test_a_terminal_that_cannot_begin_here_is_not_here(text, language):
    grammar = island_grammar(language)
    for terminal in grammar._terminals:
        found = grammar.expression(terminal).match(text, 0, process_time() + 9)
        assert not found or grammar.can_begin(terminal, text[:AHEAD])


def test_expressions_are_made_for_words_that_can_be_here_only():
    grammar = Grammar(grammar_text("en"))
    assert grammar.parse("What is this?")
    assert "_WHAT" in grammar._expressions
    assert "_SHOW" not in grammar._expressions


@pytest.mark.parametrize("what", ["the terminal A", "what is ignored"])
def test_an_expression_that_would_take_years_is_named(what, monkeypatch) -> None:
    monkeypatch.setattr("kille.dialogue.parsing.SECONDS", 0.1)
    slow = "/(a|aa)+$/"
    a, skipped = (slow, "/ /") if what == "the terminal A" else ("/a/", slow)
    grammar = Grammar(f"start: A\nA: {a}\n%ignore {skipped}\n")
    with pytest.raises(GrammarError, match=f"^{what} takes too long to look for"):
        grammar.parse("a" * 60 + "c")


def test_all_that_a_sentence_is_looked_through_for_is_timed_together(
    monkeypatch,
) -> None:
    """Each of many terminals may take a little less than what is too long."""
    seconds = count(0.0, 1.0)
    for module in ("grammars", "parsing"):
        monkeypatch.setattr(
            f"kille.dialogue.{module}.process_time", lambda: next(seconds)
        )
    names = "ABCDEFGH"
    few, many = (
        Grammar(
            f"start: {' | '.join(some)}\n" + "".join(f"{it}: /[^y]/\n" for it in some)
        )
        for some in (names[:2], names)
    )
    few.check_terminals()
    many.check_terminals()
    assert few.parse("y") == []
    with pytest.raises(GrammarError, match="takes too long to look for"):
        many.parse("y")


def test_a_pause_in_the_middle_of_a_sentence_costs_no_reading(monkeypatch) -> None:
    """Such as that of collecting garbage, which counts as the process's own time."""
    seconds = [0.0, 0.0, 100.0]

    def read_clock() -> float:
        return seconds.pop(0) if len(seconds) > 1 else seconds[0]

    for module in ("grammars", "parsing"):
        monkeypatch.setattr(f"kille.dialogue.{module}.process_time", read_clock)
    text = 'start: A B C\nA: /a/\nB: /b/\nC: /c/\n%ignore " "\n'
    for paused_at in range(1, 9):
        seconds = [0.0] * paused_at + [100.0]
        [tree] = Grammar(text).parse("a b c")
        assert tree.rule == "start"


@pytest.mark.parametrize("counts", ["{9999}){9999}", "{999}){999}){999}"])
def test_repetitions_that_fill_the_memory_are_refused(counts: str) -> None:
    pattern = "(?:" * counts.count(")") + "a" + counts
    for text in (f"A: /{pattern}/", f"A: /a/\n%ignore /{pattern}/"):
        with pytest.raises(GrammarError, match="its repetitions written out"):
            Grammar(f"start: A\n{text}").parse("a")


def test_a_mistake_at_which_lark_itself_fails_is_told():
    with pytest.raises(GrammarError, match=r"':'.* at line 2, column 5"):
        read_grammar("F://\nE:(E:", ["start"])


def test_terminals_are_checked_before_a_dialogue_comes_to_them() -> None:
    grammar = Grammar("start: A B\nA: /a/\nB: /(b/\n")
    assert grammar.parse("x") == []
    with pytest.raises(GrammarError, match="the terminal B is no regular expression"):
        grammar.check_terminals()


@pytest.mark.parametrize("opening", ["/", '"', ""])
def test_a_grammar_with_many_backslashes_is_refused_at_once(opening):
    with pytest.raises(GrammarError, match="backslashes that follow another"):
        read_grammar(f"start: a\na: {opening}" + "\\" * 500, ["start"])


def test_a_few_backslashes_are_read():
    assert Grammar(r"start: /\\\\/", "start").parse("\\\\")


def test_rules_that_nest_too_deep_are_told():
    chain = "".join(f"r{n}: r{n + 1}\n" for n in range(2000))
    grammar = Grammar(f'start: r0\n{chain}r2000: "a"\n', "start")
    with pytest.raises(GrammarError, match="nest too deep"):
        grammar.parse("a")
