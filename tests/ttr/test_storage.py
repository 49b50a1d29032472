"""Underspecified contents: which readings there are, and which there are not."""

from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Ind, Model, Pred, Theory, Type, fun, rectype, subtype, this
from ttr.computing import equal, normal_form
from ttr.errors import IllFormedError, TooLargeError
from ttr.safety.budgets import budget
from ttr.semantics.quantifiers import every, exist, most, truth
from ttr.semantics.storage import (
    StoredQuantifier,
    Underspecified,
    readings,
    type_of_readings,
)
from ttr.types.paths import subterms

dog, cat, boy = Pred("dog", Ind), Pred("cat", Ind), Pred("boy", Ind)
rep, company, sample = Pred("rep", Ind, Ind), Pred("company", Ind), Pred("sample", Ind)
chase, see, run = Pred("chase", Ind, Ind), Pred("see", Ind, Ind), Pred("run", Ind)
show = Pred("show", Ind, Ind, Ind)

EVERY_DOG, A_CAT = (
    StoredQuantifier("x", every, dog("x")),
    StoredQuantifier("y", exist, cat("y")),
)
MOST_BOYS = StoredQuantifier("z", most, boy("z"))


def of(body):
    """The property of individuals that a Python function gives."""
    return fun(v=Ind)(body)


def test_two_quantifiers_have_two_scopes():
    sentence = Underspecified(chase("x", "y"), (EVERY_DOG, A_CAT))
    assert readings(sentence) == (
        every(dog, of(lambda x: exist(cat, of(lambda y: chase(x, y))))),
        exist(cat, of(lambda y: every(dog, of(lambda x: chase(x, y))))),
    )


def test_three_quantifiers_have_six():
    sentence = Underspecified(show("x", "y", "z"), (EVERY_DOG, A_CAT, MOST_BOYS))
    found = readings(sentence)
    assert len(found) == len(set(found)) == 6


def test_the_first_reading_has_the_scopes_of_the_sentence():
    store = (A_CAT, MOST_BOYS, EVERY_DOG)
    first = readings(Underspecified(show("x", "y", "z"), store))[0]
    assert first is exist(
        cat,
        of(lambda y: most(boy, of(lambda z: every(dog, of(lambda x: show(x, y, z)))))),
    )


def test_without_a_store_it_is_its_own_reading():
    sentence = Underspecified(run("fido"))
    assert sentence.is_plugged
    assert readings(sentence) == (run("fido"),)


def test_a_quantifier_inside_another_stays_inside_or_has_wider_scope():
    """Every representative of a company saw most samples: five readings, not six."""
    noun = Underspecified(rep("x", "y"), (StoredQuantifier("y", exist, company("y")),))
    store = (
        StoredQuantifier("x", every, noun),
        StoredQuantifier("z", most, sample("z")),
    )
    found = readings(Underspecified(see("x", "z"), store))
    assert len(found) == 5
    whole = of(lambda x: exist(company, of(lambda y: rep(x, y))))
    inside = [one for one in found if whole in subterms([one])]
    assert inside == [
        every(whole, of(lambda x: most(sample, of(lambda z: see(x, z))))),
        most(sample, of(lambda z: every(whole, of(lambda x: see(x, z))))),
    ]
    for one in set(found) - set(inside):
        assert str(one).index("company") < str(one).index("rep(")


def test_a_variable_in_a_restrictor_is_bound_from_outside():
    store = (
        StoredQuantifier("x", every, rep("x", "y")),
        StoredQuantifier("y", exist, company("y")),
        StoredQuantifier("z", most, sample("z")),
    )
    found = readings(Underspecified(see("x", "z"), store))
    assert len(found) == 3
    assert all(str(one).index("company") < str(one).index("rep(") for one in found)


def test_nothing_is_retrieved_inside_that_is_wanted_outside():
    noun = Underspecified(rep("x", "y"), (StoredQuantifier("y", exist, company("y")),))
    sentence = Underspecified(see("x", "y"), (StoredQuantifier("x", every, noun),))
    assert readings(sentence) == (
        exist(
            company,
            of(lambda y: every(of(lambda x: rep(x, y)), of(lambda x: see(x, y)))),
        ),
    )


def test_readings_that_compute_to_the_same_are_one():
    theory = Theory.parse(r"""
        basic Ind
        pred  run(Ind), dog(Ind)
        object j, k : Ind
        John := \P:(Ind -> Type). P(j)
        Kim  := \P:(Ind -> Type). P(k)
    """)
    store = (StoredQuantifier("x", theory.John), StoredQuantifier("y", theory.Kim))
    assert readings(Underspecified(chase("x", "y"), store), theory) == (
        chase("j", "k"),
    )


