"""What tests in a real browser share: which browser, and how long they wait for it."""

from __future__ import annotations

import shutil
from importlib.util import find_spec
from typing import Any

import pytest

CHROMIUM = shutil.which("chromium")
PATIENCE = 60_000
"""Milliseconds after which a test gives a page up."""

Tab = Any
"""A page of Playwright's."""

IN_BROWSER = (
    pytest.mark.browser,
    pytest.mark.slow,
    pytest.mark.skipif(
        find_spec("playwright") is None,
        reason="Playwright is not installed: kille[browser]",
    ),
    pytest.mark.skipif(
        CHROMIUM is None, reason="there is no chromium: make oracles installs it"
    ),
)
"""The marks of a test that takes a browser; its fixture is `chromium` or `tab`."""
