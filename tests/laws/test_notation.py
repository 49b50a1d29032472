"""The notation reads back as what was printed, whatever things are called."""

from __future__ import annotations

from dataclasses import dataclass, replace

from generators import records, types
from hypothesis import assume, example, given, reject
from hypothesis import strategies as st

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pi,
    Plus,
    Pred,
    Rec,
    RecType,
    SetOf,
    Str,
    Theory,
    Type,
    amerge,
    fun,
    join,
    meet,
    outer,
    record,
    rectype,
    this,
)
from ttr.errors import IllFormedError
from ttr.notation.parser import parse_statement
from ttr.notation.syntax_trees import Source
from ttr.probability import CERTAIN, Degree
from ttr.theories.statements import StatementReader
from ttr.theories.theory_draft import Draft
from ttr.types import (
    Application,
    EventString,
    FiniteSet,
    Negation,
    NonEmpty,
    Path,
    Singleton,
    TypeAt,
    TypeNode,
    Universe,
    concat,
    fst,
    rst,
)
from ttr.types.merges import merge_terms
from ttr.types.objects import BOUND, Object
from ttr.types.syntax import RecordType
from ttr.updates.rule_notation import format_rule
from ttr.updates.rules import Body, Rule

A, B = Basic("A"), Basic("B")
dog, hug, rains = Pred("dog", Ind), Pred("hug", Ind, Ind), Pred("rains", ())
PREDICATES = (dog, hug, rains, Pred("sees", (Ind,), (Ind, A)), Pred("p", A, B))

WORDS = (
    *("x", "y", "c", "fido", "P", "größe", "λ", "λx", "e1", "x1"),
    *("list", "set", "str", "Type", "fst", "fun", "check", "not", "in", "dog"),
)
"""Labels and variables; some are words of the notation, names or predicates."""

LABELS = (*WORDS, "A", "Ind")
"""These, and the names of types, which no object has that is printed beside them."""

NAMES = st.one_of(
    st.sampled_from((*WORDS, "Rec", "basic", "Type_1", "a b", "", "it's", "é", "_a")),
    st.sampled_from(('say "hi"', "a\\b", "\n\t\u2028\x00\x7f", "\\u0041", "[x : A]")),
    st.sampled_from(("#", "<a>", "x.y", "λx:A. x", "fun x:A. x", "set{}", "3")),
    st.text(max_size=4),
)
NUMBERS = st.integers() | st.floats(allow_nan=False, allow_infinity=False)
BASICS = st.sampled_from((Ind, A, B))
PROPERTY = Ind >> Type
LISTS = ListOf(Ind)


@dataclass(frozen=True)
class Place:
    """What a path may lead to: how far out, its labels, its type."""

    up: int
    labels: tuple[str, ...]
    type: TypeNode


Around = tuple[Place, ...]


def within(around: Around, *more: Place) -> Around:
    """What is around, as seen one scope further in, and what the scope adds."""
    return (*(replace(place, up=place.up + 1) for place in around), *more)


def paths(around: Around, wanted: TypeNode) -> list[Path]:
    return [Path(p.up, p.labels) for p in around if p.type is wanted]


@st.composite
def individuals(draw: st.DrawFn, wanted: TypeNode, around: Around) -> Object:
    fitting = paths(around, wanted)
    if fitting and draw(st.integers(0, 3)):
        return draw(st.sampled_from(fitting))
    return draw(NAMES)


@st.composite
def sequences(draw: st.DrawFn, around: Around, depth: int) -> Object:
    """Lists, some of them computed from others."""
    fitting = paths(around, LISTS)
    items = st.lists(objects(around, depth - 1), min_size=1, max_size=2)
    if not fitting or not draw(st.integers(0, 2)):
        return tuple(draw(items))
    path = draw(st.sampled_from(fitting))
    more = [path, draw(items), path]
    computed = (path, fst(path), rst(path), concat(*more), concat(rst(path), path))
    return draw(st.sampled_from(computed))


@st.composite
def functions(draw: st.DrawFn, around: Around, depth: int) -> Object:
    name = draw(st.sampled_from(LABELS))
    domain = draw(
        st.one_of(st.sampled_from((Ind, PROPERTY, Type)), types_of(around, depth))
    )
    inside = within(around, Place(0, (BOUND,), domain))
    body = draw(objects(inside, depth - 1))
    return fun({name: domain})(body)


