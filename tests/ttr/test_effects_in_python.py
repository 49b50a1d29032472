"""What the static checks read in effects that are written in Python, and what not.

Each effect is a function `r` of the state `s` in a file of its own, mostly only its
body. What it reads, sets and returns shows in the faults that are found.
"""

import linecache
from itertools import count
from textwrap import dedent, indent

import pytest

import ttr
from ttr import Basic, Ind, ListOf, Model, RecType, outer, record, rectype, replace
from ttr.updates import all_, first, rule
from ttr.updates.checks import faults

Count = Basic("Count")
Move = rectype(spkr=Ind, addr=Ind)
Shared = rectype(qud=ListOf(Ind), move=Move)
Board = rectype(n=Count, agenda=ListOf(RecType), shared=Shared)
M = Model().witnessed(Count, by=lambda n: isinstance(n, int) and n >= 0)
START = record(
    n=0, agenda=[], shared={"qud": [], "move": {"spkr": "ann", "addr": "bob"}}
)
PEOPLE = M.given("ann", Ind).given("bob", Ind)

numbers = count()
KNOWN = {
    "ttr": ttr,
    "Count": Count,
    "Ind": Ind,
    "rectype": rectype,
    "replace": replace,
    "OTHER": lambda *args, **more: args[0],
}
"""What is known in each file; what `OTHER` does is in another one."""


def function_in_file(text, name="r", **names):
    """A function of a file with this text; the file is only in memory."""
    file = f"<effect {next(numbers)}>"
    linecache.cache[file] = (len(text), None, text.splitlines(True), file)
    known = {**KNOWN, **names}
    exec(compile(text, file, "exec"), known)
    return known[name]


def rule_of_file(text, *, when=Board, **options):
    """A rule whose effect is the function `r` of a file with this text."""
    return rule(when=when, **options)(function_in_file(dedent(text)))


def rule_of_body(body, *, parameters="s", **options):
    """A rule whose effect has this body."""
    return rule_of_file(
        f"def r({parameters}):\n{indent(dedent(body).strip(), '    ')}\n", **options
    )


def complaints(one, does):
    """What the checks say that a rule does where it goes wrong: reads, replaces, …"""
    start = f"the rule {one} {does} "
    messages = (fault.message for fault in faults(one, Board, model=M))
    return [m.removeprefix(start).split(",")[0] for m in messages if start in m]


# --- what is read --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "read"),
    [
        ("return s.gone", "s.gone"),
        ("return s.shared.gone", "s.shared.gone"),
        ("return s.gone.further.on", "s.gone.further.on"),
        ("return s['gone']", "s.gone"),
        ("return s['shared.gone']", "s.shared.gone"),
        ("return s['shared']['gone']", "s.shared.gone"),
        ("return s['shared'].gone", "s.shared.gone"),
        ("return s.gone()", "s.gone"),
        ("return s.gone[0]", "s.gone"),
        ("return s.gone(1).further[0].on", "s.gone"),
        ("return len([s.n, {s.gone: 1}])", "s.gone"),
        ("if s.gone:\n    return s", "s.gone"),
        ("def inner():\n    return s.gone\nreturn inner()", "s.gone"),
        ("return (lambda: s.gone)()", "s.gone"),
        # elements and results have other labels, and methods are no labels
        ("return s.shared.qud[0].gone", None),
        ("return s.shared.qud.count(1).gone", None),
        ("return s[0].gone", None),
        ("return s._gone", None),
        ("return s['no label']", None),
        ("return s.shared._gone.further", None),
        # what is set is not read
        ("s.gone = 1", None),
        ("del s.gone", None),
        ("s['gone'] = 1", None),
        ("s.gone.further = 1", "s.gone"),
        # what is in no variable is not known
        ("return OTHER.gone", None),
        ("return OTHER(s).gone", None),
        ("return (s or s).gone", None),
    ],
)
def test_labels_that_are_read(body, read):
    assert complaints(rule_of_body(body), "reads") == [read] * (read is not None)


