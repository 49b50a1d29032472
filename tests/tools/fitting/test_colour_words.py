"""What ships is what the script fits, and foretells names that were held out."""

from __future__ import annotations

from pathlib import Path

import pytest

from kille.perception.colours import xkcd
from tools.fitting.colour_words import (
    SHIPPED,
    file_text,
    prediction_table,
    read_survey,
    word_table,
)


@pytest.mark.data
def test_the_words_foretell_the_names_of_held_out_colours(data: Path) -> None:
    table = prediction_table(read_survey(data), xkcd())
    perplexity = {row[0]: row[1] for row in table.rows}
    modal = {row[0]: row[3] for row in table.rows}
    ours = perplexity.pop("fitted borders")
    bound = perplexity.pop("the names themselves (the bound)")
    assert bound < ours < 1.05 * bound
    assert ours < min(perplexity.values())  # the histograms'
    assert modal["fitted borders"] > 0.92


@pytest.mark.data
def test_degrees_agree_with_use(data: Path) -> None:
    table = word_table(read_survey(data), xkcd())
    assert all(row[3] > 0.95 for row in table.rows)  # AUROC


def test_the_shipped_file_is_as_it_is_written() -> None:
    import json

    text = SHIPPED.read_text(encoding="utf-8")
    assert file_text(json.loads(text)) == text
