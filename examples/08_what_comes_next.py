"""What comes next: a game as a type of strings of events, followed event by event.

Run it with `python examples/08_what_comes_next.py`, and read along.
"""

from ttr import Basic, Model, Plus, Pred, Str, subtype
from ttr.errors import UnexpectedError
from ttr.semantics.string_prediction import star, start_course
from ttr.types import EventString

Ind = Basic("Ind")
pick_up, throw = Pred("pick_up", Ind, Ind), Pred("throw", Ind, Ind)
attract, run_after = Pred("attract_attention", Ind, Ind), Pred("run_after", Ind, Ind)
bring_back = Pred("return", Ind, Ind, Ind)

# A game of fetch is a string of events: a human h picks up a stick s, makes the dog d
# look and throws the stick, again as often as the dog brings it back. The game is that
# of Cooper 2023, chapter 2.

Round = Str(
    pick_up("h", "s"),
    attract("h", "d"),
    throw("h", "s"),
    run_after("d", "s"),
    pick_up("d", "s"),
    bring_back("d", "s", "h"),
)
Fetch = Plus(Round)
print("a game of fetch:", Fetch)

# What happens comes in one by one. Who knows the game knows what may come next.

M = Model()
for number, kind in enumerate((*Round.items, pick_up("h", "s")), start=1):
    M = M.given(f"e{number}", kind)

game = start_course(Fetch, M)
print("\nat first:  ", game.expected)
for event in ("e1", "e2", "e3"):
    game = game.seen(event)
    print(f"after {event}:  ", game.expected)

# An event that the game does not expect is refused, and the course stays as it was.

M = M.given("e9", run_after("h", "s"))
try:
    game.judged_in(M).seen("e9")
except UnexpectedError as unexpected:
    print("\n" + unexpected.message)
print("does it fit:", game.judged_in(M).expects("e9"))

# After a whole round the game may be over, or go on. What is left is a type, too.

for event in ("e4", "e5", "e6"):
    game = game.seen(event)
print("\nafter e6:  ", game.expected)
print("may it be over:", game.may_end)
print("after e7 what may follow is", game.seen("e7").rest)

# What is uncertain makes the course uncertain: was that the dog, or a stranger's?

M = M.given("e8", attract("h", "d"), 0.75)
doubtful = game.judged_in(M).seen("e7").seen("e8")
print("\non course:", doubtful.on_course)

# A complete string is judged at once, and if it is none, the first event that does not
# fit is named.

string = EventString("e1", "e2", "e3", "e4", "e5", "e6")
print(f"\n{string} is a game:", M.judge(string, Fetch).p)
skipped = EventString("e1", "e2", "e4")
print(f"{skipped} is a game:", M.judge(skipped, Fetch).p)
print("because", M.judge(skipped, Fetch).why.rule)

# Types of strings are compared by what strings they allow, whatever happens to happen.

twice = Plus(Str(Round, Round))
print("\ntwo by two is a game:", subtype(twice, Fetch).yes)
print("a game is two by two:", subtype(Fetch, twice).verdict)
one_and_more = Str(Round, star(Round))
print("a round and then any:", one_and_more <= Fetch <= one_and_more)
