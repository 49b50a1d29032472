"""The game of the stories in tutoring.dlg: stories run Python of their own folder."""

from kille.simulation.tutoring import game

__all__ = ["game"]
