"""Rules, strategies and games as statements of a theory."""

from __future__ import annotations

import dataclasses
import pickle
from pathlib import Path

import pytest

from ttr.cli.session.repl import is_complete, respond
from ttr.cli.session.sessions import Session
from ttr.display.abbreviations import abbreviator
from ttr.errors import (
    MistakesError,
    NoStateError,
    NotationError,
    NotHeardError,
    TTRError,
    UnsupportedError,
    UpdateError,
)
from ttr.judging.models import Model
from ttr.probability import Degree
from ttr.theories.checking import check
from ttr.theories.theory import Theory, load
from ttr.types.objects import Record, record
from ttr.types.syntax import RecordType
from ttr.updates import (
    all_,
    by_class,
    first,
    maybe,
    nbest,
    repeat,
    rule,
    run,
    seq,
    update,
)
from ttr.updates.rule_application import apply_rule, why_not
from ttr.updates.rule_notation import declaration, format_rule

BOARD = """\
basic Ind, Act
object a, b : Ind
object hi : Act
pred p(Ind), by(Act, Ind)
State := [spkr : Ind, addr : Ind, plan : list(RecType), in : [deep : Ind]]
Start := {spkr = a, addr = b, plan = [], in = {deep = a}}
Move := [act : Act, c : by(act, 'a')]
given c1 : by(hi, a)
rule turn(s : State) "Who was spoken to speaks." of floor
    := [spkr = s.addr : Ind, addr = s.spkr : Ind]
rule drop(s : State /\\ [plan : nelist(RecType)]) of agenda
    := [plan = rst(s.plan) : list(RecType)]
rule plan(s : State) of agenda := [plan = [Move] : list(RecType)]
strategy both := all(turn, plan)
"""


def board(text: str = "") -> Theory:
    return Theory.parse(BOARD + text)


def rules(text: str) -> Theory:
    return board("rule r" + text)


def state(**changed: object) -> Record:
    fields = {"spkr": "a", "addr": "b", "plan": [], "in": record(deep="a")}
    return record(fields | changed)


# --- rules ---------------------------------------------------------------------------


def test_a_rule_has_all_that_is_written() -> None:
    found = rules(
        "(s : State, e : Move in [0.7, 1]) 'Så: «hej».' of floor\n"
        "    where [who = s.spkr : Ind, c : by(e.act, who)]\n"
        "    := [addr = who : Ind]"
    )
    one = found.rules["r"]
    assert (one.name, one.kind, one.doc) == ("r", "floor", "Så: «hej».")
    assert one.when is found.State
    assert one.on is found.Move
    assert one.p == Degree(0.7, 1.0)
    assert one.names == ("s", "e")
    assert str(one.where) == "[who = ^.s.spkr : Ind, c : by(^.e.act, who)]"
    assert one.span is not None
    assert (one.span.line, one.span.column, one.span.length) == (15, 6, 1)
    assert one.text.startswith("r(s : State, e : Move")
    assert one.text.endswith("[addr = who : Ind]")


def test_a_rule_is_called_as_one_likes() -> None:
    found = board("rule größe(état : State) := [spkr = état.addr : Ind]")
    after = apply_rule(found.rules["größe"], [state()], Model(found))
    assert after.state == state(spkr="b")


def test_a_rule_that_gives_a_type_changes_what_is_in_it() -> None:
    found = board()
    after = apply_rule(found.rules["turn"], [state()], Model(found))
    assert after.state == state(spkr="b", addr="a")
    assert [str(step.rule) for step in after.trace] == ["turn"]
    assert after.trace[0].rule.doc == "Who was spoken to speaks."


def test_a_rule_that_gives_a_record_gives_the_next_state() -> None:
    text = "(s : State) := {spkr = s.addr, addr = s.in.deep, plan = [], in = s.in}"
    found = rules(text)
    after = apply_rule(found.rules["r"], [state(spkr="b")], Model(found))
    assert after.state == state(spkr="b", addr="a")


def test_a_rule_that_gives_a_part_of_the_state_gives_it() -> None:
    found = rules("(s : [old : Rec]) := s.old")
    after = apply_rule(found.rules["r"], [record(old=state())], Model(found))
    assert after.state == state()


def test_what_is_bound_is_found() -> None:
    found = rules(
        "(s : State, e : Move) where [who = s.addr : Ind, c : by(e.act, who)]"
        " := [spkr = who : Ind]"
    )
    one, M = found.rules["r"], Model(found)
    heard = record(act="hi", c="c1")
    assert apply_rule(one, [state(addr="a"), heard], M).state == state(addr="a")
    with pytest.raises(UpdateError) as caught:
        apply_rule(one, [state(), heard], M)
    assert caught.value.message == (
        "r does not apply: nothing is found for c : by(e.act, who)"
    )


