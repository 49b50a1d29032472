"""Testing a rule set: static checks first, then the properties of many dialogues."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace

from hypothesis import strategies as st

from ttr.aliases import Alias
from ttr.building.merging import merge
from ttr.dialogues.dialogue import Dialogue
from ttr.dialogues.stories import Setting
from ttr.errors import TTRError
from ttr.escapes import terminal_text
from ttr.judging.models import Model, as_model
from ttr.showing import Fold, NotebookValue, Part, Text, below, count_of
from ttr.testing.coverage import Coverage
from ttr.testing.failure_story import story
from ttr.testing.properties.catalogue import ALL, OF_GAMES, OF_ONE_RULE
from ttr.testing.properties.determinism import DETERMINISTIC
from ttr.testing.properties.pending_items import DialogueCounts
from ttr.testing.properties.property import Breach, Property, select_properties
from ttr.testing.search import UnsteadyError, find_failure, number_of_examples
from ttr.testing.shrinking import Failure
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.random_dialogues import TURNS, dialogues
from ttr.testing.strategies.random_states import states
from ttr.testing.strategies.tutors import Speaker, Tutor
from ttr.types.objects import Record
from ttr.types.syntax import RecordType, kind_of
from ttr.updates.checks import Fault, faults, faults_of
from ttr.updates.games import Game
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import Algorithm, first

Starts = st.SearchStrategy[tuple[Record, Model]]


@dataclass(frozen=True)
class Report(NotebookValue):
    """The result of testing: static faults, or the shortest dialogue that fails.

    `coverage` is what the dialogues covered, `roles` which field played which role;
    `skipped` are the properties that could not be checked, with the roles that no field
    plays. `overall` are the properties that the dialogues break together, and why;
    `undecided` are those for which there were too few, and of what there was too
    little. Dialogues end with the first that fails, and may be too few then.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> report = Suite(theory.games["notes"], examples=5).run()
    >>> report.holds, report.coverage.rules["note"] > 0
    (True, True)
    """

    coverage: Coverage
    faults: tuple[Fault, ...] = ()
    broken: Failure[Breach] | None = None
    overall: tuple[tuple[Property, str], ...] = ()
    skipped: tuple[tuple[Property, tuple[str, ...]], ...] = ()
    undecided: tuple[tuple[Property, str], ...] = ()
    roles: Roles = field(default_factory=Roles)

    @property
    def holds(self) -> bool:
        """Did nothing go wrong?"""
        return not (self.faults or self.broken or self.overall)

    def __str__(self) -> str:
        """What went wrong; if nothing did, what was covered."""
        return self.explain_failure() or self.coverage.table()

    told = Alias("explain_failure")

    def _shown_as_(self) -> Part:
        count = count_of(self.coverage.dialogues, "dialogue")
        broken = self.broken
        return below(
            Text(
                f"nothing is wrong in {count}" if self.holds else "it breaks",
                "yes" if self.holds else "no",
            ),
            *[Text(f"{it.severity}: {it}", "code") for it in self.faults],
            None if broken is None else Text(str(broken.why)),
            None if broken is None else broken.dialogue._shown_as_(),
            *[Text(f"{one}: {one.says}\n{why}") for one, why in self.overall],
            Fold("what was covered", self.coverage._shown_as_(), opened=self.holds),
        )

    def explain_failure(self, place: Setting | None = None) -> str:
        """What went wrong, with the story that shows it; empty if nothing did."""
        parts = [f"{fault.severity}: {fault}" for fault in self.faults]
        if self.broken is not None:
            parts.append(_format_failure(self.broken, place))
        parts += [f"{one}: {one.says}\n{why}" for one, why in self.overall]
        return "\n\n".join(parts)


def _format_failure(broken: Failure[Breach], place: Setting | None) -> str:
    breach, count = broken.why, len(broken.dialogue.trials)
    turns = "one turn" if count == 1 else f"{count} turns"
    text = story(broken.dialogue, str(breach.property), place)
    return f"{breach}\nThe shortest dialogue found, of {turns}:\n\n{text}"


@dataclass(frozen=True)
class Suite:
    """How a game is tested: with which tutor, for which properties, for how long.

    `after_each` is called with the coverage so far after every dialogue.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> Suite(theory.games["notes"], turns=3, examples=5).run().holds
    True
    """

    game: Game
    tutor: Tutor | Speaker | None = None
    properties: tuple[Property, ...] = ALL
    roles: Roles | None = None
    turns: int = TURNS
    examples: int | None = None
    seed: int = 0
    starts: Starts | None = None
    after_each: Callable[[Coverage], object] | None = None

    def run(self) -> Report:
        """Check the rules; if they have no faults, test dialogues as well."""
        if found := self.faults():
            return Report(Coverage(self.game), found, roles=self._roles())
        return self.played()

    def faults(self) -> tuple[Fault, ...]:
        """What is certainly wrong before anything runs: errors, but no warnings."""
        game = self.game
        if self.starts is None:
            found = faults_of(game)
        else:
            found = faults(game.algorithm, game.type, model=game.model)
        return tuple(fault for fault in found if fault.severity == "error")

    def played(self) -> Report:
        """Test dialogues, whatever the static checks say."""
        coverage = Coverage(self.game)
        roles = self._roles()
        flows = DialogueCounts(self.game, roles)

        def judge(dialogue: Dialogue) -> Breach | None:
            breaches = (one.breach(dialogue, roles) for one in self.properties)
            return next((one for one in breaches if one is not None), None)

        def count_and_judge(dialogue: Dialogue) -> Breach | None:
            coverage.add(dialogue)
            flows.add(dialogue)
            if self.after_each is not None:
                self.after_each(coverage)
            return judge(dialogue)

        drawn = dialogues(self.game, self.tutor, turns=self.turns, starts=self.starts)
        try:
            broken = find_failure(
                drawn,
                count_and_judge,
                judge,
                examples=number_of_examples(self.examples),
                start=self.seed,
                shrink_first=self.starts is not None,
            )
        except UnsteadyError as error:
            broken = Failure(error.dialogue, _breach_of_determinism(error))
        if broken is None:
            broken = next(self._across(flows), None)
        skipped = [(one, one.missing_roles(roles)) for one in self.properties]
        return Report(
            coverage,
            broken=broken,
            overall=tuple(self._overall(coverage)),
            skipped=tuple((one, lacking) for one, lacking in skipped if lacking),
            undecided=tuple(self._undecided_properties(coverage)),
            roles=roles,
        )

    def _roles(self) -> Roles:
        """The roles, with the game's agenda and the tutor's moves."""
        roles = self.roles or Roles.of(self.game.type)
        if roles.agenda is None and self.game.agenda is not None:
            roles = replace(roles, agenda=self.game.agenda)
        if roles.acts or not isinstance(self.tutor, Tutor):
            return roles
        return replace(roles, acts=self.tutor.moves)

    def _across(self, flows: DialogueCounts) -> Iterator[Failure[Breach]]:
        """What the dialogues show together, each time with one of them."""
        for one in self.properties:
            if one.across is None or one.missing_roles(flows.roles):
                continue
            for seen in one.across(flows):
                yield Failure(seen.dialogue, Breach(one, seen.turn, seen.why))

    def _overall(self, coverage: Coverage) -> Iterable[tuple[Property, str]]:
        for one in self.properties:
            if one.overall is not None and (why := one.overall(coverage)):
                yield one, why

    def _undecided_properties(
        self, coverage: Coverage
    ) -> Iterable[tuple[Property, str]]:
        for one in self.properties:
            if one.shortfall is not None and (lacking := one.shortfall(coverage)):
                yield one, lacking


def _breach_of_determinism(error: UnsteadyError) -> Breach:
    turn = len(error.dialogue.trials)
    return Breach(DETERMINISTIC, turn, str(error))


def check_rules(
    rules: Game | Algorithm | Iterable[Rule],
    type: RecordType | None = None,
    *,
    model: Model | None = None,
    tutor: Tutor | Speaker | None = None,
    properties: Iterable[Property | str] = ALL,
    roles: Roles | None = None,
    turns: int = TURNS,
    examples: int | None = None,
    seed: int = 0,
) -> Report:
    """Test a game, or rules over states of a type; raise what is wrong.

    The static checks come first. Then a tutor plays dialogues, as many as `examples`
    or the Hypothesis profile says, and each is checked for the properties. A failure is
    raised as an `AssertionError` with the property, the reason, and the shortest
    dialogue that shows it, as a story. A list of rules is played as `first` of them,
    from random states of the type; the properties of whole games are left out then,
    such as that the game is never stuck (P14). The same `seed` draws the same
    dialogues. Raises `TTRError` for what is no rule set.

    >>> from ttr import Ind, ListOf, rectype, replace
    >>> from ttr.updates import rule
    >>> Board = rectype(heard=ListOf(Ind))
    >>> @rule(when=Board, on=Ind)
    ... def note(s, e):
    ...     return replace(s, heard=[*s.heard, e])
    >>> print(check_rules([note], Board, examples=20).coverage.table())
    ... # doctest: +ELLIPSIS
    rule  applied  most often followed by
    note      ...
    1 of 1 rules applied, 0 pairs of rules, in ... turns of 20 dialogues
    """
    __tracebackhide__ = True  # pytest shows what is wrong, not where it is raised
    found = select_properties(properties, ALL)
    if isinstance(rules, Game):
        suite = Suite(rules, tutor, found, roles, turns, examples, seed)
    else:
        game, starts = _game_of_rules(rules, type, model)
        found = tuple(one for one in found if one not in OF_GAMES)
        suite = Suite(game, tutor, found, roles, turns, examples, seed, starts)
    report = suite.run()
    if not report.holds:
        raise AssertionError(terminal_text(report.explain_failure())) from None
    return report


def check_rule(
    rule: Rule,
    type: RecordType,
    *,
    model: Model | None = None,
    examples: int | None = None,
    seed: int = 0,
) -> Report:
    """Test one rule on random states of its condition and events of its type.

    It has to keep the type of the state, change nothing in the state that it is given,
    give the same each time, and name only what exists. Raises as `check_rules` does.

    >>> from ttr import Ind, ListOf, rectype, replace
    >>> from ttr.updates import rule
    >>> Board = rectype(heard=ListOf(Ind))
    >>> @rule(when=Board, on=Ind)
    ... def note(s, e):
    ...     return replace(s, heard=[*s.heard, e])
    >>> check_rule(note, Board, examples=5).holds
    True
    """
    __tracebackhide__ = True
    if not isinstance(rule, Rule):
        raise TTRError(f"one rule is checked, found {kind_of(rule)}")
    return check_rules(
        [rule],
        type,
        model=model,
        tutor=Tutor(answers=1.0, wanders=0, contradicts=0, repeats=0, silent=0),
        properties=OF_ONE_RULE,
        turns=1,
        examples=examples,
        seed=seed,
    )


# --- rules without a game ------------------------------------------------------------


def _game_of_rules(
    rules: object, type: object, model: Model | None
) -> tuple[Game, Starts]:
    """A game of the rules, and a strategy for the states in which dialogues start."""
    if not isinstance(type, RecordType):
        raise TTRError(
            f"rules are tested over states of a record type, found {kind_of(type)}",
            hint="check_rules(rules, InfoState), or check_rules(game)",
        )
    algorithm = _algorithm(rules)
    M = Model() if model is None else as_model(model)
    start, begun = M.create(type)
    game = Game("the rules", type, start, algorithm, begun)
    kinds = [type, *_types_of_states(game, M)]
    return game, st.sampled_from(kinds).flatmap(lambda T: states(T, model))


def _algorithm(rules: object) -> Algorithm:
    if isinstance(rules, Algorithm):
        return rules
    if not isinstance(rules, Iterable) or isinstance(rules, str):
        raise TTRError(f"what is tested are rules or a game, found {kind_of(rules)}")
    parts = tuple(rules)
    if not parts:
        raise TTRError("what is tested has one rule at least")
    return first(*parts)


def _types_of_states(game: Game, M: Model) -> Iterable[RecordType]:
    """The types of states in which a rule's condition holds, if there are any."""
    for rule in game.rules:
        with suppress(TTRError):
            T = merge(game.type, rule.when, M.theory)
            M.create(T)
            if isinstance(T, RecordType) and T is not game.type:
                yield T
