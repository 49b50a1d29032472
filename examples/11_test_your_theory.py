"""Test your theory: a tutor plays dialogues until something goes wrong.

Run it with `python examples/11_test_your_theory.py`. It needs hypothesis:
`pip install 'kille[test]'`.
"""

from pathlib import Path

from ttr import Model, Theory, record, replace
from ttr.dialogues.stories import setting
from ttr.testing import Property, Roles, Suite, Tutor, check_rules
from ttr.updates import Game, first, rule

# A waiter takes orders, and strikes off what is cancelled. The types are read from the
# notation; the rules are functions.

theory = Theory.parse(
    """
    basic Ind, Dish
    object guest, waiter : Ind
    object fish, soup : Dish
    pred order(Ind, Dish), cancel(Ind, Dish)
    Order  := [spkr = guest : Ind, dish : Dish, e : order(spkr, dish)]
    Cancel := [spkr = guest : Ind, dish : Dish, e : cancel(spkr, dish)]
    Board  := [commitments : list(Dish)]
    """
)
Board, Order, Cancel = theory["Board"], theory["Order"], theory["Cancel"]


@rule(when=Board, on=Order)
def take(s, e):
    "What is ordered is agreed on."
    return replace(s, commitments=[*s.commitments, e.dish])


@rule(when=Board, on=Cancel)
def strike(s, e):
    "What is cancelled is no longer agreed on."
    return replace(s, commitments=[])


start = record(commitments=[])


def restaurant(*rules):
    """The game of these rules."""
    algorithm, model = first(*rules), Model(theory)
    return Game("restaurant", Board, start, algorithm, model, theory=theory)


# Three stories about one order each would all be fine. A tutor who orders and cancels
# finds that more is taken back than was cancelled: a property of one's own says what
# cancelling is.


def cancels_one(dialogue, roles):
    """Where in a dialogue more than one dish is taken back, and why."""
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            gone = len(step.before.commitments) - len(step.after.commitments)
            if gone > 1:
                yield number, f"{step.rule} takes back {gone} dishes"


one_at_a_time = Property(
    "own", "one at a time", "a guest cancels one dish at a time.", cancels_one
)
tutor = Tutor(answers=0.8, wanders=0.1, repeats=0.1)
roles = Roles(commitments="commitments", retracts=frozenset({"strike"}))
suite = Suite(restaurant(take, strike), tutor, (one_at_a_time,), roles, examples=200)
print(suite.run().explain_failure())

# The rule is mended, and another mistake comes to light: what was never ordered cannot
# be struck off.


@rule(when=Board, on=Cancel)
def strike(s, e):
    "What is cancelled is no longer agreed on."
    kept = list(s.commitments)
    kept.remove(e.dish)
    return replace(s, commitments=kept)


try:
    check_rules(restaurant(take, strike), tutor=tutor, roles=roles, examples=200)
except AssertionError as broken:
    print(broken)


@rule(when=Board, on=Cancel)
def strike(s, e):
    "What is cancelled is no longer agreed on, if it was ordered."
    if e.dish not in s.commitments:
        return None
    kept = list(s.commitments)
    kept.remove(e.dish)
    return replace(s, commitments=kept)


report = check_rules(restaurant(take, strike), tutor=tutor, roles=roles, examples=200)
print(f"all is well: {report.holds}, never applied: {report.coverage.missed_rules}")

# Rules that are written in a file are tested in the same way. `ttr test fetch.ttr` does
# it from the command line, and prints what the dialogues covered.

fetch = setting("fetch.ttr fetch", Path(__file__).parent).game
covered = check_rules(fetch, examples=50).coverage
print(covered.table().splitlines()[1])
print(f"what was not covered: {covered.missed_rules}")
