"""The page over its WebSocket: events with numbers, pictures, and several browsers."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event, Lock
from typing import Any

import cv2
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed

from kille.agent.agent import Agent
from kille.interfaces.cli import main
from kille.page.app import BROWSERS, UNDER_WAY
from kille.page.browser_requests import MESSAGE, parse_request
from kille.page.history import History
from kille.page.robot_thread import READING, WAITING, BusyError, Watch
from kille.page.state_changes import PLAIN
from kille.page.stepping import Stepper
from kille.scene import Frame
from kille.sensors.sensor import At, SensorError, Stage
from kille.sensors.sources import open_sensor
from ttr.escapes import terminal_text

from .pages import Page, fetch_text, fresh_ref, page_of

HOSTILE = [
    "<img src=x onerror=alert(1)>",
    "</script><script>alert(1)</script>",
    "\x1b[2J\x07 \u202egnihtyna\u2066",
    "\ud800 half a pair",
    "{{constructor.constructor('x')()}} ${x} %s",
    "#1 #2 #999999 @ show cup",
    "a" * 3_000,
]


@pytest.fixture
def taught(page: Page) -> Page:
    """A page on which a cup has been shown."""
    with page.connect() as browser:
        browser.ask_for("view", do="show", thing="cup")
    return page


def changed(turn: dict[str, Any]) -> list[tuple[bool, bool, str]]:
    """The lessons of a turn: learned or taken back, for or against which word."""
    return [(it["learned"], it["holds"], it["phrase"]) for it in turn["lessons"]]


def test_a_lesson_is_heard_answered_and_seen(taught: Page) -> None:
    with taught.connect() as browser:
        hello = browser.next()
        assert hello["type"] == "hello"
        assert hello["sensor"] == "synthetic:empty?seed=7"
        assert "cup" in hello["table"]["things"]
        assert browser.ask_for("pointed", do="point", thing=1)["thing"] == 1
        heard = browser.ask_for("heard", do="say", text="This  is a cup.")
        assert heard["says"] == "This is a cup."
        turn = browser.until("turn", ref=heard["ref"])
        assert turn["said"].startswith("OK, ")
        assert changed(turn) == [(True, True, "a cup")]
        assert (turn["thing"], turn["words"], turn["undo"]) == (1, 1, "Forget that.")
        (thing,) = browser.until("view", ref=heard["ref"])["things"]
        assert (thing["number"], thing["name"]) == (1, "cup")
        assert thing["names"][0] == {"word": "cup", "degree": 1.0}
        assert len(thing["outline"]) > 3
        asked = browser.say("What is this?")
        assert [it["says"] for it in asked["answers"]] == [
            "That is correct.",
            "That is wrong.",
        ]
        assert browser.say(asked["why"])["said"].startswith("Because")
        later = browser.say("Hello.")
        assert (later["undo"], later["undo_last"]) == ("", "Forget the last thing.")
        undone = browser.say(later["undo_last"])
        assert changed(undone) == [(False, True, "a cup")]
        denied = browser.say("This is not a cup.")
        assert changed(denied) == [(True, False, "a cup")]
        assert changed(browser.say(denied["undo"])) == [(False, False, "a cup")]


def test_a_question_which_one_has_an_answer_for_each_thing(page: Page) -> None:
    with page.connect() as browser:
        browser.ask(do="show", thing="cup")
        browser.ask(do="place", thing="cup", right=-0.15, away=0)
        browser.ask(do="place", thing="book", right=0.15, away=0.1)
        apple = {"thing": "apple", "right": 0, "away": -0.15, "turn": 30}
        assert len(browser.ask_for("view", do="place", **apple)["things"]) == 3
        turn = browser.say("This is a cup.")
        view = browser.events[-1]
        names = {it["number"]: it["name"] for it in view["things"]}
        assert {it["thing"]: it["name"] for it in turn["answers"]} == names
        meant = turn["answers"][1]
        last = browser.say(meant["says"])
        assert (last["thing"], last["answers"]) == (meant["thing"], [])
        doubt = browser.say("This is sugar.")
        assert [it["says"] for it in doubt["answers"]] == ["Yes.", "No."]
        browser.say("No.")


def test_a_second_thing_is_that(page: Page) -> None:
    with page.connect() as browser:
        browser.ask(do="show", thing="cup")
        book = {"thing": "book", "right": 0.2, "away": 0.1}
        assert len(browser.ask_for("view", do="place", **book)["things"]) == 2
        browser.ask(do="point", thing=2)
        second = {"do": "point", "as": "that"}
        assert browser.ask_for("pointed", thing=1, **second)["as"] == "that"
        assert browser.say("That is a mug.")["thing"] == 1
        browser.ask(do="point", thing=2)
        assert "already" in browser.ask_for("failed", thing=2, **second)["text"]


def test_the_table_is_arranged_by_hand(page: Page) -> None:
    with page.connect() as browser:
        browser.ask(do="show", thing="cup")
        browser.ask(do="place", thing="cup", right=-0.1, away=-0.1)
        (cup, book) = browser.ask_for("table", do="add", thing="book")["plan"]["placed"]
        assert (cup["name"], book["name"]) == ("cup", "book")
        assert len(book["outline"]) >= 3
        spot = {"do": "place", "thing": "book", "away": 0.1, "turn": 90}
        moved = browser.ask_for("table", **spot, right=0.3)["plan"]["placed"][1]
        assert [moved[it] for it in ("right", "away", "turn")] == [0.3, 0.1, 90.0]
        off = browser.ask_for("failed", **spot, right=9)
        assert "would not stand" in off["text"]
        again = browser.until("table", ref=off["ref"])["plan"]["placed"][1]
        assert again == moved
        gone = browser.ask_for("view", do="remove", thing="book")
        assert len(gone["things"]) == 1
        assert len(browser.until("table", ref=gone["ref"])["plan"]["placed"]) == 1


def test_a_recording_is_wound(tmp_path: Path) -> None:
    assert main(["record", str(tmp_path / "lesson"), "--frames", "30"]) == 0
    with (
        page_of(open_sensor(str(tmp_path / "lesson"))) as page,
        page.connect(after=0) as browser,
    ):
        hello = browser.next()
        length = hello["table"]["recording"]["length"]
        assert length > 0.5
        at = browser.ask_for("table", do="seek", at=length / 2)["recording"]["at"]
        assert length / 2 <= at <= length
        beyond = browser.ask_for("failed", do="seek", at=length + 1)
        assert "from 0 to" in beyond["text"]


def test_a_turn_can_be_looked_into_and_saved(taught: Page) -> None:
    with taught.connect() as browser:
        first, last = browser.say("What is this?")["turns"]
    span = f"{first}/{last}"
    inside = json.loads(fetch_text(taught, f"/inside/{span}"))
    rules = [text for kind, text in inside["lines"] if kind == "rule"]
    assert len(rules) == len(inside["steps"]) > 2
    assert any("shared" in it["when"] for it in inside["steps"])
    (event, *_) = unfired = json.loads(fetch_text(taught, f"/unfired/{span}"))["events"]
    assert event["others"] > 0
    fired = {name for it in unfired for name in it["fired"]}
    reasons = {it["why"]: it["rules"] for seen in unfired for it in seen["reasons"]}
    assert {"found nothing"} < reasons.keys()
    assert any(": ask_place(tutor, robot)" in why for why in reasons)
    assert fired <= {it.name for it in taught.robot.robot.game.rules}
    picture = cv2.imdecode(
        np.frombuffer(fetch_text(taught, f"/picture/{first}.jpg"), "u1"), 1
    )
    assert picture is not None
    assert picture.shape == (480, 640, 3)
    story = fetch_text(taught, f"/export/{span}/dlg").decode()
    assert "\nU> What is this?\nS> " in story
    assert (
        story in fetch_text(taught, "/export/dlg").decode() or "@ show cup" not in story
    )
    assert "@ show cup" in fetch_text(taught, "/export/dlg").decode()
    assert "rule  hear" in fetch_text(taught, f"/export/{span}/log").decode()
    assert "\\mathrm{shared}" in fetch_text(taught, f"/export/{span}/tex").decode()
    for missing in (
        "/inside/5/5",
        "/unfired/0/99",
        "/picture/9999.jpg",
        f"/export/{span}/exe",
        "/inside/9998/9999",
    ):
        assert fetch_text(taught, missing) == b""


def test_words_are_on_the_shelf_with_what_they_were_learned_from(page: Page) -> None:
    with page.connect() as browser:
        browser.ask(do="show", thing="cup")
        browser.ask_for("view", do="place", thing="book", right=0.2, away=0.1)
        browser.say("#1 This is a beaker.")
        browser.say("#2 This is not a beaker.")
        browser.say("#1 #2 This is to the left of that.")
    shelf = json.loads(fetch_text(page, "/words/0"))
    words = {it["form"]: it for it in shelf["words"]}
    assert words["beaker"]["lessons"] == 1
    beaker = json.loads(fetch_text(page, "/word/object/beaker"))
    assert [it["holds"] for it in beaker["examples"]] == [False, True]
    assert beaker["curve"]["for"][-1] == beaker["curve"]["against"][-1] == 1
    example = fetch_text(page, f"/example/{beaker['examples'][0]['key']}")
    assert cv2.imdecode(np.frombuffer(example, np.uint8), 1) is not None
    right = json.loads(fetch_text(page, "/hindsight/beaker"))
    assert (len(right), right[0]) == (2, False)  # it did not know the word before
    left = json.loads(fetch_text(page, "/word/relation/to_the_left_of"))["template"]
    middle = left[len(left) // 2]
    assert middle[2] > 0.3 > middle[-3]
    assert json.loads(fetch_text(page, "/words/9999"))["words"] == []
    for missing in (
        "/word/object/none",
        "/word/x/y",
        "/example/9999",
        f"/example/{9**30}",
    ):
        assert fetch_text(page, missing) == b""


def test_a_turn_waits_before_each_rule_until_it_may_go_on(page: Page) -> None:
    with page.connect() as one, page.connect() as other:
        one.ask(do="stepping", on=True)
        assert other.until("stepping")["on"] is True
        slow, closed = fresh_ref(), fresh_ref()
        one.ask(do="say", text="Hello.", ref=slow)
        first = other.until("step")
        assert (first["rule"], bool(first["does"])) == ("hear", True)
        other.ask(do="step")
        second = one.until("step", rule="GreetBack to Greet")
        assert any("agenda" in it for it in second["changes"])
        one.ask(do="step", rest=True)
        assert "Hello" in one.until("turn", ref=slow)["said"]
        one.ask(do="say", text="Thank you.", ref=closed)
        one.until("step")
        other.ask(do="stepping", on=False)
        assert one.until("turn", ref=closed)["said"]
        assert one.say("Hello.")["said"]
        assert one.events[-3]["type"] == "heard"


def test_a_turn_does_not_wait_for_ever() -> None:
    told: list[dict[str, object]] = []
    stepper = Stepper(told.append, PLAIN, patience=0.0)
    stepper.ask("on")
    with Agent("synthetic:empty?seed=7", change=Watch(print, stepper).change) as robot:
        assert robot.hear("Hello.") == "Hello."
    assert [it["type"] for it in told] == ["stepping", "step", "stepping"]
    assert told[-1]["on"] is False
    assert stepper.waited > 0  # which is no time that the robot took


def test_what_is_not_understood_leaves_the_state_as_it_was(page: Page) -> None:
    with page.connect() as browser:
        browser.say("Hello.")
        turn = browser.say("<b>bold</b> x")
    first, last = turn["turns"]
    inside = json.loads(fetch_text(page, f"/inside/{first}/{last}"))
    assert inside["lines"] == inside["steps"] == []
    fields = [it for part in inside["state"] for it in part["fields"]]
    assert fields
    assert not any(it["changed"] for it in fields)


def test_only_the_latest_pictures_are_kept() -> None:
    history = History(pictures=2)
    frames = [np.full((4, 4, 3), n, np.uint8) for n in (10, 20, 20)]
    for turn, colour in enumerate(frames):
        history.keep_picture(turn, colour)
    assert history.picture(0) is None
    assert history.picture(1) == history.picture(2)


def test_what_was_missed_is_told_to_who_comes_back(page: Page) -> None:
    with page.connect() as browser:
        run = browser.next()["run"]
        browser.say("Hello.")
        last = browser.events[-1]["id"]
    with page.connect() as other:
        other.say("Thank you.")
    with page.connect(run=run, after=last) as again:
        assert again.next()["after"] == last
        newest = page.feed.last
        numbers = [again.next()["id"] for _ in range(newest - last)]
    assert numbers == [*range(last + 1, newest + 1)]


@pytest.mark.parametrize(
    ("run", "after"), [("", 3), ("another", 3), ("same", 99_999), ("same", -1)]
)
def test_who_has_another_run_begins_anew(page: Page, run: str, after: int) -> None:
    with page.connect() as other:
        other.say("Hello.")
    with page.connect(run=page.feed.run if run == "same" else run, after=after) as it:
        assert it.next()["after"] == 0
        assert it.next()["id"] == page.feed.first


def test_two_browsers_see_the_same_dialogue(page: Page) -> None:
    with page.connect() as one, page.connect() as other:
        one.say("Hello.")
        thanks = other.say("Thank you.")
        one.until("view", ref=thanks["ref"])
        heard = [[it for it in who.events if "id" in it] for who in (one, other)]
    turns = [it["heard"] for it in heard[0] if it["type"] == "turn"]
    assert turns == ["Hello.", "Thank you."]
    assert heard[0] == heard[1]


def test_pictures_come_as_fast_as_they_are_drawn(page: Page) -> None:
    with page.connect() as browser:
        numbers = []
        while len(numbers) < 5:
            message = browser.socket.recv(timeout=60)
            if isinstance(message, bytes):
                numbers.append(struct.unpack(">I", message[:4])[0])
                picture = cv2.imdecode(np.frombuffer(message[4:], np.uint8), 1)
                assert picture is not None
                assert picture.shape == (480, 640, 3)
                browser.ask(do="shown")
    assert numbers == sorted(set(numbers))


def test_who_draws_no_pictures_is_sent_no_more_and_delays_nobody(page: Page) -> None:
    with page.connect() as slow, page.connect() as quick:
        hello = quick.say("Hello.")
        for _ in quick.pictures:
            quick.ask(do="shown")
        for _ in range(20):
            while not isinstance(quick.socket.recv(timeout=60), bytes):
                pass
            quick.ask(do="shown")
        slow.until("turn", ref=hello["ref"])
        slow.ask_for("turn", do="look")
        assert len(slow.pictures) <= UNDER_WAY


def test_who_does_not_look_is_sent_no_pictures(page: Page) -> None:
    with page.connect() as browser:
        browser.ask(do="watch", on=False)
        browser.say("Hello.")
        so_far = len(browser.pictures)
        for _ in range(3):
            browser.ask(do="shown")
        browser.say("Thank you.")
        assert len(browser.pictures) == so_far


def test_a_new_dialogue_is_told_to_all(page: Page) -> None:
    with page.connect() as one, page.connect() as other:
        one.say("Hello.")
        anew = other.ask_for("restarted", do="restart")
        one.until("restarted", ref=anew["ref"])
        one.until("view", ref=anew["ref"])
        assert one.say("What did you say?")["said"]


@pytest.mark.parametrize("words", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_words_are_words(page: Page, words: str) -> None:
    with page.connect() as browser:
        ref = fresh_ref()
        browser.ask(do="say", text=words, ref=ref)
        while browser.next()["type"] not in ("turn", "failed", "refused"):
            pass
        answered = browser.events[-1]
        assert answered["ref"] == ref
        heard = [it["says"] for it in browser.events if it["type"] == "heard"]
        for shown in (*heard, answered.get("heard", "")):
            assert terminal_text(shown) == shown  # all that can be seen, and no more
        browser.say("Hello.")


@pytest.mark.parametrize(
    ("message", "why"),
    [
        ("no JSON", "one JSON object"),
        ("[" * 10_000, "one JSON object"),
        ("[1]", "one JSON object"),
        ('{"do": "dance"}', "no `do`"),
        ('{"do": "say"}', "has a `text`"),
        (json.dumps({"do": "say", "text": "a" * 10_001}), "too long"),
        ('{"do": "point", "thing": 0}', "from 1"),
        ('{"do": "point", "box": [5, 5, 1, 1]}', "left, top"),
        ('{"do": "place", "thing": "cup", "right": NaN}', "from -10"),
        ('{"do": "place", "thing": "cup", "away": -Infinity}', "from -10"),
        ('{"do": "point", "thing": 1' + 400 * "0" + "}", "from 1"),
        ('{"do": "show", "thing": 3}', "names a `thing`"),
        (b'{"do": "look"}', "sound of the microphone"),
    ],
)
def test_what_cannot_be_asked_is_refused(
    page: Page, message: str | bytes, why: str
) -> None:
    with page.connect() as browser:
        browser.socket.send(message)
        assert why in browser.until("refused")["text"]
        assert browser.say("Hello.")["said"]


@pytest.mark.parametrize("name", ["/etc/passwd", "../x.obj", "~/cup.obj", "unicorn"])
def test_a_browser_names_no_files(page: Page, name: str) -> None:
    with page.connect() as browser:
        failed = browser.ask_for("failed", do="show", thing=name)
        assert "there is no" in failed["text"]


def test_a_message_that_is_too_large_ends_the_connection(page: Page) -> None:
    with page.connect() as browser:
        browser.socket.send("x" * (MESSAGE + 1))
        with pytest.raises(ConnectionClosed) as ended:
            browser.until("never")
        assert ended.value.rcvd is not None
        assert ended.value.rcvd.code == 1009


def test_more_browsers_than_fit_are_sent_away(page: Page) -> None:
    browsers = [page.connect() for _ in range(BROWSERS)]
    try:
        for it in browsers:
            it.next()
        with page.connect() as one_more, pytest.raises(ConnectionClosed) as ended:
            one_more.next()
        assert ended.value.rcvd is not None
        assert ended.value.rcvd.code == 1013
    finally:
        for it in browsers:
            it.close()


def test_more_requests_than_can_wait_are_refused(page: Page) -> None:
    going = Event()
    stopped = parse_request({"do": "look"})._replace(act=lambda _: str(going.wait(60)))

    refs = [fresh_ref() for _ in range(WAITING + 1)]

    def ask_too_often() -> None:
        for ref in refs:
            page.robot.ask(stopped._replace(ref=ref))

    with page.connect() as browser:
        try:
            with pytest.raises(BusyError, match="too much waits"):
                ask_too_often()
        finally:
            going.set()
        for ref in refs[:WAITING]:
            browser.until("view", ref=ref)
        browser.say("Hello.")


def test_who_looks_inside_keeps_nobody_waiting_who_speaks(page: Page) -> None:
    going, order = Event(), list[str]()

    def ask_to(act: Callable[[Agent], str]) -> None:
        request = parse_request({"do": "look", "ref": fresh_ref()})
        page.robot.ask(request._replace(act=act))

    try:
        ask_to(lambda _: str(going.wait(60)))
        reads = [
            page.robot.read(lambda _: order.append("read")) for _ in range(READING)
        ]
        with pytest.raises(BusyError, match="too many look inside"):
            page.robot.read(lambda _: None)
        assert "503" in fetch_text(page, "/words/0").decode()
        ask_to(lambda _: order.append("asked") or "")
    finally:
        going.set()
    for it in reads:
        it.result(60)
    assert order == ["asked", *["read"] * READING]


class Unplugged:
    """A camera that can be unplugged, and plugged in again."""

    name = "kinect:test"

    def __init__(self) -> None:
        self._inner = open_sensor("synthetic:desk?seed=7")
        self.gone = False

    def frame(self) -> Frame:
        if self.gone:
            raise SensorError("the Kinect is gone: plug it in again")
        return self._inner.frame()

    def close(self) -> None:
        self._inner.close()


class OwnTable:
    """A camera before a table on which somebody puts things."""

    name = "kinect:test"

    def __init__(self) -> None:
        self.stage = open_sensor("synthetic:empty?seed=7")
        self._lock = Lock()

    def frame(self) -> Frame:
        with self._lock:
            return self.stage.frame()

    def put(self, thing: str, right: float) -> None:
        assert isinstance(self.stage, Stage)
        with self._lock:
            self.stage.place(thing, At(right, 0.0, 0.0))

    def close(self) -> None:
        self.stage.close()


def test_outlines_follow_what_comes_and_goes_between_turns() -> None:
    sensor = OwnTable()
    with page_of(sensor) as page, page.connect() as browser:
        browser.draws = True
        assert browser.ask_for("view", do="look")["things"] == []
        sensor.put("cup", 0.1)
        (cup,) = browser.until("view", glimpsed=True)["things"]
        browser.ask_for("pointed", do="point", thing=cup["number"])
        sensor.put("book", -0.1)
        while len((view := browser.until("view", glimpsed=True))["things"]) < 2:
            pass
        assert view["focus"] == cup["number"]
        # What was pointed at before the glimpse is still "this".
        assert page.robot.read(lambda it: it.gaze.attention.anew).result(60)
        assert "a cup" in browser.say("This is a cup.")["said"]
        # It is no turn: whoever comes back has the turns, and the latest view.
        kinds = [(it["type"], it.get("glimpsed")) for it in page.feed.after(0)]
        assert kinds.count(("turn", None)) == 2


@pytest.fixture
def camera() -> Iterator[tuple[Unplugged, Page]]:
    sensor = Unplugged()
    with page_of(sensor) as made:
        yield sensor, made


def test_a_camera_that_goes_is_told_and_so_is_its_return(
    camera: tuple[Unplugged, Page],
) -> None:
    sensor, page = camera
    with page.connect() as browser:
        browser.draws = True
        browser.ask_for("view", do="look")
        sensor.gone = True
        assert "is gone" in browser.until("camera")["text"]
        blind = browser.ask_for("failed", do="say", text="What is this?")
        assert "is gone" in blind["text"]
        assert page.troubles == ["the Kinect is gone: plug it in again"]
        sensor.gone = False
        assert browser.until("camera")["text"] == ""
        assert browser.say("What is this?")["said"]
        assert page.troubles == ["the Kinect is gone: plug it in again", ""]


def test_a_restart_before_a_camera_that_is_gone_is_a_restart(
    camera: tuple[Unplugged, Page],
) -> None:
    sensor, page = camera
    with page.connect() as browser:
        browser.say("Hello.")
        sensor.gone = True
        anew = browser.ask_for("restarted", do="restart")
        assert browser.until("failed", ref=anew["ref"])["seen"]
        assert browser.say("What did you say?")["said"] != "Hello."


def test_what_is_asked_again_is_done_once(page: Page) -> None:
    with page.connect() as browser:
        twice = fresh_ref()
        for _ in range(2):
            browser.ask(do="say", text="Hello.", ref=twice)
        browser.until("view", ref=twice)
        browser.say("Thank you.")
        heard = [it["ref"] for it in browser.events if it["type"] == "heard"]
    assert heard.count(twice) == 1


def test_whoever_asks_is_told_that_the_server_is_there(page: Page) -> None:
    with page.connect() as browser:
        browser.ask(do="ping")
        assert browser.until("pong")


def test_who_comes_after_the_look_sees_what_a_recording_showed(tmp_path: Path) -> None:
    assert main(["record", str(tmp_path / "lesson"), "--frames", "12"]) == 0
    with page_of(open_sensor(str(tmp_path / "lesson"))) as page:
        page.robot.ask(parse_request({"do": "look", "ref": "first"}))
        with page.connect(after=0) as browser:
            browser.until("view", ref="first")
            while not browser.pictures:
                browser.pictures.append(browser.socket.recv(timeout=60))
