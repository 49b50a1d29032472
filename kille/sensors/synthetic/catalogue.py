"""The ten objects of the paper, by name."""

from __future__ import annotations

from functools import lru_cache

from kille.sensors.synthetic import boxes, clothing, fruit, toys, vessels
from kille.sensors.synthetic.model import Model

_MAKERS = {
    "apple": fruit.apple,
    "banana": fruit.banana,
    "teddy bear": toys.teddy_bear,
    "book": boxes.book,
    "cap": clothing.cap,
    "car": toys.car,
    "cup": vessels.cup,
    "can of paint": vessels.can_of_paint,
    "shoe": clothing.shoe,
    "shoe-box": boxes.shoe_box,
}

NAMES = tuple(_MAKERS)

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


@lru_cache(maxsize=len(_MAKERS))
def model(name: str) -> Model:
    """The model of one of `NAMES`, made once."""
    return _MAKERS[name]()
