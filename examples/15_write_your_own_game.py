"""Write your own game: robots without words make some up, and come to agree on them.

A game is a rule or two. Here is one for what a robot does when it has no idea: whoever
is asked for a name, and knows none, makes one up. Two robots ask each other in turn,
and each hears what the other says: what one has made up, the other learns. Nothing else
of the games of tutoring is changed. Source of the game: Steels 1995, A self-organizing
spatial vocabulary, Artificial Life 2.
"""

from random import Random

from kille.dialogue.games import TUTORING
from kille.dialogue.meanings import noun
from kille.dialogue.moves import answering, content_of, plan, said_of
from kille.dialogue.reference import thing_at
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.worlds import Thing, World
from ttr.updates import replace_rules, rule

CHANCE = Random(7)


@rule(when=answering("AskName"))
def make_up(s):
    "It knows no name for the thing: it makes one up, and goes by it itself."
    name = "".join(CHANCE.choice("bdgklmn") + CHANCE.choice("aeiou") for _ in range(2))
    content = said_of(s, noun(name), thing_at(content_of(s), "target"))
    return plan(s, "AssertName", content, signs=[noun(name)], teaches=[content])


rules = replace_rules(TUTORING, {"admit_name": make_up})
kinds = ("cup", "book", "box")
things = [Thing(kind, "red", place=(3 * n, 3)) for n, kind in enumerate(kinds)]
world = World(tuple(things))
robots = [simulated_game(world, rules=rules, mode="driven") for _ in range(2)]
now = [robot.begin() for robot in robots]


def hears(one: int, event: object) -> list[str]:
    """What a robot says to what it hears or sees."""
    turn = robots[one].take(now[one], event)
    now[one] = turn.run
    return [robots[one].say(move) for move in turn.said]


for turn in range(12):
    asker, asked = turn % 2, (turn + 1) % 2
    world, before = world.point_at(turn % 3 + 1).look_again(), world
    for robot in range(2):
        hears(robot, glance_event(world, before))
    [name] = hears(asked, robots[asked].hear("What is this?"))
    learned = hears(asker, robots[asker].hear(name))
    print(f"{kinds[turn % 3]}: {name}", *learned)

words = [{sign.form for sign in one.state.private.nouns} for one in now]
print("A and B have the same words:", words[0] == words[1], sorted(words[0]))
