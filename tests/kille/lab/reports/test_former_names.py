"""What measures and reports were called before works, and warns."""

from __future__ import annotations

from importlib import import_module

import pytest

FORMER = {
    "kille.lab.measures": {
        "scored": "score_dialogue",
        "Dialogue": "ScoredDialogue",
    },
    "kille.lab.measures.statistics": {"Band": "Interval"},
    "kille.lab.reports": {"compared": "compare_results"},
    "kille.lab.reports.result_pages": {"shown": "kille.lab.results.format_cell"},
}


@pytest.mark.parametrize(
    ("module", "former", "now"),
    [(module, *names) for module, them in FORMER.items() for names in them.items()],
)
def test_a_former_name_is_the_new_one(module: str, former: str, now: str) -> None:
    home, _, name = now.rpartition(".")
    with pytest.warns(DeprecationWarning, match=f"{former} is now .*{name}"):
        found = getattr(import_module(module), former)
    assert found is getattr(import_module(home or module), name)


def test_a_protocol_is_found_by_its_former_name() -> None:
    with pytest.warns(DeprecationWarning, match="is now .*picture_splits"):
        former = import_module("kille.lab.protocols.parted")
    assert former is import_module("kille.lab.protocols.picture_splits")
