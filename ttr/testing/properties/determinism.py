"""Playing a dialogue again gives the same, P3 and P20, also in another order, P5."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ttr.dialogues.dialogue import Dialogue, Trial, give, play
from ttr.judging.models import Model
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.single_rules import apply_rules
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.updates.games import Game
from ttr.updates.rules import Rule
from ttr.updates.running import Run, Step
from ttr.updates.update_strategies import Algorithm, ByClass, strategies_in

# --- again ---------------------------------------------------------------------------


# The first half of a dialogue is played again from its start, the second half from its
# middle, so that each turn is played only twice.


def _check_from_start(dialogue: Dialogue, roles: Roles) -> Breaches:
    again = play(dialogue.game, dialogue.given[: len(dialogue.trials) // 2 + 1])
    pairs = zip(dialogue.trials, again.trials, strict=False)
    for number, (trial, other) in enumerate(pairs, start=1):
        if what := _why_different(trial, other):
            yield number, f"played again, {what}"
            return


def _check_from_middle(dialogue: Dialogue, roles: Roles) -> Breaches:
    """Continue from the middle with nothing but the state and the model there."""
    middle = len(dialogue.trials) // 2
    rest = dialogue.trials[middle:]
    if not rest:
        return
    so_far = rest[0].before
    for number, trial in enumerate(rest, start=middle + 1):
        other = give(dialogue.game, so_far, trial.given)
        if what := _why_different(trial, other):
            yield number, f"continued from turn {middle}, {what}"
            return
        so_far = other.after


def _why_different(trial: Trial, other: Trial) -> str:
    """Why two trials of the same event came out differently."""
    if str(trial.fault) != str(other.fault):
        return f"it fails with {other.fault}, not with {trial.fault}"
    rules = [step.rule.name for step in trial.steps]
    others = [step.rule.name for step in other.steps]
    if rules != others:
        return f"the rules are {_format_names(others)}, not {_format_names(rules)}"
    was, now = trial.after.state, other.after.state
    if was != now:
        return f"it leads to another state: {next(differences(was, now), '')}"
    return ""


def _format_names(names: list[str]) -> str:
    return ", ".join(names) or "none"


# --- in another order ----------------------------------------------------------------


def _check_order(dialogue: Dialogue, roles: Roles) -> Breaches:
    classes = tuple(_rule_classes(dialogue.game.algorithm))
    if not classes:
        return
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            yield from (
                (number, f"in the class {kind}, {why}")
                for kind, members in classes
                if step.rule in members
                and (why := _why_order_matters(dialogue.game, members, step))
            )


def _rule_classes(algorithm: Algorithm) -> Iterator[tuple[str, tuple[Rule, ...]]]:
    """The classes of rules whose order is claimed not to matter."""
    for one in strategies_in(algorithm):
        if isinstance(one, ByClass):
            yield from ((kind, rules) for kind, rules in one.classes if len(rules) > 1)


def _why_order_matters(game: Game, members: tuple[Rule, ...], step: Step) -> str:
    """Why the order of two rules of a class matters after all."""
    one = step.rule
    for other in members:
        if other is one:
            continue
        this_way = apply_rules(game, step, one, other)
        that_way = apply_rules(game, step, other, one)
        if this_way is None or that_way is None:
            if this_way is not that_way:
                return f"{one} and {other} fail in one order, but not in the other"
        elif not _are_equal_up_to_names(this_way, that_way, step.model):
            change = next(differences(this_way.state, that_way.state), "")
            return f"{one}, {other} lead elsewhere than {other}, {one}: {change}"
    return ""


def _are_equal_up_to_names(one: Run, two: Run, before: Model) -> bool:
    """Are two states the same, up to the names of objects created since `before`?"""
    if one.state == two.state:
        return True
    return _with_names_numbered(one, before) == _with_names_numbered(two, before)


def _with_names_numbered(after: Run, before: Model) -> str:
    """The state in the notation, with new names numbered in order of occurrence."""
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
    "the same events lead to the same states by the same rules.",
    _check_from_start,
)
CONFLUENT = Property(
    "P5",
    "confluence",
    "the rules of a class lead to the same state in any order, up to new names.",
    _check_order,
)
REPLAYS = Property(
    "P20",
    "replay",
    "a dialogue that is cut anywhere continues from that state as it did before.",
    _check_from_middle,
)
