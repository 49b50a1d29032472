"""The tutor corrects reasons, and says how all things of a kind are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.criteria import (
    CUES,
    MATTERS,
    OFTEN,
    criterion,
    degree_of,
    nearest_often,
)
from kille.dialogue.meanings import adjective, is_denial, noun, packaged_types
from ttr import Record

TYPES = packaged_types()
KNOWN = {("mug", "o1"): 0.9, ("book", "o2"): 0.9, ("is_white", "o1"): 0.9}
WHITE = "Mugs are white."
COLOUR = "The colour does not matter for mugs."


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A mug and a book, and the words for them."""
    return scene(
        things=2, nouns=["mug", "book"], adjectives=["white", "blue"], known=KNOWN
    )


def describe_criteria(s: Record) -> list[str]:
    """The criteria of a state: of which word, what, and to which degree."""
    return [
        " ".join(
            [
                *(sign.form for sign in it.signs),
                *(str(it.content[x].value) for x in ("cue",) if x in it.content),
                str(degree_of(it.content)),
            ]
        )
        for it in s.private.criteria
    ]


def lessons(s: Record) -> list[str]:
    return [
        f"{'not ' * is_denial(it.content)}{it.sign.form}" for it in s.private.lessons
    ]


# --- what is learned ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "learned", "answer"),
    [
        (COLOUR, "mug colour 0.0", "OK, I do not go by the colour of mugs."),
        (
            "It is the shape for mugs.",
            "mug shape 1.0",
            "OK, I go by the shape of mugs above all.",
        ),
        (WHITE, "mug white 0.9", "OK, mugs are generally white."),
        ("All mugs are white.", "mug white 0.97", "OK, mugs are always white."),
        ("Mugs are never blue.", "mug blue 0.03", "OK, mugs are never blue."),
        ("Mugs aren't blue.", "mug blue 0.1", "OK, mugs are seldom blue."),
        (
            "Mugs have handles.",
            "mug handle 0.9",
            "OK, mugs generally have handles. I see only whole things, so I cannot "
            "look for that.",
        ),
    ],
)
def test_what_is_said_is_a_record_in_the_state(
    table: Any, text: str, learned: str, answer: str
) -> None:
    assert table.hear(text) == answer
    assert describe_criteria(table.state) == [learned]
    assert lessons(table.state) == []
    assert table.now.model.judge(table.state, TYPES["State"]).holds


def test_it_is_said_of_the_claim_in_question(table: Any) -> None:
    table.hear("What is this?")
    assert table.hear("No, the colour does not matter.") == (
        "OK, I do not go by the colour of mugs."
    )
    assert table.hear("That is correct.") == "OK, the one on the left (#1) is a mug."
    table.hear("Why?")
    assert table.hear("It is the shape.") == (
        "OK, I go by the shape of mugs above all."
    )
    assert describe_criteria(table.state) == ["mug colour 0.0", "mug shape 1.0"]


def test_without_a_claim_it_asks_of_which_things(table: Any) -> None:
    assert table.hear("The colour does not matter.").startswith("For which things?")
    assert describe_criteria(table.state) == []


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("Cups are white.", "I have not learned what a cup is. Please show me one."),
        (
            "The colour does not matter for cups.",
            "I have not learned what a cup is. Please show me one.",
        ),
        (
            "Mugs are shiny.",
            'I have not learned what "shiny" means. Please show me an example.',
        ),
        ("Cups have handles.", "I have not learned what a cup is. Please show me one."),
        (
            "Mugs have ideas.",
            "I take that as a remark. I learn words for what I can see.",
        ),
        ("It has a handle.", "I see only whole things, so I cannot see a handle."),
    ],
)
def test_nothing_is_learned_of_what_is_not_known(
    table: Any, text: str, answer: str
) -> None:
    assert table.hear(text) == answer
    assert describe_criteria(table.state) == lessons(table.state) == []


REMARK = "I take that as a remark. I learn words for what I can see."
KOMMENTAR = "Det tar jag som en kommentar. Jag lär mig ord för det jag kan se."


@pytest.mark.parametrize(
    "text",
    [
        "Mugs have feelings.",
        "Mugs have a nice colour.",
        "A mug has a soul.",
        "Mugs have colours.",
        "It has a nice colour.",
        "The mug has a funny shape.",
        "It has a history.",
        "The colour is important to me.",
        "The shape does not matter for us.",
        "What matters to me is the size.",
        "To me the colour counts.",
        "Mugs are white to me.",
    ],
)
def test_an_opinion_is_no_reason(table: Any, text: str) -> None:
    table.hear("What is this?")
    assert table.hear(text) == REMARK
    assert describe_criteria(table.state) == []


