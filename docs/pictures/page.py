"""Takes the pictures of the page anew: `python docs/pictures/page.py`.

It needs `kille[page,browser]` and Debian's chromium, as the tests of the page do.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
DESK = ["--sensor", "synthetic:desk?seed=7", "--memory", "memory.db"]
PATIENCE = 120_000
LESSON = [(1, "This is a cup."), (2, "This is a car."), (2, "What is this?")]
STUDY = """\
title = "How sure does it sound?"
seeds = 1
[theories.four-bands]
wording = "four"
[tutors.Ann]
kind = "simulated"
[scenes.table]
kind = "around"
[[phases]]
do = "teach"
"""
SERVE = [sys.executable, "-m", "kille.interfaces.cli", "serve", "--port", "0"]


def hold_lesson(tab: Any, lesson: list[tuple[int, str]] = LESSON) -> None:
    """Teach words, and ask for one."""
    for number, text in lesson:
        answers = tab.locator(".bubble--robot")
        before = answers.count()
        tab.get_by_role("button", name=f"#{number}, ").click()
        tab.get_by_role("textbox").fill(text)
        tab.get_by_role("textbox").press("Enter")
        answers.nth(before).wait_for()
    tab.mouse.move(2, 2)
    tab.wait_for_timeout(3_000)
    tab.evaluate("Promise.all(document.getAnimations().map(it => it.finished))")


@contextmanager
def open_tab(address: str, width: int, height: int) -> Iterator[Any]:
    """The page in a browser of this size."""
    with sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path="/usr/bin/chromium", args=["--no-sandbox"]
        )
        tab = browser.new_page(viewport={"width": width, "height": height})
        tab.set_default_timeout(PATIENCE)
        tab.goto(address)
        yield tab
        browser.close()


def take_pictures(address: str) -> None:
    """Take one of the lesson, and one of the lab."""
    with open_tab(address, 1180, 720) as tab:
        hold_lesson(tab)
        tab.screenshot(path=HERE / "page.png")
        tab.set_viewport_size({"width": 1480, "height": 800})
        tab.get_by_role("button", name="Look inside", exact=True).click()
        tab.locator("#timeline").fill("3")
        tab.locator(".field--changed").first.wait_for()
        tab.locator(".part").nth(1).scroll_into_view_if_needed()
        tab.locator("#lab-body").evaluate("it => it.scrollTop = 330")
        tab.wait_for_timeout(500)
        tab.screenshot(path=HERE / "page_lab.png")


def take_picture_of_two(address: str) -> None:
    """Take one of two robots side by side."""
    with open_tab(address, 1480, 860) as tab:
        tab.get_by_role("button", name="Look inside", exact=True).click()
        hold_lesson(tab, [(1, "This is a cup."), (2, "What is this?")])
        tab.locator(".beside__row--differs").first.wait_for()
        tab.screenshot(path=HERE / "page_beside.png")


def main() -> None:
    """Serve the page, and take its pictures."""
    serve_for(take_pictures)
    serve_for(take_picture_of_two, "--against", "study.toml:four-bands")


def serve_for(take: Callable[[str], None], *words: str) -> None:
    """Serve the page of a robot that knows nothing, for its pictures to be taken."""
    with TemporaryDirectory() as folder:
        Path(folder, "study.toml").write_text(STUDY)
        server = subprocess.Popen(
            [*SERVE, *DESK, *words],
            stdout=subprocess.PIPE,
            text=True,
            cwd=folder,
            env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        )
        assert server.stdout is not None
        for line in server.stdout:
            if found := re.search(r"http://\S+", line):
                take(found[0])
                break
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
