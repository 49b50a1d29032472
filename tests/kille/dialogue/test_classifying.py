"""A mug is a kind of cup: an axiom that judgements use, and that can be taken back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.beliefs import names_of
from kille.dialogue.language import understand
from kille.dialogue.meanings import is_denial, noun, packaged_types
from kille.dialogue.robust_reading.situations import situation_of
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.dialogue.taxonomy import (
    are_synonyms,
    axiom_of,
    is_kind_of,
    subsumption,
)
from kille.dialogue.tutoring import hear_sentences
from ttr import Record, subtype

KNOWN = {("mug", "o1"): 0.9, ("book", "o2"): 0.9}


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A mug and a book, and the words for them."""
    return scene(things=2, nouns=["mug", "book"], known=KNOWN)


def taught(s: Record) -> list[str]:
    """The lessons of the dialogue, by their words."""
    return [
        f"{'not ' * is_denial(it.content)}{it.sign.form}" for it in s.private.lessons
    ]


def axioms(robot: Any) -> list[str]:
    """The axioms under which the robot judges."""
    own = packaged_types().theory.axioms
    return [str(it) for it in robot.now.model.theory.axioms if it not in own]


def teach(robot: Any, *texts: str) -> Any:
    """The robot after these texts, where each new word is confirmed to be one."""
    for text in texts:
        if "ask_meant" in robot.acts(text):
            robot.hear("Yes.")
    return robot


def hear(robot: Any, text: str, language: str = "en") -> str:
    """What the robot says to a text that may be read by its parts."""
    heard = hear_in_parts(
        understand(text, language), situation_of(robot.state), language
    )
    taken = [robot._take(hear_sentences(it)) for it in heard.moves]
    return "\n".join(map(robot._worded, taken))


MUGS = "A mug is a kind of cup."
AXIOM = ["mug(x, look) <: cup(x, look)"]


# --- teaching -------------------------------------------------------------------------


def test_it_is_an_axiom_of_the_theory(table: Any) -> None:
    assert table.hear(MUGS) == "OK, a mug is a kind of cup."
    assert axioms(table) == AXIOM
    mug, cup = noun("mug").meaning, noun("cup").meaning
    assert subtype(mug, cup, table.now.model.theory).yes
    assert taught(table.state) == []


@pytest.mark.parametrize(
    "text",
    [
        "Mugs are cups.",
        "A mug is a cup.",
        "A mug is a kind of cpu.",
        "A mug is a kind of miracle.",
    ],
)
def test_a_new_noun_is_asked_about_where_it_may_not_be_meant(
    scene: Callable[..., Any], text: str
) -> None:
    robot = scene(nouns=["mug"])
    assert hear(robot, text).startswith("Do you mean that a mug is a kind of ")
    assert axioms(robot) == []


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("Is a mug a cup?", "Yes, I know that a mug is a kind of cup."),
        ("Is every mug a cup?", "Yes, I know that a mug is a kind of cup."),
        ("Is every cup a mug?", "Nobody has told me that a cup is a kind of mug."),
    ],
)
def test_it_is_asked_about_without_a_thing(table: Any, text: str, answer: str) -> None:
    table.hear(MUGS)
    assert hear(table, text) == answer


def test_it_is_told_of_both_words(table: Any) -> None:
    table.hear(MUGS)
    for text in ("What is a mug?", "What is a cup?"):
        assert table.hear(text).endswith("\nA mug is a kind of cup.")


@pytest.mark.parametrize(
    "text",
    [
        "A mug is a sort of cup.",
        "Mugs are cups.",
        "All mugs are cups.",
        "Mugs are a kind of cup.",
        "Mugs are kinds of cups.",
        "I think a mug is a kind of cup.",
        "A mug is a cup.",
        "a mug's a cup",
        "A mug is a cup very big.",
    ],
)
def test_it_is_said_in_many_ways(scene: Callable[..., Any], text: str) -> None:
    robot = scene(nouns=["mug", "cup"])
    assert hear(robot, text) == "OK, a mug is a kind of cup."
    assert axioms(robot) == AXIOM


