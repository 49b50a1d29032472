"""Games: whole dialogues, turn by turn, with moves of their own."""

import dataclasses

import pytest

from ttr import Ind, ListOf, Model, Rec, RecType, TTRError, record, rectype, replace
from ttr.errors import EndlessError, NotHeardError, UpdateError
from ttr.probability import Degree
from ttr.updates import Game, first, maybe, nbest, rule

M = Model().given("a", Ind).given("b", Ind).given("c", Ind)

Act = rectype(by=Ind)
Talk = rectype(plan=ListOf(RecType), heard=ListOf(Ind))


@rule(when=Talk, on=Act)
def reply(s, e):
    if e.by == "b":
        return replace(s, plan=s.plan[1:])
    return replace(s, plan=[rectype(by=Ind @ "b")], heard=[*s.heard, e.by])


def talk(**changes):
    options = {"algorithm": reply, "agenda": "plan"} | changes
    start = {"plan": [], "heard": []}
    return Game("talk", Talk, start, model=M, **options)


def test_a_game_is_played_turn_by_turn():
    turns = talk().play([{"by": "a"}, None, rectype(by=Ind @ "c")])
    assert [[move.sit for move in turn.said] for turn in turns] == [
        [record(by="b")],
        [],
        [record(by="b")],
    ]
    assert turns[-1].state == record(plan=[], heard=["a", "c"])
    assert [len(turn.trace) for turn in turns] == [2, 0, 2]
    assert turns[0].said[0].type is rectype(by=Ind @ "b")


def test_each_turn_goes_on_from_the_one_before():
    turns = talk().play([{"by": "a"}, {"by": "c"}, {"by": "a"}])
    assert [turn.state.heard for turn in turns] == [
        ("a",),
        ("a", "c"),
        ("a", "c", "a"),
    ]


def test_moves_are_made_in_the_order_in_which_they_are_planned():
    @rule(when=Talk, on=Act)
    def reply_twice(s, e):
        if e.by != "a":
            return replace(s, plan=s.plan[1:])
        return replace(s, plan=[rectype(by=Ind @ "b"), rectype(by=Ind @ "c")])

    (turn,) = talk(algorithm=reply_twice).play([{"by": "a"}])
    assert [move.sit for move in turn.said] == [record(by="b"), record(by="c")]
    assert [move.type for move in turn.said] == [
        rectype(by=Ind @ "b"),
        rectype(by=Ind @ "c"),
    ]


def test_a_turn_prints_what_happened():
    event = nbest((record(by="a"), 0.5), (record(by="c"), 0.25))
    sure, nothing, unsure = talk().play([{"by": "a"}, None, event])
    assert str(sure).startswith("> {by = a}\nreply\n")
    assert str(sure).endswith("\n< {by = b} : [by = b : Ind]")
    assert str(nothing) == "> nothing"
    assert str(unsure) == f"> {event}"


def test_a_turn_that_fails_changes_nothing():
    game = talk()
    so_far = game.take(game.begin(), {"by": "a"}).run
    with pytest.raises(
        NotHeardError, match="is no event that the game talk takes: expecte"
    ):
        game.take(so_far, {"who": "a"})
    assert so_far.state == record(plan=[], heard=["a"])


def test_a_move_that_nobody_takes_off_the_agenda():
    @rule(when=rectype(plan=ListOf(RecType) @ ()), on=Act)
    def planning(s, e):
        return replace(s, plan=[rectype(by=Ind @ "b")])

    game = talk(algorithm=planning)
    with pytest.raises(
        EndlessError, match=r"no rule takes the move .* stays on the agenda"
    ):
        game.take(game.begin(), {"by": "a"})

    @rule(when=Talk, on=Act)
    def on_and_on(s, e):
        return replace(s, plan=[rectype(by=Ind @ "b")])

    game = talk(algorithm=on_and_on)
    with pytest.raises(
        EndlessError, match="not empty after 100 moves in a turn: on_and_on → …"
    ):
        game.take(game.begin(), {"by": "a"})


