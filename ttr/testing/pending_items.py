"""What comes and goes over many dialogues: P25, P26 and P27.

One dialogue cannot show that a question is never answered, only that it has not been so
far. Over hundreds of dialogues in which a tutor does all that there is to do, what was
never taken up will not be.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from ttr.dialogues.dialogue import Dialogue
from ttr.testing.event_subjects import (
    agents_of,
    item_type,
    items_at,
    kin,
    mentions,
    same,
    speaker_of,
)
from ttr.testing.groundedness import added
from ttr.testing.properties import Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.syntax import Object, PType, Record, identity
from ttr.updates.games import Game
from ttr.updates.running import Step

__all__ = ["ANSWERED", "EMPTIES", "Flows", "Seen"]

ENOUGH = 25
"""How often something has to happen before it says something that nothing else did."""

STACKS = ("qud", "issues")
"""Lists of questions that are stacks in the literature: the latest is the first."""


@dataclass(frozen=True)
class Seen:
    """Something that dialogues together show: one of them, in which turn, and why."""

    dialogue: Dialogue
    turn: int
    why: str


@dataclass
class Flow:
    """What came to be at one place of the state, and what went from there."""

    put: int = 0
    taken: int = 0
    first: tuple[Dialogue, int] | None = None
    pushed: Counter[str] = field(default_factory=Counter)
    popped: Counter[str] = field(default_factory=Counter)
    wrong_end: tuple[Dialogue, int] | None = None
    last: tuple[Dialogue, int] | None = None


@dataclass
class Answering:
    """By which kinds of events a rule takes questions off: naming them, or nothing."""

    naming: Counter[str] = field(default_factory=Counter)
    nameless: Counter[str] = field(default_factory=Counter)
    example: tuple[Dialogue, int] | None = None


@dataclass
class Flows:
    """Counts of what came and went in the dialogues of one game, by the roles."""

    game: Game
    roles: Roles
    dialogues: int = 0
    by_path: dict[str, Flow] = field(default_factory=dict)
    by_rule: dict[str, Answering] = field(default_factory=dict)
    own: Counter[bool] = field(default_factory=Counter)
    own_example: tuple[Dialogue, int] | None = None

    def add(self, dialogue: Dialogue) -> None:
        """Counts a dialogue."""
        self.dialogues += 1
        roles = self.roles
        asked_by: dict[object, str] = {}
        for number, trial in enumerate(dialogue.trials, start=1):
            for step in trial.steps:
                if step.before is step.after:
                    continue
                for role in ("qud", "pending", "agenda", "commitments"):
                    path = getattr(roles, role)
                    if path is not None:
                        self._count(path, step, dialogue, number)
                if roles.qud is not None:
                    self._count_answers(step, dialogue, number, asked_by)

    def _count(self, path: str, step: Step, dialogue: Dialogue, turn: int) -> None:
        before, after = items_at(step.before, path), items_at(step.after, path)
        if before is after:
            return
        flow = self.by_path.setdefault(path, Flow())
        here = (dialogue, turn)
        if added(before, after):
            flow.put += 1
            flow.first = _shorter(flow.first, here)
        if added(after, before):
            flow.taken += 1
            flow.last = _shorter(flow.last, here)
        if before and len(after) == len(before) + 1:
            flow.pushed[_end(before, after)] += 1
        if len(before) > 1 and len(after) == len(before) - 1:
            flow.popped[_end(after, before)] += 1
            flow.wrong_end = _shorter(flow.wrong_end, here)

    def _count_answers(
        self,
        step: Step,
        dialogue: Dialogue,
        turn: int,
        asked_by: dict[object, str],
    ) -> None:
        """Notes who puts a question and who takes it off, and with what."""
        path = str(self.roles.qud)
        before, after = items_at(step.before, path), items_at(step.after, path)
        if before is after or not isinstance(step.event, Record):
            return
        # A rule that takes no event may put a question of its own: nobody asked it.
        takes = step.rule.on is not None
        agents = agents_of(self.game)
        who = speaker_of(step.event, step.model, agents) if takes else None
        said = [identity(one) for one in mentions(step.event, step.model)]
        for item in added(before, after):
            asked_by.pop(identity(item), None)
            if who is not None and identity(item) in said:
                asked_by[identity(item)] = who
        for item in added(after, before):
            asker = asked_by.get(identity(item))
            if who is not None and asker is not None:
                self.own[who == asker] += 1
                if who == asker:
                    self.own_example = _shorter(self.own_example, (dialogue, turn))
            if who is None and asker is not None:
                self.own[False] += 1  # it may go without an answer
            if takes and isinstance(item, str):
                self._count_naming(item, step, (dialogue, turn))

    def _count_naming(self, item: str, step: Step, here: tuple[Dialogue, int]) -> None:
        said = mentions(step.event, step.model)
        act = " ".join(sorted(one.pred.name for one in said if isinstance(one, PType)))
        found = self.by_rule.setdefault(step.rule.name, Answering())
        T = item_type(self.game.type, str(self.roles.qud))
        if any(same(item, one) for one in said):
            found.naming[act] += 1
        elif not kin(item, T, step.event, step.model, self.game):
            found.nameless[act] += 1
            found.example = _shorter(found.example, here)


def _shorter(
    known: tuple[Dialogue, int] | None, found: tuple[Dialogue, int]
) -> tuple[Dialogue, int]:
    """The one of two that happens earlier, cut off after its turn."""
    if known is not None and known[1] <= found[1]:
        return known
    dialogue, turn = found
    return Dialogue(dialogue.game, dialogue.trials[:turn]), turn


def _end(shorter: tuple[Object, ...], longer: tuple[Object, ...]) -> str:
    """At which end a list has one more: first, last, or neither."""
    first = identity(longer[1:]) == identity(shorter)
    last = identity(longer[:-1]) == identity(shorter)
    return "either" if first and last else "first" if first else "last" if last else ""


# --- P25 -----------------------------------------------------------------------------


def _never_empties(flows: Flows) -> Iterator[Seen]:
    for role in ("pending", "agenda", "qud"):
        path = getattr(flows.roles, role)
        flow = flows.by_path.get(path) if path is not None else None
        if flow is not None and flow.put >= ENOUGH and not flow.taken and flow.first:
            why = (
                f"what is put on {path} is never taken off: "
                f"it was put there {flow.put} times in {flows.dialogues} dialogues"
            )
            yield Seen(*flow.first, why)


# --- P26 -----------------------------------------------------------------------------


def _unanswered(flows: Flows) -> Iterator[Seen]:
    yield from _settled_by_anything(flows)
    yield from _at_the_wrong_end(flows)
    yield from _comes_to_nothing(flows)
    yield from _answered_by_the_asker(flows)


def _settled_by_anything(flows: Flows) -> Iterator[Seen]:
    """Rules that take a question off by events that name it, and by other acts."""
    for name, found in flows.by_rule.items():
        acts = set(found.nameless) - set(found.naming)
        count = sum(found.nameless[act] for act in acts)
        if acts and found.naming and count >= ENOUGH // 5 and found.example:
            told, other = sorted(found.naming)[0], sorted(acts)[0]
            why = f"{name} takes {other} for an answer, as it does {told}"
            yield Seen(*found.example, why)


def _at_the_wrong_end(flows: Flows) -> Iterator[Seen]:
    """Questions of which the last to be put is the last to be taken."""
    path = flows.roles.qud
    flow = flows.by_path.get(path) if path is not None else None
    if path is None or flow is None or flow.wrong_end is None:
        return
    if path.rpartition(".")[2].lower() not in STACKS:
        return
    for put, taken in (("last", "first"), ("first", "last")):
        if (
            flow.pushed[put] >= ENOUGH // 5
            and flow.popped[taken] >= ENOUGH // 5
            and not flow.pushed[taken]
            and not flow.popped[put]
        ):
            why = f"a question is put {put} on {path}, but the {taken} one is taken off"
            yield Seen(*flow.wrong_end, why)


def _comes_to_nothing(flows: Flows) -> Iterator[Seen]:
    """Questions that go, of which never anything is agreed on."""
    qud, agreed = flows.roles.qud, flows.roles.commitments
    if qud is None or agreed is None or agreed in flows.by_path:
        return
    flow = flows.by_path.get(qud)
    if flow is not None and flow.taken >= ENOUGH and flow.last:
        why = (
            f"questions go from {qud}, {flow.taken} times in {flows.dialogues} "
            f"dialogues, but nothing is ever put on {agreed}"
        )
        yield Seen(*flow.last, why)


def _answered_by_the_asker(flows: Flows) -> Iterator[Seen]:
    """Questions that only those answer who asked them, though there are others."""
    if flows.own[True] < ENOUGH or flows.own[False] or not flows.own_example:
        return
    if len(agents_of(flows.game)) > 1:
        yield Seen(*flows.own_example, "only who asked a question ever answers it")


EMPTIES = Property(
    "P25",
    "pending empties",
    "what is asked, planned or pending can be taken up: not everything stays for ever.",
    across=_never_empties,
)
ANSWERED = Property(
    "P26",
    "questions are answered",
    "a question goes by what answers it, or rejects it; the latest one is the first.",
    across=_unanswered,
    needs=("qud",),
)
