"""Laws of normal forms: one for each term, whichever way it is computed.

Terms are drawn with their types, and computed a second time by a little evaluator for
terms with de Bruijn indices, which knows nothing of records and paths.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from generators import models, record_types, samples, types
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Ind, Pred, RecType, Theory
from ttr.computing.definitional_equality import equal, kept_redexes
from ttr.computing.normalisation import normal_form, normal_type
from ttr.computing.path_cycles import describe_cycle
from ttr.computing.subtyping import subtype
from ttr.errors import IllFormedError
from ttr.signature.signature import signature_of
from ttr.types import Application, Function, RecordType
from ttr.types.derived_types import order_fields
from ttr.types.objects import BOUND, Path

p, q = Pred("p", Ind), Pred("q", Ind, Ind)
THEORY = Theory.parse("basic Ind\nobject j, k : Ind")
NONE = signature_of(None)


# --- typed terms with de Bruijn indices ----------------------------------------------


@dataclass(frozen=True)
class Var:
    index: int


@dataclass(frozen=True)
class Lam:
    domain: object
    body: object


@dataclass(frozen=True)
class App:
    function: object
    argument: object


@dataclass(frozen=True)
class Atom:
    """[e : p(…)]."""

    pred: Pred
    args: tuple[object, ...]


@dataclass(frozen=True)
class Both:
    """[x : Ind, r : …, s : …], where both know x."""

    r: object
    s: object


E, T = "Ind", "RecType"
"""The types of individuals and of what is said, as in Montague; (S, T) is S -> T."""

KINDS = [E, T, (E, T), (E, E), ((E, T), T), (E, (E, T)), ((E, T), (E, T))]


@st.composite
def terms(draw, kind=T, around=(), depth=4):
    """A term of this type, in which variables of the types around it may occur."""
    known = [Var(i) for i, one in enumerate(around) if one == kind]
    if known and (depth == 0 or draw(st.booleans())):
        return draw(st.sampled_from(known))

    def inner(kind, around=around):
        return draw(terms(kind, around, max(depth - 1, 0)))

    if depth > 0 and draw(st.booleans()):
        domain = draw(st.sampled_from(KINDS))
        return App(inner((domain, kind)), inner(domain))
    if kind == E:
        return draw(st.sampled_from(["j", "k"]))
    if kind != T:
        domain, result = kind
        return Lam(domain, inner(result, (domain, *around)))
    if depth > 0 and draw(st.booleans()):
        within = (E, *around)
        return Both(inner(T, within), inner(T, within))
    args = [inner(E)] if draw(st.booleans()) else [inner(E), inner(E)]
    return Atom((p, q)[len(args) - 1], tuple(args))


def rebuilt(term, change, deeper=0):
    match term:
        case Lam(domain, body):
            return Lam(domain, change(body, deeper + 1))
        case App(f, a):
            return App(change(f, deeper), change(a, deeper))
        case Atom(pred, args):
            return Atom(pred, tuple(change(one, deeper) for one in args))
        case Both(r, s):
            return Both(change(r, deeper + 1), change(s, deeper + 1))
    return term


def shifted(term, by, depth=0):
    if isinstance(term, Var):
        return Var(term.index + by) if term.index >= depth else term
    return rebuilt(term, lambda part, d: shifted(part, by, d), depth)


def replaced(term, argument, depth=0):
    """The body of an abstraction with an argument for its variable."""
    if isinstance(term, Var):
        if term.index == depth:
            return shifted(argument, depth)
        return Var(term.index - 1) if term.index > depth else term
    return rebuilt(term, lambda part, d: replaced(part, argument, d), depth)


def evaluated(term):
    term = rebuilt(term, lambda part, _: evaluated(part))
    if isinstance(term, App) and isinstance(term.function, Lam):
        return evaluated(replaced(term.function.body, term.argument))
    return term


# --- as types of the theory ----------------------------------------------------------


def kind_of(kind):
    if kind == E:
        return Ind
    if kind == T:
        return RecType
    return kind_of(kind[0]) >> kind_of(kind[1])


def as_node(term, around=()):
    """The term as a type; each scope around it is known by its only label."""
    match term:
        case Var(index):
            return Path(index, (around[index],))
        case Lam(domain, body):
            return Function(kind_of(domain), as_node(body, (BOUND, *around)))
        case App(f, a):
            return Application(as_node(f, around), as_node(a, around))
        case Atom(pred, args):
            inside = ("", *around)
            arguments = [as_node(shifted(one, 1), inside) for one in args]
            return RecordType((("e", pred(*arguments)),))
        case Both(r, s):
            within = ("x", *around)
            fields = (("x", Ind), ("r", as_node(r, within)), ("s", as_node(s, within)))
            return RecordType(order_fields(dict(fields)))
    return term


@given(terms())
def test_normal_forms_are_those_of_another_evaluator(term):
    assert normal_form(as_node(term), THEORY) is as_node(evaluated(term))


@given(
    st.sampled_from(KINDS).flatmap(lambda kind: st.tuples(st.just(kind), terms(kind)))
)
def test_a_normal_form_has_the_types_that_the_term_has(typed):
    kind, term = typed
    model = THEORY_MODEL
    for value in (as_node(term), normal_form(as_node(term), THEORY)):
        assert model.judge(value, kind_of(kind)).holds


THEORY_MODEL = __import__("ttr").Model(THEORY)


@given(terms(depth=3), st.randoms())
def test_any_order_of_contraction_has_one_normal_form(term, chance):
    node = as_node(term)
    wanted = normal_form(node, THEORY)
    while True:
        found = contracted_somewhere(term, chance)
        if found is None:
            break
        term = found
        assert normal_form(as_node(term), THEORY) is wanted
    assert as_node(term) is wanted


def contracted_somewhere(term, chance):
    """The term with one redex contracted, drawn by chance; None if it has none."""
    places = list(redexes(term))
    return contracted(term, chance.choice(places)) if places else None


def redexes(term, way=()):
    if isinstance(term, App) and isinstance(term.function, Lam):
        yield way
    for number, part in enumerate(parts(term)):
        yield from redexes(part, (*way, number))


def parts(term):
    match term:
        case Lam(_, body):
            return (body,)
        case App(f, a):
            return (f, a)
        case Atom(_, args):
            return args
        case Both(r, s):
            return (r, s)
    return ()


def contracted(term, way):
    if not way:
        return replaced(term.function.body, term.argument)
    numbers = iter(range(len(parts(term))))

    def change(part, _):
        return contracted(part, way[1:]) if next(numbers) == way[0] else part

    return rebuilt(term, change)


# --- of all types --------------------------------------------------------------------


def well_formed(T):
    with suppress(IllFormedError):
        return normal_form(T) is not None
    return False


@given(types())
def test_a_normal_form_is_its_own(T):
    found = normal_type(T, NONE)
    assert normal_type(found, NONE) is found


@given(types(), models(), samples())
def test_judging_is_the_same_of_a_normal_form(T, M, sample):
    for a in (sample, "a", "x", (), RecordType(())):
        assert M.judge(a, normal_type(T, NONE)).p == M.judge(a, T).p


@given(record_types(), record_types())
def test_subtyping_is_the_same_of_normal_forms(S, T):
    assume(not describe_cycle(S) and not describe_cycle(T))
    one, other = normal_form(S), normal_form(T)
    assert subtype(one, other).verdict == subtype(S, T).verdict


@given(types(), types())
def test_equality_is_a_congruence(S, T):
    if well_formed(S) and well_formed(T) and equal(S, T).yes:
        assert equal(~S, ~T).yes
        assert equal(S & Ind, T & Ind).yes
        assert equal(RecordType((("x", S),)), RecordType((("x", T),))).yes


@given(types())
def test_what_is_kept_is_why_equality_is_unknown(T):
    if well_formed(T) and equal(T, Ind).unknown:
        assert any(True for _ in kept_redexes(normal_type(T, NONE)))
