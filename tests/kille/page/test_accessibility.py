"""Nothing on the page keeps anybody from using it, as far as axe-core can tell."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from browsers import IN_BROWSER, PATIENCE

from .pages import Program, page_starter

playwright = pytest.importorskip(
    "playwright.sync_api", reason="Playwright is not installed: kille[browser]"
)
axe = pytest.importorskip(
    "axe_playwright_python.sync_playwright",
    reason="axe-core is not installed: kille[browser]",
)

pytestmark = [*IN_BROWSER, pytest.mark.deep]


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Program]:
    with page_starter(tmp_path_factory.mktemp("desk")) as begin:
        yield begin("--sensor", "synthetic:desk?seed=7")


@pytest.mark.parametrize("width", [390, 1280])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_serious(
    chromium: Any, desk: Program, scheme: str, width: int
) -> None:
    size = {"width": width, "height": 844}
    with chromium.new_context(
        color_scheme=scheme, viewport=size, bypass_csp=True, reduced_motion="reduce"
    ) as context:
        context.set_default_timeout(PATIENCE)
        tab = context.new_page()
        tab.goto(desk.address)
        playwright.expect(tab.locator(".thing")).to_have_count(3)
        field = tab.get_by_role("textbox", name="Say something")
        for text in ("#1 This is a cup.", "What is this?"):
            field.fill(text)
            field.press("Enter")
            bubbles = tab.locator(".turn:not(.turn--waiting) .bubble--tutor")
            playwright.expect(bubbles.filter(has_text=text).last).to_be_visible()
        assert serious(tab) == []
        tab.get_by_role("button", name="Look inside", exact=True).click()
        playwright.expect(tab.locator(".field").first).to_be_visible()
        assert serious(tab) == []


def serious(tab: Any) -> list[tuple[str, list[str]]]:
    found = axe.Axe().run(tab).response["violations"]
    return [
        (it["id"], [node["html"][:160] for node in it["nodes"]])
        for it in found
        if it["impact"] in ("serious", "critical")
    ]
