"""The dialogue gameboard of KoS: who speaks to whom, facts, moves, and questions.

A move is pending until it is grounded; then it is the latest move, and the
conversational rules integrate it. What is asked is put under discussion, and so is
whether what is asserted holds. What is accepted becomes a fact, and the questions that
it resolves are dropped. Each participant has their own board, and boards may differ.

Source: Ginzburg 2012, chapters 4 and 6. Facts and moves are lists here, the latest
first, and questions are in a linear order.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.building.constructors import rectype
from ttr.judging.models import Model
from ttr.semantics.questions import (
    Question,
    combine,
    downdate,
    is_question,
    push,
    relevant,
    top,
    whether,
    with_questions,
)
from ttr.types.objects import Object, Record, fst, record
from ttr.types.path_notation import outer
from ttr.types.records import replace
from ttr.types.syntax import (
    Basic,
    Ind,
    ListOf,
    NonEmpty,
    Pred,
    PType,
    RecordType,
    Type,
    TypeNode,
)
from ttr.updates import Algorithm, Game, all_, first, repeat, rule

__all__ = [
    "ALGORITHM",
    "DGB",
    "UTTERANCE",
    "Move",
    "Short",
    "accept",
    "answer",
    "ask",
    "assert_that",
    "counter_greet",
    "game",
    "greet",
    "part",
    "utterance",
    "with_moves",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)

# --- moves ---------------------------------------------------------------------------
# A move is a ptype, of the situations in which somebody greets, or asks, somebody.

Move = Basic("Move")
"""The types of moves.

>>> from ttr import Ind, Model
>>> from ttr.semantics.gameboards.kos import Move, greet, with_moves
>>> M = with_moves(Model().given("a", Ind).given("b", Ind))
>>> M.judge(greet("a", "b"), Move).holds
True
"""

Short = Basic("Short")
"""Short answers: the names of objects, yes and no.

>>> from ttr import Ind, Model
>>> from ttr.semantics.gameboards.kos import Short, with_moves
>>> M = with_moves(Model().given("kim", Ind))
>>> [M.judge(it, Short).holds for it in ("kim", "yes")]
[True, True]
"""

greet, counter_greet = Pred("greet", Ind, Ind), Pred("counter_greet", Ind, Ind)
"""The moves that greet somebody and greet back.

>>> from ttr.semantics.gameboards.kos import counter_greet, greet
>>> print(greet("a", "b"), counter_greet("b", "a"))
greet(a, b) counter_greet(b, a)
"""
part = Pred("part", Ind, Ind)
"""The move that says goodbye.

>>> from ttr.semantics.gameboards.kos import part
>>> print(part("a", "b"))
part(a, b)
"""
ask = Pred("ask", Ind, Ind, Question)
r"""The move that asks a question.

>>> from ttr import Ind, Pred
>>> from ttr.semantics.gameboards.kos import ask
>>> from ttr.semantics.questions import which
>>> print(ask("a", "b", which(Pred("leave", Ind))))
ask(a, b, \r:[x : Ind]. [e : leave(r.x)])
"""
answer = Pred("answer", Ind, Ind, Short)
"""The move that gives a short answer.

>>> from ttr.semantics.gameboards.kos import answer
>>> print(answer("b", "a", "kim"))
answer(b, a, kim)
"""
assert_that, accept = Pred("assert", Ind, Ind, Type), Pred("accept", Ind, Ind, Type)
"""The moves that assert a proposition and accept one.

