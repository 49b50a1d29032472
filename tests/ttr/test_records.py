"""Changed copies of records."""

import pytest

from ttr import TTRError, record, replace
from ttr.types.records import differences

r = record(x="a", bg=record(size=3, n={"y": 1}))


def test_replacing_by_label_and_by_path():
    after = replace(r, {"bg.n.y": 2}, x="b")
    assert after == record(x="b", bg={"size": 3, "n": {"y": 2}})
    assert r.bg.n.y == 1
    assert replace(r) == r
    assert replace(r, x=[1]).x == (1,)


@pytest.mark.parametrize("path", ["y", "bg.y", "x.y", "bg.n.z"])
def test_replacing_adds_nothing(path):
    with pytest.raises(TTRError, match=r"is not in .*, so it cannot be replaced"):
        replace(r, {path: 1})


def test_replacing_suggests_a_label():
    with pytest.raises(TTRError, match=r"did you mean size\?"):
        replace(r, {"bg.sizes": 1})


def test_differences():
    other = record(y=1, bg=record(size=4, n={"y": True}))
    assert list(differences(r, other)) == [
        "bg.n.y: 1 → <bool True>",
        "bg.size: 3 → 4",
        "x: a → nothing",
        "y: nothing → 1",
    ]
    assert list(differences(r, r)) == []


def test_differences_of_lists_name_what_came_and_went():
    def told(before, after):
        return list(differences(record(xs=before), record(xs=after)))

    assert told(["a"], ["a", "b", "c"]) == ["xs: + b", "xs: + c"]
    assert told(["a", "b"], ["b"]) == ["xs: − a"]
    assert told(["a"], ["a"]) == []
    assert told(["a"], ["b"]) == ["xs: [a] → [b]"]
