"""The page over HTTP and WebSocket.

`/` and its few files never change while the server runs. `/live` is the WebSocket: with
`run` and `after`, the events after that number in that run, else all that are kept.
Text is events and answers as JSON; a binary message is a number in four bytes, and then
a picture (a JPEG), or what the robot says in the turn of that number (a WAV file). A
browser that has drawn a picture says so, and no more than two are ever under way: who
is slow sees fewer.

What a browser asks of the robot is in `browser_requests`; of its connection it asks:

| `do` | with | does |
| --- | --- | --- |
| `shown` | | a picture has been drawn |
| `watch` | `on` | pictures are sent, or not |
| `ping` | | it is answered at once, `pong` |
| `microphone` | `on`, `take` | it is heard; with `take` instead of another browser |
| `voice` | `on` | it is sent the robot's voice |
| `uttered` | `turn`, `line`, `share` | the answer was uttered up to a share of a line |

The sound of a microphone is binary: see `microphone`.
"""

from __future__ import annotations

import asyncio
import json
import struct
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from importlib.resources import files
from itertools import count
from typing import Any, NamedTuple

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from kille.page.browser_requests import (
    BrowserRequest,
    RequestError,
    parse_message,
    parse_request,
    uttered_request,
)
from kille.page.feed import Event, Feed
from kille.page.live_picture import LivePicture, Watcher
from kille.page.microphone import Microphone
from kille.page.robot_thread import BusyError
from kille.page.spoken_answers import SpokenAnswers
from kille.page.state_changes import MATRIX_STYLE

BROWSERS = 16
"""How many may look at the page at a time."""

UNDER_WAY = 2
"""Pictures that were sent and not yet drawn."""

_SENTENCES = 16
"""Sentences of the robot's voice that wait to be sent; of more, the newest."""

_REFUSALS = 20

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}


class Voice(NamedTuple):
    """What the page hears, and how it speaks."""

    microphone: Microphone
    answers: SpokenAnswers

    def close(self) -> None:
        """Hear and say no more."""
        self.microphone.close()
        self.answers.close()


def page_app(
    feed: Feed,
    picture: LivePicture,
    ask: Callable[[BrowserRequest], None],
    greeting: Callable[[], Event],
    reads: Iterable[BaseRoute] = (),
    voice: Voice | None = None,
) -> Starlette:
    """The page of a robot: what it tells, what it sees, and how it is asked.

    `ask` has a request done, or raises BusyError; `greeting` is what a browser is told
    first; `reads` are the addresses at which it is looked into; without a `voice`
    nothing is heard or spoken.
    """
    connected: set[WebSocket] = set()
    numbers = count(1)

    async def live(socket: WebSocket) -> None:
        await socket.accept()
        if len(connected) >= BROWSERS:
            await socket.close(1013, "too many browsers")
            return
        connected.add(socket)
        try:
            connection = _Connection(socket, feed, picture, ask, greeting, voice)
            connection.number = next(numbers)
            await connection.hold()
        finally:
            connected.discard(socket)

    routes: list[BaseRoute] = [WebSocketRoute("/live", live)]
    routes += [_file_route(*it) for it in _page_files()]
    return Starlette(routes=[*routes, *reads], exception_handlers={BusyError: _busy})


async def _busy(_: Request, error: Exception) -> Response:
    return Response(f"{error}\n", 503, {"Retry-After": "1"}, "text/plain")


def _page_files() -> list[tuple[str, bytes]]:
    """The names and contents of the page's files."""
    folder = files("kille.page") / "assets"
    found = [
        (it.name, it.read_bytes())
        for it in sorted(folder.iterdir(), key=lambda it: it.name)
        if "." + it.name.rpartition(".")[2] in _TYPES
    ]
    return [*found, ("matrix.css", MATRIX_STYLE.encode())]


def _file_route(name: str, content: bytes) -> Route:
    kind = _TYPES["." + name.rpartition(".")[2]]

    async def answer(_: Request) -> Response:
        return Response(content, headers={"Content-Type": kind})

    return Route("/" if name == "index.html" else f"/{name}", answer)


