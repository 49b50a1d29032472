"""Records and paths: labels own the names, and nothing changes."""

import numpy as np
import pytest

from ttr import Ind, Record, TTRError, outer, record, this
from ttr.errors import IllFormedError
from ttr.types import FiniteSet
from ttr.types.objects import Path, freeze

r = record(x="fido", bg=record(size=3), keys="k", items=[1, [2]])


def test_labels_are_attributes_and_paths_are_items():
    assert r.x == "fido"
    assert r["bg.size"] == r.bg.size == 3
    assert (r.keys, r.items) == ("k", (1, (2,)))
    assert "x" in r
    assert "y" not in r
    assert sorted(r) == ["bg", "items", "keys", "x"]
    assert len(r) == 4


def test_what_is_not_there():
    with pytest.raises(AttributeError, match="no label y in"):
        _ = r.y
    with pytest.raises(KeyError):
        _ = r["bg.y"]
    with pytest.raises(KeyError):
        _ = r["x.y"]
    assert not hasattr(r, "_repr_png_")
    assert not hasattr(this, "_repr_html_")


def test_equality_is_of_labels_and_objects():
    assert r == record(dict(zip(r, [r[k] for k in r], strict=True)))
    assert record(x=1) != record(x=True)
    assert record(x=1) != record(x=1.0)
    assert record(x="a") != record(x="a", y="a")
    assert record() != ()
    assert len({record(x=1, y=2), record(y=2, x=1)}) == 1


def test_arrays_in_records():
    a = np.zeros(3)
    assert record(x=a) == record(x=a)
    assert record(x=a) != record(x=np.zeros(3))
    assert len({record(x=a), record(x=a)}) == 1


def test_a_record_does_not_change():
    with pytest.raises(TTRError, match=r"replace\(r, x=…\)"):
        r.x = "sam"
    with pytest.raises(TTRError, match="x cannot be deleted"):
        del r.x


def test_freezing():
    assert freeze([1, {"x": [this.x]}]) == (1, Record({"x": (Path(0, ("x",)),)}))
    assert freeze({1, 2}) is FiniteSet(2, 1)


@pytest.mark.parametrize("label", ["_x", "", "a b", "a.b", 3, "1"])
def test_what_is_no_label(label):
    with pytest.raises(IllFormedError, match="a label is an identifier"):
        record({label: 1})


def test_a_label_is_there_once():
    with pytest.raises(IllFormedError, match="the label x is there twice"):
        record({"x": 1}, x=2)
    with pytest.raises(IllFormedError, match="record takes labels as keywords"):
        record([("x", 1)])


def test_any_label_may_be_written_as_a_keyword():
    assert record(fields=1, self=2, path=3).self == 2


def test_paths():
    assert freeze(this.x.y) is freeze(this["x.y"]) is Path(0, ("x", "y"))
    assert freeze(outer.x) is Path(1, ("x",))
    assert freeze(outer(3)["x"]) is Path(3, ("x",))
    assert freeze(this.path.labels) is Path(0, ("path", "labels"))
    assert repr(this.x) == "this.x"
    assert repr(outer(2)["if.x"]) == "outer(2)['if.x']"


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: Ind @ this, "a path needs a label, as in this.x"),
        (lambda: this(2), "only outer can be called"),
        (lambda: outer.x(), "a function is applied to an argument"),
        (lambda: outer(0), "how many scopes out, 1 or more, found 0"),
        (lambda: outer("x"), "how many scopes out, 1 or more, found 'x'"),
        (lambda: this["a..b"], "a label is an identifier"),
        (lambda: this[3], "a label is an identifier"),
    ],
)
def test_what_is_no_path(wrong, message):
    with pytest.raises(IllFormedError, match=message):
        wrong()


def test_a_path_is_not_iterated():
    with pytest.raises(TypeError, match="a path is no list"):
        list(this.x)


def test_wide_and_deep_records():
    wide = record({f"x{i}": i for i in range(5000)})
    assert wide == record({f"x{i}": i for i in reversed(range(5000))})
    deep = record()
    for _ in range(200):
        deep = record(n=deep)
    assert hash(deep) == hash(record(n=deep.n))
