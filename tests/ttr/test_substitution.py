"""Putting objects in the place of paths."""

import pytest

from ttr import Ind, Pred, outer, record, rectype, this
from ttr.types.objects import Path, UnresolvedError
from ttr.types.paths import replace_paths
from ttr.types.substitution import follow_path, resolve_paths

hug = Pred("hug", Ind, Ind)


def test_grounding_through_the_records_around():
    here, around = {"x": "a"}, {"x": "b", "n": record(y="c")}
    assert resolve_paths(hug(this.x, outer.x), (here, around)) is hug("a", "b")
    assert resolve_paths(hug(this.x, outer["n.y"]), (here, around)) is hug("a", "c")


def test_grounding_reaches_into_nested_types_and_values():
    T = rectype(x=Ind, n=rectype(c=hug(this.x, outer(2).z), x=Ind @ outer.x))
    grounded_type = resolve_paths(T, ({"z": "k"},))
    assert grounded_type is rectype(
        x=Ind, n=rectype(c=hug(this.x, "k"), x=Ind @ outer.x)
    )
    value = Ind @ {"a": [this.z, rectype(c=hug(outer.z, "j"))]}
    assert resolve_paths(value, ({"z": "k"},)) is Ind @ {
        "a": ["k", rectype(c=hug("k", "j"))]
    }


def test_a_replacement_is_moved_along():
    T = rectype(n=rectype(c=hug(outer(2).x, "j")))
    moved = replace_paths(T, lambda path: Path(path.up, ("y",)))
    assert moved is rectype(n=rectype(c=hug(outer(2).y, "j")))


def test_a_type_without_paths_is_itself():
    T = rectype(x=Ind, c=hug(this.x, this.x))
    assert resolve_paths(T, ()) is T


@pytest.mark.parametrize(
    ("path", "message"),
    [
        (this.y, "the path y leads nowhere: there is no y"),
        (this.x.y, "the path y leads nowhere: no record has y"),
        (outer.x, "the path x leads out of every record"),
    ],
)
def test_what_leads_nowhere(path, message):
    with pytest.raises(UnresolvedError, match=message):
        resolve_paths(Ind @ path, ({"x": "a"},))


def test_along():
    assert follow_path(record(bg=record(x="a")), ("bg", "x")) == "a"
    assert follow_path("a", ()) == "a"
    with pytest.raises(UnresolvedError, match=r"the path bg\.y leads nowhere"):
        follow_path(record(bg=record(x="a")), ("bg", "y"))