@pytest.mark.parametrize(
    "text",
    [
        "En mugg är en sorts kopp.",
        "En mugg är ett slags kopp.",
        "Muggar är koppar.",
        "Alla muggar är koppar.",
        "Alla muggar är en sorts kopp.",
        "En mugg är en kopp.",
        "Med kopp menas helt enkelt muggar och sånt.",
    ],
)
def test_it_is_said_in_swedish(scene: Callable[..., Any], text: str) -> None:
    robot = scene(nouns=["mugg", "kopp"], language="sv")
    assert hear(robot, text, "sv") == "Okej, en mugg är en sorts kopp."
    assert axioms(robot) == ["mugg(x, look) <: kopp(x, look)"]


def test_it_names_nothing_in_view(scene: Callable[..., Any]) -> None:
    robot = scene(nouns=["mug", "cup"])
    robot.hear("A mug is a cup.")
    assert taught(robot.state) == []


@pytest.mark.parametrize(
    "text",
    [
        "Forks and spoons are tools.",
        "Forks, spoons, that's what we call tools.",
        "Forks are tools, and so are spoons.",
        "A tool is something you can use, for example a fork or a spoon.",
    ],
)
def test_several_kinds_are_taken_in_together(
    scene: Callable[..., Any], text: str
) -> None:
    robot = scene(nouns=["fork", "spoon"])
    assert hear(robot, text) == (
        "Do you mean that a fork is a kind of tool?\n"
        "And that a spoon is a kind of tool?"
    )
    assert axioms(robot) == []
    assert robot.acts("Yes.") == ["learned_kind", "learned_kind"]
    assert axioms(robot) == [f"{it}(x, look) <: tool(x, look)" for it in FORKS]
    assert hear(robot, text).count("I know") == 2


FORKS = ("fork", "spoon")


@pytest.mark.parametrize(
    "text",
    [
        "Gafflar och skedar är verktyg.",
        "Gafflar, skedar, det kallar vi verktyg.",
        "Gafflar är verktyg, och det är skedar också.",
        "Ett verktyg är något man kan äta med, till exempel en gaffel eller en sked.",
    ],
)
def test_several_kinds_are_taken_in_in_swedish(
    scene: Callable[..., Any], text: str
) -> None:
    robot = scene(nouns=["gaffel", "sked", "verktyg"], language="sv")
    hear(robot, text, "sv")
    assert axioms(robot) == [
        f"{it}(x, look) <: verktyg(x, look)" for it in ("gaffel", "sked")
    ]


def test_of_several_kinds_none_is_dropped(scene: Callable[..., Any]) -> None:
    robot = scene(nouns=["fork"])
    assert robot.acts("Forks and spoons are tools.") == ["need_kind"]
    assert axioms(robot) == []


@pytest.mark.parametrize(
    ("language", "text", "nouns", "question"),
    [
        (
            "en",
            "Mugs aren't bowls, they are cups.",
            ["mug", "bowl"],
            "Do you mean that a mug is a kind of cup?",
        ),
        (
            "sv",
            "Muggar är inte skålar, de är koppar.",
            ["mugg", "skål"],
            "Menar du att en mugg är en sorts kopp?",
        ),
    ],
)
def test_they_are_the_kind_that_was_spoken_of(
    scene: Callable[..., Any],
    language: str,
    text: str,
    nouns: Sequence[str],
    question: str,
) -> None:
    robot = scene(nouns=nouns, language=language)
    assert hear(robot, text, language).endswith(question)


# --- synonyms -------------------------------------------------------------------------

BOTH = ["tin(x, look) <: can(x, look)", "can(x, look) <: tin(x, look)"]


