"""Theories at work: the games that they make, what judges words, how they look."""

from kille.lab.theories.descriptions import described, rules_apart
from kille.lab.theories.games import agent_of, game_of, language_of, strategy_of

__all__ = [
    "agent_of",
    "described",
    "game_of",
    "language_of",
    "rules_apart",
    "strategy_of",
]
