"""A game of fetch: rules of update, written in a file, played by a human and a dog.

Run it with `python examples/09_a_game_of_fetch.py`, and read along in `fetch.ttr`.
"""

from pathlib import Path

from ttr import load
from ttr.dialogues.encounters import Participant, meeting
from ttr.errors import UpdateError
from ttr.judging.type_acts import Create, Query, perform
from ttr.updates import run

# The theory says what there is, what happens, what an information state is, and by what
# rules it changes (Cooper 2023, chapter 2). A rule is an update function: from a state
# and an event to a type, which the next state is of.

theory = load(Path(__file__).parent / "fetch.ttr")
fetch = theory.games["fetch"]
print(theory.rules["throw_next"].doc)

# A rule runs by itself. The trace says which rule it was, why, and what it changed.

state, model = fetch.start, fetch.model
state, model, trace = run(fetch.algorithm, state, type=fetch.type, model=model)
print(trace[0])

# Type acts: what is on the agenda is a type; an agent may create something of it, or
# ask whether what it sees is of it.

planned = state.agenda[0]
made = perform(Create(planned), model)
print("\n" + str(made))
stick = made.answer.sit
print(perform(Query(stick, theory.Throw), made.model))

# The human and the dog have a board each. Both see what happens, and each brings about
# what it can: of what is on its agenda the dog leaves to the human what is the human's.

human = Participant("human", fetch, theory.Human)
dog = Participant("dog", fetch, theory.Dog)

game = meeting(human, dog)
while len(game.history) < 7:
    game = game.in_turn()
print("\n" + str(game))

# After every event the two boards are the same: they have played one game.

print("\nboards agree:", game.agree)

# A state that is not of its type is refused, with the path and the reason: a board with
# a stone on its agenda is none.

try:
    run(fetch.algorithm, {"agenda": ["stone"]}, type=fetch.type, model=model)
except UpdateError as error:
    print("\n" + str(error))
