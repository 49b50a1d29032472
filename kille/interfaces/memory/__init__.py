"""`kille memory`: what the robot was taught, to list, show, forget and move."""