>>> from ttr import Ind, Pred, rectype
>>> from ttr.semantics.gameboards.kos import accept, assert_that
>>> left = rectype(e=Pred("leave", Ind)("kim"))
>>> print(assert_that("a", "b", left), accept("b", "a", left))
assert(a, b, [e : leave(kim)]) accept(b, a, [e : leave(kim)])
"""

Greeting, CounterGreeting = Basic("Greeting"), Basic("CounterGreeting")
Parting, Asking, Answering = Basic("Parting"), Basic("Asking"), Basic("Answering")
Assertion, Acceptance = Basic("Assertion"), Basic("Acceptance")

_KINDS: Mapping[Basic, Pred] = {
    Greeting: greet,
    CounterGreeting: counter_greet,
    Parting: part,
    Asking: ask,
    Answering: answer,
    Assertion: assert_that,
    Acceptance: accept,
}

_CONTENTS: Mapping[Pred, Callable[[Object], bool]] = {
    ask: is_question,
    answer: lambda value: isinstance(value, str),
    assert_that: lambda value: isinstance(value, TypeNode),
    accept: lambda value: isinstance(value, TypeNode),
}


def _is_move(value: Object) -> bool:
    if not isinstance(value, PType) or value.pred not in _KINDS.values():
        return False
    check = _CONTENTS.get(value.pred)
    return check is None or check(value.args[-1])


def with_moves(model: Model) -> Model:
    """The model in which moves and questions are of their types by their form.

    >>> M = with_moves(Model().given("a", Ind).given("b", Ind))
    >>> M.judge(greet("a", "b"), Move).holds, M.judge("a", Move).holds
    (True, False)
    """
    model = with_questions(model)
    model = model.witnessed(Move, by=_is_move)
    for T, pred in _KINDS.items():
        model = model.witnessed(T, by=_is_of(pred))
    return model.witnessed(Short, by=lambda value: isinstance(value, str))


def _is_of(pred: Pred) -> Callable[[Object], bool]:
    return lambda value: _is_move(value) and value.pred is pred


# --- the board -----------------------------------------------------------------------

DGB: RecordType = rectype(
    spkr=Ind,
    addr=Ind,
    facts=ListOf(Type),
    pending=ListOf(Move),
    moves=ListOf(Move),
    qud=ListOf(Question),
)
"""The type of dialogue gameboards.

The facts are agreed on; `pending` has the moves that are not yet grounded. The first of
the moves, pending or not, is the latest; the first of the questions is the maximal one.

>>> from ttr.semantics.gameboards.kos import DGB
>>> print(", ".join(DGB))
addr, facts, moves, pending, qud, spkr
"""

UTTERANCE: RecordType = rectype(spkr=Ind, addr=Ind, move=Move)
"""The type of utterances: speaker, addressee and move.

