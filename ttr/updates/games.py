"""Games: a type of information states, its rules, a start, and how they are played.

Each turn takes an event from outside and then makes the moves that the rules have put
on the agenda, as in Cooper 2023: an event of the first type on it is created, and the
rules take that event like any other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from ttr.errors import EndlessError, NotHeardError, TTRError, UpdateError, suggestion
from ttr.judging.certainty import is_certain
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model, as_model
from ttr.probability import CERTAIN, REFUTED
from ttr.safety.budgets import within_budget
from ttr.showing import (
    Fields,
    Fold,
    In,
    NotebookValue,
    Part,
    Text,
    Value,
    below,
    beside,
    count_of,
    table,
)
from ttr.types.objects import Object, Record, freeze
from ttr.types.printing import notation
from ttr.types.syntax import RecordType, TypeNode, as_type, kind_of
from ttr.updates.nbest import NBest
from ttr.updates.rules import FEW, Rule, rules_shown
from ttr.updates.running import (
    Run,
    Step,
    Watch,
    continue_run,
    endless,
    trace_shown,
)
from ttr.updates.states import check_state
from ttr.updates.update_strategies import (
    Algorithm,
    check_strategies,
    event_types,
    rules_of,
)
from ttr.updates.user_functions import blame, excerpt

if TYPE_CHECKING:
    from ttr.theories.theory import Theory

Act: TypeAlias = Callable[[TypeNode, Model], tuple[Object, Model]]
"""Makes a move of a type: the event, and the model that has it."""

MOVES = 100
"""How many moves of its own a game may make in a turn."""


@dataclass(frozen=True, eq=False)
class Turn(NotebookValue):
    """A turn: what happened, what the game said in answer, and the run.

    `event` is what was given, `heard` the object that was played, None if nothing
    happened; `said` are the game's own moves in order, each as a judgement that it is
    of the planned type. The run has the state and the model after the turn, and the
    steps of this turn only; `before` has those before it, and no steps.

    >>> from ttr import Ind
    >>> from ttr.semantics.gameboards import kos
    >>> game = kos.game(Model().given("a", Ind).given("b", Ind), "a", "b")
    >>> turn = game.take(game.begin(), kos.utterance(kos.greet("b", "a")))
    >>> print([str(step.rule) for step in turn.trace])
    ['take_turn', 'hear', 'open_with_greeting']
    >>> print(turn.state.moves)
    (Pred('greet', Basic('Ind'), Basic('Ind'))('b', 'a'),)
    """

    event: object
    heard: Object | NBest
    said: tuple[Judgement, ...]
    run: Run
    before: Run = field(repr=False)

    @property
    def state(self) -> Record:
        """The state after the turn."""
        return self.run.state

    @property
    def model(self) -> Model:
        """The model after the turn."""
        return self.run.model

    @property
    def trace(self) -> tuple[Step, ...]:
        """The rules of this turn."""
        return self.run.trace

    def _shown_as_(self) -> Part:
        return below(
            beside(Text(">", "strong"), event_shown(self.heard)),
            trace_shown(self.trace),
            *[beside(Text("<", "strong"), Value(move)) for move in self.said],
            Fold("the state after it", Value(self.state, before=self.before.state)),
        )

    def __str__(self) -> str:
        happened = "nothing" if self.heard is None else format_event(self.heard)
        lines = [f"> {happened}", *map(str, self.trace)]
        return "\n".join(
            [*lines, *(f"< {notation(move.sit)} : {move.type}" for move in self.said)]
        )


@dataclass(frozen=True, eq=False, repr=False)
class Game(NotebookValue):
    """A dialogue theory that can be played: a type of states, a start, an algorithm.

    `agenda` is the path of the list of types of the moves to be made next, if the game
    makes any. `hears` are the types of the events from outside; by default, all that a
    rule takes. `act` makes a planned move; by default, an event of its type is created.
    A game with a language reads texts by `hear` and words its moves by `say`; `watch`
    is given each step before the game goes on from it, and may take its time. Raises
    `UpdateError` if the start is not of the type.

    >>> from ttr import Theory
    >>> from ttr.updates import first, update
    >>> fetch = Theory.parse(r'''
    ...     basic Ind
    ...     object h, s : Ind
    ...     pred pick_up(Ind, Ind)
    ...     Picking := [e : pick_up(h, s)]
    ...     Board := [agenda : list(RecType)]
    ...     Idle := [agenda = [] : list(RecType)]
    ...     Busy := [agenda = [Picking] : list(RecType)]
    ...     plan := \\r:Idle. Busy
    ...     done := \\r:Busy. \\e:Picking. Idle
    ... ''')
    >>> rules = first(update(fetch.done, "done"), update(fetch.plan, "plan"))
    >>> game = Game("fetch", fetch.Board, {"agenda": []}, rules, Model(fetch), "agenda")
    >>> print(game.take(game.begin(), None))
    > nothing
    plan
      agenda: + [e : pick_up(h, s)]
    done
      agenda: − [e : pick_up(h, s)]
    < {e = s1} : [e : pick_up(h, s)]
    """

    name: str
    type: RecordType
    start: Record
    algorithm: Algorithm
    model: Model = field(default_factory=Model)
    agenda: str | None = None
    hears: tuple[TypeNode, ...] = ()
    act: Act | None = None
    hear: Callable[[str], object] | None = None
    say: Callable[[Judgement], str] | None = None
    theory: Theory | None = None
    watch: Watch | None = None

    def __post_init__(self) -> None:
        check_strategies("a game", (self.algorithm,))
        as_model(self.model)
        if self.agenda is not None and not isinstance(self.agenda, str):
            raise UpdateError(
                f"an agenda is named by its path, found {excerpt(self.agenda)}"
            )
        if not isinstance(self.hears, tuple | list):
            raise UpdateError(
                f"a game hears events of a list of types, found {excerpt(self.hears)}"
            )
        object.__setattr__(self, "hears", tuple(map(as_type, self.hears)))
        object.__setattr__(self, "start", freeze(self.start))
        check_state(self.start, self.type, self.model, "at the start")
        if self.agenda is not None:
            self.planned(self.start)

    def __repr__(self) -> str:
        return f"<Game {self.name}: {self.algorithm}>"

    def _shown_as_(self) -> Part:
        rows: list[tuple[str, Part]] = [
            ("states", Value(self.type)),
            ("start", Value(self.start)),
        ]
        if self.agenda is not None:
            rows.append(("acts on", Text(self.agenda, "code")))
        rows += [("hears", Value(T)) for T in self.hears]
        about = below(
            beside(Text(self.name, "strong"), Text("a game", "quiet")),
            Fields(tuple(rows)),
            Fold("the order of its rules", Text(str(self.algorithm), "code")),
            Fold(
                count_of(len(self.rules), "rule"),
                rules_shown(self.rules),
                len(self.rules) <= FEW,
            ),
        )
        return about if self.theory is None else In(self.theory, about)

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules, each once, in the order in which the algorithm has them."""
        return rules_of(self.algorithm)

    def begin(self) -> Run:
        """The start of a dialogue."""
        return Run(self.start, self.model, ())

    @within_budget
    def take(self, so_far: Run, event: object = None) -> Turn:
        """One turn: the event, then the moves on the agenda.

        The event is an object, an `NBest`, or a type of which an event is created; None
        if nothing happens. Raises `NotHeardError` for an event that no rule could take,
        and the errors of `run`; then nothing is changed.
        """
        if not isinstance(so_far, Run):
            raise UpdateError(
                f"a turn goes on from a run, as begin() gives one, found "
                f"{excerpt(so_far)}"
            )
        before = so_far._replace(trace=())
        happened, model = self._realise_event(event, so_far.model)
        after = self._play_event(Run(so_far.state, model, ()), happened, None)
        said: list[Judgement] = []
        after = self._make_moves(after, said)
        return Turn(event, happened, tuple(said), after, before)

    def _make_moves(self, after: Run, said: list[Judgement]) -> Run:
        """The run after the moves on the agenda, which are appended to `said`."""
        while planned := self.planned(after.state):
            if len(said) >= MOVES:
                raise _endless_moves(after)
            move, model = self._make_move(planned[0], after.model)
            ready = after._replace(model=model)
            following = self._play_event(ready, move, after.model)
            if len(following.trace) == len(after.trace):
                raise endless(
                    f"no rule takes the move {planned[0]}, so it stays on the agenda",
                    after,
                    "write a rule that takes it off when it has been made",
                )
            said.append(self._judge_move(move, planned[0], model))
            after = following
        return after

    def play(self, events: Iterable[object]) -> tuple[Turn, ...]:
        """The turns of a dialogue from the start."""
        if isinstance(
            events, str | bytes | Record | NBest | TypeNode
        ) or not isinstance(events, Iterable):
            raise UpdateError(f"events are a list of them, found {excerpt(events)}")
        turns: list[Turn] = []
        so_far = self.begin()
        for event in events:
            turns.append(self.take(so_far, event))
            so_far = turns[-1].run
        return tuple(turns)

    def _play_event(
        self, so_far: Run, event: Object | NBest, judged_in: Model | None
    ) -> Run:
        """The run after an event.

        The state is checked first, unless it was judged in a model with the same facts.
        """
        state, model, _ = so_far
        if judged_in is None or model.facts is not judged_in.facts:
            check_state(state, self.type, model, "before the first rule")
        return continue_run(self.algorithm, so_far, event, self.type, self.watch)

    # --- events ---

    def _realise_event(
        self, event: object, model: Model
    ) -> tuple[Object | NBest, Model]:
        """The event as an object, and the model in which it happens."""
        if isinstance(event, NBest):
            return self._realise_alternatives(event, model)
        if isinstance(event, TypeNode):
            event, model = model.create(event)
        happened = freeze(event)
        self._check_heard(happened, model)
        return happened, model

    def _realise_alternatives(self, event: NBest, model: Model) -> tuple[NBest, Model]:
        """The alternatives as objects; events are created of those that are types."""
        made: list[tuple[Object, float]] = []
        for one, p in event:
            if isinstance(one, TypeNode):
                one, model = model.create(one)
            self._check_heard(one, model)
            made.append((one, p))
        return NBest(tuple(made)), model

    def _check_heard(self, event: Object, model: Model) -> None:
        """Refuse an event that no rule could take."""
        if event is None:
            return
        types = self.hears or event_types(self.rules)
        if any(is_certain(model.facts, event, T) for T in types):
            return
        if any(model.judge(event, T).p != REFUTED for T in types):
            return
        wanted = " or ".join(map(str, types)) or "none at all"
        raise NotHeardError(
            f"{notation(event)} is no event that the game {self.name} takes: expected "
            f"{wanted}"
        )

    # --- own moves ---

    def planned(self, state: Record) -> tuple[TypeNode, ...]:
        """The types of the moves to be made in a state, the next one first."""
        if self.agenda is None:
            return ()
        try:
            planned = state[self.agenda]
        except (KeyError, TTRError):
            raise UpdateError(
                f"the game {self.name} acts on {self.agenda}, which its state lacks",
                hint=suggestion(self.agenda, state),
            ) from None
        if isinstance(planned, tuple) and all(
            isinstance(one, TypeNode) for one in planned
        ):
            return planned
        raise UpdateError(
            f"an agenda is a list of types, but {self.agenda} is {kind_of(planned)}"
        )

    def _make_move(self, planned: TypeNode, model: Model) -> tuple[Object, Model]:
        if self.act is None:
            return model.create(planned)
        with blame("to make the move", planned):
            made = self.act(planned, model)
        match made:
            case (event, Model() as after):
                return freeze(event), after
        raise UpdateError(
            f"the act of the game {self.name} gives an event and a model, but it gave "
            f"{excerpt(made)}"
        )

    def _judge_move(self, move: Object, T: TypeNode, model: Model) -> Judgement:
        """The judgement that a move is of the planned type.

        An `act` may have made something else. Where it is certain, its reasons are
        derived when they are asked for.
        """
        if not is_certain(model.facts, move, T):
            return model.judge(move, T)
        return Judgement(move, T, CERTAIN, lambda: model.judge(move, T).why, model)


