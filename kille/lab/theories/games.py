"""Theories at work: the games that they make, in a simulated world or by a robot.

In what two theories differ is in the value of each, a `Theory`; all else is the same.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from kille.agent.agent import Agent
from kille.dialogue.language_files import language_in
from kille.dialogue.strategies import strategy
from kille.lab.errors import TheoryError
from kille.lab.settings import Problem, Setting, show_value, suggest_name
from kille.lab.study import Theory
from kille.lab.theories.classifiers import learners_of, words_of
from kille.lab.theories.meanings import meanings_of
from kille.lab.theories.rules import algorithm_of
from kille.lab.theories.simulated_words import act_with, with_known_colours
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.word_learning import LearnedWord
from kille.lab.worlds.worlds import World
from kille.sensors.sensor import Sensor
from ttr import Record, replace
from ttr.updates import Game


def game_of(
    theory: Theory, world: World, *, colours: Iterable[Record] | None = None
) -> Game:
    """The game of a theory in front of a simulated world.

    Its robot knows these `colours`, or else all; which words are of colours it knows
    anyhow. `TheoryError` where the theory cannot be used.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> game = game_of(Theory("four", wording="four"), world)
    >>> turns = game.play(map(game.hear, ["This is a cup.", "What is this?"]))
    >>> [game.say(move) for turn in turns for move in turn.said]
    ['Please, show me more examples of cup.', 'This is a cup. Am I right?']
    """
    types = meanings_of(theory)
    every = vocabulary(theory.language, types).colours
    signs = every if colours is None else tuple(colours)
    game = simulated_game(
        world,
        colours=signs,
        language=language_of(theory),
        mode=theory.mode,
        wording=theory.wording,
        types=types,
    )
    start = replace(game.start, {"private.colours": list(every)})
    game = dataclasses.replace(game, start=start)
    makes = words_of(theory)
    if all(make is LearnedWord for make in makes.values()):
        return change_game(game, theory)
    model = with_known_colours(game.model, makes, signs)
    game = dataclasses.replace(game, model=model, act=act_with(makes))
    return change_game(game, theory)


def agent_of(
    theory: Theory,
    sensor: str | Sensor,
    *,
    change: Callable[[Game], Game] | None = None,
    **settings: Any,
) -> Agent:
    """The whole robot with this theory, looking through a sensor.

    `settings` are those of `Agent`, and so is `change`, which is given the game of the
    theory; errors as it raises them, and `TheoryError`.

    >>> with agent_of(Theory("four", wording="four"), "synthetic:empty") as robot:
    ...     print(robot.hear("What is this?"))
    I see nothing on the table.
    """

    def game_to_play(game: Game) -> Game:
        own = change_game(game, theory)
        return own if change is None else change(own)

    return Agent(
        sensor,
        language=language_of(theory),
        mode=theory.mode,
        wording=theory.wording,
        learners=learners_of(theory),
        theory=meanings_of(theory),
        change=game_to_play,
        **settings,
    )


def change_game(game: Game, theory: Theory) -> Game:
    """Give a game the theory's own strategy and rules."""
    if not (theory.strategy or theory.rules or theory.without):
        return game
    start = replace(game.start, {"private.strategy": strategy_of(theory)})
    return dataclasses.replace(game, start=start, algorithm=algorithm_of(theory))


def language_of(theory: Theory) -> str:
    """The language of a theory as games name it, with the folder of its own files.

    >>> language_of(Theory("swedish", language="sv"))
    'sv'
    """
    if theory.grammar is None:
        return theory.language
    return language_in(theory.grammar, theory.language)


def strategy_of(theory: Theory) -> Record:
    """The strategy of a theory; `TheoryError` for what it cannot be set to.

    >>> strategy_of(Theory("sure", strategy={"bands": {"sure": 0.9}})).bands.sure
    0.9
    """
    plain = strategy(theory.mode, theory.wording, language_of(theory))
    wrong = next(strategy_problems(theory), None)
    if wrong is not None:
        raise TheoryError(wrong.what)
    return replace(plain, dict(_numbers_by_path(theory.strategy)))


def strategy_problems(theory: Theory) -> Iterator[Problem]:
    """What the strategy cannot be set to, and why."""
    yield from _strategy_problems(
        theory.strategy, strategy(theory.mode, theory.wording, language_of(theory)), ()
    )


def _strategy_problems(
    given: Mapping[str, Any], known: Record, outer: tuple[str, ...]
) -> Iterator[Problem]:
    for name, value in given.items():
        here = (*outer, name)
        path = ".".join(here)
        if name not in known:
            told = f"a strategy has no {path}: {suggest_name(name, tuple(known))}"
            yield Problem(here, told)
        elif isinstance(value, dict) and isinstance(known[name], Record):
            yield from _strategy_problems(value, known[name], here)
        elif isinstance(known[name], str):
            told = f"the {name} of a strategy is that of the theory: write it there"
            yield Problem(here, told)
        elif isinstance(known[name], Record):
            inner = ", ".join(known[name])
            told = f"is a table of {inner}, found {show_value(value)}"
            yield Problem(here, f"{path} of a strategy {told}")
        elif why := _NUMBERS.get(here[0], _CHANCE).problem_with(value):
            yield Problem(here, f"{path} of a strategy: {why}")


_CHANCE = Setting(float, most=2.0)
"""A probability; what more than 1 would be needed for never is."""

_NUMBERS = {
    "wants": Setting(float, least=-1_000_000, most=1_000_000),
    "examples": Setting(float, most=1_000_000),
}
"""Numbers of a strategy that are no probabilities, by where they stand."""


def _numbers_by_path(
    given: Mapping[str, Any], outer: str = ""
) -> Iterator[tuple[str, float]]:
    """All numbers that are set, by their paths."""
    for name, value in given.items():
        if isinstance(value, dict):
            yield from _numbers_by_path(value, f"{outer}{name}.")
        else:
            yield f"{outer}{name}", float(value)
