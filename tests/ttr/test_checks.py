"""Static checks: what they see, what they leave alone, and that they raise no alarm."""

import dataclasses
import runpy
import time
from pathlib import Path

import pytest

from ttr import (
    Basic,
    ListOf,
    Model,
    Pred,
    Rec,
    RecType,
    Theory,
    load,
    outer,
    record,
    rectype,
    replace,
    this,
)
from ttr.errors import UpdateError
from ttr.types import NonEmpty
from ttr.types.objects import fst
from ttr.types.records import differences
from ttr.updates import (
    Game,
    all_,
    ask,
    by_class,
    first,
    maybe,
    repeat,
    rule,
    seq,
    update,
)
from ttr.updates.checks import Fault, faults, faults_alone, faults_of

EXAMPLES = Path(__file__).resolve().parent.parent.parent / "examples"

Ind, Text, Count = Basic("Ind"), Basic("Text"), Basic("Count")
hug, run_ = Pred("hug", Ind), Pred("run", Ind)
Move = rectype(spkr=Ind, addr=Ind)
Ask = rectype(spkr=Ind, addr=Ind, question=RecType)
Board = rectype(
    agenda=ListOf(RecType),
    n=Count,
    shared=rectype(qud=ListOf(RecType), latest=Rec, move=Move, facts=ListOf(Ind)),
)
M = Model().witnessed(Count, by=lambda n: isinstance(n, int) and n >= 0)


def messages(algorithm, type=Board, **known):
    return [fault.message for fault in faults(algorithm, type, **known)]


def sorts(algorithm, type=Board, **known):
    return [fault.sort for fault in faults(algorithm, type, **known)]


# --- no false alarms -----------------------------------------------------------------


def test_no_alarm_for_the_games_of_a_tutor():
    from kille.dialogue.meanings import noun
    from kille.dialogue.tutoring import tutoring

    assert faults_of(tutoring([noun("cup")])) == ()


def test_no_alarm_for_a_travel_agency():
    travel = runpy.run_path(str(EXAMPLES / "travel" / "travel.py"))["game"]
    assert [fault for fault in faults_of(travel) if fault.severity == "error"] == []


def test_no_alarm_for_the_game_of_fetch():
    assert faults_of(load(EXAMPLES / "fetch.ttr").games["fetch"]) == ()


def test_no_alarm_for_what_cannot_be_followed():
    @rule(when=Board)
    def any_way(s):
        t = s
        s = getattr(t, "whatever", t)
        label = "nowhere"
        if "hidden" in s.shared and s.shared.hidden:
            return replace(s, {label: 1})
        return replace(s, {f"shared.{label}": s.shared.latest.of.any.kind})

    @rule(when=Board)
    def tried(s):
        try:
            return replace(s, n=s.hidden)
        except AttributeError:
            return None

    @rule(when=Board)
    def asked(s):
        return replace(s, n=s.extra) if hasattr(s, "extra") else None

    @rule(when=Board)
    def inner(s):
        return replace(s, n=len([s for s in s.shared.qud if s.hidden]))

    @rule(when=Board)
    def methods(s):
        return replace(s, n=s.shared.qud.count(1) + s.n.bit_length())

    @rule(when=Board, on=Move)
    def judged(s, e, *, model):
        if model.judge(e, Ask).holds and isinstance(s.shared.move, object):
            return replace(s, agenda=(e.question, s.shared.move.question))
        return None

    @rule(when=Board)
    def elsewhere(s):
        return replace(s, n=len(list(differences(s, s.agenda))))

    algorithm = all_(any_way, tried, asked, inner, methods, judged, elsewhere)
    assert messages(algorithm, model=M) == []


def test_more_specific_types_may_have_more_labels():
    @rule(when=rectype(shared=rectype(latest=Ask, move=Ask)), on=Ask)
    def answer(s, e):
        return replace(s, {"shared.move": e, "agenda": (s.shared.move.question,)})

    @rule(when=Board)
    def later(s):
        return replace(s, agenda=(s.shared.move.question,))

    assert messages(first(answer, later)) == []
    assert messages(later) == [
        "the rule later reads s.shared.move.question, but s.shared.move has no question"
    ]


def test_what_the_start_has_may_be_read():
    @rule(when=Board)
    def look(s):
        return replace(s, n=s.extra)

    shared = record(qud=[], latest={}, move=record(spkr="a", addr="b"), facts=[])
    start = record(agenda=[], n=0, shared=shared, extra=1)
    N = M.given("a", Ind).given("b", Ind)
    assert messages(look, start=start, model=N) == []
    assert sorts(look) == ["missing"]


def test_events_may_be_of_what_the_rule_before_takes():
    said, named = rectype(text=Text), rectype(name=Ind)

    @rule(when=Board, on=said)
    def hear(s, e):
        return replace(s, {"shared.latest": e})

    @rule(when=Board, on=named)
    def keep(s, e):
        return replace(s, n=len(e.text) + len(e.nmae))

    (fault,) = faults(seq(hear, keep), Board)
    assert fault.message == "the rule keep reads e.nmae, but e has no nmae"
    assert fault.hint == "did you mean name?"


def test_functions_that_an_effect_calls_are_read_too():
    @rule(when=Board)
    def plan(s):
        shared = s.shared
        return planned(s, shared.qdu)

    @rule(when=Board)
    def plan_again(s):
        return planned(s, 1)

    found = faults(all_(plan, plan_again), Board)
    assert [fault.message for fault in found] == [
        "the rule plan reads s.shared.qdu, but s.shared has no qdu",
        "the rule plan replaces s.shared.pln, but s.shared has no pln",
    ]
    assert found[1].span.text.strip() == 'return replace(board, {"shared.pln": what})'


def test_what_is_returned_is_a_state():
    @rule(when=Board)
    def plan(s, *, model):
        board = CHANGES["somehow"](s)
        after = replace(board, m=1)
        return (after, model) if s.n else (replace(board, n=1), model)

    assert messages(plan) == ["the rule plan replaces s.m, but s has no m"]


def test_types_that_an_effect_builds():
    @rule(when=Board)
    def ask_it(s):
        asked = rectype(spkr=Ind, addr=Ind, question=RecType)
        if s.n:
            return rectype(shared=rectype(move=asked))
        return rectype(n=Count, shared=rectype(mvoe=asked, latest=rectype(any=Ind)))

    found = faults(ask_it, Board)
    assert [fault.message for fault in found] == [
        "the rule ask_it writes shared.mvoe, but shared has no mvoe"
    ]
    assert found[0].span.text[found[0].span.column - 1 :].startswith("mvoe=asked")
    assert messages(first(ask_it, ALWAYS)) == [
        found[0].message,
        "the rule always can never fire: "
        "the rule ask_it comes first, and applies wherever always would",
    ]


def test_functions_are_followed_only_where_they_get_the_state():
    @rule(when=Board)
    def by_name(s):
        return planned(board=s, what=1)

    @rule(when=Board)
    def unpack(s):
        return third_of(*PAIR, s)

    @rule(when=Board)
    def round_and_round(s):
        return again(s)

    found = messages(all_(by_name, unpack, round_and_round))
    assert found == ["the rule by_name replaces s.shared.pln, but s.shared has no pln"]


PAIR = (1, 2)


def third_of(one, other, board):
    return replace(board, n=other.real)


def again(board):
    return again(board)


def test_names_that_stand_for_others_are_followed_four_times():
    @rule(when=Board)
    def use_other_name(s):
        one = replace(CHANGES["somehow"](s), m=1)
        two = one
        three = two
        four = three
        return four

    assert messages(use_other_name) == [
        "the rule use_other_name replaces s.m, but s has no m"
    ]


