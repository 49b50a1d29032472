"""What a record type must not be: paths to nowhere, arguments that do not fit."""

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pred,
    Rec,
    RecordType,
    Type,
    outer,
    rectype,
    this,
    wellformed,
)
from ttr.computing.path_cycles import has_fields_in_order
from ttr.errors import IllFormedError
from ttr.signature.signature import Axiom, Signature

Dog, Image = Basic("Dog"), Basic("Image")
dog = Pred("dog", Ind)
cup = Pred("cup", Ind, Image)
event = Pred("event", (Ind,), (dog("a"),))


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"c": dog(this.x)}, "the path x leads nowhere: [c : dog(.x)] has no x"),
        (
            {"x": Ind, "c": dog(this.x.y)},
            "the path x.y leads nowhere: Ind is no record",
        ),
        ({"x": Rec, "c": dog(this.x.y)}, "the path x.y leads nowhere: Rec has no y"),
        (
            {"image": Image, "x": Ind, "c": cup(this.x, this.imag)},
            "did you mean image?",
        ),
        (
            {"x": Ind, "n": rectype(c=dog(outer.y))},
            "the path y leads nowhere: [n : [c : dog(^.y)], x : Ind] has no y",
        ),
        ({"x": Ind, "y": Ind @ {"a": [this.z]}}, "the path z leads nowhere"),
        (
            {"x": Ind, "i": Image, "c": cup(this.i, this.x)},
            "in the field c, cup(i, x) needs Ind for i, but that is of Image",
        ),
        (
            {"i": Image, "n": rectype(m=rectype(c=dog(outer(2).i)))},
            "in the field n.m.c, dog(i) needs Ind for i, but that is of Image",
        ),
        ({"i": Image, "c": ListOf(dog(this.i))}, "in the field c, dog(i) needs Ind"),
        ({"i": Image, "c": dog("a") & dog(this.i)}, "in the field c, dog(i) needs"),
        ({"T": Type, "c": dog(this.T)}, "dog(T) needs Ind for T, but that is of Type"),
    ],
)
def test_refused(fields, message):
    with pytest.raises(IllFormedError) as caught:
        rectype(fields)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    "fields",
    [
        {"x": Ind & Dog, "c": dog(this.x)},
        {"x": Ind @ "a", "c": dog(this.x)},
        {"n": rectype(x=Ind) & rectype(y=Ind), "c": dog(this.n.x), "d": dog(this.n.y)},
        {"n": rectype(x=Ind) @ {"x": "a"}, "c": dog(this.n.x)},
        {"x": Ind, "y": dog("a"), "c": event(this.x), "d": event(this.y)},
        {"c": dog(outer.x)},
    ],
)
def test_accepted(fields):
    assert set(rectype(fields).labels) == set(fields)


def test_what_fits_by_an_axiom():
    theory = Signature(axioms=(Axiom(Dog, Ind),))
    fields = {"x": Dog, "c": dog(this.x)}
    with pytest.raises(IllFormedError, match="needs Ind for x, but that is of Dog"):
        rectype(fields)
    assert str(rectype(fields, theory)) == "[x : Dog, c : dog(x)]"


def test_the_question_has_an_answer_with_a_reason():
    assert wellformed(Ind).yes
    assert wellformed(rectype(x=Ind, c=dog(this.x))).yes
    circular = rectype(x=Ind @ this.y, y=Ind @ this.x)
    assert str(wellformed(circular)) == "no: its paths go in a circle: x → y → x"
    raw = RecordType((("c", dog(this.x)),))
    assert wellformed(raw).why == "the path x leads nowhere: [c : dog(.x)] has no x"
    misfit = RecordType((("x", Dog), ("c", dog(this.x))))
    assert wellformed(misfit).no
    assert wellformed(misfit, Signature(axioms=(Axiom(Dog, Ind),))).yes
    with pytest.raises(
        IllFormedError, match="expected a type, found the predicate dog"
    ):
        wellformed(dog)


def test_a_label_of_the_record_around_is_reached_by_outer():
    with pytest.raises(IllFormedError, match="the path x leads nowhere") as caught:
        rectype(x=Ind, y=rectype(c=dog(this.x)))
    assert caught.value.hint == "outer.x, written ^.x, is the x one record further out"
    rectype(x=Ind, y=rectype(c=dog(outer.x)))


def test_the_label_that_was_meant_comes_before_those_further_out():
    with pytest.raises(IllFormedError) as caught:
        rectype(xy=Ind, c=dog(this.x))
    assert caught.value.hint == "did you mean xy?"


def test_a_path_into_alternatives_leads_to_what_all_of_them_have():
    either = rectype(a=Dog) | rectype(a=Image, b=Ind)
    assert wellformed(rectype(x=either, y=Ind @ this.x.a)).yes
    fits = r"needs Ind for x\.a, but that is of Dog \\/ Image"
    with pytest.raises(IllFormedError, match=fits):
        rectype(x=either, c=dog(this.x.a))
    with pytest.raises(IllFormedError, match=r"has no b") as caught:
        rectype(x=either, c=dog(this.x.b))
    assert caught.value.hint == "b is in some alternatives only"


def test_fields_are_in_order_where_each_depends_on_those_before_it():
    inner = rectype(x=Ind, n=rectype(c=dog(outer.x)))
    assert has_fields_in_order(inner)
    assert has_fields_in_order(ListOf(rectype(x=Ind, y=Ind @ this.x)))
    assert not has_fields_in_order(rectype(x=Ind @ this.y, y=Ind @ this.x))
