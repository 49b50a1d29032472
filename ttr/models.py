"""Models: an assignment of witnesses to types, immutable and cheap to extend.

A model answers three questions. `judge` checks what is there; `perceive` also fills the
fields whose predicates have witness functions; `create` makes a fresh witness. None
of them changes the model: what is new is in the model they give back.
"""

from __future__ import annotations

from typing import Protocol

from immutables import Map

from ttr.assignments import Assignment, WitnessFunction
from ttr.creating import created, told
from ttr.errors import IllFormed, Refused, TTRError, Unsupported, following_nesting
from ttr.judgements import Judgement
from ttr.judging import derivation, reduced
from ttr.paths import escaping
from ttr.perceiving import filled
from ttr.printing import notation
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree, degree
from ttr.propositions import claim
from ttr.syntax import (
    Application,
    Basic,
    NonEmpty,
    Object,
    Plus,
    Pred,
    PType,
    Record,
    TypeNode,
    as_type,
    freeze,
)
from ttr.theories import Signature
from ttr.witnesses import witnesses

__all__ = ["Model"]


class _HasSignature(Protocol):
    @property
    def signature(self) -> Signature: ...


class Model:
    """Which objects are judged to be of which types, under a theory.

    An unlisted judgement is refuted, unless its type is open: the theory says so, or it
    has a witness function, or a judgement of it was given with a degree between.

    >>> from ttr.constructors import rectype
    >>> from ttr.syntax import Ind, record, this
    >>> dog = Pred("dog", Ind)
    >>> Dog = rectype(x=Ind, c=dog(this.x))
    >>> M = Model().given("fido", Ind).given("s1", dog("fido"))
    >>> M.judge(record(x="fido", c="s1"), Dog).holds
    True
    >>> print(M.judge(record(x="fido", c="s2"), Dog).why)
    ✗ {c = s2, x = fido} : [x : Ind, c : dog(x)]   (field by field)
      ✓ x: fido : Ind   (given)
      ✗ c: s2 : dog(fido)   (nothing says so; s1 would do)
    """

    __slots__ = ("_facts",)

    _facts: Assignment

    def __init__(self, theory: Signature | _HasSignature | None = None, /) -> None:
        signature = _signature(theory)
        self._facts = Assignment(
            signature, opened=Map(dict.fromkeys(signature.opened, True))
        )
        start = self
        for given in signature.givens:
            start = start.given(given.sit, given.type, given.p)
        self._facts = start._facts

    @classmethod
    def of(cls, facts: Assignment) -> Model:
        """The model of these facts."""
        model = object.__new__(cls)
        model._facts = facts
        return model

    @property
    def theory(self) -> Signature:
        """The axioms, open types and first judgements that the model goes by."""
        return self._facts.theory

    @following_nesting
    def given(self, sit: object, T: TypeNode, /, p: object = 1.0) -> Model:
        """The model in which also sit : T, with a probability or an interval.

        Records, meets, singletons and lists are taken apart into their atoms, for which
        the probability must be 1. Raises `Refused` where a witness function says no or
        what is given cannot be, and `IllFormed` where a path leads nowhere.

        >>> M = Model().given("a", Basic("A"), 0.8)
        >>> print(M.judge("a", Basic("A")).p)
        0.8
        """
        sit, T = _closed(sit, T)
        try:
            p = degree(p)
        except TTRError as error:
            raise TTRError(f"{notation(sit)} : {T}: {error.message}") from None
        if isinstance(T, Basic | PType):
            return self._with(self._facts.with_fact(sit, T, p))
        if p != CERTAIN:
            raise Unsupported(
                f"only basic types and ptypes take a degree, but {T} was given {p}"
            )
        facts = told(self._facts, sit, T)
        why = derivation(facts, sit, T)
        if why.p == REFUTED:
            raise Refused(
                f"{notation(sit)} : {T} cannot be given: it denies what it says"
            )
        return self._with(facts)

    def witnessed(self, head: Basic | Pred, /, *, by: WitnessFunction) -> Model:
        """The model in which a Python function says what is of a type.

        For a basic type it is asked of the object; for a predicate, of the arguments of
        the ptype. It answers with a truth value, a number in [0, 1] or an interval.

        >>> Real = Basic("Real")
        >>> M = Model().witnessed(Real, by=lambda a: isinstance(a, float))
        >>> M.judge(0.5, Real).holds, M.judge("a", Real).holds
        (True, False)
        """
        if not isinstance(head, Basic | Pred):
            raise TTRError(
                f"a witness function is for a basic type or a predicate, found {head}"
            )
        if not callable(by):
            raise TTRError(
                f"the witness function of {head} is a Python function, found {by!r}"
            )
        return self._with(self._facts.with_function(head, by))

    @following_nesting
    def judge(self, sit: object, T: TypeNode, /) -> Judgement:
        """Is sit of T? What is there is checked; nothing is filled in.

        Raises `IllFormed` where T is no type, or has a path that leads nowhere.
        """
        sit, T = _closed(sit, T)
        why = derivation(self._facts, sit, T)
        return Judgement(sit, T, why.p, why, self)

    @following_nesting
    def perceive(self, sit: object, T: TypeNode, /) -> Judgement:
        """Judges after filling the fields that are missing and can be perceived.

        A field that the record lacks and whose ptype's predicate has a witness function
        gets a fresh situation, judged with the function's degree.

        >>> from ttr.constructors import rectype
        >>> from ttr.syntax import Ind, record, this
        >>> cup = Pred("cup", Ind)
        >>> M = Model().given("o1", Ind).witnessed(cup, by=lambda x: 0.75)
        >>> j = M.perceive(record(x="o1"), rectype(x=Ind, c=cup(this.x)))
        >>> print(j)
        {c = e1, x = o1} : [x : Ind, c : cup(x)]   p = 0.75
        """
        sit, T = _closed(sit, T)
        if not isinstance(sit, Record):
            return self.judge(sit, T)
        seen, facts = filled(self._facts, sit, T)
        return self._with(facts).judge(seen, T)

    @following_nesting
    def create(self, T: TypeNode, /) -> tuple[Object, Model]:
        """A fresh witness of T, and the model that has it; else `Refused`.

        >>> from ttr.syntax import Ind
        >>> a, M = Model().create(Ind)
        >>> a, M.judge(a, Ind).holds
        ('a1', True)
        """
        _, T = _closed((), T)
        witness, facts = created(self._facts, T)
        return witness, self._with(facts)

    @following_nesting
    def apply(self, function: object, argument: object, /) -> Object:
        """f(a), worked out: the body of the function for the argument.

        Raises `Refused` where the argument is not certainly of the function's domain.

        >>> from ttr.constructors import fun
        >>> from ttr.syntax import Ind, this
        >>> run = fun(x=Ind)(Pred("run", Ind)(this.x))
        >>> print(Model().given("j", Ind).apply(run, "j"))
        run(j)
        >>> Model().apply(run, "zz")
        Traceback (most recent call last):
        ttr.errors.Refused: \\x:Ind. run(x) takes objects of Ind, which zz is not: ...
        """
        return self.reduced(Application(function, argument))

    @following_nesting
    def reduced(self, value: object, /) -> Object:
        """The type or object with every application in it worked out."""
        return reduced(self._facts, freeze(value))

    @following_nesting
    def witnesses(self, T: TypeNode, /) -> tuple[Object, ...]:
        """The known objects that certainly are of T, in the order they were told.

        For a record type they are all its records of known objects. Raises
        `Unsupported` for a type of which there may be others without end, such as
        lists.

        >>> from ttr.constructors import rectype
        >>> from ttr.syntax import Ind, this
        >>> dog = Pred("dog", Ind)
        >>> M = Model().given("fido", Ind).given("sam", Ind).given("s1", dog("fido"))
        >>> print(*M.witnesses(rectype(x=Ind, c=dog(this.x))))
        {c = s1, x = fido}
        """
        _, T = _closed((), T)
        return tuple(witnesses(self._facts, T))

    def true(self, proposition: object, /) -> Degree:
        """How certain it is that a proposition is true.

        A type is true if something is of it: certainly if something is known to be, not
        if nothing is and nobody could say otherwise. An Austinian proposition
        {sit = s, sit_type = T} is true as far as s is of T.

        >>> from ttr.syntax import Ind
        >>> M = Model().given("s1", Pred("dog", Ind)("fido"))
        >>> print(M.true(Pred("dog", Ind)("fido")), M.true(Pred("dog", Ind)("sam")))
        1 0
        """
        if not isinstance(proposition, TypeNode):
            return self.judge(*claim(freeze(proposition))).p
        _, T = _closed((), proposition)
        try:
            known = any(True for _ in witnesses(self._facts, T))
            surely = known or not self._facts.leaves_open(T)
        except Unsupported:
            known = surely = self._has_unlisted(T)
        if known:
            return CERTAIN
        return REFUTED if surely else UNKNOWN

    def _has_unlisted(self, T: TypeNode) -> bool:
        """Whether something is of a type whose witnesses have no end, by what is known.

        It may be an empty list, or made of known objects.
        """
        if isinstance(T, NonEmpty | Plus):
            return self.true(T.item) == CERTAIN
        try:
            sit, _ = created(self._facts, T)
        except Refused:
            return False
        return derivation(self._facts, sit, T).p == CERTAIN

    def _with(self, facts: Assignment) -> Model:
        """The model of these facts: the same model where they are the same."""
        return self if facts is self._facts else Model.of(facts)


def _signature(theory: Signature | _HasSignature | None) -> Signature:
    if theory is None:
        return Signature()
    signature = getattr(theory, "signature", theory)
    if not isinstance(signature, Signature):
        raise TTRError(f"a model is of a theory, found {theory!r}")
    return signature


def _closed(sit: object, T: object) -> tuple[Object, TypeNode]:
    """The object and the type, if no path leads out of either."""
    sit, kind = freeze(sit), as_type(T)
    for value in (sit, kind):
        if escaping(value):
            raise IllFormed(
                f"{notation(value)} has paths that lead nowhere, so nothing is judged"
            )
    return sit, kind
