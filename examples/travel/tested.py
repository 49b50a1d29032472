"""The agency with a tutor, to be tested: `ttr test examples/travel/tested.py`.

The tutor mostly answers what it was asked, in moves or in words; the roles say where in
the state the questions are and what has been agreed on.
"""

from functools import cache

from travel import book, game

from ttr import Model, Record, rectype
from ttr.semantics.gameboards.ibis import utterance
from ttr.semantics.gameboards.ibis.moves import USR, Program, content_of
from ttr.semantics.questions import relevant, resolves, top
from ttr.testing import Roles, Tutor
from ttr.types.objects import Object
from ttr.types.syntax import PType

PHRASES = {
    move: " ".join(words) for words, move in reversed(list(book.phrases.items()))
}
"""The words for each move; of several, the first."""

ANSWERS = tuple(move for move in PHRASES if move.pred.name == "answer")
ASKING = tuple(move for move in PHRASES if move.pred.name == "ask")
OTHER = tuple(utterance(USR, [move]) for move in PHRASES if move not in ANSWERS)
TEXTS = (
    "",
    "colourless green ideas",
    "by train from london to paris in may",
    "economy class, one way please",
    "to atlantis",
    "no no no",
)


@cache
def replying(question: Object | None) -> tuple[Record, ...]:
    """Utterances that answer a question; where there is none, that ask one."""
    if question is None:
        return tuple(utterance(USR, [move]) for move in ASKING)
    found = [m for m in ANSWERS if relevant(content_of(m), question, game.model)]
    return tuple(utterance(USR, [move]) for move in found[:6])


def replies(state: Record, model: Model) -> tuple[Record, ...]:
    """What answers the question that is under discussion."""
    return replying(top(state.shared.qud))


def words(event: Record) -> str | None:
    """The words for an utterance, if there are any for all its moves."""
    known = [PHRASES.get(move) for move in event.moves]
    return ", ".join(known) if known and all(known) else None


@cache
def answering(move: PType, question: Object) -> bool:
    """Whether a move is an answer that resolves a question."""
    return move.pred.name == "answer" and resolves(
        content_of(move), question, game.model
    )


def answers(event: Record, question: Object) -> bool:
    """Whether an utterance of the user's answers the question."""
    return event.spkr == USR and any(answering(m, question) for m in event.moves)


@cache
def settles(agreed: Object, question: Object) -> bool:
    """Whether what is agreed on resolves the question."""
    return resolves(agreed, question, game.model)


tutor = Tutor(
    moves=(*OTHER, *(utterance(USR, [move]) for move in ANSWERS), *TEXTS),
    replies=replies,
    answers=0.75,
    mumbles=0.05,
)
roles = Roles(
    qud="shared.qud",
    commitments="shared.com",
    latest="shared.lu",
    answers=answers,
    resolves=settles,
    words=words,
    drops=frozenset({"integrate_sys_answer", "integrate_usr_quit"}),
    retracts=frozenset({"correct_answer"}),
    over=rectype(program=Program @ "quit"),
    moves=2,
)
