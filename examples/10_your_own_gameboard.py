"""Your own gameboard: a type of information states, three rules, and what a slip does.

Run it with `python examples/10_your_own_gameboard.py`, and read along.
"""

from ttr import Ind, ListOf, Model, Pred, RecType, outer, record, rectype, replace
from ttr.errors import UpdateError
from ttr.semantics.questions import (
    Question,
    combine,
    downdate,
    push,
    relevant,
    which,
    with_questions,
)
from ttr.types import fst
from ttr.updates import Game, all_, first, rule
from ttr.updates.checks import faults_of

# What is on the board: the questions under discussion, the maximal one first, what
# somebody claimed, and what is agreed on. There are boards to begin from in
# `ttr.semantics.gameboards`: Cooper's, Ginzburg's and Larsson's.

Board = rectype(qud=ListOf(Question), claimed=ListOf(RecType), agreed=ListOf(RecType))
Ask = rectype(spkr=Ind, question=Question)
Answer = rectype(spkr=Ind, short=Ind)
print("Board:", Board)

# A rule says what the board and the event have to be of, and gives the next board. It
# takes by name what `where` binds, and the model, if it asks for that.


@rule(when=Board, on=Ask)
def asked(s, e):
    "What is asked is the maximal question under discussion."
    return replace(s, qud=push(s.qud, e.question))


@rule(when=Board, on=Answer, where=rectype(question=Question @ fst(outer.s.qud)))
def answered(s, e, question, *, model):
    "A short answer claims what it comes to as an answer to the maximal question."
    if not relevant(e.short, question, model):
        return None
    return replace(s, claimed=[*s.claimed, combine(question, e.short, model)])


@rule(when=Board)
def accepted(s, *, model):
    "What is claimed is agreed on, and what it resolves is not discussed any more."
    if not s.claimed:
        return None
    agreed = (*s.agreed, *s.claimed)
    left = downdate(s.qud, agreed, model)
    return replace(s, qud=left, claimed=[], agreed=agreed)


# A game is a type of boards, a start, and an order of the rules.

leave = Pred("leave", Ind)
M = with_questions(Model())
for name in ("ann", "bo", "kim"):
    M = M.given(name, Ind)

start = record(qud=[], claimed=[], agreed=[])
game = Game("who left", Board, start, all_(first(asked, answered), accepted), M)
who = record(spkr="ann", question=which(leave))
kim = record(spkr="bo", short="kim")

for turn in game.play([who, kim]):
    print("\n" + str(turn))

# An answer to nothing changes nothing: no rule applies.

print("\nan answer first:", game.play([kim])[0].state == start)

# A slip: `agreed` is misspelt. Nothing has to run for that to be seen. A rule that can
# never apply, rules that contradict one another and loops are seen, too.


@rule(when=Board)
def forget(s):
    "Nothing is agreed on any more."
    return replace(s, agred=[]) if s.agreed else None


slip = Game("who left", Board, start, all_(first(asked, answered), forget), M)
for fault in faults_of(slip):
    print("\n" + fault.message + "\nhelp: " + fault.hint)

# And where a rule makes a board that is none, the board stays what it was.


@rule(when=Board, on=Answer)
def parrot(s, e):
    "What somebody answers is agreed on, whatever it is."
    return replace(s, agreed=[*s.agreed, e.short])


try:
    Game("who left", Board, start, parrot, M).play([kim])
except UpdateError as error:
    print(f"\n{error}")
