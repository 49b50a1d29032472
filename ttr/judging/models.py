"""Models: an assignment of witnesses to types, immutable and cheap to extend.

A model answers three questions. `judge` checks what is there; `perceive` also fills the
fields whose predicates have witness functions; `create` makes a new witness. None of
them changes the model: they give a new one with what was added.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import replace
from typing import Any, Protocol, TypeAlias, cast

from ttr.aliases import Alias
from ttr.computing.normalisation import normal_type, normal_value
from ttr.computing.subtyping import consistent
from ttr.errors import (
    IllFormedError,
    RefusedError,
    TooLargeError,
    TTRError,
    UnsupportedError,
)
from ttr.judging.assignments import Assignment, WitnessFunction
from ttr.judging.conditioning import (
    derive_conditional,
    table_rows,
    with_conditional_fact,
    with_expectation,
    with_unknown_dependence,
)
from ttr.judging.creation import create_witness, with_judgement
from ttr.judging.dependence_analysis import check_together
from ttr.judging.evaluator import derivation, reduce_applications, reduce_atom
from ttr.judging.judgements import Judgement, Why
from ttr.judging.perception import fill_fields
from ttr.judging.propositions import borne_out, claim, probabilistic_claim
from ttr.judging.truth_of_types import Range, probability_of_any, probability_of_some
from ttr.judging.witnesses import can_be_listed, some_witnesses, witnesses
from ttr.persistent_maps import Map
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree, degree
from ttr.safety.budgets import (
    SharedPurse,
    one_of_several,
    purse_of_several,
    within_budget,
)
from ttr.showing import (
    ROWS,
    Fold,
    NotebookValue,
    Part,
    Text,
    Value,
    below,
    count_of,
    name_list,
    table,
)
from ttr.signature.signature import Expected, Given, Signature
from ttr.types.interning import identity
from ttr.types.objects import Object, Record, freeze
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    NonEmpty,
    Plus,
    Pred,
    PType,
    TypeNode,
    as_type,
    kind_of,
)

Conditions: TypeAlias = Iterable[tuple[object, TypeNode]]
"""Judgements: an object and a type each."""

Types: TypeAlias = TypeNode | Sequence[TypeNode]
"""A type, or several."""

Table: TypeAlias = Mapping[tuple[bool, ...], object]
"""A probability for each case."""


def _judged_unknown(
    error: TooLargeError, model: Model, sit: object, T: TypeNode, /, **_: object
) -> Judgement:
    """The judgement where the budget is spent: its probability is unknown."""
    sit = _freeze_value(sit)
    return Judgement(sit, T, UNKNOWN, Why(sit, T, UNKNOWN, error.message), model)


@within_budget
def _freeze_value(value: object) -> Object:
    """The value as an object; raises where it has more parts than the budget."""
    return freeze(value)


def _truth_unknown(error: TooLargeError, *_: object, **__: object) -> Degree:
    """The degree where the budget is spent."""
    return UNKNOWN


def _range_unknown(
    error: TooLargeError, model: Model, T: TypeNode, /, *, when: Types, **_: object
) -> Range:
    """The range where the budget is spent."""
    types = cast(Sequence[TypeNode], when if isinstance(when, tuple | list) else [when])
    return Range(T, tuple(types), UNKNOWN, ())


class _HasSignature(Protocol):
    @property
    def signature(self) -> Signature: ...


class Model(NotebookValue):
    """Which objects are judged to be of which types, under a theory.

    An unlisted judgement is refuted, unless its type is open: the theory says so, or it
    has a witness function, or a judgement of it was given with a degree between.

    >>> from ttr import Ind, record, rectype, this
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
        self._facts = _with_givens(self, signature.givens)._facts

    @classmethod
    def of(cls, facts: Assignment) -> Model:
        """The model of these facts."""
        model = object.__new__(cls)
        model._facts = facts
        return model

    @property
    def facts(self) -> Assignment:
        """The judgements of atoms: the assignment that all others follow from."""
        return self._facts

    @property
    def theory(self) -> Signature:
        """The axioms, open types and first judgements of the model."""
        return self._facts.theory

    @within_budget
    def given(
        self, sit: object, T: TypeNode, /, p: object = 1.0, *, when: Conditions = ()
    ) -> Model:
        """The model in which also sit : T, with a probability or an interval.

        Records, meets, singletons and lists are taken apart into their atoms, for which
        the probability must be 1. With `when` it is p(sit : T | b : S, …), what it is
        if these are so; the conditions are of basic types and ptypes or their
        negations. What is given later takes the place of an earlier degree of the same
        judgement; in a theory that is an error. Raises `RefusedError` where a witness
        function says no or what is given cannot be, and `IllFormedError` where a path
        leads nowhere.

        >>> A, B = Basic("A"), Basic("B")
        >>> M = Model().given("a", A, 0.6).given("a", B, (0.7, 0.8), when=[("a", A)])
        >>> print(M.judge("a", A).p, M.judge("a", A & B).p)
        0.6 [0.42, 0.48]
        """
        sit, T = self._normalise(*_check_closed(sit, T))
        p = _degree_of(f"{notation(sit)} : {T}", p)
        pairs = conditions(when)
        if isinstance(T, Basic | PType):
            T = reduce_atom(self._facts, T)
        if pairs:
            return self._with(with_conditional_fact(self._facts, sit, T, p, pairs))
        if isinstance(T, Basic | PType):
            facts = self._facts.with_fact(sit, T, p)
            if facts.links or p not in (CERTAIN, REFUTED):
                check_together(facts, sit, T)
            return self._with(facts)
        if p != CERTAIN:
            raise UnsupportedError(
                f"only basic types and ptypes take a degree, but {T} was given {p}"
            )
        facts = with_judgement(self._facts, sit, T)
        why = derivation(facts, sit, T)
        if why.p == REFUTED:
            raise RefusedError(
                f"{notation(sit)} : {T} cannot be given: it denies what it says"
            )
        return self._with(facts)

    def _normalise(self, sit: Object, T: TypeNode) -> tuple[Object, TypeNode]:
        """The object and the type as what they compute to in the theory."""
        theory = self._facts.theory
        if isinstance(sit, TypeNode | Function):
            sit = normal_value(sit, theory)
        return sit, normal_type(T, theory)

    def with_conditional(self, T: TypeNode, /, p: object, *, when: Types) -> Model:
        """The model in which p(T || S, …) is p, for every object of the conditions S.

        What was given of a particular object goes before it.

        >>> Flu, Ill = Basic("Flu"), Basic("Ill")
        >>> M = Model().with_conditional(Ill, 0.6, when=Flu).given("kim", Flu)
        >>> print(M.judge("kim", Ill).p)
        0.6
        """
        types = when if isinstance(when, tuple | list) else (when,)
        _, T = _check_closed((), T)
        of = [_check_closed((), S)[1] for S in types]
        degree = _degree_of(f"p({T} || {', '.join(map(str, of))})", p)
        return self._with(with_expectation(self._facts, T, degree, of))

    def with_table(self, T: object, /, on: Sequence[object], rows: Table) -> Model:
        """The model with a table of conditional probabilities for T.

        `on` lists what T depends on, and `rows` gives p(T) for each case of whether
        these hold. They are types, for a table about every object, or pairs of an
        object and a type. Raises `TTRError` where a row is missing.

        >>> Rain, Wet = Basic("Rain"), Basic("Wet")
        >>> M = Model().given("now", Rain, 0.2)
        >>> M = M.with_table(Wet, on=[Rain], rows={(True,): 0.9, (False,): 0.1})
        >>> print(M.judge("now", Wet).p, M.judge("now", Rain, when=[("now", Wet)]).p)
        0.26 0.6923
        """
        model = self
        on = _list_of("what a table depends on", on)
        for case, p in table_rows(on, rows):
            literals = [_literal(one, so) for one, so in zip(on, case, strict=True)]
            if isinstance(T, TypeNode):
                model = model.with_conditional(T, p, when=literals)
            else:
                sit, kind = conditions([T])[0]
                model = model.given(sit, kind, p, when=literals)
        return model

    def with_unknown_dependence(self, *claims: tuple[object, TypeNode]) -> Model:
        """The model in which it is unknown how these judgements depend on one another.

        What rests on several of them has the bounds that hold for any dependence.

        >>> A, B = Basic("A"), Basic("B")
        >>> M = Model().given("a", A, 0.7).given("a", B, 0.8)
        >>> print(M.judge("a", A & B).p)
        0.56
        >>> print(M.with_unknown_dependence(("a", A), ("a", B)).judge("a", A & B).p)
        [0.5, 0.7]
        """
        return self._with(with_unknown_dependence(self._facts, conditions(claims)))

    def with_given(self, given: Given | Expected, /) -> Model:
        """The model in which also a `given` of a theory holds."""
        if isinstance(given, Expected):
            return self.with_conditional(given.type, given.p, when=given.when)
        if not isinstance(given, Given):
            raise TTRError(f"what a theory starts from is a Given, found {given!r}")
        return self.given(given.sit, given.type, given.p, when=given.when)

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

    def under(self, theory: Signature | _HasSignature, /) -> Model:
        """The model of the same judgements under another theory, with its axioms.

        What that theory gives and opens is not added.

        >>> from ttr import Ind, this
        >>> from ttr.signature.signature import Axiom
        >>> mug, cup = Pred("mug", Ind), Pred("cup", Ind)
        >>> M = Model().given("o1", Ind).given("s1", mug("o1"))
        >>> M.judge("s1", cup("o1")).holds
        False
        >>> M.under(Signature((Axiom(mug(this.x), cup(this.x)),))).judge(
        ...     "s1", cup("o1")
        ... ).holds
        True
        """
        return self._with(self._facts.under(_signature(theory)))

    @within_budget(otherwise=_judged_unknown)
    def judge(self, sit: object, T: TypeNode, /, *, when: Conditions = ()) -> Judgement:
        """Is sit of T? What is there is checked; nothing is filled in.

        With `when` the probability is p(sit : T | b : S, …), given that these are so,
        whatever types they are of. Raises `IllFormedError` where T is no type, or has a
        path that leads nowhere, and `RefusedError` where the conditions cannot be.

        >>> A, B = Basic("A"), Basic("B")
        >>> M = Model().given("a", A, 0.6).given("a", B, 0.5)
        >>> print(M.judge("a", A, when=[("b", A)]).p)
        0.6
        >>> print(M.judge("a", A, when=[("a", A | B)]).p)
        0.75
        """
        sit, T = _check_closed(sit, T)
        pairs = conditions(when)
        computed = self._normalise(sit, T)
        why = (
            derive_conditional(self._facts, *computed, pairs)
            if pairs
            else derivation(self._facts, *computed)
        )
        return Judgement(sit, T, why.p, why, self)

    @within_budget(otherwise=_judged_unknown)
    def perceive(self, sit: object, T: TypeNode, /) -> Judgement:
        """Judge sit : T after filling the missing fields that can be perceived.

        A missing field whose ptype's predicate has a witness function gets a new
        situation, which is of the ptype with the degree that the function gives.

        >>> from ttr import Ind, record, rectype, this
        >>> cup = Pred("cup", Ind)
        >>> M = Model().given("o1", Ind).witnessed(cup, by=lambda x: 0.75)
        >>> j = M.perceive(record(x="o1"), rectype(x=Ind, c=cup(this.x)))
        >>> print(j)
        {c = e1, x = o1} : [x : Ind, c : cup(x)]   p = 0.75
        """
        sit, T = self._normalise(*_check_closed(sit, T))
        if not isinstance(sit, Record):
            return self.judge(sit, T)
        seen, facts = fill_fields(self._facts, sit, T)
        return self._with(facts).judge(seen, T)

    @within_budget
    def create(self, T: TypeNode, /) -> tuple[Object, Model]:
        """A new witness of T, and the model that has it; `RefusedError` if there is
        none.

        >>> from ttr import Ind
        >>> a, M = Model().create(Ind)
        >>> a, M.judge(a, Ind).holds
        ('a1', True)
        """
        _, T = self._normalise(*_check_closed((), T))
        witness, facts = create_witness(self._facts, T)
        return witness, self._with(facts)

    @within_budget
    def apply(self, function: object, argument: object, /) -> Object:
        """f(a): the body of the function for the argument.

        Raises `RefusedError` where the argument is not certainly of the function's
        domain.

        >>> from ttr import Ind, fun, this
        >>> run = fun(x=Ind)(Pred("run", Ind)(this.x))
        >>> print(Model().given("j", Ind).apply(run, "j"))
        run(j)
        >>> Model().apply(run, "zz")
        Traceback (most recent call last):
        ttr...RefusedError: \\x:Ind. run(x) takes objects of Ind, which zz is not: ...
        """
        return self.reduce(Application(function, argument))

    @within_budget
    def reduce(self, value: object, /) -> Object:
        """The type or object with every application in it reduced."""
        return reduce_applications(self._facts, freeze(value))

    @within_budget
    def witnesses(self, T: TypeNode, /) -> tuple[Object, ...]:
        """The known objects that are certainly of T, in the order of the facts.

        For a record type they are all its records of known objects. Raises
        `UnsupportedError` for a type that may have infinitely many, such as lists.

        >>> from ttr import Ind, rectype, this
        >>> dog = Pred("dog", Ind)
        >>> M = Model().given("fido", Ind).given("sam", Ind).given("s1", dog("fido"))
        >>> print(*M.witnesses(rectype(x=Ind, c=dog(this.x))))
        {c = s1, x = fido}
        """
        _, T = self._normalise(*_check_closed((), T))
        return tuple(witnesses(self._facts, T))

    @within_budget(otherwise=_truth_unknown)
    def true(
        self,
        proposition: object,
        /,
        *,
        when: TypeNode | None = None,
        among: Iterable[object] | None = None,
    ) -> Degree:
        """How certain it is that a proposition is true.

        A type is true if something is of it. That is as certain as that one of the
        known objects is, and refuted if none is and the type is not open. With `when`
        it is p(T | S), given that something is of S; `among` lists the objects that
        exist. An Austinian proposition {sit = s, sit_type = T} is as true as s : T is;
        with a `prob`, it is true if p(s : T) is the probability that it states.

        >>> from ttr import Ind
        >>> M = Model().given("s1", Pred("dog", Ind)("fido"))
        >>> print(M.true(Pred("dog", Ind)("fido")), M.true(Pred("dog", Ind)("sam")))
        1 0
        >>> M = Model().given("a", Basic("A"), 0.3).given("b", Basic("A"), 0.4)
        >>> print(M.true(Basic("A")), M.true(Basic("A"), among=["a", "b"]))
        [0.58, 1] 0.58
        """
        if not isinstance(proposition, TypeNode):
            return self._truth_of_proposition(freeze(proposition))
        _, T = _check_closed((), proposition)
        given = None if when is None else _check_closed((), when)[1]
        objects = None if among is None else _objects(among)
        if objects is None and not can_be_listed(T):
            if self._has_unlisted_witness(T):
                return CERTAIN
            if consistent(T, theory=self.theory).no:
                return REFUTED
        try:
            return probability_of_some(self._facts, T, given, objects)
        except UnsupportedError:
            return CERTAIN if self._has_unlisted_witness(T) else UNKNOWN

    @within_budget(otherwise=_range_unknown)
    def chance(
        self,
        T: TypeNode,
        /,
        *,
        when: Types,
        among: Iterable[object] | None = None,
    ) -> Range:
        """p(T || S, …): how probable it is that any one object of S is of T.

        The interval goes from the least to the most probable object: of the known ones
        that may be of S, or of those in `among`.

        >>> Flu, Ill, Old = Basic("Flu"), Basic("Ill"), Basic("Old")
        >>> M = Model().with_conditional(Ill, 0.6, when=[Flu, Old])
        >>> M = M.with_conditional(Ill, 0.3, when=[Flu, ~Old])
        >>> M = M.given("kim", Flu).given("kim", Old).given("sam", Flu)
        >>> print(M.chance(Ill, when=Flu))
        P(Ill || Flu) = [0.3, 0.6]   (2 objects)
          0.3: sam
          0.6: kim
        """
        types = when if isinstance(when, tuple | list) else (when,)
        _, T = _check_closed((), T)
        objects = None if among is None else _objects(among)
        return probability_of_any(
            self._facts, T, [_check_closed((), S)[1] for S in types], objects
        )

    expects = Alias("with_conditional")
    tabled = Alias("with_table")
    dependent = Alias("with_unknown_dependence")
    stated = Alias("with_given")
    reduced = Alias("reduce")

    def _shown_as_(self) -> Part:
        told = self._facts.first_told(ROWS)
        return below(
            Text(f"a model with {count_of(self._facts.facts, 'judgement')}", "quiet"),
            table(
                ("object", "type", "p"),
                told,
                lambda it: (Value(it[0]), Value(it[1]), Text(str(it[2]))),
                count=max(self._facts.facts, len(told)),
            )
            if told
            else None,
            _named("with a witness function:", self._facts.functions),
            _named("open:", self._facts.opened),
        )

    def _truth_of_proposition(self, proposition: Object) -> Degree:
        """How certain it is that an Austinian proposition is true."""
        sit, T = claim(proposition)
        found = self.judge(sit, T).p
        if "prob" not in cast(Record, proposition):
            return found
        return borne_out(probabilistic_claim(proposition)[2], found)

    def _has_unlisted_witness(self, T: TypeNode) -> bool:
        """Is something certainly of a type whose witnesses cannot be listed?

        It may be an empty list, or made of known objects.
        """
        if isinstance(T, NonEmpty | Plus):
            return self.true(T.item) == CERTAIN
        if next(some_witnesses(self._facts, T), None) is not None:
            return True
        try:
            sit, _ = create_witness(self._facts, T)
        except RefusedError:
            return False
        return self._is_certain(sit, T)

    def _is_certain(self, sit: Object, T: TypeNode) -> bool:
        return derivation(self._facts, sit, T).p == CERTAIN

    def _with(self, facts: Assignment) -> Model:
        """The model of these facts: the same model where they are the same."""
        return self if facts is self._facts else Model.of(facts)


