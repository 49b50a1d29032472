"""Cues: the appearance of a thing as a whole, each cue a vector.

A cue is a pure function of a patch, that is, of a region in a frame. The Euclidean
distance of two vectors says how unlike two things are in that cue.

>>> " ".join(CUES)
'colour hue size shape texture paint outline form pattern
whole_texture whole_paint whole_form whole_pattern'
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from kille.extras import MissingExtraError
from kille.perception.cues import (
    colour,
    embedding,
    gradients,
    pattern,
    shape,
    size,
    texture,
)
from kille.perception.cues.patch import Patch
from kille.scene import Frame, Region, Traits, Vector
from ttr.aliases import former_names

__getattr__ = former_names(__name__, {"measured": "measure_cues"})

__all__ = [
    "CUES",
    "EMBEDDING",
    "Cue",
    "MissingExtraError",
    "Patch",
    "measure_cues",
    "with_embedding",
]


@dataclass(frozen=True)
class Cue:
    """One respect in which things are compared.

    `measure` gives `length` finite numbers, or None for what cannot be told.

    >>> brightness = Cue("brightness", 1, lambda patch: patch.rgb.mean(keepdims=True))
    >>> brightness.length
    1
    """

    name: str
    length: int
    measure: Callable[[Patch], Vector | None]


CUES: Mapping[str, Cue] = MappingProxyType(
    {
        cue.name: cue
        for cue in (
            Cue("colour", colour.LENGTH, colour.colour),
            Cue("hue", colour.HUE_LENGTH, colour.hue),
            Cue("size", size.LENGTH, size.size),
            Cue("shape", shape.LENGTH, shape.shape),
            Cue("texture", texture.LENGTH, texture.texture),
            Cue("paint", texture.LENGTH, texture.paint),
            Cue("outline", gradients.LENGTH, gradients.outline),
            Cue("form", gradients.LENGTH, gradients.form),
            Cue("pattern", pattern.LENGTH, pattern.pattern),
            Cue("whole_texture", texture.LENGTH, texture.whole_texture),
            Cue("whole_paint", texture.LENGTH, texture.whole_paint),
            Cue("whole_form", gradients.LENGTH, gradients.whole_form),
            Cue("whole_pattern", pattern.WHOLE, pattern.whole_pattern),
        )
    }
)
"""The cues that need only the picture and its depth.

>>> from kille.perception.cues import CUES
>>> "colour" in CUES, "embedding" in CUES
(True, False)
"""

EMBEDDING = Cue("embedding", embedding.LENGTH, embedding.embedding)
"""What a pretrained network makes of a thing; it needs the extra `kille[embedding]`.

>>> from kille.perception.cues import EMBEDDING
>>> EMBEDDING.name
'embedding'
"""


def with_embedding() -> Mapping[str, Cue]:
    """The default cues and the embedding; MissingExtraError without its packages.

    >>> try:
    ...     cues = with_embedding()
    ... except MissingExtraError:
    ...     cues = CUES
    >>> set(CUES) <= set(cues)
    True
    """
    embedding.network()
    return MappingProxyType({**CUES, EMBEDDING.name: EMBEDDING})


def measure_cues(
    frame: Frame, region: Region, cues: Mapping[str, Cue] = CUES
) -> Traits:
    """Measure the cues of the region: a vector for each cue that applies.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> from kille.perception.segment import segment
    >>> traits = measure_cues(frame, segment(frame).regions[0])
    >>> "colour" in traits
    True
    """
    patch = Patch(frame, region)
    found = {name: cue.measure(patch) for name, cue in cues.items()}
    return {name: vector for name, vector in found.items() if vector is not None}
