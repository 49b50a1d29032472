"""IBiS1 and the travel agency of the examples: stories, and what never fails."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Model, Rec, TTRError, rectype
from ttr.dialogues.stories import play, read_stories, setting
from ttr.errors import NotHeardError
from ttr.semantics.gameboards.ibis import Domain, PhraseBook, utterance
from ttr.semantics.gameboards.ibis import moves as moves
from ttr.semantics.gameboards.ibis.domains import plan_size, questions_in
from ttr.semantics.questions import find_answer, resolves, whether, which
from ttr.updates.checks import faults_of

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "travel"
STORIES = read_stories(FOLDER / "travel.dlg")
GAME = setting("travel.py:game", FOLDER).game
BOOK = GAME.hear.__self__
THEORY = GAME.theory
M = GAME.model
COST, VISA, DEST = THEORY["Cost"], THEORY["Visa"], THEORY["Dest"]


def talk(*texts):
    """The last turn of a dialogue in which the user says this."""
    return GAME.play(map(GAME.hear, texts))[-1]


def words(turn):
    return [GAME.say(said) for said in turn.said]


def rules(turn):
    return [step.rule.name for step in turn.trace]


# --- stories -------------------------------------------------------------------------


@pytest.mark.parametrize("story", STORIES, ids=lambda story: story.title)
def test_a_story_goes_as_written(story):
    mismatch = play(story).mismatch
    assert mismatch is None, f"\n{mismatch}"


def test_the_page_runs():
    run = subprocess.run(
        [sys.executable, "-W", "error", str(FOLDER / "travel.py")],
        capture_output=True,
        env={**os.environ, "PYTHONUTF8": "1"},
        encoding="utf-8",
        timeout=60,
        check=False,
    )
    assert (run.returncode, run.stderr) == (0, "")
    assert "S> It costs 700 crowns." in run.stdout.splitlines()
    assert "  shared.com: + [e : means(train)]" in run.stdout.splitlines()


def test_the_rules_have_no_fault_and_are_explained():
    assert faults_of(GAME) == ()
    assert all(rule.doc and rule.kind for rule in GAME.rules)


# --- the rules -----------------------------------------------------------------------


def test_a_question_of_the_users_loads_its_plan():
    s = talk("price").state
    assert s.shared.qud == (THEORY["How"], COST)
    assert s.private.plan == THEORY["PricePlan"]
    assert s.private.agenda == ()


def test_an_answer_is_agreed_on_and_its_question_dropped():
    turn = talk("price", "train")
    assert rules(turn)[:4] == [
        "get_user_moves",
        "integrate_usr_answer",
        "downdate_qud",
        "remove_answered",
    ]
    assert turn.state.shared.com == (rectype(e=THEORY["means"]("train")),)
    assert THEORY["How"] not in turn.state.shared.qud


def test_no_is_the_negation_of_what_was_asked():
    asked = ["price", "by train from london to paris in may, economy"]
    agreed = talk(*asked, "no").state.shared.com
    assert ~THEORY["Return"].body in agreed
    assert THEORY["Return"].body not in agreed
    assert THEORY["Return"].body in talk(*asked, "yes").state.shared.com


@pytest.mark.parametrize(
    "text",
    [
        *("not paris", "not to paris", "not from paris", "not may", "not in may"),
        *("not back in may", "not train", "not by train", "not economy"),
    ],
)
def test_not_is_never_passed_over(text):
    said = BOOK.hear(text)
    plain = BOOK.hear(text.replace("not ", ""))
    assert str(said) != str(plain)
    turn = talk("price", text)
    assert not any(str(fact) in str(plain) for fact in turn.state.shared.com)


def test_no_is_no_answer_to_a_question_which():
    turn = talk("price", "no")
    assert "integrate_useless" in rules(turn)
    assert turn.state.shared.com == ()
    assert turn.state.shared.qud == (THEORY["How"], COST)


def test_a_plan_depends_on_what_is_agreed_on():
    asked = ["price", "by train from london to paris in may, economy"]
    assert "In which month do you want to come back?" in words(talk(*asked, "yes"))
    assert words(talk(*asked, "no")) == ["It costs 700 crowns."]


def test_a_correction_takes_back_what_rests_on_it_and_nothing_else():
    before = talk("price", "plane to paris from london in may, economy", "no")
    assert find_answer(COST, before.state.shared.com, M) is not None
    after = GAME.take(before.run, GAME.hear("no, by train"))
    gone = set(before.state.shared.com) - set(after.state.shared.com)
    named = rectype(e=THEORY["means"]("plane"))
    assert gone == {named, find_answer(COST, before.state.shared.com, M)}
    assert words(after) == ["It costs 700 crowns."]
    assert find_answer(COST, after.state.shared.com, M) is not None


def test_what_is_said_again_changes_nothing_that_is_agreed_on():
    before = talk("price", "train", "to paris")
    after = GAME.take(before.run, GAME.hear("to paris"))
    assert "integrate_known" in rules(after)
    assert after.state.shared.com == before.state.shared.com


def test_after_the_end_nothing_happens():
    over = talk("price", "bye")
    assert over.state.program == "quit"
    assert over.state.shared.qud == ()
    for text in ("price", "", "hello"):
        turn = GAME.take(over.run, GAME.hear(text))
        assert (turn.trace, turn.said, turn.state) == ((), (), over.state)


def test_what_nobody_knows_how_to_find_out():
    turn = talk("", "ask(usr, ReturnMonth)")
    assert words(turn) == ["That I do not know."]
    assert turn.state.shared.qud == ()
    assert turn.state.shared.com == ()


# --- whatever is said ----------------------------------------------------------------

QUESTIONS = [
    T
    for name in sorted(THEORY.definitions)
    if M.judge(T := THEORY[name], moves.Question).holds
]
PROPOSITIONS = sorted(
    {
        move.args[1]
        for move in BOOK.phrases.values()
        if move.pred is moves.answer and not isinstance(move.args[1], str)
    },
    key=str,
)
NAMES = sorted({*THEORY.objects, "yes", "no", "nowhere"})
CONTENTS = st.sampled_from([*NAMES, *PROPOSITIONS, Rec, rectype(e=Rec), ~Rec])
MOVES = st.one_of(
    st.sampled_from(QUESTIONS).map(lambda q: moves.ask("usr", q)),
    CONTENTS.map(lambda a: moves.answer("usr", a)),
    CONTENTS.map(lambda a: moves.answer("usr", a)),
    st.sampled_from([moves.greet("usr"), moves.unclear("usr"), moves.quit("usr")]),
)
PHRASES = sorted(" ".join(phrase) for phrase in BOOK.phrases)
TEXTS = st.one_of(
    st.lists(st.sampled_from([*PHRASES, "zork"]), max_size=4).map(" ".join),
    st.text(max_size=12),
)
EVENTS = st.one_of(
    st.lists(MOVES, max_size=3).map(lambda made: utterance("usr", made)),
    TEXTS.map(GAME.hear),
    st.none(),
)
ANSWERS = {
    q: [a for a in NAMES if resolves(a, q, M)] for q in QUESTIONS if q is not COST
}


def check_turn(before, turn):
    """What holds after every turn, whatever was said."""
    s = turn.state
    assert turn.run.model.judge(s, GAME.type).holds
    assert s.next_moves == s.output == s.private.nim == ()
    assert len(set(s.shared.qud)) == len(s.shared.qud)
    assert len(set(s.shared.com)) == len(s.shared.com)
    assert all(find_answer(q, s.shared.com, M) is None for q in s.shared.qud)
    if before.program == "run":
        assert turn.said
        assert all(words(turn))
    kinds = {step.rule.kind for step in turn.trace}
    if "correct" not in kinds:
        assert set(before.shared.com) <= set(s.shared.com)


@given(st.lists(EVENTS, max_size=8))
def test_whatever_is_said_it_goes_on(events):
    so_far = GAME.begin()
    for event in events:
        turn = GAME.take(so_far, event)
        check_turn(so_far.state, turn)
        so_far = turn.run


def test_who_says_very_much_is_heard_to_the_end():
    turn = talk("price", "hello " * 1100 + "by train")
    assert THEORY["How"] not in turn.state.shared.qud
    assert turn.state.private.nim == ()


@pytest.mark.slow
@given(st.data())
def test_who_mostly_answers_what_is_asked_gets_an_answer(data):
    so_far = GAME.take(GAME.begin(), GAME.hear("price")).run
    for _ in range(8):
        asked = so_far.state.shared.qud[:1]
        wanders = not asked or data.draw(st.integers(0, 4)) == 0
        if wanders:
            event = data.draw(EVENTS)
        else:
            short = data.draw(st.sampled_from(ANSWERS[asked[0]]))
            event = utterance("usr", [moves.answer("usr", short)])
        turn = GAME.take(so_far, event)
        check_turn(so_far.state, turn)
        so_far = turn.run


@given(st.data())
def test_who_answers_all_that_is_asked_is_told_the_price_or_that_there_is_none(data):
    turn = GAME.take(GAME.begin(), GAME.hear("price"))
    for _ in range(8):
        if COST not in turn.state.shared.qud:
            break
        short = data.draw(st.sampled_from(ANSWERS[turn.state.shared.qud[0]]))
        turn = GAME.take(turn.run, utterance("usr", [moves.answer("usr", short)]))
    assert COST not in turn.state.shared.qud
    (text,) = words(turn)
    assert text.startswith(("It costs", "Sorry, there is no such trip."))


@pytest.mark.parametrize(
    "event",
    [
        "price",
        utterance("sys", []),
        utterance("usr", ["price"]),
        utterance("usr", [moves.ask("usr", "price")]),
        utterance("usr", [moves.answer("usr", 5)]),
        utterance("nobody", [moves.greet("nobody")]),
    ],
)
def test_what_is_no_utterance_of_the_user_is_not_heard(event):
    with pytest.raises(NotHeardError, match="is no event that the game travel takes"):
        GAME.take(GAME.begin(), event)


# --- domains and phrases -------------------------------------------------------------


def test_the_questions_in_a_plan():
    plan = THEORY["PricePlan"]
    assert list(questions_in(plan))[-1] is THEORY["ReturnMonth"]
    assert plan_size(plan) == len(plan) + 1


@pytest.mark.parametrize(
    ("plans", "message"),
    [
        ({"price": []}, "a plan is for a question, not for the object 'price'"),
        ({COST: ["ask"]}, "has ask, which is no action"),
        ({COST: [moves.findout("where")]}, "which is no action"),
        ({COST: [moves.greet("usr")]}, "which is no action"),
    ],
)
def test_what_is_no_domain(plans, message):
    with pytest.raises(TTRError, match=message):
        Domain(plans, lambda *_: None, M)


def test_a_database_that_answers_otherwise_is_named():
    domain = Domain({}, lambda *_: "700", Model())
    with pytest.raises(TTRError, match="or None, but it gave '700'"):
        domain.look_up(COST, ())


def test_what_opposes_an_answer():
    domain = Domain({}, lambda *_: None, M)
    paris, london = (rectype(e=THEORY["dest_city"](c)) for c in ("paris", "london"))
    assert domain.incompatible(london, DEST, [paris]) == (paris,)
    assert domain.incompatible(paris, DEST, [paris, ~london]) == ()
    assert domain.incompatible(~paris, DEST, [paris]) == (paris,)
    assert domain.incompatible(paris, DEST, [~paris]) == (~paris,)


def test_the_longest_phrase_is_heard():
    heard = GAME.hear("I go from London to Paris, not to Malmo")
    assert [str(move) for move in heard.moves] == [
        "answer(usr, [e : depart_city(london)])",
        "answer(usr, [e : dest_city(paris)])",
        "answer(usr, ~[e : dest_city(malmo)])",
    ]


@pytest.mark.parametrize(
    "text", ["(((", "ask(usr, Nothing)", "[1, 2]", "greet(sys", "?"]
)
def test_what_is_not_in_the_book_is_unclear(text):
    assert GAME.hear(text).moves == (moves.unclear("usr"),)
    assert GAME.hear("").moves == ()


def test_a_phrase_stands_for_a_move():
    with pytest.raises(TTRError, match="a phrase stands for a move, but paris is none"):
        PhraseBook.of(THEORY, M, phrases={"to": "paris"}, wordings={}, answers={})


def test_what_has_no_wording_is_said_in_the_notation():
    bare = PhraseBook.of(THEORY, M, phrases={}, wordings={}, answers={})
    assert bare.word_move(moves.greet("sys")) == "greet(sys)."
    assert GAME.model.judge(which(THEORY["price"]), moves.Question).holds
    assert whether(Rec) not in BOOK.answers
