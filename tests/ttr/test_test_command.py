"""The command `ttr test`: what it plays, what it tells, and how it ends."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from ttr.cli.commands.test import _bar
from ttr.cli.main import main

GOOD = """
    basic Word
    object hi, ho : Word
    pred say(Word)
    Words  := list(Word)
    Board  := [facts : Words]
    Saying := [w : Word, e : say(w)]
    rule note(s : Board, e : Saying) := [facts = [e.w] + s.facts : Words]
    game talk({facts = []} : Board) := note
"""
FORGETFUL = GOOD.replace("[e.w] + s.facts", "[e.w]").replace("talk", "forget")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.ttr").write_text(GOOD)
    (tmp_path / "bad.ttr").write_text(FORGETFUL)
    (tmp_path / "none.ttr").write_text("basic Word\n")
    both = GOOD + FORGETFUL[FORGETFUL.index("rule") :].replace("note", "only")
    (tmp_path / "both.ttr").write_text(both)
    (tmp_path / "beside.py").write_text(
        "import ttr\n"
        "from ttr.testing import Roles, Tutor\n"
        "game = ttr.load('good.ttr').games['talk']\n"
        "forget = ttr.load('bad.ttr').games['forget']\n"
        "roles = Roles()\n"
        "tutor = Tutor(silent=1, answers=0, wanders=0, contradicts=0, repeats=0)\n"
    )
    return tmp_path


def test_what_holds_is_told_with_what_was_covered(capsys):
    assert main(["test", "good.ttr", "--examples", "20"]) == 0
    printed = capsys.readouterr().out
    assert "note      " in printed
    assert "1 of 1 rules applied" in printed
    assert "not checked: P8, P9, P26 (no qud)" in printed
    assert "talk: holds, 20 dialogues in " in printed


def test_a_rule_that_never_applied_is_told_whatever_else_is(capsys, folder):
    dead = """
    Five := [facts = [hi, hi, ho, ho, hi] : Words]
    rule rest(s : Board /\\ Five, e : Saying) := [facts = [e.w] : Words]
    game talk({facts = []} : Board) := first(rest, note)