def test_an_uncertain_event_is_taken_if_it_is_probable_enough() -> None:
    found = rules("(s : State, e : Move in [0.6, 1]) := [spkr = s.addr : Ind]")
    one, M = found.rules["r"], Model(found)
    heard, noise = record(act="hi", c="c1"), record(act="hi", c="hi")
    for p, count in ((0.7, 1), (0.5, 0)):
        event = nbest((heard, p), (noise, 0.3))
        after = run(one, state(), type=found.State, model=M, events=[event])
        assert len(after.trace) == count
    event = nbest((heard, 0.5), (noise, 0.3))
    assert why_not(one, state(), event, M) == (
        "an event of [act : Act, c : by(act, a)] is not as probable as [0.6, 1]"
    )
    assert why_not(one, state(), record(act="hi", c="hi"), M) == (
        "c: hi : by(hi, a), nothing says so; hi is of Act; c1 would do"
    )


def test_a_variable_hides_what_is_called_so_and_a_label_hides_a_variable() -> None:
    found = rules(
        "(a : State) := [spkr = a.addr : Ind,"
        " plan = [[a : Ind, c : p(a)]] : list(RecType)]"
    )
    body = found.rules["r"].effect.value
    assert str(body) == (
        "[plan = [[a : Ind, c : p(a)]] : list(RecType), spkr = ^.a.addr : Ind]"
    )
    plan = apply_rule(found.rules["r"], [state()], Model(found)).state.plan
    assert str(plan[0]) == "[a : Ind, c : p(a)]"
    inner = rules(
        "(s : State) := [plan = [[s : Ind, c : p(^^.s.spkr)]] : list(RecType)]"
    )
    plan = apply_rule(inner.rules["r"], [state()], Model(inner)).state.plan
    assert str(plan[0]) == "[c : p(a), s : Ind]"


def test_a_meet_of_record_types_is_one() -> None:
    drop = board().rules["drop"]
    assert str(drop.when["plan"]) == "nelist(RecType)"
    assert "spkr" in drop.when


def test_what_is_bound_may_be_called_as_one_likes() -> None:
    found = rules("(p : State) where [nbest = p.addr : Ind] := [spkr = nbest : Ind]")
    assert apply_rule(found.rules["r"], [state()], Model(found)).state == state(
        spkr="b"
    )
    labels = rules("(s : State, e : [s : Ind, c : p(s)]) := State")
    assert str(labels.rules["r"].on) == "[s : Ind, c : p(s)]"
    quoted = rules("(a : State, e : p('a')) := State")
    assert quoted.rules["r"].on is quoted.p("a")
    assert 'e : p("a")' in format_rule(quoted.rules["r"])


def test_the_name_of_an_event_stands_for_nothing_in_its_own_type() -> None:
    found = rules("(s : State, a : p(a)) := State")
    assert found.rules["r"].on is found.p("a")
    assert "a : p(a))" in format_rule(found.rules["r"])


# --- strategies ----------------------------------------------------------------------


def test_strategies_are_read_as_python_builds_them() -> None:
    found = board(
        "strategy s1 := first(drop, both)\n"
        "strategy s2 := seq(turn, maybe(repeat(drop, 3)))\n"
        "strategy s3 := repeat(drop, plan)\n"
        "strategy s4 := repeat(drop, 5, in.deep)\n"
        "strategy s5 := by_class(agenda, floor)\n"
        "strategy s6 := plan\n"
        "strategy s7 := repeat(drop)\n"
    )
    turn, drop, plan = (found.rules[name] for name in ("turn", "drop", "plan"))
    assert dict(found.strategies) == {
        "both": all_(turn, plan),
        "s1": first(drop, all_(turn, plan)),
        "s2": seq(turn, maybe(repeat(drop, times=3))),
        "s3": repeat(drop, measure="plan"),
        "s4": repeat(drop, times=5, measure="in.deep"),
        "s5": by_class(drop, plan, turn, order=("agenda", "floor")),
        "s6": plan,
        "s7": repeat(drop),
    }


def test_a_strategy_prints_as_it_reads() -> None:
    text = "first(drop, seq(turn, maybe(repeat(drop, 3, plan))), by_class(agenda))"
    found = board(f"strategy s := {text}")
    assert str(found.strategies["s"]) == text
    assert declaration(found, "s") == f"strategy s := {text}"


# --- games ---------------------------------------------------------------------------


def test_a_game_is_played_in_the_model_of_all_the_givens() -> None:
    found = board(
        "rule take(s : State /\\ [plan : nelist(RecType)], e : Move)"
        " := [plan = rst(s.plan) : list(RecType)]\n"
        "game g({spkr = c, addr = b, plan = [], in = {deep = c}} : State, acts on plan)"
        " := first(take, plan)\n".replace("= c", "= 'c'")
        + "given 'c' : Ind\n"
    )
    game = found.games["g"]
    assert (game.name, game.agenda) == ("g", "plan")
    assert game.type is found.State
    assert found.games is found.games
    turn = game.take(game.begin(), None)
    assert [str(step.rule) for step in turn.trace] == ["plan", "take"]
    assert turn.state == state(spkr="c", **{"in": record(deep="c")})
    assert len(turn.said) == 1


def test_a_game_may_start_from_a_name_and_play_a_strategy() -> None:
    found = board("game g(Start : State) := both")
    assert found.games["g"].begin().state == state()
    assert found.games["g"].algorithm is found.strategies["both"]


