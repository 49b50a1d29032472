"""Small games with one slip each, as somebody might make it while writing the rules.

A slip is a few lines of a correct game that stand otherwise. The first twenty were
written before the properties that find them; the others, kept apart, were written
after, without looking at the properties.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ttr import Theory
from ttr.theories.theory import load
from ttr.updates.games import Game

__all__ = ["HELD_OUT", "ORIGINALS", "PLANTED", "Slip"]

HERE = Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "examples"

ORIGINALS = {
    "fetch": EXAMPLES / "fetch.ttr",
    **{file.stem: file for file in sorted(HERE.rglob("*.ttr"))},
}
"""The correct games, by the names of their files."""


@dataclass(frozen=True)
class Slip:
    """What stands in a correct game, and what stands there instead.

    `roles` are paths that somebody has to declare for the slip to be found.
    """

    original: str
    says: str
    edits: tuple[tuple[str, str], ...]
    roles: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return f"{self.original}: {self.says}"

    @cached_property
    def text(self) -> str:
        """The theory with the slip in it."""
        text = ORIGINALS[self.original].read_text(encoding="utf-8")
        for old, new in self.edits:
            assert text.count(old) == 1, (str(self), old, text.count(old))
            text = text.replace(old, new)
        return text

    @cached_property
    def game(self) -> Game:
        """The first game of the theory."""
        return next(iter(Theory.parse(self.text).games.values()))


def game_of(original: str) -> Game:
    """The first game of a correct theory."""
    return next(iter(load(ORIGINALS[original]).games.values()))


def slip(original: str, says: str, *edits: str, **roles: str) -> Slip:
    """A slip of which the edits are given as old, new, old, new …"""
    pairs = tuple(zip(edits[::2], edits[1::2], strict=True))
    return Slip(original, says, pairs, tuple(roles.items()))


PLANTED = (
    # --- a game of fetch, and a walk with a dog ---
    slip(
        "fetch",
        "what was brought back is still to be brought back",
        'e : Bring)\n    "The stick is back: nothing is left to be done."\n'
        "    := [agenda = [] : Agenda]",
        "e : Bring)\n    := [agenda = [Bring] : Agenda]",
    ),
    slip(
        "fetch",
        "the stick is picked up before anybody runs",
        "    := [agenda = [RunAfter] : Agenda]",
        "    := [agenda = [Fetch] : Agenda]",
    ),
    slip(
        "fetch",
        "two moves are planned, and the rule that comes next waits for one",
        "    := [agenda = [Throw] : Agenda]",
        "    := [agenda = [Throw, RunAfter] : Agenda]",
    ),
    slip(
        "fetch",
        "a rule is forgotten in the strategy",
        "fetch_next, bring_next, done)",
        "fetch_next, done)",
    ),
    slip(
        "fetch",
        "a rule waits for the move before the one that was made",
        "rule fetch_next(s : [agenda = [RunAfter] : Agenda], e : RunAfter)",
        "rule fetch_next(s : [agenda = [RunAfter] : Agenda], e : Throw)",
    ),
    slip(
        "walk",
        "one move made empties the whole agenda",
        "    := [next = rst(s.next) : Moves, common",
        "    := [next = [] : Moves, floor = ann : Agent, common",
    ),
    slip(
        "walk",
        "what was done stays on the agenda",
        "    := [next = rst(s.next) : Moves, common",
        "    := [common",
        "[floor = rex : Agent, next = [Drop] : Moves], e",
        "[floor = rex : Agent, next : nelist(RecType)], e",
    ),
    slip(
        "walk",
        "nothing takes praise, which anybody may give",
        "first(thrown, caught, dropped, praised)",
        "first(thrown, caught, dropped)",
    ),
    slip(
        "walk",
        "what is a fact is not what was done",
        "[facts = [Drop] + s.common.facts",
        "[facts = [Praise] + s.common.facts",
    ),
    slip(
        "walk",
        "who has the floor is not who moves",
        "rule caught(s : Board /\\ [floor = rex : Agent, ",
        "rule caught(s : Board /\\ [floor = ann : Agent, ",
        "    := [floor = rex : Agent, next = [Catch, Drop] : Moves]",
        "    := [next = [Catch, Drop] : Moves]",
        "next = rst(s.next) : Moves, common : [facts = [Catch]",
        "next = rst(s.next) : Moves, floor = rex : Agent, common : [facts = [Catch]",
    ),
    slip(
        "walk",
        "another throw takes the place of what is planned",
        "rule praised(s : Board /\\ [floor = ann : Agent, next = [] : Moves], e",
        "rule praised(s : Board, e",
        "    := [common : [facts = [Praise]",
        "    := [next = [Throw] : Moves, floor = ann : Agent, "
        "common : [facts = [Praise]",
        "rule thrown(s : [floor = ann : Agent, next = [] : Moves], e : Throw)",
        "rule thrown(s : [floor = ann : Agent], e : Throw)",
    ),
    # --- asking and telling ---
    slip(
        "talk",
        "what was answered stays under discussion",
        "[qud = rst(s.qud) : Topics, facts",
        "[facts",
    ),
    slip(
        "talk",
        "what is told answers what was asked, whatever it is about",
        "    where [t = e.t : Topic, q = fst(s.qud) : Topic@t]\n",
        "",
    ),
    slip(
        "talk",
        "something is a fact that nobody said",
        "facts = [e.t] + s.facts",
        "facts = [snow] + s.facts",
    ),
    slip("talk", "a fact is added twice", "[e.t] + s.facts", "[e.t, e.t] + s.facts"),
    slip(
        "talk",
        "a new question takes the place of the one that is open",
        "rule asked(s : [qud = [] : Topics], e : Ask)",
        "rule asked(s : Board, e : Ask)",
    ),
    slip(
        "library",
        "any reply of the clerk's gets the book",
        "e : Lend)\n",
        "e : [by = clerk : Person])\n",
        "    where [b = e.b : Book, wish = fst(s.shared.issues) : Book@b]\n",
        "    where [b = fst(s.shared.issues) : Book]\n",
    ),
    slip(
        "library",
        "what was thanked for stays pending",
        "[pending = rst(s.shared.pending) : Books,\n                  agreed",
        "[agreed",
    ),
    slip(
        "library",
        "the loan is the clerk's",
        "[{who = by, what = b}]",
        "[{who = clerk, what = b}]",
    ),
    slip(
        "library",
        "the wish that came last is answered last",
        "turn = clerk : Person, shared : [issues = [e.b] + s.shared.issues : Books]",
        "shared : [issues = s.shared.issues + [e.b] : Books]",
        "where [b = e.b : Book, wish = fst(s.shared.issues) : Book@b]",
        "where [b = fst(s.shared.issues) : Book]",
        "[turn = clerk : Person, shared : [issues : nelist(Book)]], e : Lend",
        "[shared : [issues : nelist(Book)]], e : Lend",
        "[turn = clerk : Person, shared : [issues : nelist(Book)]], e : Refuse",
        "[shared : [issues : nelist(Book)]], e : Refuse",
    ),
)
"""Twenty slips: eleven of moves that are planned, nine of asking and telling."""

HELD_OUT = (
    slip(
        "greeting",
        "a greeting that is returned is returned again",
        "    := [agenda = [] : Acts, met = [HelloBack] : Acts]",
        "    := [agenda = [HelloBack] : Acts]",
    ),
    slip(
        "greeting",
        "who leaves is not parted with",
        "    := [agenda = [ByeBack] : Acts]",
        "    := [met = [] : Acts]",
    ),
    slip(
        "shopping",
        "what was vetoed is on the list as well",
        "    := [proposed = rst(s.proposed) : Items]\n",
        "    := [proposed = rst(s.proposed) : Items,\n"
        "        accepted = s.accepted + [top] : Items]\n",
    ),
    slip(
        "shopping",
        "whatever is confirmed, the proposal is accepted",
        "    where [it = e.it : Item, top = fst(s.proposed) : Item@it]\n"
        "    := [proposed = rst(s.proposed) : Items, accepted",
        "    where [it = e.it : Item, top = fst(s.proposed) : Item]\n"
        "    := [proposed = rst(s.proposed) : Items, accepted",
    ),
    slip(
        "shopping",
        "a list that is confirmed forgets what was on it",
        "accepted = s.accepted + [top]",
        "accepted = [top]",
    ),
    slip(
        "clarify",
        "the clarification takes the place of what it clarifies",
        "    := [qud = [which_one, where_to] : Issues]",
        "    := [qud = [which_one] : Issues]",
    ),
    slip(
        "clarify",
        "the clarification lies below what it clarifies",
        "    := [qud = [which_one, where_to] : Issues]",
        "    := [qud = [where_to, which_one] : Issues]",
    ),
    slip(
        "floor",
        "news are put down to the one who listens",
        "facts = [{by = e.by, what = e.what}] + s.shared.facts : Heard]]\nrule ben",
        "facts = [{by = ben, what = e.what}] + s.shared.facts : Heard]]\nrule ben",
    ),
    slip(
        "floor",
        "who has told keeps the floor",
        "    := [floor = ben : Ind, ",
        "    := [floor = amy : Ind, ",
    ),
    slip(
        "accommodate",
        "an answer leaves its question open",
        "    := [shared : [issues = [] : list(Question), com = [{q = dest, c = e.c}]",
        "    := [shared : [com = [{q = dest, c = e.c}]",
    ),
    slip(
        "untyped",
        "what is told answers what was asked, whatever it is about",
        "    where [t = e.t : Ind, q = fst(s.qud) : Ind@t]\n",
        "",
    ),
)
"""Slips in games of other kinds, written without looking at the properties."""
