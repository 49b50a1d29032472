"""Draws why kappa was so low: `python docs/pictures/kappa.py` (takes minutes)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from grounds import remove_ground_of
from matplotlib.figure import Figure

from kille.lab.measures.statistics import bootstrap
from kille.lab.protocols.causes import CAUSES, play_protocol
from kille.perception.relations import PaperRelations, RelationMemory

HERE = Path(__file__).parent
RUNS, SEED = 30, 1
METHODS = {"linear SVC, as in the paper": PaperRelations, "templates": RelationMemory}
HUES = ("#D55E00", "#0072B2")
PUBLISHED = 0.054


def main() -> None:
    """Dots for the mean kappa under each cause, with 95 % bands."""
    drawn = Figure(figsize=(7.6, 5.4), layout="constrained")
    axes = drawn.subplots()
    places = np.arange(len(CAUSES))
    chance = np.random.default_rng(SEED)
    for aside, hue, (name, make) in zip(
        (-0.15, 0.15), HUES, METHODS.items(), strict=True
    ):
        runs = [
            [
                play_protocol(make, cause, np.random.default_rng([SEED, run])).robot
                for run in range(RUNS)
            ]
            for cause in CAUSES
        ]
        bands = np.array([bootstrap(them, chance) for them in runs])
        means = [float(np.mean(them)) for them in runs]
        axes.hlines(places + aside, bands[:, 0], bands[:, 1], color=hue, lw=1.6)
        axes.plot(means, places + aside, "o", ms=5, color=hue, label=name)
    axes.axvline(PUBLISHED, color="#444444", lw=1, ls="--")
    axes.text(PUBLISHED + 0.005, -0.75, "published: .05", color="#444444", fontsize=9)
    axes.axvline(0, color="#bbbbbb", lw=0.8)
    axes.set_yticks(places, [cause.name for cause in CAUSES])
    axes.set_ylim(len(CAUSES) - 0.4, -1.1)
    axes.set_xlabel("kappa of judges and robot")
    axes.grid(axis="x", alpha=0.3)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.tick_params(axis="y", length=0)
    axes.legend(loc="lower center", bbox_to_anchor=(0.3, 1.0), ncols=2, frameon=False)
    drawn.savefig(HERE / "kappa.png", dpi=110)
    remove_ground_of(HERE / "kappa.png")


if __name__ == "__main__":
    main()
