"""Playing the dialogues of a study."""

from kille.lab.playing.talking import play

__all__ = ["play"]
