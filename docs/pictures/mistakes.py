"""Draws things that are not made out: `python docs/pictures/mistakes.py`.

Rendered scenes of seeds that nothing was fitted to, above as they look, below with the
regions in inks and the true outlines in white.
"""

from __future__ import annotations

import sys
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from kille.lab.protocols.regions import paint_regions
from kille.perception.picture_sheet import write_picture
from kille.perception.segment import segment
from kille.scene import Frame
from tools.fitting.piles import crowd, hide_middle

HERE = Path(__file__).parent
SCENES = (
    (crowd, 9012),
    (crowd, 9005),
    (crowd, 9014),
    (crowd, 9010),
    (crowd, 9006),
    (hide_middle, 9017),
)
SIZE = 320, 240
IN_A_ROW = 3
SHRINK = 0.7


def draw(number: int, frame: Frame) -> NDArray[np.uint8]:
    """The picture, its number, and below it the regions with the true outlines."""
    seen = np.asarray(cv2.resize(frame.colour, SIZE), np.uint8)
    cv2.putText(seen, str(number), (8, 28), cv2.FONT_HERSHEY_SIMPLEX, 0.9, (0, 0, 0), 2)
    inked = np.ascontiguousarray(paint_regions(frame, segment(frame).regions))
    for mask in frame.outlines.values():
        small = cv2.resize(mask.astype(np.uint8), SIZE)
        outlines = cv2.findContours(small, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0]
        cv2.drawContours(inked, outlines, -1, (255, 255, 255), 1)
    return np.concatenate([seen, inked])


def main() -> None:
    """Write mistakes.png."""
    tiles = [draw(i, of(seed)) for i, (of, seed) in enumerate(SCENES, start=1)]
    rows = [
        np.concatenate(tiles[first : first + IN_A_ROW], axis=1)
        for first in range(0, len(tiles), IN_A_ROW)
    ]
    whole = np.concatenate(rows)
    small = cv2.resize(whole, None, fx=SHRINK, fy=SHRINK, interpolation=cv2.INTER_AREA)
    write_picture(HERE / "mistakes.png", np.asarray(small, np.uint8))


if __name__ == "__main__":
    main()
