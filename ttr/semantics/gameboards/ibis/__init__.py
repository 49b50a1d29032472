"""IBiS1, the issue-based information state, in which questions drive a dialogue.

A `Domain` says what can be asked and how the answer is found; `game` makes a dialogue
system of it. Source: Larsson 2002, chapter 2, with accommodation and correction from
chapter 4.

Read `moves` and `state` first, then `domains`; then the rules in the order in which
they apply: `turn_grounding`, `integrating`, `planning`, `selecting`; then
`issue_based_game`, which puts them together. `phrase_book` is a toy language. May
import: questions, updates, theories and all below.
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
