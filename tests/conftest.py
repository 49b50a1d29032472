"""What all tests share: hypothesis profiles, the real captures, the optional tests."""

from __future__ import annotations

import gc
import os
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

from browsers import CHROMIUM, PATIENCE, Tab
from kille.sensors.synthetic import faults

ROOT = Path(__file__).resolve().parent.parent

# Optional tests need something a fresh clone does not have; the run says at its end
# which of them were really run.
OPTIONAL = ("browser", "data", "oracle", "ros", "speech")

# What is interned and cached grows with the tests: to look through all of it for
# garbage takes a twentieth of the run if that is done as often as in a small program.
gc.set_threshold(20_000, 20, 100)

settings.register_profile("dev", max_examples=50, deadline=None)
settings.register_profile(
    "ci", max_examples=45, derandomize=True, deadline=None, print_blob=True
)
settings.register_profile("deep", max_examples=5_000, deadline=None)
settings.register_profile("release", max_examples=100_000, deadline=None)
settings.load_profile(
    os.environ.get("HYPOTHESIS_PROFILE") or ("ci" if os.environ.get("CI") else "dev")
)


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real captures, or a skip that says where it was looked for."""
    folder = Path(os.environ.get("KILLE_DATA") or ROOT.parent / "shared" / "data")
    if not folder.is_dir():
        pytest.skip(f"no real captures in {folder}: set KILLE_DATA to their folder")
    return folder


@pytest.fixture(scope="session", autouse=True)
def _noise_of_frames_drawn_once() -> Iterator[None]:
    """Draws the noise of a frame once for all tests of a process.

    The noise of the n-th frame of a seed is the same in every scene, and to draw it
    takes two thirds of the time of a frame.
    """
    drawn = lru_cache(maxsize=120)(faults.standard_noise)  # up to 150 MB

    def noise(shape: tuple[int, ...], seed: tuple[int, ...]) -> Any:
        found = drawn(shape, seed)
        found.flags.writeable = False
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(faults, "standard_noise", noise)
        yield


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """Chromium, one for all tests of a process: a process can drive only one.

    As long as it runs there is an event loop in this thread: a test that needs one
    of its own takes a thread for it.
    """
    from playwright.sync_api import expect, sync_playwright

    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox"]
        )
        yield browser
        browser.close()


@pytest.fixture
def tab(chromium: Any) -> Iterator[Tab]:
    """A tab in which nothing goes wrong that the test did not ask for."""
    with chromium.new_context(viewport={"width": 1280, "height": 800}) as context:
        context.set_default_timeout(PATIENCE)
        wrong: list[str] = []
        made = context.new_page()
        made.on("pageerror", lambda error: wrong.append(str(error)))
        made.on("dialog", lambda it: (wrong.append(it.message), it.dismiss()))
        yield made
        assert wrong == []


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what uses the captures, and let reports carry the optional marks."""
    for item in items:
        if "data" in getattr(item, "fixturenames", ()):
            item.add_marker("data")
        for name in OPTIONAL:
            if item.get_closest_marker(name):
                item.user_properties.append(("optional", name))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print which optional tests ran: one line for each file that has any."""
    counts: Counter[tuple[str, str, str]] = Counter()
    for outcome in ("passed", "failed", "error", "skipped"):
        for report in terminalreporter.getreports(outcome):
            for key, name in getattr(report, "user_properties", ()):
                if key == "optional":
                    counts[name, report.nodeid.partition("::")[0], outcome] += 1
    terminalreporter.section("optional tests")
    if not counts:
        terminalreporter.line("none in this run")
    for (name, file, outcome), count in sorted(counts.items()):
        terminalreporter.line(f"{name}: {file}: {count} {outcome}")
