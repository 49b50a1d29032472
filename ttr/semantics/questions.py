"""Questions, what answers them, and the questions under discussion.

A question is a propositional abstract: a function from situations to types. *Whether
she left* is `\\r:Rec. [e : leave(she)]`, and *who left* is
`\\r:[x : Ind]. [e : leave(r.x)]`. An alternative question is a set of questions
whether. Which answers are about a question and which resolve it follows from these
functions: an answer is about a question that can be applied to it.

Sources: Ginzburg 2012, chapters 3 and 4; Larsson 2002, chapter 2, for the names of the
three relations between questions and answers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, TypeGuard

from ttr.aliases import former_names
from ttr.building.constructors import fun, rectype
from ttr.building.merging import merge_meet
from ttr.errors import IllFormedError, TTRError
from ttr.judging.certainty import is_certain
from ttr.judging.models import Model
from ttr.safety.budgets import spend
from ttr.semantics.argument_checks import as_tuple
from ttr.types.interning import identity
from ttr.types.objects import (
    BOUND,
    FiniteSet,
    Object,
    Path,
    Record,
    UnresolvedError,
)
from ttr.types.path_notation import outer
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.substitution import instantiate_body, resolve_paths
from ttr.types.syntax import (
    Basic,
    Function,
    Negation,
    Pred,
    PType,
    Rec,
    RecordType,
    Singleton,
    TypeNode,
    as_type,
    kind_of,
)

__all__ = [
    "NO",
    "YES",
    "Question",
    "asked_of",
    "combine",
    "downdate",
    "is_polar",
    "is_question",
    "pop",
    "push",
    "relevant",
    "resolves",
    "find_answer",
    "top",
    "whether",
    "which",
    "which_of",
    "with_questions",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)

_MATCHES = 4096
"""The number of propositions whose arguments in a question are cached."""

YES, NO = "yes", "no"
"""The short answers to questions whether.

>>> from ttr import Basic, Model
>>> from ttr.semantics.questions import NO, YES, combine, whether
>>> rain = whether(Basic("Rain"))
>>> print(combine(rain, YES, Model()), combine(rain, NO, Model()))
Rain ~Rain
"""

Question = Basic("Question")
"""The type of questions; `with_questions` gives a model its witnesses.

