"""Rules, strategies and runs: pure, checked after every rule, and explained."""

import dataclasses
import math

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    Rec,
    Record,
    RecType,
    Theory,
    TTRError,
    Type,
    fun,
    merge,
    outer,
    record,
    rectype,
    replace,
    this,
)
from ttr.errors import EndlessError, NoStateError, RuleFailedError, UpdateError
from ttr.updates import (
    all_,
    ask,
    by_class,
    first,
    maybe,
    nbest,
    repeat,
    rule,
    rules_of,
    run,
    seq,
    update,
)
from ttr.updates.update_strategies import replace_rules

Count = Basic("Count")
Counter = rectype(n=Count, log=ListOf(Ind))
M = Model().witnessed(Count, by=lambda n: isinstance(n, int) and 0 <= n <= 5)
for name in ("a", "b", "c"):
    M = M.given(name, Ind)
START = record(n=0, log=[])


@rule(when=Counter)
def up(s):
    "One more."
    return replace(s, n=s.n + 1) if s.n < 3 else None


@rule(when=Counter)
def too_far(s):
    return replace(s, n=9)


@rule(when=rectype(n=Count @ 3))
def at_three(s):
    return replace(s, n=0)


@rule(when=Counter)
def still(s):
    return s


@rule(when=Counter, on=Ind)
def hear(s, event):
    return replace(s, log=[*s.log, event])


@rule(when=Counter)
def never(s):
    return None


def play(algorithm, state=START, **options):
    return run(algorithm, state, type=Counter, model=M, **options)


# --- strategies -----------------------------------------------------------------------


def test_a_rule_applies_where_its_condition_holds():
    after, model, trace = play(up)
    assert after == record(n=1, log=[])
    assert model is M
    assert [str(step) for step in trace] == ["up: One more.\n  n: 0 → 1"]
    assert trace[0].licence.holds
    assert play(at_three).trace == ()


@pytest.mark.parametrize(
    ("algorithm", "n", "steps"),
    [
        (first(at_three, up), 1, 1),
        (first(at_three, never), 0, 0),
        (first(), 0, 0),
        (seq(up, up), 2, 2),
        (seq(up, at_three), 0, 0),
        (seq(), 0, 0),
        (maybe(at_three), 0, 0),
        (maybe(seq(up, at_three)), 0, 0),
        (seq(maybe(at_three), up), 1, 1),
        (seq(up, maybe(seq(up, at_three)), up), 2, 2),
        (repeat(up), 3, 3),
        (seq(repeat(up), at_three), 0, 4),
        (repeat(at_three), 0, 0),
        (seq(repeat(at_three), up), 0, 0),
        (seq(maybe(repeat(at_three)), up), 1, 1),
        (seq(repeat(maybe(at_three)), up), 1, 1),
        (repeat(repeat(up)), 3, 3),
        (repeat(up, times=3), 3, 3),
        (repeat(seq(up, up)), 2, 2),
    ],
)
def test_strategies(algorithm, n, steps):
    after, _, trace = play(algorithm)
    assert (after.n, len(trace)) == (n, steps)


def test_a_repetition_without_progress():
    with pytest.raises(
        UpdateError, match="still is repeated without changing anything"
    ):
        play(repeat(still))
    with pytest.raises(UpdateError, match="help: let its precondition fail"):
        play(repeat(first(at_three, still)))
    there_and_back = seq(up, rule(when=Counter)(lambda s: replace(s, n=s.n - 1)))
    with pytest.raises(EndlessError, match=r"goes in a circle: up → <lambda> → up"):
        play(repeat(there_and_back))


def test_a_repetition_without_end():
    circle = first(at_three, up)
    with pytest.raises(
        EndlessError, match="goes in a circle: up → up → up → at_three → up"
    ):
        play(repeat(circle, times=50))


def test_a_repetition_that_goes_on_and_on():
    @rule(when=Counter)
    def longer(s):
        return replace(s, log=[*s.log, "a"])

    with pytest.raises(
        EndlessError, match="after 50 rounds; the last rules: longer, long"
    ):
        play(repeat(longer, times=50))
    with pytest.raises(EndlessError, match="did not end after 1000 rounds"):
        play(repeat(longer))
    with pytest.raises(EndlessError, match=r"log should get smaller .* from 0 to 1"):
        play(repeat(longer, measure="log"))


