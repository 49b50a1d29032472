"""The learned merge: which patches belong together as one thing.

Small networks say from a pair's features how likely the two belong to one thing. Their
log-odds are the weights of a graph, whose edges are contracted greedily, the most
certain first; the weights of parallel edges add up [1]. What came of it is measured
anew and judged by other networks, to which a leg and a body are pairs of pieces where
the first saw patches of them only [2]. The networks were fitted by
`tools.fitting.merge`, which says on what.

[1] M. Keuper et al.: Efficient decomposition of image and mesh graphs by lifted
multicuts. ICCV 2015 (greedy additive edge contraction).
[2] J. Nunez-Iglesias et al.: Machine learning of hierarchical clustering to segment 2D
and 3D images. PLoS ONE 2013 (pairs are judged anew as pieces grow).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from kille.perception.surfaces.pairs import FEATURES, Pairs, pairs_of
from kille.perception.surfaces.patch_measures import Vectors, measure_patches
from kille.perception.surfaces.patches import Surface
from kille.perception.surfaces.relief import Labels, Relief
from kille.perception.table import Plane

WEIGHTS = "merge.npz"
_CERTAIN = 1e-4


@dataclass(frozen=True, eq=False)
class Committee:
    """Networks with one hidden layer each, whose mean is the answer.

    mean, scale (n,): of the features; hidden (m, n, h), hidden_bias (m, h), output
    (m, h), output_bias (m,): of m networks with h hidden units.
    """

    mean: Vectors
    scale: Vectors
    hidden: Vectors
    hidden_bias: Vectors
    output: Vectors
    output_bias: Vectors

    def probabilities(self, features: Vectors) -> Vectors:
        """The probability (k,) that the two of each row (k, n) belong to one thing."""
        inputs = (features - self.mean) / self.scale
        units = np.maximum(inputs @ self.hidden + self.hidden_bias[:, None], 0)
        score = np.einsum("mkh,mh->mk", units, self.output) + self.output_bias[:, None]
        mean: Vectors = (1 / (1 + np.exp(-score))).mean(axis=0)
        return mean


@dataclass(frozen=True, eq=False)
class Merger:
    """Judges pairs that touch and pairs that do not, with a bias against merging.

    `bias` is added to the log-odds of every pair: the evidence of parallel edges is not
    independent, as their sum takes it to be.
    """

    touching: Committee
    parted: Committee
    bias: float

    def log_odds(self, pairs: Pairs) -> Vectors:
        """The log odds (m,) that the two patches of each pair belong to one thing."""
        p = np.where(
            pairs.touching,
            self.touching.probabilities(pairs.features),
            self.parted.probabilities(pairs.features),
        ).clip(_CERTAIN, 1 - _CERTAIN)
        odds: Vectors = np.log(p / (1 - p)) + self.bias
        return odds


Rounds = tuple[Merger, ...]
"""The merger of patches, followed by the merger of the resulting pieces."""


@cache
def default_rounds() -> Rounds:
    """The rounds that come with the package."""
    with (files(__package__) / WEIGHTS).open("rb") as file, np.load(file) as stored:
        return rounds_from_arrays(stored)


def rounds_to_arrays(rounds: Rounds) -> dict[str, NDArray[np.float32]]:
    """Convert the rounds to named arrays, as a file stores them."""
    arrays = {
        f"{number} {kind} {name}": np.asarray(values, np.float32)
        for number, merger in enumerate(rounds)
        for kind in ("touching", "parted")
        for name, values in vars(getattr(merger, kind)).items()
    }
    biases = [merger.bias for merger in rounds]
    return {**arrays, "biases": np.array(biases, np.float32)}


def rounds_from_arrays(stored: Mapping[str, NDArray[np.float32]]) -> Rounds:
    """Convert named arrays to rounds. ValueError if they judge other features."""
    rounds = tuple(
        Merger(
            _committee(stored, f"{number} touching"),
            _committee(stored, f"{number} parted"),
            float(bias),
        )
        for number, bias in enumerate(stored["biases"])
    )
    for merger in rounds:
        if merger.touching.mean.shape != (len(FEATURES),):
            raise ValueError(
                f"the merger judges {merger.touching.mean.size} features, not "
                f"{len(FEATURES)}: "
                "fit it again with `python -m tools.fitting.merge`"
            )
    return rounds


def _committee(stored: Mapping[str, NDArray[np.float32]], kind: str) -> Committee:
    names = Committee.__dataclass_fields__
    return Committee(**{it: stored[f"{kind} {it}"].astype(np.float64) for it in names})


def merge_patches(
    labels: Labels, relief: Relief, surface: Surface, table: Plane, rounds: Rounds
) -> Labels:
    """Relabel patches (h, w) so that those of one thing share a label, from 1."""
    for merger in rounds:
        number = int(labels.max())
        if number < 2:
            break
        patches = measure_patches(labels, relief, surface, table)
        pairs = pairs_of(labels, relief, surface, patches)
        things = contract_edges(number, pairs, merger.log_odds(pairs))
        _, names = np.unique(things, return_inverse=True)
        labels = np.concatenate([[0], names + 1]).astype(np.int32)[labels]
    return labels


def contract_edges(number: int, pairs: Pairs, odds: Vectors) -> NDArray[np.intp]:
    """For each of `number` patches (k,), the first patch that it is merged with.

    The edge with the highest weight is contracted, as long as one is above 0.
    """
    weights = np.zeros((number, number))
    weights[pairs.one, pairs.other] = weights[pairs.other, pairs.one] = odds
    things = np.arange(number)
    while True:
        one, other = np.unravel_index(weights.argmax(), weights.shape)
        if weights[one, other] <= 0:
            return things
        one, other = min(one, other), max(one, other)
        weights[one] += weights[other]
        weights[:, one] = weights[one]
        weights[one, one] = 0
        weights[other] = weights[:, other] = 0
        things[things == other] = one
