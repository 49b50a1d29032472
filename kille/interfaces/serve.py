"""`kille serve`: the robot's page, for a browser here or, on request, elsewhere."""

from __future__ import annotations

import errno
import io
import secrets
import socket
import webbrowser
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from datetime import datetime
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, NamedTuple

from kille.agent.agent import Agent
from kille.interfaces.formatting import derivation, in_short, introduction
from kille.interfaces.terminal import FINE, complain, console, memory_path
from kille.memory import Memory, MemoryFileError, default_path
from kille.sensors.sensor import Sensor, SensorError
from ttr.safety.unforeseen_errors import report_unforeseen

if TYPE_CHECKING:
    from kille.page.robot_thread import Watch
    from kille.page.server import PageSettings, Second

MISSING = (
    "the page needs Starlette, uvicorn and websockets: "
    "install them by pip install 'kille[page]'"
)


DEAF = {
    "language": "The page has no microphone: the robot can hear English only.",
    "pocketsphinx": "The page has no microphone: to be heard, pip install "
    "'kille[speech]'.",
}
"""What is told where no microphone can be heard, by the reason."""

_TAKEN = (errno.EADDRINUSE, getattr(errno, "WSAEACCES", errno.EADDRINUSE))
_ELSEWHERE = (
    errno.EADDRNOTAVAIL,
    getattr(errno, "WSAEADDRNOTAVAIL", errno.EADDRNOTAVAIL),
)


class Against(NamedTuple):
    """A robot that stands beside the first: what makes it, with which language, mode
    and wording; the file of its memory, if it has any; what the theories of the two
    are called."""

    make: Callable[..., Agent]
    settings: Mapping[str, str]
    names: tuple[str, str]
    memory: Path | None = None


def serve(
    sensor: str,
    memory: Path | None,
    *,
    host: str = "127.0.0.1",
    port: int = 8765,
    show: bool = False,
    language: str = "en",
    mode: str = "",
    wording: str = "",
    make: Callable[..., Agent] = Agent,
    against: Against | None = None,
) -> int:
    """Serve the robot's page until Ctrl-C; returns the exit code.

    Where others than this machine reach the `host`, the page speaks TLS and needs a
    token. With `show` it is opened in a browser; `make` makes the robot, `against` the
    one that stands beside it.
    """
    try:
        from kille.page.microphone import why_deaf
        from kille.page.server import Terminal, serve_page
        from kille.page.state_changes import Insight
    except ImportError:
        return complain(MISSING)
    place = memory_path(memory)

    def robot(of: Sensor, watch: Watch) -> Agent:
        return make(
            of,
            place,
            language=language,
            mode=mode,
            wording=wording,
            record_event=watch.record_event,
            change=watch.change,
        )

    try:
        settings = _settings(host, port)
    except OSError as error:
        return complain(_why_no_page(host, port, error))
    with settings.listener:
        terminal = Terminal(
            lambda woken: _welcome(
                woken, settings, show, why_deaf(woken.language), against
            ),
            complain,
            lambda error: report_unforeseen("kille", error),
        )
        try:
            second = None if against is None else _second(against, place)
            insight = Insight(derivation, in_short)
            serve_page(sensor, robot, settings, terminal, insight, second)
        except (SensorError, MemoryFileError) as error:
            return complain(error)
    return FINE


def _second(against: Against, place: Path) -> Second:
    """The robot that stands beside the first, whose memory is at this place.

    Unless it has a file of its own, it begins with a copy of that, which it does not
    keep.
    """
    from kille.page.server import Second

    def robot(sensor: Sensor, now: Callable[[], datetime]) -> Agent:
        memory = against.memory or Memory.copy_of(place)
        return against.make(sensor, memory, now=now, **against.settings)

    return Second(robot, against.names)


def _settings(host: str, port: int) -> PageSettings:
    """A socket on this host, and what beyond this machine is needed to reach it."""
    from kille.page.guard import Access, is_loopback
    from kille.page.server import PageSettings, listen

    if is_loopback(host):
        return PageSettings(listen(host, port), Access(host))
    from kille.page.certificates import host_certificate

    with ExitStack() as failing:
        listener = failing.enter_context(listen(host, port))
        certificate = host_certificate(host, default_path().parent)
        failing.pop_all()
    console().print(
        "Others can reach this page: it speaks TLS. Its certificate is this host's "
        "own; trust it in the browser if this is its fingerprint (SHA-256):\n"
        f"  {certificate.fingerprint}"
    )
    access = Access(host, secure=True, token=secrets.token_urlsafe(24))
    return PageSettings(listener, access, certificate.path)


def _why_no_page(host: str, port: int, error: OSError) -> str:
    """Why the page cannot listen there, and what to do."""
    if isinstance(error, socket.gaierror) or error.errno in _ELSEWHERE:
        return f"this machine has no host {host}: leave --host out, or name another"
    if isinstance(error, PermissionError) and port < 1024:
        return f"port {port} is for the system: take one from 1024 on with --port N"
    if port and error.errno in _TAKEN:
        return (
            f"port {port} is taken by another program, perhaps another kille serve: "
            "end that, or take another with --port N (0 for any that is free)"
        )
    return f"the page cannot listen on {host}, port {port}: {error.strerror or error}"


def _welcome(
    robot: Agent,
    settings: PageSettings,
    show: bool,
    why_deaf: str,
    against: Against | None,
) -> None:
    """Print where the page is, and open it in a browser if that is wanted."""
    address = _address(settings)
    out = console()
    out.print(introduction(robot))
    if against is not None:
        ours, theirs = against.names
        out.print(
            f"My theory is {ours}. Beside me stands a robot with the theory {theirs}: "
            f"it hears and sees the same, and keeps what it learns "
            f"{f'in {against.memory}' if against.memory else 'until the end'}."
        )
    if deaf := DEAF.get(why_deaf):
        out.print(deaf)
    out.print(f"The page is ready: {address}\nCtrl-C ends it.")
    if settings.access.token and out.is_terminal:
        out.print(f"For a phone:\n{qr_code(address)}", highlight=False)
    if show:
        Thread(target=open_in_browser, args=(address,), daemon=True).start()


def open_in_browser(address: str) -> None:
    """Open an address in this user's browser; say so if there is none."""
    if not webbrowser.open(address):
        complain(f"no browser can be opened here: open {address} yourself")


def _address(settings: PageSettings) -> str:
    """Where the page is: where it listens on all addresses, at the likeliest."""
    from kille.page.guard import own_addresses

    access, port = settings.access, settings.listener.getsockname()[1]
    name = access.host
    if name in ("0.0.0.0", "::"):
        name = next(iter(own_addresses()), socket.gethostname())
    name = f"[{name}]" if ":" in name else name
    address = f"{access.scheme}://{name}:{port}/"
    return f"{address}?token={access.token}" if access.token else address


def qr_code(text: str) -> str:
    """A text as a QR code for a terminal: two rows of it in a line.

    >>> len(qr_code("https://192.0.2.7:8765/").splitlines())
    17
    """
    import segno

    out = io.StringIO()
    segno.make(text, error="l", micro=False).terminal(out, compact=True)
    return out.getvalue()
