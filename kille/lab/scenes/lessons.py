"""Lessons about single things, as protocols give them to learners."""

from kille.scene import Percept

Lesson = tuple[Percept, str]
"""A thing, and the right word for it: to be taught, or to be asked for."""
