"""Rules, strategies and runs: pure, checked after every rule, and explained."""

import pytest

from ttr import (
    Basic,
    Endless,
    Ind,
    ListOf,
    Model,
    Pred,
    Rec,
    Record,
    RecType,
    TTRError,
    Type,
    UpdateError,
    merge,
    record,
    rectype,
    replace,
    this,
)
from ttr.updates import first, maybe, repeat, rule, run, seq

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


def test_a_repetition_without_end():
    circle = first(at_three, up)
    with pytest.raises(
        Endless, match="goes in a circle: up → up → up → at_three → up"
    ):
        play(repeat(circle, times=50))


def test_a_repetition_that_goes_on_and_on():
    @rule(when=Counter)
    def longer(s):
        return replace(s, log=[*s.log, "a"])

    with pytest.raises(Endless, match="after 50 rounds; the last rules: longer, long"):
        play(repeat(longer, times=50))
    with pytest.raises(Endless, match="did not end after 1000 rounds"):
        play(repeat(longer))
    with pytest.raises(Endless, match="log should get smaller .* from 0 to 1"):
        play(repeat(longer, measure="log"))


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
