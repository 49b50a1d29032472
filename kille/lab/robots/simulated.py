"""A robot that is its games alone, in front of a simulated world."""

from __future__ import annotations

import dataclasses

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import DialogueTypes, packaged_types
from kille.dialogue.robust_reading.text_hearing import hear_text
from kille.dialogue.tutoring import hear_sentences
from kille.dialogue.wording import did_not_understand
from kille.lab.robots.replies import Reply
from kille.lab.scenes.scene import Occasion
from kille.lab.scenes.table_commands import change_world
from kille.lab.worlds.games import world_of
from kille.lab.worlds.perception import glance_event, look_event, number_of, thing
from kille.lab.worlds.schooling import game_next_day
from kille.lab.worlds.worlds import World
from ttr.updates import Game, Run, Turn


class SimulatedRobot:
    """A robot without a body: what it sees follows from the name of the world."""

    def __init__(
        self, game: Game, language: str = "en", types: DialogueTypes | None = None
    ) -> None:
        self._game, self._language = game, language
        self._types = types or packaged_types()
        self._now: Run = game.begin()

    def see(self, occasion: Occasion) -> Reply:
        """Glance at what is shown."""
        return self._take(glance_event(occasion.world_seen, self._world))

    def wait(self, occasion: Occasion) -> Reply:
        """Look on its own turn."""
        return self._take(look_event(occasion.world_seen, self._world))

    def hear(self, text: str) -> Reply:
        """Hear a text, as a whole or by its parts, as the whole robot does.

        The reply also says what is not understood.
        """
        heard = hear_text(text, self._now.state, self._language, types=self._types)
        words, beside = lexicon(self._language), bool(heard.moves)
        sorries = (
            did_not_understand(
                words, it.text, found.parts, beside=beside, types=self._types
            )
            for it, found in heard.missed
        )
        reply = self._reply("\n".join(sorries), ())
        for move in heard.moves:
            reply = reply.then(self._take(hear_sentences(move)))
            if heard.in_parts and reply.is_open:
                break
        return reply

    def happen(self, command: str) -> Reply:
        """Carry out `look`, `point 2`, `place 2 3.5 4`, `remove 2` or `restart`."""
        world = self._world
        if command == "restart":
            return self.rest()
        if command == "look":
            return self._take(look_event(world.look_again(), world))
        return self._take(glance_event(change_world(world, command), world))

    def rest(self) -> Reply:
        """Begin another day, see `kille.lab.worlds.schooling.game_next_day`."""
        state, model, _ = self._now
        ended = dataclasses.replace(self._game, start=state, model=model)
        self._now = game_next_day(ended).begin()
        return self._reply("", ())

    def name(self, number: int) -> str | None:
        """Things have the numbers that they have in the world."""
        return thing(number) if number in self._world else None

    def close(self) -> None:
        """There is nothing to release."""

    @property
    def _world(self) -> World:
        """What is in view."""
        return world_of(self._now.state)

    def _take(self, event: object) -> Reply:
        turn = self._game.take(self._now, event)
        self._now = turn.run
        assert self._game.say is not None
        text = "\n".join(map(self._game.say, turn.said))
        return self._reply(text, tuple(it.rule.name for it in turn.trace), turn)

    def _reply(
        self, text: str, rules: tuple[str, ...], turn: Turn | None = None
    ) -> Reply:
        moves = () if turn is None else turn.said
        return Reply(text, moves, self._now.state, self._now.model, rules, number_of)
