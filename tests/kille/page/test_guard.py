"""Who may reach the page, and what it tells a browser to refuse."""

from __future__ import annotations

import json
from collections.abc import Iterator
from http.client import HTTPConnection, HTTPResponse
from socket import create_connection
from typing import Any

import pytest
from websockets.exceptions import InvalidStatus

from kille.page.guard import Access
from kille.sensors.sources import open_sensor

from .pages import Page, page_of

TOKEN = "a-token-of-the-test"


@pytest.fixture(scope="module")
def guarded_page() -> Iterator[Page]:
    """A page that needs a token."""
    access = Access("127.0.0.1", token=TOKEN)
    with page_of(open_sensor("synthetic:empty"), access=access) as made:
        yield made


def fetch_json(page: Page, path: str) -> Any:
    connection = HTTPConnection(page.host, timeout=60)
    connection.request("GET", path)
    with connection.getresponse() as answer:
        found = json.loads(answer.read())
    connection.close()
    return found


def get(
    page: Page, path: str = "/", method: str = "GET", **headers: str
) -> HTTPResponse:
    connection = HTTPConnection(page.host, timeout=60)
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    connection.request(method, path, headers=named)
    answer = connection.getresponse()
    answer.read()
    connection.close()
    return answer


@pytest.mark.parametrize("path", ["/", "/page.css", "/main.js", "/icon.svg"])
def test_every_file_of_the_page_has_headers_that_keep_a_browser_safe(
    page: Page, path: str
) -> None:
    answer = get(page, path)
    assert answer.status == 200
    policy = answer.headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert "frame-ancestors 'none'" in policy
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert answer.headers["Server"] is None


@pytest.mark.parametrize("path", ["/../app.py", "/%2e%2e/app.py", "/app.py", "/nope"])
def test_there_are_no_other_files(page: Page, path: str) -> None:
    assert get(page, path).status == 404


@pytest.mark.parametrize(
    "host",
    ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "[::2]", "a@b", ""],
)
def test_a_foreign_name_is_refused(page: Page, host: str) -> None:
    assert get(page, Host=host).status == 421


def test_own_names_are_not(page: Page) -> None:
    port = page.host.partition(":")[2]
    for name in ("localhost", "127.0.0.1", "[::1]", "LOCALHOST"):
        assert get(page, Host=f"{name}:{port}").status == 200


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "TRACE"])
def test_nothing_is_sent_but_over_the_socket(page: Page, method: str) -> None:
    assert get(page, method=method).status == 405


@pytest.mark.parametrize(
    "origin",
    [None, "null", "http://evil.example", "http://localhost:1", "https://127.0.0.1"],
)
def test_a_page_of_somebody_else_cannot_speak_to_the_robot(
    page: Page, origin: str | None
) -> None:
    with pytest.raises(InvalidStatus) as refused:
        page.connect(origin=origin)
    assert refused.value.response.status_code == 403


def test_a_token_comes_once_in_the_address_and_then_in_a_cookie(
    guarded_page: Page,
) -> None:
    assert get(guarded_page).status == 403
    assert get(guarded_page, "/main.js").status == 403
    assert get(guarded_page, "/?token=wrong").status == 403
    assert get(guarded_page, "/?token=%00%ff").status == 403
    answer = get(guarded_page, f"/?token={TOKEN}")
    assert (answer.status, answer.headers["Location"]) == (303, "/")
    whole = answer.headers["Set-Cookie"]
    assert "HttpOnly" in whole
    assert "SameSite=Strict" in whole
    cookie = whole.partition(";")[0]
    assert get(guarded_page, Cookie=f"other=1; {cookie}").status == 200
    assert get(guarded_page, Cookie=f"{cookie}x").status == 403
    with guarded_page.connect(additional_headers={"Cookie": cookie}) as browser:
        assert browser.next()["type"] == "hello"


def test_without_the_token_there_is_no_socket(guarded_page: Page) -> None:
    with pytest.raises(InvalidStatus):
        guarded_page.connect()


# --- looking inside ------------------------------------------------------------------


def test_a_turn_has_an_inside_with_what_changed_marked(page: Page) -> None:
    with page.connect() as browser:
        turn = browser.say("Is <b>this</b> a cup & more?")
        turn = browser.say("Hello.")
    first, last = turn["turns"]
    found = fetch_json(page, f"/inside/{first}/{last}")
    assert ["rule", "hear"] in [[kind, text[:4]] for kind, text in found["lines"]]
    assert [it["name"] for it in found["state"]] == ["shared", "view", "private"]
    shared = {it["name"]: it for it in found["state"][0]["fields"]}
    assert shared["latest"]["changed"]
    assert "ttr-changed" in shared["latest"]["html"]
    assert not shared["frame"]["changed"]
    inside = "".join(it["html"] for part in found["state"] for it in part["fields"])
    assert "<script" not in inside
    assert "style=" not in inside


@pytest.mark.parametrize("path", ["0/0", "5/2", "0/99", "999/1000", "-1/1", "a/b"])
def test_a_turn_that_was_not_taken_has_none(page: Page, path: str) -> None:
    assert get(page, f"/inside/{path}").status == 404


@pytest.mark.parametrize(
    ("site", "status"),
    [("cross-site", 403), ("same-site", 403), ("same-origin", 404), ("none", 404)],
)
def test_only_its_own_page_looks_inside(page: Page, site: str, status: int) -> None:
    assert get(page, "/inside/998/999", Sec_Fetch_Site=site).status == status


def test_a_foreign_name_has_no_socket(page: Page) -> None:
    host = f"evil.example:{page.host.partition(':')[2]}"
    with create_connection(
        ("127.0.0.1", int(page.host.partition(":")[2])), 60
    ) as plain:
        plain.sendall(
            f"GET /live HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n"
            "Connection: Upgrade\r\nUpgrade: websocket\r\n"
            "Sec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n".encode()
        )
        assert plain.recv(64).startswith(b"HTTP/1.1 403")


def test_the_inside_is_behind_the_token(guarded_page: Page) -> None:
    assert get(guarded_page, "/inside/0/1").status == 403
