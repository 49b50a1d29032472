"""Playing the dialogues of a study."""

from kille.lab.playing_dialogues.talking import play

__all__ = ["play"]
