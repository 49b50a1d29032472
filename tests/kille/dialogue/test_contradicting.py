"""What was taught in another dialogue is raised where the tutor now says otherwise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.criteria import OFTEN, criterion, degree_of, is_against
from kille.dialogue.meanings import adjective, is_denial, noun, packaged_types
from kille.dialogue.taxonomy import is_kind_of, subsumption
from ttr import Record, record

TYPES = packaged_types()
MUG, CUP = noun("mug", "a"), noun("cup", "a")
KNOWN = {("mug", "o1"): 0.95, ("book", "o2"): 0.95, ("is_white", "o1"): 0.9}


def earlier_kind(lower: Record, upper: Record) -> Record:
    """That a kind is one of another, as it was taught in another dialogue."""
    return record(
        key=f"{lower.form} {upper.form}",
        signs=[lower, upper],
        content=subsumption(lower, upper),
        new=[],
        after=-1.0,
    )


def earlier_criterion(subject: Record, *others: Record, **said: Any) -> Record:
    """By what things are known, as it was taught in another dialogue."""
    content = criterion(subject, types=TYPES, **said)
    return record(
        key=f"criterion {len(content.fields)} {[it.form for it in others]}",
        signs=[subject, *others],
        content=content,
        after=-1.0,
    )


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A mug and a book, to a robot that was told of mugs in another dialogue."""
    white = adjective("white")
    return scene(
        2,
        nouns=["mug", "cup", "book"],
        adjectives=["white"],
        known=KNOWN,
        kinds=[earlier_kind(MUG, CUP)],
        criteria=[
            earlier_criterion(MUG, white, quality=white, often="Usually"),
            earlier_criterion(MUG, cue="colour"),
        ],
        taught=[record(sign=MUG, lessons=2.0), record(sign=noun("book"), lessons=1.0)],
    )


def kinds(s: Record) -> list[str]:
    """The axioms of a state."""
    return [" ".join(sign.form for sign in it.signs) for it in s.private.kinds]


def degrees(s: Record) -> list[float]:
    """How much is true, by the criteria of a state."""
    return [degree_of(it.content) for it in s.private.criteria]


# --- kinds of kinds -------------------------------------------------------------------

DENIALS = (
    "A mug is not a kind of cup.",
    "Mugs are not cups.",
    "A mug is not a cup.",
    "The mug is not a cup.",
)


@pytest.mark.parametrize("text", DENIALS)
def test_a_kind_that_was_taught_earlier_is_asked_about(table: Any, text: str) -> None:
    assert table.acts(text) == ["ask_earlier"]
    assert kinds(table.state) == ["mug cup"]
    assert not table.state.private.lessons
    assert table.now.model.judge(table.state, TYPES["State"]).holds


@pytest.mark.parametrize("answer", ["What I said before.", "A mug is a kind of cup."])
@pytest.mark.parametrize("text", DENIALS)
def test_what_was_said_earlier_stays(table: Any, text: str, answer: str) -> None:
    table.hear(text)
    assert table.acts(answer) == ["kept_earlier"]
    assert kinds(table.state) == ["mug cup"]
    assert not table.state.shared.qud
    assert table.acts("Is a mug a kind of cup?") == ["know_kind"]


@pytest.mark.parametrize("answer", ["", "What I say now."])
@pytest.mark.parametrize("text", DENIALS)
def test_what_is_said_now_is_learned(table: Any, text: str, answer: str) -> None:
    table.hear(text)
    assert table.acts(answer or text) == ["unlearned_kind"]
    assert kinds(table.state) == []
    assert table.acts("No.") == ["learned_kind"]
    assert kinds(table.state) == ["mug cup"]


def test_what_was_taught_in_this_dialogue_is_taken_back_at_once(table: Any) -> None:
    for text in (DENIALS[0], "What I say now.", "No."):
        table.hear(text)
    assert table.acts(DENIALS[0]) == ["forgot_kind"]


def test_the_reverse_is_refused_as_before(table: Any) -> None:
    assert table.acts("A cup is a kind of mug.") == ["same_kind"]
    assert kinds(table.state) == ["mug cup"]


@pytest.mark.parametrize("answer", ["Yes.", "No.", "That is wrong."])
def test_yes_and_no_do_not_say_which_is_right(table: Any, answer: str) -> None:
    table.hear(DENIALS[0])
    assert table.acts(answer) == ["ask_earlier"]
    assert len(table.state.shared.qud) == 1
    assert kinds(table.state) == ["mug cup"]


def test_what_the_tutor_takes_back_changes_nothing(table: Any) -> None:
    table.hear(DENIALS[0])
    assert table.acts("Forget that.") == ["let_be"]
    assert kinds(table.state) == ["mug cup"]


def test_whoever_has_it_forgotten_is_not_asked(table: Any) -> None:
    assert table.acts("Forget that mugs are cups.") == ["forgot_kind"]
    assert kinds(table.state) == []


def test_without_a_question_nothing_is_preferred(table: Any) -> None:
    assert table.acts("What I say now.") == ["wonder"]
    assert table.acts("What I said before.") == ["wonder"]


# --- by what things are known ---------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "after"),
    [("Mugs are seldom white.", [0.0, 0.1]), ("The colour matters for mugs.", None)],
)
def test_a_reason_that_was_taught_earlier_is_asked_about(
    table: Any, text: str, after: list[float] | None
) -> None:
    before = degrees(table.state)
    assert table.acts(text) == ["ask_earlier"]
    assert degrees(table.state) == before
    assert table.acts("What I said before.") == ["kept_earlier"]
    assert degrees(table.state) == before
    table.hear(text)
    [act] = table.acts(text)
    assert act in ("learned_generic", "stressed_cue")
    assert degrees(table.state) == (after or [0.8, 1.0])
    assert table.acts("No.") == [
        "forgot_criterion",
        "learned_generic" if after else "ignored_cue",
    ]
    assert sorted(degrees(table.state)) == sorted(before)


