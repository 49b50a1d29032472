"""The page in a real browser: lessons by mouse and by keys, and coming back."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from browsers import IN_BROWSER, PATIENCE, Tab
from kille.sensors.sources import open_sensor

from .pages import Browser, Page, Program, Start, page_of

playwright = pytest.importorskip(
    "playwright.sync_api", reason="Playwright is not installed: kille[browser]"
)

pytestmark = [*IN_BROWSER]

DESK = "--sensor", "synthetic:desk?seed=7"
EMPTY = "--sensor", "synthetic:empty?seed=7"


@pytest.fixture(scope="module")
def desk() -> Iterator[Page]:
    """The page of a robot before a desk on which a cup, a car and a book lie."""
    with page_of(open_sensor(DESK[1])) as page, page.connect() as browser:
        browser.ask_for("view", do="look")
        yield page


def open_page(tab: Tab, page: Page | Program) -> None:
    """Open the page, and wait until it shows all that has happened."""
    tab.goto(page.address)
    playwright.expect(tab.locator("html[data-ready]")).to_have_count(1)


def visit(tab: Tab, page: Page | Program, things: int = 3) -> None:
    """Open the page, and wait until it shows so many things."""
    open_page(tab, page)
    expect_things(tab, things)


def expect_things(tab: Tab, count: int) -> None:
    playwright.expect(tab.locator(".thing")).to_have_count(count)


def thing(tab: Tab, number: int) -> Any:
    return tab.get_by_role("button", name=f"#{number}, ")


@contextmanager
def await_answer(tab: Tab, text: str) -> Iterator[None]:
    """Wait until the robot has answered something with such a text in it."""
    turns = tab.locator(".turns .turn")
    number = turns.count()
    yield
    robot = turns.nth(number).locator(".bubble--robot").first
    playwright.expect(robot).to_contain_text(text)


def say(tab: Tab, text: str, answer: str) -> None:
    field = tab.get_by_role("textbox", name="Say something")
    with await_answer(tab, answer):
        field.fill(text)
        field.press("Enter")


def press(tab: Tab, name: str, answer: str) -> None:
    """Press a button that says something."""
    with await_answer(tab, answer):
        tab.get_by_role("button", name=name, exact=True).click()


def test_a_lesson_by_clicks(desk: Page, tab: Tab) -> None:
    visit(tab, desk)
    thing(tab, 2).click()
    playwright.expect(thing(tab, 2)).to_have_attribute("aria-pressed", "true")
    say(tab, "This is a car.", "#2) is a car")
    tab.get_by_role("button", name="#2, car, 100 %").hover()
    playwright.expect(tab.get_by_role("tooltip")).to_contain_text("car100 %")
    playwright.expect(tab.locator("#fact-words")).to_have_text("1")
    say(tab, "What is this?", "This is a car.")
    press(tab, "Why?", "Because")
    # On the picture itself, where the book lies.
    box = tab.locator("#stage").bounding_box()
    tab.mouse.click(box["x"] + box["width"] * 0.29, box["y"] + box["height"] * 0.43)
    playwright.expect(thing(tab, 3)).to_have_attribute("aria-pressed", "true")
    say(tab, "This is a cup.", "is a cup")
    press(tab, "Undo", "OK, I forgot that")
    playwright.expect(tab.locator("#fact-words")).to_have_text("1")
    say(tab, "This is sugar.", "kind of thing?")
    press(tab, "Yes.", "OK")
    playwright.expect(tab.locator("#answers")).to_be_hidden()


def test_a_second_click_is_that(desk: Page, tab: Tab) -> None:
    visit(tab, desk)
    thing(tab, 3).click()
    playwright.expect(thing(tab, 3)).to_have_accessible_name(re.compile(r"\(this\)"))
    thing(tab, 1).click()
    playwright.expect(thing(tab, 1)).to_have_accessible_name(re.compile(r"\(that\)"))
    playwright.expect(thing(tab, 3)).to_have_accessible_name(re.compile(r"\(this\)"))
    say(tab, "This is to the left of that.", "this relation is called")
    tab.keyboard.press("Tab")
    for key in "1", "2", "2":  # at last it is "this", and there is no "that"
        tab.keyboard.press(key)
    playwright.expect(thing(tab, 2)).to_have_accessible_name(re.compile(r"\(this\)"))
    playwright.expect(thing(tab, 1)).to_have_attribute("aria-pressed", "false")


def test_things_are_placed_turned_and_removed_by_hand(tab: Tab) -> None:
    with page_of(open_sensor(EMPTY[1])) as page:
        visit(tab, page, things=0)
        _arrange_a_cup(tab)


def _arrange_a_cup(tab: Tab) -> None:
    tab.get_by_text("Change what is on the table").click()
    tab.get_by_role("button", name="Put the cup on the table").click()
    expect_things(tab, 1)
    cup = tab.locator("[data-placed=cup]")
    cup.focus()
    tab.keyboard.press("Shift+ArrowRight")
    tab.keyboard.press("r")
    named = playwright.expect(cup)
    named.to_have_accessible_name(re.compile("5 cm right, 0 cm away, turned 15°"))
    # By dragging: the robot sees it where it is then.
    board, before = tab.locator(".plan").bounding_box(), thing(tab, 1).bounding_box()
    middle = cup.bounding_box()
    x, y = middle["x"] + middle["width"] / 2, middle["y"] + middle["height"] / 2
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x - board["width"] / 5, y, steps=3)
    tab.mouse.up()
    named.to_have_accessible_name(re.compile("-23 cm right"))
    tab.wait_for_function(
        "x => document.querySelector('.thing').getBoundingClientRect().x < x - 50",
        arg=before["x"],
    )
    cup.focus()
    tab.keyboard.press("Delete")
    expect_things(tab, 0)


def test_a_region_of_ones_own_is_drawn_over_nothing_in_particular(
    desk: Page, tab: Tab
) -> None:
    visit(tab, desk)
    thing(tab, 3).click()
    playwright.expect(thing(tab, 3)).to_have_attribute("aria-pressed", "true")
    box = tab.locator("#stage").bounding_box()
    tab.mouse.move(box["x"] + 300, box["y"] + 420)
    tab.mouse.down()
    tab.mouse.move(box["x"] + 360, box["y"] + 460, steps=2)
    # While it is being drawn, somebody else has the robot look.
    with Browser.connect(desk.address) as other:
        looked = other.ask_for("view", do="look")["id"]
    playwright.expect(tab.locator(f"html[data-shown='{looked}']")).to_have_count(1)
    tab.mouse.move(box["x"] + 420, box["y"] + 500, steps=2)
    tab.mouse.up()
    playwright.expect(tab.locator(".stage__box--sent")).to_be_visible()
    playwright.expect(thing(tab, 3)).to_have_attribute("aria-pressed", "false")
    say(tab, "This is a plank.", "is a plank")
    expect_things(tab, 4)


def test_hostile_words_stay_words(desk: Page, tab: Tab) -> None:
    open_page(tab, desk)
    words = "<img src=x onerror=alert(1)></p><script>alert(2)</script>"
    say(tab, words, "I did not understand")
    playwright.expect(tab.locator(".bubble--tutor").last).to_contain_text(words)
    assert tab.locator("#turns img, #turns script").count() == 0


def test_the_lab_shows_what_each_turn_changed(desk: Page, tab: Tab) -> None:
    open_page(tab, desk)
    say(tab, "Hello.", "Hello")
    tab.get_by_role("button", name="Look inside", exact=True).click()
    title = tab.locator("#lab-title")
    playwright.expect(title).to_contain_text("Hello.")
    changed = tab.locator(".field--changed")
    playwright.expect(changed.filter(has_text="latest").first).to_be_visible()
    assert tab.locator("#lab .ttr-changed").count() > 0
    tab.get_by_role("slider", name="Turn").press("Home")
    playwright.expect(title).to_contain_text("Turn 1: it looked")
    playwright.expect(tab.locator(".step").first).to_contain_text("see")
    say(tab, "Thank you.", "welcome")
    playwright.expect(title).to_contain_text("Turn 1: it looked")
    # The picture is that of the turn, too, until somebody goes back to now.
    replayed = playwright.expect(tab.locator("#replay"))
    replayed.to_contain_text("As it was: Turn 1")
    playwright.expect(thing(tab, 1)).to_have_count(1)
    assert tab.locator("#things").evaluate("it => it.inert")
    tab.get_by_role("button", name="Back to now").press("Enter")
    replayed.to_be_hidden()
    playwright.expect(tab.get_by_role("slider", name="Turn")).to_be_focused()
    playwright.expect(title).to_contain_text("Thank you.")
    tab.get_by_text("Rules that did not fire, and why").click()
    tab.locator(".unfired__event[open] .step summary").first.click()
    playwright.expect(tab.locator(".unfired__event li b").first).not_to_be_empty()
    say(tab, "#1 This is a jug.", "a jug")
    tab.locator("#shelf summary").click()
    jug = tab.locator("#shelf").get_by_role("button", name="jug 1")
    jug.press("Enter")
    playwright.expect(jug).to_have_attribute("aria-pressed", "true")
    playwright.expect(jug).to_be_focused()
    example = tab.get_by_role("img", name=re.compile("^jug, 20"))
    playwright.expect(example).to_be_visible()
    assert example.evaluate("async it => (await it.decode(), it.naturalWidth)") > 20
    tab.get_by_role("slider", name="Turn").press("ArrowLeft")
    tab.get_by_text("Save as a file").click()
    with tab.expect_download() as saved:
        tab.get_by_role("link", name="This turn: story (.dlg)").click()
    assert "U> Thank you." in saved.value.path().read_text()


def test_a_turn_is_stepped_through(desk: Page, tab: Tab) -> None:
    open_page(tab, desk)
    playwright.expect(thing(tab, 1)).to_be_visible()  # it has looked
    tab.get_by_role("button", name="Look inside", exact=True).click()
    toggle = tab.get_by_role("button", name="Step before every rule")
    toggle.click()
    playwright.expect(toggle).to_have_attribute("aria-pressed", "true")
    waits = tab.locator("#step")
    field = tab.get_by_role("textbox", name="Say something")
    field.fill("Hello.")
    field.press("Enter")
    playwright.expect(waits).to_contain_text("It waits before hear")
    waits.get_by_role("button", name="Step").click()
    playwright.expect(waits).to_contain_text("GreetBack")
    waits.get_by_role("button", name="Go on").click()
    playwright.expect(waits).to_be_hidden()
    playwright.expect(tab.locator(".bubble--robot").last).to_contain_text("Hello.")
    toggle.click()
    playwright.expect(toggle).to_have_attribute("aria-pressed", "false")


def test_a_lesson_by_keys_alone(start: Start, tab: Tab) -> None:
    visit(tab, start(*EMPTY), things=0)
    keys = tab.keyboard
    playwright.expect(tab.get_by_text("Nothing is in view.")).to_be_visible()
    press_until(tab, "Change what is on the table")
    keys.press("Enter")
    press_until(tab, "Put the cup on the table")
    keys.press("Enter")
    expect_things(tab, 1)
    # What was put there has the focus, to be moved; nothing that is pressed loses it.
    playwright.expect(tab.locator("[data-placed=cup]")).to_be_focused()
    keys.press("1")
    playwright.expect(thing(tab, 1)).to_be_focused()
    keys.press("/")
    with await_answer(tab, "I learned a cup"):
        keys.type("This is a cup.")
        keys.press("Enter")
    with await_answer(tab, "This is a cup."):
        keys.type("What is this?")
        keys.press("Enter")
    keys.press("Shift+Tab")
    keys.press("Shift+Tab")
    right = tab.get_by_role("button", name="That is correct.")
    playwright.expect(right).to_be_focused()
    with await_answer(tab, "OK"):
        keys.press("Enter")
    field = tab.get_by_role("textbox", name="Say something")
    playwright.expect(field).to_be_focused()
    press_until(tab, "Mark a region")
    keys.press("Enter")
    keys.press("Escape")
    playwright.expect(tab.get_by_role("button", name="Mark a region")).to_be_focused()
    keys.press("r")
    for key in ("ArrowDown", "Shift+ArrowRight"):
        playwright.expect(tab.locator("#box")).to_be_focused()
        keys.press(key)
    keys.press("Enter")
    playwright.expect(tab.locator(".stage__box--sent")).to_be_visible()
    playwright.expect(field).to_be_focused()
    keys.press("ArrowUp")
    playwright.expect(field).to_have_value("What is this?")


def press_until(tab: Tab, name: str) -> None:
    """Press Tab until what has the focus is called so."""
    for _ in range(40):
        tab.keyboard.press("Tab")
        focused = tab.locator(":focus")
        if focused.count():
            label = focused.get_attribute("aria-label") or focused.inner_text()
            if label == name:
                return
    raise AssertionError(f"no key leads to {name}")


def test_it_comes_back_by_itself_and_knows_what_was_confirmed(
    start: Start, tab: Tab, tmp_path: Path
) -> None:
    program = start(*EMPTY)
    visit(tab, program, things=0)
    tab.get_by_text("Change what is on the table").click()
    tab.get_by_role("button", name="Put the cup on the table").click()
    expect_things(tab, 1)
    say(tab, "This is a cup.", "I learned a cup")
    # Stopped, it does not answer; going on, it does, and nothing is lost.
    program.process.send_signal(signal.SIGSTOP)
    field = tab.get_by_role("textbox", name="Say something")
    with await_answer(tab, "This is a cup."):
        field.fill("What is this?")
        field.press("Enter")
        program.process.send_signal(signal.SIGCONT)
    # Killed, it has kept what it had answered, and the rest is to be said again.
    program.process.send_signal(signal.SIGSTOP)
    for text in ("This is a mug.", "Thank you."):
        field.fill(text)
        field.press("Enter")
    program.process.kill()
    program.process.wait()
    playwright.expect(tab.get_by_role("status")).to_contain_text("Lost")
    # What cannot be looked into is not shown as what it is not.
    tab.get_by_role("button", name="Look inside", exact=True).click()
    inside = tab.locator("#lab-body")
    playwright.expect(inside).to_have_text(re.compile("cannot be looked into now"))
    port = program.address.rstrip("/").rpartition(":")[2]
    start(*EMPTY, "--port", port)
    playwright.expect(tab.get_by_role("status")).to_contain_text(
        "Connected", timeout=PATIENCE
    )
    playwright.expect(tab.get_by_text("The robot was started anew")).to_be_visible()
    for text in ("This is a mug.", "Thank you."):
        told = tab.get_by_text(f"It had not confirmed “{text}”")
        playwright.expect(told).to_be_visible()
    playwright.expect(field).to_have_value("This is a mug.")
    playwright.expect(tab.locator("#fact-words")).to_have_text("1")


def test_every_thing_and_control_has_a_name_and_a_phone_has_room(
    start: Start, chromium: Any
) -> None:
    program = start(*DESK, "--lang", "sv")
    with chromium.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, color_scheme="dark"
    ) as context:
        context.set_default_timeout(PATIENCE)
        tab = context.new_page()
        visit(tab, program)
        named = tab.get_by_role("button").all()
        labels = [it.get_attribute("aria-label") or it.inner_text() for it in named]
        assert all(labels)
        assert {f"#{n}, inget ord för den än" for n in (1, 2, 3)} <= {*labels}
        assert tab.locator("html").get_attribute("lang") == "sv"
        playwright.expect(tab.locator("#facts")).to_contain_text("Kända ord")
        wide = tab.locator("body").bounding_box()
        assert wide["width"] == 390
        for it in ("#stage", "#say", "#tools", "#turns"):
            box = tab.locator(it).bounding_box()
            assert box["x"] >= 0
            assert box["x"] + box["width"] <= 390
            assert box["y"] + box["height"] <= 844
        thing(tab, 2).tap()
        playwright.expect(thing(tab, 2)).to_have_attribute("aria-pressed", "true")
        # As much is left while the phone's keyboard is up.
        tab.set_viewport_size({"width": 390, "height": 400})
        tab.locator("#text").focus()
        for it in ("#stage", "#turns", "#say"):
            box = tab.locator(it).bounding_box()
            assert box["y"] >= 0
            assert box["y"] + box["height"] <= 400


@pytest.mark.deep
def test_it_comes_back_after_ten_seconds_of_silence(start: Start, tab: Tab) -> None:
    program = start(*EMPTY)
    visit(tab, program, things=0)
    status = tab.get_by_role("status")
    os.kill(program.process.pid, signal.SIGSTOP)
    field = tab.get_by_role("textbox", name="Say something")
    field.fill("Hello.")
    field.press("Enter")
    playwright.expect(status).to_contain_text("Lost")
    tab.wait_for_timeout(10_000)
    os.kill(program.process.pid, signal.SIGCONT)
    playwright.expect(status).to_contain_text("Connected")
    # What was said into the silence is heard, and once.
    playwright.expect(tab.locator(".bubble--robot")).to_contain_text("Hello")
    say(tab, "Thank you.", "welcome")
    assert tab.locator(".bubble--tutor").count() == 2


@pytest.mark.deep
def test_a_page_with_an_old_token_says_to_open_the_new_address(
    start: Start, chromium: Any
) -> None:
    program = start(*EMPTY, "--host", "0.0.0.0")
    with chromium.new_context(ignore_https_errors=True) as context:
        tab = context.new_page()
        visit(tab, program, things=0)
        program.process.kill()
        program.process.wait()
        port = urlsplit(program.address).port
        start(*EMPTY, "--host", "0.0.0.0", "--port", str(port))
        status = tab.get_by_role("status")
        playwright.expect(status).to_contain_text("open the address")


@pytest.mark.deep
def test_two_theories_stand_side_by_side(
    start: Start, tab: Tab, tmp_path: Path
) -> None:
    study = tmp_path / "study.toml"
    study.write_text(
        'title = "Greetings"\nseeds = 1\n[theories.curt]\n'
        'without = ["GreetBack to Greet"]\n[tutors.Ann]\nkind = "simulated"\n'
        '[scenes.table]\nkind = "around"\n[[phases]]\ndo = "teach"\n'
    )
    visit(tab, start(*DESK, "--against", f"{study}:curt"))
    tab.get_by_role("button", name="Look inside", exact=True).click()
    say(tab, "#2 This is a car.", "is a car")
    latest = tab.locator(".turns .turn").last
    playwright.expect(latest).to_contain_text("curt: the same")
    beside = tab.get_by_role("region", name="Side by side")
    playwright.expect(beside).to_contain_text("Nothing differs in this turn.")
    say(tab, "Hello.", "Hello.")
    second = tab.locator(".turns .turn").last.locator(".bubble--second")
    playwright.expect(second).to_have_text("curt(nothing)")
    differs = beside.locator(".beside__row--differs")
    playwright.expect(differs.first).to_have_text("Hello.(nothing)")
    fired = differs.filter(has_text="GreetBack to Greet")
    playwright.expect(fired.locator(".beside__cell--first")).to_contain_text("say")
    assert beside.locator(".ttr-changed").count() > 0
    tab.get_by_role("slider", name="Turn").press("ArrowLeft")
    playwright.expect(beside).to_contain_text("Nothing differs in this turn.")
