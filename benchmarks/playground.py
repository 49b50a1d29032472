"""How long the page that runs theories takes to its first answer, and to the next.

The browser has the files in its cache from the second load on.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread
from time import perf_counter

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

LOADS = 4
CHECKED = "() => document.documentElement.dataset.checked"


def main() -> None:
    """Print seconds from opening the page to the answers to its example."""
    from playwright.sync_api import sync_playwright

    from tools.playground.building import build
    from tools.playground.serving import server_of

    with TemporaryDirectory() as folder:
        build(Path(folder))
        size = sum(it.stat().st_size for it in Path(folder).rglob("*") if it.is_file())
        print(f"size of the page: {size / 1e6:.1f} MB")
        with server_of(Path(folder)) as server, sync_playwright() as driver:
            Thread(target=server.serve_forever, daemon=True).start()
            browser = driver.chromium.launch(
                executable_path=shutil.which("chromium"), args=["--no-sandbox"]
            )
            tab = browser.new_page()
            for number in range(LOADS):
                start = perf_counter()
                tab.goto(f"http://127.0.0.1:{server.server_port}/")
                tab.wait_for_function(CHECKED, timeout=120_000)
                seconds = perf_counter() - start
                print(f"first answer, load {number + 1}: {seconds:.1f} s")
            start = perf_counter()
            tab.click("#check")
            tab.wait_for_function(f"{CHECKED} === '2'", timeout=60_000)
            print(f"next answer: {perf_counter() - start:.2f} s")
            browser.close()
            server.shutdown()


if __name__ == "__main__":
    if shutil.which("chromium") is None:
        print("not measured: there is no chromium; make oracles installs it")
    else:
        main()
