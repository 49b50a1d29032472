"""Laws of normal forms: one for each term, whichever way it is computed.

Terms are drawn with their types, and computed a second time by a little evaluator for
terms with de Bruijn indices, which knows nothing of records and paths.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from generators import models, record_types, samples, types
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ttr import Ind, ListOf, Model, Pred, Rec, RecType, Theory, fun, rectype, this
from ttr.computing.definitional_equality import equal, kept_redexes
from ttr.computing.generic_witness import ITSELF
from ttr.computing.normalisation import normal_form, normal_type
from ttr.computing.path_cycles import describe_cycle
from ttr.computing.prover import Prover
from ttr.computing.subtyping import subtype
from ttr.computing.universe_levels import level_of
from ttr.errors import IllFormedError
from ttr.judging.evaluator import derivation
from ttr.signature.signature import signature_of
from ttr.types import Application, Function, RecordType, Universe
from ttr.types.derived_types import order_fields
from ttr.types.interning import identity
from ttr.types.objects import BOUND, Path
from ttr.types.syntax import as_type

WELL_TESTED = settings(max_examples=max(300, settings.default.max_examples))
"""What equality rests on is tried often, also where other laws are not."""

p, q = Pred("p", Ind), Pred("q", Ind, Ind)
THEORY = Theory.parse("basic Ind\nobject j, k : Ind")
THEORY_OF_TERMS = Theory.of(Ind, p("j"), q("j", "k"))
NONE = signature_of(None)


def are_same(one, other):
    """Whether two terms are the same; names are compared by their letters."""
    return identity(one) == identity(other)


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


def map_terms(term, change, deeper=0):
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


def shift(term, by, depth=0):
    if isinstance(term, Var):
        return Var(term.index + by) if term.index >= depth else term
    return map_terms(term, lambda part, d: shift(part, by, d), depth)


def substitute(term, argument, depth=0):
    """The body of an abstraction with an argument for its variable."""
    if isinstance(term, Var):
        if term.index == depth:
            return shift(argument, depth)
        return Var(term.index - 1) if term.index > depth else term
    return map_terms(term, lambda part, d: substitute(part, argument, d), depth)


def evaluate(term):
    term = map_terms(term, lambda part, _: evaluate(part))
    if isinstance(term, App) and isinstance(term.function, Lam):
        return evaluate(substitute(term.function.body, term.argument))
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
            arguments = [as_node(shift(one, 1), inside) for one in args]
            return RecordType((("e", pred(*arguments)),))
        case Both(r, s):
            within = ("x", *around)
            one, other = (as_type(as_node(part, within)) for part in (r, s))
            fields = {"x": Ind, "r": one, "s": other}
            return RecordType(order_fields(fields))
    return term


def in_python(term, around=()):
    """The term composed by Python functions, each of what stands around it."""
    match term:
        case Var(index):
            return around[index]
        case Lam(domain, body):
            return fun(v=kind_of(domain))(lambda v: in_python(body, (v, *around)))
        case App(f, a):
            return Application(in_python(f, around), in_python(a, around))
        case Atom(pred, args):
            return rectype(e=pred(*[in_python(one, around) for one in args]))
        case Both(r, s):
            return rectype(
                x=Ind,
                r=lambda it: in_python(r, (it.x, *around)),
                s=lambda it: in_python(s, (it.x, *around)),
            )
    return term


@WELL_TESTED
@given(terms())
def test_nothing_is_captured_in_python(term):
    assert are_same(in_python(term), as_node(term))
    assert are_same(normal_form(in_python(term), THEORY), as_node(evaluate(term)))


@WELL_TESTED
@given(terms())
def test_nothing_is_captured_in_notation(term):
    assert are_same(THEORY_OF_TERMS.parse(str(as_node(term))), as_node(term))


# --- functions over types ------------------------------------------------------------

Types = Universe("Type", 1)
ID, K, S = map(
    THEORY.parse,
    (
        r"\A:Type^1. \x:A. x",
        r"\A:Type^1. \B:Type^1. \x:A. \y:B. x",
        r"\A:Type^1. \B:Type^1. \C:Type^1. "
        r"\f:(A -> (B -> C)). \g:(A -> B). \x:A. f(x)(g(x))",
    ),
)


def apply_to(function, *args):
    for one in args:
        function = Application(function, one)
    return function


@WELL_TESTED
@given(st.data(), *[st.sampled_from(KINDS)] * 3)
def test_functions_over_types_compute_at_every_type(data, a, b, c):
    """Their values have the codomain at the argument, before and after computing."""
    A, B, C = map(kind_of, (a, b, c))
    f = as_node(data.draw(terms((a, (b, c)), depth=2)))
    g = as_node(data.draw(terms((a, b), depth=2)))
    x, y = (as_node(data.draw(terms(kind, depth=2))) for kind in (a, b))
    for written, wanted, of in (
        (apply_to(ID, A, x), x, A),
        (apply_to(K, A, B, x, y), x, A),
        (apply_to(S, A, B, C, f, g, x), apply_to(f, x, apply_to(g, x)), C),
        (apply_to(S, A, B >> A, A, apply_to(K, A, B >> A), apply_to(K, A, B), x), x, A),
    ):
        found = normal_form(written, THEORY)
        assert are_same(found, normal_form(wanted, THEORY))
        prover = Prover.for_type(Rec, THEORY).assume(*THEORY.declared.items())
        assert prover.prove(found, of).yes
        assert Model(THEORY).judge(written, of).holds


@WELL_TESTED
@given(types(), types())
def test_what_a_field_stands_for_is_what_it_computes_to(T, U):
    assume(well_formed(T) and well_formed(U))
    high = Universe("Type", max(map(level_of, (T, U))))
    of_T = rectype(T=high @ T, x=this.T, l=ListOf(this.T), f=this.T >> U)
    given_T = rectype(T=high @ T, x=T, l=ListOf(T), f=T >> U)
    assert normal_form(of_T) is normal_form(given_T)
    assert subtype(of_T, rectype(T=high, x=this.T, f=this.T >> U)).yes


@WELL_TESTED
@given(terms())
def test_normal_forms_are_those_of_another_evaluator(term):
    assert are_same(normal_form(as_node(term), THEORY), as_node(evaluate(term)))


@WELL_TESTED
@given(st.data(), st.sampled_from(KINDS))
def test_a_normal_form_has_the_types_that_the_term_has(data, kind):
    """It has them by the way it was drawn; the prover is not given it, as it was."""
    node = as_node(data.draw(terms(kind)))
    prover = Prover.for_type(Rec, THEORY).assume(*THEORY.declared.items())
    assert prover.prove(normal_form(node, THEORY), kind_of(kind)).yes
    assert Model(THEORY).judge(node, kind_of(kind)).holds


@WELL_TESTED
@given(terms(depth=3), st.randoms())
def test_any_order_of_contraction_has_one_normal_form(term, chance):
    node = as_node(term)
    wanted = normal_form(node, THEORY)
    while True:
        found = contract_somewhere(term, chance)
        if found is None:
            break
        term = found
        assert are_same(normal_form(as_node(term), THEORY), wanted)
    assert as_node(term) is wanted


def contract_somewhere(term, chance):
    """The term with one redex contract, drawn by chance; None if it has none."""
    places = list(redexes(term))
    return contract(term, chance.choice(places)) if places else None


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


def contract(term, way):
    if not way:
        return substitute(term.function.body, term.argument)
    numbers = iter(range(len(parts(term))))

    def change(part, _):
        return contract(part, way[1:]) if next(numbers) == way[0] else part

    return map_terms(term, change)


# --- of all types --------------------------------------------------------------------


def well_formed(T):
    with suppress(IllFormedError):
        return normal_form(T) is not None
    return False


@WELL_TESTED
@given(types())
def test_a_normal_form_is_its_own(T):
    found = normal_type(T, NONE)
    assert normal_type(found, NONE) is found


@WELL_TESTED
@given(types(), models(), samples())
def test_judging_is_the_same_of_a_normal_form(T, M, sample):
    """As the evaluator has it, which computes what it meets in the model."""
    for a in (sample, "a", "x", (), RecordType(())):
        found = derivation(M.facts, a, normal_type(T, NONE))
        assert found.p == derivation(M.facts, a, T).p


@WELL_TESTED
@given(st.lists(terms(depth=3), min_size=2, max_size=2))
def test_subtyping_is_the_same_of_normal_forms(both):
    """As the prover has it, which contracts what it meets."""
    S, T = map(as_node, both)
    one, other = (normal_form(it, THEORY) for it in (S, T))
    written = Prover.for_type(S, THEORY).prove(ITSELF, T)
    assert Prover.for_type(one, THEORY).prove(ITSELF, other).yes or not written.yes


@WELL_TESTED
@given(record_types())
def test_a_record_type_is_below_its_normal_form_and_above(T):
    assume(not describe_cycle(T))
    assert subtype(T, normal_form(T)).yes
    assert subtype(normal_form(T), T).yes


@WELL_TESTED
@given(terms(), types())
def test_equality_is_a_congruence(term, other):
    assume(well_formed(other))
    T = as_node(term)
    U = normal_form(T, THEORY)
    assert equal(T, U, THEORY).yes
    for context in (
        lambda S: ~S,
        lambda S: S | other,
        lambda S: ListOf(S),
        lambda S: RecordType((("x", S), ("y", other))),
        lambda S: Function(Ind, S),
        lambda S: (S, "a"),
    ):
        assert equal(context(T), context(U), THEORY).yes


@WELL_TESTED
@given(terms(depth=2), terms(depth=2))
def test_what_computes_to_something_else_is_not_equal(one, other):
    same = are_same(as_node(evaluate(one)), as_node(evaluate(other)))
    answer = equal(as_node(one), as_node(other), THEORY)
    assert answer.verdict == ("yes" if same else "no")


@WELL_TESTED
@given(types())
def test_what_is_kept_is_why_equality_is_unknown(T):
    """Unless that is what both compute to."""
    assume(well_formed(T))
    kept = Application(Function(Ind, "a"), "nobody")
    answer = equal(RecordType((("x", T @ kept),)), RecordType((("x", T),)))
    assert answer.unknown
    assert kept in kept_redexes(normal_form(T @ kept))
    assert equal(T @ kept, T @ kept).yes
