"""How fast the page is, in headless Chromium before the simulated Kinect.

    python benchmarks/page.py [--seconds 10] [--turns 1000]

Frames a second that are drawn, and what of a core the server takes for it; from a click
to the thing that is marked, and from Enter to an answer for which nothing is looked at;
how soon it is ready and painted, and how much is sent before the first picture; four
browsers at once; and how the memories of the server and of a browser grow with turns,
when the page has as many as it keeps. The server is a process of its own. Its processor
time has the simulated camera in it, which is measured by itself: what is left is the
page's.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from kille.sensors.sources import open_sensor

SENSOR = "synthetic:desk?seed=7"
SERVE = [sys.executable, "-m", "kille.interfaces.cli", "serve", "--port", "0"]
CLICKS = 21
KEPT = 320
"""Turns after which the page keeps no more of them."""

TICKS = os.sysconf("SC_CLK_TCK")


class Server(NamedTuple):
    """A page that is served by a process of its own."""

    pid: int
    address: str
    ready: float

    def cpu(self) -> float:
        """The seconds of processor that it has taken."""
        fields = Path(f"/proc/{self.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / TICKS

    def memory(self) -> int:
        """Its bytes in memory."""
        pages = Path(f"/proc/{self.pid}/statm").read_text().split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE")


@contextmanager
def running_server() -> Iterator[Server]:
    with TemporaryDirectory() as folder:
        words = ["--sensor", SENSOR, "--memory", str(Path(folder, "memory.db"))]
        began = time.perf_counter()
        process = subprocess.Popen([*SERVE, *words], stdout=subprocess.PIPE, text=True)
        assert process.stdout is not None
        try:
            for line in process.stdout:
                if found := re.search(r"http://\S+", line):
                    break
            yield Server(process.pid, found[0], time.perf_counter() - began)
        finally:
            process.terminate()
            process.wait()


def show(what: str, value: float, unit: str, limit: str) -> None:
    print(f"{what:58} {value:9.1f} {unit:6} ({limit})", flush=True)


def camera_share(seconds: float) -> float:
    """What of a core the simulated camera takes for thirty frames a second."""
    sensor = open_sensor(SENSOR)
    sensor.frame()
    began, frames = time.process_time(), int(30 * seconds)
    for _ in range(frames):
        sensor.frame()
    spent = time.process_time() - began
    sensor.close()
    return spent / seconds


def open_tab(browser: Any, server: Server) -> Any:
    tab = browser.new_page()
    tab.goto(server.address)
    tab.locator(".thing").nth(2).wait_for()
    return tab


def count_drawn(tab: Any) -> int:
    return int(tab.locator("#picture").get_attribute("data-pictures") or 0)


def frame_rate(tab: Any, server: Server, seconds: float) -> tuple[float, float]:
    """The frames that are drawn in a second, and what of a core the server takes."""
    count, cpu, began = count_drawn(tab), server.cpu(), time.perf_counter()
    tab.wait_for_timeout(seconds * 1000)
    took = time.perf_counter() - began
    return (count_drawn(tab) - count) / took, (server.cpu() - cpu) / took


def milliseconds(tab: Any, act: str, done: str) -> float:
    """How long it takes in the page until a selector is there after something is done.

    Both are watched in the browser, so that no call from here is in it.
    """
    script = f"""() => new Promise((resolve) => {{
      const began = performance.now();
      const seen = () => {{
        if (!document.querySelector({json.dumps(done)})) return;
        watching.disconnect();
        requestAnimationFrame(() => resolve(performance.now() - began));
      }};
      const watching = new MutationObserver(seen);
      const all = {{subtree: true, childList: true, attributes: true}};
      watching.observe(document.body, all);
      {act}
    }})"""
    return float(tab.evaluate(script))


def click_time(tab: Any) -> float:
    times = []
    for number in range(CLICKS):
        thing = number % 3 + 1
        button = f'.thing[data-thing="{thing}"]'
        act = f"document.querySelector({json.dumps(button)}).click();"
        times.append(milliseconds(tab, act, f'{button}[aria-pressed="true"]'))
    return median(times)


def answer_time(tab: Any) -> float:
    times = []
    for number in range(CLICKS):
        count = tab.locator(".turns .turn").count() + 1
        act = (
            "document.querySelector('#text').value = 'Hello.';"
            "document.querySelector('#say').requestSubmit();"
        )
        done = f".turn:nth-child({count}) .bubble--robot"
        took = milliseconds(tab, act, done)
        if number:
            times.append(took)
    return median(times)


def weight_before_frames(browser: Any, server: Server) -> int:
    """The bytes of all files of the page."""
    tab = browser.new_page()
    sent: list[Any] = []
    tab.on("response", lambda it: sent.append(it))
    tab.goto(server.address)
    tab.locator(".thing").nth(2).wait_for()
    size = sum(len(it.body()) for it in sent)
    tab.close()
    return size


def first_paint(browser: Any, server: Server) -> float:
    tab = browser.new_page()
    tab.goto(server.address)
    tab.locator(".thing").nth(2).wait_for()
    script = "performance.getEntriesByName('first-contentful-paint')[0].startTime"
    found = float(tab.evaluate(script))
    tab.close()
    return found


def heap_size(tab: Any) -> int:
    """The bytes of all that the page's scripts have kept."""
    session = tab.context.new_cdp_session(tab)
    session.send("HeapProfiler.enable")
    session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    return int(used)