class _Connection:
    """A browser that looks at the page: what it has, and what it is sent next."""

    def __init__(
        self,
        socket: WebSocket,
        feed: Feed,
        picture: LivePicture,
        ask: Callable[[BrowserRequest], None],
        greeting: Callable[[], Event],
        voice: Voice | None,
    ) -> None:
        self._socket, self._feed, self._picture = socket, feed, picture
        self._ask, self._greeting, self._voice = ask, greeting, voice
        self._wake, self._loop = asyncio.Event(), asyncio.get_running_loop()
        self.number = 0
        self.name = socket.client.host if socket.client is not None else ""
        self._told: deque[Event] = deque(maxlen=_REFUSALS)
        self._sounds: deque[bytes] = deque(maxlen=_SENTENCES)
        self._listens = False
        self._shown = self._sent = self._pictures = 0
        self._looks = True
        self._last = self._begin_after(socket.query_params)

    def _begin_after(self, query: Any) -> int:
        """The number of the last event that the browser has; 0 if it has none."""
        after = str(query.get("after", ""))
        known = after.isdecimal() and len(after) < 12
        if not known or query.get("run") != self._feed.run:
            return 0
        number = int(after)
        return number if self._feed.first - 1 <= number <= self._feed.last else 0

    async def hold(self) -> None:
        """Send and receive until one of the two goes."""
        greeting = {
            **self._greeting(),
            "type": "hello",
            "run": self._feed.run,
            "after": self._last,
            "last": self._feed.last,
            "browser": self.number,
            "deaf": "no" if self._voice is None else self._voice.microphone.why_deaf,
            "mute": self._voice is None or not self._voice.answers.program,
        }
        await self._socket.send_text(json.dumps(greeting))
        watcher = Watcher(self._rouse, self._can_take_picture)
        self._wake.set()
        with (
            self._feed.listener(self._rouse),
            self._picture.watched_by(watcher),
            self._heard_and_spoken_to(),
        ):
            sending = asyncio.create_task(self._send())
            receiving = asyncio.create_task(self._receive())
            done, left = await asyncio.wait(
                (sending, receiving), return_when=asyncio.FIRST_COMPLETED
            )
            for task in left:
                task.cancel()
            await asyncio.gather(*left, return_exceptions=True)
            for task in done:
                with suppress(WebSocketDisconnect, RuntimeError):
                    task.result()

    @contextmanager
    def _heard_and_spoken_to(self) -> Iterator[None]:
        """Let it be heard and spoken to as long as it is there."""
        if self._voice is None:
            yield
            return
        self._voice.answers.add(self)
        try:
            yield
        finally:
            self._voice.answers.remove(self)
            self._voice.microphone.give_back(self)

    def tell(self, event: Event) -> None:
        """Tell this browser alone, from any thread."""
        self._told.append(event)
        self._rouse()

    def wants_voice(self) -> bool:
        """Whether it wants to hear the robot."""
        return self._listens

    def play(self, sound: bytes) -> None:
        """Send it a sentence of the robot's, from any thread."""
        self._sounds.append(sound)
        self._rouse()

    def _can_take_picture(self) -> bool:
        """Whether the browser looks, and has drawn the pictures that it was sent."""
        return self._looks and self._pictures - self._shown < UNDER_WAY

    def _rouse(self) -> None:
        """Wake the sender, from any thread."""
        with suppress(RuntimeError):  # the server has ended
            self._loop.call_soon_threadsafe(self._wake.set)

    async def _send(self) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            while self._told:
                await self._socket.send_text(json.dumps(self._told.popleft()))
            while events := self._feed.after(self._last):
                for event in events:
                    await self._socket.send_text(json.dumps(event))
                    self._last = event["id"]
            while self._sounds:
                await self._socket.send_bytes(self._sounds.popleft())
            await self._send_picture()

    async def _send_picture(self) -> None:
        """Send the newest picture, if the browser has drawn those before it."""
        newest = self._picture.newest
        if newest is None or newest.number == self._sent:
            return
        if not self._can_take_picture():
            return
        self._sent = newest.number
        self._pictures += 1
        number = struct.pack(">I", newest.number % 2**32)
        await self._socket.send_bytes(number + newest.jpeg)

    async def _receive(self) -> None:
        while True:
            received = await self._socket.receive()
            if received["type"] == "websocket.disconnect":
                return
            try:
                self._take(received.get("text"), received.get("bytes") or b"")
            except (RequestError, BusyError) as error:
                ref = error.ref if isinstance(error, RequestError) else ""
                self.tell({"type": "refused", "ref": ref, "text": str(error)})
            self._wake.set()

    def _take(self, text: str | None, sound: bytes) -> None:
        """Take a message. RequestError, or BusyError, if nothing comes of it."""
        if not isinstance(text, str):
            self._speaking().microphone.take(self, sound)
            return
        message = parse_message(text)
        is_on = message.get("on") is not False
        match message.get("do"):
            case "shown":
                self._shown = min(self._shown + 1, self._pictures)
                self._picture.go_on()
            case "watch":
                self._looks = is_on
                self._picture.go_on()
            case "ping":
                self.tell({"type": "pong"})
            case "microphone" if is_on:
                take_over = message.get("take") is True
                self._speaking().microphone.lend(self, take_over)
            case "microphone":
                self._speaking().microphone.give_back(self)
            case "voice":
                self._listens = is_on
            case "uttered":
                self._tell_uttered(message)
            case _:
                self._ask(parse_request(message))

    def _speaking(self) -> Voice:
        if self._voice is None:
            raise RequestError("this page does not hear or speak")
        return self._voice

    def _tell_uttered(self, message: Event) -> None:
        """Tell the robot how much of its answer was uttered, unless it was told."""
        number = message.get("turn")
        if type(number) is not int or not self._feed.first <= number <= self._feed.last:
            raise RequestError("a `turn` is the number of an event")
        event = self._feed.after(number - 1)[0]
        if event["id"] != number:
            raise RequestError("a `turn` is the number of an event that is kept")
        request = uttered_request(event, message.get("line"), message.get("share"))
        if self._speaking().answers.is_first_told_of(number):
            self._ask(request)
