"""How views are parted."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from kille.perception.descriptor_index.partition import FACTOR, TAIL, partition_views

sizes = st.lists(st.integers(0, 3 * TAIL), max_size=200)


@given(sizes)
def test_runs_hold_every_view_once_and_fall_in_size(sizes: list[int]) -> None:
    partition = partition_views(sizes)
    starts = [0, *(run.stop for run in partition.runs)]
    assert [run.start for run in partition.runs] == starts[:-1]
    assert partition.tail_start == starts[-1]
    assert partition.views == len(sizes)
    assert [run.size for run in partition.runs] == [
        sum(sizes[run.start : run.stop]) for run in partition.runs
    ]
    assert partition.tail == sum(sizes[starts[-1] :]) <= TAIL
    for early, late in pairwise(partition.runs):
        assert early.size >= FACTOR * late.size


def test_there_are_few_runs_however_many_views() -> None:
    assert len(partition_views([300] * 10_000).runs) <= 3
    assert not partition_views([300] * 13).runs