@pytest.mark.parametrize("circle", ["ab", "abc"])
def test_an_agenda_that_never_becomes_empty_names_the_rules_that_go_round(circle):
    """Each rule takes the move of one and plans that of the next."""

    def passing(one, following):
        @rule(when=Talk, on=rectype(by=Ind @ one))
        def pass_on(s, e):
            return replace(s, plan=[rectype(by=Ind @ following)])

        return dataclasses.replace(pass_on, name=f"after_{one}")

    game = talk(algorithm=first(*map(passing, circle, circle[1:] + circle[0])))
    with pytest.raises(EndlessError) as caught:
        game.take(game.begin(), {"by": circle[0]})
    order = circle[101 % len(circle) :] + circle[: 101 % len(circle)]
    names = " → ".join(f"after_{one}" for one in order)
    assert f"after 100 moves in a turn: {names} → …" in str(caught.value)


def test_uncertain_events_of_a_game():
    sure = dataclasses.replace(reply, p=Degree(0.5, 1.0))
    game = talk(algorithm=sure)
    event = nbest((rectype(by=Ind @ "a"), 0.6), (record(by="c"), 0.3))
    turn = game.take(game.begin(), event)
    assert turn.state.heard == ("a",)
    assert turn.event is event
    assert [one for one, _ in turn.heard] == [record(by="a"), record(by="c")]


def test_a_move_that_cannot_be_made():
    def act(planned, model):
        raise OSError("the arm is stuck")

    game = talk(act=act)
    with pytest.raises(UpdateError, match="failed: OSError: the arm is stuck"):
        game.take(game.begin(), {"by": "a"})


@pytest.mark.parametrize("made", [5, ("x", 5), None])
def test_an_act_gives_an_event_and_a_model(made):
    game = talk(act=lambda planned, model: made)
    with pytest.raises(UpdateError, match="gives an event and a model, but it gave"):
        game.take(game.begin(), {"by": "a"})


def test_what_a_turn_cannot_go_on_from():
    with pytest.raises(UpdateError, match=r"a turn goes on from a run, as begin\(\) g"):
        talk().take(None, {"by": "a"})
    for events in (None, 5, "ab", record(by="a"), Act):
        with pytest.raises(UpdateError, match="events are a list of them, found"):
            talk().play(events)


def test_an_agenda_that_is_a_record():
    state = rectype(plan=Rec)
    with pytest.raises(UpdateError, match="a list of types, but plan is the record"):
        Game("talk", state, {"plan": {}}, maybe(reply), M, agenda="plan")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"agenda": "paln"}, "acts on paln, which its state lacks"),
        ({"agenda": "paln"}, "did you mean plan?"),
        ({"agenda": "heard", "start": {"plan": [], "heard": ["a"]}}, "a list of types"),
        ({"start": {"plan": []}}, "at the start the state is not of its type, at hear"),
        ({"agenda": 5}, "an agenda is named by its path, found 5"),
        ({"hears": 5}, "a game hears events of a list of types, found 5"),
        ({"hears": ("x",)}, "expected a type, found the object 'x'"),
        ({"algorithm": 3}, "a game takes rules and strategies, found 3"),
    ],
)
def test_what_is_no_game(changes, message):
    options = {"algorithm": reply, "agenda": "plan", "start": {"plan": [], "heard": []}}
    with pytest.raises(TTRError) as caught:
        Game("talk", Talk, model=M, **options | changes)
    assert message in str(caught.value)


def test_a_move_that_an_act_made_is_judged_to_be_of_what_was_planned():
    def other(planned, model):
        return record(by="b", loud="yes"), model

    @rule(when=Talk, on=Rec)
    def once(s, e):
        planned = [] if s.heard else [rectype(by=Ind @ "c")]
        return replace(s, plan=planned, heard=["a"])

    for act, holds in (
        (other, False),
        (lambda planned, model: model.create(planned), True),
    ):
        (turn,) = talk(act=act, algorithm=once).play([{"by": "a"}])
        assert [move.holds for move in turn.said] == [holds]
