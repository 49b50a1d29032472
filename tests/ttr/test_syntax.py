"""Nodes: one for each structure, and errors that say what to mend."""

import gc
import threading

import numpy as np
import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pred,
    Rec,
    RecordType,
    TTRError,
    meet,
    outer,
    record,
    rectype,
    this,
)
from ttr.errors import IllFormedError
from ttr.types import FiniteSet, FunType, Meet, PType, Singleton, Universe, interning
from ttr.types.interning import identity
from ttr.types.objects import Path
from ttr.types.paths import free_paths

dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)


def test_one_node_for_one_structure():
    assert Basic("Ind") is Ind
    assert dog("fido") is dog("fido")
    assert Pred("dog", Ind) is dog
    assert Pred("dog", Ind, Ind) is not dog
    assert ListOf(dog("x")) is ListOf(dog("x"))
    assert rectype(x=Ind, c=dog(this.x)) is rectype({"c": dog(this.x), "x": Ind})


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (1, True),
        (1, 1.0),
        (0.0, -0.0),
        ("1", 1),
        ((1,), (True,)),
        (("a",), "a"),
        (frozenset([1]), (1,)),
        (None, "None"),
    ],
)
def test_objects_of_other_classes_are_other_objects(one, other):
    assert dog(one) is not dog(other)
    assert Ind @ one is not Ind @ other
    assert identity(one) != identity(other)


def test_objects_that_are_the_same():
    nan = float("nan")
    assert dog(nan) is dog(float("nan"))
    assert dog([1, [2]]) is dog((1, (2,)))
    assert dog({"x": 1}) is dog({"x": 1})


def test_arrays_are_the_same_by_address():
    a, b = np.zeros(3), np.zeros(3)
    assert dog(a) is dog(a)
    assert dog(a) is not dog(b)
    assert meet(dog(a), dog(b)) is meet(dog(b), dog(a))


def test_an_array_in_a_key_keeps_its_address():
    key = identity(np.zeros(3))
    gc.collect()
    assert all(identity(np.zeros(3)) != key for _ in range(100))


class Percept(tuple):
    """A handle with a class of its own."""


def test_an_object_of_a_class_of_its_own_stays_what_it_is():
    handle = Percept(["img7"])
    assert dog(handle).args[0] is handle
    assert dog(handle) is not dog(("img7",))


def test_nodes_are_let_go():
    def pool():
        from ttr.types import interning

        gc.collect()
        return len(interning._pool)

    before = pool()
    kept = [Basic(f"Fleeting{i}") for i in range(100)]
    assert pool() == before + len(kept)
    del kept
    assert pool() == before