def test_what_the_effect_asks_for_first_may_be_missing():
    @rule(when=Board)
    def asked(s):
        if "hidden" in s.shared:
            return replace(s, n=s.shared.hidden)
        return s

    assert messages(asked) == []


def planned(board, what):
    return replace(board, {"shared.pln": what})


# --- paths ---------------------------------------------------------------------------


def test_each_path_that_is_missing():
    @rule(when=Board, gives=rectype(agneda=ListOf(RecType)))
    def plan(s):
        changes = {"shared.qdu": (), "agenda": ()}
        return replace(replace(s, changes), m=1)

    found = faults(plan, Board)
    assert [(fault.message, fault.hint) for fault in found] == [
        (
            "the rule plan replaces s.shared.qdu, but s.shared has no qdu",
            "did you mean qud?",
        ),
        ("the rule plan replaces s.m, but s has no m", "s has agenda, n, shared"),
        (
            "the rule plan promises agneda, but a state has no agneda",
            "did you mean agenda?",
        ),
    ]
    assert found[2].span.text.strip().startswith("@rule(when=Board, gives=")


def test_a_path_of_a_binding_is_underlined_where_it_leads_nowhere():
    @rule(when=Board, where=rectype(qdu=RecType @ outer.s.shared.qdu.first))
    def drop(s, qdu):
        return s

    (fault,) = faults(drop, Board)
    assert fault.message.endswith("but s.shared has no qdu")
    assert fault.span.text[fault.span.column - 1 :].startswith("qdu=RecType")


def test_what_nothing_binds_is_not_missing_too():
    one = made("one", where=rectype(q=Ind @ outer.nobody.name))
    assert messages(one) == ["the rule one uses nobody, which nothing binds"]


def test_labels_that_are_known_from_several_types_or_from_an_object():
    state = rectype(r=rectype(a=Ind) @ record(a="x"))

    @rule(when=state)
    def read(s):
        return replace(s, {"r.a": s.r.b})

    assert messages(read, state) == ["the rule read reads s.r.b, but s.r has no b"]
    both = rectype(shared=rectype(qdu=Ind) & rectype(qud=ListOf(RecType)))
    assert messages(made("both", both)) == [
        "the rule both asks for shared.qdu, but shared has no qdu"
    ]


def test_a_place_that_is_set_to_anything_may_have_any_label():
    @rule(when=Board)
    def move(s):
        return replace(s, {"shared.move": CHANGES["somehow"](s)})

    @rule(when=Board)
    def look(s):
        return replace(s, agenda=(s.shared.move.question,))

    assert messages(all_(move, look)) == []
    assert len(messages(look)) == 1


def test_the_variable_of_the_state_may_have_any_name():
    theory = Theory.parse("""
        basic Ind
        Board := [x : [a : Ind]]
        Event := [x : list(Ind)]
        rule never(board : Board, event : Event)
            where [q = board.x : list(Ind)] := Board
        rule may(board : Board, event : Event)
            where [q = event.x : list(Ind)] := Board
    """)
    assert sorts(theory.rules["never"], theory.Board) == ["dead"]
    assert sorts(theory.rules["may"], theory.Board) == []


def test_faults_without_a_place_of_their_own_are_shown_at_the_rule():
    one = made("one", rectype(nn=Count))
    (fault,) = faults(one, Board)
    assert fault.span == one.span
    assert fault.span.text[fault.span.column - 1 :].startswith("applies(s)")


def test_paths_of_bindings_and_measures():
    @rule(when=Board, where=rectype(q=RecType @ fst(outer.s.shared.qdu)))
    def drop(s, q):
        return replace(s, {"shared.qud": s.shared.qud[1:]})

    assert messages(drop) == [
        "the rule drop reads s.shared.qdu, but s.shared has no qdu"
    ]
    assert messages(repeat(seq(), measure="shared.qdu")) == [
        "a repetition is measured by shared.qdu, but shared has no qdu"
    ]


def test_the_path_of_the_agenda():
    @rule(when=rectype(n=Count))
    def stay(s):
        return s

    state, start = rectype(n=Count), record(n=0)
    game = Game("g", state, start, stay, M)
    object.__setattr__(game, "agenda", "next")
    assert [fault.message for fault in faults_of(game)] == [
        "moves are planned at next, but a state has no next"
    ]


def test_where_a_named_type_is_misspelt():
    @rule(when=MISSPELT)
    def wait(s):
        return s

    (fault,) = faults(wait, Board)
    assert fault.span.text.startswith("MISSPELT = ")
    assert fault.span.text[fault.span.column - 1 :].startswith("qdu")


MISSPELT = rectype(shared=rectype(qdu=ListOf(RecType)))


def test_update_functions_are_read_too():
    theory = Theory.parse(r"""
        basic Ind
        object a : Ind
        Board := [spkr : Ind, addr : Ind]
        turn := \s:[spkr : Ind]. [adr = s.spkr : Ind]
    """)
    assert messages(update(theory.turn, "turn"), theory.Board) == [
        "the rule turn writes adr, but a state has no adr"
    ]


def test_a_rule_alone_may_write_what_its_pattern_does_not_name():
    theory = Theory.parse("""
        basic Ind
        object a : Ind
        rule greet(s : [spkr : Ind]) := [latest = s.spkr : Ind]
    """)
    assert faults_alone(theory.rules["greet"]) == ()
    assert len(faults(theory.rules["greet"], rectype(spkr=Ind))) == 1


# --- values --------------------------------------------------------------------------


def test_a_rule_of_a_file_that_is_changed_afterwards_is_read_again():
    theory = Theory.parse("""
        basic Ind
        Board := [qud : list([by : Ind]), last : [by : Ind], next : [by : Ind]]
        rule go_on(s : [last : [by : Ind]], e : [by : Ind])
            := [last : [by = e.by : Ind], next = s.last : [by : Ind]]
    """)
    go_on, Board = theory.rules["go_on"], theory.Board
    assert faults(go_on, Board) == ()
    elsewhere = dataclasses.replace(go_on, when=rectype(qud=Board["qud"]))
    found = faults(elsewhere, rectype(qud=Board["qud"], next=Rec))
    assert [fault.message for fault in found] == [
        "the rule go_on reads s.last, but s has no last",
        "the rule go_on writes last, but a state has no last",
    ]
    (span, _) = [fault.span for fault in found]
    assert span.text[span.column - 1 :].startswith("last : [by : Ind]]")
    (fault,) = faults(dataclasses.replace(go_on, names=("s", "said")), Board)
    assert fault.message == "the rule go_on uses e, which nothing binds"


def test_values_of_wrong_types():
    @rule(when=Board, gives=rectype(agenda=Text))
    def wrong(s):
        if s.n:
            return replace(s, n=-1)
        return replace(s, {"shared.facts": "a", "agenda": (1, 2)})

    found = messages(wrong, model=M)
    assert found == [
        "the rule wrong sets n to -1, which is no Count",
        "the rule wrong sets shared.facts to a, which is no list(Ind)",
        "the rule wrong sets agenda to [1, 2], which is no list(RecType)",
    ]


def test_promises_of_wrong_values():
    promising = made("promising", gives=rectype(n=Count @ -1))
    assert messages(promising, model=M) == [
        "the rule promising promises to set n to -1, which is no Count"
    ]


def test_a_promise_is_wrong_once_though_value_and_type_are():
    both = made("both", gives=rectype(agenda=rectype(a=Ind) @ record(a="x")))
    assert messages(both) == [
        "the rule both promises to set agenda to {a = x}, which is no list(RecType)"
    ]


def test_a_value_that_cannot_be_judged_is_left_alone():
    def broken(n):
        raise ValueError(n)

    @rule(when=Board)
    def count(s):
        return replace(s, n=-1)

    assert messages(count, model=Model().witnessed(Count, by=broken)) == []