def _named(what: str, heads: Iterable[Basic | Pred]) -> Part | None:
    """The names of types and predicates, folded."""
    found = list(heads)
    if not found:
        return None
    return Fold(f"{what} {len(found):,}", name_list([one.name for one in found]))


def as_model(value: object) -> Model:
    """The model itself; `TTRError` for what is none.

    >>> as_model("M")
    Traceback (most recent call last):
    ttr.errors.TTRError: expected a model to judge in, found the object 'M'
    """
    if isinstance(value, Model):
        return value
    raise TTRError(f"expected a model to judge in, found {kind_of(value)}")


def _signature(theory: Signature | _HasSignature | None) -> Signature:
    if theory is None:
        return Signature()
    signature = getattr(theory, "signature", theory)
    if not isinstance(signature, Signature):
        raise TTRError(f"a model is of a theory, found {theory!r}")
    return signature


def _degree_of(what: str, p: object) -> Degree:
    try:
        return degree(p)
    except TTRError as error:
        raise TTRError(f"{what}: {error.message}") from None


def conditions(when: object) -> list[tuple[Object, TypeNode]]:
    """The conditions, each an object and its type."""
    pairs = _list_of("judgements", when)
    if not all(isinstance(pair, tuple) and len(pair) == 2 for pair in pairs):
        raise TTRError(
            "judgements are pairs of an object and a type, [(a, T), …], "
            f"found {notation(freeze(when))}"
        )
    return [_check_closed(*pair) for pair in pairs]  # type: ignore[misc]


