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
from collections.abc import Iterator

from kille.lab.tutors.exploring import exploring_tutor
from kille.lab.tutors.tested_game import roles_in
from kille.lab.worlds.dialogue_properties import OF_TUTORING
from kille.lab.worlds.robot_profiles import ROBOTS, RobotProfile
from ttr.testing import ALL, Report, Suite

BATCH = 10
"""How many dialogues there are in one world.

After so many Hypothesis begins to draw variants of the ones that it has drawn.
"""


def reports(
    robot: RobotProfile, count: int, options: argparse.Namespace
) -> Iterator[Report]:
    """What comes of so many dialogues with a robot, in one world after the other."""
    checked = () if options.plain else (*OF_TUTORING, *ALL)
    for number, left in enumerate(range(count, 0, -BATCH)):
        seed = options.seed + len(ROBOTS) * number + ROBOTS.index(robot)
        yield Suite(
            robot.game(seed),
            exploring_tutor(robot.language),
            # What no dialogue of one robot applied may be for another: told below.
            properties=tuple(one for one in checked if one.name != "P6"),
            roles=roles_in(robot.language),
            turns=options.turns,
            examples=min(BATCH, left),
            seed=seed,
        ).run()


def facts(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """What came of the dialogues with each robot, up to the first that went wrong."""
    for robot in ROBOTS:
        count = max(1, round(options.dialogues * robot.share))
        start, wrong = time.process_time(), ""
        dialogues, turns, rules = 0, 0, Counter[str]()
        for report in reports(robot, count, options):
            dialogues += report.coverage.dialogues
            turns += report.coverage.turns
            rules.update(
                {name: report.coverage.rules[name] for name in report.coverage.names}
            )
            if wrong := report.explain_failure():
                break
        spent = time.process_time() - start
        yield {
            "robot": robot.name,
            "dialogues": dialogues,
            "turns": turns,
            "seconds": round(spent, 1),
            "milliseconds a turn": round(1000 * spent / max(1, turns), 2),
            "wrong": wrong,
            "rules": dict(rules),
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
