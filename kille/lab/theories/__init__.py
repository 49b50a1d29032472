"""Theories at work: the games that they make, what judges words, how they look."""

from kille.lab.theories.descriptions import describe, rules_apart
from kille.lab.theories.games import agent_of, game_of, language_of, strategy_of
from ttr.aliases import former_names

__all__ = [
    "agent_of",
    "describe",
    "game_of",
    "language_of",
    "rules_apart",
    "strategy_of",
]

__getattr__ = former_names(__name__, {"described": "describe"})