def test_a_fact_that_is_new_makes_a_state_one_that_was_not_there_before():
    """Nothing goes in a circle where each round knows more than the last."""
    calm = Pred("calm", Ind)
    facts = iter(["s1", "s2"])

    @rule(when=rectype(n=Count @ 1))
    def back(s, model):
        fact = next(facts, None)
        if fact is not None:
            return replace(s, n=0), model.given(fact, calm("a"))

    @rule(when=rectype(n=Count @ 0))
    def forth(s):
        return replace(s, n=1)

    after, model, trace = play(repeat(first(back, forth)))
    assert [step.rule.name for step in trace] == ["forth", "back"] * 2 + ["forth"]
    assert after.n == 1
    assert model.judge("s2", calm("a")).holds is True


def test_a_condition_is_asked_again_of_the_same_state_in_another_model():
    calm = Pred("calm", Ind)

    @rule(when=Counter)
    def learn(s, model):
        return s, model.given("s1", calm("a"))

    @rule(when=rectype(mood=calm("a")))
    def rest(s):
        return replace(s, n=5)

    State = rectype({**dict(Counter.fields), "mood": Ind})
    start = record(n=0, log=[], mood="s1")
    model = M.given("s1", Ind)
    unwatched = run(seq(maybe(rest), learn), start, type=State, model=model)
    assert [str(step.rule) for step in unwatched.trace] == ["learn"]
    after = run(seq(maybe(rest), learn, rest), start, type=State, model=model)
    assert [str(step.rule) for step in after.trace] == ["learn", "rest"]


def test_events_are_played_once_and_in_order():
    after, _, trace = play(first(hear, up), events=["a", "b", "c"])
    assert after.log == ("a", "b", "c")
    assert [step.event for step in trace] == ["a", "b", "c"]


def test_an_event_that_nothing_applies_to():
    after, _, trace = play(hear, events=["nobody", "a", "nobody"])
    assert after.log == ("a",)
    assert len(trace) == 1
    assert play(hear, events=["nobody"]) == (START, M, ())
    assert play(hear) == (START, M, ())


def test_tacit_rules_run_for_every_event():
    assert play(seq(up, hear), events=["a", "b", "nobody"]).state.n == 2
    assert play(seq(up, maybe(hear)), events=["a", "nobody"]).state.n == 2


# --- what a rule may give -------------------------------------------------------------

dog = Pred("dog", Ind)


def test_a_rule_may_add_facts():
    @rule(when=Counter)
    def know(s, model):
        return replace(s, log=["d"]), model.given("d", Ind).given("s", dog("d"))

    after, model, _ = play(know)
    assert model.judge("s", dog("d")).holds is True
    assert M.judge("s", dog("d")).holds is False
    assert after.log == ("d",)


def test_a_rule_may_give_a_type():
    Board = rectype(spkr=Ind, addr=Ind, moves=ListOf(Type), bg=rectype(topic=Ind))
    greet = Pred("greet", Ind, Ind)

    @rule(when=Board)
    def turn(s):
        return rectype(spkr=Ind @ s.addr, addr=Ind @ s.spkr)

    @rule(when=Board)
    def say(s):
        return rectype(
            moves=ListOf(Type) @ [*s.moves, greet(s.spkr, s.addr)],
            e=greet(s.spkr, s.addr),
        )

    state = record(spkr="a", addr="b", moves=[], bg={"topic": "c"}, extra=1)
    after, model, trace = run(seq(turn, say), state, type=Board, model=M)
    assert after == record(
        spkr="b",
        addr="a",
        moves=[greet("b", "a")],
        bg={"topic": "c"},
        e="s1",
        extra=1,
    )
    assert model.judge("s1", greet("b", "a")).holds is True
    assert trace[1].changes == ("e: nothing → s1", "moves: + greet(b, a)")


def test_a_field_left_without_a_value_is_created():
    @rule(when=rectype(x=Ind))
    def somebody(s):
        return rectype(x=Ind, c=dog(this.x))

    T = rectype(x=Ind)
    after, model, _ = run(somebody, record(x="a"), type=T, model=M)
    assert after.x not in ("a", "b", "c")
    assert model.judge(after.c, dog(after.x)).holds is True


