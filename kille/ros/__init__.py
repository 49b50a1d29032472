"""ROS 1 as a bus; nothing of ROS is imported before it is asked for."""