@pytest.mark.parametrize(
    "body",
    [
        "t = s.shared\nreturn t.gone",
        "t: object = s.shared\nreturn t.gone",
        "if t := s.shared:\n    return t.gone",
        "t = s\nu = t.shared\nreturn u.gone",
        "a = s.shared\nb = a\nc = b\nd = c\nreturn d.gone",
    ],
)
def test_a_name_stands_for_what_it_is_set_to(body):
    assert complaints(rule_of_body(body), "reads") == ["s.shared.gone"]


def test_names_are_followed_through_four_others():
    longer = "a = s.shared\nb = a\nc = b\nd = c\ne = d\nreturn e.gone"
    assert complaints(rule_of_body(longer), "reads") == []


SET_AGAIN = [
    "{0} = OTHER(1)",
    "({0}, other) = OTHER(1)",
    "{0}: object = OTHER(1)",
    "{0} += 1",
    "if ({0} := OTHER(1)): pass",
    "del {0}",
    "for {0} in (): pass",
    "for other, *{0} in (): pass",
    "with OTHER(1) as {0}: pass",
    "[1 for {0} in ()]",
    "try: pass\nexcept OSError as {0}: pass",
    "match OTHER(1):\n    case {0}: pass",
    "match OTHER(1):\n    case int() as {0}: pass",
    "match OTHER(1):\n    case [*{0}]: pass",
    "match OTHER(1):\n    case {{1: 2, **{0}}}: pass",
    "def {0}(): pass",
    "async def {0}(): pass",
    "class {0}: pass",
    "import {0}",
    "import {0}.inner",
    "import other as {0}",
    "from other import {0}",
    "from other import other as {0}",
    "lambda {0}, /: 1",
    "lambda {0}: 1",
    "lambda *{0}: 1",
    "lambda *, {0}: 1",
    "lambda **{0}: 1",
    "def inner({0}): pass",
    "def inner(*, other, {0}=1): pass",
    "def inner():\n    nonlocal {0}\n    {0} = 1",
]


@pytest.mark.parametrize("again", SET_AGAIN)
def test_a_name_that_is_set_twice_stands_for_nothing_known(again):
    again = again.format("t")
    rest = f"if s.n:\n{indent(again, '    ')}\nreturn t.gone"
    assert complaints(rule_of_body(f"t = s.shared\n{rest}"), "reads") == []


@pytest.mark.parametrize("again", SET_AGAIN)
def test_a_variable_that_is_set_again_is_no_longer_the_state(again):
    again = again.format("s")
    rest = f"if s.n:\n{indent(again, '    ')}\nreturn s.gone"
    assert complaints(rule_of_body(rest), "reads") == []


def test_a_name_of_the_whole_file_may_be_set_anywhere():
    body = "global t\nt = s.shared\nOTHER(s)\nreturn t.gone"
    assert complaints(rule_of_body(body), "reads") == []


@pytest.mark.parametrize(
    ("test", "guarded"),
    [
        ("'gone' in s.shared", True),
        ("'gone' not in s.shared", True),
        ("OTHER(1) and not 'gone' in s.shared", True),
        ("hasattr(s.shared, 'gone')", True),
        ("getattr(s.shared, 'gone', None)", True),
        ("'gone' == s.n", False),
        ("'gone' < s.n in s.agenda", False),
        ("s.n in ('gone',)", False),
        ("callable('gone')", False),
        ("hasattr('gone', 'n')", False),
        ("'other' in s.shared", False),
        ("0 in s.agenda", False),
        ("OTHER in s.agenda", False),
        ("hasattr(s, OTHER)", False),
        ("getattr(s.shared, 'n', 'gone')", False),
    ],
)
def test_labels_that_are_tested_for_may_be_missing(test, guarded):
    missing = [] if guarded else ["s.shared.gone"]
    for body in (f"if {test}:\n    return s.shared.gone", f"{test}\nt = s.shared.gone"):
        assert complaints(rule_of_body(body), "reads") == missing
    deeper = rule_of_body(f"if {test}:\n    return s.shared.gone.further")
    assert complaints(deeper, "reads") == [one + ".further" for one in missing]
    set_if = rule_of_body(f"if {test}: return replace(s, {{'shared.gone': 1}})")
    assert complaints(set_if, "replaces") == missing


