"""How well spoken sentences are heard: `python benchmarks/speech.py [--some N]`.

Two voices of flite speak 32 sentences of teaching and asking, and 200 that tutors say,
drawn from the lists of utterances; the recogniser knows nine nouns and nine colours.
A sentence counts as heard if its words, or a sentence of the same meaning, come first.
The factor is the processor's time for a second of speech.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import time
import tomllib
from pathlib import Path
from random import Random

from kille.dialogue.language import understand
from kille.dialogue.meanings import sign
from kille.speech.expectations import expected_speech, speech
from kille.speech.grammar import in_full, split_words
from kille.speech.recognition import Recogniser
from kille.speech.sound import RATE, Sound, read_wav
from kille.speech.word_network import allows

UTTERANCES = Path(__file__).parent.parent / "tests/kille/dialogue/utterances.en.toml"
VOICES = ("rms", "awb")

NOUNS = ("cup", "mug", "book", "box", "car", "apple", "ball", "shoe", "teddy bear")
COLOURS = ("red", "blue", "green", "yellow", "black", "white", "grey", "brown", "pink")
KNOWN = (
    *(sign(it, "noun") for it in NOUNS),
    *(sign(it, "adjective") for it in COLOURS),
)

SENTENCES = """\
This is a cup. | This is a book. | This is an apple. | That is a mug. | This is a box.
This is a ball. | This is a shoe. | It is a teddy bear. | What is this?
What is that? | Is this a cup? | Is this an apple? | What do you see?
What colour is this? | That is correct. | That is wrong. | Yes. | No.
No, this is a mug. | No, it is a book. | This is not a cup.
The book is to the left of the box. | The cup is to the right of the book.
The apple is in front of the box. | The ball is behind the cup.
The mug is near the apple. | Where is the book? | Where is the cup?
Where is the apple? | Where is the ball? | The cup is red. | Thank you."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--some", type=int, default=200, help="tutor's sentences (200)")
    options = parser.parse_args()
    begun = time.process_time()
    what = expected_speech(KNOWN)
    recogniser = Recogniser(speech())
    recogniser.expect(what)
    print(f"ready after {time.process_time() - begun:.1f} s of the processor")
    listed = [it.strip() for it in re.split(r"[|\n]", SENTENCES)]
    data = tomllib.loads(UTTERANCES.read_text(encoding="utf-8"))
    said = dict.fromkeys(text for it in data["judged"] for text in it["said"])
    sayable = [it for it in said if allows(what.network, split_words(it))]
    drawn = Random(5).sample(sayable, min(options.some, len(sayable)))
    for voice in VOICES:
        measure(recogniser, voice, "listed", listed)
        measure(recogniser, voice, "tutors'", drawn)


def measure(recogniser: Recogniser, voice: str, name: str, texts: list[str]) -> None:
    right, wrong, seconds, used = 0, [], 0.0, 0.0
    for text in texts:
        sound = speak_sentence(text, voice)
        seconds += sound.seconds
        begun = time.process_time()
        found = recogniser.hear(sound.samples)
        used += time.process_time() - begun
        first = found[0].text if found else ""
        if same(first, text):
            right += 1
        else:
            others = any(same(it.text, text) for it in found)
            wrong.append(f"{text!r}: {first!r}{' (in the list)' * others}")
    share = right / len(texts)
    print(
        f"{voice} {name}: {right}/{len(texts)} ({share:.1%}), "
        f"{used / seconds:.3f} of real time"
    )
    for line in wrong:
        print("   ", line)


def speak_sentence(text: str, voice: str) -> Sound:
    """A sentence in a voice of flite's, with 0.2 s of silence around it."""
    command = ["flite", "-voice", voice, "-t", text, "-o", "/dev/stdout"]
    wav = subprocess.run(command, capture_output=True, check=True).stdout
    margin = bytes(2 * RATE // 5)
    return Sound(RATE, margin + read_wav(wav).at(RATE).samples + margin)


def same(heard: str, text: str) -> bool:
    """Whether two texts have the same words, or mean the same."""
    if in_full(split_words(heard)) == in_full(split_words(text)):
        return True
    return bool(heard) and meaning(heard) == meaning(re.sub(r"[.?!]", "", text))


def meaning(text: str) -> list[tuple[str, str]]:
    found = [it.readings[:1] for it in understand(text)]
    return [(str(it.type["e"]), str(it.content)) for them in found for it in them]


if __name__ == "__main__":
    main()