def test_a_game_hears_what_it_says_it_hears() -> None:
    found = board(
        "rule take(s : State, e : Move) := Start\n"
        "game g(Start : State, hears Move, Ind) := take\n"
        "game h(Start : State, acts on plan, hears [m : Ind]) := take\n"
    )
    assert found.games["g"].hears == (found.Move, found.Ind)
    assert found.games["h"].hears == (found.parse("[m : Ind]"),)
    assert found.games["h"].agenda == "plan"
    with pytest.raises(NotHeardError):
        found.games["h"].take(found.games["h"].begin(), found.Move)


def test_a_type_may_be_called_as_a_word_of_games() -> None:
    found = board(
        "hears := [m : Ind]\nrule take(s : State, e : hears) := Start\n"
        "game g(Start : State, hears hears) := take\n"
    )
    assert found.games["g"].hears == (found.hears,)


def test_a_game_that_starts_from_no_state_is_told_with_its_place() -> None:
    found = board(
        "game g({spkr = 'c', addr = b, plan = [], in = {deep = a}} : State) := turn"
    )
    for ask in (lambda: found.games, lambda: check(found)):
        with pytest.raises(NoStateError) as caught:
            ask()
        assert caught.value.message == (
            "at the start the state is not of its type, at spkr: c : Ind, "
            "nothing says so; a, b would do"
        )
        assert caught.value.span is not None
        assert (caught.value.span.line, caught.value.span.column) == (15, 8)


# --- what is wrong -------------------------------------------------------------------

A_RULE = "a rule is written rule name(s : S, e : E) := T"
A_STRATEGY = "a strategy is written strategy name := first(a, b)"
A_GAME = "a game is written game name({x = a} : S) := strategy"
PARTS = "between the brackets and := stand a 'text', of kind and where [x = a : T]"
BOUNDS = (
    "repeat takes how often at most, a number from 1, or the path of what gets "
    "smaller, found "
)
SHAPE = "[addr : Ind, in : [deep : Ind], plan : list(RecType), spkr : Ind]"

