"""Draws the small pictures of the gallery anew: `python -m docs.pictures.gallery`.

Each is a figure of its notebook, as the notebook draws it. Run it from the top folder.
"""

from __future__ import annotations

import io
from pathlib import Path

from PIL import Image

from tools.notebooks import GALLERY, run_page

WIDTH = 220  # pixels
CHOSEN = {
    "a-meaning-that-learns": 0,
    "a-probability-puzzle": 1,
    "bring-your-own-learner": 0,
    "most-dogs": 0,
    "spatial-templates": 1,
    "teach-the-robot": -1,
    "what-is-a-cup": 0,
}
"""Which figure of a notebook it is known by."""


def picture_of(notebook: str, number: int) -> Image.Image:
    """A figure of a notebook, made small."""
    shown = run_page(GALLERY / f"{notebook}.md")
    pictures = [picture for cell in shown for picture in cell.pictures]
    figure = Image.open(io.BytesIO(pictures[number]))
    height = round(figure.height * WIDTH / figure.width)
    return figure.resize((WIDTH, height), Image.Resampling.LANCZOS)


if __name__ == "__main__":
    for notebook, number in CHOSEN.items():
        file = Path(__file__).parent / "gallery" / f"{notebook}.png"
        picture_of(notebook, number).quantize(128).save(file, optimize=True)