@pytest.mark.parametrize("quote", ["'", '"'])
def test_what_is_quoted_in_a_rule_is_no_place_and_no_comment(quote):
    board = Theory.parse(f"""
    basic Ind
    Board := [spkr : Ind]
    rule turn(s : Board) {quote}No # 1 := hearer{quote} := [hearer = s.spkr : Ind]
    """)
    [fault] = faults(board.rules["turn"], board.Board)
    assert fault.span is not None
    assert fault.span.text[fault.span.column - 1 :].startswith("hearer = s.spkr")


PLACES = """
    basic Ind
    object ann : Ind
    pred p(Ind), q(Ind)
    given d : q(ann)
    Event := [n : [a : Ind]]
    Board := [c : p(ann), e : Rec, l : list(Ind), r : [a : Ind],
              u : [a : Ind] \\/ [b : Ind], h : [a = l : list(Ind)]]
"""


@pytest.mark.parametrize(
    ("parameters", "body", "found"),
    [
        ("s : Board", "[r : list(Ind)]", ["something of list(Ind)"]),
        ("s : Board", "[l = {} : Rec]", ["{}"]),
        ("s : Board, e : Event", "[l = e.n : Rec]", ["something of [a : Ind]"]),
        # inside, e is the label, not the event
        ("s : Board, e : Event", "[e : [n : list(Ind)], l = e.n : list(Ind)]", []),
        (
            "s : Board",
            "{c = s.c, e = s.e, h = s.h, l = [], r = s.r, u = {a = ann}}",
            [],
        ),
        ("s : Board", "[r : [a : Ind, c : p(a)]]", []),
        ("s : Board", "[c = d : p(ann)]", []),
        # what the type of h depends on may be set, too
        ("s : Board", "[h = s.l : list(Ind)]", []),
    ],
)
def test_what_a_rule_in_a_file_sets(parameters, body, found):
    theory = Theory.parse(f"{PLACES}\n    rule r({parameters}) := {body}")
    told = faults(theory.rules["r"], theory.Board, model=Model(theory))
    assert [one.message.split(" to ")[1] for one in told if one.sort == "misfit"] == [
        f"{what}, which is no {'[a : Ind]' if 'list' in what else 'list(Ind)'}"
        for what in found
    ]


def test_a_value_that_may_become_known_is_left_alone():
    @rule(when=Board)
    def name(s, *, model):
        after = replace(s, {"shared.facts": ("new",)})
        return after, model.given("new", Ind)

    assert messages(name, model=M) == []


def test_a_start_that_is_no_state():
    assert messages(seq(), rectype(n=Count), start=record(n=-1), model=M) == [
        "the state to start from is not of its type, at n: -1 : Count, "
        "by the witness function of Count"
    ]


# --- rules that never fire -----------------------------------------------------------


@pytest.mark.parametrize(
    ("condition", "why"),
    [
        (rectype(n=Count @ -1), "it asks that n be -1, but n is of Count"),
        (rectype(shared=ListOf(Ind)), "it asks that shared be of list(Ind)"),
        (rectype(agenda=NonEmpty(RecType) @ ()), "nothing can be a state and of"),
        (
            rectype(agenda=(NonEmpty(RecType) @ ()) | (NonEmpty(Ind) @ ())),
            "it asks that agenda be of",
        ),
    ],
)
def test_impossible_conditions(condition, why):
    @rule(when=condition)
    def never(s):
        return s

    (message,) = messages(never, model=M)
    assert message.startswith(f"the rule never can never fire: {why}")


def test_an_impossible_condition_behind_one_of_which_nothing_is_known():
    state = rectype(a=Rec, b=Rec, n=Count)
    anything = rectype(a=rectype(x=Ind), b=Rec, n=Count @ -1)
    (message,) = messages(made("never", anything), state, model=M)
    assert message == (
        "the rule never can never fire: it asks that n be -1, but n is of Count"
    )


def test_impossible_bindings():
    @rule(when=Board, where=rectype(q=ListOf(Ind) @ outer.s.shared.move))
    def never(s, q):
        return s

    assert sorts(never) == ["dead"]


@pytest.mark.parametrize(
    ("value", "hint"),
    [
        ("[Said /\\ Hello]", "a meet of record types is none itself, merge(S, T) is"),
        ("[merge(Said, Hello)]", None),
        ("[Said /\\ Ind]", ""),
        ("Said /\\ Hello", ""),
    ],
)
def test_a_meet_is_no_record_type_but_a_merge_is(value, hint):
    game = Theory.parse(f"""
        basic Ind
        Said := [x : Ind]
        Hello := [y : Ind]
        Board := [agenda : list(RecType)]
        rule greet(s : Board) := [agenda = {value} : list(RecType)]
        game g({{agenda = []}} : Board) := greet
    """).games["g"]
    found = [fault.hint for fault in faults_of(game) if fault.sort == "misfit"]
    assert found == ([] if hint is None else [hint])


def test_an_element_of_a_wrong_type():
    one = Theory.parse("""
        basic Ind, Dish
        object ann : Ind
        object fish : Dish
        Board := [dishes : list(Dish)]
        rule right(s : Board) := [dishes = [fish] : list(Dish)]
        rule wrong(s : Board) := [dishes = [fish, ann] : list(Dish)]
        game g({dishes = []} : Board) := first(right, wrong)
    """).games["g"]
    assert [fault.message for fault in faults_of(one) if fault.sort == "misfit"] == [
        "the rule wrong sets dishes to [fish, ann], which is no list(Dish)"
    ]


SEARCHED = """
    basic Ind, Dish
    object ann : Ind
    pred ordered(Dish), serve(Ind, Dish)
    Order := [dish : Dish]
    Board := [dishes : list(Dish), agenda : list(RecType)]
"""


@pytest.mark.parametrize(
    "T", ["~ordered(d)", "list(Dish)", "[x : Dish, no : ~ordered(x)]", "(Ind -> Type)"]
)
def test_what_no_search_can_find(T):
    one = Theory.parse(f"""{SEARCHED}
    rule missing(s : Board, e : Order)
        where [d = e.dish : Dish, sit : {T}] := [agenda = [] : list(RecType)]
    """).rules["missing"]
    (fault,) = faults(one, one.when)
    assert fault.sort == "unbound"
    assert fault.span.column == 35
    assert "missing looks for sit, but what is of its type cannot be" in fault.message


@pytest.mark.parametrize(
    "T", ["ordered(d)", "Dish", "[x : Dish, c : ordered(x)]", "Dish /\\ ~Ind", "Rec"]
)
def test_what_a_search_can_find(T):
    one = Theory.parse(f"""{SEARCHED}
    rule there(s : Board, e : Order)
        where [d = e.dish : Dish, sit : {T}] := [agenda = [] : list(RecType)]
    """).rules["there"]
    assert faults(one, one.when) == ()


def test_a_label_that_hides_what_it_should_be_set_to():
    """It stands for itself, so that no move can be made of the planned type."""
    one = Theory.parse(f"""{SEARCHED}
    rule plan(s : Board, e : Order)
        where [dish = e.dish : Dish]
        := [agenda = [[dish = dish : Dish, c : serve(ann, dish)]] : list(RecType)]
    """).rules["plan"]
    (fault,) = faults(one, one.when)
    assert fault.severity == "warning"
    assert fault.sort == "unbound"
    assert fault.message == "in the rule plan dish is set to itself: dish → dish"
    assert fault.hint == "give what where binds another name than the label"
    assert fault.span.text[fault.span.column - 1 :].startswith("dish = dish : Dish,")


