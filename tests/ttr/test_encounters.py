"""Participants with boards of their own, who act in turn or in step."""

import dataclasses
from pathlib import Path

import pytest

from ttr import RecType, load, rectype
from ttr.dialogues.encounters import Participant, meeting
from ttr.errors import IllFormedError, UpdateError
from ttr.updates import Game

FETCH = Path(__file__).parents[2] / "examples" / "fetch.ttr"


@pytest.fixture(scope="module")
def theory():
    return load(FETCH)


@pytest.fixture
def players(theory):
    game = theory.games["fetch"]
    return (
        Participant("human", game, theory.Human),
        Participant("dog", game, theory.Dog),
    )


ROUND = ["PickUp", "Attract", "Throw", "RunAfter", "Fetch", "Bring"]


@pytest.mark.parametrize("way", ["in_turn", "in_step"])
def test_a_game_of_fetch_is_six_events_that_both_see(theory, players, way):
    game = meeting(*players)
    while len(game.history) < 2 * 7:
        game = getattr(game, way)()
    done = game.history[: 2 * 7]
    events = [step.event.type for step in done if step.event is not None]
    assert events == [theory[name] for name in ROUND] * 2
    who = [step.by for step in done]
    assert who == [None, *["human"] * 3, *["dog"] * 3] * 2
    for step in done:
        assert step.boards["human"] == step.boards["dog"]
    sits = [step.event.sit for step in done if step.event is not None]
    assert len(set(sits)) == len(sits)


def test_everybody_who_saw_it_judges_the_event_alike(players):
    game = meeting(*players).in_turn().in_turn()
    event = game.history[1].event
    for board in game.boards:
        assert board.model.judge(event.sit, event.type).holds is True


def test_nobody_does_what_only_another_can(theory, players):
    human, dog = players
    alone = meeting(dog).in_turn()
    assert alone.history[-1].by is None
    assert alone.in_turn().history == alone.history
    assert alone.is_idle
    assert not meeting(human, dog).is_idle


def test_boards_are_asked_for_by_name(players):
    game = meeting(*players).in_turn()
    assert game.board("dog") == game.board("human")
    assert game.agree
    with pytest.raises(UpdateError, match="dgo takes no part\nhelp: did you mean dog"):
        game.board("dgo")


def test_what_contradicts_somebody_is_told_by_name(theory, players):
    human, dog = players
    blind = dog.game.model.witnessed(theory.pick_up, by=lambda x, y: False)
    game = dataclasses.replace(dog.game, model=blind)
    with pytest.raises(
        UpdateError, match=r"dog cannot take \{e = s1\} : .*, which human did: .* refus"
    ):
        meeting(human, dataclasses.replace(dog, game=game)).in_turn()


def test_an_encounter_is_told_step_by_step(players):
    told = str(meeting(*players).in_turn())
    assert told.startswith("nothing happens\n  human | begin: Nothing is going on")
    assert "human: {e = s1} : [e : pick_up(human, stick)]" in told


def test_what_is_no_meeting(theory, players):
    human, _ = players
    with pytest.raises(UpdateError, match="names of their own, found human, human"):
        meeting(human, human)
    with pytest.raises(UpdateError, match="found none"):
        meeting()
    with pytest.raises(UpdateError, match="a meeting is of participants, found int 5"):
        meeting(5)
    with pytest.raises(UpdateError, match="a participant has a name, found None"):
        Participant(None, theory.games["fetch"], theory.Dog)
    with pytest.raises(IllFormedError, match="expected a type, found int 5"):
        Participant("cat", theory.games["fetch"], 5)
    with pytest.raises(UpdateError, match="a participant plays a game, found"):
        Participant("cat", 3, theory.Dog)
    fetch = theory.games["fetch"]
    plain = Game("plain", fetch.type, fetch.start, fetch.algorithm, fetch.model)
    with pytest.raises(UpdateError, match="cat has no agenda to act on"):
        Participant("cat", plain, rectype(x=RecType))
