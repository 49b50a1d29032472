"""How lines are wrapped, and what is told of a turn."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille import Agent
from kille.agent.attention import AttentiveSensor
from kille.interfaces.formatting import ACCOUNTS, claims, derivation, things_in_view
from kille.interfaces.terminal import hang_text, hanging_type

WIDTH = 100

WORDS = st.lists(st.from_regex(r"[a-z]{1,12},?", fullmatch=True), min_size=1)


@given(WORDS)
def test_wrapping_keeps_every_word_and_the_width(words: list[str]) -> None:
    lines = hang_text("S> ", " ".join(words)).splitlines()
    assert lines[0].startswith("S> ")
    assert all(line.startswith("   ") for line in lines[1:])
    assert all(len(line) <= WIDTH for line in lines)
    assert " ".join(line[3:] for line in lines).split() == words


def test_a_type_is_broken_only_between_its_parts() -> None:
    T = "[" + ", ".join(f"label{n} : relation(x, landmark)" for n in range(9)) + "]"
    first, *others = hanging_type("about  ", T).splitlines()
    assert others
    assert first.endswith(",")
    assert all(line.endswith((",", "]")) for line in others)
    assert " ".join([first[7:], *(line[7:] for line in others)]) == T


def test_a_terminal_says_how_wide_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    monkeypatch.setenv("COLUMNS", "44")
    lines = hang_text("", "so many words " * 20).splitlines()
    assert max(map(len, lines)) <= 44


def test_claims_are_what_was_heard_judged_and_said() -> None:
    with Agent("synthetic:empty?seed=3", scans=1) as robot:
        robot.do("show cup")
        robot.hear("This is a cup.")
        robot.hear("What is this?")
        turn = robot.exchanges[-1]
        kinds = [kind for kind, _ in claims(turn)]
        assert kinds == ["heard", "about", "judged", "said", "about"]
        told = dict(claims(turn))
        assert told["heard"].endswith(" : ask_name(tutor, robot)")
        assert ": cup(o1, look" in told["judged"]
        assert list(ACCOUNTS["none"](turn)) == []


def test_a_derivation_names_each_rule_that_ran() -> None:
    with Agent("synthetic:empty?seed=3", scans=1) as robot:
        robot.hear("This is a cup.")
        turn = robot.exchanges[-1]
        rules = [text for kind, text in derivation(turn) if kind == "rule"]
        assert [rule.partition(":")[0] for rule in rules] == [
            step.rule.name for step in turn.steps
        ]
        robot.hear("Blah.")
        assert list(derivation(robot.exchanges[-1])) == []


def test_things_in_view_have_numbers_and_places() -> None:
    gaze = AttentiveSensor("synthetic:empty?seed=3", scans=1)
    assert things_in_view(gaze.look()) == "Nothing is in view."
    gaze.change("place car at 0 -0.15")
    gaze.change("place book at -0.25 0.12")
    head, first, second = things_in_view(gaze.look()).splitlines()
    assert head == "2 things are in view:"
    assert first.startswith("  #1  ")
    assert first.endswith("straight ahead  ← this")
    assert second.startswith("  #2  ")
    assert second.endswith("cm to the left")
    gaze.point("2")
    gaze.point("that 1")
    _, first, second = things_in_view(gaze.look()).splitlines()
    assert first.endswith("  ← that")
    assert second.endswith("  ← this")
