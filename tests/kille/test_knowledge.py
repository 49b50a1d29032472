"""Knowledge: what is on disk is what the robot knows, looks and all."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from kille.knowledge import Evidence, Knowledge
from kille.memory import Memory, Turn
from kille.perception.look import look
from kille.scene import Percept
from kille.sensors.synthetic import open_synthetic

THINGS = ("cup", "book", "banana")


def percepts(seed: int) -> dict[str, Percept]:
    stage = open_synthetic(f"synthetic:empty?seed={seed}")
    seen = {}
    for thing in THINGS:
        stage.show(thing)
        seen[thing] = look(stage, 2).percepts[0]
    return seen


def test_a_robot_that_starts_again_judges_as_it_did(tmp_path: Path) -> None:
    path, asked = tmp_path / "memory.db", percepts(2)
    with Memory.open(path) as memory:
        knowledge, dialogue = Knowledge(memory), memory.begin_dialogue("now")
        for number, (thing, percept) in enumerate(percepts(1).items()):
            turn = Turn(dialogue, number, "tutor", thing, "", "now")
            evidence = Evidence(turn, "synthetic", 0.0)
            knowledge.learn_noun(thing, thing, percept, evidence)
        before = [knowledge.objects.predict_proba_one(it) for it in asked.values()]
    with Memory.open(path) as memory:
        again = Knowledge(memory).objects
        assert [again.predict_proba_one(it) for it in asked.values()] == before
        for view in again.views:
            assert {"size", "colour", "paint"} <= view.traits.keys()
            assert all(it.dtype == np.float32 for it in view.traits.values())