@pytest.mark.parametrize(
    ("effect", "message"),
    [
        (lambda s: 3, "gives a state, .* or None, but it gave 3"),
        (lambda s: "n", "but it gave 'n'"),
        (lambda s: (s, None), "but it gave"),
        (lambda s: {"n": 1}, "but it gave {'n': 1}"),
        (lambda s: Ind, r"but it gave Basic\('Ind'\)"),
        (lambda s: s.missing, "failed: AttributeError: no label missing"),
        (lambda s: 1 / 0, "failed: ZeroDivisionError: division by zero"),
        (lambda s: replace(s, m=1), "failed: m is not in"),
        (lambda s: rectype(n=Count @ "x"), "no state can be made of what the rule"),
        (lambda s: rectype(n=Count @ this.log, log=Ind @ this.n), "no state can be"),
        (lambda s: replace(s, n=9), "is not of its type, at n: 9 : Count, by the"),
        (lambda s: replace(s, log=["a", "x"]), "at log: x : Ind, nothing says so"),
        (lambda s: Record({}), "at log: nothing : list.Ind., there is no log"),
    ],
)
def test_a_rule_that_fails(effect, message):
    effect.__name__ = "faulty"
    faulty = rule(when=Counter)(effect)
    before = str(START)
    with pytest.raises(UpdateError, match=message) as caught:
        play(seq(up, faulty))
    assert "faulty" in str(caught.value)
    assert str(START) == before
    assert play(up).state.n == 1


def test_an_interrupt_is_no_fault_of_a_rule():
    @rule(when=Counter)
    def interrupted(s):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        play(interrupted)


# --- what a run takes -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("state", "message"),
    [
        (
            record(n=9, log=[]),
            "before the first rule the state is not of its type, at n",
        ),
        (record(n=1), "at log: nothing : list.Ind., there is no log"),
        (record(n=1, log=["a", "nobody"]), "at log: nobody : Ind, nothing says so"),
        ("a", "before the first rule the state is no record, but a"),
    ],
)
def test_a_state_that_is_none(state, message):
    with pytest.raises(UpdateError, match=message):
        play(up, state)


def test_a_nested_path_is_named():
    T = rectype(shared=rectype(latest=rectype(who=Ind)))
    state = record(shared={"latest": {"who": "nobody"}})
    with pytest.raises(UpdateError, match=r"at shared\.latest\.who: nobody : Ind"):
        run(up, state, type=T, model=M)


def test_plain_dictionaries_and_lists_are_taken():
    assert play(up, {"n": 0, "log": []}).state == record(n=1, log=[])
    heard = rule(when=Counter, on=rectype(who=Ind))(
        lambda s, e: replace(s, log=[e.who])
    )
    assert play(heard, events=[{"who": "b"}]).state.log == ("b",)


MISTAKES = {
    "run takes rules and strategies, found 3": lambda: play(3),
    "first takes rules and strategies, found 'up'": lambda: first("up"),
    "seq takes rules and strategies": lambda: seq([up]),
    "repeat takes how often at most, found times=0": lambda: repeat(up, times=0),
    "maybe takes rules and strategies": lambda: maybe(None),
    "events are a list of objects, found the one 'a'": lambda: play(up, events="a"),
    "the type of a state is a record type, found Basic('Ind')": lambda: run(
        up, START, type=Ind, model=M
    ),
    "the condition of a rule is a record type, found Basic('Ind')": lambda: rule(
        when=Ind
    ),
    "the event of a rule is of a type, found 'Ind'": lambda: rule(when=Rec, on="Ind"),
    "a rule is made of a function, found 3": lambda: rule(when=Rec)(3),
    "takes the state, and model by that name, but its parameters are ()": lambda: rule(
        when=Rec
    )(lambda: None),
    "takes the state, and model by that name, but its parameters are (s, e)": (
        lambda: rule(when=Rec)(lambda s, e: s)
    ),
    "takes the state and the event, and model": lambda: rule(when=Rec, on=Ind)(
        lambda s, model: s
    ),
}


@pytest.mark.parametrize("message", MISTAKES)
def test_mistakes_are_named(message):
    with pytest.raises(UpdateError) as caught:
        MISTAKES[message]()
    assert message in str(caught.value)


def test_an_error_of_a_rule_is_one_line_and_keeps_its_cause():
    @rule(when=Counter)
    def refused(s, model):
        return s, model.given("x", Count)

    with pytest.raises(UpdateError, match="x : Count is refused by the") as caught:
        play(refused)
    assert isinstance(caught.value.__cause__, TTRError)
    assert str(caught.value).count("\n") == 0


def test_runs_are_deterministic():
    algorithm = seq(repeat(first(hear, up)), maybe(at_three))
    game = first(hear, up)
    runs = [play(game, events=["a", "x", "b"]) for _ in range(3)]
    assert len({str(each.state) for each in runs}) == 1
    assert len({"\n".join(map(str, each.trace)) for each in runs}) == 1
    assert algorithm == seq(repeat(first(hear, up)), maybe(at_three))


