r"""Normal forms: what types and objects compute to.

Functions are applied wherever the argument is derivably in the domain; paths into
manifest fields lead to what these are set to; fields of written records and the first
and rest of written lists are looked up; merges are done as soon as the form of their
parts is known. Not η.

An application (λx:S. φ)(a) is contracted iff Θ; Γ ⊢ a : S, by the axioms and declared
objects of the theory Θ and by the fields and variables around it, Γ. It is ill-formed
iff nothing can be of S and of the type of a. Else it is *kept* as it is.
Source: Martin-Löf 1984 for equality by computation; Cooper 2023 for what computes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from weakref import WeakKeyDictionary

from ttr.computing.generic_witness import Assumption, GenericWitness
from ttr.computing.path_cycles import find_cycle_of_values
from ttr.computing.prover import Prover
from ttr.errors import IllFormedError
from ttr.safety.budgets import open_purse, spend, within_budget
from ttr.signature.signature import Signature, signature_of
from ttr.types.derived_types import order_fields
from ttr.types.interning import Node, identity
from ttr.types.objects import BOUND, Object, Operation, Path, freeze
from ttr.types.paths import (
    free_paths,
    labels_mentioned,
    map_parts,
    mentions_any,
    replace_paths,
    shift_paths,
    subterms,
)
from ttr.types.printing import Scope, notation, variable
from ttr.types.substitution import field_type, follow_labels, substitute_variable
from ttr.types.syntax import (
    Application,
    Function,
    FunType,
    Ind,
    Meet,
    Merge,
    Pred,
    PType,
    Rec,
    RecordType,
    Singleton,
    TypeAt,
    TypeNode,
    type_at,
)


@within_budget
def normal_form(value: Object, /, theory: Signature | None = None) -> Object:
    r"""What a type or an object computes to.

    Raises `IllFormedError` where the argument of a function cannot be in its domain.

    >>> from ttr import Ind, Pred, fun, outer, rectype, this
    >>> man = Pred("man", Ind)
    >>> Man = fun(v=Ind)(rectype(e=man(outer.v)))
    >>> print(normal_form(rectype(x=Ind, r=Man(this.x))))
    [x : Ind, r : [e : man(x)]]
    >>> print(normal_form(rectype(x=Ind @ "j", c=man(this.x))))
    [c : man(j), x = j : Ind]
    """
    return _Normaliser(signature_of(theory)).of(freeze(value), ())


_REFUSED = frozenset((Application, TypeAt))
"""The kinds of types of which some are ill-formed for what they compute to."""

_COMPUTED = frozenset((*_REFUSED, Merge))
"""The kinds of types that may compute to others."""

_WRITTEN = (TypeNode, Function, Pred)
"""What is no individual, as its form tells."""

_OPEN = (Application, TypeAt)
"""Types of which some stand for objects of any kind."""

_KINDS: dict[type, str] = {Function: "a function", Pred: "a predicate"}
"""What an argument is that is no type."""

_SET = frozenset((Singleton,))
"""The kinds of types that say which object something is."""

_VALUED = _COMPUTED | _SET
"""The kinds of types that compute to others, or by which a path has a value."""


@dataclass(eq=False)
class _Scope:
    """The types at the labels of a record type, or at a variable, as seen inside.

    Fields that depend on each other in a circle are known, but lead nowhere. `binder`
    is what binds the variable.
    """

    types: dict[str, TypeNode] = field(default_factory=dict)
    circular: set[str] = field(default_factory=set)
    binder: Function | FunType | None = None


_Scopes = tuple[_Scope, ...]
"""What stands around, innermost first."""


class _Cost:
    """The steps that a normal form takes: its own, and those of others that it needs.

    Whoever finds it in the memo spends the same again, each of the others once: so an
    answer does not depend on what was asked before.
    """

    __slots__ = ("others", "own", "spent_on_others")

    def __init__(self) -> None:
        self.own = 0
        self.others: list[_Cost] = []
        self.spent_on_others = 0


_CHEAP = 64
"""A normal form of fewer steps is paid for wherever it stands, not only once."""


_KNOWN: WeakKeyDictionary[
    Signature, tuple[WeakKeyDictionary[Node, tuple[Object | None, _Cost]], ...]
] = WeakKeyDictionary()
"""The normal forms of closed types with their costs, by theory, where an application
that is ill-formed is kept and where it is refused; None for a type that is its own.
"""


class _Normaliser:
    """Computes normal forms in a theory.

    If it is strict, it refuses an application whose argument cannot be in the domain;
    else it keeps it.
    """

    def __init__(self, theory: Signature, is_strict: bool = True) -> None:
        self._theory, self._is_strict = theory, is_strict
        kinds = _KNOWN.setdefault(theory, (WeakKeyDictionary(), WeakKeyDictionary()))
        self._known = kinds[is_strict]
        self._made: dict[tuple[object, ...], Object] = {}
        self._paid: set[_Cost] = set()
        self._cost = _Cost()

    def of(self, value: Object, around: _Scopes) -> Object:
        """The normal form of what stands in these scopes."""
        spend()
        if type(value) is str:
            return value
        if isinstance(value, Path):
            return self._at_path(value, around)
        if isinstance(value, TypeNode | Function):
            return self._of_node(value, around)
        return map_parts(value, lambda part, _: self.of(part, around))

    def _of_node(self, value: Node, around: _Scopes) -> Object:
        """The normal form of a type or function, once where it stands several times."""
        outward = max((path.up + 1 for path in free_paths(value)), default=0)
        if outward:
            key = (value, *around[:outward])
            if key not in self._made:
                self._made[key] = self._compute(value, around)
            return self._made[key]
        known = self._known.get(value)
        if known is None:
            known = self._find(value)
        else:
            self._pay(known[1])
        found = known[0]
        return value if found is None else found

    def _find(self, value: Node) -> tuple[Object | None, _Cost]:
        """Compute a normal form, and remember it with what it cost."""
        purse, around = open_purse(), self._cost
        assert purse is not None
        left = purse.left
        cost = self._cost = _Cost()
        computed = self._compute(value, ())
        self._cost = around
        spent = left - purse.left
        cost.own = spent - cost.spent_on_others
        known = (None if computed is value else computed, cost)
        self._known[value] = known
        self._note(cost, spent)
        return known

    def _pay(self, cost: _Cost) -> None:
        """Spend what a normal form cost, but for what was spent here before."""
        spent = 0
        waiting = [cost]
        while waiting:
            one = waiting.pop()
            if one not in self._paid:
                spent += one.own
                waiting += one.others
                if one.others or one.own >= _CHEAP:
                    self._paid.add(one)
        spend(spent)
        self._note(cost, spent)

    def _note(self, cost: _Cost, spent: int) -> None:
        """Note that what is being computed needed this, and what was spent on it."""
        if cost.others or cost.own >= _CHEAP:
            self._paid.add(cost)
            self._cost.others.append(cost)
            self._cost.spent_on_others += spent

    def _compute(self, value: Node, around: _Scopes) -> Object:
        match value:
            case RecordType():
                return self._record_type(value, around)
            case Function(domain, inside) | FunType(domain, inside):
                kind = self._type(domain, around)
                scope = _Scope({BOUND: _move_in(kind)}, binder=value)
                return type(value)(kind, self.of(inside, (scope, *around)))
            case Application(function, argument):
                return self._application(function, self.of(argument, around), around)
            case TypeAt(term):
                return self._type_at(self.of(term, around))
            case Merge():
                merged = map_parts(value, lambda part, _: self.of(part, around))
                again = isinstance(merged, TypeNode) and not isinstance(merged, Merge)
                return self.of(merged, around) if again else merged
        return map_parts(value, lambda part, _: self.of(part, around))

    def _type(self, T: TypeNode, around: _Scopes) -> TypeNode:
        found: TypeNode = self.of(T, around)
        return found

    def _record_type(self, T: RecordType, around: _Scopes) -> RecordType:
        """The record type, field by field; each knows those that it depends on."""
        scope = _Scope()
        within = (scope, *around)
        for label, kind in T.fields:
            found: TypeNode = self.of(kind, within)
            if not labels_mentioned(found) <= scope.types.keys():
                scope.circular.add(label)
            scope.types[label] = found
        return RecordType(order_fields(scope.types))

    # --- paths ---

    def _at_path(self, path: Path, around: _Scopes) -> Object:
        """What a path leads to, if it leads to or into manifest fields.

        Their values are normal already. A circle of them leads nowhere.
        """
        passed: set[Path] = set()
        found: Object = path
        while isinstance(found, Path) and found not in passed:
            passed.add(found)
            found = self._follow(found, around)
        return found

    def _follow(self, path: Path, around: _Scopes) -> Object:
        """The value of the first manifest field on the way, and on from there."""
        if path.up >= len(around) or path.labels[0] in around[path.up].circular:
            return path
        T = around[path.up].types.get(path.labels[0])
        for done in range(1, len(path.labels) + 1):
            spend()
            if T is None:
                return path
            value = _manifest(T)
            if value is not None:
                found = follow_labels(value[0], path.labels[done:])
                return shift_paths(found, path.up)
            if done < len(path.labels):
                T = _field(T, path.labels[done], Path(0, path.labels[:done]))
        return path

    def _type_at(self, term: Object) -> TypeNode:
        """What a normal term stands for where a type is needed."""
        found = type_at(term)
        if self._is_strict and isinstance(found, TypeAt) and not _is_open(term):
            raise IllFormedError(
                f"{notation(term)} stands where a type is needed, but it is none"
            )
        return found

    # --- applications ---

    def _application(
        self, function: Object, argument: Object, around: _Scopes
    ) -> Object:
        """The value of a function for a normal argument, or the application itself.

        The body of a function that is written out is not computed before it has its
        argument: so one that doubles another costs no more than that.
        """
        is_normal = not isinstance(function, Function) or _is_plain(function)
        if is_normal:
            function = self.of(function, around)
        if not isinstance(function, Function):
            return Application(function, argument)
        domain = function.domain if is_normal else self._type(function.domain, around)
        derived = _Derivation(self._theory, around, argument, domain)
        if derived.is_derivable:
            value = substitute_variable(function.body, argument)
            if is_normal and _stays_normal(function.body, argument):
                return value
            return self.of(value, around)
        if self._is_strict and derived.is_impossible:
            names = _names(around, self._theory)
            of = notation(derived.type, names) if derived.type else ""
            raise IllFormedError(
                f"{notation(function, names)} takes objects of "
                f"{notation(domain, names)}, and {notation(argument, names)} cannot be "
                "one" + (f", as it is of {of}" if of else "")
            )
        return Application(self.of(function, around), argument)


def _is_plain(function: Function) -> bool:
    """Is it plain from the form of a function that it is normal?"""
    return not (free_paths(function) or mentions_any(function, _VALUED))


def _stays_normal(body: Object, argument: Object) -> bool:
    """Is a normal body still normal with a normal argument for its variable?

    It is if the argument is a name or a path, and stands nowhere on the way to
    something else.
    """
    if not (type(argument) is str or isinstance(argument, Path)):
        return False
    if mentions_any(body, _COMPUTED):
        return False
    return all(path.up > 0 or path.labels == (BOUND,) for path in free_paths(body))


def _names(around: _Scopes, theory: Signature) -> Scope:
    """The names of what stands around, as the text of the theory has them."""
    scope = theory.spelling
    for one in reversed(around):
        binder = one.binder
        name = variable(binder, scope) if binder else frozenset(one.types)
        scope = (name, *scope)
    return scope


def _move_in(T: TypeNode) -> TypeNode:
    """The type as it is seen one scope further in."""
    moved: TypeNode = shift_paths(T, 1)
    return moved


def _is_open(term: Object) -> bool:
    """May a term still compute to something else?"""
    return isinstance(term, Path | Operation)


def _manifest(T: TypeNode) -> tuple[Object] | None:
    """The object that whatever is of T is, in a tuple; None if T does not say."""
    match T:
        case Singleton(_, value):
            return (value,)
        case Meet(parts):
            return next((found for part in parts if (found := _manifest(part))), None)
    return None


def _field(T: TypeNode, label: str, whole: Path) -> TypeNode | None:
    """The type at a label of what is of T, as seen from outside of the record."""
    match T:
        case RecordType():
            inner = T.get(label)
            return None if inner is None else field_type(inner, whole)
        case Singleton(base, _):
            return _field(base, label, whole)
        case Meet(parts):
            found = (_field(part, label, whole) for part in parts)
            return next((one for one in found if one is not None), None)
    return None


# --- is the argument in the domain? --------------------------------------------------


class _Derivation:
    """Θ; Γ ⊢ a : S, for normal a and S: is it derivable, or is it impossible?"""

    def __init__(
        self, theory: Signature, around: _Scopes, a: Object, S: TypeNode
    ) -> None:
        self._theory, self._around = theory, around
        self._a, self._S = a, S
        self.type = self._type_of(a)

    def _type_of(self, a: Object) -> TypeNode | None:
        """The type that a declaration, or the field at the end of a path, gives."""
        if type(a) is str:
            return self._theory.declared.get(a)
        if isinstance(a, Path) and a.up < len(self._around) and len(a.labels) == 1:
            T = self._around[a.up].types.get(a.labels[0])
            if T is not None:
                moved: TypeNode = shift_paths(T, a.up)
                return moved
        return None

    @property
    def is_derivable(self) -> bool:
        """Is the argument surely in the domain?"""
        T = self.type
        while isinstance(T, Singleton):
            T = T.base
        if T is self._S:
            return True
        prover, a, S = self._prover()
        return prover.prove(a, S).yes

    @property
    def is_impossible(self) -> bool:
        """Can nothing be of the domain and of the argument's type?"""
        if (
            isinstance(self._a, _WRITTEN)
            and not isinstance(self._a, _OPEN)
            and self._S is Ind
        ):
            return True
        prover, a, S = self._prover()
        return prover.assume((a, S)).is_impossible

    def _prover(self) -> tuple[Prover, Object, TypeNode]:
        """A prover that knows what stands around, with a and S as it sees them."""
        a, S = _as_places(self._a, 0), _as_places(self._S, 0)
        assumed = tuple(self._assumptions((a, S)))
        witness = GenericWitness(Rec, assumed)
        return Prover(Rec, self._theory, witness, assumed), a, S

    def _assumptions(self, values: tuple[Object, ...]) -> Iterator[Assumption]:
        """What is known of the places and declared objects in the values."""
        waiting = list(values)
        seen: set[object] = set()
        while waiting:
            value = waiting.pop()
            for term in _terms_in(value):
                spend()
                known = self._types_known_of(term)
                for place, T in known:
                    if identity(place) not in seen:
                        seen.add(identity(place))
                        yield place, T
                        waiting.append(T)

    def _types_known_of(self, term: Object) -> Iterator[Assumption]:
        if type(term) is str:
            if term in self._theory.declared:
                yield term, self._theory.declared[term]
            return
        assert isinstance(term, Path)
        scope, label, *_ = term.labels
        up = int(scope[1:])
        if up < len(self._around):
            T = self._around[up].types.get(label)
            if T is not None:
                yield Path(0, (scope, label)), _as_places(T, up)


