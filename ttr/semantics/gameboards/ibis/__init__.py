"""IBiS1, the issue-based information state, in which questions drive a dialogue.

A `Domain` says what can be asked and how it is found out; `game` makes a dialogue
system of it. Source: Larsson 2002, chapter 2, with question accommodation and
corrections from chapter 4.
"""

from ttr.semantics.gameboards.ibis.domains import Domain
from ttr.semantics.gameboards.ibis.issue_based_game import algorithm, game
from ttr.semantics.gameboards.ibis.phrase_book import PhraseBook
from ttr.semantics.gameboards.ibis.state import (
    START,
    STATE,
    USER,
    utterance,
    utterance_type,
)

__all__ = [
    "START",
    "STATE",
    "USER",
    "Domain",
    "PhraseBook",
    "algorithm",
    "game",
    "utterance",
    "utterance_type",
]
