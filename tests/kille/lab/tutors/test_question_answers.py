"""What answers which question, by itself."""

import pytest

from kille.lab.tutors.question_answers import answer_test
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.worlds import draw_world
from ttr import Rec, record

GAME = simulated_game(draw_world(1))
ONE, TWO, THREE = ([record(n=float(i)) for i in range(n)] for n in (1, 2, 3))


@pytest.mark.parametrize(
    ("text", "ask", "options", "answers"),
    [
        ("That is correct.", "OfferWord", TWO, True),
        ("That is wrong.", "OfferWord", TWO, True),
        ("Hello.", "OfferWord", TWO, False),
        ("That is correct.", "AskPresumed", TWO, True),
        ("You mixed them up.", "AskMeant", TWO, True),
        ("You mixed them up.", "AskMeant", ONE, False),
        ("What I say now.", "AskEither", TWO, True),
        ("What I said before.", "AskBoth", TWO, True),
        ("That is correct.", "AskEither", TWO, False),
        ("That is wrong.", "AskForgetAll", ONE, True),
        ("Forget that.", "AskKind", TWO, True),
        ("Forget the last thing.", "AskEarlier", TWO, True),
        ("Forget that this is a cup.", "AskKind", TWO, False),
        ("Forget that.", "AskForget", ONE, False),
        ("That is correct.", "AskHeard", ONE, True),
        ("That is correct.", "AskHeard", TWO, False),
        ("That is wrong.", "AskReferent", TWO, True),
        ("The first one.", "AskReferent", TWO, True),
        ("The third one.", "AskReferent", TWO, False),
        ("The third one.", "AskReferentAgain", THREE, True),
        ("The red one.", "AskReferent", TWO, False),
        ("From your side.", "AskFrame", TWO, True),
        ("As the cup sees it.", "AskFrame", TWO, False),
        ("That is correct.", "AskFrame", TWO, False),
    ],
)
def test_what_answers_what(text, ask, options, answers):
    (heard,) = (
        step.event for step in GAME.take(GAME.begin(), GAME.hear(text)).trace[:1]
    )
    assert answer_test("en")(heard, record(ask=ask, options=options)) is answers


def test_a_no_that_is_read_by_parts_answers():
    no = record(text="Not that one.", content=Rec)
    assert answer_test("en")(no, record(ask="AskMeant", options=ONE))


def test_what_happens_and_is_not_said_answers_nothing():
    asked = record(ask="OfferWord", options=TWO)
    assert not answer_test("en")(record(floor="tutor"), asked)
    assert not answer_test("en")("Yes.", asked)