def test_long_runs():
    state, steps = START, 2000
    after, _, trace = play(first(at_three, up), state, events=[None] * steps)
    assert len(trace) == steps
    assert after.n == steps % 4


def test_the_example_of_the_contract():
    Naming = rectype(content=RecType)

    @rule(when=rectype(lu=Naming, com=RecType))
    def accept_naming(s):
        "What was named becomes common ground."
        return replace(s, com=merge(s.com, s.lu.content))

    InfoState = rectype(lu=Rec, com=RecType)
    named = rectype(x=Ind, c=dog(this.x))
    state = record(lu={"content": named}, com=rectype(y=Ind))

    @rule(when=rectype(lu=Naming))
    def downdate(s):
        return replace(s, lu=record())

    algorithm = seq(first(accept_naming), maybe(repeat(downdate)))
    after, model, trace = run(algorithm, state, type=InfoState, model=M)
    assert after == record(lu={}, com=rectype(x=Ind, y=Ind, c=dog(this.x)))
    assert model is M
    assert [step.rule.name for step in trace] == ["accept_naming", "downdate"]
    assert str(trace[0]).startswith(
        "accept_naming: What was named becomes common ground."
    )


@pytest.mark.parametrize(
    ("slip", "told"),
    [
        ({"model": "x"}, "a run is in a model, found the object 'x'"),
        ({"events": 3}, "events are a list of objects, found int 3"),
    ],
)
def test_what_a_run_cannot_be_given(slip, told):
    with pytest.raises(UpdateError, match=told):
        run(up, START, **{"type": Counter, "model": M, **slip})


# --- bindings -------------------------------------------------------------------------

likes = Pred("likes", Ind, Ind)
Fans = M.given("s1", likes("a", "b")).given("s2", likes("a", "c"))
Topic = rectype(topic=Ind)


def bound(where, effect, state, model=Fans, **options):
    made = rule(when=Topic, where=where, **options)(effect)
    return run(made, state, type=Topic, model=model)


def test_what_a_rule_binds_is_worked_out_or_found_in_the_model():
    where = rectype(other=Ind, c=likes(outer.s.topic, this.other))

    def move_on(s, other):
        return replace(s, topic=other)

    after, model, trace = bound(where, move_on, record(topic="a"))
    assert after == record(topic="b")
    assert model is Fans
    assert trace[0].bindings == {"other": "b", "c": "s1"}
    assert "  with other = b" in str(trace[0])
    assert bound(where, move_on, record(topic="c")).trace == ()


def test_later_fields_choose_among_what_earlier_ones_found():
    where = rectype(other=Ind, c=likes("a", this.other), d=likes(this.other, "a"))
    model = Fans.given("s3", likes("c", "a"))
    _, _, trace = bound(where, lambda s, other: s, record(topic="a"), model)
    assert trace[0].bindings["other"] == "c"


def test_a_binding_that_a_witness_function_sees():
    model = M.witnessed(likes, by=lambda x, y: x == "a")
    where = rectype(c=likes(outer.s.topic, outer.s.topic))
    _, after, trace = bound(where, lambda s, c: s, record(topic="a"), model)
    assert after.judge(trace[0].bindings["c"], likes("a", "a")).holds is True
    assert bound(where, lambda s, c: s, record(topic="b"), model).trace == ()


def test_a_binding_is_certainly_of_its_type():
    where = rectype(c=likes("a", "b") @ "s2")
    assert bound(where, lambda s: s, record(topic="a")).trace == ()
    where = rectype(c=likes("a", "b") @ outer.s.nothing)
    assert bound(where, lambda s: s, record(topic="a")).trace == ()


# --- what a rule gives ----------------------------------------------------------------


def test_a_rule_keeps_to_what_it_says_it_gives():
    @rule(when=Counter, gives=rectype(n=Count @ 0))
    def reset(s):
        return replace(s, n=1)

    with pytest.raises(
        NoStateError, match=r"after reset, by what it gives, .* at n: 1 "
    ):
        play(reset)


def test_a_type_changes_just_what_it_mentions():
    T = rectype(shared=rectype(latest=Rec, com=RecType), x=Ind)
    state = record(shared={"latest": {"e": "a"}, "com": Rec, "more": 1}, x="a")

    @rule(when=T)
    def turn(s):
        return rectype(shared=rectype(latest=rectype(by=Ind @ s.x)), x=Ind)

    after, _, trace = run(turn, state, type=T, model=M)
    assert after.shared == record(latest={"e": "a", "by": "a"}, com=Rec, more=1)
    assert after.x not in ("a", "b", "c")
    assert trace[0].created == ("x",)
    assert "(created)" in str(trace[0])