def test_a_write_is_underlined_where_it_is_written():
    one = Theory.parse("""
        basic Ind
        object ann : Ind
        Board := [x : list(Ind)]
        rule wrong(s : Board /\\ [x = [] : list(Ind)]) := [x = ann : list(Ind)]
    """).rules["wrong"]
    (fault,) = faults(one, one.when)
    assert fault.span.text[fault.span.column - 1 :].startswith("x = ann")


def test_a_condition_with_more_cases_than_are_told_apart_is_taken_as_a_whole():
    either = rectype(**{f"x{i}": Ind | Text for i in range(9)})
    assert messages(made("whole", either), either) == []


@pytest.mark.parametrize(
    ("fields", "circle"),
    [
        ("x = y : Dish, y = x : Dish", "x → y → x"),
        ("x = y : Dish, y = z : Dish, z = x : Dish", "x → y → z → x"),
        ("w = z : Dish, y = z : Dish, z = y : Dish", "z → y → z"),
        ("x : [y = ^.z : Dish], z = x.y : Dish", "x.y → z → x.y"),
    ],
)
def test_a_type_that_goes_in_a_circle(fields, circle):
    one = Theory.parse(f"""{SEARCHED}
    rule plan(s : Board) := [agenda = [[{fields}]] : list(RecType)]
    """).rules["plan"]
    (fault,) = faults(one, one.when)
    assert fault.message == f"in the rule plan fields go in a circle: {circle}"
    assert "no witness" in fault.hint
    assert fault.severity == "warning"


def test_bindings_that_go_in_a_circle():
    one = Theory.parse(f"""{SEARCHED}
    rule plan(s : Board) where [x = y : Dish, y = x : Dish]
        := [dishes = [x] : list(Dish)]
    """).rules["plan"]
    (fault,) = faults(one, one.when)
    assert fault.message == "in the rule plan fields go in a circle: x → y → x"
    assert fault.span.text[fault.span.column - 1 :].startswith("x = y : Dish")


def made(name, when=Board, on=None, refuses=False, **options):
    """A rule that changes nothing, or refuses."""

    def applies(s):
        return s

    def refusing(s):
        return None if s.n else s

    def hears(s, e):
        return s

    effect = hears if on is not None else refusing if refuses else applies
    effect.__name__ = name
    return rule(when=when, on=on, **options)(effect)


ALWAYS, SOMETIMES = made("always"), made("sometimes", rectype(n=Count @ 0))
LOW = made("low", on=Move, p=(0, 0.5))
EMPTY = rectype(n=Count @ 0, agenda=ListOf(RecType) @ ())
OF_A_CLASS = by_class(
    made("one", EMPTY, kind="k"), made("other", kind="k"), order=["k"]
)


@pytest.mark.parametrize(
    ("algorithm", "never"),
    [
        (first(ALWAYS, SOMETIMES), ["sometimes"]),
        (first(SOMETIMES, ALWAYS), []),
        (first(SOMETIMES, made("late", EMPTY)), ["late"]),
        (first(made("early", EMPTY), SOMETIMES), []),
        (first(made("early", refuses=True), SOMETIMES), []),
        (first(made("early", where=rectype(q=Ind)), SOMETIMES), []),
        (first(maybe(made("early", EMPTY)), SOMETIMES), ["sometimes"]),
        (first(seq(ALWAYS, made("and", EMPTY)), SOMETIMES), []),
        (first(seq(ALWAYS, maybe(made("and", EMPTY))), SOMETIMES), ["sometimes"]),
        (first(all_(made("and", EMPTY), ALWAYS), SOMETIMES), ["sometimes"]),
        (first(first(made("and", EMPTY), ALWAYS), SOMETIMES), ["sometimes"]),
        (first(ALWAYS, seq(SOMETIMES, made("then"))), ["sometimes"]),
        (first(ALWAYS, seq(maybe(SOMETIMES), made("then"))), ["sometimes"]),
        (seq(first(ALWAYS, SOMETIMES), SOMETIMES), []),
        (seq(first(ALWAYS, SOMETIMES), made("then")), ["sometimes"]),
        (all_(made("now"), first(ALWAYS, SOMETIMES)), ["sometimes"]),
        (first(made("and", EMPTY), maybe(first(ALWAYS, SOMETIMES))), ["sometimes"]),
        (all_(ALWAYS, SOMETIMES), []),
        (ask(ALWAYS, SOMETIMES, choose=lambda names, state: 0), []),
        (first(made("hear", on=Move), made("late", on=Ask)), ["late"]),
        (first(made("hear", on=Ask), made("late", on=Move)), []),
        (first(made("hear", on=Move), made("tacit")), []),
        (first(made("tacit"), made("late", on=Move)), ["late"]),
        (first(made("sure", on=Move), made("late", on=Move, p=0.5)), []),
        (first(made("unsure", on=Move, p=0.5), made("late", on=Move)), ["late"]),
        (first(made("low", on=Move, p=(0, 0.5)), made("late", on=Move)), []),
        (first(LOW, made("late", on=Move, p=(0.2, 0.5))), ["late"]),
        (first(LOW, made("late", on=Move, p=(0.2, 0.6))), []),
        (first(repeat(ALWAYS, times=2), SOMETIMES), ["sometimes"]),
        (first(repeat(SOMETIMES, times=2), ALWAYS), []),
        (first(OF_A_CLASS, SOMETIMES), ["sometimes"]),
        (first(ALWAYS, OF_A_CLASS), []),
        (first(ask(ALWAYS, choose=lambda names, state: 0), SOMETIMES), []),
        (first(ALWAYS, ask(SOMETIMES, choose=lambda names, state: 0)), ["sometimes"]),
        (first(ALWAYS, all_(SOMETIMES, made("then"))), ["sometimes"]),
        (first(ALWAYS, repeat(SOMETIMES, times=2)), ["sometimes"]),
        (first(ALWAYS, seq(made("then"), SOMETIMES)), ["then"]),
        (first(seq(maybe(SOMETIMES), ALWAYS), SOMETIMES), []),
    ],
    ids=str,
)
def test_cases_that_come_too_late(algorithm, never):
    assert [fault.rule.name for fault in faults(algorithm, Board)] == never


def test_the_way_out_of_coming_too_late():
    (fault,) = faults(first(ALWAYS, SOMETIMES), Board)
    assert fault.hint == "put sometimes before always"
    (fault,) = faults(first(maybe(ALWAYS), SOMETIMES), Board)
    assert fault.hint == ""


@rule(when=Board)
def only_if(s):
    if s.n:
        return replace(s, n=0)


@rule(when=Board)
def by_both_branches(s):
    if s.n:
        return replace(s, n=0)
    else:
        return s


@rule(when=Board)
def by_one_branch(s):
    if s.n:
        return replace(s, n=0)
    else:
        pass


@rule(when=Board)
def by_other_branch(s):
    if s.n:
        pass
    else:
        return s


@rule(when=Board)
def by_helper(s):
    return reset(s)


@rule(when=Board)
def by_helper_if(s):
    return reset_if(s)


@rule(when=Board)
def by_cases(s):
    match s.n:
        case 0:
            return s
        case _:
            return replace(s, n=0)


@rule(when=Board)
def by_some_cases(s):
    match s.n:
        case 0:
            return s
        case 1:
            return replace(s, n=0)


@rule(when=Board)
def by_guarded_cases(s):
    match s.n:
        case 0:
            return s
        case _ if s.agenda:
            return replace(s, n=0)


def reset(board):
    return replace(board, n=0)


def reset_if(board):
    return replace(board, n=0) if board.n else None


