"""How probable a judgement is, and why: intervals, conditions, what excludes what.

Run it with `python examples/06_how_probable.py`, and read along. With the name of a
picture, `… 06_how_probable.py degrees.png`, it draws the record with its degrees too.
"""

import sys

from ttr import Ind, Model, Pred, Theory, TTRError, record, rectype, this
from ttr.semantics.random_variables import RandomVariable

boy, dog, hug = Pred("boy", Ind), Pred("dog", Ind), Pred("hug", Ind, Ind)
BoyHugsDog = rectype(
    x=Ind, c1=boy(this.x), y=Ind, c2=dog(this.y), e=hug(this.x, this.y)
)

# What a camera makes of a scene is not certain. Of the hug it only says that it is
# between 0.6 and 0.8. Distinct judgements are independent, so a record is as probable
# as the product of its fields.

scene = Model().given("a", Ind).given("b", Ind)
scene = scene.given("s1", boy("a"), 0.9).given("s2", dog("b"), 0.95)
M = scene.given("s3", hug("a", "b"), (0.6, 0.8))
seen = record(x="a", c1="s1", y="b", c2="s2", e="s3")
print(M.judge(seen, BoyHugsDog).why)

# Negations and joins go by the same arithmetic. A judgement that occurs twice is one
# judgement: that s1 is one of a boy, or is not, is certain.

print("\nnot both: ", M.judge("s1", ~boy("a")).p, M.judge("s1", boy("a") & ~boy("a")).p)
print("certain:  ", M.judge("s1", boy("a") | ~boy("a")).p)

# One judgement may depend on another. Here only what boys do is known.

depending = scene.given("s3", hug("a", "b"), (0.6, 0.8), when=[("s1", boy("a"))])
print("\n" + str(depending.judge(seen, BoyHugsDog).why))

# In a file this is `given P(s3 : hug(a, b) | s1 : boy(a)) in [0.6, 0.8]`. What holds of
# whatever object is said of types, `P(Ill || Flu)`, and a judgement can be asked for
# under conditions.

ward = Theory.parse("""
    basic Flu, Ill, Old
    given P(Ill || Flu, Old) = 0.6
    given P(Ill || Flu, ~Old) in [0.05, 0.3]
    given kim : Flu
    given kim : Old = 0.5
    check P(kim : Ill | kim : Old) = 0.6
""")
ill = Model(ward).judge("kim", ward.Ill, when=[("kim", ~ward.Old)])
print("\nKim, who has the flu, is ill:    ", Model(ward).judge("kim", ward.Ill).p)
print("if Kim is not old:               ", ill.p)
print(
    "Kim is old, as Kim is ill:       ",
    Model(ward).judge("kim", ward.Old, when=[("kim", ward.Ill)]).p,
)

# What excludes what is declared, like what is below what. A model that would say
# otherwise is refused.

table = Theory.parse("""
    basic Cup, Mug, Vessel
    Cup <: ~Mug
    Cup <: Vessel
    Mug <: Vessel
    given o1 : Cup = 0.5
    given o1 : Mug = 0.3
""")
T = Model(table)
print("\n" + str(T.judge("o1", table.Cup | table.Mug).why))
try:
    T.given("o1", table.Vessel, 0.7)
except TTRError as refused:
    print("refused:", refused.message)

# A random variable takes its values as the only ones there are. From intervals come
# intervals, each end where the others are at their other end.

What = RandomVariable("What", table.Cup, table.Mug)
loose = Model(Theory.of(table.Cup, table.Mug))
loose = loose.given("o1", table.Cup, (0.2, 0.4)).given("o1", table.Mug, (0.1, 0.3))
print("\n" + str(What.judge(loose, "o1", table.Cup).why))

# --- a picture of the first judgement ---


def draw(path: str) -> None:
    """The record type as a matrix, beside each field its degree as an interval."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        sys.exit("no picture: it needs matplotlib, pip install 'kille[plots]'")
    why = M.judge(seen, BoyHugsDog).why
    rows = [*((part.where, part.type, part.p) for part in why.parts), ("", "", why.p)]
    figure = Figure(figsize=(6.4, 0.42 * len(rows) + 0.5), layout="constrained")
    matrix, bars = figure.subplots(1, 2, sharey=True, width_ratios=(1, 1))
    last = len(rows) - 1
    for row, (label, kind, p) in enumerate(rows):
        colour = "#D55E00" if row == last else "#0072B2"
        text = f"{label} : {kind}" if label else "the whole record"
        matrix.text(0.1, row, text, va="center", family="DejaVu Sans Mono", size=11)
        bars.plot((p.lo, p.hi), (row, row), color=colour, lw=7, solid_capstyle="butt")
        bars.plot((p.lo, p.hi), (row, row), "|", color=colour, ms=12, mew=2)
        bars.text(1.04, row, str(p), va="center", size=10)
    for side, turn in ((0.0, 1), (0.95, -1)):
        corners = [side + 0.04 * turn, side, side, side + 0.04 * turn]
        matrix.plot(corners, (-0.45, -0.45, last - 0.55, last - 0.55), "k", lw=1.4)
    matrix.set(xlim=(-0.02, 1), ylim=(last + 0.6, -0.6))
    matrix.axis("off")
    bars.set(xlim=(0, 1), xticks=(0, 0.5, 1), yticks=())
    bars.spines[["left", "right", "top"]].set_visible(False)
    figure.savefig(path, dpi=150, bbox_inches="tight", pad_inches=0.1)
    print(f"\npicture: {path}")


if len(sys.argv) > 1:
    draw(sys.argv[1])
