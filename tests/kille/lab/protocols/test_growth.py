"""How time and memory grow: what is measured, and what is only foreseen."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import cache

import pytest

from kille.lab.protocols import growth as module
from kille.lab.protocols.growth import growth
from kille.lab.results import Result
from kille.perception.objects import ObjectMemory
from kille.perception.paper_objects import PaperObjects
from kille.scene import Percept

SIZES = (10, 20, 40)


@pytest.fixture(autouse=True, scope="module")
def things_seen_once() -> Iterator[None]:
    """The ten things are looked at once for all tests: looks follow from the seed."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_look_at_things", cache(module._look_at_things))
        yield


class Slow:
    """Whose questions take a millisecond a view."""

    def __init__(self) -> None:
        self.words: list[str] = []

    def learn_one(self, x: Percept, label: str, *, key: object = None) -> None:
        self.words.append(label)

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        time.sleep(len(self.words) / 1000)
        return dict.fromkeys(self.words, 0.0)


def measured(**methods: Callable[[], object]) -> Result:
    return growth(methods, seed=0, sizes=SIZES)  # type: ignore[arg-type]


def test_each_method_is_asked_at_each_size() -> None:
    told: list[tuple[float, str]] = []
    found = growth(
        {"kille": PaperObjects, "default": ObjectMemory},
        seed=0,
        sizes=SIZES[:2],
        progress=lambda share, doing: told.append((share, doing)),
    )
    rows = found.tables[0].rows
    assert [row[:2] for row in rows] == [
        (name, size) for name in ("kille", "default") for size in SIZES[:2]
    ]
    for row in rows:
        for cell in row[2:6]:
            assert isinstance(cell, int | float)
            assert cell > 0
    assert rows[0][-1] < rows[1][-1]  # type: ignore[operator]
    assert [share for share, _ in told] == [0.25, 0.5, 0.75, 1.0]
    series = found.figures[0].data["series"]
    assert series["kille"]["mean"] == pytest.approx(
        [point["question_ms"] for point in found.facts["methods"]["kille"]]
    )


def test_progress_is_told_of_what_is_done() -> None:
    learners: list[Slow] = []

    class Watched(Slow):
        def __init__(self) -> None:
            super().__init__()
            learners.append(self)

    told: list[tuple[float, int]] = []
    growth(
        {"slow": Watched},
        seed=0,
        sizes=SIZES,
        progress=lambda share, _: told.append((share, len(learners[0].words))),
    )
    assert [views for _, views in told] == [10, 20, 40]


def test_what_takes_too_long_is_foreseen_and_marked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(module, "_BEARABLE", 0.015)
    found = measured(slow=Slow)
    first, second, third = found.tables[0].rows
    assert isinstance(second[2], int | float)
    assert str(third[2]).startswith("~")
    assert third[3:7] == (None,) * 4
    assert len(found.facts["methods"]["slow"]) == 2
    means = found.figures[0].data["series"]["slow"]["mean"]
    assert means[2] == pytest.approx(2 * means[1])
    assert first[2] < second[2]  # type: ignore[operator]


def test_the_system_need_not_tell_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kille.lab.protocols.memory_use.resident_memory", lambda: None)
    found = measured(slow=Slow)
    assert [row[6] for row in found.tables[0].rows] == [None] * 3
