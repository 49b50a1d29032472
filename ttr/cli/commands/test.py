"""`ttr test`: plays many dialogues with the games of a file, and says what breaks."""

from __future__ import annotations

import argparse
import signal
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

from ttr.cli.consent_options import (
    add_consent,
    consent_of,
    named_game,
)
from ttr.cli.output import (
    FAILED,
    FINE,
    INTERRUPTED,
    Commands,
    LiveLine,
    complain,
    say,
    say_json,
)
from ttr.errors import TTRError

if TYPE_CHECKING:
    from ttr.dialogues.stories import Setting
    from ttr.safety.consent import Consent
    from ttr.testing import Coverage, Report
    from ttr.testing.strategies.discourse_roles import Roles
    from ttr.updates import Game

EXAMPLES = 1000
PROCESSED = 20
"""How many dialogues are played once more, in processes of their own."""

PATIENCE = 2.0
"""After how many seconds a terminal shows progress."""

REFRESH = 0.1
WIDTH = 30


def add(commands: Commands) -> None:
    """Declares the command."""
    test = commands.add_parser(
        "test",
        help="play many dialogues, and find the shortest that breaks",
        description="Checks the rules of games before they run, then plays dialogues "
        "and checks what dialogues should be like; exits with 1 if something breaks.",
    )
    test.add_argument(
        "rules", metavar="RULES", help="FILE.ttr, FILE.py:GAME or MODULE:GAME"
    )
    test.add_argument("--game", metavar="NAME", help="only this game of the file")
    test.add_argument(
        "--examples",
        type=_count,
        default=EXAMPLES,
        metavar="N",
        help=f"how many dialogues (default: {EXAMPLES})",
    )
    test.add_argument(
        "--turns", type=_count, default=10, metavar="N", help="of how many turns"
    )
    test.add_argument(
        "--seed", type=_number, default=0, metavar="S", help="draws other dialogues"
    )
    test.add_argument(
        "--role",
        type=_role,
        action="append",
        default=[],
        metavar="ROLE=PATH",
        help="what plays a role in the state, as qud=shared.issues; nothing does: "
        "commitments=, rules that may: drops=reject,cancel",
    )
    test.add_argument("--json", action="store_true", help="report for machines")
    add_consent(test)
    test.set_defaults(run=_test)


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a number from 1 on, found {text}")
    return int(text)


def _number(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"expected a whole number, found {text}"
        ) from None


def _role(text: str) -> tuple[str, str]:
    role, sign, path = text.partition("=")
    if not sign or not role:
        raise argparse.ArgumentTypeError(f"expected ROLE=PATH, found {text}")
    return role, path


def _test(options: argparse.Namespace) -> int:
    try:
        import ttr.testing  # noqa: F401
    except ImportError as error:
        return complain(str(error))
    try:
        places = _named_games(options.rules, options.game, consent_of(options))
    except TTRError as error:
        return complain(str(error))
    try:
        roles = [_roles(place.game, options.role) for place in places]
    except TTRError as error:
        return complain(str(error))
    outcomes = []
    for place, played in zip(places, roles, strict=True):
        outcome = _outcome(place, played, options)
        outcomes.append(outcome)
        if not options.json:
            say(outcome.format_report())
        if outcome.was_interrupted:
            break
    if options.json:
        facts = [one.facts() for one in outcomes]
        say_json(facts)
    return max(one.code for one in outcomes)


# --- which games ---------------------------------------------------------------------


def _named_games(rules: str, game: str | None, consent: Consent) -> list[Setting]:
    """The settings of the games that the user names."""
    if not rules.endswith(".ttr"):
        named = rules if ":" in Path(rules).name else f"{rules}:{game or 'game'}"
        return [named_game(named, consent)]
    if game is not None:
        return [named_game(f"{rules} {game}", consent)]
    from ttr.theories.theory import load

    if not Path(rules).is_file():
        raise TTRError(f"there is no file {rules}")
    names = load(rules, allow=consent.folders).openings
    if not names:
        raise TTRError(f"{rules} has no game: write `game NAME(START : TYPE) := …`")
    return [named_game(f"{rules} {name}", consent) for name in names]


def _roles(game: Game, declared: list[tuple[str, str]]) -> Roles | None:
    """The roles of paths: as the module of the game says, and as options declare."""
    from ttr.testing.game_settings import roles_of
    from ttr.testing.strategies.discourse_roles import Roles

    roles = roles_of(game)
    if not declared:
        return roles
    return (roles or Roles.of(game.type)).with_declared(game.type, dict(declared))


# --- testing one ---------------------------------------------------------------------