def test_a_value_of_the_wrong_type_is_refused_where_it_stands():
    @rule(when=Counter)
    def banana(s):
        return rectype(n=Count @ "banana")

    with pytest.raises(RuleFailedError, match="at n: banana : Count"):
        play(banana)


def test_what_fails_inside_a_record_that_is_set_is_named_itself():
    inner = rectype(deep=rectype(one=Ind, other=Ind))
    T = rectype(r=inner)
    good = record(deep=record(one="a", other="b"))

    @rule(when=T)
    def put(s):
        return rectype(r=inner @ record(deep=record(one="c", other="nobody")))

    with pytest.raises(
        RuleFailedError, match=r"at r\.deep\.other: nobody : Ind, nothing says so"
    ):
        run(put, record(r=good), type=T, model=M)


def test_what_is_in_a_record_that_was_created_was_created():
    T = rectype(r=Rec, rest=Ind)

    @rule(when=T)
    def get(s):
        return rectype(r=rectype(of=Ind) & rectype(for_=Ind), rest=Ind @ "b")

    state = record(r=record(of="a", for_="a"), rest="a")
    (step,) = run(get, state, type=T, model=M).trace
    assert step.created == ("r",)
    created = [line for line in str(step).splitlines() if "(created)" in line]
    assert [line.split(":")[0].strip() for line in created] == ["r.for_", "r.of"]


# --- more strategies ------------------------------------------------------------------


def renamed(made, name, **changes):
    return dataclasses.replace(made, name=name, **changes)


@pytest.mark.parametrize(
    ("algorithm", "n", "steps"),
    [
        (all_(at_three, up, never, up), 2, 2),
        (all_(at_three, never), 0, 0),
        (seq(all_(at_three), up), 0, 0),
        (maybe(all_(up)), 1, 1),
        (repeat(all_(up, up)), 3, 3),
        (repeat(up, measure=lambda s: 5 - s.n), 3, 3),
    ],
)
def test_more_strategies(algorithm, n, steps):
    after, _, trace = play(algorithm)
    assert (after.n, len(trace)) == (n, steps)


def test_rules_class_by_class():
    late = renamed(at_three, "late", kind="late")
    early = [renamed(up, f"up{number}", kind="early") for number in range(3)]
    _, _, trace = play(by_class(late, *early, order=["early", "late"]))
    assert [step.rule.name for step in trace] == ["up0", "up1", "up2", "late"]
    assert rules_of(by_class(late, *early, order=["early", "late"])) == (*early, late)


def test_somebody_chooses_among_the_rules_that_apply():
    asked = []

    def choose(names, state):
        asked.append((tuple(names), state.n))
        return len(names) - 1 if state.n < 2 else None

    algorithm = ask(at_three, renamed(up, "one"), renamed(up, "two"), choose=choose)
    after, _, trace = play(algorithm, events=[None] * 4)
    assert [step.rule.name for step in trace] == ["two", "two"]
    assert asked[0] == (("one", "two"), 0)
    assert after.n == 2
    with pytest.raises(
        UpdateError, match="gives an index below 1, or None, but gave 3"
    ):
        play(ask(up, choose=lambda names, s: 3))


def test_a_measure_gets_smaller_and_is_never_negative():
    @rule(when=Counter)
    def down(s):
        return replace(s, n=s.n - 1) if s.n else None

    assert play(repeat(down, measure="n"), record(n=3, log=[])).state.n == 0
    with pytest.raises(
        EndlessError, match="n should get smaller each time up is repeated"
    ):
        play(repeat(up, measure="n"))
    with pytest.raises(EndlessError, match=r"should get smaller .* from 3 to 3"):
        play(repeat(up, times=2, measure=lambda s: 3))
    with pytest.raises(EndlessError, match="from 0 to -1"):
        play(repeat(up, measure=lambda s: -s.n))
    with pytest.raises(UpdateError, match="a list or a whole number, found None"):
        play(repeat(up, measure=lambda s: None))
    with pytest.raises(UpdateError, match=r"a whole number, found 1\.0"):
        play(repeat(up, measure=lambda s: 1 / (s.n + 1)))
    with pytest.raises(UpdateError, match="the measure m is no path of the state"):
        play(repeat(up, measure="m"))
    with pytest.raises(RuleFailedError, match="the measure failed: ZeroDivisionError"):
        play(repeat(up, measure=lambda s: 1 / 0))


