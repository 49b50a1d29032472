"""`kille memory`: list, show, forget and move what the robot was taught."""
