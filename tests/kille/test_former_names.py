"""What users may know by another name is found by it, with a warning."""

from __future__ import annotations

from importlib import import_module

import pytest

RENAMED = [
    ("kille.dialogue.meanings", "denied", "denial"),
    ("kille.dialogue.meanings", "named", "record_type"),
    ("kille.dialogue.meanings", "placed", "meaning_at"),
    ("kille.dialogue.meanings", "reworded", "replace_word"),
    ("kille.dialogue.meanings", "spoken", "move_type"),
    ("kille.dialogue.moves", "numbered", "number_field"),
    ("kille.dialogue.moves", "standing", "placement"),
    ("kille.dialogue.moves", "used", "words_in"),
    ("kille.dialogue.reference", "Judging", "PhraseJudge"),
    ("kille.dialogue.reference", "contents", "possible_readings"),
    ("kille.dialogue.reference", "denoted", "intended_readings"),
    ("kille.dialogue.reference", "facing", "known_front"),
    ("kille.dialogue.reference", "fitting", "fitting_readings"),
    ("kille.dialogue.strategies", "expected", "expected_value"),
    ("kille.dialogue.tutoring", "heard", "hear_sentences"),
    ("kille.nodes.dialogue", "Talking", "DialogueNode"),
    ("kille.nodes.perception", "Seeing", "PerceptionNode"),
    ("kille.nodes.remote_sensor", "Eyes", "RemoteSensor"),
    ("kille.nodes.sensor", "Sensing", "SensorNode"),
]


@pytest.mark.parametrize(("module", "former", "now"), RENAMED)
def test_a_former_name_works_and_warns(module: str, former: str, now: str) -> None:
    place = import_module(module)
    with pytest.warns(DeprecationWarning, match=rf"{former} is now .*{now}"):
        assert getattr(place, former) is getattr(place, now)
