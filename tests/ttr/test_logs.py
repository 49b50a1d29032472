"""Logs: what is written is read, replayed and gone on with."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from ttr import Model, Pred, record, rectype, this
from ttr import replace as replaced
from ttr.cli.main import main
from ttr.dialogues.dialogue import Trial
from ttr.dialogues.logs import (
    Log,
    LogError,
    LogFile,
    continue_log,
    read_logs,
    replay,
    run_after,
    story_of,
)
from ttr.dialogues.stories import Setting, play, read_stories, setting
from ttr.theories.theory import Theory
from ttr.types.syntax import Ind, ListOf, RecType
from ttr.updates import Game, Turn, nbest, rule

GAMES = Path(__file__).parent.parent / "games"


@pytest.fixture
def door() -> Setting:
    return setting("door.ttr door", GAMES)


def visit(door: Setting) -> tuple[Turn, ...]:
    """A dialogue of five turns, with an uncertain event and an empty turn."""
    greet, answer = door.theory["Greet"], door.theory["Answer"]
    uncertain = nbest((greet, 0.6), (answer, 0.3))
    return door.game.play([greet, answer, None, uncertain, answer])


@pytest.fixture
def log(tmp_path: Path, door: Setting) -> Log:
    with LogFile(tmp_path / "visit.jsonl") as file:
        file.begin(door, "a visit")
        for turn in visit(door):
            file.write(turn)
    (dialogue,) = read_logs(tmp_path / "visit.jsonl")
    return dialogue


def states(turns: tuple[Turn, ...]) -> list[str]:
    return [str(turn.state) for turn in turns]


# --- writing and reading -------------------------------------------------------------


def test_a_log_has_all_of_a_turn(log: Log, door: Setting) -> None:
    assert (log.header.title, log.cut) == ("a visit", "")
    assert [entry.turn for entry in log.entries] == [1, 2, 3, 4, 5]
    assert [entry.state for entry in log.entries] == states(visit(door))
    first, _, empty, uncertain, _ = log.entries
    assert first.line == "U> Greet"
    assert first.said[1] == ("[e : ask(host, guest)]", "Ask")
    assert [one["rule"] for one in first.rules] == ["greeted", "greeted_back", "asked"]
    assert first.rules[2]["changes"] == [
        "private.agenda: − [e : ask(host, guest)]",
        "shared.open: + [e : ask(host, guest)]",
    ]
    assert first.judged[0] == ("s1", "greet(guest, host)", 1.0, 1.0)
    assert (empty.line, empty.event, empty.rules) == ("U>", None, ())
    assert isinstance(uncertain.event, list)
    assert [p for _, p in uncertain.event] == [0.6, 0.3]


def test_every_line_is_json_that_machines_read(log: Log) -> None:
    lines = Path(log.file).read_text(encoding="utf-8").splitlines()
    header, *turns = map(json.loads, lines)
    assert (header["log"], header["version"]) == ("ttr", 1)
    assert header["game"].endswith("tests/games/door.ttr door")
    assert [turn["turn"] for turn in turns] == [1, 2, 3, 4, 5]


def test_a_log_is_read_without_its_game(log: Log) -> None:
    bare = replace(log, header=replace(log.header, game="gone.ttr gone"))
    read = bare.declared.read_value(log.entries[-1].state, "log")
    assert str(read) == log.entries[-1].state


def test_a_log_may_hold_several_dialogues(tmp_path: Path, door: Setting) -> None:
    path = tmp_path / "two.jsonl"
    with LogFile(path) as file:
        for title in ("one", "two"):
            file.begin(door, title)
            file.write(visit(door)[0])
    one, two = read_logs(path)
    assert [(it.header.title, it.number, len(it.entries)) for it in (one, two)] == [
        ("one", 1, 1),
        ("two", 3, 1),
    ]


def test_a_turn_without_a_dialogue_is_refused(tmp_path: Path, door: Setting) -> None:
    with LogFile(tmp_path / "a.jsonl") as file, pytest.raises(LogError, match="begin"):
        file.write(visit(door)[0])


def test_an_event_without_a_notation_is_refused_and_nothing_written(
    tmp_path: Path,
) -> None:
    Board = rectype(seen=ListOf(Ind))

    @rule(when=Board, on=Ind)
    def see(s: Any, e: Any) -> Any:
        return s

    model = Model().witnessed(Ind, by=lambda a: True)
    watch = Setting.of(Game("watch", Board, {"seen": []}, see, model))
    path = tmp_path / "watch.jsonl"
    with LogFile(path) as file:
        file.begin(watch)
        before = path.read_bytes()
        turn = watch.game.take(watch.game.begin(), frozenset({1}))
        with pytest.raises(LogError, match="the event of turn 1 has no notation"):
            file.write(turn)
        assert path.read_bytes() == before


# --- replaying -----------------------------------------------------------------------


def test_a_replay_is_the_same(log: Log, door: Setting) -> None:
    again = replay(log, door)
    assert again.divergence is None
    assert [str(it.after.state) for it in again.dialogue.trials] == states(visit(door))


@pytest.mark.parametrize("turn", range(6))
def test_a_replay_from_any_turn_is_the_same(log: Log, door: Setting, turn: int) -> None:
    again = replay(log, door, from_=turn)
    assert again.divergence is None
    found = [str(one.turn.state) for one in again.dialogue.trials]
    assert found == states(visit(door))[turn:]
    whole = visit(door)[-1].model.facts
    assert again.dialogue.now.model.facts.known == whole.known
    assert again.dialogue.now.model.facts.created == whole.created


def test_a_turn_that_a_log_has_not(log: Log, door: Setting) -> None:
    for turn in (-1, 6):
        with pytest.raises(LogError, match=f"there is no turn {turn}: .* has 5"):
            run_after(log, door, turn)


def test_a_log_of_other_rules_tells_the_turn(log: Log, door: Setting) -> None:
    text = (GAMES / "door.ttr").read_text(encoding="utf-8")
    changed = text.replace("[agenda = [GreetBack, Ask]", "[agenda = [GreetBack]")
    other = Setting.of(Theory.parse(changed).games["door"])
    divergence = replay(log, other).divergence
    assert divergence is not None
    assert "turn 1" in divergence.place
    assert divergence.what == "which rules ran"
    assert divergence.logged == "greeted, greeted_back, asked"
    assert divergence.found == "greeted, greeted_back"


def test_what_changes_more_than_facts_is_replayed_from_the_start(
    tmp_path: Path,
) -> None:
    Seen = rectype(x=Ind, c=Pred("seen", Ind)(this.x))
    Board = rectype(seen=ListOf(RecType))

    @rule(when=Board, on=Seen)
    def learn(s: Any, e: Any, model: Any) -> Any:
        known = model.witnessed(Pred("bright", Ind), by=lambda x: 0.5)
        return replaced(s, seen=[*s.seen, Seen]), known

    learner = Setting.of(Game("learner", Board, {"seen": []}, learn))
    with LogFile(tmp_path / "a.jsonl") as file:
        file.begin(learner)
        for turn in learner.game.play([Seen, Seen]):
            file.write(turn)
    (log,) = read_logs(tmp_path / "a.jsonl")
    assert replay(log, learner).divergence is None
    with pytest.raises(LogError, match="turn 1 has changed the model by more than"):
        replay(log, learner, from_=1)


def test_a_log_tells_a_story_that_plays(
    log: Log, door: Setting, tmp_path: Path
) -> None:
    (tmp_path / "told.dlg").write_text(story_of(log, door, tmp_path))
    (story,) = read_stories(tmp_path / "told.dlg")
    result = play(story)
    assert story.title == "a visit"
    assert result.mismatch is None
    assert [str(it.after.state) for it in result.dialogue.trials] == states(visit(door))


def test_a_log_with_another_start_tells_it(tmp_path: Path, door: Setting) -> None:
    ask = door.theory["Ask"]
    start = record(private={"agenda": []}, shared={"said": [], "open": [ask]})
    asked = replace(door, game=replace(door.game, start=start))
    with LogFile(tmp_path / "a.jsonl") as file:
        file.begin(asked)
        file.write(asked.game.play([door.theory["Answer"]])[0])
    (log,) = read_logs(tmp_path / "a.jsonl")
    assert replay(log, door).divergence is None
    story = story_of(log, door, tmp_path)
    assert "@ start {private = {agenda = []}" in story
    (tmp_path / "a.dlg").write_text(story)
    assert play(read_stories(tmp_path / "a.dlg")[0]).mismatch is None


# --- logs that were cut off ----------------------------------------------------------


def test_a_log_cut_anywhere_is_read_up_to_its_last_whole_turn(
    log: Log, tmp_path: Path
) -> None:
    whole = Path(log.file).read_bytes()
    header = whole.index(b"\n") + 1
    path = tmp_path / "cut.jsonl"
    for size in range(header, len(whole), 97):
        path.write_bytes(whole[:size])
        (cut,) = read_logs(path)
        turns = whole[:size].count(b"\n") - 1
        assert cut.entries == log.entries[:turns]
        assert bool(cut.cut) == (not whole[:size].endswith(b"\n"))
    assert f"{path}:" in cut.cut
    assert cut.cut.endswith("the log is cut off after turn 4")


@pytest.mark.parametrize("turns", range(6))
@pytest.mark.parametrize("rest", [b"", b'{"turn": 6, "li', "né".encode()[:2]])
def test_a_log_that_was_cut_and_is_gone_on_with_equals_the_whole(
    log: Log, door: Setting, tmp_path: Path, turns: int, rest: bytes
) -> None:
    lines = Path(log.file).read_bytes().splitlines(keepends=True)
    path = tmp_path / "visit.jsonl"
    path.write_bytes(b"".join(lines[: turns + 1]) + rest)
    (cut,) = read_logs(path)
    file, run = continue_log(cut, door)
    with file:
        for turn in visit(door)[turns:]:
            taken = door.game.take(run, turn.event)
            file.write(Trial.of(taken, door))
            run = taken.run
    assert path.read_bytes() == b"".join(lines)


WRITER = """
import sys
from pathlib import Path
from ttr.dialogues.logs import LogFile
from ttr.dialogues.stories import setting

