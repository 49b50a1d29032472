"""A log of a drawn dialogue, cut after any turn, goes on from there as it went on."""

from __future__ import annotations

from itertools import takewhile

import pytest
from hypothesis import HealthCheck, given, settings
from mutants import GAMES

from ttr.dialogues.logs import LogFile, read_logs, replay
from ttr.testing.failure_story import place_of
from ttr.testing.strategies import dialogues


@pytest.mark.parametrize("name", GAMES)
def test_a_log_cut_anywhere_goes_on(name, tmp_path):
    beside = GAMES[name]
    place = place_of(beside.game)

    @settings(
        max_examples=5,
        derandomize=True,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )
    @given(dialogues(beside.game, beside.tutor, turns=5))
    def cut(dialogue):
        file = tmp_path / "drawn.jsonl"
        file.unlink(missing_ok=True)
        with LogFile(file) as log:
            log.begin(place)
            for turn in dialogue.turns:
                log.write(turn)
        (read,) = read_logs(file)
        # A lesson gives the model new functions, which no log can have.
        facts = takewhile(lambda entry: entry.whole, read.entries)
        for after in range(len(list(facts)) + 1):
            assert replay(read, place, from_=after).divergence is None

    cut()
