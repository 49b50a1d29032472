"""The microphone of a browser: whose it is, and what comes of its sound."""

from __future__ import annotations

import os
import struct
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from queue import Queue
from threading import Thread
from typing import Any

import pytest

from kille.page import spoken_answers
from kille.sensors.sources import open_sensor
from kille.speech.hearing import (
    ANEW,
    END,
    HELD,
    OPEN,
    WAITING,
    Heard,
    Hearing,
    HearingProcess,
    Message,
)
from kille.speech.recognition import Hypothesis
from kille.speech.sound import RATE, Sound, read_wav
from kille.speech.utterances import LONGEST

from .pages import Browser, Page, page_of

PIECE = bytes(1600)
"""A twentieth of a second."""

CUP = (Hypothesis("This is a cup.", 0.95), Hypothesis("Is this a cup?", 0.04))


class Ears:
    """What listens in place of a process: it hears what the test says it does."""

    def __init__(self, tell: Callable[[Heard], object]) -> None:
        self.tell, self.is_alive, self.has_room = tell, True, True
        self.taken: list[Message] = []
        self.words: set[str] = set()
        self.tell_in_thread(Heard("ready"))

    def tell_in_thread(self, heard: Heard) -> None:
        Thread(target=self.tell, args=(heard,)).start()

    def expect(self, words: Iterable[Any]) -> None:
        self.words = {str(it.form) for it in words}

    def take(self, message: Message) -> bool:
        if self.has_room:
            self.taken.append(message)
        if message.kind == END:
            self.tell_in_thread(Heard("heard", CUP, held=True))
        return self.has_room

    def close(self) -> None:
        self.is_alive = False


@pytest.fixture(scope="module")
def ears() -> list[Ears]:
    return []


@pytest.fixture(scope="module")
def heard_page(ears: list[Ears]) -> Iterator[Page]:
    """A page that hears by such ears, with a cup before the robot."""

    def begin(tell: Callable[[Heard], object]) -> Ears:
        ears.append(Ears(tell))
        return ears[-1]

    sensor = open_sensor("synthetic:empty?seed=7")
    with page_of(sensor, hearing=begin) as page, page.connect() as browser:
        browser.ask_for("view", do="show", thing="cup")
        yield page


def sound(kind: bytes, number: int, samples: bytes = PIECE) -> bytes:
    return kind + struct.pack(">I", number) + samples


def take_microphone(browser: Browser) -> None:
    """Have it, even if a browser that has just gone still has it, too."""
    browser.ask(do="microphone", on=True, take=True)
    browser.until("listening")


def expect_nothing_more(browser: Browser) -> list[str]:
    """The types of the events that were still under way."""
    before = len(browser.events)
    browser.ask(do="ping")
    browser.until("pong")
    return [it["type"] for it in browser.events[before:-1]]


def test_what_is_heard_is_a_turn_with_its_alternatives(
    heard_page: Page, ears: list[Ears]
) -> None:
    with heard_page.connect() as browser:
        take_microphone(browser)
        for number in range(3):
            browser.socket.send(sound(HELD, number))
        browser.socket.send(sound(END, 3, b""))
        heard = browser.until("heard")
        assert heard["says"] == "This is a cup."
        assert heard["perhaps"] == [["This is a cup.", 0.95], ["Is this a cup?", 0.04]]
        turn = browser.until("turn", ref=heard["ref"])
        assert [it["word"] for it in turn["lessons"]] == ["cup"]
        assert [it.kind for it in ears[-1].taken[-4:]] == [HELD, HELD, HELD, END]
        browser.until("view", ref=heard["ref"])
        assert "cup" in ears[-1].words  # what was learned is expected
        browser.say("Forget that.")


def test_one_browser_has_the_microphone_at_a_time(heard_page: Page) -> None:
    with heard_page.connect() as one, heard_page.connect() as other:
        numbers = [it.until("hello")["browser"] for it in (one, other)]
        take_microphone(one)
        assert other.until("microphone", browser=numbers[0])["who"] == "127.0.0.1"
        other.ask(do="microphone", on=True)
        assert other.until("taken")["who"] == "127.0.0.1"
        other.socket.send(sound(END, 0))  # not its own: nothing comes of it
        assert expect_nothing_more(other) == []
        take_microphone(other)
        one.until("microphone", browser=numbers[1])
        other.close()
        one.until("microphone", browser=0)  # who goes gives it back


