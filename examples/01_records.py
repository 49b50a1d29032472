"""Records and record types: what there is, what it is of, and why.

Run it with `python examples/01_records_and_types.py`, and read along.
"""

from ttr import Basic, Model, Pred, Rec, merge, record, rectype, subtype, this

# A basic type, and two predicates with the types of their arguments.

Ind = Basic("Ind")
dog = Pred("dog", Ind)
hug = Pred("hug", Ind, Ind)

# A record type has labelled fields. Here c depends on x: it is the type of the
# situations in which *that* individual is a dog. `print` writes the notation of the
# papers.

Dog = rectype(x=Ind, c=dog(this.x))
print("a dog:       ", Dog)

# Types are values. Whoever builds the same type has the same object, whatever the
# order in which the fields were written.

assert rectype(c=dog(this.x), x=Ind) is Dog

# A type with more fields is a subtype: every hugged dog is a dog. The other way round
# there is a reason why not.

HugDog = rectype(x=Ind, c=dog(this.x), y=Ind, e=hug(this.y, this.x))
print("a hugged dog:", HugDog)
print("HugDog <= Dog:", HugDog <= Dog)
print("Dog <= HugDog:", subtype(Dog, HugDog))

# The merge of two types has the fields of both, and is below both. A manifest field,
# [x = fido : Ind], says which object it is.

Fido = rectype(x=Ind @ "fido")
FidoTheDog = merge(Dog, Fido)
print("Fido the dog:", FidoTheDog)
assert FidoTheDog <= Dog
assert FidoTheDog <= Fido

# Types know nothing of the world: a model does. s1 is a situation in which Fido is a
# dog, s2 one in which Sam hugs him.

M = Model().given("fido", Ind).given("sam", Ind)
M = M.given("s1", dog("fido")).given("s2", hug("sam", "fido"))

# A record is of a record type when each field is of the field's type, and `why` is the
# derivation.

seen = record(x="fido", c="s1", y="sam", e="s2")
print("\nIs this a hugged dog?")
print(M.judge(seen, HugDog).why)

# Sam is not known to be a dog, and the situation s1 does not make him one.

print("\nIs this?")
judgement = M.judge(record(x="sam", c="s1", y="sam", e="s2"), HugDog)
print(judgement.why)
print("What fails first is", judgement.why.path())

# A judgement may have a degree. The degree of a record is that of all its fields
# together.

M = M.given("s3", dog("sam"), 0.7)
print("\nA likely dog:", M.judge(record(x="sam", c="s3"), Dog))

# Records nest, and so do their types. `Rec` is the type of all records, and `^.x`
# leads to the x of the record one further out.

Scene = merge(Dog, rectype(background=Rec))
print("\nA dog in a scene:", Scene)
print("as a record:     ", record(x="fido", c="s1", background=record(place="park")))
