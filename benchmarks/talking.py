"""How fast the robot answers, what is seen aside.

    python benchmarks/talking.py [--json] [--cpu] [--profile]

A dialogue of a hundred different turns in front of three things: each is parsed, taken,
judged, answered and worded; what is seen is a prepared answer. It is played again and
again, so that sentences are remembered; then with sentences that were never heard, and
by a robot that knows 200 nouns more. The first turn counts from the start of the
process. Last, what naming all that is on a full table takes beyond its ten scans, which
come from a camera, thirty frames a second. `--profile` says where the time goes.
"""

from __future__ import annotations

import cProfile
import gc
import os
import pstats
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import product
from statistics import median, quantiles
from tempfile import TemporaryDirectory

from _measuring import Result, arguments, clock_of, report
from threadpoolctl import threadpool_limits

from kille.dialogue.language import understand
from kille.dialogue.meanings import adjective, noun, relation, theory, word_of
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from kille.grounding.witness_functions import WitnessFunctions, thing_name
from kille.perception.look import SCANS, look
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.scene import Frame, Look
from kille.sensors.sensor import At, SensorError, Stage
from kille.sensors.sources import open_sensor
from ttr import Model, Record, record
from ttr.updates import Game, Run

ROUNDS = 10
"""How often the dialogue is played; the first half warms up and is not counted."""

STARTS = 5
"""How often a process is started."""

TAUGHT = 4
"""How often each thing was taught, and how many tables are then named."""

LOOKS = 5
"""How often each table is looked at for its scans alone, and for its names."""

FRAMES = 30
"""How many frames a camera gives in a second."""

Clock = Callable[[], float]

THINGS = ("o1", "o2", "o3")
DEGREES = {
    ("cup", "o1"): 0.9,
    ("mug", "o1"): 0.3,
    ("cup", "o2"): 0.85,
    ("book", "o3"): 0.95,
    ("is_red", "o1"): 0.9,
    ("is_blue", "o2"): 0.9,
    ("is_green", "o3"): 0.8,
    ("to_the_left_of", "o1", "o3"): 0.8,
    ("to_the_right_of", "o3", "o1"): 0.8,
    ("behind", "o2", "o3"): 0.7,
}
"""How much the words are true of the things: of what is not here, not at all."""

SIGNS = (
    *map(noun, ("cup", "mug", "book")),
    *map(adjective, ("red", "blue", "green")),
    *map(relation, ("to the left of", "to the right of", "behind")),
)

PHRASES = ("this", "it", "the book", "the red cup", "the blue cup", "the green one")
SENTENCES = (
    "What is {}?",
    "Where is {}?",
    "Is {} a cup?",
    "Is {} red?",
    "Is {} to the left of the book?",
    "{} is a cup.",
    "{} is big.",
    "{} is behind the red cup.",
    "What colour is {}?",
    "Show me {}.",
    "No, {} is a mug.",
    "{} is not a box.",
)
OTHERS = (
    "Hello.",
    "Yes.",
    "No.",
    "Thank you.",
    "Help.",
    "Why?",
    "How sure are you?",
    "What do you see?",
    "What do you know?",
    "What is a cup?",
    "What does red mean?",
    "How many cups are there?",
    "Pardon?",
    "Forget that.",
    "Forget the last thing.",
    "Where is the cup?",
    "The red one.",
    "What is the cup to the left of the book?",
    "What is the red cup to the left of the green book?",
    "A cup.",
    "No, a mug.",
    "This is a unicorn.",
    "Where is the unicorn?",
    "The unicorn is a horse.",
    "Forget unicorn.",
    "Colourless green ideas sleep.",
    "What is the other cup?",
    "The other one is a cup.",
)
DIALOGUE = tuple(
    text
    for number, sentence in enumerate(SENTENCES)
    for text in (
        *(sentence.format(phrase) for phrase in PHRASES),
        *OTHERS[number::12],
    )
)[:100]
"""A hundred turns, no two the same."""


def degree(word: str, arity: int, *args: str) -> float:
    return DEGREES.get((word, *args[:arity]), 0.0)


MORE = tuple(noun(f"thing {number}") for number in range(200))
"""Nouns that are true of nothing in view."""


def model_of(signs: Sequence[Record]) -> Model:
    """Three things in view, of which these words are true as they are."""
    model = blank_model().given("look1", theory()["Look"])
    for x in THINGS:
        model = model.given(x, theory()["Ind"])
    for sign in signs:
        word = word_of(sign)
        arity = 2 if sign.kind == "relation" else 1
        model = model.witnessed(word, by=partial(degree, word.name, arity))
    return model


def begin_dialogue(signs: Sequence[Record] = SIGNS) -> tuple[Game, Run]:
    """The game, and the run in which the three things are seen."""
    game = tutoring(signs, model=model_of(signs))
    view = record(
        look="look1", things=THINGS, placed=THINGS, focus=["o1"], pointed=["o1"]
    )
    return game, game.take(game.begin(), _glance(view)).run


def _glance(view: Record) -> Record:
    return record(view=view, kept=[], floor="tutor")


def answer_text(game: Game, so_far: Run, text: str) -> Run:
    """What comes of a text, its answer worded."""
    assert game.hear is not None
    assert game.say is not None
    event = game.hear(text)
    if event is None:
        return so_far
    turn = game.take(so_far, event)
    assert all(map(game.say, turn.said))
    return turn.run


