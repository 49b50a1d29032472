"""Simulated worlds, perception, learning and tutors: games without a robot.

A `World` is a value; a look at it is named by what there is. `simulated` are the games
of tutoring in front of one: what is seen follows from the name of the look, and what
words are true of is learned by other values. So a dialogue can be played again, and go
on from any of its states. The tutor, in `tutors`, needs hypothesis.

>>> from kille.lab.worlds.games import simulated_game
>>> from kille.lab.worlds.worlds import Thing, World
>>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
>>> turns = game.play([game.hear("This is a cup."), game.hear("What is this?")])
>>> [game.say(move) for turn in turns for move in turn.said]
['OK, I learned a cup.', 'This is a cup.']
"""