@pytest.mark.parametrize(
    "text",
    [
        "Muggar har känslor.",
        "Muggar har en fin färg.",
        "En mugg har en själ.",
        "Muggar har rättigheter.",
        "Den har en fin färg.",
        "Muggen har en rolig form.",
        "Färgen är viktig för mig.",
        "Formen spelar ingen roll för oss.",
        "Det som är viktigt för mig är storleken.",
        "För mig är färgen viktig.",
        "Muggar är vita för mig.",
    ],
)
def test_an_opinion_is_no_reason_in_swedish(
    scene: Callable[..., Any], text: str
) -> None:
    known = {("mugg", "o1"): 0.9}
    robot = scene(nouns=["mugg"], adjectives=["vit"], known=known, language="sv")
    robot.hear("Vad är det här?")
    assert robot.hear(text) == KOMMENTAR
    assert describe_criteria(robot.state) == []


@pytest.mark.parametrize("part", ["flurbs", "duties", "owners"])
def test_what_may_be_no_part_is_asked_about(table: Any, part: str) -> None:
    asked = f"Do you mean that mugs generally have {part}?"
    assert table.hear(f"Mugs have {part}.") == asked
    assert describe_criteria(table.state) == []
    assert table.hear("No.") == "Then I learn nothing from that."
    assert table.hear(f"Mugs have {part}.") == asked
    assert table.hear("Yes.").startswith(f"OK, mugs generally have {part}.")
    assert table.hear(f"Mugs have {part}.") == "Yes, you told me that."


def test_a_part_is_no_thing(table: Any) -> None:
    table.hear("Mugs have handles.")
    for text in ("This is a handle.", "That is not a handle.", "No, a handle."):
        assert table.hear(text).startswith("To me a handle is a part of a mug.")
    assert lessons(table.state) == []


def test_what_is_said_last_counts(table: Any) -> None:
    table.hear(WHITE)
    assert table.hear("Mugs are white.") == "Yes, you told me that."
    table.hear("Mugs are rarely white.")
    assert describe_criteria(table.state) == ["mug white 0.1"]
    table.hear(COLOUR)
    table.hear("What matters for mugs is the colour.")
    assert describe_criteria(table.state) == ["mug white 0.1", "mug colour 1.0"]


def test_something_is_left_to_go_by(table: Any) -> None:
    for cue in CUES[:-1]:
        table.hear(f"The {cue} does not matter for mugs.")
    assert len(describe_criteria(table.state)) == len(CUES) - 1
    answer = table.hear(f"The {CUES[-1]} do not matter for mugs.")
    assert answer.startswith("Then nothing would be left")
    assert len(describe_criteria(table.state)) == len(CUES) - 1


# --- taking back ----------------------------------------------------------------------


@pytest.mark.parametrize("text", [COLOUR, WHITE, "Mugs have handles."])
@pytest.mark.parametrize("back", ["Forget that.", "No.", "Forget the last thing."])
def test_it_is_taken_back(table: Any, text: str, back: str) -> None:
    table.hear("This is a mug.")
    before = table.state.private
    table.hear(text)
    assert table.hear(back).startswith("OK, I forgot ")
    assert describe_criteria(table.state) == []
    assert table.state.private.lessons == before.lessons


@pytest.mark.parametrize(
    ("text", "back"),
    [
        (WHITE, "Forget that mugs are white."),
        (COLOUR, "Forget that the colour does not matter for mugs."),
        ("Mugs have handles.", "Forget that mugs have handles."),
    ],
)
def test_it_is_forgotten_by_what_it_says(table: Any, text: str, back: str) -> None:
    table.hear(text)
    table.hear("What is this?")
    assert table.hear(back).startswith("OK, I forgot ")
    assert describe_criteria(table.state) == []
    assert table.hear(back) == "There is nothing that I could forget."


def test_a_lesson_that_came_later_is_forgotten_first(table: Any) -> None:
    table.hear(WHITE)
    table.hear("This is a mug.")
    assert table.hear("Forget the last thing.") == "OK, I forgot that this is a mug."
    assert table.hear("Forget the last thing.") == (
        "OK, I forgot that mugs are generally white."
    )


def test_a_word_that_is_forgotten_takes_its_criteria_along(table: Any) -> None:
    table.hear(WHITE)
    table.hear("The colour does not matter for books.")
    table.hear("Forget mugs.")
    assert describe_criteria(table.state) == ["book colour 0.0"]