def turns(
    texts: Callable[[int], Sequence[str]],
    clock: Clock,
    signs: Sequence[Record] = SIGNS,
) -> list[float]:
    """The milliseconds of each turn, of the second half of the rounds."""
    game, begun = begin_dialogue(signs)
    gc.collect()
    gc.freeze()
    times = []
    for number in range(ROUNDS):
        so_far = begun
        for text in texts(number):
            start = clock()
            so_far = answer_text(game, so_far, text)
            times.append(1000 * (clock() - start))
    return times[len(times) // 2 :]


def new(number: int) -> Sequence[str]:
    """The dialogue about a word that was never heard before."""
    return [text.replace("book", f"thing{number}") for text in DIALOGUE]


def parsing_times(clock: Clock) -> list[float]:
    """The milliseconds to parse sentences that were never heard before."""
    times = []
    for text in new(-1):
        start = clock()
        understand(text)
        times.append(1000 * (clock() - start))
    return times


FIRST = """
from kille.dialogue.tutoring import tutoring
game = tutoring()
turn = game.take(game.begin(), game.hear("What is this?"))
print([game.say(move) for move in turn.said], flush=True)
"""


def first() -> list[float]:
    """The milliseconds from the start of a process to its first answer.

    Its modules have been compiled before, as those of an installed program are. What
    the process takes to end does not count.
    """
    with TemporaryDirectory() as compiled:
        around = {**os.environ, "PYTHONPYCACHEPREFIX": compiled}
        around.pop("PYTHONDONTWRITEBYTECODE", None)
        times = []
        for _ in range(1 + STARTS):
            start = time.perf_counter()
            command = [sys.executable, "-c", FIRST]
            with subprocess.Popen(command, env=around, stdout=subprocess.PIPE) as one:
                assert one.stdout is not None
                assert one.stdout.readline().startswith(b"['")
                times.append(1000 * (time.perf_counter() - start))
    return times[1:]


def full_table(seed: int) -> Stage:
    """A stage with ten things, each where it finds a place."""
    stage = open_sensor(f"synthetic:empty?seed={seed}")
    assert isinstance(stage, Stage)
    spots = product((0.0, -0.15, 0.15, -0.3, 0.3), (0.0, 0.15, -0.15))
    free = [At(right, away) for right, away in spots]
    for name in stage.things():
        for spot in free:
            with suppress(SensorError):
                stage.place(name, spot)
                free.remove(spot)
                break
    return stage


class Camera:
    """A stage as a camera shows it: the next frame has to be waited for."""

    def __init__(self, stage: Stage) -> None:
        self.name = "camera"
        self._frames = [stage.frame() for _ in range(SCANS)]

    def frame(self) -> Frame:
        time.sleep(1 / FRAMES)
        self._frames.append(self._frames.pop(0))
        return self._frames[-1]

    def close(self) -> None:
        """It has nothing open."""


def naming(clock: Clock) -> list[float]:
    """The milliseconds that naming all on a full table takes beyond its ten scans.

    Each of the things was taught four times. Nothing of what is on the table was asked
    about before: its features are extracted and compared, and its traits measured as
    far as they were not while the frames came. That is done once to the end, and once
    until the scans are there. Processor time is that of all threads, and more than one
    waits where a second core is free.
    """
    learned = ObjectMemory()
    for seed in range(TAUGHT):
        stage = open_sensor(f"synthetic:empty?seed={seed}")
        assert isinstance(stage, Stage)
        for name in stage.things():
            stage.show(name)
            learned.learn_one(look(stage, scans=1).percepts[0], name)
            stage.remove(name)

    def scan_all(seen: Look) -> bool:
        return all(tuple(percept.scans) for percept in seen.percepts)

    def name_all(seen: Look) -> bool:
        witnesses = WitnessFunctions(learned, RelationMemory())
        witnesses.remember("look1", seen)
        things = map(thing_name, range(1, len(seen.percepts) + 1))
        found = [witnesses.evidence(x, "look1") for x in things]
        return all(it is not None and it.degrees() for it in found)

    def time_of(act: Callable[[Look], bool], camera: Camera) -> float:
        seen = look(camera)
        start = clock()
        assert act(seen)
        return 1000 * (clock() - start)

    times = []
    for seed in range(TAUGHT, 2 * TAUGHT):
        camera = Camera(full_table(seed))
        both = [
            time_of(name_all, camera) - time_of(scan_all, camera) for _ in range(LOOKS)
        ]
        times.append(median(both))
    return times


def limits_of(
    task: str, times: Sequence[float], middle: float = 0, most: float = 0
) -> Iterator[Result]:
    """The median and the 95th percentile, with the limits that they have."""
    for of, found, limit in (
        ("median", median(times), middle),
        ("p95", quantiles(times, n=20)[-1], most),
    ):
        limits = ((of, limit, found),) if limit else ()
        yield Result("talking", f"{task}, {of}", {1: found}, limits)


def measure_turns(clock: Clock) -> Iterator[Result]:
    yield from limits_of("a turn", turns(lambda number: DIALOGUE, clock), 1.0, 5.0)
    yield from limits_of("a turn of new sentences", turns(new, clock))
    more = turns(lambda number: DIALOGUE, clock, (*SIGNS, *MORE))
    yield from limits_of("a turn, knowing 200 nouns more", more)
    yield from limits_of("parsing a new sentence", parsing_times(clock), 5.0)
    yield from limits_of("from start to first answer", first(), 300.0)
    with threadpool_limits(1):
        yield from limits_of("naming a full table", naming(clock), 60.0)


def print_profile() -> None:
    """Say where the time of the hundred turns goes."""
    turns(lambda number: DIALOGUE, time.perf_counter)
    profile = cProfile.Profile()
    profile.runcall(turns, lambda number: DIALOGUE, time.perf_counter)
    pstats.Stats(profile).sort_stats("tottime").print_stats(40)


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--profile", action="store_true", help="say what costs most")
    options = parser.parse_args()
    if options.profile:
        print_profile()
        return
    report(measure_turns(getattr(time, clock_of(options))), options)


if __name__ == "__main__":
    main()