@pytest.mark.parametrize(
    ("one", "never"),
    [
        (only_if, []),
        (by_both_branches, ["always"]),
        (by_one_branch, []),
        (by_other_branch, []),
        (by_helper, ["always"]),
        (by_helper_if, []),
        (by_cases, ["always"]),
        (by_some_cases, []),
        (by_guarded_cases, []),
    ],
    ids=str,
)
def test_a_rule_that_may_refuse_leaves_something_to_the_next(one, never):
    assert [fault.rule.name for fault in faults(first(one, ALWAYS), Board)] == never


def test_axioms_count():
    theory = Theory.parse("basic Animal, Dog\nDog <: Animal\nS := [x : Animal]")
    dogs = made("dogs", rectype(x=theory.Dog))
    animals = made("animals", rectype(x=theory.Animal))
    known = {"model": Model(theory)}
    assert sorts(first(animals, dogs), theory.S, **known) == ["dead"]
    assert sorts(first(dogs, animals), theory.S, **known) == []


def test_a_rule_that_always_applies_forestalls_what_asks_for_something_unrelated():
    pets = rectype(x=Basic("Pet"))
    assert sorts(first(made("pets", pets), made("texts", rectype(x=Text))), pets) == [
        "dead"
    ]


# --- what nothing brings about -------------------------------------------------------

Phase = Basic("Phase")
Phased = rectype(phase=Phase, log=ListOf(Ind))
IDLE, BUSY, DONE = (rectype(phase=Phase @ p) for p in ("idle", "busy", "done"))
P = Model().given("a", Ind)
for _phase in ("idle", "busy", "done"):
    P = P.given(_phase, Phase)
AT_FIRST = {"start": record(phase="idle", log=[]), "model": P}


@rule(when=IDLE)
def work(s):
    return replace(s, phase="busy")


@rule(when=BUSY)
def finish(s):
    return replace(s, phase="done")


@rule(when=DONE)
def rest(s):
    return replace(s, phase="idle")


@rule(when=BUSY)
def somehow(s):
    return CHANGES["somehow"](s)


CHANGES = {"somehow": lambda s: s}


def unset(algorithm, **known):
    found = faults(algorithm, Phased, **{**AT_FIRST, **known})
    return [fault.rule.name for fault in found if fault.sort == "unset"]


def test_what_nothing_brings_about():
    assert unset(first(work, finish, rest)) == []
    assert unset(first(work, rest)) == ["rest"]
    assert unset(first(finish, rest)) == ["finish"]
    assert unset(first(finish, somehow, rest, work)) == []
    assert unset(first(rest, somehow)) == ["somehow"]
    assert faults(first(work, rest), Phased, model=P) == ()


def test_what_is_set_elsewhere_or_to_anything():
    @rule(when=IDLE)
    def note(s):
        return replace(s, before="done")

    @rule(when=IDLE)
    def vaguely(s):
        return replace(s, phase=CHANGES["somehow"](s))

    state = rectype(phase=Phase, before=Phase)
    known = {"start": record(phase="idle", before="idle"), "model": P}
    assert sorts(first(note, rest), state, **known) == ["unset"]
    assert sorts(first(vaguely, rest), state, **known) == []


def test_what_a_rule_promises_is_what_it_brings_about():
    def busy_or_so(gives):
        @rule(when=IDLE, gives=gives)
        def somewhere(s):
            return CHANGES["somehow"](s)

        return somewhere

    assert unset(first(busy_or_so(BUSY), rest)) == ["rest"]
    assert unset(first(busy_or_so(DONE), rest)) == []
    assert unset(first(busy_or_so(rectype(log=ListOf(Ind))), rest)) == []


def test_what_is_set_within_or_around_a_place():
    state = rectype(r=Rec)
    known = {"start": record(r=record(a="idle")), "model": P}
    done = record(a="done")
    whole = made("whole", rectype(r=Rec @ done))
    inner = made("inner", rectype(r=rectype(a=Phase @ "done")))

    @rule(when=state)
    def within(s):
        return replace(s, {"r.a": "done"})

    @rule(when=state, on=rectype(x=rectype(b=Ind)))
    def around(s, e):
        return replace(s, r=e.x)

    def those_waited_for(*members):
        found = faults(all_(*members), state, **known)
        return [fault.rule.name for fault in found if fault.sort == "unset"]

    assert those_waited_for(whole, inner) == ["whole", "inner"]
    assert those_waited_for(within, whole, inner) == []
    assert those_waited_for(around, inner) == []


def test_a_condition_that_asks_for_nothing_waits_for_nothing():
    assert sorts(made("any", rectype()), Phased, start="idle") == ["misfit"]


def test_what_is_copied_from_an_event_may_be_anything_of_its_type():
    @rule(when=IDLE, on=rectype(phase=Phase))
    def follow(s, e):
        return replace(s, phase=e.phase)

    @rule(when=IDLE, on=BUSY)
    def follow_busy(s, e):
        return replace(s, phase=e.phase)

    assert unset(first(follow, rest)) == []
    assert unset(first(follow_busy, rest)) == ["rest"]


def test_events_that_nobody_sends():
    hello, bye = rectype(e=hug("a")), rectype(e=run_("a"))
    greet = made("greet", Phased, on=hello)
    leave = made("leave", Phased, on=bye)
    both = first(greet, leave)
    assert unset(both) == []
    assert unset(both, hears=[hello]) == ["leave"]
    assert unset(both, hears=[hello, Rec]) == []


def test_own_moves_are_events():
    theory = Theory.parse("""
        basic Ind
        object a : Ind
        pred hug(Ind), run(Ind), bark(Ind)
        Hug := [e : hug(a)]
        Run := [e : run(a)]
        Bark := [e : bark(a)]
        Board := [next : list(RecType)]
        rule hugged(s : Board, e : Hug) := [next = [Run] : list(RecType)]
        rule ran(s : Board, e : Run) := [next = [] : list(RecType)]
        rule barked(s : Board, e : Bark) := [next = [] : list(RecType)]
        game dogs({next = []} : Board, acts on next) := first(hugged, ran, barked)
    """)
    dogs = theory.games["dogs"]
    assert faults_of(dogs) == ()
    heard = Game(
        "heard",
        dogs.type,
        dogs.start,
        dogs.algorithm,
        dogs.model,
        "next",
        (theory.Hug,),
    )
    assert [fault.rule.name for fault in faults_of(heard)] == ["barked"]


def test_own_moves_are_found_where_a_rule_sets_other_fields_too():
    game = Theory.parse("""
        basic Ind
        object a : Ind
        pred hug(Ind), run(Ind)
        Hug := [e : hug(a)]
        Run := [e : run(a)]
        Board := [last : Rec, next : list(RecType)]
        rule hugged(s : Board, e : Hug)
            := [last = e : Rec, next = [Run] : list(RecType)]
        rule ran(s : Board, e : Run) := [last = e : Rec, next = [] : list(RecType)]
        game dogs({last = {}, next = []} : Board, acts on next, hears Hug)
            := first(hugged, ran)
    """).games["dogs"]
    assert faults_of(game) == ()


def test_own_moves_are_found_where_a_rule_sets_what_the_agenda_is_in():
    game = Theory.parse("""
        basic Ind
        object a : Ind
        pred hug(Ind), run(Ind)
        Hug := [e : hug(a)]
        Run := [e : run(a)]
        Board := [mine : [next : list(RecType)]]
        rule hugged(s : Board, e : Hug)
            := [mine = {next = [Run]} : [next : list(RecType)]]
        rule ran(s : Board, e : Run) := [mine : [next = [] : list(RecType)]]
        game dogs({mine = {next = []}} : Board, acts on mine.next, hears Hug)
            := first(hugged, ran)
    """).games["dogs"]
    assert faults_of(game) == ()