@dataclass(frozen=True)
class _Outcome:
    """The result of testing one game."""

    place: Setting
    coverage: Coverage
    report: Report | None
    across: str
    """How processes with different hash seeds differ; empty if they do not."""
    seconds: float

    @property
    def was_interrupted(self) -> bool:
        return self.report is None

    @property
    def code(self) -> int:
        if self.report is None:
            return INTERRUPTED
        return FINE if self.report.holds and not self.across else FAILED

    def format_report(self) -> str:
        """The report for people: what went wrong, and what was covered."""
        known = "\n".join(filter(None, [self._roles(), self._what_is_open()]))
        parts = [self._failures(), self.coverage.table(), known, self._summary()]
        return "\n\n".join(filter(None, parts)) + "\n"

    def _failures(self) -> str:
        told = self.report.explain_failure(self.place) if self.report else ""
        return "\n\n".join(filter(None, [told.rstrip(), self._process_difference()]))

    def _process_difference(self) -> str:
        from ttr.testing.properties.determinism import DETERMINISTIC

        if not self.across:
            return ""
        return f"{DETERMINISTIC}: {DETERMINISTIC.says}\n{self.across}"

    def _what_is_open(self) -> str:
        """Which properties were not checked and why, and which rules never applied."""
        if self.report is None:
            return ""
        lacking: dict[str, list[str]] = {}
        for one, no in self.report.skipped:
            lacking.setdefault(f"no {', '.join(no)}", []).append(one.name)
        for one, few in self.report.undecided:
            lacking.setdefault(few, []).append(one.name)
        told = [f"{', '.join(names)} ({why})" for why, names in lacking.items()]
        parts = [f"not checked: {'; '.join(told)}"] if told else []
        if not self.report.faults and (never := self.coverage.missed_rules):
            parts.append(f"never applied: {', '.join(never)}")
        return "; ".join(parts)

    def _roles(self) -> str:
        """Which paths were taken for which roles, and how to change that."""
        paths = self.report.roles.paths if self.report is not None else {}
        if not paths:
            return ""
        told = ", ".join(f"{path} as {role}" for role, path in paths.items())
        return f"taken: {told}; to change it: --role ROLE=PATH"

    def _summary(self) -> str:
        name, count = self.place.game.name, self.coverage.dialogues
        took = f"{count} dialogue{'s' * (count != 1)} in {self.seconds:.1f} s"
        if self.report is None:
            return f"{name}: stopped after {took}"
        if self.code != FINE:
            return f"{name}: breaks, {took}"
        never = self.coverage.missed_rules
        if not never:
            return f"{name}: holds, {took}"
        verb = "was" if len(never) == 1 else "were"
        return f"{name}: holds, but {', '.join(never)} {verb} never applied, {took}"

    def facts(self) -> dict[str, Any]:
        """The report as a JSON object."""
        report = self.report
        facts: dict[str, Any] = {
            "game": self.place.game.name,
            "holds": self.code == FINE,
            "interrupted": self.was_interrupted,
            "seconds": round(self.seconds, 3),
            "coverage": self.coverage.facts(),
            "across_processes": self.across or None,
        }
        if report is not None:
            facts["faults"] = [str(fault) for fault in report.faults]
            facts["broken"] = _broken_facts(report, self.place)
            facts["overall"] = [
                {"property": one.name, "why": why} for one, why in report.overall
            ]
            facts["roles"] = report.roles.paths
            open_ones = (*report.skipped, *report.undecided)
            facts["not_checked"] = [one.name for one, _ in open_ones]
        return facts


def _broken_facts(report: Report, place: Setting) -> dict[str, Any] | None:
    from ttr.testing.failure_story import story

    if report.broken is None:
        return None
    breach = report.broken.why
    return {
        "property": breach.property.name,
        "says": breach.property.says,
        "turn": breach.turn,
        "why": breach.why,
        "story": story(report.broken.dialogue, str(breach.property), place),
    }


def _outcome(
    place: Setting, roles: Roles | None, options: argparse.Namespace
) -> _Outcome:
    from ttr.testing import Suite
    from ttr.testing.game_settings import starts_of, tutor_of
    from ttr.testing.hash_seeds import first_difference

    watch = _Progress(place.game, options.examples)
    suite = Suite(
        place.game,
        tutor_of(place.game),
        roles=roles,
        turns=options.turns,
        examples=options.examples,
        seed=options.seed,
        starts=starts_of(place.game),
        after_each=watch.see,
    )
    report, across = None, ""
    with watch:
        try:
            report = suite.run()
            if report.holds and place.reference:
                across = first_difference(place, examples=PROCESSED, start=options.seed)
        except KeyboardInterrupt:
            report = None
        except TTRError as error:
            across = error.message
    return _Outcome(place, watch.coverage, report, across, watch.seconds)


class _Progress:
    """Keeps what was covered so far, and shows progress at a terminal.

    Ctrl-C takes effect between two dialogues: an interrupt during the destruction of an
    object would be lost. A second one takes effect at once.
    """

    def __init__(self, game: Game, total: int) -> None:
        from ttr.testing import Coverage

        self.coverage = Coverage(game)
        self._total = total
        self._began = self._told = monotonic()
        self._stops, self._line = False, LiveLine()

    def __enter__(self) -> None:
        self._usual = signal.getsignal(signal.SIGINT)
        with suppress(ValueError):  # only the main thread may
            signal.signal(signal.SIGINT, self._stop)

    def __exit__(self, *_: object) -> None:
        with suppress(ValueError):
            signal.signal(signal.SIGINT, self._usual)
        self._line.clear()

    def _stop(self, *_: object) -> None:
        if self._stops:
            raise KeyboardInterrupt
        self._stops = True

    @property
    def seconds(self) -> float:
        """The seconds since it began."""
        return monotonic() - self._began

    def see(self, coverage: Coverage) -> None:
        """Notes what is covered after one more dialogue."""
        self.coverage = coverage
        if self._stops:
            raise KeyboardInterrupt
        now = monotonic()
        if now - self._began < PATIENCE or now - self._told < REFRESH:
            return
        self._told = now
        self._line.show(_bar(coverage.dialogues, self._total))


def _bar(done: int, total: int) -> str:
    share = min(1.0, done / total)
    filled = round(WIDTH * share)
    return f"{'█' * filled}{'░' * (WIDTH - filled)} {done} of {total} dialogues"