def _endless_moves(after: Run) -> EndlessError:
    """The error that an agenda does not become empty, and which rules repeat."""
    circle = " → ".join(_repeating_names([str(step.rule) for step in after.trace]))
    return endless(
        f"the agenda is not empty after {MOVES} moves in a turn: {circle} → …",
        after,
        "let a rule take the last move off without planning another",
    )


def _repeating_names(names: Sequence[str]) -> Sequence[str]:
    """The names that are repeated at the end of a list; otherwise its last few.

    >>> _repeating_names(["a", "b", "c", "b", "c", "b", "c"])
    ['b', 'c']
    >>> _repeating_names(["a", "b", "c"])
    ['a', 'b', 'c']
    >>> _repeating_names(["a", "b", "c", "d"])
    ['b', 'c', 'd']
    """
    for size in range(1, len(names) // 2 + 1):
        if names[-size:] == names[-2 * size : -size]:
            return names[-size:]
    return names[-3:]


def event_shown(event: object) -> Part:
    """An event, or its alternatives with their probabilities."""
    if event is None:
        return Text("nothing", "quiet")
    if not isinstance(event, NBest):
        return Value(event)
    return table(
        ("perhaps", "p"), list(event), lambda it: (Value(it[0]), Text(f"{it[1]:g}"))
    )


def format_event(event: object) -> str:
    """An event in the notation, or its alternatives."""
    return str(event) if isinstance(event, NBest) else notation(event)