@pytest.mark.parametrize(
    ("test", "tested"),
    [
        ("match s.shared:\n    case _: pass", True),
        ("match s:\n    case _: pass", True),
        ("model.judge(s.shared, Ind)", True),
        ("model.perceive(s.shared, Ind)", True),
        ("isinstance(s.shared, int)", True),
        ("type(s.shared)", True),
        ("t = s.shared\nisinstance(t, int)", True),
        ("match s.n:\n    case _: pass", False),
        ("match e:\n    case _: pass", False),
        ("model.other(s.shared, Ind)", False),
        ("model.judge(Ind, s.shared)", False),
        ("callable(s.shared)", False),
        ("isinstance(s.shared.move, int)", False),
        ("isinstance(s.shared[0], int)", False),
        ("isinstance(OTHER(s), int)", False),
        ("isinstance()", False),
    ],
)
def test_what_is_tested_to_be_of_a_type_may_have_other_labels(test, tested):
    one = rule_of_body(
        f"{test}\nreturn s.shared.gone", parameters="s, e, model", on=Move
    )
    assert complaints(one, "reads") == ([] if tested else ["s.shared.gone"])


@pytest.mark.parametrize(
    ("body", "read"),
    [
        ("try: t = s.gone\nexcept KeyError: pass", []),
        ("try: t = [s.gone]\nexcept* KeyError: pass", []),
        ("if s.n:\n    try: t = s.gone\n    except KeyError: pass", []),
        ("try: pass\nexcept KeyError: t = s.gone", ["s.gone"]),
        ("try: pass\nexcept KeyError: pass\nelse: t = s.gone", ["s.gone"]),
        ("try: pass\nexcept KeyError: pass\nfinally: t = s.gone", ["s.gone"]),
        ("try: t = s.gone\nfinally: pass", ["s.gone"]),
        ("try: pass\nexcept KeyError: pass\nt = s.gone", ["s.gone"]),
    ],
)
def test_what_is_tried_may_fail(body, read):
    assert complaints(rule_of_body(body), "reads") == read


def test_faults_come_in_the_order_in_which_they_are_written():
    one = rule_of_body("""
        try: pass
        except KeyError: return s.a + s.b
        else: return [s.c, s.d][s.e]
        finally: t = s.f
    """)
    assert complaints(one, "reads") == [f"s.{label}" for label in "abcdef"]


def test_a_path_that_is_read_twice_is_one_fault_for_each_place():
    one = rule_of_body("return s.gone + s.shared.gone + s.gone")
    assert complaints(one, "reads") == ["s.gone", "s.shared.gone", "s.gone"]


def test_events_and_bindings_are_read_like_the_state():
    def reads(body, **options):
        return complaints(rule_of_body(body, **options), "reads")

    heard = {"parameters": "s, e", "on": Move}
    assert reads("return e.gone", **heard) == ["e.gone"]
    assert reads("return e.spkr", **heard) == []
    where = rectype(b=Move @ outer.s.shared.move)
    assert reads("return b.gone", parameters="s, b", where=where) == ["b.gone"]
    assert reads("return b.spkr", parameters="s, b", where=where) == []
    assert reads("return (lambda b: b.gone)(s)", where=where) == []


# --- functions that an effect calls --------------------------------------------------


@pytest.mark.parametrize(
    ("call", "signature", "read"),
    [
        ("look(s)", "board", "s.gone"),
        ("look(board=s)", "board", "s.gone"),
        ("look(1, s)", "other, board", "s.gone"),
        ("look(1, board=s)", "other, board", "s.gone"),
        ("look(s)", "board, /", "s.gone"),
        ("look(board=s)", "*, board", "s.gone"),
        ("look(s, 1, 2)", "board, *others", "s.gone"),
        ("look(s)", "board, other=1", "s.gone"),
        ("look(e)", "board", "e.gone"),
        ("look(e, s)", "s, board", "s.gone"),
        ("OTHER([look(s)])", "board", "s.gone"),
        # which parameter gets what is not known, or no variable is passed on
        ("look(*(), s)", "board", None),
        ("look(s, *())", "board, other=1", None),
        ("look(**{'board': s})", "board", None),
        ("look(s.shared)", "board", None),
        ("look(OTHER(s))", "board", None),
        ("OTHER(look)(s)", "board", None),
        ("look(s, 1)", "other, board", None),
    ],
)
def test_functions_are_followed_if_they_get_a_variable(call, signature, read):
    one = rule_of_file(
        f"""
        def r(s, e): return {call}
        def look({signature}): return board.gone
        """,
        on=Move,
    )
    assert complaints(one, "reads") == [read] * (read is not None)