def test_threads_get_the_same_node():
    barrier = threading.Barrier(8)
    found = []

    def build():
        barrier.wait()
        types = [
            rectype(x=Ind, c=dog(this.x), e=hug(this.x, f"thread{i}"))
            for i in range(300)
        ]
        found.append(types)

    threads = [threading.Thread(target=build) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8
    for same in zip(*found, strict=True):
        assert len(set(map(id, same))) == 1


def test_nodes_do_not_change():
    with pytest.raises(TTRError, match="do not change, so name cannot be set"):
        Ind.name = "Other"
    with pytest.raises(TTRError, match="do not change, so fields cannot be set"):
        rectype(x=Ind).fields = ()
    with pytest.raises(TTRError, match="do not change, so x cannot be set"):
        dog.x = 3
    with pytest.raises(TTRError, match="do not change, so name cannot be deleted"):
        del Ind.name


@pytest.mark.parametrize(
    "mistaken",
    [
        lambda: ~dog,
        lambda: dog & dog,
        lambda: dog | Ind,
        lambda: dog >> Ind,
        lambda: dog @ "a",
        lambda: dog <= Ind,
        lambda: Ind >> dog,
    ],
)
def test_a_predicate_is_no_type(mistaken):
    with pytest.raises(
        IllFormedError, match="expected a type, found the predicate dog:"
    ):
        mistaken()


def test_arities_are_a_set():
    one, two = (Ind,), (Ind, Ind)
    assert Pred("open", one, two) is Pred("open", two, one, two)
    assert Pred("open", two, one).arities == (one, two)
    assert Pred("rain").arities == ((),)
    assert str(Pred("rain")()) == "rain()"


def test_a_meet_is_flat_and_has_no_order():
    A, B, C = Basic("A"), Basic("B"), Basic("C")
    assert meet(C, meet(B, A), B) is meet(A, B, C)
    assert isinstance(A & B, Meet)
    assert A & A is A
    assert A & B >= A & B & C


def test_the_order_of_parts_is_that_of_structure_not_of_print():
    A, B = Basic("A"), Basic("B")
    named, renamed = FunType(A, B, "x"), FunType(A, B, "y")
    assert named is renamed
    parts = [~A, dog("b"), named, ListOf(A & B), A | B, ListOf(A), dog("a"), B]
    shown = "(A -> B) /\\ (A \\/ B) /\\ B /\\ dog(a) /\\ dog(b)"
    shown += " /\\ list(A) /\\ list(A /\\ B) /\\ ~A"
    assert str(meet(*parts)) == str(meet(*reversed(parts))) == shown


def test_types_are_put_in_order_without_being_printed(monkeypatch):
    def refuse(*_: object) -> str:
        raise AssertionError("the canonical order asked for text")

    monkeypatch.setattr(interning, "as_notation", refuse)
    monkeypatch.setattr(interning, "as_python", refuse)
    new, newer = Basic("New"), Basic("Newer")
    assert (dog("n") & ~newer & new).parts == (new, dog("n"), ~newer)
    objects = FiniteSet([newer], {"a": new}, new, ("b",), "a")
    assert objects.items == (new, (newer,), "a", ("b",), record(a=new))
    assert Pred("newly", (newer,), (new,)).arities == ((new,), (newer,))


def test_fields_by_label():
    T = rectype(x=Ind, c=dog(this.x))
    assert T["c"] is dog(this.x)
    assert "x" in T
    assert "y" not in T
    assert T.get("y") is None
    assert list(T) == ["x", "c"]
    with pytest.raises(KeyError):
        T["y"]


def test_escaping_paths():
    inner = rectype(x=Ind, e=hug(this.x, outer.y))
    assert free_paths(inner) == {Path(0, ("y",))}
    assert free_paths(rectype(y=Ind, n=inner)) == frozenset()
    assert free_paths(Ind @ {"a": [this.x]}) == {Path(0, ("x",))}
    assert free_paths(ListOf(dog(outer(2).z))) == {Path(2, ("z",))}


WRONG = {
    "a type, found the predicate dog: apply it to objects of (Ind)": lambda: ListOf(
        dog
    ),
    "expected a type, found the object 'Ind'": lambda: Ind & "Ind",
    "expected a type, found the object 'man'": lambda: Pred("p", "man"),
    "the field x needs a type, found the object 'a'": lambda: rectype(x="a"),
    "a ptype is of a predicate, found the object 'dog'": lambda: PType("dog", ("a",)),
    "dog takes 1 argument (Ind), but has 0": dog,
    "hug takes 2 arguments (Ind, Ind), but has 1": lambda: hug("a"),
    "p takes 1 argument (Ind) or 2 arguments (Ind, Ind), but has 3": lambda: Pred(
        "p", (Ind,), (Ind, Ind)
    )("a", "b", "c"),
    "a basic type is named by a string, found int 3": lambda: Basic(3),
    "a predicate is named by an identifier, found '3'": lambda: Pred("3", Ind),
    "a type of types is Type or RecType": lambda: Universe("Set"),
    "a meet needs at least one type": meet,
    "a label is an identifier that does not start with _: '_x'": lambda: rectype(
        {"_x": Ind}
    ),
    "a label is an identifier that does not start with _: 'a.b'": lambda: rectype(
        {"a.b": Ind}
    ),
    "the label 'ﬁ' is written fi in Python": lambda: rectype({"ﬁ": Ind}),
    "the label x is there twice": lambda: rectype({"x": Ind}, x=Ind),
    "rectype takes labels as keywords or as one mapping, found [1]": lambda: rectype(
        [1]
    ),
}


@pytest.mark.parametrize("message", WRONG)
def test_mistakes_are_named(message):
    with pytest.raises(IllFormedError) as caught:
        WRONG[message]()
    assert message in str(caught.value)


def test_classes_hold_data():
    match rectype(x=Ind @ "a"):
        case RecordType((("x", Singleton(base, value)),)):
            assert (base, value) == (Ind, "a")
        case _:
            pytest.fail("no match")
    assert Rec is rectype()
