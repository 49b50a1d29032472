"""Theories side by side: what differs stands out, what is the same is said once."""

from __future__ import annotations

import re
from collections.abc import Iterator

from hypothesis import given
from hypothesis import strategies as st

from kille.lab.reports.layouts import side_by_side
from ttr import Ind, Pred, Record, record, rectype, this
from ttr.display.differences import mark_differences, omit_common_fields
from ttr.display.layout import Layout, Matrix, layout_of

RECORDS = st.recursive(
    st.sampled_from(["a", "b"]),
    lambda inner: st.dictionaries(
        st.sampled_from(["x", "y", "z", "v", "w"]), inner, min_size=1
    ).map(record),
    max_leaves=12,
).filter(lambda it: isinstance(it, Record))


def changed(layout: Layout, *path: str) -> Iterator[str]:
    """The paths of the fields that are marked."""
    if isinstance(layout, Matrix):
        for row in layout.rows:
            here = (*path, row.label.text)
            if row.changed:
                yield ".".join(here)
            yield from changed(row.has, *here)


def marked(one: object, *others: object) -> list[str]:
    return list(
        changed(mark_differences(layout_of(one), [layout_of(it) for it in others]))
    )


def test_of_records_the_innermost_fields_are_marked() -> None:
    one = record(bands=record(sure=0.6, think=0.2), mode="driven")
    other = record(bands=record(sure=0.8, think=0.2), mode="driven")
    assert marked(one, other) == ["bands.sure"]
    assert marked(one, one, other) == ["bands.sure"]
    assert marked(one, one) == []


def test_of_types_the_fields_are_marked_that_the_other_lacks() -> None:
    dog, hug = Pred("dog", Ind), Pred("hug", Ind)
    one, other = rectype(x=Ind, c=dog(this.x)), rectype(x=Ind, c=hug(this.x))
    assert marked(one, other) == ["c"]
    assert marked(rectype(x=Ind, c=dog(this.x)), rectype(x=Ind)) == ["c"]


def test_where_the_other_is_something_else_all_is_marked() -> None:
    assert marked(rectype(x=Ind, y=Ind), Ind) == ["x", "y"]


@given(RECORDS, RECORDS)
def test_nothing_is_marked_just_if_they_are_the_same(
    one: Record, other: Record
) -> None:
    found = [*marked(one, other), *marked(other, one)]
    assert bool(found) == (one != other)


@given(RECORDS, RECORDS)
def test_what_is_marked_is_still_there_when_it_is_shortened(
    one: Record, other: Record
) -> None:
    layout = mark_differences(layout_of(one), [layout_of(other)])
    assert list(changed(omit_common_fields(layout))) == list(changed(layout))


def test_what_is_the_same_is_counted() -> None:
    one = record(a=record(b="1", c="2"), d="3", e="4", f="5")
    other = record(a=record(b="1", c="2"), d="3", e="4", f="6")
    layout = omit_common_fields(mark_differences(layout_of(one), [layout_of(other)]))
    assert isinstance(layout, Matrix)
    assert [row.label.text for row in layout.rows] == ["f", "…"]
    assert "4 fields as in all" in str(layout.rows[-1].has)


def test_rules_that_differ_come_first() -> None:
    page = "".join(
        side_by_side(
            {
                "bold": {"rules": {"hear": "He is heard.", "ask": "It asks."}},
                "shy": {"rules": {"hear": "He is heard.", "hedge": "<It> hedges."}},
            }
        )
    )
    assert page.index("hedge") < page.index("hear")
    assert '<td class="apart">–</td>' in page
    assert "&lt;It&gt; hedges." in page
    assert "1 the same in all" in page


def test_parts_that_are_the_same_come_last_and_folded() -> None:
    parts = {"state": rectype(x=Ind), "about": ""}
    page = "".join(
        side_by_side({"a": {**parts, "mode": "x"}, "b": {**parts, "mode": "y"}})
    )
    assert page.index("mode") < page.index("the same in all: state") < page.index("Ind")
    assert "about" not in page


def test_theories_that_are_alike_stand_together() -> None:
    """Of three the first and the last have the same strategy."""
    strategies = {"a": "bold", "<b>": "shy", "c": "bold"}
    shown = {
        name: {"strategy": record(mode=it), "rules": {"hear": it, "ask": "so"}}
        for name, it in strategies.items()
    }
    page = "".join(side_by_side(shown))
    strategy, rules = page.split("<h3>rules</h3>")
    assert [
        re.findall(r">([^<]+)<", it) for it in re.findall(r"<h4>.*?</h4>", strategy)
    ] == [
        ["a", "c"],
        ["&lt;b&gt;"],
    ]
    assert strategy.count('class="ttr"') == 2
    assert rules.count("<th>") == 3
    assert rules.count('<td class="apart">') == 2


def test_types_by_name_are_matrices_with_what_differs_marked() -> None:
    dog, hug = Pred("dog", Ind), Pred("hug", Ind)
    one, other = rectype(x=Ind, c=dog(this.x)), rectype(x=Ind, c=hug(this.x))
    page = "".join(
        side_by_side(
            {
                "one": {"meanings": {"It": one, "This": one}},
                "other": {"meanings": {"It": other, "This": one}},
            }
        )
    )
    assert page.count('<td class="type">') == 2
    assert page.count("ttr-changed") == 2
    assert "1 the same in all" in page


def test_what_theories_are_about_is_told_of_those_that_say_it() -> None:
    page = "".join(side_by_side({"a": {"about": "Bold."}, "b": {"about": ""}}))
    assert "<dt>a</dt>" in page
    assert "<dt>b</dt>" not in page
    alone = "".join(side_by_side({"a": {"about": "Bold <3."}}))
    assert alone == "<p>Bold &lt;3.</p>"
