"""One dialogue in all its spellings: a story, a log, a page; and its former names."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings

from ttr.dialogues import logs, stories, transcripts
from ttr.dialogues.dialogue import Dialogue, Trial, play
from ttr.dialogues.logs import read_logs, replay, story_of, write_log
from ttr.dialogues.stories import Setting, read_stories, setting, story_text
from ttr.dialogues.stories import play as play_story
from ttr.dialogues.transcripts import transcript
from ttr.testing.strategies import dialogues
from ttr.types.objects import Record

GAMES = Path(__file__).parent.parent / "games"
DOOR = setting("door.ttr door", GAMES)


@pytest.fixture
def visit() -> Dialogue:
    given = [DOOR.theory[name] for name in ("Greet", "Answer")]
    return replace(play(DOOR.game, [*given, None]), title="a visit", place=DOOR)


def in_folder(folder: Path) -> Setting:
    """The door, as a story in another folder names it."""
    return replace(DOOR, reference=DOOR.reference_from(folder), folder=folder)


@settings(max_examples=20)
@given(dialogues(DOOR.game))
def test_a_drawn_dialogue_is_the_same_in_every_spelling(
    tmp_path_factory: pytest.TempPathFactory, drawn: Dialogue
) -> None:
    folder = tmp_path_factory.mktemp("drawn")
    taken = tuple(trial for trial in drawn.trials if trial.turn is not None)
    drawn = replace(drawn, title="drawn", place=in_folder(folder), trials=taken)
    states = [*map(str, drawn.states)]

    (folder / "a.dlg").write_text(story_text(drawn), encoding="utf-8")
    if taken:
        (story,) = read_stories(folder / "a.dlg")
        played = play_story(story)
        assert played.mismatch is None
        assert [*map(str, played.dialogue.states)] == states
        assert story_text(played.dialogue) == story_text(drawn)

    write_log(folder / "a.jsonl", [drawn])
    (log,) = read_logs(folder / "a.jsonl")
    again = replay(log, drawn.setting)
    assert again.divergence is None
    assert [*map(str, again.dialogue.states)] == states
    assert story_of(log, drawn.setting) == story_text(drawn)

    assert transcript("page", [again.dialogue]) == transcript("page", [drawn])


def test_a_dialogue_is_the_same_value_however_it_came_about(
    visit: Dialogue, tmp_path: Path
) -> None:
    visit = replace(visit, place=in_folder(tmp_path)).in_words()
    (tmp_path / "a.dlg").write_text(story_text(visit), encoding="utf-8")
    write_log(tmp_path / "a.jsonl", [visit])
    (story,), (log,) = read_stories(tmp_path / "a.dlg"), read_logs(tmp_path / "a.jsonl")
    replayed = replay(log, visit.setting).dialogue
    for one in (play_story(story).dialogue, replayed):
        assert one.title == "a visit"
        assert [trial.line for trial in one.trials] == ["U> Greet", "U> Answer", "U>"]
        assert [trial.said for trial in one.trials] == [
            trial.said for trial in visit.trials
        ]
        assert [str(trial.before.state) for trial in one.trials] == [
            str(state) for state in one.states[:-1]
        ]


def test_a_dialogue_that_begins_elsewhere_says_so(visit: Dialogue) -> None:
    assert "@ start" not in story_text(visit)
    assert "@ start" in story_text(replace(visit, place=None))
    later = Dialogue(visit.game, place=DOOR, origin=visit.trials[0].after)
    assert later.states == (visit.states[1],)
    assert f"@ start {visit.states[1]}" in story_text(later)


def test_a_dialogue_is_never_changed(visit: Dialogue) -> None:
    longer = visit.then(None)
    assert (len(visit.trials), len(longer.trials)) == (3, 4)
    assert longer.trials[:3] == visit.trials
    assert (longer.title, longer.place) == (visit.title, visit.place)


def test_words_that_are_there_stay(visit: Dialogue) -> None:
    said = replace(visit.trials[0], line="U> hello", said=("Hello!",))
    assert said.in_words(DOOR) is said
    dialogue = replace(visit, trials=(said, *visit.trials[1:]))
    assert "U> hello\nS> Hello!\nU> Answer\n" in story_text(dialogue)


def test_what_was_not_taken_is_in_the_story_but_not_in_the_log(tmp_path: Path) -> None:
    odd = Dialogue(DOOR.game, place=DOOR).then(Record({})).then(None)
    assert [trial.turn is None for trial in odd.trials] == [True, False]
    assert "U> {}\nU>\n" in story_text(odd)
    assert "no rule applied" in transcript("odd", [odd])
    write_log(tmp_path / "a.jsonl", [odd])
    (log,) = read_logs(tmp_path / "a.jsonl")
    assert [entry.line for entry in log.entries] == ["U>"]


# --- former names --------------------------------------------------------------------


def test_what_stories_made_moments_of_is_a_trial_now() -> None:
    with pytest.warns(DeprecationWarning, match="stories.Moment is now .*Trial"):
        assert stories.Moment is Trial
    (turn,) = DOOR.game.play([DOOR.theory["Greet"]])
    with pytest.warns(DeprecationWarning, match=r"stories.moment is now .*Trial\.of"):
        one = stories.moment(turn, DOOR)
    assert (one.line, one.turn) == ("U> Greet", turn)
    with pytest.warns(DeprecationWarning, match="written is now .*format_story"):
        assert "U> Greet\nS> " in stories.written("a visit", [one], DOOR)
    with pytest.warns(DeprecationWarning, match="worded is now .*wording"):
        assert stories.worded(turn.said[0], DOOR) == one.said[0]
    with pytest.warns(DeprecationWarning, match="failing is now .*failure_reason"):
        assert stories.failing is stories.failure_reason
    with pytest.warns(DeprecationWarning, match="continued is now .*continue_log"):
        assert logs.continued is logs.continue_log


def test_what_transcripts_showed_is_a_dialogue_now(visit: Dialogue) -> None:
    visit = visit.in_words()
    with pytest.warns(DeprecationWarning, match="Transcribed is now .*Dialogue"):
        shown = transcripts.Transcribed("a visit", DOOR, visit.start, visit.trials)
    assert transcript("page", [shown]) == transcript("page", [visit])


def test_results_have_their_former_attributes(visit: Dialogue, tmp_path: Path) -> None:
    write_log(tmp_path / "a.jsonl", [visit])
    (log,) = read_logs(tmp_path / "a.jsonl")
    again = replay(log, DOOR)
    with pytest.warns(DeprecationWarning, match=r"moments is now .*dialogue\.trials"):
        assert again.moments == again.dialogue.trials
    with pytest.warns(DeprecationWarning, match=r"run is now .*dialogue\.now"):
        assert again.run == again.dialogue.now