def test_what_was_claimed_can_still_be_corrected(table: Any) -> None:
    table.hear("What is this?")
    table.hear("The colour does not matter.")
    assert table.hear("No, this is a book.") == (
        "OK, the one on the left (#1) is a book, not a mug."
    )
    assert lessons(table.state) == ["not mug", "book"]


# --- what is told ---------------------------------------------------------------------


def test_it_tells_what_it_was_told(table: Any) -> None:
    for text in (COLOUR, WHITE, "Mugs have handles."):
        table.hear(text)
    assert table.hear("What do you know about mugs?").splitlines()[1:] == [
        "You told me not to go by the colour of mugs.",
        "You told me that mugs are generally white.",
        "You told me that mugs generally have handles, but I cannot see parts of "
        "things.",
    ]


def test_it_cites_only_what_fits(table: Any) -> None:
    for text in (WHITE, "Mugs are blue.", "Mugs are never blue.", COLOUR):
        table.hear(text)
    table.hear("What is this?")
    assert table.hear("Why?").splitlines()[1:] == [
        "You told me that mugs are generally white."
    ]


# --- values ---------------------------------------------------------------------------


@given(st.sampled_from(OFTEN), st.floats(-0.005, 0.005))
def test_how_often_follows_from_the_degree(often: str, off: float) -> None:
    content = criterion(
        noun("mug"), quality=adjective("white"), often=often, types=TYPES
    )
    assert nearest_often(degree_of(content) + off, types=TYPES) == often


def test_degrees_are_in_order() -> None:
    degrees = [degree_of(TYPES.record_type(it)) for it in OFTEN]
    assert degrees == sorted(degrees)
    assert [degree_of(TYPES.record_type(it)) for it in MATTERS] == [0.0, 1.0]


# --- both, every, only ----------------------------------------------------------------


@pytest.fixture
def three(scene: Callable[..., Any]) -> Any:
    """Three things of which nothing is known."""
    return scene(things=3, nouns=["cup"])


def hear_all(robot: Any, texts: Sequence[str]) -> str:
    *_, last = [robot.hear(it) for it in texts]
    return str(last)


def test_both_are_two(scene: Callable[..., Any], three: Any) -> None:
    two = scene(things=2, nouns=["cup"])
    assert two.hear("Both are cups.") == "OK, I learned two cups."
    assert three.hear("Both are cups.").startswith("I do not know which ones")
    assert lessons(three.state) == []


def test_both_are_those_that_are_nothing_else(scene: Callable[..., Any]) -> None:
    robot = scene(things=3, nouns=["cup", "book"], known={("book", "o2"): 0.9})
    assert robot.hear("Both are cups.") == "OK, I learned two cups."


def test_everything_is_every_thing(three: Any) -> None:
    assert three.hear("Everything here is a cup.") == "OK, I learned three cups."
    assert lessons(three.state) == ["cup"] * 3


def test_only_this_is_a_lesson_about_the_others_too(three: Any) -> None:
    assert three.hear("Only this is a cup.") == "OK, only #1 is a cup."
    assert sorted(lessons(three.state)) == ["cup", "not cup", "not cup"]


@pytest.mark.parametrize(
    ("answer", "after"),
    [
        ("Yes.", ["cup", "cup", "not cup", "not cup"]),
        ("No.", ["cup", "cup", "cup"]),
        ("Forget that.", ["cup", "cup", "cup"]),
    ],
)
def test_only_this_is_asked_about_first(
    three: Any, answer: str, after: list[str]
) -> None:
    texts = ["Everything here is a cup.", "Only this is a cup."]
    assert hear_all(three, texts) == (
        "You told me that #2 is a cup as well. Was that wrong?"
    )
    three.hear(answer)
    assert sorted(lessons(three.state)) == after


@pytest.mark.parametrize(
    ("answer", "after"),
    [
        ("Yes.", ["cup", "cup", "cup"]),
        ("No.", ["cup", "not cup", "not cup"]),
        ("Forget that.", ["cup", "not cup", "not cup"]),
    ],
)
def test_everything_is_asked_about_first(
    three: Any, answer: str, after: list[str]
) -> None:
    texts = ["Only this is a cup.", "Everything here is a cup."]
    assert hear_all(three, texts) == "Is #2 a cup as well?"
    three.hear(answer)
    learned = lessons(three.state)
    assert sorted(learned) in (sorted(after), sorted([*after, "cup"]))
