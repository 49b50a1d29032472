"""How fast noun phrases are resolved, and things described, once they are perceived.

    python benchmarks/reference.py [--json] [--cpu]

The witness functions say degrees that are fixed beforehand: half of the things in view
are cups, every third is red, and a relation is true of some pairs. Everything else is
as in a dialogue: phrases are judged, ranked and set to things, and what fits several
things is described so that they can be told apart.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from _measuring import Measure, Measures, Task, arguments, clock_of, report, results

from kille.dialogue.describing import describe
from kille.dialogue.language import understand
from kille.dialogue.meanings import adjective, noun, relation, theory, word_of
from kille.dialogue.reference import intended_readings, possible_readings, ranking
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from ttr import Model, Record, RecordType, record, replace

SIZES = (2, 5, 10)
LIMIT = 5.0

NOUNS = [noun(form) for form in ("cup", "book", "box", "apple")]
ADJECTIVES = [adjective(form) for form in ("red", "blue", "big")]
RELATIONS = [relation(form) for form in ("to the left of", "near", "behind")]


def degree(n: int, kind: str, *args: str) -> float:
    """How well the n-th word of a kind fits things, by their numbers: fixed."""
    numbers = [int(x[1:]) for x in args if x[1:].isdigit()]
    if kind == "relation":
        x, y, *_ = numbers
        return 0.9 if (x + n) % 3 == y % 3 else 0.05
    size = {"noun": 2, "adjective": 3}[kind]
    return 0.9 if numbers[0] % size == n % size else 0.03


def scene(n: int) -> tuple[Record, Model]:
    """The state and the model with n things in view."""
    model = blank_model().given("look1", theory()["Look"])
    names = [f"o{number + 1}" for number in range(n)]
    for x in names:
        model = model.given(x, theory()["Ind"])
    for words in (NOUNS, ADJECTIVES, RELATIONS):
        for number, sign in enumerate(words):
            by = partial(degree, number, sign.kind)
            model = model.witnessed(word_of(sign), by=by)
    game = tutoring([*NOUNS, *ADJECTIVES, *RELATIONS], model=model)
    view = record(
        look="look1", things=names, placed=names, focus=names[:1], pointed=names[:1]
    )
    return replace(game.begin().state, view=view), model


def content(text: str) -> RecordType:
    """What a sentence is about, in the reading of which all words are known."""
    known = {(it.kind, it.form) for it in (*NOUNS, *ADJECTIVES, *RELATIONS)}
    return next(
        it.content
        for it in understand(text)[0].readings
        if {(sign.kind, sign.form) for sign in it.signs} <= known
    )


def resolving_task(text: str) -> Callable[[int], Task]:
    """The phrases of a sentence are set to things among n: readings and ranking."""

    def make(n: int) -> Task:
        (s, model), said = scene(n), content(text)

        def resolve() -> object:
            return [
                it.content
                for it in intended_readings(s, possible_readings(s, model, said))[:1]
            ]

        assert n < max(SIZES) or resolve(), text
        return resolve

    return make


def ranking_task(n: int) -> Task:
    """The things are ranked after each word of a phrase."""
    s, model = scene(n)
    words = [ADJECTIVES[0], NOUNS[0], RELATIONS[0], NOUNS[1]]
    return lambda: ranking(s, model, words)


def describing_task(n: int) -> Task:
    """The last of n things is described."""
    s, model = scene(n)
    return lambda: describe(s, model, f"o{n}")


def measure_of(make: Callable[[int], Task], limit: float) -> Measure:
    return Measure(make, SIZES, {10: limit})


MEASURES: Measures = {
    "resolving among n things": {
        "the cup": measure_of(resolving_task("Where is the cup?"), LIMIT),
        "the red cup": measure_of(resolving_task("Where is the red cup?"), LIMIT),
        "the second cup": measure_of(resolving_task("Where is the second cup?"), LIMIT),
        "the cup near the book": measure_of(
            resolving_task("Where is the cup near the book?"), LIMIT
        ),
        "the red cup near the blue book": measure_of(
            resolving_task("Where is the red cup near the blue book?"), LIMIT
        ),
        "the cup behind the box near the book": measure_of(
            resolving_task("Where is the cup behind the box near the book?"), LIMIT
        ),
        "the red cup is near the book": measure_of(
            resolving_task("The red cup is near the blue book."), LIMIT
        ),
    },
    "word by word": {"four words": measure_of(ranking_task, LIMIT)},
    "describing one of n things": {"a description": measure_of(describing_task, 50.0)},
}


if __name__ == "__main__":
    options = arguments(__doc__).parse_args()
    report(results(MEASURES, clock_of(options)), options)
