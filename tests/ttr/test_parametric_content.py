"""Parametric contents, and the weak and the strong reading."""

import pytest

from ttr import Ind, Model, Pred, fun, record, rectype, this
from ttr.errors import IllFormedError, RefusedError
from ttr.semantics.parametric_content import apply, content, in_context, strong, weak
from ttr.semantics.quantifiers import truth

donkey, bray = Pred("donkey", Ind), Pred("bray", Ind)
own, beat = Pred("own", Ind, Ind), Pred("beat", Ind, Ind)

OWNED = rectype(y=Ind, c=donkey(this.y), o=own("f1", this.y))
BEATS = content(OWNED, fun(r=OWNED)(beat("f1", this.r.y)))


@pytest.fixture
def M():
    """f1 owns the donkeys d1 and d2, and beats d1 only."""
    M = Model().given("f1", Ind).given("b1", beat("f1", "d1"))
    for name in ("d1", "d2"):
        M = M.given(name, Ind).given(f"c{name}", donkey(name))
        M = M.given(f"o{name}", own("f1", name))
    return M


def test_some_context_or_all_of_them(M):
    assert truth(M, weak(BEATS)).p == (1, 1)
    assert truth(M, strong(BEATS)).p == (0, 0)
    M = M.given("b2", beat("f1", "d2"))
    assert truth(M, strong(BEATS)).p == (1, 1)


def test_the_weak_reading_is_a_record_type_with_a_witness(M):
    found = truth(M, weak(BEATS)).witness
    assert found == record(bg=record(y="d1", c="cd1", o="od1"), fg="b1")
    assert M.judge(found, weak(BEATS)).holds is True


def test_the_strong_reading_names_the_exception(M):
    why = str(truth(M, strong(BEATS)).why)
    assert "not for 1 of 2" in why
    assert "beat(f1, d2)" in why


def test_without_a_context_the_weak_reading_fails_and_the_strong_one_holds():
    M = Model().given("f1", Ind)
    assert truth(M, weak(BEATS)).p == (0, 0)
    assert truth(M, strong(BEATS)).p == (1, 1)


def test_an_uncertain_context_makes_it_a_degree(M):
    M = M.given("b2", beat("f1", "d2"), 0.25)
    assert truth(M, strong(BEATS)).p == (0.25, 0.25)


def test_a_content_is_asked_in_one_context(M):
    contexts = M.witnesses(OWNED)
    assert [in_context(M, BEATS, r).p for r in contexts] == [(1, 1), (0, 0)]
    with pytest.raises(RefusedError, match="takes objects of"):
        in_context(M, BEATS, record(y="f1"))


def test_contents_of_parts_are_composed():
    A, B = rectype(a=Ind), rectype(b=Ind)
    verb = content(A, fun(r=A)(fun(y=Ind)(bray(this.y))))
    name = content(B, fun(r=B)(this.r.b))
    whole = apply(verb, name)
    assert str(whole.bg) == "[a : [b : Ind], f : [a : Ind]]"
    context = record(f=record(a="x"), a=record(b="d1"))
    M = Model().given("x", Ind).given("d1", Ind)
    assert M.apply(whole.fg, context) is bray("d1")


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: content(Ind, bray("a")), "a background is a record type"),
        (lambda: content(rectype(y=Ind), BEATS.fg), "does not take the contexts of"),
        (lambda: weak(record(x="a")), "a parametric content is a record"),
        (lambda: strong("a"), "a parametric content is a record"),
    ],
)
def test_a_mistake_is_told(make, why):
    with pytest.raises(IllFormedError, match=why):
        make()


def test_a_type_is_a_foreground_that_depends_on_nothing():
    found = content(OWNED, bray("d1"))
    assert str(weak(found)).endswith("fg : bray(d1)]")
