"""Colour words: what is called what, where words overlap, and how a tutor moves them.

Run it with `python examples/14_colour_words.py`. It needs no camera and no data: the
things stand on a simulated table.
"""

import numpy as np

from kille.perception.colours import (
    BASIC,
    ColourMemory,
    Palette,
    colour_chances,
    colour_words,
    colours_of,
    lab_of,
    plain,
    xkcd,
)
from kille.perception.look import look
from kille.sensors.synthetic.sensor import open_synthetic

table = open_synthetic("synthetic:empty?seed=7")


def seen(thing: str) -> Palette:
    """The colours of a thing that is put on the table alone."""
    table.show(thing)
    view = look(table, scans=1)
    colours = colours_of(view.frame, view.percepts[0].region)
    if colours is None:
        raise SystemExit(f"the {thing} is not to be seen")
    return colours


def best(degrees: dict[str, float], least: float = 0.3) -> str:
    """The words with a fair degree, the best first."""
    order = sorted(degrees, key=lambda word: -degrees[word])
    return ", ".join(f"{w} {degrees[w]:.1f}" for w in order if degrees[w] >= least)


# A thing has a palette, and several words may hold of it, each to a degree. These are
# the words of people who were shown colours on a screen; nobody has taught them here.

basic = xkcd().among(BASIC)
print("What holds of the things on the table:")
for thing in ("apple", "banana", "car", "cup", "shoe-box"):
    print(f"  {thing:9}", best(colour_words(seen(thing), basic)))

# To hold is one thing, to be chosen another: words compete, and some come to mind more
# easily than others.

lime = plain(lab_of([170, 230, 80]))
print("\nA lime:")
print("  holds: ", best(colour_words(lime)))
print("  chosen:", best(colour_chances(lime), 0.1))

# The borders are vague. From red to orange the one word fades and the other comes up.

print("\nFrom red to orange, and on to yellow:")
for mix in np.linspace(0, 1, 9):
    degrees = colour_words(plain(lab_of([225, 30 + 190 * mix, 30])))
    bars = [
        f"{word} {'#' * round(10 * degrees[word]):10}"
        for word in ("red", "orange", "yellow")
    ]
    print("  " + "  ".join(bars).rstrip())

# A tutor calls orange things red. One such lesson moves the border a little; after ten
# of them it is the tutor who is right. The word is chosen then, and orange less so.

orange = plain(lab_of([240, 130, 30]))
memory = ColourMemory(prior=xkcd())
print("\nIs it red, when a tutor says so of something orange?")
for lesson in range(11):
    if lesson in (0, 1, 5, 10):
        holds, says = memory.degrees(orange), memory.predict_proba_one(orange)
        word = max(says, key=lambda word: says[word])
        print(f"  after {lesson:2} lessons: red {holds['red']:.2f}; it says {word}")
    memory.learn_one(orange, "red", key=lesson)

# A word that it has never heard is learned from what it is shown, in any language; and
# what was taught can be forgotten.

memory.learn_one(plain(lab_of([150, 110, 190])), "syrenlila", key="a flower")
memory.learn_one(plain(lab_of([170, 130, 200])), "syrenlila", key="another")
print("\nA new word:", best(memory.degrees(plain(lab_of([160, 120, 190])))))
print("And of a red thing:", best(memory.degrees(plain(lab_of([200, 30, 30])))))
memory.forget("a flower")
memory.forget("another")
print("Forgotten again:", "syrenlila" not in memory.labels)
