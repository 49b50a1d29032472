"""The Fisher vector: how descriptors differ from a typical distribution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from importlib.resources import files

import numpy as np

from kille.perception.cues.dense import Descriptors
from kille.perception.geometry import Array

LENGTH = 512
"""Numbers of a shortened vector: of 4,800, which told things apart no better."""

_PLACE = np.float32(3.5)  # makes the deviation of a place about 1, as all others


@dataclass(frozen=True, eq=False)
class Codebook:
    """A mixture of k Gaussians, diagonal, over d numbers a descriptor.

    A descriptor's numbers are its principal components, of unit variance, and its
    place: mean (m,), axes (m, d - 2), weights (k,), means and deviations (k, d).
    """

    mean: Array
    axes: Array
    weights: Array
    means: Array
    deviations: Array

    def shares(self, numbers: Array) -> Array:
        """The probability (n, k) that each descriptor belongs to each Gaussian."""
        precision = self.deviations**-2
        constant = (
            np.log(self.weights)
            - np.log(self.deviations).sum(axis=1)
            - (self.means**2 * precision).sum(axis=1) / 2
        )
        logs = constant + numbers @ (self.means * precision).T
        logs -= numbers**2 @ precision.T / 2
        logs -= logs.max(axis=1, keepdims=True)
        shares = np.exp(logs)
        shares /= shares.sum(axis=1, keepdims=True)
        return np.asarray(shares, np.float32)

    def fisher(self, found: Descriptors) -> Array:
        """The Fisher vector (2 k d,) of these descriptors, of length 1.

        Source: Perronnin, Sánchez & Mensink 2010, "Improving the Fisher kernel":
        signed roots, then length 1.
        """
        these = numbers(found, self.mean, self.axes)
        shares = self.shares(these)
        counts = shares.sum(axis=0)[:, None]
        first, second = shares.T @ these, shares.T @ these**2
        centred = first - counts * self.means
        spread = second - 2 * self.means * first + counts * self.means**2
        means = centred / self.deviations
        deviations = (spread / self.deviations**2 - counts) / np.sqrt(np.float32(2))
        roots = np.sqrt(self.weights)[:, None] * np.float32(len(these))
        vector = np.concatenate([(means / roots).ravel(), (deviations / roots).ravel()])
        vector = np.sign(vector) * np.sqrt(np.abs(vector))
        return np.asarray(vector / max(np.linalg.norm(vector), 1e-9), np.float32)


def numbers(found: Descriptors, mean: Array, axes: Array) -> Array:
    """The numbers (n, d) of each descriptor: its components and its place."""
    parts = (found.values - mean) @ axes
    return np.concatenate([parts, found.places * _PLACE], axis=1)


def project_vector(vector: Array) -> Array:
    """Project a vector (n,) to LENGTH numbers, nearly keeping distances.

    The projection has random signs, which are always the same.
    Source: Achlioptas 2003, "Database-friendly random projections".
    """
    shorter: Array = vector @ _signs(len(vector)) / np.float32(np.sqrt(LENGTH))
    return shorter


@cache
def _signs(length: int) -> Array:
    # Raw numbers of a bit generator are the same with every version of NumPy.
    raw = np.random.PCG64(0).random_raw(length * LENGTH // 64)
    bits = np.unpackbits(raw.astype("<u8").view(np.uint8)).reshape(length, LENGTH)
    return np.where(bits > 0, np.float32(1), np.float32(-1))


def load_codebook(name: str) -> Codebook:
    """A codebook that comes with the package: `texture` or `paint`.

    They are made by `python -m tools.fitting.codebook`.
    """
    return _codebooks()[name]


@cache
def _codebooks() -> Mapping[str, Codebook]:
    with files("kille.perception.cues").joinpath("codebooks.npz").open("rb") as file:
        found = {name: it.astype(np.float32) for name, it in np.load(file).items()}
    return {
        book: Codebook(*(found[f"{book}_{part.name}"] for part in fields(Codebook)))
        for book in ("texture", "paint")
    }