def test_what_only_refines_a_reason_is_learned_at_once(table: Any) -> None:
    assert table.acts("Mugs are often white.") == ["learned_generic"]
    assert table.acts("Mugs are seldom white.") == ["learned_generic"]


@given(st.sampled_from(OFTEN), st.sampled_from(OFTEN))
def test_to_be_against_is_symmetric(one: str, other: str) -> None:
    a, b = (
        criterion(MUG, quality=adjective("white"), often=it, types=TYPES)
        for it in (one, other)
    )
    assert is_against(a, b) == is_against(b, a)
    assert not is_against(a, a)


# --- things that are known again ------------------------------------------------------


def names(s: Record) -> list[str]:
    """The lessons of a state, by their words."""
    return [
        f"{'not ' * is_denial(it.content)}{it.sign.form}" for it in s.private.lessons
    ]


@pytest.mark.parametrize(
    ("answer", "after"),
    [
        ("A lamp.", ["not mug", "lamp"]),
        ("What I say now.", ["not mug", "lamp"]),
        ("It is a mug.", ["mug"]),
        ("What I said before.", ["mug"]),
    ],
)
def test_a_thing_that_was_called_something_else_is_asked_about(
    table: Any, answer: str, after: list[str]
) -> None:
    assert table.hear("This is a lamp.") == (
        "Earlier you called what looks like this a mug. Which is right, a mug or "
        "a lamp?"
    )
    assert names(table.state) == []
    assert table.acts("Yes.") == ["ask_which"]
    table.hear(answer)
    assert names(table.state) == after


def test_a_kind_of_what_it_was_called_is_no_contradiction(table: Any) -> None:
    assert table.acts("This is a cup.") == ["learned"]


def test_what_was_just_said_needs_no_question(table: Any) -> None:
    table.hear("What is this?")
    assert table.acts("No, this is a lamp.") == ["corrected"]


def test_what_is_not_known_again_is_learned(scene: Callable[..., Any]) -> None:
    known, taught = {("mug", "o1"): 0.8}, [record(sign=MUG, lessons=1.0)]
    robot = scene(nouns=["mug"], known=known, taught=taught)
    assert robot.acts("This is a lamp.") == ["learned"]


def test_it_is_asked_in_swedish_too(scene: Callable[..., Any]) -> None:
    mugg, kopp = noun("mugg", "en"), noun("kopp", "en")
    robot = scene(
        nouns=["mugg", "kopp"],
        known={("mugg", "o1"): 0.95},
        kinds=[earlier_kind(mugg, kopp)],
        criteria=[earlier_criterion(mugg, cue="colour")],
        taught=[record(sign=mugg, lessons=1.0)],
        language="sv",
    )
    assert robot.acts("En mugg är inte en sorts kopp.") == ["ask_earlier"]
    assert robot.acts("Det jag sa tidigare.") == ["kept_earlier"]
    assert robot.acts("Muggar är inte koppar.") == ["ask_earlier"]
    assert robot.acts("Det jag säger nu.") == ["unlearned_kind"]
    assert robot.acts("Nej.") == ["learned_kind"]
    assert robot.acts("Färgen spelar roll för muggar.") == ["ask_earlier"]
    assert robot.acts("Färgen spelar roll.") == ["stressed_cue"]
    assert robot.acts("Det här är en lampa.") == ["ask_earlier"]
    assert robot.acts("En lampa.") == ["corrected"]
    assert robot.acts("Glöm att muggar är koppar.") == ["forgot_kind"]


# --- law: nothing that was taught earlier goes unasked --------------------------------

NOUNS = ("mug", "cup", "vessel")
SAID = st.tuples(
    st.sampled_from(NOUNS),
    st.sampled_from(NOUNS),
    st.booleans(),
    st.sampled_from(["What I say now.", "What I said before.", "Hello."]),
)
TAUGHT = [("mug", "cup"), ("cup", "vessel")]


@given(st.lists(SAID, max_size=6))
def test_what_was_taught_earlier_is_affirmed(
    scene: Callable[..., Any], said: Sequence[tuple[str, str, bool, str]]
) -> None:
    signs = {form: noun(form, "a") for form in NOUNS}
    known = [earlier_kind(signs[one], signs[other]) for one, other in TAUGHT]
    robot = scene(nouns=NOUNS, kinds=known)
    held = dict.fromkeys(f"{one} {other}" for one, other in TAUGHT)
    for one, other, so, answer in said:
        before = {it.key: it for it in robot.state.private.kinds}
        [act] = robot.acts(f"A {one} is{'' if so else ' not'} a kind of {other}.")
        if act == "ask_earlier":
            assert {it.key for it in robot.state.private.kinds} == {*before}
            robot.acts(answer)
        gone = {*before} - {it.key for it in robot.state.private.kinds}
        asked = act == "ask_earlier" and answer == "What I say now."
        assert asked or not gone & {*held}
    for one in NOUNS:
        for other in NOUNS:
            so = is_kind_of(robot.state, signs[one], signs[other])
            if one != other:
                asks = f"Is a {one} a kind of {other}?"
                assert robot.acts(asks) == ["know_kind" if so else "unknown_kind"]
