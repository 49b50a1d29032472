"""The game of the stories in tutoring.dlg: stories run Python of their own folder."""

from kille.lab.tutors.tested_game import game

__all__ = ["game"]
