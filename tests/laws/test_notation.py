"""The notation reads back as what was printed."""

from generators import records, types
from hypothesis import given

from ttr import Theory


@given(types())
def test_a_printed_type_reads_back_as_itself(T):
    assert Theory.of(T).parse(str(T)) is T


@given(records())
def test_a_printed_record_reads_back_as_its_equal(r):
    assert Theory.of(r).parse(str(r)) == r