def test_strategies_print_as_they_are_written():
    shown = str(first(up, maybe(repeat(at_three, times=3)), all_(never), seq(still)))
    assert shown == "first(up, maybe(repeat(at_three, 3)), all(never), seq(still))"


def test_a_rule_is_replaced_by_its_name():
    algorithm = seq(up, maybe(repeat(first(up, at_three))), all_(never))
    other = renamed(still, "up")
    after = replace_rules(algorithm, {"up": other})
    assert rules_of(after) == (other, at_three, never)
    assert replace_rules(after, {"up": up}) == algorithm


def test_all_applies_where_a_part_does():
    assert play(first(all_(maybe(at_three)), up)).trace == ()
    assert len(play(first(all_(at_three), up)).trace) == 1


def test_a_choice_that_fails():
    with pytest.raises(RuleFailedError, match="what chooses failed: ZeroDivisionError"):
        play(ask(up, choose=lambda names, s: 1 / 0))


# --- rules that do what they should not -----------------------------------------------


class Box:
    """Somebody's own object, which can change."""

    def __init__(self, size):
        self.size = size


class Silent:
    """Somebody's own object, which cannot print itself."""

    def __repr__(self):
        raise OSError("no")


BoxT = Basic("Box")
Small = M.witnessed(BoxT, by=lambda b: b.size < 5)


@pytest.mark.parametrize("state", [record(b=Box(1), l=[]), record(b={"in": Box(1)})])
def test_an_object_that_was_changed_in_place_is_judged_again(state):
    inside = rectype({"in": BoxT}) if isinstance(state.b, Record) else BoxT
    T = rectype(b=inside)

    @rule(when=T)
    def swell(s):
        (s["b.in"] if isinstance(s.b, Record) else s.b).size = 9
        return replace(s, b=s.b)

    with pytest.raises(
        NoStateError, match="after swell the state is not of its type, at b"
    ):
        run(swell, state, type=T, model=Small)


def test_a_list_of_objects_that_were_changed_in_place():
    T = rectype(l=ListOf(BoxT))

    @rule(when=T)
    def swell(s):
        s.l[0].size = 9
        return replace(s, l=[*s.l, Box(1)])

    with pytest.raises(NoStateError, match="at l: <Box"):
        run(swell, record(l=[Box(1)]), type=T, model=Small)


def giving(value):
    return lambda s: value


def test_what_a_rule_gives_is_told_on_one_short_line():
    for junk in (["a"] * 10**5, Silent(), "a\nb" * 100):
        with pytest.raises(RuleFailedError) as caught:
            play(rule(when=Counter)(giving(junk)))
        assert len(str(caught.value)) < 400
        assert "\n" not in str(caught.value)

    def complain(s):
        raise ValueError("one\ntwo" * 1000)

    with pytest.raises(
        RuleFailedError, match="complain failed: ValueError: one twoone tw"
    ):
        play(rule(when=Counter)(complain))


def test_a_rule_is_a_plain_function_of_the_state():
    async def later(s):
        return s

    def bit_by_bit(s):
        yield s

    for effect in (later, bit_by_bit):
        with pytest.raises(
            UpdateError, match="gives its state later: write a plain fu"
        ):
            rule(when=Rec)(effect)
    for effect in (lambda *, s: s, lambda **s: s, lambda *s: s):
        with pytest.raises(
            UpdateError, match="takes the state, and model by that name"
        ):
            rule(when=Rec)(effect)
    with pytest.raises(UpdateError, match="the parameters of type are not known"):
        rule(when=Rec)(type)


@pytest.mark.parametrize("events", [record(a=1), {"a": 1}, b"ab", rectype(a=Ind)])
def test_one_event_is_no_list_of_events(events):
    with pytest.raises(
        UpdateError, match="events are a list of objects, found the one"
    ):
        play(up, events=events)


def test_what_cannot_be_is_seen_before_more_is_tried():
    asked = []

    def never_likes(x, y):
        asked.append((x, y))
        return False

    model = Model().witnessed(likes, by=never_likes)
    for number in range(12):
        model = model.given(f"a{number}", Ind)
    where = rectype(x=Ind, y=Ind, z=Ind, v=Ind, c=likes(this.x, this.x))
    state = record(topic="a1")
    assert bound(where, lambda s: s, state, model).trace == ()
    assert len(asked) <= 4 * 12


# --- uncertain events -----------------------------------------------------------------

Yes, No = rectype(yes=Ind), rectype(no=Ind)
yes, no = record(yes="a"), record(no="a")


def heard_as(*rules):
    def play_heard(*alternatives):
        event = nbest(*alternatives) if len(alternatives) > 1 else alternatives[0]
        after = play(first(*rules), events=[event])
        return after.trace[0] if after.trace else None

    return play_heard


