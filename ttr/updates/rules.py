"""Rules of information-state update: a condition, an event, bindings and an effect."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from linecache import checkcache, getlines
from typing import TypeAlias

from ttr.errors import Span, TTRError, UpdateError
from ttr.judging.evaluator import reduce_applications
from ttr.judging.models import Model
from ttr.probability import CERTAIN, Degree, degree
from ttr.showing import (
    Fields,
    Fold,
    NotebookValue,
    Part,
    Text,
    Value,
    below,
    beside,
    table,
)
from ttr.signature.signature import Signature, signature_of
from ttr.types.objects import BOUND, Object, Path
from ttr.types.paths import free_paths, replace_paths
from ttr.types.printing import as_written
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import Function, RecordType, TypeNode, kind_of

Effect: TypeAlias = Callable[..., object]

EXTRAS = ("model", "p", "nbest")
"""What an effect may take as a parameter besides the bindings."""


@dataclass(frozen=True, repr=False)
class Rule(NotebookValue):
    """An update rule: if the state is of `when`, `effect` gives the next state.

    A rule with `on` takes an event of that type, as probable as `p` says; a rule
    without `on` is tacit. `where` binds names to what is in the state, the event and
    the model; the rule applies only if everything in it can be bound. `gives` is the
    type of the next state, `kind` the rule's class, `doc` what the rule is for. `takes`
    are the bindings and extras that the effect has as parameters, `names` its names for
    the state and the event; `text` is the text of a rule in a file, from its name on,
    and `place` where that is.
    Built by `rule`, `update` or a theory file.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> drop = talk.rules["drop"]
    >>> print(drop.name, drop.when)
    drop [qud : nelist(Question)]
    """

    name: str
    effect: Effect
    when: RecordType
    on: TypeNode | None = None
    where: RecordType | None = None
    gives: RecordType | None = None
    kind: str = ""
    p: Degree = CERTAIN
    takes: frozenset[str] = frozenset()
    names: tuple[str, ...] = ("s", "e")
    doc: str = ""
    place: Span | None = None
    text: str = ""

    def __str__(self) -> str:
        return self.name

    @cached_property
    def span(self) -> Span | None:
        """Where the rule stands: its `place`, or that of the name of its function."""
        return self.place or span_of_function(self.effect)

    def __repr__(self) -> str:
        return f"<Rule {self.name}>"

    def _shown_as_(self) -> Part:
        return below(
            beside(
                Text(self.name, "strong"),
                Text(f"of {self.kind}", "quiet") if self.kind else None,
                Text(self.doc) if self.doc else None,
            ),
            rule_shown(self),
        )


def rule_shown(rule: Rule) -> Part:
    """A rule as in papers, without its name: what it takes above what it does."""
    rows: list[tuple[str, Part]] = [(f"pre {rule.names[0]}", Value(rule.when))]
    if rule.on is not None:
        p = None if rule.p == CERTAIN else Text(f"p in {rule.p}", "quiet")
        event = Value(rule.on, free=rule.names[:1])
        rows.append((f"event {rule.names[1]}", beside(event, p) if p else event))
    if rule.where:
        rows.append(("where", Value(rule.where, free=rule.names)))
    rows.append(("effect", _effect_shown(rule)))
    if rule.gives is not None:
        rows.append(("gives", Value(rule.gives)))
    return Fields(tuple(rows))


def _effect_shown(rule: Rule) -> Part:
    if isinstance(rule.effect, Body):
        return Value(rule.effect.value, free=(*rule.names, *(rule.where or ())))
    parameters = ", ".join([*rule.names, *sorted(rule.takes)])
    name = getattr(rule.effect, "__name__", rule.name)
    return beside(Text(f"{name}({parameters})", "code"), Text("in Python", "quiet"))


FEW = 6
"""So many rules are shown open."""


def rules_shown(rules: Sequence[Rule]) -> Part:
    """Rules with what they are for; each opens to what it takes and does."""
    return table(
        ("rule", "class", "what it is for"),
        rules,
        lambda rule: (
            Fold(rule.name, rule_shown(rule)),
            Text(rule.kind),
            Text(rule.doc.split("\n")[0]),
        ),
    )


@dataclass(frozen=True)
class Body:
    """An effect written in the notation: a type or a record with paths to variables.

    Paths that lead out of `value` start with the name of the state, the event or a
    binding. It is called like an effect in Python, with all of them.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> print(talk.rules["drop"].effect.value)
    [qud = rst(^.s.qud) : list(Question)]
    """

    value: Object
    names: tuple[str, ...]

    def __call__(self, /, *args: Object, model: Model, **bound: Object) -> Object:
        """The type or record for a state, an event and bindings."""
        around = {**dict(zip(self.names, args, strict=False)), **bound}
        return reduce_applications(model.facts, resolve_paths(self.value, (around,)))


def rule(
    *,
    when: RecordType,
    on: TypeNode | None = None,
    where: RecordType | None = None,
    gives: RecordType | None = None,
    kind: str = "",
    p: object = CERTAIN,
) -> Callable[[Effect], Rule]:
    """Make a rule of a function of the state, and of the event if the rule has one.

    The function may also have parameters for what `where` binds, for the `model`, and
    for the probability `p` of the event and its alternatives `nbest`. It returns the
    next state, or a pair of state and model if it adds facts, or a record type, as in
    the literature: then the next state is of the asymmetric merge of the state's own
    type with it. It returns None if it does not apply after all. Raises `UpdateError`
    if `when`, `on`, `where` or `gives` is no such type, or for other parameters.

    Paths in `where` refer to the function's parameters one record further out:
    `outer.s.qud` if the state is called `s`.

    >>> from ttr import Ind, outer, record, rectype, replace
    >>> from ttr.updates import run
    >>> Board = rectype(spkr=Ind, addr=Ind)
    >>> @rule(when=Board, where=rectype(other=Ind @ outer.s.addr))
    ... def take_turn(s, other):
    ...     "Who was spoken to speaks."
    ...     return replace(s, spkr=other, addr=s.spkr)
    >>> M = Model().given("a", Ind).given("b", Ind)
    >>> state = record(spkr="a", addr="b")
    >>> after, M, trace = run(take_turn, state, type=Board, model=M)
    >>> print(after)
    {addr = a, spkr = b}
    >>> print(trace[0])
    take_turn: Who was spoken to speaks.
      with other = b
      addr: b → a
      spkr: a → b
    """
    if not isinstance(when, RecordType):
        raise UpdateError(f"the condition of a rule is a record type, found {when!r}")
    if on is not None and not isinstance(on, TypeNode):
        raise UpdateError(f"the event of a rule is of a type, found {on!r}")
    for role, found in (("bindings", where), ("target", gives)):
        if found is not None and not isinstance(found, RecordType):
            raise UpdateError(
                f"the {role} of a rule are a record type, found {found!r}"
            )
    if not isinstance(kind, str):
        raise UpdateError(f"the kind of a rule is a word, found {kind!r}")
    certain = degree_asked_for(p)

    def make_rule(effect: Effect) -> Rule:
        name = name_of_effect(effect)
        extras = {*EXTRAS, *(where or ())}
        names, takes = read_parameters(name, effect, on is not None, extras)
        return Rule(
            name,
            effect,
            when,
            on=on,
            where=where,
            gives=gives,
            kind=kind,
            p=certain,
            takes=takes,
            names=names,
            doc=inspect.getdoc(effect) or "",
        )

    return make_rule


def _without_defaults(parameters: Iterable[inspect.Parameter]) -> inspect.Signature:
    """The parameters without their defaults and annotations, for an error."""
    empty = inspect.Parameter.empty
    bare = [one.replace(default=empty, annotation=empty) for one in parameters]
    return inspect.Signature(bare)


_ASYNCHRONOUS = (
    inspect.iscoroutinefunction,
    inspect.isgeneratorfunction,
    inspect.isasyncgenfunction,
)

_POSITIONAL = (
    inspect.Parameter.POSITIONAL_ONLY,
    inspect.Parameter.POSITIONAL_OR_KEYWORD,
)


def degree_asked_for(p: object) -> Degree:
    """The degree that an event needs: from a lower bound, or a pair of bounds."""
    try:
        found = degree(p, "the probability of a rule's event")
    except TTRError as error:
        raise UpdateError(error.message) from None
    plain = not isinstance(p, tuple | list)
    return Degree(found.lo, 1.0) if plain else found


def name_of_effect(effect: Effect) -> str:
    """What a function is called; `UpdateError` where it cannot be an effect."""
    if not callable(effect):
        raise UpdateError(f"a rule is made of a function, found {effect!r}")
    name: str = getattr(effect, "__name__", "rule")
    if any(kind(effect) for kind in _ASYNCHRONOUS):
        raise UpdateError(
            f"the rule {name} gives its state later: write a plain function"
        )
    return name


def read_parameters(
    name: str, effect: Effect, has_event: bool, extras: Collection[str] = EXTRAS
) -> tuple[tuple[str, ...], frozenset[str]]:
    """The names of the state and the event, and the other parameters of an effect."""
    try:
        asked = inspect.signature(effect).parameters
    except ValueError:
        raise UpdateError(
            f"the parameters of {name} are not known: write def {name}(s): …"
        ) from None
    plain = tuple(parameter for parameter in asked if parameter not in extras)
    wanted = 1 + has_event
    if len(plain) != wanted or any(asked[one].kind not in _POSITIONAL for one in plain):
        roles = "the state and the event" if has_event else "the state"
        raise UpdateError(
            f"the rule {name} takes {roles}, and model by that name, "
            f"but its parameters are {_without_defaults(asked.values())}"
        )
    return plain, frozenset(asked).difference(plain)


def span_of_function(effect: Effect) -> Span | None:
    """The place of the function's name, if its source is known."""
    while isinstance(effect, partial):
        effect = effect.func
    code = getattr(effect, "__code__", None)
    if code is None:
        return None
    first = code.co_firstlineno
    checkcache(code.co_filename)
    lines = getlines(code.co_filename, getattr(effect, "__globals__", None))
    for number, line in enumerate(lines[first - 1 :], first):
        column = line.find(f"def {code.co_name}")
        if column >= 0:
            column += len("def ")
            length = len(code.co_name)
            text = line.rstrip("\n")
            return Span(code.co_filename, number, column + 1, length, text)
    return None


