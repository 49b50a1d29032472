"""Laws of the static checks: what they say never happens, never happens.

Rules are drawn over a small board with a phase, a count and a list; each asks for some
of it and sets some of it. Then they are played from every state, or from the start.
"""

import linecache
from itertools import count, product

from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, ListOf, Model, Record, RecordType, record, rectype
from ttr.errors import EndlessError, UpdateError
from ttr.types.objects import Operation, Path
from ttr.updates import Rule, by_class, first, maybe, repeat, rule, run, seq
from ttr.updates.checks import faults
from ttr.updates.rules import Body

Phase, Ind = Basic("Phase"), Basic("Ind")
Tell = rectype(who=Ind)
Told = rectype(who=Ind @ "a")
Board = rectype(phase=Phase, inner=rectype(last=Ind, qud=ListOf(Ind)))
PHASES, NAMES, LISTS = ("p", "q", "r"), ("a", "b"), ((), ("a",), ("a", "b"))

M = Model()
for name in NAMES:
    M = M.given(name, Ind)
for name in PHASES:
    M = M.given(name, Phase)

STATES = [
    record(phase=phase, inner=record(last=last, qud=qud))
    for phase, last, qud in product(PHASES, NAMES, LISTS)
]
START = STATES[0]
EVENTS = tuple(record(who=name) for name in NAMES)


def on_board(phase, last, qud) -> RecordType:
    """The record type with those of the fields that are told."""
    inner = {"last": last, "qud": qud}
    inner = {label: T for label, T in inner.items() if T is not None}
    fields = {"phase": phase} if phase is not None else {}
    return rectype({**fields, **({"inner": rectype(inner)} if inner else {})})


def one_of(base, values):
    return st.none() | st.just(base) | st.sampled_from([base @ one for one in values])


conditions = st.builds(
    on_board, one_of(Phase, PHASES), one_of(Ind, NAMES), one_of(ListOf(Ind), LISTS)
)
rest = Operation("rst", (Path(2, ("s", "inner", "qud")),))
longer = Operation("+", (Path(2, ("s", "inner", "qud")), ("a",)))
effects = st.builds(
    on_board,
    st.none() | st.sampled_from([Phase @ one for one in PHASES]),
    st.none() | st.sampled_from([Ind @ one for one in NAMES]),
    st.none() | st.sampled_from([ListOf(Ind) @ one for one in (*LISTS, rest, longer)]),
)
numbers = count()


@st.composite
def rules(draw, events=(None, Tell, Told)) -> Rule:
    """A rule of the notation over the board."""
    event = draw(st.sampled_from(events))
    names = ("s",) if event is None else ("s", "e")
    body = Body(draw(effects), names)
    name = f"r{next(numbers)}"
    when = draw(conditions)
    return Rule(name, body, when, on=event, takes=frozenset(["model"]), names=names)


tacit = rules(events=(None,))
algorithms = st.recursive(
    rules(),
    lambda inner: (
        st.builds(
            lambda make, parts: make(*parts),
            st.sampled_from([first, seq]),
            st.lists(inner, min_size=1, max_size=4),
        )
        | inner.map(maybe)
    ),
    max_leaves=6,
)


def fired(algorithm, state, events=()) -> set[str]:
    """The rules that fire, up to where a run is refused."""
    names: set[str] = set()
    model = M
    for event in events or (None,):
        given_event = () if event is None else (event,)
        try:
            state, model, trace = run(
                algorithm, state, type=Board, model=model, events=given_event
            )
        except UpdateError:
            return names
        names |= {step.rule.name for step in trace}
    return names


def never(algorithm, sort, **known) -> set[str]:
    found = faults(algorithm, Board, model=M, **known)
    return {fault.rule.name for fault in found if fault.sort == sort}


@given(algorithms)
def test_a_dead_rule_never_fires(algorithm) -> None:
    dead = never(algorithm, "dead")
    for state, event in product(STATES, (None, *EVENTS)):
        assert not dead & fired(algorithm, state, () if event is None else (event,))


@given(
    st.lists(rules(), min_size=1, max_size=5),
    st.lists(st.sampled_from(EVENTS), min_size=1, max_size=6),
)
def test_what_waits_for_nothing_never_fires_from_the_start(some, events) -> None:
    algorithm = first(*some)
    waiting = never(algorithm, "unset", start=START)
    assert not waiting & fired(algorithm, START, events)


@given(st.lists(tacit, min_size=1, max_size=4))
def test_a_repetition_without_a_fault_ends(some) -> None:
    algorithm = repeat(first(*some))
    if any(fault.sort == "endless" for fault in faults(algorithm, Board, model=M)):
        return
    assert all(ends(algorithm, state) for state in STATES)


def ends(algorithm, state) -> bool:
    """Whether a run comes to its end, or to a rule that fails."""
    try:
        run(algorithm, state, type=Board, model=M)
    except EndlessError:
        return False
    except UpdateError:
        return True
    return True


@given(st.lists(tacit, min_size=2, max_size=4))
def test_rules_of_a_class_that_set_the_same_do_not_disagree(some) -> None:
    same = [
        Rule(r.name, some[0].effect, r.when, kind="k", takes=r.takes, names=r.names)
        for r in some
    ]
    found = faults(by_class(*same, order=["k"]), Board, model=M)
    assert all(fault.sort != "disagreement" for fault in found)


# --- paths ---------------------------------------------------------------------------

LABELS = ("phase", "inner", "last", "qud", "phsae", "inn", "lst", "quds")
paths = st.lists(st.sampled_from(LABELS), min_size=1, max_size=2)


def python_rule(line: str) -> Rule:
    """The rule whose effect is this line, in a file that is only in memory."""
    file = f"<rule {next(numbers)}>"
    text = f"def effect(s):\n    {line}\n"
    linecache.cache[file] = (len(text), None, text.splitlines(True), file)
    scope: dict[str, object] = {}
    exec(compile(text, file, "exec"), PYTHON, scope)
    return rule(when=Board)(scope["effect"])


exec("from ttr import replace", PYTHON := {})


@given(paths)
def test_reading_a_missing_path_fails(path) -> None:
    reading = python_rule(f"return replace(s, phase=s.{'.'.join(path)})")
    told = [f for f in faults(reading, Board, model=M) if f.sort == "missing"]
    assert bool(told) == (at(START, path) is NOWHERE)
    assert not told or not fired(reading, START)


@given(paths)
def test_replacing_a_missing_path_fails(path) -> None:
    writing = python_rule(f"return replace(s, {{{'.'.join(path)!r}: s.inner}})")
    told = [f for f in faults(writing, Board, model=M) if f.sort == "missing"]
    assert bool(told) == (at(START, path) is NOWHERE)
    assert not told or not fired(writing, START)


@given(conditions, st.sampled_from(["phsae", "quds"]))
def test_asking_for_a_missing_path_never_applies(condition, label) -> None:
    asking = rectype({**dict(condition.fields), label: Ind})
    waiting = Rule("w", Body(rectype(), ("s",)), asking, takes=frozenset(["model"]))
    assert [f.sort for f in faults(waiting, Board, model=M)] == ["missing"]
    assert all(not fired(waiting, state) for state in STATES)


NOWHERE = object()


def at(value, path):
    """What is at a path of a record; `NOWHERE` where a label of it is missing.

    What has no labels at all is left alone, as the checks leave it alone.
    """
    for label in path:
        if not isinstance(value, Record):
            return value
        if label not in value:
            return NOWHERE
        value = value[label]
    return value