MISTAKES = {
    # how statements are written
    "rule r := T": (8, "expected (, found :=", A_RULE),
    "rule r": (7, "expected (, found the end of the text", A_RULE),
    "rule r(s) := T": (9, "expected :, found )", A_RULE),
    "rule r(s : State, e) := T": (20, "expected :, found )", A_RULE),
    "rule r() := T": (8, "expected a name, found )", A_RULE),
    "rule (s : State) := T": (9, "expected a comma or ), found :", A_RULE),
    "rule r(s : State) = T": (19, "expected :=, of or where, found =", A_RULE),
    "rule r(s : State) -> T": (19, "expected :=, of or where, found ->", A_RULE),
    "rule r(s : State)\n  [x : T]": (3, "expected :=, of or where, found [", A_RULE),
    "rule r(s : State) wher [x = s.y : T] := T": (
        19,
        "expected :=, of or where, found wher",
        "did you mean where?",
    ),
    "rule r(s : State) where x = s.y : T := T": (
        25,
        "expected [, found x",
        "what is bound stands in brackets: where [x = s.y : T]",
    ),
    "rule r(s : State) where [x = s.y] := T": (
        33,
        "expected :, found ]",
        "a manifest field has a type as well: [x = a : T]",
    ),
    "rule r(s : State) of := T": (22, "expected a name, found :=", ""),
    "rule r(s : State) where [x = s.spkr : Ind] of k := T": (
        44,
        "expected :=, found of",
        PARTS,
    ),
    "rule r(s : State) of k 'doc' := T": (
        24,
        "expected := or where, found 'doc' := T",
        PARTS,
    ),
    "rul r(s : State) := T": (5, "expected := or <:, found r", "did you mean rule?"),
    "strategi n := turn": (
        10,
        "expected := or <:, found n",
        "did you mean strategy?",
    ),
    "gaem g(Start : State) := turn": (
        6,
        "expected := or <:, found g",
        "did you mean game?",
    ),
    "strategy n = turn": (12, "expected :=, found =", A_STRATEGY),
    "strategy n(s) := turn": (11, "expected :=, found (", A_STRATEGY),
    "strategy n :=": (
        14,
        "expected a rule or a strategy, found the end of the text",
        "",
    ),
    "game g := turn": (8, "expected (, found :=", A_GAME),
    "game g(State) := turn": (13, "expected :, found )", A_GAME),
    "game (Start : State) := turn": (13, "expected a comma or ), found :", A_GAME),
    "game g(Start : State) = turn": (23, "expected :=, found =", A_GAME),
    "game g(Start : State acts on plan) := turn": (
        22,
        "expected a comma or ), found acts",
        "a comma stands before acts on",
    ),
    "game g(Start : State, act on plan) := turn": (
        23,
        "expected acts on or hears, found act",
        "did you mean acts?",
    ),
    "game g(Start : State, hear Move) := turn": (
        23,
        "expected acts on or hears, found hear",
        "did you mean hears?",
    ),
    "game g(Start : State hears Move) := turn": (
        22,
        "expected a comma or ), found hears",
        "a comma stands before hears",
    ),
    "game g(Start : State, hears Move, acts on plan) := turn": (
        40,
        "expected a comma or ), found on",
        "acts on stands before hears",
    ),
    "game g(Start : State, hears) := turn": (28, "expected a type, found )", ""),
    "game g(Start : State, hears Move,) := turn": (34, "expected a type, found )", ""),
    "game g(Start : State, hears Moev) := turn": (
        29,
        "nothing is called Moev here",
        "did you mean Move?",
    ),
    "game g(Start : State, acts on) := turn": (30, "expected a path, found )", ""),
    # names that are taken
    "rule turn(s : State) := State": (6, "turn is already a rule", ""),
    "rule Ind(s : State) := State": (6, "Ind is already a basic type", ""),
    "rule list(s : State) := State": (6, "list is a reserved word", ""),
    "strategy turn := both": (10, "turn is already a rule", ""),
    "game both(Start : State) := both": (6, "both is already a strategy", ""),
    "turn := Ind": (1, "turn is already a rule", ""),
    # parameters
    "rule r(s : Ind) := State": (
        12,
        "a state is a record, but Ind is no record type",
        "write a record type, [x : T], or the name of one",
    ),
    "rule r(s : Stat) := State": (
        12,
        "nothing is called Stat here",
        "did you mean State?",
    ),
    "rule r(s : State, e : Move, f : Move) := State": (
        29,
        "a rule takes the state and at most one event",
        "what else it needs is bound by where [x = … : T]",
    ),
    "rule r(s : State in [0, 1]) := State": (
        18,
        "the state is certain: only the event has a probability",
        "",
    ),
    "rule r(s : State, e : Move in 0.7) := State": (
        31,
        "how probable the event must be is an interval",
        "write e : E in [0.7, 1] for 0.7 at least",
    ),
    "rule r(s : State, e : Move in [0.7, 2]) := State": (
        31,
        "a probability is a number in [0, 1] or an interval of two, lower first, "
        "but found (0.7, 2)",
        "",
    ),
    "rule r(s : State, s : Move) := State": (19, "the label s is there twice", ""),
    "rule r(model : State) := State": (
        8,
        "model has a meaning of its own in rules",
        "choose another name, such as m",
    ),
    # bindings
    "rule r(s : State) where [s = a : Ind] := State": (
        26,
        "the label s is there twice",
        "",
    ),
    "rule r(s : State) where [model = a : Ind] := State": (
        26,
        "model has a meaning of its own in rules",
        "choose another name, such as m",
    ),
    "rule r(s : State, e : p(s.spkr)) := State": (
        25,
        "the type of an event cannot mention the state, found s.spkr",
        "ask it of the event: where [c = e : T]; an object is quoted: 'a'",
    ),
    "rule r(s : State, e : Mov) := State": (
        23,
        "nothing is called Mov here",
        "did you mean Move?",
    ),
    "rule r(s : State) where [x = s.spekr : Ind] := State": (
        30,
        f"the path s.spekr leads nowhere: {SHAPE} has no spekr",
        "did you mean spkr?",
    ),
    "rule r(s : State) where [x = s.in : Ind, c : p(x.deep)] := State": (
        46,
        "the path x.deep leads nowhere: Ind@^.s.in is no record type",
        "",
    ),
    # bodies
    "rule r(s : State) := [spkr = s.in.depp : Ind]": (
        30,
        "the path s.in.depp leads nowhere: [deep : Ind] has no depp",
        "did you mean deep?",
    ),
    "rule r(s : [spkr : Ind]) := {spkr = s.spkr, addr = s.listener}": (
        52,
        "the path s.listener leads nowhere: [spkr : Ind] has no listener",
        "what s has is said in the brackets: s : [x : T]",
    ),
    "rule r(s : State) where [x = s.in : [deep : Ind]] := [spkr = x.dep : Ind]": (
        62,
        "the path x.dep leads nowhere: [deep : Ind] has no dep",
        "did you mean deep?",
    ),
    "rule r(s : State, spkr : Ind) := [spkr = spkr : Ind]": (
        42,
        "the field spkr is set to itself: here spkr is the label",
        "it hides spkr of the rule: choose another name for that",
    ),
    "rule r(s : State) := [spkr = spkr : Ind]": (
        30,
        "the field spkr is set to itself: here spkr is the label",
        "say what it is set to",
    ),
    "rule r(s : State) := [spkr = e.act : Ind]": (
        30,
        "nothing is called e here",
        "name the event so, or bind it: where [e = … : T], or quote it to name an "
        "object: 'e'",
    ),
    "rule r(s : State, ev : Move) := [spkr = e.act : Ind]": (
        41,
        "nothing is called e here",
        "did you mean ev?",
    ),
    "rule r(s : State) := [c : p(s.plan)]": (
        27,
        "in the field c, p(s.plan) needs Ind for s.plan, but that is of list(RecType)",
        "",
    ),
    "rule r(s : State) := a": (
        22,
        "a rule gives a record type or the next state, found a",
        "write what is new: [x = a : T] changes x and leaves the rest",
    ),
    "rule r(s : State) := p(s.spkr)": (
        22,
        "a rule gives a record type or the next state, found p(s.spkr)",
        "write what is new: [x = a : T] changes x and leaves the rest",
    ),
    # strategies
    "strategy n := first(turn, dorp)": (
        27,
        "no rule or strategy is called dorp",
        "did you mean drop?",
    ),
    "strategy n := zebra": (
        15,
        "no rule or strategy is called zebra",
        "declare it first: rule zebra(s : S) := …",
    ),
    "strategy n := frist(turn, drop)": (
        15,
        "no way to combine rules is called frist",
        "did you mean first?",
    ),
    "strategy n := turn(drop)": (
        15,
        "turn stands alone in a strategy, without brackets",
        "",
    ),
    "strategy n := ask(turn, drop)": (
        15,
        "ask needs a function that chooses, and is built in Python",
        "from ttr.updates import ask",
    ),
    "strategy n := [turn]": (
        15,
        "a strategy is made of rules and strategies, found [turn]",
        "rules are combined by first, all, seq, maybe, repeat and by_class",
    ),
    "strategy n := first(turn, State)": (
        27,
        "a strategy is made of rules and strategies, and State is neither",
        "",
    ),
    "strategy n := first()": (
        15,
        "first takes rules and strategies, but has none",
        "",
    ),
    "strategy n := first(turn, drop, turn)": (
        33,
        "turn is in this first twice: its second place is never reached",
        "",
    ),
    "strategy n := maybe(turn, drop)": (
        15,
        "maybe takes one rule or strategy, but has 2",
        "",
    ),
    "strategy n := repeat()": (
        15,
        "repeat takes a rule or strategy, but has none",
        "",
    ),
    "strategy n := repeat(turn, 0)": (
        28,
        BOUNDS + "0",
        "write repeat(a, 10) or repeat(a, shared.qud)",
    ),
    "strategy n := repeat(turn, 1.5)": (
        28,
        BOUNDS + "1.5",
        "write repeat(a, 10) or repeat(a, shared.qud)",
    ),
    "strategy n := repeat(turn, 3, 4)": (
        31,
        BOUNDS + "4",
        "write repeat(a, 10) or repeat(a, shared.qud)",
    ),
    "strategy n := by_class()": (15, "by_class takes kinds of rules, but has none", ""),
    "strategy n := by_class('floor')": (
        24,
        "by_class takes kinds of rules, found 'floor'",
        "",
    ),
    "strategy n := by_class(flor)": (
        24,
        "no rule is of the kind flor",
        "did you mean floor?",
    ),
    "strategy n := by_class(zebra)": (
        24,
        "no rule is of the kind zebra",
        "a rule has its kind after its brackets: rule a(s : S) of zebra := …",
    ),
    "strategy n := by_class(floor, floor)": (
        31,
        "the kind floor is there twice",
        "",
    ),
    "strategy n := by_class(floor)\nrule r(s : State) of floor := State": (
        22,
        "n has been made of the rules of floor before",
        "move the rule up",
    ),
    "strategy n := later\nrule later(s : State) := State": (
        15,
        "later is used before its definition in line 16",
        "move the definition up",
    ),
    # games
    "game g(a : State) := turn": (
        8,
        "a game starts from a state, a record, found a",
        "write {x = a, …}",
    ),
    "game g(Start : Ind) := turn": (
        16,
        "a state is a record, but Ind is no record type",
        "write a record type, [x : T], or the name of one",
    ),
    "game g(Start : State, acts on plam) := turn": (
        31,
        f"the path plam leads nowhere: {SHAPE} has no plam",
        "did you mean plan?",
    ),
    "game g(Start : State, acts on spkr) := turn": (
        31,
        "a game acts on a list of types, but spkr is of Ind",
        "",
    ),
    "game g(Start : State, acts on 'plan') := turn": (
        31,
        "a game acts on the path of a list of types, found 'plan'",
        "write acts on agenda, or acts on shared.next",
    ),
    # rules elsewhere
    "T := [x : turn]": (
        11,
        "turn is a rule, which is no type, object or predicate",
        "",
    ),
    "T := both(a)": (
        6,
        "both is a strategy, which is no type, object or predicate",
        "",
    ),
    "check turn(Start, hi) = Start": (7, "turn takes the state alone, but has 2", ""),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_a_mistake_is_told_with_its_place(text: str) -> None:
    column, said, hint = MISTAKES[text]
    with pytest.raises(TTRError) as caught:
        board(text)
    error = caught.value
    assert (error.message, error.hint) == (said, hint)
    assert error.span is not None
    assert error.span.column == column


def test_what_mentions_a_spoilt_rule_is_passed_over() -> None:
    with pytest.raises(NotationError) as caught:
        board(
            "rule r(s : Stat) := State\n"
            "strategy n := first(r, turn)\n"
            "game g(Start : State) := n\n"
            "check r(Start) = Start\n"
        )
    assert not isinstance(caught.value, MistakesError)
    assert caught.value.message == "nothing is called Stat here"


@pytest.mark.parametrize(
    ("combined", "said"),
    [
        ("maybe(s{0})", "strategies nest at most 100 deep, with those that they name"),
        (
            "all(s{0}, s{0})",
            "a strategy has at most 10,000 parts, with those that it names",
        ),
    ],
)
def test_strategies_that_name_others_may_be_too_large(combined: str, said: str) -> None:
    lines = [f"strategy s{i + 1} := {combined.format(i)}" for i in range(1000)]
    with pytest.raises(NotationError) as caught:
        board("\n".join(["strategy s0 := turn", *lines]))
    assert caught.value.message == said


def test_the_words_of_rules_may_be_names() -> None:
    found = Theory.parse(
        "basic rule, strategy, of, where, acts, on\n"
        "pred game(rule)\n"
        "game(x) <: game(x)\n"
        "rule <: strategy\n"
        "T := [rule : rule, of : of, where : where, c : game(rule)]\n"
        "rule first(of : T) where [where = of.rule : rule] := [rule = where : rule]\n"
        "strategy all := first\n"
    )
    assert sorted(found.rules) == ["first"]
    assert found.strategies["all"] is found.rules["first"]


def test_a_theory_with_rules_is_a_value() -> None:
    found = board("game g(Start : State) := both")
    again = pickle.loads(pickle.dumps(found))
    assert again.rules == dict(found.rules)
    assert again.games["g"].begin().state == state()
    assert {"turn", "both", "g"} <= found.names
    with pytest.raises(AttributeError) as caught:
        _ = found.turn
    assert str(caught.value) == "turn is one of the rules: theory.rules['turn']"
    with pytest.raises(AttributeError, match=r"has no trun: did you mean turn\?"):
        _ = found.trun


# --- importing -----------------------------------------------------------------------


def test_rules_and_games_are_imported(tmp_path: Path) -> None:
    (tmp_path / "board.ttr").write_text(BOARD + "game g(Start : State) := both\n")
    (tmp_path / "more.ttr").write_text('import "board.ttr"\nobject c : Ind\n')
    text = (
        'import "board.ttr"\nimport "more.ttr"\n'
        "strategy n := first(drop, both)\n"
        "game h({spkr = c, addr = b, plan = [], in = {deep = c}} : State) := n\n"
    )
    (tmp_path / "all.ttr").write_text(text)
    found = load(tmp_path / "all.ttr")
    base = load(tmp_path / "board.ttr")
    assert [str(one) for one in found.rules] == ["turn", "drop", "plan"]
    assert found.rules == dict(base.rules)
    assert sorted(found.games) == ["g", "h"]
    assert found.games["g"].model.judge("c", found.Ind).holds
    report = check(found)
    assert (report.rules, report.holds) == (0, True)


def test_rules_that_are_different_are_not_one(tmp_path: Path) -> None:
    for name, body in (("a", "[x = s.y : T]"), ("b", "[y = s.x : T]")):
        text = f"basic T\nrule r(s : [x : T, y : T]) := {body}"
        (tmp_path / f"{name}.ttr").write_text(text)
    (tmp_path / "c.ttr").write_text('import "a.ttr"\nimport "b.ttr"')
    with pytest.raises(NotationError, match="the import declares r in another way"):
        load(tmp_path / "c.ttr")


# --- checks --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "claim",
    [
        "turn(Start) = {spkr = b, addr = a, plan = [], in = {deep = a}}",
        "not turn(Start) = Start",
        "drop({spkr = a, addr = b, plan = [Rec, Move], in = {deep = a}})"
        " = {spkr = a, addr = b, plan = [Move], in = {deep = a}}",
        "error drop(Start) = Start",
        "error turn({spkr = a}) = Start",
        "error turn(a) = a",
        "r(Start, {act = hi, c = c1}) = Start",
        "error r(Start, hi) = Start",
        "error r(Start, {act = hi, c = hi}) = Start",
        "r((\\x:Ind. {spkr = x, addr = b, plan = [], in = {deep = a}})(a),"
        " {act = hi, c = c1}) = Start",
    ],
)
def test_a_claim_about_a_rule_holds_and_its_opposite_fails(claim: str) -> None:
    again = "rule r(s : State, e : Move) := [spkr = s.spkr : Ind]\n"
    assert check(board(f"{again}check {claim}")).holds
    words = claim.split(" ", 1)
    opposite = words[1] if words[0] in ("not", "error") else f"not {claim}"
    report = check(board(f"{again}check {opposite}"))
    assert len(report.failures) == 1


