"""Takes the pictures of the page anew: `python docs/pictures/page.py`.

It needs `kille[page,browser]` and Debian's chromium, as the tests of the page do.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
LESSON = [(1, "This is a cup."), (2, "This is a car."), (2, "What is this?")]
SERVE = [sys.executable, "-m", "kille.interfaces.cli", "serve", "--port", "0"]


def hold_lesson(tab: Any) -> None:
    """Teach two words, and ask for one."""
    for number, text in LESSON:
        answers = tab.locator(".bubble--robot")
        before = answers.count()
        tab.get_by_role("button", name=f"#{number}, ").click()
        tab.get_by_role("textbox").fill(text)
        tab.get_by_role("textbox").press("Enter")
        answers.nth(before).wait_for()
    tab.mouse.move(2, 2)
    tab.wait_for_timeout(3_000)


def take_pictures(address: str) -> None:
    """Take one of the lesson, and one of the lab."""
    with sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path="/usr/bin/chromium", args=["--no-sandbox"]
        )
        tab = browser.new_page(viewport={"width": 1180, "height": 720})
        tab.goto(address)
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
        browser.close()


def main() -> None:
    """Serve the page, and take its pictures."""
    with TemporaryDirectory() as folder:
        words = ["--sensor", "synthetic:desk?seed=7", "--memory", "memory.db"]
        server = subprocess.Popen(
            [*SERVE, *words],
            stdout=subprocess.PIPE,
            text=True,
            cwd=folder,
            env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        )
        assert server.stdout is not None
        for line in server.stdout:
            if found := re.search(r"http://\S+", line):
                take_pictures(found[0])
                break
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
