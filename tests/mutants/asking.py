"""A small game: the system asks its two questions, and keeps what it is told.

It is correct, and its rules are what the mutants are made of.
"""

from __future__ import annotations

from ttr import Model, Record, Theory, merge, record, rectype, replace
from ttr.judging import Judgement
from ttr.testing import Roles, Tutor
from ttr.types import TypeNode
from ttr.updates import Game, by_class, first, maybe, repeat, rule, seq

theory = Theory.parse(
    """
    basic Ind, Question, Place
    object tutor, system : Ind
    object whence, whither : Question
    object paris, london : Place
    pred ask(Ind, Question), answer(Ind, Question, Place), greet(Ind), deny(Ind)

    Move   := [spkr : Ind]
    Heard  := [spkr = tutor : Ind]
    Said   := [spkr = system : Ind]
    Ask    := [spkr = system : Ind, q : Question, e : ask(spkr, q)]
    Hello  := [spkr = system : Ind, e : greet(spkr)]
    Answer := [spkr = tutor : Ind, q : Question, a : Place, e : answer(spkr, q, a)]
    Greet  := [spkr = tutor : Ind, e : greet(spkr)]
    Deny   := [spkr = tutor : Ind, e : deny(spkr)]
    Fact   := [q : Question, a : Place]
    Board  := [private : [agenda : list(RecType), plan : list(Question)],
               shared  : [qud : list(Question), commitments : list(Fact), latest : Rec,
                          history : list(Rec)]]
    Idle   := [private : [agenda = [] : list(RecType)],
               shared  : [qud = [] : list(Question)]]
    """
)
Board, Idle = theory["Board"], theory["Idle"]
Heard, Said = theory["Heard"], theory["Said"]
Ask, Answer, Greet, Deny, Hello = (
    theory[name] for name in ("Ask", "Answer", "Greet", "Deny", "Hello")
)


# --- grounding -----------------------------------------------------------------------


@rule(when=Board, on=Heard, kind="grounding")
def note(s: Record, e: Record) -> Record:
    """What the tutor does is the latest move."""
    history = (*s.shared.history, e)
    return replace(s, {"shared.latest": e, "shared.history": history})


@rule(when=Board, on=Said, kind="grounding")
def note_own(s: Record, e: Record) -> Record:
    """What the system has done is the latest move, and off its agenda."""
    return replace(note.effect(s, e), {"private.agenda": s.private.agenda[1:]})


# --- integrating ---------------------------------------------------------------------


@rule(when=Board, on=Answer, kind="integrating")
def accept(s: Record, e: Record) -> Record | None:
    """An answer to a question that is under discussion is agreed on."""
    if e.q not in s.shared.qud:
        return None
    fact = record(q=e.q, a=e.a)
    return replace(s, {"shared.commitments": (*s.shared.commitments, fact)})


@rule(when=Board, on=Deny, kind="integrating")
def take_back(s: Record, e: Record) -> Record | None:
    """A denial takes back what was agreed on last, and its question is asked again."""
    if not s.shared.commitments:
        return None
    *kept, last = s.shared.commitments
    again = () if last.q in (*s.private.plan, *s.shared.qud) else (last.q,)
    plan = (*again, *s.private.plan)
    return replace(s, {"shared.commitments": kept, "private.plan": plan})


@rule(when=Board, on=Greet, kind="integrating")
def greet_back(s: Record, e: Record) -> Record:
    """A greeting is returned."""
    return replace(s, {"private.agenda": (*s.private.agenda, Hello)})


@rule(when=Board, on=Ask, kind="integrating")
def put(s: Record, e: Record) -> Record:
    """A question that was asked is under discussion, and no longer planned."""
    plan = tuple(q for q in s.private.plan if q != e.q)
    return replace(s, {"private.plan": plan, "shared.qud": (e.q, *s.shared.qud)})


# --- what follows --------------------------------------------------------------------


@rule(when=Board)
def downdate(s: Record) -> Record | None:
    """A question that something agreed on resolves is no longer under discussion."""
    settled = {fact.q for fact in s.shared.commitments}
    kept = tuple(q for q in s.shared.qud if q not in settled)
    return None if kept == s.shared.qud else replace(s, {"shared.qud": kept})


@rule(when=Idle)
def ask_next(s: Record) -> Record | None:
    """Nothing is under discussion: the next question of the plan is to be asked."""
    if not s.private.plan:
        return None
    return replace(s, {"private.agenda": (asking(s.private.plan[0]),)})


def asking(q: str) -> TypeNode:
    """The type of asking a question."""
    return merge(Ask, rectype(q=Ask["q"] @ q))


react = by_class(
    note,
    note_own,
    accept,
    take_back,
    greet_back,
    put,
    order=("grounding", "integrating"),
)
game = Game(
    "asking",
    Board,
    record(
        private=record(agenda=[], plan=["whence", "whither"]),
        shared=record(qud=[], commitments=[], latest=record(), history=[]),
    ),
    first(
        seq(react, maybe(repeat(downdate, measure="shared.qud")), maybe(ask_next)),
        ask_next,
    ),
    Model(theory),
    "private.agenda",
    hears=(Answer, Greet, Deny),
)


def answers(event: Record, question: str) -> bool:
    """Whether an event is an answer to the question."""
    return "a" in event and event.q == question


def resolves(fact: Record, question: str) -> bool:
    """Whether what is agreed on settles the question."""
    return bool(fact.q == question)


def fits(event: Judgement | None, move: Judgement) -> bool:
    """A greeting comes after a greeting; a question is always welcome."""
    return move.type is not Hello or (event is not None and event.type <= Greet)


tutor = Tutor()
roles = Roles(
    qud="shared.qud",
    commitments="shared.commitments",
    latest="shared.latest",
    spoken=Heard,
    history="shared.history",
    answers=answers,
    resolves=resolves,
    fits=fits,
    retracts=frozenset({"take_back"}),
    moves=2,
)
