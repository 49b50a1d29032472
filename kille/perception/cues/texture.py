"""Texture and paint: edges and colours at all places of a thing, as Fisher vectors."""

from __future__ import annotations

from kille.perception.cues.dense import Descriptors, colours, edges
from kille.perception.cues.fisher import LENGTH as LENGTH
from kille.perception.cues.fisher import load_codebook, project_vector
from kille.perception.cues.patch import Patch
from kille.scene import Vector


def texture(patch: Patch) -> Vector | None:
    """Which edges lie where on the region (512,); None for next to no pixels."""
    return None if patch.window is None else _fisher("texture", edges(patch.window))


def paint(patch: Patch) -> Vector | None:
    """Which colours lie where beside which (512,); None for next to no pixels."""
    return None if patch.window is None else _fisher("paint", colours(patch.window))


def whole_texture(patch: Patch) -> Vector | None:
    """Which edges lie where in the whole picture (512,); None if it has depth."""
    return None if patch.whole is None else _fisher("texture", edges(patch.whole))


def whole_paint(patch: Patch) -> Vector | None:
    """Which colours lie where in the whole picture (512,); None if it has depth."""
    return None if patch.whole is None else _fisher("paint", colours(patch.whole))


def _fisher(book: str, found: Descriptors) -> Vector | None:
    return (
        project_vector(load_codebook(book).fisher(found)) if len(found.values) else None
    )
