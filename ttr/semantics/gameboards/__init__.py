"""Information-state types of the literature, with their update rules, as values.

`cooper` is the gameboard of Cooper 2023, `kos` that of Ginzburg 2012, `ibis` the
issue-based one of Larsson 2002. Change a type or a rule and you have your own.
"""
