"""Relabelling: paths follow, all at once, and two labels never fall together."""

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pi,
    Pred,
    Type,
    fun,
    join,
    meet,
    outer,
    record,
    rectype,
    this,
)
from ttr.building.relabelling import relabel
from ttr.errors import IllFormedError
from ttr.types import Application, Path

A, B = Basic("A"), Basic("B")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
PAIR = rectype(x=Ind, y=Ind, e=hug(this.x, this.y))


def test_paths_follow_their_labels():
    assert relabel(PAIR, x="a") is rectype(a=Ind, y=Ind, e=hug(this.a, this.y))


def test_labels_are_swapped_at_once():
    assert relabel(PAIR, x="y", y="x") is rectype(x=Ind, y=Ind, e=hug(this.y, this.x))
    assert relabel(record(x="a", y="b"), x="y", y="x") == record(x="b", y="a")


def test_fields_are_put_in_order_anew():
    assert relabel(rectype(a=A, b=B), a="z").labels == ("b", "z")


def test_paths_from_nested_record_types_functions_and_values_follow():
    T = rectype(
        x=Ind,
        n=rectype(y=Ind @ outer.x, e=hug(outer.x, this.y)),
        f=Pi(v=Ind)(hug(this.v, outer.x)),
        g=(Ind >> Type) @ fun(v=Ind)(hug(this.v, outer.x)),
        k=ListOf(rectype(c=dog(outer.x))),
        r=rectype(a=Ind) @ {"a": this.x},
    )
    assert relabel(T, x="z") is rectype(
        z=Ind,
        n=rectype(y=Ind @ outer.z, e=hug(outer.z, this.y)),
        f=Pi(v=Ind)(hug(this.v, outer.z)),
        g=(Ind >> Type) @ fun(v=Ind)(hug(this.v, outer.z)),
        k=ListOf(rectype(c=dog(outer.z))),
        r=rectype(a=Ind) @ {"a": this.z},
    )


def test_a_label_inside_is_named_by_its_path():
    T = rectype(bg=rectype(x=Ind, c=dog(this.x)), e=dog(this.bg.x))
    assert relabel(T, {"bg.x": "z"}, bg="b") is rectype(
        b=rectype(z=Ind, c=dog(this.z)), e=dog(this.b.z)
    )
    r = record(bg={"x": "a", "c": "s"}, e="t")
    assert relabel(r, {"bg.x": "z"}, bg="b") == record(b={"z": "a", "c": "s"}, e="t")


def test_only_the_label_that_is_named_changes():
    T = rectype(x=Ind, n=rectype(x=Ind, c=hug(outer.x, this.x)))
    assert relabel(T, {"n.x": "z"}) is rectype(
        x=Ind, n=rectype(z=Ind, c=hug(outer.x, this.z))
    )


def test_a_label_changes_in_every_part_of_a_meet_join_and_negation():
    R, S = rectype(x=A), rectype(z=A)
    T = rectype(m=meet(R, rectype(y=B)), j=join(R, rectype(x=B)), n=~R)
    names = {"m.x": "z", "j.x": "z", "n.x": "z"}
    assert relabel(T, names) is rectype(
        m=meet(S, rectype(y=B)), j=join(S, rectype(z=B)), n=~S
    )


def test_a_label_changes_in_what_a_field_is_set_to():
    T = rectype(bg=rectype(x=A) @ {"x": "a"})
    assert relabel(T, {"bg.x": "z"}) is rectype(bg=rectype(z=A) @ {"z": "a"})


def test_equal_records_are_renamed_alike_or_not_at_all():
    T = rectype(bg=rectype(x=A), o=rectype(x=A) @ this.bg)
    both = relabel(T, {"bg.x": "z", "o.x": "z"})
    assert both is rectype(bg=rectype(z=A), o=rectype(z=A) @ this.bg)
    with pytest.raises(IllFormedError, match=r"bg\.x cannot be renamed: o is about bg"):
        relabel(T, {"bg.x": "z"})
    with pytest.raises(IllFormedError, match=r"o\.x cannot be renamed: o is set to"):
        relabel(T, {"o.x": "z"})


def test_nothing_is_renamed_in_a_record_that_something_is_said_of():
    said = Application(Path(0, ("f",)), Path(0, ("bg",)))
    T = rectype(bg=rectype(x=A), f=rectype(x=A) >> A, c=A @ said)
    with pytest.raises(IllFormedError, match=r"c is about bg as a whole"):
        relabel(T, {"bg.x": "z"})
    with pytest.raises(
        IllFormedError, match=r"bg\.x cannot be renamed: B is no record"
    ):
        relabel(rectype(bg=B & rectype(x=A)), {"bg.x": "z"})


@pytest.mark.parametrize("value", [rectype(x=A, y=A), record(x="a", y="b")])
def test_labels_that_would_fall_together_are_named(value):
    with pytest.raises(
        IllFormedError, match="the labels x and y would both be called y"
    ):
        relabel(value, x="y")


def test_labels_fall_together_across_the_parts_of_a_meet():
    T = rectype(bg=meet(rectype(x=A), rectype(y=A)))
    with pytest.raises(IllFormedError, match="x and y in bg would both be called y"):
        relabel(T, {"bg.x": "y"})


@pytest.mark.parametrize("value", [PAIR, record(x="a", y="b", e="s")])
def test_a_label_that_is_not_there_is_named(value):
    with pytest.raises(IllFormedError, match="there is no ee") as caught:
        relabel(value, ee="z")
    assert caught.value.hint == "did you mean e?"


def test_what_cannot_be_relabelled_is_said():
    with pytest.raises(IllFormedError, match="relabel takes a record type or a record"):
        relabel(Ind, x="y")
    with pytest.raises(IllFormedError, match="a label is an identifier"):
        relabel(PAIR, x="bg.z")
    with pytest.raises(IllFormedError, match=r"a path as a text, as in 'bg\.x'"):
        relabel(PAIR, {3: "z"})
    with pytest.raises(IllFormedError, match="x is no record"):
        relabel(record(x="a"), {"x.y": "z"})


def test_a_type_whose_paths_lead_out_keeps_them():
    inner = relabel(rectype(x=Ind, c=hug(this.x, outer.x)), x="y")
    assert inner is rectype(y=Ind, c=hug(this.y, outer.x))


def test_the_cost_grows_with_the_size():
    fields = {f"x{i}": Ind for i in range(5000)}
    fields |= {f"c{i}": dog(this[f"x{i}"]) for i in range(5000)}
    found = relabel(rectype(fields), {f"x{i}": f"y{i}" for i in range(5000)})
    assert found["c4999"] is dog(this.y4999)
