"""Two robots on the same frames: what differs comes of their theories alone."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from datetime import datetime
from functools import partial
from typing import Any

import pytest

from kille.agent.agent import Agent
from kille.lab.study import Theory
from kille.lab.theories import agent_of
from kille.page.server import Second
from kille.sensors.sensor import Sensor
from kille.sensors.sources import open_sensor

from .pages import Browser, Page, fetch_text, page_of

BOLD = Theory("bold", without=("hedge_name",))
SILENT = Theory("silent", without=("GreetBack to Greet",))


def second_of(theory: Theory, names: tuple[str, str] = ("packaged", "other")) -> Second:
    def make(sensor: Sensor, now: Callable[[], datetime]) -> Agent:
        return agent_of(theory, sensor, now=now)

    return Second(make, names)


@pytest.fixture(scope="module")
def pair() -> Iterator[Page]:
    """A robot, and beside it one that never greets back."""
    sensor = open_sensor("synthetic:empty?seed=7")
    with page_of(sensor, second=second_of(SILENT)) as made:
        yield made


def comparison(page: Page, turn: dict[str, Any]) -> dict[str, Any]:
    first, last = turn["turns"]
    found: dict[str, Any] = json.loads(fetch_text(page, f"/beside/{first}/{last}"))
    return found


def test_both_hear_and_see_the_same_and_learn_it(pair: Page) -> None:
    with pair.connect() as browser:
        assert browser.events == []
        arranged = browser.ask_for("beside", do="show", thing="cup")
        assert arranged["failed"] == ""
        turn = browser.say("This is a cup.")
        beside = browser.until("beside", ref=turn["ref"])
        assert beside["turns"] == turn["turns"]
        assert beside["lessons"] == turn["lessons"]
        assert [it["name"] for it in beside["names"]] == ["cup"]
        mine, other = pair.robot.robot, pair.robot.second
        assert other is not None
        counts = [
            pair.robot.read(lambda _, it=it: it.memory.counts()).result()  # type: ignore[misc]
            for it in (mine, other.robot)
        ]
        assert counts == [{("object", "cup"): 1}] * 2
        looks = [it.view.look for it in (mine, other.robot) if it.view is not None]
        assert looks[0].frame is looks[1].frame
        # A region of one's own is the same to both.
        browser.ask_for("pointed", do="point", box=[100, 100, 200, 180])
        turn = browser.say("This is a plank.")
        beside = browser.until("beside", ref=turn["ref"])
        assert beside["lessons"] == turn["lessons"] != []
        focus = [it.view.look.percepts[0].region.box for it in (mine, other.robot)]
        assert focus[0] == focus[1]


def test_what_differs_is_told_apart(pair: Page) -> None:
    with pair.connect() as browser:
        turn = browser.say("Hello.")
        beside = browser.until("beside", ref=turn["ref"])
        assert (turn["said"], beside["said"]) == ("Hello.", "")
        report = comparison(pair, turn)
        by = {it["name"]: it["by"] for it in report["rules"]}
        assert (by["hear"], by["GreetBack to Greet"]) == ("both", "first")
        shared = report["state"][0]
        apart = {it["name"]: it["html"] for it in shared["fields"]}
        assert "latest" in apart
        assert all("ttr-changed" in html for html in apart["latest"] if html)
        assert "topic" in shared["alike"]


LESSON = (
    "#2 This is a car.",
    "#1 #3 This is to the left of that.",
    "What is this?",
    "That is wrong.",
    "Forget that.",
)


@pytest.mark.parametrize(
    ("scene", "talk"),
    [
        ("empty", ("What is this?", "Gloo bloo.")),
        pytest.param("desk", LESSON, marks=pytest.mark.deep),
    ],
)
def test_with_the_same_theory_nothing_differs(scene: str, talk: tuple[str]) -> None:
    """Whatever the two see, hear and remember is the same."""
    sensor = open_sensor(f"synthetic:{scene}?seed=7")
    second = second_of(Theory("same"))
    with page_of(sensor, second=second) as page, page.connect() as browser:
        for text in talk:
            turn = browser.say(text)
            beside = browser.until("beside", ref=turn["ref"])
            assert (beside["said"], beside["failed"]) == (turn["said"], "")
            assert beside["lessons"] == turn["lessons"]
            report = comparison(page, turn)
            assert {it["by"] for it in report["rules"]} <= {"both"}
            assert [it["fields"] for it in report["state"] if it["fields"]] == []
        browser.ask_for("beside", do="restart")
        turn = browser.say("What is this?")
        assert browser.until("beside", ref=turn["ref"])["said"] == turn["said"]


def test_what_the_second_cannot_do_is_its_own_trouble() -> None:
    """Its rules are anybody's, and may raise anything."""

    def make(sensor: Sensor, now: Callable[[], datetime]) -> Agent:
        robot = Agent(sensor, now=now)
        robot.hear = partial(fail)  # type: ignore[method-assign]
        return robot

    def fail(text: str) -> str:
        raise ZeroDivisionError(f"not a theory of {text}")

    sensor = open_sensor("synthetic:desk?seed=7")
    second = Second(make, ("packaged", "broken"))
    with page_of(sensor, second=second) as page, page.connect() as browser:
        turn = browser.say("Hello.")
        assert turn["said"] == "Hello."
        beside = browser.until("beside", ref=turn["ref"])
        assert beside["failed"] == "not a theory of Hello."
        assert browser.say("Thank you.")["said"]


def test_without_a_second_robot_there_is_nothing_beside(page: Page) -> None:
    assert fetch_text(page, "/beside/0/1") == b""
    with Browser.connect(f"http://{page.host}") as browser:
        assert browser.next()["theories"] == []


def test_a_robot_of_another_theory_waits_before_each_rule_too() -> None:
    sensor = open_sensor("synthetic:desk?seed=7")
    make = partial(agent_of, BOLD)

    def made(sensor: Sensor, memory: object, **settings: Any) -> Agent:
        return make(sensor, memory=memory, **settings)

    with page_of(sensor, make=made) as page, page.connect() as browser:
        browser.ask(do="stepping", on=True)
        browser.until("stepping", on=True)
        browser.ask(do="say", text="Hello.", ref="1")
        assert browser.until("step")["rule"] == "hear"
        browser.ask(do="step", rest=True)
        assert browser.until("turn", ref="1")["said"] == "Hello."
