"""What is put on and taken off lists of the state in many dialogues: P25 and P26.

One dialogue cannot show that a question is never answered, only that it has not been
answered yet. But what hundreds of dialogues never take up, although the tutor does all
that can be done, will never be taken up.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from ttr.dialogues.dialogue import Dialogue
from ttr.testing.event_subjects import (
    agents_of,
    is_same,
    item_type,
    items_added,
    items_at,
    mentions,
    mentions_of_sort,
    speaker_of,
)
from ttr.testing.properties.property import Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.interning import identity
from ttr.types.objects import Object, Record
from ttr.types.syntax import PType
from ttr.updates.games import Game
from ttr.updates.running import Step

ENOUGH = 25
"""How often something has to happen before what never happens counts as a fault."""

STACKS = ("qud", "issues")
"""Labels of lists of questions that are stacks: the latest question comes first."""


@dataclass(frozen=True)
class Finding:
    """What many dialogues show together, and why; with one of them, and its turn."""

    dialogue: Dialogue
    turn: int
    why: str


@dataclass
class FlowCounts:
    """How often items were put on and taken off one list, and at which end."""

    put: int = 0
    taken: int = 0
    first: tuple[Dialogue, int] | None = None
    taken_by: Counter[str] = field(default_factory=Counter)
    pushed: Counter[str] = field(default_factory=Counter)
    popped: Counter[str] = field(default_factory=Counter)
    wrong_end: tuple[Dialogue, int] | None = None
    last: tuple[Dialogue, int] | None = None
    names_put: Counter[str] = field(default_factory=Counter)
    names_taken: Counter[str] = field(default_factory=Counter)
    first_of_name: dict[str, tuple[Dialogue, int]] = field(default_factory=dict)


@dataclass
class AnswerCounts:
    """How often a rule removes questions by which acts: that name them, or do not."""

    naming: Counter[str] = field(default_factory=Counter)
    nameless: Counter[str] = field(default_factory=Counter)
    example: tuple[Dialogue, int] | None = None


@dataclass
class DialogueCounts:
    """Counts of what was put on and taken off the lists that play a role in a game."""

    game: Game
    roles: Roles
    dialogues: int = 0
    by_path: dict[str, FlowCounts] = field(default_factory=dict)
    by_rule: dict[str, AnswerCounts] = field(default_factory=dict)
    own: Counter[bool] = field(default_factory=Counter)
    own_example: tuple[Dialogue, int] | None = None
    without_effect: Counter[str] = field(default_factory=Counter)
    """How often a rule took an event about a question, and left it and facts alone."""

    def add(self, dialogue: Dialogue) -> None:
        """Count a dialogue."""
        self.dialogues += 1
        roles = self.roles
        asked_by: dict[object, str] = {}
        for number, trial in enumerate(dialogue.trials, start=1):
            for step in trial.steps:
                if step.before is step.after:
                    self._count_without_effect(step)
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
        flow = self.by_path.setdefault(path, FlowCounts())
        here = (dialogue, turn)
        if added := items_added(before, after):
            flow.put += 1
            flow.first = _earlier(flow.first, here)
            for name in _names_among(added):
                flow.names_put[name] += 1
                first = flow.first_of_name.get(name)
                flow.first_of_name[name] = _earlier(first, here)
        if removed := items_added(after, before):
            flow.taken += 1
            flow.taken_by[step.rule.name] += 1
            flow.last = _earlier(flow.last, here)
            flow.names_taken.update(_names_among(removed))
        if before and len(after) == len(before) + 1:
            flow.pushed[_end_of_difference(before, after)] += 1
        if len(before) > 1 and len(after) == len(before) - 1:
            flow.popped[_end_of_difference(after, before)] += 1
            flow.wrong_end = _earlier(flow.wrong_end, here)

    def _count_answers(
        self,
        step: Step,
        dialogue: Dialogue,
        turn: int,
        asked_by: dict[object, str],
    ) -> None:
        """Count who asks a question, and who removes it with what event."""
        path = str(self.roles.qud)
        before, after = items_at(step.before, path), items_at(step.after, path)
        if not isinstance(step.event, Record):
            return
        if identity(before) == identity(after):
            self._count_without_effect(step)
            return
        # Nobody asked the question that a rule without an event puts.
        takes = step.rule.on is not None
        agents = agents_of(self.game)
        who = speaker_of(step.event, step.model, agents) if takes else None
        said = [identity(one) for one in mentions(step.event, step.model)]
        for item in items_added(before, after):
            asked_by.pop(identity(item), None)
            if who is not None and identity(item) in said:
                asked_by[identity(item)] = who
        for item in items_added(after, before):
            asker = asked_by.get(identity(item))
            if who is not None and asker is not None:
                self.own[who == asker] += 1
                if who == asker:
                    self.own_example = _earlier(self.own_example, (dialogue, turn))
            if who is None and asker is not None:
                self.own[False] += 1  # it may be removed without an answer
            if takes and isinstance(item, str):
                self._count_naming(item, step, (dialogue, turn))

    def _count_without_effect(self, step: Step) -> None:
        """Count events about questions, as long as nothing was ever agreed on."""
        qud, takes = self.roles.qud, step.rule.on is not None
        if qud is None or not takes or self.roles.commitments in self.by_path:
            return
        asked = set(map(identity, items_at(step.before, qud)))
        if asked and any(
            identity(one) in asked for one in mentions(step.event, step.model)
        ):
            self.without_effect[step.rule.name] += 1

    def _count_naming(self, item: str, step: Step, here: tuple[Dialogue, int]) -> None:
        said = mentions(step.event, step.model)
        act = " ".join(sorted(one.pred.name for one in said if isinstance(one, PType)))
        found = self.by_rule.setdefault(step.rule.name, AnswerCounts())
        T = item_type(self.game.type, str(self.roles.qud))
        if any(is_same(item, one) for one in said):
            found.naming[act] += 1
        elif not mentions_of_sort(item, T, step.event, step.model, self.game):
            found.nameless[act] += 1
            found.example = _earlier(found.example, here)


def _names_among(items: Iterable[Object]) -> list[str]:
    return [one for one in items if isinstance(one, str)]


def _earlier(
    known: tuple[Dialogue, int] | None, found: tuple[Dialogue, int]
) -> tuple[Dialogue, int]:
    """The one of two turns that comes earlier, in its dialogue up to there."""
    if known is not None and known[1] <= found[1]:
        return known
    dialogue, turn = found
    return Dialogue(dialogue.game, dialogue.trials[:turn]), turn


def _end_of_difference(shorter: tuple[Object, ...], longer: tuple[Object, ...]) -> str:
    """The end at which the longer list has one more: first, last, either or none."""
    first = identity(longer[1:]) == identity(shorter)
    last = identity(longer[:-1]) == identity(shorter)
    return "either" if first and last else "first" if first else "last" if last else ""


# --- P25 -----------------------------------------------------------------------------


def _check_emptying(flows: DialogueCounts) -> Iterator[Finding]:
    for role in ("pending", "agenda", "qud"):
        path = getattr(flows.roles, role)
        flow = flows.by_path.get(path) if path is not None else None
        if flow is not None and flow.put >= ENOUGH and not flow.taken and flow.first:
            why = (
                f"what is put on {path} is never taken off: "
                f"it was put there {flow.put} times in {flows.dialogues} dialogues"
            )
            yield Finding(*flow.first, why)
        elif flow is not None:
            yield from _names_that_stay(flow, path, flows.dialogues)


def _names_that_stay(flow: FlowCounts, path: str, dialogues: int) -> Iterator[Finding]:
    """Objects that are put on a list, and never taken off as others are."""
    for name, count in sorted(flow.names_put.items()):
        if count >= ENOUGH and not flow.names_taken[name]:
            why = (
                f"{name} is never taken off {path}: "
                f"it was put there {count} times in {dialogues} dialogues"
            )
            yield Finding(*flow.first_of_name[name], why)


# --- P26 -----------------------------------------------------------------------------


def _check_answering(flows: DialogueCounts) -> Iterator[Finding]:
    yield from _rules_that_accept_anything(flows)
    yield from _questions_from_the_wrong_end(flows)
    yield from _questions_without_effect(flows)
    yield from _questions_answered_by_their_askers(flows)


def _rules_that_accept_anything(flows: DialogueCounts) -> Iterator[Finding]:
    """Rules that remove a question after acts that name it, but after others, too."""
    for name, found in flows.by_rule.items():
        acts = set(found.nameless) - set(found.naming)
        count = sum(found.nameless[act] for act in acts)
        if acts and found.naming and count >= ENOUGH // 5 and found.example:
            answer, other = sorted(found.naming)[0], sorted(acts)[0]
            why = f"{name} takes {other} for an answer, just like {answer}"
            yield Finding(*found.example, why)


def _questions_from_the_wrong_end(flows: DialogueCounts) -> Iterator[Finding]:
    """Questions that are put on one end of a stack and taken off at the other."""
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
            yield Finding(*flow.wrong_end, why)


def _questions_without_effect(flows: DialogueCounts) -> Iterator[Finding]:
    """Questions that are removed although nothing is ever agreed on."""
    qud, agreed = flows.roles.qud, flows.roles.commitments
    if qud is None or agreed is None or agreed in flows.by_path:
        return
    flow = flows.by_path.get(qud)
    if flow is not None and flow.taken >= ENOUGH and flow.last:
        why = (
            f"questions leave {qud}, {flow.taken} times in {flows.dialogues} "
            f"dialogues, but nothing is ever put on {agreed}: they are taken off by "
            f"{_names_of(flow.taken_by)}"
        )
        if flows.without_effect:
            why += (
                f"; events about a question leave it, and {agreed}, as they are in "
                f"{_names_of(flows.without_effect)}"
            )
        yield Finding(*flow.last, why)


def _names_of(rules: Counter[str]) -> str:
    """The names of the rules, the most frequent first."""
    return ", ".join(name for name, _ in rules.most_common())


def _questions_answered_by_their_askers(flows: DialogueCounts) -> Iterator[Finding]:
    """Questions that are answered only by those who asked them."""
    if flows.own[True] < ENOUGH or flows.own[False] or not flows.own_example:
        return
    if len(agents_of(flows.game)) > 1:
        why = "a question is only ever answered by the one who asked it"
        yield Finding(*flows.own_example, why)


EMPTIES = Property(
    "P25",
    "pending empties",
    "what is asked, planned or pending does not always stay for ever.",
    across=_check_emptying,
)
ANSWERED = Property(
    "P26",
    "questions are answered",
    "questions are removed by what answers or rejects them, the latest one first.",
    across=_check_answering,
    needs=("qud",),
)
