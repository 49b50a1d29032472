"""Most dogs: quantifiers by witness sets, what a pronoun picks up, what follows.

Run it with `python examples/07_most_dogs.py`, and read along.
"""

from ttr import Ind, Model, Pred, fun, outer, record, rectype, this
from ttr.semantics.fragment import english, follows, pronoun_antecedents, understand
from ttr.semantics.parametric_content import content, strong, weak
from ttr.semantics.quantifiers import (
    Thresholds,
    UndefinedError,
    antecedents,
    every,
    exist,
    few,
    judge_situation,
    most,
    settle,
    share,
    truth,
)

# Three dogs and two boys; two of the dogs bark, and who hugs whom.

words = english()
dog, boy = words.meaning("NOUN", "dog"), words.meaning("NOUN", "boy")
bark, hug = words.meaning("IV", "bark"), words.meaning("TV", "hug")

M = Model(words.theory)
for name in ("fido", "rex", "felix", "kim", "sam"):
    M = M.given(name, Ind)
for number, name in enumerate(("fido", "rex", "felix"), start=1):
    M = M.given(f"d{number}", dog(name))
M = M.given("b1", boy("kim")).given("b2", boy("sam"))
M = M.given("w1", bark("fido")).given("w2", bark("rex"))
M = M.given("h1", hug("fido", "kim")).given("h2", hug("rex", "kim"))
M = M.given("h3", hug("felix", "sam"))

# `most(dog, bark)` is a type. Of it are the situations {X, f} in which X is a set of
# dogs, enough of them to be most, and f says what makes each of them bark.

found = settle(M, most(dog, bark))
print(found.why)
print("witness:", found.witness)
wrong = record(X={"fido"}, f=[record(x="fido", e="w1")])
print("too few:", judge_situation(M, wrong, most(dog, bark)).why.rule)

# How many is most, many or few is up to the agent.

strict = Thresholds(most=share("at least", 0.9))
print("\nstrict: ", settle(M, most(dog, bark), strict).holds)
print(settle(M, every(dog, bark)).why)

# Of nothing, most is neither true nor false.

try:
    settle(M, most(Pred("unicorn", Ind), bark))
except UndefinedError as undefined:
    print("undefined:", undefined)

# What is uncertain makes it a degree: here it is a chance of one in four that Felix
# barks too.

perhaps = M.given("w3", bark("felix"), 0.25)
print("\nevery dog barks, perhaps: p =", settle(perhaps, every(dog, bark)).p)

# Properties are functions, so quantifiers nest, and a sentence of the fragment of
# English has such a type as its content.

hugs_a_boy = fun(x=Ind)(exist(boy, fun(y=Ind)(hug(outer.x, this.y))))
sentence = understand("Every dog hugs a boy.")
print("\ncontent:", sentence.content)
print("the same type:", sentence.content is every(dog, hugs_a_boy))
print(sentence.judge(M).why)

# The witness sets are what a pronoun can pick up.

dogs, boys = pronoun_antecedents(M, sentence)
print("\nthey, the dogs:", dogs)
print("they, the boys:", boys)
sets = antecedents(settle(M, few(dog, boy)))
print("after few, the others too:", sets.compset)
print("They bark:", understand("They bark.", picked=[dogs]).judge(M).p)

# "Every farmer who owns a donkey beats it": some of his donkeys, or all of them? What
# is presupposed is the background of a content, and purification does away with it.

donkey, own = Pred("donkey", Ind), Pred("own", Ind, Ind)
beat = Pred("beat", Ind, Ind)
F = Model().given("f1", Ind).given("b1", beat("f1", "d1"))
for name in ("d1", "d2"):
    F = F.given(name, Ind).given(f"c{name}", donkey(name))
    F = F.given(f"o{name}", own("f1", name))
owned = rectype(y=Ind, c=donkey(this.y), o=own("f1", this.y))
beats = content(owned, fun(r=owned)(beat("f1", this.r.y)))
print("\nweak:  ", weak(beats))
print("strong:", strong(beats))
print("some owned donkey is beaten: ", truth(F, weak(beats)).p)
print("every owned donkey is beaten:", truth(F, strong(beats)).p)
print(truth(F, strong(beats)).why)

# What follows from what, whoever the dogs are?

print()
for premises, hypothesis in (
    (["Most dogs bark.", "Most dogs are brown."], "Some brown dog barks."),
    (["Every puppy barks."], "Every dog barks."),
    (["No dog barks."], "At least two dogs bark loudly."),
    (["Kim is a skilful vet.", "Kim is a sailor."], "Kim is a skilful sailor."),
):
    print(*premises, "/", hypothesis, "->", follows(premises, hypothesis).verdict)
