"""Teaching learners what people judged, and scoring them by what other people said."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.lab.measures.statistics import kappa, spearman
from kille.lab.scenes.published_judgements import Choice, Judged, JudgementStudy
from kille.lab.theories.candidates import degrees_of
from kille.scene import Configuration

_FOLDS = 5
_ASKED = 40  # of a word in one draw at most: more tell little and take long

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Agreement:
    """Agreement with people: of ranks, of yes and no, and of these beyond chance.

    within: the mean agreement of ranks within each fold. Pooled folds are unfair to a
    learner that learns how usual a word is: where high places are asked, low ones were
    taught (Forman and Scholz 2010).
    """

    spearman: float
    accuracy: float
    kappa: float
    within: float = float("nan")


def teach_judgements(
    make: Callable[[], Any], lessons: Mapping[str, Sequence[Judged]]
) -> Any:
    """A new learner that got these judgements, or if it takes none, lessons of them."""
    learner = make()
    judge = getattr(learner, "judge_one", None)
    for word, them in lessons.items():
        for it in them:
            if judge is not None:
                judge(it.x, word, it.degree)
            elif it.degree >= 0.5:
                learner.learn_one(it.x, word)
    return learner


def _ask_word(learner: Any, word: str, them: Sequence[Judged]) -> tuple[Vector, Vector]:
    """The degrees of a word by people, and by the learner."""
    said = [_degree(learner, word, it.x) for it in them]
    return np.array([it.degree for it in them]), np.array(said)


def _degree(learner: Any, word: str, x: Configuration) -> float:
    """To what degree the word fits; above .5 it does.

    Of a learner that only shares out one choice, a word fits if it has more than its
    even share.
    """
    degrees = degrees_of(learner, x)
    found = degrees.get(word, 0.0)
    if hasattr(learner, "degrees"):
        return found
    return _rescale(found, 1 / max(2, len(degrees)))


def _rescale(share: float, even: float) -> float:
    """Rescale a share so that an even one is .5; 0, 1 and the order stay."""
    if share <= even:
        return 0.5 * share / even
    return 0.5 + 0.5 * (share - even) / (1 - even)


def _agreement(people: Vector, learner: Vector) -> Agreement:
    """Agreement; where people were evenly divided, only the ranks count."""
    decided = people != 0.5
    ours, theirs = learner[decided] > 0.5, people[decided] > 0.5
    rank = spearman(people, learner)
    return Agreement(
        0.0 if np.isnan(rank) and np.ptp(people) > 0 else rank,
        float((ours == theirs).mean()) if len(ours) else float("nan"),
        kappa([str(it) for it in theirs], [str(it) for it in ours]),
    )


def agreement_after(
    study: JudgementStudy,
    make: Callable[[], Any],
    size: int,
    chance: np.random.Generator,
) -> dict[str, Agreement]:
    """The agreement on each word after `size` lessons of each, drawn at random."""
    lessons, asked = {}, {}
    for word, them in study.words.items():
        order = chance.permutation(len(them))
        count = min(size, len(them) // 2)
        lessons[word] = [them[i] for i in order[:count]]
        asked[word] = [them[i] for i in order[count : count + _ASKED]]
    learner = teach_judgements(make, lessons)
    return {word: _agreement(*_ask_word(learner, word, asked[word])) for word in asked}


def _folds(study: JudgementStudy, seed: int) -> Iterator[tuple[set[str], set[str]]]:
    """The scenes to teach and to ask in each fold, or places, if there is one scene."""
    groups = sorted({_group(it) for it in study.every()})
    order = np.random.default_rng(seed).permutation(len(groups))
    for fold in range(_FOLDS):
        asked = {groups[i] for i in order[fold::_FOLDS]}
        yield {it for it in groups if it not in asked}, asked


def _group(it: Judged) -> str:
    return it.scene or str(it.x.offset)


def _judgements_of(study: JudgementStudy, groups: set[str]) -> dict[str, list[Judged]]:
    return {
        word: [it for it in them if _group(it) in groups]
        for word, them in study.words.items()
    }


def cross_validate(
    study: JudgementStudy, make: Callable[[], Any], seed: int
) -> dict[str, Agreement]:
    """The agreement on each word when all but a fifth of the scenes are taught."""
    said: dict[str, list[tuple[Vector, Vector]]] = {word: [] for word in study.words}
    for teach, ask in _folds(study, seed):
        learner = teach_judgements(make, _judgements_of(study, teach))
        for word, them in _judgements_of(study, ask).items():
            said[word].append(_ask_word(learner, word, them))
    return {word: _pool_folds(pairs) for word, pairs in said.items()}


def _pool_folds(folds: Sequence[tuple[Vector, Vector]]) -> Agreement:
    score = _agreement(*(np.concatenate(side) for side in zip(*folds, strict=True)))
    ranks = [_agreement(*fold).spearman for fold in folds if len(fold[0])]
    known = [it for it in ranks if not np.isnan(it)]
    return replace(score, within=float(np.mean(known)) if known else float("nan"))


def score_choices(
    study: JudgementStudy, make: Callable[[], Any], seed: int
) -> dict[int, float]:
    """Score each choice in a scene that was not taught: 1 if it is that of people.

    A tie of n targets counts 1/n if the right one is among them.
    """
    found = {}
    for teach, _ in _folds(study, seed):
        learner = teach_judgements(make, _judgements_of(study, teach))
        for i, choice in enumerate(study.choices):
            if choice.scene not in teach and i not in found:
                found[i] = _score_choice(learner, choice)
    return found


def _score_choice(learner: Any, choice: Choice) -> float:
    degrees = [degrees_of(learner, x).get(choice.word, 0.0) for x in choice.targets]
    best = [i for i, it in enumerate(degrees) if it == max(degrees)]
    return (choice.chosen in best) / len(best)
