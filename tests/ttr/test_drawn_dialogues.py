"""Strategies of states, events and dialogues: what they draw, and what tutors do."""

from array import array
from collections import Counter

import pytest
from hypothesis import HealthCheck, find, given, settings
from hypothesis import strategies as st

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    Record,
    RecordType,
    Theory,
    record,
    rectype,
    replace,
    this,
)
from ttr.dialogues.state_snapshots import copy_of, first_change, snapshot
from ttr.testing import strategies as tst
from ttr.types import TypeNode
from ttr.updates import Game, NBest, first, rule

few = settings(
    max_examples=100,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)

Topic = Basic("Topic")
ask, tell = Pred("ask", Topic), Pred("tell", Topic)
Ask = rectype(t=Topic, e=ask(this.t))
Tell = rectype(t=Topic, e=tell(this.t))
Board = rectype(asked=ListOf(Topic), told=ListOf(Topic))
Waiting = rectype(asked=ListOf(Topic) @ ("rain",), told=ListOf(Topic))
M = Model().given("rain", Topic).given("snow", Topic)
START = record(asked=[], told=[])


@rule(when=rectype(asked=ListOf(Topic) @ ()), on=Ask)
def hear_question(s, e):
    return replace(s, asked=[e.t])


@rule(when=Board, on=Tell)
def hear_answer(s, e):
    if not s.asked:
        return None
    return replace(s, asked=[], told=[*s.told, e.t])


game = Game("weather", Board, START, first(hear_question, hear_answer), M)


def drawn(strategy, run=few):
    found = []

    def keep(value):
        found.append(value)

    run(given(strategy)(keep))()
    return found


# --- states --------------------------------------------------------------------------


@pytest.mark.parametrize("model", [None, M])
def test_states_are_of_their_type(model):
    some = drawn(tst.states(Board, model))
    for state, known in some:
        assert known.judge(state, Board).holds
    assert len({len(state.asked) for state, _ in some}) > 1


def test_states_over_a_model_are_of_what_it_knows():
    some = drawn(tst.states(Board, M))
    topics = {t for state, _ in some for t in state.asked}
    assert {"rain", "snow"} <= topics


# --- events --------------------------------------------------------------------------


def test_events_are_such_as_the_game_hears():
    for event in drawn(tst.events(game)):
        assert isinstance(event, TypeNode)
        assert event <= Ask or event <= Tell
        turn = game.take(game.begin(), event)
        assert isinstance(turn.heard, Record)


def test_events_that_the_theory_defines_are_drawn():
    """A rule may wait for one question among those that can be asked."""
    theory = Theory.parse("""
        basic Ind
        pred rain(), ask(RecType)
        Rain := [e : rain()]
        Ask := [q : RecType, e : ask(q)]
        AskRain := [q = Rain : RecType, e : ask(q)]
        Board := [open : list(RecType)]
        rule hear(s : Board, e : Ask) := [open = [e.q] : list(RecType)]
        game talk({open = []} : Board) := hear
    """)
    game = theory.games["talk"]
    drawn = find(tst.events(game), lambda event: event is theory.AskRain, settings=few)
    assert game.take(game.begin(), drawn).state.open == (theory.Rain,)


def test_events_are_about_what_is_known_and_what_is_new():
    some = Counter(map(str, drawn(tst.events([Ask], M))))
    assert set(some) == {
        "[t : Topic, e : ask(t)]",
        "[t = rain : Topic, e : ask(t)]",
        "[t = snow : Topic, e : ask(t)]",
    }


def test_events_of_other_types_are_known_objects_or_new():
    assert set(drawn(tst.events([Topic], M))) == {Topic, "rain", "snow"}


def test_fields_of_fields_are_set_too():
    Nested = rectype(by=rectype(x=Ind), t=Topic)
    found = find(
        tst.events([Nested], M.given("kim", Ind)),
        lambda T: isinstance(T, RecordType) and T["by"] is rectype(x=Ind @ "kim"),
    )
    assert str(found) == "[by : [x = kim : Ind], t : Topic]"


# --- dialogues -----------------------------------------------------------------------


def test_dialogues_are_played_as_they_were_drawn():
    for dialogue in drawn(tst.dialogues(game), few):
        again = tst.play(game, dialogue.given)
        assert again.states == dialogue.states
        assert len(dialogue.trials) <= 10


def test_most_dialogues_have_all_their_turns():
    lengths = Counter(len(d.trials) for d in drawn(tst.dialogues(game, turns=6)))
    assert max(lengths) == 6
    assert lengths[6] > 50


def test_a_dialogue_ends_with_what_goes_wrong_in_it():
    @rule(when=Board, on=Ask)
    def broken(s, e):
        return replace(s, asked=[*s.asked, 1] if s.asked else [e.t])

    faulty = Game("faulty", Board, START, broken, M)
    dialogue = find(tst.dialogues(faulty), lambda d: d.fault is not None)
    assert len(dialogue.trials) == 2
    assert dialogue.trials[-1].turn is None
    assert "broken" in str(dialogue.fault)


