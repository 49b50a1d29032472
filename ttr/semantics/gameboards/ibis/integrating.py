"""Integration: rules that take in the moves of an utterance and drop questions.

Each rule takes the first move that is not yet integrated. Source: Larsson 2002, chapter
2; chapter 4 for the rules of the kinds `accommodate` and `correct`, on unraised issues
and on answers that are revised.
"""

from __future__ import annotations

from collections.abc import Mapping

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.domains import Domain, questions_in
from ttr.semantics.gameboards.ibis.moves import (
    SYS,
    USR,
    Answer,
    Ask,
    Greet,
    Move,
    Participant,
    Proposition,
    Quit,
    Unclear,
    content_of,
    greet,
    icm,
    quit,
    respond,
    say,
)
from ttr.semantics.gameboards.ibis.planning import (
    known_answer,
    load,
    no_answer_to,
    question_without_answer,
)
from ttr.semantics.questions import NO, YES, Question, combine, downdate, pop, push, top
from ttr.types.objects import Object, Record, fst
from ttr.types.path_notation import outer
from ttr.types.records import replace
from ttr.types.syntax import NonEmpty, PType, RecordType, TypeNode
from ttr.updates import Algorithm, Rule, all_, first, maybe, repeat, rule, seq

_NOTHING: Mapping[str, object] = {}


_DISCUSSED = rectype(shared=rectype(com=NonEmpty(Proposition), qud=NonEmpty(Question)))
"""The states with facts and questions, so that a fact may resolve a question."""


def integrating_from(speaker: str) -> RecordType:
    """The states in which a move of this speaker is to be integrated."""
    return rectype(
        private=rectype(nim=NonEmpty(Move)),
        shared=rectype(lu=rectype(speaker=Participant @ speaker)),
    )


def bind_move(T: TypeNode) -> RecordType:
    """Binds the first move that is to be integrated if it is of this type."""
    return rectype(m=T @ fst(outer.s.private.nim))


def _integrate(s: Record, changes: Mapping[str, object] = _NOTHING) -> Record:
    """The state with these changes, in which the first move is integrated."""
    return replace(s, {"private.nim": s.private.nim[1:], **changes})


def _agenda_with(s: Record, *actions: PType) -> tuple[Object, ...]:
    """The agenda with these actions at its end, each once."""
    new = tuple(action for action in actions if action not in s.private.agenda)
    return (*s.private.agenda, *new)


# --- asking, greeting, quitting ------------------------------------------------------


@rule(when=integrating_from(USR), where=bind_move(Ask), kind="integrate")
def integrate_usr_ask(s: Record, m: PType) -> Record:
    """The user's question is put under discussion; the system is to respond to it."""
    question = content_of(m)
    agenda = _agenda_with(s, respond(question))
    qud = push(s.shared.qud, question)
    return _integrate(s, {"shared.qud": qud, "private.agenda": agenda})


@rule(when=integrating_from(SYS), where=bind_move(Ask), kind="integrate")
def integrate_sys_ask(s: Record, m: PType) -> Record:
    """What the system has asked becomes the maximal question under discussion."""
    return _integrate(s, {"shared.qud": push(s.shared.qud, content_of(m))})


@rule(when=integrating_from(SYS), where=bind_move(Answer), kind="integrate")
def integrate_sys_answer(s: Record, m: PType) -> Record:
    """What the system has answered is agreed on.

    Where it had no answer, the question is no longer under discussion.
    """
    content = content_of(m)
    missing = question_without_answer(content)
    if missing is None:
        return _integrate(s, {"shared.com": _commitments_with(s, content)})
    return _integrate(s, {"shared.qud": pop(s.shared.qud, missing)})


def _commitments_with(s: Record, *propositions: Object) -> tuple[Object, ...]:
    """The shared commitments with these propositions, each once."""
    return tuple(dict.fromkeys((*s.shared.com, *propositions)))


@rule(when=integrating_from(USR), where=bind_move(Greet), kind="integrate")
def integrate_usr_greet(s: Record) -> Record:
    """The user greets: the system is to greet, too."""
    return _integrate(s, {"private.agenda": _agenda_with(s, say(greet(SYS)))})


@rule(when=integrating_from(USR), where=bind_move(Quit), kind="integrate")
def integrate_usr_quit(s: Record) -> Record:
    """The user leaves: the system is to say good-bye, and nothing else."""
    over = {"private.agenda": (say(quit(SYS)),), "private.plan": (), "shared.qud": ()}
    return replace(s, {"private.nim": (), **over})


@rule(when=integrating_from(SYS), where=bind_move(Quit), kind="integrate")
def integrate_sys_quit(s: Record) -> Record:
    """The system has said good-bye: the dialogue is over."""
    return _integrate(s, {"program": "quit"})


@rule(when=integrating_from(USR), where=bind_move(Unclear), kind="integrate")
def integrate_unclear(s: Record) -> Record:
    """What the user said is no known move: the system is to say so."""
    return _integrate(s, {"private.agenda": _agenda_with(s, say(icm(SYS, "per_neg")))})


@rule(when=integrating_from(USR), kind="integrate")
def integrate_useless(s: Record) -> Record:
    """The move is about nothing under discussion: the system is to say so."""
    return _integrate(s, {"private.agenda": _agenda_with(s, say(icm(SYS, "und_neg")))})


@rule(when=integrating_from(SYS), kind="integrate")
def integrate_other(s: Record) -> Record:
    """A move of the system that changes nothing else, such as a greeting."""
    return _integrate(s)


# --- answers -------------------------------------------------------------------------


