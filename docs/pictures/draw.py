"""Draws the pictures of the documents anew: `python docs/pictures/draw.py`."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from grounds import remove_ground
from PIL import Image

from kille.perception.look import look
from kille.perception.picture_sheet import picture_sheet, write_picture
from kille.scene import Colour
from kille.sensors.synthetic.catalogue import TOY_NAMES
from kille.sensors.synthetic.sensor import Synthetic, open_synthetic

HERE = Path(__file__).parent
SENSOR = "synthetic:empty?seed=7"
COLUMNS, WIDTH, HEIGHT, TITLE = 5, 140, 120, 22


def objects(sensor: Synthetic) -> Colour:
    """The ten objects as the camera sees them, with their names below."""
    cells = [_named(name, _close_up(sensor, name)) for name in TOY_NAMES]
    rows = [cells[i : i + COLUMNS] for i in range(0, len(cells), COLUMNS)]
    return np.vstack([np.hstack(row) for row in rows])


def _close_up(sensor: Synthetic, name: str) -> Colour:
    """The thing with some table around it, in the proportions of a cell."""
    sensor.show(name)
    frame = sensor.frame()
    rows, columns = np.nonzero(frame.outlines[name])
    middle = (columns.min() + columns.max()) / 2, (rows.min() + rows.max()) / 2
    across = 1.25 * max(np.ptp(columns), np.ptp(rows) * WIDTH / HEIGHT)
    size = round(across), round(across * HEIGHT / WIDTH)
    cut = cv2.getRectSubPix(frame.colour, size, middle)
    return cv2.resize(cut, (WIDTH, HEIGHT), interpolation=cv2.INTER_LINEAR)


def _named(name: str, picture: Colour) -> Colour:
    """The picture, with room around it and the name below it, on no ground."""
    below = np.full((TITLE, WIDTH, 3), 255, np.uint8)
    (across, _), _ = cv2.getTextSize(name, cv2.FONT_HERSHEY_SIMPLEX, 0.45, 1)
    at = ((WIDTH - across) // 2, TITLE - 7)
    cv2.putText(below, name, at, cv2.FONT_HERSHEY_SIMPLEX, 0.45, 0, 1, cv2.LINE_AA)
    opaque = np.dstack([picture, np.full(picture.shape[:2], 255, np.uint8)])
    cell = np.vstack([opaque, remove_ground(below)])
    return cv2.copyMakeBorder(cell, 4, 0, 4, 4, cv2.BORDER_CONSTANT, None, [0] * 4)


def seen(sensor: Synthetic, *names: str) -> Colour:
    """How things look to the robot: rows of the sheet that `kille demo` writes."""
    rows = []
    for name in names:
        sensor.show(name)
        rows.append((name, look(sensor, scans=1), 1))
    return picture_sheet(rows)


def smaller(picture: Colour, width: int) -> Colour:
    """The picture scaled down to this width."""
    size = width, round(picture.shape[0] * width / picture.shape[1])
    return cv2.resize(picture, size, interpolation=cv2.INTER_AREA)


if __name__ == "__main__":
    things = Image.fromarray(objects(open_synthetic(SENSOR)))
    things.save(HERE / "objects.png", optimize=True)
    rows = seen(open_synthetic(SENSOR), "cup", "teddy bear")
    write_picture(HERE / "seen.png", smaller(rows, 800))