def test_a_failed_claim_says_what_was_found_and_where_it_differs() -> None:
    report = check(board("check turn(Start) = Start"))
    assert report.summary == "1 of 1 checks failed, no fault in 3 rules"
    (failure,) = report.failures
    assert failure.found == "{addr = a, in = {deep = a}, plan = [], spkr = b}"
    assert failure.why == "addr: b → a\nspkr: a → b"


def test_a_claim_of_a_rule_that_does_not_apply_says_why() -> None:
    (failure,) = check(board("check drop(Start) = Start")).failures
    assert failure.found == "error"
    assert failure.why == (
        "drop does not apply: plan: [] : nelist(RecType), it is empty"
    )


@pytest.mark.parametrize(
    ("changed", "event", "why"),
    [
        ({}, None, "it waits for an event of [act : Act, c : by(act, a)]"),
        ({}, record(act="hi"), "c: nothing : by(hi, a), there is no c"),
        ({"plan": []}, record(act="hi", c="c1"), "plan: [] : nelist(RecType), it is"),
        ({"addr": "b"}, record(act="hi", c="c1"), "nothing is found for same : by("),
        ({}, record(act="hi", c="c1"), ""),
    ],
)
def test_why_a_rule_does_not_apply(changed, event, why) -> None:
    found = rules(
        "(s : State /\\ [plan : nelist(RecType)], e : Move)"
        " where [who = s.addr : Ind, same : by(e.act, who)] := [spkr = who : Ind]"
    )
    now = state(**{"plan": [RecordType(())], "addr": "a", **changed})
    answer = why_not(found.rules["r"], now, event, Model(found))
    assert answer.startswith(why)
    assert bool(answer) == bool(why)


