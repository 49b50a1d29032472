"""Studies in which a person at this terminal takes part: who plays them, and how.

People are asked dialogue by dialogue, before all that is played without them. They are
not told which theory they talk to, and meet theories in an order that does not tell it:
drawn by chance, but so that each is as often the first as any other, as far as the
numbers allow. The log has the dialogues in the order of the study, and which one each
was as `order`.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import product
from random import Random

from kille.interfaces.experiment.crews import choose_crew
from kille.interfaces.terminal import console
from kille.lab.log import Broken, Finished, Outcome, RunError
from kille.lab.log.outcomes import Play, PlayAll
from kille.lab.people.typed_lines import wait_until_ready
from kille.lab.protocols.phases import CHANGING, successor, tasks
from kille.lab.running_studies import Crew, Scheduler, alone
from kille.lab.scenes import open_scene
from kille.lab.study import PERSON, Run, Study

_FIRST = "The robot was taught nothing yet."
_NEXT = "It is another robot now, and was taught nothing yet."


def has_people(study: Study) -> bool:
    """Does a person type what a tutor or the robot says?"""
    tutors = any(it.kind == "keyboard" for it in study.tutors.values())
    return tutors or any(it.mode == PERSON for it in study.theories.values())


def crew_for(study: Study, workers: int | None, scheduler: Scheduler | None) -> Crew:
    """The crew that plays a study; with a person, only this process.

    RunError where others were asked for that cannot be had.
    """
    if not has_people(study):
        return choose_crew(workers, scheduler)
    if scheduler or workers not in (None, 1):
        raise RunError(
            "a person takes part in this study, whom only one process can ask: play it "
            "with --workers 1"
        )
    return in_person


def people_summary(study: Study) -> str:
    """How many dialogues of a study people take part in, for the end of a message."""
    count = len(in_turn(study))
    return f", a person takes part in {count:,}" if count else ""


def people_in(study: Study, run: Run) -> tuple[str, ...]:
    """Who types in a dialogue, and in which role, in the words shown to them."""
    tutors = dict.fromkeys(_tutors(study, run))
    typing = [f"{it} is the tutor" for it in tutors if _types(study, it)]
    plays = study.theories[run.theory].mode == PERSON
    return (*typing, *[f"{run.theory} plays the robot"] * plays)


def _types(study: Study, tutor: str) -> bool:
    return study.tutors[tutor].kind == "keyboard"


def _tutors(study: Study, run: Run) -> Iterator[str]:
    """The tutors of a dialogue, one after the other."""
    name = run.tutor
    yield from study.tutors[name].settings.get("of", (name,))
    for phase in study.phases:
        if phase.do in CHANGING:
            name = successor(study, phase, name)
            yield from study.tutors[name].settings.get("of", (name,))


def in_turn(study: Study) -> list[Run]:
    """The dialogues in which people take part, in the order in which they are asked.

    A tutor goes on to the end; each scene of each seed is met with all theories.
    """
    scenes = [*product(study.seeds, study.scenes)]
    return [
        Run(theory, tutor, scene, seed)
        for tutor in study.tutors
        for met in [_theories_met(study, tutor)]
        for place, (seed, scene) in enumerate(scenes)
        for theory in _mix(met, tutor, place)
    ]


def _theories_met(study: Study, tutor: str) -> list[str]:
    """The theories that people meet, or play, in the dialogues of a tutor."""
    scene, seed = next(iter(study.scenes)), study.seeds[0]
    runs = (Run(theory, tutor, scene, seed) for theory in study.theories)
    return [it.theory for it in runs if people_in(study, it)]


def _mix(names: Sequence[str], tutor: str, place: int) -> list[str]:
    """Mix theories for a place in the study, in the order in which they are met.

    They are drawn by chance, and then each is the first once, the second once …
    """
    block, first = divmod(place, max(1, len(names)))
    drawn = [*names]
    Random(f"the order of theories for {tutor}, {block}").shuffle(drawn)
    return [*drawn[first:], *drawn[:first]]


@contextmanager
def in_person(study: Study, play: Play) -> Iterator[PlayAll]:
    """Play in this process: first with people, when they are ready, then the rest."""
    with alone(study, play) as play_each:

        def play_all(runs: Sequence[Run]) -> Generator[Outcome, None, None]:
            theirs, left = in_turn(study), frozenset(runs)
            for number, run in enumerate(theirs, start=1):
                if run in left:
                    _begin(study, run, number, len(theirs))
                    (outcome,) = play_each([run])
                    yield _number_outcome(outcome, number)
                    _end(outcome, number)
            others = [it for it in runs if not people_in(study, it)]
            if others:
                console().print(f"{_more(len(others))} played without you.")
            yield from play_each(others)

        yield play_all


def _more(count: int) -> str:
    return f"{count:,} more {'is' if count == 1 else 'are'}"


def _begin(study: Study, run: Run, number: int, count: int) -> None:
    """Announce a dialogue without naming the theory; wait until they are ready."""
    steps = sum(1 for _ in tasks(study, run, open_scene(study, run)))
    who = ", and ".join(people_in(study, run))
    long = f"{steps:,} step{'s' * (steps != 1)}"
    text = f"\nDialogue {number:,} of {count:,}, {long}: {who}."
    if study.theories[run.theory].mode != PERSON:
        text += f"\n{_FIRST if number == 1 else _NEXT}"
    wait_until_ready(text)


def _number_outcome(outcome: Outcome, number: int) -> Outcome:
    """Add to an outcome the number of the dialogue for the people in it."""
    if isinstance(outcome, Broken):
        return outcome
    facts = {**outcome.played.facts, "order": float(number)}
    return Finished(outcome.run, replace(outcome.played, facts=facts), outcome.seconds)


def _end(outcome: Outcome, number: int) -> None:
    """Announce the end of a dialogue, after it was written to the log."""
    became = "broke off" if isinstance(outcome, Broken) else "is over, and kept"
    console().print(f"\nDialogue {number:,} {became}.")
