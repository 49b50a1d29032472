"""Who may reach the page, and the headers that keep a browser safe with it.

A page of somebody else's that is open in the same browser must not speak to the robot:
so the name by which the page is asked for is checked (a foreign name may be made to
lead to this machine), and whoever opens a WebSocket says from which page. Beyond this
machine a token is needed, too: it comes once in an address, and then in a cookie.
"""

from __future__ import annotations

import ipaddress
import secrets
import socket
from collections.abc import Awaitable, Callable, MutableMapping
from contextlib import suppress
from typing import Any, NamedTuple
from urllib.parse import parse_qs, urlsplit

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; "
    "style-src 'self'; img-src 'self' blob:; connect-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(self)",
    "Cache-Control": "no-cache",
}
"""No script but the page's own files, nothing from elsewhere, no frames around it."""

REFUSED = "kille: open the address with its token that `kille serve` has printed.\n"
_ELSEWHERE = (
    (socket.AF_INET, "192.0.2.1"),
    (socket.AF_INET6, "2001:db8::1"),
)
"""Addresses that are nobody's, by which to find out which are this machine's."""

_LOCAL = frozenset({"localhost", "127.0.0.1", "::1"})


class Access(NamedTuple):
    """Under which names the page is asked for, and with which token, if any."""

    host: str
    secure: bool = False
    token: str = ""

    @property
    def scheme(self) -> str:
        """Of the page's address."""
        return "https" if self.secure else "http"

    def allows_name(self, name: str) -> bool:
        """Whether the page may be asked for under the name of a host.

        A number is no name that somebody else could have lead here.
        """
        name = name.lower()
        if name in _LOCAL or name == self.host.lower():
            return True
        if not self.secure:
            return False
        return is_number(name) or name in own_names()

    def allows_token(self, token: str) -> bool:
        """Whether this is the token, or none is needed."""
        given = token.encode("utf-8", "replace")
        return not self.token or secrets.compare_digest(given, self.token.encode())


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach a server on this host. OSError if unknown.

    >>> is_loopback("127.0.0.1"), is_loopback("0.0.0.0")
    (True, False)
    """
    found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    return all(ipaddress.ip_address(it[4][0]).is_loopback for it in found)


def is_number(name: str) -> bool:
    """Whether the name of a host is an address in numbers."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def own_names() -> frozenset[str]:
    """The names that this machine has for itself."""
    name = socket.gethostname().lower()
    return frozenset(
        {name, f"{name.partition('.')[0]}.local", socket.getfqdn().lower()}
    )


def own_addresses() -> tuple[str, ...]:
    """The addresses at which other machines reach this one, the likeliest first.

    They are those from which it would send to others; nothing is sent. Its name is no
    help: on Debian it leads to 127.0.1.1.
    """
    found: list[str] = []
    for family, elsewhere in _ELSEWHERE:
        with suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((elsewhere, 9))
            found.append(str(probe.getsockname()[0]).partition("%")[0])
    return tuple(it for it in found if not ipaddress.ip_address(it).is_loopback)


def split_host(host: str) -> str:
    """The name in a Host header, without its port; empty if it has none.

    >>> split_host("[::1]:8765"), split_host("localhost:80"), split_host("a b")
    ('::1', 'localhost', '')
    """
    try:
        parts = urlsplit(f"//{host}")
        plain = parts.netloc == host and "@" not in host and not set(host) & set("/?# ")
        return (parts.hostname or "") if plain else ""
    except ValueError:
        return ""


class Guard:
    """The page behind its checks: what does not pass them never reaches it."""

    def __init__(self, app: App, access: Access) -> None:
        self._app, self._access = app, access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        headers = {
            name.decode("latin-1").lower(): value.decode("latin-1")
            for name, value in scope.get("headers", ())
        }
        match scope["type"]:
            case "http":
                await self._pass_http(scope, headers, receive, _with_headers(send))
            case "websocket":
                await self._pass_websocket(scope, headers, receive, send)

    async def _pass_http(
        self, scope: Scope, headers: dict[str, str], receive: Receive, send: Send
    ) -> None:
        host = headers.get("host", "")
        if not self._access.allows_name(split_host(host)):
            await _answer(send, 421, "kille: the page has another name.\n")
        elif _is_foreign(scope, headers):
            await _answer(send, 403, "kille: only its own page looks inside.\n")
        elif scope["method"] not in ("GET", "HEAD"):
            await _answer(send, 405, "kille: there is nothing to send here.\n")
        elif token := _query(scope, "token"):
            if self._access.allows_token(token):
                await _answer(send, 303, "", self._cookie(host), ("Location", "/"))
            else:
                await _answer(send, 403, REFUSED)
        elif not self._knows(headers, host):
            await _answer(send, 403, REFUSED)
        else:
            await self._app(scope, receive, send)

    async def _pass_websocket(
        self, scope: Scope, headers: dict[str, str], receive: Receive, send: Send
    ) -> None:
        host = headers.get("host", "")
        if (
            self._access.allows_name(split_host(host))
            and headers.get("origin") == f"{self._access.scheme}://{host}"
            and self._knows(headers, host)
        ):
            await self._app(scope, receive, send)
        else:
            await receive()
            await send({"type": "websocket.close", "code": 1008})

    def _knows(self, headers: dict[str, str], host: str) -> bool:
        """Whether the browser has shown the token before, or needs none."""
        if not self._access.token:
            return True
        own = f"{_cookie_name(host)}="
        cookies = [it.strip() for it in headers.get("cookie", "").split(";")]
        return any(
            self._access.allows_token(it.removeprefix(own))
            for it in cookies
            if it.startswith(own)
        )

    def _cookie(self, host: str) -> tuple[str, str]:
        value = f"{_cookie_name(host)}={self._access.token}"
        secure = "; Secure" if self._access.secure else ""
        return "Set-Cookie", f"{value}; Path=/; HttpOnly; SameSite=Strict{secure}"


def _cookie_name(host: str) -> str:
    """Cookies are shared by all ports of a host: another robot has another cookie."""
    try:
        port = urlsplit(f"//{host}").port
    except ValueError:
        port = None
    return f"kille-{port or 'page'}"


def _is_foreign(scope: Scope, headers: dict[str, str]) -> bool:
    """Whether a page of somebody else's asks for what makes the robot work."""
    site = headers.get("sec-fetch-site", "none")
    return scope["path"].startswith("/inside/") and site not in ("same-origin", "none")


def _query(scope: Scope, name: str) -> str:
    found = parse_qs(scope.get("query_string", b"").decode("latin-1"))
    return str(found.get(name, [""])[0])


def _with_headers(send: Send) -> Send:
    """What sends answers with the headers that keep the browser safe."""
    added = [(k.lower().encode(), v.encode()) for k, v in HEADERS.items()]

    async def send_with(message: MutableMapping[str, Any]) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", ()), *added]}
        await send(message)

    return send_with


async def _answer(send: Send, code: int, text: str, *more: tuple[str, str]) -> None:
    body = text.encode()
    headers = [
        (b"content-type", b"text/plain; charset=utf-8"),
        (b"content-length", str(len(body)).encode()),
        *((name.lower().encode(), value.encode("latin-1")) for name, value in more),
    ]
    await send({"type": "http.response.start", "status": code, "headers": headers})
    await send({"type": "http.response.body", "body": body})
