"""A game as a Hypothesis state machine, to be extended with rules of one's own."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.escapes import terminal_text
from ttr.testing.failure_story import story
from ttr.testing.properties.catalogue import ALL
from ttr.testing.properties.property import Property, select_properties
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.random_states import event_of, heard_by
from ttr.types.objects import Object
from ttr.types.syntax import TypeNode, kind_of
from ttr.updates.games import Game


def machine(
    game: Game,
    *,
    properties: Iterable[Property | str] = ALL,
    roles: Roles | None = None,
) -> type[RuleBasedStateMachine]:
    """A state machine that plays any events the game hears and checks the properties.

    It has a rule for each type of events and one for the empty turn; `self.dialogue` is
    the dialogue so far. `machine(game).TestCase` is a test that pytest runs; subclasses
    may add rules and invariants. Raises `TTRError` for what is no game or property.

    >>> from hypothesis import settings
    >>> from hypothesis.stateful import run_state_machine_as_test
    >>> from ttr import Ind, ListOf, rectype, replace
    >>> from ttr.updates import rule
    >>> Board = rectype(heard=ListOf(Ind))
    >>> @rule(when=Board, on=Ind)
    ... def note(s, e):
    ...     return replace(s, heard=[*s.heard, e])
    >>> notes = machine(Game("notes", Board, {"heard": []}, note))
    >>> run_state_machine_as_test(notes, settings=settings(max_examples=5))
    """
    if not isinstance(game, Game):
        raise TTRError(f"a machine is made of a game, found {kind_of(game)}")
    asked = select_properties(properties, ALL)
    who = roles or Roles.of(game.type)

    class Machine(RuleBasedStateMachine):
        """Plays one dialogue."""

        def __init__(self) -> None:
            super().__init__()
            self.dialogue = Dialogue(game)

        def take(self, event: Object) -> None:
            """Continue the dialogue, unless something has gone wrong in it."""
            if self.dialogue.fault is None:
                self.dialogue = self.dialogue.then(event)

        @rule()
        def nothing_happens(self) -> None:
            """The tutor is silent."""
            self.take(None)

        @invariant()
        def properties_hold(self) -> None:
            """The dialogue so far breaks no property."""
            __tracebackhide__ = True
            for one in asked:
                if breach := one.breach(self.dialogue, who):
                    text = story(self.dialogue, str(one))
                    message = terminal_text(f"{breach}\n\n{text}")
                    raise AssertionError(message) from None

    for number, T in enumerate(heard_by(game), start=1):
        setattr(Machine, f"event_{number}", rule(data=st.data())(_rule_for_events(T)))
    Machine.__name__ = Machine.__qualname__ = f"Machine_{game.name}"
    return Machine


def _rule_for_events(T: TypeNode) -> Callable[..., None]:
    """The rule of a machine that lets an event of the type happen."""

    def happens(self: Any, data: st.DataObject) -> None:
        self.take(data.draw(event_of(T, self.dialogue.now.model)))

    return happens
