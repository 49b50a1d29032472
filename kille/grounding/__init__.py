"""Grounding: what is seen and learned decides what the robot's words are true of."""
