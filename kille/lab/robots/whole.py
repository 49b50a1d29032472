"""The whole robot, with its eyes and its memory, in front of a theatre."""

from __future__ import annotations

from kille.agent.agent import Agent
from kille.agent.exchanges import Exchange
from kille.lab.robots.replies import Reply
from kille.lab.scenes.robot_views import Theatre
from kille.lab.scenes.scene import Occasion
from kille.lab.worlds.perception import thing


class WholeRobot:
    """The whole robot, with its eyes and its memory, in front of a theatre."""

    def __init__(self, agent: Agent, theatre: Theatre) -> None:
        self._agent, self._theatre = agent, theatre
        self._occasion: Occasion | None = None

    def see(self, occasion: Occasion) -> Reply:
        """Turn to what is shown; it is looked at when something is said of it."""
        self._occasion = occasion
        self._theatre.turn_to(occasion)
        self._agent.gaze.attention = self._theatre.attention()
        return self._reply(None)

    def wait(self, occasion: Occasion) -> Reply:
        """Look of its own accord."""
        self._agent.look()
        return self._reply(self._agent.exchanges[-1])

    def hear(self, text: str) -> Reply:
        """Hear a text, and glance at what it is about."""
        self._agent.hear(text)
        return self._reply(self._agent.exchanges[-1])

    def happen(self, command: str) -> Reply:
        """Carry out a command by `Agent.change_scene`."""
        before = len(self._agent.exchanges)
        self._agent.change_scene(command)
        return self._reply(next(iter(self._agent.exchanges[before:]), None))

    def rest(self) -> Reply:
        """Begin another day."""
        self._agent.do("restart")
        return self._reply(None)

    def name(self, number: int) -> str | None:
        """The thing in the latest look that is this one of the world."""
        view = self._agent.view
        if view is None or self._occasion is None:
            return None
        found = self._theatre.number_in_view(self._occasion, number, view)
        return None if found is None else thing(found)

    def close(self) -> None:
        """Close the sensor and the memory."""
        self._agent.close()

    def _number(self, x: str) -> int | None:
        """The thing of the world that a name is for."""
        occasion = self._occasion
        if occasion is None:
            return None
        return next((it for it in occasion.world.in_view if self.name(it) == x), None)

    def _reply(self, exchange: Exchange | None) -> Reply:
        state, model = self._agent.state, self._agent.model
        if exchange is None:
            return Reply("", (), state, model, (), self._number)
        moves = tuple(it.judgement for it in exchange.said if it.judgement is not None)
        rules = tuple(it.rule.name for it in exchange.steps)
        return Reply(exchange.answer, moves, state, model, rules, self._number)
