"""The abstract syntax: types, predicates and record types, as immutable values.

Nodes are interned: two nodes of the same structure are the same Python object, so that
`is` is structural identity, a hash is an address and a type can be a key. The classes
with capital letters only hold data, to be matched on; types are built with `rectype`,
`meet`, `join`, `fun`, `Pi`, `Pred.__call__` and the operators, which normalise and
refuse the ill-formed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import TYPE_CHECKING, NoReturn

from ttr.errors import IllFormedError
from ttr.hooks import hook
from ttr.safety.budgets import within_budget
from ttr.types.interning import Node, identity, node
from ttr.types.objects import (
    Applied,
    Object,
    Operation,
    Path,
    Record,
    TermAsType,
    WrittenPath,
    check_label,
    concat,
    freeze,
    sort_canonically,
)


@hook
def is_subtype(S: TypeNode, T: TypeNode, /) -> bool:
    """S ⊑ T: `ttr.computing.subtyping.subtype`."""
    raise NotImplementedError


@hook
def as_function_type(domain: TypeNode, result: TypeNode, /) -> TypeNode:
    """(S → T): `ttr.types.derived_types.function_type`."""
    raise NotImplementedError


class TypeNode(Node):
    r"""A type, with the signs of the notation as operators.

    `S & T` is the meet, `S | T` the join, `~T` the negation, `S >> T` the type of
    functions from S to T, `T @ a` a singleton; `S <= T` asks for subtyping.

    >>> from ttr import Ind, Pred
    >>> dog, brown = Pred("dog", Ind), Pred("brown", Ind)
    >>> print(dog("fido") & brown("fido"), "or", ~dog("fido"))
    brown(fido) /\ dog(fido) or ~dog(fido)
    >>> dog("fido") & brown("fido") <= dog("fido")
    True
    """

    __slots__ = ()

    def __le__(self, other: object) -> bool:
        return is_subtype(self, as_type(other))

    def __ge__(self, other: object) -> bool:
        return as_type(other) <= self

    def __and__(self, other: object) -> TypeNode:
        return meet(self, as_type(other))

    def __or__(self, other: object) -> TypeNode:
        return join(self, as_type(other))

    def __invert__(self) -> TypeNode:
        return Negation(self)

    def __rshift__(self, other: object) -> TypeNode:
        return as_function_type(self, as_type(other))

    def __matmul__(self, value: object) -> TypeNode:
        return Singleton(self, freeze(value))


def as_type(value: object) -> TypeNode:
    """The value, if it is a type; else `IllFormedError` says what it is.

    A path stands for the type that it leads to, and so does the first of a list.
    """
    if isinstance(value, TypeNode):
        return value
    if isinstance(value, WrittenPath | Path) or _is_first(value):
        return TypeAt(value)
    raise _not_a_type(value)


def _is_first(value: object) -> bool:
    return isinstance(value, Operation) and value.name == "fst"


def _not_a_type(found: object) -> IllFormedError:
    return IllFormedError(f"expected a type, found {kind_of(found)}")


def kind_of(value: object) -> str:
    """A short description of a value, for an error message."""
    match value:
        case Pred():
            domain = ", ".join(map(str, value.arities[0]))
            return f"the predicate {value.name}: apply it to objects of ({domain})"
        case Record():
            return f"the record {value}"
        case Function():
            return f"the function {value}"
        case WrittenPath() | Path() | Operation():
            return f"the object {value}"
        case str():
            return f"the object {value!r}"
        case TypeNode():
            return f"the type {value}"
        case type():
            return f"the class {value.__name__}"
        case None:
            return "None"
    return f"{type(value).__name__} {value!r}"


@node
class Basic(TypeNode):
    """A basic type: a name, and whatever a model judges to be of it.

    >>> from ttr import Model
    >>> Topic = Basic("Topic")
    >>> Model().given("rain", Topic).judge("rain", Topic).holds
    True
    """

    name: str

    @staticmethod
    def _normal(name: str) -> tuple[str]:
        if not isinstance(name, str) or not name:
            raise IllFormedError(
                f"a basic type is named by a string, found {kind_of(name)}"
            )
        return (str(name),)


@node
class Universe(TypeNode):
    """Typeⁿ, RecTypeⁿ: the types of level n at most, and the record types among them.

    A type is of level 0 if it mentions no type of types, and of level n + 1 if the
    highest that it mentions is of level n. So Type itself is of Type^1, not of Type.

    >>> from ttr import Model, Rec, Type
    >>> print(Universe("RecType", 1))
    RecType^1
    >>> Model().judge(Rec, Type).holds, Model().judge(Type, Type).holds
    (True, False)
    >>> Model().judge(Type, Universe("Type", 1)).holds
    True
    """

    name: str
    level: int = 0

    @staticmethod
    def _normal(name: str, level: int = 0) -> tuple[str, int]:
        if not isinstance(name, str) or name not in ("Type", "RecType"):
            raise IllFormedError(
                f"a type of types is Type or RecType, found {kind_of(name)}"
            )
        if type(level) is not int or level < 0:
            raise IllFormedError(f"a level of types is 0 or more, found {level!r}")
        return name, level


@node
class PType(TypeNode):
    """p(a₁, …, aₙ): the type of the situations that make a predication true.

    >>> from ttr import Pred
    >>> T = Pred("hug", Ind, Ind)("sam", "fido")
    >>> print(T, "is of", T.pred, "and", ", ".join(T.args))
    hug(sam, fido) is of hug and sam, fido
    """

    pred: Pred
    args: tuple[Object, ...]

    @staticmethod
    def _normal(pred: Pred, args: object) -> tuple[object, ...]:
        if not isinstance(pred, Pred):
            raise IllFormedError(f"a ptype is of a predicate, found {kind_of(pred)}")
        if not isinstance(args, tuple | list):
            raise IllFormedError(
                f"the arguments of {pred} are a tuple, found {kind_of(args)}"
            )
        frozen = tuple(map(freeze, args))
        for arity in pred.arities:
            if len(arity) == len(frozen):
                return pred, frozen
        raise IllFormedError(_wrong_arity(pred, len(frozen)))


def _wrong_arity(pred: Pred, found: int) -> str:
    wanted = " or ".join(
        f"{len(arity)} argument{'s' * (len(arity) != 1)} ({', '.join(map(str, arity))})"
        for arity in pred.arities
    )
    return f"{pred.name} takes {wanted}, but has {found}"


@node
class Singleton(TypeNode):
    """T@a, T restricted to a: b is of it iff b is of T and b is a.

    >>> from ttr import Model
    >>> M = Model().given("fido", Ind).given("rex", Ind)
    >>> [M.judge(it, Singleton(Ind, "fido")).holds for it in ("fido", "rex")]
    [True, False]
    """

    base: TypeNode
    value: Object

    @staticmethod
    def _normal(base: TypeNode, value: object) -> tuple[object, ...]:
        return as_type(base), freeze(value)

    @staticmethod
    def _key(base: TypeNode, value: Object) -> tuple[object, ...]:
        return base, identity(value)


@node
class Meet(TypeNode):
    """S ∧ T: a is of it iff a is of every part. Built by `meet`.

    >>> from ttr import Pred
    >>> T = Pred("dog", Ind)("fido") & Pred("brown", Ind)("fido")
    >>> isinstance(T, Meet), [str(it) for it in T.parts]
    (True, ['brown(fido)', 'dog(fido)'])
    """

    parts: tuple[TypeNode, ...]

    @staticmethod
    def _key(parts: tuple[TypeNode, ...]) -> tuple[object, ...]:
        return (frozenset(parts),)


@node
class Merge(Meet):
    r"""S ∧̣ T where a part is not known yet, such as the value of a variable function.

    It is the meet of its parts but for its form: as soon as they are known they are
    merged label by label. Built by `merge_terms`.

    >>> from ttr import Type, fun, rectype, this
    >>> from ttr.types import merge_terms
    >>> f = fun(T=Type)(merge_terms(this.T, rectype(x=Ind)))
    >>> print(f)
    \T:Type. merge(T, [x : Ind])
    >>> type(f.body) is Merge
    True
    """

    parts: tuple[TypeNode, ...]
    _sign = "merge"


@node
class Join(TypeNode):
    """S ∨ T: a is of it iff a is of one of the parts. Built by `join`.

    >>> from ttr import Pred
    >>> T = Pred("dog", Ind)("fido") | Pred("cat", Ind)("fido")
    >>> isinstance(T, Join), [str(it) for it in T.parts]
    (True, ['cat(fido)', 'dog(fido)'])
    """

    parts: tuple[TypeNode, ...]

    @staticmethod
    def _key(parts: tuple[TypeNode, ...]) -> tuple[object, ...]:
        return (frozenset(parts),)


@node
class Negation(TypeNode):
    """¬T: a is of it iff a is not of T.

    >>> from ttr import Pred
    >>> T = ~Pred("dog", Ind)("fido")
    >>> print(T, "denies", T.body)
    ~dog(fido) denies dog(fido)
    """

    body: TypeNode
    _sign = "~"

    @staticmethod
    def _normal(body: TypeNode) -> tuple[object, ...]:
        return (as_type(body),)


# --- collections and strings ---------------------------------------------------------


class _Of(TypeNode):
    """A type of things that are made of objects of one type."""

    __slots__ = ()

    @staticmethod
    def _normal(item: TypeNode) -> tuple[object, ...]:
        return (as_type(item),)


@node
class ListOf(_Of):
    """list(T): the type of the finite lists of objects of T.

    >>> from ttr import Model
    >>> M = Model().given("fido", Ind).given("rex", Ind)
    >>> M.judge(("fido", "rex", "fido"), ListOf(Ind)).holds
    True
    """

    item: TypeNode
    _sign = "list"


@node
class NonEmpty(_Of):
    """nelist(T): the lists of objects of T that have a first element and a rest.

    >>> from ttr import Model
    >>> M = Model().given("fido", Ind)
    >>> M.judge(("fido",), NonEmpty(Ind)).holds, M.judge((), NonEmpty(Ind)).holds
    (True, False)
    """

    item: TypeNode
    _sign = "nelist"


@node
class SetOf(_Of):
    """set(T): the type of the finite sets of objects of T.

    >>> from ttr import Model
    >>> M = Model().given("fido", Ind).given("rex", Ind)
    >>> M.judge({"fido", "rex"}, SetOf(Ind)).holds
    True
    """

    item: TypeNode
    _sign = "set"


@node
class Plus(_Of):
    """plus(T), T⁺: the strings that are one or more strings or events of T in a row.

    >>> Step = Basic("Step")
    >>> Str(Step, Step, Step) <= Plus(Step)
    True
    >>> Plus(Step) <= Str(Step, Step, Step)
    False
    """

    item: TypeNode
    _sign = "plus"


@node
class Str(TypeNode):
    """str(T₁, …, Tₙ): the strings of n pieces, the first of T₁ and so on.

    A piece is an event of Tᵢ; where by its form Tᵢ is a type of strings, it is a string
    of Tᵢ. So concatenation is associative, and written in one way only: str(str(R, S),
    T) is str(R, S, T).

    >>> A, B, C = Basic("A"), Basic("B"), Basic("C")
    >>> Str(Str(A, B), C) is Str(A, Str(B, C)) is Str(A, B, Str(), C)
    True
    """

    items: tuple[TypeNode, ...]
    _sign = "str"

    if TYPE_CHECKING:

        def __init__(self, *items: object) -> None: ...

    @staticmethod
    def _normal(*items: object) -> tuple[object, ...]:
        pieces: list[TypeNode] = []
        for item in map(as_type, items):
            pieces += item.items if isinstance(item, Str) else (item,)
        return (tuple(pieces),)

    def __reduce__(self) -> tuple[object, ...]:
        return Str, self.items


# --- functions -----------------------------------------------------------------------


class _Binder(Node):
    """Something with a bound variable of a domain, which has no name.

    Inside, the variable is the path `BOUND`. A name that is given is checked and
    forgotten; what is printed for a variable is up to `ttr.types.printing.variable`.
    """

    __slots__ = ()

    @staticmethod
    def _key(domain: TypeNode, inside: object) -> tuple[object, ...]:
        return domain, identity(inside)


@node
class FunType(_Binder, TypeNode):
    """((x : S) → T), the functions that take each x of S to an object of T.

    Where T does not mention x it is written (S → T). Built by `S >> T` and `Pi`.

    >>> from ttr import Pi, Pred, this
    >>> T = Pi(x=Ind)(Pred("run", Ind)(this.x))
    >>> print(T, "from", T.domain)
    ((x : Ind) -> run(x)) from Ind
    """

    domain: TypeNode
    result: TypeNode
    _sign = "("

    @staticmethod
    def _normal(
        domain: TypeNode, result: TypeNode, name: str = "x"
    ) -> tuple[object, ...]:
        check_label(name)
        return as_type(domain), as_type(result)


@node
class Function(_Binder):
    r"""λx:S. body, the function that takes each x of S to the body. Built by `fun`.

    >>> from ttr import Model, Pred, fun, this
    >>> run = fun(x=Ind)(Pred("run", Ind)(this.x))
    >>> print(run, "from", run.domain)
    \x:Ind. run(x) from Ind
    >>> print(Model().given("fido", Ind).apply(run, "fido"))
    run(fido)
    """

    domain: TypeNode
    body: Object
    _sign = "\\"

    @staticmethod
    def _normal(domain: TypeNode, body: object, name: str = "x") -> tuple[object, ...]:
        check_label(name)
        return as_type(domain), freeze(body)

    def __call__(self, *args: object) -> Application:
        """The application of the function, as written; `Model.apply` works it out."""
        return apply_to(self, *args)


@node
class Application(Applied, TypeNode):
    r"""f(a): the value of a function for an argument, a type or any other object.

    >>> from ttr import Model, Pred, fun, this
    >>> run = fun(x=Ind)(Pred("run", Ind)(this.x))
    >>> term = run("fido")
    >>> print(term, "=", Model().given("fido", Ind).reduce(term))
    (\x:Ind. run(x))(fido) = run(fido)
    """

    function: Object
    argument: Object

    @staticmethod
    def _normal(function: object, argument: object) -> tuple[object, ...]:
        return freeze(function), freeze(argument)

    def __call__(self, *args: object) -> Application:
        """The result, a function, applied to another argument: f(a)(b)."""
        return apply_to(self, *args)

    def __add__(self, other: object) -> Object:
        return concat(self, other)


def apply_to(function: object, *args: object) -> Application:
    """f(a), or f(a)(b) and so on where there are more arguments."""
    if not args:
        raise IllFormedError(f"a function is applied to an argument: {function}(…)")
    for arg in args:
        function = Application(function, arg)
    return function  # type: ignore[return-value]


@node
class TypeAt(TermAsType, TypeNode):
    """The type that a term stands for, such as the x : T in [T : Type, x : T].

    Built where a type is needed and a path is given. As an object it is the path.

    >>> from ttr import Type, rectype, this
    >>> T = rectype(T=Type, x=this.T)
    >>> print(T)
    [T : Type, x : T]
    >>> type(T["x"]) is TypeAt
    True
    """

    term: Object

    @staticmethod
    def _normal(term: object) -> tuple[object, ...]:
        return (freeze(term),)


def type_at(term: Object) -> TypeNode:
    """What a term stands for where a type is needed: a type for itself.

    >>> type_at(Ind) is Ind
    True
    """
    return term if isinstance(term, TypeNode) else TypeAt(term)


# --- records and predicates ----------------------------------------------------------


@node
class RecordType(TypeNode):
    """[ℓ₁ : T₁, …]: r is of it iff each r.ℓᵢ is of Tᵢ. Built by `rectype`.

    Paths in a field's type start in the record where the field stands.

    >>> T = RecordType((("x", Ind),))
    >>> T["x"] == Ind
    True
    """

    fields: tuple[tuple[str, TypeNode], ...]
    _sign = "["
    _types: Mapping[str, TypeNode] = field(init=False)

    @staticmethod
    def _key(fields: tuple[tuple[str, TypeNode], ...]) -> tuple[object, ...]:
        return (fields,) if type(fields) is tuple else (identity(fields),)

    def __post_init__(self) -> None:
        try:
            types = dict(self.fields if isinstance(self.fields, tuple) else (None,))
        except (TypeError, ValueError):
            raise IllFormedError(
                "RecordType holds pairs of a label and a type: build it with rectype"
            ) from None
        object.__setattr__(self, "_types", types)

    def __getitem__(self, label: str) -> TypeNode:
        """The type of the field with this label; raises `KeyError` if there is none.

        >>> RecordType((("x", Ind),))["x"]
        Basic('Ind')
        """
        return self._types[label]

    def get(self, label: str) -> TypeNode | None:
        """The type of the field with this label, or None if there is none."""
        return self._types.get(label)

    def __contains__(self, label: object) -> bool:
        return label in self._types

    def __iter__(self) -> Iterator[str]:
        return iter(self._types)

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels, dependencies first."""
        return tuple(self._types)


