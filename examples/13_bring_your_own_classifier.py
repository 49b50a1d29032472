"""Bring your own classifier: a learner of two methods, measured beside the robot's own.

Run it with `python examples/13_bring_your_own_classifier.py`. It needs no camera and no
data: the things stand on a simulated table. The same class takes part in whatever
`kille evaluate` measures; in this folder:

    kille evaluate objects --method 13_bring_your_own_classifier.py:NearestColour
"""

import math

from kille.lab.protocols.objects import paper
from kille.lab.theories.candidates import candidates
from kille.perception.methods import OBJECTS


class NearestColour:
    """It remembers one colour a lesson, and answers with the word of the nearest."""

    def __init__(self):
        self.lessons = []

    def learn_one(self, x, y):
        """A tutor points at x, which is called y."""
        self.lessons.append((mean_colour(x), y))

    def predict_proba_one(self, x):
        """How likely each word is for x: the nearer its colours, the likelier."""
        colour = mean_colour(x)
        degrees = {}
        for known, word in self.lessons:
            nearness = math.exp(-math.dist(colour, known) / 10)
            degrees[word] = max(nearness, degrees.get(word, 0.0))
        return {word: it / (1 + sum(degrees.values())) for word, it in degrees.items()}


def mean_colour(x):
    """What is seen is a percept: its frame has pixels, its region says which are its.

    It has more to go by: `x.scans` are SIFT features of each scan, and `x.traits` what
    the thing looks like as a whole: colour, size, shape, texture and more.
    """
    return tuple(x.frame.colour[x.region.mask].mean(axis=0))


def broken():
    """A learner that cannot be made, to see what is said then."""
    raise RuntimeError("no weights")


if __name__ == "__main__":
    # The paper's protocol, cut down to be quick: one round of lessons about five
    # things, then each is asked for in another pose, and again turned by 45 degrees.

    things = ("apple", "cap", "car", "shoe", "book")
    methods = {**OBJECTS, "nearest colour": NearestColour}
    taking_part = candidates(["default", "nearest colour"], methods)
    result = paper(taking_part, seed=7, things=things, rounds=1)
    print(result.title)

    # What comes back is plain numbers: tables, figures, and facts for a machine.

    scores, _, ranking, mistakes = result.tables
    for row in scores.rows:
        name, right, _, turned, margin, *_ = row
        print(f"{name:15} right: {right}, turned: {turned}, margin: {margin:.2f}")

    print("\nThe most distinct first:")
    for row in ranking.rows:
        print(*(f"{cell!s:15}" for cell in row[1:]))

    print("\nTaken for another:")
    for name, _, once, turned in mistakes.rows:
        print(f"{name:15} {once}; turned: {turned}")

    # A learner that fails is named; in `kille evaluate` the others go on without it.

    try:
        candidates(["mine"], {"mine": broken})["mine"]()
    except Exception as error:
        print(f"\nrefused: {error}")
