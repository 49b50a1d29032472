"""Talking aloud: what the tutor says is heard, and what the robot says is spoken."""
