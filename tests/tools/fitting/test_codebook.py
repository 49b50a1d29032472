"""Fitting a codebook: what comes out describes what went in."""

from __future__ import annotations

import numpy as np
import pytest

from kille.perception.cues.dense import Descriptors
from kille.perception.cues.fisher import numbers
from tools.fitting.codebook import fit_codebook


def found(seed: int, kinds: int = 4, count: int = 800) -> Descriptors:
    """Descriptors of a few kinds, each kind in a place of its own."""
    chance = np.random.default_rng(seed)
    kind = chance.integers(kinds, size=count)
    middles = np.random.default_rng(99).normal(size=(kinds, 12)) * 5
    values = middles[kind] + chance.normal(size=(count, 12))
    places = np.stack([kind / kinds - 0.4, np.zeros(count)], axis=1)
    places += chance.normal(size=places.shape) * 0.02
    return Descriptors(values.astype(np.float32), places.astype(np.float32))


def test_each_kind_of_descriptor_gets_a_gaussian() -> None:
    book = fit_codebook(found(0), components=6, gaussians=4)
    assert book.weights == pytest.approx(0.25, abs=0.05)
    these = numbers(found(1), book.mean, book.axes)
    assert these[:, :6].std(axis=0) == pytest.approx(1, abs=0.15)
    assert np.median(book.shares(these).max(axis=1)) > 0.95


def test_the_fisher_vector_says_what_is_unusual() -> None:
    book = fit_codebook(found(0), components=6, gaussians=4)
    usual, again, odd = found(1), found(2), found(3)
    shifted = Descriptors(odd.values + np.float32(2), odd.places)
    vectors = [book.fisher(each) for each in (usual, again, shifted)]
    assert all(np.linalg.norm(each) == pytest.approx(1, abs=1e-4) for each in vectors)
    assert np.linalg.norm(vectors[0] - vectors[1]) < np.linalg.norm(
        vectors[0] - vectors[2]
    )
