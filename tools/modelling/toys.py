"""Models the ten toys and the wood of the table, and writes them into the package.

`python -m tools.modelling.toys [FOLDER]`, from the project's root; FOLDER is
`kille/sensors/synthetic` unless another is given.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import cv2

from kille.scene import Colour
from kille.sensors import synthetic
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling.boxes import book, shoe_box
from tools.modelling.car import car
from tools.modelling.clothing import cap, shoe
from tools.modelling.fruit import apple, banana
from tools.modelling.obj_files import obj_text
from tools.modelling.teddy_bear import teddy_bear
from tools.modelling.vessels import can_of_paint, cup
from tools.modelling.wood import wood
from ttr.safety.unforeseen_errors import run_guarded

SHIPPED = Path(synthetic.__file__).parent

MAKERS: Mapping[str, Callable[[], ToyModel]] = {
    "apple": apple,
    "banana": banana,
    "teddy_bear": teddy_bear,
    "book": book,
    "cap": cap,
    "car": car,
    "cup": cup,
    "can_of_paint": can_of_paint,
    "shoe": shoe,
    "shoe-box": shoe_box,
}
"""What makes each toy, by the name of its files."""


def main(folder: Path) -> None:
    """Write the toys and the wood into this folder."""
    toys = folder / "toys"
    toys.mkdir(parents=True, exist_ok=True)
    for name, make in MAKERS.items():
        model = make()
        (toys / f"{name}.obj").write_text(obj_text(model, f"{name}.mtl"), "utf-8")
        material = f"newmtl {name}\nmap_Kd {name}.png\n"
        (toys / f"{name}.mtl").write_text(material, "utf-8")
        write_picture(toys / f"{name}.png", model.texture)
    write_picture(folder / "wood.png", wood())


def write_picture(file: Path, picture: Colour) -> None:
    """Write RGB as a PNG that is as small as it gets."""
    bgr = cv2.cvtColor(picture, cv2.COLOR_RGB2BGR)
    smallest = [cv2.IMWRITE_PNG_COMPRESSION, 9]
    file.write_bytes(cv2.imencode(".png", bgr, smallest)[1].tobytes())


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    sys.exit(run_guarded("kille", lambda: main(*(given or [SHIPPED]))))
