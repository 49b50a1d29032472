"""The parts behind the page: its feed, its requests, its pictures, its sentences."""

from __future__ import annotations

import re
import socket
import stat
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from threading import Event, Thread
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.language import understand
from kille.page.browser_requests import RequestError, parse_message, parse_request
from kille.page.feed import Feed
from kille.page.live_picture import LivePicture, SharedSensor, Watcher
from kille.page.phrases import PHRASES, phrases
from kille.page.server import listen
from kille.perception.outlines import polygon_of
from kille.scene import Frame
from kille.sensors.sensor import Stage
from kille.sensors.sources import open_sensor

# --- the socket ----------------------------------------------------------------------


def test_what_is_sent_does_not_wait_until_what_was_sent_before_is_confirmed() -> None:
    with listen("127.0.0.1", 0) as listener:
        here = listener.getsockname()
        with socket.create_connection(here), listener.accept()[0] as connection:
            assert connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


# --- the feed ------------------------------------------------------------------------


def test_a_feed_forgets_what_is_too_old() -> None:
    feed = Feed(kept=3)
    for number in range(5):
        feed.publish({"n": number})
    assert (feed.first, feed.last) == (3, 5)
    assert [it["id"] for it in feed.after(0)] == [3, 4, 5]
    assert feed.after(5) == []


def test_threads_publish_without_losing_or_doubling_a_number() -> None:
    feed, woken = Feed(), []
    with feed.listener(lambda: woken.append(1)):
        threads = [
            Thread(target=lambda: [feed.publish({}) for _ in range(50)])
            for _ in range(4)
        ]
        for it in threads:
            it.start()
        for it in threads:
            it.join()
    feed.publish({})
    assert [it["id"] for it in feed.after(0)] == [*range(1, 202)]
    assert len(woken) == 200


# --- what a browser may ask for ------------------------------------------------------

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=9),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text(max_size=3), inner, max_size=2)
    ),
    max_leaves=4,
)
DEEDS = st.sampled_from(["say", "point", "look", "restart", "show", "remove", "place"])
FIELDS = ("text", "thing", "box", "right", "away", "turn", "ref")
MESSAGES = st.fixed_dictionaries(
    {"do": DEEDS | JSON}, optional=dict.fromkeys(FIELDS, JSON)
)


@given(MESSAGES)
def test_a_message_asks_for_something_or_is_refused(message: dict[str, Any]) -> None:
    with suppress(RequestError):
        request = parse_request(message)
        assert "\n" not in request.shown
        assert len(request.ref) <= 64


@given(st.text())
def test_a_text_is_a_message_or_refused(text: str) -> None:
    with suppress(RequestError):
        assert isinstance(parse_message(text), dict)


# --- pictures ------------------------------------------------------------------------


def test_a_shared_stage_is_a_stage_and_a_shared_camera_is_none() -> None:
    picture = LivePicture()
    stage = picture.share(open_sensor("synthetic:empty?seed=7"))
    assert isinstance(stage, Stage)
    assert "cup" in stage.things()
    stage.show("cup")
    before = stage.frame().colour.copy()
    stage.remove("cup")
    assert not np.array_equal(stage.frame().colour, before)
    stage.close()
    picture.close()


def test_a_picture_is_made_only_for_who_watches() -> None:
    picture, woken = LivePicture(), []
    sensor = picture.share(open_sensor("synthetic:empty?seed=7"))
    sensor.frame()
    assert picture.newest is None
    with picture.watched_by(Watcher(lambda: woken.append(1))):
        while len(woken) < 3:
            sensor.frame()
    assert picture.newest is not None
    assert picture.newest.jpeg.startswith(b"\xff\xd8")
    picture.close()
    sensor.close()