@pytest.mark.parametrize(
    "text",
    [
        "Tin is just another word for can.",
        "A tin is another name for a can.",
        "Tins are the same as cans.",
        "By tin I mean the same as can.",
        "Tin means the same as can.",
        "Tin and can mean the same.",
        "Tin, can, same thing to me.",
        "We say tin for a can.",
        "People call a can a tin.",
    ],
)
def test_synonyms_are_an_axiom_in_both_directions(
    scene: Callable[..., Any], text: str
) -> None:
    robot = scene(nouns=["can"], known={("can", "o1"): 0.9})
    assert robot.hear(text) == 'Do you mean that "tin" is another word for "can"?'
    assert axioms(robot) == []
    assert robot.hear("Yes.") == 'OK, "tin" is another word for "can".'
    assert axioms(robot) == BOTH
    assert robot.acts(text) == ["know_synonym"]
    assert robot.hear("Is this a tin?").startswith("Yes, this is a tin")
    assert robot.acts("Are tins cans?") == ["know_kind"]


@pytest.mark.parametrize(
    "text",
    [
        "Plåtburk är bara ett annat ord för burk.",
        "En plåtburk är samma sak som en burk.",
        "Med plåtburk menar jag samma sak som burk.",
        "Plåtburk betyder samma sak som burk.",
        "Plåtburk och burk är samma sak.",
        "Plåtburk, burk, samma sak för mig.",
        "Vi säger plåtburk om en burk.",
    ],
)
def test_synonyms_in_swedish(scene: Callable[..., Any], text: str) -> None:
    robot = scene(nouns=["plåtburk", "burk"], language="sv")
    assert robot.hear(text) == 'Okej, "plåtburk" är ett annat ord för "burk".'
    assert len(axioms(robot)) == 2


@pytest.mark.parametrize("text", ["Forget that.", "No.", "A tin is not a kind of can."])
def test_synonyms_are_taken_back_in_both_directions(
    scene: Callable[..., Any], text: str
) -> None:
    robot = scene(nouns=["can", "tin"])
    robot.hear("Tin is another word for can.")
    assert robot.acts(text) == ["forgot_synonym"]
    assert axioms(robot) == []


def test_what_is_a_kind_of_the_other_is_no_synonym(table: Any) -> None:
    teach(table, MUGS)
    assert table.acts("Mug is another word for cup.") == ["same_kind"]
    assert axioms(table) == AXIOM
    assert table.acts("Mug is another word for mug.") == ["same_thing"]


def test_of_two_unknown_words_neither_is_a_synonym(table: Any) -> None:
    assert table.acts("Tin is another word for can.") == ["need_kind"]
    assert axioms(table) == []


def test_what_speaks_against_synonyms_is_asked_about(table: Any) -> None:
    table.hear("This is a mug.")
    table.hear("This is not a cup.")
    teach(table, "Mug is another word for cup.")
    assert table.state.shared.qud[0].ask == "AskKindStill"
    assert axioms(table) == []
    table.hear("Yes.")
    assert len(axioms(table)) == 2
    assert "not cup" not in taught(table.state)


def test_a_word_that_is_no_kind_of_thing_teaches_nothing(table: Any) -> None:
    assert table.acts("A mug is a kind of nuisance.") == ["ask_meant"]
    assert table.acts("No.") == ["let_be"]
    assert axioms(table) == []
    assert [it.form for it in table.state.private.nouns] == ["mug", "book"]


def test_of_two_unknown_nouns_one_is_to_be_shown_first(table: Any) -> None:
    assert table.hear("A tankard is a kind of vessel.") == (
        "I have learned neither what a tankard is nor what a vessel is. "
        "Please show me one of them first."
    )
    assert axioms(table) == []


def test_what_is_known_is_not_learned_again(table: Any) -> None:
    teach(table, MUGS, "A cup is a kind of vessel.")
    assert table.acts(MUGS) == ["know_kind"]
    assert table.hear("Mugs are vessels.") == (
        "Yes, I know that a mug is a kind of vessel."
    )
    assert len(axioms(table)) == 2


@pytest.mark.parametrize("text", ["A mug is a kind of mug.", "Mugs are mugs."])
def test_nothing_is_a_kind_of_itself(table: Any, text: str) -> None:
    assert table.acts(text) == ["same_thing"]
    assert axioms(table) == []


