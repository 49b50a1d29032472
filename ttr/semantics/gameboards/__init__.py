"""Information-state types of the literature, with their update rules, as values.

`cooper` is the gameboard of Cooper 2023 (the simplest, to be read first), `kos` that of
Ginzburg 2012, `ibis` the issue-based information state of Larsson 2002. Change a type
or a rule and you have your own. They do not import one another. May import: questions,
updates, theories and all below.
"""
