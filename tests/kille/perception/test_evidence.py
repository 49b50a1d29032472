"""Evidence: degrees are probabilities, however much is added for a word."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.evidence import Evidence

logs = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=6)


@given(st.floats(-50, 50), logs, st.floats(-1e6, 1e6))
def test_degrees_are_probabilities_that_leave_room_for_none_of_the_words(base, e, more):
    labels = tuple("abcdef"[: len(e)])
    cues = {"colour": np.array(e), "form": np.full(len(e), more)}
    degrees = Evidence(labels, base, cues).degrees()
    assert tuple(degrees) == labels
    assert all(0.0 <= p <= 1.0 for p in degrees.values())
    assert math.fsum(degrees.values()) <= 1.0 + 1e-9


def test_the_degree_of_a_word_is_its_share_beside_none_of_the_words():
    cues = {"colour": np.log([2.0, 3.0]), "form": np.log([1.0, 2.0])}
    degrees = Evidence(("cup", "mug"), math.log(0.5), cues).degrees()
    assert degrees == pytest.approx({"cup": 1 / 5, "mug": 3 / 5})
    assert Evidence((), 0.0, {}).degrees() == {}
