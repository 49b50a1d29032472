"""Rules of one's own that never applied are told: perhaps a label is misspelt."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from kille.lab.dialogues import Played, Turn
from kille.lab.measures.scored_dialogues import ScoredDialogue, score_dialogue
from kille.lab.reports.unused_rules import unused_rules
from kille.lab.study import Run, Theory
from kille.lab.theories.descriptions import describe

RULE = """
rule silent(s : State /\\ [shared : [{label} : AskName]])
    "It says nothing." of admit_name
    := [private : [failed = [] : list(Sign)]]
"""


def dialogues(theory: str, *rules: str) -> list[ScoredDialogue]:
    """Two dialogues of one turn, in which these rules applied."""
    turn = Turn(1, "test", "Ann", "ask_name", "What is this?", "", 3, rules=rules)
    played = Played((turn,), ())
    return [
        score_dialogue(Run(theory, "Ann", "table", it), played, 0.1) for it in (1, 2)
    ]


def told(folder: Path, *rules: str, label: str = "latest") -> list[str]:
    source = files("kille.grammars").joinpath("tutor.ttr").read_text("utf-8")
    (folder / "tutor.ttr").write_text(source, encoding="utf-8")
    own = f'import "tutor.ttr"\n{RULE.format(label=label)}'
    (folder / "own.ttr").write_text(own, encoding="utf-8")
    theory = Theory("mute", rules=str(folder / "own.ttr"))
    return list(
        unused_rules({"mute": describe(theory)}, {"mute": dialogues("mute", *rules)})
    )


def test_a_rule_that_applied_is_not_told(tmp_path: Path) -> None:
    assert told(tmp_path, "hear", "silent") == []


def test_a_rule_that_never_applied_is_told(tmp_path: Path) -> None:
    """A label that no state has is a type like any other, of which no state is."""
    assert told(tmp_path, "hear", "refer", label="lates") == [
        "mute: no dialogue came to its own rule silent: what it waits for may be "
        "misspelt"
    ]


def test_the_games_may_have_rules_that_were_not_needed() -> None:
    usual = {"plain": describe(Theory("plain"))}
    assert list(unused_rules(usual, {"plain": dialogues("plain", "hear")})) == []


def test_nothing_is_told_where_rules_are_not_known() -> None:
    """Of a theory whose files are gone, or of dialogues with a person as the robot."""
    gone = {"gone": {"about": "It cannot be shown."}}
    assert list(unused_rules(gone, {"gone": dialogues("gone", "hear")})) == []
