"""Laws of updating: what is certain, what a rule makes of a state."""

from generators import models, objects, record_types, records, types
from hypothesis import given

from ttr.certainty import certainly
from ttr.probability import CERTAIN


@given(types(), objects(), models())
def test_certainty_is_that_of_the_derivation(T, a, M):
    assert certainly(M.facts, a, T) == (M.judge(a, T).p == CERTAIN)


@given(record_types(), records(), models())
def test_certainty_of_records_is_that_of_the_derivation(T, r, M):
    assert certainly(M.facts, r, T) == (M.judge(r, T).p == CERTAIN)
