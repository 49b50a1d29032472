"""Information-state update: rules, strategies as values, runs with a trace, games.

A rule has a precondition, a record type, and an effect, a pure function or a type. A
strategy combines rules: `first`, `all_`, `maybe`, `repeat`, `seq`, `by_class`, `ask`.
`run` plays events through a strategy and checks the state against its declared type
after every rule; a `Game` is what is needed to play whole dialogues.

Read `rules`, `update_strategies`, `running` and `games` first; `matching` finds what a
rule binds, `effect_application` makes the next state, and `checks` finds faults in
rules without running them. This room may use `judging` and what is below it.

>>> from ttr import Model, Theory, record
>>> board = Theory.parse('''
...     basic Ind
...     object ann, bo : Ind
...     Board := [spkr : Ind, addr : Ind]
...     rule turn(s : Board) "Who was spoken to speaks."
...         where [a = s.addr : Ind] := [spkr = a : Ind, addr = s.spkr : Ind]
... ''')
>>> turn, start = board.rules["turn"], record(spkr="ann", addr="bo")
>>> print(run(turn, start, type=board.Board, model=Model(board)).state)
{addr = ann, spkr = bo}
"""

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.updates.games import Game, Turn
from ttr.updates.nbest import NBest, nbest
from ttr.updates.rules import Body, Rule, rule, update
from ttr.updates.running import Run, Step, run
from ttr.updates.update_strategies import (
    Algorithm,
    All,
    Ask,
    ByClass,
    First,
    Maybe,
    Repeat,
    Seq,
    all_,
    ask,
    by_class,
    first,
    maybe,
    repeat,
    replace_rules,
    rules_of,
    seq,
)

__all__ = [
    "Algorithm",
    "All",
    "Ask",
    "Body",
    "ByClass",
    "First",
    "Game",
    "Maybe",
    "NBest",
    "Repeat",
    "Rule",
    "Run",
    "Seq",
    "Step",
    "Turn",
    "all_",
    "ask",
    "by_class",
    "first",
    "maybe",
    "nbest",
    "repeat",
    "replace_rules",
    "rule",
    "rules_of",
    "run",
    "seq",
    "update",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