def test_dialogues_begin_where_they_are_told_to():
    starts = tst.states(Waiting, M)
    for dialogue in drawn(tst.dialogues(game, starts=starts)):
        assert dialogue.game.start.asked == ("rain",)


# --- tutors --------------------------------------------------------------------------


def moves_of(tutor, turns=8):
    """What is given after a question, and how often, over many dialogues."""
    found = Counter()
    for dialogue in drawn(tst.dialogues(game, tutor, turns=turns)):
        for trial in dialogue.trials:
            asked = bool(trial.before.state.asked)
            given_ = trial.given
            kind = "nothing" if given_ is None else "ask" if given_ <= Ask else "tell"
            found[asked, kind] += 1
    return found


def test_a_tutor_mostly_does_what_some_rule_waits_for():
    found = moves_of(tst.Tutor())
    assert found[True, "tell"] > 2 * found[True, "ask"]
    assert found[True, "nothing"] + found[False, "nothing"] > 0


def test_weights_are_obeyed():
    only = dict.fromkeys(("answers", "wanders", "contradicts", "repeats", "silent"), 0)
    silent = moves_of(tst.Tutor(**{**only, "silent": 1}))
    assert set(silent) == {(False, "nothing")}
    answering = moves_of(tst.Tutor(**{**only, "answers": 1}))
    assert (True, "ask") not in answering
    assert (False, "nothing") not in answering


def test_a_tutor_repeats_and_contradicts():
    only = dict.fromkeys(("answers", "wanders", "contradicts", "repeats", "silent"), 0)
    said = ("rain", "snow")
    moves = tuple(rectype(t=Topic @ t, e=tell(this.t)) for t in said)
    tutor = tst.Tutor(moves=moves, replies=moves, **{**only, "repeats": 1})
    for dialogue in drawn(tst.dialogues(game, tutor)):
        assert len(set(dialogue.given)) == 1
    tutor = tst.Tutor(moves=moves, replies=moves, **{**only, "contradicts": 1})
    for dialogue in drawn(tst.dialogues(game, tutor)):
        pairs = zip(dialogue.given, dialogue.given[1:], strict=False)
        assert all(one is not other for one, other in pairs)


def test_a_tutor_that_mumbles_is_heard_with_probabilities():
    tutor = tst.Tutor(
        answers=0, wanders=0, contradicts=0, repeats=0, silent=0, mumbles=1
    )
    for dialogue in drawn(tst.dialogues(game, tutor)):
        assert all(isinstance(given, NBest) for given in dialogue.given)
        assert dialogue.fault is None


def test_replies_may_depend_on_the_state():
    def replies(state, model):
        return [Tell] if state.asked else [Ask]

    tutor = tst.Tutor(replies=replies, answers=1, wanders=0, repeats=0, silent=0)
    dialogue = find(tst.dialogues(game, tutor), lambda d: len(d.now.state.told) == 2)
    assert [Ask >= T for T in dialogue.given] == [True, False, True, False]


def test_a_tutor_may_be_a_function():
    def tutor(draw, state, model):
        return draw(st.sampled_from([Tell])) if state.asked else Ask

    for dialogue in drawn(tst.dialogues(game, tutor)):
        expected = [Ask, Tell] * 5
        assert list(dialogue.given) == expected[: len(dialogue.given)]


def test_texts_are_read_by_the_game_and_what_is_not_understood_is_silence():
    speaking = Game(
        "speaking",
        Board,
        START,
        first(hear_question, hear_answer),
        M,
        hear={"?": Ask, "!": Tell}.get,
    )
    dialogue = tst.play(speaking, ["?", "what", "!"])
    assert [len(state.told) for state in dialogue.states] == [0, 0, 0, 1]


# --- snapshots -----------------------------------------------------------------------


def test_snapshots_see_what_was_changed_where_it_stood():
    class Notes:
        def __init__(self):
            self.lines = []

    notes = Notes()
    state = record(a=record(b=[1]), notes=[notes])
    before = snapshot(state)
    assert first_change(before, state) == ""
    state.a._fields["b"] = (2,)
    assert first_change(before, state) == "a.b"
    state.a._fields["b"] = (1,)
    assert first_change(before, state) == ""
    notes.lines.append("new")
    assert first_change(before, state) == "notes"
    notes.lines.clear()
    state.a._fields["new"] = 1
    assert first_change(before, state) == "a.new"


def test_snapshots_see_what_is_in_arrays():
    state = record(pixels=array("b", [1, 2]))
    before = snapshot(state)
    state.pixels[0] = 3
    assert first_change(before, state) == "pixels"


def test_a_copy_has_records_of_its_own():
    state = record(a=record(b="x"))
    copy = copy_of(state)
    copy.a._fields["b"] = "y"
    assert state.a.b == "x"
