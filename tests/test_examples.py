"""The examples run from top to bottom, and print what they are about."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"

KEY_LINES = {
    "01_records.py": [
        "a dog:        [x : Ind, c : dog(x)]",
        "⎡x : Ind   ⎤",
        "  ✓ c: s1 : dog(fido)   (given)",
        "All dogs:     {c = s1, x = fido}",
        "A likely dog: {c = s3, x = sam} : [x : Ind, c : dog(x)]   p = 0.7",
        "A hugged dog: [x : Ind, c : dog(x), event : [by : Ind, e : hug(by, x)]]",
        "Fido:         [x = fido : Ind, c : dog(x)]",
        "functions:    (Ind -> Type)",
        "applied:      run(fido)",
        "<e1 e2> : plus(run(fido))   p = 1",
    ],
    "02_subtyping_and_merge.py": [
        "HugDog <= Dog: True",
        "Dog <= HugDog: no: [x : Ind, c : dog(x)] has no field y",
        "for example:   {c = s2, x = a1} : "
        "[x : Ind, y : Ind, c : dog(x), e : hug(y, x)]   p = 0",
        "Puppy <= Dog:  yes by the axiom",
        "consistent:    no: nothing can be of A /\\ B /\\ ~A",
        "merge:         [x : Ind, c : dog(x), e : run(x)]",
        "merge:         [x = fido : Ind, c : dog(x)]",
        "amerge:        [x : Ind, c : dog(x)]",
        "relabelled:    [x : Ind, y : Ind, c : dog(y), e : hug(x, y)]",
        "without e:     [x : Ind, y : Ind, c : dog(x)]",
        "in common:     [x : Ind, c : dog(x)]",
    ],
    "03_a_theory_in_a_file.py": [
        "Dog :=   [x : Ind, c : dog(x)]",
        "  ✓ c: s1 : dog(rex)   (by puppy(x) <: dog(x) and s1 : puppy(rex))",
        "kennel.ttr: 11 checks hold",
        "hug takes 2 arguments (Ind, Ind), but has 1",
        "help: did you mean dog?",
    ],
    "04_why_a_judgement_fails.py": [
        "  ✗ c: s1 : dog(sam)   (nothing says so; s1 is of dog(fido))",
        "fails at: c",
        "but:      s1 is of dog(fido)",
        "  ✗ e: nothing : hug(sam, fido)   (there is no e; s2 would do)",
        "  ✗ x: sam : Ind@fido   (it is another object)",
        "unknown:  s1 : dog(sam)   p = [0, 1]",
        "refused:  a : Real is refused by the witness function of Real",
    ],
    "10_first_words.py": [
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