@pytest.mark.parametrize(("links", "is_followed"), [(4, True), (5, False)])
def test_four_calls_are_followed(links, is_followed):
    calls = [f"def f{i}(s): return f{i + 1}(s)" for i in range(1, links)]
    one = rule_of_file(
        "\n".join(["def r(s): return f1(s)", *calls, f"def f{links}(s): return s.gone"])
    )
    assert complaints(one, "reads") == ["s.gone"] * is_followed


def test_functions_that_call_each_other_are_read_once():
    one = rule_of_file("""
        def r(s): return there(s, s.a)
        def there(s, x): return s.b if x else back(s)
        def back(s): return there(s, s.c) or r(s)
    """)
    assert complaints(one, "reads") == ["s.a", "s.b", "s.c"]


def test_a_function_of_another_file_is_not_followed():
    look = function_in_file("def look(s): return s.gone\n", "look")
    one = rule(when=Board)(
        function_in_file("def r(s): return [look(s), s.lost]\n", look=look)
    )
    assert complaints(one, "reads") == ["s.lost"]


def test_what_the_caller_tests_for_need_not_be_tested_again():
    one = rule_of_file("""
        def r(s):
            if "gone" in s: return look(s)
        def look(s): return further(s, s.gone)
        def further(s, x): return s.gone
    """)
    assert complaints(one, "reads") == []


def test_what_a_function_tests_for_its_caller_has_to_test_as_well():
    one = rule_of_file("""
        def r(s): return look(s) or s.gone
        def look(s): return "gone" in s
    """)
    assert complaints(one, "reads") == ["s.gone"]


def test_a_function_sees_its_own_names_only():
    one = rule_of_file("""
        def r(s):
            t = s.shared
            return look(s, t)
        def look(board, s): return [t.gone, s.gone, board.lost]
        t = 1
    """)
    assert complaints(one, "reads") == ["s.lost"]


# --- names that nothing binds --------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "unbound"),
    [
        ("def r(s): return nobody", ["nobody"]),
        ("def r(s): return nobody(nobody)", ["nobody"]),
        ("def r(s): return [x for x in nobody]", ["nobody"]),
        ("def r(s): return [nobody for x in s]", ["nobody"]),
        ("def r(s): return lambda: nobody", ["nobody"]),
        ("def r(s): return look(s)\ndef look(s): return nobody", ["nobody"]),
        ("def r(s): return look()\ndef look(): return nobody", []),
        ("def r(s):\n    try: nobody\n    except NameError: pass", []),
        ("def r(s): return nobody\nfrom math import *", []),
        ("from math import *\ndef r(s): return nobody", ["nobody"]),
        ("def r(s):\n    nobody = 1\n    return nobody", []),
        # Python, the file or a function around it binds them
        ("def r(s): return len", []),
        ("def r(s): return ttr", []),
        ("later = 1\ndef r(s): return later", []),
        ("def r(s): return later\ndef set_up():\n    global later\n    later = 1", []),
        ("def r(s): return later\nif 0:\n    def later(): pass", []),
        ("def r(s): return later\nif 0:\n    class later: pass", []),
        ("def r(s): return later\nif 0:\n    async def later(): pass", []),
        ("def r(s): return later\nif 0:\n    import later", []),
        ("def r(s): return later\nif 0:\n    import later.on", []),
        ("def r(s): return later\nif 0:\n    from so import later", []),
        ("def r(s): return later\nif 0:\n    from so import much as later", []),
        ("def r(s): return later\nif 0:\n    from so import later as much", ["later"]),
        ("from math import *\ndef r(s): return later\nif 0:\n    later = 1", []),
    ],
)
def test_names_that_nothing_binds(text, unbound):
    one = rule_of_file(text)
    found = [f.message for f in faults(one, Board, model=M) if f.sort == "unbound"]
    assert found == [f"the rule r uses {name}, which nothing binds" for name in unbound]


