"""The robot's words are perceptual meanings: printed, corrected, compared."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from kille import Agent
from kille.dialogue.meanings import noun
from rich_values import check_html
from ttr import Record, TTRError, box, record
from ttr.errors import UnsupportedError
from ttr.probability import UNKNOWN
from ttr.semantics.perceptual import (
    agreement,
    combined_type,
    convergence,
    difference,
    history,
    says,
)


@pytest.fixture(scope="module")
def robot() -> Iterator[Agent]:
    """Who has learned a cup, a book, and what is to the left of what."""
    with Agent(sensor="synthetic:empty?seed=7") as it:
        it.do("show cup")
        it.hear("This is a cup.")
        it.do("show book")
        it.hear("This is a book.")
        it.do("show cup")
        it.do("place book at -0.28 0.1")
        it.hear("The book is to the left of the cup.")
        yield it


def seen(robot: Agent, x: str) -> Record:
    """A thing in the robot's latest look."""
    return record(x=x, look=robot.state.view.look)


def cup_and_book(robot: Agent) -> tuple[Record, Record]:
    """The situations of the cup and of the book, whichever is the nearer."""
    one, other = seen(robot, "o1"), seen(robot, "o2")
    return (one, other) if says(robot.meaning("cup"), one) else (other, one)


def test_a_word_can_be_printed(robot: Agent) -> None:
    cup = robot.meaning("cup")
    assert str(cup) == (
        "{bg = [look : Look, x : Ind], "
        "clf = <Classifier of x, look by a learner, as cup>, "
        "interp = \\r:[look : Look, x : Ind]. [c : cup(r.x, r.look)], "
        "params = {labels = [book, cup], learner = <Handle ObjectMemory>}}"
    )
    assert "λr:⎡look : Look⎤. [c : cup(r.x, r.look)]" in box(cup.record)
    assert cup.type is noun("cup").meaning


def test_a_word_judges_as_the_robot_does(robot: Agent) -> None:
    cup, book = cup_and_book(robot)
    for word in ("cup", "book"):
        meaning = robot.meaning(word)
        for r in (cup, book):
            p = robot.model.perceive(r, meaning.type).p
            assert meaning.degree(r) == p
            assert meaning.judge(robot.model, r).p == p
    assert list(robot.words().degrees(cup)) == ["cup", "book"]


def test_a_relation_is_judged_of_two_things(robot: Agent) -> None:
    left = robot.meaning("to the left of")
    cup, book = cup_and_book(robot)
    r = record(look=cup.look, frame="away", target=book, landmark=cup)
    back = record(look=cup.look, frame="away", target=cup, landmark=book)
    assert left.degree(r) == robot.model.perceive(r, left.type).p
    claim = f"to_the_left_of({book.x}, {cup.x}, {cup.look}, away)"
    assert str(left.classify(r)) == claim
    assert left.degree(back).hi < 0.5


def test_a_word_can_be_corrected_and_the_robot_is_not(robot: Agent) -> None:
    cup, _ = cup_and_book(robot)
    words, lessons = robot.words(), robot.memory.lessons()
    after = words.corrected(cup, said="cup", right="book")
    assert says(words["cup"], cup)
    assert not says(after["cup"], cup)
    assert after["book"].degree(cup).lo > words["book"].degree(cup).hi
    assert robot.memory.lessons() == lessons
    assert robot.words().degrees(cup) == words.degrees(cup)
    assert difference(words["cup"], after["cup"]) == (
        "params.learner: <Handle ObjectMemory> → <Handle ObjectMemory + 1 lesson>",
    )


def test_a_new_word_is_learned_beside_the_others(robot: Agent) -> None:
    cup, book = cup_and_book(robot)
    mug = robot.meaning("cup").with_params(robot.meaning("book").params)
    assert mug.degree(cup) == robot.meaning("cup").degree(cup)
    taught = mug.confirmed(book)
    assert taught.degree(book).lo > mug.degree(book).lo
    with pytest.raises(UnsupportedError, match="cup: that it is not cup teaches this"):
        mug.rejected(cup)


def test_two_robots_can_be_compared(robot: Agent) -> None:
    cup, book = cup_and_book(robot)
    with Agent(sensor="synthetic:empty?seed=7") as other:
        other.do("show book")
        other.hear("This is a cup.")
        other.hear("This is a cup.")
        mistaken = other.words()
    mine = robot.words()
    # The other has learned by its own eyes; here it is shown what this one sees.
    theirs = mine.with_meaning("cup", mine["cup"].with_params(mistaken["cup"].params))
    before = agreement(mine["cup"], theirs["cup"], [cup, book])
    assert before.share < 1.0
    pupils = history(mine, theirs, "cup", [cup])
    series = convergence(mine, pupils, "cup", [cup]).series
    assert [it.share for it in series] == [0.0, 1.0]


def test_a_word_combines_with_another(robot: Agent) -> None:
    cup, book = robot.meaning("cup"), robot.meaning("book")
    assert str(combined_type(cup, book)["c"]) == "book(.x, .look) /\\ cup(.x, .look)"


def test_what_the_robot_no_longer_sees_is_unknown(robot: Agent) -> None:
    gone = record(x="o1", look="look99")
    cup = robot.meaning("cup")
    assert cup.degree(gone) == UNKNOWN
    with pytest.raises(TTRError, match="cup: nothing can be seen in"):
        cup.confirmed(gone)


def test_a_word_that_the_robot_does_not_know(robot: Agent) -> None:
    with pytest.raises(TTRError, match="robot has no meaning of 'unicorn'"):
        robot.meaning("unicorn")


def test_a_relation_is_judged_and_shown_by_itself_among_several() -> None:
    with Agent(sensor="synthetic:empty?seed=7", scans=1) as robot:
        robot.do("place cup at 0 0")
        robot.hear("This is a cup.")
        for side in ("left", "right"):
            robot.do(f"place book {side} of cup")
            robot.hear("#2 This is a book." if side == "left" else "")
            robot.hear(f"The book is to the {side} of the cup.")
        left = robot.meaning("to the left of")
        assert left.params.labels == ("to_the_left_of",)
        shown = left._repr_html_()
        check_html(shown)
        assert "where “to_the_left_of” holds" in shown
        assert "to_the_right_of" not in shown
