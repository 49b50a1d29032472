"""Talking: utterances as judgements, games as update rules over one typed state."""