def test_names_of_the_function_around_an_effect():
    outside = function_in_file(
        dedent("""
            def outside(inner, shared):
                def r(s): return [inner, replace(s, {"shared.gone": not_yet})]
                return r
                not_yet = 1
        """),
        "outside",
    )
    one = rule(when=Board)(outside(1, 2))
    assert [fault.message for fault in faults(one, Board, model=M)] == [
        "the rule r replaces s.shared.gone, but s.shared has no gone"
    ]


# --- what is replaced ----------------------------------------------------------------


def test_what_the_library_has_not_loaded_yet_is_known_by_its_name(monkeypatch):
    monkeypatch.delitem(vars(ttr), "replace", raising=False)
    one = rule_of_body("return ttr.replace(s, gone=1)")
    assert complaints(one, "replaces") == ["s.gone"]


CHANGES = [
    "{'gone': 1}",
    "gone=1",
    "**{'gone': 1}",
    "dict(gone=1)",
    "dict(**{'gone': 1})",
    "**dict(gone=1)",
    "{'n': 1}, gone=1",
    "{'n': 1}, **{'gone': 1}",
    "n=1, gone=1",
    "**{'n': 1}, gone=1",
    "gone=1, **{'n': 1}",
]


@pytest.mark.parametrize("changes", CHANGES)
def test_labels_that_are_replaced(changes):
    assert complaints(rule_of_body(f"return replace(s, {changes})"), "replaces") == [
        "s.gone"
    ]


@pytest.mark.parametrize("changes", ["t", "**t", "dict(**t)", "{'n': 1}, **t"])
def test_changes_may_have_a_name(changes):
    for value in ("{'gone': 1}", "dict(gone=1)"):
        one = rule_of_body(f"t = {value}\nreturn replace(s, {changes})")
        assert complaints(one, "replaces") == ["s.gone"]
    again = rule_of_body(f"t = {{'gone': 1}}\nt |= {{}}\nreturn replace(s, {changes})")
    assert complaints(again, "replaces") == []


@pytest.mark.parametrize(
    "changes",
    [
        "{OTHER: 1, 'gone': 1}",
        "{1: 1, 'gone': 1}",
        "{**OTHER(1), 'gone': 1}",
        "OTHER(gone=1)",
        "dict(OTHER(1), gone=1)",
        "OTHER(1), gone=1",
        "**OTHER(1), gone=1",
        "**{OTHER: 1}, gone=1",
        "*OTHER(1), gone=1",
    ],
)
def test_changes_that_are_not_written_out_are_not_known(changes):
    assert complaints(rule_of_body(f"return replace(s, {changes})"), "replaces") == []


@pytest.mark.parametrize(
    ("body", "replaced"),
    [
        ("return ttr.replace(s, gone=1)", ["s.gone"]),
        ("t = replace(s, gone=1)\nreturn OTHER(t)", ["s.gone"]),
        ("return replace(replace(s, gone=1), lost=1)", ["s.gone", "s.lost"]),
        ("return replace(s, {'shared.gone': 1})", ["s.shared.gone"]),
        ("return replace(s, shared=replace(s.shared, gone=1))", []),
        # what is returned has to be a state, wherever it comes from
        ("return replace(OTHER(s), gone=1)", ["s.gone"]),
        ("return replace(replace(OTHER(s), gone=1), lost=1)", ["s.lost", "s.gone"]),
        ("return replace(OTHER(s), gone=1), model", ["s.gone"]),
        ("return replace(replace(OTHER(s), gone=1), {'n': 1})", ["s.gone"]),
        ("return replace(OTHER(s), a=1) if s.n else replace(OTHER(s), b=1)", "ab"),
        ("t = replace(OTHER(s), gone=1)\nreturn t", ["s.gone"]),
        ("if s.n: return s\nelse: return replace(OTHER(s), gone=1)", ["s.gone"]),
        ("t = replace(OTHER(s), gone=1)\nreturn OTHER(t)", []),
        ("return replace(OTHER(s), gone=1), model, 1", []),
        ("def f(): return replace(OTHER(s), gone=1)\nreturn s", []),
        # only of the library's own function
        ("return OTHER(s, gone=1)", []),
        ("return OTHER.replace(s, gone=1)", []),
        ("return replace(gone=1)", []),
        ("def replace(*a, **b): pass\nreturn replace(s, gone=1)", []),
        ("replace = OTHER\nreturn replace(s, gone=1)", []),
        ("for replace in [OTHER]: return replace(s, gone=1)", []),
        ("import ttr\nreturn ttr.replace(s, gone=1)", []),
        ("def f(): return replace\nreplace = OTHER\nreturn replace(s, gone=1)", []),
    ],
)
def test_calls_of_replace(body, replaced):
    one = rule_of_body(body, parameters="s, model")
    expected = [path if len(path) > 1 else f"s.{path}" for path in replaced]
    assert complaints(one, "replaces") == expected


