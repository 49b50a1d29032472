"""Counterexamples: a made-up witness of one type that is not of the other, the smallest
that shows it, in a model that says no more than is needed."""

import pytest

from ttr import Theory, subtype
from ttr.probability import REFUTED

NAMES = """
    basic A, B, C
    B <: A
    pred p(A), q(A), r(A, A)
    object a : A
"""

COUNTEREXAMPLES = [
    ("[x : A]", "[x : A, y : A]", "{x = a1}"),
    ("[x : A]", "[x : B]", "{x = a1}"),
    ("list(A)", "list(B)", "('a1',)"),
    ("list(A)", "nelist(A)", "()"),
    ("nelist(A)", "nelist(B)", "('a1',)"),
    ("plus(A)", "str(A, A)", "<a1>"),
    ("plus(A)", "str(A)", "<a1 a2>"),
    ("star(A)", "plus(A)", "<>"),
    ("[x : star(A)]", "[x : plus(A)]", "{x = <>}"),
    ("[x : plus(A)]", "[x : str(A, A)]", "{x = <a1>}"),
    ("[r : [x : plus(A)]]", "[r : [x : str(A, A)]]", "{r = {x = <a1>}}"),
    (
        "[r : [x : plus(A), y : A]]",
        "[r : [x : str(A, A, A), y : A]]",
        "{r = {x = <a1>, y = a2}}",
    ),
    ("[x : A, c : p(x)]", "[x : A, c : q(x)]", "{c = s2, x = a1}"),
    ("[x : A, c : p(x)]", "[x : A, c : p(x), d : q(x)]", "{c = s2, x = a1}"),
    ("(A -> B)", "(A -> C)", r"\x:A. a1"),
    ("(A -> A)", "(A -> B)", r"\x:A. x"),
    (r"A \/ C", "A", "a1"),
    ("A", r"B \/ C", "a1"),
    ("~B", "~A", "a1"),
    ("set(A)", "set(B)", "{a1}"),
    ("list([x : A])", "list([x : B])", "(record(x='a1'),)"),
    ("[l : list([x : A])]", "[l : list([x : B])]", "{l = [{x = a1}]}"),
    ("[l : list(list(A))]", "[l : list(list(B))]", "{l = [[a1]]}"),
    ("[x : A, s : plus(p(x))]", "[x : A, s : str(p(x), p(x))]", "{s = <s2>, x = a1}"),
    (
        "[x : A, s : str(p(x), q(x))]",
        "[x : A, s : str(q(x), p(x))]",
        "{s = <s2 s3>, x = a1}",
    ),
    ("[l : list(plus(A))]", "[l : list(A)]", "{l = [<a1>]}"),
    ("[x : plus(A) , y : plus(A)]", "[x : str(A, A), y : A]", "{x = <a1>, y = <a2>}"),
    (
        "[x : A, r : [s : plus(p(^.x))]]",
        r"[x : A, r : [s : str(p(^.x), p(^.x)) \/ str(p(^.x))]]",
        "{r = {s = <s2 s3 s4>}, x = a1}",
    ),
    ("str(p(a), q(a))", "str(q(a), p(a))", "<s1 s2>"),
    ("plus(str(p(a), q(a)))", "str(p(a), q(a))", "<s1 s2 s3 s4>"),
    (
        "[x : A, y : A, c : r(x, y)]",
        "[x : A, y : A, c : r(y, x)]",
        "{c = s3, x = a1, y = a2}",
    ),
    ("[x : A, y = x : A]", "[x : A, y : B]", "{x = a1, y = a1}"),
    ("[x = y : A, y = x : A]", "[x : B]", "{x = a1, y = a1}"),
    ("Type", "RecType", "Ind"),
    ("RecType", "Rec", "Rec"),
    ("nelist(list(A))", "nelist(nelist(A))", "((),)"),
    ("[f : (A -> A)]", "[f : (A -> B)]", r"{f = \x:A. x}"),
    (r"plus(A \/ C)", r"plus(A) \/ plus(C)", "<a1 a2>"),
    (r"[x : plus(A \/ C)]", r"[x : plus(A) \/ plus(C)]", "{x = <a1 a2>}"),
    ("plus([x : A])", "plus([x : B])", "<{x = a1}>"),
    ("[s : plus([x : A])]", "[s : plus([x : B])]", "{s = <{x = a1}>}"),
    (r"list(A \/ C)", r"list(A) \/ list(C)", "('a1', 'a2')"),
    (r"[l : list(A \/ C)]", r"[l : list(A) \/ list(C)]", "{l = [a1, a2], more0 = a3}"),
    (r"set(A \/ C)", r"set(A) \/ set(C)", "{a1, a2}"),
    (r"[x : A \/ C]", "[x : A]", "{x = a1}"),
    (r"[x : [y : A] \/ [z : A]]", "[x : [y : A]]", "{x = {z = a1}}"),
    ("[x : list(A), y : A]", "[x : nelist(A), y : A]", "{x = [], y = a1}"),
    ("str(A, plus(C))", "str(A, C)", "<a1 a2 a3>"),
    ("[s : str(A, plus(C))]", "[s : str(A, C)]", "{s = <a1 a2 a3>}"),
    (
        "[s : plus(A), t : [s : plus(C)]]",
        r"[s : plus(A), t : [s : str(C, C, C) \/ str(C)]]",
        "{s = <a1>, t = {s = <a2 a3>}}",
    ),
    ("A", "~B", "a1"),
    ("[x : A]", "[x : ~B]", "{x = a1}"),
    ("list(A)", "list(~B)", "('a1',)"),
    ("nelist(A)", "list(~B)", "('a1',)"),
    ("set(A)", "set(~B)", "{a1}"),
    ("[l : list([x : A])]", "[l : list([x : ~B])]", "{l = [{x = a1}]}"),
    ("list(list(A))", "list(list(~B))", "(('a1',),)"),
    ("plus(A)", "plus(~B)", "<a1>"),
    ("[s : plus(A)]", "[s : plus(~B)]", "{s = <a1>}"),
    ("[x : A, y : A]", "[x : A, y : ~C]", "{x = a1, y = a2}"),
    ("[x : A]", "~[x : B]", "{x = a1}"),
    ("list(A)", "~nelist(B)", "('a1',)"),
    ("list(A)", "~list(B)", "('a1',)"),
    ("A", r"~(B /\ C)", "a1"),
    ("[r : [x : A]]", "[r : ~[x : B]]", "{r = {x = a1}}"),
    ("A", r"A /\ ~p(a)", "s1"),
    ("[x : list(A)]", "[x : ~list(B)]", "{x = [a1]}"),
    ("Rec", "~[x : A]", "{x = a1}"),
    ("[x : plus(A)]", "[x : ~plus(B)]", "{x = <a1>}"),
    (
        "[l : list(A), m : list(C)]",
        "[l : list(~B), m : list(C)]",
        "{l = [a1], m = [a2]}",
    ),
    (
        r"[x : A \/ C, y : A \/ C]",
        r"[x : A, y : A \/ C] \/ [x : A \/ C, y : C]",
        "{x = a1, y = a2}",
    ),
    ("[r : [y : star(A)]]", r"[r : [y : str() \/ str(A)]]", "{r = {y = <a1 a2>}}"),
    (
        "[r : [y : star(A)], z : A]",
        "[r : [y : plus(A)], z : A]",
        "{r = {y = <>}, z = a1}",
    ),
    ("(A -> RecType)", "(A -> list(A))", r"\x:A. [i = x : A]"),
    (
        "([x : A] -> RecType)",
        "([x : A] -> list(A))",
        r"\r:[x : A]. [i = r : [x : A]]",
    ),
    ("(A -> A)", "list(A)", r"\x:A. x"),
    ("(A -> (A -> A))", "(A -> (A -> B))", r"\x:A. \y:A. y"),
    ("[x = y : A, y = x : A, z : A]", "[z : B]", "{x = a1, y = a1, z = a2}"),
    ("[l : list(plus(A))]", "[l : list(str(A, A))]", "{l = [<a1>]}"),
    ("[l : nelist(plus(A))]", "[l : nelist(str(A, A))]", "{l = [<a1>]}"),
    ("[s : plus(A) /\\ plus(C)]", "[s : str(A)]", "{s = <a1 a2>}"),
    ("[r : Rec, s : plus(A)]", "[r : Rec, s : str(A, A)]", "{r = {}, s = <a1>}"),
    (r"C /\ [s : plus(A)]", "[s : str(A, A)]", "{s = <a1>}"),
    (r"C /\ [s : plus(A)]", "[s : str(A)]", "{more0 = a3, s = <a1 a2>}"),
    (r"C /\ [l : list(A)]", "[l : list(~B)]", "{l = [a1]}"),
    (r"C /\ list(list(A))", "list(list(~B))", "(('a1',),)"),
    (r"C /\ [s : str(A, A)]", "[s : str(A, ~B)]", "{s = <a1 a2>}"),
    ("[s : str(A, A)]", "[s : str(A, ~B)]", "{s = <a1 a2>}"),
    (r"[s : plus(A)] /\ ~p(a)", "[s : str(A, A)]", "{s = <a1>}"),
    (r"[r : [s : plus(A)] /\ C]", "[r : [s : str(A, A)]]", "{r = {s = <a1>}}"),
    ("[s : str(list(A), C)]", "[s : str(list(~B), C)]", "{s = <[a1] a2>}"),
    ("[x : A, s : plus(p(x))]", "[x : A, s : str(p(x))]", "{s = <s2 s3>, x = a1}"),
    (
        "[x : A, r : [s : plus(p(^.x))]]",
        "[x : A, r : [s : str(p(^.x))]]",
        "{r = {s = <s2 s3>}, x = a1}",
    ),
    (
        "[x : A, l : list([s : plus(p(^.x))])]",
        "[x : A, l : list([s : str(p(^.x))])]",
        "{l = [{s = <s2 s3>}], x = a1}",
    ),
    (
        "[l : list([x : A, s : plus(p(x))])]",
        "[l : list([x : A, s : str(p(x))])]",
        "{l = [{s = <s2 s3>, x = a1}]}",
    ),
    (
        "[l : nelist(A), s : plus(p(fst(l)))]",
        "[l : nelist(A), s : str(p(fst(l)))]",
        "{l = [a1], s = <s2 s3>}",
    ),
    (
        r"C /\ [k = 'b' : A, l : list(A)]",
        "[k : ~(A@a), l : list(~B)]",
        "{k = b, l = [a1]}",
    ),
    (
        r"C /\ [k = 'b' : A, s : str(A, A)]",
        "[k : ~(A@a), s : str(A, ~B)]",
        "{k = b, s = <a1 a2>}",
    ),
    (
        r"C /\ [k = 'b' : A, l : list([x : A])]",
        "[k : ~(A@a), l : list([x : ~B])]",
        "{k = b, l = [{x = a1}]}",
    ),
    ("[k = 'b' : A, l : list(A)]", "[k : ~(A@a), l : list(~B)]", "{k = b, l = [a1]}"),
    ("[f : (A -> A)]", "[f : (A -> ~B)]", r"{f = \x:A. a1}"),
    ("(A -> [x : A])", "(A -> [x : ~B])", r"\x:A. {x = a1}"),
]
"""A type, another one, and what is of the first and not of the other."""


@pytest.mark.parametrize(("S", "T", "shown"), COUNTEREXAMPLES)
def test_a_counterexample_is_of_one_type_and_not_of_the_other(S, T, shown):
    theory = Theory.parse(NAMES)
    lower, upper = theory.parse(S), theory.parse(T)
    against = subtype(lower, upper, theory).counter
    assert str(against.sit) == shown
    assert against.p == REFUTED
    assert against.model.judge(against.sit, lower).holds
    assert against.model.judge(against.sit, upper).p == REFUTED


@pytest.mark.parametrize(
    ("S", "T"), [("B", "A"), ("str(A, A)", "plus(A)"), ("[x : A, y : A]", "[x : A]")]
)
def test_what_holds_has_no_counterexample(S, T):
    theory = Theory.parse(f"{NAMES}\nS := {S}\nT := {T}\n")
    assert subtype(theory.S, theory.T, theory).counter is None


def test_a_counterexample_is_to_the_type_as_it_was_written():
    theory = Theory.parse("basic A, B\nF := \\x:A. [y : B]\nobject a : A")
    T = theory.parse("[z : F(a)]")
    against = subtype(theory.parse("[z : Rec]"), T, theory).counter
    assert against.type is T
    assert against.p == REFUTED