"""
    for name, text in (("dead", GOOD), ("both", FORGETFUL)):
        rules = text[: text.index("    game")]
        (folder / f"{name}.ttr").write_text(rules + dead)
    assert main(["test", "dead.ttr", "--examples", "5"]) == 0
    printed = capsys.readouterr().out
    assert "P26 (no qud)" in printed
    assert " of 5,000 turns); never applied: rest\n" in printed
    assert "talk: holds, but rest was never applied, 5 dialogues in " in printed
    assert main(["test", "both.ttr", "--examples", "30"]) == 1
    printed = capsys.readouterr().out
    assert printed.startswith("P10 commitments stay: ")
    assert "P6 (" in printed
    assert "never applied: rest\n" in printed
    assert main(["test", "both.ttr", "--examples", "30", "--json"]) == 1
    (facts,) = json.loads(capsys.readouterr().out)
    assert "P6" in facts["not_checked"]


def test_what_breaks_is_told_as_a_story_that_can_be_played(capsys, folder):
    assert main(["test", "bad.ttr", "--examples", "50"]) == 1
    printed = capsys.readouterr().out
    assert printed.startswith("P10 commitments stay: ")
    assert "forget: breaks" in printed
    story = printed[printed.index("--- P10") :].split("\n\n")[0]
    assert story == (
        "--- P10 commitments stay\n@ game bad.ttr forget\nU> Saying\nU> Saying"
    )
    (folder / "found.dlg").write_text(f"{story}\n")
    assert main(["play", "found.dlg"]) == 0


def test_the_report_for_machines(capsys):
    assert main(["test", "both.ttr", "--examples", "30", "--json"]) == 1
    talk, forget = json.loads(capsys.readouterr().out)
    assert (talk["game"], talk["holds"], talk["broken"]) == ("talk", True, None)
    assert talk["coverage"]["rules"]["note"] > 50
    assert talk["coverage"]["dialogues"] == 30
    assert talk["not_checked"] == ["P8", "P9", "P23", "P24", "P16", "P26"]
    assert talk["roles"] == {"commitments": "facts"}
    assert forget["holds"] is False
    assert forget["broken"]["property"] == "P10"
    assert forget["broken"]["turn"] == 2
    assert "U> Saying" in forget["broken"]["story"]


def test_one_game_of_a_file(capsys):
    assert main(["test", "both.ttr", "--game", "talk", "--examples", "5"]) == 0
    assert "forget" not in capsys.readouterr().out


def test_the_tutor_and_the_roles_beside_a_game_in_python(capsys):
    assert main(["test", "beside.py:forget", "--examples", "5"]) == 0
    printed = capsys.readouterr().out
    assert "0 of 1 rules applied" in printed  # the tutor is silent
    assert "P10, P22 (no commitments)" in printed


def test_dialogues_begin_where_the_starts_beside_a_game_say(capsys, folder):
    (folder / "begun.py").write_text(
        "import ttr\n"
        "from hypothesis import strategies as st\n"
        "game = ttr.load('bad.ttr').games['forget']\n"
        "starts = st.just((ttr.record(facts=['hi']), game.model))\n"
    )
    assert main(["test", "begun.py:game", "--examples", "20"]) == 1
    printed = capsys.readouterr().out
    assert "turn 1: " in printed
    assert "@ start {facts = [hi]}" in printed


def test_the_same_seed_tells_the_same(capsys):
    def told(seed):
        main(["test", "good.ttr", "--examples", "20", "--seed", seed, "--json"])
        (facts,) = json.loads(capsys.readouterr().out)
        return facts["coverage"]

    assert told("1") == told("1")
    assert told("1") != told("2")


@pytest.mark.parametrize(
    ("rules", "told"),
    [
        (["missing.ttr"], "there is no file missing.ttr"),
        (["none.ttr"], "none.ttr has no game"),
        (["good.ttr", "--game", "tlak"], "did you mean talk?"),
        (["beside.py:gaem"], "did you mean game?"),
        (["nowhere:game"], "there is no module nowhere: name a game as FILE.ttr NAME"),
        (["talk.dlg"], "there is no module talk.dlg: name a game as FILE.ttr NAME"),
    ],
)
def test_what_is_not_there_is_told_in_a_line(rules, told, capsys):
    assert main(["test", *rules]) == 2
    printed = capsys.readouterr()
    assert told in printed.err
    assert printed.out == ""
    assert "Traceback" not in printed.err


def test_that_hypothesis_is_not_there_is_told_in_a_line(monkeypatch, capsys):
    for name in list(sys.modules):
        if name.startswith(("hypothesis", "ttr.testing", "ttr.testing.strategies")):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "hypothesis", None)
    assert main(["test", "good.ttr"]) == 2
    told = "ttr: ttr.testing needs hypothesis: pip install 'kille[test]'\n"
    assert capsys.readouterr().err == told


@pytest.mark.parametrize("count", ["0", "-1", "many"])
def test_a_count_is_a_number(count, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["test", "good.ttr", "--examples", count])
    assert stopped.value.code == 2
    assert "expected" in capsys.readouterr().err


def test_rules_that_depend_on_the_order_of_sets_differ_between_processes(
    capsys, folder
):
    (folder / "hasty.py").write_text(
        "from ttr import Basic, ListOf, Model, rectype, record, replace\n"
        "from ttr.updates import Game, rule\n"
        "Word = Basic('Word')\n"
        "Board = rectype(heard=ListOf(Word))\n"
        "M = Model()\n"
        "for name in 'abcdefgh':\n"
        "    M = M.given(name, Word)\n"
        "@rule(when=Board, on=Word)\n"
        "def note(s, e):\n"
        "    return replace(s, heard=list({*s.heard, e}))\n"
        "game = Game('hasty', Board, record(heard=[]), note, M)\n"
    )
    assert main(["test", "hasty.py", "--examples", "20"]) == 1
    printed = capsys.readouterr().out
    assert "P3 determinism" in printed
    assert "differs in a process with another hash seed" in printed


@pytest.mark.skipif(os.name == "nt", reason="there are no such signals")
def test_ctrl_c_tells_what_was_covered_so_far(folder):
    command = [sys.executable, "-m", "ttr.cli.main", "test", "good.ttr"]
    process = subprocess.Popen(
        [*command, "--examples", "100000"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(6)
    process.send_signal(signal.SIGINT)
    printed, complained = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "talk: stopped after " in printed
    assert "rules applied" in printed
    assert complained == ""


def test_the_bar_is_as_long_as_it_is_far():
    assert _bar(0, 10).startswith("░" * 30)
    assert _bar(5, 10) == "█" * 15 + "░" * 15 + " 5 of 10 dialogues"
    assert _bar(12, 10).startswith("█" * 30)


ROUND = """
    basic Ind
    object a : Ind
    pred ask(Ind), reply(Ind)
    Ask   := [e : ask(a)]
    Reply := [e : reply(a)]
    Moves := list(RecType)
    Board := [wishes : Moves]
    rule asked(s : Board, e : Ask) := [wishes = [Reply] : Moves]
    rule replied(s : Board, e : Reply) := [wishes = [Ask] : Moves]
    game round({wishes = []} : Board, acts on wishes, hears Ask)
        := first(asked, replied)
"""


def test_an_agenda_that_goes_round_is_told_with_its_rules(capsys, folder):
    (folder / "round.ttr").write_text(ROUND)
    assert main(["test", "round.ttr", "--examples", "5"]) == 1
    printed = capsys.readouterr().out
    assert "not empty after 100 moves in a turn: replied → asked → …" in printed
    assert "asked         51  replied 50" in printed  # the turn that fails counts


def test_what_plays_a_role_is_told_and_can_be_declared(capsys, folder):
    text = GOOD.replace("facts", "words")
    (folder / "words.ttr").write_text(text.replace("[e.w] + s.words", "[e.w]"))
    assert main(["test", "words.ttr", "--examples", "20"]) == 0
    assert "taken:" not in capsys.readouterr().out
    declared = ["test", "words.ttr", "--examples", "20", "--role", "commitments=words"]
    assert main(declared) == 1
    printed = capsys.readouterr().out
    assert printed.startswith("P10 commitments stay")
    assert "taken: words as commitments; to change it: --role ROLE=PATH" in printed
    assert main([*declared, "--role", "retracts=note"]) == 0


def test_a_role_can_be_taken_from_a_field(capsys):
    assert main(["test", "bad.ttr", "--examples", "20", "--role", "commitments="]) == 0
    assert "P10, P22 (no commitments)" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("role", "told"),
    [
        ("king=facts", "a role is one of qud, commitments, "),
        ("qud=fatcs", "did you mean facts?"),
    ],
)
def test_a_role_that_is_none_is_told_in_a_line(role, told, capsys):
    assert main(["test", "good.ttr", "--role", role]) == 2
    assert told in capsys.readouterr().err
