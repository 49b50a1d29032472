"""Faulty variants of correct rule sets: each is one slip that a person might make.

A mutant is a function from the correct game to a faulty one. Property tests are worth
something if they find the fault in each of them, and none in the games themselves.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from itertools import count
from types import ModuleType

import asking
import fetching
import talking
import travelling

from kille.dialogue.moves import answering, plan
from ttr import ListOf, Model, Record, RecType, rectype, replace
from ttr.semantics.questions import top
from ttr.testing import ALL, Property
from ttr.types import TypeNode
from ttr.updates import Game, Rule
from ttr.updates.update_strategies import replace_rules

__all__ = ["GAMES", "MUTANTS", "Mutant", "properties_of"]

GAMES: dict[str, ModuleType] = {
    "asking": asking,
    "fetch": fetching,
    "tutoring": talking,
    "travel": travelling,
}
"""The correct games, each with its tutor and its roles."""


def properties_of(name: str) -> tuple[Property, ...]:
    """What should hold of a game: its own properties, if it has any."""
    return getattr(GAMES[name], "properties", ALL)


Change = Callable[[Game], Game]


@dataclass(frozen=True)
class Mutant:
    """A slip: in which game, what it is, and how it is made."""

    game: str
    name: str
    slip: str
    change: Change

    @property
    def made(self) -> Game:
        """The faulty game."""
        return self.change(GAMES[self.game].game)

    def __str__(self) -> str:
        return f"{self.game}-{self.name}"


MUTANTS: list[Mutant] = []


def mutant(game: str, slip: str) -> Callable[[Change], Change]:
    """Adds the mutant that a function makes."""

    def add(change: Change) -> Change:
        name = change.__name__.strip("_").replace("_", "-")
        MUTANTS.append(Mutant(game, name, slip, change))
        return change

    return add


def rule_of(game: Game, name: str) -> Rule:
    """The rule of this name."""
    return next(rule for rule in game.rules if rule.name == name)


def with_rules(game: Game, *rules: Rule) -> Game:
    """The game with these rules in place of those of their names."""
    algorithm = replace_rules(game.algorithm, {rule.name: rule for rule in rules})
    return dataclasses.replace(game, algorithm=algorithm)


def with_effect(game: Game, name: str, effect: Callable[..., object]) -> Game:
    """The game in which a rule has another effect."""
    return with_rules(game, dataclasses.replace(rule_of(game, name), effect=effect))


def after(game: Game, name: str, then: Callable[..., object]) -> Game:
    """The game in which a rule gives `then(before, after)`, where it applies."""
    rule = rule_of(game, name)

    def effect(s: Record, *args: object, **extra: object) -> object:
        found = rule.effect(s, *args, **extra)
        match found:
            case None:
                return None
            case (after, model):
                return then(s, after), model
        return then(s, found)

    return with_effect(game, rule.name, effect)


def listening(game: Game, name: str, T: TypeNode) -> Game:
    """The game in which a rule takes events of another type."""
    return with_rules(game, dataclasses.replace(rule_of(game, name), on=T))


def never(game: Game, name: str) -> Game:
    """The game in which a rule never applies."""
    return after(game, name, lambda before, found: None)


# --- a system that asks ---------------------------------------------------------------


@mutant("asking", "a question that was answered stays under discussion")
def lost_downdate(game: Game) -> Game:
    return never(game, "downdate")


@mutant("asking", "the topmost question is dropped, answered or not")
def careless_downdate(game: Game) -> Game:
    def downdate(s: Record) -> Record | None:
        rest = s.shared.qud[1:]
        return replace(s, {"shared.qud": rest}) if s.shared.qud else None

    return with_effect(game, "downdate", downdate)


@mutant("asking", "a question is put twice")
def asked_twice(game: Game) -> Game:
    def twice(before: Record, found: Record) -> Record:
        return replace(found, {"shared.qud": (found.shared.qud[0], *found.shared.qud)})

    return after(game, "put", twice)


@mutant("asking", "what is agreed on takes the place of what was")
def forgetful(game: Game) -> Game:
    def only(before: Record, found: Record) -> Record:
        return replace(found, {"shared.commitments": found.shared.commitments[-1:]})

    return after(game, "accept", only)


@mutant("asking", "an answer is accepted though nothing was asked")
def gullible(game: Game) -> Game:
    def accept(s: Record, e: Record) -> Record:
        fact = Record({"q": e.q, "a": e.a})
        return replace(s, {"shared.commitments": (*s.shared.commitments, fact)})

    return with_effect(game, "accept", accept)


@mutant("asking", "the repeated rule does not see that its work is done")
def no_end(game: Game) -> Game:
    def downdate(s: Record) -> Record:
        settled = {fact.q for fact in s.shared.commitments}
        kept = [q for q in s.shared.qud if q not in settled]
        return replace(s, {"shared.qud": kept})

    return with_effect(game, "downdate", downdate)


@mutant("asking", "a question that was asked stays in the plan")
def planned_for_ever(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"private.plan": before.private.plan})

    return after(game, "put", kept)


@mutant("asking", "what was said stays on the agenda")
def says_it_again(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"private.agenda": before.private.agenda})

    return after(game, "note_own", kept)


@mutant("asking", "what the tutor does is not the latest move")
def stale_latest(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"shared.latest": before.shared.latest})

    return after(game, "note", kept)


@mutant("asking", "every move of the tutor's is taken for a greeting")
def greets_always(game: Game) -> Game:
    return listening(game, "greet_back", asking.Heard)


@mutant("asking", "two rules of a class undo what the other does")
def order_matters(game: Game) -> Game:
    return listening(game, "take_back", asking.Heard)


@mutant("asking", "a move is noted twice in the history")
def counted_twice(game: Game) -> Game:
    def twice(before: Record, found: Record) -> Record:
        history = (*found.shared.history, found.shared.latest)
        return replace(found, {"shared.history": history})

    return after(game, "note", twice)


# --- a game of fetch ------------------------------------------------------------------


def plans(game: Game, name: str, *agenda: object) -> Game:
    """The game in which a rule plans something else."""
    rule = rule_of(game, name)
    T = rectype(agenda=ListOf(RecType) @ agenda)
    body = dataclasses.replace(rule.effect, value=T)
    return with_rules(game, dataclasses.replace(rule, effect=body))


@mutant("fetch", "the stick is fetched before anybody runs")
def skips_a_move(game: Game) -> Game:
    return plans(game, "throw_next", fetching.theory["Fetch"])


@mutant("fetch", "what has been brought back is to be brought back again")
def brings_for_ever(game: Game) -> Game:
    return plans(game, "done", fetching.theory["Bring"])


@mutant("fetch", "the game begins again before it is over")
def round_in_circles(game: Game) -> Game:
    return plans(game, "done", fetching.theory["PickUp"])


@mutant("fetch", "the name of an object stands where a type has to")
def plans_a_thing(game: Game) -> Game:
    return plans(game, "attract_next", "stick")


@mutant("fetch", "two moves are planned at once")
def hurries(game: Game) -> Game:
    theory = fetching.theory
    return plans(game, "attract_next", theory["Attract"], theory["Throw"])


@mutant("fetch", "a rule waits for the move before the one that was made")
def waits_for_the_wrong_move(game: Game) -> Game:
    return with_rules(
        game,
        dataclasses.replace(rule_of(game, "run_next"), on=fetching.theory["Attract"]),
    )


@mutant("fetch", "what comes next depends on how often it was played")
def counts_in_secret(game: Game) -> Game:
    played = count()

    def sometimes(before: Record, found: object) -> object:
        return replace(before, agenda=()) if next(played) % 3 == 2 else found

    return after(game, "throw_next", sometimes)


@mutant("fetch", "a rule writes into the state that it is given")
def scribbles(game: Game) -> Game:
    def scribbled(before: Record, found: object) -> object:
        before._fields["agenda"] = (fetching.theory["PickUp"],)
        return found

    return after(game, "begin", scribbled)


# --- a robot that is taught -----------------------------------------------------------


@mutant("tutoring", "no is taken for yes, and yes for no")
def wrong_polarity(game: Game) -> Game:
    return with_rules(
        game,
        dataclasses.replace(rule_of(game, "learn_confirmed"), when=answering("Deny")),
        dataclasses.replace(rule_of(game, "ask_again"), when=answering("Affirm")),
    )


@mutant("tutoring", "what the tutor says is not the latest move")
def stale_question(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"shared.latest": before.shared.latest})

    return after(game, "hear", kept)


@mutant("tutoring", "what the robot has said is not the latest move")
def stale_answer(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"shared.latest": before.shared.latest})

    return after(game, "say", kept)


@mutant("tutoring", "what the robot has said stays on its agenda")
def parrot(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"private.agenda": before.private.agenda})

    return after(game, "say", kept)


@mutant("tutoring", "a lesson takes the place of all earlier ones")
def one_lesson_only(game: Game) -> Game:
    def only(before: Record, found: Record) -> Record:
        return replace(found, {"shared.commitments": found.shared.commitments[-1:]})

    return after(game, "keep", only)


@mutant("tutoring", "a rule that does not apply has cleared what is pending")
def impure_precondition(game: Game) -> Game:
    rule = rule_of(game, "learn_confirmed")

    def effect(s: Record) -> object:
        found = rule.effect(s)
        if found is None:
            s.shared._fields["pending"] = ()
        return found

    return with_effect(game, rule.name, effect)


@mutant("tutoring", "a text stands where a record has to")
def latest_is_text(game: Game) -> Game:
    def text(before: Record, found: Record) -> Record:
        return replace(found, {"shared.latest": found.shared.latest.text})

    return after(game, "hear", text)


@mutant("tutoring", "nobody looks whether there is anything in view")
def looks_at_nothing(game: Game) -> Game:
    rule = rule_of(game, "refer")

    def effect(s: Record, *, model: Model) -> object:
        shown = replace(s, {"shared.salient": (s.view.focus[0],)})
        return rule.effect(shown, model=model)

    return with_effect(game, rule.name, effect)


@mutant("tutoring", "the path of a field is misspelt")
def misspelt_path(game: Game) -> Game:
    def effect(s: Record) -> Record:
        return replace(plan(s, "GreetBack"), {"shared.pendign": ()})

    return with_effect(game, "GreetBack to Greet", effect)


@mutant("tutoring", "which of two it is is asked though nothing was claimed")
def unpacks_nothing(game: Game) -> Game:
    def effect(s: Record) -> Record:
        content, rival = s.shared.pending
        return plan(s, "AskWhich", content, rival, pending=s.shared.pending)

    return with_effect(game, "ask_which", effect)


@mutant("tutoring", "that it does not know is tried before a guess")
def never_guesses(game: Game) -> Game:
    guess, admit = rule_of(game, "guess_name"), rule_of(game, "admit_name")
    swapped = {"guess_name": admit, "admit_name": guess}
    algorithm = replace_rules(game.algorithm, swapped)
    return dataclasses.replace(game, algorithm=algorithm)


@mutant("tutoring", "the robot says the same thing twice")
def says_it_twice(game: Game) -> Game:
    def twice(before: Record, found: Record) -> Record:
        agenda = found.private.agenda
        return replace(found, {"private.agenda": (*agenda, *agenda)})

    return after(game, "assert_name", twice)


@mutant("tutoring", "what is said depends on what was said in other dialogues")
def moody(game: Game) -> Game:
    asked = count()

    def sometimes(before: Record, found: Record) -> Record | None:
        return None if next(asked) % 4 == 3 else found

    return after(game, "assert_name", sometimes)


@mutant("tutoring", "thanks are answered by a greeting")
def mixed_up_replies(game: Game) -> Game:
    thanked, greeted = "Welcome to Thank", "GreetBack to Greet"
    effect = rule_of(game, greeted).effect
    return with_effect(game, thanked, effect)


# --- a travel agency, by IBiS1 --------------------------------------------------------


@mutant("travel", "the phrase book has no for yes")
def no_is_yes(game: Game) -> Game:
    book = travelling.book
    said_yes = book.phrases["yes",]
    phrases = {**book.phrases, ("no",): said_yes}
    return dataclasses.replace(
        game, hear=dataclasses.replace(book, phrases=phrases).hear
    )


@mutant("travel", "a question that is resolved stays under discussion")
def lost_downdate_qud(game: Game) -> Game:
    return never(game, "downdate_qud")


@mutant("travel", "whatever the user answers is the answer to what was asked")
def relevant_or_not(game: Game) -> Game:
    from ttr.semantics.questions import combine

    def effect(s: Record, m: object) -> Record | None:
        question = top(s.shared.qud)
        if question is None:
            return None
        P = combine(question, m.args[-1], game.model)
        changes = {"private.nim": s.private.nim[1:], "shared.com": (*s.shared.com, P)}
        return replace(s, changes)

    return with_effect(game, "integrate_usr_answer", effect)


@mutant("travel", "a short answer is agreed on as it is")
def agrees_on_a_city(game: Game) -> Game:
    def short(before: Record, found: Record) -> Record:
        content = before.private.nim[0].args[-1]
        return replace(found, {"shared.com": (*before.shared.com, content)})

    return after(game, "integrate_usr_answer", short)


@mutant("travel", "what the user said is not the latest utterance")
def stale_utterance(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"shared.lu.moves": before.shared.lu.moves})

    return after(game, "get_own_moves", kept)


@mutant("travel", "a question that is there already is pushed once more")
def pushes_twice(game: Game) -> Game:
    def twice(before: Record, found: Record) -> Record:
        question = before.private.nim[0].args[-1]
        return replace(found, {"shared.qud": (question, *before.shared.qud)})

    return after(game, "integrate_usr_ask", twice)


@mutant("travel", "a condition of the plan is not taken off when it is decided")
def decides_for_ever(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, {"private.plan": before.private.plan})

    return after(game, "exec_if_then", kept)


@mutant("travel", "an answer of the system's takes the place of what is agreed on")
def forgets_the_trip(game: Game) -> Game:
    def only(before: Record, found: Record) -> Record:
        return replace(found, {"shared.com": found.shared.com[-1:]})

    return after(game, "integrate_sys_answer", only)


@mutant("travel", "what was said stays to be said")
def stuck_output(game: Game) -> Game:
    def kept(before: Record, found: Record) -> Record:
        return replace(found, output=before.output)

    return after(game, "get_own_moves", kept)


@mutant("travel", "the list of questions is changed where it stands")
def downdates_in_place(game: Game) -> Game:
    def in_place(before: Record, found: Record) -> Record:
        before.shared._fields["qud"] = found.shared.qud
        return found

    return after(game, "downdate_qud", in_place)


@mutant("travel", "a word that nobody knows is looked up in the table")
def unknown_words(game: Game) -> Game:
    book = travelling.book

    def hear(text: str) -> object:
        first = text.split()[:1]
        return book.hear(text) if not first else _looked_up(text, first[0])

    def _looked_up(text: str, word: str) -> object:
        known = {phrase[0] for phrase in book.phrases}
        return {one: book.hear(text) for one in known}[word.lower()]

    return dataclasses.replace(game, hear=hear)


@mutant("travel", "one answer resolves all that is under discussion")
def resolves_all(game: Game) -> Game:
    def nothing_left(before: Record, found: Record) -> Record:
        return replace(found, {"shared.qud": ()})

    return after(game, "downdate_qud", nothing_left)


@mutant("travel", "the user's answer is dropped, not only integrated")
def drops_what_was_agreed(game: Game) -> Game:
    def none(before: Record, found: Record) -> Record:
        return replace(found, {"shared.com": ()})

    return after(game, "integrate_usr_answer", none)


@mutant("travel", "to say good-bye does not end the dialogue, nor leave a way on")
def no_way_on(game: Game) -> Game:
    rule = rule_of(game, "get_user_moves")

    def effect(s: Record, e: Record) -> Record | None:
        return None if len(s.shared.com) > 1 else rule.effect(s, e)

    def nothing(s: Record) -> Record | None:
        silent = rule_of(game, "hear_nothing")
        return None if len(s.shared.com) > 1 else silent.effect(s)

    return with_rules(
        game,
        dataclasses.replace(rule, effect=effect),
        dataclasses.replace(rule_of(game, "hear_nothing"), effect=nothing),
    )