@node
class Pred(Node):
    """A predicate: a name and one or more arities, each a tuple of types.

    >>> Pred("hug", Ind, Ind)("a", "b")
    Pred('hug', Basic('Ind'), Basic('Ind'))('a', 'b')
    >>> Pred("open", (Ind,), (Ind, Ind)).arities[1]
    (Basic('Ind'), Basic('Ind'))
    """

    name: str
    arities: tuple[tuple[TypeNode, ...], ...]

    if TYPE_CHECKING:

        def __init__(self, name: str, *arities: object) -> None: ...

    @staticmethod
    def _normal(name: str, *arities: object) -> tuple[object, ...]:
        if not isinstance(name, str) or not name.isidentifier():
            raise IllFormedError(
                f"a predicate is named by an identifier, found {name!r}"
            )
        several = [arity for arity in arities if isinstance(arity, tuple)]
        if not several or len(several) < len(arities):
            several = [arities]
        found = {tuple(map(as_type, arity)): None for arity in several}
        return str(name), tuple(sorted(sort_canonically(found), key=len))

    @staticmethod
    def _key(
        name: str, arities: tuple[tuple[TypeNode, ...], ...]
    ) -> tuple[object, ...]:
        return name, frozenset(arities)

    def __call__(self, *args: object) -> PType:
        """The ptype of situations in which the predicate holds of these objects."""
        return PType(self, args)

    def _refuse(self, *_: object) -> NoReturn:
        """Refuse a predicate as an operand: the operators are for types."""
        raise _not_a_type(self)

    __and__ = __or__ = __invert__ = __rshift__ = __matmul__ = _refuse
    __le__ = __ge__ = _refuse

    def __reduce__(self) -> tuple[object, ...]:
        return Pred, (self.name, *self.arities)