def test_a_rule_that_gives_nothing_after_all_does_not_apply() -> None:
    @rule(when=RecordType(()))
    def refuse(s):
        return None

    assert why_not(refuse, state(), None, Model()) == ""
    with pytest.raises(UpdateError, match="refuse does not apply: "):
        apply_rule(refuse, [state()], Model())


# --- writing -------------------------------------------------------------------------


def test_a_rule_is_shown_with_the_names_of_its_types() -> None:
    found = board(
        "Named := [name : Ind]\n"
        "rule r(s : State, e : Move) where [who = s.in : Named]"
        " := [spkr = who.name : Ind]\n"
        "rule t(s : State) := State\n"
    )
    assert declaration(found, "r", abbreviator(found, 0)) == (
        "rule r(s : State, e : Move)\n"
        "    where [who = s.in : Named]\n"
        "    := [spkr = who.name : Ind]"
    )
    assert (
        declaration(found, "t", abbreviator(found, 0))
        == "rule t(s : State)\n    := State"
    )


def test_a_python_rule_is_not_written() -> None:
    @rule(when=RecordType(()))
    def nothing(s):
        return None

    with pytest.raises(UnsupportedError) as caught:
        format_rule(nothing)
    assert caught.value.message == (
        "the effect of nothing is a Python function, not notation"
    )