games, path = map(Path, sys.argv[1:])
door = setting("door.ttr door", games)
with LogFile(path) as log:
    log.begin(door, "without end")
    now = door.game.begin()
    while True:
        for event in (door.theory["Greet"], door.theory["Answer"], None):
            turn = door.game.take(now, event)
            log.write(turn)
            now = turn.run
"""


def test_a_writer_that_is_killed_leaves_whole_turns(
    tmp_path: Path, door: Setting
) -> None:
    path = tmp_path / "killed.jsonl"
    command = [sys.executable, "-c", WRITER, str(GAMES), str(path)]
    with subprocess.Popen(command) as process:
        deadline = time.monotonic() + 60
        while not path.exists() or path.read_bytes().count(b"\n") < 8:
            assert time.monotonic() < deadline
            assert process.poll() is None
            time.sleep(0.01)
        os.kill(process.pid, signal.SIGKILL)
    (log,) = read_logs(path)
    assert len(log.entries) >= 7
    assert replay(log, door).divergence is None
    file, run = continue_log(log, door)
    file.close()
    assert str(run.state) == log.entries[-1].state
    assert path.read_bytes().endswith(b"\n")


# --- logs that were edited -----------------------------------------------------------


Edit = Callable[[dict[str, Any]], None]


def edited(log: Log, turn: int, edit: Edit) -> Log:
    """The log, read again after one turn of it was edited in its file."""
    path = Path(log.file)
    lines = path.read_text(encoding="utf-8").splitlines()
    facts = json.loads(lines[turn])
    edit(facts)
    lines[turn] = json.dumps(facts)
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    (dialogue,) = read_logs(path)
    return dialogue


def test_an_edited_state_is_told_with_turn_and_path(log: Log, door: Setting) -> None:
    def forget(facts: dict[str, Any]) -> None:
        facts["state"] = facts["state"].replace("open = []", "open = [Ind]")
        facts["declares"] = [*facts["declares"], "basic Ind"]

    told = str(replay(edited(log, 2, forget), door).divergence)
    assert told.splitlines() == [
        f"{log.file}:3: turn 2: the state at shared.open differs",
        "    logged: [Ind]",
        "     found: []",
    ]


def test_an_edited_event_is_told(log: Log, door: Setting) -> None:
    edit: Edit = lambda facts: facts.update(event=None)  # noqa: E731
    divergence = replay(edited(log, 1, edit), door).divergence
    assert divergence is not None
    assert (divergence.what, divergence.found) == ("which rules ran", "none")


def test_an_edited_change_and_an_edited_move_are_told(log: Log, door: Setting) -> None:
    def change(facts: dict[str, Any]) -> None:
        facts["rules"][0]["changes"] = ["shared.said: + [e : lie(guest)]"]

    def move(facts: dict[str, Any]) -> None:
        facts["said"] = facts["said"][:1]

    divergence = replay(edited(log, 1, change), door).divergence
    assert divergence is not None
    assert divergence.what == "what greeted changed"
    divergence = replay(edited(log, 1, move), door).divergence
    assert divergence is not None
    assert divergence.what == "what was said"


DAMAGES: dict[str, tuple[Edit, str]] = {
    "missing": (lambda it: it.pop("state"), "state is missing"),
    "kind": (lambda it: it.update(turn="1"), "turn should be a whole number"),
    "number": (lambda it: it.update(turn=7), "expected turn 2, found turn 7"),
    "event": (lambda it: it.update(event=3), "event should be a text or a list"),
    "said": (lambda it: it.update(said=[3]), "is not expected in it"),
    "rules": (lambda it: it.update(rules=["greeted"]), "is no rule"),
    "judged": (lambda it: it.update(judged=[["a", "b"]]), "is not expected in it"),
    "header": (lambda it: it.update(log="ttr", version=2), "a log of version 2"),
    "kind of log": (lambda it: it.update(log="other"), "a log of another kind"),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_turn_is_told_with_its_line(log: Log, damage: str) -> None:
    edit, told = DAMAGES[damage]
    with pytest.raises(LogError) as caught:
        edited(log, 2, edit)
    assert str(caught.value).startswith(f"{log.file}:3: ")
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)


UNREADABLE: dict[str, Edit] = {
    "the state cannot be read": lambda it: it.update(state="{private = "),
    "the state is no record": lambda it: it.update(state="guest"),
    "a fact cannot be read": lambda it: it["judged"][0].__setitem__(1, "greet("),
    "no fact is of the type": lambda it: it["judged"][0].__setitem__(1, "list(Ind)"),
}


@pytest.mark.parametrize("told", UNREADABLE)
def test_what_cannot_be_read_is_told_with_its_turn(
    log: Log, door: Setting, told: str
) -> None:
    damaged = edited(log, 2, UNREADABLE[told])
    with pytest.raises(LogError) as caught:
        replay(damaged, door, from_=2)
    assert caught.value.message.startswith(f"{log.file}:3: turn 2: ")
    assert told in caught.value.message


EDITED: dict[str, tuple[Edit, str]] = {
    "the event of a rule": (
        lambda facts: facts["rules"][0].update(event="{e = s9}"),
        "what greeted took",
    ),
    "a binding": (
        lambda facts: facts["rules"][0]["with"].update(x="guest"),
        "what greeted bound",
    ),
    "how probable a fact is": (
        lambda facts: facts["judged"][0].__setitem__(2, 0.5),
        "what was judged",
    ),
    "no fact": (lambda facts: facts.update(judged=[]), "what was judged"),
    "how many names there are": (
        lambda facts: facts.update(names=7),
        "how many names were given",
    ),
}


@pytest.mark.parametrize(("edit", "what"), EDITED.values(), ids=EDITED)
def test_whatever_is_edited_is_told(
    log: Log, door: Setting, edit: Edit, what: str
) -> None:
    divergence = replay(edited(log, 1, edit), door).divergence
    assert divergence is not None
    assert divergence.what == what


@pytest.mark.parametrize("change", [1, None, ["a"]])
def test_a_change_that_is_no_text_is_told(log: Log, change: object) -> None:
    edit: Edit = lambda facts: facts["rules"][0].update(changes=[change])  # noqa: E731
    with pytest.raises(LogError, match="2: changes should be a list of texts"):
        edited(log, 1, edit)


def test_what_is_said_of_a_damaged_log_is_one_line(log: Log, door: Setting) -> None:
    path = Path(log.file)
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace('"ttr"', '"a\\nb"', 1), encoding="utf-8")
    with pytest.raises(LogError) as other:
        read_logs(path)
    assert "\n" not in other.value.message
    path.write_text(text, encoding="utf-8")
    with pytest.raises(LogError) as several:
        replay(edited(log, 1, lambda facts: facts.update(declares=[])), door)
    assert "\n" not in several.value.message


def test_names_that_cannot_be_declared_are_told(log: Log, door: Setting) -> None:
    edit: Edit = lambda it: it.update(declares=["basic"])  # noqa: E731
    with pytest.raises(LogError, match=r"visit.jsonl:1: the names declared here"):
        replay(edited(log, 2, edit), door)


def test_files_that_are_no_logs(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    for content, told in (
        (b"", "is no log"),
        (b"hello\n", "a.jsonl:1: this is no JSON"),
        (b"\xff\xfe\n", "a.jsonl:1: this is no text in UTF-8"),
        (b"[" * 100_000 + b"\n", "a.jsonl:1: this is no JSON"),
        (b"3\n", "a.jsonl:1: no turn of a log"),
    ):
        path.write_bytes(content)
        with pytest.raises(LogError) as caught:
            read_logs(path)
        assert told in str(caught.value)
    with pytest.raises(LogError, match="is a folder"):
        read_logs(tmp_path)


# --- the commands --------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for name in ("door.ttr", "door.dlg"):
        (tmp_path / name).write_bytes((GAMES / name).read_bytes())
    return tmp_path


def test_what_was_played_can_be_replayed_and_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", "--quiet", "door.dlg", "--log", "a.jsonl"]) == 0
    (folder / "sub").mkdir()
    assert main(["replay", "a.jsonl", "--story", "sub/told.dlg"]) == 0
    out = capsys.readouterr().out
    assert "a.jsonl: the door is opened: 2 turns, all the same\n" in out
    assert main(["play", "--quiet", "sub/told.dlg"]) == 0
    assert capsys.readouterr().out == "sub/told.dlg: 5 stories as written\n"
    assert main(["replay", "a.jsonl", "--from", "1"]) == 0
    out = capsys.readouterr().out
    assert "a.jsonl: the door is opened: 2 turns, all the same after turn 1\n" in out
    assert "a.jsonl: less is not: 1 turn, none after turn 1\n" in out


def test_replaying_after_the_rules_have_changed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", "--quiet", "door.dlg", "--log", "a.jsonl"]) == 0
    text = (folder / "door.ttr").read_text()
    (folder / "door.ttr").write_text(text.replace("[GreetBack, Ask]", "[Ask]"))
    assert main(["replay", "a.jsonl"]) == 1
    out = capsys.readouterr().out
    assert "a.jsonl:2: turn 1: which rules ran differs\n" in out
    assert "a.jsonl: the door is opened: differs\n" in out
    (folder / "door.ttr").unlink()
    assert main(["replay", "a.jsonl"]) == 1
    assert capsys.readouterr().out == "a.jsonl:1: there is no file door.ttr\n"


def test_a_log_that_is_not_there_or_damaged(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replay", "gone.jsonl"]) == 2
    assert capsys.readouterr().err == "ttr: there is no file gone.jsonl\n"
    assert main(["replay", "."]) == 2
    assert capsys.readouterr().err == "ttr: . is a folder, not a file\n"
    (folder / "no.jsonl").write_text("hello\n")
    assert main(["replay", "no.jsonl"]) == 1
    assert capsys.readouterr().out == "no.jsonl:1: this is no JSON\n"


@pytest.mark.parametrize("option", ["--story", "--html"])
def test_what_a_replay_cannot_write_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str], option: str
) -> None:
    assert main(["play", "--quiet", "door.dlg", "--log", "a.jsonl"]) == 0
    capsys.readouterr()
    for place in (".", "/", str(folder)):
        assert main(["replay", "a.jsonl", option, place]) == 2
        told = capsys.readouterr().err
        assert told == f"ttr: {place} cannot be written: is a folder\n"
    assert main(["replay", "a.jsonl", option, "no/such/folder"]) == 2
    told = capsys.readouterr().err
    assert told == "ttr: no/such/folder cannot be written: no such file or directory\n"


def test_a_log_of_a_game_without_a_name_is_replayed_from_python(
    folder: Path, door: Setting, capsys: pytest.CaptureFixture[str]
) -> None:
    nameless = replace(door, reference="")
    with LogFile(folder / "a.jsonl") as file:
        file.begin(nameless)
        file.write(visit(door)[0])
    assert main(["replay", "a.jsonl"]) == 1
    assert capsys.readouterr().out.startswith("a.jsonl:1: the log names no game")
    assert replay(read_logs(folder / "a.jsonl")[0], nameless).divergence is None


def test_a_log_that_was_cut_off_is_told_and_replayed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", "--quiet", "door.dlg", "--log", "a.jsonl"]) == 0
    whole = (folder / "a.jsonl").read_bytes()
    (folder / "a.jsonl").write_bytes(whole[: whole.index(b"\n") + 20])
    capsys.readouterr()
    assert main(["replay", "a.jsonl"]) == 1
    assert capsys.readouterr().out.splitlines() == [
        "a.jsonl:2: the log is cut off at once",
        "a.jsonl: the door is opened: 0 turns, all the same",
    ]
