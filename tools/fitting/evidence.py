"""Fits how evidence is weighed: `python -m tools.fitting.evidence DATA`.

DATA holds `ycb_meshes` and `sota_kinect`. Two kinds of things are learned from, half
each: things rendered in many poses, most of them made darker or lighter, tinted,
blurred and partly hidden, as things seen elsewhere are; and pictures of categories,
whose things are mostly new. Each episode teaches some words from one to eight views and
asks about other views of these and of untaught things. The numbers b, r, a and v of
`kille.perception.evidence` make what was asked most probable. The weights of the
kernels are given: they were chosen by what tells categories of these pictures apart.

With `--held-out` half of the words are fitted to and the other half asked, both ways:
so much is to be expected of words that nothing was fitted to. `--degrees` prints
whether degrees mean what they say, of categories that nothing was fitted to but the
kernels' weights, before and after the lessons have calibrated them, and where a tutor
tells after each answer whether the thing was known.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.lab.measures.statistics import auroc, calibration_error
from kille.lab.protocols.degrees import is_asserted
from kille.lab.protocols.teaching import ObjectAnswer
from kille.perception import evidence
from kille.perception.cues import CUES, Cue, measure_cues, with_embedding
from kille.perception.descriptor_index import Index, View, rooted
from kille.perception.evidence import Weighing, unlike_in_size
from kille.perception.features import features_of
from kille.perception.likeness import SIZE, Examples, Kernel
from kille.perception.segment import overlap, region_of, segment
from kille.perception.strangers import share_of_strangers
from kille.perception.votes import beyond_chance, votes
from kille.scene import Frame, Region
from kille.sensors.sensor import Stage
from kille.sensors.sources import open_sensor
from ttr.safety.unforeseen_errors import run_guarded

Numbers = NDArray[np.float64]

POSES = 10
ELSEWHERE = 0.6
"""The share of the views that are changed."""

EPISODES = 200
FEW, MANY = 3, 12
"""Words that are taught at most: at the beginning of a dialogue, and later."""

SEEDS = 8
SHOTS, LAST = 5, 6
"""Pictures of a word that are taught, and asked, where degrees are measured."""

ORDERS = 8
"""In so many orders of chance a tutor asks, and tells whether the thing was known."""

RIDGE = 1e-3  # on the numbers that are fitted
WEIGHTS = {
    "colour": 1.0,
    "hue": 1.0,
    "size": 1.0,
    "shape": 1.0,
    "texture": 1.0,
    "paint": 1.5,
    "outline": 0.75,
    "form": 0.75,
    "pattern": 0.5,
    "whole_texture": 1.0,
    "whole_paint": 1.0,
    "whole_form": 0.5,
    "whole_pattern": 0.5,
}
WEIGHINGS = Path(evidence.__file__).with_name("weighing.json")
NUMBERS = ("score", "votes", "size")
"""The numbers that weigh evidence, besides the base, as in `Asked.found`."""

PARTS: Mapping[str, Collection[str]] = {
    "default": NUMBERS,
    "instances": ("votes",),
    "cues": ("score", "size"),
}
"""What is heard by a memory of each name: all, the features alone, the traits alone."""

USUAL = 0.6
"""What votes add on the whole, u: chosen of 0 to 1.3 on the same things."""

EMBEDDING = 100.0
"""The weight of the embedding, where it is had: more than that of all others."""


@dataclass(frozen=True, eq=False)
class Asked:
    """A question: what was found for each word (words, numbers), and the right column.

    The column is -1 for a thing that was not taught.
    """

    found: Numbers
    column: int


def render_views(
    meshes: Path, chance: np.random.Generator, cues: Mapping[str, Cue]
) -> Iterator[View]:
    """Views of every thing that the simulated sensor can show, and of the meshes."""
    stage = open_sensor(f"synthetic:empty?seed=11&meshes={meshes}")
    assert isinstance(stage, Stage)
    for name in stage.things():
        for _ in range(POSES):
            stage.show(name)
            frame = stage.frame()
            outline = max(frame.outlines.values(), key=np.count_nonzero)
            thing = region_of(frame, outline)
            region = max(segment(frame).regions, key=lambda it: overlap(it, thing))
            if chance.random() < ELSEWHERE:
                frame, region = elsewhere(frame, region, chance)
            yield view(frame, region, name, cues)


def pictures(folder: Path, cues: Mapping[str, Cue]) -> Iterator[View]:
    """A view of each picture, whose word is the name of its folder."""
    for category in sorted(path for path in folder.iterdir() if path.is_dir()):
        for path in sorted(category.glob("*.png")):
            frame = open_sensor(str(path)).frame()
            yield view(frame, segment(frame).regions[0], category.name, cues)


def elsewhere(
    frame: Frame, region: Region, chance: np.random.Generator
) -> tuple[Frame, Region]:
    """The same as it might be seen in another light, from farther away, half hidden."""
    colour = frame.colour.astype(np.float32) / 255
    gain = np.exp(chance.normal(0, 0.25)) * np.exp(chance.normal(0, 0.06, 3))
    colour = np.clip(colour ** np.exp(chance.normal(0, 0.12)) * gain, 0, 1) * 255
    if chance.random() < 0.6:
        colour = cv2.GaussianBlur(colour, (0, 0), chance.uniform(0.4, 1.2))
    if chance.random() < 0.5:
        share = chance.uniform(0.5, 0.95)
        small = cv2.resize(
            colour, None, fx=share, fy=share, interpolation=cv2.INTER_AREA
        )
        colour = cv2.resize(small, colour.shape[1::-1])
    colour = colour + chance.normal(0, 3, colour.shape)
    changed = replace(frame, colour=np.clip(colour, 0, 255).astype(np.uint8))
    mask = region.mask.copy()
    if chance.random() < 0.5:
        rows, columns = np.nonzero(mask)
        way = chance.uniform(0, 2 * np.pi)
        along = columns * np.cos(way) + rows * np.sin(way)
        hidden = along < np.quantile(along, chance.uniform(0.05, 0.45))
        mask[rows[hidden], columns[hidden]] = False
    return changed, region_of(changed, mask)


def view(frame: Frame, region: Region, word: str, cues: Mapping[str, Cue]) -> View:
    """What a lesson about the region keeps; its key is made when it is taught."""
    descriptors = features_of(frame, region).descriptors
    return View("", word, descriptors, measure_cues(frame, region, cues))


def widths(groups: Iterable[Sequence[View]], cues: Iterable[str]) -> dict[str, float]:
    """For each cue the mean of |x - y|² between things of different words."""
    found: dict[str, list[float]] = {cue: [] for cue in cues}
    for views in groups:
        for cue, means in found.items():
            known = [it for it in views if cue in it.traits]
            if known:
                means.append(_spread(np.stack([it.traits[cue] for it in known]), known))
    return {cue: float(np.mean(means)) for cue, means in found.items() if means}


def _spread(rows: NDArray[np.float32], views: Sequence[View]) -> float:
    words = np.array([it.label for it in views])
    squares = (rows.astype(np.float64) ** 2).sum(axis=1)
    apart = squares[:, None] + squares - 2 * rows.astype(np.float64) @ rows.T
    return float(apart[words[:, None] != words].mean())


def episode(
    views: Sequence[View],
    kernels: Mapping[str, Kernel],
    words: Sequence[str],
    chance: np.random.Generator,
) -> Iterator[Asked]:
    """Teach some of the words, and ask about these and others."""
    order = [str(word) for word in chance.permutation(np.array(words))]
    most = FEW if chance.random() < 0.4 else MANY
    count = int(chance.integers(1, min(most, len(order)) + 1))
    taught, asked = [], []
    for word in order[: count + max(2, count)]:
        of = [
            views[i] for i in chance.permutation(len(views)) if views[i].label == word
        ]
        lessons = int(chance.integers(1, 9)) if word in order[:count] else 0
        taught += of[:lessons]
        asked += of[lessons : lessons + (3 if lessons else 2)]
    lessons_of = [replace(it, key=key) for key, it in enumerate(taught)]
    yield from answers(lessons_of, asked, kernels)


def answers(
    taught: Sequence[View], asked: Sequence[View], kernels: Mapping[str, Kernel]
) -> Iterator[Asked]:
    """What is found when some views have been taught and others are asked about."""
    index = Index(taught)
    examples = Examples(taught, index.labels, kernels)
    for it in asked:
        likeness = examples.likeness(it.traits)
        found = votes(index.neighbours(rooted(it.descriptors)), len(index.labels), 1)
        beyond = beyond_chance(found, index.sizes, max(len(it.descriptors), 1))
        score = sum(likeness.scores.values(), np.zeros(len(index.labels)))
        sized = SIZE in likeness.unlike
        apart = unlike_in_size(likeness) if sized else np.zeros_like(score)
        numbers = np.stack(
            [np.ones_like(score), score, np.sqrt(beyond), -apart], axis=1
        )
        known = it.label in index.labels
        yield Asked(numbers, index.labels.index(it.label) if known else -1)


def fit_weighing(
    episodes: Sequence[Sequence[Asked]],
    kernels: Mapping[str, Kernel],
    heard: Collection[str] = NUMBERS,
) -> Weighing:
    """The weighing that makes the right answers most probable, each episode alike.

    Evidence that is not `heard` weighs nothing.
    """
    from scipy.optimize import minimize

    most = [None if it in heard else 0.0 for it in NUMBERS]
    found = minimize(
        _surprise,
        np.array([0.1] + [0.1 if it in heard else 0.0 for it in NUMBERS]),
        args=(episodes,),
        jac=True,
        method="L-BFGS-B",
        bounds=[(None, None), *((0.0, it) for it in most)],
    ).x
    base, score, cast, size = (round(float(it), 3) for it in found)
    usual = USUAL if {"score", "votes"} <= {*heard} else 0.0
    return Weighing(base, score, cast, size, kernels, usual)


def _surprise(
    numbers: Numbers, episodes: Sequence[Sequence[Asked]]
) -> tuple[float, Numbers]:
    """Minus the mean logarithm of the degree of what was right, and its gradient."""
    total, gradient = RIDGE * float(numbers @ numbers), 2 * RIDGE * numbers
    for asked in episodes:
        share = 1 / (len(asked) * len(episodes))
        for it in asked:
            logs = np.concatenate([[0.0], it.found @ numbers])
            degrees = np.exp(logs - logs.max())
            degrees /= degrees.sum()
            total -= share * float(np.log(degrees[it.column + 1] + 1e-12))
            wrong = degrees[1:].copy()
            if it.column >= 0:
                wrong[it.column] -= 1
            gradient = gradient + share * (wrong @ it.found)
    return total, gradient


def numbers_of(it: Weighing) -> Numbers:
    """The fitted numbers of a weighing as one vector, in the order of `Asked.found`."""
    return np.array([it.base, it.score, it.votes, it.size])


def right(asked: Iterable[Asked], weighed: Weighing) -> tuple[float, float]:
    """The share of taught things named, and how well they part from untaught ones.

    The second is the probability that a taught thing has a higher best degree than an
    untaught one (AUROC).
    """
    named: list[bool] = []
    best: dict[bool, list[float]] = {True: [], False: []}
    for it in asked:
        logs = it.found @ numbers_of(weighed)
        degrees = np.exp(logs) / (1 + np.exp(logs).sum())
        best[it.column >= 0].append(float(degrees.max()))
        if it.column >= 0:
            named.append(bool(degrees.argmax() == it.column))
    return float(np.mean(named)), auroc(best[True], best[False])


def draw_episodes(
    groups: Sequence[Sequence[View]],
    kernels: Mapping[str, Kernel],
    words: Sequence[Sequence[str]],
    seed: int,
    count: int = EPISODES,
) -> list[list[Asked]]:
    """Episodes about some words of each group of views, so many of each."""
    chance = np.random.default_rng(seed)
    return [
        list(episode(views, kernels, some, chance))
        for views, some in zip(groups, words, strict=True)
        for _ in range(count)
    ]


def cross_validate(
    groups: Sequence[Sequence[View]], kernels: Mapping[str, Kernel]
) -> Iterator[str]:
    """What is reached with words that nothing was fitted to, and with the others."""
    chance = np.random.default_rng(1)
    halves = [_halves(views, chance) for views in groups]
    for one, other in ((0, 1), (1, 0)):
        weighed = fit_weighing(
            draw_episodes(groups, kernels, [it[one] for it in halves], 2), kernels
        )
        for which, name in ((one, "fitted to"), (other, "held out")):
            for views, half in zip(groups, halves, strict=True):
                episodes = draw_episodes([views], kernels, [half[which]], 3)
                share, area = right([it for some in episodes for it in some], weighed)
                count = len(half[which])
                yield f"{name}: {count} words, named {share:.3f}, AUROC {area:.3f}\n"


def _halves(
    views: Sequence[View], chance: np.random.Generator
) -> tuple[list[str], list[str]]:
    words = [str(it) for it in chance.permutation(sorted({it.label for it in views}))]
    return words[::2], words[1::2]


@dataclass(frozen=True, eq=False)
class Degrees:
    """The answers of one run about what was taught, and about what was not."""

    taught: Sequence[ObjectAnswer]
    strange: Sequence[ObjectAnswer]


def measure_degrees(groups: Sequence[Sequence[View]], seeds: int) -> Iterator[str]:
    """Whether degrees are right as often as they say, of words not fitted to.

    For each seed half of the words are fitted to, and pictures of the others taught,
    five of each: all of them, or half of them, the others being strangers.
    """
    found: dict[tuple[str, str], list[Degrees]] = {}
    for seed in range(seeds):
        chance = np.random.default_rng([seed, 34])
        halves = [_halves(views, chance) for views in groups]
        for one, other in ((0, 1), (1, 0)):
            words = [it[one] for it in halves]
            kernels = kernels_of(_only(groups, words))
            episodes = draw_episodes(groups, kernels, words, seed, EPISODES // 4)
            weighed = fit_weighing(episodes, kernels)
            asked = halves[-1][other]
            for share, taught in (("all", asked), ("half", asked[::2])):
                for name, them in _ask_words(groups[-1], asked, taught, weighed, seed):
                    found.setdefault((share, name), []).append(them)
    for (share, name), runs in found.items():
        yield f"{share} taught, {name}: {_format_degrees(runs)}\n"


def _only(
    groups: Sequence[Sequence[View]], words: Sequence[Sequence[str]]
) -> list[list[View]]:
    return [
        [it for it in views if it.label in some]
        for views, some in zip(groups, words, strict=True)
    ]


def _ask_words(
    views: Sequence[View],
    words: Sequence[str],
    taught: Sequence[str],
    weighed: Weighing,
    seed: int,
) -> Iterator[tuple[str, Degrees]]:
    """What is said of pictures of these words where some of the words are taught."""
    chance = np.random.default_rng([seed, 5])
    lessons, asked = [], []
    for word in words:
        own = [it for it in views if it.label == word]
        order = chance.permutation(len(own))
        asked += [own[i] for i in order[-LAST:]]
        lessons += [own[i] for i in order[:SHOTS] if word in taught]
    lessons = [replace(it, key=key) for key, it in enumerate(lessons)]
    labels = sorted(taught)
    left_out = Examples(lessons, labels, weighed.kernels).left_out()
    found = list(answers(lessons, asked, weighed.kernels))
    calibrated = weighed.calibrate_by(left_out)
    yield "as fitted", _answer_all(asked, found, labels, weighed)
    yield "calibrated", _answer_all(asked, found, labels, calibrated)
    for _ in range(ORDERS):
        order = chance.permutation(len(asked)).tolist()
        told = [asked[i] for i in order], [found[i] for i in order]
        yield "calibrated and told", _answer_all(*told, labels, calibrated, tells=True)


def _answer_all(
    asked: Sequence[View],
    found: Sequence[Asked],
    labels: Sequence[str],
    weighed: Weighing,
    *,
    tells: bool = False,
) -> Degrees:
    """The answers about all views in turn, where a tutor tells after each whether the
    thing was known, or does not."""
    said, known = [], list[bool]()
    for view, it in zip(asked, found, strict=True):
        degrees = _degrees_by(weighed.reckon_with(known), it, labels)
        said.append(ObjectAnswer(view.label, degrees, share_of_strangers(known)))
        if tells:
            known.append(it.column >= 0)
    return Degrees(
        [it for it in said if it.word in labels],
        [it for it in said if it.word not in labels],
    )


def _degrees_by(
    weighed: Weighing, it: Asked, labels: Sequence[str]
) -> dict[str, float]:
    strengths = np.exp(it.found @ numbers_of(weighed))
    return dict(zip(labels, (strengths / (1 + strengths.sum())).tolist(), strict=True))


def _format_degrees(runs: Sequence[Degrees]) -> str:
    every = [it for run in runs for it in (*run.taught, *run.strange)]
    error = calibration_error([it.best for it in every], [it.right for it in every])
    shares = {
        "right": [np.mean([it.right for it in run.taught]) for run in runs],
        "asserted": [
            np.mean([it.right and is_asserted(it) for it in run.taught]) for run in runs
        ],
        "nothing said": [np.mean([it.best < 0.2 for it in run.taught]) for run in runs],
        "wrongly asserted": [
            np.mean(
                [is_asserted(it) and not it.right for it in (*run.taught, *run.strange)]
            )
            for run in runs
        ],
    }
    told = [f"{name} {np.mean(x):.3f} ± {np.std(x):.3f}" for name, x in shares.items()]
    return f"error {error:.3f}, {', '.join(told)}"


def kernels_of(groups: Sequence[Sequence[View]]) -> dict[str, Kernel]:
    """The kernels of all cues that tell of some view."""
    weights = {**WEIGHTS, "embedding": EMBEDDING}
    found = widths(groups, weights)
    return {cue: Kernel(weights[cue], round(found[cue], 4)) for cue in found}


def weighing_as_json(weighed: Weighing) -> dict[str, object]:
    """The weighing as it is written in weighing.json."""
    cues = {
        cue: {"weight": it.weight, "width": it.width}
        for cue, it in weighed.kernels.items()
    }
    return {
        "base": weighed.base,
        "score": weighed.score,
        "votes": weighed.votes,
        "size": weighed.size,
        "usual": weighed.usual,
        "cues": cues,
    }


def main() -> None:
    """Fit, and write what was found into the package; or print what is reached."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("data", type=Path, metavar="DATA")
    parser.add_argument("--held-out", action="store_true", help="cross-validate")
    parser.add_argument("--degrees", action="store_true", help="measure degrees")
    parser.add_argument("--embedding", action="store_true", help="with the embedding")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    cues = with_embedding() if options.embedding else CUES
    chance = np.random.default_rng(0)
    groups = [
        list(render_views(options.data / "ycb_meshes", chance, cues)),
        list(pictures(options.data / "sota_kinect", cues)),
    ]
    if options.degrees:
        sys.stdout.writelines(measure_degrees(groups, SEEDS))
        return
    kernels = kernels_of(groups)
    if options.held_out:
        sys.stdout.writelines(cross_validate(groups, kernels))
        return
    words = [sorted({it.label for it in views}) for views in groups]
    episodes = draw_episodes(groups, kernels, words, 0)
    parts = {"embedding": NUMBERS} if options.embedding else PARTS
    found = {
        name: weighing_as_json(fit_weighing(episodes, kernels, it))
        for name, it in parts.items()
    }
    known = json.loads(WEIGHINGS.read_text("utf-8")) if WEIGHINGS.exists() else {}
    text = json.dumps({**known, **found}, indent=1)
    WEIGHINGS.write_text(text + "\n", "utf-8")


if __name__ == "__main__":
    sys.exit(run_guarded("kille", main))
