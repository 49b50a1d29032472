"""Records and record types: what there is, and what it is of.

Run it with `python examples/01_records.py`, and read along.
"""

from ttr import (
    Basic,
    ListOf,
    Model,
    Plus,
    Pred,
    SetOf,
    Type,
    box,
    fun,
    outer,
    record,
    rectype,
    this,
)
from ttr.types import EventString

# A basic type, and predicates with the types of their arguments. `dog("fido")` is a
# ptype: the type of the situations in which Fido is a dog.

Ind = Basic("Ind")
dog, run = Pred("dog", Ind), Pred("run", Ind)
hug = Pred("hug", Ind, Ind)
print("a ptype:     ", dog("fido"))

# A record type has labelled fields. Here c depends on x: it is the type of the
# situations in which *that* individual is a dog. `print` writes the notation of the
# papers, `box` the matrix.

Dog = rectype(x=Ind, c=dog(this.x))
print("a dog:       ", Dog)
print(box(Dog))

# Types are values. Whoever builds the same type has the same object, whatever the
# order in which the fields were written.

assert rectype(c=dog(this.x), x=Ind) is Dog

# Types know nothing of the world: a model does. It does not change; `given` makes
# another one. s1 is a situation in which Fido is a dog, s2 one in which Sam hugs him.

M = Model().given("fido", Ind).given("sam", Ind)
M = M.given("s1", dog("fido")).given("s2", hug("sam", "fido"))

# A record is of a record type when each field is of the field's type, and `why` is the
# derivation. What is of a type can be asked, or made up.

fido = record(x="fido", c="s1")
print("\nIs this a dog?")
print(M.judge(fido, Dog).why)
print("All dogs:    ", *M.witnesses(Dog))
another, _ = M.create(Dog)
print("A new one:   ", another)

# A judgement may have a degree. The degree of a record is that of all its fields
# together.

graded = M.given("s3", dog("sam"), 0.7)
print("A likely dog:", graded.judge(record(x="sam", c="s3"), Dog))

# Records nest, and so do their types. `outer.x` leads to the x of the record one
# further out; on the board it is `x`, or `^.x` where another x is nearer.

Hugged = rectype(x=Ind, c=dog(this.x), event=rectype(by=Ind, e=hug(this.by, outer.x)))
print("\nA hugged dog:", Hugged)
print(box(Hugged))

# A manifest field says which object it is. `T @ a` is the singleton type T@a.

print("Fido:        ", rectype(x=Ind @ "fido", c=dog(this.x)))

# Meets, joins, negations, functions, lists, sets and strings of events are types, too.

print("\nmeet:        ", dog("fido") & run("fido"))
print("join:        ", dog("fido") | run("fido"))
print("negation:    ", ~dog("sam"))
print("functions:   ", Ind >> Type)
print("lists, sets: ", ListOf(Ind), SetOf(Ind))
print("strings:     ", Plus(run("fido")))
property_of_running = fun(x=Ind)(run(this.x))
print(M.judge(property_of_running, Ind >> Type))
print("applied:     ", M.apply(property_of_running, "fido"))
M = M.given("e1", run("fido")).given("e2", run("fido"))
print(M.judge(EventString("e1", "e2"), Plus(run("fido"))))