def test_sound_that_is_lost_is_told_once(heard_page: Page, ears: list[Ears]) -> None:
    with heard_page.connect() as browser:
        take_microphone(browser)
        for number in (0, 1, 4, 9):
            browser.socket.send(sound(OPEN, number))
        assert expect_nothing_more(browser).count("sound-lost") == 1
        browser.socket.send(sound(OPEN, 10))
        assert expect_nothing_more(browser) == []
        ears[-1].has_room = False
        browser.socket.send(sound(OPEN, 11))
        assert expect_nothing_more(browser) == ["sound-lost"]
        ears[-1].has_room = True


@pytest.mark.parametrize(
    "message",
    [
        b"",
        b"O",
        b"X" + bytes(104),
        sound(OPEN, 0, bytes(RATE)),
        sound(HELD, 0, bytes(3)),
    ],
    ids=["empty", "short", "unknown", "long", "half a sample"],
)
def test_what_is_no_sound_is_refused(heard_page: Page, message: bytes) -> None:
    with heard_page.connect() as browser:
        take_microphone(browser)
        browser.socket.send(message)
        assert "sound" in browser.until("refused")["text"]


def test_a_noise_in_an_open_microphone_is_not_answered(
    heard_page: Page, ears: list[Ears]
) -> None:
    with heard_page.connect() as browser:
        take_microphone(browser)
        ears[-1].tell(Heard("heard"))
        browser.until("unheard")
        ears[-1].tell(Heard("heard", held=True))
        heard = browser.until("heard")
        assert heard["says"] == "…"
        assert "not understand" in browser.until("turn", ref=heard["ref"])["said"]


def test_what_listens_may_end_and_begins_anew(
    heard_page: Page, ears: list[Ears]
) -> None:
    with heard_page.connect() as browser:
        take_microphone(browser)
        ears[-1].is_alive = False
        ears[-1].tell(Heard("failed", text="it has ended"))
        assert browser.until("refused")["text"] == "it has ended"
        browser.until("microphone", browser=0)
        assert "it has ended" in heard_page.troubles
        count = len(ears)
        take_microphone(browser)
        assert len(ears) == count + 1


# --- the robot's voice ---------------------------------------------------------------


@pytest.mark.skipif(not spoken_answers.voice_program("en"), reason="nothing speaks")
def test_the_robot_is_heard_by_who_wants_that(heard_page: Page) -> None:
    with heard_page.connect() as browser, heard_page.connect() as deaf:
        browser.ask(do="voice", on=True)
        turn = browser.say("Hello.")
        while not any(it[4:8] == b"RIFF" for it in browser.pictures):
            browser.pictures.append(browser.socket.recv(timeout=60))
        spoken = next(it for it in browser.pictures if it[4:8] == b"RIFF")
        assert struct.unpack(">I", spoken[:4]) == (turn["id"],)
        assert read_wav(spoken[4:]).seconds > 0.2
        deaf.until("turn", id=turn["id"])
        expect_nothing_more(deaf)
        assert not any(it[4:8] == b"RIFF" for it in deaf.pictures)


def test_what_was_cut_off_is_not_said(heard_page: Page) -> None:
    with heard_page.connect() as browser:
        browser.say("This is a cup.")
        turn = browser.say("What is this?")
        assert turn["said"] == "This is a cup."
        for share in (0.6, 1):
            browser.ask(do="uttered", turn=turn["id"], line=0, share=share)
        uttered = browser.until("uttered")
        assert (uttered["text"], uttered["whole"]) == ("This is", False)
        assert "uttered" not in expect_nothing_more(browser)  # it is told once
        again = browser.say("Go on.")
        assert again["said"] == "This is a cup."
        browser.ask(do="uttered", turn=again["id"], line=1, share=0)
        assert browser.until("uttered")["whole"]
        browser.say("Forget that.")


@pytest.mark.parametrize(
    ("over", "then"),
    [
        ("Glimp frotz the.", "OK, "),
        ("Hello.", "I have not said anything that you could confirm."),
    ],
    ids=["no sentence", "sentence"],
)
def test_only_who_is_understood_interrupts(
    heard_page: Page, over: str, then: str
) -> None:
    with heard_page.connect() as browser:
        taught = browser.say("This is a cup.")
        turn = browser.say("What is this?")
        browser.ask(do="uttered", turn=turn["id"], line=0, share=0.6)
        assert not browser.until("uttered")["whole"]
        browser.say(over)
        assert browser.say("That is correct.")["said"].startswith(then)
        browser.say(taught["undo"])