def test_rules_that_share_their_text_are_told_apart():
    hello, bye = (rectype(e=hug(x)) for x in "ab")
    greet, leave = (
        made(name, Phased, on=on) for name, on in {"greet": hello, "leave": bye}.items()
    )
    assert greet.span == leave.span
    assert unset(first(greet, leave), hears=[rectype(e=run_("a"))]) == [
        "greet",
        "leave",
    ]


def test_moves_that_are_planned_without_saying_which():
    theory = Theory.parse("""
        basic Ind
        object a : Ind
        pred hug(Ind), bark(Ind)
        Hug := [e : hug(a)]
        Bark := [e : bark(a)]
        Board := [next : list(RecType)]
        rule hugged(s : Board, e : Hug) := [next : list(RecType)]
        rule barked(s : Board, e : Bark) := [next = [] : list(RecType)]
        game dogs({next = []} : Board, acts on next, hears Hug)
            := first(hugged, barked)
    """)
    assert faults_of(theory.games["dogs"]) == ()


CLERK = """
    basic Ind, Topic
    object guest, clerk : Ind
    object museum : Topic
    pred ask(Ind, Topic), tell(Ind, Topic), cancel(Ind, Topic)
    Ask    := [spkr = guest : Ind, t : Topic, e : ask(spkr, t)]
    Tell   := [spkr = clerk : Ind, t : Topic, e : tell(spkr, t)]
    Cancel := [spkr = guest : Ind, t : Topic, e : cancel(spkr, t)]
    Topics := list(Topic)
    Moves  := list(RecType)
    Board  := [qud : Topics, next : Moves]
    Asked  := [qud : nelist(Topic)]
    rule asked(s : Board, e : Ask) := [qud = [e.t] + s.qud : Topics]
    rule plan(s : Board /\\ Asked /\\ [next = [] : Moves])
        := [next = [[spkr = clerk : Ind, t = fst(s.qud) : Topic, e : tell(spkr, t)]]
                + rst(s.next) : Moves]
    rule told(s : Board /\\ Asked, e : Tell)
        := [qud = rst(s.qud) : Topics, next = [] : Moves]
    rule cancelled(s : Board /\\ Asked, e : Cancel) := [qud = rst(s.qud) : Topics]
    game desk({qud = [], next = []} : Board, acts on next, hears Ask, Cancel)
        := first(asked, told, cancelled, plan)
"""


@pytest.mark.parametrize(
    ("written", "instead", "message", "hint"),
    [
        (
            "hears Ask, Cancel",
            "hears Ask",
            "the rule cancelled waits for an event of Cancel that nobody sends",
            "what is heard is Ask",
        ),
        (
            "cancelled, plan)",
            "cancelled)",
            "the rule told waits for an event of Tell that nobody sends",
            "plan plans one, but is not in desk: add it to the strategy",
        ),
        (
            "told, cancelled, plan",
            "told, plan",
            "the game hears events of Cancel, which no rule takes",
            "cancelled takes them, but is not in desk: add it to the strategy",
        ),
        (
            "[e.t] + s.qud",
            "e.t + s.qud",
            "the rule asked sets qud to a list and e.t, which is of Topic",
            "a list of one is written in brackets: [e.t]",
        ),
    ],
)
def test_a_planned_move_that_depends_on_the_state_is_still_of_a_type(
    written, instead, message, hint
):
    assert faults_of(Theory.parse(CLERK).games["desk"]) == ()
    assert written in CLERK
    game = Theory.parse(CLERK.replace(written, instead)).games["desk"]
    fault = next(one for one in faults_of(game) if one.message == message)
    assert fault.hint == hint
    assert fault.span is not None


def test_events_that_are_heard_and_that_no_rule_takes():
    hello, bye = rectype(e=hug("a")), rectype(e=run_("a"))
    greet = made("greet", Phased, on=hello)
    (fault,) = faults(greet, Phased, hears=[hello, bye], **AT_FIRST)
    assert (fault.sort, fault.rule) == ("unheard", None)
    assert fault.message == "the game hears events of [e : run(a)], which no rule takes"


# --- rules that disagree -------------------------------------------------------------


def test_rules_of_a_class_disagree_only_where_both_may_apply():
    @rule(when=IDLE, kind="k")
    def one(s):
        return replace(s, phase="busy")

    @rule(when=Phased, kind="k")
    def two(s):
        return replace(s, phase="done")

    @rule(when=DONE, kind="k")
    def three(s):
        return replace(s, phase="idle")

    @rule(when=IDLE, kind="k")
    def same(s):
        return replace(s, phase="busy", log=())

    def disagreeing(*members):
        found = faults(by_class(*members, order=["k"]), Phased, model=P)
        return [(fault.severity, fault.rule.name) for fault in found]

    assert disagreeing(one, two) == [("error", "two")]
    assert disagreeing(one, three) == []
    assert disagreeing(one, same) == []
    found = faults(all_(one, two), Phased, model=P)
    assert [(fault.severity, fault.sort) for fault in found] == [
        ("warning", "disagreement")
    ]
    assert faults(first(one, two), Phased, model=P) == ()


def test_rules_for_different_events_do_not_disagree():
    def to(name, on, phase):
        def effect(s, e):
            return replace(s, phase="busy") if phase else replace(s, phase="done")

        effect.__name__ = name
        return rule(when=Phased, on=on, kind="k")(effect)

    hello, bye = rectype(e=hug(this.x), x=Ind), rectype(e=run_(this.x), x=Ind)
    greeted, left = to("greeted", hello, True), to("left", bye, False)
    assert faults(by_class(greeted, left, order=["k"]), Phased) == ()


KINDS = """
    basic Ind, Thing, Animal, Dog
    Dog <: Animal
    object rex : Dog
    object ann : Ind
    State := [x : Thing, n : Ind, u : list(Ind) \\/ Rec]
"""


@pytest.mark.parametrize(
    ("one", "other", "disagree"),
    [
        ("x : Animal", "x : Dog", True),
        ("x : Dog", "x : Animal", True),
        ("x : Dog", "x : Ind", False),
        ("x = rex : Dog", "x : Ind", False),
        ("x : Ind", "x = rex : Dog", False),
        ("x = rex : Dog", "x : Animal", True),
        ("x : Thing, n = x : Thing", "x : Thing, n = rex : Thing", True),
    ],
)
def test_rules_for_what_is_of_unrelated_types_do_not_disagree(one, other, disagree):
    theory = Theory.parse(f"""{KINDS}
    rule r1(s : [{one}]) of k := [n = ann : Ind]
    rule r2(s : [{other}]) of k := [n = rex : Ind]
    """)
    algorithm = by_class(*theory.rules.values(), order=["k"])
    found = sorts(algorithm, theory.State, model=Model(theory))
    assert found.count("disagreement") == disagree


@pytest.mark.parametrize(
    ("one", "other", "disagree"),
    [
        ("list(Ind)", "Rec", True),
        ("list(Ind)", "list(Ind)", False),
        ("list(Ind)", "nelist(Ind)", False),
    ],
)
def test_rules_that_set_types_disagree_where_nothing_is_of_both(one, other, disagree):
    theory = Theory.parse(f"""{KINDS}
    rule r1(s : State) of k := [u : {one}]
    rule r2(s : State) of k := [u : {other}]
    """)
    algorithm = by_class(*theory.rules.values(), order=["k"])
    assert sorts(algorithm, theory.State) == ["disagreement"] * disagree


def test_a_value_and_an_unknown_value_do_not_disagree():
    @rule(when=Board, kind="k")
    def known(s):
        return replace(s, n=0)

    @rule(when=Board, kind="k")
    def unknown(s):
        return replace(s, n=CHANGES["somehow"](s))

    typed = Theory.parse("""
        basic Count
        rule typed(s : [n : Count]) of k := [n : Count]
    """).rules["typed"]
    for one in (known, typed):
        assert sorts(by_class(one, unknown, order=["k"])) == []
        assert sorts(by_class(unknown, one, order=["k"])) == []


