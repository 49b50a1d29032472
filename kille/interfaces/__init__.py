"""The commands, with which a person meets the robot."""
