"""The parts of the robot as nodes on a bus: sensor, perception and dialogue."""
