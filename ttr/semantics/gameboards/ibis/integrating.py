"""Taking in the moves of an utterance, one after the other, and dropping questions.

Each rule takes the first move that is not yet integrated. Source: Larsson 2002, chapter
2, for all but the rules of the kinds `accommodate` and `correct`: those are after his
account of unraised issues and of answers that are revised, chapter 4.
"""

from __future__ import annotations

from collections.abc import Mapping

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.domains import Domain, asked_in
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
    load,
    settled,
    unanswered,
    without_answer,
)
from ttr.semantics.questions import NO, YES, Question, combine, downdate, pop, push, top
from ttr.types.objects import fst
from ttr.types.records import replace
from ttr.types.syntax import (
    NonEmpty,
    Object,
    PType,
    Record,
    RecordType,
    TypeNode,
    outer,
)
from ttr.updates import Algorithm, Rule, all_, first, maybe, repeat, rule, seq

__all__ = ["integration", "own_integration"]


_NOTHING: Mapping[str, object] = {}


DISCUSSED = rectype(shared=rectype(com=NonEmpty(Proposition), qud=NonEmpty(Question)))
"""The states in which there are facts that may resolve a question."""


def heard_from(speaker: str) -> RecordType:
    """The states in which a move of this speaker is to be integrated."""
    return rectype(
        private=rectype(nim=NonEmpty(Move)),
        shared=rectype(lu=rectype(speaker=Participant @ speaker)),
    )


def move_of(T: TypeNode) -> RecordType:
    """Binds the first move that is to be integrated, if it is of this type."""
    return rectype(m=T @ fst(outer.s.private.nim))


def _taken(s: Record, changes: Mapping[str, object] = _NOTHING) -> Record:
    """The state with these changes, the first move integrated."""
    return replace(s, {"private.nim": s.private.nim[1:], **changes})


def _planned(s: Record, *actions: PType) -> tuple[Object, ...]:
    """The agenda with these actions at the end, each only once."""
    new = tuple(action for action in actions if action not in s.private.agenda)
    return (*s.private.agenda, *new)


# --- asking, greeting, quitting ------------------------------------------------------


@rule(when=heard_from(USR), where=move_of(Ask), kind="integrate")
def integrate_usr_ask(s: Record, m: PType) -> Record:
    """A question of the user's is under discussion, and to be responded to."""
    question = content_of(m)
    agenda = _planned(s, respond(question))
    qud = push(s.shared.qud, question)
    return _taken(s, {"shared.qud": qud, "private.agenda": agenda})


@rule(when=heard_from(SYS), where=move_of(Ask), kind="integrate")
def integrate_sys_ask(s: Record, m: PType) -> Record:
    """What the system has asked is the maximal question under discussion."""
    return _taken(s, {"shared.qud": push(s.shared.qud, content_of(m))})


@rule(when=heard_from(SYS), where=move_of(Answer), kind="integrate")
def integrate_sys_answer(s: Record, m: PType) -> Record:
    """What the system has answered is agreed on.

    Where it had no answer, it is agreed that the question is not to be discussed.
    """
    content = content_of(m)
    missing = unanswered(content)
    if missing is None:
        return _taken(s, {"shared.com": _agreed(s, content)})
    return _taken(s, {"shared.qud": pop(s.shared.qud, missing)})


def _agreed(s: Record, *propositions: Object) -> tuple[Object, ...]:
    """What is agreed on with these, each only once."""
    return tuple(dict.fromkeys((*s.shared.com, *propositions)))


@rule(when=heard_from(USR), where=move_of(Greet), kind="integrate")
def integrate_usr_greet(s: Record) -> Record:
    """The user greets: the system is going to greet, too."""
    return _taken(s, {"private.agenda": _planned(s, say(greet(SYS)))})


@rule(when=heard_from(USR), where=move_of(Quit), kind="integrate")
def integrate_usr_quit(s: Record) -> Record:
    """The user leaves: the system is going to say good-bye, and nothing else."""
    over = {"private.agenda": (say(quit(SYS)),), "private.plan": (), "shared.qud": ()}
    return replace(s, {"private.nim": (), **over})


@rule(when=heard_from(SYS), where=move_of(Quit), kind="integrate")
def integrate_sys_quit(s: Record) -> Record:
    """The system has said good-bye: the dialogue is over."""
    return _taken(s, {"program": "quit"})


@rule(when=heard_from(USR), where=move_of(Unclear), kind="integrate")
def integrate_unclear(s: Record) -> Record:
    """What the user said is no move: the system is going to say so."""
    return _taken(s, {"private.agenda": _planned(s, say(icm(SYS, "per_neg")))})


@rule(when=heard_from(USR), kind="integrate")
def integrate_useless(s: Record) -> Record:
    """The move is about nothing under discussion: the system is going to say so."""
    return _taken(s, {"private.agenda": _planned(s, say(icm(SYS, "und_neg")))})


@rule(when=heard_from(SYS), kind="integrate")
def integrate_other(s: Record) -> Record:
    """A move of the system that changes nothing else, as a greeting."""
    return _taken(s)


