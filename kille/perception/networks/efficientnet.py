"""EfficientNet-Lite0: from a picture to its features, as a file for OpenCV.

A stem, sixteen blocks and a head of convolutions, each with the normalisation after it
folded into its weights,

    w' = w γ / √(σ² + ε),   b' = β - μ γ / √(σ² + ε)

and min(max(x, 0), 6) after all but the last of a block. A block widens the channels,
looks around in each of them, and narrows them again; what comes in is added to what
comes out where both have the same shape. The features are the means of the head over
the picture.
Source: Tan & Le 2019, "EfficientNet"; R. Liu 2020, "Higher accuracy on vision models
with EfficientNet-Lite".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.perception.networks.onnx_files import Port, constant, node, onnx_file

SIDE = 224
"""Pixels of the pictures that it was trained on."""

FEATURES = 1280

_EPSILON = 1e-3
_HIGHEST = 6.0


class _Stage(NamedTuple):
    """Some blocks alike, of which the first has the stride."""

    blocks: int
    kernel: int
    stride: int


_STAGES = (
    _Stage(1, 3, 1),
    _Stage(2, 3, 2),
    _Stage(2, 5, 2),
    _Stage(3, 3, 2),
    _Stage(3, 5, 1),
    _Stage(4, 5, 2),
    _Stage(1, 3, 1),
)


def features_network(weights: Mapping[str, NDArray[Any]], pictures: int) -> bytes:
    """The network that gives the features (pictures, 1280, 1, 1) of so many pictures
    (pictures, 3, 224, 224), as an ONNX file.

    KeyError if one of its weights is missing.
    """
    network = _Network(weights)
    network.convolve("_conv_stem", "_bn0", 3, stride=2)
    block = 0
    for stage in _STAGES:
        for repetition in range(stage.blocks):
            network.add_block(block, stage, first=repetition == 0)
            block += 1
    network.convolve("_conv_head", "_bn1", 1)
    network.compute("GlobalAveragePool", [network.last], "features")
    return onnx_file(
        "EfficientNet-Lite0",
        network.nodes,
        network.constants,
        Port("pictures", (pictures, 3, SIDE, SIDE)),
        Port("features", (pictures, FEATURES, 1, 1)),
    )


class _Network:
    """A network under construction: `last` is the name of what it gives so far."""

    def __init__(self, weights: Mapping[str, NDArray[Any]]) -> None:
        self._weights = weights
        self._side = SIDE
        self.last = "pictures"
        self.nodes: list[bytes] = []
        self.constants = [
            constant("lowest", np.array(0.0, np.float32)),
            constant("highest", np.array(_HIGHEST, np.float32)),
        ]

    def add_block(self, number: int, stage: _Stage, *, first: bool) -> None:
        own, before = f"_blocks.{number}.", self.last
        stride = stage.stride if first else 1
        if f"{own}_expand_conv.weight" in self._weights:
            self.convolve(f"{own}_expand_conv", f"{own}_bn0", 1)
        self.convolve(
            f"{own}_depthwise_conv", f"{own}_bn1", stage.kernel, stride, each=True
        )
        self.convolve(f"{own}_project_conv", f"{own}_bn2", 1, clipped=False)
        if not first:
            self.compute("Add", [self.last, before], f"{own}sum")

    def convolve(
        self,
        name: str,
        norm: str,
        kernel: int,
        stride: int = 1,
        *,
        each: bool = False,
        clipped: bool = True,
    ) -> None:
        """Convolve all channels together, or each by itself."""
        filters, biases = self._fold_norm(name, norm)
        self.constants.append(constant(f"{name}.weight", filters))
        self.constants.append(constant(f"{name}.bias", biases))
        self.compute(
            "Conv",
            [self.last, f"{name}.weight", f"{name}.bias"],
            name,
            kernel_shape=(kernel, kernel),
            strides=(stride, stride),
            pads=self._pads(kernel, stride),
            group=len(filters) if each else 1,
        )
        if clipped:
            self.compute("Clip", [self.last, "lowest", "highest"], f"{name}.clipped")

    def compute(
        self, operator: str, inputs: list[str], output: str, **attributes: Any
    ) -> None:
        self.nodes.append(node(operator, inputs, output, **attributes))
        self.last = output

    def _fold_norm(
        self, name: str, norm: str
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """The weights and biases of a convolution with the normalisation in them."""
        weights = self._weights
        spread = np.sqrt(weights[f"{norm}.running_var"] + _EPSILON)
        scale = weights[f"{norm}.weight"] / spread
        biases = weights[f"{norm}.bias"] - weights[f"{norm}.running_mean"] * scale
        filters = weights[f"{name}.weight"] * scale[:, None, None, None]
        return filters.astype(np.float32), biases.astype(np.float32)

    def _pads(self, kernel: int, stride: int) -> tuple[int, int, int, int]:
        """The pixels to add around the picture, of which the end gets one more.

        ONNX has a word for this, SAME_UPPER, but OpenCV adds them elsewhere.
        """
        before = self._side
        self._side = -(-before // stride)
        both = max(0, (self._side - 1) * stride + kernel - before)
        return both // 2, both // 2, both - both // 2, both - both // 2