>>> from ttr.semantics.gameboards.kos import UTTERANCE
>>> print(UTTERANCE)
[addr : Ind, move : Move, spkr : Ind]
"""


def utterance(move: PType) -> Record:
    """The utterance of a move.

    >>> print(utterance(greet("a", "b")))
    {addr = b, move = greet(a, b), spkr = a}
    """
    return record(spkr=move.args[0], addr=move.args[1], move=move)


# --- who speaks, and what was said ---------------------------------------------------


@rule(
    when=DGB,
    on=UTTERANCE,
    where=rectype(turn=(Ind @ outer.s.addr) @ outer.e.spkr),
    kind="turn",
)
def take_turn(s: Record, e: Record) -> RecordType:
    """The addressee becomes the speaker when they say something."""
    return rectype(spkr=Ind @ s.addr, addr=Ind @ s.spkr)


@rule(when=DGB, on=UTTERANCE, kind="pending")
def hear(s: Record, e: Record) -> Record:
    """What was said is pending."""
    return replace(s, pending=(e.move, *s.pending))


# --- conversational rules ------------------------------------------------------------
# Each grounds the first pending move if it is of the right kind and makes sense there.

_PENDING = rectype(pending=NonEmpty(Move))


def bind_pending(T: TypeNode) -> RecordType:
    """Binds the first pending move if it is of this type."""
    return rectype(m=T @ fst(outer.s.pending))


def _ground(s: Record, m: PType, **changes: object) -> Record:
    """The board with these changes, and the pending move as the latest move."""
    return replace(s, pending=s.pending[1:], moves=(m, *s.moves), **changes)


@rule(
    when=rectype(
        pending=NonEmpty(Move),
        moves=ListOf(Move) @ (),
        qud=ListOf(Question) @ (),
    ),
    where=bind_pending(Greeting),
    kind="ground",
)
def open_with_greeting(s: Record, m: PType) -> Record:
    """A conversation may begin with a greeting."""
    return _ground(s, m)


@rule(
    when=rectype(pending=NonEmpty(Move), moves=NonEmpty(Move)),
    where=rectype(
        latest=Greeting @ fst(outer.s.moves), m=CounterGreeting @ fst(outer.s.pending)
    ),
    kind="ground",
)
def greet_back(s: Record, m: PType, latest: PType) -> Record | None:
    """Somebody who was greeted may greet back."""
    return _ground(s, m) if latest.args == m.args[::-1] else None


@rule(when=_PENDING, where=bind_pending(Asking), kind="ground")
def ask_qud(s: Record, m: PType) -> Record:
    """What is asked becomes the maximal question under discussion."""
    return _ground(s, m, qud=push(s.qud, m.args[-1]))


@rule(when=_PENDING, where=bind_pending(Assertion), kind="ground")
def assert_qud(s: Record, m: PType) -> Record:
    """Whether what is asserted holds becomes the maximal question."""
    return _ground(s, m, qud=push(s.qud, whether(m.args[-1])))


@rule(
    when=rectype(pending=NonEmpty(Move), qud=NonEmpty(Question)),
    where=bind_pending(Answering),
    kind="ground",
)
def answer_qud(s: Record, m: PType, *, model: Model) -> Record | None:
    """A short answer asserts what it conveys as an answer to the maximal question."""
    question, short = top(s.qud), m.args[-1]
    if not relevant(short, question, model):
        return None
    proposition = combine(question, short, model)
    asserted = assert_that(*m.args[:2], proposition)
    return _ground(s, asserted, qud=push(s.qud, whether(proposition)))


@rule(
    when=rectype(pending=NonEmpty(Move), qud=NonEmpty(Question)),
    where=bind_pending(Acceptance),
    kind="ground",
)
def accept_fact(s: Record, m: PType, *, model: Model) -> Record | None:
    """What somebody else asserted becomes a fact when it is accepted.

    The questions that it resolves are no longer under discussion.
    """
    accepter, _, proposition = m.args
    by_others = (
        move
        for move in s.moves
        if move.pred is assert_that and move.args[0] != accepter
    )
    if not any(move.args[-1] is proposition for move in by_others):
        return None
    facts = (proposition, *(fact for fact in s.facts if fact is not proposition))
    return _ground(s, m, facts=facts, qud=downdate(s.qud, facts, model))


@rule(
    when=rectype(pending=NonEmpty(Move), qud=ListOf(Question) @ ()),
    where=bind_pending(Parting),
    kind="ground",
)
def close_with_parting(s: Record, m: PType) -> Record:
    """A conversation may end when nothing is under discussion."""
    return _ground(s, m)


ALGORITHM: Algorithm = all_(
    take_turn,
    hear,
    repeat(
        first(
            open_with_greeting,
            greet_back,
            ask_qud,
            assert_qud,
            answer_qud,
            accept_fact,
            close_with_parting,
        ),
        measure="pending",
    ),
)
"""Take the turn, hear, then ground all that can be grounded.

What cannot be grounded stays pending: a reason to ask for clarification.

>>> from ttr.semantics.gameboards.kos import ALGORITHM
>>> print(ALGORITHM)
all(take_turn, hear, repeat(first(open_with_greeting, greet_back, ask_qud, assert_qud,
answer_qud, accept_fact, close_with_parting), pending))
"""


def game(model: Model, spkr: str, addr: str) -> Game:
    """The game on the board of one participant, at the start of a conversation.

    >>> leave = Pred("leave", Ind)
    >>> M = Model().given("a", Ind).given("b", Ind).given("kim", Ind)
    >>> board = game(M, "a", "b")
    >>> from ttr.semantics.questions import which
    >>> left = rectype(e=leave("kim"))
    >>> moves = [ask("a", "b", which(leave)), answer("b", "a", "kim")]
    >>> _, answered = board.play(map(utterance, moves))
    >>> print(answered.state.moves[0], len(answered.state.qud), answered.state.facts)
    assert(b, a, [e : leave(kim)]) 2 ()
    >>> accepted = board.take(answered.run, utterance(accept("a", "b", left)))
    >>> print(len(accepted.state.qud), *accepted.state.facts)
    0 [e : leave(kim)]
    """
    start = record(spkr=spkr, addr=addr, facts=[], pending=[], moves=[], qud=[])
    return Game(
        "a dialogue gameboard",
        DGB,
        start,
        ALGORITHM,
        with_moves(model),
        hears=(UTTERANCE,),
    )
