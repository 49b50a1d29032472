"""How fast information states are updated: rules, turns, whole dialogues, checks.

    python benchmarks/updates.py [--json] [--cpu] [--dialogues N]

Fetch is the game of `examples/fetch.ttr`, with the state checked after every rule. A
turn of tutoring is parsed, updated, checked, selected and worded, but nothing is looked
at: perception is a prepared answer. The sentences are the same in every round, or new
ones that were never heard before. Travel plays the stories of `examples/travel`.

`--dialogues` plays that many guided dialogues of ten turns through the games of
tutoring, with every property checked; 10,000 take minutes.
"""

from __future__ import annotations

import gc
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from itertools import cycle, islice
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from _measuring import (
    Measure,
    Measures,
    Result,
    Task,
    arguments,
    clock_of,
    report,
    results,
)

from kille.dialogue.meanings import noun, theory, word_of
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from ttr import Ind, ListOf, Model, load, record, rectype
from ttr.dialogues.stories import Setting, play, read_stories
from ttr.updates import Body, Game, Rule, Run, all_, first, run
from ttr.updates.checks import faults

ROOT = Path(__file__).resolve().parent.parent

# --- the game of fetch ---------------------------------------------------------------


def fetching_task(n: int) -> Task:
    """n events of fetch, each taken by one of seven rules."""
    game = load(ROOT / "examples" / "fetch.ttr").games["fetch"]
    turn = game.take(game.begin())
    events = (None, *(move.sit for move in turn.said))
    played = tuple(islice(cycle(events), n))

    def playing() -> Run:
        return run(
            game.algorithm, game.start, type=game.type, model=turn.model, events=played
        )

    assert len(playing().trace) == n
    return playing


# --- static checks -------------------------------------------------------------------


def checking_task(n: int) -> Task:
    """n rules on as many paths, each with a condition, an event and a type to give."""
    boards = {f"part{i}": rectype(x=Ind, log=ListOf(Ind)) for i in range(n)}
    Board = rectype(boards)
    names = ("s", "e")
    rules = [
        Rule(
            f"rule{i}",
            Body(rectype({f"part{i}": rectype(x=Ind @ f"a{i + 1}")}), names),
            rectype({f"part{i}": rectype(x=Ind @ f"a{i}")}),
            on=rectype(seen=Ind @ f"a{i}"),
        )
        for i in range(n)
    ]
    model = Model()
    for i in range(n + 1):
        model = model.given(f"a{i}", Ind)
    start = record({f"part{i}": {"x": f"a{i}", "log": []} for i in range(n)})
    algorithm = first(*rules[: n // 2], all_(*rules[n // 2 :]))

    def checking() -> object:
        return faults(algorithm, Board, start=start, model=model)

    assert not checking()
    return checking


MEASURES: Measures = {
    "update": {
        "events of fetch": Measure(
            fetching_task, (100, 1000, 10_000), limits={1000: 50.0}, grows=(100, 10_000)
        ),
        "static check of rules": Measure(checking_task, (10, 50), limits={50: 1000.0}),
    },
}

# --- turns ---------------------------------------------------------------------------

ROUNDS = 40
"""How often a script is played; the first half warms up and is not counted."""

SCRIPT = (
    "Hello.",
    "What is this?",
    "Yes.",
    "This is a {noun}.",
    "What is this?",
    "No.",
    "Where is the {noun}?",
    "This is a cup.",
    "Thank you.",
    "Help.",
)
NOUNS = ("cup", "book", "box", "apple")


def seen_model() -> Model:
    """One thing in view, of which four words are true to some degree."""
    model = blank_model().given("look1", theory()["Look"]).given("o1", theory()["Ind"])
    for form, degree in zip(NOUNS, (0.55, 0.4, 0.05, 0.0), strict=True):
        word = word_of(noun(form))
        model = model.witnessed(word, by=lambda x, look, degree=degree: degree)
    return model


def tutoring_times(
    new: Callable[[int], str], clock: Callable[[], float]
) -> list[float]:
    """The milliseconds of each turn of tutoring: heard, taken, answered in words."""
    game = tutoring([noun(form) for form in NOUNS], model=seen_model())
    view = record(look="look1", things=["o1"], placed=["o1"], focus=["o1"], pointed=[])
    seen = record(view=view, kept=[], floor="tutor")
    begun = game.take(game.begin(), seen).run
    times = []
    for number in range(ROUNDS):
        so_far = begun
        for sentence in SCRIPT:
            text = sentence.format(noun=new(number))
            start = clock()
            turn = game.take(so_far, event_heard(game, text))
            said = [game.say(move) for move in turn.said] if game.say else []
            times.append(1000 * (clock() - start))
            assert said
            so_far = turn.run
    return times[len(times) // 2 :]


def event_heard(game: Game, text: str) -> object:
    assert game.hear is not None
    event = game.hear(text)
    assert event is not None, text
    return event


def travel_times(clock: Callable[[], float]) -> list[float]:
    """The milliseconds of each turn of the travel stories."""
    travel = ROOT / "examples" / "travel"
    sys.path.insert(0, str(travel))
    game = import_module("travel").game
    stories = read_stories(travel / "travel.dlg")
    scripts = [[*play(story, Setting.of(game)).dialogue.given] for story in stories]
    times = []
    for _ in range(ROUNDS // 4):
        for script in scripts:
            so_far = game.begin()
            for event in script:
                start = clock()
                so_far = game.take(so_far, event).run
                times.append(1000 * (clock() - start))
    return times[len(times) // 2 :]


def turns(clock: Callable[[], float]) -> Iterator[Result]:
    gc.collect()
    same = tutoring_times(lambda number: "pencil case", clock)
    yield limits_of("a turn of tutoring", same, 1.0, 5.0)
    new = tutoring_times(lambda number: f"thing{number}", clock)
    yield limits_of("  with words never heard before", new)
    yield limits_of("a turn with the travel agency", travel_times(clock), 1.0)


def limits_of(
    task: str, times: Sequence[float], middle: float = 0, most: float = 0
) -> Result:
    """The median and the 95th percentile, with the limits that they have."""
    found = (
        ("median", middle, median(times)),
        ("p95", most, quantiles(times, n=20)[-1]),
    )
    limits = tuple(limit for limit in found if limit[1])
    return Result("dialogue", task, {1: median(times)}, limits)


# --- dialogues -----------------------------------------------------------------------


def dialogues(count: int) -> None:
    """Plays guided dialogues through the games of tutoring; says how long it took."""
    sys.path.insert(0, str(ROOT / "tests" / "mutants"))
    talking = import_module("talking")
    from ttr.testing import Suite

    start = time.perf_counter()
    found = Suite(
        talking.game,
        tutor=talking.tutor,
        properties=talking.properties,
        roles=talking.roles,
        examples=count,
        turns=10,
    ).run()
    spent = time.perf_counter() - start
    print(f"{count:,} dialogues of ten turns: {spent:.0f} s; limit for 10,000: 300 s")
    print(found.explain_failure())


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--dialogues", type=int, metavar="N", help="play so many")
    options = parser.parse_args()
    if options.dialogues:
        dialogues(options.dialogues)
        return
    clock = clock_of(options)
    found: list[Any] = [*results(MEASURES, clock), *turns(getattr(time, clock))]
    report(found, options)


if __name__ == "__main__":
    main()
