"""Whatever the moment of a kill -9, what was acknowledged is there, and nothing half.

A child process teaches lesson after lesson and prints the key of each once it is
learned; it is killed at a moment drawn at random. The same is done to whole robots.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from kille.memory import Memory, ObjectLesson

SCANS, FEATURES = 3, 200
KILLS = 15

TEACHING = f"""
import itertools, os, pathlib, sys
import numpy as np
from kille.memory import Memory, Scan, Sighting, Turn
from kille.scene import Point

print("ready", flush=True)
memory = Memory.open(pathlib.Path(sys.argv[1]))
dialogue = memory.begin_dialogue("now")
for number in itertools.count():
    word = f"word_{{dialogue}}_{{number}}"
    turn = Turn(dialogue, number, "tutor", f"This is a {{word}}.", "", "now")
    shade = (7 * dialogue + number) % 256
    scan = Scan(
        np.full(({FEATURES}, 128), shade, np.uint8),
        np.full(({FEATURES}, 3), shade, np.float32),
    )
    seen = Sighting("synthetic", number, (scan,) * {SCANS}, Point(shade, 0, 0))
    print(memory.learn_object(turn, word, word, seen), flush=True)
"""


def killed_after(path: Path, lessons: int, seconds: float) -> list[int]:
    """The keys of the lessons acknowledged before a child was killed.

    That is so many seconds after so many lessons.
    """
    with subprocess.Popen(
        [sys.executable, "-c", TEACHING, str(path)],
        stdout=subprocess.PIPE,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        text=True,
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "ready\n"
        keys = [child.stdout.readline() for _ in range(lessons)]
        time.sleep(seconds)
        child.kill()
        keys += child.stdout.read().splitlines(keepends=True)
    return [int(key) for key in keys if key.endswith("\n")]


def assert_whole(lesson: ObjectLesson) -> None:
    dialogue, number = lesson.turn.dialogue, lesson.turn.number
    shade = (7 * dialogue + number) % 256
    assert lesson.word.name == f"word_{dialogue}_{number}"
    assert lesson.turn.text == f"This is a {lesson.word.name}."
    assert lesson.seen.place == (shade, 0, 0)
    assert len(lesson.seen.scans) == SCANS
    for scan in lesson.seen.scans:
        assert scan.descriptors.shape == (FEATURES, 128)
        assert (scan.descriptors == shade).all()
        assert (scan.points == shade).all()


def test_no_acknowledged_lesson_is_lost_and_none_is_halved(path: Path) -> None:
    rng = np.random.default_rng(2026)
    acknowledged: list[int] = []
    for lessons in range(KILLS):
        acknowledged += killed_after(path, lessons, float(rng.uniform(0, 0.004)))
    with Memory.open(path) as memory:
        lessons = list(memory.objects())
        turns = memory.turns()
    for lesson in lessons:
        assert_whole(lesson)
    assert len(acknowledged) >= sum(range(KILLS))
    assert {lesson.key for lesson in lessons} >= set(acknowledged)
    # Killed between its commit and its acknowledgement: at most one a child.
    assert len(lessons) <= len(acknowledged) + KILLS
    assert [lesson.turn for lesson in lessons] == list(turns)


def test_a_kill_while_the_file_is_made_leaves_one_that_opens(tmp_path: Path) -> None:
    rng = np.random.default_rng(2027)
    for number, seconds in enumerate(rng.uniform(0, 0.012, size=10)):
        path = tmp_path / f"{number}.db"
        acknowledged = killed_after(path, 0, float(seconds))
        with Memory.open(path) as memory:
            keys = [lesson.key for lesson in memory.objects()]
        assert keys[: len(acknowledged)] == acknowledged


def test_a_robot_keeps_every_word_that_it_said_it_learned() -> None:
    benchmark = Path(__file__).parents[3] / "benchmarks" / "kills.py"
    done = subprocess.run(
        [sys.executable, str(benchmark), "--kills", "50", "--json"],
        stdout=subprocess.PIPE,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        text=True,
        check=False,
    )
    found = json.loads(done.stdout)
    assert (found["lost"], found["halved"], found["unreadable"]) == (0, 0, 0)
    assert found["acknowledged"] <= found["kept"] <= found["acknowledged"] + 50
    assert found["acknowledged"] > 50
    assert done.returncode == 0
