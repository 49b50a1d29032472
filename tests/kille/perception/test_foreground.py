"""The foreground of a picture without depth: a guess, but a good one."""

from __future__ import annotations

import warnings
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from kille.perception.foreground import enclosure, guess, isolation, saliency
from kille.scene import Frame, Mask
from kille.sensors.pictures import read_colour


def picture(colour: NDArray[np.uint8]) -> Frame:
    return Frame(colour, None, None, 0.0, {})


def thing(
    colour: tuple[int, int, int], background: int, size: int = 224
) -> tuple[Frame, Mask]:
    """An ellipse on a wall and a table with grain and falling light, and its pixels."""
    chance = np.random.default_rng(0)
    scene = np.full((size, size, 3), background, np.float64)
    scene[int(0.7 * size) :] *= 0.8
    shade = np.linspace(1.1, 0.8, size)[None, :, None]
    mask = np.zeros((size, size), np.uint8)
    middle, axes = (size // 2, int(0.58 * size)), (size // 5, size // 4)
    cv2.ellipse(mask, middle, axes, 15, 0, 360, 1, -1)
    scene[mask > 0] = colour
    noisy = scene * shade + chance.normal(0, 3, scene.shape)
    return picture(np.clip(noisy, 0, 255).astype(np.uint8)), mask > 0


def agreement(one: Mask, other: Mask) -> float:
    return float((one & other).sum() / (one | other).sum())


@pytest.mark.parametrize("background", [60, 120, 220])
@pytest.mark.parametrize("colour", [(200, 40, 40), (230, 200, 40), (20, 60, 160)])
@pytest.mark.parametrize("size", [120, 224, 600])
def test_a_plain_thing_before_a_plain_wall_is_found(
    background: int, colour: tuple[int, int, int], size: int
) -> None:
    frame, mask = thing(colour, background, size)
    assert agreement(guess(frame), mask) > 0.85


def test_what_goes_on_to_the_edges_is_background() -> None:
    frame, mask = thing((200, 40, 40), 120)
    salient = cv2.resize(saliency(frame.colour[::2, ::2]), mask.shape)
    assert salient[mask].mean() > 0.7
    assert salient[~mask].mean() < 0.1


@pytest.mark.parametrize("colour", [(228, 226, 224), (240, 240, 240)])
def test_white_before_white_is_found(colour: tuple[int, int, int]) -> None:
    frame, mask = thing(colour, 215)
    assert agreement(guess(frame), mask) > 0.7


def test_what_reaches_the_edges_is_not_cut_off_and_not_enclosed() -> None:
    frame, mask = thing((200, 40, 40), 120)
    small, there = frame.colour[::2, ::2], mask[::2, ::2]
    for guessed, least in ((isolation(small), 3.0), (enclosure(small), 1.2)):
        assert guessed[there].mean() > least * guessed[~there].mean()


def test_a_guess_is_the_same_each_time() -> None:
    frame, _ = thing((20, 60, 160), 200)
    assert np.array_equal(guess(frame), guess(frame))


@pytest.mark.parametrize("shape", [(1, 1), (1, 500), (9, 9), (40, 400), (3000, 4000)])
@pytest.mark.parametrize("level", [0, 128, 255])
def test_there_is_always_a_guess(shape: tuple[int, int], level: int) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mask = guess(picture(np.full((*shape, 3), level, np.uint8)))
    assert mask.shape == shape
    assert mask.dtype == bool
    assert mask.any()


@settings(deadline=None, max_examples=6)
@given(st.integers(0, 2**32 - 1))
def test_there_is_a_guess_for_noise(seed: int) -> None:
    chance = np.random.default_rng(seed)
    shape = tuple(chance.integers(1, 200, 2))
    assert guess(picture(chance.integers(0, 256, (*shape, 3), np.uint8))).any()


def test_the_duck_and_the_bananas_are_found(data: Path) -> None:
    """Their colour says where they are: yellow, in pictures without much of it else."""
    agreed = [
        agreement(guess(frame), yellow)
        for name in ("banana/banana", "rubber_duck/rubber_duck")
        for frame, yellow in map(_with_yellow, _files(data / "sota_kinect", name))
    ]
    assert np.median(agreed) > 0.8
    assert np.mean(np.array(agreed) > 0.6) > 0.85


def _files(folder: Path, name: str) -> list[Path]:
    return [folder / f"{name}{k}.png" for k in range(10)]


def _with_yellow(path: Path) -> tuple[Frame, Mask]:
    colour = read_colour(path)
    b = cv2.cvtColor(colour, cv2.COLOR_RGB2LAB)[..., 2]
    return picture(colour), b > 150
