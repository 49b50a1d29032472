"""Networks that OpenCV reads and computes as they were written."""

from __future__ import annotations

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from kille.perception.networks.onnx_files import Port, constant, node, onnx_file

Array = NDArray[np.float32]


def convolve_slowly(picture: Array, filters: Array, biases: Array, step: int) -> Array:
    """Convolve with one row more below and one column more on the right."""
    padded = np.pad(picture, ((0, 0), (0, 1), (0, 1)))
    kernel = filters.shape[2]
    windows = np.lib.stride_tricks.sliding_window_view(padded, (kernel, kernel), (1, 2))
    some = windows[:, ::step, ::step]
    sums = np.einsum("crsij,ocij->ors", some, filters)
    return np.asarray(sums + biases[:, None, None], np.float32)


@given(
    st.integers(0, 1000), st.integers(1, 2), st.integers(1, 3), st.integers(200, 300)
)
def test_a_network_computes_what_its_nodes_say(
    seed: int, step: int, out: int, side: int
) -> None:
    chance = np.random.default_rng(seed)
    picture = chance.random((2, side, side), np.float32)
    filters = chance.random((out, 2, 3, 3), np.float32)
    biases = chance.random(out, np.float32)
    expected = np.minimum(convolve_slowly(picture, filters, biases, step), 9)
    nodes = [
        node(
            "Conv",
            ["in", "w", "b"],
            "sums",
            kernel_shape=(3, 3),
            strides=(step, step),
            pads=(0, 0, 1, 1),
            group=1,
        ),
        node("Clip", ["sums", "lowest", "highest"], "out"),
    ]
    constants = [
        constant("w", filters),
        constant("b", biases),
        constant("lowest", np.array(0, np.float32)),
        constant("highest", np.array(9, np.float32)),
    ]
    file = onnx_file(
        "one",
        nodes,
        constants,
        Port("in", (1, *picture.shape)),
        Port("out", (1, *expected.shape)),
    )
    network = cv2.dnn.readNetFromONNX(np.frombuffer(file, np.uint8))
    network.setInput(picture[None])
    assert np.allclose(network.forward()[0], expected, atol=1e-4)
