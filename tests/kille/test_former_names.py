"""What users may know by another name is found by it, with a warning."""

from __future__ import annotations

import sys
from importlib import import_module
from pkgutil import resolve_name

import pytest

from kille.former_modules import FORMER_MODULES

RENAMED = [
    ("kille.dialogue.meanings", "denied", "denial"),
    ("kille.dialogue.meanings", "named", "record_type"),
    ("kille.dialogue.meanings", "placed", "meaning_at"),
    ("kille.dialogue.meanings", "reworded", "replace_word"),
    ("kille.dialogue.meanings", "spoken", "move_type"),
    ("kille.dialogue.moves", "changed_act", "change_act"),
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
    ("kille.memory.Memory", "reading", "open_to_read"),
    ("kille.memory.MemoryReader", "told", "lesson_without_sight"),
    ("kille.perception.colours", "packed", "pack_palette"),
    ("kille.perception.colours", "unpacked", "unpack_palette"),
    ("kille.perception.cues", "measured", "measure_cues"),
    ("kille.perception.segment", "Scene", "SegmentedFrame"),
    ("kille.perception.segment", "plainly", "segment_by_contact"),
    ("kille.nodes.dialogue", "Talking", "DialogueNode"),
    ("kille.nodes.perception", "Seeing", "PerceptionNode"),
    ("kille.nodes.remote_sensor", "Eyes", "RemoteSensor"),
    ("kille.nodes.sensor", "Sensing", "SensorNode"),
]


@pytest.mark.parametrize(("place", "former", "now"), RENAMED)
def test_a_former_name_works_and_warns(place: str, former: str, now: str) -> None:
    owner = resolve_name(place)
    with pytest.warns(DeprecationWarning, match=rf"{former} is now .*{now}"):
        assert getattr(owner, former) is getattr(owner, now)


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize("former", sorted(FORMER_MODULES))
def test_a_former_module_is_the_one_that_took_its_place(former: str) -> None:
    now = FORMER_MODULES[former]
    sys.modules.pop(former, None)
    with pytest.warns(DeprecationWarning, match=f"^{former} is now {now}$"):
        assert import_module(former) is import_module(now)


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_module_is_found_in_a_room_by_its_former_name() -> None:
    former = resolve_name("kille.studies.running.crews")
    assert former is import_module("kille.lab.running_studies.crews")
