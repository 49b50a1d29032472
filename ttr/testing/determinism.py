"""Properties of playing the same again, P3 and P20, and in another order, P5."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ttr.dialogues.dialogue import Dialogue, Trial, give, play
from ttr.judging.models import Model
from ttr.testing.properties import Checked, Property
from ttr.testing.single_rules import applied
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.updates.algorithms import (
    Algorithm,
    All,
    Ask,
    ByClass,
    First,
    Maybe,
    Repeat,
    Seq,
)
from ttr.updates.games import Game
from ttr.updates.rules import Rule
from ttr.updates.running import Run, Step

__all__ = ["CONFLUENT", "DETERMINISTIC", "REPLAYS"]


# --- the same again ------------------------------------------------------------------


# The first half of a dialogue is played again from its start, the second from its
# middle: each turn is played twice, and no more.


def _differs(dialogue: Dialogue, roles: Roles) -> Checked:
    again = play(dialogue.game, dialogue.given[: len(dialogue.trials) // 2 + 1])
    pairs = zip(dialogue.trials, again.trials, strict=False)
    for number, (trial, other) in enumerate(pairs, start=1):
        if what := _difference(trial, other):
            yield number, f"played once more, {what}"
            return


def _cannot_go_on(dialogue: Dialogue, roles: Roles) -> Checked:
    """Goes on from the middle with nothing but the state and the model there."""
    middle = len(dialogue.trials) // 2
    rest = dialogue.trials[middle:]
    if not rest:
        return
    so_far = rest[0].before
    for number, trial in enumerate(rest, start=middle + 1):
        other = give(dialogue.game, so_far, trial.given)
        if what := _difference(trial, other):
            yield number, f"continued from turn {middle}, {what}"
            return
        so_far = other.after


def _difference(trial: Trial, other: Trial) -> str:
    """What two trials in which the same was given do not have in common."""
    if str(trial.fault) != str(other.fault):
        return f"it ends with {other.fault}, not with {trial.fault}"
    rules = [step.rule.name for step in trial.steps]
    others = [step.rule.name for step in other.steps]
    if rules != others:
        return f"the rules are {_listed(others)}, not {_listed(rules)}"
    was, now = trial.after.state, other.after.state
    if was != now:
        return f"the state is another: {next(differences(was, now), '')}"
    return ""


def _listed(names: list[str]) -> str:
    return ", ".join(names) or "none"


# --- in another order ----------------------------------------------------------------


def _depends_on_order(dialogue: Dialogue, roles: Roles) -> Checked:
    classes = tuple(_classes(dialogue.game.algorithm))
    if not classes:
        return
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            yield from (
                (number, f"in the class {kind}, {why}")
                for kind, members in classes
                if step.rule in members
                and (why := _order_matters(dialogue.game, members, step))
            )


def _classes(algorithm: Algorithm) -> Iterator[tuple[str, tuple[Rule, ...]]]:
    """The classes of rules whose order is claimed not to matter."""
    match algorithm:
        case ByClass(classes):
            yield from ((kind, rules) for kind, rules in classes if len(rules) > 1)
        case Maybe(part) | Repeat(part):
            yield from _classes(part)
        case First(parts) | All(parts) | Seq(parts) | Ask(parts):
            for part in parts:
                yield from _classes(part)


def _order_matters(game: Game, members: tuple[Rule, ...], step: Step) -> str:
    """Which two rules give different states in one and in the other order, if any."""
    one = step.rule
    for other in members:
        if other is one:
            continue
        this_way = applied(game, step, one, other)
        that_way = applied(game, step, other, one)
        if this_way is None or that_way is None:
            if this_way is not that_way:
                return f"{one} and {other} fail in one order, and not in the other"
        elif not _alike(this_way, that_way, step.model):
            change = next(differences(this_way.state, that_way.state), "")
            return f"{one}, {other} lead elsewhere than {other}, {one}: {change}"
    return ""


def _alike(one: Run, two: Run, before: Model) -> bool:
    """Whether two states are the same, up to the names of what was made up since."""
    if one.state == two.state:
        return True
    return _renamed(one, before) == _renamed(two, before)


def _renamed(after: Run, before: Model) -> str:
    """The state in print, with new names in the order in which they occur."""
    new = after.model.facts.known
    old = before.facts.known
    names: dict[str, str] = {}

    def renamed(word: re.Match[str]) -> str:
        name = word.group()
        if name not in new or name in old:
            return name
        return names.setdefault(name, f"new·{len(names) + 1}")

    return re.sub(r"\w+", renamed, notation(after.state))


DETERMINISTIC = Property(
    "P3",
    "determinism",
    "the same events lead to the same states, by the same rules.",
    _differs,
)
CONFLUENT = Property(
    "P5",
    "confluence",
    "rules of one class lead to the same state in any order, up to new names.",
    _depends_on_order,
)
REPLAYS = Property(
    "P20",
    "replay",
    "a dialogue cut anywhere goes on from its state as it went on.",
    _cannot_go_on,
)
