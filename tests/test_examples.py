"""The examples run from top to bottom, and print what they are about."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"

KEY_LINES = {
    "01_records_and_types.py": [
        "a dog:        [x : Ind, c : dog(x)]",
        "HugDog <= Dog: True",
        "Dog <= HugDog: no: [x : Ind, c : dog(x)] has no field y",
        "Fido the dog: [x = fido : Ind, c : dog(x)]",
        "  ✓ e: s2 : hug(sam, fido)   (given)",
        "  ✗ c: s1 : dog(sam)   (nothing says so)",
        "What fails first is c",
        "A likely dog: {c = s3, x = sam} : [x : Ind, c : dog(x)]   p = 0.7",
        "A dog in a scene: [background : Rec, x : Ind, c : dog(x)]",
    ],
    "02_first_words.py": [
        "S> OK, I learned a cup.",
        "S> OK, I learned a book.",
        "S> This is a cup.",
        "The meaning of the word: [look : Look, x : Ind, c : cup(x, look)]",
        "  ✓ x: o1 : Ind   (given)",
        "   assert_name: It is sure, and no rival is near: it says what this is.",
        "S> I do not know what this is. Please tell me.",
    ],
}


def printed_by(example: str) -> list[str]:
    """The lines that an example prints; it must not fail, nor warn."""
    run = subprocess.run(
        [sys.executable, "-W", "error", str(EXAMPLES / example)],
        capture_output=True,
        env={**os.environ, "PYTHONUTF8": "1"},
        encoding="utf-8",
        timeout=60,
        check=False,
    )
    assert (run.returncode, run.stderr) == (0, "")
    return run.stdout.splitlines()


def test_every_example_is_known_here() -> None:
    assert {path.name for path in EXAMPLES.glob("*.py")} == set(KEY_LINES)


@pytest.mark.parametrize("example", sorted(KEY_LINES))
def test_an_example_prints_what_it_is_about(example: str) -> None:
    lines = printed_by(example)
    found = [line for line in lines if line in KEY_LINES[example]]
    assert list(dict.fromkeys(found)) == KEY_LINES[example]
