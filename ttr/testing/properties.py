"""A property of dialogues: its name, what it says, and how a dialogue breaks it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.testing.coverage import Coverage
from ttr.testing.strategies.discourse_roles import Roles

if TYPE_CHECKING:
    from ttr.testing.pending_items import Flows, Seen

__all__ = ["Breach", "Checked", "Property"]

Checked: TypeAlias = Iterator[tuple[int, str]]
"""What breaks a property, in order: the number of the turn, and why."""


@dataclass(frozen=True)
class Property:
    """A property that update rules should have, checked on dialogues.

    `each` tells where one dialogue breaks it, `overall` whether many together do, by
    what they covered, and `across` by what came and went in them. `needs` are the roles
    that a state must have for it to be checked; `says` explains it in a line.
    """

    name: str
    title: str
    says: str
    each: Callable[[Dialogue, Roles], Checked] | None = None
    overall: Callable[[Coverage], str] | None = None
    across: Callable[[Flows], Iterator[Seen]] | None = None
    needs: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.name} {self.title}"

    def lacks(self, roles: Roles) -> tuple[str, ...]:
        """The roles that it needs and nothing plays."""
        return tuple(role for role in self.needs if getattr(roles, role) is None)

    def breach(self, dialogue: Dialogue, roles: Roles) -> Breach | None:
        """The first thing in the dialogue that breaks it, if anything does."""
        if self.each is None or self.lacks(roles):
            return None
        for turn, why in self.each(dialogue, roles):
            return Breach(self, turn, why)
        return None


@dataclass(frozen=True)
class Breach:
    """That a dialogue breaks a property: in which of its turns, and why."""

    property: Property
    turn: int
    why: str

    def __str__(self) -> str:
        return f"{self.property}: {self.property.says}\nturn {self.turn}: {self.why}"


def chosen(properties: object, known: tuple[Property, ...]) -> tuple[Property, ...]:
    """The properties, by value or by name. Raises `TTRError` for what is none."""
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
