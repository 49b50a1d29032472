"""The learned merge: its rounds, how they are kept, and when they stop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kille.perception.surfaces.merging import (
    default_rounds,
    merge_patches,
    rounds_from_arrays,
    rounds_to_arrays,
)
from kille.perception.surfaces.patches import patches_of, surface_of
from kille.perception.surfaces.relief import protruding_pixels, relief_of, table_in
from kille.sensors.synthetic import open_synthetic


def test_rounds_are_kept_as_they_are() -> None:
    again = rounds_from_arrays(rounds_to_arrays(default_rounds()))
    assert len(again) == len(default_rounds()) == 2
    for one, other in zip(again, default_rounds(), strict=True):
        assert one.bias == pytest.approx(other.bias)
        features = np.random.default_rng(0).normal(size=(5, other.touching.mean.size))
        for kind in ("touching", "parted"):
            odds, known = (
                getattr(it, kind).probabilities(features) for it in (one, other)
            )
            assert odds == pytest.approx(known)


def test_a_merger_of_other_features_is_refused() -> None:
    (first, *_) = default_rounds()
    fewer = replace(first.touching, mean=first.touching.mean[:-1])
    with pytest.raises(ValueError, match="fit it again"):
        rounds_from_arrays(rounds_to_arrays((replace(first, touching=fewer),)))


def test_each_round_puts_pieces_of_the_one_before_together() -> None:
    stage = open_synthetic("synthetic:empty?seed=5")
    stage.show("teddy bear")
    relief = relief_of(stage.frame())
    assert relief is not None
    table = table_in(relief)
    assert table is not None
    surface = surface_of(relief)
    patches = patches_of(relief, protruding_pixels(relief, table), surface)
    never = tuple(replace(it, bias=-100.0) for it in default_rounds())
    always = tuple(replace(it, bias=100.0) for it in default_rounds())
    assert np.array_equal(merge_patches(patches, relief, surface, table, ()), patches)
    assert np.array_equal(
        merge_patches(patches, relief, surface, table, never), patches
    )
    assert merge_patches(patches, relief, surface, table, always).max() == 1
    first = merge_patches(patches, relief, surface, table, default_rounds()[:1])
    both = merge_patches(patches, relief, surface, table, default_rounds())
    assert 1 <= both.max() <= first.max() < patches.max()
    for piece in range(1, int(first.max()) + 1):
        assert len(np.unique(both[first == piece])) == 1
