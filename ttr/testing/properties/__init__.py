"""The properties that any theory of dialogue should have, P1 to P27.

Read `property` (what a property says, and how a dialogue breaks it) and `catalogue`
(all of them, in the order in which they are checked) first; every other module has a
few that belong together.
"""
