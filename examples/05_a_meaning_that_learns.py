"""A meaning that learns: Larsson's `right`, shown a situation, and corrected.

Run it with `python examples/05_a_meaning_that_learns.py`, and read along. With the name
of a picture, `python examples/05_a_meaning_that_learns.py boundary.png`, it also draws
how the meaning changed; that needs matplotlib: `pip install 'kille[plots]'`.
"""

import random
import sys
from itertools import pairwise

from ttr import Ind, Model, Pred, box, fun, outer, record, rectype, this
from ttr.semantics.perceptual import (
    GradedPerceptron,
    Perceptron,
    RealVector,
    Speaker,
    agreement,
    combined_type,
    convergence,
    difference,
    history,
    interpretation,
    meaning,
    perceive,
    says,
)

# A perceptual meaning is a record {params, bg, clf, interp}. The background type `bg`
# has a percept, here the position of the object that the speaker is looking at; the
# classifier is a perceptron, `params` are its weights and threshold; and `interp` is
# the type that a situation gets where the classifier says yes.

right = Pred("right", Ind)
bg = rectype(foo=Ind, spkr=Ind, pos=RealVector)
interp = fun(r=bg)(rectype(c=right(outer.r.foo)))
params = record(w=[0.8, 0.01], t=0.09)
to_the_right = meaning(interp, Perceptron(rate=0.5), params, of="pos")
print(box(to_the_right.record))

# Shown a situation, it gives it a type. In a model it is judged like any other type,
# with a reason, field by field.

situation = record(foo="o1", spkr="a", pos=[0.9, 0.1])
print("\nscore:     ", round(to_the_right.score(situation), 3))
print("type:      ", to_the_right.classify(situation))
M = Model().given("o1", Ind).given("a", Ind)
print(to_the_right.judge(M, situation).why)

# "No, that is not to the right": the meaning after it is another one. What changed are
# the parameters, by one step of the perceptron's rule. The old meaning is as it was.

corrected = to_the_right.rejected(situation)
print("\nAfter a correction:")
print(box(corrected.params))
print("now:       ", corrected.classify(situation))
print("before:    ", to_the_right.classify(situation))
print(*difference(to_the_right, corrected), sep="\n")
assert corrected.rejected(situation) is corrected

# Two agents have their own meanings of the word. Whenever they do not agree about a
# situation, the one corrects the other; what they mean comes to be alike.

rng = random.Random(5)


def somewhere() -> list[float]:
    """A place on the table between them."""
    return [round(rng.uniform(-1, 1), 2) for _ in range(2)]


probes = [record(foo="o1", spkr="a", pos=somewhere()) for _ in range(200)]
seen = [record(foo="o1", spkr="a", pos=somewhere()) for _ in range(60)]

# For Ann, right is right; Bo starts with a meaning that is nearer to "far away", and
# learns in smaller steps.

careful = Perceptron(rate=0.1)
ann = Speaker("Ann", {"right": to_the_right})
far_away = record(w=[0.1, 0.6], t=0.2)
bo = Speaker("Bo", {"right": meaning(interp, careful, far_away, of="pos")})
stages = history(ann, bo, "right", seen)
course = convergence(ann, stages, "right", probes)
print("\nAnn and Bo:")
for number in (0, 5, 20, 60):
    print(f"after {number:2} exchanges: {course.series[number]}")
print("corrected: ", sum(one is not two for one, two in pairwise(stages)))
assert agreement(ann["right"], bo["right"], probes) == course.series[0]

# A graded classifier gives degrees, and meanings combine by merge: in "red cup" both
# classifiers judge, and the degrees are multiplied.


def graded(word: str, percept: str, t: float):
    """The meaning of a word that holds the more, the more there is of something."""
    T = rectype({"x": Ind, percept: RealVector, "c": Pred(word, Ind)(this.x)})
    method, params = GradedPerceptron(steepness=5), record(w=[1.0], t=t)
    return meaning(interpretation(T, "c"), method, params, of=percept)


red, cup = graded("red", "redness", 0.5), graded("cup", "roundness", 0.3)
thing = record(x="o1", redness=[0.8], roundness=[0.5])
print("\nred cup:   ", combined_type(red, cup))
print("red:       ", round(red.degree(thing).lo, 3))
print("cup:       ", round(cup.degree(thing).lo, 3))
print("red cup:   ", round(perceive(M, thing, red, cup).p.lo, 3))


# --- the picture ---------------------------------------------------------------------


def picture(path: str) -> None:
    """Draw what Bo means before and after, and how Bo and Ann came to agree."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        sys.exit("no picture: it needs matplotlib, pip install 'kille[plots]'")
    figure = Figure(figsize=(9.6, 3.6), layout="constrained")
    before, after, curve = figure.subplots(1, 3, width_ratios=[1, 1, 1.2])
    for axes, title, bo_then in (
        (before, "Bo's right before", stages[0]),
        (after, "and after 60 exchanges", stages[-1]),
    ):
        boundary(axes, bo_then["right"])
        axes.set_title(title, fontsize=10)
    names = before.get_legend_handles_labels()
    figure.legend(*names, loc="outside lower left", ncols=3, fontsize=9, frameon=False)
    curve.plot([100 * one.share for one in course.series], color="#0072B2")
    curve.set(ylim=(0, 103), xlabel="exchanges", ylabel="judged alike, %")
    curve.set_title("Ann and Bo", fontsize=10)
    curve.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=110)
    print("\npicture:   ", path)


def boundary(axes, bos) -> None:
    """Bo's boundary w · x = t, and the places that Ann says are to the right."""
    w, t = bos.params.w, bos.params.t
    grid = [i / 60 for i in range(-66, 67)]
    above = [[w[0] * x + w[1] * y - t for x in grid] for y in grid]
    levels = [-1e9, 0, 1e9]
    axes.contourf(grid, grid, above, levels=levels, colors=["#ffffff", "#cfe0f2"])
    axes.fill_between([], [], color="#cfe0f2", label="Bo: right")
    axes.contour(grid, grid, above, levels=[0], colors="#0072B2")
    for marker, wanted, name in (
        ("o", True, "Ann: right"),
        ("x", False, "Ann: not right"),
    ):
        places = [r.pos for r in probes[:80] if says(to_the_right, r) is wanted]
        axes.scatter(
            *zip(*places, strict=True), marker=marker, s=14, color="#D55E00", label=name
        )
    axes.set(xticks=[-1, 0, 1], yticks=[-1, 0, 1], aspect="equal")


for path in sys.argv[1:2]:
    picture(path)