# --- repetitions ---------------------------------------------------------------------


def test_repetitions_that_surely_end():
    assert faults(repeat(work), Phased, model=P) == ()
    assert faults(repeat(first(work, finish)), Phased, model=P) == ()
    assert faults(repeat(maybe(work), times=3), Phased, model=P) == ()


def test_repetitions_that_go_round():
    (fault,) = faults(repeat(first(work, finish, rest)), Phased, model=P)
    assert fault.message == (
        "repeat(first(work, finish, rest)) need not end: "
        "work leaves its own condition as it is"
    )
    (fault,) = faults(repeat(somehow), Phased, model=P)
    assert fault.severity == "warning"
    assert (
        fault.message == "repeat(somehow) may not end: nothing says when somehow stops"
    )


def test_of_a_repetition_the_rule_is_named_that_surely_does_not_end():
    """Another one before it, that may stop by itself, is not."""
    stay = made("stay", Phased)
    (fault,) = faults(repeat(first(somehow, stay)), Phased, model=P)
    assert (fault.rule, fault.severity) == (stay, "error")


def test_a_repetition_ends_if_what_is_set_is_promised_to_be_something_else():
    def becoming(gives):
        @rule(when=IDLE, gives=gives)
        def change(s):
            return replace(s, phase=CHANGES["somehow"](s))

        return change

    assert sorts(repeat(becoming(BUSY)), Phased, model=P) == []
    assert sorts(repeat(becoming(IDLE)), Phased, model=P) == ["endless"]
    assert sorts(repeat(becoming(None)), Phased, model=P) == ["endless"]


def test_a_repetition_of_what_nobody_can_read_ends_by_what_it_promises():
    def becoming(gives):
        return rule(when=IDLE, gives=gives)(eval("lambda s: s"))

    assert sorts(repeat(becoming(BUSY)), Phased, model=P) == []
    assert sorts(repeat(becoming(IDLE)), Phased, model=P) == ["endless"]
    assert sorts(repeat(becoming(None)), Phased, model=P) == ["endless"]


def test_a_repetition_need_not_end_if_a_rule_sets_something_else_only_sometimes():
    @rule(when=IDLE)
    def at_times(s):
        return replace(s, phase="busy") if s.log else s

    assert sorts(repeat(at_times), Phased, model=P) == ["endless"]


def test_taking_the_first_off_a_list_ends():
    theory = Theory.parse("""
        basic Ind
        Board := [qud : list(Ind), done : list(Ind)]
        rule drop(s : [qud : nelist(Ind)]) := [qud = rst(s.qud) : list(Ind)]
        rule keep(s : [qud : nelist(Ind), done : list(Ind)])
            := [done = s.qud : list(Ind), qud = s.done : list(Ind)]
    """)
    drop, keep = theory.rules["drop"], theory.rules["keep"]
    assert faults(repeat(drop), theory.Board) == ()
    assert sorts(repeat(all_(drop, keep)), theory.Board) == ["endless"]


@pytest.mark.parametrize(
    ("what", "ends"),
    [
        ("rst(s.qud)", True),
        ("rst(s.done)", False),
        ("rst(e.qud)", False),
        ("s.qud", False),
    ],
)
def test_only_the_rest_of_the_list_itself_is_shorter(what, ends):
    theory = Theory.parse(f"""
        basic Ind
        Board := [qud : list(Ind), done : list(Ind)]
        rule drop(s : [qud : nelist(Ind), done : list(Ind)], e : [qud : list(Ind)])
            := [qud = {what} : list(Ind)]
    """)
    found = sorts(repeat(theory.rules["drop"]), theory.Board)
    assert found == ([] if ends else ["endless"])


def test_each_of_two_lists_gets_shorter_whatever_becomes_of_the_other():
    theory = Theory.parse("""
        basic Ind
        Board := [qud : list(Ind), plan : list(Ind)]
        rule drop(s : [qud : nelist(Ind)]) := [qud = rst(s.qud) : list(Ind)]
        rule go_on(s : [plan : nelist(Ind)]) := [plan = rst(s.plan) : list(Ind)]
    """)
    both = repeat(first(theory.rules["drop"], theory.rules["go_on"]))
    assert sorts(both, theory.Board, model=Model(theory)) == []


def test_a_long_repetition_is_named_by_its_first_rules():
    members = [made(f"a_rule_with_a_long_name_{i}") for i in range(5)]
    (fault,) = faults(repeat(all_(*members)), Board)
    assert fault.message.startswith(
        "the repetition of a_rule_with_a_long_name_0, a_rule_with_a_long_name_1, "
        "a_rule_with_a_long_name_2, … need not end"
    )


# --- the report ----------------------------------------------------------------------


def test_a_fault_prints_like_an_error():
    fault = Fault(None, "missing", "there is no x", "did you mean y?")
    assert str(fault) == "there is no x\nhelp: did you mean y?"


def test_what_is_no_strategy():
    with pytest.raises(UpdateError, match="faults takes rules and strategies"):
        faults("rule", Board)
    with pytest.raises(UpdateError, match="the type of a state is a record type"):
        faults(ALWAYS, Ind)
    with pytest.raises(UpdateError, match="what is heard is a list of types"):
        faults(ALWAYS, Board, hears=Ind)
    with pytest.raises(UpdateError, match="faults_alone takes a rule"):
        faults_alone(first(ALWAYS))


def test_effects_that_cannot_be_read():
    class Callable:
        def __call__(self, s):
            return s

        def method(self, s):
            return s.nowhere

    by_object = rule(when=Board)(Callable())
    by_method = rule(when=Board)(Callable().method)
    assert messages(all_(by_object, by_method), model=M) == []


def test_functions_on_one_line_are_told_apart():
    one, other = rule(when=Board)(lambda s: s.a), rule(when=Board)(lambda s: s)
    assert messages(one) == ["the rule <lambda> reads s.a, but s has no a"]
    assert messages(other) == []


def test_names_that_are_set_where_they_are_declared_or_used():
    @rule(when=Board)
    def declared(s):
        shared: object = s.shared
        return replace(s, n=shared.nn)

    @rule(when=Board)
    def used(s):
        if shared := s.shared:
            return replace(s, n=shared.nn)

    for one in (declared, used):
        assert messages(one) == [
            f"the rule {one} reads s.shared.nn, but s.shared has no nn"
        ]


def test_changes_that_are_written_as_keywords_of_a_dict():
    @rule(when=Board)
    def called(s):
        return replace(s, dict(m=0))  # noqa: C408

    @rule(when=Board)
    def spread(s):
        return replace(s, **{"m": 0})

    @rule(when=Board)
    def open_ended(s):
        return replace(s, **dict(s.shared, m=0))

    for one in (called, spread):
        assert messages(one) == [f"the rule {one} replaces s.m, but s has no m"]
    assert messages(open_ended) == []


def test_an_effect_that_returns_a_changed_state_by_a_name_always_applies():
    @rule(when=Board)
    def changes(s):
        after = replace(s, n=0)
        return after

    assert messages(first(changes, ALWAYS)) == [
        "the rule always can never fire: the rule changes comes first, and applies "
        "wherever always would"
    ]


def test_an_effect_that_returns_nothing():
    @rule(when=Board)
    def forgets(s):
        replace(s, n=0)

    @rule(when=Board)
    def leaves(s):
        if s.n:
            return None

    @rule(when=Board)
    def may(s):
        if s.n:
            return replace(s, n=0)

    for one in (forgets, leaves):
        assert messages(one) == [
            f"the rule {one} can never fire: it gives no next state, as nothing is "
            "returned"
        ]
    assert messages(may) == []


