"""The gameboards of Cooper and of KoS: what each rule does, and when it does not."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Ind, ListOf, Model, Pred, Rec, RecType, Type, record, rectype
from ttr.dialogues.encounters import Participant, meeting
from ttr.errors import NotHeardError
from ttr.semantics.gameboards import cooper, kos
from ttr.semantics.questions import Question, whether, which
from ttr.updates.checks import faults_of

leave, run_ = Pred("leave", Ind), Pred("run", Ind)
M = Model()
for name in ("a", "b", "kim", "sam"):
    M = M.given(name, Ind)
KIM_LEFT, SAM_LEFT = rectype(e=leave("kim")), rectype(e=leave("sam"))
SAM_RUNS = rectype(f=run_("sam"))
WHO_LEFT = which(leave)

# --- KoS -----------------------------------------------------------------------------

BOARD = kos.game(M, "a", "b")


def talk(*moves, board=BOARD):
    return board.play(map(kos.utterance, moves))[-1]


def rules(turn):
    return [step.rule.name for step in turn.trace]


def test_who_is_spoken_to_takes_the_turn():
    assert rules(talk(kos.greet("a", "b"))) == ["hear", "open_with_greeting"]
    turn = talk(kos.greet("a", "b"), kos.counter_greet("b", "a"))
    assert rules(turn) == ["take_turn", "hear", "greet_back"]
    assert (turn.state.spkr, turn.state.addr) == ("b", "a")


def test_a_greeting_opens_a_conversation_and_is_answered_once():
    once = talk(kos.greet("a", "b"), kos.greet("a", "b"))
    assert once.state.pending == (kos.greet("a", "b"),)
    other = talk(kos.greet("a", "b"), kos.counter_greet("a", "b"))
    assert other.state.pending == (kos.counter_greet("a", "b"),)
    again = talk(
        kos.greet("a", "b"), kos.counter_greet("b", "a"), kos.counter_greet("b", "a")
    )
    assert again.state.pending == (kos.counter_greet("b", "a"),)


def test_what_is_asked_is_maximal():
    turn = talk(
        kos.ask("a", "b", WHO_LEFT),
        kos.ask("a", "b", whether(SAM_RUNS)),
        kos.ask("a", "b", WHO_LEFT),
    )
    assert turn.state.qud == (WHO_LEFT, whether(SAM_RUNS))


def test_what_is_accepted_is_a_fact_and_downdates_all_that_it_resolves():
    moves = [kos.ask("a", "b", WHO_LEFT), kos.assert_that("b", "a", KIM_LEFT)]
    asserted = talk(*moves)
    assert asserted.state.qud == (whether(KIM_LEFT), WHO_LEFT)
    assert asserted.state.facts == ()
    accepted = talk(*moves, kos.accept("a", "b", KIM_LEFT))
    assert accepted.state.qud == ()
    assert accepted.state.facts == (KIM_LEFT,)
    assert accepted.state.moves[0] is kos.accept("a", "b", KIM_LEFT)


def test_what_is_denied_leaves_a_question_which_open():
    turn = talk(
        kos.ask("a", "b", WHO_LEFT),
        kos.assert_that("b", "a", ~KIM_LEFT),
        kos.accept("a", "b", ~KIM_LEFT),
    )
    assert turn.state.qud == (WHO_LEFT,)
    assert turn.state.facts == (~KIM_LEFT,)


@pytest.mark.parametrize("accepter", ["a", "b"])
def test_only_what_somebody_else_asserted_can_be_accepted(accepter):
    other = "b" if accepter == "a" else "a"
    turn = talk(kos.accept(accepter, other, KIM_LEFT))
    assert turn.state.facts == ()
    assert turn.state.pending == (kos.accept(accepter, other, KIM_LEFT),)
    own = talk(
        kos.assert_that(accepter, other, KIM_LEFT),
        kos.accept(accepter, other, KIM_LEFT),
    )
    assert own.state.facts == ()


def test_a_short_answer_is_about_the_maximal_question():
    turn = talk(kos.ask("a", "b", WHO_LEFT), kos.answer("b", "a", "kim"))
    assert turn.state.moves[0] is kos.assert_that("b", "a", KIM_LEFT)
    yes = talk(kos.ask("a", "b", whether(SAM_RUNS)), kos.answer("b", "a", "yes"))
    assert yes.state.moves[0] is kos.assert_that("b", "a", SAM_RUNS)
    no = talk(kos.ask("a", "b", whether(SAM_RUNS)), kos.answer("b", "a", "no"))
    assert no.state.moves[0] is kos.assert_that("b", "a", ~SAM_RUNS)


def test_what_makes_no_sense_stays_pending():
    turn = talk(kos.ask("a", "b", WHO_LEFT), kos.answer("b", "a", "yes"))
    assert turn.state.pending == (kos.answer("b", "a", "yes"),)
    assert turn.state.qud == (WHO_LEFT,)


def test_one_parts_when_nothing_is_discussed():
    assert talk(kos.part("a", "b")).state.moves == (kos.part("a", "b"),)
    open_ = talk(kos.ask("a", "b", WHO_LEFT), kos.part("a", "b"))
    assert open_.state.pending == (kos.part("a", "b"),)


def test_what_was_pending_may_be_grounded_later():
    turn = talk(
        kos.ask("a", "b", WHO_LEFT),
        kos.part("b", "a"),
        kos.assert_that("b", "a", KIM_LEFT),
        kos.accept("a", "b", KIM_LEFT),
    )
    assert turn.state.pending == ()
    assert turn.state.facts == (KIM_LEFT,)


def test_boards_of_two_may_differ():
    a, b = kos.game(M, "a", "b"), kos.game(M, "a", "b")
    heard_by_both = [kos.ask("a", "b", WHO_LEFT), kos.assert_that("b", "a", KIM_LEFT)]
    of_a = talk(*heard_by_both, kos.accept("a", "b", KIM_LEFT), board=a)
    of_b = talk(*heard_by_both, board=b)
    assert of_a.state.facts == (KIM_LEFT,)
    assert of_b.state.facts == ()


def test_what_is_no_utterance_is_not_heard():
    for move in (leave("kim"), "hello", kos.ask("a", "b", "who"), None):
        with pytest.raises(NotHeardError):
            BOARD.take(BOARD.begin(), record(spkr="a", addr="b", move=move))


PEOPLE = st.sampled_from([("a", "b"), ("b", "a")])
CONTENTS = st.sampled_from([KIM_LEFT, SAM_LEFT, SAM_RUNS, ~KIM_LEFT])
MOVES = st.one_of(
    st.builds(
        lambda act, who: act(*who),
        st.sampled_from([kos.greet, kos.counter_greet, kos.part]),
        PEOPLE,
    ),
    st.builds(
        lambda act, who, what: act(*who, what),
        st.sampled_from([kos.assert_that, kos.accept]),
        PEOPLE,
        CONTENTS,
    ),
    st.builds(
        lambda who, what: kos.ask(*who, what),
        PEOPLE,
        st.sampled_from([WHO_LEFT, whether(SAM_RUNS), whether(KIM_LEFT)]),
    ),
    st.builds(
        lambda who, what: kos.answer(*who, what),
        PEOPLE,
        st.sampled_from(["kim", "sam", "yes", "no", "x"]),
    ),
)


@given(st.lists(MOVES, max_size=8))
def test_whatever_is_said_the_board_is_a_board(moves):
    facts, said = (), 0
    for turn in BOARD.play(map(kos.utterance, moves)):
        s, said = turn.state, said + 1
        assert turn.run.model.judge(s, kos.DGB).holds
        assert len(set(s.qud)) == len(s.qud)
        assert set(facts) <= set(s.facts)
        assert len(s.moves) + len(s.pending) == said
        facts = s.facts


# --- Cooper --------------------------------------------------------------------------


def conversation(*contents):
    """a is going to assert these to b."""
    planned = [cooper.asserting("a", "b", content) for content in contents]
    return meeting(
        Participant("a", cooper.game("a", M, planned), rectype(spkr=Ind @ "a")),
        Participant("b", cooper.game("b", M), rectype(spkr=Ind @ "b")),
    )


def test_an_assertion_is_not_agreed_on_before_it_is_acknowledged():
    a, b = cooper.game("a", M, [cooper.asserting("a", "b", KIM_LEFT)]), None
    turn = a.take(a.begin())
    assert [step.rule.name for step in turn.trace] == ["make_move"]
    assert turn.state.shared.commitments is Rec
    assert turn.state.private.agenda == ()
    heard, M2 = M.create(cooper.asserting("a", "b", KIM_LEFT))
    b = cooper.game("b", M2)
    turn = b.take(b.begin(), heard)
    assert [step.rule.name for step in turn.trace] == [
        "hear_move",
        "plan_acknowledgement",
        "integrate_acknowledgement",
        "make_move",
    ]
    assert turn.state.shared.commitments is KIM_LEFT


def test_two_boards_come_to_the_same_commitments():
    talk = conversation(KIM_LEFT, SAM_RUNS)
    for _ in range(3):
        talk = talk.in_turn()
    both = rectype(e=leave("kim"), f=run_("sam"))
    assert talk.is_idle
    for name in ("a", "b"):
        assert talk.board(name).shared.commitments is both
        assert talk.board(name).private.agenda == ()


def test_who_is_not_addressed_keeps_an_own_board():
    other = cooper.game("kim", M)
    heard, M2 = M.create(cooper.asserting("a", "b", SAM_LEFT))
    turn = cooper.game("kim", M2).take(other.begin()._replace(model=M2), heard)
    assert turn.trace == ()
    assert turn.state == other.start


def test_an_acknowledgement_is_of_what_was_asserted():
    heard, M2 = M.create(cooper.asserting("a", "b", KIM_LEFT))
    board = cooper.game("a", M2, [cooper.asserting("a", "b", KIM_LEFT)])
    said = board.take(board.begin())
    for content, agreed in ((SAM_LEFT, Rec), (KIM_LEFT, KIM_LEFT)):
        back, M3 = said.model.create(cooper.acknowledging("b", "a", content))
        turn = board.take(said.run._replace(model=M3), back)
        assert turn.state.shared.commitments is agreed
    assert heard.content is KIM_LEFT


# --- both ----------------------------------------------------------------------------


@pytest.mark.parametrize("game", [BOARD, cooper.game("a", M)], ids=lambda g: g.name)
def test_the_rules_have_no_fault_and_are_explained(game):
    assert faults_of(game) == ()
    assert all(rule.doc for rule in game.rules)


def test_boards_are_typed():
    assert kos.DGB["qud"] is ListOf(Question)
    assert kos.DGB["facts"] is ListOf(Type)
    assert cooper.BOARD["shared"]["commitments"] is RecType