# --- meets and joins -----------------------------------------------------------------


@within_budget
def meet(*parts: TypeNode) -> TypeNode:
    """The meet S ∧ T: flat, each part once, in one order whatever the order of writing.

    >>> A, B = Basic("A"), Basic("B")
    >>> meet(B, A) is meet(A, meet(A, B)), meet(A, A) is A
    (True, True)
    """
    flat = _flat_parts(Meet, parts)
    if not flat:
        raise IllFormedError("a meet needs at least one type")
    return flat[0] if len(flat) == 1 else Meet(flat)


@within_budget
def join(*parts: TypeNode) -> TypeNode:
    """The join S ∨ T: flat, each part once, in one order whatever the order of writing.

    >>> A, B = Basic("A"), Basic("B")
    >>> print(join(B, A, B))
    A \\/ B
    """
    flat = _flat_parts(Join, parts)
    if not flat:
        raise IllFormedError("a join needs at least one type")
    return flat[0] if len(flat) == 1 else Join(flat)


def _flat_parts(
    kind: type[Meet] | type[Join], parts: tuple[TypeNode, ...]
) -> tuple[TypeNode, ...]:
    """The parts without those of the same kind around them, each once, in order."""
    once: dict[TypeNode, None] = {}
    for part in map(as_type, parts):
        inner = part.parts if type(part) is kind else (part,)
        once.update(dict.fromkeys(inner))
    return tuple(once) if len(once) < 2 else tuple(sort_canonically(once))


Ind = Basic("Ind")
"""The basic type of individuals.

>>> from ttr import Ind, Model
>>> Model().given("fido", Ind).judge("fido", Ind).holds
True
"""

Type = Universe("Type")
"""The type of all types of level 0, those that mention neither Type nor RecType.

>>> from ttr import Ind, Model, RecType, Type
>>> Model().judge(Ind, Type).holds, Model().judge(RecType, Type).holds
(True, False)
"""

RecType = Universe("RecType")
"""The type of all record types of level 0.

>>> from ttr import Ind, Model, RecType, rectype
>>> Model().judge(rectype(x=Ind), RecType).holds, Model().judge(Ind, RecType).holds
(True, False)
"""

Rec = RecordType(())
"""The record type without fields: every record is of it.

>>> from ttr import Ind, Rec, rectype
>>> rectype(x=Ind) <= Rec
True
"""
