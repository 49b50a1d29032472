"""A robot without eyes: its games, in front of things whose degrees are given."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import pytest

from kille.dialogue.language import understand
from kille.dialogue.meanings import (
    adjective,
    noun,
    predicate_at,
    relation,
    theory,
    word_of,
)
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import hear_sentences, tutoring
from ttr import Model, Record, record
from ttr.judging import Judgement
from ttr.updates import Game, Run, Turn

Degrees = Mapping[tuple[str, ...], float]
"""The degree of a word (its predicate's name) for things: ("cup", "o1")."""


def degree(known: Degrees, word: str, arity: int, *args: str) -> float:
    """The degree; a relation seen in another perspective has its front as well."""
    front = [it for it in args[arity + 1 :] if it != "away"]
    return known.get((word, *args[:arity], *front), 0.0)


class Scene:
    """Things in view, and a robot that knows some words and answers what it is told.

    Relations that are `seen` are judged, though no lesson has taught them.
    """

    def __init__(
        self,
        things: int = 1,
        placed: int | None = None,
        nouns: Sequence[str] = (),
        adjectives: Sequence[str] = (),
        relations: Sequence[str] = (),
        known: Degrees | None = None,
        seen: Sequence[str] = (),
        **settings: Any,
    ) -> None:
        signs = [
            *map(noun, nouns),
            *map(adjective, adjectives),
            *map(relation, relations),
        ]
        self.names = [f"o{n + 1}" for n in range(things)]
        self.placed = self.names[:placed]
        model: Model = blank_model().given("look1", theory()["Look"])
        for x in self.names:
            model = model.given(x, theory()["Ind"])
        for sign in (*signs, *map(relation, seen)):
            word = word_of(sign)
            arity = 2 if sign.kind == "relation" else 1
            if word.name in ("between",):
                word, arity = theory()[word.name], 3
            by = partial(degree, known or {}, word.name, arity)
            model = model.witnessed(word, by=by)
        self.game: Game = tutoring(signs, model=model, **settings)
        self.now: Run = self.game.begin()
        self.turns: list[Turn] = []
        self._take(self.seen("Glance"))

    def seen(self, kind: str = "Seen", kept: Sequence[str] | None = None) -> Record:
        """The event of a look at these things, as a turn or at a glance."""
        view = record(
            look="look1",
            things=self.names,
            placed=self.placed,
            focus=self.names[:1],
            pointed=self.names[:1],
        )
        floor = "robot" if kind == "Seen" else "tutor"
        kept = self.names if kept is None else kept
        return record(view=view, kept=kept, floor=floor)

    def _take(self, event: object) -> tuple[Judgement, ...]:
        turn = self.game.take(self.now, event)
        self.now = turn.run
        self.turns.append(turn)
        return turn.said

    def hear(self, text: str) -> str:
        """What the robot says to this, a sentence a line."""
        return self._worded(self._take(self._read(text)))

    def acts(self, text: str) -> list[str]:
        """What the robot does when it hears this, by the names of its acts."""
        return self._acts(self._take(self._read(text)))

    def perhaps(self, **texts: float) -> str:
        """What it says when one of these was heard, each so probable ("_" is " ")."""
        said = {text.replace("_", " "): p for text, p in texts.items()}
        sentences = [understand(text)[0] for text in said]
        return self._worded(self._take(hear_sentences(*sentences, p=said.values())))

    def look(self, kept: Sequence[str] | None = None) -> list[str]:
        """What it does of its own accord at a look; `kept` were in view, or all."""
        return self._acts(self._take(self.seen(kept=kept)))

    @property
    def state(self) -> Record:
        return self.now.state

    def _read(self, text: str) -> object:
        assert self.game.hear is not None
        event = self.game.hear(text)
        assert event is not None, f"{text} is not understood"
        return event

    def _worded(self, said: Sequence[Judgement]) -> str:
        assert self.game.say is not None
        return "\n".join(map(self.game.say, said))

    @staticmethod
    def _acts(said: Sequence[Judgement]) -> list[str]:
        return [predicate_at(move.type, "e").name for move in said]  # type: ignore[arg-type]


@pytest.fixture(scope="session")
def scene() -> Callable[..., Scene]:
    """Makes a scene: scene(things=2, nouns=["cup"], known={("cup", "o1"): 0.9})."""
    return Scene