def update(
    function: Object,
    /,
    name: str = "update",
    *,
    where: RecordType | None = None,
    gives: RecordType | None = None,
    kind: str = "",
    p: object = CERTAIN,
    doc: str = "",
    span: Span | None = None,
    theory: Signature | None = None,
) -> Rule:
    r"""The rule of an update function (S → (E → T)), or of a tacit one (S → T).

    If the state is of S and the event of E, the next state is of the asymmetric merge
    of the state's own type with T. With the theory that defines the function, state and
    event are called as in its text, else s and e. Raises `UpdateError` for any other
    function. Source: Cooper 2023, chapter 2.

    >>> from ttr import Theory, record
    >>> from ttr.updates import run
    >>> board = Theory.parse('''
    ...     basic Ind
    ...     object a, b : Ind
    ...     Board := [spkr : Ind, addr : Ind]
    ...     turn := \\s:Board. [spkr = s.addr : Ind, addr = s.spkr : Ind]
    ... ''')
    >>> start = record(spkr="a", addr="b")
    >>> run(update(board.turn), start, type=board.Board, model=Model(board)).state
    record(addr='a', spkr='b')
    """
    if not isinstance(function, Function):
        raise UpdateError(
            f"an update is a function of states, found {kind_of(function)}"
        )
    if not isinstance(function.domain, RecordType):
        raise UpdateError(
            f"an update is a function of states, records, found {function}"
        )
    names, on, inside = [_name_of(function, theory, "s")], None, function.body
    if isinstance(inside, Function):
        if free_paths(inside.domain):
            raise UpdateError(f"the event's type depends on the state in {function}")
        on = inside.domain
        event = _name_of(inside, theory, "e")
        names.append(event + "_" * (event == names[0]))
        inside = inside.body
    return Rule(
        name,
        Body(_with_names(inside, names), tuple(names)),
        function.domain,
        on=on,
        where=where,
        gives=gives,
        kind=kind,
        p=degree_asked_for(p),
        takes=frozenset(("model", *(where or ()))),
        names=tuple(names),
        doc=doc,
        place=span,
    )


def _name_of(function: Function, theory: Signature | None, usual: str) -> str:
    """The name of a function's variable in the text of a theory, or the usual one."""
    found = as_written(function, signature_of(theory).spelling)
    return found if isinstance(found, str) else usual


def _with_names(value: Object, names: list[str]) -> Object:
    """The body of a function of these variables with their names in place of them."""

    def at(path: Path) -> Object:
        first, *rest = path.labels
        if first != BOUND:
            raise UpdateError(f"the path {path} leads out of the function")
        return Path(0, (names[-1 - path.up], *rest))

    return replace_paths(value, at)