@pytest.mark.parametrize(
    "text", ["A cup is a kind of mug.", "A vessel is a kind of mug."]
)
def test_a_circle_is_refused(table: Any, text: str) -> None:
    teach(table, MUGS, "A cup is a kind of vessel.")
    before = axioms(table)
    assert table.acts(text) == ["same_kind"]
    assert axioms(table) == before


# --- judging --------------------------------------------------------------------------


def test_a_mug_is_a_cup_because_mugs_are_cups(table: Any) -> None:
    teach(table, MUGS)
    answer = table.hear("Is this a cup?")
    assert answer == "Yes, this is a cup: a mug is a kind of cup."
    assert table.hear("Why?") == "Because this is a mug, and a mug is a kind of cup."
    assert table.acts("Why is this a mug?") == ["explain_name"]


def test_it_follows_step_by_step(table: Any) -> None:
    teach(table, MUGS, "A cup is a kind of vessel.")
    answer = table.hear("Is this a vessel?")
    assert answer == "Yes, this is a vessel: a mug is a kind of vessel."


def test_a_thing_is_called_by_its_most_special_name(table: Any) -> None:
    teach(table, MUGS, "A cup is a kind of vessel.")
    assert table.hear("What is this?") == "This is a mug."


def test_what_is_a_book_is_no_cup(table: Any) -> None:
    teach(table, MUGS)
    assert table.acts("Is the book a cup?") != ["say_yes"]


def test_a_mug_is_meant_by_the_cup(table: Any) -> None:
    teach(table, MUGS)
    assert table.hear("Show me the cup.") == "This is the cup: #1."
    assert table.hear("How many cups are there?") == "One."
    assert table.hear("The cup is red.") == "OK, the one on the left (#1) is red."


def test_a_cup_need_not_be_a_mug(scene: Callable[..., Any]) -> None:
    robot = scene(nouns=["mug", "cup"], known={("cup", "o1"): 0.9, ("mug", "o1"): 0.1})
    teach(robot, MUGS)
    assert robot.hear("What is this?") == "This is a cup."
    assert robot.hear("Is this a mug?") == "No, this is not a mug."
    assert robot.hear("Is this a cup?") == "Yes, this is a cup."


def test_a_kind_is_no_rival_of_what_it_is_a_kind_of(scene: Callable[..., Any]) -> None:
    known = {("mug", "o1"): 0.75, ("cup", "o1"): 0.7}
    robot = scene(nouns=["mug", "cup"], known=known)
    assert robot.acts("What is this?") == ["hedge_name"]
    teach(robot, MUGS)
    assert robot.acts("What is this?") == ["assert_name"]


def test_it_is_not_asked_if_a_mug_is_both(scene: Callable[..., Any]) -> None:
    robot = scene(nouns=["mug", "cup"])
    teach(robot, MUGS, "This is a mug.")
    assert robot.acts("This is a cup.") == ["learned"]
    assert taught(robot.state) == ["mug", "cup"]


def test_what_was_told_of_a_kind_counts(scene: Callable[..., Any]) -> None:
    robot = scene(nouns=["mug", "cup"])
    teach(robot, MUGS, "This is a mug.")
    assert robot.acts("Is this a cup?") == ["say_yes"]


# --- asking ---------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["Is a mug a kind of cup?", "Are mugs cups?"])
def test_it_tells_what_it_was_taught_of_kinds(table: Any, text: str) -> None:
    unknown = "Nobody has told me that a mug is a kind of cup."
    assert table.hear(text) == unknown
    teach(table, MUGS)
    assert table.hear(text) == "Yes, I know that a mug is a kind of cup."


