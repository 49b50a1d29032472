"""People's judgements: reading them, and learners held against them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kille.lab.protocols.judgements import judgements
from kille.lab.results import ExperimentError, silent
from kille.lab.scenes.published_judgements import Judged, JudgementStudy, read
from kille.perception.relations import AngleRule, PaperRelations, RelationMemory
from kille.scene import Configuration


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few draws: what is measured shows all the same."""
    monkeypatch.setattr("kille.lab.protocols.judgements.SIZES", (4, 8))
    monkeypatch.setattr("kille.lab.protocols.judgements._DRAWS", 2)


METHODS = {"default": RelationMemory, "kille": PaperRelations, "angle": AngleRule}


def invented(places: int = 40) -> JudgementStudy:
    """Two words that people hold to fit by the cosine."""
    chance, words = np.random.default_rng(0), {}
    for word, sign in (("left", -1), ("right", 1)):
        them = []
        for scene in range(places):
            right, away = chance.uniform(-0.3, 0.3, 2).tolist()
            degree = max(0.0, sign * right / np.hypot(right, away))
            them.append(Judged(Configuration((right, away, 0.0)), degree, str(scene)))
        words[word] = them
    return JudgementStudy("invented", words, {"left": "left", "right": "right"})


def test_learners_are_held_against_people() -> None:
    result = judgements(invented(), METHODS, seed=1, progress=silent)
    by_size, _, by_word = result.tables
    names = {row[0] for row in by_size.rows}
    assert names == {*METHODS, "angle, told"}
    assert [row[0] for row in by_word.rows] == ["left", "right", "mean"]
    ours = result.facts["spearman"]["default"]
    assert min(ours.values()) > 0.9
    again = judgements(invented(), METHODS, seed=1, progress=silent)
    assert again.tables == result.tables


def test_a_word_of_few_scenes_is_in_few_folds() -> None:
    study = invented()
    rare = {**study.words, "rare": study.words["left"][:3]}
    few = JudgementStudy("invented", rare, {**study.about, "rare": "left"})
    result = judgements(few, METHODS, seed=1, progress=silent)
    within = result.facts["spearman within folds"]["default"]
    assert set(within) == set(rare)
    assert min(within["left"], within["right"]) > 0.8


def test_a_learner_with_two_methods_takes_part() -> None:
    class Shrug:
        def learn_one(self, x: Configuration, label: str) -> None:
            pass

        def predict_proba_one(self, x: Configuration) -> dict[str, float]:
            return {}

    result = judgements(invented(), {"shrug": Shrug}, seed=1, progress=silent)
    row = next(it for it in result.tables[0].rows if it[0] == "shrug")
    assert row[2] == 0.0


def test_a_folder_without_judgements_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ExperimentError, match="judgements"):
        read(tmp_path)


def test_a_broken_file_is_told_of(tmp_path: Path) -> None:
    (tmp_path / "logan_sadler.csv").write_text("preposition,dx_right\nleft,none\n")
    with pytest.raises(ExperimentError, match="not as expected"):
        read(tmp_path)
    far = f"preposition,dx_right,dy_up,rating_1_9\nleft,{'9' * 400},0,5\n"
    (tmp_path / "logan_sadler.csv").write_text(far)
    with pytest.raises(ExperimentError, match="not as expected"):
        read(tmp_path)
    (tmp_path / "logan_sadler.csv").write_text(
        "preposition,row,col,dx_right,dy_up,rating_1_9\n"
    )
    with pytest.raises(ExperimentError, match="no judgement"):
        read(tmp_path)


@pytest.mark.data
def test_the_studies_are_read(data: Path) -> None:
    grid = read(data / "spatial_logan_sadler")
    rooms = read(data / "spatial_rooms")
    use = read(data / "spatial_functional_2019")
    assert {len(them) for them in grid.words.values()} == {48}
    assert {"near", "behind", "between", "on"} <= set(rooms.words)
    assert len(use.words) == 9
    assert len(use.choices) > 600
    for study in (grid, rooms, use):
        degrees = [it.degree for them in study.words.values() for it in them]
        assert 0 <= min(degrees) < max(degrees) <= 1


@pytest.mark.data
def test_the_grid_is_learned_as_people_rated_it(data: Path) -> None:
    """Spearman of the default, all cells but a fifth taught, and of few lessons."""
    study = read(data / "spatial_logan_sadler")
    methods = {"default": RelationMemory, "angle": AngleRule}
    result = judgements(study, methods, seed=1, progress=silent)
    ours = result.facts["spearman"]["default"]
    assert min(ours[word] for word in ("left", "right", "above", "below")) > 0.9
    rows = {(row[0], row[1]): row[2] for row in result.tables[0].rows}
    for size in (4, 8):
        few, rule = rows["default", size], rows["angle", size]
        assert isinstance(few, float)
        assert isinstance(rule, float)
        assert few > rule
    by_word = [row for row in result.tables[1].rows if row[0] == "default"]
    assert result.tables[1].title == "By word, 8 lessons of each"
    assert {row[1] for row in by_word} == set(study.words)
    assert np.mean([row[2] for row in by_word]) == pytest.approx(rows["default", 8])