def test_an_update_is_the_rule_that_is_read_where_it_is_written() -> None:
    theory = board("Bound := [x : Ind]\ngo := \\s:State. [spkr = s.addr : Ind]")
    one = update(theory.go, "again", where=theory.Bound, kind="k", doc="Why.")
    read = board(format_rule(one)).rules["again"]
    assert dataclasses.replace(read, place=None, text="") == one


def test_a_promise_of_a_rule_is_not_written() -> None:
    theory = board("Deep := [in : [deep : Ind]]\ngo := \\s:State. Deep")
    assert format_rule(update(theory.go, "promise")).startswith("rule promise(")
    with pytest.raises(UnsupportedError) as caught:
        format_rule(update(theory.go, "promise", gives=theory.Deep))
    assert (
        caught.value.message == "promise declares what it gives, which has no notation"
    )


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ({"name": "two words"}, "two words"),
        ({"name": "fun"}, "fun"),
        ({"kind": "1st"}, "1st"),
        ({"kind": "list"}, "list"),
    ],
)
def test_a_rule_with_a_name_that_cannot_be_read_is_not_written(changes, name) -> None:
    turn = board().rules["turn"]
    assert format_rule(dataclasses.replace(turn, name="turns", kind=""))
    with pytest.raises(UnsupportedError) as caught:
        format_rule(dataclasses.replace(turn, **changes))
    assert caught.value.message == f"{name!r} is no name in the notation"


def test_games_are_written_as_they_are_read() -> None:
    found = board("game g(Start : State, acts on plan) := maybe(both)")
    assert declaration(found, "g") == (
        f"game g({found.Start} : {SHAPE}, acts on plan) := maybe(all(turn, plan))"
    )
    again = board("game g(Start : State, acts on plan, hears Ind, Rec) := turn")
    assert declaration(again, "g") == (
        f"game g({again.Start} : {SHAPE}, acts on plan, hears Ind, Rec) := turn"
    )
    with pytest.raises(KeyError):
        declaration(found, "State")


# --- sessions ------------------------------------------------------------------------


def after(text: str) -> Session:
    """The session after statements that must all be taken."""
    session = Session()
    lines = text.split("\n")
    while lines:
        typed = lines.pop(0)
        while lines and not is_complete(typed):
            typed += "\n" + lines.pop(0)
        reply = respond(session, typed)
        assert not reply.text.startswith("error"), reply.text
        session = reply.session
    return session