def downdate_rule(domain: Domain) -> Rule:
    """The rule that drops questions which are resolved."""

    @rule(when=_DISCUSSED, kind="downdate")
    def downdate_qud(s: Record) -> Record | None:
        """A question that is resolved by what is agreed on is no longer discussed."""
        qud = downdate(s.shared.qud, s.shared.com, domain.model)
        return replace(s, {"shared.qud": qud}) if qud != s.shared.qud else None

    return downdate_qud


def own_integration(domain: Domain) -> Algorithm:
    """The algorithm that integrates all moves of the system's own utterance."""
    integrate = first(
        integrate_sys_ask, integrate_sys_answer, integrate_sys_quit, integrate_other
    )
    return seq(repeat(integrate, measure="private.nim"), maybe(downdate_rule(domain)))


def integration(domain: Domain) -> Algorithm:
    """The algorithm that integrates the user's moves, drops questions, loads plans."""

    def _questions_answered_again(s: Record, m: PType) -> list[tuple[Object, TypeNode]]:
        """The questions that a move answers again, each with what it conveys."""
        content = content_of(m)
        return (
            []
            if _is_short(m)
            else domain.questions_answered_again(content, s.shared.com)
        )

    @rule(when=integrating_from(USR), where=bind_move(Answer), kind="accommodate")
    def accommodate_issue(s: Record, m: PType) -> Record | None:
        """The user's answer is about just one issue, unraised so far: it is raised.

        Larsson 2002, chapter 4: issue accommodation.
        """
        if s.private.plan or _is_short(m) or _questions_answered_again(s, m):
            return None
        issues = domain.issues_about(content_of(m))
        if len(issues) != 1 or issues[0] in s.shared.qud:
            return None
        (issue,) = issues
        qud = (*s.shared.qud, issue)
        return replace(s, {"shared.qud": qud, "private.plan": domain.plan(issue)})

    @rule(when=integrating_from(USR), where=bind_move(Answer), kind="accommodate")
    def accommodate_question(s: Record, m: PType) -> Record | None:
        """The user's answer is about just one question in the plan: it is raised.

        Larsson 2002, chapter 4: question accommodation.
        """
        if _is_short(m) or domain.questions_about(content_of(m), s.shared.qud[:1]):
            return None
        asked = downdate(questions_in(s.private.plan), s.shared.com, domain.model)
        concerned = domain.questions_about(content_of(m), asked)
        if len(concerned) != 1:
            return None
        return replace(s, {"shared.qud": push(s.shared.qud, concerned[0])})

    @rule(when=integrating_from(USR), where=bind_move(Answer), kind="integrate")
    def integrate_usr_answer(s: Record, m: PType) -> Record | None:
        """What answers the maximal question under discussion is agreed on."""
        question = top(s.shared.qud)
        if question is None or not domain.questions_about(content_of(m), [question]):
            return None
        P = combine(question, content_of(m), domain.model)
        if domain.incompatible(P, question, s.shared.com):
            return None
        return _integrate(s, {"shared.com": _commitments_with(s, P)})

    @rule(when=integrating_from(USR), where=bind_move(Answer), kind="integrate")
    def integrate_known(s: Record, m: PType) -> Record | None:
        """What the user says is agreed on already: nothing changes.

        Not so where it answers the question just asked differently than before.
        """
        said, asked = _questions_answered_again(s, m), top(s.shared.qud)
        if any(q is asked and domain.incompatible(P, q, s.shared.com) for q, P in said):
            return None
        return _integrate(s) if any(P in s.shared.com for _, P in said) else None

    @rule(when=integrating_from(USR), where=bind_move(Answer), kind="correct")
    def correct_answer(s: Record, m: PType) -> Record | None:
        """The user answers a question differently than before: the new answer holds.

        If it could correct several answers, it corrects that to the question just
        asked. What was agreed on because of the old answer is open again. Larsson 2002,
        chapter 4: reaccommodation.
        """
        corrected = [
            (question, P, opposed)
            for question, P in _questions_answered_again(s, m)
            if (opposed := domain.incompatible(P, question, s.shared.com))
        ]
        asked = [one for one in corrected if one[0] is top(s.shared.qud)]
        if len(asked or corrected) != 1:
            return None
        ((question, P, opposed),) = asked or corrected
        issues = domain.dependent_issues(question)
        answered = [
            Q
            for Q in _known_propositions(s)
            for q in issues
            if domain.questions_about(Q, [q])
        ]
        stale = [*answered, *map(no_answer_to, issues)]
        reopened = [q for q in issues if known_answer(s, q, domain) is not None]
        gone = {*opposed, *stale}
        com = tuple(Q for Q in s.shared.com if Q not in gone)
        changes = {
            "shared.com": (*com, P),
            "shared.qud": tuple(dict.fromkeys((*s.shared.qud, *reopened))),
            "private.bel": tuple(Q for Q in s.private.bel if Q not in gone),
            "private.plan": (),
        }
        return _integrate(s, changes)

    downdate_qud = downdate_rule(domain)
    accommodate = all_(accommodate_issue, accommodate_question)
    integrate = first(
        integrate_usr_answer,
        integrate_known,
        correct_answer,
        integrate_usr_ask,
        integrate_usr_greet,
        integrate_usr_quit,
        integrate_unclear,
        integrate_useless,
    )
    each = seq(maybe(accommodate), integrate, maybe(downdate_qud), maybe(load(domain)))
    return repeat(each, measure="private.nim")


def _is_short(m: PType) -> bool:
    """Is a move a yes or no, which is about the latest question only?"""
    return isinstance(content_of(m), str) and content_of(m) in (YES, NO)


def _known_propositions(s: Record) -> tuple[Object, ...]:
    """All that is agreed on or believed."""
    return (*s.shared.com, *s.private.bel)
