"""`kille serve` as a program: how it begins, how it ends, and what it says."""

from __future__ import annotations

import os
import signal
import socket
import ssl
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from kille.interfaces.cli import main
from kille.interfaces.serve import MISSING
from kille.memory import Memory

from .pages import PATIENCE, Browser, Start

EMPTY = "--sensor", "synthetic:empty?seed=7"


@pytest.mark.parametrize(
    "ending", [signal.SIGTERM, pytest.param(signal.SIGINT, marks=pytest.mark.deep)]
)
def test_it_ends_cleanly(start: Start, ending: int) -> None:
    program = start(*EMPTY)
    assert "know no words for things" in program.said
    with Browser.connect(program.address) as browser:
        browser.ask(do="show", thing="cup", ref="1")
        browser.until("heard", ref="1")
        program.process.send_signal(ending)
        assert program.process.wait(60) == 0
    assert program.process.stderr is not None
    assert program.process.stderr.read() == ""


def test_kill_9_loses_no_lesson_that_was_acknowledged(
    start: Start, tmp_path: Path
) -> None:
    program = start(*EMPTY)
    with Browser.connect(program.address) as browser:
        run = browser.next()["run"]
        browser.ask(do="show", thing="cup", ref="1")
        browser.until("turn", ref="1")
        assert browser.say("This is a cup.")["lessons"]
        program.process.kill()
        program.process.wait(60)
    with Memory.open_to_read(tmp_path / "memory.db") as memory:
        assert memory.counts() == {("object", "cup"): 1}
    with Browser.connect(start(*EMPTY).address, run=run, after=5) as again:
        hello = again.next()
        assert (hello["after"], hello["words"]) == (0, 1)
        assert hello["run"] != run


@pytest.mark.deep
def test_a_second_robot_begins_with_what_the_first_knows_and_keeps_its_own(
    start: Start, tmp_path: Path
) -> None:
    first = start(*EMPTY)
    with Browser.connect(first.address) as browser:
        browser.ask_for("view", do="show", thing="cup")
        assert browser.say("This is a cup.")["lessons"]
    first.process.terminate()
    first.process.wait(60)
    assert main(["init", str(tmp_path / "own")]) == 0
    both = start(*EMPTY, "--against", str(tmp_path / "own"))
    assert "a robot with the theory own" in " ".join(both.said.split())
    with Browser.connect(both.address) as browser:
        assert browser.next()["theories"] == ["packaged", "own"]
        browser.ask_for("beside", do="show", thing="cup")
        browser.say("What is this?")
        assert browser.until("beside")["said"] == "This is a cup."
        assert browser.say("This is a mug.")["lessons"]
        assert browser.until("beside")["lessons"]
    both.process.terminate()
    both.process.wait(60)
    own = tmp_path / "second.db"
    kept = start(*EMPTY, "--against", "packaged", "--against-memory", str(own))
    with Browser.connect(kept.address) as browser:
        browser.ask_for("beside", do="show", thing="cup")
        browser.say("This is a jug.")
        assert browser.until("beside")["failed"] == ""
    kept.process.terminate()
    kept.process.wait(60)
    with Memory.open_to_read(own) as memory:
        assert memory.counts() == {("object", "jug"): 1}


def test_beyond_this_machine_it_speaks_tls_and_needs_a_token(start: Start) -> None:
    program = start(*EMPTY, "--host", "0.0.0.0")
    parts = urlsplit(program.address)
    assert parts.scheme == "https"
    assert "fingerprint (SHA-256)" in program.said
    fingerprint = program.said.split("(SHA-256):")[1].split()[0]
    trusting = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    trusting.check_hostname, trusting.verify_mode = False, ssl.CERT_NONE
    here = f"https://127.0.0.1:{parts.port}"
    with (
        socket.create_connection(("127.0.0.1", parts.port or 0)) as plain,
        trusting.wrap_socket(plain) as secure,
    ):
        shown = ssl.DER_cert_to_PEM_cert(secure.getpeercert(True) or b"")
        secure.sendall(
            f"GET /?{parts.query} HTTP/1.1\r\nHost: 127.0.0.1:{parts.port}\r\n"
            "Connection: close\r\n\r\n".encode()
        )
        answer = b""
        while piece := secure.recv(4096):
            answer += piece
    digest = _fingerprint(shown)
    assert digest == fingerprint
    cookie = next(
        it.partition(": ")[2].partition(";")[0]
        for it in answer.decode().splitlines()
        if it.lower().startswith("set-cookie")
    )
    with Browser.connect(
        here, ssl=trusting, additional_headers={"Cookie": cookie}
    ) as browser:
        assert browser.next()["type"] == "hello"


def _fingerprint(pem: str) -> str:
    from hashlib import sha256

    return sha256(ssl.PEM_cert_to_DER_cert(pem)).digest().hex(":").upper()


# --- what goes wrong before it is ready ----------------------------------------------


def test_a_port_that_is_taken_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert main(["serve", "--port", str(port), *EMPTY]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"port {port} is taken by another program" in line
    assert "--port N" in line


def test_a_memory_in_use_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "memory.db"
    with Memory.open(path):
        code = main(["serve", "--port", "0", "--memory", str(path), *EMPTY])
    assert code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "is in use by another program" in line


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--sensor", "synthetic:nowhere"], "nowhere"),
        (["--sensor", "/nowhere/at/all"], "/nowhere/at/all"),
        (["--host", "no.such.host.invalid"], "no host no.such.host.invalid"),
        (["--host", "203.0.113.9"], "no host 203.0.113.9"),
        (["--theory", "nothing.txt"], "is no theory"),
        (["--against", "nothing.txt"], "is no theory"),
        (["--against", "packaged"], "both robots would have the theory packaged"),
        (["--against-memory", "other.db"], "name its theory by --against"),
    ],
)
def test_what_cannot_be_served_is_one_line(
    words: list[str],
    told: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    memory = ["--memory", str(tmp_path / "memory.db")]
    assert main(["serve", "--port", "0", *memory, *words]) == 2
    said = capsys.readouterr()
    (line,) = said.err.splitlines()
    assert told in line
    assert said.out == ""


@pytest.mark.parametrize("port", ["65536", "-1", "x"])
def test_a_wrong_port_is_one_line(
    port: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as left:
        main(["serve", f"--port={port}"])
    assert left.value.code == 2
    assert "is no port from 0 to 65535" in capsys.readouterr().err


def test_where_no_browser_opens_the_address_is_told() -> None:
    code = "from kille.interfaces.serve import open_in_browser as it; it('http://x/')"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={"PATH": "", "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=True,
    )
    assert (
        done.stderr == "kille: no browser can be opened here: open http://x/ yourself\n"
    )


def test_without_the_extra_it_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in [it for it in sys.modules if it.startswith("kille.page.server")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    assert main(["serve", "--port", "0", *EMPTY]) == 2
    assert MISSING in capsys.readouterr().err
