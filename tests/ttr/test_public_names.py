"""The names a user writes, and where they come from."""

import pytest

import ttr


def test_every_public_name_is_there():
    for name in ttr.__all__:
        assert getattr(ttr, name) is not None
    assert len(set(ttr.__all__)) == len(ttr.__all__)


def test_every_public_name_is_documented():
    undocumented = [
        name
        for name in ttr.__all__
        if callable(getattr(ttr, name)) and not getattr(ttr, name).__doc__
    ]
    assert undocumented == []


def test_a_name_that_is_not_there():
    with pytest.raises(AttributeError, match="'ttr' has no attribute 'nonesuch'"):
        _ = ttr.nonesuch


def test_a_name_that_something_had_before_warns_and_works():
    theory = ttr.Theory()
    with pytest.warns(DeprecationWarning, match="Theory.related is now .*axiom_heads"):
        assert theory.related == theory.axiom_heads