REPLIES = {
    "turn": (
        'rule turn(s : State) "Who was spoken to speaks." of floor\n'
        "    := [addr = s.spkr : Ind, spkr = s.addr : Ind]"
    ),
    "both": "strategy both := all(turn, plan)",
    "turn(Start)": "{addr = a, in = {deep = a}, plan = [], spkr = b}",
    "turn(Start) = Start": "no: {addr = a, in = {deep = a}, plan = [], spkr = b}",
    "drop(Start)": (
        "error: drop does not apply: plan: [] : nelist(RecType), it is empty"
    ),
    "g()": (
        "> nothing\n"
        "turn: Who was spoken to speaks.\n"
        "  addr: b → a\n"
        "  spkr: a → b\n"
        "plan\n"
        "  plan: + [act : Act, c : by(act, a)]\n"
        "state: {addr = a, in = {deep = a}, plan = [[act : Act, c : by(act, a)]], "
        "spkr = b}"
    ),
    "game h({spkr = a} : State) := turn": (
        "error: at the start the state is not of its type, at addr: nothing : Ind, "
        "there is no addr; a, b would do\n"
        "  ┌─ <input>:1:8\n"
        "1 │ game h({spkr = a} : State) := turn\n"
        "  │        ^^^^^^^^^^"
    ),
    ":names": (
        "basic   Ind, Act\n"
        "pred    p(Ind), by(Act, Ind)\n"
        "object  a, b, c1, hi\n"
        "defined State, Start, Move\n"
        "rule    turn, drop, plan\n"
        "strategy both\n"
        "game    g"
    ),
}


@pytest.mark.parametrize("typed", REPLIES)
def test_rules_are_asked_and_games_are_played_in_a_session(typed: str) -> None:
    session = after(BOARD + "game g(Start : State) := both")
    assert respond(session, typed).text == REPLIES[typed]


def test_a_rule_goes_on_over_lines_until_it_is_written() -> None:
    assert not is_complete("rule r(s : State)")
    assert not is_complete('rule r(s : State)\n  "doc" where [x = s.y : T]')
    assert is_complete("rule r(s : State)\n  := State")
    assert not is_complete("game g({} : Rec)")
    assert is_complete("rule := Ind")
    assert is_complete("game(x) <: rule(x)")


def test_what_rests_on_a_rule_follows_it() -> None:
    session = after(
        BOARD + "game g(Start : State) := both\nstrategy n := by_class(floor)"
    )
    reply = respond(session, "rule turn(s : State) of floor := [spkr = 'b' : Ind]")
    assert reply.text == "changed: both, g, n, turn"
    rules = reply.session.theory.rules
    assert reply.session.theory.strategies["both"] == all_(rules["turn"], rules["plan"])
    assert reply.session.theory.games["g"].rules == (rules["turn"], rules["plan"])


def test_a_rule_more_of_a_kind_is_gathered_too() -> None:
    session = after(BOARD + "strategy n := by_class(floor)")
    reply = respond(session, "rule more(s : State) of floor := [spkr = 'b' : Ind]")
    assert reply.text == "changed: n"
    rules = reply.session.theory.rules
    gathered = by_class(rules["turn"], rules["more"], order=["floor"])
    assert reply.session.theory.strategies["n"] == gathered


def test_a_state_type_that_a_game_does_not_start_from_is_refused() -> None:
    session = after(
        "basic Ind\nobject a : Ind\nS := [x : Ind]\n"
        "rule r(s : [x : Ind]) := [x = s.x : Ind]\n"
        "game g({x = a} : S) := r"
    )
    reply = respond(session, "S := [x : Ind, y : Ind]")
    assert reply.text.startswith("error: at the start the state is not of its type")
    assert reply.session is session


def test_a_session_with_rules_is_saved_and_loaded(tmp_path: Path) -> None:
    session = after(BOARD + "game g(Start : State) := both")
    file = tmp_path / "saved.ttr"
    respond(session, f":save {file}")
    reply = respond(Session(), f":load {file}")
    assert "error" not in reply.text
    found = reply.session.theory
    assert list(found.rules) == ["turn", "drop", "plan"]
    assert respond(reply.session, "g()").text == REPLIES["g()"]


def plan_of(event, item, where=""):
    """A theory whose rule plans a move with content; its event has the given name."""
    return f"""
        basic Ind
        object robot : Ind
        pred ask(Ind), ok(Ind, Ind)
        Ask := [i : Ind, e : ask(i)]
        Board := [agenda : list(RecType)]
        rule asked(s : Board, {event} : Ask) {where}
            := [agenda = [[i = {item} : Ind, e : ok('robot', i)]] : list(RecType)]
    """


@pytest.mark.parametrize("item", ["e.i", "^.e.i"])
def test_a_label_that_hides_the_event_is_told_with_two_ways_out(item):
    with pytest.raises(TTRError) as refused:
        Theory.parse(plan_of("e", item))
    error = refused.value
    assert error.message.startswith("the path e.i leads nowhere: ")
    assert error.hint == (
        "the label e hides the event e: "
        "bind it, where [it = e.i : Ind], or write ^^.e.i"
    )
    assert error.span.text[error.span.column - 1 :].startswith(item)


def test_the_ways_out_of_a_hidden_event_lead_out():
    for text in (
        plan_of("e", "^^.e.i"),
        plan_of("e", "it", "where [it = e.i : Ind]"),
        plan_of("ev", "ev.i"),
    ):
        assert "asked" in Theory.parse(text).rules
