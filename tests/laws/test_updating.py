"""Laws of updating: what is certain, what a rule makes of a state."""

from generators import models, objects, record_types, records, types
from hypothesis import assume, given

from ttr import ListOf, NonEmpty, TTRError, amerge, meet, merge
from ttr.certainty import certainly, certainly_also
from ttr.probability import CERTAIN


@given(types(), objects(), models())
def test_certainty_is_that_of_the_derivation(T, a, M):
    assert certainly(M.facts, a, T) == (M.judge(a, T).p == CERTAIN)


@given(record_types(), records(), models())
def test_certainty_of_records_is_that_of_the_derivation(T, r, M):
    assert certainly(M.facts, r, T) == (M.judge(r, T).p == CERTAIN)


@given(types(), types(), models())
def test_what_is_known_need_not_be_judged_again(T, known, M):
    try:
        a, M = M.create(known)
    except TTRError:
        assume(False)
    for asked in (T, known, meet(T, known), ListOf(T), NonEmpty(known)):
        for sit, given_ in ((a, known), ((a, a), ListOf(known)), ((), ListOf(known))):
            found = certainly_also(M.facts, sit, asked, given_)
            assert found == certainly(M.facts, sit, asked)


@given(record_types(), record_types(), models())
def test_what_is_known_of_records_need_not_be_judged_again(T, known, M):
    try:
        r, M = M.create(known)
    except TTRError:
        assume(False)
    for asked in (T, known, merge(T, known), amerge(known, T)):
        found = certainly_also(M.facts, r, asked, known)
        assert found == certainly(M.facts, r, asked)
