"""The page over HTTP and WebSocket.

`/` and its few files never change while the server runs. `/live` is the WebSocket: with
`run` and `after`, the events after that number in that run, else all that are kept.
Text is events and answers as JSON; a binary message is a picture: its number in four
bytes, then a JPEG. A browser that has drawn a picture says so (`{"do": "shown"}`), and
no more than two are ever under way: who is slow sees fewer.
"""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from importlib.resources import files
from typing import Any

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
)
from kille.page.feed import Event, Feed
from kille.page.inside import MATRIX_STYLE
from kille.page.live_picture import LivePicture, Watcher
from kille.page.robot_thread import BusyError

BROWSERS = 16
"""How many may look at the page at a time."""

UNDER_WAY = 2
"""Pictures that were sent and not yet drawn."""

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}


def page_app(
    feed: Feed,
    picture: LivePicture,
    ask: Callable[[BrowserRequest], None],
    greeting: Callable[[], Event],
    reads: Iterable[BaseRoute] = (),
) -> Starlette:
    """The page of a robot: what it tells, what it sees, and how it is asked.

    `ask` has a request done, or raises BusyError; `greeting` is what a browser is told
    first; `reads` are the addresses at which it is looked into.
    """
    connected: set[WebSocket] = set()

    async def live(socket: WebSocket) -> None:
        await socket.accept()
        if len(connected) >= BROWSERS:
            await socket.close(1013, "too many browsers")
            return
        connected.add(socket)
        try:
            await _Connection(socket, feed, picture, ask, greeting).hold()
        finally:
            connected.discard(socket)

    routes: list[BaseRoute] = [WebSocketRoute("/live", live)]
    routes += [_file_route(*it) for it in _page_files()]
    return Starlette(routes=[*routes, *reads])


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


def _text_of(received: Mapping[str, Any]) -> str:
    """The text of a message. RequestError if it is binary."""
    text = received.get("text")
    if not isinstance(text, str):
        raise RequestError("a message is text, not bytes")
    return text


class _Connection:
    """A browser that looks at the page: what it has, and what it is sent next."""

    def __init__(
        self,
        socket: WebSocket,
        feed: Feed,
        picture: LivePicture,
        ask: Callable[[BrowserRequest], None],
        greeting: Callable[[], Event],
    ) -> None:
        self._socket, self._feed, self._picture = socket, feed, picture
        self._ask, self._greeting = ask, greeting
        self._wake, self._loop = asyncio.Event(), asyncio.get_running_loop()
        self._refusals: list[Event] = []
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
        }
        await self._socket.send_text(json.dumps(greeting))
        watcher = Watcher(self._rouse, self._can_take_picture)
        self._wake.set()
        with self._feed.listener(self._rouse), self._picture.watched_by(watcher):
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
            while self._refusals:
                await self._socket.send_text(json.dumps(self._refusals.pop(0)))
            while events := self._feed.after(self._last):
                for event in events:
                    await self._socket.send_text(json.dumps(event))
                    self._last = event["id"]
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
                message = parse_message(_text_of(received))
                match message.get("do"):
                    case "shown":
                        self._shown = min(self._shown + 1, self._pictures)
                        self._picture.go_on()
                    case "watch":
                        self._looks = message.get("on") is not False
                        self._picture.go_on()
                    case _:
                        self._ask(parse_request(message))
            except (RequestError, BusyError) as error:
                self._refuse(error)
            self._wake.set()

    def _refuse(self, error: RequestError | BusyError) -> None:
        ref = error.ref if isinstance(error, RequestError) else ""
        self._refusals.append({"type": "refused", "ref": ref, "text": str(error)})
        del self._refusals[:-20]
