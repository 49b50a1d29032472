"""Subtyping and merge: more specific types, and types put together.

Run it with `python examples/02_subtyping_and_merge.py`, and read along.
"""

from ttr import Basic, Pred, amerge, consistent, merge, rectype, relabel, subtype, this
from ttr.building import common_supertype, subtract
from ttr.signature.signature import Axiom, Signature

Ind = Basic("Ind")
dog, puppy, run = Pred("dog", Ind), Pred("puppy", Ind), Pred("run", Ind)
hug = Pred("hug", Ind, Ind)
Dog = rectype(x=Ind, c=dog(this.x))
HugDog = rectype(x=Ind, c=dog(this.x), y=Ind, e=hug(this.y, this.x))

# A type with more fields is a subtype: whatever is judged to be of what, every hugged
# dog is a dog.

print("HugDog <= Dog:", HugDog <= Dog)

# The answer is yes, no or unknown. For a no there is a reason, and a counter-example:
# a record, in a model made for it, that is of the one type and not of the other.

answer = subtype(Dog, HugDog)
print("Dog <= HugDog:", answer)
print("for example:  ", answer.counter)

# What is declared counts as well, if the theory is given. A predicate on both sides
# of an axiom is about whatever objects.

puppies_are_dogs = Signature(axioms=(Axiom(puppy(this.x), dog(this.x)),))
Puppy = rectype(x=Ind, c=puppy(this.x))
print("Puppy <= Dog: ", subtype(Puppy, Dog).verdict, "by structure")
print("Puppy <= Dog: ", subtype(Puppy, Dog, puppies_are_dogs).verdict, "by the axiom")

# The logic is that of meets, joins and negations.

A, B, C = Basic("A"), Basic("B"), Basic("C")
assert A & (B | C) <= (A & B) | (A & C)
assert A & ~B <= ~(A & B)
print("consistent:   ", consistent(A | B, ~A).verdict, "for A \\/ B and ~A")
print("consistent:   ", consistent(A & B, ~A))

# The merge of two types has the fields of both, and is below both. What is of it is of
# each, and the other way round.

Running = rectype(x=Ind, e=run(this.x))
RunningDog = merge(Dog, Running)
print("\nmerge:        ", RunningDog)
assert RunningDog <= Dog
assert RunningDog <= Running

# In the asymmetric merge the second has the say: it models change.

Fido = rectype(x=Ind @ "fido", c=dog(this.x))
print("merge:        ", merge(Fido, rectype(x=Ind)))
print("amerge:       ", amerge(Fido, rectype(x=Ind)))

# Labels can be renamed, all at once, and paths follow; a path can be taken away, if
# nothing else needs it.

print("relabelled:   ", relabel(HugDog, x="y", y="x"))
print("without e:    ", subtract(HugDog, "e"))

# What two types have in common is the most specific record type above both.

print("in common:    ", common_supertype(HugDog, RunningDog))