def test_what_is_replaced_in_an_event_or_a_binding():
    where = rectype(b=Move @ outer.s.shared.move)
    one = rule_of_body(
        "t = [replace(e, gone=1), replace(b, lost=1), replace(e, spkr=1)]\nreturn s",
        parameters="s, e, b",
        on=Move,
        where=where,
    )
    assert complaints(one, "replaces") == ["e.gone", "b.lost"]


# --- what it is replaced by ----------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "found"),
    [
        ("-1", "-1"),
        ("'x'", "x"),
        ("(1, -2)", "[1, -2]"),
        ("[[], ['a']]", "[[], [a]]"),
        ("{'a': -1}", "{a = -1}"),
        ("t", "-3"),
        ("0", None),
        ("True", None),
        ("s.n", None),
        ("s.shared[0]", None),
        ("OTHER(1)", None),
        ("[OTHER]", None),
        ("{'a': OTHER}", None),
        ("{1: 2}", None),
        ("{[]: 2}", None),
        ("-'a'", None),
        ("[-1][0]", None),
        ("lambda: -1", None),
        ("v", None),
    ],
)
def test_values_of_wrong_types(value, found):
    body = f"t = -3\nu = s.shared\nv = -1\nv = 0\nreturn replace(s, n={value})"
    one = rule_of_body(body, parameters="s, e", on=Move)
    expected = [] if found is None else [f"the rule r sets n to {found}"]
    messages = [f.message for f in faults(one, Board, model=M) if f.sort == "misfit"]
    assert [message.split(", which is no ")[0] for message in messages] == expected


@pytest.mark.parametrize(
    ("value", "found"),
    [
        ("s.shared", Shared),
        ("s.shared.move", Move),
        ("t.move", Move),
        ("u", Move),
        ("e", Move),
        ("b", Move),
        ("s.shared.qud", None),
        ("s.shared.move[0]", None),
        ("OTHER(s.shared)", None),
        ("v", None),
    ],
)
def test_what_is_copied_from_elsewhere_is_of_its_type_there(value, found):
    body = f"""
        t = s.shared
        u = s.shared.move
        v = s.shared
        v = 1
        return replace(s, {{"shared.qud": {value}}})
    """
    one = rule_of_body(body, parameters="s, e, b", on=Move, where=rectype(b=Move))
    messages = [f.message for f in faults(one, Board, model=M) if f.sort == "misfit"]
    wrong = f"the rule r sets shared.qud to something of {found}, which is no list(Ind)"
    assert messages == ([] if found is None else [wrong])


# --- types that are built ------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "written"),
    [
        ("return rectype(gone=Ind)", ["gone"]),
        ("return rectype({'gone': Ind})", ["gone"]),
        ("return rectype({'n': Ind}, gone=Ind)", ["gone"]),
        ("return ttr.rectype(gone=Ind)", ["gone"]),
        ("return rectype(shared=rectype(gone=Ind))", ["shared.gone"]),
        ("t = rectype(gone=Ind)\nreturn rectype(shared=t)", ["shared.gone"]),
        ("t = rectype(gone=Ind)\nreturn t", ["gone"]),
        ("return rectype(a=Ind) if s.n else rectype(b=Ind)", ["a", "b"]),
        ("return rectype(n=rectype(gone=Ind))", []),
        ("return rectype(agenda=rectype(gone=Ind))", []),
        ("t = rectype(gone=Ind)\nreturn OTHER(t)", []),
        ("return rectype(shared=OTHER(gone=Ind))", []),
        ("return rectype(shared=OTHER(rectype(gone=Ind)))", []),
        ("return OTHER(rectype(gone=Ind))", []),
        ("return rectype({OTHER: Ind}, gone=Ind)", []),
        ("return rectype()", []),
    ],
)
def test_labels_of_types_that_are_built(body, written):
    assert complaints(rule_of_body(body), "writes") == written


