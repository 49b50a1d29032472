"""The ten objects of the paper, by name."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from kille.sensors.synthetic.obj_files import load_model
from kille.sensors.synthetic.toy_model import ToyModel

TOY_NAMES = (
    "apple",
    "banana",
    "teddy bear",
    "book",
    "cap",
    "car",
    "cup",
    "can of paint",
    "shoe",
    "shoe-box",
)

ALSO_CALLED = {
    "bear": "teddy bear",
    "teddy": "teddy bear",
    "paint": "can of paint",
    "paint can": "can of paint",
    "tin of paint": "can of paint",
    "box of shoes": "shoe-box",
    "toy car": "car",
    "mug": "cup",
}

_TOYS = Path(__file__).with_name("toys")


@lru_cache(maxsize=len(TOY_NAMES))
def toy_model(name: str) -> ToyModel:
    """The model of one of `TOY_NAMES`, read once. KeyError for another name.

    It was made by `python -m tools.modelling.toys`.
    """
    if name not in TOY_NAMES:
        raise KeyError(name)
    return load_model(_TOYS / f"{name.replace(' ', '_')}.obj")