>>> from ttr import Basic, Model
>>> from ttr.semantics.questions import Question, whether, with_questions
>>> with_questions(Model()).judge(whether(Basic("Rain")), Question).holds
True
"""


# --- questions -----------------------------------------------------------------------


def whether(T: TypeNode) -> Function:
    r"""The question whether there is a situation of T: λr:Rec. T.

    >>> leave = Pred("leave", Basic("Ind"))
    >>> print(whether(rectype(e=leave("kim"))))
    \r:Rec. [e : leave(kim)]
    """
    return fun(r=Rec)(T)


def which(pred: Pred) -> Function:
    r"""The question which object a predicate holds of: λr:[x : S]. [e : p(r.x)].

    Raises `TTRError` for a predicate that cannot be said of a single object.

    >>> print(which(Pred("leave", Basic("Ind"))))
    \r:[x : Ind]. [e : leave(r.x)]
    """
    if not isinstance(pred, Pred):
        raise TTRError(f"a question which asks for a predicate, found {kind_of(pred)}")
    places = [arity for arity in pred.arities if len(arity) == 1]
    if not places:
        raise TTRError(
            f"{pred.name} has no place that a question could ask for",
            hint=r"write the function, as in \r:[x : S]. [e : p(r.x, a)]",
        )
    return fun(r=rectype(x=places[0][0]))(rectype(e=pred(outer.r.x)))


def which_of(*types: TypeNode) -> FiniteSet:
    """The alternative question which of some types is the case: a set of questions.

    Raises `TTRError` for fewer than two alternatives.

    >>> leave = Pred("leave", Basic("Ind"))
    >>> len(which_of(rectype(e=leave("kim")), rectype(e=leave("sam"))))
    2
    """
    if len(types) < 2:
        raise TTRError("an alternative question has at least two alternatives")
    return FiniteSet(*map(whether, types))


def is_question(value: Object) -> bool:
    """Is an object a question: a function from records to types, or a set of such?

    >>> is_question(whether(Rec)), is_question(Rec)
    (True, False)
    """
    spend()
    if isinstance(value, FiniteSet):
        return len(value) > 1 and all(map(is_polar, value))
    return (
        isinstance(value, Function)
        and isinstance(value.domain, RecordType)
        and isinstance(value.body, TypeNode)
    )


def is_polar(value: Object) -> TypeGuard[Function]:
    """Is an object a question whether, that is, one that asks for no object?

    >>> is_polar(whether(Basic("Rain"))), is_polar(which(Pred("leave", Basic("Ind"))))
    (True, False)
    """
    spend()
    return is_question(value) and isinstance(value, Function) and value.domain is Rec


def with_questions(model: Model) -> Model:
    """The model in which questions are of the type `Question` by their form.

    >>> M = with_questions(Model())
    >>> M.judge(whether(Basic("Rain")), Question).holds, M.judge(Rec, Question).holds
    (True, False)
    """
    return model.witnessed(Question, by=is_question)


# --- answers -------------------------------------------------------------------------


def relevant(answer: Object, question: Object, model: Model) -> bool:
    """Is an answer about a question?

    About a question whether T are yes, no, T and ¬T. About a question which are an
    object that it can be applied to, the type that it then gives, and the negation of
    that. About an alternative question is what is about one of the alternatives, except
    yes and no. Propositions may be more specific than what was asked for.

    >>> City = Basic("City")
    >>> dest = Pred("dest_city", City)
    >>> M = Model().given("paris", City)
    >>> where_to = which(dest)
    >>> relevant("paris", where_to, M), relevant("yes", where_to, M)
    (True, False)
    >>> relevant(~rectype(e=dest("paris")), where_to, M)
    True
    """
    return _conveyed_proposition(answer, question, model) is not None


def resolves(answer: Object, question: Object, model: Model) -> bool:
    """Does an answer resolve a question?

    Whatever is about a question whether resolves it. Other questions are resolved only
    by what is not negative: "not Paris" does not resolve where somebody wants to go.
    Raises `IllFormedError` as `relevant`.

    >>> City = Basic("City")
    >>> dest = Pred("dest_city", City)
    >>> M = Model().given("paris", City)
    >>> resolves(rectype(e=dest("paris")), which(dest), M)
    True
    >>> resolves(~rectype(e=dest("paris")), which(dest), M)
    False
    """
    found = _conveyed_proposition(answer, question, model)
    if found is None:
        return False
    return is_polar(question) or not isinstance(_simplify_negation(found), Negation)


def combine(question: Object, answer: Object, model: Model) -> TypeNode:
    """The proposition that an answer conveys as an answer to a question.

    A question which is applied to its short answer. To a question whether T, yes and no
    convey T and ¬T. A proposition conveys itself. Raises `TTRError` for an answer that
    is not about the question.

    >>> City = Basic("City")
    >>> dest, back = Pred("dest_city", City), Pred("return_trip", ())
    >>> M = Model().given("paris", City)
    >>> print(combine(which(dest), "paris", M))
    [e : dest_city(paris)]
    >>> print(combine(whether(rectype(e=back())), "no", M))
    ~[e : return_trip()]
    """
    found = _conveyed_proposition(answer, question, model)
    if found is None:
        raise TTRError(f"{kind_of(answer)} is no answer to the question {question}")
    return found


def find_answer(
    question: Object, propositions: Iterable[Object], model: Model
) -> TypeNode | None:
    """The first of some propositions that resolves a question, or None.

    >>> back = Pred("return_trip", ())
    >>> known = [~rectype(e=back())]
    >>> print(find_answer(whether(rectype(e=back())), known, Model()))
    ~[e : return_trip()]
    """
    for one in as_tuple(propositions, "propositions"):
        if isinstance(one, TypeNode) and resolves(one, question, model):
            return one
    return None


def asked_of(question: Function, P: TypeNode, model: Model) -> Record | None:
    """An r that a question q can be applied to with P ⊑ q(r), or None.

    Raises `TTRError` for what is no question.

    >>> City = Basic("City")
    >>> dest = Pred("dest_city", City)
    >>> M = Model().given("paris", City)
    >>> print(asked_of(which(dest), rectype(e=dest("paris")), M))
    {x = paris}
    """
    if not isinstance(question, Function):
        raise _no_question(question)
    found = _matching_argument(question, P) if isinstance(P, TypeNode) else None
    if found is None or not is_certain(model.facts, found, question.domain):
        return None
    return found


@lru_cache(_MATCHES)
def _matching_argument(question: Function, P: TypeNode) -> Record | None:
    """The r with P ⊑ q(r) by their forms alone, or None."""
    if not is_question(question):
        raise _no_question(question)
    bound: dict[str, Object] = {}
    found = _matches(question.body, _with_values_inlined(P), 0, bound)
    return Record(bound) if found else None


def _no_question(found: Object) -> TTRError:
    return TTRError(f"this is no question: {kind_of(found)}")


def _conveyed_proposition(
    answer: Object, question: Object, model: Model
) -> TypeNode | None:
    """The proposition that an answer conveys; None if it is not about the question."""
    spend()
    if isinstance(question, FiniteSet):
        found = (_conveyed_proposition(answer, one, model) for one in question)
        plain = isinstance(answer, TypeNode)
        return next((one for one in found if one is not None), None) if plain else None
    if not isinstance(question, Function) or not is_question(question):
        raise _no_question(question)
    if isinstance(answer, TypeNode):
        if _is_instance(answer, question, model):
            return answer
        _check_form(answer, question, model)
        return None
    if question.domain is Rec:
        if not isinstance(answer, str) or answer not in (YES, NO):
            return None
        body = as_type(question.body)
        return body if answer == YES else ~body
    given = _as_argument(answer, question.domain)
    if given is None or not is_certain(model.facts, given, question.domain):
        return None
    return _apply(question, given)


def _as_argument(answer: Object, domain: TypeNode) -> Record | None:
    """The record to apply a question to: {x = a} for a where it asks for [x : S]."""
    if isinstance(answer, Record):
        return answer
    labels = domain.labels if isinstance(domain, RecordType) else ()
    return Record({labels[0]: answer}) if len(labels) == 1 else None


def _apply(question: Function, argument: Record) -> TypeNode:
    return as_type(instantiate_body(question, argument))


def _is_instance(P: TypeNode, question: Function, model: Model) -> bool:
    """Is P ⊑ q(r), or P = ¬q(r), for some r that the question can be applied to?"""
    P = _simplify_negation(P)
    if asked_of(question, P, model) is not None:
        return True
    denied = P.body if isinstance(P, Negation) else ~P
    about = asked_of(question, denied, model)
    return about is not None and _apply(question, about) is denied


def _check_form(P: TypeNode, question: Function, model: Model) -> None:
    """Refuse what would be about a question if it were in a record type, or not in one.

    Raises `IllFormedError`: such an answer would be none, and nobody would know why.
    """
    P = _simplify_negation(P)
    said = P.body if isinstance(P, Negation) else P
    others: list[TypeNode] = []
    match question.body, said:
        case RecordType(((label, PType()),)), PType():
            others = [RecordType(((label, said),))]
        case PType(), RecordType(fields):
            others = [field for _, field in fields if not free_paths(field)]
    for other in others:
        meant = Negation(other) if isinstance(P, Negation) else other
        if _is_instance(meant, question, model):
            found, wanted = "a ptype", "a record type"
            if isinstance(said, RecordType):
                found, wanted = wanted, found
            raise IllFormedError(
                f"{said} is {found}, but {notation(question)} asks for {wanted}",
                hint=f"write {meant}",
            )


def _simplify_negation(P: TypeNode) -> TypeNode:
    """The type without double negations: T for ¬¬T."""
    while isinstance(P, Negation) and isinstance(P.body, Negation):
        P = P.body.body
    return P


def _with_values_inlined(P: TypeNode) -> TypeNode:
    """A record type with the values of its manifest fields for the paths to them.

    So [x = paris : City, e : dest_city(x)] matches like [e : dest_city(paris)].
    """
    P = merge_meet(P)
    if not isinstance(P, RecordType):
        return P
    fields: dict[str, TypeNode] = {}
    known: dict[str, Object] = {}
    for label, field in P.fields:
        with suppress(UnresolvedError):
            field = resolve_paths(field, (known,))
        fields[label] = field
        if isinstance(field, Singleton):
            known[label] = field.value
    return RecordType(tuple(fields.items()))


def _matches(
    pattern: Object, found: Object, out: int, bound: dict[str, Object]
) -> bool:
    """Is `found` below the pattern, with the objects `bound` for the variable?

    `out` is the number of record types between the variable and the pattern.
    """
    spend()
    if isinstance(pattern, RecordType):
        return isinstance(found, RecordType) and all(
            label in found and _matches(field, found[label], out + 1, bound)
            for label, field in pattern.fields
        )
    if isinstance(pattern, PType):
        return (
            isinstance(found, PType)
            and found.pred is pattern.pred
            and len(found.args) == len(pattern.args)
            and all(
                _matches(a, b, out, bound)
                for a, b in zip(pattern.args, found.args, strict=True)
            )
        )
    if isinstance(pattern, Path) and (pattern.up, pattern.labels[0]) == (out, BOUND):
        if isinstance(found, Path) or len(pattern.labels) != 2:
            return False
        known = bound.setdefault(pattern.labels[1], found)
        return bool(identity(known) == identity(found))
    if isinstance(pattern, Singleton) and isinstance(found, Singleton):
        return _matches(pattern.base, found.base, out, bound) and _matches(
            pattern.value, found.value, out, bound
        )
    return bool(identity(pattern) == identity(found))


# --- questions under discussion ------------------------------------------------------
# A list of questions, the maximal one first, each once: a linear order that the partial
# order of Ginzburg's QUD is part of, and the stack without repetition of IBiS.


def push(qud: Iterable[Object], question: Object) -> tuple[Object, ...]:
    """The questions with this one on top; if it was there already, it is moved.

    Raises `TTRError` for what is no question.

    >>> a, b = (whether(Basic(name)) for name in "AB")
    >>> push(push([a], b), a) == (a, b)
    True
    """
    if not is_question(question):
        raise TTRError(f"only questions are under discussion, not {kind_of(question)}")
    return question, *_without(as_tuple(qud, "questions"), question)


def top(qud: Iterable[Object]) -> Object | None:
    """The maximal question under discussion, or None where there is none.

    >>> a, b = (whether(Basic(name)) for name in "AB")
    >>> top(push([a], b)) == b, top([])
    (True, None)
    """
    return next(iter(as_tuple(qud, "questions")), None)


def pop(qud: Iterable[Object], question: Object) -> tuple[Object, ...]:
    """The questions without one that was dropped or resolved.

    >>> a, b = (whether(Basic(name)) for name in "AB")
    >>> pop([b, a], b) == (a,)
    True
    """
    return tuple(_without(as_tuple(qud, "questions"), question))


def downdate(
    qud: Iterable[Object], facts: Iterable[Object], model: Model
) -> tuple[Object, ...]:
    """The questions that no fact resolves.

    >>> back = rectype(e=Pred("return_trip", ())())
    >>> downdate([whether(back), whether(Rec)], [~back], Model()) == (whether(Rec),)
    True
    """
    known = as_tuple(facts, "propositions")
    asked = as_tuple(qud, "questions")
    return tuple(q for q in asked if find_answer(q, known, model) is None)


def _without(qud: Iterable[Object], question: Object) -> Iterator[Object]:
    return (one for one in qud if identity(one) != identity(question))
