"""The learned merge: its rounds, how they are kept, and when they stop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kille.perception.surfaces.merging import fitted, merged, packed, unpacked
from kille.perception.surfaces.patches import patches_of, surface_of
from kille.perception.surfaces.relief import relief_of, standing, table_in
from kille.sensors.synthetic import open_synthetic


def test_rounds_are_kept_as_they_are() -> None:
    again = unpacked(packed(fitted()))
    assert len(again) == len(fitted()) == 2
    for one, other in zip(again, fitted(), strict=True):
        assert one.bias == pytest.approx(other.bias)
        features = np.random.default_rng(0).normal(size=(5, other.touching.mean.size))
        for kind in ("touching", "parted"):
            odds, known = (
                getattr(it, kind).probabilities(features) for it in (one, other)
            )
            assert odds == pytest.approx(known)


def test_a_merger_of_other_features_is_refused() -> None:
    (first, *_) = fitted()
    fewer = replace(first.touching, mean=first.touching.mean[:-1])
    with pytest.raises(ValueError, match="fit it anew"):
        unpacked(packed((replace(first, touching=fewer),)))


def test_each_round_puts_pieces_of_the_one_before_together() -> None:
    stage = open_synthetic("synthetic:empty?seed=5")
    stage.show("teddy bear")
    relief = relief_of(stage.frame())
    assert relief is not None
    table = table_in(relief)
    assert table is not None
    surface = surface_of(relief)
    patches = patches_of(relief, standing(relief, table), surface)
    never = tuple(replace(it, bias=-100.0) for it in fitted())
    always = tuple(replace(it, bias=100.0) for it in fitted())
    assert np.array_equal(merged(patches, relief, surface, table, ()), patches)
    assert np.array_equal(merged(patches, relief, surface, table, never), patches)
    assert merged(patches, relief, surface, table, always).max() == 1
    first = merged(patches, relief, surface, table, fitted()[:1])
    both = merged(patches, relief, surface, table, fitted())
    assert 1 <= both.max() <= first.max() < patches.max()
    for piece in range(1, int(first.max()) + 1):
        assert len(np.unique(both[first == piece])) == 1
