"""Fits the borders of colour words to the names that people gave to colours.

`python -m tools.fitting.colour_words DATA [OUT]` reads the folder
colour_names_xkcd (or the one that holds it), writes the fitted words, and prints how
well they foretell the names of colours that were held out, one colour of Lab in five.

The borders of what a word holds of are fitted to how often it is chosen, against how
often it is chosen of the colour that it is best for: it holds fully from half of that.
The borders of what it is apt for are fitted to P(word | colour), together with how
available the word is. Every colour counts the same, though a screen shows more of the
vivid ones: so the fit does not lean towards them.
"""

from __future__ import annotations

import csv
import io
import json
import sys
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.lab.measures.statistics import auroc
from kille.lab.results import Table
from kille.perception.colours import borders
from kille.perception.colours.borders import AXES, along
from kille.perception.colours.space import even
from kille.perception.colours.words import ColourWords, parse_colour_words
from tools.fitting.edges import agreement, choice, minimise
from ttr.safety.inputs import read_text
from ttr.safety.limits import TABLE
from ttr.safety.unforeseen_errors import run_guarded

Numbers = NDArray[np.float64]

FOLDER, COUNTS = "colour_names_xkcd", "colour_name_counts.csv"
SHIPPED = Path(borders.__file__).with_name("xkcd.json")
ABOUT = {
    "about": "Borders of colour words in Oklab; see borders.py and words.py.",
    "fitted by": "python -m tools.fitting.colour_words",
    "source": "xkcd colour survey (2010), as binned by Heer and Stone (CHI 2012) in "
    "github.com/StanfordHCI/c3; BSD-3-Clause, (c) 2011 Stanford University",
    "edges": "[low, how vague, high, how vague], about in units of Lab",
}

_HELD_OUT = 5  # every so manieth colour, by its hash
_FULLY = 0.5  # of its best share of the names: from there a word holds fully
_SMOOTH = 5.0  # Lab units: what a word is best for is not for one bin to say
_OUTSIDE = 0.05  # of a word's names lie beyond each border that the fit starts with
_START_VAGUE = 10.0  # Lab units: from sharper ones the fit ends in a worse place
_COARSE = (10, 15, 20)  # Lab units: bins of the histogram to compare with

_SPACED = {
    name.replace(" ", ""): name
    for name in (
        "light blue",
        "light green",
        "sky blue",
        "lime green",
        "light purple",
        "dark green",
        "dark blue",
        "navy blue",
        "bright green",
        "forest green",
        "dark purple",
        "yellow green",
        "royal blue",
        "hot pink",
        "seafoam green",
        "pale green",
    )
}


@dataclass(frozen=True, eq=False)
class Survey:
    """Names (w,) of colours: lab (n, 3), counts (n, w), and which are held out (n,)."""

    names: tuple[str, ...]
    lab: Numbers
    counts: Numbers
    held_out: NDArray[np.bool_]

    @property
    def shares(self) -> Numbers:
        """P(word | colour), (n, w)."""
        return np.asarray(self.counts / self.counts.sum(axis=1, keepdims=True))


def read_survey(data: Path) -> Survey:
    """The survey in a folder, or in its subfolder colour_names_xkcd."""
    folder = data / FOLDER if (data / FOLDER).is_dir() else data
    if not (folder / COUNTS).is_file():
        raise SystemExit(f"{folder} has no {COUNTS}: give the folder of data")
    rows: dict[tuple[int, ...], dict[str, int]] = {}
    for row in csv.DictReader(io.StringIO(read_text(folder / COUNTS, TABLE))):
        at = int(row["L"]), int(row["a"]), int(row["b"])
        name = _SPACED.get(row["name"], row["name"])
        rows.setdefault(at, {})[name] = int(row["count"])
    names = tuple(sorted({name for row in rows.values() for name in row}))
    counts = [[row.get(name, 0) for name in names] for row in rows.values()]
    held = [zlib.crc32(f"{at}".encode()) % _HELD_OUT == 0 for at in rows]
    return Survey(
        names, np.array(list(rows), float), np.array(counts, float), np.array(held)
    )


def fit_words(survey: Survey) -> dict[str, Any]:
    """The words as they are written to the file, fitted to what is not held out."""
    kept = ~survey.held_out
    lab, shares = survey.lab[kept], survey.shares[kept]
    best = _best(lab, shares)
    hues = _hues(lab, shares)
    places = along(lab, hues)
    start = _first_borders(places, shares)
    truth = agreement(np.minimum(1.0, shares / (_FULLY * best)))
    holding, _ = minimise(places, start, np.log(best), truth)
    apt, weights = minimise(places, start, np.log(best), choice(shares))
    available = np.exp(weights - weights.max())
    words = {
        name: {
            "hue": round(float(hues[w]), 1),
            "availability": float(f"{available[w] / available.sum():.3g}"),
            "holds": _axes_by_name(holding[w]),
            "apt": _axes_by_name(apt[w]),
        }
        for w, name in enumerate(survey.names)
    }
    return {**ABOUT, "words": words}


