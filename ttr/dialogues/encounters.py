"""Encounters: several participants, each with their own board, who act and look on.

Each plays their own game: an event is taken by the rules of everyone who sees it. A
participant is licensed to create an event (Cooper 2023, chapter 2) if its type is next
on their agenda and they can bring it about. They act in turn or all at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ttr.computing.subtyping import subtype
from ttr.errors import TTRError, UpdateError, suggestion
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.judging.type_acts import Create, perform
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.syntax import TypeNode, as_type, kind_of
from ttr.updates.games import Game
from ttr.updates.running import Run, Step, run

__all__ = ["Encounter", "Happening", "Participant", "meeting"]


@dataclass(frozen=True, eq=False)
class Participant:
    """Somebody who plays a game on their own board.

    `does` is the type of the events that they can bring about: what is on the agenda
    and not of this type is for others to do.

    >>> from ttr import Ind, Model, rectype
    >>> from ttr.semantics.gameboards import cooper
    >>> M = Model().given("a", Ind).given("b", Ind)
    >>> bo = Participant("b", cooper.game("b", M), does=rectype(spkr=Ind @ "b"))
    >>> print(meeting(bo).board("b").private)
    {agenda = [], self = b}
    """

    name: str
    game: Game
    does: TypeNode

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise UpdateError(f"a participant has a name, found {kind_of(self.name)}")
        as_type(self.does)
        if not isinstance(self.game, Game):
            raise UpdateError(f"a participant plays a game, found {kind_of(self.game)}")
        if self.game.agenda is None:
            raise UpdateError(
                f"{self.name} has no agenda to act on: the game {self.game.name} "
                "names none",
                hint="say where it is: Game(…, agenda='agenda')",
            )

    def licensed_act(self, board: Run) -> Create | None:
        """The act that their board licenses: to create what is first on the agenda."""
        planned = self.game.planned(board.state)
        if not planned:
            return None
        theory = board.model.theory
        able = subtype(planned[0], self.does, theory).yes
        return Create(planned[0]) if able else None


@dataclass(frozen=True, eq=False)
class Happening:
    """One step of an encounter: who did what, and how it changed each board.

    `by` and `event` are None where only rules without an event applied.

    >>> from ttr import Ind, Model, Pred, rectype
    >>> from ttr.semantics.gameboards import cooper
    >>> M = Model().given("a", Ind).given("b", Ind)
    >>> says = cooper.asserting("a", "b", rectype(e=Pred("run", Ind)("sam")))
    >>> ann = Participant("a", cooper.game("a", M, [says]), rectype(spkr=Ind @ "a"))
    >>> bo = Participant("b", cooper.game("b", M), rectype(spkr=Ind @ "b"))
    >>> [it.by for it in meeting(ann, bo).in_turn().history]
    ['a', 'b']
    """

    by: str | None
    event: Judgement | None
    boards: dict[str, Record]
    traces: dict[str, tuple[Step, ...]]

    def __str__(self) -> str:
        head = "nothing happens"
        if self.event is not None:
            head = f"{self.by}: {notation(self.event.sit)} : {self.event.type}"
        lines = [head]
        for name, steps in self.traces.items():
            lines += [f"  {name} | {line}" for step in steps for line in _lines(step)]
        return "\n".join(lines)


def _lines(step: Step) -> list[str]:
    return str(step).split("\n")


@dataclass(frozen=True, eq=False)
class Encounter:
    """Participants with their boards, and what has happened; built by `meeting`.

    `in_turn` and `in_step` give the encounter after one more round.

    >>> from ttr import Ind, Model, Pred, rectype
    >>> from ttr.semantics.gameboards import cooper
    >>> M = Model().given("a", Ind).given("b", Ind)
    >>> says = cooper.asserting("a", "b", rectype(e=Pred("run", Ind)("sam")))
    >>> ann = Participant("a", cooper.game("a", M, [says]), rectype(spkr=Ind @ "a"))
    >>> bo = Participant("b", cooper.game("b", M), rectype(spkr=Ind @ "b"))
    >>> after = meeting(ann, bo).in_turn()
    >>> print(after.board("b").shared.commitments)
    [e : run(sam)]
    """

    participants: tuple[Participant, ...]
    boards: tuple[Run, ...]
    history: tuple[Happening, ...] = ()

    def board(self, name: str) -> Record:
        """The board of a participant; raises `UpdateError` for an unknown name."""
        for one, board in zip(self.participants, self.boards, strict=True):
            if one.name == name:
                return board.state
        names = [one.name for one in self.participants]
        raise UpdateError(f"{name} takes no part", hint=suggestion(name, names))

    @property
    def agree(self) -> bool:
        """Are all boards the same?"""
        return len({board.state for board in self.boards}) == 1

    def in_turn(self) -> Encounter:
        """A round in which everyone who is licensed acts, one after the other.

        The others see each act before it is their turn.
        """
        current = self
        for index in range(len(self.participants)):
            ready = current._after_tacit_rules()
            act = ready.participants[index].licensed_act(ready.boards[index])
            current = ready if act is None else ready._after_act(index, act)
        return current

    def in_step(self) -> Encounter:
        """A round in which all who are licensed act at once; then everyone sees it."""
        ready = self._after_tacit_rules()
        pairs = zip(ready.participants, ready.boards, strict=True)
        acts = [one.licensed_act(board) for one, board in pairs]
        current = ready
        for index, act in enumerate(acts):
            current = current if act is None else current._after_act(index, act)
        return current

    @cached_property
    def is_idle(self) -> bool:
        """Is nobody licensed to do anything, even after the rules without an event?"""
        ready = self._after_tacit_rules()
        pairs = zip(ready.participants, ready.boards, strict=True)
        return all(one.licensed_act(board) is None for one, board in pairs)

    def _after_tacit_rules(self) -> Encounter:
        """After the rules without an event, for everyone whose agenda is empty."""
        boards = [
            board if one.game.planned(board.state) else _continue_board(one, board, ())
            for one, board in zip(self.participants, self.boards, strict=True)
        ]
        return self._with_boards(boards, None, None)

    def _after_act(self, index: int, act: Create) -> Encounter:
        """After a participant has created an event and everyone has seen it."""
        by = self.participants[index]
        made = perform(act, _with_fresh_names(self.boards, index))
        event, T = made.answer.sit, act.type
        boards = []
        for number, (one, board) in enumerate(
            zip(self.participants, self.boards, strict=True)
        ):
            model = made.model
            if number != index:
                model = _model_of_witness(one, board.model, event, T, by)
            boards.append(_continue_board(one, board._replace(model=model), (event,)))
        return self._with_boards(boards, by.name, made.answer)

    def _with_boards(
        self, boards: Sequence[Run], by: str | None, event: Judgement | None
    ) -> Encounter:
        """The encounter with these boards, whose traces belong to one step."""
        names = [one.name for one in self.participants]
        if by is None and not any(board.trace for board in boards):
            return self
        happening = Happening(
            by,
            event,
            {name: b.state for name, b in zip(names, boards, strict=True)},
            {name: b.trace for name, b in zip(names, boards, strict=True)},
        )
        kept = tuple(board._replace(trace=()) for board in boards)
        return replace(self, boards=kept, history=(*self.history, happening))

    def __str__(self) -> str:
        return "\n".join(map(str, self.history))


def meeting(*participants: Participant) -> Encounter:
    """The encounter of participants, each at the start of their game.

    Raises `UpdateError` where two have the same name.

    >>> from ttr import Theory
    >>> from ttr.updates import first, update
    >>> chat = Theory.parse(r'''
    ...     basic Ind
    ...     object a, b : Ind
    ...     pred greet(Ind, Ind)
    ...     Hi := [e : greet('a', 'b')]
    ...     Back := [e : greet('b', 'a')]
    ...     Board := [agenda : list(RecType)]
    ...     planned := \\s:[agenda = [Hi] : list(RecType)]. \\e:Hi.
    ...                [agenda = [Back] : list(RecType)]
    ...     done := \\s:[agenda = [Back] : list(RecType)]. \\e:Back.
    ...             [agenda = [] : list(RecType)]
    ... ''')
    >>> rules = first(update(chat.planned, "reply"), update(chat.done, "done"))
    >>> M, start = Model(chat), {"agenda": [chat.Hi]}
    >>> game = Game("greeting", chat.Board, start, rules, M, "agenda")
    >>> a, b = Participant("a", game, chat.Hi), Participant("b", game, chat.Back)
    >>> after = meeting(a, b).in_turn()
    >>> print(*[f"{one.by}: {one.event.type}" for one in after.history], sep="\\n")
    a: [e : greet(a, b)]
    b: [e : greet(b, a)]
    >>> after.agree, after.is_idle
    (True, True)
    """
    for one in participants:
        if not isinstance(one, Participant):
            raise UpdateError(f"a meeting is of participants, found {kind_of(one)}")
    names = [one.name for one in participants]
    if not names or len(set(names)) < len(names):
        raise UpdateError(
            f"participants have names of their own, found {', '.join(names) or 'none'}"
        )
    return Encounter(participants, tuple(one.game.begin() for one in participants))


def _model_of_witness(
    one: Participant, model: Model, event: Object, T: TypeNode, by: Participant
) -> Model:
    """The model of a participant who has seen somebody act."""
    try:
        return model.given(event, T)
    except TTRError as error:
        raise UpdateError(
            f"{one.name} cannot take {notation(event)} : {T}, which {by.name} did: "
            f"{error.message}"
        ) from error


def _continue_board(one: Participant, board: Run, events: Sequence[object]) -> Run:
    game = one.game
    return run(
        game.algorithm,
        board.state,
        type=game.type,
        model=board.model,
        events=events,
    )


def _with_fresh_names(boards: Sequence[Run], index: int) -> Model:
    """The actor's model; names that it makes up are not yet known on any board."""
    most = max(board.model.facts.created for board in boards)
    mine = boards[index].model
    return Model.of(replace(mine.facts, created=most))