def answer(name, on, **options):
    return renamed(rule(when=Counter, on=on, **options)(lambda s, e: s), name)


def test_a_rule_takes_the_likeliest_alternative_of_its_type():
    hears = heard_as(answer("sure", Yes), answer("likely", Yes, p=0.5))
    other = record(yes="b")
    assert hears(yes).rule.name == "sure"
    assert hears((yes, 0.6), (no, 0.3)).rule.name == "likely"
    assert hears((yes, 0.4), (no, 0.3)) is None
    both = hears((other, 0.4), (yes, 0.2))
    assert (both.event, both.rule.name) == (other, "likely")
    assert both.p.lo == pytest.approx(0.6)
    assert str(both).splitlines()[1] == "  on {yes = b}   p = 0.6"
    assert hears((other, 0.7), (yes, 0.3)).rule.name == "sure"


def test_alternatives_that_are_all_of_a_type_make_it_certain_up_to_rounding():
    several = [
        (record(yes=one), p) for one, p in zip("abc", (0.35, 0.08, 0.57), strict=True)
    ]
    assert math.fsum(p for _, p in several) < 1.0
    taken = heard_as(answer("sure", Yes))(*several)
    assert taken.p == (1.0, 1.0)
    assert "p =" not in str(taken)


def test_how_sure_an_alternative_is_and_how_well_it_fits_count_together():
    Wave = Basic("Wave")
    model = M.given("w", Wave, 0.5).given("v", Wave)
    waved = answer("waved", Wave, p=0)

    def taken(*alternatives):
        event = nbest(*alternatives)
        return run(waved, START, type=Counter, model=model, events=[event]).trace[0]

    assert taken(("w", 0.6), ("v", 0.2)).event == "w"  # .30 and .20
    assert taken(("w", 0.5), ("v", 0.3)).event == "v"  # .25 and .30
    assert taken(("w", 0.5), ("v", 0.3)).p.lo == pytest.approx(0.55)


def test_a_rule_that_has_to_be_certain_hears_nothing_that_may_be_something_else():
    hears = heard_as(answer("sure", Yes))
    assert hears((yes, 0.5), (no, 0.5)) is None
    assert hears(yes) is not None
    named = heard_as(answer("a", rectype(yes=Ind @ "a")), answer("b", Yes))
    assert named((yes, 0.5), (record(yes="b"), 0.5)).rule.name == "b"


def test_an_event_that_lacks_what_is_asked_for_is_not_heard_at_all():
    assert heard_as(answer("maybe", Yes, p=(0, 0.5)))(no) is None


def test_a_rule_that_takes_any_probability_hears_what_one_alternative_is():
    taken = heard_as(answer("any", Yes, p=0))((no, 0.6), (yes, 0.3))
    assert (taken.event, taken.p.lo) == (yes, 0.3)


def test_a_step_has_the_event_that_was_taken_and_the_one_that_it_comes_from():
    uncertain = nbest((no, 0.6), (yes, 0.3))
    both = seq(up, answer("any", Yes, p=0))
    events = [uncertain, yes]
    steps = play(both, events=events).trace
    assert [(step.event, step.given) for step in steps] == [
        (None, None),
        (yes, uncertain),
        (yes, yes),
        (yes, yes),
    ]


def test_bands_of_probability_decide():
    hears = heard_as(
        answer("accept", Yes, p=0.7),
        answer("confirm", Yes, p=(0.3, 0.7)),
        answer("repeat", Yes | No, p=0),
    )
    taken = [hears((yes, p), (no, 0.05)).rule.name for p in (0.9, 0.7, 0.4, 0.2)]
    assert taken == ["accept", "accept", "confirm", "repeat"]


def test_a_rule_may_ask_how_probable_its_event_is():
    @rule(when=Counter, on=Yes, p=0.1)
    def keep(s, e, p, nbest):
        return replace(s, n=round(p.lo * 5), log=[one["yes"] for one, _ in nbest])

    event = nbest((yes, 0.4), (record(yes="b"), 0.4))
    assert play(keep, events=[event]).state == record(n=4, log=["a", "b"])
    assert "p = 0.8" in str(play(keep, events=[event]).trace[0])


def test_an_event_that_is_judged_uncertainly():
    Wave = Basic("Wave")
    model = M.given("w", Wave, 0.6)
    waved = answer("waved", Wave, p=0.5)
    assert run(waved, START, type=Counter, model=model, events=["w"]).trace
    sure = answer("waved", Wave)
    assert not run(sure, START, type=Counter, model=model, events=["w"]).trace
    event = nbest(("w", 0.5), ("a", 0.5))
    assert not run(waved, START, type=Counter, model=model, events=[event]).trace


