"""Properties of dialogues: what they say, and how a dialogue breaks them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.testing.coverage import Coverage
from ttr.testing.strategies.discourse_roles import Roles

if TYPE_CHECKING:
    from ttr.testing.properties.pending_items import DialogueCounts, Finding

Breaches: TypeAlias = Iterator[tuple[int, str]]
"""How a dialogue breaks a property, in order: the number of the turn, and why."""


@dataclass(frozen=True)
class Property:
    """A property that update rules should have, checked on dialogues.

    `says` states it in a line. `each` finds where a dialogue breaks it. `overall` says
    why many dialogues together break it, by the rules that they covered; so does
    `across`, by what they put on and took off the lists of the state. `shortfall` says
    what the dialogues lack for `overall` to judge, as in "90 of 5,000 turns"; it is
    empty if they do not. `needs` are the roles without which it cannot be checked.

    >>> def find_long_states(dialogue, roles):
    ...     for turn, state in enumerate(dialogue.states):
    ...         if len(state.qud) > 3:
    ...             yield turn, "too much is under discussion"
    >>> short = Property("M1", "short", "QUD stays short.", each=find_long_states)
    >>> print(short)
    M1 short
    """

    name: str
    title: str
    says: str
    each: Callable[[Dialogue, Roles], Breaches] | None = None
    overall: Callable[[Coverage], str] | None = None
    across: Callable[[DialogueCounts], Iterator[Finding]] | None = None
    shortfall: Callable[[Coverage], str] | None = None
    needs: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.name} {self.title}"

    def missing_roles(self, roles: Roles) -> tuple[str, ...]:
        """The roles that it needs and that no field of the state plays."""
        return tuple(role for role in self.needs if getattr(roles, role) is None)

    def breach(self, dialogue: Dialogue, roles: Roles) -> Breach | None:
        """Where the dialogue first breaks it; None if it does not."""
        if self.each is None or self.missing_roles(roles):
            return None
        for turn, why in self.each(dialogue, roles):
            return Breach(self, turn, why)
        return None


@dataclass(frozen=True)
class Breach:
    """That a dialogue breaks a property, in which turn, and why.

    >>> from ttr.testing import ALL
    >>> print(Breach(ALL[0], 2, "it changed qud in place"))
    P2 pure rules: a rule never changes the state that it is given, whether it applies
    or not.
    turn 2: it changed qud in place
    """

    property: Property
    turn: int
    why: str

    def __str__(self) -> str:
        return f"{self.property}: {self.property.says}\nturn {self.turn}: {self.why}"


def select_properties(
    properties: object, known: tuple[Property, ...]
) -> tuple[Property, ...]:
    """The properties, given as such or by name. Raises `TTRError` for others."""
    if isinstance(properties, str | Property):
        properties = (properties,)
    by_name = {one.name: one for one in known}
    found = []
    for one in properties:  # type: ignore[attr-defined]
        if isinstance(one, str) and one in by_name:
            found.append(by_name[one])
        elif isinstance(one, Property):
            found.append(one)
        else:
            names = ", ".join(sorted(by_name, key=lambda name: int(name[1:])))
            raise TTRError(f"a property is one of {names}, or one's own, found {one!r}")
    return tuple(found)