# --- taking back ----------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "Forget that.",
        "No.",
        "That is wrong.",
        "Forget the last thing.",
        "Forget that a mug is a kind of cup.",
        "Forget that mugs are cups.",
        "A mug is not a kind of cup.",
        "No, mugs are not cups.",
        "Mugs aren't cups.",
    ],
)
def test_it_is_taken_back(table: Any, text: str) -> None:
    teach(table, MUGS)
    assert table.hear(text) == "OK, I forgot that a mug is a kind of cup."
    assert axioms(table) == []
    assert table.state.private.kinds == ()
    assert [it.form for it in table.state.private.nouns] == ["mug", "book"]
    assert table.acts("Is this a cup?") == ["unknown_noun"]


def test_a_word_that_was_taught_stays_when_the_axiom_goes(
    scene: Callable[..., Any],
) -> None:
    robot = scene(nouns=["mug"], known=KNOWN)
    teach(robot, MUGS, "This is a cup.")
    robot.hear("Forget that mugs are cups.")
    assert [it.form for it in robot.state.private.nouns] == ["mug", "cup"]


def test_the_last_thing_is_the_later_one(scene: Callable[..., Any]) -> None:
    robot = scene(nouns=["mug", "cup"])
    teach(robot, "This is a mug.", MUGS, "This is red.")
    assert robot.acts("Forget the last thing.") == ["forgot_quality"]
    assert robot.acts("Forget the last thing.") == ["forgot_kind"]
    assert robot.acts("Forget the last thing.") == ["forgot"]


def test_a_word_is_forgotten_with_what_was_said_of_its_kind(table: Any) -> None:
    teach(table, MUGS)
    table.hear("Forget mugs.")
    assert axioms(table) == []


def test_an_axiom_that_follows_is_not_taken_back(table: Any) -> None:
    teach(table, MUGS, "A cup is a kind of vessel.")
    assert table.acts("Mugs are not vessels.") == ["know_kind"]
    assert len(axioms(table)) == 2


def test_a_no_to_something_else_leaves_it(table: Any) -> None:
    teach(table, MUGS)
    table.hear("What is this?")
    assert table.acts("No.") == ["ask_again"]
    assert axioms(table) == AXIOM


# --- what does not go together --------------------------------------------------------


@pytest.fixture
def odd(scene: Callable[..., Any]) -> Any:
    """A robot that was told of something that it is a mug, and not a cup."""
    return teach(scene(nouns=["mug", "cup"]), "This is a mug.", "This is not a cup.")


def test_what_speaks_against_it_is_asked_about(odd: Any) -> None:
    assert odd.hear(MUGS) == (
        "You told me of something here that it is a mug, but not a cup. "
        "Is a mug a kind of cup all the same?"
    )
    assert axioms(odd) == []


def test_yes_unlearns_what_speaks_against_it(odd: Any) -> None:
    odd.hear(MUGS)
    assert odd.hear("Yes.") == "OK, a mug is a kind of cup."
    assert taught(odd.state) == ["mug"]
    assert axioms(odd) == AXIOM


@pytest.mark.parametrize("text", ["No.", "Forget that.", "Forget the last thing."])
def test_no_leaves_it(odd: Any, text: str) -> None:
    odd.hear(MUGS)
    assert odd.acts(text) == ["let_be"]
    assert taught(odd.state) == ["mug", "not cup"]
    assert axioms(odd) == []


@pytest.mark.parametrize(
    ("first", "then", "answer"),
    [
        (
            "This is a mug.",
            "This is not a cup.",
            "But you told me that it is a mug, and that a mug is a kind of cup. "
            "Which of the two is wrong?",
        ),
        (
            "This is not a cup.",
            "This is a mug.",
            "But you told me that it is not a cup, and that a mug is a kind of cup. "
            "Which of the two is wrong?",
        ),
    ],
)
def test_a_lesson_against_an_axiom_is_objected_to(
    scene: Callable[..., Any], first: str, then: str, answer: str
) -> None:
    robot = teach(scene(nouns=["mug", "cup"]), MUGS, first)
    before = taught(robot.state)
    assert robot.hear(then) == answer
    assert taught(robot.state) == before
    assert axioms(robot) == AXIOM


# --- laws -----------------------------------------------------------------------------