# --- answers -------------------------------------------------------------------------


def downdating(domain: Domain) -> Rule:
    """Drops what is resolved."""

    @rule(when=DISCUSSED, kind="downdate")
    def downdate_qud(s: Record) -> Record | None:
        """A question that something agreed on resolves is no longer discussed."""
        qud = downdate(s.shared.qud, s.shared.com, domain.model)
        return replace(s, {"shared.qud": qud}) if qud != s.shared.qud else None

    return downdate_qud


def own_integration(domain: Domain) -> Algorithm:
    """Takes in every move of the system's own."""
    integrate = first(
        integrate_sys_ask, integrate_sys_answer, integrate_sys_quit, integrate_other
    )
    return seq(repeat(integrate, measure="private.nim"), maybe(downdating(domain)))


def integration(domain: Domain) -> Algorithm:
    """Takes in every move of the user's: drops what it resolves, loads its plan."""

    def _said(s: Record, m: PType) -> list[tuple[Object, TypeNode]]:
        """What a move says as an answer to a question answered before, and to which."""
        content = content_of(m)
        return [] if _is_short(m) else domain.said_before(content, s.shared.com)

    @rule(when=heard_from(USR), where=move_of(Answer), kind="accommodate")
    def accommodate_issue(s: Record, m: PType) -> Record | None:
        """What the user says is about one issue only, which nobody raised: it is now.

        Larsson 2002, chapter 4: issue accommodation.
        """
        if s.private.plan or _is_short(m) or _said(s, m):
            return None
        issues = domain.concerned(content_of(m))
        if len(issues) != 1 or issues[0] in s.shared.qud:
            return None
        (issue,) = issues
        qud = (*s.shared.qud, issue)
        return replace(s, {"shared.qud": qud, "private.plan": domain.plan(issue)})

    @rule(when=heard_from(USR), where=move_of(Answer), kind="accommodate")
    def accommodate_question(s: Record, m: PType) -> Record | None:
        """What the user says answers one question in the plan: that is raised now.

        Larsson 2002, chapter 4: question accommodation.
        """
        if _is_short(m) or domain.about(content_of(m), s.shared.qud[:1]):
            return None
        asked = domain.open(asked_in(s.private.plan), s.shared.com)
        concerned = domain.about(content_of(m), asked)
        if len(concerned) != 1:
            return None
        return replace(s, {"shared.qud": push(s.shared.qud, concerned[0])})

    @rule(when=heard_from(USR), where=move_of(Answer), kind="integrate")
    def integrate_usr_answer(s: Record, m: PType) -> Record | None:
        """What answers the maximal question under discussion is agreed on."""
        question = top(s.shared.qud)
        if question is None or not domain.about(content_of(m), [question]):
            return None
        P = combine(question, content_of(m), domain.model)
        if domain.opposed(P, question, s.shared.com):
            return None
        return _taken(s, {"shared.com": _agreed(s, P)})

    @rule(when=heard_from(USR), where=move_of(Answer), kind="integrate")
    def integrate_known(s: Record, m: PType) -> Record | None:
        """What the user says is agreed on already: nothing changes.

        Unless it answers the question just asked, and in another way than before.
        """
        said, asked = _said(s, m), top(s.shared.qud)
        if any(q is asked and domain.opposed(P, q, s.shared.com) for q, P in said):
            return None
        return _taken(s) if any(P in s.shared.com for _, P in said) else None

    @rule(when=heard_from(USR), where=move_of(Answer), kind="correct")
    def correct_answer(s: Record, m: PType) -> Record | None:
        """The user answers a question in another way than before: that holds now.

        What could correct several answers corrects that to the question just asked.
        What was agreed on because of the earlier answer is open again.
        Larsson 2002, chapter 4: reaccommodation.
        """
        corrected = [
            (question, P, opposed)
            for question, P in _said(s, m)
            if (opposed := domain.opposed(P, question, s.shared.com))
        ]
        asked = [one for one in corrected if one[0] is top(s.shared.qud)]
        if len(asked or corrected) != 1:
            return None
        ((question, P, opposed),) = asked or corrected
        issues = domain.resting_on(question)
        answered = [Q for Q in _held(s) for q in issues if domain.about(Q, [q])]
        stale = [*answered, *map(without_answer, issues)]
        reopened = [q for q in issues if settled(s, q, domain) is not None]
        gone = {*opposed, *stale}
        com = tuple(Q for Q in s.shared.com if Q not in gone)
        changes = {
            "shared.com": (*com, P),
            "shared.qud": tuple(dict.fromkeys((*s.shared.qud, *reopened))),
            "private.bel": tuple(Q for Q in s.private.bel if Q not in gone),
            "private.plan": (),
        }
        return _taken(s, changes)

    downdate_qud = downdating(domain)
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
    """Whether a move says yes or no, which is about the latest question only."""
    return isinstance(content_of(m), str) and content_of(m) in (YES, NO)


def _held(s: Record) -> tuple[Object, ...]:
    """All that is agreed on or believed."""
    return (*s.shared.com, *s.private.bel)
