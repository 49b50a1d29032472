"""Laws of logs, for dialogues that are drawn.

A replay is the same as what was logged; a log that is cut and gone on with equals the
whole; the story of a log plays as it was.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from ttr import Model, rectype, replace
from ttr.dialogues.dialogue import Trial
from ttr.dialogues.logs import Log, LogFile, continue_log, read_logs, replay, story_of
from ttr.dialogues.stories import Setting, play, read_stories, setting
from ttr.types.objects import Record
from ttr.types.syntax import Ind, ListOf, Rec
from ttr.updates import Game, Turn, nbest, rule

GAMES = Path(__file__).parent.parent / "games"
DOOR = setting("door.ttr door", GAMES)

# --- a game in which anything may be shown, and is remembered -------------------------

Board = rectype(seen=ListOf(Rec), count=Ind)


@rule(when=Board, on=Rec)
def see(s: Any, e: Any) -> Any:
    """What is shown is seen."""
    return replace(s, seen=[e, *s.seen][:3])


WATCH = Setting.of(
    Game(
        "watch",
        Board,
        {"seen": [], "count": "none"},
        see,
        Model().given("none", Ind),
    ),
    reference=f"{Path(__file__).as_posix()}:GAME",
)
GAME = WATCH.game
"""What a story of the game names."""

names = st.sampled_from(
    ["a", "none", "a b", "Ind", "list", "fst", "x", 'a"b', "né", ""]
)
values = st.recursive(
    names | st.integers() | st.floats(allow_nan=False, allow_infinity=False),
    lambda inner: (
        st.lists(inner, max_size=3).map(tuple)
        | st.dictionaries(st.sampled_from(["x", "y", "seen"]), inner).map(Record)
    ),
    max_leaves=6,
)
shown = st.dictionaries(st.sampled_from(["x", "y", "a"]), values).map(Record)

# --- dialogues -----------------------------------------------------------------------

visits = st.lists(
    st.sampled_from(
        [
            None,
            DOOR.theory["Greet"],
            DOOR.theory["Answer"],
            nbest((DOOR.theory["Greet"], 0.6), (DOOR.theory["Answer"], 0.3)),
            nbest((DOOR.theory["Answer"], 0.3)),
        ]
    ),
    max_size=6,
)
dialogues = st.tuples(st.just(DOOR), visits) | st.tuples(
    st.just(WATCH), st.lists(st.none() | shown, max_size=5)
)


def logged(path: Path, setting: Setting, turns: tuple[Turn, ...]) -> Log:
    with LogFile(path) as file:
        file.begin(setting, "drawn")
        for turn in turns:
            file.write(turn)
    (log,) = read_logs(path)
    return log


@given(dialogues, st.integers(0, 6))
def test_a_replay_from_any_turn_equals_what_was_logged(
    dialogue: tuple[Setting, list[object]], start: int
) -> None:
    setting, events = dialogue
    turns = setting.game.play(events)
    with TemporaryDirectory() as folder:
        log = logged(Path(folder, "a.jsonl"), setting, turns)
    start = min(start, len(turns))
    again = replay(log, setting, from_=start)
    assert again.divergence is None
    found = [one.turn.state for one in again.dialogue.trials]
    assert found == [turn.state for turn in turns[start:]]


@given(dialogues, st.data())
def test_a_log_that_is_cut_and_gone_on_with_equals_the_whole(
    dialogue: tuple[Setting, list[object]], data: st.DataObject
) -> None:
    setting, events = dialogue
    turns = setting.game.play(events)
    with TemporaryDirectory() as folder:
        path = Path(folder, "a.jsonl")
        logged(path, setting, turns)
        whole = path.read_bytes()
        path.write_bytes(
            whole[: data.draw(st.integers(whole.index(b"\n") + 1, len(whole)))]
        )
        (cut,) = read_logs(path)
        file, run = continue_log(cut, setting)
        with file:
            for event in events[len(cut.entries) :]:
                turn = setting.game.take(run, event)
                file.write(Trial.of(turn, setting))
                run = turn.run
        assert path.read_bytes() == whole


@given(visits)
def test_the_story_of_a_log_plays_as_it_was(events: list[object]) -> None:
    turns = DOOR.game.play(events)
    with TemporaryDirectory() as name:
        folder = Path(name)
        log = logged(folder / "a.jsonl", DOOR, turns)
        (folder / "a.dlg").write_text(story_of(log, DOOR, folder), encoding="utf-8")
        stories = read_stories(folder / "a.dlg") if events else ()
        for story in stories:
            result = play(story)
            assert result.mismatch is None
            found = [one.turn.state for one in result.dialogue.trials]
            assert found == [turn.state for turn in turns]