@pytest.mark.parametrize(
    "about",
    [
        {"turn": 0},
        {"turn": 10**9},
        {"turn": "1"},
        {"turn": True},
        {"line": -1},
        {"line": 9},
        {"share": 2},
        {"share": "all"},
    ],
    ids=str,
)
def test_what_cannot_have_been_uttered_is_refused(
    heard_page: Page, about: dict[str, Any]
) -> None:
    with heard_page.connect() as browser:
        turn = browser.say("Hello.")
        message = {"turn": turn["id"], "line": 0, "share": 0.5} | about
        browser.ask(do="uttered", **message)
        assert browser.until("refused")["text"]


# --- what listens --------------------------------------------------------------------


class Words:
    """A recogniser that knows how long what it heard was."""

    def __init__(self) -> None:
        self.heard: list[float] = []

    def expect(self, words: Iterable[Any]) -> None:
        """Nothing."""

    def hear(self, sound: bytes) -> tuple[Hypothesis, ...]:
        self.heard.append(Sound(RATE, sound).seconds)
        return CUP


@pytest.fixture
def hearing() -> tuple[Hearing, Words, list[Heard]]:
    pytest.importorskip("pocketsphinx")
    words, told = Words(), list[Heard]()
    return Hearing(words, told.append), words, told  # type: ignore[arg-type]


def test_what_is_held_is_one_utterance(
    hearing: tuple[Hearing, Words, list[Heard]],
) -> None:
    taking, words, told = hearing
    for kind in (HELD, HELD, END):
        taking.take(Message(kind, bytes(RATE)))
    assert told == [Heard("heard", CUP, held=True)]
    assert 1.5 < words.heard[0] < 2.0  # half a second each, and margins


def test_what_is_held_too_long_is_cut_and_the_next_is_heard(
    hearing: tuple[Hearing, Words, list[Heard]],
) -> None:
    taking, words, _ = hearing
    for _ in range(3 * int(LONGEST)):
        taking.take(Message(HELD, bytes(2 * RATE)))
    assert len(words.heard) == 1
    assert words.heard[0] < LONGEST + 1
    taking.take(Message(END))
    taking.take(Message(END, bytes(RATE)))
    assert len(words.heard) == 2


def test_another_microphone_begins_with_nothing(
    hearing: tuple[Hearing, Words, list[Heard]],
) -> None:
    taking, words, _ = hearing
    taking.take(Message(HELD, bytes(4 * RATE)))
    taking.take(Message(ANEW))
    taking.take(Message(END, bytes(RATE)))
    assert words.heard[0] < 1.0


def test_an_open_microphone_in_which_nobody_speaks_is_silent(
    hearing: tuple[Hearing, Words, list[Heard]],
) -> None:
    taking, _, told = hearing
    for _ in range(40):
        taking.take(Message(OPEN, bytes(3200)))
    assert told == []


def test_sound_that_nobody_hears_waits_up_to_a_bound(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asleep = "import time; time.sleep(600)"
    monkeypatch.setattr("kille.speech.hearing._BEGIN", asleep)
    monkeypatch.setattr("kille.speech.hearing._FAREWELL", 0.1)
    process = HearingProcess(lambda _: None)
    second = Message(OPEN, bytes(2 * RATE))
    taken = [process.take(second) for _ in range(3 * int(WAITING))]
    assert taken[0]
    assert not taken[-1]
    process.close()
    assert not process.is_alive


ECHO = """
import sys
open(sys.argv[1]).read()
from kille.speech.hearing import Heard, _messages
for message in _messages(sys.stdin.buffer):
    told = Heard("heard", text=f"{message.kind.decode()}{len(message.content)}")
    sys.stdout.write(told.to_line())
    sys.stdout.flush()
"""
"""Tells what it is sent, as soon as a file can be read to its end."""


def test_what_is_held_is_heard_whole_or_not_at_all(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    gate = tmp_path / "gate"
    os.mkfifo(gate)
    monkeypatch.setattr("kille.speech.hearing._BEGIN", ECHO)
    monkeypatch.setattr("sys.path", [str(gate), *sys.path])
    told: Queue[str] = Queue()
    process = HearingProcess(lambda heard: told.put(heard.text))
    second = Message(HELD, bytes(2 * RATE))
    taken = [process.take(second) for _ in range(2 * int(WAITING))]
    assert not process.take(Message(END, bytes(RATE)))
    for _ in range(100):
        assert not process.take(Message(END, bytes(2 * RATE))), "no end of waiting"
    gate.write_text("")
    sent = [told.get(timeout=60) for _ in range(sum(taken) + 1)]
    assert sent == [f"H{2 * RATE}"] * sum(taken) + ["N0"]
    assert process.take(Message(HELD, bytes(6)))
    assert process.take(Message(END))
    assert [told.get(timeout=60) for _ in range(2)] == ["H6", "E0"]
    process.close()