@st.composite
def applications(draw: st.DrawFn, around: Around, depth: int) -> Application:
    heads = [*paths(around, PROPERTY), "fido", "p q"]
    head = draw(st.sampled_from(heads))
    if draw(st.booleans()):
        head = draw(functions(around, depth - 1))
    if not draw(st.integers(0, 3)):
        head = Application(head, draw(NAMES))
    return Application(head, draw(objects(around, depth - 1)))


@st.composite
def objects(draw: st.DrawFn, around: Around, depth: int) -> Object:
    some = st.lists(st.deferred(lambda: objects(around, depth - 1)), max_size=3)
    match draw(st.integers(0, 10 if depth > 0 else 2)):
        case 0:
            return draw(NAMES)
        case 1:
            return draw(NUMBERS)
        case 2 | 3:
            return draw(individuals(draw(BASICS), around))
        case 4:
            return draw(sequences(around, depth))
        case 5:
            labels = st.sampled_from(LABELS)
            inner = st.dictionaries(labels, objects(around, depth - 1), max_size=2)
            return record(draw(inner))
        case 6:
            return FiniteSet(*draw(some))
        case 7:
            return EventString(*draw(some))
        case 8:
            return draw(functions(around, depth))
        case 9:
            return draw(applications(around, depth))
    return draw(types_of(around, depth - 1))


@st.composite
def types_of(draw: st.DrawFn, around: Around = (), depth: int = 3) -> TypeNode:
    """Types of every constructor, with paths to what is around."""
    if depth <= 0:
        universes = st.sampled_from((Type, RecType, Rec, Universe("Type", 1)))
        return draw(st.one_of(BASICS, universes))
    inner = types_of(around, depth - 1)
    some = st.lists(inner, min_size=2, max_size=3)
    match draw(st.integers(0, 12)):
        case 0 | 1:
            pred = draw(st.sampled_from(PREDICATES))
            arity = draw(st.sampled_from(pred.arities))
            return pred(*[draw(individuals(wanted, around)) for wanted in arity])
        case 2:
            of = draw(st.sampled_from((ListOf, NonEmpty, SetOf, Plus, Negation)))
            return of(draw(inner))
        case 3:
            return Str(*draw(st.lists(inner, max_size=3)))
        case 4:
            return meet(*draw(some))
        case 5:
            return join(*draw(some))
        case 6:
            base = draw(inner)
            if isinstance(base, Basic):
                return Singleton(base, draw(individuals(base, around)))
            return Singleton(base, draw(objects(around, depth - 1)))
        case 7:
            return draw(inner) >> draw(inner)
        case 8:
            domain = draw(st.sampled_from((Ind, A, B, Type)))
            variable = Place(0, (BOUND,), domain)
            result = draw(types_of(within(around, variable), depth - 1))
            return Pi({draw(st.sampled_from(LABELS)): domain})(result)
        case 9:
            return draw(applications(around, depth))
        case 10:
            fitting = paths(around, Type)
            return draw(st.sampled_from([*map(TypeAt, fitting)] or [Ind]))
    return draw(record_types(around, depth))


@st.composite
def record_types(draw: st.DrawFn, around: Around, depth: int) -> TypeNode:
    some = st.lists(st.sampled_from(LABELS), min_size=1, max_size=4, unique=True)
    labels = draw(some)
    plain = labels[: draw(st.integers(1, len(labels)))]
    kinds = st.one_of(BASICS, st.sampled_from((Ind, PROPERTY, LISTS, Type)))
    fields: dict[str, TypeNode] = {label: draw(kinds) for label in plain}
    inside = within(around, *(Place(0, (k,), T) for k, T in fields.items()))
    for label in labels[len(plain) :]:
        fields[label] = draw(types_of(inside, depth - 1))
    return rectype(fields)


