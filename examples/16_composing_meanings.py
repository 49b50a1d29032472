r"""Composing meanings: from words to the type that a sentence stands for.

Run it with `python examples/16_composing_meanings.py`, and read along. With the name of
a file behind it, it writes the boxes there as a page.
"""

import sys
from pathlib import Path

from ttr import Model, Theory, box, html
from ttr.computing import equal, normal_form, subtype
from ttr.display.html import page
from ttr.errors import IllFormedError
from ttr.semantics.storage import StoredQuantifier, Underspecified, readings

# A lexicon: nouns and verbs are functions from individuals to types of situations; noun
# phrases take such a function, and determiners two of them.

english = Theory.parse(r"""
    basic Ind
    object j, k : Ind
    Property := (Ind -> RecType)
    pred man(Ind), dog(Ind), cat(Ind), gun(Ind), run(Ind), red(Ind), chase(Ind, Ind)
    pred fake(Ind, Property), ltm(Ind, RecType), believe(Ind, RecType)
    Man   := \x:Ind. [e : man(x)]
    Dog   := \x:Ind. [e : dog(x)]
    Cat   := \x:Ind. [e : cat(x)]
    Gun   := \x:Ind. [e : gun(x)]
    Run   := \x:Ind. [e : run(x)]
    John  := \P:Property. P(j)
    Some  := \P:Property. \Q:Property. [x : Ind, restr : P(x), scope : Q(x)]
    Every := \P:Property. \Q:Property. [f : ((x : Ind) -> (P(x) -> Q(x)))]
    Chase := \q:(Property -> RecType). \x:Ind. q(\y:Ind. [e : chase(x, y)])
    Red   := \P:Property. \x:Ind. merge(P(x), [a : red(x)])
    Fake  := \P:Property. \x:Ind. [a : fake(x, P)]
    Believe := \C:RecType. \x:Ind. [e : believe(x, C)]
    ltm(a, V) <: believe(a, C) if V <= C up to relabelling
""")
boxes = []


def show(sentence, text):
    """Print what a composed meaning computes to."""
    T = normal_form(english.parse(text), english)
    boxes.append(f"<h2>{sentence}</h2>\n{html(T)}")
    print(f"{sentence}  {text}\n{box(T)}\n")
    return T


# The meaning of a phrase is that of one part, applied to that of the other.

show("John runs.", "John(Run)")
show("Some man runs.", "Some(Man)(Run)")

# Two orders of scope are two types. Who does not want to choose puts quantifiers in
# store: an underspecified meaning has both readings.

surface = show("Every dog chases a cat.", "Every(Dog)(Chase(Some(Cat)))")
inverse = show(
    "There is a cat that every dog chases.",
    r"Some(Cat)(\y:Ind. Every(Dog)(\x:Ind. [e : chase(x, y)]))",
)
print("equal:    ", equal(surface, inverse, english).verdict)
chases, dog, cat = english.parse("[e : chase('x', 'y')]"), english.Dog, english.Cat
in_store = Underspecified(
    chases,
    (
        StoredQuantifier("x", english.Every, dog("x")),
        StoredQuantifier("y", english.Some, cat("y")),
    ),
)
found = [normal_form(T, english) for T in readings(in_store)]
print("from store:", len(found), "readings, the same:", {*found} == {surface, inverse})

# "Red" adds a condition: a red dog is a dog. "Fake" takes the property itself, and from
# a fake gun nothing follows about guns.

red = show("Some red dog runs.", "Some(Red(Dog))(Run)")
fake = show("Some man chases a fake gun.", "Some(Man)(Chase(Some(Fake(Gun))))")
print("red dog:  ", subtype(red, english.parse("Some(Dog)(Run)"), english))
gun = english.parse("Some(Man)(Chase(Some(Gun)))")
print("fake gun: ", subtype(fake, gun, english).verdict)

# To believe something is to have a view that matches it, whatever its labels are.

T = show("John believes that some dog runs.", "John(Believe(Some(Dog)(Run)))")
view = "[d : Ind, r : [e : dog(^.d)], s : [e : run(^.d)]]"
M = Model(english).given("m", english.parse(f"ltm(j, {view})"))
print(M.judge("m", english.parse("believe(j, Some(Dog)(Run))")).why)
print("a cat:    ", M.judge("m", english.parse("believe(j, Some(Cat)(Run))")).p)

# What cannot be composed is refused, and where that is open it is said what is asked.

try:
    normal_form(english.parse("Some(Man)(j)"), english)
except IllFormedError as error:
    print("\nrefused:  ", error.message)
print(
    "open:     ", equal(english.parse("Man('zoe')"), english.parse("[e : man('zoe')]"))
)

if len(sys.argv) > 1:
    out = Path(sys.argv[1])
    out.write_text(page("Composing meanings", "\n".join(boxes)), encoding="utf-8")
    print("\nThe boxes are in", out)