def test_an_undefined_name_below_a_star_import(tmp_path):
    file = tmp_path / "starred.py"
    file.write_text(
        "from ttr import *\n"
        "from ttr.updates import rule\n"
        "Board = rectype(x=Ind)\n"
        "@rule(when=Board)\n"
        "def fine(s): return replace(s, x=s.x)\n"
        "@rule(when=Board)\n"
        "def lost(s): return replace(s, x=nobody)\n"
    )
    names = {}
    exec(compile(file.read_text(), str(file), "exec"), names)
    assert messages(names["fine"], names["Board"]) == []
    assert messages(names["lost"], names["Board"]) == [
        "the rule lost uses nobody, which nothing binds"
    ]


def test_what_a_function_imports_for_the_whole_file_is_defined(tmp_path):
    file = tmp_path / "warming.py"
    file.write_text(
        "from ttr import Ind, rectype, replace\n"
        "from ttr.updates import rule\n"
        "def warm_up():\n"
        "    global json, sensor, degree\n"
        "    import json.decoder, wave as sensor\n"
        "    from colorsys import hls_to_rgb as degree\n"
        "Board = rectype(x=Ind)\n"
        "@rule(when=Board)\n"
        "def warm(s): return replace(s, x=json.dumps(sensor.open(degree)))\n"
        "@rule(when=Board)\n"
        "def cold(s): return replace(s, x=[decoder, wave, hls_to_rgb])\n"
    )
    names = {}
    exec(compile(file.read_text(), str(file), "exec"), names)
    assert messages(names["warm"], names["Board"]) == []
    assert messages(names["cold"], names["Board"]) == [
        f"the rule cold uses {name}, which nothing binds"
        for name in ("decoder", "wave", "hls_to_rgb")
    ]


def test_an_undefined_name_is_told_once_where_it_is_used_first(tmp_path):
    file = tmp_path / "undefined.py"
    file.write_text(
        "from ttr import Ind, rectype, replace\n"
        "from ttr.updates import rule\n"
        "Board = rectype(x=Ind)\n"
        "@rule(when=Board)\n"
        "def twice(s):\n"
        "    later = lambda: nowhere\n"
        "    return replace(s, x=[nobody, nobody, later()][0])\n"
    )
    names = {}
    exec(compile(file.read_text(), str(file), "exec"), names)
    found = faults(names["twice"], names["Board"])
    assert [(one.message, one.span.line, one.span.column) for one in found] == [
        ("the rule twice uses nobody, which nothing binds", 7, 26),
        ("the rule twice uses nowhere, which nothing binds", 6, 21),
    ]


def test_either_of_two_record_types():
    either = rectype(r=rectype(a=Ind) | rectype(b=Ind))

    @rule(when=either)
    def both(s):
        return replace(s, {"r.a": s.r.b, "r.c": s.r.d})

    assert messages(both, either) == [
        "the rule both reads s.r.d, but s.r has no d",
        "the rule both replaces s.r.c, but s.r has no c",
    ]


def test_fifty_rules_are_checked_within_seconds():
    game = Theory.parse(fifty_rules()).games["g"]
    began = time.thread_time()
    assert faults_of(game) == ()
    assert time.thread_time() - began < 3.0


def fifty_rules(number: int = 50) -> str:
    """A theory with as many rules, each for one phase and one move of a wide board."""
    phases = ", ".join(f"p{i}" for i in range(number + 1))
    lists = ", ".join(f"l{i} : list(RecType)" for i in range(10))
    empty = ", ".join(f"l{i} = []" for i in range(10))
    names = ", ".join(f"r{i}" for i in range(number))
    rules = "\n".join(
        f"rule r{i}(s : [phase = p{i} : Phase], e : {('Ask', 'Tell')[i % 2]}) "
        f"of k{i % 3} := [phase = p{i + 1} : Phase, shared : [latest = e : Rec]]"
        for i in range(number)
    )
    return f"""
        basic Ind, Phase
        pred ask(Ind, Ind), tell(Ind, Ind)
        object a, b : Ind
        object {phases} : Phase
        Ask   := [spkr : Ind, addr : Ind, e : ask(spkr, addr)]
        Tell  := [spkr : Ind, addr : Ind, e : tell(spkr, addr)]
        Board := [phase : Phase, private : [{lists}], shared : [latest : Rec, {lists}]]
        {rules}
        strategy answers := by_class(k0, k1, k2)
        game g({{phase = p0, private = {{{empty}}},
                 shared = {{latest = {{}}, {empty}}}}} : Board) := first({names})
    """


BRACKETS = """
    basic Ind, P
    object ann : Ind
    object p0 : P
    pred says(Ind, P)
    Say := [p : P, e : says(ann, p)]
    Board := [qud : list(P), last : P]
    rule hear(s : Board, e : Say) := [qud = e.p : list(P)]
    rule keep(s : Board, e : Say) := [last = s.qud : P]
    rule fine(s : Board, e : Say) := [qud = [e.p] : list(P), last = fst([e.p]) : P]
    game talk({qud = [], last = p0} : Board) := first(seq(hear, keep), fine)
"""


def test_what_lacks_brackets_is_a_warning():
    found = faults_of(Theory.parse(BRACKETS).games["talk"])
    told = [(fault.severity, fault.rule.name, fault.hint) for fault in found]
    assert told == [
        ("warning", "hear", "a list of one is written in brackets: [a]"),
        ("warning", "keep", "the first of a list a is fst(a)"),
    ]
    assert found[0].message == (
        "the rule hear sets qud to something of P, where list(P) is due"
    )


def test_a_type_that_a_witness_function_judges_may_have_lists():
    game = Theory.parse(BRACKETS).games["talk"]
    seeing = game.model.witnessed(game.theory.P, by=lambda a: True)
    assert faults_of(dataclasses.replace(game, model=seeing)) == ()


WHOLE = """
    basic Ind, P
    object ann : Ind
    object p0 : P
    Board := [a : P, in : [b : P, c : [d : P]]]
    rule whole(s : Board) := {a = p0, in = {b = ann, c = {d = ann}}}
    rule part(s : Board) := {a = p0, in = {b = p0}}
    game g({a = p0, in = {b = p0, c = {d = p0}}} : Board) := first(whole, part)
"""


def test_a_record_that_is_the_next_state_is_checked_field_by_field():
    found = faults_of(Theory.parse(WHOLE).games["g"])
    assert [one.message for one in found if one.sort == "misfit"] == [
        "the rule whole sets in.b to ann, which is no P",
        "the rule whole sets in.c.d to ann, which is no P",
        "the state that the rule part gives has no in.c",
    ]


@pytest.mark.parametrize(
    "now",
    [
        "\ndef shy(s): return s.nowhere\n",
        "def shy(t): return t.nowhere\n",
        "def bold(s): return s.nowhere\n",
    ],
    ids=["further down", "another parameter", "another name"],
)
def test_what_was_edited_since_it_was_loaded_is_not_read(tmp_path, now):
    file = tmp_path / "edited.py"
    file.write_text(now)
    names = {}
    exec(compile("def shy(s): return s.nowhere\n", str(file), "exec"), names)
    assert messages(rule(when=Board)(names["shy"])) == []


def test_what_is_as_it_was_loaded_is_read(tmp_path):
    file = tmp_path / "same.py"
    file.write_text("def shy(s): return s.nowhere\n")
    names = {}
    exec(compile(file.read_text(), str(file), "exec"), names)
    assert messages(rule(when=Board)(names["shy"])) == [
        "the rule shy reads s.nowhere, but s has no nowhere"
    ]