@given(types_of())
@example(rectype(Ind=Type, x=Ind, y=this.Ind, z=Type @ Ind))
@example(rectype(Ind=Type, n=rectype(Ind=A, x=Ind, y=outer.Ind)))
@example(rectype(Type=Type, x=Type, y=this.Type))
@example(rectype(x=Type, f=(Ind >> Type) @ fun(x=Ind)(ListOf(outer.x))))
@example(rectype(A=A, f=Type @ Pi(A=Type)(this.A >> A)))
@example(rectype(x=Ind, y=rectype(x=Ind, c=dog(outer.x))))
@example(rectype(x=Ind, c=hug("x", this.x)))
@example(rectype(x=Ind, t=Type @ rectype(c=dog(outer.x))))
@example(Singleton(Singleton(Ind, "a"), "b"))
@example(rectype(f=Ind @ "λx", λx=Ind))
@example(rectype(λ=Ind @ 0.5))
@example(Application(Application("x", Type), "Type"))
@example(rectype(fun=Ind, s=Type @ EventString(this.fun, "x")))
@example(rectype(set=Ind, s=Type @ EventString(this.set, record(x=1))))
@example(rectype(set=Ind, s=Type @ EventString(this.set, FiniteSet())))
def test_a_type_of_any_constructor_reads_back_as_itself(T):
    assert Theory.of(T).parse(str(T)) is T


@given(objects((), 3))
@example(EventString("x", "in"))
@example(fun({"λx": Ind})("x"))
def test_an_object_reads_back_as_itself(a):
    T = Type @ a
    assert Theory.of(T).parse(str(T)) is T


@given(types_of())
def test_the_order_and_the_spaces_do_not_matter(T):
    text = str(T)
    if '"' in text or "λ" in text:
        return
    spread = text.replace(",", " \n , ").replace("[", "[ # so\n").replace("/\\", "∧")
    spread = spread.replace("\\/", "∨").replace("->", "→").replace("~", "¬ ")
    spread = spread.replace("\\", "λ ")
    assert Theory.of(T).parse(spread) is T


@given(types())
def test_a_printed_type_reads_back_as_itself(T):
    assert Theory.of(T).parse(str(T)) is T


@given(types(), types())
def test_a_merge_that_is_written_is_the_merge(S, T):
    for word, operation in (("merge", merge_terms), ("amerge", amerge)):
        try:
            wanted = operation(S, T)
        except IllFormedError:
            reject()
        assert Theory.of(S, T).parse(f"{word}({S}, {T})") is wanted


@given(records())
def test_a_printed_record_reads_back_as_its_equal(r):
    assert Theory.of(r).parse(str(r)) == r


# --- rules ---------------------------------------------------------------------------

KINDS = st.sampled_from((Ind, A, B, PROPERTY, LISTS, Type))
VARIABLES = ("s", "e", *LABELS)
ENDS = st.sampled_from((0.0, 0.25, 0.7, 1.0))


@st.composite
def rules(draw: st.DrawFn) -> Rule:
    """Rules of any form, with paths to the state, the event and what is bound."""
    fields = draw(st.dictionaries(st.sampled_from(LABELS), KINDS, max_size=3))
    when = rectype(fields)
    on = draw(st.none() | types_of((), 2))
    some = st.lists(st.sampled_from(VARIABLES), min_size=2, max_size=2, unique=True)
    names = tuple(draw(some)[: 1 if on is None else 2])
    around = tuple(Place(0, (names[0], k), T) for k, T in fields.items())
    around += (Place(0, (names[0],), when),)
    where = draw(st.none() | record_types(around, 1))
    if isinstance(where, RecordType):
        assume(not set(where) & set(names))
        around += tuple(Place(0, (k,), T) for k, T in where.fields)
    records_of = st.dictionaries(st.sampled_from(LABELS), objects(around, 1))
    value = draw(record_types(around, 2) | records_of.map(record))
    return Rule(
        draw(st.sampled_from(("greet", "größe", "rule", "of"))),
        Body(value, names),
        when,
        on=on,
        where=where,
        kind=draw(st.sampled_from(("", "grounding", "where", "λ"))),
        p=CERTAIN if on is None else Degree(*sorted((draw(ENDS), draw(ENDS)))),
        takes=frozenset(("model", *(where or ()))),
        names=names,
        doc=draw(
            st.sampled_from(("", "Says 'hello'.", 'a "b"\nc')) | st.text(max_size=4)
        ),
    )


@given(rules())
def test_a_rule_reads_back_as_itself(rule):
    parts = (rule.when, rule.on or (), rule.where or (), rule.effect.value)
    draft = Draft.of(Theory.of(*parts))
    assume(rule.name not in draft.names)
    source = Source(format_rule(rule))
    try:
        StatementReader(draft, source).declare(
            parse_statement(source, 0, len(source.text))
        )
    except IllFormedError:
        reject()  # a path leads to what does not fit, as the types of the rule say
    found = draft.rules[rule.name]
    assert replace(found, place=None, text="") == rule
    assert format_rule(found) == format_rule(rule)