def _as_places(value: Object, up: int) -> Object:
    """A value of so many scopes out, with its paths as places of one witness.

    The path `^^.x.y` is the place `^2.x.y`; no label is written so.
    """
    return replace_paths(
        value, lambda path: Path(0, (f"^{path.up + up}", *path.labels))
    )


def _terms_in(value: Object) -> Iterator[Object]:
    """The places and the names of objects in a value."""
    for path in free_paths(value):
        if path.up == 0 and path.labels[0].startswith("^"):
            yield path
    for part in subterms([value]):
        if type(part) is str:
            yield part


@within_budget
def check_computable(value: Object, theory: Signature) -> None:
    """Check that no function or predicate is given what cannot be in its domain.

    Nor may fields be set to each other in a circle. Raises `IllFormedError`.
    """
    for part in subterms([value]):
        match part:
            case RecordType() if mentions_any(part, _SET):
                _check_values(part)
            case PType(pred, args):
                _check_individuals(pred, args)
    if mentions_any(value, _REFUSED):
        normal_form(value, theory)


def _check_individuals(pred: Pred, args: tuple[Object, ...]) -> None:
    """Refuse a type where all arities need an individual.

    Other basic types, such as one of moves, may well have types as their objects.
    """
    for number, arg in enumerate(args):
        if not isinstance(arg, _WRITTEN) or isinstance(arg, _OPEN):
            continue
        wanted = [arity[number] for arity in pred.arities if len(arity) == len(args)]
        if all(T is Ind for T in wanted):
            kind = _KINDS.get(type(arg), "a type")
            raise IllFormedError(f"{pred.name} takes individuals, but {arg} is {kind}")


def _check_values(T: RecordType) -> None:
    circle = " → ".join(find_cycle_of_values(T))
    if circle:
        raise IllFormedError(
            f"the fields of {notation(T)} are set to each other in a circle: {circle}"
        )


def normal_value(value: Object, theory: Signature) -> Object:
    """What a type or object computes to; what is ill-formed in it is kept.

    Nothing is of a type that is ill-formed.
    """
    if not mentions_any(value, _COMPUTED):
        return value
    return _compute_normal_value(value, theory)


@within_budget
def _compute_normal_value(value: Object, theory: Signature) -> Object:
    return _Normaliser(theory, is_strict=False).of(value, ())


def normal_type(T: TypeNode, theory: Signature) -> TypeNode:
    """The same of a type, which may compute to what is none: then it is kept."""
    found = normal_value(T, theory)
    return found if isinstance(found, TypeNode) else T
