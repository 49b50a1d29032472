"""A page in this process, or as a program of its own, and clients for both."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from itertools import count
from pathlib import Path
from threading import Thread
from typing import Any, NamedTuple
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest
from websockets.sync.client import ClientConnection, connect

from kille.agent.agent import Agent
from kille.interfaces.formatting import derivation, in_short
from kille.page.app import page_app
from kille.page.feed import Feed
from kille.page.guard import Access, Guard
from kille.page.live_picture import LivePicture
from kille.page.lookup_routes import lookup_routes
from kille.page.robot_thread import RobotThread
from kille.page.server import (
    Second,
    _hello_event,
    listen,
    open_voice,
    uvicorn_server,
)
from kille.page.state_changes import Insight
from kille.sensors.sensor import Sensor
from kille.sensors.sources import open_sensor
from kille.speech.hearing import HearingProcess

SERVE = [sys.executable, "-m", "kille.interfaces.cli", "serve", "--port", "0"]
_NUMBERS = count(1)
QUICK = partial(Agent, scans=1)
"""A robot whose looks take a moment: it is the page that is tried."""
PATIENCE = 60
"""Seconds after which a test gives a server up."""


def fresh_ref() -> str:
    """A name for a request that no other has: what is asked for again is done once."""
    return f"asked {next(_NUMBERS)}"


class Page(NamedTuple):
    """A page that is served in this process, and the parts behind it."""

    host: str
    feed: Feed
    picture: LivePicture
    robot: RobotThread
    troubles: list[str]

    @property
    def address(self) -> str:
        return f"http://{self.host}/"

    def connect(self, **settings: Any) -> Browser:
        """A client that is told what happens from now on: nothing is under way."""
        self.robot.read(lambda _: None).result(PATIENCE)
        now = {"run": self.feed.run, "after": self.feed.last}
        return Browser.connect(self.address, **(now | settings))


class Browser:
    """A client that has read what a browser would have been sent."""

    def __init__(self, socket: ClientConnection, close: Callable[[], None]) -> None:
        self.socket, self.close = socket, close
        self.events: list[dict[str, Any]] = []
        self.pictures: list[bytes] = []
        self.draws = False

    @classmethod
    def connect(
        cls, address: str, run: str = "", after: int = 0, **settings: Any
    ) -> Browser:
        origin = settings.pop("origin", address.rstrip("/"))
        live = f"{address.rstrip('/').replace('http', 'ws', 1)}/live"
        address = f"{live}?run={run}&after={after}"
        stack = ExitStack()
        connected = stack.enter_context(
            connect(address, origin=origin, max_queue=None, close_timeout=1, **settings)
        )
        return cls(connected, stack.close)

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def ask(self, **message: Any) -> None:
        self.socket.send(json.dumps(message))

    def ask_for(self, kind: str, **message: Any) -> dict[str, Any]:
        """Ask for something; the event of a kind that came of it."""
        ref = fresh_ref()
        self.ask(**message, ref=ref)
        return self.until(kind, ref=ref)

    def next(self) -> dict[str, Any]:
        """The next event; pictures before it are kept."""
        while True:
            message = self.socket.recv(timeout=PATIENCE)
            if isinstance(message, str):
                event: dict[str, Any] = json.loads(message)
                self.events.append(event)
                return event
            self.pictures.append(message)
            if self.draws:
                self.ask(do="shown")

    def until(self, kind: str, **about: Any) -> dict[str, Any]:
        """The next event of a kind about which this is so."""
        while True:
            event = self.next()
            if event["type"] == kind and about.items() <= event.items():
                return event

    def say(self, text: str, ref: str = "") -> dict[str, Any]:
        """Say something; the turn that came of it. Its view has come, too."""
        ref = ref or fresh_ref()
        self.ask(do="say", text=text, ref=ref)
        turn = self.until("turn", ref=ref)
        self.until("view", ref=ref)
        return turn


@contextmanager
def page_of(
    sensor: Sensor,
    memory: Path | None = None,
    access: Access | None = None,
    hearing: Callable[..., Any] = HearingProcess,
    make: Callable[..., Agent] = QUICK,
    second: Second | None = None,
) -> Iterator[Page]:
    """A page of a robot that looks through this sensor, and hears by that, with a
    second one beside it or without."""
    feed, troubles = Feed(), []
    picture = LivePicture(lambda text: feed.publish({"type": "camera", "text": text}))
    robot = RobotThread(
        lambda watch: make(
            picture.share(sensor),
            memory,
            record_event=watch.record_event,
            change=watch.change,
        ),
        feed,
        troubles.append,
        insight=Insight(derivation, in_short),
        make_second=None if second is None else second.make,
    )
    picture.on_check = robot.attend
    voice = open_voice(feed, robot, troubles.append, hearing)
    listener = listen("127.0.0.1", 0)
    app = page_app(
        feed,
        picture,
        robot.ask,
        lambda: _hello_event(robot.robot, second),
        lookup_routes(robot),
        voice,
    )
    server = uvicorn_server(Guard(app, access or Access("127.0.0.1")))
    thread = Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    host = f"127.0.0.1:{listener.getsockname()[1]}"
    try:
        yield Page(host, feed, picture, robot, troubles)
    finally:
        server.should_exit = True
        thread.join(PATIENCE)
        voice.close()
        robot.close()
        picture.close()
        listener.close()


def fetch_text(page: Page, address: str) -> bytes:
    """What the page has at an address; empty if there is nothing."""
    try:
        with urlopen(f"http://{page.host}{address}", timeout=PATIENCE) as answer:
            return bytes(answer.read())
    except HTTPError as error:
        error.close()
        return b"" if error.code == 404 else str(error).encode()


@pytest.fixture(scope="module")
def page() -> Iterator[Page]:
    """The page of a robot before an empty simulated table; it keeps its words."""
    with page_of(open_sensor("synthetic:empty?seed=7")) as made:
        yield made


class Program(NamedTuple):
    """A `kille serve` that is ready."""

    process: subprocess.Popen[str]
    address: str
    said: str


Start = Callable[..., Program]


@contextmanager
def page_starter(folder: Path) -> Iterator[Start]:
    """What starts `kille serve` with memories in a folder, and ends it afterwards."""
    started: list[subprocess.Popen[str]] = []

    def begin(*words: str) -> Program:
        process = subprocess.Popen(
            [*SERVE, "--memory", str(folder / "memory.db"), *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=os.environ | {"KILLE_MEMORY": str(folder / "own.db")},
        )
        started.append(process)
        said = ""
        assert process.stdout is not None
        for line in process.stdout:
            said += line
            if found := re.search(r"https?://\S+", line):
                return Program(process, found[0], said)
        assert process.stderr is not None
        raise AssertionError(f"it ended: {said}{process.stderr.read()}")

    try:
        yield begin
    finally:
        for process in started:
            if process.poll() is None:
                process.kill()
            process.communicate(timeout=PATIENCE)


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts `kille serve`, and ends it with the test."""
    with page_starter(tmp_path) as begin:
        yield begin