NOUNS = ("cup", "mug", "vessel", "beaker")
PAIRS = st.tuples(st.sampled_from(NOUNS), st.sampled_from(NOUNS))


@given(st.lists(PAIRS, max_size=8))
def test_kinds_are_never_in_a_circle(
    scene: Callable[..., Any], said: Sequence[tuple[str, str]]
) -> None:
    robot = scene(nouns=NOUNS)
    for lower, upper in said:
        robot.hear(f"A {lower} is a kind of {upper}.")
    signs = [noun(it) for it in NOUNS]
    for one in signs:
        for other in signs:
            both = is_kind_of(robot.state, one, other) and one != other
            assert not (both and is_kind_of(robot.state, other, one))
    for it in robot.state.private.kinds:
        assert str(axiom_of(it.content)) in axioms(robot)
        assert it.content == subsumption(*it.signs)


def degrees_of(robot: Any) -> dict[str, float]:
    """How probable each noun is at least of the first thing, under the axioms."""
    perceive = robot.now.model.facts.perceive
    return {
        it.form: perceive(
            None, axiom_of(subsumption(it, it)).lower.pred("o1", "look1")
        ).lo
        for it in robot.state.private.nouns
    }


@given(
    st.lists(PAIRS, max_size=6),
    st.fixed_dictionaries({it: st.sampled_from([0.0, 0.3, 0.6, 0.9]) for it in NOUNS}),
)
def test_what_is_a_kind_is_at_least_as_probably_what_it_is_a_kind_of(
    scene: Callable[..., Any],
    said: Sequence[tuple[str, str]],
    degrees: dict[str, float],
) -> None:
    known = {(word, "o1"): p for word, p in degrees.items()}
    robot = scene(nouns=NOUNS, known=known)
    for lower, upper in said:
        robot.hear(f"A {lower} is a kind of {upper}.")
    s, model = robot.state, robot.now.model
    p = degrees_of(robot)
    for lower in s.private.nouns:
        assert p[lower.form] >= degrees[lower.form]
        for upper in s.private.nouns:
            if is_kind_of(s, lower, upper):
                assert p[lower.form] <= p[upper.form]
    names = names_of(s, model, "o1")
    assert names[0].p == max(p.values())


@given(st.lists(PAIRS, max_size=5), PAIRS)
def test_to_take_an_axiom_back_is_never_to_have_had_it(
    scene: Callable[..., Any],
    said: Sequence[tuple[str, str]],
    last: tuple[str, str],
) -> None:
    one, other = scene(nouns=NOUNS), scene(nouns=NOUNS)
    for lower, upper in said:
        one.hear(f"A {lower} is a kind of {upper}.")
        other.hear(f"A {lower} is a kind of {upper}.")
    if other.acts("A {} is a kind of {}.".format(*last)) == ["learned_kind"]:
        assert other.acts("Forget that.") == ["forgot_kind"]
    assert axioms(one) == axioms(other)
    assert one.state.private.nouns == other.state.private.nouns


@given(
    st.lists(PAIRS, max_size=4),
    st.fixed_dictionaries({it: st.sampled_from([0.0, 0.3, 0.9]) for it in NOUNS}),
)
@settings(max_examples=15)
def test_synonyms_are_as_probable_as_each_other(
    scene: Callable[..., Any],
    said: Sequence[tuple[str, str]],
    degrees: dict[str, float],
) -> None:
    known = {(word, "o1"): p for word, p in degrees.items()}
    robot = scene(nouns=NOUNS, known=known)
    for one, other in said:
        robot.hear(f"{one.capitalize()} is another word for {other}.")
    s, model = robot.state, robot.now.model
    p = degrees_of(robot)
    for one in s.private.nouns:
        for other in s.private.nouns:
            if is_kind_of(s, one, other):
                assert are_synonyms(s, one, other)
                assert p[one.form] == p[other.form]
    first, *rivals = (it.sign for it in names_of(s, model, "o1"))
    assert not any(are_synonyms(s, first, it) for it in rivals)
