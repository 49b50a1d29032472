"""Thousands of guided dialogues with the games of tutoring, every property checked.

    python benchmarks/dialogues.py [--dialogues N] [--turns N] [--seed S] [--json]

A tutor who knows a simulated world talks to robots of several strategies, in two
languages. The first dialogue that breaks a property is told, with what it breaks; so
are the rules that no dialogue applied. With `--plain` nothing is checked: how long the
dialogues themselves take.
"""

from __future__ import annotations

import argparse
import json
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from kille.simulation.playing import simulated
from kille.simulation.properties import OF_TUTORING
from kille.simulation.tutoring import roles
from kille.simulation.tutors import tutoring
from kille.simulation.worlds import drawn
from ttr.testing import ALL, Report, Suite


@dataclass(frozen=True)
class Robot:
    """Who the tutor talks to, in which language, in which share of the dialogues."""

    name: str
    share: float
    language: str = "en"
    strategy: Mapping[str, str] = field(default_factory=dict)
    world: Mapping[str, Any] = field(default_factory=dict)


ROBOTS = (
    Robot("assisted", 0.3),
    Robot("assisted, seeing flat pictures", 0.05, world={"deep": False}),
    Robot("assisted, seeing badly", 0.1, world={"noise": 0.12, "things": 5}),
    Robot("assisted, Swedish", 0.15, "sv"),
    Robot("assisted, four bands", 0.1, strategy={"wording": "four"}),
    Robot("autonomous", 0.1, strategy={"mode": "autonomous"}),
    Robot(
        "autonomous, four bands",
        0.1,
        strategy={"mode": "autonomous", "wording": "four"},
    ),
    Robot("driven", 0.1, strategy={"mode": "driven"}),
)


def played(robot: Robot, count: int, options: argparse.Namespace) -> Report:
    """What comes of so many dialogues with a robot."""
    world = drawn(options.seed, **robot.world)
    checked = () if options.plain else (*OF_TUTORING, *ALL)
    suite = Suite(
        simulated(world, language=robot.language, **robot.strategy),
        tutoring(robot.language),
        # What no dialogue of one robot applied may be for another: it is told below.
        properties=tuple(one for one in checked if one.name != "P6"),
        roles=roles,
        turns=options.turns,
        examples=count,
        seed=options.seed,
    )
    return suite.run()


def facts(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """What came of the dialogues with each robot."""
    for robot in ROBOTS:
        count = max(1, round(options.dialogues * robot.share))
        start = time.process_time()
        report = played(robot, count, options)
        spent = time.process_time() - start
        turns = report.coverage.turns
        yield {
            "robot": robot.name,
            "dialogues": report.coverage.dialogues,
            "turns": turns,
            "seconds": round(spent, 1),
            "milliseconds a turn": round(1000 * spent / max(1, turns), 2),
            "wrong": report.told(),
            "rules": {
                name: report.coverage.rules[name] for name in report.coverage.names
            },
        }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--dialogues", type=int, default=300, metavar="N")
    parser.add_argument("--turns", type=int, default=10, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    parser.add_argument("--plain", action="store_true", help="check no property")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    found, applied = [], Counter[str]()
    for one in facts(options):
        found.append(one)
        applied.update(one["rules"])  # type: ignore[call-overload]
        if not options.json:
            told = ", ".join(f"{one[key]} {key}" for key in list(one)[1:5])
            print(f"{one['robot']}: {told}\n{one['wrong'] or 'all holds'}", flush=True)
    missed = [name for name, count in applied.items() if not count]
    if options.json:
        print(json.dumps({"robots": found, "never applied": missed}))
        return
    print(f"{len(applied) - len(missed)} of {len(applied)} rules applied")
    print(f"never applied: {', '.join(missed) or 'none'}")


if __name__ == "__main__":
    main()
