"""Moves, actions and propositions of IBiS1, as ptypes.

A move is the type of the situations in which it is made: `ask(usr, q)`. An action on
the agenda or in a plan is the type of what is to be done: `findout(q)`.

Source: Larsson 2002, chapter 2.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ttr.judging.models import Model
from ttr.semantics.questions import Question, is_question, with_questions
from ttr.types.objects import Object
from ttr.types.syntax import Basic, ListOf, Negation, Pred, PType, RecordType

USR, SYS = "usr", "sys"
"""The two participants."""

Participant = Basic("Participant")
"""The type of participants: `usr` and `sys`."""

Proposition = Basic("Proposition")
"""The type of what is believed or agreed on: record types and their negations."""

Content = Basic("Content")
"""The type of what an answer says: a proposition, the name of an object, yes or no."""

Feedback = Basic("Feedback")
"""The type of problems with what was said: `per_neg` not perceived, `und_neg` not
understood."""

Program = Basic("Program")
"""The type of whether the dialogue goes on: `run` or `quit`."""

# --- moves ---------------------------------------------------------------------------

Move = Basic("Move")
"""The type of moves: asking, answering, greeting and so on."""

ask, answer = Pred("ask", Participant, Question), Pred("answer", Participant, Content)
greet, quit = Pred("greet", Participant), Pred("quit", Participant)
icm = Pred("icm", Participant, Feedback)
"""Interactive communication management: the system says that there is a problem."""
unclear = Pred("unclear", Participant)
"""Something was said that is no move known to the system."""
prompt = Pred("prompt", Participant)
"""The system invites a question."""

Ask, Answer, Greet, Quit = Basic("Ask"), Basic("Answer"), Basic("Greet"), Basic("Quit")
Unclear = Basic("Unclear")

# --- actions -------------------------------------------------------------------------

Action = Basic("Action")
"""The type of actions: finding out, responding and so on."""

findout = Pred("findout", Question)
"""Get an answer to a question from the user."""
raise_ = Pred("raise", Question)
"""Ask a question once, whether or not it is answered."""
consult = Pred("consult", Question)
"""Look up the answer to a question in the database."""
respond = Pred("respond", Question)
"""Answer a question of the user."""
if_then = Pred("if_then", Proposition, ListOf(Action), ListOf(Action))
"""Do the first list of actions if the proposition is known, else the second."""
say = Pred("say", Move)
"""Make a move."""

no_answer = Pred("no_answer", Question)
"""The system could find no answer to a question."""


# --- what is one ----------------------------------------------------------------------


def content_of(made: PType) -> Object:
    """What a move or an action is about: its last argument.

    >>> content_of(answer(USR, "paris"))
    'paris'
    """
    return made.args[-1]


def _is_proposition(value: Object) -> bool:
    if isinstance(value, Negation):
        value = value.body
    return isinstance(value, RecordType)


def _is_content(value: Object) -> bool:
    return isinstance(value, str) or _is_proposition(value)


def _is_action(value: Object) -> bool:
    return _is_of(value, _ACTIONS)


def _are_actions(value: Object) -> bool:
    return isinstance(value, tuple) and all(map(_is_action, value))


def _is_move(value: Object) -> bool:
    return _is_of(value, _MOVES)


def _is_of(value: Object, forms: Mapping[Pred, tuple[_Check, ...]]) -> bool:
    """Is a value a ptype of these predicates with arguments of the right form?"""
    if not isinstance(value, PType) or value.pred not in forms:
        return False
    checks = forms[value.pred]
    return all(check(arg) for check, arg in zip(checks, value.args, strict=True))


_Check = Callable[[Object], bool]

_PARTICIPANTS = (USR, SYS)
_FEEDBACK = ("per_neg", "und_neg")


def _among(*words: str) -> _Check:
    return lambda value: isinstance(value, str) and value in words


_is_participant, _is_feedback = _among(*_PARTICIPANTS), _among(*_FEEDBACK)

_MOVES: Mapping[Pred, tuple[_Check, ...]] = {
    ask: (_is_participant, is_question),
    answer: (_is_participant, _is_content),
    greet: (_is_participant,),
    quit: (_is_participant,),
    icm: (_is_participant, _is_feedback),
    unclear: (_is_participant,),
    prompt: (_is_participant,),
}

_ACTIONS: Mapping[Pred, tuple[_Check, ...]] = {
    findout: (is_question,),
    raise_: (is_question,),
    consult: (is_question,),
    respond: (is_question,),
    if_then: (_is_proposition, _are_actions, _are_actions),
    say: (_is_move,),
}


def _moves_of(pred: Pred) -> _Check:
    forms = {pred: _MOVES[pred]}
    return lambda value: _is_of(value, forms)


_FORMS: Mapping[Basic, _Check] = {
    Participant: _is_participant,
    Proposition: _is_proposition,
    Content: _is_content,
    Feedback: _is_feedback,
    Program: _among("run", "quit"),
    Move: _is_move,
    Action: _is_action,
    Ask: _moves_of(ask),
    Answer: _moves_of(answer),
    Greet: _moves_of(greet),
    Quit: _moves_of(quit),
    Unclear: _moves_of(unclear),
}


def with_terms(model: Model) -> Model:
    """The model in which moves, actions and so on are of their types by their form.

    >>> M = with_terms(Model())
    >>> M.judge(ask(USR, "paris"), Move).holds
    False
    """
    model = with_questions(model)
    for T, check in _FORMS.items():
        model = model.witnessed(T, by=check)
    return model