def test_no_picture_is_made_for_who_cannot_take_one() -> None:
    picture, woken, frames = LivePicture(), [], []
    inner = open_sensor("synthetic:empty?seed=7")
    sensor = picture.share(inner)
    full = Watcher(lambda: woken.append(1), lambda: len(woken) < 2)
    with picture.watched_by(full):
        for _ in range(50):
            frames.append(sensor.frame())
    assert len(woken) <= 2
    picture.close()
    sensor.close()


class Stumbling:
    """A camera that fails once as nobody foresaw."""

    name = "kinect:test"

    def __init__(self) -> None:
        self._inner, self._read = open_sensor("synthetic:empty?seed=7"), 0

    def frame(self) -> Frame:
        self._read += 1
        if self._read == 1:
            raise ValueError("a frame of\nno size")
        return self._inner.frame()

    def close(self) -> None:
        self._inner.close()


def test_pictures_go_on_after_an_error_that_nobody_foresaw() -> None:
    told: list[str] = []
    made = Event()
    picture = LivePicture(told.append)
    sensor = picture.share(Stumbling())
    with picture.watched_by(Watcher(made.set)):
        assert made.wait(60)
    assert told == ["there is no picture: a frame of no size", ""]
    picture.close()
    sensor.close()


class Renamed:
    """A sensor under another name."""

    def __init__(self, name: str) -> None:
        self.name, self._inner = name, open_sensor("synthetic:empty?seed=7")

    def frame(self) -> Frame:
        return self._inner.frame()

    def close(self) -> None:
        self._inner.close()


@pytest.mark.parametrize(
    ("name", "runs"),
    [
        ("synthetic", True),
        ("synthetic:desk?seed=7", True),
        ("kinect", True),
        ("kinect?fps=15", True),
        ("ros:/camera", True),
        ("kinect_lesson/", False),
        ("rosbags/cup", False),
        ("synthetic.npz", False),
    ],
)
def test_a_recording_is_none_that_is_called_like_a_camera(
    name: str, runs: bool
) -> None:
    picture = LivePicture()
    sensor = SharedSensor(Renamed(name), picture)
    assert sensor.runs_by_itself is runs
    sensor.close()
    picture.close()


def test_an_outline_is_that_of_the_largest_piece() -> None:
    mask = np.zeros((50, 60), bool)
    assert polygon_of(mask) == []
    mask[2:4, 2:4] = mask[20:40, 10:50] = True
    corners = polygon_of(mask)
    assert sorted(corners) == [(10, 20), (10, 39), (49, 20), (49, 39)]


# --- sentences -----------------------------------------------------------------------


@pytest.mark.parametrize("language", PHRASES)
def test_what_buttons_say_is_understood(language: str) -> None:
    for sentence in phrases(language):
        (heard,) = understand(sentence.format(a_word="cup"), language)
        assert heard.readings, sentence


def test_the_page_has_each_of_its_texts_once_in_each_language() -> None:
    source = files("kille.page").joinpath("assets", "texts.js").read_text()
    languages = re.findall(r"^const [A-Z]+ = \{$(.*?)^\};$", source, re.M | re.S)
    names = [re.findall(r"(\w+): \"", re.sub(r'"[^"]*"', '""', it)) for it in languages]
    assert len(names) == len(PHRASES)
    for it in names:
        assert sorted(it) == sorted({*names[0]})


# --- certificates --------------------------------------------------------------------


def test_a_certificate_is_private_and_made_once(tmp_path: Path) -> None:
    pytest.importorskip("cryptography", reason="kille[page] is not installed")
    from kille.page.certificates import host_certificate

    made = host_certificate("0.0.0.0", tmp_path / "new")
    assert stat.S_IMODE(made.path.stat().st_mode) == 0o600
    assert len(made.fingerprint.split(":")) == 32
    assert host_certificate("0.0.0.0", tmp_path / "new") == made
    assert host_certificate("192.0.2.7", tmp_path / "new") != made
    made.path.write_text("no certificate")
    assert host_certificate("0.0.0.0", tmp_path / "new").fingerprint != made.fingerprint
