"""The programs: how a person meets the robot."""