# --- what is returned ----------------------------------------------------------------

ALWAYS = rule_of_file("def always(s): return s\nr = always")
WAITING = rule_of_file(
    "def waiting(s): return s\nr = waiting", when=rectype(n=Count @ 2)
)

HELPERS = """
def reset(board): return replace(board, n=0)
def reset_if(board): return replace(board, n=0) if board.agenda else None
def go_on(board): return OTHER(board)
def nothing(board): pass
"""


@pytest.mark.parametrize(
    ("body", "refuses", "known"),
    [
        # it may refuse: no state is returned; known: what it writes in each case
        ("return s", False, True),
        ("return s, model", False, True),
        ("return replace(s, n=1)", False, True),
        ("return replace(replace(s, n=0), n=1), model", False, True),
        ("return rectype(agenda=Ind)", False, True),
        ("t = replace(s, n=1)\nreturn t", False, True),
        ("a = s\nb = a\nc = b\nd = c\nreturn d", False, True),
        ("return s if s.n else replace(s, n=0)", False, True),
        ("if s.n: return s\nreturn replace(s, n=0)", False, True),
        ("if s.n: return s\nelse: return replace(s, n=0)", False, True),
        ("if s.n: return s\nelif s.agenda: return s\nelse: return s", False, True),
        ("if s.n: raise ValueError\nelse: return s", False, True),
        ("return reset(s)", False, True),
        ("return replace(reset(s), n=1)", False, True),
        ("def f(): return None\nreturn s", False, True),
        ("f = lambda: None\nreturn s", False, True),
        ("class C:\n    def f(self): return\nreturn s", False, True),
        ("match s.n:\n    case 0: return s\n    case _: return s", False, True),
        ("match s.n:\n    case 0: return s\n    case n: return s", False, True),
        # sometimes it returns None
        ("if s.n: return s", True, True),
        ("if s.n: return s\nreturn", True, True),
        ("if s.n: return s\nreturn None", True, True),
        ("return s if s.n else None", True, True),
        ("return reset_if(s)", True, True),
        ("return reset(s) if s.n else nothing(s)", True, True),
        ("if s.n: return s\nelif s.agenda: pass\nelse: return s", True, True),
        ("if s.n: pass\nelse: return s", True, True),
        ("while s.n: return s", True, True),
        ("for one in s.agenda: return s", True, True),
        ("try: return s\nexcept KeyError: pass", True, True),
        ("match s.n:\n    case 0: return s\n    case 1: return s", True, True),
        ("match s.n:\n    case 0: return s\n    case 1 as k: return s", True, True),
        ("match s.n:\n    case 0: return s\n    case _ if s: return s", True, True),
        ("match s.n:\n    case 0: pass\n    case _: return s", True, True),
        ("match s.n:\n    case _:\n        if s: return s", True, True),
        # a state is returned, but which is not known
        ("return replace(OTHER(s), n=1)", False, False),
        ("return replace(s, OTHER(1))", False, False),
        ("return replace(replace(s, OTHER(1)), n=1)", False, False),
        ("return OTHER(s), model", False, False),
        ("return replace(s if s.n else OTHER(s), n=1)", False, False),
        ("return replace(reset_if(s), n=1)", False, False),
        # anything may be returned
        ("return OTHER(s)", True, False),
        ("return go_on(s)", True, False),
        ("return reset(*[s])", True, False),
        ("return s.shared", True, False),
        ("return s.n and s", True, False),
        ("t = s\nt = OTHER(t)\nreturn t", True, False),
        ("s = OTHER(s)\nreturn s", True, False),
        ("a = s\nb = a\nc = b\nd = c\ne = d\nreturn e", True, False),
        ("return s, model, 1", True, False),
    ],
)
def test_what_an_effect_may_return(body, refuses, known):
    effect = f"def r(s, model):\n{indent(body, '    ')}\n"
    one = rule_of_file(effect + HELPERS)
    late = {f.rule for f in faults(first(one, ALWAYS), Board) if f.sort == "dead"}
    assert late == (set() if refuses else {ALWAYS})
    found = faults(all_(one, WAITING), Board, start=START, model=PEOPLE)
    assert (WAITING in {f.rule for f in found if f.sort == "unset"}) == known


