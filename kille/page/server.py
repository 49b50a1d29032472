"""The process of the page: its socket, its robot, and how it ends."""

from __future__ import annotations

import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import Lock
from typing import NamedTuple

import uvicorn

from kille.agent.agent import Agent
from kille.dialogue.language_files import plain
from kille.dialogue.state import words
from kille.page.app import Voice, page_app
from kille.page.browser_requests import MESSAGE, parse_request
from kille.page.feed import Event, Feed
from kille.page.guard import Access, Guard
from kille.page.live_picture import LivePicture
from kille.page.lookup_routes import lookup_routes
from kille.page.microphone import Listening, Microphone
from kille.page.robot_thread import RobotThread, Watch
from kille.page.second_robot import MakeSecond
from kille.page.spoken_answers import SpokenAnswers
from kille.page.state_changes import PLAIN, Insight
from kille.page.table import table_report
from kille.sensors.sensor import Sensor
from kille.sensors.sources import open_sensor
from kille.speech.hearing import Heard, HearingProcess

_FAREWELL = 2
"""Seconds that browsers have to take their leave."""

_CONNECTIONS = 64


class PageSettings(NamedTuple):
    """Where the page listens, who may reach it, and the file of its certificate."""

    listener: socket.socket
    access: Access
    certificate: Path | None = None


class Second(NamedTuple):
    """A robot that stands beside the first: what makes it, and what the theories of
    the two are called."""

    make: MakeSecond
    names: tuple[str, str]


class Terminal(NamedTuple):
    """What the terminal is told: that the page is ready, what goes wrong with camera
    or memory, and what nobody foresaw."""

    ready: Callable[[Agent], object]
    trouble: Callable[[str], object]
    unforeseen: Callable[[Exception], object]


class ToldOnce:
    """Tells of trouble once, whoever meets with it; an empty text: it is over.

    >>> heard = []
    >>> told = ToldOnce(heard.append)
    >>> for who, trouble in ("robot", "gone"), ("picture", "gone"), ("picture", ""):
    ...     told.tell(who, trouble)
    >>> heard
    ['gone']
    """

    def __init__(self, tell: Callable[[str], object]) -> None:
        self._tell, self._troubles, self._lock = tell, dict[str, str](), Lock()

    def tell(self, who: str, trouble: str) -> None:
        """Tell of what somebody meets with, unless anybody has at present."""
        with self._lock:
            is_new = bool(trouble) and trouble not in self._troubles.values()
            self._troubles[who] = trouble
        if is_new:
            self._tell(trouble)


def listen(host: str, port: int) -> socket.socket:
    """A socket that listens there; any free port for 0. OSError if that cannot be.

    What is sent is on its way at once: the second of two short messages would wait for
    the browser to confirm the first, for 40 ms. Connections have that from the socket;
    asyncio sees to it only for sockets that name their protocol, as these do not.
    """
    family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
    listener = socket.create_server((host, port), family=family)
    listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return listener


def serve_page(
    sensor: str,
    make: Callable[[Sensor, Watch], Agent],
    settings: PageSettings,
    terminal: Terminal,
    insight: Insight = PLAIN,
    second: Second | None = None,
) -> None:
    """Serve the page of the robot that `make` makes of the sensor until Ctrl-C.

    A `second` robot hears and sees the same. Raises SensorError and MemoryFileError as
    they arise before it is ready.
    """
    feed, told = Feed(), ToldOnce(terminal.trouble)

    def tell_of_camera(trouble: str) -> None:
        feed.publish({"type": "camera", "text": trouble})
        told.tell("picture", trouble)

    with ExitStack() as closing:
        picture = LivePicture(tell_of_camera)
        closing.callback(picture.close)
        opened = open_sensor(sensor)
        with ExitStack() as failing:
            failing.callback(opened.close)
            robot = RobotThread(
                lambda watch: make(picture.share(opened), watch),
                feed,
                lambda trouble: told.tell("robot", trouble),
                terminal.unforeseen,
                insight,
                None if second is None else second.make,
            )
            failing.pop_all()
        closing.callback(robot.close)
        closing.callback(picture.close)  # before the sensor that it reads
        robot.ask(parse_request({"do": "look"}))
        picture.on_check = robot.attend
        voice = open_voice(feed, robot, terminal.trouble)
        closing.callback(voice.close)
        app = page_app(
            feed,
            picture,
            robot.ask,
            lambda: _hello_event(robot.robot, second),
            lookup_routes(robot),
            voice,
        )
        server = uvicorn_server(Guard(app, settings.access), settings.certificate)
        with _signals_end(server):
            terminal.ready(robot.robot)  # from now on Ctrl-C ends it well
            server.run(sockets=[settings.listener])


def open_voice(
    feed: Feed,
    robot: RobotThread,
    trouble: Callable[[str], object],
    begin: Callable[[Callable[[Heard], object]], Listening] = HearingProcess,
) -> Voice:
    """What hears for a robot, and speaks for it; `trouble` is told what goes wrong, and
    `begin` begins what listens."""
    language = robot.robot.language
    microphone = Microphone(
        feed, robot.ask, lambda: words(robot.robot.state), language, trouble, begin
    )
    return Voice(microphone, SpokenAnswers(feed, plain(language), trouble))


def _hello_event(robot: Agent, second: Second | None = None) -> Event:
    """What a browser is told of the robot first."""
    sensor = robot.gaze.sensor
    return {
        "sensor": sensor.name,
        "memory": str(robot.memory.place),
        "language": plain(robot.language),
        "mode": robot.state.private.strategy.mode,
        "words": len(robot.state.private.nouns),
        "table": table_report(sensor),
        "theories": [] if second is None else list(second.names),
    }


def uvicorn_server(app: Guard, certificate: Path | None = None) -> uvicorn.Server:
    """What serves the page: it says nothing by itself, and its messages are small."""
    config = uvicorn.Config(
        app,
        lifespan="off",
        ws="websockets-sansio",
        ws_max_size=MESSAGE,
        ws_per_message_deflate=False,
        http="h11",
        h11_max_incomplete_event_size=MESSAGE,
        limit_concurrency=_CONNECTIONS,
        timeout_graceful_shutdown=_FAREWELL,
        log_config=None,
        log_level="critical",
        access_log=False,
        proxy_headers=False,
        server_header=False,
        ssl_certfile=certificate,
    )
    return uvicorn.Server(config)


@contextmanager
def _signals_end(server: uvicorn.Server) -> Iterator[None]:
    """Have Ctrl-C and SIGTERM end the server, and nothing else.

    The server sends itself the signal that ended it once more when it has ended.
    """

    def end(*_: object) -> None:
        server.should_exit = True

    ends = (signal.SIGINT, signal.SIGTERM)
    before = {it: signal.signal(it, end) for it in ends}
    try:
        yield
    finally:
        for it, handler in before.items():
            signal.signal(it, handler)