def test_determiners_of_a_theory_are_computed():
    theory = Theory.parse(r"""
        basic Ind
        pred  dog(Ind), cat(Ind), chase(Ind, Ind)
        Some  := \P:(Ind -> RecType). \Q:(Ind -> RecType). [x : Ind, r : P(x), s : Q(x)]
        Every := \P:(Ind -> RecType). \Q:(Ind -> RecType).
            [f : ((x : Ind) -> (P(x) -> Q(x)))]
        Surface := Every(\v:Ind. [e : dog(v)])(\v:Ind.
            Some(\w:Ind. [e : cat(w)])(\w:Ind. [e : chase(v, w)]))
        Inverse := Some(\w:Ind. [e : cat(w)])(\w:Ind.
            Every(\v:Ind. [e : dog(v)])(\v:Ind. [e : chase(v, w)]))
    """)
    e = [theory.parse(text) for text in ("[e : dog('v')]", "[e : cat('w')]")]
    store = (
        StoredQuantifier("v", theory.Every, e[0]),
        StoredQuantifier("w", theory.Some, e[1]),
    )
    content = theory.parse("[e : chase('v', 'w')]")
    surface, inverse = readings(Underspecified(content, store), theory)
    assert equal(surface, theory.Surface, theory).yes
    assert equal(inverse, theory.Inverse, theory).yes
    assert equal(surface, inverse, theory).no


def test_readings_can_be_judged():
    M = Model()
    for name, kind in (("fido", dog), ("rex", dog), ("tom", cat), ("kit", cat)):
        M = M.given(name, Ind).given(f"s_{name}", kind(name))
    M = M.given("e1", chase("fido", "tom")).given("e2", chase("rex", "kit"))
    surface, inverse = readings(Underspecified(chase("x", "y"), (EVERY_DOG, A_CAT)))
    assert truth(M, surface).p == (1, 1)
    assert truth(M, inverse).p == (0, 0)


def test_the_type_of_the_readings_has_them_as_witnesses():
    sentence = Underspecified(chase("x", "y"), (EVERY_DOG, A_CAT))
    T = type_of_readings(sentence)
    assert subtype(T, Type).yes
    assert all(Model().judge(one, T).holds for one in readings(sentence))
    assert not Model().judge(run("fido"), T).holds


def test_a_property_may_be_of_other_things():
    box = rectype(x=Ind)
    full, red = Pred("full", box), Pred("red", box)
    sentence = Underspecified(
        full("b"), (StoredQuantifier("b", exist, red("b"), domain=box),)
    )
    properties = [fun(r=box)(pred(this.r)) for pred in (red, full)]
    assert readings(sentence) == (exist(*properties),)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Underspecified(run("x"), (EVERY_DOG, EVERY_DOG)), "are to bind x"),
        (lambda: Underspecified("run"), "type"),
        (lambda: Underspecified(run("x"), (every,)), "a store has stored quantifiers"),
        (lambda: StoredQuantifier(3, every, dog("x")), "a variable is a name"),
        (
            lambda: StoredQuantifier("x", "every", dog("x")),
            "a quantifier is a function",
        ),
    ],
)
def test_what_is_no_store_is_refused(make, message):
    with pytest.raises(IllFormedError, match=message):
        make()


def test_too_many_readings_are_refused():
    names = [f"x{i}" for i in range(12)]
    many = Pred("many", *[Ind] * 12)
    store = [StoredQuantifier(name, every, dog(name)) for name in names]
    with budget(steps=20_000), pytest.raises(TooLargeError):
        readings(Underspecified(many(*names), store))


@given(st.permutations("xyz"), st.sets(st.sampled_from("xyz")))
def test_each_order_of_retrieval_is_a_reading(order, used):
    """By brute force: the readings are the orders in which the quantifiers nest."""
    kinds = {"x": (every, dog), "y": (exist, cat), "z": (most, boy)}
    store = [
        StoredQuantifier(v, kinds[v][0], kinds[v][1](v)) for v in order if v in used
    ]
    content = show(*[v if v in used else "fido" for v in "xyz"])
    wanted = set()
    for chosen in permutations(store):
        found = content
        for one in chosen:
            left = Underspecified(found, (one,))
            (found,) = readings(left)
        wanted.add(found)
    assert set(readings(Underspecified(content, store))) == wanted
    assert all(normal_form(one) is one for one in wanted)
    assert all(isinstance(one, StoredQuantifier) for one in store)
