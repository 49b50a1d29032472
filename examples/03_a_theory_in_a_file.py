"""A theory in a file: types, facts and axioms without Python, checked.

Run it with `python examples/03_a_theory_in_a_file.py`, and read along with
`examples/kennel.ttr`. The command `ttr check examples/kennel.ttr` asks the same.
"""

from pathlib import Path

import ttr

# A `.ttr` file declares basic types, predicates and objects, defines types, states
# axioms and facts, and says what should hold.

file = Path(__file__).with_name("kennel.ttr")
kennel = ttr.load(file)
print("declared:", *sorted(kennel.names))

# What it defines are its attributes, the same values as those built in Python.

Ind, dog = ttr.Basic("Ind"), ttr.Pred("dog", ttr.Basic("Ind"))
assert kennel.Dog is ttr.rectype(x=Ind, c=dog(ttr.this.x))
print("Dog :=  ", kennel.Dog)

# Texts are read with its names; what is printed reads back to the same type.

T = kennel.parse("[x : Ind, c : puppy(x), e : hug(sam, x)]")
assert kennel.parse(str(T)) is T
print("T :=    ", T)
print("T <= Dog:", ttr.subtype(T, kennel.Dog, kennel))

# A model of the theory has its facts and goes by its axioms: a puppy is a dog, so s1,
# in which Rex is a puppy, is one in which he is a dog.

M = ttr.Model(kennel)
print("\nIs Rex a dog?")
print(M.judge(ttr.record(x="rex", c="s1"), kennel.Dog).why)

# The checks of the file are a test of the theory.

print("\nkennel.ttr:", ttr.check(kennel))

# Several mistakes are told in one go, each with its place and a way out.

try:
    ttr.Theory.parse(
        """
basic Ind
pred  dog(Ind), hug(Ind, Ind)
Hug := [x : Ind, e : hug(x)]
Dog := [x : Ind, c : dgo(x)]
"""
    )
except ttr.TTRError as mistakes:
    print(mistakes)