def test_what_an_effect_writes_in_one_case_may_be_what_another_waits_for():
    for body in (
        "return replace(s, n=2)",
        "return replace(s, n=2) if s.agenda else replace(s, n=1)",
        "return replace(replace(s, n=2), agenda=())",
        "if s.agenda: return s\nreturn set_to_two(s)",
        "return rectype(n=Count)",
    ):
        text = f"def r(s):\n{indent(body, '    ')}\n"
        one = rule_of_file(text + "def set_to_two(b): return replace(b, n=2)\n")
        found = faults(all_(one, WAITING), Board, start=START, model=PEOPLE)
        assert WAITING not in {f.rule for f in found if f.sort == "unset"}


# --- where it is written -------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "underlined", "line"),
    [
        ("def r(s): return s.gone", ["gone"], 1),
        ("def r(s): return s.gone.further", ["gone"], 1),
        ("def r(s): return s.shared.gone", ["gone"], 1),
        ("def r(s): return s['gone']", ["'gone'"], 1),
        ("def r(s): return s['shared.gone']", ["'shared.gone'"], 1),
        ("def r(s): return (s.shared\n    .gone)", ["gone"], 2),
        ("def r(s): return (s.\n    gone, 1)", ["gone"], 2),
        ("def r(s): return ['åäö', '\N{WINKING FACE}', s.gone]", ["gone"], 1),
        ("def r(s): return ['åäö', nobody, 'å']", ["nobody"], 1),
        ("def r(s): return replace(s, n=len('å'), gone='å')", ["gone"], 1),
        ("def r(s): return replace(s, {'å': 1, 'gone': 2})", ["'å'", "'gone'"], 1),
        ("def r(s): return replace(s, {'n':\n1,\n'gone': 2})", ["'gone'"], 3),
        ("def r(s): return replace(s, {'go'\n'ne': 2})", ["'go'"], 1),
        ("def r(s):\n\treturn (\ts.gone)", ["gone"], 2),
        ("def r(s): return rectype(shared=rectype(gone=Ind))", ["gone"], 1),
        ("def r(s): return rectype({'gone': Ind})", ["'gone'"], 1),
        ("t = lambda s: s.n\nr = lambda s: (s.gone)", ["gone"], 2),
    ],
)
def test_what_is_wrong_is_underlined(text, underlined, line):
    found = [fault.span for fault in faults(rule_of_file(text), Board, model=M)]
    assert [s.text[s.column - 1 : s.column - 1 + s.length] for s in found] == underlined
    assert {span.line for span in found} == {line}
    assert "\t" not in "".join(span.text for span in found)


# --- which function it is ------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("r = lambda s: s.gone", ["s.gone"]),
        ("o, r = lambda s: s.lost, lambda s: s.gone", ["s.gone"]),
        ("r, o = lambda s: s.gone, lambda s: s.lost", ["s.gone"]),
        ("r = [lambda s:\n    s.gone, lambda s: s.lost][0]", ["s.gone"]),
        ("o, r = lambda t: t.lost, lambda s: s.gone", ["s.gone"]),
        ("o, r = lambda: s.lost, lambda s: s.gone", ["s.gone"]),
        ("def r(s): return (lambda s: s.lost)(s)", []),
        ("r = lambda s: lambda s: s.lost", []),
        ("r = (lambda s: lambda s: s.gone)(1)", []),
        ("def r(s): return s.gone\no = r\ndef r(s): return s.lost\nr = o", ["s.gone"]),
        ("def f(g): return g\n@f\n@f\ndef r(s): return s.gone", ["s.gone"]),
        ("def f(g): return lambda s: g(s)\n@f\ndef r(s): return s.gone", ["s.gone"]),
        ("def r(s, /): return s.gone", ["s.gone"]),
    ],
)
def test_the_function_that_is_read_is_the_effect_itself(text, read):
    assert complaints(rule_of_file(text), "reads") == read
