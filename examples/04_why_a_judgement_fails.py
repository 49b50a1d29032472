"""Why a judgement fails: which field, what was found, what would have done.

Run it with `python examples/04_why_a_judgement_fails.py`, and read along.
"""

from ttr import Basic, Model, Pred, latex, record, rectype, this
from ttr.errors import RefusedError, UndecidedError
from ttr.signature.signature import Signature

Ind = Basic("Ind")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
HugDog = rectype(x=Ind, c=dog(this.x), y=Ind, e=hug(this.y, this.x))

M = Model().given("fido", Ind).given("sam", Ind)
M = M.given("s1", dog("fido")).given("s2", hug("sam", "fido"))

# A judgement comes with its derivation. Here x and y are the wrong way round: s1 is a
# situation in which Fido is a dog, and not one in which Sam is.

swapped = M.judge(record(x="sam", c="s1", y="fido", e="s2"), HugDog)
print(swapped.why)

# What fails first has a path, a rule, and where something is known of it, a remedy.

print("\nfails at:", swapped.why.path())
print("because: ", swapped.why.failure().rule)
print("but:     ", swapped.why.failure().remedy())

# A field may be missing, or a manifest field be another object.

print("\nWithout e:")
print(M.judge(record(x="fido", c="s1", y="sam"), HugDog).why)
Fido = rectype(x=Ind @ "fido", c=dog(this.x))
print("\nIs Sam Fido?")
print(M.judge(record(x="sam", c="s1"), Fido).why)

# Negation fails where what is denied holds, a join where none of its parts does.

print("\nIs s1 no situation of Fido being a dog?")
print(M.judge("s1", ~dog("fido")).why)
print("\nIs Fido a dog, or hugged by himself, in s2?")
print(M.judge("s2", dog("fido") | hug("fido", "fido")).why)

# Where a type is open, what nobody told is not refuted but unknown. A yes or no is
# then no answer, and asking for one is an error that says so.

open_model = Model(Signature(opened=frozenset({dog}))).given("sam", Ind)
unknown = open_model.judge("s1", dog("sam"))
print("\nunknown: ", unknown)
try:
    print(unknown.holds)
except UndecidedError as undecided:
    print(undecided)

# What a witness condition refuses cannot be given, and is not stored.

numbers = Model().witnessed(Basic("Real"), by=lambda a: isinstance(a, float))
try:
    numbers.given("a", Basic("Real"))
except RefusedError as refused:
    print("\nrefused: ", refused)

# A derivation is also LaTeX for a paper, and HTML in a notebook.

print("\n" + latex(M.judge("s1", dog("fido")).why))