def prediction_table(survey: Survey, words: ColourWords) -> Table:
    """How well the names of held-out colours are foretold, by several ways."""
    out = survey.held_out
    shares, totals = survey.shares[out], survey.counts[out].sum(axis=1)
    ways = {
        "the names themselves (the bound)": shares,
        "fitted borders": words.chances(survey.lab[out]),
        **{f"histogram, bins of {n}": _histogram(survey, n) for n in _COARSE},
    }
    rows = []
    for name, chances in ways.items():
        entropy = -(shares * np.log(np.where(shares > 0, chances, 1))).sum(axis=1)
        modal = np.mean(chances.argmax(axis=1) == shares.argmax(axis=1))
        rows.append(
            (
                name,
                float(np.exp(entropy.mean())),
                float(np.exp(np.average(entropy, weights=totals))),
                float(modal),
            )
        )
    columns = ("way", "perplexity, by colour", "by answer", "commonest name found")
    return Table(f"{int(out.sum())} colours held out", columns, tuple(rows))


def word_table(survey: Survey, words: ColourWords) -> Table:
    """For each word, how its degree agrees with use on held-out colours."""
    out = survey.held_out
    kept = ~out
    best = _best(survey.lab[kept], survey.shares[kept])
    held = np.minimum(1.0, survey.shares[out] / (_FULLY * best))
    degrees = words.degrees(survey.lab[out])
    rows = tuple(
        (
            name,
            float(best[w]),
            float(np.corrcoef(degrees[:, w], held[:, w])[0, 1]),
            auroc(degrees[held[:, w] >= 0.5, w], degrees[held[:, w] < 0.5, w]),
            float(np.abs(degrees[:, w] - held[:, w]).mean()),
        )
        for w, name in enumerate(survey.names)
    )
    columns = ("word", "best share", "correlation", "AUROC", "mean error")
    return Table("Degrees against use, on held-out colours", columns, rows)


def _best(lab: Numbers, shares: Numbers) -> Numbers:
    """The share (w,) of each word among the names of the colour that it is best for."""
    smooth = np.empty_like(shares)
    for block in np.array_split(np.arange(len(lab)), 20):
        apart = ((lab[block, None] - lab[None]) ** 2).sum(axis=2)
        near = np.exp(-apart / (2 * _SMOOTH**2))
        smooth[block] = near @ shares / near.sum(axis=1, keepdims=True)
    return np.asarray(smooth.max(axis=0))


def _hues(lab: Numbers, shares: Numbers) -> Numbers:
    """The angle (w,) of each word's mean colour, in degrees."""
    means = shares.T @ even(lab)
    return np.asarray(np.degrees(np.arctan2(means[:, 2], means[:, 1])))


def _first_borders(places: Numbers, shares: Numbers) -> Numbers:
    """Borders (w, 3, 4) around most of each word's names on every axis."""
    edges = np.full((shares.shape[1], len(AXES), 4), _START_VAGUE)
    for w, axis in np.ndindex(edges.shape[:2]):
        order = np.argsort(places[:, w, axis], kind="stable")
        below = np.cumsum(shares[order, w]) / shares[:, w].sum()
        ends = np.searchsorted(below, (_OUTSIDE, 1 - _OUTSIDE))
        edges[w, axis, 0::2] = places[order[ends], w, axis]
    return edges


def _histogram(survey: Survey, size: int) -> Numbers:
    """P(word | bin) for the held-out colours, a bin being so wide in L, a and b.

    The words' shares over all count as a tenth of an answer in every bin.
    """
    kept = ~survey.held_out
    bins: dict[tuple[int, ...], Numbers] = {}
    codes = [tuple(code) for code in np.floor(survey.lab / size).astype(int).tolist()]
    for code, row, used in zip(codes, survey.counts, kept, strict=True):
        if used:
            bins[code] = bins.get(code, 0) + row
    usual = survey.shares[kept].mean(axis=0)
    found = [bins.get(codes[i], 0) + 0.1 * usual for i in np.flatnonzero(~kept)]
    return np.array([row / row.sum() for row in found])


def _axes_by_name(edges: Numbers) -> dict[str, list[float]]:
    return dict(zip(AXES, edges.round(1).tolist(), strict=True))


def file_text(words: dict[str, Any]) -> str:
    """The file's text: one line a word, so that changes are easily seen."""
    head = {name: value for name, value in words.items() if name != "words"}
    lines = [f'  "{name}": {json.dumps(word)}' for name, word in words["words"].items()]
    start = json.dumps(head, indent=1, ensure_ascii=False)[:-2]
    return start + ',\n "words": {\n' + ",\n".join(lines) + "\n }\n}\n"


def main(data: Path, out: Path) -> None:
    """Fit, write, and print the measures."""
    survey = read_survey(data)
    found = fit_words(survey)
    out.write_text(file_text(found), encoding="utf-8")
    words = parse_colour_words(found)
    for table in (prediction_table(survey, words), word_table(survey, words)):
        sys.stdout.write(f"\n{table.title}\n{' | '.join(table.columns)}\n")
        for name, *numbers in table.rows:
            row = " ".join(f"{number:8.3f}" for number in numbers)
            sys.stdout.write(f"{name:33} {row}\n")


if __name__ == "__main__":
    written_to = Path(sys.argv[2]) if len(sys.argv) > 2 else SHIPPED
    sys.exit(run_guarded("kille", lambda: main(Path(sys.argv[1]), written_to)))
