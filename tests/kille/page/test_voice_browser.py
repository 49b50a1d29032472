"""Speaking with the robot in a real browser, whose microphone plays a file."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from shutil import which
from typing import Any

import pytest

from browsers import CHROMIUM, IN_BROWSER, PATIENCE, Tab
from kille.speech.sound import RATE, Sound, read_wav, write_wav

from .pages import Program, Start

playwright = pytest.importorskip(
    "playwright.sync_api", reason="Playwright is not installed: kille[browser]"
)
pytest.importorskip("pocketsphinx", reason="kille[speech] is not installed")

pytestmark = [
    *IN_BROWSER,
    pytest.mark.speech,
    pytest.mark.deep,
    pytest.mark.skipif(which("flite") is None, reason="apt install flite"),
]

EMPTY = "--sensor", "synthetic:empty?seed=7"
SAID = 200.0
"""Seconds in which a lesson is heard on a busy machine."""


@pytest.fixture
def speaking(chromium: Any, tmp_path: Path) -> Iterator[Callable[..., Tab]]:
    """Opens a browser in front of whose microphone these sentences are said, again and
    again, with pauses between them."""
    opened = []

    def begin(*texts: str, pause: float = 3.0) -> Tab:
        path = tmp_path / f"said {len(opened)}.wav"
        silence = bytes(2 * int(pause * RATE))
        samples = b"".join(silence + _say(it) for it in texts)
        path.write_bytes(write_wav(Sound(RATE, samples + silence)))
        browser = chromium.browser_type.launch(
            executable_path=CHROMIUM,
            args=[
                "--no-sandbox",
                "--use-fake-device-for-media-stream",
                "--use-fake-ui-for-media-stream",
                "--autoplay-policy=no-user-gesture-required",
                f"--use-file-for-fake-audio-capture={path}",
            ],
        )
        opened.append(browser)
        context = browser.new_context(
            ignore_https_errors=True, permissions=["microphone"]
        )
        context.set_default_timeout(PATIENCE)
        return context.new_page()

    yield begin
    for browser in opened:
        browser.close()


def _say(text: str) -> bytes:
    command = ["flite", "-voice", "rms", "-t", text, "-o", "/dev/stdout"]
    done = subprocess.run(command, capture_output=True, check=True)
    return read_wav(done.stdout).at(RATE).samples


def visit(tab: Tab, address: str) -> None:
    tab.goto(address)
    playwright.expect(tab.locator("html[data-ready]")).to_have_count(1)


def expect_answer(tab: Tab, text: str) -> None:
    robot = tab.locator(".bubble--robot").filter(has_text=text).first
    playwright.expect(robot).to_be_visible(timeout=SAID * 1000)


@pytest.mark.parametrize("host", ["127.0.0.1", "0.0.0.0"], ids=["loopback", "TLS"])
def test_a_lesson_by_voice(
    start: Start, speaking: Callable[..., Tab], host: str
) -> None:
    program: Program = start(*EMPTY, "--host", host)
    tab = speaking("This is a cup.", "What is this?")
    visit(tab, program.address)
    tab.get_by_text("Change what is on the table").click()
    tab.get_by_role("button", name="Put the cup on the table").click()
    playwright.expect(tab.locator(".thing")).to_have_count(1)
    tab.get_by_role("button", name="Open microphone").click()
    expect_answer(tab, "I learned a cup")
    expect_answer(tab, "This is a cup.")
    heard = tab.locator(".chips--heard").first
    playwright.expect(heard).to_contain_text("Heard as")
    playwright.expect(tab.locator("#fact-microphone")).to_have_text("here")
    tab.get_by_role("button", name="Open microphone").click()
    playwright.expect(tab.locator("#fact-microphone")).to_have_text("nobody’s")
