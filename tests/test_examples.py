"""The examples run from top to bottom, and print what they are about."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
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
    "05_a_meaning_that_learns.py": [
        "⎢params = ⎡t = 0.09       ⎤                                  ⎥",
        "score:      0.721",
        "type:       right(o1)",
        "  ✓ c: e1 : right(o1)   (given)",
        "now:        ~right(o1)",
        "before:     right(o1)",
        "params.t: 0.09 → 0.59",
        "after  0 exchanges: 57% alike, κ 0.12, 0.42 apart",
        "after 60 exchanges: 92% alike, κ 0.84, 0.07 apart",
        "corrected:  9",
        "red cup:    [redness : RealVector, roundness : RealVector, x : Ind, "
        "c : cup(x) /\\ red(x)]",
        "red cup:    0.598",
    ],
    "06_how_probable.py": [
        "  p = [0.6, 0.8] e: s3 : hug(a, b)   (given)",
        "not both:  0.1 0",
        "  p = [0.54, 0.82] e: s3 : hug(a, b)   "
        "(P(s3 : hug(a, b) | s1 : boy(a)) is [0.6, 0.8])",
        "Kim, who has the flu, is ill:     [0.325, 0.45]",
        "p = 0.8 o1 : Cup \\/ Mug   (one part; o1 : Cup excludes o1 : Mug)",
        "p = [0.4, 0.8] o1 : Cup   "
        "(as a value of What; 0.2 / (0.2 + 0.3), 0.4 / (0.4 + 0.1))",
    ],
    "07_most_dogs.py": [
        "witness: {X = {fido, rex}, f = [{e = w1, x = fido}, {e = w2, x = rex}]}",
        "too few: X has 1 of 3; it takes more than 1/2 of them",
        "strict:  False",
        "  ✗ nothing : bark(felix)   (nothing says so)",
        "every dog barks, perhaps: p = 0.25",
        "the same type: True",
        "they, the boys: {kim, sam}",
        "after few, the others too: {felix, fido, rex}",
        "some owned donkey is beaten:  1",
        "every owned donkey is beaten: 0",
        "Most dogs bark. Most dogs are brown. / Some brown dog barks. -> yes",
        "Every puppy barks. / Every dog barks. -> unknown",
        "No dog barks. / At least two dogs bark loudly. -> no",
    ],
    "08_what_comes_next.py": [
        "at first:   pick_up(h, s)",
        "after e3:   run_after(d, s)",
        "event 4, e9, is of run_after(h, s), but expected: run_after(d, s)",
        "does it fit: 0",
        "may it be over: 1",
        "on course: 0.75",
        "<e1 e2 e3 e4 e5 e6> is a game: 1",
        "because it cannot be divided beyond its first 2 events; "
        "event 3, e4, is of run_after(d, s), expected: throw(h, s)",
        "a game is two by two: no",
        "a round and then any: True",
    ],
    "09_a_game_of_fetch.py": [
        "The dog attends: the stick is to be thrown.",
        "begin: Nothing is going on: the human is to pick up the stick.",
        ": [e : pick_up(human, stick)]!   "
        "{e = s1} : [e : pick_up(human, stick)]   p = 1",
        "human: {e = s3} : [e : throw(human, stick)]",
        "dog: {e = s4} : [e : run_after(dog, stick)]",
        "dog: {e = s6} : [e : bring(dog, stick, human)]",
        "boards agree: True",
        "before the first rule the state is not of its type, at agenda: "
        "stone : RecType, it is no type",
    ],
    "10_your_own_gameboard.py": [
        "Board: [agreed : list(RecType), claimed : list(RecType), "
        "qud : list(Question)]",
        "asked: What is asked is the maximal question under discussion.",
        "  with question = \\r:[x : Ind]. [e : leave(r.x)]",
        "  claimed: + [e : leave(kim)]",
        "  qud: − \\r:[x : Ind]. [e : leave(r.x)]",
        "an answer first: True",
        "the rule forget replaces s.agred, but s has no agred",
        "help: did you mean agreed?",
        "after parrot the state is not of its type, at agreed: kim : RecType, "
        "it is no type",
    ],
    "11_test_your_theory.py": [
        "own one at a time: a guest cancels one dish at a time.",
        "turn 3: strike takes back 2 dishes",
        "U> Order",
        "U> Cancel",
        "P17 no crash: whatever happens, no rule, move or text raises an error.",
        "turn 1: the rule strike failed: ValueError: list.remove(x): x not in list",
        "all is well: True, never applied: ()",
        "what was not covered: ()",
    ],
    "12_first_words.py": [
        "S> OK, I learned a cup.",
        "S> OK, I learned a book.",
        "S> This is a cup.",
        "The meaning of the word: [look : Look, x : Ind, c : cup(x, look)]",
        "  ✓ x: o1 : Ind   (given)",
        "   assert_name: It is sure, and no rival is near: it says what this is.",
        "S> I do not know what this is. Please tell me.",
    ],
    "13_bring_your_own_classifier.py": [
        "5 things, 1 round of lessons and questions",
        "The most distinct first:",
        "Taken for another:",
        "default         nothing; turned: nothing",
        "refused: the method mine failed: it cannot be made: RuntimeError: no weights",
    ],
    "14_colour_words.py": [
        "What holds of the things on the table:",
        "  banana    yellow 1.0",
        "  red ##########  orange #           yellow",
        "  red             orange ##########  yellow",
        "  after  0 lessons: red 0.00; it says orange",
        "  after  1 lessons: red 0.20; it says orange",
        "  after 10 lessons: red 0.71; it says red",
        "And of a red thing: red 1.0",
        "Forgotten again: True",
    ],
    "15_write_your_own_game.py": [
        "cup: This is a geka. OK, the one on the left (#1) is a geka.",
        "box: This is a lale. OK, the one on the right (#3) is a lale.",
        "A and B have the same words: True ['bubi', 'geka', 'lale']",
    ],
    "16_composing_meanings.py": [
        "⎡x     : Ind         ⎤",
        "⎣scope : [f : ((y : Ind) → ([e : dog(y)] → [e : chase(y, x)]))]⎦",
        "equal:     no",
        "from store: 2 readings, the same: True",
        "red dog:   yes: each field of "
        "[x : Ind, restr : [e : dog(x)], scope : [e : run(x)]] is there, and below",
        "fake gun:  no",
        "a cat:     0",
        "refused:   \\P:(Ind -> RecType). "
        "[x : Ind, restr : [e : man(x)], scope : P(x)] takes objects "
        "of (Ind -> RecType), and j cannot be one, as it is of Ind",
        "open:      unknown: it is not known that zoe is of Ind, "
        "in (\\x:Ind. [e : man(x)])(zoe)",
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


@pytest.mark.parametrize(
    "example", ["05_a_meaning_that_learns.py", "06_how_probable.py"]
)
def test_a_picture_is_drawn_or_it_says_what_it_needs(
    example: str, tmp_path: Path
) -> None:
    picture = tmp_path / "picture.png"
    run = subprocess.run(
        [sys.executable, str(EXAMPLES / example), str(picture)],
        capture_output=True,
        env={**os.environ, "PYTHONUTF8": "1"},
        encoding="utf-8",
        timeout=60,
        check=False,
    )
    if find_spec("matplotlib"):
        assert (run.returncode, run.stderr) == (0, "")
        assert picture.read_bytes().startswith(b"\x89PNG")
    else:
        needs = "no picture: it needs matplotlib, pip install 'kille[plots]'\n"
        assert (run.returncode, run.stderr) == (1, needs)
