"""Tutors of a study, kind by kind, and what may be set of each.

simulated: knows the world, see `simulated`. scripted: says the lines of a file `.dlg`.
people: speaks as people's data have it. keyboard: a person types. several: some of the
others take turns, and may disagree. own: a class or function of one's own makes them.
"""

from kille.lab.tutors.kinds import SETTINGS as SETTINGS
from kille.lab.tutors.kinds import faults as faults