def take_turns(server: Server, turns: int, after: Callable[[int], None]) -> None:
    """Take turns for which nothing is looked at, over the socket."""
    from websockets.sync.client import connect

    address = server.address.replace("http", "ws", 1) + "live"
    origin = server.address.rstrip("/")
    with connect(address, origin=origin, max_queue=None) as socket:
        for number in range(turns):
            ref = f"t{number}"
            socket.send(json.dumps({"do": "say", "text": "Hello.", "ref": ref}))
            while True:
                message = socket.recv()
                if isinstance(message, str):
                    event = json.loads(message)
                    if event["type"] == "view" and event["ref"] == ref:
                        break
            after(number + 1)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--turns", type=int, default=1_000)
    options = parser.parse_args()
    chromium = shutil.which("chromium")
    if chromium is None or not all(map(find_spec, ("playwright", "websockets"))):
        print("it takes chromium (make oracles) and kille[page,browser]")
        return
    from playwright.sync_api import sync_playwright

    camera = camera_share(options.seconds)
    with running_server() as server, sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=chromium, args=["--no-sandbox"]
        )
        context = browser.new_context(bypass_csp=True)  # for the clocks above
        show("ready after", server.ready * 1000, "ms", "at most 2,000")
        show("first paint", first_paint(context, server), "ms", "at most 1,000")
        weight = weight_before_frames(context, server) / 1000
        show("sent before frames", weight, "kB", "at most 250")
        tab = open_tab(context, server)
        fps, cpu = frame_rate(tab, server, options.seconds)
        show("frames shown in a second", fps, "", "at least 25")
        show("the server, of a core", 100 * cpu, "%", "")
        show("of which is the simulated camera", 100 * camera * fps / 30, "%", "")
        own = 100 * (cpu - camera * fps / 30)
        show("of which is the page", own, "%", "at most 15")
        show("from a click to the mark", click_time(tab), "ms", "median, at most 50")
        show("from Enter to an answer", answer_time(tab), "ms", "median, at most 50")
        others = [open_tab(context, server) for _ in range(3)]
        fps, cpu = frame_rate(tab, server, options.seconds)
        show("frames shown in a second in the first of four", fps, "", "at least 25")
        show("the server, of a core, with four", 100 * cpu, "%", "")
        for it in others:
            it.close()
        sizes: dict[int, tuple[int, int]] = {}

        def keep(number: int) -> None:
            if number in (KEPT, KEPT + options.turns):
                sizes[number] = server.memory(), heap_size(tab)

        take_turns(server, KEPT + options.turns, keep)
        for n, whose in enumerate(("the server", "the browser")):
            before, after = (sizes[it][n] for it in sorted(sizes))
            what = f"memory of {whose} after {options.turns} more turns"
            show(what, 100 * (after / before - 1), "%", "at most 20 more")
            show("which is", after / 1e6, "MB", "")
        browser.close()


if __name__ == "__main__":
    main()