@pytest.mark.parametrize(
    ("alternatives", "message"),
    [
        ([("a", 0.9), ("b", 0.9)], "come to at most 1, found 1.8"),
        ([("a", 0)], "a probability above 0"),
        ([("a", "much")], "a probability above 0"),
        (["a"], "an alternative is an event and a probability"),
        ([], "has one alternative at least"),
    ],
)
def test_what_is_no_uncertain_event(alternatives, message):
    with pytest.raises(UpdateError, match=message):
        nbest(*alternatives)


MORE_MISTAKES = {
    "the bindings of a rule are a record type, found": lambda: rule(
        when=Rec, where=Ind
    ),
    "the target of a rule are a record type, found": lambda: rule(when=Rec, gives=3),
    "the probability of a rule's event is a number": lambda: rule(when=Rec, p=7),
    "by_class takes rules, found": lambda: by_class(first(up), order=["x"]),
    "the rule up has no class; the order is x": lambda: by_class(up, order=["x"]),
    "did you mean early?": lambda: by_class(
        renamed(up, "up", kind="erly"), order=["early"]
    ),
    "help: give it a class by kind=": lambda: by_class(up, order=["x"]),
    "no rule is of the class late": lambda: by_class(
        renamed(up, "up", kind="early"), order=["early", "late"]
    ),
    "the order of classes is a list of words": lambda: by_class(up, order="early"),
    "what chooses is a function": lambda: ask(up, choose=3),
    "a measure is the path of a list or number": lambda: repeat(up, measure=3),
    "an update is a function of states": lambda: update(Ind),
    "an update is a function of states, records": lambda: update(fun(x=Ind)(Rec)),
}


@pytest.mark.parametrize("message", MORE_MISTAKES)
def test_more_mistakes_are_named(message):
    with pytest.raises(UpdateError) as caught:
        MORE_MISTAKES[message]()
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("state", "event", "names"),
    [("s", "e", ("s", "e")), ("a", "b", ("a", "b")), ("s", "s", ("s", "s_"))],
)
def test_an_update_keeps_the_names_of_its_text(state, event, names):
    theory = Theory.parse(f"""
        basic Ind
        f := \\{state}:[x : Ind]. \\{event}:[y : Ind]. [x = {event}.y : Ind]
    """)
    assert update(theory.f, theory=theory).names == names
    assert update(theory.f).names == ("s", "e")
    start, said = record(x="a"), record(y="b")
    after = run(update(theory.f), start, events=[said], type=rectype(x=Ind), model=M)
    assert after.state == record(x="b")


def test_where_nothing_of_a_basic_type_is_known_a_rule_waits():
    @rule(when=Counter, where=rectype(one=Basic("Unheard")))
    def found(s, one):
        return replace(s, log=[one])

    assert run(maybe(found), START, type=Counter, model=M).state == START


@pytest.mark.parametrize(
    ("on", "event"), [(Ind, record(of="a")), (rectype(of=Ind), "a")], ids=str
)
def test_what_is_of_another_form_is_not_probable_either(on, event):
    @rule(when=Counter, on=on, p=0.3)
    def takes(s, e):
        return replace(s, n=5)

    assert (
        run(maybe(takes), START, events=[event], type=Counter, model=M).state == START
    )


def test_an_event_with_the_name_that_is_asked_for_is_taken_if_it_is_probable():
    one = rectype(of=Ind @ "a", sure=Basic("Sure"))

    @rule(when=Counter, on=one, p=0.3)
    def takes(s, e):
        return replace(s, n=5)

    known = M.given("w", Basic("Sure"), 0.5)
    event = record(of="a", sure="w")
    assert (
        run(maybe(takes), START, events=[event], type=Counter, model=known).state.n == 5
    )
    other = record(of="b", sure="w")
    assert (
        run(maybe(takes), START, events=[other], type=Counter, model=known).state.n == 0
    )


def test_what_several_rules_ask_of_a_state_is_judged_once():
    asked = []

    def odd(n):
        asked.append(n)
        return False

    Odd = Basic("Odd")
    never = [rule(when=rectype(n=Odd))(lambda s: s) for _ in range(3)]
    known = M.witnessed(Odd, by=odd)
    assert run(maybe(all_(*never)), START, type=Counter, model=known).trace == ()
    assert asked == [0]