def _objects(among: object) -> list[Object]:
    return [freeze(one) for one in _list_of("objects", among)]


def _list_of(what: str, values: object) -> list[object]:
    """The values of a list; `TTRError` for a text or what is no list."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TTRError(f"{what} are given as a list, found {notation(freeze(values))}")
    return list(values)


def _literal(one: object, so: bool) -> Any:
    """A type, or a pair of an object and a type, negated where it does not hold."""
    if isinstance(one, TypeNode):
        return one if so else ~one
    ((sit, T),) = conditions([one])
    return sit, T if so else ~T


def _check_closed(sit: object, T: object) -> tuple[Object, TypeNode]:
    """The object and the type; `IllFormedError` if a path leads out of either."""
    sit, kind = freeze(sit), as_type(T)
    for value in (sit, kind):
        if free_paths(value):
            raise IllFormedError(
                f"{notation(value)} has paths that lead nowhere, so nothing is judged"
            )
    return sit, kind


def model_of(theory: Signature, purse: SharedPurse | None = None) -> Model:
    """The model of the givens alone; an error tells which of them is to blame.

    Raises `RefusedError` where two of them give one judgement different degrees.
    """
    purse = purse or purse_of_several(len(theory.givens))
    return _with_givens(Model(replace(theory, givens=())), theory.givens, purse)


def _with_givens(
    model: Model, givens: Sequence[Given | Expected], purse: SharedPurse | None = None
) -> Model:
    """The model in which all the givens of a theory hold together.

    Within the purse, where there is one. What a theory gives stands side by side: no
    given takes the place of another.
    """
    start = model
    conditionals: dict[object, Given | Expected] = {}
    for number, given in enumerate(givens):
        try:
            with one_of_several(purse) if purse else nullcontext():
                after = model.with_given(given)
            if after.facts.replaced is not model.facts.replaced:
                raise _given_twice(model, after, start, givens[:number])
            other = conditionals.setdefault(_condition_of(given, number), given)
            if other.p != given.p:
                raise _conditional_given_twice(other, given)
        except TTRError as error:
            raise error.at(given.span) if given.span else error from None
        model = after
    return model


def _given_twice(
    model: Model, after: Model, start: Model, before: Sequence[Given | Expected]
) -> RefusedError:
    """The error that a given changes the degree which one of those before it gave."""
    changed = after.facts.replaced
    assert changed is not None
    sit, T = changed.sit, changed.type
    old, new = (one.facts.told_degree(sit, T) for one in (model, after))
    first = None
    for given in before:
        start = start.with_given(given)
        if first is None and start.facts.told_degree(sit, T) == old:
            first = given
    return _contradiction(f"{notation(sit)} : {T}", old, new, first)


def _condition_of(given: Given | Expected, number: int) -> object:
    """What a conditional is about; another for each given that is none."""
    if isinstance(given, Expected):
        return given.type, frozenset(given.when)
    if not given.when:
        return number
    when = frozenset((identity(sit), S) for sit, S in given.when)
    return identity(given.sit), given.type, when


def _conditional_given_twice(
    first: Given | Expected, given: Given | Expected
) -> RefusedError:
    if isinstance(given, Expected):
        of, bar = f"{given.type}", "||"
        when = ", ".join(map(str, given.when))
    else:
        of, bar = f"{notation(given.sit)} : {given.type}", "|"
        when = ", ".join(f"{notation(sit)} : {S}" for sit, S in given.when)
    old, new = degree(first.p, "P"), degree(given.p, "P")
    return _contradiction(f"P({of} {bar} {when})", old, new, first)


def _contradiction(
    what: str, old: object, new: object, first: Given | Expected | None
) -> RefusedError:
    span = first.span if first else None
    where = f" at {span.source}:{span.line}" if span else ""
    return RefusedError(
        f"{what} is given as {old}{where} and as {new} here",
        hint="keep one of the two",
    )
